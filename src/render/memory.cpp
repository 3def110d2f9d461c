#include "render/memory.h"

#include <algorithm>
#include <set>
#include <variant>

namespace portalens {
namespace {

// Measured as the peak of resident memory; tests/reliability/memory_test.cpp holds them.
constexpr std::uint64_t bytes_of_program = std::uint64_t{12} << 20;
constexpr std::uint64_t bytes_a_triangle = 450;  // with the accelerator, and its building
constexpr std::uint64_t bytes_a_value = 24;      // of a channel of a pixel, while it is encoded
constexpr std::uint64_t bytes_a_thread = std::uint64_t{4} << 20;

constexpr std::uint64_t bytes_a_tile_pixel =
    350;  // of photons, and of the sampling grid between them

std::uint64_t bytes_of(const Image& image) { return image.pixels.size() * sizeof(float); }

std::uint64_t bytes_of_textures(const Appearance& look) {
  std::set<const Image*> images;
  if (look.environment.image) images.insert(look.environment.image.get());
  for (const Material& material : look.materials)
    for (const Texture* texture : material.textures())
      if (const auto* picture = std::get_if<Picture>(texture)) images.insert(picture->image.get());
  std::uint64_t sum = 0;
  for (const Image* image : images)
    if (image) sum += bytes_of(*image);
  return sum;
}

std::uint64_t bytes_of_sky_lights(const Appearance& look) {
  std::uint64_t sum = 0;
  for (const Light& light : look.lights)
    if (const auto* sky = std::get_if<SkyLight>(&light)) sum += sky->table_bytes();
  return sum;
}

std::uint64_t bytes_of_meshes(const Space& space) {
  std::uint64_t triangles = 0;
  for (const Shape& shape : space.surfaces.shapes())
    if (const auto* mesh = std::get_if<Mesh>(&shape)) triangles += mesh->triangle_count();
  return triangles * bytes_a_triangle;
}

}  // namespace

MemoryEstimate estimated_memory(const World& world, const Window& window,
                                std::size_t layer_channels, int threads, int tile_size) {
  MemoryEstimate estimate;
  estimate.program = bytes_of_program;
  estimate.scene = bytes_of_textures(world.appearance) + bytes_of_sky_lights(world.appearance) +
                   bytes_of_meshes(world.space);
  estimate.picture = window.pixels() * (3 + layer_channels) * bytes_a_value;
  const std::uint64_t side = static_cast<std::uint64_t>(tile_size);
  const std::uint64_t tile = std::min<std::uint64_t>(side * side, window.pixels());
  estimate.photons =
      static_cast<std::uint64_t>(threads) * (bytes_a_thread + tile * bytes_a_tile_pixel);
  return estimate;
}

}  // namespace portalens
