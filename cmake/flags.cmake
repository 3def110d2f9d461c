# Warnings and flags, for our own targets only. Never -ffast-math: all instruction sets and both
# compilers give the same bits, which -ffp-contract=off keeps true: what rounds a product and a sum
# once is written so (`multiply_add` in src/math/pack.h).
add_library(portalens_flags INTERFACE)
target_compile_features(portalens_flags INTERFACE cxx_std_20)
set(shadow -Wshadow)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # where files are compiled together, a local name may be that of another's
  set(shadow $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,-Wshadow=local,-Wshadow>)
endif()
target_compile_options(portalens_flags INTERFACE
  -Wall -Wextra ${shadow} -Wnon-virtual-dtor -Wno-psabi -ffp-contract=off -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # g++ 12 sees bounds in its own std::string that are not there
  target_compile_options(portalens_flags INTERFACE
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()
if(PORTALENS_SANITIZE)
  target_compile_options(portalens_flags INTERFACE
    -fsanitize=${PORTALENS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(portalens_flags INTERFACE -fsanitize=${PORTALENS_SANITIZE})
endif()
if(PORTALENS_STD_THREADS OR PORTALENS_PORTABLE)
  target_compile_definitions(portalens_flags INTERFACE PORTALENS_STD_THREADS)
endif()
if(PORTALENS_FUZZ)  # toml++ compiled in, so that the fuzzer sees into it
  target_compile_definitions(portalens_flags INTERFACE TOML_HEADER_ONLY=1)
endif()
