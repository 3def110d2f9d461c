# Writes a header with a digest of the sources: what was computed by other sources is not gone on
# with. Run as `cmake -DSOURCES=... -DHEADER=... [-DNAME=...] [-DLEAVE_OUT=...] -P`; SOURCES is the
# folder, NAME the macro, and LEAVE_OUT a pattern of files in it that don't matter.
if(NOT NAME)
  set(NAME PORTALENS_SOURCE_DIGEST)
endif()
file(GLOB_RECURSE files LIST_DIRECTORIES false RELATIVE ${SOURCES} ${SOURCES}/*.h ${SOURCES}/*.cpp)
if(LEAVE_OUT)
  list(FILTER files EXCLUDE REGEX "${LEAVE_OUT}")
endif()
list(SORT files)
set(all "")
foreach(file ${files})
  file(SHA256 ${SOURCES}/${file} digest)
  string(APPEND all "${file} ${digest}\n")
endforeach()
string(SHA256 digest "${all}")
string(SUBSTRING ${digest} 0 16 digest)
file(CONFIGURE OUTPUT ${HEADER} CONTENT
  "/// \\file\n/// Written by cmake/source_digest.cmake.\n#pragma once\n\n#define ${NAME} \"${digest}\"\n")
