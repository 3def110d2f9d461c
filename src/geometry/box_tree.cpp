#include "geometry/box_tree.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "geometry/slab.h"

namespace portalens {
namespace {

/// What float loses over a tree, as a share of its diagonal, with an ample margin: positions,
/// directions and distances are each rounded to 6e-8.
constexpr double float_loss = 2e-6;

float round_up(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

struct BuildInput {
  const void* function;
  Box (*get_box)(const void*, std::uint32_t);
  Vec3d middle;
  double slack;
};

struct Walk {
  RTCIntersectContext base;  // first, so that Embree's pointer to it is one to the whole
  const void* visit;
  double (*call)(const void*, std::uint32_t);
  double start;
  double slack;
};

struct PointSearch {
  const void* visit;
  double (*call)(const void*, std::uint32_t);
  double slack;
};

void give_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& input = *static_cast<const BuildInput*>(arguments->geometryUserPtr);
  const Box box = input.get_box(input.function, arguments->primID).grown(input.slack);
  const Vec3d low = box.low - input.middle, high = box.high - input.middle;
  RTCBounds& out = *arguments->bounds_o;
  out.lower_x = static_cast<float>(low.x), out.upper_x = static_cast<float>(high.x);
  out.lower_y = static_cast<float>(low.y), out.upper_y = static_cast<float>(high.y);
  out.lower_z = static_cast<float>(low.z), out.upper_z = static_cast<float>(high.z);
}

void visit_along(const RTCIntersectFunctionNArguments* arguments) {
  if (!arguments->valid[0]) return;
  auto& walk = *reinterpret_cast<Walk*>(arguments->context);
  auto& ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray;
  const double high = walk.call(walk.visit, arguments->primID);
  const float far = round_up(high - walk.start + walk.slack);
  if (far < ray.tfar) ray.tfar = far;
}

bool visit_around(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<PointSearch*>(arguments->userPtr);
  const double radius = search.call(search.visit, arguments->primID);
  const float bound = radius > 0.0 ? round_up(radius + search.slack) : 0.0f;
  if (!(bound < arguments->query->radius)) return false;
  arguments->query->radius = bound;
  return true;
}

[[noreturn]] void fail(RTCError error) {
  // What its threads could not allocate, Embree reports as an unknown error.
  const std::string why = error == RTC_ERROR_OUT_OF_MEMORY || error == RTC_ERROR_UNKNOWN
                              ? "there is not enough memory for it"
                              : "Embree reports error " + std::to_string(static_cast<int>(error));
  throw WorkError("the surfaces can't be arranged for tracing: " + why);
}

}  // namespace

struct TreeBuilder::Implementation {
  RTCDevice device = nullptr;
  ~Implementation() {
    if (device) rtcReleaseDevice(device);
  }
};

struct BoxTree::Implementation {
  RTCScene scene = nullptr;
  ~Implementation() {
    if (scene) rtcReleaseScene(scene);
  }
};

TreeBuilder::TreeBuilder() : implementation_(std::make_unique<Implementation>()) {
#ifdef PORTALENS_STD_THREADS
  const char* const settings = "threads=1";
#else
  const char* const settings = nullptr;
#endif
  implementation_->device = rtcNewDevice(settings);
  if (!implementation_->device) fail(rtcGetDeviceError(nullptr));
}
TreeBuilder::~TreeBuilder() = default;
TreeBuilder::TreeBuilder(TreeBuilder&&) noexcept = default;
TreeBuilder& TreeBuilder::operator=(TreeBuilder&&) noexcept = default;

BoxTree::BoxTree(const TreeBuilder& builder, std::uint32_t count, const void* function,
                 GetBox get_box)
    : implementation_(std::make_unique<Implementation>()) {
  for (std::uint32_t i = 0; i < count; ++i) bounds_.add(get_box(function, i));
  if (bounds_.empty()) return;
  middle_ = bounds_.middle();
  slack_ = float_loss * bounds_.diagonal() + 1e-14 * length(middle_);
  BuildInput input{function, get_box, middle_, slack_};
  const RTCDevice device = builder.implementation_->device;
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, count);
  rtcSetGeometryUserData(geometry, &input);
  rtcSetGeometryBoundsFunction(geometry, give_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, visit_along);
  rtcCommitGeometry(geometry);
  const RTCScene scene = implementation_->scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  rtcSetGeometryUserData(geometry, nullptr);
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE) fail(error);
}
BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

void BoxTree::walk(const Ray& ray, double low, double high, const void* visit, Call call) const {
  if (bounds_.empty() || !is_finite(ray.origin) || !is_finite(ray.direction)) return;
  const auto [first, last] = Slab(ray).clip(bounds_.grown(slack_), low, high);
  if (!(first <= last)) return;
  const double start = first - slack_;
  const Vec3d origin = ray.at(start) - middle_;
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x);
  query.ray.org_y = static_cast<float>(origin.y);
  query.ray.org_z = static_cast<float>(origin.z);
  query.ray.dir_x = static_cast<float>(ray.direction.x);
  query.ray.dir_y = static_cast<float>(ray.direction.y);
  query.ray.dir_z = static_cast<float>(ray.direction.z);
  query.ray.tfar = round_up(last - start + slack_);
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  Walk walk{{}, visit, call, start, slack_};
  rtcInitIntersectContext(&walk.base);
  rtcIntersect1(implementation_->scene, &walk.base, &query);
}

void BoxTree::search(Vec3d x, double radius, const void* visit, Call call) const {
  if (bounds_.empty() || !is_finite(x) || !(bounds_.distance(x) <= radius)) return;
  const Vec3d from = x - middle_;
  const double slack = slack_ + float_loss * length(from);
  const double farthest = length(from) + bounds_.diagonal();
  RTCPointQuery query{};
  query.x = static_cast<float>(from.x);
  query.y = static_cast<float>(from.y);
  query.z = static_cast<float>(from.z);
  query.radius = round_up(std::min(radius, farthest) + slack);
  PointSearch search{visit, call, slack};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(implementation_->scene, &query, &context, visit_around, &search);
}

}  // namespace portalens
