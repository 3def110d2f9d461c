#include "render/piece.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/words.h"
#include "io/bytes.h"
#include "io/digest.h"
#include "io/files.h"

namespace portalens {
namespace {

constexpr std::string_view magic = "portalens piece\n";
constexpr std::uint32_t layout_version = 1;
constexpr std::size_t preamble_size = 16 + 4 + 4;  // magic, version, length of the head
constexpr std::size_t digest_size = 32;            // as text
constexpr std::uint32_t most_head = 64u << 20;
constexpr std::uint32_t most_entries = 100'000;
constexpr int most_along = 65'536;
constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28;
constexpr std::uint32_t most_samples = 1'000'000;
constexpr int most_tile = 4096;

using Entries = std::vector<std::pair<std::string, std::string>>;

/// Why a file is no piece.
struct Refusal {
  std::string problem, remedy = "it was damaged; use another copy, or take it anew";
};

void require(bool condition, const char* problem) {
  if (!condition) throw Refusal{problem};
}

void write_entries(ByteWriter& writer, const Entries& entries) {
  writer.number(static_cast<std::uint32_t>(entries.size()));
  for (const auto& [name, value] : entries) {
    writer.text(name);
    writer.text(value);
  }
}

Entries read_entries(ByteReader& reader) {
  const auto count = reader.number<std::uint32_t>();
  require(count <= most_entries, "its head names too much");
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
  require(film.x0 == 0 && film.y0 == 0 && film.x1 >= 1 && film.y1 >= 1 && film.x1 <= most_along &&
              film.y1 <= most_along && film.pixels() <= most_pixels,
          "its film has no size that a film can have");
  require(film.holds(window) && !window.empty(), "its pixels are not on its film");
  require(assignment.samples >= 1 && assignment.samples <= most_samples &&
              assignment.range.begin < assignment.range.end &&
              assignment.range.end <= assignment.samples,
          "its samples are none of the picture's");
  require(layers < 1u << layer_count, "it has layers that are not known");
  require(assignment.tile_size >= 1 && assignment.tile_size <= most_tile,
          "its tiles have no size that tiles can have");
  for (int i = 0; i < layer_count; ++i)
    if (layers & 1u << i) assignment.layers.push_back(static_cast<Layer>(i));
  return assignment;
}

template <class Tally_, class Visit>
void for_counts(Tally_& tally, const Visit& visit) {
  for (auto* count : {&tally.samples, &tally.photons, &tally.shadow_queries, &tally.steps,
                      &tally.crossings, &tally.not_finite})
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
  const auto begun = reader.number<std::uint64_t>();
  require(begun <= tiles.count(), "it has begun more tiles than there are");
  for (std::uint64_t i = 0; i < begun && !reader.failed(); ++i) {
    const auto tile = reader.number<std::uint64_t>();
    const auto done = reader.number<std::uint64_t>();
    if (reader.failed()) return;
    require(tile < tiles.count() && !account.complete[tile] &&
                (account.begun.empty() || account.begun.rbegin()->first < tile),
            "its tiles contradict each other");
    const TileWork work(assignment, tiles[tile]);
    require(done > 0 && done < work.total(), "more of a tile is done than there is");
    samples += std::min(done, work.samples);
    account.begun[tile].done = done;
  }
  require(reader.failed() || samples == account.tally.samples,
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
    require(value >= 0 && std::isfinite(static_cast<double>(value)), "its counts are not counts");
  });
  account.seconds = reader.number<double>();
  require(account.seconds >= 0.0 && std::isfinite(account.seconds), "its time is not a time");
  const auto lost = reader.number<std::uint32_t>();
  require(lost <= most_lost, "it names too many lost photons");
  for (std::uint32_t i = 0; i < lost; ++i) {
    PixelSample at;
    at.x = reader.number<std::int32_t>();
    at.y = reader.number<std::int32_t>();
    at.sample = reader.number<std::uint32_t>();
    account.lost.push_back(at);
    require(reader.failed() || assignment.window.holds({at.x, at.y, at.x + 1, at.y + 1}),
            "it lost photons that are not its own");
  }
  read_tiles(reader, assignment, account);
  return account;
}

/// A picture's header is written from these: they may say nothing but what is ours to say.
void check_metadata(const Metadata& metadata) {
  for (const auto& [key, value] : metadata)
    require(key == "Software" || key.rfind("portalens:", 0) == 0, "its description is not ours");
}

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

/// Bytes of what stands of a tile.
std::uint64_t tile_size(const Assignment& assignment, const TileWork& work, std::uint64_t done) {
  const std::uint64_t sums =
      assignment.whole_pixels() ? 0 : SampleSum::node_count(assignment.range);
  const std::uint64_t pixel = 3 * sizeof(float) + sums * sizeof(Rgb);
  return work.lit(done) * pixel +
         SampleSum::node_count(work.begun(done, assignment.range)) * sizeof(Rgb) +
         work.layered(done) * channel_count(assignment.layers) * sizeof(float);
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

PieceHead decoded_head(std::string_view bytes) {
  ByteReader reader(bytes);
  PieceHead head;
  head.provenance.fingerprint = read_entries(reader);
  head.provenance.metadata = read_entries(reader);
  head.provenance.scene_words = reader.text();
  require(!reader.failed(), "its head is too short");
  check_metadata(head.provenance.metadata);
  head.assignment = read_assignment(reader);
  head.account = read_account(reader, head.assignment);
  require(!reader.failed() && reader.size() == 0, "its head is not as long as it says");
  head.body_size = body_size(head.assignment, head.account);
  return head;
}

std::span<const double> doubles_of(std::span<const Rgb> sums) {
  static_assert(sizeof(Rgb) == 3 * sizeof(double));
  return {reinterpret_cast<const double*>(sums.data()), 3 * sums.size()};
}

void write_tile(ByteWriter& writer, const Exposure& exposure, std::size_t tile,
                const TileProgress& progress) {
  const TileWork work = exposure.work_on(tile);
  const Plate& plate = exposure.plate();
  for_first_pixels(work, work.lit(progress.done), [&](int x, int y) {
    writer.numbers(plate.mean(x, y));
    writer.numbers(doubles_of(plate.sums(x, y)));
  });
  writer.numbers(doubles_of(progress.sums));
  for_first_pixels(work, work.layered(progress.done),
                   [&](int x, int y) { writer.numbers(plate.layers(x, y)); });
}

/// Reads what is written so.
class BodyReader {
 public:
  BodyReader(const PieceHead& head, std::string_view bytes) : head_(head), reader_(bytes) {}

  std::unique_ptr<Exposure> read() {
    const Assignment& assignment = head_.assignment;
    const Tiling tiles(assignment.window, assignment.tile_size);
    Plate plate(assignment);
    Account account = head_.account;
    for (std::size_t i = 0; i < tiles.count(); ++i) {
      const auto begun = account.begun.find(i);
      const TileWork work(assignment, tiles[i]);
      if (account.complete[i])
        read_tile(work, work.total(), plate);
      else if (begun != account.begun.end())
        begun->second.sums = read_tile(work, begun->second.done, plate);
    }
    return std::make_unique<Exposure>(assignment, std::move(account), std::move(plate));
  }

 private:
  std::vector<Rgb> read_tile(const TileWork& work, std::uint64_t done, Plate& plate) {
    const SampleRange& range = head_.assignment.range;
    const std::size_t nodes = head_.assignment.whole_pixels() ? 0 : SampleSum::node_count(range);
    for_first_pixels(work, work.lit(done), [&](int x, int y) {
      float mean[3];
      reader_.numbers(std::span<float>(mean));
      for (const float value : mean)
        require(std::isfinite(value), "it holds light that is not a number");
      plate.restore(x, y, mean, read_sums(nodes));
    });
    std::vector<Rgb> begun = read_sums(SampleSum::node_count(work.begun(done, range)));
    for_first_pixels(work, work.layered(done),
                     [&](int x, int y) { reader_.numbers(plate.layers(x, y)); });
    return begun;
  }

  std::vector<Rgb> read_sums(std::size_t count) {
    std::vector<Rgb> sums(count);
    reader_.numbers(std::span<double>(reinterpret_cast<double*>(sums.data()), 3 * count));
    for (const Rgb& sum : sums) require(is_finite(sum), "it holds light that is not a number");
    return sums;
  }

  const PieceHead& head_;
  ByteReader reader_;
};

/// Calls `work`, and tells what it found wrong as a fault of the file's.
template <class Work>
auto told(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const Refusal& refusal) {
    Faults faults;
    faults.add({std::make_shared<const std::string>(name), 0}, refusal.problem, refusal.remedy);
    faults.raise();
    throw;  // not reached
  }
}

std::string with_digest(std::string bytes) {
  bytes += digest(bytes);
  return bytes;
}

/// The bytes before their digest.
std::string_view proven(std::string_view bytes, const char* problem) {
  require(bytes.size() >= digest_size, problem);
  const std::string_view content = bytes.substr(0, bytes.size() - digest_size);
  require(digest(content) == bytes.substr(content.size()), problem);
  return content;
}

}  // namespace

