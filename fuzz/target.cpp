#include "target.h"

#include <cstdio>
#include <cstdlib>

namespace portalens::fuzz {

void require(bool condition, const char* expectation) {
  if (condition) return;
  std::fprintf(stderr, "fuzz: not so: %s\n", expectation);
  std::abort();
}

}  // namespace portalens::fuzz
