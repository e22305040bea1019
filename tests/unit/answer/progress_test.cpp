#include "answer/progress.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace rsphere {
namespace {

// The first tenth of a picture makes the coarse solution. In an office it took as long as the next three, and
// the time left was predicted three times too long.
TEST(PictureProgress, TheStartDoesNotForetellTheRest) {
  std::vector<std::string> lines;
  const PictureProgress::Report report = [&](std::string_view line) { lines.emplace_back(line); };
  PictureProgress progress("view.png", report, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  progress.at(.1);
  progress.at(.12);
  progress.at(.2);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].find("picture view.png: 10% after 0."), 0u);
  EXPECT_EQ(lines[1].find("left"), std::string::npos);
  EXPECT_NE(lines[2].find(", about 0 seconds left"), std::string::npos) << lines[2];
}

}  // namespace
}  // namespace rsphere
