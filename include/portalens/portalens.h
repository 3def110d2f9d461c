/// \file
/// All of the library. docs/library.md begins with a program.
#pragma once

#include "portalens/error.h"    // IWYU pragma: export
#include "portalens/field.h"    // IWYU pragma: export
#include "portalens/picture.h"  // IWYU pragma: export
#include "portalens/render.h"   // IWYU pragma: export
#include "portalens/scene.h"    // IWYU pragma: export
#include "portalens/trace.h"    // IWYU pragma: export
#include "portalens/types.h"    // IWYU pragma: export
#include "portalens/version.h"  // IWYU pragma: export
#include "portalens/world.h"    // IWYU pragma: export
