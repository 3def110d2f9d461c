/// \file
/// What colour a surface has where: one colour, a checker, or a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>

#include "core/image.h"
#include "core/parameters.h"
#include "geometry/ray.h"
#include "shading/picture.h"

namespace portalens {

/// The image that a scene names, or null after a fault (which the loader has added).
using ImageLoader =
    std::function<std::shared_ptr<const Image>(const std::string& name, const Location& asked_at)>;

struct Constant {
  Rgb color{0.5, 0.5, 0.5};
  [[nodiscard]] Rgb at(const SurfacePoint&) const { return color; }
};

/// Flat faces: squares of `size` along the first edge and across it, counted from the first vertex.
/// Curved ones: by u/size and v/size.
struct Checker {
  Rgb first, second;
  double size = 1.0;
  [[nodiscard]] Rgb at(const SurfacePoint& point) const {
    const std::int64_t a = floored((point.flat ? point.along : point.u) / size);
    const std::int64_t b = floored((point.flat ? point.across : point.v) / size);
    // Picked, not decided: far away the squares come in no order that a processor could foresee.
    const Rgb* const colors[] = {&first, &second};
    return *colors[(a ^ b) & 1];
  }

 private:
  /// The largest whole number not above x. Beyond 2^62 all doubles are even, and 0 stands for them.
  [[nodiscard]] static std::int64_t floored(double x) {
    constexpr double most = 0x1p62;
    if (!(x > -most && x < most)) return 0;
    const auto towards_zero = static_cast<std::int64_t>(x);
    return towards_zero - (static_cast<double>(towards_zero) > x);
  }
};

using Texture = std::variant<Constant, Checker, Picture>;

[[nodiscard]] inline Rgb color_at(const Texture& texture, const SurfacePoint& point) {
  return std::visit([&](const auto& kind) { return kind.at(point); }, texture);
}

/// Whether its colour depends on `u` and `v` on a flat face, too: those take long to find there.
[[nodiscard]] inline bool uses_coordinates(const Texture& texture) {
  const auto* picture = std::get_if<Picture>(&texture);
  return picture && picture->uses_coordinates();
}

/// The same, all its colours multiplied.
[[nodiscard]] Texture scaled(Texture texture, double by);

/// The largest value of each channel anywhere on the texture.
[[nodiscard]] Rgb brightest(const Texture& texture);
/// The same of the sum of two that lie on each other; or more, where they are not of one pattern.
[[nodiscard]] Rgb brightest_sum(const Texture& one, const Texture& other);

/// What `key` says: `[r, g, b]`, `{ checker = [[r,g,b], [r,g,b]], size = s }`, an image's file, or
/// `{ image = "file", size, offset, rotation, wrap }`.
[[nodiscard]] Texture texture_from(Parameters& parameters, std::string_view key,
                                   const Texture& fallback, const ImageLoader& load);

}  // namespace portalens
