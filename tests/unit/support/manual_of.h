#pragma once
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace rsphere {

// That man/NAME.1 is the template man/NAME.1.in with these options in it. Leaves what it should be in the
// folder of the test.
inline void expectManual(const std::string& name, const std::string& options) {
  const auto contents = [](const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string file = std::string(RSPHERE_TESTS) + "/../man/" + name + ".1";
  std::string text = contents(file + ".in");
  const std::string mark = ".\\\" @OPTIONS@\n";
  const size_t at = text.find(mark);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, mark.size(), options);
  std::ofstream(name + ".1", std::ios::binary) << text;
  EXPECT_TRUE(contents(file) == text) << "differs from " << name << ".1 in the folder of this test";
}

}  // namespace rsphere
