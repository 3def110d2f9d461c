/// \file
/// The strip under a drawing that says what its marks mean.
#pragma once

#include <string>
#include <vector>

#include "app/drawing.h"
#include "app/path_marks.h"
#include "app/view.h"
#include "world/world.h"

namespace portalens {

/// Makes the drawing higher by a strip with the title, each kind of mark that it holds, a scale if
/// lengths are the same everywhere, and a few paths in words.
void add_legend(const World& world, const View& view, const std::string& title,
                const std::vector<DrawnPath>& paths, const PathStyle& style, double unit,
                Drawing& drawing);

}  // namespace portalens
