#include "app/development_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "app/choices.h"

namespace portalens {
namespace {

constexpr const char* exposure_meaning = "The light times 2^STOPS";
constexpr const char* tone_meaning =
    "How it fits bright light in: linear (it burns out at 1), filmic, agx-like (bright colours go "
    "towards white)";
constexpr const char* white_balance_meaning =
    "The temperature of a black body that looks white, 1667 to 25000 K; below 6504 K it makes "
    "the picture bluer";

constexpr const char* exposure_entry = "portalens:exposure";
constexpr const char* tone_entry = "portalens:tone";
constexpr const char* white_balance_entry = "portalens:white_balance";

/// A number as `fmt` has written it; nothing if it is none, or out of bounds.
std::optional<double> number_in(const std::string& text, const Bounds& bounds) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  const bool sound = error == std::errc{} && number >= bounds.low && number <= bounds.high;
  return sound ? std::optional(number) : std::nullopt;
}

}  // namespace

std::array<CLI::Option*, 3> add_development_options(CLI::App& command, Development& development) {
  std::map<std::string, Tone> tones;
  for (std::size_t i = 0; i < tone_names.size(); ++i)
    tones.emplace(tone_names[i], static_cast<Tone>(i));
  return {command.add_option("--exposure", development.exposure, exposure_meaning)
              ->check(number_within(exposure_bounds.low, exposure_bounds.high))
              ->type_name("STOPS"),
          command.add_option("--tone", development.tone, tone_meaning)
              ->transform(one_of(tones))
              ->type_name("NAME"),
          command.add_option("--white-balance", development.white_balance, white_balance_meaning)
              ->check(number_within(white_balance_bounds.low, white_balance_bounds.high))
              ->type_name("KELVIN")};
}

void add_development_overrides(CLI::App& command,
                               const std::function<void(const char*, const std::string&)>& set) {
  const auto add = [&](const char* option, const char* key, const char* type,
                       const std::string& meaning) {
    command
        .add_option_function<std::string>(
            option, [set, key](const std::string& value) { set(key, value); },
            fmt::format("{} ({}); an .exr keeps the light as it is", meaning, key))
        ->type_name(type);
  };
  add("--exposure", "film.exposure", "STOPS", exposure_meaning);
  add("--tone", "film.tone", "NAME", tone_meaning);
  add("--white-balance", "film.white_balance", "KELVIN", white_balance_meaning);
}

Metadata development_metadata(const Development& development) {
  Metadata metadata = {
      {exposure_entry, fmt::format("{}", development.exposure)},
      {tone_entry, std::string(tone_names[static_cast<std::size_t>(development.tone)])}};
  if (development.white_balance)
    metadata.emplace_back(white_balance_entry, fmt::format("{}", *development.white_balance));
  return metadata;
}

Development development_in(const Metadata& header) {
  Development development;
  for (const auto& [key, value] : header) {
    if (key == exposure_entry)
      development.exposure = number_in(value, exposure_bounds).value_or(0.0);
    if (key == white_balance_entry)
      development.white_balance = number_in(value, white_balance_bounds);
    const auto* const tone = std::find(tone_names.begin(), tone_names.end(), value);
    if (key == tone_entry && tone != tone_names.end())
      development.tone = static_cast<Tone>(tone - tone_names.begin());
  }
  return development;
}

Metadata without_development(Metadata header) {
  header.erase(std::remove_if(header.begin(), header.end(),
                              [](const auto& entry) {
                                return entry.first == exposure_entry || entry.first == tone_entry ||
                                       entry.first == white_balance_entry;
                              }),
               header.end());
  return header;
}

}  // namespace portalens
