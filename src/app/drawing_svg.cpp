#include "app/drawing_svg.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string_view>

#include "app/utf8.h"

namespace portalens {
namespace {

/// Hundredths of a pixel, as short as it goes.
std::string number(double value) {
  const double hundredths = std::round(value * 100.0);
  return hundredths == 0.0 ? "0" : fmt::format("{}", hundredths / 100.0);
}

std::string color_of(const Color& color) {
  const auto byte = [](double x) { return static_cast<int>(std::lround(255.0 * x)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(color.red), byte(color.green), byte(color.blue));
}

std::string opacity(std::string_view what, const Color& color) {
  return color.alpha < 1.0 ? fmt::format(" {}-opacity=\"{}\"", what, number(color.alpha)) : "";
}

std::string fill(const Color& color) {
  return " fill=\"" + color_of(color) + '"' + opacity("fill", color);
}

std::string stroke(const Stroke& stroke) {
  if (stroke.width <= 0.0) return "";
  std::string text = fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", color_of(stroke.color),
                                 number(stroke.width)) +
                     opacity("stroke", stroke.color);
  if (stroke.dash > 0.0) text += fmt::format(" stroke-dasharray=\"{0} {0}\"", number(stroke.dash));
  return text;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char32_t code : code_points(text)) {
    if (code == U'&')
      safe += "&amp;";
    else if (code == U'<')
      safe += "&lt;";
    else if (code == U'>')
      safe += "&gt;";
    else if (code < 0x20 || (code >= 0x7f && code < 0xa0) || (code & 0xfffe) == 0xfffe)
      safe += to_utf8(U'\ufffd');
    else
      safe += to_utf8(code);
  }
  return safe;
}

std::string meaning(const std::string& words) {
  return words.empty() ? "" : " class=\"" + words + '"';
}

struct Writer {
  std::string& text;

  void operator()(const Lines& lines) const {
    if (lines.pieces.empty() || lines.stroke.width <= 0.0) return;
    text += "<path" + meaning(lines.meaning) + stroke(lines.stroke) + " d=\"";
    for (const PointChain& piece : lines.pieces)
      for (std::size_t i = 0; i < piece.size(); ++i)
        text += (i == 0 ? 'M' : 'L') + number(piece[i].x) + ' ' + number(piece[i].y);
    text += "\"/>\n";
  }
  void operator()(const Area& area) const {
    if (area.corners.size() < 3) return;
    text += "<polygon" + meaning(area.meaning) + fill(area.color) + " points=\"";
    for (std::size_t i = 0; i < area.corners.size(); ++i)
      text += (i == 0 ? "" : " ") + number(area.corners[i].x) + ',' + number(area.corners[i].y);
    text += "\"/>\n";
  }
  void operator()(const Disc& disc) const {
    text += fmt::format("<circle{} cx=\"{}\" cy=\"{}\" r=\"{}\"", meaning(disc.meaning),
                        number(disc.center.x), number(disc.center.y), number(disc.radius)) +
            fill(disc.color) + stroke(disc.rim) + "/>\n";
  }
  /// One path a colour, made of the runs of equal cells.
  void operator()(const Cells& cells) const {
    std::map<std::string, std::string> paths;
    for (int row = 0; row < cells.rows; ++row)
      for (int first = 0, next = 0; first < cells.columns; first = next) {
        const Color* const colors = &cells.colors[static_cast<std::size_t>(row) * cells.columns];
        const std::string color = fill(colors[first]);
        while (next < cells.columns && colors[next] == colors[first]) ++next;
        const std::string width = number((next - first) * cells.size);
        paths[color] += 'M' + number(cells.corner.x + first * cells.size) + ' ' +
                        number(cells.corner.y + row * cells.size) + 'h' + width + 'v' +
                        number(cells.size) + "h-" + width + 'z';
      }
    text += "<g" + meaning(cells.meaning) + " shape-rendering=\"crispEdges\">\n";
    for (const auto& [color, path] : paths) text += "<path" + color + " d=\"" + path + "\"/>\n";
    text += "</g>\n";
  }
  void operator()(const Label& label) const {
    constexpr const char* anchors[] = {"start", "middle", "end"};
    text += fmt::format(
        "<text{} x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{}\"{}>{}</text>\n",
        meaning(label.meaning), number(label.at.x), number(label.at.y), number(label.size),
        anchors[static_cast<int>(label.anchor)], fill(label.color), escaped(label.text));
  }
};

}  // namespace

std::string svg_text(const Drawing& drawing) {
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" fill=\"none\" "
      "stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
      "<style>text {{ paint-order: stroke; stroke: {2}; stroke-width: 3px; }}</style>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"{2}\"/>\n",
      drawing.width, drawing.height, color_of(drawing.background));
  for (const Mark& mark : drawing.marks) std::visit(Writer{text}, mark);
  return text + "</svg>\n";
}

}  // namespace portalens
