// Shapes as a scene file describes them: sound ones are read, others are faults with a remedy.
#include <gtest/gtest.h>

#include <string>

#include "core/choice.h"
#include "geometry/shape.h"

namespace portalens::test {
namespace {

Value real(double x) { return {x, {}}; }
Value list(std::vector<Value> values) { return {Value::List(std::move(values)), {}}; }
Value point(double x, double y, double z) { return list({real(x), real(y), real(z)}); }

struct Reading {
  std::optional<Shape> shape;
  std::string faults;
};

Reading read(const std::string& kind, Value::Dictionary entries) {
  const Table table{kind, {}, std::move(entries)};
  Faults faults;
  Parameters parameters(table, faults);
  Reading reading{Choice<Shape>::make(kind, parameters), ""};
  parameters.finish();
  try {
    faults.raise();
  } catch (const SceneError& error) {
    reading.faults = error.what();
  }
  return reading;
}

TEST(ShapeKeys, SoundShapesAreReadWithoutFaults) {
  const Value origin = point(0, 0, 0), turn = point(10, 20, 30);
  const std::vector<std::pair<std::string, Value::Dictionary>> sound = {
      {"sphere", {{"center", origin}, {"radius", real(2)}}},
      {"quad", {{"vertices", list({origin, point(1, 0, 0), point(1, 1, 0), point(0, 1, 0)})}}},
      {"quad",
       {{"vertices", list({origin, point(1, 0, 0), point(1, 1, 0)})},
        {"texture_coordinates",
         list({list({real(0), real(0)}), list({real(1), real(0)}), list({real(0), real(1)})})}}},
      {"cube", {{"center", origin}, {"size", real(2)}}},
      {"cube", {{"center", origin}, {"size", point(1, 2, 3)}, {"rotation", turn}}},
      {"cone", {{"base", origin}, {"height", real(2)}, {"radius", real(1)}, {"rotation", turn}}},
      {"cylinder", {{"base", origin}, {"height", real(2)}, {"radius", real(1)}}},
      {"ring",
       {{"base", origin},
        {"height", real(2)},
        {"inner_radius", real(1)},
        {"outer_radius", real(2)}}},
      {"mesh", {{"file", Value{std::string("a.obj"), {}}}, {"scale", real(2)}}}};
  for (const auto& [kind, entries] : sound) {
    const Reading reading = read(kind, entries);
    EXPECT_EQ(reading.faults, "") << kind;
    ASSERT_TRUE(reading.shape.has_value()) << kind;
    const auto its_name = std::visit(
        [](const auto& s) {
          if constexpr (requires { s.name; }) return std::string(s.name);
          return std::string();
        },
        *reading.shape);
    EXPECT_EQ(its_name, kind);
  }
}

TEST(ShapeKeys, UnsoundQuadsAreFaults) {
  const auto quad = [](std::vector<Value> vertices) {
    return read("quad", {{"vertices", list(std::move(vertices))}}).faults;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const Value a = point(0, 0, 0), b = point(1, 0, 0), c = point(1, 1, 0), d = point(0, 1, 0);
  EXPECT_TRUE(has(quad({a, b, c, point(0, 1, 1e-5)}), "not in one plane"));
  EXPECT_EQ(quad({a, b, c, point(0, 1, 1e-7)}), "");
  EXPECT_TRUE(has(quad({a, c, b, d}), "no area") || has(quad({a, c, b, d}), "not convex"));
  EXPECT_TRUE(has(quad({a, b, point(0.2, 0.2, 0), d}), "not convex"));
  EXPECT_TRUE(has(quad({a, b, point(2, 0, 0), point(3, 0, 0)}), "no area"));
  EXPECT_TRUE(has(quad({a, a, c, d}), "no area"));
  EXPECT_TRUE(has(quad({a, b, b}), "no area"));
  EXPECT_FALSE(quad({a, b}).empty());
  EXPECT_TRUE(has(quad({point(1e300, 0, 0), b, c, d}), "beyond 1e12"));
}

TEST(ShapeKeys, TextureCoordinatesMustFitTheVertices) {
  const Value vertices = list({point(0, 0, 0), point(1, 0, 0), point(1, 1, 0)});
  const Value pair = list({real(0), real(1)});
  for (const Value& wrong :
       {list({pair, pair}), list({pair, pair, pair, pair}), list({pair, pair, real(1)}), real(2),
        list({pair, pair, list({real(1)})})})
    EXPECT_NE(read("quad", {{"vertices", vertices}, {"texture_coordinates", wrong}})
                  .faults.find("3 pairs"),
              std::string::npos);
}

TEST(ShapeKeys, LengthsThatCanNotBeAreFaults) {
  const Value origin = point(0, 0, 0);
  const auto ring = [&](double inner, double outer) {
    return read("ring", {{"base", origin},
                         {"height", real(1)},
                         {"inner_radius", real(inner)},
                         {"outer_radius", real(outer)}})
        .faults;
  };
  EXPECT_NE(ring(2, 1).find("inner_radius below outer_radius"), std::string::npos);
  EXPECT_NE(ring(1, 1), "");
  EXPECT_EQ(ring(0, 1), "");
  for (const double radius : {0.0, -1.0, 1e-300, 1e300})
    EXPECT_NE(read("sphere", {{"center", origin}, {"radius", real(radius)}}).faults, "") << radius;
  EXPECT_NE(read("cube", {{"center", point(1e9, 0, 0)}, {"size", real(1e-8)}}).faults, "");
}

}  // namespace
}  // namespace portalens::test
