#include "core/words.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace portalens {
namespace {

constexpr std::size_t longest_quote = 60;
constexpr std::size_t longest_list = 60;
constexpr std::size_t longest_guess = 40;  // a longer word is no slip of ours

using Alias = std::pair<std::string_view, std::string_view>;

// What other renderers, other spellings and other formats say, and what it is called here. Several
// rows for one word are tried in order; a row counts only where its right side is known.
constexpr std::array aliases{
    Alias{"maxdepth", "max_bounces"},
    Alias{"depth", "max_bounces"},
    Alias{"bounces", "max_bounces"},
    Alias{"crossings", "max_crossings"},
    Alias{"spp", "samples"},
    Alias{"samplesperpixel", "samples"},
    Alias{"pixelsamples", "samples"},
    Alias{"samplecount", "samples"},
    Alias{"resolution", "width"},
    Alias{"xresolution", "width"},
    Alias{"yresolution", "height"},
    Alias{"imagewidth", "width"},
    Alias{"imageheight", "height"},
    Alias{"length", "height"},
    Alias{"origin", "position"},
    Alias{"origin", "center"},
    Alias{"origin", "base"},
    Alias{"eye", "position"},
    Alias{"from", "position"},
    Alias{"lookfrom", "position"},
    Alias{"location", "position"},
    Alias{"position", "center"},
    Alias{"position", "base"},
    Alias{"position", "translate"},
    Alias{"center", "base"},
    Alias{"center", "position"},
    Alias{"centre", "center"},
    Alias{"centre", "base"},
    Alias{"centre", "position"},
    Alias{"centreofmass", "center_of_mass"},
    Alias{"target", "look_at"},
    Alias{"lookto", "look_at"},
    Alias{"direction", "look_at"},
    Alias{"pointofinterest", "look_at"},
    Alias{"vup", "up"},
    Alias{"vfov", "fov"},
    Alias{"fieldofview", "fov"},
    Alias{"angle", "fov"},
    Alias{"albedo", "diffuse"},
    Alias{"color", "diffuse"},
    Alias{"color", "intensity"},
    Alias{"strength", "intensity"},
    Alias{"scale", "intensity"},
    Alias{"multiplier", "intensity"},
    Alias{"color", "tint"},
    Alias{"colour", "color"},
    Alias{"colour", "diffuse"},
    Alias{"colour", "tint"},
    Alias{"lostcolour", "lost_color"},
    Alias{"basecolor", "diffuse"},
    Alias{"reflectance", "diffuse"},
    Alias{"texture", "diffuse"},
    Alias{"background", "color"},
    Alias{"background", "environment"},
    Alias{"sky", "environment"},
    Alias{"world", "environment"},
    Alias{"map", "image"},
    Alias{"file", "image"},
    Alias{"filename", "file"},
    Alias{"filename", "image"},
    Alias{"path", "file"},
    Alias{"obj", "file"},
    Alias{"radiance", "emitted"},
    Alias{"emission", "emitted"},
    Alias{"emissive", "emitted"},
    Alias{"emittance", "emitted"},
    Alias{"emit", "emitted"},
    Alias{"power", "intensity"},
    Alias{"brightness", "intensity"},
    Alias{"mirror", "reflective"},
    Alias{"specular", "reflective"},
    Alias{"reflection", "reflective"},
    Alias{"glossiness", "roughness"},
    Alias{"alpha", "roughness"},
    Alias{"weight", "mass"},
    Alias{"gravity", "mass"},
    Alias{"softening", "core_radius"},
    Alias{"eventhorizon", "horizon"},
    Alias{"points", "vertices"},
    Alias{"corners", "vertices"},
    Alias{"verts", "vertices"},
    Alias{"rotate", "rotation"},
    Alias{"orientation", "rotation"},
    Alias{"translation", "translate"},
    Alias{"offset", "translate"},
    Alias{"partner", "pair"},
    Alias{"target", "pair"},
    Alias{"other", "pair"},
    Alias{"link", "pair"},
    Alias{"filter", "tint"},
    Alias{"id", "name"},
    Alias{"innerradius", "inner_radius"},
    Alias{"rmin", "inner_radius"},
    Alias{"rmax", "outer_radius"},
    Alias{"radius", "outer_radius"},
    Alias{"stepsize", "step"},
    Alias{"dt", "step"},
    Alias{"epsilon", "tolerance"},
    Alias{"error", "tolerance"},
    Alias{"maxdistance", "max_length"},
    Alias{"lightspeed", "c"},
    Alias{"speedoflight", "c"},
    Alias{"gravitationalconstant", "G"},
    Alias{"image", "film"},
    Alias{"output", "film"},
    Alias{"sampling", "sampler"},
    Alias{"integrator", "physics"},
    Alias{"renderer", "shading"},
    Alias{"box", "cube"},
    Alias{"block", "cube"},
    Alias{"ball", "sphere"},
    Alias{"plane", "quad"},
    Alias{"polygon", "quad"},
    Alias{"rectangle", "quad"},
    Alias{"triangle", "quad"},
    Alias{"disk", "ring"},
    Alias{"disc", "ring"},
    Alias{"annulus", "ring"},
    Alias{"tube", "cylinder"},
    Alias{"model", "mesh"},
    Alias{"pointlight", "light"},
    Alias{"lamp", "light"},
    Alias{"wormhole", "portal"},
    Alias{"blackhole", "mass"},
};

/// Lower case, letters and digits only.
std::string bare(std::string_view word) {
  std::string result;
  for (const char letter : word) {
    if (letter >= 'A' && letter <= 'Z') {
      result += static_cast<char>(letter - 'A' + 'a');
    } else if (letter != '_' && letter != '-' && letter != ' ') {
      result += letter;
    }
  }
  return result;
}

/// Optimal string alignment: insert, delete, replace, swap neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

/// The one known word that begins so; nothing if there are several, or the beginning is short.
std::string begun_with(std::string_view beginning, const std::vector<std::string>& known) {
  constexpr std::size_t least = 3;
  if (beginning.size() < least) return {};
  std::string found;
  for (const std::string& candidate : known) {
    if (!bare(candidate).starts_with(beginning)) continue;
    if (!found.empty()) return {};
    found = candidate;
  }
  return found;
}

bool is_control(char letter) {
  const auto code = static_cast<unsigned char>(letter);
  return code < 0x20 || code == 0x7f;
}

}  // namespace

