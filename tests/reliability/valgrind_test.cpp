// The program under valgrind, where there is one: no read of what was never written, nothing lost.
#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/sanitized.h"
#include "support/scale.h"

namespace portalens {
namespace {

TEST(Valgrind, FindsNothingInARender) {
  const SceneFolder folder;
  if (test::test_scale() < 10.0) GTEST_SKIP() << "a long test; PORTALENS_TEST_SCALE=10 takes it";
  if (sanitized || run_shell(folder.path(), "valgrind --version").code != 0)
    GTEST_SKIP() << "no valgrind here, or a sanitizer in its place";
  folder.write("scene.toml", R"([camera]
position = [0, 1, 6]
look_at = [0, 0, 0]
[film]
width = 24
height = 16
[sampler]
samples = 1
[[mass]]
center = [0, 0, 0]
mass = 100
[[quad]]
vertices = [[-9,-1,-9],[-9,-1,9],[9,-1,9],[9,-1,-9]]
[[cube]]
center = [1, 0, -2]
size = 1
[[light]]
position = [3, 4, 5]
intensity = [60, 50, 40]
[[portal]]
name = "a"
pair = "b"
vertices = [[-1,-1,1], [1,-1,1], [1,1,1], [-1,1,1]]
[[portal]]
name = "b"
pair = "a"
vertices = [[3,-1,1], [3,-1,-1], [3,1,-1], [3,1,1]]
)");
  for (const char* picture : {"picture.exr", "picture.png"}) {
    const Outcome outcome = run_shell(
        folder.path(),
        "valgrind -q --error-exitcode=99 --leak-check=full "
        "--errors-for-leak-kinds=definite" +
            quoted({PORTALENS_PROGRAM, "render", "-q", "-t", "2", "scene.toml", "-o", picture}));
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
  }
}

}  // namespace
}  // namespace portalens
