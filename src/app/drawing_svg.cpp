#include "app/drawing_svg.h"

#include <fmt/format.h>

#include <map>
#include <tuple>

namespace portalens {
namespace {

std::string color(Ink ink) {
  return fmt::format("#{:02x}{:02x}{:02x}", ink.red, ink.green, ink.blue);
}

/// Printable ASCII as it is, what XML reserves escaped, all else a question mark: names in scenes
/// are any bytes.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += c >= ' ' && c <= '~' ? c : '?';
  }
  return safe;
}

/// One path an ink, made of the runs of equal cells.
void write(const InkCells& cells, std::string& svg) {
  std::map<std::tuple<int, int, int>, std::string> paths;
  for (int row = 0; row < cells.rows; ++row)
    for (int first = 0, next = 0; first < cells.columns; first = next) {
      const Ink* const inks = &cells.inks[static_cast<std::size_t>(row) * cells.columns];
      const Ink ink = inks[first];
      while (next < cells.columns && inks[next] == ink) ++next;
      paths[{ink.red, ink.green, ink.blue}] +=
          fmt::format("M{:g} {:g}h{:g}v{:g}h{:g}z", cells.corner.x + first * cells.size,
                      cells.corner.y + row * cells.size, (next - first) * cells.size, cells.size,
                      (first - next) * cells.size);
    }
  svg += "<g shape-rendering=\"crispEdges\">\n";
  for (const auto& [ink, path] : paths) {
    const auto [red, green, blue] = ink;
    svg += fmt::format("<path fill=\"#{:02x}{:02x}{:02x}\" d=\"{}\"/>\n", red, green, blue, path);
  }
  svg += "</g>\n";
}

void write(const Stroke& stroke, std::string& svg) {
  svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\" points=\"",
                     color(stroke.ink), stroke.width);
  for (const DrawingPoint& p : stroke.points) svg += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
  svg += "\"/>\n";
}

void write(const Disc& disc, std::string& svg) {
  svg += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"/>\n",
                     disc.center.x, disc.center.y, disc.radius, color(disc.ink));
}

void write(const Label& label, std::string& svg) {
  constexpr const char* anchors[] = {"start", "middle", "end"};
  svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n",
                     label.at.x, label.at.y, anchors[static_cast<int>(label.anchor)],
                     color(label.ink), escaped(label.text));
}

}  // namespace

std::string svg_of(const Drawing& drawing) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"{2:g}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      drawing.width, drawing.height, 1.4 * label_height);
  for (const Mark& mark : drawing.marks) std::visit([&](const auto& m) { write(m, svg); }, mark);
  return svg + "</svg>\n";
}

}  // namespace portalens
