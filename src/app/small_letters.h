/// \file
/// Capitals, figures and a few signs, five pixels high: the letters of drawings in pixels.
#pragma once

#include <string_view>

namespace portalens {

inline constexpr int letter_rows = 5;

/// The rows of a letter from the top, separated by '|'; '#' is ink. All rows are equally long.
/// Small letters look as capitals; a frame stands for what has no letter here.
[[nodiscard]] std::string_view letter_of(char c);

}  // namespace portalens
