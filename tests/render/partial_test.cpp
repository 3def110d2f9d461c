/// \file
/// What stands of a picture survives as a file, to the bit, and no damaged file passes for one.
#include "render/partial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include "math/random.h"
#include "render/merge.h"
#include "render/render.h"
#include "support/busy_scene.h"
#include "support/scale.h"
#include "support/scene_text.h"

namespace portalens::test {
namespace {

const World& busy_world() {
  static const World world = compiled(busy_scene);
  return world;
}

const Provenance provenance{{{"the program", "this"}, {"physics.c", "1"}},
                            {{"Software", "portalens"}, {"portalens:scene", "busy"}},
                            "busy.toml"};

/// Requested after it was asked so many times.
class StopAfter : public Cancellation {
 public:
  explicit StopAfter(int asked) : left_(asked) {}
  [[nodiscard]] bool requested() const override { return left_-- <= 0; }

 private:
  mutable std::atomic<int> left_;
};

RenderOptions part_options(int tile, std::optional<Window> crop = std::nullopt,
                           std::optional<SampleRange> samples = std::nullopt) {
  RenderOptions options;
  options.threads = 2;
  options.tile_size = tile;
  options.crop = crop;
  options.samples = samples;
  options.layers = {Layer::depth, Layer::normal, Layer::object};
  return options;
}

std::unique_ptr<Exposure> begun(const RenderOptions& options, int stop_after = 1 << 30) {
  auto exposure = std::make_unique<Exposure>(assignment_of(busy_world(), options));
  const StopAfter stop(stop_after);
  expose(busy_world(), *exposure, options, nullptr, &stop);
  return exposure;
}

PartialFile partial(const Exposure& exposure) {
  return PartialFile("a.part", encoded_partial(provenance, exposure));
}

/// Everything but the times.
void expect_same(const RenderResult& a, const RenderResult& b) {
  EXPECT_EQ(a.image.pixels, b.image.pixels);
  ASSERT_EQ(a.layers.size(), b.layers.size());
  for (std::size_t i = 0; i < a.layers.size(); ++i) {
    EXPECT_EQ(a.layers[i].name, b.layers[i].name);
    EXPECT_EQ(a.layers[i].values, b.layers[i].values);
  }
  EXPECT_EQ(a.window, b.window);
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.completion, b.completion);
  EXPECT_EQ(a.tally.samples, b.tally.samples);
  EXPECT_EQ(a.tally.photons, b.tally.photons);
  EXPECT_EQ(a.tally.steps, b.tally.steps);
  EXPECT_EQ(a.tally.crossings, b.tally.crossings);
  EXPECT_EQ(a.tally.shadow_queries, b.tally.shadow_queries);
  EXPECT_EQ(a.tally.fates, b.tally.fates);
  ASSERT_EQ(a.lost.size(), b.lost.size());
  for (std::size_t i = 0; i < a.lost.size(); ++i) {
    EXPECT_FALSE(a.lost[i] < b.lost[i]);
    EXPECT_FALSE(b.lost[i] < a.lost[i]);
  }
}

TEST(Partial, HoldsWhatStandsAndGoesOnToTheSameBits) {
  const RenderResult whole = result_of(*begun(part_options(16)));
  EXPECT_EQ(whole.lost.size(), max_lost);
  for (int stop = 0; stop < scaled(20); ++stop) {
    const auto interrupted = begun(part_options(16), stop);
    const PartialFile file = partial(*interrupted);
    const auto back = file.exposure();
    expect_same(result_of(*back), result_of(*interrupted));
    RenderOptions options = part_options(16);
    options.threads = 1 + stop % 3;
    expose(busy_world(), *back, options);
    expect_same(result_of(*back), whole);
  }
}

TEST(Partial, GoesOnWithinAPixel) {
  const RenderOptions options = part_options(64);
  const RenderResult whole = result_of(*begun(options));
  RenderOptions one = options;
  one.threads = 1;
  int within = 0;
  for (int stop = 2; stop < 10; ++stop) {
    Exposure exposure(assignment_of(busy_world(), options));
    const StopAfter soon(stop);
    expose(busy_world(), exposure, one, nullptr, &soon);
    for (const auto& [tile, progress] : exposure.account().begun) within += !progress.sums.empty();
    const auto back = partial(exposure).exposure();
    expose(busy_world(), *back, options);
    expect_same(result_of(*back), whole);
  }
  EXPECT_GT(within, 0) << "a batch of 512 samples ends within a pixel of 3";
}

TEST(Partial, CropsInAnyOrderMergeToTheWhole) {
  const RenderResult whole = result_of(*begun(part_options(32)));
  std::vector<Window> crops;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      crops.push_back({column * 53 / 3, row * 29 / 3, (column + 1) * 53 / 3, (row + 1) * 29 / 3});
  std::vector<std::string> files;
  for (const Window& crop : crops)
    files.push_back(encoded_partial(provenance, *begun(part_options(8, crop))));
  for (int order = 0; order < scaled(5); ++order) {
    std::vector<std::size_t> places(files.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
    std::sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
      return random_number(order, a) < random_number(order, b);
    });
    std::vector<PartialFile> parts;
    for (const std::size_t i : places) parts.emplace_back("part", files[i]);
    expect_same(result_of(*merged(parts, std::nullopt)), whole);
  }
}

