// Arrivals that are kept are those that were computed, and what is not sound is computed again.
#include "support/arrival_cache.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace portalens::benchmarks {
namespace {

class ArrivalsKept : public testing::Test {
 protected:
  ArrivalsKept() {
    std::string pattern = (std::filesystem::temp_directory_path() / "portalens-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    for (int i = 0; i < 5; ++i) {
      Photon photon;
      photon.position = {1.0 * i, 0.5, -2.0};
      photon.direction = {0, 0, -1};
      photons_.push_back(photon);
    }
  }
  ~ArrivalsKept() override { std::filesystem::remove_all(folder_); }

  /// Asks the cache; `computed_` counts how often that led to work.
  std::vector<Arrival> ask(const std::string& recipe) {
    return ArrivalCache(folder_).arrivals(
        recipe, photons_, [this](std::span<const Photon> photons, std::span<Arrival> arrivals) {
          ++computed_;
          for (std::size_t i = 0; i < photons.size(); ++i) arrivals[i] = arrival_of(photons[i]);
        });
  }
  static Arrival arrival_of(const Photon& photon) {
    Arrival arrival;
    arrival.fate = Fate::hit;
    arrival.met = Met::portal_back;
    arrival.object = 7;
    arrival.face = 3;
    arrival.position = photon.position * (1.0 / 3.0);
    arrival.direction = photon.direction;
    arrival.tint = {0.25, 0.5, 1.0};
    arrival.length = 12.5;
    arrival.turning = 0.125;
    arrival.steps = 44;
    arrival.crossings = 2;
    return arrival;
  }
  void expect_sound(const std::vector<Arrival>& arrivals) const {
    ASSERT_EQ(arrivals.size(), photons_.size());
    for (std::size_t i = 0; i < arrivals.size(); ++i) {
      const Arrival expected = arrival_of(photons_[i]);
      const Arrival& found = arrivals[i];
      EXPECT_EQ(found.fate, expected.fate);
      EXPECT_EQ(found.met, expected.met);
      EXPECT_EQ(found.object, expected.object);
      EXPECT_EQ(found.face, expected.face);
      EXPECT_EQ(found.position, expected.position);
      EXPECT_EQ(found.direction, expected.direction);
      EXPECT_EQ(found.tint, expected.tint);
      EXPECT_EQ(found.length, expected.length);
      EXPECT_EQ(found.turning, expected.turning);
      EXPECT_EQ(found.steps, expected.steps);
      EXPECT_EQ(found.crossings, expected.crossings);
    }
  }
  [[nodiscard]] std::string bytes(const std::string& recipe) const {
    std::ifstream stream(ArrivalCache(folder_).file(recipe, photons_), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void put(const std::string& recipe, const std::string& bytes) const {
    std::ofstream(ArrivalCache(folder_).file(recipe, photons_), std::ios::binary) << bytes;
  }

  std::filesystem::path folder_;
  std::vector<Photon> photons_;
  int computed_ = 0;
};

TEST_F(ArrivalsKept, AreComputedOnceAndComeBackToTheBit) {
  expect_sound(ask("scene"));
  expect_sound(ask("scene"));
  EXPECT_EQ(computed_, 1);
}

TEST_F(ArrivalsKept, BelongToTheirRecipeAndPhotons) {
  ask("scene");
  ask("another scene");
  EXPECT_EQ(computed_, 2);
  photons_.back().direction = {0, 1, 0};
  expect_sound(ask("scene"));
  EXPECT_EQ(computed_, 3);
}

TEST_F(ArrivalsKept, AreComputedAgainWhereverAByteOfTheFileIsDamaged) {
  ask("scene");
  const std::string sound = bytes("scene");
  ASSERT_GT(sound.size(), 100u);
  int expected = 1;
  for (std::size_t i = 0; i < sound.size(); i += 13) {
    std::string damaged = sound;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    put("scene", damaged);
    expect_sound(ask("scene"));
    EXPECT_EQ(computed_, ++expected) << "byte " << i;
  }
  EXPECT_EQ(bytes("scene"), sound);
}

TEST_F(ArrivalsKept, AreComputedAgainWhereTheFileIsCutOrLengthened) {
  ask("scene");
  const std::string sound = bytes("scene");
  int expected = 1;
  for (const std::string& wrong :
       {std::string(), sound.substr(0, 10), sound.substr(0, sound.size() - 1), sound + "x"}) {
    put("scene", wrong);
    expect_sound(ask("scene"));
    EXPECT_EQ(computed_, ++expected);
  }
}

TEST_F(ArrivalsKept, AreComputedAgainWhereTheFileIsAnothers) {
  ask("scene");
  ask("another scene");
  put("scene", bytes("another scene"));
  expect_sound(ask("scene"));
  EXPECT_EQ(computed_, 3);
}

TEST_F(ArrivalsKept, AreStillGivenWhereTheyCannotBeKept) {
  folder_ /= "file";
  std::ofstream(folder_) << "no folder";
  expect_sound(ask("scene"));
}

}  // namespace
}  // namespace portalens::benchmarks
