/// \file
/// What lanes can't do, and leave to the scalar engine. Each function tells why, as `LaneChoice`
/// does: what the scene has, and what lanes would take; nothing where they can.
#pragma once

#include <string>

#include "lanes/plan.h"

namespace portalens {

[[nodiscard]] std::string physics_refusal(const Space& space);

/// Of sizes, distances and portals.
/// @pre the plan knows its centre and its stepped masses
[[nodiscard]] std::string place_refusal(const Space& space, const LanePlan& plan);

/// Of what acts at once.
/// @pre the plan has its masses and its coupling
[[nodiscard]] std::string field_refusal(const Space& space, const LaneScene& scene);

/// Whether something acts through portals.
[[nodiscard]] bool looks_through(const LaneScene& scene);

/// How far from `center` anything lies that a photon can meet or feel.
[[nodiscard]] double radius_about(const Space& space, Vec3d center);

}  // namespace portalens
