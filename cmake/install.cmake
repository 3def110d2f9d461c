# What `cmake --install` puts where: the program with its manual page, completions and scenes, the
# library with its headers, and what find_package(portalens) reads. docs/library.md says what the
# version promises.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/portalens)

install(TARGETS portalens RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
find_program(PYTHON python3)
if(PYTHON AND NOT CMAKE_CROSSCOMPILING)
  set(manual_page ${CMAKE_BINARY_DIR}/generated/portalens.1)
  install(CODE "execute_process(
    COMMAND \"${PYTHON}\" \"${PROJECT_SOURCE_DIR}/tools/man_page.py\" \"$<TARGET_FILE:portalens>\"
    OUTPUT_FILE \"${manual_page}\" COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${manual_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/share/completions/portalens.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME portalens)
install(FILES ${PROJECT_SOURCE_DIR}/share/completions/_portalens
  DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/portalens)
install(TARGETS portalens_core EXPORT portalensTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/portalens
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT portalensTargets NAMESPACE portalens:: DESTINATION ${package_folder})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/portalensConfig.cmake.in
  ${CMAKE_BINARY_DIR}/generated/portalensConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/portalensConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/generated/portalensConfig.cmake
  ${CMAKE_BINARY_DIR}/generated/portalensConfigVersion.cmake DESTINATION ${package_folder})
