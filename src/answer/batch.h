#pragma once
#include <cstdint>
#include <exception>
#include <functional>
#include <span>
#include <string>

#include "answer/answer_options.h"
#include "answer/messages.h"
#include "answer/record_reader.h"
#include "answer/record_writer.h"
#include "answer/stop_signals.h"

namespace rsphere {

// One input record.
struct Record {
  uint64_t index = 0;               // from 0; bogus records have numbers too
  std::span<const double> numbers;  // three (sphere mode) or six (ray mode); valid during the call
  // Ray mode: the direction of the record is zero, so that nothing is traced. `numbers` are those of the last
  // record that has a direction, or zeros if there is none. See bogusAnswer().
  bool bogus = false;
};

// Appends the answer to a record to `bytes`: any number of output records. It is called from several threads
// at once, which `worker` numbers from 0; its answer must depend on the record alone. If it throws, the
// answers to all records before this one are written, and runRecords() throws the exception on.
using AnswerRecord = std::function<void(const Record& record, unsigned worker, std::string& bytes)>;

// What happens at the end of a run besides its result.
struct RunEnd {
  // Called once, after the last answer is written.
  std::function<void()> ended;
  // Ends the process with the message and the status of `fault`; it may not return. Called where a fault, a
  // signal or a closed output ends the run and a record is still in work after .1 s: no thread can be stopped
  // within a record, and the threads use what the caller holds. If it is empty, the run ends with the record.
  std::function<void(const std::exception_ptr& fault)> leave;
  // Called instead of a warning where the input ends before -y scanlines.
  std::function<void()> shortInput;
};

// Reads records to the end of the input (or of the -y'th scanline of -x records), calls `answer` for each on
// threadCount() threads (threads.h), and writes the answers in the order of the input.
// - Output is flushed after every -x records where -y is 0, after every record where -x is 1, after a
//   bogus record, and, unless -x asks for groups of several records, every half second and whenever the next
//   input is not there yet. A group is written at once when it is complete, so that a program may write all
//   of it before it reads an answer.
// - Memory does not grow with the input: at most 16 claims of records for each thread wait to be written.
// - A fault in the input or in an answer ends the run when all records before it are answered and written.
// - A signal ends the run (rad::Error with Status::signal and its name as text): the answers that are
//   finished up to the first record that is not are written at once, and nothing waits for the records in
//   work.
// - Warns if there are fewer threads than -n asks for, if the input ends before -y scanlines, if the first
//   line of text in ray mode does not hold whole rays, and (once, without -u+) if the same ray comes three
//   times in a row and its answers may be noisy.
// - Writes a progress report to `messages` about every -t seconds.
// Throws what reader, writer and answer throw, and rad::Error (Status::system) if no thread can be
// started. `signals` may be null.
void runRecords(RecordReader& reader, RecordSink& writer, const AnswerOptions& options,
                const Messages& messages, StopSignals* signals, const AnswerRecord& answer,
                const RunEnd& end = {});

}  // namespace rsphere