TEST(Partial, RangesOfSamplesMergeToTheWholeBesideCrops) {
  const RenderResult whole = result_of(*begun(part_options(32)));
  const Window left{0, 0, 20, 29}, right{20, 0, 53, 29};
  std::vector<PartialFile> parts;
  for (const auto& [window, range] :
       {std::pair{right, SampleRange{1, 3}}, std::pair{left, SampleRange{0, 3}},
        std::pair{right, SampleRange{0, 1}}})
    parts.push_back(partial(*begun(part_options(16, window, range))));
  const auto exposure = merged(parts, std::nullopt);
  expect_same(result_of(*exposure), whole);
  EXPECT_EQ(partial(*exposure).head().account.pixels, 53u * 29);
}

std::vector<Fault> faults_of_merge(const std::vector<PartialFile>& parts,
                                   std::optional<Window> crop = std::nullopt) {
  try {
    (void)merged(parts, crop);
  } catch (const SceneError& error) {
    return error.faults();
  }
  return {};
}

TEST(Partial, MergeNamesGapsOverlapsAndDifferences) {
  const Window left{0, 0, 20, 29}, right{20, 0, 53, 29}, more{19, 0, 53, 29};
  const auto one = [](const Window& window, SampleRange range = {0, 3}) {
    return partial(*begun(part_options(32, window, range)));
  };
  const auto told = [](const std::vector<Fault>& faults) {
    std::string text;
    for (const Fault& fault : faults) text += to_string(fault) + '\n';
    return text;
  };
  EXPECT_EQ(told(faults_of_merge({one(left), one(right)})), "");
  EXPECT_EQ(told(faults_of_merge({one(left)}, left)), "");
  EXPECT_NE(told(faults_of_merge({one(left)})).find("samples 0 to 3 of pixel (20, 0)"),
            std::string::npos);
  EXPECT_NE(told(faults_of_merge({one(left), one(right, {0, 2})})).find("samples 2 to 3"),
            std::string::npos);
  EXPECT_NE(told(faults_of_merge({one(left), one(right, {1, 3})})).find("samples 0 to 1"),
            std::string::npos);
  EXPECT_NE(told(faults_of_merge({one(left), one(more)})).find("19 0 20 29, samples 0 to 3"),
            std::string::npos);
  EXPECT_NE(told(faults_of_merge({one(left), one(right)}, left)).find("not among those wanted"),
            std::string::npos);

  Provenance other = provenance;
  other.fingerprint[1].second = "2";
  const PartialFile different("b.part", encoded_partial(other, *begun(part_options(32, right))));
  EXPECT_NE(told(faults_of_merge({one(left), different}))
                .find("b.part: physics.c is '2' here, and '1' in a.part"),
            std::string::npos);

  const PartialFile unfinished = partial(*begun(part_options(8, right), 2));
  EXPECT_NE(told(faults_of_merge({one(left), unfinished})).find("not finished"), std::string::npos);
}

