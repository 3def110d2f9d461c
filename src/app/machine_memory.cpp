#include "app/machine_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"

namespace portalens {
namespace {

/// What a control group allows; nothing is said where there is no limit ("max").
std::uint64_t group_limit(const char* file, std::uint64_t otherwise) {
  std::uint64_t bytes = 0;
  std::ifstream stream(file);
  return stream >> bytes ? bytes : otherwise;
}

}  // namespace

std::uint64_t machine_memory() {
  std::uint64_t bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  for (const char* file :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
    bytes = std::min(bytes, group_limit(file, bytes));
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = std::min<std::uint64_t>(bytes, limit.rlim_cur);
  return bytes;
}

std::string memory_text(std::uint64_t bytes) {
  const double mega = static_cast<double>(bytes) / (1 << 20);
  return mega < 1000.0 ? fmt::format("{:.0f} MiB", mega) : fmt::format("{:.1f} GiB", mega / 1024.0);
}

void check_memory(const MemoryEstimate& estimate) {
  const std::uint64_t there = machine_memory();
  if (estimate.total() <= there) return;
  refuse(fmt::format("this needs about {} of memory ({} for the picture, {} for the "
                     "scene), and there are {}",
                     memory_text(estimate.total()), memory_text(estimate.picture),
                     memory_text(estimate.scene), memory_text(there)),
         "give a smaller film, fewer layers, or take the picture in parts (--crop)");
}

}  // namespace portalens
