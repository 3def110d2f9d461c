/// \file
/// How many samples a test takes: PORTALENS_TEST_SCALE multiplies the counts.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace portalens::test {

inline double test_scale() {
  const char* text = std::getenv("PORTALENS_TEST_SCALE");
  const double scale = text ? std::atof(text) : 1.0;
  return scale > 0.0 ? scale : 1.0;
}

/// `count` times the scale, at least 1.
inline int scaled(int count) { return std::max(1, static_cast<int>(count * test_scale())); }

}  // namespace portalens::test
