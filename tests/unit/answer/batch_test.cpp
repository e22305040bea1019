#include "answer/batch.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <future>
#include <mutex>
#include <optional>
#include <set>

#include "answer/progress.h"
#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

using namespace std::chrono_literals;

// Answers a record with its numbers, and with "bogus" if it is.
void echo(const Record& record, unsigned, std::string& bytes) {
  for (const double x : record.numbers) bytes += fmt::format("{} ", x);
  bytes += record.bogus ? "bogus\n" : "\n";
}

struct Outcome {
  std::string out, fault, messages;
};

// Answers records of text with this command line, once for each of several -n, which must agree.
Outcome run(std::initializer_list<const char*> words, const std::string& text,
            const AnswerRecord& answer = echo) {
  std::optional<Outcome> first;
  for (const int threads : {1, 2, 5}) {
    Options options = parse(words);
    options.threads = threads;
    const TemporaryFile in(text), out, log;
    options.messages.errorFile = log.path;
    Outcome result;
    {
      Messages messages("rsphere");
      messages.use(options.messages, "");
      const size_t head = contents(log.path).size();
      RecordReader reader = readerOf(in.descriptor, options);
      RecordWriter writer(out.descriptor);
      try {
        runRecords(reader, writer, options, messages, nullptr, answer);
      } catch (const rad::Error& error) {
        result.fault = error.what();
      }
      result.messages = contents(log.path).substr(head);
    }
    result.out = contents(out.path);
    if (!first) first = result;
    EXPECT_EQ(result.out, first->out);
    EXPECT_EQ(result.fault, first->fault);
    EXPECT_EQ(result.messages, first->messages);
  }
  return *first;
}

TEST(RunRecords, AnswersInTheOrderOfTheInput) {
  std::string text, expected;
  for (int i = 0; i < 20000; ++i) {
    text += fmt::format("{} {} {}\n", i, i % 7, i % 11);
    expected += fmt::format("{} {} {} \n", i, i % 7, i % 11);
  }
  const Outcome result =
      run({"rsphere", "s.oct"}, text, [](const Record& record, unsigned worker, std::string& bytes) {
        EXPECT_EQ(record.index, static_cast<uint64_t>(record.numbers[0]));
        EXPECT_LT(worker, 5u);
        // Some records take longer, so that later ones are finished before them.
        if (record.index % 97 == 0) std::this_thread::sleep_for(1ms);
        echo(record, worker, bytes);
      });
  EXPECT_EQ(result.out, expected);
  EXPECT_EQ(result.fault, "");
  EXPECT_EQ(result.messages, "");
}

TEST(RunRecords, ARecordMayHaveManyAnswersOrNone) {
  const Outcome result = run({"rsphere", "s.oct"}, "0 0 3\n0 0 0\n0 0 2",
                             [](const Record& record, unsigned, std::string& bytes) {
                               for (int i = 0; i < record.numbers[2]; ++i)
                                 bytes += fmt::format("{}.{}\n", record.index, i);
                             });
  EXPECT_EQ(result.out, "0.0\n0.1\n0.2\n2.0\n2.1\n");
}

TEST(RunRecords, NoInputNoOutput) {
  const Outcome result = run({"rsphere", "s.oct"}, "");
  EXPECT_EQ(result.out + result.fault + result.messages, "");
}

TEST(RunRecords, EverythingBeforeAFaultIsAnswered) {
  std::string text, expected;
  for (int i = 0; i < 1000; ++i) {
    text += fmt::format("{} 0 0\n", i);
    expected += fmt::format("{} 0 0 \n", i);
  }
  const Outcome result = run({"rsphere", "s.oct"}, text + "1 2 x\n4 5 6\n");
  EXPECT_EQ(result.out, expected);
  EXPECT_EQ(result.fault, "stdin:1001: expected 3 numbers, got \"x\"");
}

TEST(RunRecords, EverythingBeforeAFaultyAnswerIsWritten) {
  std::string text, expected;
  for (int i = 0; i < 3000; ++i) text += fmt::format("{} 0 0\n", i);
  for (int i = 0; i < 1234; ++i) expected += fmt::format("{} 0 0 \n", i);
  const Outcome result =
      run({"rsphere", "s.oct"}, text, [](const Record& record, unsigned worker, std::string& bytes) {
        bytes += "";
        if (record.index >= 1234) {
          bytes += "half an answer";
          throw rad::Error(fmt::format("no answer to {}", record.index));
        }
        echo(record, worker, bytes);
      });
  EXPECT_EQ(result.out, expected);
  EXPECT_EQ(result.fault, "no answer to 1234");
}

