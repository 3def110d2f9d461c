/// \file
/// Renders that are killed, ended and gone on with: nothing that stood is lost, and the picture is
/// the same bits as if nothing had happened. docs/reliability.md names the promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "io/image.h"
#include "lanes/instruction_sets.h"
#include "math/random.h"
#include "render/partial.h"
#include "support/busy_scene.h"
#include "support/child.h"
#include "support/run_program.h"
#include "support/sanitized.h"
#include "support/scale.h"

namespace portalens::test {
namespace {

namespace fs = std::filesystem;

/// By how much a build is slower than one without sanitizers.
double slowness() { return sanitized ? 5.0 : 1.0; }

/// One render; long enough to be met on its way, with layers, and samples in the middle of pixels.
struct Asked {
  std::string output = "a.exr", samples = sanitized ? "30" : "120", layers = "depth,order";
};

std::vector<std::string> words(const Asked& asked = {}) {
  return {"render",      "busy.toml", "-o",         asked.output, "--samples",
          asked.samples, "--layers",  asked.layers, "--tile",     "16"};
}

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The command on that many threads.
std::vector<std::string> on_threads(int threads, const std::vector<std::string>& more = {}) {
  return with(with(words(), {"--threads", std::to_string(threads)}), more);
}

class Interruption : public testing::Test {
 protected:
  /// The picture that all must come to, and how long the program listens until it stands.
  static void SetUpTestSuite() {
    const SceneFolder folder;
    folder.write("busy.toml", busy_scene);
    Child child(folder.path(), words());
    ASSERT_TRUE(child.wait_until_it_listens());
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(child.wait(), 0);
    whole_seconds = seconds_since(start);
    whole = folder.read("a.exr");
  }

  Interruption() {
    folder_.write("busy.toml", busy_scene);
    folder_.write("a.exr", "the old picture");
  }

  [[nodiscard]] bool has_checkpoint() const {
    return fs::exists(folder_.path() / "a.exr.checkpoint");
  }

  /// Goes on with a checkpoint, if there is one, to the end.
  void expect_the_rest(int threads) {
    const Outcome outcome = has_checkpoint()
                                ? run_portalens(folder_.path(), on_threads(threads, {"--resume"}))
                                : run_portalens(folder_.path(), on_threads(threads));
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_TRUE(folder_.read("a.exr") == whole) << "the picture is not the uninterrupted one";
    EXPECT_FALSE(has_checkpoint()) << "a finished render needs none";
  }

