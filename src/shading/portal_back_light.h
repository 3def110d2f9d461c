/// \file
/// The back of a portal that emits; its front leads elsewhere.
#pragma once

#include <vector>

#include "portal/portal.h"
#include "shading/light_sample.h"
#include "shading/triangle_choice.h"

namespace portalens {

class PortalBackLight {
 public:
  static constexpr bool is_delta = false;
  /// @param emitted  radiance
  PortalBackLight(Portal portal, Texture emitted);

  [[nodiscard]] LightSample sample(Vec3d x, double u1, double u2) const;
  [[nodiscard]] double area() const { return choice_.area(); }
  [[nodiscard]] Rgb power() const;

 private:
  void add(const TriangleCorners& triangle);

  Portal portal_;
  Texture emitted_;
  TriangleChoice choice_;  ///< of a curved face, so that the triangles have its area
};

}  // namespace portalens
