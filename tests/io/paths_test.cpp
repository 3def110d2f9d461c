// A scene reaches the files of its own folder, and no others unless it is allowed to.
#include "io/paths.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <vector>

#include "io/files.h"
#include "support/temporary_folder.h"

namespace portalens::test {
namespace {

class PathsTest : public testing::Test {
 protected:
  PathsTest() {
    scene_ = folder_.write("scenes/a.toml", "x");
    folder_.write("scenes/textures/wood.png", "x");
    outside_ = folder_.write("secret.png", "x");
    std::filesystem::create_symlink("textures/wood.png", folder_.path() / "scenes/inside_link");
    std::filesystem::create_symlink(outside_, folder_.path() / "scenes/outside_link");
    std::filesystem::create_symlink("loop", folder_.path() / "scenes/loop");
    ::mkfifo((folder_.path() / "scenes/fifo").c_str(), 0600);
  }

  bool reaches(const std::string& name, Containment containment) {
    Faults faults;
    const auto file = resolve_file(scene_, name, containment, {}, faults);
    EXPECT_EQ(file.has_value(), faults.empty()) << name;
    return file.has_value();
  }

  TemporaryFolder folder_;
  std::filesystem::path scene_, outside_;
};

TEST_F(PathsTest, FilesOfTheSceneFolderAreReached) {
  for (const char* name : {"a.toml", "textures/wood.png", "./textures/../textures/wood.png",
                           "inside_link", "../scenes/a.toml"}) {
    EXPECT_TRUE(reaches(name, Containment::scene_folder)) << name;
  }
  EXPECT_TRUE(reaches((folder_.path() / "scenes/a.toml").string(), Containment::scene_folder));
}

TEST_F(PathsTest, FilesOutsideAreReachedOnlyWhenAllowed) {
  for (const std::string& name : {std::string("../secret.png"), std::string("outside_link"),
                                  std::string("textures/../../secret.png"), outside_.string()}) {
    EXPECT_FALSE(reaches(name, Containment::scene_folder)) << name;
    EXPECT_TRUE(reaches(name, Containment::anywhere)) << name;
  }
}

TEST_F(PathsTest, WhatIsNoRegularFileIsNeverReached) {
  for (const std::string& name :
       {std::string(), std::string("textures"), std::string("."), std::string("fifo"),
        std::string("loop"), std::string("nothere"), std::string("a.toml/b"),
        std::string("/dev/zero"), std::string("a.toml\0b", 8), std::string(5000, 'x')}) {
    EXPECT_FALSE(reaches(name, Containment::scene_folder)) << name;
    EXPECT_FALSE(reaches(name, Containment::anywhere)) << name;
  }
}

TEST_F(PathsTest, AFolderWhoseNameBeginsAlikeIsOutside) {
  folder_.write("scenes2/b.png", "x");
  EXPECT_FALSE(reaches("../scenes2/b.png", Containment::scene_folder));
}

TEST_F(PathsTest, ReadingNeverWaitsForAPipeAndHoldsItsLimit) {
  Faults faults;
  EXPECT_FALSE(read_file(folder_.path() / "scenes/fifo", 100, {}, faults));
  EXPECT_FALSE(read_file("/dev/zero", 100, {}, faults));
  EXPECT_FALSE(read_file(folder_.write("long", std::string(101, 'x')), 100, {}, faults));
  EXPECT_EQ(faults.size(), 3U);
  EXPECT_EQ(read_file(folder_.write("short", std::string(100, 'x')), 100, {}, faults)->size(),
            100U);
}

TEST_F(PathsTest, AFileIsReplacedAsAWholeAndNothingElseIsLeft) {
  const auto file = folder_.write("out/a.bin", "old");
  const std::string bytes = std::string("new\0bytes", 9) + std::string(3 << 20, 'y');
  replace_file(file, bytes);
  EXPECT_EQ(TemporaryFolder::read(file), bytes);
  const auto entries = std::filesystem::directory_iterator(folder_.path() / "out");
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST_F(PathsTest, WhatKilledProgramsLeftIsRemovedLaterAndNothingElse) {
  const auto file = folder_.write("out/a.bin", "old");
  const auto name = [&](const std::string& of) { return folder_.path() / "out" / of; };
  const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(2);
  const std::vector<std::string> others = {".portalens-1-0.tmp.png", ".portalens-.tmp",
                                           ".portalens-mine.tmp", "portalens-1-0.tmp"};
  for (const std::string& other : others) folder_.write("out/" + other, "x");
  for (const char* left : {".portalens-123-0.tmp", ".portalens-9-17.tmp"})
    folder_.write(std::string("out/") + left, "half a pic");
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "out"))
    std::filesystem::last_write_time(entry.path(), long_ago);
  folder_.write("out/.portalens-124-0.tmp", "of one who still writes");
  check_replaceable(file);
  EXPECT_FALSE(exists(name(".portalens-123-0.tmp")));
  EXPECT_FALSE(exists(name(".portalens-9-17.tmp")));
  EXPECT_TRUE(exists(name(".portalens-124-0.tmp")));
  EXPECT_TRUE(exists(file));
  for (const std::string& other : others) EXPECT_TRUE(exists(name(other))) << other;
}

TEST_F(PathsTest, ALinkIsFollowedWhenItsFileIsReplaced) {
  const auto file = folder_.write("out/a.bin", "old");
  const auto link = folder_.path() / "link";
  std::filesystem::create_symlink("out/a.bin", link);
  replace_file(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(TemporaryFolder::read(file), "new");
}

TEST_F(PathsTest, AFailedWriteLeavesNoTrace) {
  const auto before = std::filesystem::directory_iterator(folder_.path());
  const auto count = std::distance(begin(before), end(before));
  EXPECT_THROW(replace_file(folder_.path() / "nofolder/a", "x"), WorkError);
  EXPECT_THROW(replace_file(folder_.path() / "scenes", "x"), WorkError);
  EXPECT_THROW(replace_file(folder_.path() / "scenes/fifo", "x"), WorkError);
  EXPECT_THROW(check_replaceable(folder_.path() / "nofolder/a"), WorkError);
  EXPECT_NO_THROW(check_replaceable(folder_.path() / "a"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a"));
  const auto after = std::filesystem::directory_iterator(folder_.path());
  EXPECT_EQ(std::distance(begin(after), end(after)), count);
}

}  // namespace
}  // namespace portalens::test
