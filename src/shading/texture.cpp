#include "shading/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/words.h"
#include "math/srgb.h"

namespace portalens {
namespace {

/// The remainder of the floored division, in [0, period).
double wrapped(double x, double period) {
  const double rest = x - std::floor(x / period) * period;
  return rest >= 0.0 && rest < period ? rest : 0.0;
}

Rgb highest(Rgb a, Rgb b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

Rgb mixed_colors(Rgb a, Rgb b, double share) { return a * (1.0 - share) + b * share; }

/// The two whole neighbours of a continuous coordinate, and the share of the second.
struct Neighbours {
  int first = 0, second = 0;
  double share = 0.0;
};

Neighbours repeated(double x, int count) {
  const double low = std::floor(x - 0.5);
  const int first = static_cast<int>(wrapped(low, count));
  return {first, (first + 1) % count, (x - 0.5) - low};
}

Neighbours clamped(double x, int count) {
  // What is no number counts as 0: it is looked at no place that is none.
  const double place = x > 0.5 ? std::min(x - 0.5, count - 1.0) : 0.0;
  const int first = static_cast<int>(place);
  return {first, std::min(first + 1, count - 1), place - first};
}

Checker checker_from(Parameters& outer, std::string_view key, const Value::Dictionary& entries) {
  const Table table{outer.kind() + "'s " + std::string(key), outer.where(key), entries};
  Parameters parameters(table, outer.faults());
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

Rgb bilinear(const Image& image, double x, double y, Rows rows) {
  const Neighbours column = repeated(x, image.width);
  const Neighbours row =
      rows == Rows::repeat ? repeated(y, image.height) : clamped(y, image.height);
  const Rgb top = mixed_colors(pixel(image, column.first, row.first),
                               pixel(image, column.second, row.first), column.share);
  const Rgb bottom = mixed_colors(pixel(image, column.first, row.second),
                                  pixel(image, column.second, row.second), column.share);
  return mixed_colors(top, bottom, row.share);
}

Rgb Picture::at(double u, double v) const {
  const double x = wrapped(u, 1.0) * image->width;
  const double y = (1.0 - wrapped(v, 1.0)) * image->height;
  return bilinear(*image, x, y, Rows::repeat) * scale;
}

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
      if (p.width != q.width || p.height != q.height) return brightest(a) + brightest(b);
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
    return checker_from(parameters, key, *entries);
  }
  if (std::holds_alternative<Value::List>(value->data)) {
    return Constant{to_vec3(parameters.triple(key, non_negative))};
  }
  parameters.fault(key, std::string(key) + " is neither a colour nor a texture",
                   "give [r, g, b], an image's file name, or "
                   "{ checker = [[r, g, b], [r, g, b]], size = 1.0 }");
  return fallback;
}

}  // namespace portalens