std::string encoded_piece(const Provenance& provenance, const Exposure& exposure) {
  const Account account = exposure.account();
  const Assignment& assignment = exposure.assignment();
  const std::string head = encoded_head(provenance, assignment, account);
  ByteWriter preamble;
  preamble.raw(magic);
  preamble.number(layout_version);
  preamble.number(static_cast<std::uint32_t>(head.size()));
  preamble.raw(head);

  ByteWriter body;
  body.reserve(body_size(assignment, account) + digest_size);
  for (std::size_t i = 0; i < account.complete.size(); ++i) {
    const auto begun = account.begun.find(i);
    if (account.complete[i])
      write_tile(body, exposure, i, {exposure.work_on(i).total(), {}});
    else if (begun != account.begun.end())
      write_tile(body, exposure, i, begun->second);
  }
  return with_digest(std::move(preamble).release()) + with_digest(std::move(body).release());
}

PieceFile::PieceFile(const std::filesystem::path& file)
    : PieceFile([&] {
        const auto opened = std::make_shared<const RegularFile>(file);
        return PieceFile(file.string(), opened->size(),
                         [opened](std::uint64_t offset, std::size_t count) {
                           return opened->read(offset, count);
                         });
      }()) {}

PieceFile::PieceFile(std::string name, std::string bytes)
    : PieceFile([&] {
        const auto kept = std::make_shared<const std::string>(std::move(bytes));
        return PieceFile(
            std::move(name), kept->size(), [kept](std::uint64_t offset, std::size_t count) {
              return kept->substr(std::min<std::uint64_t>(offset, kept->size()), count);
            });
      }()) {}

