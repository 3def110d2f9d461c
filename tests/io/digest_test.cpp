// Digests tell bytes apart, and are the same wherever they are taken.
#include "io/digest.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace portalens::test {
namespace {

TEST(Digest, IsThatOfXxHash) {
  // Of no bytes: the first value of xxHash's own tests (XXH3, 128 bits, seed 0).
  EXPECT_EQ(digest(""), "99aa06d3014798d86001c324468d497f");
}

TEST(Digest, TellsOfEveryChangedBitAndEveryLength) {
  const std::string bytes(1000, 'a');
  std::set<std::string> seen;
  std::size_t taken = 0;
  for (std::size_t size = 0; size <= bytes.size(); ++size, ++taken)
    seen.insert(digest(std::string_view(bytes).substr(0, size)));
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit, ++taken) {
    std::string changed = bytes;
    changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
    seen.insert(digest(changed));
  }
  EXPECT_EQ(seen.size(), taken);
  for (const std::string& one : seen) ASSERT_EQ(one.size(), 32u);
}

}  // namespace
}  // namespace portalens::test
