#include "shading/material.h"

namespace portalens {

Material Material::from(Parameters& parameters, const ImageLoader& load) {
  Material material;
  material.diffuse = texture_from(parameters, "diffuse", material.diffuse, load);
  material.reflective = to_vec3(parameters.triple("reflective", non_negative, Triple{}));
  material.roughness = parameters.number("roughness", unit_interval, material.roughness);
  material.emitted = to_vec3(parameters.triple("emitted", non_negative, Triple{}));
  return material;
}

}  // namespace portalens
