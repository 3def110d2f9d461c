/// \file
/// A drawing in the making: places of the scene go in, marks come out, labels avoid each other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/drawing.h"
#include "app/view.h"

namespace portalens {

namespace ink {
inline constexpr Color black{0.08, 0.08, 0.10};
inline constexpr Color green{0.05, 0.62, 0.20};  ///< the paper's figure 6: steps in turn green
inline constexpr Color grey{0.52, 0.52, 0.55};   ///< and grey
inline constexpr Color surface{0.66, 0.68, 0.72};
inline constexpr Color influence{0.55, 0.45, 0.75};
}  // namespace ink

class Sheet {
 public:
  /// The drawing is as large as the view.
  explicit Sheet(const View& view);

  [[nodiscard]] const View& view() const { return view_; }
  /// Pixels of what would be one in a picture of 960 x 540: everything grows with the picture.
  [[nodiscard]] double unit() const { return unit_; }
  [[nodiscard]] double font() const { return 13.0 * unit_; }

  void add(Mark mark) { drawing_.marks.push_back(std::move(mark)); }
  /// Lines of the scene; `stroke` is in units.
  void add_lines(const std::vector<std::vector<Vec3d>>& lines, Stroke stroke,
                 const std::string& meaning);
  void add_area(std::span<const Vec3d> corners, const Color& color, const std::string& meaning);
  /// An arrow from one place to another.
  void add_arrow(Vec3d from, Vec3d to, const Color& color, const std::string& meaning);

  /// Words beside a point, where they hide least. They are drawn last, over all marks.
  /// @param distance  from the point to the words, units
  /// @param anchor    `middle`: on the point itself, if nothing else is there
  void add_label(Point beside, double distance, const std::string& text, const Color& color,
                 const std::string& meaning, double size_share = 1.0,
                 Anchor anchor = Anchor::start);
  /// Tells that labels should rather not lie here.
  void keep_free(Point point);

  /// The finished drawing.
  [[nodiscard]] Drawing release() &&;

 private:
  struct Rectangle {
    double left, top, right, bottom;
    [[nodiscard]] bool holds(Point p) const {
      return p.x >= left && p.x <= right && p.y >= top && p.y <= bottom;
    }
  };
  struct Wish {
    Point beside;
    double distance;
    Label label;
  };
  [[nodiscard]] double cost(const Rectangle& place) const;
  void place(const Wish& wish);

  View view_;
  double unit_;
  Drawing drawing_;
  std::vector<Wish> wishes_;
  std::vector<Rectangle> taken_;
  std::vector<Point> busy_;
};

/// The head of an arrow whose tip is at `tip`.
/// @param way  of any length; if it is 0 there is no head, but a dot
[[nodiscard]] Mark arrow_head(Point tip, Point way, double size, const Color& color,
                              const std::string& meaning);

}  // namespace portalens