PieceFile::PieceFile(std::string name, std::uint64_t size, Read read)
    : name_(std::move(name)), read_(std::move(read)) {
  told(name_, [&] {
    const Refusal no_piece{"it is no checkpoint and no part of a picture",
                           "name a file that portalens render wrote"};
    const std::string preamble = read_(0, preamble_size);
    ByteReader reader(preamble);
    if (reader.raw(magic.size()) != magic) throw no_piece;
    const auto version = reader.number<std::uint32_t>();
    const auto head_size = reader.number<std::uint32_t>();
    if (reader.failed()) throw no_piece;
    if (version != layout_version)
      throw Refusal{
          fmt::format("its layout has version {}; this program knows {}", version, layout_version),
          "use the program that wrote it"};
    body_begin_ = preamble_size + std::uint64_t{head_size} + digest_size;
    require(head_size <= most_head && body_begin_ <= size, "it ends within its head");
    const std::string head = read_(0, static_cast<std::size_t>(body_begin_));
    head_ = decoded_head(proven(head, "its head is not as it was written").substr(preamble_size));
    if (body_begin_ + head_.body_size + digest_size != size)
      throw Refusal{fmt::format("it should have {} bytes and has {}",
                                body_begin_ + head_.body_size + digest_size, size)};
  });
}

std::unique_ptr<Exposure> PieceFile::exposure() const {
  return told(name_, [&] {
    const std::string body =
        read_(body_begin_, static_cast<std::size_t>(head_.body_size) + digest_size);
    const char* const changed = "its pixels are not as they were written";
    require(body.size() == head_.body_size + digest_size, changed);
    return BodyReader(head_, proven(body, changed)).read();
  });
}

}  // namespace portalens
