// Gravity through a portal that acts over a hundred lengths: the drift of such paths can't be told,
// and yet lanes follow them themselves.
#include <gtest/gtest.h>

#include <vector>

#include "lanes/engine.h"
#include "render/camera_photon.h"
#include "support/scene_text.h"

namespace portalens::test {
namespace {

/// The first of README.md, and a door that shows a mass close behind its pair.
const std::vector<std::string> scenes = {
    "camera = { position = [0, 1.4, 7], look_at = [0, 1.2, 0] }\n"
    "mass = [{ name = \"hole\", center = [0, 1.4, 0], mass = 250 }]\n"
    "portal = [{ name = \"in\", pair = \"out\", vertices = ["
    "[-3, 0.1, -1], [-1.5, 0.1, -1], [-1.5, 2.4, -1], [-3, 2.4, -1]] },"
    "{ name = \"out\", pair = \"in\", vertices = ["
    "[1.6, 0.1, -2], [2.8, 0.1, -1.1], [2.8, 2.4, -1.1], [1.6, 2.4, -2]] }]\n",
    "camera = { position = [0, 2, 12], look_at = [0, 1.5, 0] }\n"
    "mass = [{ name = \"hole\", center = [0, 1.5, 0], mass = 200 }]\n"
    "portal = [{ name = \"blue\", pair = \"orange\", center = [0, 1.5, 2], facing = [0, 0, 1],"
    " size = [2, 3] }, { name = \"orange\", pair = \"blue\", center = [6, 1.5, -2],"
    " facing = [-1, 0, 0], size = [2, 3] }]\n"};

std::vector<Photon> photons_of(const World& world) {
  std::vector<Photon> photons;
  for (int y = 0; y < world.film.height; ++y)
    for (int x = 0; x < world.film.width; ++x) photons.push_back(central_photon(world, x, y));
  return photons;
}

TEST(LongPull, IsFollowedInLanesAndToTheTolerance) {
  for (const std::string& scene : scenes) {
    const std::string film = scene + "film = { width = 32, height = 18 }\n";
    const World world = compiled(film);
    const World exact = compiled(film + "physics = { tolerance = 1e-8 }\n");
    const std::vector<Photon> photons = photons_of(world);
    std::vector<Arrival> found(photons.size()), right(photons.size());
    advance(world.space, photons, found, Engine::automatic);
    advance(exact.space, photons, right, Engine::scalar);
    std::uint64_t steps = 0, handed_over = 0;
    int off = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
      steps += found[i].steps;
      handed_over += found[i].handed_over;
      const bool same = found[i].fate == right[i].fate && found[i].crossings == right[i].crossings;
      off += same && length(found[i].direction - right[i].direction) < 1e-4 ? 0 : 1;
    }
    EXPECT_LT(static_cast<double>(handed_over), 0.02 * static_cast<double>(steps)) << scene;
    EXPECT_LE(off, 1) << scene;
  }
}

}  // namespace
}  // namespace portalens::test
