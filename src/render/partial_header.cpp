#include "render/partial_header.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/bytes.h"
#include "io/exr_matrix.h"

namespace portalens {
namespace {

constexpr std::uint32_t max_entries = 100'000;
constexpr int max_along = 65'536;
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 28;
constexpr std::uint32_t max_samples = 1'000'000;
constexpr int max_tile = 4096;

using Entries = std::vector<std::pair<std::string, std::string>>;

void write_entries(ByteWriter& writer, const Entries& entries) {
  writer.number(static_cast<std::uint32_t>(entries.size()));
  for (const auto& [name, value] : entries) {
    writer.text(name);
    writer.text(value);
  }
}

Entries read_entries(ByteReader& reader) {
  const auto count = reader.number<std::uint32_t>();
  require_of_partial(count <= max_entries, "its head names too much");
  Entries entries;
  for (std::uint32_t i = 0; i < count && !reader.failed(); ++i) {
    std::string name = reader.text();
    entries.emplace_back(std::move(name), reader.text());
  }
  return entries;
}

void write_window(ByteWriter& writer, const Window& window) {
  for (const int value : {window.x0, window.y0, window.x1, window.y1})
    writer.number(static_cast<std::int32_t>(value));
}

Window read_window(ByteReader& reader) {
  Window window;
  for (int* value : {&window.x0, &window.y0, &window.x1, &window.y1})
    *value = reader.number<std::int32_t>();
  return window;
}

void write_assignment(ByteWriter& writer, const Assignment& assignment) {
  write_window(writer, assignment.film);
  write_window(writer, assignment.window);
  writer.number(assignment.samples);
  writer.number(assignment.range.begin);
  writer.number(assignment.range.end);
  std::uint32_t layers = 0;
  for (const Layer layer : assignment.layers) layers |= 1u << static_cast<unsigned>(layer);
  writer.number(layers);
  writer.number(static_cast<std::int32_t>(assignment.tile_size));
}

Assignment read_assignment(ByteReader& reader) {
  Assignment assignment;
  assignment.film = read_window(reader);
  assignment.window = read_window(reader);
  assignment.samples = reader.number<std::uint32_t>();
  assignment.range.begin = reader.number<std::uint32_t>();
  assignment.range.end = reader.number<std::uint32_t>();
  const auto layers = reader.number<std::uint32_t>();
  assignment.tile_size = reader.number<std::int32_t>();

  const Window &film = assignment.film, &window = assignment.window;
  require_of_partial(film.x0 == 0 && film.y0 == 0 && film.x1 >= 1 && film.y1 >= 1 &&
                         film.x1 <= max_along && film.y1 <= max_along &&
                         film.pixels() <= max_pixels,
                     "its film has no size that a film can have");
  require_of_partial(film.holds(window) && !window.empty(), "its pixels are not on its film");
  require_of_partial(assignment.samples >= 1 && assignment.samples <= max_samples &&
                         assignment.range.begin < assignment.range.end &&
                         assignment.range.end <= assignment.samples,
                     "its samples are none of the picture's");
  require_of_partial(layers < 1u << layer_count, "it has layers that are not known");
  require_of_partial(assignment.tile_size >= 1 && assignment.tile_size <= max_tile,
                     "its tiles have no size that tiles can have");
  for (int i = 0; i < layer_count; ++i)
    if (layers & 1u << i) assignment.layers.push_back(static_cast<Layer>(i));
  return assignment;
}

template <class Tally_, class Visit>
void for_counts(Tally_& tally, const Visit& visit) {
  for (auto* count : {&tally.samples, &tally.photons, &tally.shadow_queries, &tally.interpolated,
                      &tally.probe_rays, &tally.steps, &tally.handed_over, &tally.crossings,
                      &tally.out_of_crossings, &tally.not_finite})
    visit(*count);
  for (auto& count : tally.fates) visit(count);
  for (auto* seconds : {&tally.advancing, &tally.shading, &tally.shadowing}) visit(*seconds);
}

void write_tiles(ByteWriter& writer, const Account& account) {
  std::string bits((account.complete.size() + 7) / 8, '\0');
  for (std::size_t i = 0; i < account.complete.size(); ++i)
    if (account.complete[i]) bits[i / 8] = static_cast<char>(bits[i / 8] | 1 << i % 8);
  writer.raw(bits);
  writer.number(static_cast<std::uint64_t>(account.begun.size()));
  for (const auto& [tile, progress] : account.begun) {
    writer.number(static_cast<std::uint64_t>(tile));
    writer.number(progress.done);
  }
}

void read_tiles(ByteReader& reader, const Assignment& assignment, Account& account) {
  const Tiling tiles(assignment.window, assignment.tile_size);
  const std::string_view bits = reader.raw((tiles.count() + 7) / 8);
  if (reader.failed()) return;
  account.complete.resize(tiles.count());
  std::uint64_t samples = 0;
  for (std::size_t i = 0; i < tiles.count(); ++i) {
    account.complete[i] = (static_cast<unsigned char>(bits[i / 8]) >> i % 8 & 1) != 0;
    if (!account.complete[i]) continue;
    account.pixels += tiles[i].pixels();
    samples += TileWork(assignment, tiles[i]).samples;
  }
  require_of_partial(
      tiles.count() % 8 == 0 || static_cast<unsigned char>(bits.back()) >> tiles.count() % 8 == 0,
      "it has tiles beyond its last");
  const auto begun = reader.number<std::uint64_t>();
  require_of_partial(begun <= tiles.count(), "it has begun more tiles than there are");
  for (std::uint64_t i = 0; i < begun && !reader.failed(); ++i) {
    const auto tile = reader.number<std::uint64_t>();
    const auto done = reader.number<std::uint64_t>();
    if (reader.failed()) return;
    require_of_partial(tile < tiles.count() && !account.complete[tile] &&
                           (account.begun.empty() || account.begun.rbegin()->first < tile),
                       "its tiles contradict each other");
    const TileWork work(assignment, tiles[tile]);
    require_of_partial(done > 0 && done < work.total(), "more of a tile is done than there is");
    samples += std::min(done, work.samples);
    account.begun[tile].done = done;
  }
  require_of_partial(reader.failed() || samples == account.tally.samples,
                     "its samples are not as many as it counted");
}

void write_account(ByteWriter& writer, const Account& account) {
  for_counts(account.tally, [&](const auto& value) { writer.number(value); });
  writer.number(account.seconds);
  writer.number(static_cast<std::uint32_t>(account.lost.size()));
  for (const PixelSample& at : account.lost) {
    writer.number(static_cast<std::int32_t>(at.x));
    writer.number(static_cast<std::int32_t>(at.y));
    writer.number(at.sample);
  }
  write_tiles(writer, account);
}

Account read_account(ByteReader& reader, const Assignment& assignment) {
  Account account;
  for_counts(account.tally, [&](auto& value) {
    value = reader.number<std::decay_t<decltype(value)>>();
    require_of_partial(value >= 0 && std::isfinite(static_cast<double>(value)),
                       "its counts are not counts");
  });
  account.seconds = reader.number<double>();
  require_of_partial(account.seconds >= 0.0 && std::isfinite(account.seconds),
                     "its time is not a time");
  const auto lost = reader.number<std::uint32_t>();
  require_of_partial(lost <= max_lost, "it names too many lost photons");
  for (std::uint32_t i = 0; i < lost; ++i) {
    PixelSample at;
    at.x = reader.number<std::int32_t>();
    at.y = reader.number<std::int32_t>();
    at.sample = reader.number<std::uint32_t>();
    account.lost.push_back(at);
    const Window& window = assignment.window;
    require_of_partial(
        reader.failed() ||
            (at.x >= window.x0 && at.x < window.x1 && at.y >= window.y0 && at.y < window.y1 &&
             at.sample >= assignment.range.begin && at.sample < assignment.range.end),
        "it lost photons that are not its own");
  }
  read_tiles(reader, assignment, account);
  return account;
}

/// A picture's header is written from these: they may say nothing but what is ours to say.
void check_metadata(const Metadata& metadata) {
  for (const auto& [key, value] : metadata)
    require_of_partial(key == "Software" || key == matrix_entry || key.rfind("portalens:", 0) == 0,
                       "its description is not ours");
}

/// Users are shown these words to give them to their shell: they may be words, and no command.
void check_words(std::string_view words) {
  constexpr std::string_view special = "|&;<>()$`\\\"\n\r*?[]#~!{}";
  bool quoted = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == '\'')
      quoted = !quoted;
    else if (!quoted && words.substr(i, 2) == "\\'")
      ++i;  // how a quotation mark is written within a word
    else
      require_of_partial(quoted || special.find(words[i]) == std::string_view::npos,
                         "its words are not those of a command");
  }
  require_of_partial(!quoted, "its words are not those of a command");
}