TEST(RunRecords, ZeroDirectionsAreBogusAndRepeatTheRayBefore) {
  const Outcome result =
      run({"rtrace", "s.oct"}, "9 9 9 0 0 0  1 2 3 4 5 6  7 7 7 0 -0 0  8 8 8 0 0 0  1 1 1 0 0 1");
  EXPECT_EQ(result.out,
            "0 0 0 0 0 0 bogus\n1 2 3 4 5 6 \n1 2 3 4 5 6 bogus\n1 2 3 4 5 6 bogus\n1 1 1 0 0 1 \n");
}

// echo 1 2 3 0 0 1e-200 | rtrace: a bogus record (6.1a).
TEST(RunRecords, DirectionsTooSmallToHaveAUnitVectorAreBogus) {
  EXPECT_EQ(run({"rtrace", "s.oct"}, "1 2 3 0 0 1e-200  1 2 3 0 0 1e-100").out,
            "0 0 0 0 0 0 bogus\n1 2 3 0 0 1e-100 \n");
}

TEST(RunRecords, PointsAtTheOriginAreNotBogus) {
  EXPECT_EQ(run({"rsphere", "s.oct"}, "0 0 0").out, "0 0 0 \n");
}

TEST(RunRecords, ScanlinesEndTheInput) {
  const std::string text = "1 0 0\n2 0 0\n3 0 0\n4 0 0\n5 0 0\n6 0 0\n7 0 0 x";
  EXPECT_EQ(run({"rsphere", "-x", "3", "-y", "2", "s.oct"}, text).out,
            "1 0 0 \n2 0 0 \n3 0 0 \n4 0 0 \n5 0 0 \n6 0 0 \n");
  EXPECT_EQ(run({"rsphere", "-y", "2", "s.oct"}, text).out, "1 0 0 \n2 0 0 \n");
  EXPECT_EQ(run({"rsphere", "-y", "2", "-x", "1", "s.oct"}, text).out, "1 0 0 \n2 0 0 \n");
  EXPECT_EQ(run({"rsphere", "-y", "2", "s.oct"}, text).messages, "");
  const Outcome early = run({"rsphere", "-y", "2", "s.oct"}, "1 0 0");
  EXPECT_EQ(early.messages, "rsphere: warning - unexpected EOF on input\n");
  EXPECT_EQ(early.fault, "");
}

TEST(RunRecords, FourOrFiveNumbersOnALineOfRaysAreWarnedOfOnce) {
  const auto warning = [](const std::string& numbers) {
    return "rsphere: warning - stdin:1: " + numbers +
           " on a line, but a ray has six: rays are read across line ends\n";
  };
  EXPECT_EQ(run({"rtrace", "s.oct"}, "1 2 3\n0 0 1\n").messages, warning("3 numbers"));
  EXPECT_EQ(run({"rtrace", "s.oct"}, "1 2 3 0\n0 1 1 2\n3 0 0 1\n").messages, warning("4 numbers"));
  EXPECT_EQ(run({"rtrace", "s.oct"}, "1 2 3 0 0 1 7\n1 2 3 0 0\n").messages, warning("7 numbers"));
  EXPECT_EQ(run({"rtrace", "s.oct"}, "1\n2\n3\n0\n0\n1\n").messages, warning("1 number"));
  EXPECT_EQ(run({"rtrace", "-w-", "s.oct"}, "1 2 3\n0 0 1\n").messages, "");
  EXPECT_EQ(run({"rtrace", "s.oct"}, "1 2 3 0 0 1\n1 2 3\n0 0 1\n").messages, "");
  EXPECT_EQ(run({"rtrace", "s.oct"}, "1 2 3 0 0 1 1 2 3 0 0 1\n").messages, "");
}

