/// \file
/// A scene that renders at once.
#pragma once

#include <string>

namespace portalens {

inline const std::string tiny = R"([camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
[film]
width = 8
height = 6
[sampler]
samples = 2
[environment]
color = [0.25, 0.5, 0.75]
[[sphere]]
name = "ball"
center = [0, 0, 0]
radius = 1
mass = 100
)";

}  // namespace portalens
