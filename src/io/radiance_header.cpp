#include "io/radiance_header.h"

#include <cmath>
#include <optional>
#include <string>

#include "core/words.h"
#include "io/image_claim.h"
#include "io/tokens.h"

namespace portalens {
namespace {

/// Takes a line off the front.
std::string_view take_line(std::string_view& left) {
  const std::size_t end = left.find('\n');
  if (end == std::string_view::npos)
    throw Refusal{"is broken: its header is cut off", "save it again"};
  const std::string_view line = left.substr(0, end);
  left.remove_prefix(end + 1);
  return line;
}

/// What follows `name` at the beginning of a line. Lines that are set in tell of other pictures,
/// from which this one was made.
std::optional<std::string_view> value_of(std::string_view name, std::string_view line) {
  if (line.substr(0, name.size()) != name) return std::nullopt;
  return line.substr(name.size());
}

double multiplier(TokenStream& words, std::string_view line) {
  const auto number = parse_number(words.next().text);
  if (!number || *number <= 0.0)
    throw Refusal{"has the header line " + in_quotes(line),
                  "EXPOSURE has one number above 0, COLORCORR has three"};
  return *number;
}

RadianceColors colors_named(std::string_view format) {
  const std::string_view name = TokenStream(format).next().text;
  if (name == "32-bit_rle_rgbe") return RadianceColors::rgb;
  if (name == "32-bit_rle_xyze") return RadianceColors::xyz;
  throw Refusal{"has the header line " + in_quotes("FORMAT=" + std::string(format)),
                "32-bit_rle_rgbe and 32-bit_rle_xyze are read"};
}

/// `-Y 480 +X 640`: the axis from line to line comes first, then the one along a line. Y points up.
void read_resolution(std::string_view line, RadianceHeader& header) {
  TokenStream words(line);
  for (const bool first : {true, false}) {
    const std::string_view axis = words.next().text;
    const auto side = parse_integer(words.next().text);
    const bool signed_axis = axis.size() == 2 && (axis[0] == '+' || axis[0] == '-');
    if (signed_axis && side && axis[1] == 'X') {
      header.width = *side;
      header.right_to_left = axis[0] == '-';
      if (first) header.by_columns = true;
    } else if (signed_axis && side && axis[1] == 'Y') {
      header.height = *side;
      header.bottom_up = axis[0] == '+';
    } else {
      throw Refusal{"is broken: its header tells no size", "write it like -Y 480 +X 640"};
    }
  }
}

}  // namespace

RadianceHeader radiance_header(std::string_view bytes) {
  RadianceHeader header;
  std::optional<RadianceColors> colors;
  std::string_view left = bytes;
  for (std::string_view line = take_line(left); !line.empty(); line = take_line(left)) {
    if (const auto format = value_of("FORMAT=", line)) {
      colors = colors_named(*format);
    } else if (const auto exposure = value_of("EXPOSURE=", line)) {
      TokenStream words(*exposure);
      const double factor = multiplier(words, line);
      for (double& multiplied : header.multiplied) multiplied *= factor;
    } else if (const auto correction = value_of("COLORCORR=", line)) {
      TokenStream words(*correction);
      for (double& multiplied : header.multiplied) multiplied *= multiplier(words, line);
    }
  }
  if (!colors)
    throw Refusal{"has no header line FORMAT", "32-bit_rle_rgbe and 32-bit_rle_xyze are read"};
  header.colors = *colors;
  for (const double multiplied : header.multiplied)
    if (!std::isnormal(multiplied))
      throw Refusal{"has exposures beyond all bounds", "give one EXPOSURE, of about 1"};
  read_resolution(take_line(left), header);
  header.size = bytes.size() - left.size();
  return header;
}

}  // namespace portalens
