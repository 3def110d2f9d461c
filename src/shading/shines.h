/// \file
/// On which sides a surface shines.
#pragma once

namespace portalens {

/// The front of a surface is where its geometric normal leads.
enum class Shines { on_both_sides, in_front };

}  // namespace portalens
