#include "portalens/version.h"

namespace portalens::api {
namespace {

/// The number that a version's text stands for.
constexpr int number_of(std::string_view text) {
  int number = 0, part = 0;
  for (const char letter : text) {
    if (letter == '.')
      number = 100 * (number + part), part = 0;
    else
      part = 10 * part + (letter - '0');
  }
  return number + part;
}
static_assert(number_of(version) == PORTALENS_VERSION);

}  // namespace

std::string_view linked_version() noexcept { return version; }

}  // namespace portalens::api
