#include "shading/reflection.h"

#include "shading/ggx.h"

namespace portalens {

std::optional<Reflection> reflect(Vec3d incoming, Vec3d normal, double roughness, double u1,
                                  double u2) {
  const double alpha = roughness * roughness;
  if (alpha == 0.0) return Reflection{ggx::mirrored(incoming, normal), 1.0};
  const Frame frame = ggx::frame_about(normal);
  const Vec3d out = frame.direction_to_local(-incoming);
  if (!(out.z > 0.0)) return std::nullopt;
  const Vec3d in = ggx::mirrored(-out, ggx::visible_normal(out, alpha, u1, u2));
  if (!(in.z > 0.0)) return std::nullopt;
  const double lambda = ggx::smith_lambda(out, alpha);
  const double weight = (1.0 + lambda) / (1.0 + lambda + ggx::smith_lambda(in, alpha));
  return Reflection{normalize(frame.direction_to_world(in)), weight};
}

}  // namespace portalens
