#include "support/arrival_cache.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <exception>
#include <limits>
#include <string_view>

#include "io/bytes.h"
#include "io/digest.h"
#include "io/files.h"

namespace portalens::benchmarks {
namespace {

constexpr std::string_view magic = "portalens arrivals 1\n";

/// Of the recipe and of where each photon starts.
std::string key_of(const std::string& recipe, std::span<const Photon> photons) {
  ByteWriter writer;
  writer.text(recipe);
  for (const Photon& photon : photons)
    for (const Vec3d& v : {photon.position, photon.direction})
      writer.numbers(std::span<const double>(std::array{v.x, v.y, v.z}));
  return digest(writer.bytes());
}

void write(const Arrival& arrival, ByteWriter& writer) {
  writer.number(static_cast<std::uint8_t>(arrival.fate));
  writer.number(static_cast<std::uint8_t>(arrival.met));
  for (const std::uint32_t number :
       {arrival.object, arrival.face, arrival.steps, arrival.crossings})
    writer.number(number);
  for (const Vec3d& v : {arrival.position, arrival.direction, arrival.tint})
    writer.numbers(std::span<const double>(std::array{v.x, v.y, v.z}));
  writer.number(arrival.length);
  writer.number(arrival.turning);
}

Vec3d read_vector(ByteReader& reader) {
  const auto x = reader.number<double>(), y = reader.number<double>(), z = reader.number<double>();
  return {x, y, z};
}

Arrival read_arrival(ByteReader& reader) {
  Arrival arrival;
  arrival.fate = static_cast<Fate>(reader.number<std::uint8_t>());
  arrival.met = static_cast<Met>(reader.number<std::uint8_t>());
  for (std::uint32_t* number : {&arrival.object, &arrival.face, &arrival.steps, &arrival.crossings})
    *number = reader.number<std::uint32_t>();
  for (Vec3d* v : {&arrival.position, &arrival.direction, &arrival.tint}) *v = read_vector(reader);
  arrival.length = reader.number<double>();
  arrival.turning = reader.number<double>();
  return arrival;
}

/// The magic word, the key, the arrivals, and a digest of all that.
std::string to_bytes(const std::string& key, std::span<const Arrival> arrivals) {
  ByteWriter writer;
  writer.raw(magic);
  writer.text(key);
  writer.number(static_cast<std::uint64_t>(arrivals.size()));
  for (const Arrival& arrival : arrivals) write(arrival, writer);
  const std::string seal = digest(writer.bytes());
  writer.raw(seal);
  return std::move(writer).release();
}

std::optional<std::vector<Arrival>> from_bytes(std::string_view bytes, const std::string& key,
                                               std::size_t count) {
  const std::size_t seal = digest({}).size();
  if (bytes.size() < seal) return std::nullopt;
  const std::string_view content = bytes.substr(0, bytes.size() - seal);
  if (digest(content) != bytes.substr(content.size())) return std::nullopt;
  ByteReader reader(content);
  if (reader.raw(magic.size()) != magic || reader.text() != key ||
      reader.number<std::uint64_t>() != count)
    return std::nullopt;
  std::vector<Arrival> arrivals;
  for (std::size_t i = 0; i < count && !reader.failed(); ++i)
    arrivals.push_back(read_arrival(reader));
  if (reader.failed() || reader.size() != 0) return std::nullopt;
  return arrivals;
}

}  // namespace

std::filesystem::path ArrivalCache::file(const std::string& recipe,
                                         std::span<const Photon> photons) const {
  return folder_ / (key_of(recipe, photons) + ".arrivals");
}

std::vector<Arrival> ArrivalCache::arrivals(
    const std::string& recipe, std::span<const Photon> photons,
    const std::function<void(std::span<const Photon>, std::span<Arrival>)>& compute) const {
  const std::string key = key_of(recipe, photons);
  const std::filesystem::path path = file(recipe, photons);
  Faults faults;  // a file that can't be read counts as none
  const auto bytes = read_file(path, std::uint64_t{1} << 30, {}, faults);
  if (bytes)
    if (auto kept = from_bytes(*bytes, key, photons.size())) return *std::move(kept);
  std::vector<Arrival> arrivals(photons.size());
  compute(photons, arrivals);
  try {
    std::filesystem::create_directories(folder_);
    replace_file(path, to_bytes(key, arrivals));
  } catch (const std::exception& error) {
    fmt::print(stderr, "not kept for the next run: {}\n", error.what());
  }
  return arrivals;
}

}  // namespace portalens::benchmarks