/// Else what is tried on the path to them never sees more than the door.
TEST(Partial, SeedsForFuzzingAreReadAsWhatTheyAre) {
  const std::filesystem::path seeds = PORTALENS_SOURCE_DIR "/fuzz/seeds/checkpoint";
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(seeds)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    bytes.resize(
        std::min(bytes.size(), bytes.find("portalens piece", 1)));  // of several, the first
    EXPECT_NO_THROW((void)PartialFile(entry.path().string(), bytes).exposure()) << entry.path();
    ++read;
  }
  EXPECT_GE(read, 8);
}

TEST(Partial, EveryChangedByteIsNoticed) {
  const std::string bytes = encoded_partial(provenance, *begun(part_options(16), 4));
  const auto refused = [](std::string changed) {
    try {
      (void)PartialFile("a.part", std::move(changed)).exposure();
    } catch (const SceneError& error) {
      return !error.faults().front().problem.empty();
    }
    return false;
  };
  ASSERT_FALSE(refused(bytes));
  for (int trial = 0; trial < scaled(3000); ++trial) {
    std::string changed = bytes;
    const double where = random_number(trial, 0);
    const auto at = static_cast<std::size_t>(
        where * where * static_cast<double>(bytes.size()));  // more at the head
    changed[at] = static_cast<char>(changed[at] ^ (1 << trial % 8));
    EXPECT_TRUE(refused(changed)) << at;
    EXPECT_TRUE(refused(bytes.substr(0, at))) << at;
  }
  EXPECT_TRUE(refused(bytes + "x"));
  EXPECT_TRUE(refused(""));
}

/// What is wrong with a partial picture, or nothing.
std::string refusal(const Provenance& of, const Exposure& exposure) {
  try {
    (void)PartialFile("a.part", encoded_partial(of, exposure)).exposure();
  } catch (const SceneError& error) {
    return to_string(error.faults().front());
  }
  return "";
}

/// Before anything else of it: its digests are of another kind, too.
TEST(Partial, AnOlderLayoutIsToldByItsVersion) {
  std::string bytes = encoded_partial(provenance, *begun(part_options(16)));
  bytes[16] = 3;
  try {
    (void)PartialFile("a.part", bytes);
    FAIL() << "it was read";
  } catch (const SceneError& error) {
    EXPECT_NE(
        to_string(error.faults().front()).find("its layout has version 3; this program knows"),
        std::string::npos);
  }
}

TEST(Partial, TheWordsOfAStrangersPieceAreNoCommand) {
  const auto exposure = begun(part_options(16), 4);
  Provenance of = provenance;
  for (const char* words :
       {"", "busy.toml --set physics.c=2", R"('it'\''s; a b.toml' --set 'camera.up=[0, 1, 0]')"}) {
    of.scene_words = words;
    EXPECT_EQ(refusal(of, *exposure), "") << words;
  }
  for (const char* words : {"a.toml; rm x", "a.toml\nrm x", "$(rm x)", "`rm x`", "'a.toml",
                            R"(a\ b)", R"(a.toml\)", "a > b", "a & b", "a | b"}) {
    of.scene_words = words;
    EXPECT_NE(refusal(of, *exposure).find("its words are not those of a command"),
              std::string::npos)
        << words;
  }
}

TEST(Partial, LayersThatAreNotFiniteAreRefused) {
  const auto exposure = begun(part_options(16));
  exposure->framebuffer().layers(1, 1)[0] = std::numeric_limits<float>::infinity();
  EXPECT_NE(refusal(provenance, *exposure).find("not a number"), std::string::npos);
}

TEST(Partial, SumsBeyondWhatSamplesCanGiveAreRefused) {
  for (const double light : {1e45, -1e45, 1e308}) {
    Exposure exposure(assignment_of(busy_world(), part_options(64, std::nullopt, {{1, 3}})));
    const TileWork work = exposure.work_on(0);
    Tally tally;
    tally.samples = work.samples;
    SampleSum sum(1);
    sum.add({light, 0, 0});
    sum.add({0, 0, 0});
    for_first_pixels(work, work.lit(work.total()),
                     [&](int x, int y) { exposure.framebuffer().set(x, y, sum); });
    exposure.note(0, {work.total(), {}}, tally, {});
    EXPECT_NE(refusal(provenance, exposure).find("not a number"), std::string::npos) << light;
  }
}

}  // namespace
}  // namespace portalens::test
