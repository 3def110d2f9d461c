/// \file
/// What stands of a picture, as a file: the checkpoint of a render under way, or a finished part of
/// a picture for `merge`. docs/checkpoints.md tells its layout.
///
/// A partial picture carries the exact bits that were computed: of each complete pixel its floats,
/// or, where only some of its samples are taken, the double sums that others are added to; of the
/// pixel in each tile that was begun, the sums so far.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/error.h"
#include "render/exposure.h"
#include "render/partial_header.h"

namespace portalens {

/// The suffix of a picture's finished part.
inline constexpr std::string_view partial_suffix = ".part";

/// The file's bytes. While others work on the exposure, what stands at this moment.
[[nodiscard]] std::string encoded_partial(const Provenance& provenance, const Exposure& exposure);

/// A partial picture's file, its head read and proven; the pixels are read when they are asked for.
/// What a head claims is held against the file's length before memory is taken for it.
class PartialFile {
 public:
  /// @throws SceneError if there is no such file, or it is no sound partial picture
  explicit PartialFile(const std::filesystem::path& file);
  /// A file that lies in memory already.
  PartialFile(std::string name, std::string bytes);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const PartialHeader& head() const { return head_; }
  /// What stands, ready to be gone on with.
  /// @throws SceneError if the pixels are not those that were written
  [[nodiscard]] std::unique_ptr<Exposure> exposure() const;

 private:
  /// Up to so many bytes from there on.
  using Read = std::function<std::string(std::uint64_t offset, std::size_t count)>;

  PartialFile(std::string name, std::uint64_t size, Read read);

  std::string name_;
  Read read_;
  PartialHeader head_;
  std::uint64_t body_begin_ = 0;
};

}  // namespace portalens