// An identifier before x y z used to give four answers for three lines.
TEST(RunRecords, FourOrFiveNumbersOnALineOfPointsAreAFault) {
  const auto four = run({"rsphere", "s.oct"}, "\n1 2 3\n\n4 5 6\r\n1 7 8 9\n2 1 1 1\n");
  EXPECT_EQ(four.out, "1 2 3 \n4 5 6 \n");
  EXPECT_EQ(four.fault, "stdin:5: expected 3 numbers on a line, got 4");
  EXPECT_EQ(run({"rsphere", "s.oct"}, "1 2 3 4 5\n").fault, "stdin:1: expected 3 numbers on a line, got 5");
  EXPECT_EQ(run({"rsphere", "s.oct"}, "1 2 3 0 0 1\n").fault,
            "stdin:1: expected 3 numbers on a line, got 6; use -S- for rays");
  EXPECT_EQ(run({"rsphere", "s.oct"}, "1 2\n3\n").fault, "stdin:1: expected 3 numbers on a line, got 2");
  EXPECT_EQ(run({"rsphere", "s.oct"}, "1 2 3").fault, "");
}

TEST(RunRecords, NoMoreThreadsThanAskedFor) {
  std::string text;
  for (int i = 0; i < 400; ++i) text += "1 2 3\n";
  const Options options = parse({"rsphere", "-n", "3", "s.oct"});
  const TemporaryFile in(text), out;
  RecordReader reader(in.descriptor, NumberFormat::ascii, 3);
  RecordWriter writer(out.descriptor);
  std::mutex mutex;
  std::set<std::thread::id> threads;
  std::set<unsigned> workers;
  std::condition_variable oneMore;
  runRecords(reader, writer, options, Messages("rsphere"), nullptr,
             [&](const Record&, unsigned worker, std::string&) {
               std::unique_lock lock(mutex);
               threads.insert(std::this_thread::get_id());
               workers.insert(worker);
               oneMore.notify_all();
               // The first threads wait for the others, because a busy machine may start them late.
               oneMore.wait_for(lock, 20s, [&] { return threads.size() >= 3; });
               lock.unlock();
               std::this_thread::sleep_for(300us);
             });
  EXPECT_EQ(threads.size(), 3u);
  EXPECT_EQ(workers, (std::set<unsigned>{0, 1, 2}));
  EXPECT_FALSE(threads.contains(std::this_thread::get_id())) << "its stack may be too small";
}

// A program that talks through pipes to runRecords() on another thread.
class Conversation {
 public:
  explicit Conversation(std::initializer_list<const char*> words, AnswerRecord answer = echo)
      : options_(parse(words)), answer_(std::move(answer)), thread_([this] {
          RecordReader reader = readerOf(toChild.out, options_);
          RecordWriter writer(fromChild.in);
          try {
            runRecords(reader, writer, options_, Messages("rsphere"), nullptr, answer_);
          } catch (const rad::Error& error) {
            fault = error.what();
          }
          fromChild.closeIn();
        }) {}
  ~Conversation() { toChild.closeIn(); }

  void finish() {
    toChild.closeIn();
    thread_.join();
  }
  void wait() { thread_.join(); }

  Pipe toChild, fromChild;
  std::string fault;

 private:
  Options options_;
  AnswerRecord answer_;
  std::jthread thread_;
};

TEST(RunRecords, AnswersWithoutWaitingForMoreInput) {
  for (const auto& words : {std::initializer_list<const char*>{"rsphere", "-x", "1", "s.oct"},
                            {"rsphere", "s.oct"},
                            {"rsphere", "-n", "4", "s.oct"},
                            {"rsphere", "-n", "4", "-x", "1", "s.oct"}}) {
    Conversation talk(words);
    for (int i = 0; i < 50; ++i) {
      talk.toChild.put(fmt::format("{} 1 2\n", i));
      EXPECT_EQ(talk.fromChild.getLines(1), fmt::format("{} 1 2 \n", i));
    }
  }
}

TEST(RunRecords, ZeroDirectionFlushes) {
  for (const char* threads : {"1", "3"}) {
    Conversation talk({"rtrace", "-n", threads, "-x", "1000", "s.oct"});
    for (int i = 0; i < 20; ++i) {
      talk.toChild.put("1 2 3 0 0 1\n1 2 4 0 0 1\n0 0 0 0 0 0\n");
      EXPECT_EQ(talk.fromChild.getLines(3), "1 2 3 0 0 1 \n1 2 4 0 0 1 \n1 2 4 0 0 1 bogus\n");
    }
  }
}

