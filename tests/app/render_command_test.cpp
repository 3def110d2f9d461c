/// \file
/// `portalens render` from end to end: what it writes, what it says, and how it exits.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/exr_matrix.h"
#include "io/exr_texts.h"
#include "lanes/instruction_sets.h"
#include "math/vec3.h"
#include "support/pictures.h"
#include "support/run_program.h"
#include "support/tiny_scene.h"

namespace portalens {
namespace {

using nlohmann::json;

TEST(Render, WritesThePictureBesideTheUserAndSaysWhere) {
  const SceneFolder folder;
  std::filesystem::create_directory(folder.path() / "scenes");
  folder.write("scenes/tiny.toml", tiny);
  const Outcome outcome = run_portalens(folder.path(), {"render", "scenes/tiny.toml"});
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_NE(outcome.output.find("tiny.png"), std::string::npos);
  EXPECT_NE(outcome.output.find("hit"), std::string::npos) << "fates are reported";
  const Image image = picture_in(folder, "tiny.png");
  EXPECT_EQ(image.width, 8);
  EXPECT_EQ(image.height, 6);
}

TEST(Render, APngIsDevelopedAnExrKeepsTheLightAndPartsKeepBoth) {
  const SceneFolder folder;
  folder.write("tiny.toml", std::string(tiny));
  expect_done(folder, {"render", "tiny.toml", "-o", "plain.exr"});
  expect_done(folder, {"render", "tiny.toml", "-o", "dark.exr", "--exposure", "-2"});
  EXPECT_EQ(picture_in(folder, "dark.exr").pixels, picture_in(folder, "plain.exr").pixels);
  expect_done(folder,
              {"render", "tiny.toml", "-o", "dark.png", "--exposure", "-2", "--tone", "agx-like"});
  expect_done(folder,
              {"image", "plain.exr", "-o", "same.png", "--exposure", "-2", "--tone", "agx-like"});
  EXPECT_EQ(folder.read("dark.png"), folder.read("same.png"));
  expect_done(folder, {"render", "tiny.toml", "-o", "a.part", "--set", "film.exposure=-2", "--tone",
                       "agx-like"});
  expect_done(folder, {"merge", "a.part", "-o", "merged.png"});
  EXPECT_EQ(folder.read("merged.png"), folder.read("same.png"));
  const Outcome refused = run_portalens(folder.path(), {"render", "tiny.toml", "--tone", "fimlic"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.errors.find("did you mean filmic?"), std::string::npos) << refused.errors;
}

/// What the matrix makes of a place: x to the right, y up, z into the depth.
Vec3d seen_by(const ExrMatrix& matrix, Vec3d place) {
  const double row[] = {place.x, place.y, place.z, 1.0};
  double seen[3] = {};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t r = 0; r < 4; ++r) seen[c] += row[r] * double{matrix[4 * r + c]};
  return {seen[0], seen[1], seen[2]};
}

TEST(Render, AnExrTellsOtherProgramsWhereTheCameraStood) {
  const SceneFolder folder;
  folder.write("tiny.toml", std::string(tiny));
  const Outcome outcome =
      run_portalens(folder.path(), {"render", "tiny.toml", "-o", "a.exr", "--set",
                                    "camera.position=[3, 1, 4]", "--set", "camera.fov=90"});
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  const Outcome told = run_shell(folder.path(), "exrheader a.exr");
  EXPECT_NE(told.output.find("worldToCamera (type m44f)"), std::string::npos) << told.output;
  std::optional<ExrMatrix> matrix;
  for (const auto& [name, text] : read_exr_texts(folder.path() / "a.exr"))
    if (name == matrix_entry) matrix = matrix_in(text);
  ASSERT_TRUE(matrix);
  const Vec3d middle = seen_by(*matrix, {0, 0, 0});
  EXPECT_NEAR(middle.x, 0.0, 1e-6);
  EXPECT_NEAR(middle.y, 0.0, 1e-6);
  EXPECT_NEAR(middle.z, std::sqrt(26.0), 1e-6);
  EXPECT_GT(seen_by(*matrix, {0, 1, 0}).y, 0.9) << "up is up";
  EXPECT_GT(seen_by(*matrix, {1, 0, 0}).x, 0.5) << "and right is right";
}

TEST(Render, LayersAreWrittenToAnExrUnasked) {
  const SceneFolder folder;
  folder.write("tiny.toml", std::string(tiny));
  const Outcome outcome = run_portalens(folder.path(), {"render", "tiny.toml", "--layers", "all"});
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  Faults faults;
  const auto picture = read_channels(folder.path() / "tiny.exr", Location{}, faults);
  ASSERT_TRUE(picture);
  EXPECT_GT(picture->channels.size(), 10u);
}

TEST(Render, APictureThatAnotherProcessRendersIsLeftToIt) {
  const SceneFolder folder;
  folder.write("tiny.toml", std::string(tiny));
  const std::filesystem::path lock = folder.path() / ".tiny.png.lock";
  const int number = ::open(lock.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  ASSERT_EQ(::flock(number, LOCK_EX), 0);
  const Outcome refused = run_portalens(folder.path(), {"render", "tiny.toml"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.errors.find("tiny.png is being rendered by another process; wait"),
            std::string::npos)
      << refused.errors;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "tiny.png"));
  EXPECT_EQ(run_portalens(folder.path(), {"render", "tiny.toml", "-o", "other.png"}).code, 0);
  ::close(number);  // as the end of that process would
  EXPECT_EQ(run_portalens(folder.path(), {"render", "tiny.toml"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(lock)) << "nothing is left";
}

TEST(Render, DrawsNoProgressWhenPiped) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const Outcome outcome =
      run_portalens(folder.path(), {"render", "tiny.toml", "--set", "shading.ambient=[1, 1, 1]"});
  EXPECT_EQ(outcome.errors, "");
  EXPECT_EQ(outcome.output.find('\r'), std::string::npos);
}

TEST(Render, QuietPrintsNothing) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const Outcome outcome = run_portalens(folder.path(), {"render", "tiny.toml", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.output + outcome.errors, "");
}

TEST(Render, SaysByWhichEngineAndWhyWhereverItTellsOfThePicture) {
  const SceneFolder folder;
  folder.write("tiny.toml", std::string(tiny) + "[[mass]]\ncenter = [0, 0, 0]\nmass = 9\n");
  const std::vector<std::string> infinite = {"--set", "physics.min_force=0"};
  const auto outcome = [&](std::vector<std::string> words) {
    words.insert(words.end(), infinite.begin(), infinite.end());
    return run_portalens(folder.path(), words).output;
  };
  const char* why = "an influence is infinite (physics.min_force = 0";
  for (const std::string& text :
       {outcome({"check", "tiny.toml"}), outcome({"render", "tiny.toml", "--stats"})}) {
    EXPECT_NE(text.find("scalar, because " + std::string(why)), std::string::npos) << text;
    EXPECT_NE(text.find("all, because only lanes"), std::string::npos) << text;
  }
  for (const std::string& text : {outcome({"check", "tiny.toml", "--json"}),
                                  outcome({"render", "tiny.toml", "--json", "-o", "a.exr"})})
    EXPECT_NE(text.find("\"engine\":{\"name\":\"scalar\",\"because\":\"" + std::string(why)),
              std::string::npos)
        << text;
  EXPECT_NE(folder.read("a.exr").find(why), std::string::npos);
  EXPECT_NE(run_portalens(folder.path(), {"check", "tiny.toml"}).output.find("engine      lanes"),
            std::string::npos);
  const Outcome forced =
      run_shell(folder.path(), "PORTALENS_ISA=avx3" + quoted({PORTALENS_PROGRAM, "check"}) +
                                   quoted({"tiny.toml"}));
  EXPECT_NE(forced.output.find("because PORTALENS_ISA asks for 'avx3', which this processor"),
            std::string::npos)
      << forced.output;
}

TEST(Render, SaysWhereProcessorsWithoutFmaGiveOtherBits) {
  if (!lane_engine("sse4-plain").step) GTEST_SKIP() << "this processor has no SSE 4.2";
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const auto told = [&](const std::string& set, const std::vector<std::string>& words) {
    const Outcome outcome = run_shell(
        folder.path(), "PORTALENS_ISA=" + set + quoted({PORTALENS_PROGRAM}) + quoted(words));
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    return outcome.output.find("products and sums are rounded apart") != std::string::npos;
  };
  for (const std::vector<std::string>& words : {std::vector<std::string>{"check", "tiny.toml"},
                                                {"check", "tiny.toml", "--json"},
                                                {"render", "tiny.toml", "--stats", "-o", "a.exr"},
                                                {"render", "tiny.toml", "--json", "-o", "b.exr"}}) {
    EXPECT_TRUE(told("sse4-plain", words));
    EXPECT_FALSE(told("sse4", words));
  }
}

TEST(Render, OptionsStandAboveTheFile) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  const Outcome outcome = run_portalens(
      folder.path(), {"render", "tiny.toml", "--width", "5", "--height", "4", "--samples", "3",
                      "--set", "environment.color=[1.0, 1.0, 1.0]", "--set", "sampler.seed=9", "-o",
                      "big.exr", "--json", "-t", "2", "--tile", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.errors;
  const json told = json::parse(outcome.output);
  EXPECT_EQ(told["width"], 5);
  EXPECT_EQ(told["height"], 4);
  EXPECT_EQ(told["samples"], 5 * 4 * 3);
  EXPECT_EQ(told["picture"], "big.exr");
  EXPECT_EQ(told["complete"], true);
  std::uint64_t sum = 0;
  for (const auto& [fate, count] : told["fates"].items()) sum += count.get<std::uint64_t>();
  EXPECT_EQ(sum, told["photons"]);
  EXPECT_EQ(picture_in(folder, "big.exr").at(0, 0)[0], 1.0f);
}

TEST(Render, APictureKeepsItsShapeWhereOnlyOneSideIsGiven) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);  // 8 x 6
  struct Given {
    std::vector<std::string> words;
    int width, height;
  };
  for (const Given& given :
       {Given{{"--width", "16"}, 16, 12}, Given{{"--height", "3"}, 4, 3},
        Given{{"--width", "1"}, 1, 1}, Given{{"--width", "16", "--set", "film.height=5"}, 16, 5},
        Given{{"--set", "film.width=16"}, 16, 6},
        Given{{"--set", "film.width=24", "--height", "2"}, 24, 2}}) {
    std::vector<std::string> words = {"render", "tiny.toml", "--json"};
    words.insert(words.end(), given.words.begin(), given.words.end());
    const Outcome outcome = run_portalens(folder.path(), words);
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_EQ(json::parse(outcome.output)["width"], given.width) << quoted(words);
    EXPECT_EQ(json::parse(outcome.output)["height"], given.height) << quoted(words);
  }
}

TEST(Render, ACropIsThePartOfTheWholePicture) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  ASSERT_EQ(run_portalens(folder.path(), {"render", "tiny.toml", "-o", "whole.exr"}).code, 0);
  ASSERT_EQ(run_portalens(folder.path(),
                          {"render", "tiny.toml", "-o", "part.exr", "--crop", "2", "1", "7", "5"})
                .code,
            0);
  const Image whole = picture_in(folder, "whole.exr"), part = picture_in(folder, "part.exr");
  ASSERT_EQ(part.width, 5);
  ASSERT_EQ(part.height, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      for (int channel = 0; channel < 3; ++channel)
        ASSERT_EQ(part.at(x, y)[channel], whole.at(x + 2, y + 1)[channel]);
}

TEST(Render, TheSameSceneGivesTheSameFile) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  for (const char* kind : {".exr", ".png"}) {
    const std::string a = std::string("a") + kind, b = std::string("b") + kind;
    ASSERT_EQ(run_portalens(folder.path(), {"render", "tiny.toml", "-o", a, "-t", "1"}).code, 0);
    ASSERT_EQ(run_portalens(folder.path(), {"render", "tiny.toml", "-o", b, "-t", "3"}).code, 0);
    EXPECT_EQ(folder.read(a), folder.read(b));
  }
}

TEST(Render, FaultsOfTheSceneAreAllToldByLineAndNothingIsWritten) {
  const SceneFolder folder;
  folder.write("bad.toml", R"([camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
fof = 30
[film]
width = -3
[[sphere]]
center = [0, 0, 0]
radius = "big"
material = "nowhere"
)");
  for (const char* command : {"render", "check"}) {
    const Outcome outcome = run_portalens(folder.path(), {command, "bad.toml"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.output, "");
    for (const char* line : {"bad.toml:4: ", "bad.toml:6: ", "bad.toml:9: ", "bad.toml:10: "})
      EXPECT_NE(outcome.errors.find(line), std::string::npos) << line << outcome.errors;
  }
  EXPECT_EQ(folder.size(), 1u);
}

TEST(Render, APlaceThatCantBeWrittenIsToldBeforeTheWork) {
  const SceneFolder folder;
  // Were it rendered first, this would take hours.
  folder.write("long.toml", tiny + "[[sphere]]\ncenter = [3, 0, 0]\nradius = 1\n");
  for (const char* place : {"no/such/folder/a.png", "a.tiff", "/proc/a.png"}) {
    const Outcome outcome =
        run_portalens(folder.path(), {"render", "long.toml", "--width", "30000", "--height",
                                      "30000", "--samples", "1000", "-o", place});
    EXPECT_EQ(outcome.code, place == std::string("a.tiff") ? 2 : 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find(place), std::string::npos) << outcome.errors;
  }
  EXPECT_EQ(folder.size(), 1u);
}

/// Interrupted once it listens (the kernel tells which signals it catches), long before its end.
TEST(Render, AnInterruptLeavesTheOldPictureWholeAndSaysWhatStands) {
  const SceneFolder folder;
  folder.write("tiny.toml", tiny);
  folder.write("out.exr", "old");
  const Outcome outcome = run_shell(
      folder.path(),
      quoted({PORTALENS_PROGRAM}) +
          " render tiny.toml -o out.exr --width 500 --height 500 --samples 100000 --tile 1 & p=$!; "
          "until grep -qE 'SigCgt:.*[4567cdef][0-9a-f]{3}$' /proc/$p/status; do :; done; "
          "kill -TERM $p; wait $p; echo code $?");
  EXPECT_EQ(folder.read("out.exr"), "old");
  EXPECT_NE(outcome.output.find("code 143"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.errors.find("interrupted"), std::string::npos) << outcome.errors;
  EXPECT_EQ(folder.size(), 4u) << "the checkpoint and the unfinished picture are added";
  EXPECT_EQ(picture_in(folder, "out.unfinished.exr").width, 500);
}

}  // namespace
}  // namespace portalens
