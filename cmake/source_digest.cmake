# Writes a header with a digest of the sources: what was computed by other sources is not gone on
# with. Run as `cmake -DSOURCES=... -DHEADER=... -P`; SOURCES is the folder.
file(GLOB_RECURSE files LIST_DIRECTORIES false RELATIVE ${SOURCES} ${SOURCES}/*.h ${SOURCES}/*.cpp)
list(SORT files)
set(all "")
foreach(file ${files})
  file(SHA256 ${SOURCES}/${file} digest)
  string(APPEND all "${file} ${digest}\n")
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING ${digest} 0 16 digest)
file(CONFIGURE OUTPUT ${HEADER} CONTENT
  "/// \\file\n/// Written by cmake/source_digest.cmake.\n#pragma once\n\n#define PORTALENS_SOURCE_DIGEST \"${digest}\"\n")
