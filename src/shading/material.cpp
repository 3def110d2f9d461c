#include "shading/material.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "core/choice.h"

namespace portalens {

namespace {

/// What the keys of a table tell of its type.
std::string usual_type(Parameters& parameters) {
  for (const char* key : {"base_color", "metallic", "ior"})
    if (parameters.has(key)) {
      for (const char* other : {"diffuse", "reflective"})
        if (parameters.has(other))
          parameters.fault(other, std::string(other) + " and " + key + " are of different surfaces",
                           "give one of the two");
      return std::string(MetallicRoughness::name);
    }
  return std::string(DiffuseMirror::name);
}

}  // namespace

Material Material::from(Parameters& parameters, const ImageLoader& load) {
  const std::vector<std::string_view> types = Choice<Bsdf>::names();
  const std::string type =
      parameters.has("type") ? parameters.choice("type", types) : usual_type(parameters);
  auto bsdf = Choice<Bsdf>::make(type, parameters, load);
  return Material(bsdf ? std::move(*bsdf) : Bsdf{},
                  scaled(texture_from(parameters, "emitted", Constant{{}}, load),
                         parameters.number("emission_strength", non_negative, 1.0)));
}

Material::Material(Bsdf bsdf, Texture emitted, Shines shines)
    : bsdf_(std::move(bsdf)),
      emitted_(std::move(emitted)),
      shines_(shines),
      emits_(max_component(brightest(emitted_)) > 0.0) {
  const auto all = textures();
  uses_coordinates_ = std::any_of(all.begin(), all.end(), [](const Texture* texture) {
    return portalens::uses_coordinates(*texture);
  });
}

bool Material::answers_lamps() const {
  return std::visit([](const auto& bsdf) { return bsdf.answers(); }, bsdf_);
}

std::vector<const Texture*> Material::textures() const {
  auto all = std::visit([](const auto& bsdf) { return bsdf.textures(); }, bsdf_);
  all.push_back(&emitted_);
  return all;
}

}  // namespace portalens
