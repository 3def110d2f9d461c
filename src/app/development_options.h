/// \file
/// How pictures to look at are developed, as the command line and a picture's header have it.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <functional>
#include <string>

#include "io/development.h"
#include "io/image.h"

namespace portalens {

/// `--exposure`, `--tone` and `--white-balance` of a picture that is there.
/// @param development  gets them; must outlive the command
/// @return the options, in that order
std::array<CLI::Option*, 3> add_development_options(CLI::App& command, Development& development);

/// The same of a picture that is to be rendered, where they stand for values of `[film]`.
/// @param set  gets key and value
void add_development_overrides(CLI::App& command,
                               const std::function<void(const char*, const std::string&)>& set);

/// What the header of a picture, or of a part, keeps of it.
[[nodiscard]] Metadata development_metadata(const Development& development);
/// What a header says of it; nobody vouches for that.
[[nodiscard]] Development development_in(const Metadata& header);
/// The header without that.
[[nodiscard]] Metadata without_development(Metadata header);

}  // namespace portalens
