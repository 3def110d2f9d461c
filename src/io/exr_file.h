/// \file
/// EXR through OpenEXR: the first part of a file, whole lines of floats.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "io/image.h"
#include "io/image_window.h"

namespace portalens {

/// An open file that lies in memory. Borrows the bytes.
class ExrFile {
 public:
  /// @throws std::exception with the cause; Refusal if its pixels are none of a flat picture
  explicit ExrFile(std::string_view bytes);
  ~ExrFile();
  ExrFile(const ExrFile&) = delete;
  ExrFile& operator=(const ExrFile&) = delete;

  [[nodiscard]] PixelWindow data() const;
  [[nodiscard]] PixelWindow display() const;
  /// Layer by layer; of each red, green, blue and alpha first.
  [[nodiscard]] const std::vector<std::string>& channels() const { return channels_; }

  struct Target {
    std::string channel;
    float* first;      ///< of its data window
    std::size_t step;  ///< numbers from pixel to pixel
  };
  /// Reads all pixels of these channels at once.
  void read(const std::vector<Target>& targets);

 private:
  struct Open;

  std::unique_ptr<Open> open_;
  std::vector<std::string> channels_;
};

/// Float channels, each packed by lines, with texts and perhaps a matrix (io/exr_matrix.h).
/// @throws std::exception with the cause
[[nodiscard]] std::vector<unsigned char> pack_exr(int width, int height,
                                                  const std::vector<ChannelView>& channels,
                                                  const Metadata& metadata, Packing packing);

}  // namespace portalens
