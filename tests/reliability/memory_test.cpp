// What a picture takes of memory is told before it is begun, and where there is too little of it
// the program says so and ends in good order.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/sanitized.h"

namespace portalens {
namespace {

std::string scene_of(int width, int height, const std::string& more = "") {
  return fmt::format(
             "[camera]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n[film]\nwidth = {}\nheight = "
             "{}\n"
             "[sampler]\nsamples = 1\n",
             width, height) +
         more;
}

/// The estimate of `check`, bytes.
double estimated(const SceneFolder& folder) {
  const Outcome check = run_portalens(folder.path(), {"check", "scene.toml", "--json"});
  EXPECT_EQ(check.code, 0) << check.errors;
  return nlohmann::json::parse(check.output).at("memory").at("bytes").get<double>();
}

/// The most resident memory that a run of the program takes, bytes.
double taken(const SceneFolder& folder, const std::string& picture,
             const std::vector<std::string>& options = {}) {
  std::vector<std::string> words = {"portalens", "render",
                                    "-q",        (folder.path() / "scene.toml").string(),
                                    "-o",        (folder.path() / picture).string()};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::execv(PORTALENS_PROGRAM, arguments.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  EXPECT_EQ(::wait4(child, &status, 0, &usage), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// A wavy sheet of 2 n² triangles.
std::string sheet(int n) {
  std::string text;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k)
      text += fmt::format("v {} {} {}\n", i, k, (i * 7919 + k * 104729) % 97 / 97.0);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const int at = i * (n + 1) + k + 1;
      text += fmt::format("f {} {} {} {}\n", at, at + 1, at + n + 2, at + n + 1);
    }
  return text;
}

void expect_near(const SceneFolder& folder, const std::string& picture) {
  const double expected = estimated(folder), found = taken(folder, picture);
  EXPECT_LT(found, 1.3 * expected) << picture;
  EXPECT_GT(found, expected / 3.0) << picture;
}

TEST(Memory, TheEstimateIsWithinReachOfWhatIsTaken) {
  if (sanitized) GTEST_SKIP() << "a sanitizer takes memory of its own";
  const SceneFolder folder;
  folder.write("scene.toml", scene_of(16, 16));
  expect_near(folder, "small.png");
  folder.write("scene.toml", scene_of(1200, 900));
  expect_near(folder, "large.exr");
  expect_near(folder, "large.png");
  folder.write("sheet.obj", sheet(300));
  folder.write("scene.toml", scene_of(16, 16, "[[mesh]]\nfile = \"sheet.obj\"\n"));
  expect_near(folder, "mesh.png");
}

TEST(Memory, TheEstimateCountsTheSumsOfSamples) {
  if (sanitized) GTEST_SKIP() << "a sanitizer takes memory of its own";
  const SceneFolder folder;
  folder.write("scene.toml", scene_of(700, 700));
  // The samples 1 to 15 of 16 are six nodes of their tree.
  const std::vector<std::string> options = {"--samples", "16",           "--samples-from",
                                            "1",         "--samples-to", "15"};
  std::vector<std::string> words = {"render", "--stats", "scene.toml", "-o", "a.part"};
  words.insert(words.end(), options.begin(), options.end());
  const std::string said = run_portalens(folder.path(), words).errors;
  const std::size_t at = said.find("about ");
  ASSERT_NE(at, std::string::npos) << said;
  const double expected = std::stod(said.substr(at + 6)) * (1 << 20);
  const double found = taken(folder, "b.part", options);
  EXPECT_LT(found, 1.1 * expected) << said;
  EXPECT_GT(found, expected / 2.0) << said;
}

TEST(Memory, APictureThatDoesNotFitIsRefusedWithAWayOut) {
  if (sanitized) GTEST_SKIP() << "a sanitizer takes address space without end";
  const SceneFolder folder;
  folder.write("scene.toml", scene_of(16000, 16000));
  const Outcome outcome =
      run_shell(folder.path(),
                "ulimit -v 4000000; exec" + quoted({PORTALENS_PROGRAM, "render", "scene.toml"}));
  EXPECT_EQ(outcome.code, 2) << outcome.errors;
  EXPECT_NE(outcome.errors.find("of memory"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("--crop"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "scene.png"));
}

TEST(Memory, WhereItRunsOutTheProgramSaysSoAndTheOldPictureStays) {
  if (sanitized) GTEST_SKIP() << "a sanitizer takes address space without end";
  const SceneFolder folder;
  folder.write("sheet.obj", sheet(200));
  folder.write("scene.toml", scene_of(600, 400, "[[mesh]]\nfile = \"sheet.obj\"\n"));
  folder.write("scene.png", "the old picture");
  int refused = 0, done = 0;
  // With less the system's loader gives up before the program's first line.
  const auto under = [&](int megabytes, const std::vector<std::string>& words) {
    return run_shell(folder.path(), fmt::format("ulimit -v {}; exec", 1024 * megabytes) +
                                        quoted({PORTALENS_PROGRAM}) + quoted(words));
  };
  int least = 20;
  while (least < 4000 && under(least, {"--version"}).code != 0) least += 20;
  for (int megabytes = least; megabytes <= least + 400; megabytes += 40) {
    const Outcome outcome =
        under(megabytes, {"render", "-q", "-t", "2", "--restart", "scene.toml", "-o", "scene.png"});
    if (outcome.code == 0) {
      ++done;
      folder.write("scene.png", "the old picture");
      continue;
    }
    ++refused;
    EXPECT_TRUE(outcome.code == 1 || outcome.code == 2)
        << megabytes << " MiB: " << outcome.code << " " << outcome.errors;
    EXPECT_NE(outcome.errors.find("memory"), std::string::npos)
        << megabytes << " MiB: " << outcome.errors;
    EXPECT_EQ(folder.read("scene.png"), "the old picture") << megabytes;
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(done, 0);
}

}  // namespace
}  // namespace portalens
