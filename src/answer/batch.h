#pragma once
#include <cstdint>
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
  uint64_t index = 0;               // from 0, bogus ones counted
  std::span<const double> numbers;  // three (sphere mode) or six (ray mode); valid during the call
  // Ray mode: the direction was zero. Nothing is to be traced; `numbers` are those of the last record that
  // had a direction, or zeros. See bogusAnswer().
  bool bogus = false;
};

// Appends the answer of a record to `bytes`: as many output records as it likes. Called from up to -n threads
// at once, `worker` counts them from 0; what it appends must depend on the record alone. May throw: the
// answers to all records before this one are then written, and the error goes on to the caller of
// runRecords().
using AnswerRecord = std::function<void(const Record& record, unsigned worker, std::string& bytes)>;

// Reads records to the end of input (or to the -y'th scanline of -x records), has them answered by
// threadCount() threads (threads.h), and writes the answers in the order of the input, whatever the number of
// threads. Warns where these are fewer than -n asks for, or where the system starts fewer, which then do all;
// Status::system where it starts none.
// - Flush: after every -x records where -y is 0, and after every record where -x is 1; after a bogus record;
//   and, unless -x asks for groups of several, whenever input has to be waited for. A group is written in one
//   go once it is whole, so that a program may write it all before it reads an answer.
// - Memory does not grow with the input: answers wait for at most 16 batches of records a thread.
// - A fault in the input or in an answer stops it once everything before is answered and written; so does a
//   signal (rad::Error with Status::signal, its name the text), but records being computed are given up then.
// - Warns where input ends before -y scanlines, and in ray mode where the numbers on the first line of text
//   are not those of whole rays.
// - Warns once where the same ray comes three times in a row and its answers may be noisy, without -u+.
// - Reports to `messages` every -t seconds, when there are answers.
// Throws what reader, writer and answer throw. `signals` may be null.
void runRecords(RecordReader& reader, RecordWriter& writer, const AnswerOptions& options,
                const Messages& messages, StopSignals* signals, const AnswerRecord& answer);

}  // namespace rsphere
