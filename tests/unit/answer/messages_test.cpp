#include "answer/messages.h"

#include <fmt/format.h>

#include "answer/header.h"
#include "records/record_writer.h"
#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

// The text that `action` writes to standard error.
template <class Action>
std::string standardErrorOf(Action action) {
  const TemporaryFile file;
  const int kept = dup(2);
  dup2(file.descriptor, 2);
  action();
  dup2(kept, 2);
  close(kept);
  return contents(file.path);
}

void use(Messages& messages, const Options& options) {
  messages.use(options.messages, commandLine(options, true));
}

TEST(Messages, HaveThePrefixesAndStatusOfRtrace) {
  const Messages messages("rsphere");
  EXPECT_EQ(standardErrorOf([&] { messages.warning("odd"); }), "rsphere: warning - odd\n");
  EXPECT_EQ(standardErrorOf([&] { EXPECT_EQ(messages.error(rad::Error("a.rad:3: no")), 1); }),
            "rsphere: fatal - a.rad:3: no\n");
  EXPECT_EQ(standardErrorOf([&] { EXPECT_EQ(messages.error(rad::Error("no", rad::Status::system)), 2); }),
            "rsphere: system - no\n");
  EXPECT_EQ(
      standardErrorOf([&] { EXPECT_EQ(messages.error(rad::Error("Terminate", rad::Status::signal)), 3); }),
      "rsphere: signal - Terminate\n");
  EXPECT_EQ(standardErrorOf([&] { messages.report("12 records"); }), "rsphere: 12 records\n");
}

TEST(Messages, AClosedPipeIsQuiet) {
  const Messages messages("rsphere");
  EXPECT_EQ(standardErrorOf([&] { EXPECT_EQ(messages.error(ClosedPipe()), 3); }), "");
}

TEST(Messages, AreOnePrintableLine) {
  const Messages messages("r\x1b");
  EXPECT_EQ(standardErrorOf([&] { messages.warning("one\n\x1b[31mtwo\n"); }),
            "r\\x1b: warning - one\\x0a\\x1b[31mtwo\n");
  EXPECT_EQ(standardErrorOf([&] { messages.report("\xc2\x9b"); }), "r\\x1b: \\xc2\\x9b\n");
}

// The message used to be lost: the program ended with status 1 and without a word.
TEST(Messages, GoToStandardErrorIfTheErrorFileIsFull) {
  Messages messages("rsphere");
  EXPECT_EQ(standardErrorOf([&] {
              use(messages, parse({"rsphere", "-e", "/dev/full", "s.oct"}));
              messages.error(rad::Error("a.rad:3: no"));
            }),
            "rsphere: fatal - a.rad:3: no\n");
}

TEST(Messages, WarningsCanBeSwitchedOff) {
  Messages messages("rtrace");
  EXPECT_EQ(standardErrorOf([&] {
              use(messages, parse({"rtrace", "-w", "-oV", "s.oct"}));
              messages.warning("odd");
            }),
            "");
  EXPECT_EQ(standardErrorOf([&] {
              use(messages, parse({"rtrace", "-oV", "s.oct"}));
            }),
            "rtrace: warning - -oVW options require trace mode\n");
}

TEST(Messages, ErrorFileIsAppendedTo) {
  const TemporaryFile file("before\n");
  {
    Messages messages("rsphere");
    use(messages, parse({"rsphere", "-e", file.path.c_str(), "s.oct"}));
    messages.warning("odd");
  }
  EXPECT_EQ(
      contents(file.path),
      fmt::format("before\n**************\n*** PID {:5}: rsphere -e {} s.oct\n\nrsphere: warning - odd\n",
                  getpid(), file.path));
}

TEST(Messages, ErrorFileThatCannotBeOpened) {
  Messages messages("rsphere");
  EXPECT_EQ(faultOf(
                [&] {
                  use(messages, parse({"rsphere", "-e", "/no/file", "s.oct"}));
                },
                rad::Status::system),
            "cannot open error file \"/no/file\": No such file or directory");
}

}  // namespace
}  // namespace rsphere
