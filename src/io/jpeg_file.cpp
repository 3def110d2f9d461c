#include "io/jpeg_file.h"

#include <turbojpeg.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "io/image_claim.h"

namespace portalens {
namespace {

using Handle = std::unique_ptr<std::remove_pointer_t<tjhandle>, int (*)(tjhandle)>;

[[noreturn]] void refuse(tjhandle handle) {
  const std::string_view told = tjGetErrorStr2(handle);
  if (told.find("subsampling type") != std::string_view::npos)
    throw Refusal{"has a subsampling of colours that is not read", "save it with 4:4:4 or 4:2:0"};
  throw Refusal{std::string("is broken: ") + tjGetErrorStr2(handle), "save it again"};
}

/// The library calls whatever follows a warning a warning, too: only bytes too many, as some
/// cameras write them, are harmless.
void expect(tjhandle handle, int result) {
  if (result == 0) return;
  const std::string_view told = tjGetErrorStr2(handle);
  if (told.find("extraneous bytes before marker") == std::string_view::npos) refuse(handle);
}

}  // namespace

Samples decode_jpeg(std::string_view bytes) {
  // Behind bytes too many the library does not tell of an end that comes too early.
  if (bytes.find("\xff\xd9") == std::string_view::npos)
    throw Refusal{"is broken: it is cut off", "save it again"};
  const Handle handle(tjInitDecompress(), tjDestroy);
  if (!handle) throw std::bad_alloc();
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  Samples samples;
  int subsampling = 0, colors = 0;
  expect(handle.get(), tjDecompressHeader3(handle.get(), data, bytes.size(), &samples.width,
                                           &samples.height, &subsampling, &colors));
  if (samples.width > max_image_side || samples.height > max_image_side ||
      std::int64_t{samples.width} * samples.height > max_image_pixels)
    throw Refusal{"has a size that its header hides", "save it again"};
  const bool gray = colors == TJCS_GRAY, inks = colors == TJCS_CMYK || colors == TJCS_YCCK;
  const int format = gray ? TJPF_GRAY : inks ? TJPF_CMYK : TJPF_RGB;
  const std::size_t pixels =
      static_cast<std::size_t>(samples.width) * static_cast<std::size_t>(samples.height);
  const auto channels = static_cast<std::size_t>(tjPixelSize[format]);
  std::vector<unsigned char> decoded(pixels * channels);
  expect(handle.get(),
         tjDecompress2(handle.get(), data, bytes.size(), decoded.data(), samples.width, 0,
                       samples.height, format, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS));
  constexpr float share = 1.0f / 255.0f;
  samples.channels = gray ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  samples.values.reserve(pixels * samples.channels.size());
  for (std::size_t i = 0; i < decoded.size(); i += channels)
    for (std::size_t c = 0; c < samples.channels.size(); ++c) {
      const float value = static_cast<float>(decoded[i + c]) * share;
      // JPEG holds how much of white each ink leaves.
      samples.values.push_back(inks ? value * (static_cast<float>(decoded[i + 3]) * share) : value);
    }
  return samples;
}

std::vector<unsigned char> pack_jpeg(int width, int height, std::span<const unsigned char> rgb) {
  const Handle handle(tjInitCompress(), tjDestroy);
  if (!handle) throw std::bad_alloc();
  unsigned char* packed = nullptr;
  unsigned long size = 0;
  constexpr int quality = 95;
  const int result = tjCompress2(handle.get(), rgb.data(), width, 0, height, TJPF_RGB, &packed,
                                 &size, TJSAMP_420, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> buffer(packed, tjFree);
  if (result != 0)
    throw std::runtime_error(std::string("libjpeg-turbo: ") + tjGetErrorStr2(handle.get()));
  return {packed, packed + size};
}

}  // namespace portalens
