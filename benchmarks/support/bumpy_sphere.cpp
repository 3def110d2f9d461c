#include "support/bumpy_sphere.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

namespace portalens::benchmarks {
namespace {

/// Of the surface in a direction: waves of several lengths.
double radius(double x, double y, double z) {
  return 1.0 + 0.05 * std::sin(5.0 * x + 1.0) * std::sin(4.0 * y) * std::cos(6.0 * z) +
         0.01 * std::sin(23.0 * x) * std::cos(19.0 * y + 2.0) +
         0.002 * std::sin(90.0 * y) * std::sin(80.0 * z + 70.0 * x);
}

}  // namespace

std::string bumpy_sphere(int triangles) {
  // Twice as many columns as rows: 2 columns (rows - 1) triangles.
  const int rows = 1 + static_cast<int>(std::ceil(0.5 * (1.0 + std::sqrt(1.0 + triangles))));
  const int columns = 2 * (rows - 1);
  std::string text;
  const auto add = [&text](double x, double y, double z) {
    const double r = radius(x, y, z);
    fmt::format_to(std::back_inserter(text), "v {:.7f} {:.7f} {:.7f}\n", r * x, r * y, r * z);
  };
  add(0, 1, 0);
  for (int i = 1; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double from_pole = std::numbers::pi * i / rows;
      const double around = 2.0 * std::numbers::pi * j / columns;
      add(std::sin(from_pole) * std::sin(around), std::cos(from_pole),
          std::sin(from_pole) * std::cos(around));
    }
  add(0, -1, 0);
  const auto face = [&text](int a, int b, int c) {
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", a, b, c);
  };
  const int last = 2 + (rows - 1) * columns;
  const auto vertex = [&](int i, int j) { return 2 + (i - 1) * columns + j % columns; };
  for (int j = 0; j < columns; ++j) {
    face(1, vertex(1, j), vertex(1, j + 1));
    for (int i = 1; i + 1 < rows; ++i) {
      face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
    face(vertex(rows - 1, j), last, vertex(rows - 1, j + 1));
  }
  return text;
}

}  // namespace portalens::benchmarks