// The program writes a whole group, which is more than two pipes hold, before it reads an answer.
TEST(RunRecords, GroupsAreWrittenOnceTheyAreWhole) {
  for (const char* threads : {"1", "3"}) {
    constexpr int kGroup = 20000;
    Conversation talk({"rsphere", "-n", threads, "-x", "20000", "s.oct"});
    for (int group = 0; group < 2; ++group) {
      std::string text;
      for (int i = 0; i < kGroup; ++i) text += fmt::format("{} 123456789 123456789\n", i);
      talk.toChild.put(text);
      const std::string answers = talk.fromChild.getLines(kGroup);
      EXPECT_EQ(std::count(answers.begin(), answers.end(), '\n'), kGroup);
    }
  }
}

TEST(RunRecords, AFaultEndsAConversationThoughInputIsOpen) {
  Conversation talk({"rsphere", "-n", "2", "s.oct"});
  talk.toChild.put("1 2 3\n4 5 x\n");
  talk.wait();
  EXPECT_EQ(talk.fromChild.getAll(), "1 2 3 \n");
  EXPECT_EQ(talk.fault, "stdin:2: expected 3 numbers, got \"x\"");
}

TEST(RunRecords, AClosedOutputEndsAConversationThoughInputIsOpen) {
  std::signal(SIGPIPE, SIG_IGN);
  for (const char* threads : {"1", "3"}) {
    Conversation talk({"rsphere", "-n", threads, "s.oct"});
    talk.fromChild.closeOut();
    talk.toChild.put("1 2 3\n");
    talk.wait();
    EXPECT_EQ(talk.fault, "Broken pipe");
  }
}

// However long one record takes, at most 16 claims of 256 records for each thread wait to be written.
TEST(RunRecords, EndlessInputNeedsNoMoreMemory) {
  const Options options = parse({"rsphere", "-n", "2", "s.oct"});
  std::string text;
  for (int i = 0; i < 300000; ++i) text += "1 2 3\n";
  const TemporaryFile in(text);
  RecordReader reader(in.descriptor, NumberFormat::ascii, 3);
  const int null = open("/dev/null", O_WRONLY);
  RecordWriter writer(null);
  std::atomic<int64_t> begun{0}, ahead{0};
  runRecords(reader, writer, options, Messages("rsphere"), nullptr,
             [&](const Record& record, unsigned, std::string& bytes) {
               ++begun;
               if (record.index == 100000) {
                 // The other thread continues, when it gets a processor, until it must wait.
                 const auto index = static_cast<int64_t>(record.index);
                 for (int i = 0; i < 1000 && begun - index < 2; ++i) std::this_thread::sleep_for(20ms);
                 std::this_thread::sleep_for(200ms);
                 ahead = begun - index;
               }
               bytes += "answer";
             });
  close(null);
  EXPECT_EQ(reader.records(), 300000u);
  EXPECT_EQ(begun, 300000);
  EXPECT_LE(ahead, 2 * 16 * 256);
  EXPECT_GE(ahead, 2) << "the other thread went on";
}

// They used to come at the end of the file, or after 64 KiB.
TEST(RunRecords, AnswersOfAFileComeWhileItWorks) {
  std::string text, expected;
  for (int i = 0; i < 310; ++i) text += "1 2 3\n";
  for (int i = 0; i < 300; ++i) expected += fmt::format("{}\n", i);
  const Options options = parse({"rsphere", "-n", "2", "s.oct"});
  const TemporaryFile in(text);
  const Pipe out;
  std::promise<void> received;
  std::atomic<bool> inTime{false};
  std::jthread program([&, isReceived = received.get_future().share()] {
    RecordReader reader(in.descriptor, NumberFormat::ascii, 3);
    RecordWriter writer(out.in);
    runRecords(reader, writer, options, Messages("rsphere"), nullptr,
               [&](const Record& record, unsigned, std::string& bytes) {
                 if (record.index == 300) inTime = isReceived.wait_for(20s) == std::future_status::ready;
                 bytes += fmt::format("{}\n", record.index);
               });
  });
  EXPECT_EQ(out.getLines(300), expected);
  received.set_value();
  program.join();
  EXPECT_TRUE(inTime);
}

TEST(RunRecords, FullDiskIsASystemFault) {
  const Options options = parse({"rsphere", "-n", "2", "s.oct"});
  const TemporaryFile in("1 2 3\n");
  const int full = open("/dev/full", O_WRONLY);
  RecordReader reader(in.descriptor, NumberFormat::ascii, 3);
  RecordWriter writer(full);
  EXPECT_EQ(faultOf([&] { runRecords(reader, writer, options, Messages("rsphere"), nullptr, echo); },
                    rad::Status::system),
            "write error: No space left on device");
  close(full);
}

