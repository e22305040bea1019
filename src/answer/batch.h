#pragma once
#include <cstdint>
#include <exception>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "answer/answer_options.h"
#include "answer/messages.h"
#include "process/stop_signals.h"
#include "records/record_reader.h"
#include "records/record_writer.h"

namespace rsphere {

// A reader of the records of a mode. Line ends separate points, because there is no other program whose
// format of points must be matched. They are blanks between the numbers of rays, as in rtrace.
inline RecordReader readerOf(int descriptor, const AnswerOptions& options, std::string name = "stdin") {
  return {descriptor, options.in, options.numbersPerRecord(),
          options.sphereMode ? LineEnds::endRecords : LineEnds::areBlanks, std::move(name)};
}

// One input record.
struct Record {
  uint64_t index = 0;               // from 0, including bogus records
  std::span<const double> numbers;  // three (sphere mode) or six (ray mode); valid during the call
  // Ray mode: whether the direction of the record is zero, so that nothing is traced. `numbers` are then
  // those of the last record with a direction, or zeros if there is none. See bogusAnswer().
  bool bogus = false;
};

// Appends the answer to a record to `bytes`, as any number of output records. It is called from several
// threads at once, numbered by `worker` from 0; the answer must depend only on the record. If it throws, the
// answers to all preceding records are written, and runRecords() rethrows the exception.
using AnswerRecord = std::function<void(const Record& record, unsigned worker, std::string& bytes)>;

// Actions at the end of a run, in addition to its result.
struct RunEnd {
  // Called once, after the last answer is written.
  std::function<void()> ended;
  // Ends the process with the message and the status of `fault`; may return. Called if an error, a signal or
  // a closed output ends the run and a record is still unfinished after .1 s: not all work asks whether to
  // stop (base/stop_check.h), and threads use objects of the caller. If it is empty, the run ends after the
  // record.
  std::function<void(const std::exception_ptr& fault)> leave;
  // Called instead of a warning if the input ends before -y scanlines.
  std::function<void()> shortInput;
};

// Reads records until the end of the input (or of -y scanlines of -x records), calls `answer` for each on
// threadCount() threads (threads.h), and writes the answers in the order of the input.
// - Output is flushed after each -x records if -y is 0, after each record if -x is 1, and after a bogus
//   record. Unless -x requests groups of several records, it is also flushed every half second, and if the
//   next input has not arrived yet. A group is written as soon as it is complete but no earlier, so that a
//   program may send a whole group before it reads an answer.
// - Memory does not grow with the input: at most 16 claims of records per thread wait to be written.
// - An error in the input or in an answer ends the run after all preceding records are answered and written.
// - A signal ends the run (rad::Error with Status::signal and its name as text). Answers that are finished,
//   up to the first unfinished record, are written at once, without waiting for unfinished records.
// - Warns if there are fewer threads than requested with -n, if the input ends before -y scanlines, if the
//   first line of text in ray mode does not contain whole rays, and (once, without -u+) if a ray occurs three
//   times in a row and its answers may be noisy.
// - Writes a progress report to `messages` about every -t seconds.
// Throws the errors of reader, writer and answer, and rad::Error (Status::system) if no thread can be
// started. `signals` may be null.
void runRecords(RecordReader& reader, RecordSink& writer, const AnswerOptions& options,
                const Messages& messages, StopSignals* signals, const AnswerRecord& answer,
                const RunEnd& end = {});

}  // namespace rsphere
