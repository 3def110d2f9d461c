#include "render/partial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/bytes.h"
#include "io/digest.h"
#include "io/files.h"

namespace portalens {
namespace {

constexpr std::string_view magic = "portalens piece\n";
constexpr std::uint32_t layout_version = 5;
constexpr std::size_t preamble_size = 16 + 4 + 4;  // magic, version, length of the head
constexpr std::size_t digest_size = 32;            // as text
constexpr std::uint32_t max_head = 64u << 20;
/// Of a pixel: a sample is at most as bright as a float can be, and there are a million at most.
constexpr double max_light = 1e6 * std::numeric_limits<float>::max();

std::span<const double> doubles_of(std::span<const Rgb> sums) {
  static_assert(sizeof(Rgb) == 3 * sizeof(double));
  return {reinterpret_cast<const double*>(sums.data()), 3 * sums.size()};
}

void write_tile(ByteWriter& writer, const Exposure& exposure, std::size_t tile,
                const TileProgress& progress) {
  const TileWork work = exposure.work_on(tile);
  const Framebuffer& framebuffer = exposure.framebuffer();
  for_first_pixels(work, work.lit(progress.done), [&](int x, int y) {
    writer.numbers(framebuffer.mean(x, y));
    writer.numbers(doubles_of(framebuffer.sums(x, y)));
  });
  writer.numbers(doubles_of(progress.sums));
  for_first_pixels(work, work.layered(progress.done),
                   [&](int x, int y) { writer.numbers(framebuffer.layers(x, y)); });
}

/// Reads what is written so.
class BodyReader {
 public:
  BodyReader(const PartialHeader& head, std::string_view bytes) : head_(head), reader_(bytes) {}

  std::unique_ptr<Exposure> read() {
    const Assignment& assignment = head_.assignment;
    const Tiling tiles(assignment.window, assignment.tile_size);
    Framebuffer framebuffer(assignment);
    Account account = head_.account;
    for (std::size_t i = 0; i < tiles.count(); ++i) {
      const auto begun = account.begun.find(i);
      const TileWork work(assignment, tiles[i]);
      if (account.complete[i])
        read_tile(work, work.total(), framebuffer);
      else if (begun != account.begun.end())
        begun->second.sums = read_tile(work, begun->second.done, framebuffer);
    }
    return std::make_unique<Exposure>(assignment, std::move(account), std::move(framebuffer));
  }

 private:
  std::vector<Rgb> read_tile(const TileWork& work, std::uint64_t done, Framebuffer& framebuffer) {
    const SampleRange& range = head_.assignment.range;
    const std::size_t nodes = head_.assignment.whole_pixels() ? 0 : SampleSum::node_count(range);
    for_first_pixels(work, work.lit(done), [&](int x, int y) {
      float mean[3];
      reader_.numbers(std::span<float>(mean));
      for (const float value : mean)
        require_of_partial(std::isfinite(value), "it holds light that is not a number");
      framebuffer.restore(x, y, mean, read_sums(nodes));
    });
    std::vector<Rgb> begun = read_sums(SampleSum::node_count(work.begun(done, range)));
    for_first_pixels(work, work.layered(done),
                     [&](int x, int y) { read_layers(framebuffer.layers(x, y)); });
    return begun;
  }

  void read_layers(std::span<float> values) {
    reader_.numbers(values);
    for (const float value : values)
      require_of_partial(std::isfinite(value), "its layers hold what is not a number");
  }

  std::vector<Rgb> read_sums(std::size_t count) {
    std::vector<Rgb> sums(count);
    reader_.numbers(std::span<double>(reinterpret_cast<double*>(sums.data()), 3 * count));
    for (const Rgb& sum : sums)
      for (const double value : {sum.x, sum.y, sum.z})
        require_of_partial(std::abs(value) <= max_light, "it holds light that is not a number");
    return sums;
  }

