/// \file
/// Hands files to a fuzz target: no fuzzer, no clang. Replays what was once found, and with one
/// file looks into a single crash. Tells which took longest.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "target.h"

namespace {

namespace fs = std::filesystem;

/// The files named, and all files in the folders named, in the order of their paths.
std::vector<fs::path> files_of(int count, char** names) {
  std::vector<fs::path> files;
  for (int i = 0; i < count; ++i) {
    if (!fs::is_directory(names[i])) {
      files.emplace_back(names[i]);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(names[i]))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  const std::vector<fs::path> files = files_of(argc - 1, argv + 1);
  Clock::duration longest{};
  std::string slowest;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    std::fprintf(stderr, "%s\n", file.c_str());  // the last one named is the one that crashed
    const auto start = Clock::now();
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    const auto took = Clock::now() - start;
    if (took <= longest) continue;
    longest = took;
    slowest = file.string();
  }
  std::printf("%zu files replayed; %.2f s for the slowest, %s\n", files.size(),
              std::chrono::duration<double>(longest).count(), slowest.c_str());
  return files.empty() ? 1 : 0;
}