  SceneFolder folder_;
  static std::string whole;
  static double whole_seconds;
};
std::string Interruption::whole;
double Interruption::whole_seconds = 0.0;

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

TEST_F(Interruption, AKillAtAnyMomentLeavesWholeFilesAndTheSameBitsComeOfThem) {
  int resumed = 0;
  const int kills = test_scale() >= 10.0 ? 100 : 4;
  for (int trial = 0; trial < kills; ++trial) {
    folder_.write("a.exr", "the old picture");
    Child child(folder_.path(), on_threads(1 + trial % 3, {"--checkpoint", "0.01"}));
    if (trial % 10 != 9) child.wait_until_it_listens();
    sleep(random_number(1, trial) * whole_seconds);
    child.send(SIGKILL);
    child.wait();
    const std::string picture = folder_.read("a.exr");
    EXPECT_TRUE(picture == "the old picture" || picture == whole) << "trial " << trial;
    if (has_checkpoint()) {
      ++resumed;
      EXPECT_NO_THROW((void)PartialFile(folder_.path() / "a.exr.checkpoint").exposure());
    }
    expect_the_rest(1 + (trial + 1) % 3);
  }
  std::cout << kills << " kills, " << resumed << " of them left a checkpoint\n";
}

TEST_F(Interruption, AnEndAtAnyMomentKeepsTheWorkWithinSeconds) {
  double slowest = 0.0;
  int caught = 0;
  const int signals = test_scale() >= 10.0 ? 50 : 2;
  for (int trial = 0; trial < signals; ++trial) {
    const int signal = trial % 2 == 0 ? SIGINT : SIGTERM;
    folder_.write("a.exr", "the old picture");
    fs::remove(folder_.path() / "a.unfinished.exr");
    Child child(folder_.path(), on_threads(1 + trial % 3));
    if (child.wait_until_it_listens()) sleep(random_number(2, trial) * whole_seconds);
    const auto start = std::chrono::steady_clock::now();
    child.send(signal);
    const int code = child.wait();
    const double seconds = seconds_since(start);
    slowest = std::max(slowest, seconds);
    EXPECT_LT(seconds, 5.0 * slowness());
    // One that comes when all is done may still end the program on its way out.
    if (code != 0 && folder_.read("a.exr") != whole) {
      ++caught;
      EXPECT_EQ(code, 128 + signal) << folder_.read("said");
      EXPECT_TRUE(folder_.read("a.exr") == "the old picture");
      EXPECT_TRUE(has_checkpoint());
      Faults faults;
      EXPECT_TRUE(read_channels(folder_.path() / "a.unfinished.exr", {}, faults));
    }
    expect_the_rest(1 + (trial + 1) % 3);
  }
  std::cout << signals << " signals, " << caught << " of them before the end; the slowest answer "
            << "took " << slowest << " s\n";
}

/// A photon of this scene takes longer than anyone waits.
const std::string slow_scene = R"([camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
[film]
width = 40
height = 30
[physics]
integrator = "euler"
step = 1e-9
max_steps = 1000000000
[[mass]]
name = "hole"
center = [0, 0, 0]
mass = 100
)";

TEST_F(Interruption, PhotonsThatTakeTooLongAreNotWaitedFor) {
  folder_.write("slow.toml", slow_scene);
  Child child(folder_.path(), {"render", "slow.toml", "-o", "slow.png"});
  ASSERT_TRUE(child.wait_until_it_listens());
  sleep(0.5 * slowness());
  const auto start = std::chrono::steady_clock::now();
  child.send(SIGINT);
  EXPECT_EQ(child.wait(), 130);
  EXPECT_LT(seconds_since(start), 5.0 * slowness());
  EXPECT_TRUE(fs::exists(folder_.path() / "slow.png.checkpoint"));
  EXPECT_TRUE(fs::exists(folder_.path() / "slow.unfinished.png"));
}

TEST_F(Interruption, ASecondInterruptEndsAtOnce) {
  folder_.write("slow.toml", slow_scene);
  Child child(folder_.path(), {"render", "slow.toml", "-o", "slow.png"});
  ASSERT_TRUE(child.wait_until_it_listens());
  sleep(0.5 * slowness());  // the photons are under way
  child.send(SIGINT);
  sleep(0.05);
  child.send(SIGINT);
  EXPECT_EQ(child.wait(), 130);
  EXPECT_FALSE(fs::exists(folder_.path() / "slow.png.checkpoint"));
}

TEST_F(Interruption, ALookAtWhatStandsLetsTheRenderGoOn) {
  Child child(folder_.path(), on_threads(2));
  ASSERT_TRUE(child.wait_until_it_listens());
  child.send(SIGUSR1);
  EXPECT_EQ(child.wait(), 0);
  EXPECT_TRUE(folder_.read("a.exr") == whole);
  EXPECT_NE(folder_.read("said").find("what stands is in a.unfinished.exr"), std::string::npos)
      << folder_.read("said");
  EXPECT_FALSE(fs::exists(folder_.path() / "a.unfinished.exr")) << "the whole one is there";
  EXPECT_FALSE(has_checkpoint());
}

/// A render that was interrupted before much stood.
class Resume : public Interruption {
 protected:
  Resume() {
    Child child(folder_.path(), words(long_));
    EXPECT_TRUE(child.wait_until_it_listens());
    child.send(SIGTERM);
    EXPECT_EQ(child.wait(), 143);
    EXPECT_TRUE(has_checkpoint());
    checkpoint_ = folder_.read("a.exr.checkpoint");
  }

  void expect_refused(const std::vector<std::string>& words, const std::string& reason) const {
    const Outcome outcome = run_portalens(folder_.path(), words);
    EXPECT_EQ(outcome.code, 2) << outcome.errors;
    EXPECT_NE(outcome.errors.find(reason), std::string::npos)
        << reason << " is not in: " << outcome.errors;
    EXPECT_TRUE(folder_.read("a.exr.checkpoint") == checkpoint_) << "the checkpoint changed";
  }

