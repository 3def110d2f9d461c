#include "app/read_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <optional>
#include <string_view>

#include "geometry/rays.h"

namespace portalens {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr const char* remedy = "six numbers are needed: x y z dx dy dz, the direction not zero";
constexpr std::size_t max_reported = 100;

/// The line's numbers; nothing if it holds anything else, or not six.
std::optional<std::array<double, 6>> six_numbers(std::string_view line) {
  std::array<double, 6> numbers{};
  for (double& number : numbers) {
    const std::size_t begin = line.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return std::nullopt;
    line.remove_prefix(begin);
    if (line[0] == '+') line.remove_prefix(1);
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc{}) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    if (!line.empty() && blanks.find(line[0]) == std::string_view::npos) return std::nullopt;
  }
  if (line.find_first_not_of(blanks) != std::string_view::npos) return std::nullopt;
  return numbers;
}

std::string shown(const std::string& line) {
  constexpr std::size_t most = 60;
  std::string text = line.size() <= most ? line : line.substr(0, most) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text;
}

}  // namespace

std::vector<Ray> read_rays(std::istream& input, const std::string& name) {
  const auto file = std::make_shared<const std::string>(name);
  std::vector<Ray> rays;
  Faults faults;
  std::string line;
  for (int number = 1; faults.size() < max_reported && std::getline(input, line); ++number) {
    const std::size_t begin = line.find_first_not_of(blanks);
    if (begin == std::string::npos || line[begin] == '#') continue;
    const auto numbers = six_numbers(line);
    const auto ray = numbers ? ray_of(*numbers) : std::nullopt;
    if (ray)
      rays.push_back(*ray);
    else
      faults.add({file, number}, "'" + shown(line) + "' is no ray", remedy);
  }
  if (input.bad())
    faults.add({file, 0}, "reading failed", "a file of lines 'x y z dx dy dz' is needed");
  if (rays.empty() && faults.empty()) faults.add({file, 0}, "there is no ray in it", remedy);
  faults.raise();
  return rays;
}

std::vector<Ray> rays_in(const std::vector<double>& numbers, Faults& faults) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i + 5 < numbers.size(); i += 6) {
    std::array<double, 6> six{};
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(i), 6, six.begin());
    if (const auto ray = ray_of(six))
      rays.push_back(*ray);
    else
      faults.add({}, "--ray has a zero direction, or a number that is not finite",
                 "x y z dx dy dz are needed, the direction not zero");
  }
  if (numbers.size() % 6 != 0)
    faults.add({}, fmt::format("--ray has {} values, not 6", numbers.size() % 6),
               "write --ray X Y Z DX DY DZ");
  return rays;
}

}  // namespace portalens
