#include "portal/rigid_passage.h"

namespace portalens {

Rigid motion_through(const Frame& a, const Frame& b) {
  const auto row = [&](double br, double bu, double bn) {
    return a.right * -br + a.up * bu + a.normal * -bn;
  };
  return {row(b.right.x, b.up.x, b.normal.x), row(b.right.y, b.up.y, b.normal.y),
          row(b.right.z, b.up.z, b.normal.z), a.origin, b.origin};
}

}  // namespace portalens
