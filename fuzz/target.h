/// \file
/// What all fuzz targets share. A target is one function that takes any bytes whatever, as a
/// stranger's file; libFuzzer calls it with what it makes up (`make fuzz`), and fuzz/replay.cpp
/// with the files that are kept (`make test`).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace portalens::fuzz {

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A condition that every input must leave true.
/// @post the program is ended, with what was expected, if it does not hold
void require(bool condition, const char* expectation);

}  // namespace portalens::fuzz