std::string in_quotes(std::string_view word) {
  std::string result = "'";
  for (const char letter : word.substr(0, longest_quote))
    result += is_control(letter) ? '?' : letter;
  if (word.size() > longest_quote) result += "...";
  return result + "'";
}

std::string harmless(std::string text) {
  for (char& letter : text)
    if (is_control(letter)) letter = letter == '\n' ? ' ' : '?';
  return text;
}

std::string listed(const std::vector<std::string>& words) {
  std::string result;
  for (std::size_t i = 0; i < words.size() && i < longest_list; ++i) {
    if (i > 0) result += ", ";
    result += words[i];
  }
  return words.size() > longest_list ? result + ", ..." : result;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  if (word.empty() || word.size() > longest_guess) return {};
  const std::string meant = bare(word);
  for (const std::string& candidate : known) {
    if (bare(candidate) == meant) return candidate;
  }
  for (const auto& [theirs, ours] : aliases) {
    if (theirs == meant && std::find(known.begin(), known.end(), ours) != known.end()) {
      return std::string(ours);
    }
  }
  std::string best;
  std::size_t least = std::max<std::size_t>(1, std::min<std::size_t>(3, meant.size() / 3)) + 1;
  for (const std::string& candidate : known) {
    const std::string other = bare(candidate);
    // No distance is less than the difference of the lengths.
    if (std::max(meant.size(), other.size()) >= least + std::min(meant.size(), other.size()))
      continue;
    const std::size_t distance = edit_distance(meant, other);
    if (distance < least && distance < std::max(meant.size(), other.size())) {
      least = distance;
      best = candidate;
    }
  }
  return best.empty() ? begun_with(meant, known) : best;
}

std::string suggestion_or_list(std::string_view word, const std::vector<std::string>& known) {
  const std::string guess = suggestion(word, known);
  if (!guess.empty()) return "did you mean " + guess + "?";
  return known.empty() ? "leave it out" : "known are " + listed(known);
}

}  // namespace portalens
