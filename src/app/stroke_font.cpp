#include "app/stroke_font.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/utf8.h"

namespace portalens {
namespace {

/// From ' ' to '~': strokes apart by blanks, each a chain of points, each two digits x y. Capitals
/// go from y = 0 to 7, the baseline; small letters begin at 3, and descend to 9.
constexpr std::array<std::string_view, 95> glyphs = {
    "",
    "0005 0707",
    "0002 2022",
    "1017 3037 0242 0545",
    "413010010213334446371706 2028",
    "4007 0010110100 3646473736",
    "4712112031320506172744",
    "0002",
    "10020517",
    "00121507",
    "2125 0244 0442",
    "2226 0444",
    "1608",
    "0434",
    "0707",
    "4007",
    "103041463717060110 2324",
    "022027 0747",
    "01103041420747",
    "01103041423323 334446371706",
    "37300545",
    "400003334446371706",
    "413010010617374644331304",
    "004017",
    "103041423313020110 130406173746443313",
    "433414030110304146371706",
    "0303 0707",
    "1313 1608",
    "310437",
    "0333 0535",
    "013407",
    "01103041422425 2727",
    "4717060110304145252343",
    "072047 1434",
    "003041423303 334446370700",
    "4130100106173746",
    "00204245270700",
    "40000747 0333",
    "400007 0333",
    "41301001061737464424",
    "0007 4047 0343",
    "0020 1017 0727",
    "3036271706",
    "0007 4004 1347",
    "000747",
    "0700244047",
    "07004740",
    "103041463717060110",
    "07003041433404",
    "103041463717060110 2548",
    "07003041433404 2447",
    "413010010213334446371706",
    "0040 2027",
    "000617374640",
    "002740",
    "0017325760",
    "0047 4007",
    "002340 2327",
    "00400747",
    "10000717",
    "0047",
    "00101707",
    "022042",
    "0848",
    "0011",
    "13334447 451506173746",
    "0007 0413334446371706",
    "4433130406173746",
    "4047 4433130406173746",
    "05454433130406173746",
    "30201117 0323",
    "4348391908 4433130406173746",
    "0007 0413334447",
    "0307 0101",
    "131809 1111",
    "0007 3305 1437",
    "000617",
    "0307 0413233437 3443536467",
    "0307 0413334447",
    "133344463717060413",
    "0309 0413334446371706",
    "4349 4433130406173746",
    "0307 041333",
    "44331304153546371706",
    "11162737 0333",
    "0306173746 4347",
    "032743",
    "0317345763",
    "0347 4307",
    "0327 4319",
    "03430747",
    "20111203141627",
    "0008",
    "00111223141607",
    "05143544",
};
constexpr std::string_view unknown = "0040470700";

constexpr double gap = 2.0;         ///< between letters
constexpr double blank = 2.0;       ///< width of ' '
constexpr double unit_share = 0.1;  ///< a unit of the grid, of the font's size

std::string_view glyph(char32_t code) {
  return code >= U' ' && code <= U'~' ? glyphs[code - U' '] : unknown;
}

double glyph_width(std::string_view strokes) {
  if (strokes.empty()) return blank;
  double width = 0.0;
  for (std::size_t i = 0; i + 1 < strokes.size(); i += 2) {
    if (strokes[i] == ' ') ++i;
    width = std::max(width, static_cast<double>(strokes[i] - '0'));
  }
  return width;
}

}  // namespace

double text_width(const std::string& text, double size) {
  double units = 0.0;
  for (const char32_t code : code_points(text)) units += glyph_width(glyph(code)) + gap;
  return std::max(0.0, units - gap) * unit_share * size;
}

double letter_weight(double size) { return 0.1 * size; }

std::vector<PointChain> letter_lines(const Label& label) {
  const double unit = unit_share * label.size;
  const double width = text_width(label.text, label.size);
  double left = label.at.x - (label.anchor == Anchor::start    ? 0.0
                              : label.anchor == Anchor::middle ? 0.5 * width
                                                               : width);
  std::vector<PointChain> lines;
  for (const char32_t code : code_points(label.text)) {
    const std::string_view strokes = glyph(code);
    if (!strokes.empty()) lines.emplace_back();
    for (std::size_t i = 0; i + 1 < strokes.size(); i += 2) {
      if (strokes[i] == ' ') lines.emplace_back(), ++i;
      lines.back().push_back(
          {left + unit * (strokes[i] - '0'), label.at.y + unit * (strokes[i + 1] - '0' - 7)});
    }
    left += unit * (glyph_width(strokes) + gap);
  }
  return lines;
}

}  // namespace portalens
