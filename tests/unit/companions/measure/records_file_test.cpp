#include "companions/measure/records_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

// The fault of a file of rays with this text, without its folder.
std::string faultOfText(const char* text) {
  const std::string name = testing::TempDir() + "records";
  std::ofstream(name) << text;
  AnswerOptions options;
  options.sphereMode = false;
  const std::string fault = faultOf([&] { readRecords(name, options); });
  return fault.starts_with(name) ? fault.substr(testing::TempDir().size()) : fault;
}

TEST(RecordsFile, ASceneSaysThatRecordsComeLast) {
  const std::string last = "; the file of records is the last argument, after the scene";
  EXPECT_EQ(faultOfText("void plastic white 0 0 5 .7 .7 .7 0 0\n"),
            "records:1: expected 6 numbers, got \"void\"" + last);
  EXPECT_EQ(faultOfText("#?RADIANCE\noconv room.rad\n"),
            "records:1: expected 6 numbers, got \"#?RADIANCE\"" + last);
}

TEST(RecordsFile, OtherFaultsOfRecordsAreLeftAsTheyAre) {
  EXPECT_EQ(faultOfText("1 2 3 0 0 1\n1 2 3 0 0 1\n"), "no fault");
  EXPECT_EQ(faultOfText("1 2 3 0 0 1\n1 2 x 0 0 1\n"), "records:2: expected 6 numbers, got \"x\"");
}

}  // namespace
}  // namespace rsphere
