// The hierarchy of boxes of builds without Embree (PORTALENS_PORTABLE): split in halves by the
// median along the longest side, walked in double. Items are decided in double by whoever asks, so
// answers are the same; they take longer: the boxes of a tree of halves overlap more than Embree's.
#include <algorithm>
#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/slab.h"

namespace portalens {
namespace {

/// What double loses over a tree, as a share of its diagonal, with an ample margin.
constexpr double double_loss = 1e-12;
constexpr std::uint32_t max_in_leaf = 4;
/// 2^32 items in halves are 32 levels deep, and a walk keeps one node a level.
constexpr std::size_t max_levels = 40;

struct Node {
  Box box;
  std::uint32_t begin = 0, end = 0;  ///< of the items below it
  std::uint32_t right = 0;           ///< its second child; the first stands behind it; 0: a leaf
};

/// The nodes that a walk has yet to look at, each with a number to judge it by.
class Waiting {
 public:
  void put(std::uint32_t node, double number) { nodes_[count_++] = {node, number}; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  std::pair<std::uint32_t, double> take() { return nodes_[--count_]; }

 private:
  std::array<std::pair<std::uint32_t, double>, max_levels> nodes_;
  std::size_t count_ = 0;
};

}  // namespace

struct TreeBuilder::Implementation {};

struct BoxTree::Implementation {
  std::vector<Node> nodes;
  std::vector<std::uint32_t> items;

  /// Adds the node of those items, and all below it.
  /// @param boxes  of all items; empty ones are not among them
  std::uint32_t add(const std::vector<Box>& boxes, std::uint32_t begin, std::uint32_t end) {
    const auto number = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    Box box, middles;
    for (std::uint32_t i = begin; i < end; ++i) {
      box.add(boxes[items[i]]);
      middles.add(boxes[items[i]].middle());
    }
    std::uint32_t right = 0;
    if (end - begin > max_in_leaf) {
      const Vec3d size = middles.high - middles.low;
      const auto along = [&](std::uint32_t item) {
        const Vec3d m = boxes[item].middle();
        return size.x >= size.y && size.x >= size.z ? m.x : size.y >= size.z ? m.y : m.z;
      };
      const std::uint32_t half = begin + (end - begin) / 2;
      std::nth_element(items.begin() + begin, items.begin() + half, items.begin() + end,
                       [&](std::uint32_t a, std::uint32_t b) {
                         return std::pair(along(a), a) < std::pair(along(b), b);
                       });
      add(boxes, begin, half);
      right = add(boxes, half, end);
    }
    nodes[number] = {box, begin, end, right};
    return number;
  }
};

TreeBuilder::TreeBuilder() = default;
TreeBuilder::~TreeBuilder() = default;
TreeBuilder::TreeBuilder(TreeBuilder&&) noexcept = default;
TreeBuilder& TreeBuilder::operator=(TreeBuilder&&) noexcept = default;

BoxTree::BoxTree(const TreeBuilder& /*builder*/, std::uint32_t count, const void* function,
                 GetBox get_box)
    : implementation_(std::make_unique<Implementation>()) {
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < count; ++i) boxes.push_back(get_box(function, i));
  for (const Box& box : boxes) bounds_.add(box);
  if (bounds_.empty()) return;
  middle_ = bounds_.middle();
  slack_ = double_loss * (bounds_.diagonal() + length(middle_));
  for (Box& box : boxes) box = box.grown(slack_);
  implementation_->items.resize(count);
  std::iota(implementation_->items.begin(), implementation_->items.end(), 0u);
  implementation_->add(boxes, 0, count);
}
BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

void BoxTree::walk(const Ray& ray, double low, double high, const void* visit, Call call) const {
  if (bounds_.empty() || !is_finite(ray.origin) || !is_finite(ray.direction)) return;
  const std::vector<Node>& nodes = implementation_->nodes;
  const Slab slab(ray);
  const double margin = double_loss * length(ray.origin - middle_);
  const auto entry = [&](std::uint32_t node) {
    return slab.clip(nodes[node].box.grown(margin), low, high);
  };
  Waiting waiting;
  if (const auto [first, last] = entry(0); first <= last) waiting.put(0, first);
  while (!waiting.empty()) {
    const auto [number, begins] = waiting.take();
    if (begins > high || high < low) continue;
    const Node& node = nodes[number];
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        high = std::min(high, call(visit, implementation_->items[i]));
      continue;
    }
    std::pair near{number + 1, entry(number + 1)}, far{node.right, entry(node.right)};
    if (far.second.first < near.second.first) std::swap(near, far);
    for (const auto& [child, part] : {far, near})  // the last put is the next taken
      if (part.first <= part.second) waiting.put(child, part.first);
  }
}

void BoxTree::search(Vec3d x, double radius, const void* visit, Call call) const {
  if (bounds_.empty() || !is_finite(x) || !(bounds_.distance(x) <= radius)) return;
  const std::vector<Node>& nodes = implementation_->nodes;
  const double slack = slack_ + double_loss * length(x - middle_);
  Waiting waiting;
  waiting.put(0, nodes[0].box.distance(x) - slack);
  while (!waiting.empty()) {
    const auto [number, distance] = waiting.take();
    if (distance > radius || !(radius > 0.0)) continue;
    const Node& node = nodes[number];
    if (node.right == 0) {
      for (std::uint32_t i = node.begin; i < node.end; ++i)
        radius = std::min(radius, call(visit, implementation_->items[i]));
      continue;
    }
    std::pair near{number + 1, nodes[number + 1].box.distance(x) - slack};
    std::pair far{node.right, nodes[node.right].box.distance(x) - slack};
    if (far.second < near.second) std::swap(near, far);
    waiting.put(far.first, far.second);
    waiting.put(near.first, near.second);
  }
}

}  // namespace portalens