TEST(RunRecords, ReportsProgress) {
  Options options = parse({"rsphere", "-t", "0.01", "s.oct"});
  const TemporaryFile in("1 2 3 1 2 3 1 2 3"), out, log;
  options.messages.errorFile = log.path;
  Messages messages("rsphere");
  messages.use(options.messages, "");
  RecordReader reader(in.descriptor, NumberFormat::ascii, 3);
  RecordWriter writer(out.descriptor);
  runRecords(reader, writer, options, messages, nullptr,
             [](const Record&, unsigned, std::string&) { std::this_thread::sleep_for(15ms); });
  EXPECT_NE(contents(log.path).find("\nrsphere: 1 records after "), std::string::npos);
  EXPECT_NE(contents(log.path).find(" a second, 100.0% done, 0 seconds left\n"), std::string::npos);
}

// Also while the first record is in work, which may wait for the coarse solution.
TEST(RunRecords, ReportsProgressOfASlowRecord) {
  Options options = parse({"rsphere", "-t", "0.01", "s.oct"});
  const TemporaryFile in("1 2 3"), out, log;
  options.messages.errorFile = log.path;
  Messages messages("rsphere");
  messages.use(options.messages, "");
  RecordReader reader(in.descriptor, NumberFormat::ascii, 3);
  RecordWriter writer(out.descriptor);
  const auto isReported = [&] {
    return contents(log.path).find("\nrsphere: no record finished after ") != std::string::npos;
  };
  runRecords(reader, writer, options, messages, nullptr, [&](const Record&, unsigned, std::string&) {
    for (int i = 0; i < 1000 && !isReported(); ++i) std::this_thread::sleep_for(10ms);
  });
  EXPECT_TRUE(isReported());
}

TEST(RunRecords, ReportsByItselfToAPersonAlone) {
  const double usual = kReportSeconds;
  EXPECT_EQ(reportSeconds(0, false, {.messages = true}), usual);
  EXPECT_EQ(reportSeconds(0, true, {.messages = true}), 0);
  EXPECT_EQ(reportSeconds(2, true, {.messages = true}), 2);
  EXPECT_EQ(reportSeconds(2, true, {}), 2);
  EXPECT_EQ(reportSeconds(0, false, {}), 0);
  EXPECT_EQ(reportSeconds(0, false, {.input = true, .messages = true}), 0);
  EXPECT_EQ(reportSeconds(0, false, {.output = true, .messages = true}), 0);
}

// With input from a pipe, the number of records is known only from -y.
TEST(RunRecords, ProgressOfAPipeHasAnEndOnlyWithScanlines) {
  for (const bool scanlines : {false, true}) {
    Options options = scanlines ? parse({"rsphere", "-t", "0.01", "-x", "2", "-y", "2", "s.oct"})
                                : parse({"rsphere", "-t", "0.01", "s.oct"});
    Pipe in;
    const TemporaryFile out, log;
    options.messages.errorFile = log.path;
    Messages messages("rsphere");
    messages.use(options.messages, "");
    in.put("1 2 3 1 2 3 1 2 3 1 2 3");
    in.closeIn();
    RecordReader reader(in.out, NumberFormat::ascii, 3);
    RecordWriter writer(out.descriptor);
    runRecords(reader, writer, options, messages, nullptr,
               [](const Record&, unsigned, std::string&) { std::this_thread::sleep_for(15ms); });
    const std::string text = contents(log.path);
    EXPECT_NE(text.find(" a second"), std::string::npos);
    EXPECT_EQ(text.find("50.0% done") != std::string::npos, scanlines);
  }
}

