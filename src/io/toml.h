/// \file
/// The native format: TOML into a `Scene`. Only toml.cpp knows the TOML library.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace portalens {

/// Fills `scene` with the tables of `text`. What is wrong with the tables (not with their keys:
/// that is for `compile`) is added to its faults.
/// @param name  how messages call the file
/// @throws SceneError for a syntax error, which stands alone
void read_toml(std::string_view text, const std::shared_ptr<const std::string>& name, Scene& scene);

/// One value as TOML writes it; a bare word is a string. Nothing if it is neither.
[[nodiscard]] std::optional<Value> read_toml_value(const std::string& text);

}  // namespace portalens
