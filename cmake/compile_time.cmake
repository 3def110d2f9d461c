# Headers of others that most files include, compiled once for all of them. The build for WebAssembly does
# without: there it shows if a file has forgotten one.
set(precompiled_headers <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <span> <string>
  <variant> <vector> <fmt/format.h>)
function(precompile target)
  if(NOT EMSCRIPTEN)
    target_precompile_headers(${target} PRIVATE ${precompiled_headers} ${ARGN})
  endif()
endfunction()
# Together, eight files at a time: all of them take a third of the time, each alone more.
function(compile_together target)
  if(PORTALENS_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  endif()
endfunction()
# Not for files with options of their own.
function(precompile_not)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
endfunction()
