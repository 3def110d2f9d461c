#include "world/portal_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/words.h"
#include "world/face_reader.h"
#include "world/polygon_check.h"

namespace portalens {
namespace {

/// Largest error of a pair's congruence, relative to the longest edge.
constexpr double congruent = 1e-6;

constexpr std::size_t max_compared = 1000;  // names a misspelt one is held against
constexpr std::size_t max_guesses = 100;    // among so many faults nobody needs another

/// Whether what stands upright along y in front of A does so behind B, too.
bool keeps_upright(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
  constexpr Vec3d up{0, 1, 0};
  const Frame from = polygon_frame(a), to = polygon_frame(b);
  const Vec3d through =
      to.up * dot(up, from.up) - to.right * dot(up, from.right) - to.normal * dot(up, from.normal);
  return dot(through, up) > 0.99;
}

/// An order of B's vertices in which they are congruent with A's.
struct Order {
  std::size_t first = 0;  ///< of B's vertices
  bool upright = false;
};

/// The one that keeps things upright, or else the first.
std::optional<Order> congruent_order(const std::vector<Vec3d>& a, std::vector<Vec3d> b) {
  std::optional<Order> found;
  for (std::size_t first = 0; first < b.size(); ++first) {
    if (congruence_error(a, b) <= congruent && (!found || !found->upright)) {
      const bool upright = keeps_upright(a, b);
      if (!found || upright) found = Order{first, upright};
    }
    std::rotate(b.begin(), b.begin() + 1, b.end());
  }
  return found;
}

/// "3, 2, 1, 0"
std::string backwards_from(std::size_t first, std::size_t count) {
  std::string order;
  for (std::size_t i = 0; i < count; ++i)
    order += fmt::format("{}{}", i > 0 ? ", " : "", (first + count - i) % count);
  return order;
}

/// What to do about B's list; empty if no order of it would do.
std::string better_order(const std::vector<Vec3d>& a, const Portal& b) {
  std::vector<Vec3d> backwards(b.vertices.rbegin(), b.vertices.rend());
  const auto forth = congruent_order(a, b.vertices), back = congruent_order(a, backwards);
  const std::size_t count = b.vertices.size();
  std::string order;
  if (forth)
    order = fmt::format("begin the list of {} with its vertex {} (counted from 0)",
                        in_quotes(b.name), forth->first);
  if (back && (back->upright || !forth))
    order += fmt::format("{}to face the other way, list the corners of {} in the order {}",
                         order.empty() ? "" : "; or, if it is ", in_quotes(b.name),
                         backwards_from(count - 1 - back->first, count));
  return order;
}

}  // namespace

void PortalReader::read(Parameters& parameters, const std::string& name, MaterialList& materials,
                        const Physics& physics, std::vector<Mass>& masses) {
  Read read;
  read.where = parameters.where();
  read.shape = parameters.where(shape_key(parameters));
  read.by_size = shape_key(parameters) == "size";
  read.pair_where = parameters.where("pair");
  read.pair = parameters.text("pair");
  Portal& portal = read.portal;
  portal.name = name;
  portal.tint = to_vec3(parameters.triple("tint", non_negative, Triple{1, 1, 1}));
  read.back = parameters.where("back");
  if (parameters.has("back")) {
    const std::string back = parameters.text("back");
    portal.two_sided = back == "portal";
    if (back != "open" && back != "portal")
      portal.back_material = materials.named_by(parameters, "back");
  }
  if (std::optional<FaceInput> face = read_face(parameters, name)) {
    read.sound = true;
    give_face(portal, *face);
    read.face = *std::move(face);
  }
  (void)read_mass(parameters, name, MassKey::optional, portal.frame.origin, physics, masses);
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

std::string PortalReader::remedy_for(const Read& first, const Read& second) {
  const Portal &a = first.portal, &b = second.portal;
  if (first.by_size && second.by_size) return "give both the same size";
  if (a.aperture.index() != b.aperture.index())
    return "give two faces of the same kind, size and shape";
  if (is_curved(a.aperture)) return "give both the same radii, to 1e-6 of the longer diameter";
  if (first.by_size || second.by_size)
    return fmt::format("give {} a center, a facing and the size of {}, too, or both their vertices",
                       in_quotes(first.by_size ? b.name : a.name),
                       in_quotes(first.by_size ? a.name : b.name));
  if (a.vertices.size() == b.vertices.size()) {
    if (std::string order = better_order(a.vertices, b); !order.empty()) return order;
  }
  return "give two polygons of the same size and shape, mirror images of each other, to 1e-6 of "
         "the longest edge: v0, v1 of one correspond to v1, v0 of the other";
}

/// By its vertices, or what stands for them.
std::string PortalReader::face_of(const Read& read) {
  const Portal& portal = read.portal;
  const PlaneBox box = box_of(portal.aperture);
  const double width = box.high_x - box.low_x, height = box.high_y - box.low_y;
  if (read.by_size) return fmt::format("of size {:.6g} x {:.6g}", width, height);
  if (!is_curved(portal.aperture)) return written(portal.vertices);
  return fmt::format("{} of radii {:.6g} and {:.6g}", name_of(portal.aperture), 0.5 * width,
                     0.5 * height);
}

void PortalReader::check_congruent(const Read& a, const Read& b) const {
  const double error = mismatch(a.portal.aperture, b.portal.aperture);
  if (error <= congruent) return;
  const bool alike = a.portal.aperture.index() == b.portal.aperture.index();
  const std::string how =
      std::isfinite(error)
          ? fmt::format("they differ by {:.3g} of the {}", error,
                        is_curved(a.portal.aperture) ? "longer diameter" : "longest edge")
      : alike ? std::string("they have different numbers of vertices")
              : fmt::format("they are a pair of {} and {}", name_of(a.portal.aperture),
                            name_of(b.portal.aperture));
  faults_->add(
      b.shape,
      fmt::format("portals {} ({}) and {} ({}) are not congruent: {}", in_quotes(a.portal.name),
                  face_of(a), in_quotes(b.portal.name), face_of(b), how),
      remedy_for(a, b));
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
        read.portal.passage = passage_between({read.face, pair.face});
      }
    }
    portals.push_back(read.portal);
  }
  return portals;
}

}  // namespace portalens