// A child process, because signals end it. It answers two records and then waits for input, or is busy.
class Child {
 public:
  Child(bool deferred, const AnswerRecord& answer, const char* threads = "2") {
    pid_ = fork();
    if (pid_ != 0) {
      toChild.closeOut();
      fromChild.closeIn();
      return;
    }
    toChild.closeIn();
    fromChild.closeOut();
    dup2(log.descriptor, 2);
    Messages messages("rsphere");
    int status = 0;
    try {
      StopSignals signals("rsphere");
      const Options options = parse({"rsphere", "-n", threads, "s.oct"});
      if (!deferred) {
        fromChild.put("ready\n");
        for (;;) pause();
      }
      RecordReader reader(toChild.out, NumberFormat::ascii, 3);
      RecordWriter writer(fromChild.in);
      RunEnd end;
      end.ended = [&] { messages.report("ended"); };
      end.leave = [&](const std::exception_ptr& fault) { _exit(statusOf(messages, fault)); };
      runRecords(reader, writer, options, messages, &signals, answer, end);
    } catch (const rad::Error&) {
      status = statusOf(messages, std::current_exception());
    }
    _exit(status);
  }
  int exitStatus() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void send(int signal) const { kill(pid_, signal); }
  // Whether a signal was sent that no thread has handled yet.
  bool isPending() const {
    return contents(fmt::format("/proc/{}/status", pid_)).find("ShdPnd:\t0000000000000000") ==
           std::string::npos;
  }

  Pipe toChild, fromChild;
  TemporaryFile log;

  static int statusOf(const Messages& messages, const std::exception_ptr& fault) {
    try {
      std::rethrow_exception(fault);
    } catch (const rad::Error& error) {
      return messages.error(error);
    }
  }

 private:
  pid_t pid_ = -1;
};

TEST(StopSignals, WhileWaitingForInput) {
  for (const auto& [signal, name] :
       {std::pair(SIGTERM, "Terminate"), std::pair(SIGINT, "Interrupt"), std::pair(SIGHUP, "Hangup"),
        std::pair(SIGXCPU, "CPU limit exceeded"), std::pair(SIGXFSZ, "File size exceeded"),
        std::pair(SIGALRM, "Alarm clock")}) {
    const Child child(true, echo);
    child.toChild.put("1 2 3\n");
    EXPECT_EQ(child.fromChild.getLines(1), "1 2 3 \n");
    child.send(signal);
    EXPECT_EQ(child.exitStatus(), 3);
    EXPECT_EQ(contents(child.log.path), std::string("rsphere: ended\nrsphere: signal - ") + name + "\n");
  }
}

// Answers two records, which are kept as one group. At the third, `stop` sends signals to the process.
AnswerRecord stoppedAtTheThird(std::function<void()> stop) {
  return [stop = std::move(stop), ready = std::make_shared<std::atomic<int>>(0)](
             const Record& record, unsigned worker, std::string& bytes) {
    if (record.index == 2) {
      while (*ready < 2) std::this_thread::sleep_for(1ms);
      stop();
      std::this_thread::sleep_for(50ms);
    }
    echo(record, worker, bytes);
    ++*ready;
  };
}

TEST(StopSignals, FlushWhatIsFinished) {
  const Child child(true, stoppedAtTheThird([] { kill(getpid(), SIGTERM); }));
  child.toChild.put("1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1\n");
  EXPECT_EQ(child.exitStatus(), 3);
  const std::string out = child.fromChild.getAll();
  EXPECT_EQ(out.substr(0, 14), "1 2 3 \n4 5 6 \n");
  EXPECT_EQ(out.back(), '\n');
  EXPECT_EQ(contents(child.log.path), "rsphere: ended\nrsphere: signal - Terminate\n");
}

TEST(StopSignals, BeforeRecordsAreRead) {
  const Child child(false, echo);
  EXPECT_EQ(child.fromChild.getLines(1), "ready\n");
  child.send(SIGTERM);
  EXPECT_EQ(child.exitStatus(), 3);
  EXPECT_EQ(contents(child.log.path), "rsphere: signal - Terminate\n");
}

TEST(StopSignals, TheSecondEndsItAtOnce) {
  const Pipe busy;
  const Child child(true, [&](const Record&, unsigned, std::string&) {
    busy.put("busy\n");
    std::this_thread::sleep_for(60s);
  });
  child.toChild.put("1 2 3\n");
  EXPECT_EQ(busy.getLines(1), "busy\n");
  child.send(SIGTERM);
  while (child.isPending()) std::this_thread::sleep_for(1ms);  // two signals that come together are merged
  std::this_thread::sleep_for(100ms);
  const auto start = std::chrono::steady_clock::now();
  child.send(SIGTERM);
  EXPECT_EQ(child.exitStatus(), 3);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);
}

