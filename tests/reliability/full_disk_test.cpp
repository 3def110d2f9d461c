// A disk that fills while a picture is written: the program says so and fails, and the old picture
// stays as it was. Once on a small file system of its own, once against a limit on the file's size.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "support/run_program.h"
#include "support/scale.h"

namespace portalens {
namespace {

/// A picture that hardly compresses: 196 KB as EXR.
const std::string scene = R"([camera]
position = [0, 1, 6]
look_at = [0, 0, 0]
[film]
width = 160
height = 120
[sampler]
samples = 1
[[material]]
name = "shiny"
diffuse = [0.4, 0.3, 0.2]
reflective = [0.5, 0.5, 0.5]
roughness = 0.4
[[quad]]
vertices = [[-9,-1,-9],[-9,-1,9],[9,-1,9],[9,-1,-9]]
material = "shiny"
[[sphere]]
center = [0, 0, 0]
radius = 1
material = "shiny"
[[light]]
position = [3, 4, 5]
intensity = [60, 50, 40]
)";

/// What happened at one size: the exit code, whether the old picture was intact, how many files lie
/// where it lies, and what was said.
struct Attempt {
  int size = 0, code = -1, intact = 0, files = 0;
  std::string said;
};

/// How large the picture is of which the tests try parts.
int size_of_picture(const SceneFolder& folder, const std::string& name) {
  folder.write("scene.toml", scene);
  EXPECT_EQ(run_portalens(folder.path(), {"render", "-q", "scene.toml", "-o", name}).code, 0);
  return static_cast<int>(std::filesystem::file_size(folder.path() / name));
}

/// Reads the lines `size code intact files said` that the scripts print.
std::vector<Attempt> attempts_in(const std::string& output) {
  std::vector<Attempt> attempts;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    Attempt attempt;
    words >> attempt.size >> attempt.code >> attempt.intact >> attempt.files;
    std::getline(words, attempt.said);
    attempts.push_back(attempt);
  }
  return attempts;
}

void expect_all_failed_well(const std::vector<Attempt>& attempts, std::size_t count,
                            const std::string& cause) {
  EXPECT_EQ(attempts.size(), count);
  for (const Attempt& attempt : attempts) {
    EXPECT_EQ(attempt.code, 1) << "at " << attempt.size << " bytes:" << attempt.said;
    EXPECT_EQ(attempt.intact, 1) << "at " << attempt.size;
    EXPECT_EQ(attempt.files, 1) << "at " << attempt.size;
    EXPECT_NE(attempt.said.find("can't write"), std::string::npos) << attempt.said;
    EXPECT_NE(attempt.said.find(cause), std::string::npos) << attempt.said;
  }
}

/// Sizes from 0 to just below `size`, evenly.
std::string sizes(int size, int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += " " + std::to_string(static_cast<int>(1.0 * (size - 1) * i / std::max(1, count - 1)));
  return text;
}

/// 50 in a long run, a few else.
int trials() { return test::test_scale() >= 10.0 ? 50 : 3; }

const std::string program = PORTALENS_PROGRAM;

/// One shell function for both tests: renders over an old picture, and prints an `Attempt`.
const std::string attempt_function =
    R"(
attempt() {  # SIZE FOLDER NAME
  said=$(")" +
    program + R"(" render -q scene.toml -t 1 -o "$2/$3" 2>&1 | tr '\n' ' '; exit ${PIPESTATUS[0]})
  code=$?
  intact=0; cmp -s "$2/$3" old && intact=1
  echo "$1 $code $intact $(ls -A "$2" | grep -vc filler) $said"
}
)";

void fill_a_disk(const std::string& name) {
  const SceneFolder folder;
  const int size = size_of_picture(folder, name);
  folder.write("old", "the old picture");
  // A block more than `size` bytes take is left free: the old picture's own.
  const std::string script = attempt_function + R"(
mkdir disk && mount -t tmpfs -o size=4m tmpfs disk || { echo cannot; exit 0; }
for size in)" + sizes(size, trials()) +
                             R"(; do
  rm -f disk/*; cp old "disk/)" +
                             name + R"("
  head -c $((4 * 1048576 - 4096 - size / 4096 * 4096)) /dev/zero > disk/filler
  attempt $size disk )" + name +
                             R"(
done
umount disk
)";
  folder.write("script", script);
  const Outcome outcome =
      run_shell(folder.path(), "unshare --user --map-root-user --mount bash script || echo cannot");
  if (outcome.output.find("cannot") != std::string::npos)
    GTEST_SKIP() << "no file system of its own may be mounted here: " << outcome.errors;
  expect_all_failed_well(attempts_in(outcome.output), static_cast<std::size_t>(trials()),
                         "No space left");
}

void limit_the_file(const std::string& name) {
  const SceneFolder folder;
  const int size = size_of_picture(folder, name);
  folder.write("old", "the old picture");
  folder.write("script", attempt_function + R"(
trap '' XFSZ
mkdir disk
for size in)" + sizes(size, trials()) +
                             R"(; do
  cp old "disk/)" + name + R"("
  limit=$((size / 512))
  (set -o posix; ulimit -f $limit; set +o posix; attempt $size disk )" +
                             name + R"( ) | cat
done
)");
  const Outcome outcome = run_shell(folder.path(), "bash script");
  expect_all_failed_well(attempts_in(outcome.output), static_cast<std::size_t>(trials()),
                         "File too large");
}

TEST(FullDisk, LeavesTheOldExrAndSaysSo) { fill_a_disk("picture.exr"); }
TEST(FullDisk, LeavesTheOldPngAndSaysSo) { fill_a_disk("picture.png"); }
TEST(FullDisk, AnExrTooLargeForItsLimitLeavesTheOldOne) { limit_the_file("picture.exr"); }
TEST(FullDisk, APngTooLargeForItsLimitLeavesTheOldOne) { limit_the_file("picture.png"); }

}  // namespace
}  // namespace portalens
