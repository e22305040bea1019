#include "rad_parser/file_path.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/unit/rad_parser/scene_text.h"

namespace {

using rad::findFile;

TEST(FilePath, DirectoriesAreSearchedInTheirOrder) {
  const TestFolder folder;
  folder.write("a/one.cal", "1");
  folder.write("b/one.cal", "2");
  folder.write("b/two.cal", "3");
  const std::string path = folder.path("a") + ":" + folder.path("b") + "/";
  EXPECT_EQ(findFile("one.cal", path), folder.path("a/one.cal"));
  EXPECT_EQ(findFile("two.cal", path), folder.path("b/two.cal"));
  EXPECT_EQ(findFile("three.cal", path), std::nullopt);
  EXPECT_EQ(findFile("", path), std::nullopt);
}

TEST(FilePath, FullNamesAreNotSearched) {
  const TestFolder folder;
  folder.write("a/one.cal", "1");
  folder.write("b/.hidden", "1");
  EXPECT_EQ(findFile("./one.cal", folder.path("a")), std::nullopt);
  EXPECT_EQ(findFile("../a/one.cal", folder.path("a")), std::nullopt);
  EXPECT_EQ(findFile(".hidden", folder.path("b")), std::nullopt);
  EXPECT_EQ(findFile(folder.path("a/one.cal"), ""), folder.path("a/one.cal"));
  EXPECT_EQ(findFile("./one.cal", "", folder.path("a")), folder.path("a/./one.cal"));
}

TEST(FilePath, HomeDirectories) {
  const TestFolder folder;
  folder.write("one.cal", "1");
  const char* before = std::getenv("HOME");
  const std::string home = before ? before : "";
  setenv("HOME", folder.path().c_str(), 1);
  EXPECT_EQ(findFile("~/one.cal", "."), folder.path("one.cal"));
  EXPECT_EQ(findFile("~nobody-of-this-name/one.cal", "."), std::nullopt);
  before ? setenv("HOME", home.c_str(), 1) : unsetenv("HOME");
}

TEST(FilePath, RelativeDirectoriesStartAtTheBase) {
  const TestFolder folder;
  folder.write("one.cal", "1");
  folder.write("lib/two.cal", "1");
  EXPECT_EQ(findFile("one.cal", ".:lib", folder.path()), folder.path("one.cal"));
  EXPECT_EQ(findFile("one.cal", ":lib", folder.path()), folder.path("one.cal"));  // empty: the current one
  EXPECT_EQ(findFile("two.cal", ".:lib", folder.path()), folder.path("lib/two.cal"));
}

TEST(FilePath, ADirectoryIsNoFileToFind) {
  const TestFolder folder;
  folder.write("a/chair/x", "1");
  folder.write("b/chair", "1");
  EXPECT_EQ(findFile("chair", folder.path("a") + ":" + folder.path("b")), folder.path("b/chair"));
}

TEST(FilePath, Parts) {
  EXPECT_EQ(rad::directoryOf("a/b.rad"), "a");
  EXPECT_EQ(rad::directoryOf("/b.rad"), "/");
  EXPECT_EQ(rad::directoryOf("b.rad"), "");
  EXPECT_EQ(rad::joinPath("a", "b"), "a/b");
  EXPECT_EQ(rad::joinPath("a/", "b"), "a/b");
  EXPECT_EQ(rad::joinPath("a", "/b"), "/b");
  EXPECT_EQ(rad::joinPath("", "b"), "b");
}

TEST(FileAccess, FoldersOfTheNamesGivenAndOfRaypath) {
  const TestFolder folder;
  const std::string scene = folder.write("scene/room.rad", "");
  const std::string below = folder.write("scene/lib/chair.rad", "");
  const std::string other = folder.write("scenery/chair.rad", "");
  std::filesystem::create_symlink(other, folder.path("scene/link.rad"));
  const rad::FileAccess access = rad::FileAccess::foldersOf(std::vector<std::string>{scene});
  EXPECT_TRUE(access.allows(scene));
  EXPECT_TRUE(access.allows(below));
  EXPECT_TRUE(access.allows(folder.path("scenery/../scene/lib/chair.rad")));
  EXPECT_FALSE(access.allows(other));  // the name of its folder begins with that of the allowed one
  EXPECT_FALSE(access.allows(folder.path("scene/../scenery/chair.rad")));
  EXPECT_FALSE(access.allows(folder.path("scene/link.rad")));
  EXPECT_FALSE(access.allows(folder.path("scene/none.rad")));
  EXPECT_FALSE(access.allows(folder.path("scene/lib")));
  EXPECT_FALSE(access.allows("/dev/zero"));
  EXPECT_EQ(findFile(other, ".", {}, access), std::nullopt);
  EXPECT_EQ(findFile("chair.rad", folder.path("scenery") + ":" + folder.path("scene/lib"), {}, access),
            below);
  EXPECT_FALSE(access.remark().empty());
}

TEST(FileAccess, AnywhereUnlessAskedOtherwise) {
  EXPECT_TRUE(rad::FileAccess().allows("/dev/zero"));
  EXPECT_TRUE(rad::FileAccess().remark().empty());
}

}  // namespace
