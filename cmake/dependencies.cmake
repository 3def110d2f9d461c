# Debian 12's own packages; scripts/install-deps names them. What the library itself stands on is
# named again in portalensConfig.cmake.in, for whoever links it.
if(EMSCRIPTEN)
  include(${CMAKE_CURRENT_LIST_DIR}/emscripten.cmake)
  return()
endif()
if(NOT PORTALENS_PORTABLE)
  find_package(embree 3 REQUIRED)
  find_package(TBB REQUIRED)
  find_package(OpenImageIO 2.4 REQUIRED)
endif()
find_package(fmt 9 REQUIRED)
find_package(utf8cpp REQUIRED)
find_path(xxhash_folder xxhash.h REQUIRED)  # its header alone: it is compiled in
find_package(Threads REQUIRED)
find_package(tomlplusplus 3.3 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(xsimd REQUIRED IMPORTED_TARGET xsimd)  # its CMake files want xtl
find_package(CLI11 2.1 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(ZLIB REQUIRED)
if(PORTALENS_TESTS)
  find_package(GTest REQUIRED)
  find_package(tinyobjloader REQUIRED)  # what our reader of meshes is held against
endif()

# What the library is linked with, wherever; and what it is compiled with here. The one is reached
# by way of the other, because OpenImageIO's CMake files name folders that its package lacks.
set(portalens_linked fmt::fmt Threads::Threads)
if(NOT PORTALENS_PORTABLE)
  list(APPEND portalens_linked embree TBB::tbb OpenImageIO::OpenImageIO)
endif()
if(NOT PORTALENS_FUZZ)
  list(APPEND portalens_linked tomlplusplus::tomlplusplus)
endif()
add_library(portalens_dependencies INTERFACE)
target_link_libraries(portalens_dependencies INTERFACE ${portalens_linked} PkgConfig::xsimd utf8cpp nlohmann_json::nlohmann_json)
target_include_directories(portalens_dependencies SYSTEM INTERFACE ${xxhash_folder})
