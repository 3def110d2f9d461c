#include "geometry/flush.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/flush_face.h"
#include "geometry/flush_pairs.h"

namespace portalens {

/// Joins faces into planes, and says which of them cover each other.
class FlushBuilder {
 public:
  FlushBuilder(FlushPairs found, std::size_t object_count)
      : faces_(std::move(found.faces)),
        pairs_(std::move(found.pairs)),
        object_count_(object_count) {}

  void write(FlushFaces& out);

 private:
  void group();
  [[nodiscard]] std::uint32_t root(std::uint32_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  std::vector<FlushFace> faces_;
  std::vector<FlushPairs::Pair> pairs_;
  std::size_t object_count_;
  std::vector<std::uint32_t> parent_;  ///< of faces of one plane; the root is the largest
};

/// Joins the planes of faces that touch, as long as the largest of all of them still agree.
void FlushBuilder::group() {
  parent_.resize(faces_.size());
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (const auto& [i, j] : pairs_) {
    std::uint32_t large = root(i), small = root(j);
    if (large == small) continue;
    const auto size = [&](std::uint32_t k) { return faces_[k].box.diagonal(); };
    if (size(large) < size(small) || (size(large) == size(small) && small < large))
      std::swap(large, small);
    if (in_one_plane(faces_[small], faces_[large])) parent_[small] = large;
  }
}

void FlushBuilder::write(FlushFaces& out) {
  group();
  std::vector<std::vector<std::uint32_t>> over(faces_.size());
  std::vector<bool> told(faces_.size());
  for (std::uint32_t i = 0; i < faces_.size(); ++i) told[i] = faces_[i].opening;
  for (const auto& [i, j] : pairs_) {
    told[i] = told[j] = true;
    if (root(i) != root(j) || !share_area(faces_[i], faces_[j])) continue;
    const bool both = faces_[i].opening && faces_[j].opening;
    if (both || comes_before(faces_[i], faces_[j])) over[j].push_back(i);
    if (both || !comes_before(faces_[i], faces_[j])) over[i].push_back(j);
  }

  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < faces_.size(); ++i)
    if (told[i]) order.push_back(i);
  std::sort(order.begin(), order.end(),
            [this](std::uint32_t i, std::uint32_t j) { return faces_[i].id < faces_[j].id; });
  std::vector<std::uint32_t> plane_of(faces_.size(), LeftPlane::none);
  out.object_count_ = static_cast<std::uint32_t>(object_count_);
  out.first_.assign(object_count_ + 1, 0);
  for (const std::uint32_t i : order) {
    const std::uint32_t base = root(i);
    if (plane_of[base] == LeftPlane::none) {
      plane_of[base] = out.plane_count();
      const Vec3d normal = faces_[base].normal;
      out.planes_.push_back({normal, dot(normal, faces_[base].hull.front()), 0.0});
    }
    FlushFaces::Plane& plane = out.planes_[plane_of[base]];
    plane.thickness = std::max(plane.thickness, tolerance_of(faces_[i], faces_[base]));
    FlushFaces::Place place{faces_[i].id, plane_of[base], 1.0, 0, 0};
    place.side = dot(faces_[i].normal, plane.normal) < 0.0 ? -1.0 : 1.0;
    place.first_over = static_cast<std::uint32_t>(out.over_.size());
    std::sort(over[i].begin(), over[i].end(), [this](std::uint32_t a, std::uint32_t b) {
      return comes_before(faces_[a], faces_[b]);
    });
    for (const std::uint32_t k : over[i]) out.over_.push_back(faces_[k].id);
    place.end_over = static_cast<std::uint32_t>(out.over_.size());
    out.places_.push_back(place);
    ++out.first_[faces_[i].id.object + 1];
    out.any_shapes_ = out.any_shapes_ || !faces_[i].opening;
  }
  std::partial_sum(out.first_.begin(), out.first_.end(), out.first_.begin());
}

FlushFaces::FlushFaces(const std::vector<Shape>& shapes, std::span<const MeshTriangles> meshes,
                       std::span<const Opening> openings) {
  FlushBuilder(find_flush_pairs(shapes, meshes, openings), shapes.size() + openings.size())
      .write(*this);
}

const FlushFaces::Place* FlushFaces::find_among(std::uint32_t begin, std::uint32_t end,
                                                std::uint32_t face) const {
  const auto last = places_.begin() + end;
  const auto at =
      std::lower_bound(places_.begin() + begin, last, face,
                       [](const Place& place, std::uint32_t f) { return place.face.face < f; });
  return at != last && at->face.face == face ? &*at : nullptr;
}

std::vector<FlushFaces::Overlap> FlushFaces::overlaps(std::size_t most) const {
  std::vector<Overlap> pairs;
  for (const Place& place : places_)
    for (const FaceId& seen : over(place)) {
      if (pairs.size() == most) break;
      const auto* other = find(seen.object, seen.face);
      const auto back = over(*other);
      const bool both = std::find(back.begin(), back.end(), place.face) != back.end();
      const Plane& plane = planes_[place.plane];
      if (!both || seen < place.face)
        pairs.push_back({seen.object, place.face.object, plane.normal * other->side,
                         plane.height * other->side});
    }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Overlap& a, const Overlap& b) {
    return std::pair(a.seen, a.hidden) < std::pair(b.seen, b.hidden);
  });
  return pairs;
}

LeftPlane FlushFaces::left_by(const SelfIntersectionGuard& guard) const {
  const Place* place = find(guard.shape, guard.face);
  if (!place) return {};
  return {place->plane, guard.side * place->side, guard.reach};
}

}  // namespace portalens
