#include "world/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "geometry/extent.h"

namespace portalens {
namespace {

constexpr std::array<std::string_view, 2> projections = {"perspective", "orthographic"};
constexpr std::array<std::string_view, 4> axes = {"x", "y", "smaller", "larger"};

/// Sines of angles below this are taken for 0: the camera has no steady `right`.
constexpr double parallel = 1e-9;

/// How much of the view a scene without a camera leaves free round its bounding box.
constexpr double spare = 1.05;

template <std::size_t count>
std::size_t place(const std::array<std::string_view, count>& words, const std::string& word) {
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
}

Triple as_triple(Vec3d v) { return {v.x, v.y, v.z}; }

/// Where a camera that has no place of its own stands: on +z of the box, so that the sphere around
/// the box fits in the view.
struct Standpoint {
  Vec3d position, look_at;
  double size = 1.0;

  Standpoint(const Box& box, double fov) {
    const double radius = box.diagonal() > 0.0 ? 0.5 * box.diagonal() : 1.0;
    look_at = box.empty() ? Vec3d{} : box.middle();
    position = look_at + Vec3d{0, 0, spare * radius / std::sin(fov * std::numbers::pi / 360.0)};
    size = 2.0 * spare * radius;
  }
};

void orient(Camera& camera, Vec3d look_at, Vec3d up, Parameters& parameters) {
  const Vec3d way = look_at - camera.position;
  const double distance = length(way), up_length = length(up);
  if (!(distance > 0.0) || !std::isfinite(distance)) {
    parameters.fault("look_at", "the camera looks at its own position", "move one of the two");
    return;
  }
  if (!(up_length > 0.0) || !std::isfinite(up_length)) {
    parameters.fault("up", "'up' has no direction", "give for instance [0, 1, 0]");
    return;
  }
  camera.forward = way / distance;
  const Vec3d across = cross(camera.forward, up / up_length);
  if (!(length(across) > parallel)) {
    parameters.fault(
        "up", "'up' is parallel to the direction of view",
        "give a direction to the side of it, for instance " +
            std::string(std::fabs(camera.forward.y) > 0.9 ? "[0, 0, -1]" : "[0, 1, 0]"));
    return;
  }
  camera.right = normalize(across);
  camera.up = cross(camera.right, camera.forward);
}

bool spans_width(FovAxis axis, int width, int height) {
  switch (axis) {
    case FovAxis::x:
      return true;
    case FovAxis::y:
      return false;
    case FovAxis::smaller:
      return width < height;
    case FovAxis::larger:
      return width > height;
  }
  return false;
}

}  // namespace

Camera Camera::from(Parameters& parameters, const std::optional<Box>& whole) {
  Camera camera;
  camera.projection = Projection(
      place(projections, parameters.choice("type", projections, std::string(projections.front()))));
  const bool perspective = camera.projection == Projection::perspective;
  if (perspective) {
    camera.fov = parameters.number("fov", {1e-6, 179.9}, camera.fov);
    camera.fov_axis =
        FovAxis(place(axes, parameters.choice("fov_axis", axes, whole ? "smaller" : "y")));
  }
  std::optional<Triple> position, look_at;
  std::optional<double> size;
  if (whole) {
    const Standpoint standpoint(*whole, camera.fov);
    position = as_triple(standpoint.position);
    look_at = as_triple(standpoint.look_at);
    size = standpoint.size;
  }
  const std::size_t before = parameters.faults().size();
  camera.position = to_vec3(parameters.triple("position", coordinate, position));
  const Vec3d target = to_vec3(parameters.triple("look_at", coordinate, look_at));
  const Vec3d up = to_vec3(parameters.triple("up", coordinate, Triple{0, 1, 0}));
  if (parameters.faults().size() == before) orient(camera, target, up, parameters);
  if (!perspective) camera.size = parameters.number("size", positive, size);
  return camera;
}

Ray Camera::ray(double film_x, double film_y, int width, int height) const {
  return FilmCamera(*this, width, height).ray(film_x, film_y);
}

FilmCamera::FilmCamera(const Camera& camera, int width, int height)
    : camera_(camera),
      width_(width),
      height_(height),
      aspect_(static_cast<double>(width) / height),
      half_height_(0.5 * camera.size) {
  if (camera.projection == Projection::orthographic) return;
  const double half = std::tan(camera.fov * std::numbers::pi / 360.0);
  half_height_ = spans_width(camera.fov_axis, width, height) ? half / aspect_ : half;
}

Ray FilmCamera::ray(double film_x, double film_y) const {
  const double across = 2.0 * film_x / width_ - 1.0, above = 1.0 - 2.0 * film_y / height_;
  const Vec3d aside = camera_.right * (across * half_height_ * aspect_);
  const Vec3d upwards = camera_.up * (above * half_height_);
  if (camera_.projection == Projection::orthographic)
    return {camera_.position + aside + upwards, camera_.forward};
  return {camera_.position, normalize(camera_.forward + aside + upwards)};
}

void FilmCamera::rays(std::span<const FilmPlace> places, std::span<Ray> rays) const {
  if (camera_.projection == Projection::orthographic) {
    std::transform(places.begin(), places.end(), rays.begin(),
                   [this](const FilmPlace& place) { return ray(place.x, place.y); });
    return;
  }
  // Component by component, for the compiler to take several at once; each as `ray` does.
  std::array<double, max_rays> x, y, z;
  const Vec3d right = camera_.right, up = camera_.up, forward = camera_.forward;
  const double width = width_, height = height_, half = half_height_, aspect = aspect_;
  const std::size_t count = places.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double across = 2.0 * places[i].x / width - 1.0, above = 1.0 - 2.0 * places[i].y / height;
    const double aside = across * half * aspect, upwards = above * half;
    const double dx = forward.x + right.x * aside + up.x * upwards;
    const double dy = forward.y + right.y * aside + up.y * upwards;
    const double dz = forward.z + right.z * aside + up.z * upwards;
    const double inverse = 1.0 / std::sqrt(dx * dx + dy * dy + dz * dz);
    x[i] = dx * inverse, y[i] = dy * inverse, z[i] = dz * inverse;
  }
  for (std::size_t i = 0; i < count; ++i) rays[i] = {camera_.position, {x[i], y[i], z[i]}};
}

}  // namespace portalens
