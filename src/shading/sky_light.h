/// \file
/// The environment as a lamp, infinitely far all round: `lights` in `[environment]`.
#pragma once

#include <cstddef>
#include <vector>

#include "shading/environment.h"
#include "shading/light_sample.h"

namespace portalens {

/// Directions are drawn in proportion to the brightness there, so that a small sun in a picture is
/// found as surely as a lamp. Between the centres of four pixels the picture is bilinear; that is a
/// cell, and the density of directions is bilinear in it too, over azimuth and sine of latitude. It
/// is nowhere 0: what might shine is never left out.
class SkyLight {
 public:
  static constexpr bool is_delta = false;
  static constexpr bool is_distant = true;

  /// @pre it is not black
  explicit SkyLight(const Environment& sky);

  [[nodiscard]] LightSample sample(Vec3d x, double u1, double u2) const;
  /// Of the directions that are drawn, per solid angle: as bright as the sky is there.
  [[nodiscard]] double density(Vec3d direction) const;
  /// W/m², of a surface, in the mean over all directions that it may face: π times the mean
  /// radiance.
  [[nodiscard]] Rgb power() const { return power_; }
  [[nodiscard]] std::size_t table_bytes() const {
    return rows_.size() * sizeof(rows_[0]) + columns_.size() * sizeof(columns_[0]);
  }

 private:
  /// Its corners' brightnesses.
  struct Cell {
    double top_left, top_right, bottom_left, bottom_right;
    [[nodiscard]] double mean() const {
      return 0.25 * ((top_left + top_right) + (bottom_left + bottom_right));
    }
  };
  /// Where a row of cells lies, as the sines of latitude of its upper and lower edge.
  struct Band {
    double top, bottom;
    [[nodiscard]] double height() const { return top - bottom; }
  };

  [[nodiscard]] Rgb color(int x, int y) const;
  [[nodiscard]] double brightness(int x, int y) const;
  /// @param column  0 to width - 1: from that column of pixels to the next, round the sky
  /// @param row     0 to height: from the row of pixels above that to that one
  [[nodiscard]] Cell cell(int column, int row) const;
  [[nodiscard]] Band band(int row) const;
  void find_power();
  void fill_tables();

  Environment sky_;
  int width_ = 1, height_ = 1;  ///< in pixels; a colour is one
  double least_ = 0.0;          ///< is added to the brightness everywhere
  double total_ = 0.0;          ///< brightness, over all directions
  Rgb power_;
  std::vector<double> rows_;    ///< the share of the light up to and with each row of cells
  std::vector<float> columns_;  ///< of each row, up to and with each of its cells
};

}  // namespace portalens
