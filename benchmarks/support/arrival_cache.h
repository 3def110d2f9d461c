/// \file
/// Arrivals that take long to compute, kept in files from one run to the next.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "photon/photon.h"

namespace portalens::benchmarks {

/// A folder of files, each named by the digest of what decides its arrivals. A file that is
/// damaged, or was made for something else, counts as none.
class ArrivalCache {
 public:
  explicit ArrivalCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The arrivals of `photons`: kept ones, or those that `compute` gives, which then are kept.
  /// Where they can't be kept, it says so on the standard error, and that is all.
  /// @param recipe  everything beside the photons that decides the arrivals, in words
  [[nodiscard]] std::vector<Arrival> arrivals(
      const std::string& recipe, std::span<const Photon> photons,
      const std::function<void(std::span<const Photon>, std::span<Arrival>)>& compute) const;

  /// Where those arrivals are kept.
  [[nodiscard]] std::filesystem::path file(const std::string& recipe,
                                           std::span<const Photon> photons) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace portalens::benchmarks