// Answers 300 records at once, with two numbers each. The next takes a minute; `busy` gets a line when all
// 300 are answered by any of the threads.
AnswerRecord slowAfter300(const Pipe& busy) {
  const auto answered = std::make_shared<std::atomic<int>>(0);
  return [&busy, answered](const Record& record, unsigned, std::string& bytes) {
    if (record.index == 300) {
      while (*answered < 300) std::this_thread::sleep_for(1ms);
      std::this_thread::sleep_for(20ms);  // the last of them is still to be handed in
      busy.put("busy\n");
      std::this_thread::sleep_for(60s);
    }
    bytes += fmt::format("{}\n", record.index);
    if (record.index < 300) ++*answered;
  };
}

// The finished answers used to wait for the record in work. After 15 seconds they were lost.
TEST(StopSignals, NothingWaitsForTheRecordInWork) {
  std::string expected;
  for (int i = 0; i < 300; ++i) expected += fmt::format("{}\n", i);
  for (const char* threads : {"1", "2", "3"})
    for (const int second : {0, SIGHUP}) {
      const Pipe busy;
      Child child(true, slowAfter300(busy), threads);
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < 310; ++i) child.toChild.put("1 2 3\n");
      EXPECT_EQ(busy.getLines(1), "busy\n");
      child.send(SIGTERM);
      if (second != 0) child.send(second);  // systemd sends it right after TERM
      EXPECT_EQ(child.exitStatus(), 3);
      EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);
      EXPECT_EQ(child.fromChild.getAll(), expected) << threads;
      const std::string log = contents(child.log.path);
      EXPECT_TRUE(log == "rsphere: ended\nrsphere: signal - Terminate\n" ||
                  (second != 0 && log == "rsphere: ended\nrsphere: signal - Hangup\n"))
          << log;
    }
}

// Nobody reads the answers any more: nothing waits for the record in work either.
TEST(StopSignals, AClosedOutputEndsTheRunThoughARecordIsInWork) {
  const Pipe busy;
  Child child(true, [&](const Record& record, unsigned, std::string& bytes) {
    if (record.index == 1) {
      busy.put("busy\n");
      std::this_thread::sleep_for(60s);
    }
    if (record.index == 0) busy.getLines(1);
    bytes += "answer\n";
  });
  child.fromChild.closeOut();
  const auto start = std::chrono::steady_clock::now();
  child.toChild.put("1 2 3\n4 5 6\n");
  EXPECT_EQ(child.exitStatus(), 3);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);
  EXPECT_EQ(contents(child.log.path), "rsphere: ended\n");
}

// timeout(1) sends a signal to the process and to its group.
TEST(StopSignals, TheSameTwiceInAMomentIsOne) {
  const Child child(true, stoppedAtTheThird([] {
                      kill(getpid(), SIGTERM);
                      std::this_thread::sleep_for(5ms);
                      kill(getpid(), SIGTERM);
                    }));
  child.toChild.put("1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n");
  EXPECT_EQ(child.exitStatus(), 3);
  EXPECT_EQ(child.fromChild.getAll().substr(0, 14), "1 2 3 \n4 5 6 \n");
  EXPECT_EQ(contents(child.log.path), "rsphere: ended\nrsphere: signal - Terminate\n");
}

TEST(StopSignals, AClosedStandardInputIsAFaultAndNotSomeOtherFile) {
  const pid_t pid = fork();
  if (pid == 0) {
    close(0);
    const StopSignals signals("rsphere");
    RecordReader reader(0, NumberFormat::ascii, 3);
    std::vector<double> numbers;
    try {
      reader.read(numbers, 1);
    } catch (const rad::Error& error) {
      _exit(static_cast<int>(error.status()));
    }
    _exit(0);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_EQ(status, 2 << 8);
}

TEST(StopSignals, GiveBackTheHandlersBefore) {
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGHUP, SIG_IGN);
  {
    const StopSignals signals("rsphere");
    struct sigaction now {};
    sigaction(SIGHUP, nullptr, &now);
    EXPECT_EQ(now.sa_handler, SIG_IGN) << "ignored signals stay so (nohup)";
    sigaction(SIGTERM, nullptr, &now);
    EXPECT_NE(now.sa_handler, SIG_DFL);
    EXPECT_FALSE(signals.raised());
  }
  struct sigaction now {};
  sigaction(SIGTERM, nullptr, &now);
  EXPECT_EQ(now.sa_handler, SIG_DFL);
  std::signal(SIGHUP, SIG_DFL);
}

}  // namespace
}  // namespace rsphere
