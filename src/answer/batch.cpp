#include "answer/batch.h"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <vector>

#include "answer/answer_writer.h"
#include "answer/threads.h"

namespace rsphere {
namespace {

using Clock = std::chrono::steady_clock;

// A thread claims as many records at once as it answers in about this time. A claim costs about a
// microsecond, which is negligible beside it; and the threads still end at nearly the same time.
constexpr auto kClaimTime = std::chrono::microseconds(200);
constexpr size_t kLargestClaim = 256;
// For each thread, the number of claims that may be ahead of the oldest unfinished one.
constexpr uint64_t kClaimsAhead = 16;

// One repetition of a ray may be an accident; two suggest that someone averages its answers.
constexpr int kRepeatsToRemark = 2;

constexpr uint64_t kNoLimit = std::numeric_limits<uint64_t>::max();

// Consecutive records, for one thread.
struct Claim {
  uint64_t number = 0;
  uint64_t firstRecord = 0;
  size_t records = 0;
  std::vector<double> numbers;
  std::vector<double> before;  // the last record before them that has a direction
  bool flush = false;
  std::exception_ptr error;  // the fault in reading the record after them
};

struct Finished {
  std::string bytes;
  size_t records = 0;
  bool flush = false;
  bool last = false;  // no later claim may be written
  std::exception_ptr error;
};

// Each thread takes records from the reader (under input_), answers them, and hands in the bytes
// (under output_). The thread that hands in the oldest claim writes all claims that are due. Lock
// order: input_ before output_.
class Batch {
 public:
  Batch(RecordReader& reader, RecordWriter& writer, const AnswerOptions& options, const Messages& messages,
        const StopSignals* signals, const AnswerRecord& answer)
      : reader_(reader),
        writer_(writer),
        options_(options),
        messages_(messages),
        signals_(signals),
        answer_(answer),
        threads_(threadCount(options.threads)),
        perRecord_(options.numbersPerRecord()),
        interval_(options.height == 0 || options.width <= 1 ? static_cast<uint64_t>(options.width) : 0),
        untilFlush_(interval_),
        remaining_(options.height == 0 ? kNoLimit
                                       : static_cast<uint64_t>(std::max<int64_t>(options.width, 1)) *
                                             static_cast<uint64_t>(options.height)),
        before_(static_cast<size_t>(perRecord_), 0.0) {}

  void run();

 private:
  void runWorkers();
  void work(unsigned worker);
  bool take(Claim& claim, size_t most);
  void noteBogus(Claim& claim);
  void remarkRepeats(const double* record, uint64_t index);
  void remarkLayout();
  Finished compute(const Claim& claim, unsigned worker);
  void handIn(uint64_t number, Finished&& finished);
  void waitingForInput(bool waiting);
  void reportProgress();
  double expectedRecords() const;
  void stop(std::exception_ptr error);
  void endInput();
  bool stopping() const { return stopped_ || (signals_ != nullptr && signals_->raised()); }
  bool isBogus(const double* record) const { return perRecord_ == 6 && hasNoDirection({record, 6}); }

  RecordReader& reader_;
  RecordWriter& writer_;
  const AnswerOptions& options_;
  const Messages& messages_;
  const StopSignals* signals_;
  const AnswerRecord& answer_;
  const unsigned threads_;
  const int perRecord_;
  const uint64_t interval_;  // records between flushes; 0: none

  std::mutex input_;
  uint64_t untilFlush_, remaining_;
  uint64_t nextClaim_ = 0, nextRecord_ = 0;
  std::vector<double> before_;
  bool inputEnded_ = false, layoutRemarked_ = false, textRemarked_ = false, repeatsRemarked_ = false;
  int repeats_ = 0;

  std::mutex output_;
  std::condition_variable written_;
  std::map<uint64_t, Finished> finished_;
  uint64_t nextOut_ = 0, recordsOut_ = 0;
  std::exception_ptr error_;
  bool outputEnded_ = false;
  Clock::time_point start_ = Clock::now(), lastReport_ = start_;