/// Bytes of what stands of a tile.
std::uint64_t tile_size(const Assignment& assignment, const TileWork& work, std::uint64_t done) {
  const std::uint64_t sums =
      assignment.whole_pixels() ? 0 : SampleSum::node_count(assignment.range);
  const std::uint64_t pixel = 3 * sizeof(float) + sums * sizeof(Rgb);
  return work.lit(done) * pixel +
         SampleSum::node_count(work.begun(done, assignment.range)) * sizeof(Rgb) +
         work.layered(done) * channel_count(assignment.layers) * sizeof(float);
}

}  // namespace

std::string encoded_head(const Provenance& provenance, const Assignment& assignment,
                         const Account& account) {
  ByteWriter writer;
  write_entries(writer, provenance.fingerprint);
  write_entries(writer, provenance.metadata);
  writer.text(provenance.scene_words);
  write_assignment(writer, assignment);
  write_account(writer, account);
  return std::move(writer).release();
}

PartialHeader decoded_head(std::string_view bytes) {
  ByteReader reader(bytes);
  PartialHeader head;
  head.provenance.fingerprint = read_entries(reader);
  head.provenance.metadata = read_entries(reader);
  head.provenance.scene_words = reader.text();
  require_of_partial(!reader.failed(), "its head is too short");
  check_metadata(head.provenance.metadata);
  check_words(head.provenance.scene_words);
  head.assignment = read_assignment(reader);
  head.account = read_account(reader, head.assignment);
  require_of_partial(!reader.failed() && reader.size() == 0, "its head is not as long as it says");
  head.body_size = body_size(head.assignment, head.account);
  return head;
}

std::uint64_t body_size(const Assignment& assignment, const Account& account) {
  const Tiling tiles(assignment.window, assignment.tile_size);
  std::uint64_t size = 0;
  for (std::size_t i = 0; i < account.complete.size(); ++i) {
    if (!account.complete[i]) continue;
    const TileWork work(assignment, tiles[i]);
    size += tile_size(assignment, work, work.total());
  }
  for (const auto& [tile, progress] : account.begun)
    size += tile_size(assignment, TileWork(assignment, tiles[tile]), progress.done);
  return size;
}

}  // namespace portalens
