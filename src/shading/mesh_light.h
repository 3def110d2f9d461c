/// \file
/// A mesh of which some triangles emit, each its own colour or texture.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/mesh.h"
#include "shading/light_sample.h"
#include "shading/triangle_choice.h"

namespace portalens {

class MeshLight {
 public:
  static constexpr bool is_delta = false;
  /// @param emitted     radiance, on both sides
  /// @param emitted_by  of a triangle, the index of its radiance; none if it does not emit
  /// @pre one does
  MeshLight(Mesh mesh, std::vector<Texture> emitted,
            const std::function<std::optional<std::uint32_t>(std::uint32_t)>& emitted_by);

  [[nodiscard]] LightSample sample(Vec3d x, double u1, double u2) const;
  [[nodiscard]] double area() const { return choice_.area(); }
  /// Of what photons find of it, too.
  [[nodiscard]] double found_area() const { return choice_.area(); }
  [[nodiscard]] Rgb power() const;

 private:
  struct Face {
    std::uint32_t triangle, emitted;
  };
  Mesh mesh_;
  std::vector<Texture> emitted_;
  std::vector<Face> faces_;
  TriangleChoice choice_;
};

}  // namespace portalens
