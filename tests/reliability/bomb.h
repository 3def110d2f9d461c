/// \file
/// Files made to hurt, and that each is refused, by the readers and by the program, and soon.
#pragma once

#include <gtest/gtest.h>
#include <time.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/read_scene.h"
#include "support/run_program.h"
#include "support/sanitized.h"
#include "support/scale.h"
#include "world/compile.h"

namespace portalens::test {

namespace fs = std::filesystem;

struct Bomb {
  std::string title;
  std::function<std::string(const SceneFolder&)>
      lay;  ///< returns what the program is told to check
};

inline std::string repeated(const std::string& text, std::size_t times) {
  std::string result;
  for (std::size_t i = 0; i < times; ++i) result += text;
  return result;
}

inline constexpr std::size_t mega = 1'000'000;

inline const std::string names_picture = "[environment]\nimage = \"p\"\n";

/// A file of which `make` decides what it is.
inline Bomb file(const std::string& title, const std::string& name, const std::string& scene,
                 const std::function<void(const fs::path&)>& make) {
  return {title, [=](const SceneFolder& folder) {
            if (!scene.empty()) folder.write("scene.toml", scene);
            make(folder.path() / name);
            return scene.empty() ? name : std::string("scene.toml");
          }};
}

/// Seconds of processor time that this thread took.
inline double spent() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What the readers say of a scene; nothing if they take it.
inline std::string refusal_of(const fs::path& scene) {
  try {
    static_cast<void>(compile(read_scene(scene)));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

inline void expect_refused(const std::vector<Bomb>& bombs) {
  // The program takes a quarter of a second to start: only in a long run does each bomb go through
  // it.
  const std::size_t every = test::test_scale() >= 10.0 ? 1 : bombs.size() / 2;
  for (std::size_t i = 0; i < bombs.size(); ++i) {
    const SceneFolder folder;
    const std::string scene = bombs[i].lay(folder);
    const double before = spent();
    const std::string refusal = refusal_of(folder.path() / scene);
    EXPECT_LT(spent() - before, sanitized ? 20.0 : 2.0) << bombs[i].title;
    EXPECT_NE(refusal, "") << bombs[i].title;
    EXPECT_LT(refusal.size(), 400'000u) << bombs[i].title;
    if (i % every != 0) continue;
    const Outcome outcome =
        run_shell(folder.path(), "timeout 60" + quoted({PORTALENS_PROGRAM, "check", scene}));
    EXPECT_EQ(outcome.code, 2) << bombs[i].title << ": " << outcome.errors.substr(0, 500);
    EXPECT_FALSE(outcome.errors.empty()) << bombs[i].title;
  }
}

}  // namespace portalens::test
