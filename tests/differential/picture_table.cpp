#include "differential/picture_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace portalens::differential {
namespace {

constexpr double max_errors = 5e-5;  // share of the pixels

struct Sums {
  std::uint64_t pictures = 0, interpolating = 0;
  PictureComparison of;
};

std::uint64_t errors_in(const PictureComparison& c) { return c.other_way + c.over10; }

Sums sums_of(const std::vector<PictureEntry>& entries) {
  Sums sums;
  for (const PictureEntry& entry : entries) {
    const PictureComparison& c = entry.comparison;
    ++sums.pictures;
    sums.interpolating += c.interpolates;
    sums.of.pixels += c.pixels;
    sums.of.interpolated += c.interpolated;
    sums.of.other_way += c.other_way;
    sums.of.over10 += c.over10;
    sums.of.misplaced += c.misplaced;
    sums.of.strangers += c.strangers;
  }
  return sums;
}

double percent(std::uint64_t count, std::uint64_t of) {
  return of == 0 ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(of);
}

}  // namespace

std::string picture_table(const std::vector<PictureEntry>& entries, std::size_t worst) {
  const Sums sums = sums_of(entries);
  const PictureComparison& all = sums.of;
  std::string text =
      fmt::format("== --photons fewer against all\n{:<45}{:>24}{:>14}\n", "", "pixels", "at most");
  const auto row = [&](const char* name, std::uint64_t count, const std::string& most) {
    text += fmt::format("{:<45}{:>24}{:>14}\n", name,
                        fmt::format("{:.5f} % ({})", percent(count, all.pixels), count), most);
  };
  row("off by over 10 tolerances, or another way", errors_in(all),
      fmt::format("{:.4f} %", 100.0 * max_errors));
  row("of these, another way", all.other_way, "");
  row("hits over 10 tolerances of the way misplaced", all.misplaced, "");
  row("showing what nothing around them shows", all.strangers, "none");
  text += fmt::format("pictures: {}; {} interpolate, {:.1f} % of their {} pixels\n", sums.pictures,
                      sums.interpolating, percent(all.interpolated, all.pixels), all.pixels);
  std::vector<const PictureEntry*> order;
  for (const PictureEntry& entry : entries)
    if (errors_in(entry.comparison) > 0) order.push_back(&entry);
  std::stable_sort(order.begin(), order.end(), [](const PictureEntry* a, const PictureEntry* b) {
    const PictureComparison &x = a->comparison, &y = b->comparison;
    return std::pair(x.strangers, errors_in(x)) > std::pair(y.strangers, errors_in(y));
  });
  for (std::size_t i = 0; i < std::min(worst, order.size()); ++i) {
    const PictureComparison& c = order[i]->comparison;
    text += fmt::format(
        "--only {:<6} {:<14} pixel {} {}: {} strangers, {} on another way, {} off\n",
        order[i]->index, order[i]->kind, c.worst_x, c.worst_y, c.strangers, c.other_way, c.over10);
  }
  return text;
}

bool pictures_hold(const std::vector<PictureEntry>& entries) {
  const PictureComparison all = sums_of(entries).of;
  return all.strangers == 0 &&
         static_cast<double>(errors_in(all)) <= max_errors * static_cast<double>(all.pixels);
}

}  // namespace portalens::differential
