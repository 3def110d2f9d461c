/// \file
/// What stands of a picture, as a file: the checkpoint of a render under way, or a finished part of
/// a picture for `merge`. docs/pieces.md tells its layout.
///
/// A piece carries the exact bits that were computed: of each complete pixel its floats, or, where
/// only some of its samples are taken, the double sums that others are added to; of the pixel in
/// each tile that was begun, the sums so far.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/error.h"
#include "render/exposure.h"
#include "render/piece_head.h"

namespace portalens {

/// The suffix of a picture's finished part.
inline constexpr std::string_view piece_suffix = ".part";

/// The file's bytes. While others work on the exposure, what stands at this moment.
[[nodiscard]] std::string encoded_piece(const Provenance& provenance, const Exposure& exposure);

/// A piece's file, its head read and proven; the pixels are read when they are asked for. What a
/// head claims is held against the file's length before memory is taken for it.
class PieceFile {
 public:
  /// @throws SceneError if there is no such file, or it is no sound piece
  explicit PieceFile(const std::filesystem::path& file);
  /// A file that lies in memory already.
  PieceFile(std::string name, std::string bytes);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const PieceHead& head() const { return head_; }
  /// What stands, ready to be gone on with.
  /// @throws SceneError if the pixels are not those that were written
  [[nodiscard]] std::unique_ptr<Exposure> exposure() const;

 private:
  /// Up to so many bytes from there on.
  using Read = std::function<std::string(std::uint64_t offset, std::size_t count)>;

  PieceFile(std::string name, std::uint64_t size, Read read);

  std::string name_;
  Read read_;
  PieceHead head_;
  std::uint64_t body_begin_ = 0;
};

}  // namespace portalens