  std::atomic<bool> stopped_{false}, waiting_{false};
  std::atomic<uint64_t> recordsTaken_{0};  // this and inputShare_ are for progress reports only
  std::atomic<double> inputShare_{0};
  int wakeFd_ = -1;
};

void Batch::run() {
  wakeFd_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wakeFd_ < 0) throw rad::Error("cannot create an event descriptor", rad::Status::system);
  std::vector<int> wakes{wakeFd_};
  if (signals_ != nullptr) wakes.push_back(signals_->descriptor());
  reader_.interruptBy(wakes);
  reader_.whenWaiting([this](bool waiting) { waitingForInput(waiting); });
  writer_.holdUntilFlush(interval_ > 1);
  runWorkers();
  reader_.whenWaiting({});
  reader_.interruptBy({});
  close(wakeFd_);
  writer_.holdUntilFlush(false);
  try {
    writer_.flush();
  } catch (const rad::Error&) {
    if (!error_) error_ = std::current_exception();  // the first fault is reported
  }
  if (error_) std::rethrow_exception(error_);
  if (signals_ != nullptr && signals_->raised()) throw rad::Error(signals_->name(), rad::Status::signal);
  if (remaining_ != kNoLimit && remaining_ > 0) messages_.warning("unexpected EOF on input");
}

// The answers do not depend on the number of threads.
void Batch::runWorkers() {
  const unsigned wanted = wantedThreads(options_.threads);
  if (threads_ < wanted)
    messages_.warning(
        fmt::format("reducing number of threads from {} to {}: the stacks of more threads would take "
                    "over half of the memory that this process may have",
                    wanted, threads_));
  try {
    runOnThreads(
        threads_, [this](unsigned worker) { work(worker); },
        [this](unsigned started, const std::string& reason) {
          messages_.warning(
              fmt::format("reducing number of threads from {} to {}: no more could be started: {}", threads_,
                          started, reason));
        });
  } catch (const rad::Error&) {
    stop(std::current_exception());
  }
}

void Batch::work(unsigned worker) {
  try {
    Claim claim;
    for (size_t most = 1; take(claim, most);) {
      const auto start = Clock::now();
      Finished finished = compute(claim, worker);
      const auto time = Clock::now() - start;
      if (time < kClaimTime / 2 && claim.records == most) most = std::min(2 * most, kLargestClaim);
      if (time > 2 * kClaimTime) most = std::max<size_t>(most / 2, 1);
      handIn(claim.number, std::move(finished));
    }
  } catch (...) {
    stop(std::current_exception());
  }
}

// Takes the next records: those that have arrived, at most `most`. Waits for the first of them. Returns
// false when there are no more.
bool Batch::take(Claim& claim, size_t most) {
  const std::lock_guard input(input_);
  if (inputEnded_ || stopping()) return false;
  {
    std::unique_lock output(output_);
    written_.wait(output, [&] { return stopped_ || nextClaim_ - nextOut_ < kClaimsAhead * threads_; });
  }
  if (stopping()) return false;
  if (remaining_ == 0) {
    inputEnded_ = true;
    return false;
  }
  claim.numbers.clear();
  claim.records = 0;
  claim.error = nullptr;
  claim.flush = false;
  claim.before = before_;
  claim.firstRecord = nextRecord_;
  if (interval_ > 0) most = std::min<uint64_t>(most, untilFlush_);
  most = std::min<uint64_t>(most, remaining_);
  try {
    claim.records = reader_.read(claim.numbers, most);
  } catch (const rad::Error&) {
    claim.error = std::current_exception();
  }
  remarkLayout();
  if (claim.records == 0) inputEnded_ = true;
  if (claim.records == 0 && !claim.error) return false;
  claim.number = nextClaim_++;
  nextRecord_ += claim.records;
  if (options_.progressSeconds > 0) {
    recordsTaken_ = nextRecord_;
    inputShare_ = reader_.shareRead();
  }
  if (remaining_ != kNoLimit) remaining_ -= claim.records;
  untilFlush_ -= interval_ > 0 ? claim.records : 0;
  noteBogus(claim);
  if (interval_ > 0 && untilFlush_ == 0) {
    claim.flush = true;
    untilFlush_ = interval_;
  }
  return true;
}

void Batch::noteBogus(Claim& claim) {
  if (perRecord_ != 6) return;
  for (size_t i = 0; i < claim.records; ++i) {
    const double* record = claim.numbers.data() + 6 * i;
    if (!isBogus(record)) {
      remarkRepeats(record, claim.firstRecord + i);
      before_.assign(record, record + 6);
      continue;
    }
    claim.flush = true;
    if (interval_ > 0) untilFlush_ = interval_ - (claim.records - 1 - i);
  }
}

// Callers that repeat a ray to average its answers expect new samples each time, which rtrace draws.
void Batch::remarkRepeats(const double* record, uint64_t index) {
  const RayOptions& ray = options_.ray;
  if (repeatsRemarked_ || options_.numberedRays || (ray.ambientBounces == 0 && ray.directJitter == 0)) return;
  repeats_ = std::equal(before_.begin(), before_.end(), record) ? repeats_ + 1 : 0;
  if (repeats_ < kRepeatsToRemark) return;
  repeatsRemarked_ = true;
  messages_.warning(fmt::format(
      "record {}: a repeated ray has the same random numbers each time; use -u+ for different ones",
      index + 1));
}

void Batch::remarkLayout() {
  if (!textRemarked_ && reader_.firstRecordIsText()) {
    textRemarked_ = true;
    messages_.warning(
        fmt::format("stdin: the first record of -f{} input consists of printable characters: use "
                    "-fa to read text",
                    static_cast<char>(options_.in)));
  }
  const auto& first = reader_.firstLine();
  if (layoutRemarked_ || !first) return;
  layoutRemarked_ = true;
  if (first->numbers % perRecord_ != 0)
    messages_.warning(
        fmt::format("stdin:{}: {} number{} on a line, but a ray has six: rays are read across line ends",
                    first->line, first->numbers, first->numbers == 1 ? "" : "s"));
}

Finished Batch::compute(const Claim& claim, unsigned worker) {
  Finished finished;
  finished.flush = claim.flush;
  finished.error = claim.error;
  const double* before = claim.before.data();
  const auto length = static_cast<size_t>(perRecord_);
  try {
    for (; finished.records < claim.records; ++finished.records) {
      if (stopping()) {
        finished.last = true;
        return finished;
      }
      const double* numbers = claim.numbers.data() + length * finished.records;
      Record record;
      record.index = claim.firstRecord + finished.records;
      record.bogus = isBogus(numbers);
      if (!record.bogus) before = numbers;
      record.numbers = {before, length};
      const size_t whole = finished.bytes.size();
      try {
        answer_(record, worker, finished.bytes);
      } catch (...) {
        finished.bytes.resize(whole);
        throw;
      }
    }
  } catch (...) {
    finished.error = std::current_exception();
  }
  finished.last = finished.error != nullptr;
  return finished;
}

void Batch::handIn(uint64_t number, Finished&& finished) {
  const std::lock_guard output(output_);
  finished_.emplace(number, std::move(finished));
  try {
    while (!finished_.empty() && finished_.begin()->first == nextOut_ && !outputEnded_) {
      const Finished due = std::move(finished_.begin()->second);
      finished_.erase(finished_.begin());
      ++nextOut_;
      recordsOut_ += due.records;
      writer_.write(due.bytes);
      if (due.flush) writer_.flush();
      if (due.last) {
        outputEnded_ = true;
        error_ = due.error;
      }
    }
    if (waiting_ && interval_ == 0) writer_.flush();
  } catch (...) {
    outputEnded_ = true;
    error_ = std::current_exception();
  }
  if (outputEnded_) endInput();
  reportProgress();
  written_.notify_all();
}

// Wakes the thread that waits for input and the threads that wait for answers to be written.
void Batch::endInput() {
  stopped_ = true;
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t n = ::write(wakeFd_, &one, sizeof one);
  written_.notify_all();
}

void Batch::waitingForInput(bool waiting) {
  waiting_ = waiting;
  if (!waiting || interval_ != 0) return;
  const std::lock_guard output(output_);
  if (outputEnded_) return;
  try {
    writer_.flush();
  } catch (...) {
    outputEnded_ = true;
    error_ = std::current_exception();
    endInput();
  }
}

void Batch::reportProgress() {
  if (options_.progressSeconds <= 0) return;
  const auto now = Clock::now();
  if (std::chrono::duration<double>(now - lastReport_).count() < options_.progressSeconds) return;
  lastReport_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const auto done = static_cast<double>(recordsOut_);
  std::string text =
      fmt::format("{} records after {:.1f} seconds, {:.4g} a second", recordsOut_, seconds, done / seconds);
  if (const double all = expectedRecords(); all > 0 && done > 0)
    text += fmt::format(", {:.1f}% done, {:.0f} seconds left", 100 * std::min(done / all, 1.),
                        seconds * std::max(all / done - 1, 0.));
  messages_.report(text);
}

// An estimate of the number of all records; 0 if nothing is known. For a file, it assumes that the rest of
// the file has as many records per byte as the part that was read.
double Batch::expectedRecords() const {
  if (options_.height > 0)
    return static_cast<double>(options_.height) * static_cast<double>(std::max<int64_t>(options_.width, 1));
  const double read = inputShare_;
  return read > 0 ? static_cast<double>(recordsTaken_) / read : 0;
}

void Batch::stop(std::exception_ptr error) {
  const std::lock_guard output(output_);
  if (!error_) error_ = error;
  outputEnded_ = true;
  endInput();
}

}  // namespace

void runRecords(RecordReader& reader, RecordWriter& writer, const AnswerOptions& options,
                const Messages& messages, StopSignals* signals, const AnswerRecord& answer) {
  if (signals != nullptr) signals->defer(true);
  Batch(reader, writer, options, messages, signals, answer).run();
  if (signals != nullptr) signals->defer(false);
}

}  // namespace rsphere
