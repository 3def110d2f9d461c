#include "render/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "core/words.h"

namespace portalens {
namespace {

using Parts = std::vector<const PartialFile*>;

const Assignment& assigned(const PartialFile* part) { return part->head().assignment; }

Location place_of(const PartialFile& part) {
  return {std::make_shared<const std::string>(part.name()), 0};
}

/// As an option would ask for it.
std::string written(const Window& window) {
  return fmt::format("{} {} {} {}", window.x0, window.y0, window.x1, window.y1);
}

void check_finished(const PartialFile& part, Faults& faults) {
  const PartialHeader& head = part.head();
  if (head.account.pixels == head.assignment.window.pixels()) return;
  faults.add(place_of(part), "the part is not finished", "go on with it: render ... --resume");
}

/// Whether the part is one of the same picture as the first.
void check_same(const PartialFile& first, const PartialFile& part, Faults& faults) {
  const auto tell = [&](const Difference& difference) {
    faults.add(place_of(part),
               fmt::format("{} is {} here, and {} in {}", difference.name,
                           in_quotes(difference.now), in_quotes(difference.before), first.name()),
               "merge parts of the same picture");
  };
  const PartialHeader &a = first.head(), &b = part.head();
  for (const Difference& one : differences(a.provenance.fingerprint, b.provenance.fingerprint))
    tell(one);
  for (const Difference& one :
       differences(fingerprint_of(a.assignment), fingerprint_of(b.assignment)))
    if (one.name == "--layers") tell(one);
  if (a.assignment.film != b.assignment.film)
    tell({"the film", written(a.assignment.film), written(b.assignment.film)});
  if (a.assignment.samples != b.assignment.samples)
    tell({"the number of samples", fmt::format("{}", a.assignment.samples),
          fmt::format("{}", b.assignment.samples)});
}

SampleRange common_part(const SampleRange& a, const SampleRange& b) {
  const std::uint32_t begin = std::max(a.begin, b.begin);
  return {begin, std::max(begin, std::min(a.end, b.end))};
}

void check_disjoint(const Parts& parts, Faults& faults) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Assignment &a = assigned(parts[j]), &b = assigned(parts[i]);
      const Window window = common_part(a.window, b.window);
      const SampleRange range = common_part(a.range, b.range);
      if (window.empty() || range.empty()) continue;
      faults.add(place_of(*parts[i]),
                 fmt::format("it overlaps {}: both hold the pixels {}, samples {} to {}",
                             parts[j]->name(), written(window), range.begin, range.end),
                 "leave one of them out");
    }
}

/// The first pixel, row by row, of which samples are missing, and the first of these; nothing if
/// every one is there. It lies where a part ends, or at the corner of what is wanted.
struct Gap {
  int x = 0, y = 0;
  SampleRange samples;
};

std::optional<Gap> first_gap(const Parts& parts, const Window& wanted, std::uint32_t samples) {
  std::set<int> rows{wanted.y0};
  for (const PartialFile* part : parts) rows.insert(assigned(part).window.y1);
  for (const int y : rows) {
    if (y >= wanted.y1) continue;
    Parts here;
    std::set<int> columns{wanted.x0};
    for (const PartialFile* part : parts) {
      const Window& window = assigned(part).window;
      if (y < window.y0 || y >= window.y1) continue;
      here.push_back(part);
      columns.insert(window.x1);
    }
    for (const int x : columns) {
      if (x >= wanted.x1) continue;
      std::uint32_t next = 0;  // parts come by their first sample
      std::optional<std::uint32_t> upto;
      for (const PartialFile* part : here) {
        const Window& window = assigned(part).window;
        if (x < window.x0 || x >= window.x1) continue;
        if (assigned(part).range.begin > next) {
          upto = assigned(part).range.begin;
          break;
        }
        next = assigned(part).range.end;
      }
      if (upto || next < samples) return Gap{x, y, {next, upto.value_or(samples)}};
    }
  }
  return std::nullopt;
}

