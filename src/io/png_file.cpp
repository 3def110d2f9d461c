#include "io/png_file.h"

#include <spng.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "io/image_claim.h"

namespace portalens {
namespace {

using Context = std::unique_ptr<spng_ctx, void (*)(spng_ctx*)>;

Context make_context(int flags) {
  Context context(spng_ctx_new(flags), spng_ctx_free);
  if (!context) throw std::bad_alloc();
  return context;
}

void expect(int result) {
  if (result == SPNG_EMEM) throw std::bad_alloc();
  if (result != 0)
    throw Refusal{std::string("is broken: ") + spng_strerror(result), "save it again"};
}

/// All pixels with four samples each.
template <class Number>
std::vector<Number> pixels_of(spng_ctx* context, int format) {
  std::size_t size = 0;
  expect(spng_decoded_image_size(context, format, &size));
  std::vector<Number> pixels(size / sizeof(Number));
  expect(spng_decode_image(context, pixels.data(), size, format, SPNG_DECODE_TRNS));
  return pixels;
}

template <class Number>
void take_values(const std::vector<Number>& rgba, const std::vector<std::size_t>& wanted,
                 std::vector<float>& values) {
  constexpr float share = 1.0f / static_cast<Number>(-1);
  values.reserve(rgba.size() / 4 * wanted.size());
  for (std::size_t pixel = 0; pixel < rgba.size(); pixel += 4)
    for (const std::size_t channel : wanted)
      values.push_back(static_cast<float>(rgba[pixel + channel]) * share);
}

}  // namespace

Samples decode_png(std::string_view bytes) {
  const Context context = make_context(0);
  expect(spng_set_image_limits(context.get(), max_image_side, max_image_side));
  expect(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
  spng_ihdr header{};
  expect(spng_get_ihdr(context.get(), &header));
  if (std::int64_t{header.width} * header.height > max_image_pixels)
    throw Refusal{"has a size that its header hides", "save it again"};
  spng_trns transparent{};
  const bool gray = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE ||
                    header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA;
  const bool alpha = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA ||
                     header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA ||
                     spng_get_trns(context.get(), &transparent) == 0;
  Samples samples;
  samples.width = static_cast<int>(header.width);
  samples.height = static_cast<int>(header.height);
  samples.channels = gray ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  std::vector<std::size_t> wanted =
      gray ? std::vector<std::size_t>{0} : std::vector<std::size_t>{0, 1, 2};
  if (alpha) {
    samples.channels.emplace_back("A");
    wanted.push_back(3);
  }
  if (header.bit_depth == 16)
    take_values(pixels_of<std::uint16_t>(context.get(), SPNG_FMT_RGBA16), wanted, samples.values);
  else
    take_values(pixels_of<std::uint8_t>(context.get(), SPNG_FMT_RGBA8), wanted, samples.values);
  return samples;
}

std::vector<unsigned char> pack_png(int width, int height, std::span<const unsigned char> rgb,
                                    int level) {
  const auto attempt = [](int result) {
    if (result == SPNG_EMEM) throw std::bad_alloc();
    if (result != 0) throw std::runtime_error(std::string("libspng: ") + spng_strerror(result));
  };
  const Context context = make_context(SPNG_CTX_ENCODER);
  attempt(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
  attempt(spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, level));
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.bit_depth = 8;
  header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
  attempt(spng_set_ihdr(context.get(), &header));
  attempt(spng_set_srgb(context.get(), 0));
  attempt(
      spng_encode_image(context.get(), rgb.data(), rgb.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
  std::size_t size = 0;
  int result = 0;
  const std::unique_ptr<void, void (*)(void*)> buffer(
      spng_get_png_buffer(context.get(), &size, &result), std::free);
  attempt(result);
  const auto* const begin = static_cast<const unsigned char*>(buffer.get());
  return {begin, begin + size};
}

}  // namespace portalens
