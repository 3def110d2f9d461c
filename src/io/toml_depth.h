/// \file
/// A look at how deep a TOML text nests, before it is given to a parser that recurses.
#pragma once

#include <string_view>

namespace portalens {

/// The deepest places of a text, as far as the text is well-formed.
struct TomlDepth {
  int brackets = 0;  ///< lists and inline tables inside each other
  int brackets_line = 0;
  int dots = 0;  ///< dots in one key
  int dots_line = 0;
};

/// Strings and comments are passed over as TOML 1.0 delimits them. Where the text is not
/// well-formed, a parser stops at or before the place from which this count would be wrong.
[[nodiscard]] TomlDepth toml_depth(std::string_view text);

}  // namespace portalens
