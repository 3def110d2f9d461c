#include "io/development.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "math/vec3.h"

namespace portalens {
namespace {

using Matrix = std::array<Vec3d, 3>;  // rows

Vec3d operator*(const Matrix& m, Vec3d v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix product;
  for (std::size_t i = 0; i < 3; ++i) product[i] = b[0] * a[i].x + b[1] * a[i].y + b[2] * a[i].z;
  return product;
}

Matrix inverse(const Matrix& m) {
  const Vec3d a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
  const double determinant = dot(m[0], a);
  return {Vec3d{a.x, b.x, c.x} / determinant, Vec3d{a.y, b.y, c.y} / determinant,
          Vec3d{a.z, b.z, c.z} / determinant};
}

/// From linear sRGB to XYZ (IEC 61966-2-1), and from XYZ to Bradford's cone responses.
constexpr Matrix xyz_of_srgb = {{{0.4124564, 0.3575761, 0.1804375},
                                 {0.2126729, 0.7151522, 0.0721750},
                                 {0.0193339, 0.1191920, 0.9503041}}};
constexpr Matrix bradford = {
    {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

/// XYZ of a black body, Y = 1.
Vec3d black_body_white(double kelvin) {
  const double t = 1000.0 / kelvin;
  const double x = kelvin < 4000.0 ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                                   : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  const double y =
      kelvin < 2222.0   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
      : kelvin < 4000.0 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                        : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  return {x / y, 1.0, (1.0 - x - y) / y};
}

Matrix white_balance_of(double kelvin) {
  constexpr double neutral = 6504.0;
  const Vec3d from = bradford * black_body_white(kelvin), to = bradford * black_body_white(neutral);
  const Matrix scaled = {Vec3d{to.x / from.x, 0, 0}, Vec3d{0, to.y / from.y, 0},
                         Vec3d{0, 0, to.z / from.z}};
  const Matrix cones = bradford * xyz_of_srgb;
  return inverse(cones) * (scaled * cones);
}

double filmic(double x) {
  return std::min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
}

/// From 0 to 1 as x goes from 0 to 1, through (pivot, grey) with that slope; the larger `bend`, the
/// later it leaves the straight line towards either end.
double sigmoid(double x) {
  constexpr double pivot = 10.0 / 16.5, grey = 0.4587, slope = 2.4, bend = 1.5;  // .18^(1 / 2.2)
  const double side = x < pivot ? -1.0 : 1.0;
  const double room = side < 0.0 ? grey : 1.0 - grey;
  const double farthest = slope * (side < 0.0 ? pivot : 1.0 - pivot);
  const double scale = farthest / std::pow(std::pow(farthest / room, bend) - 1.0, 1.0 / bend);
  const double u = slope * std::fabs(x - pivot);
  return grey + side * u / std::pow(1.0 + std::pow(u / scale, bend), 1.0 / bend);
}

double agx_like(double light) {
  constexpr double middle_grey = 0.18, darkest = -10.0, brightest = 6.5;  // stops
  const double stops = std::log2(std::max(light, 1e-12) / middle_grey);
  const double x = std::clamp((stops - darkest) / (brightest - darkest), 0.0, 1.0);
  return std::pow(std::max(0.0, sigmoid(x)), 2.2);
}

/// Bright colours go towards white as their channels are mixed before the curve.
constexpr Matrix inset = {{{0.84, 0.10, 0.06}, {0.06, 0.86, 0.08}, {0.06, 0.10, 0.84}}};

Vec3d toned(Vec3d light, Tone tone) {
  static const Matrix outset = inverse(inset);
  const Vec3d there{std::max(0.0, light.x), std::max(0.0, light.y), std::max(0.0, light.z)};
  switch (tone) {
    case Tone::linear:
      return light;
    case Tone::filmic:
      return {filmic(there.x), filmic(there.y), filmic(there.z)};
    case Tone::agx_like: {
      const Vec3d mixed = inset * there;
      return outset * Vec3d{agx_like(mixed.x), agx_like(mixed.y), agx_like(mixed.z)};
    }
  }
  return light;
}

}  // namespace

Development Development::from(Parameters& parameters) {
  Development development;
  development.exposure = parameters.number("exposure", exposure_bounds, development.exposure);
  const std::string tone = parameters.choice("tone", tone_names, std::string(tone_names[0]));
  const auto* const known = std::find(tone_names.begin(), tone_names.end(), tone);
  if (known != tone_names.end()) development.tone = static_cast<Tone>(known - tone_names.begin());
  if (parameters.has("white_balance"))
    development.white_balance = parameters.number("white_balance", white_balance_bounds, 6504.0);
  return development;
}

Image developed(Image image, const Development& development) {
  if (development.changes_nothing()) return image;
  const double factor = std::exp2(development.exposure);
  const Matrix balance = development.white_balance ? white_balance_of(*development.white_balance)
                                                   : Matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      float* const pixel = image.at(x, y);
      Vec3d light = Vec3d{pixel[0], pixel[1], pixel[2]} * factor;
      if (development.white_balance) light = balance * light;
      light = toned(light, development.tone);
      pixel[0] = static_cast<float>(light.x);
      pixel[1] = static_cast<float>(light.y);
      pixel[2] = static_cast<float>(light.z);
    }
  return image;
}

}  // namespace portalens
