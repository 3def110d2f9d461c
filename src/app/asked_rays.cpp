#include "app/asked_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "app/read_rays.h"
#include "core/error.h"
#include "geometry/rays.h"

namespace portalens {
namespace {

constexpr std::size_t max_rays = 10000;

class Collector {
 public:
  Collector(const World& world, const AskedRays& asked) : world_(world), asked_(asked) {}

  void add_rays() {
    int number = 0;
    for (const Ray& ray : rays_in(asked_.rays, faults_))
      rays_.push_back({fmt::format("ray {}", ++number), ray});
  }

  void add_file() {
    if (asked_.file.empty()) return;
    std::vector<Ray> rays;
    if (asked_.file == "-") {
      rays = read_rays(std::cin, "standard input");
    } else {
      std::ifstream file(asked_.file);
      if (!file || std::filesystem::is_directory(asked_.file)) {
        faults_.add({std::make_shared<const std::string>(asked_.file), 0}, "can't be read",
                    "--rays needs a file of lines 'x y z dx dy dz'");
        return;
      }
      rays = read_rays(file, asked_.file);
    }
    for (std::size_t i = 0; i < rays.size(); ++i)
      rays_.push_back({fmt::format("ray {} of the file", i + 1), rays[i]});
  }

  void add_pixels() {
    const Film& film = world_.film;
    for (std::size_t i = 0; i + 1 < asked_.pixels.size(); i += 2) {
      const int x = asked_.pixels[i], y = asked_.pixels[i + 1];
      if (x < 0 || y < 0 || x >= film.width || y >= film.height)
        fault(fmt::format("--pixel {} {} lies outside the picture", x, y),
              fmt::format("0 <= X < {} and 0 <= Y < {} are needed", film.width, film.height));
      else
        rays_.push_back({fmt::format("pixel {} {}", x, y), through(x + 0.5, y + 0.5)});
    }
  }

  void add_fan(Vec3d across) {
    const std::vector<double>& fan = asked_.fan;
    if (fan.empty()) return;
    std::array<double, 6> numbers{};
    std::copy_n(fan.begin(), 6, numbers.begin());
    const auto middle = ray_of(numbers);
    const double spread = fan[6], count = fan[7];
    if (!middle || !(spread >= 0.0 && spread <= 360.0) || !(count >= 1.0) || count > max_rays ||
        count != std::floor(count)) {
      fault("--fan is no fan of rays",
            fmt::format("OX OY OZ DX DY DZ SPREAD COUNT are needed: the direction not zero, the "
                        "spread 0 to 360 degrees, the count 1 to {}",
                        max_rays));
      return;
    }
    int number = 0;
    for (const Ray& ray : fan_of(*middle, across, spread, static_cast<int>(count)))
      rays_.push_back({fmt::format("fan {}", ++number), ray});
  }

  void add_grid() {
    if (asked_.grid.empty()) return;
    const int columns = asked_.grid[0], rows = asked_.grid[1];
    const auto most = static_cast<std::int64_t>(max_rays);
    if (columns < 1 || rows < 1 || static_cast<std::int64_t>(columns) * rows > most) {
      fault(fmt::format("--grid {} {} is no grid of photons", columns, rows),
            fmt::format("at least 1 of each, and no more than {} together, are needed", most));
      return;
    }
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        rays_.push_back(
            {fmt::format("grid {} {}", i, j), through((i + 0.5) * world_.film.width / columns,
                                                      (j + 0.5) * world_.film.height / rows)});
  }

  [[nodiscard]] std::vector<NamedRay> release() {
    if (rays_.size() > max_rays)
      fault(fmt::format("{} photons are more than a drawing can show", rays_.size()),
            fmt::format("ask for at most {}", max_rays));
    faults_.raise();
    return std::move(rays_);
  }

 private:
  [[nodiscard]] Ray through(double x, double y) const {
    return world_.camera.ray(x, y, world_.film.width, world_.film.height);
  }
  void fault(std::string problem, std::string remedy) {
    faults_.add(Location{}, std::move(problem), std::move(remedy));
  }

  const World& world_;
  const AskedRays& asked_;
  std::vector<NamedRay> rays_;
  Faults faults_;
};

}  // namespace

std::vector<NamedRay> rays_of(const World& world, const AskedRays& asked, Vec3d across) {
  Collector collector(world, asked);
  collector.add_rays();
  collector.add_file();
  collector.add_pixels();
  collector.add_fan(across);
  collector.add_grid();
  return collector.release();
}

}  // namespace portalens
