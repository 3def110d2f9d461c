/// \file
/// The film: which part of the picture is taken, tile by tile, and what has reached it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/image.h"
#include "math/vec3.h"

namespace portalens {

/// Pixels x0 <= x < x1, y0 <= y < y1, counted from the top left of the whole picture.
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  [[nodiscard]] int width() const { return x1 - x0; }
  [[nodiscard]] int height() const { return y1 - y0; }
  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  }
};

/// A window cut into squares, smaller at its right and lower edges, counted row by row.
class Tiling {
 public:
  /// @pre size >= 1, and the window is not empty
  Tiling(const Window& window, int size)
      : window_(window), size_(size), columns_((window.width() - 1) / size + 1) {}

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(columns_) *
           (static_cast<std::size_t>((window_.height() - 1) / size_) + 1);
  }
  [[nodiscard]] Window operator[](std::size_t i) const {
    const int x = window_.x0 + static_cast<int>(i % columns_) * size_;
    const int y = window_.y0 + static_cast<int>(i / columns_) * size_;
    return {x, y, x + std::min(size_, window_.x1 - x), y + std::min(size_, window_.y1 - y)};
  }

 private:
  Window window_;
  int size_;
  int columns_;
};

/// Linear radiance of each pixel of a window. Different pixels may be set from different threads.
class Exposure {
 public:
  explicit Exposure(const Window& window)
      : window_(window), image_(window.width(), window.height(), 3) {}

  /// @pre (x, y) lies in the window
  void set(int x, int y, Rgb radiance) {
    float* pixel = image_.at(x - window_.x0, y - window_.y0);
    pixel[0] = static_cast<float>(radiance.x);
    pixel[1] = static_cast<float>(radiance.y);
    pixel[2] = static_cast<float>(radiance.z);
  }
  /// The picture of the window so far.
  [[nodiscard]] const Image& image() const { return image_; }
  [[nodiscard]] Image release() && { return std::move(image_); }

 private:
  Window window_;
  Image image_;
};

}  // namespace portalens
