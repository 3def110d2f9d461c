/// \file
/// From the light of a scene to the values of a picture that is looked at: exposure, white balance
/// and a tone curve. docs/scene-files.md, "Pictures to look at".
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/image.h"
#include "core/parameters.h"

namespace portalens {

/// How values above 1 end up below it.
enum class Tone { linear, filmic, agx_like };
inline constexpr std::array<std::string_view, 3> tone_names = {"linear", "filmic", "agx-like"};

/// None of it changes anything unless it is asked for.
struct Development {
  double exposure = 0.0;  ///< stops: light × 2^exposure
  Tone tone = Tone::linear;
  std::optional<double> white_balance;  ///< kelvin: a black body of that temperature looks white

  /// Keys exposure, tone, white_balance.
  static Development from(Parameters& parameters);
  [[nodiscard]] bool changes_nothing() const {
    return exposure == 0.0 && tone == Tone::linear && !white_balance;
  }
};

inline constexpr Bounds exposure_bounds{-40.0, 40.0, false};
inline constexpr Bounds white_balance_bounds{1667.0, 25000.0, false};

/// The image with its first three channels developed: linear values, to be written as sRGB.
/// White balance is Bradford's adaptation from the black body's white to that of 6504 K; a black
/// body's chromaticity is Kim, Lee and Lee's cubic (US patent 7024034). `filmic` is Narkowicz's fit
/// of the Academy's curve, channel by channel; `agx-like` a sigmoid of the logarithm of light from
/// 10 stops below middle grey to 6.5 above, between a mixing of the channels and its inverse.
[[nodiscard]] Image developed(Image image, const Development& development);

}  // namespace portalens