  const Asked long_{"a.exr", "100000"};
  const std::vector<std::string> same_ = with(words(long_), {"--resume"});
  std::string checkpoint_;
};

TEST_F(Resume, IsRefusedForAnotherSceneSettingOrPartWithTheDifferenceNamed) {
  for (const auto& [more, reason] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--set", "physics.tolerance=0.002"},
            "physics.tolerance was '0.001', and is '0.002' now"},
           {{"--width", "54"}, "film.width was '53', and is '54' now"},
           {{"--crop", "0", "0", "10", "10"},
            "--crop was 'the whole picture', and is '0 0 10 10' now"},
           {{"--engine", "scalar"}, "and is 'scalar' now"},
           {{"--set", "physics.c=2"}, "physics.c was 'not set', and is '2' now"}})
    expect_refused(with(same_, more), reason);
  expect_refused(with(words({"a.exr", "100001"}), {"--resume"}),
                 "sampler.samples was '100000', and is '100001' now");
  expect_refused(with(words({"a.exr", "100000", "fate"}), {"--resume"}),
                 "--layers was 'depth,order', and is 'fate' now");

  std::string other = busy_scene;
  other.replace(other.find("radius = 0.6"), 12, "radius = 0.7");
  folder_.write("busy.toml", other);
  expect_refused(same_, "sphere 'ball'.radius was '0.6', and is '0.7' now");
  folder_.write("busy.toml", "# another comment, and the same scene\n" + std::string(busy_scene));
  Child child(folder_.path(), same_);
  EXPECT_TRUE(child.wait_until_it_listens());
}

TEST_F(Resume, IsRefusedForAnotherKindOfProcessor) {
  if (lane_engine().name == "sse4" || !lane_engine().step)
    GTEST_SKIP() << "this processor has no other kind to be";
  const std::string program = "PORTALENS_ISA=sse4 " + quoted({PORTALENS_PROGRAM});
  const Outcome outcome = run_shell(folder_.path(), program + quoted(same_));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.errors.find("the engine was 'lanes of avx"), std::string::npos)
      << outcome.errors;
}

TEST_F(Resume, IsNeverARestartUnasked) {
  expect_refused(words(long_), "the checkpoint of an earlier render lies there");
  EXPECT_EQ(run_portalens(folder_.path(), with(words(), {"--restart"})).code, 0);
  EXPECT_TRUE(folder_.read("a.exr") == whole);
  const Outcome outcome = run_portalens(folder_.path(), same_);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.errors.find("there is no checkpoint to resume from"), std::string::npos);
}

TEST_F(Resume, IsRefusedFromADamagedCheckpoint) {
  for (const std::string& damaged :
       {std::string(), std::string("nothing of the kind"), checkpoint_.substr(0, 1000),
        checkpoint_.substr(0, checkpoint_.size() - 1), checkpoint_ + " "}) {
    checkpoint_ = damaged;
    folder_.write("a.exr.checkpoint", damaged);
    expect_refused(same_, "a.exr.checkpoint: it");
  }
}

TEST_F(Interruption, CropsAndRangesOfSamplesMergeToTheSameFile) {
  std::vector<std::string> merge = {"merge", "-o", "m.exr", "-q"};
  const auto part = [&](const std::vector<std::string>& more) {
    const std::string name = std::to_string(merge.size()) + ".part";
    const Outcome outcome = run_portalens(folder_.path(), with(words({name}), with({"-q"}, more)));
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    merge.insert(merge.begin() + 1 + static_cast<long>(merge.size() * 7 % (merge.size() - 3)),
                 name);
  };
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const auto at = [](int of, int i) { return std::to_string(of * i / 3); };
      const std::vector<std::string> crop = {"--crop", at(53, column), at(29, row),
                                             at(53, column + 1), at(29, row + 1)};
      if (row == 1 && column == 1) {
        part(with(crop, {"--samples-from", "17"}));
        part(with(crop, {"--samples-to", "17"}));
      } else {
        part(crop);
      }
    }
  const Outcome outcome = run_portalens(folder_.path(), merge);
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
  EXPECT_TRUE(folder_.read("m.exr") == whole);
  merge.erase(merge.begin() + 1);
  EXPECT_EQ(run_portalens(folder_.path(), merge).code, 2);
}

TEST_F(Interruption, SamplesOfAPixelAreNoPicture) {
  const Outcome outcome = run_portalens(folder_.path(), with(words(), {"--samples-to", "3"}));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.errors.find(".part"), std::string::npos) << outcome.errors;
}

}  // namespace
}  // namespace portalens::test
