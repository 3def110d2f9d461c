/// \file
/// Small scenes of one lit point, and the light that leaves it.
#pragma once

#include <vector>

#include "math/random.h"
#include "shading/shade.h"
#include "support/spaces.h"

namespace portalens::test {

inline PlannedSpace plain_space(std::vector<Shape> shapes, std::vector<Portal> portals = {},
                                std::vector<Mass> masses = {}) {
  return space_with(physics_with(1e-4), std::move(masses), std::move(shapes), std::move(portals));
}

inline Material diffuse_material(Rgb reflectance, Rgb emitted = {}) {
  return Material(DiffuseMirror(Constant{reflectance}), Constant{emitted});
}

inline Material mirror_material(Rgb reflectance, Rgb reflective, double roughness = 0.0) {
  return Material(DiffuseMirror(Constant{reflectance}, Constant{reflective}, roughness));
}

/// All bodies have material 0; no ambient light, a black sky.
inline Appearance appearance_with(std::vector<Material> materials, std::vector<Light> lights,
                                  std::size_t bodies = 1) {
  Appearance look;
  look.materials = std::move(materials);
  look.lights = std::move(lights);
  look.bodies.resize(bodies);
  look.environment.color = {};
  look.limits.ambient = {};
  return look;
}

/// A photon that has met shape 0 at `x`, flying along `direction`.
inline Arrival hit_at(Vec3d x, Vec3d direction, std::uint32_t object = 0, std::uint32_t face = 0) {
  Arrival arrival;
  arrival.fate = Fate::hit;
  arrival.met = Met::surface;
  arrival.object = object;
  arrival.face = face;
  arrival.position = x;
  arrival.direction = normalize(direction);
  return arrival;
}

inline ShadeOutput shade_one(const PlannedSpace& space, const Appearance& look,
                             const Arrival& arrival, std::uint64_t key = 1, Photon photon = {}) {
  photon.random_key = key;
  ShadeOutput output;
  shade(space, look, {&photon, 1}, {&arrival, 1}, output);
  return output;
}

/// Everything but what secondary photons would bring.
inline Rgb light_from(const PlannedSpace& space, const ShadeOutput& output) {
  Rgb sum;
  for (const Contribution& contribution : output.light) sum += contribution.radiance;
  for (const ShadowQuery& query : output.shadows)
    if (visible(space, query)) sum += query.contribution;
  return sum;
}

/// A mean over many random keys, with its standard error.
struct Estimate {
  double mean = 0.0, error = 0.0;
};

template <class Sample>
Estimate estimate(int count, const Sample& sample) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double value = sample(static_cast<std::uint64_t>(i));
    sum += value;
    squares += value * value;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::fmax(0.0, squares / count - mean * mean) / count)};
}

}  // namespace portalens::test
