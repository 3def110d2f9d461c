#include "portal/aperture.h"

#include <limits>
#include <type_traits>

namespace portalens {
namespace {

template <class Variant>
struct List;

template <class... Types>
struct List<std::variant<Types...>> {
  static std::optional<Aperture> make(const FaceInput& input) {
    std::optional<Aperture> made;
    const auto takes = [&](auto aperture) {
      const bool fits = aperture.has_value();
      if (fits) made.emplace(*std::move(aperture));
      return fits;
    };
    (void)(takes(Types::from(input)) || ...);
    return made;
  }
};

}  // namespace

std::optional<Aperture> aperture_from(const FaceInput& input) {
  return List<Aperture>::make(input);
}

std::string_view name_of(const Aperture& aperture) {
  return std::visit([](const auto& a) { return a.name; }, aperture);
}

bool is_curved(const Aperture& aperture) {
  return std::visit([](const auto& a) { return a.curved; }, aperture);
}

std::vector<Vec3d> outline_of(const Aperture& aperture) {
  return std::visit([](const auto& a) { return std::vector<Vec3d>(a.outline()); }, aperture);
}

PlaneBox box_of(const Aperture& aperture) {
  return std::visit([](const auto& a) { return a.box(); }, aperture);
}

double size_of(const Aperture& aperture) {
  return std::visit([](const auto& a) { return a.size(); }, aperture);
}

double area_of(const Aperture& aperture) {
  return std::visit([](const auto& a) { return a.area(); }, aperture);
}

double mismatch(const Aperture& aperture, const Aperture& pair) {
  return std::visit(
      [](const auto& a, const auto& b) {
        if constexpr (std::is_same_v<decltype(a), decltype(b)>)
          return a.mismatch(b);
        else
          return std::numeric_limits<double>::infinity();
      },
      aperture, pair);
}

}  // namespace portalens