void check_cover(const Parts& parts, const Window& wanted, Faults& faults) {
  for (const PartialFile* part : parts)
    if (!wanted.holds(assigned(part).window))
      faults.add(place_of(*part),
                 "its pixels " + written(assigned(part).window) + " are not among those wanted, " +
                     written(wanted),
                 "leave it out, or ask for more with --crop");
  if (const auto gap = first_gap(parts, wanted, assigned(parts.front()).samples))
    faults.add({},
               fmt::format("no part holds the samples {} to {} of pixel ({}, {})",
                           gap->samples.begin, gap->samples.end, gap->x, gap->y),
               "render what is missing with --crop, --samples-from and --samples-to, and merge "
               "that, too");
}

template <class Visit>
void for_pixels(const Window& window, const Visit& visit) {
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x) visit(x, y);
}

void copy_layers(const Assignment& from, const Framebuffer& source, Framebuffer& framebuffer) {
  if (!from.takes_layers()) return;
  for_pixels(from.window, [&](int x, int y) {
    const auto values = source.layers(x, y);
    std::copy(values.begin(), values.end(), framebuffer.layers(x, y).begin());
  });
}

/// Adds up what was taken in ranges of samples, in the order of the samples.
void add_ranges(const std::vector<std::unique_ptr<Exposure>>& ranges, const Window& wanted,
                Framebuffer& framebuffer) {
  if (ranges.empty()) return;
  for (int y = wanted.y0; y < wanted.y1; ++y) {
    std::vector<const Exposure*> here;
    for (const auto& range : ranges) {
      const Window& window = range->assignment().window;
      if (window.y0 <= y && y < window.y1) here.push_back(range.get());
    }
    for (int x = wanted.x0; x < wanted.x1; ++x) {
      SampleSum sum;
      bool any = false;
      for (const Exposure* exposure : here) {
        const Window& window = exposure->assignment().window;
        if (x < window.x0 || x >= window.x1) continue;
        sum.add(exposure->assignment().range, exposure->framebuffer().sums(x, y));
        any = true;
      }
      if (any) framebuffer.set(x, y, sum);
    }
  }
}

/// @pre the parts hold every sample once, and come by their first sample
Framebuffer merged_framebuffer(const Parts& parts, const Assignment& assignment) {
  Framebuffer framebuffer(assignment);
  std::vector<std::unique_ptr<Exposure>> ranges;
  for (const PartialFile* part : parts) {
    auto exposure = part->exposure();
    const Assignment& from = exposure->assignment();
    const Framebuffer& source = std::as_const(*exposure).framebuffer();
    copy_layers(from, source, framebuffer);
    if (from.whole_pixels())
      for_pixels(from.window,
                 [&](int x, int y) { framebuffer.restore(x, y, source.mean(x, y), {}); });
    else
      ranges.push_back(std::move(exposure));
  }
  add_ranges(ranges, assignment.window, framebuffer);
  return framebuffer;
}

Account merged_account(const Parts& parts, const Assignment& assignment) {
  Account account;
  account.complete.assign(Tiling(assignment.window, assignment.tile_size).count(), true);
  account.pixels = assignment.window.pixels();
  for (const PartialFile* part : parts) {
    const Account& from = part->head().account;
    account.tally += from.tally;
    account.seconds += from.seconds;
    account.lost.insert(account.lost.end(), from.lost.begin(), from.lost.end());
  }
  keep_first(account.lost);
  return account;
}

}  // namespace

std::unique_ptr<Exposure> merged(std::span<const PartialFile> parts,
                                 const std::optional<Window>& crop) {
  Parts ordered;
  Faults faults;
  for (const PartialFile& part : parts) {
    check_finished(part, faults);
    if (&part != &parts.front()) check_same(parts.front(), part, faults);
    ordered.push_back(&part);
  }
  faults.raise();
  const auto key = [](const PartialFile* part) {
    const Assignment& a = assigned(part);
    return std::tuple(a.range.begin, a.range.end, a.window.y0, a.window.x0);
  };
  std::stable_sort(ordered.begin(), ordered.end(),
                   [&](const PartialFile* a, const PartialFile* b) { return key(a) < key(b); });

  Assignment assignment = assigned(ordered.front());
  assignment.window = crop.value_or(assignment.film);
  assignment.range = {0, assignment.samples};
  assignment.tile_size = Assignment{}.tile_size;
  check_disjoint(ordered, faults);
  check_cover(ordered, assignment.window, faults);
  faults.raise();
  return std::make_unique<Exposure>(assignment, merged_account(ordered, assignment),
                                    merged_framebuffer(ordered, assignment));
}

}  // namespace portalens
