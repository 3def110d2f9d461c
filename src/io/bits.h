/// \file
/// `std::bit_cast`, which emscripten's library lacks.
#pragma once

#include <type_traits>

namespace portalens {

template <class To, class From>
[[nodiscard]] constexpr To bit_cast(const From& from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
                std::is_trivially_copyable_v<From>);
  return __builtin_bit_cast(To, from);
}

}  // namespace portalens
