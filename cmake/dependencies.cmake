# Debian 12's own packages; scripts/install-deps names them.
find_package(PkgConfig REQUIRED)
find_package(embree 3 REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenImageIO 2.4 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(utf8cpp REQUIRED)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(xsimd REQUIRED IMPORTED_TARGET xsimd)
if(PORTALENS_TESTS)
  find_package(GTest REQUIRED)
  find_package(tinyobjloader REQUIRED)  # what our reader of meshes is held against
endif()

add_library(portalens_dependencies INTERFACE)
target_link_libraries(portalens_dependencies INTERFACE
  embree TBB::tbb OpenImageIO::OpenImageIO fmt::fmt CLI11::CLI11
  nlohmann_json::nlohmann_json utf8cpp PkgConfig::xsimd Threads::Threads ZLIB::ZLIB)
if(PORTALENS_FUZZ)  # compiled in, so that the fuzzer sees into it
  target_compile_definitions(portalens_dependencies INTERFACE TOML_HEADER_ONLY=1)
else()
  target_link_libraries(portalens_dependencies INTERFACE PkgConfig::tomlplusplus)
endif()
