#include "shading/diffuse_mirror.h"

#include <utility>

namespace portalens {

DiffuseMirror DiffuseMirror::from(Parameters& parameters, const ImageLoader& load) {
  Texture diffuse = texture_from(parameters, "diffuse", Constant{}, load);
  Texture reflective = texture_from(parameters, "reflective", Constant{{}}, load);
  return DiffuseMirror(std::move(diffuse), std::move(reflective),
                       parameters.number("roughness", unit_interval, 0.0));
}

DiffuseMirror::DiffuseMirror(Texture diffuse, Texture reflective, double roughness)
    : diffuse_(std::move(diffuse)),
      reflective_(std::move(reflective)),
      roughness_(roughness),
      diffuses_(!is_black(brightest(diffuse_))),
      mirrors_(!is_black(brightest(reflective_))) {}

}  // namespace portalens
