#include "records/record_reader.h"

#include <cmath>
#include <limits>
#include <random>

#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

struct ReadAll {
  std::vector<double> numbers;
  size_t records = 0;
  std::string fault;
};

ReadAll readAll(RecordReader& reader, size_t most = 256) {
  ReadAll all;
  try {
    while (const size_t n = reader.read(all.numbers, most)) all.records += n;
  } catch (const rad::Error& error) {
    EXPECT_EQ(error.status(), rad::Status::input);
    all.fault = error.what();
  }
  return all;
}

ReadAll readText(const std::string& text, int perRecord = 3, size_t most = 256,
                 LineEnds lineEnds = LineEnds::areBlanks) {
  const TemporaryFile file(text);
  RecordReader reader(file.descriptor, NumberFormat::ascii, perRecord, lineEnds);
  return readAll(reader, most);
}

ReadAll readLines(const std::string& text, size_t most = 256) {
  return readText(text, 3, most, LineEnds::endRecords);
}

using Numbers = std::vector<double>;

TEST(RecordReader, LineEndsAreNoDifferentFromBlanks) {
  const ReadAll all = readText("1 2\n3\t4\r\n5\v\f6 \n\n 7 8 9");
  EXPECT_EQ(all.numbers, (Numbers{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(all.records, 3u);
  EXPECT_EQ(all.fault, "");
}

TEST(RecordReader, Utf16IsNamed) {
  using namespace std::string_literals;
  const std::string message = "stdin: the text is in UTF-16; convert it to UTF-8: iconv -f UTF-16 -t UTF-8";
  for (const std::string& text : {"\xff\xfe"
                                  "1\0 \0"
                                  "2\0 \0"
                                  "3\0\n\0"s,
                                  "\xfe\xff\0"
                                  "1\0 \0"
                                  "2\0 \0"
                                  "3\0\n"s}) {
    EXPECT_EQ(readText(text).fault, message);
    EXPECT_EQ(readLines(text).fault, message);
  }
}

TEST(RecordReader, NothingIsNoFault) {
  EXPECT_EQ(readText("").records, 0u);
  EXPECT_EQ(readText(" \n\n\t").fault, "");
}

TEST(RecordReader, NumbersAsRadianceSpellsThem) {
  const ReadAll all = readText("+.5 1. 1e0 -0 .5e+1 1E-2 -.25 +3 \"7\" '8.5' 000 1e-400");
  EXPECT_EQ(all.numbers, (Numbers{.5, 1, 1, -0.0, 5, .01, -.25, 3, 7, 8.5, 0, 0}));
  EXPECT_TRUE(std::signbit(all.numbers[3]));
}

// rtrace cuts words at 31 characters, which shifts all columns after them.
TEST(RecordReader, LongNumbersAreReadWhole) {
  const std::string third = "0." + std::string(400, '3');
  const ReadAll all =
      readText(third + " 1.0000000000000000000000000000000000000000 12345678901234567890123456789012345e-30");
  EXPECT_EQ(all.numbers, (Numbers{1 / 3., 1, 12345.678901234567890123456789012345}));
}

TEST(RecordReader, WhatIsNoNumberIsNamedWithItsLineAfterAllBefore) {
  for (const std::string word :
       {"x", "nan", "NaN", "inf", "-inf", "infinity", "0x10", "1d0",  "#",   "1e",  "1e+",
        ".", "+",   "-",   "--1", "+-1",  "-+1",      "1..2", "1e5.", "\"1", "1\"", "\"\""}) {
    const ReadAll all = readText("1 2 3\n4 5 6 \n7 " + word + " 8\n1 2 3\n");
    EXPECT_EQ(all.numbers, (Numbers{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(all.fault, "stdin:3: expected 3 numbers, got \"" + word + "\"");
  }
  EXPECT_EQ(readText("1 2 3 4 5 x", 6).fault, "stdin:1: expected 6 numbers, got \"x\"");
  EXPECT_EQ(readText("1 2 3 4 5 1e400", 6).fault,
            "stdin:1: expected 6 numbers, got \"1e400\", beyond the range of numbers");
  for (const std::string word : {"1,2,3,0,0,1", "1;2;3;0;0;1", "1,5"})
    EXPECT_EQ(readText(word + " 2 3 0 0 1", 6).fault,
              "stdin:1: expected 6 numbers, got \"" + word +
                  "\"; blanks separate numbers, and decimals need a point");
}

TEST(RecordReader, AFaultStaysAFault) {
  const TemporaryFile file("1 2 x 1 2 3");
  RecordReader reader(file.descriptor, NumberFormat::ascii, 3);
  EXPECT_EQ(readAll(reader).fault, readAll(reader).fault);
}

TEST(RecordReader, ShortRecordIsAFault) {
  const ReadAll all = readText("1 2 3\n4 5\n\n");
  EXPECT_EQ(all.records, 1u);
  EXPECT_EQ(all.fault, "stdin:2: expected 3 numbers, got 2");
}

TEST(RecordReader, HostileWordsAreShownOnOneShortLine) {
  EXPECT_EQ(readText(std::string("1 2 \x1b[2J\0z\n", 11)).fault,
            "stdin:1: expected 3 numbers, got \"\\x1b[2J\\x00z\"");
  const std::string fault = readText("1 2 " + std::string(10000000, '9')).fault;
  EXPECT_EQ(fault, "stdin:1: expected 3 numbers, got \"" + std::string(40, '9') +
                       "...\", beyond the range of numbers");
}

// Blocks are 64 KiB, so that their limits fall on every position in a record.
TEST(RecordReader, RecordsAcrossBlocksAreWhole) {
  std::string text;
  Numbers expected;
  std::mt19937 random(1);
  for (int i = 0; i < 60000; ++i) {
    const double x = static_cast<double>(random()) / 1024 - 1e6;
    expected.push_back(x);
    char word[64];
    std::snprintf(word, sizeof word, i % 3 != 0 ? "%.17g " : x < 0 ? "%.17g\n" : "+%.17g\n", x);
    text += word;
  }
  for (const size_t most : {1u, 7u, 100000u}) {
    const ReadAll all = readText(text, 6, most);
    EXPECT_EQ(all.fault, "");
    EXPECT_EQ(all.numbers, expected);
  }
}

TEST(RecordReader, MegabytesOfBlanksInsideARecord) {
  const std::string blanks(3000000, ' ');
  EXPECT_EQ(readText("1" + blanks + "2" + blanks + "\n3").numbers, (Numbers{1, 2, 3}));
}

TEST(RecordReader, OneByteAtATime) {
  const std::string text = "1.5 -2e1 +3\n44 55 66 7 8 1e";
  Pipe pipe;
  std::jthread slow([&] {
    for (const char c : text) pipe.put({&c, 1});
    pipe.closeIn();
  });
  RecordReader reader(pipe.out, NumberFormat::ascii, 3);
  const ReadAll all = readAll(reader);
  EXPECT_EQ(all.numbers, (Numbers{1.5, -20, 3, 44, 55, 66}));
  EXPECT_EQ(all.fault, "stdin:2: expected 3 numbers, got \"1e\"");
}

TEST(RecordReader, DoesNotWaitForMoreThanARecord) {
  for (const LineEnds lineEnds : {LineEnds::areBlanks, LineEnds::endRecords}) {
    Pipe pipe;
    RecordReader reader(pipe.out, NumberFormat::ascii, 3, lineEnds);
    Numbers numbers;
    pipe.put("1 2 3\n4 5");
    EXPECT_EQ(reader.read(numbers, 100), 1u);
    pipe.put(" 6\n");
    EXPECT_EQ(reader.read(numbers, 100), 1u);
    EXPECT_EQ(numbers, (Numbers{1, 2, 3, 4, 5, 6}));
  }
}

TEST(RecordReader, BinaryNumbers) {
  {
    const TemporaryFile file(bytesOf<float>({1, 2, .1f, 4, 5, 6}));
    RecordReader reader(file.descriptor, NumberFormat::float32, 3);
    EXPECT_EQ(readAll(reader).numbers, (Numbers{1, 2, .1f, 4, 5, 6}));
  }
  {
    const TemporaryFile file(bytesOf<double>({1, 2, .1, 4, 5, 6}));
    RecordReader reader(file.descriptor, NumberFormat::float64, 6);
    EXPECT_EQ(readAll(reader).numbers, (Numbers{1, 2, .1, 4, 5, 6}));
  }
}

TEST(RecordReader, BinaryFaultsHaveTheNumberOfTheRecord) {
  {
    const TemporaryFile file(bytesOf<float>({1, 2, 3, 4}) + "ab");
    RecordReader reader(file.descriptor, NumberFormat::float32, 3);
    const ReadAll all = readAll(reader);
    EXPECT_EQ(all.records, 1u);
    EXPECT_EQ(all.fault, "stdin: record 2: expected 12 bytes, got 6");
  }
  for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    const TemporaryFile file(bytesOf<double>({1, 2, 3, 4, 5, 6, 7, bad, 9}));
    RecordReader reader(file.descriptor, NumberFormat::float64, 3);
    const ReadAll all = readAll(reader);
    EXPECT_EQ(all.numbers, (Numbers{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(all.fault, std::string("stdin: record 3: expected 3 numbers, got ") + (std::isnan(bad) ? "nan"
                                                                                     : bad > 0       ? "inf"
                                                                                               : "-inf"));
  }
}

TEST(RecordReader, CannotReadIsASystemFault) {
  RecordReader reader(9999, NumberFormat::ascii, 3);
  Numbers numbers;
  EXPECT_NE(faultOf([&] { reader.read(numbers, 1); }, rad::Status::system), "no fault");
  const int folder = open("/tmp", O_RDONLY);
  RecordReader onFolder(folder, NumberFormat::ascii, 3);
  EXPECT_EQ(faultOf([&] { onFolder.read(numbers, 1); }, rad::Status::system), "stdin: Is a directory");
  close(folder);
}

TEST(RecordReader, AByteOrderMarkIsSkippedAtTheBeginningOnly) {
  EXPECT_EQ(readText("\xef\xbb\xbf"
                     "1 2 3\n4 5 6\n")
                .numbers,
            (Numbers{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(readText("\xef\xbb\xbf \n1 2 3").numbers, (Numbers{1, 2, 3}));
  EXPECT_EQ(readText("\xef\xbb\xbf").fault, "");
  const ReadAll later = readText(
      "1 2 3\n\xef\xbb\xbf"
      "4 5 6\n");
  EXPECT_EQ(later.records, 1u);
  EXPECT_EQ(later.fault,
            "stdin:2: expected 3 numbers, got \"\xef\xbb\xbf"
            "4\"");
  const ReadAll within = readText(
      "1 \xef\xbb\xbf"
      "2 3\n");
  EXPECT_EQ(within.fault,
            "stdin:1: expected 3 numbers, got \"\xef\xbb\xbf"
            "2\"");
}

TEST(RecordReader, TextIsToldFromFloatsAndDoubles) {
  const auto isText = [](const std::string& bytes, NumberFormat format) {
    const TemporaryFile file(bytes);
    RecordReader reader(file.descriptor, format, 6);
    const ReadAll all = readAll(reader);
    return std::pair(reader.firstRecordIsText(), all.fault);
  };
  const std::string text = "0 0 1 0 0 -1\n0 0 2 0 0 -1\n0 0 3 0 0 -1\n0 0 4 0 0 -1\n";
  EXPECT_TRUE(isText(text, NumberFormat::float32).first);
  EXPECT_TRUE(isText(text, NumberFormat::float64).first);
  EXPECT_FALSE(isText(bytesOf<float>({0, 0, 1, 0, 0, -1}), NumberFormat::float32).first);
  EXPECT_FALSE(isText(bytesOf<double>({1.1, 2.2, 3.3, 4.4, 5.5, 6.6}), NumberFormat::float64).first);
  EXPECT_FALSE(isText("", NumberFormat::float32).first);
  EXPECT_EQ(isText("0 0 1 0 0 -1\n", NumberFormat::float32).second,
            "stdin: record 1: expected 24 bytes, got 13, all of them printable: use -fa to read text");
  EXPECT_EQ(isText(std::string(5, '\0'), NumberFormat::float32).second,
            "stdin: record 1: expected 24 bytes, got 5");
}

TEST(RecordReader, NumbersOnTheFirstLine) {
  for (const auto& [text, line, count] :
       {std::tuple("\n1 2 3\n4 5 6\n", 2, 3), std::tuple("1 2 3 4 5 6\n1 2 3", 1, 6)}) {
    const TemporaryFile file(text);
    RecordReader reader(file.descriptor, NumberFormat::ascii, 3);
    readAll(reader);
    ASSERT_TRUE(reader.firstLine());
    EXPECT_EQ(reader.firstLine()->line, static_cast<uint64_t>(line));
    EXPECT_EQ(reader.firstLine()->numbers, count);
  }
}

TEST(RecordReader, LinesAreRecordsWhereLineEndsEndThem) {
  const ReadAll all = readLines("  \n1 +2 \"3\"\r\n\n\t\n4\t5e0 6 \n7 8 9");
  EXPECT_EQ(all.numbers, (Numbers{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(all.fault, "");
  EXPECT_EQ(readLines("").records, 0u);
  EXPECT_EQ(readLines(" \n\n\t").fault, "");
  for (const auto& [text, fault] :
       {std::pair("1 2 3\n\n4 5\n6\n", "stdin:3: expected 3 numbers on a line, got 2"),
        std::pair("1 2 3\n4 5 6 7\n", "stdin:2: expected 3 numbers on a line, got 4"),
        std::pair("1 2 3\n4 5 6 7 8", "stdin:2: expected 3 numbers on a line, got 5"),
        std::pair("1 2 3\n4 5 x 7\n", "stdin:2: expected 3 numbers, got \"x\""),
        std::pair("1 2 3\n4 5 6 # desk\n", "stdin:2: expected 3 numbers, got \"#\"")})
    for (const size_t most : {1u, 100u}) {
      EXPECT_EQ(readLines(text, most).fault, fault);
      EXPECT_EQ(readLines(text, most).numbers, (Numbers{1, 2, 3}));
    }
}

TEST(RecordReader, LinesAcrossBlocksAreWholeAndEndlessOnesAFault) {
  std::string text;
  Numbers expected;
  for (int i = 0; i < 30000; ++i) {
    for (int k = 0; k < 3; ++k) {
      expected.push_back(i + .25 * k);
      text += std::to_string(i + .25 * k) + (k < 2 ? " " : i % 7 == 0 ? "\r\n\n" : "\n");
    }
  }
  for (const size_t most : {1u, 7u, 100000u}) {
    const ReadAll all = readLines(text, most);
    EXPECT_EQ(all.fault, "");
    EXPECT_EQ(all.numbers, expected);
  }
  EXPECT_EQ(readLines(std::string(3000000, ' ') + "1 2 3" + std::string(60000, ' ') + "\n").numbers,
            (Numbers{1, 2, 3}));
  EXPECT_EQ(readLines("1 2 3" + std::string(70000, ' ') + "\n").fault,
            "stdin:1: expected 3 numbers on a line, got more than 65536 bytes");
  EXPECT_EQ(
      readLines("1 2 " + std::string(10000000, '9')).fault,
      "stdin:1: expected 3 numbers, got \"" + std::string(40, '9') + "...\", beyond the range of numbers");
}

}  // namespace
}  // namespace rsphere
