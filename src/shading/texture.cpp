#include "shading/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/words.h"
#include "geometry/extent.h"
#include "geometry/two_lengths.h"
#include "math/srgb.h"

namespace portalens {
namespace {

Rgb highest(Rgb a, Rgb b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

Checker checker_from(const Table& table, Faults& faults) {
  Parameters parameters(table, faults);
  const std::vector<Triple> colors = parameters.points("checker", 2, 2);
  Checker checker;
  checker.size = parameters.number("size", positive, 1.0);
  if (colors.size() == 2) {
    checker.first = to_vec3(colors[0]);
    checker.second = to_vec3(colors[1]);
    const double lowest = std::min(
        {colors[0][0], colors[0][1], colors[0][2], colors[1][0], colors[1][1], colors[1][2]});
    if (lowest < 0.0)
      parameters.fault("checker", "a colour is negative", "give numbers of at least 0");
  }
  parameters.finish();
  return checker;
}

}  // namespace

Texture scaled(Texture texture, double by) {
  struct Scale {
    double by;
    void operator()(Constant& t) const { t.color = t.color * by; }
    void operator()(Checker& t) const { t.first = t.first * by, t.second = t.second * by; }
    void operator()(Picture& t) const { t.scale *= by; }
  };
  std::visit(Scale{by}, texture);
  return texture;
}

Rgb brightest(const Texture& texture) {
  struct Brightest {
    Rgb operator()(const Constant& t) const { return t.color; }
    Rgb operator()(const Checker& t) const { return highest(t.first, t.second); }
    Rgb operator()(const Picture& t) const {
      Rgb most;
      for (int y = 0; y < t.image->height; ++y) {
        for (int x = 0; x < t.image->width; ++x) most = highest(most, pixel(*t.image, x, y));
      }
      return most * t.scale;
    }
  };
  return std::visit(Brightest{}, texture);
}

Rgb brightest_sum(const Texture& one, const Texture& other) {
  struct BrightestSum {
    Rgb operator()(const Checker& a, const Checker& b) const {
      if (a.size != b.size) return brightest(a) + brightest(b);
      return highest(a.first + b.first, a.second + b.second);
    }
    /// Between the centres of pixels both are bilinear, and so is their sum.
    Rgb operator()(const Picture& a, const Picture& b) const {
      const Image &p = *a.image, &q = *b.image;
      if (p.width != q.width || p.height != q.height || a.placement != b.placement)
        return brightest(a) + brightest(b);
      Rgb most;
      for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
          most = highest(most, pixel(p, x, y) * a.scale + pixel(q, x, y) * b.scale);
      return most;
    }
    Rgb operator()(const Texture& a, const Texture& b) const { return brightest(a) + brightest(b); }
  };
  return std::visit(BrightestSum{}, one, other);
}

namespace {

std::optional<std::array<double, 2>> two_numbers(Parameters& parameters, std::string_view key) {
  const Value* value = parameters.raw(key);
  if (!value) return std::array{0.0, 0.0};
  std::array<double, 2> pair{};
  const auto* list = std::get_if<Value::List>(&value->data);
  bool sound = list && list->size() == 2;
  for (std::size_t i = 0; sound && i < 2; ++i) {
    const Value& one = (*list)[i];
    if (const auto* integer = std::get_if<std::int64_t>(&one.data))
      pair[i] = static_cast<double>(*integer);
    else if (const auto* number = std::get_if<double>(&one.data))
      pair[i] = *number;
    else
      sound = false;
    sound = sound && std::fabs(pair[i]) <= largest_coordinate;
  }
  if (sound) return pair;
  parameters.fault(key, std::string(key) + " is " + describe(*value) + " that gives no two numbers",
                   "give [right, up]");
  return std::nullopt;
}

/// @return nothing after a fault
std::optional<Picture> picture_from(const Table& table, Faults& faults, const ImageLoader& load) {
  constexpr std::array<std::string_view, 3> wraps{"repeat", "clamp",
                                                  "mirror"};  // in `Wrap`'s order
  Parameters parameters(table, faults);
  const std::size_t before = faults.size();
  Picture picture{load(parameters.text("image"), parameters.where("image"))};
  Placement placement;
  const Value* size = parameters.raw("size");
  if (size) {
    placement.size = two_lengths(parameters, "size", OneNumber::stands_for_both,
                                 "give the width of the picture, or [width, height]");
    const bool one = !std::holds_alternative<Value::List>(size->data);
    if (one && placement.size && picture.image)
      (*placement.size)[1] *= double{1} * picture.image->height / picture.image->width;
  }
  placement.offset = two_numbers(parameters, "offset").value_or(placement.offset);
  const double turned = std::remainder(parameters.number("rotation", any_number, 0.0), 360.0) *
                        std::numbers::pi / 180;
  placement.cosine = std::cos(turned);
  placement.sine = std::sin(turned);
  const std::string wrap = parameters.choice("wrap", wraps, std::string(wraps[0]));
  placement.wrap = static_cast<Wrap>(std::find(wraps.begin(), wraps.end(), wrap) - wraps.begin());
  parameters.finish();
  if (!picture.image || faults.size() > before) return std::nullopt;
  picture.placement = placement;
  return picture;
}

/// A colour as the web writes it, `#ff8000`, is no file: tells it as numbers.
/// @return whether it is one
bool refuse_hexadecimal(Parameters& parameters, std::string_view key, const std::string& text) {
  constexpr std::string_view digits = "0123456789abcdefABCDEF";
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of(digits, 1) != std::string::npos)
    return false;
  std::string numbers;
  for (std::size_t i = 1; i < 7; i += 2) {
    const int byte = std::stoi(text.substr(i, 2), nullptr, 16);
    numbers += fmt::format("{}{:.3g}", i > 1 ? ", " : "",
                           linear_from_srgb(static_cast<float>(byte) / 255.0f));
  }
  parameters.fault(key, fmt::format("{} is in sRGB, and colours are linear here", in_quotes(text)),
                   fmt::format("give the list [{}]", numbers));
  return true;
}

}  // namespace

Texture texture_from(Parameters& parameters, std::string_view key, const Texture& fallback,
                     const ImageLoader& load) {
  const Value* value = parameters.raw(key);
  if (!value) return fallback;
  if (std::holds_alternative<std::string>(value->data)) {
    if (refuse_hexadecimal(parameters, key, std::get<std::string>(value->data))) return fallback;
    std::shared_ptr<const Image> image = load(parameters.text(key), value->where);
    if (!image) return fallback;
    return Picture{std::move(image)};
  }
  if (const auto* entries = std::get_if<Value::Dictionary>(&value->data)) {
    const Table table{parameters.kind() + "'s " + std::string(key), value->where, *entries};
    if (!table.find("image")) return checker_from(table, parameters.faults());
    const auto picture = picture_from(table, parameters.faults(), load);
    return picture ? Texture(*picture) : fallback;
  }
  if (std::holds_alternative<Value::List>(value->data)) {
    return Constant{to_vec3(parameters.triple(key, non_negative))};
  }
  parameters.fault(key, std::string(key) + " is neither a colour nor a texture",
                   "give [r, g, b], an image's file name, "
                   "{ image = \"file\", size = 1.0 } or "
                   "{ checker = [[r, g, b], [r, g, b]], size = 1.0 }");
  return fallback;
}

}  // namespace portalens
