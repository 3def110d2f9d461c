#include "world/portal_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/words.h"
#include "world/polygon_check.h"

namespace portalens {
namespace {

/// Largest error of a pair's congruence, relative to the longest edge.
constexpr double congruent = 1e-6;

constexpr std::size_t max_vertices = 64;
constexpr std::size_t max_compared = 1000;  // names a misspelt one is held against
constexpr std::size_t max_guesses = 100;    // among so many faults nobody needs another

std::vector<Vec3d> as_vectors(const std::vector<Triple>& points) {
  std::vector<Vec3d> vectors;
  for (const Triple& point : points) vectors.push_back(to_vec3(point));
  return vectors;
}

Vec3d mean(const std::vector<Vec3d>& points) {
  Vec3d sum;
  for (const Vec3d& point : points) sum += point - points[0];
  return points.empty() ? Vec3d{} : points[0] + sum / static_cast<double>(points.size());
}

/// At which of its vertices B's list should begin so that it is congruent with A's; 0 if nowhere.
std::size_t better_start(const std::vector<Vec3d>& a, std::vector<Vec3d> b) {
  for (std::size_t start = 1; start < b.size(); ++start) {
    std::rotate(b.begin(), b.begin() + 1, b.end());
    if (congruence_error(a, b) <= congruent) return start;
  }
  return 0;
}

std::string remedy_for(const std::string& name, const std::vector<Vec3d>& a,
                       const std::vector<Vec3d>& b) {
  if (a.size() == b.size()) {
    if (const std::size_t start = better_start(a, b))
      return fmt::format("begin the list of {} with its vertex {}", in_quotes(name), start);
  }
  return "give two polygons of the same size and shape, mirror images of each other, to 1e-6 of "
         "the "
         "longest edge: v0, v1 of one correspond to v1, v0 of the other";
}

}  // namespace

void PortalReader::read(Parameters& parameters, const std::string& name, MaterialList& materials,
                        const Physics& physics, std::vector<Mass>& masses) {
  Read read;
  read.where = parameters.where();
  read.vertices = parameters.where("vertices");
  read.pair_where = parameters.where("pair");
  read.pair = parameters.text("pair");
  Portal& portal = read.portal;
  portal.name = name;
  portal.vertices = as_vectors(parameters.points("vertices", 3, max_vertices));
  portal.tint = to_vec3(parameters.triple("tint", non_negative, Triple{1, 1, 1}));
  read.back = parameters.where("back");
  if (parameters.has("back")) {
    const std::string back = parameters.text("back");
    portal.two_sided = back == "portal";
    if (back != "open" && back != "portal")
      portal.back_material = materials.named_by(parameters, "back");
  }
  if (!portal.vertices.empty()) {
    if (const auto fault = polygon_fault(portal.vertices)) {
      parameters.fault("vertices", in_quotes(name) + ": " + fault->problem, fault->remedy);
    } else {
      read.sound = true;
      give_face(portal, polygon_input(portal.vertices));
    }
  }
  (void)read_mass(parameters, name, MassKey::optional, mean(portal.vertices), physics, masses);
  by_name_.emplace(name, static_cast<std::uint32_t>(portals_.size()));
  portals_.push_back(std::move(read));
}

std::optional<std::uint32_t> PortalReader::partner(std::uint32_t index) const {
  const Read& read = portals_[index];
  const auto refuse = [&](std::string problem, std::string remedy) {
    faults_->add(read.pair_where, std::move(problem), std::move(remedy));
    return std::nullopt;
  };
  if (read.pair.empty()) return std::nullopt;  // already told
  const auto found = by_name_.find(read.pair);
  if (found == by_name_.end()) {
    const bool guess = faults_->size() < max_guesses;
    std::vector<std::string> known;
    for (std::uint32_t i = 0; guess && i < portals_.size() && known.size() < max_compared; ++i)
      if (i != index) known.push_back(portals_[i].portal.name);
    return refuse(
        "no portal has the name " + in_quotes(read.pair),
        known.empty() ? "add the second portal of the pair" : suggestion_or_list(read.pair, known));
  }
  const Read& other = portals_[found->second];
  if (found->second == index)
    return refuse("portal " + in_quotes(read.pair) + " is its own pair", "name another portal");
  if (other.pair != read.portal.name)
    return refuse("portal " + in_quotes(read.portal.name) + " names " + in_quotes(read.pair) +
                      " as its pair, but " + in_quotes(read.pair) + " names " +
                      in_quotes(other.pair),
                  "let the two portals of a pair name each other");
  return found->second;
}

void PortalReader::check_backs(const Read& a, const Read& b) const {
  if (a.portal.two_sided == b.portal.two_sided) return;
  const Read &has = a.portal.two_sided ? a : b, &lacks = a.portal.two_sided ? b : a;
  faults_->add(has.back,
               fmt::format("portal {} has the back 'portal', and its pair {} has not",
                           in_quotes(has.portal.name), in_quotes(lacks.portal.name)),
               "give back = \"portal\" to both, or to neither");
}

void PortalReader::check_congruent(const Read& a, const Read& b) const {
  const double error = congruence_error(a.portal.vertices, b.portal.vertices);
  if (error <= congruent) return;
  const std::string how = std::isfinite(error)
                              ? fmt::format("they differ by {:.3g} of the longest edge", error)
                              : std::string("they have different numbers of vertices");
  faults_->add(b.vertices,
               fmt::format("portals {} ({}) and {} ({}) are not congruent: {}",
                           in_quotes(a.portal.name), written(a.portal.vertices),
                           in_quotes(b.portal.name), written(b.portal.vertices), how),
               remedy_for(b.portal.name, a.portal.vertices, b.portal.vertices));
}

std::vector<Portal> PortalReader::join() {
  std::vector<Portal> portals;
  for (std::uint32_t i = 0; i < portals_.size(); ++i) {
    Read& read = portals_[i];
    if (const auto other = partner(i)) {
      const Read& pair = portals_[*other];
      read.portal.pair = *other;
      if (i < *other) check_backs(read, pair);
      if (read.sound && pair.sound) {
        if (i < *other) check_congruent(read, pair);
        read.portal.through = motion_through(read.portal.frame, pair.portal.frame);
      }
    }
    portals.push_back(read.portal);
  }
  return portals;
}

}  // namespace portalens