  const PartialHeader& head_;
  ByteReader reader_;
};

/// Calls `work`, and tells what it found wrong as a fault of the file's.
template <class Work>
auto told(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const PartialRefusal& refusal) {
    Faults faults;
    faults.add({std::make_shared<const std::string>(name), 0}, refusal.problem, refusal.remedy);
    faults.raise();
    throw;  // not reached
  }
}

/// The bytes before their digest.
std::string_view proven(std::string_view bytes, const char* problem) {
  require_of_partial(bytes.size() >= digest_size, problem);
  const std::string_view content = bytes.substr(0, bytes.size() - digest_size);
  require_of_partial(digest(content) == bytes.substr(content.size()), problem);
  return content;
}

}  // namespace

std::string encoded_partial(const Provenance& provenance, const Exposure& exposure) {
  const Account account = exposure.account();
  const Assignment& assignment = exposure.assignment();
  const std::string head = encoded_head(provenance, assignment, account);
  ByteWriter writer;  // of all, since sums may take much of the memory
  writer.reserve(preamble_size + head.size() + body_size(assignment, account) + 2 * digest_size);
  writer.raw(magic);
  writer.number(layout_version);
  writer.number(static_cast<std::uint32_t>(head.size()));
  writer.raw(head);
  writer.raw(digest(writer.bytes()));

  const std::size_t body = writer.bytes().size();
  for (std::size_t i = 0; i < account.complete.size(); ++i) {
    const auto begun = account.begun.find(i);
    if (account.complete[i])
      write_tile(writer, exposure, i, {exposure.work_on(i).total(), {}});
    else if (begun != account.begun.end())
      write_tile(writer, exposure, i, begun->second);
  }
  writer.raw(digest(std::string_view(writer.bytes()).substr(body)));
  return std::move(writer).release();
}

PartialFile::PartialFile(const std::filesystem::path& file)
    : PartialFile([&] {
        const auto opened = std::make_shared<const RegularFile>(file);
        return PartialFile(file.string(), opened->size(),
                           [opened](std::uint64_t offset, std::size_t count) {
                             return opened->read(offset, count);
                           });
      }()) {}

PartialFile::PartialFile(std::string name, std::string bytes)
    : PartialFile([&] {
        const auto kept = std::make_shared<const std::string>(std::move(bytes));
        return PartialFile(
            std::move(name), kept->size(), [kept](std::uint64_t offset, std::size_t count) {
              return kept->substr(std::min<std::uint64_t>(offset, kept->size()), count);
            });
      }()) {}

PartialFile::PartialFile(std::string name, std::uint64_t size, Read read)
    : name_(std::move(name)), read_(std::move(read)) {
  told(name_, [&] {
    const PartialRefusal no_partial{"it is no checkpoint and no part of a picture",
                                    "name a file that portalens render wrote"};
    const std::string preamble = read_(0, preamble_size);
    ByteReader reader(preamble);
    if (reader.raw(magic.size()) != magic) throw no_partial;
    const auto version = reader.number<std::uint32_t>();
    const auto head_size = reader.number<std::uint32_t>();
    if (reader.failed()) throw no_partial;
    if (version != layout_version)
      throw PartialRefusal{
          fmt::format("its layout has version {}; this program knows {}", version, layout_version),
          "use the program that wrote it"};
    body_begin_ = preamble_size + std::uint64_t{head_size} + digest_size;
    require_of_partial(head_size <= max_head && body_begin_ <= size, "it ends within its head");
    const std::string head = read_(0, static_cast<std::size_t>(body_begin_));
    head_ = decoded_head(proven(head, "its head is not as it was written").substr(preamble_size));
    if (body_begin_ + head_.body_size + digest_size != size)
      throw PartialRefusal{fmt::format("it should have {} bytes and has {}",
                                       body_begin_ + head_.body_size + digest_size, size)};
  });
}

std::unique_ptr<Exposure> PartialFile::exposure() const {
  return told(name_, [&] {
    const std::string body =
        read_(body_begin_, static_cast<std::size_t>(head_.body_size) + digest_size);
    const char* const changed = "its pixels are not as they were written";
    require_of_partial(body.size() == head_.body_size + digest_size, changed);
    return BodyReader(head_, proven(body, changed)).read();
  });
}

}  // namespace portalens
