#include "shading/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace portalens {
namespace {

using std::numbers::pi;

/// One of several, and what is left of the uniform number that chose it: uniform again.
struct Choice {
  int index = 0;
  double probability = 0.0, left = 0.0;
};

/// @param up_to  shares up to and with each; the last is 1
template <class Real>
Choice choose(const Real* up_to, int count, double u) {
  const Real* const found = std::upper_bound(up_to, up_to + count - 1, u,
                                             [](double wanted, Real sum) { return wanted < sum; });
  const double before = found == up_to ? 0.0 : double{*(found - 1)};
  const double probability = *found - before;
  return {static_cast<int>(found - up_to), probability,
          std::clamp((u - before) / probability, 0.0, 1.0)};
}

double mixed(double a, double b, double share) { return a + (b - a) * share; }

/// A number of [0, 1] whose density grows linearly from `a` to `b`, neither below 0, one above.
double linearly(double a, double b, double u) {
  return u * (a + b) / (a + std::sqrt(mixed(a * a, b * b, u)));
}

}  // namespace

SkyLight::SkyLight(const Environment& sky) : sky_(sky) {
  sky_.discs.clear();  // suns are lamps of their own
  if (sky_.image) width_ = sky_.image->width, height_ = sky_.image->height;
  find_power();
  constexpr double least_share = 0.01;
  least_ = least_share * (power_.x + power_.y + power_.z) / (3.0 * pi);
  fill_tables();
}

Rgb SkyLight::color(int x, int y) const {
  return sky_.image ? sky_.scale * pixel(*sky_.image, x, y) : sky_.color;
}

double SkyLight::brightness(int x, int y) const {
  const Rgb seen = color(x, y);
  return (seen.x + seen.y + seen.z) / 3.0 + least_;
}

SkyLight::Cell SkyLight::cell(int column, int row) const {
  const int right = (column + 1) % width_;
  const int top = std::max(row - 1, 0), bottom = std::min(row, height_ - 1);
  return {brightness(column, top), brightness(right, top), brightness(column, bottom),
          brightness(right, bottom)};
}

SkyLight::Band SkyLight::band(int row) const {
  const auto sine = [&](double y) { return std::cos(pi * std::clamp(y / height_, 0.0, 1.0)); };
  return {sine(row - 0.5), sine(row + 0.5)};
}

/// Each row of pixels counts by the integral of its share of what is seen between it and the next,
/// over the sine of latitude.
void SkyLight::find_power() {
  std::vector<double> weights(static_cast<std::size_t>(height_));
  for (int row = 0; row <= height_; ++row) {
    const auto angle = [&](double y) { return pi * std::clamp(y / height_, 0.0, 1.0); };
    const double first = angle(row - 0.5), last = angle(row + 0.5);
    const double below = (std::sin(last) - std::sin(first)) / (last - first) - std::cos(last);
    weights[static_cast<std::size_t>(std::max(row - 1, 0))] += band(row).height() - below;
    weights[static_cast<std::size_t>(std::min(row, height_ - 1))] += below;
  }
  for (int y = 0; y < height_; ++y) {
    Rgb sum;
    for (int x = 0; x < width_; ++x) sum += color(x, y);
    power_ += sum * (0.5 * pi / width_ * weights[static_cast<std::size_t>(y)]);
  }
}

void SkyLight::fill_tables() {
  const std::size_t width = static_cast<std::size_t>(width_);
  columns_.resize(width * static_cast<std::size_t>(height_ + 1));
  std::vector<double> sums(width);
  double all = 0.0;
  for (int row = 0; row <= height_; ++row) {
    double sum = 0.0;
    for (int column = 0; column < width_; ++column)
      sums[static_cast<std::size_t>(column)] = sum += cell(column, row).mean();
    float* const shares = &columns_[static_cast<std::size_t>(row) * width];
    for (std::size_t i = 0; i < width; ++i) shares[i] = static_cast<float>(sums[i] / sum);
    shares[width - 1] = 1.0f;
    rows_.push_back(all += sum * band(row).height());
  }
  total_ = all * 2.0 * pi / width_;
  for (double& up_to : rows_) up_to /= all;
  rows_.back() = 1.0;
}

double SkyLight::density(Vec3d direction) const {
  const Rgb seen = sky_.radiance(direction);
  return ((seen.x + seen.y + seen.z) / 3.0 + least_) / total_;
}

LightSample SkyLight::sample(Vec3d /*x*/, double u1, double u2) const {
  const Choice row = choose(rows_.data(), height_ + 1, u2);
  const float* const shares =
      &columns_[static_cast<std::size_t>(row.index) * static_cast<std::size_t>(width_)];
  const Choice column = choose(shares, width_, u1);
  const Cell here = cell(column.index, row.index);
  const double down =
      linearly(here.top_left + here.top_right, here.bottom_left + here.bottom_right, row.left);
  const double left = mixed(here.top_left, here.bottom_left, down);
  const double right = mixed(here.top_right, here.bottom_right, down);
  const double across = linearly(left, right, column.left);

  const Band at = band(row.index);
  const double x = column.index + 0.5 + across;
  const double y = std::acos(std::clamp(mixed(at.top, at.bottom, down), -1.0, 1.0)) / pi * height_;
  // Over the density of directions: that of its cell, times the part of its place in there.
  const double solid_angle = 2.0 * pi / width_ * at.height();
  const double density =
      row.probability * column.probability / solid_angle * mixed(left, right, across) / here.mean();
  LightSample sample;
  sample.position = sky_.direction_of(x / width_, y / height_);
  sample.distant = true;
  sample.facing = sky_.radiance_at(x / width_, y / height_) / density;
  return sample;
}

}  // namespace portalens
