# Builds for WebAssembly (cmake --preset wasm): the core alone, in one thread, upon the headers of
# fmt, JSON, toml++, UTF8-CPP, xsimd and xxHash. They lie among those of this machine, of which no other may be seen.
set(portalens_linked)
set(header_folder ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${header_folder})
foreach(header fmt/format.h nlohmann/json.hpp toml++/toml.h utf8/core.h xsimd/xsimd.hpp)
  find_path(folder_of_${header} ${header} NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include REQUIRED)
  get_filename_component(library ${header} DIRECTORY)
  file(CREATE_LINK ${folder_of_${header}}/${library} ${header_folder}/${library} SYMBOLIC)
endforeach()
foreach(header utf8.h xxhash.h)
  find_file(file_of_${header} ${header} NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include REQUIRED)
  file(CREATE_LINK ${file_of_${header}} ${header_folder}/${header} SYMBOLIC)
endforeach()
add_library(portalens_dependencies INTERFACE)
target_include_directories(portalens_dependencies SYSTEM INTERFACE ${header_folder})
target_compile_definitions(portalens_dependencies INTERFACE
  FMT_HEADER_ONLY=1 TOML_HEADER_ONLY=1 PORTALENS_ONE_THREAD)
target_compile_options(portalens_dependencies INTERFACE -fexceptions)
