#include "answer/batch.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <map>
#include <mutex>
#include <vector>

#include "answer/answer_writer.h"
#include "base/stop_check.h"
#include "process/threads.h"

namespace rsphere {
namespace {

using Clock = std::chrono::steady_clock;

// Time in which a thread answers the records that it claims at once. It is long compared with a claim, which
// takes about a microsecond, and so short that all threads end nearly together.
constexpr auto kClaimTime = std::chrono::microseconds(200);
constexpr size_t kLargestClaim = 256;
// Number of claims per thread that may be ahead of the oldest unfinished one.
constexpr uint64_t kClaimsAhead = 16;

// A single repetition of a ray may be accidental; two suggest that the caller averages answers.
constexpr int kRepeatsToRemark = 2;

// Finished answers are written at least this often, unless -x requests groups.
constexpr auto kLongestDelay = std::chrono::milliseconds(500);
// Time for unfinished records at the end of a run, before the process ends without them. Most records take
// less, and writing a finished picture takes a few milliseconds.
constexpr auto kGrace = std::chrono::milliseconds(100);

constexpr uint64_t kNoLimit = std::numeric_limits<uint64_t>::max();

// Consecutive records that one thread answers.
struct Claim {
  uint64_t number = 0;
  uint64_t firstRecord = 0;
  size_t records = 0;
  std::vector<double> numbers;
  std::vector<double> before;  // last preceding record with a direction
  bool flush = false;
  std::exception_ptr error;  // error while reading the following record
};

// The answers to the records of a claim. Its thread appends answers, and meanwhile another thread may take
// those already appended.
class alignas(64) InWork {
 public:
  // Begins a claim. Called by the thread that answers the claim.
  void begin(uint64_t claim) {
    const std::lock_guard lock(mutex_);
    claim_ = claim;
  }
  void append(std::string_view bytes) {
    const std::lock_guard lock(mutex_);
    bytes_ += bytes;
  }
  // Ends the claim and returns the answers that have not been taken.
  std::string finish() {
    const std::lock_guard lock(mutex_);
    claim_ = kNoLimit;
    return untaken();
  }
  // Takes the answers appended so far, if they belong to this claim. Any thread may call it.
  std::string take(uint64_t claim) {
    const std::lock_guard lock(mutex_);
    return claim_ == claim ? untaken() : std::string();
  }

 private:
  // Keeps the memory for the next claim.
  std::string untaken() {
    std::string bytes = bytes_;
    bytes_.clear();
    return bytes;
  }

  std::mutex mutex_;
  uint64_t claim_ = kNoLimit;
  std::string bytes_;
};

struct Finished {
  std::string bytes;
  size_t records = 0;
  bool flush = false;
  bool last = false;  // no later claim may be written
  std::exception_ptr error;
};

// A file descriptor for which threads wait with poll(2). It counts how often it was raised.
class Event {
 public:
  Event() : fd_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (fd_ < 0) throw rad::systemError("cannot create an event descriptor");
  }
  ~Event() { close(fd_); }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;

  void raise() const {
    const uint64_t one = 1;
    [[maybe_unused]] const ssize_t n = ::write(fd_, &one, sizeof one);
  }
  // How often it was raised since the last call.
  uint64_t count() const {
    uint64_t n = 0;
    return ::read(fd_, &n, sizeof n) == sizeof n ? n : 0;
  }
  int descriptor() const { return fd_; }

 private:
  int fd_;
};

// Each thread takes records from the reader (holding input_), answers them, and submits the bytes (holding
// output_). The thread that submits the oldest claim writes all claims that are complete in order. The thread
// that called run() watches: it writes the finished records of the oldest claim every kLongestDelay and on a
// signal. Lock order: input_, output_, the lock of InWork.
class Batch {
 public:
  Batch(RecordReader& reader, RecordSink& writer, const AnswerOptions& options, const Messages& messages,
        const StopSignals* signals, const AnswerRecord& answer, const RunEnd& end)
      : reader_(reader),
        writer_(writer),
        options_(options),
        messages_(messages),
        signals_(signals),
        answer_(answer),
        end_(end),
        threads_(threadCount(options.threads)),
        perRecord_(options.numbersPerRecord()),
        interval_(options.height == 0 || options.width <= 1 ? static_cast<uint64_t>(options.width) : 0),
        untilFlush_(interval_),
        remaining_(options.height == 0 ? kNoLimit
                                       : static_cast<uint64_t>(std::max<int64_t>(options.width, 1)) *
                                             static_cast<uint64_t>(options.height)),
        before_(static_cast<size_t>(perRecord_), 0.0),
        inWork_(threads_) {}

  void run() {
    std::vector<int> wakes{wake_.descriptor()};
    if (signals_ != nullptr) wakes.push_back(signals_->descriptor());
    reader_.interruptBy(wakes);
    reader_.whenWaiting([this](bool waiting) { waitingForInput(waiting); });
    writer_.holdUntilFlush(interval_ > 1);
    runWorkers();
    reader_.whenWaiting({});
    reader_.interruptBy({});
    writer_.holdUntilFlush(false);
    if (const std::exception_ptr fault = conclude()) std::rethrow_exception(fault);
  }

 private:
  // The answers do not depend on the number of threads.
  void runWorkers() {
    const unsigned wanted = wantedThreads(options_.threads);
    if (threads_ < wanted)
      messages_.warning(
          fmt::format("reducing number of threads from {} to {}: the stacks of more threads would take "
                      "over half of the memory that this process may have",
                      wanted, threads_));
    try {
      runOnThreads(
          threads_,
          [this](unsigned worker) {
            work(worker);
            workerEnded_.raise();
          },
          [this](unsigned started, const std::string& reason) {
            messages_.warning(
                fmt::format("reducing number of threads from {} to {}: no more could be started: {}",
                            threads_, started, reason));
          },
          [this](unsigned started) { watch(started); });
    } catch (const rad::Error&) {
      stop(std::current_exception());
    }
  }

  void work(unsigned worker) {
    const StopCheck stopCheck([this] {
      if (signals_ != nullptr) signals_->check();
    });
    try {
      Claim claim;
      for (size_t most = 1; take(claim, most);) {
        const auto start = Clock::now();
        Finished finished = compute(claim, worker);
        const auto time = Clock::now() - start;
        if (time < kClaimTime / 2 && claim.records == most) most = std::min(2 * most, kLargestClaim);
        if (time > 2 * kClaimTime) most = std::max<size_t>(most / 2, 1);
        handIn(claim.number, std::move(finished), inWork_[worker]);
      }
    } catch (...) {
      stop(std::current_exception());
    }
  }

  // Takes the next records that have arrived, at most `most`. Waits for the first. False if there are no
  // more.
  bool take(Claim& claim, size_t most) {
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

  void noteBogus(Claim& claim) {
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

  // Callers that repeat a ray to average its answers expect a new sample each time, as from rtrace.
  void remarkRepeats(const double* record, uint64_t index) {
    const RayOptions& ray = options_.ray;
    if (repeatsRemarked_ || options_.numberedRays || (ray.ambientBounces == 0 && ray.directJitter == 0))
      return;
    repeats_ = std::equal(before_.begin(), before_.end(), record) ? repeats_ + 1 : 0;
    if (repeats_ < kRepeatsToRemark) return;
    repeatsRemarked_ = true;
    messages_.warning(fmt::format(
        "record {}: a repeated ray has the same random numbers each time; use -u+ for different ones",
        index + 1));
  }

  void remarkLayout() {
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

  // The answers remain in inWork_[worker].
  Finished compute(const Claim& claim, unsigned worker) {
    InWork& mine = inWork_[worker];
    mine.begin(claim.number);
    Finished finished;
    finished.flush = claim.flush;
    finished.error = claim.error;
    const double* before = claim.before.data();
    const auto length = static_cast<size_t>(perRecord_);
    try {
      std::string bytes;
      for (size_t& i = finished.records; i < claim.records; ++i) {
        if (stopping()) {
          finished.last = true;
          return finished;
        }
        const double* numbers = claim.numbers.data() + length * i;
        Record record;
        record.index = claim.firstRecord + i;
        record.bogus = isBogus(numbers);
        if (!record.bogus) before = numbers;
        record.numbers = {before, length};
        bytes.clear();
        answer_(record, worker, bytes);
        mine.append(bytes);
      }
    } catch (...) {
      finished.error = std::current_exception();
    }
    finished.last = finished.error != nullptr;
    return finished;
  }

  void handIn(uint64_t number, Finished&& finished, InWork& mine) {
    const std::lock_guard output(output_);
    finished.bytes = mine.finish();
    finished_.emplace(number, std::move(finished));
    guardOutput([this] {
      writeDue();
      if (waiting_ && interval_ == 0) writer_.flush();
    });
    reportProgress();
    written_.notify_all();
  }

  // Calls `write`, unless the output has ended. If it fails or was the last, the run ends. REQUIRES output_.
  template <typename Write>
  void guardOutput(const Write& write) {
    try {
      if (!outputEnded_) write();
    } catch (...) {
      outputEnded_ = true;
      error_ = std::current_exception();
    }
    if (outputEnded_) endInput();
  }

  // Writes the answers of all finished claims in order, up to the first unfinished one. REQUIRES output_.
  void writeDue() {
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
  }

  // Locks output_ for the watching thread. A worker holds this mutex as long as its output is not read.
  // Polling replaces waiting for the mutex, because the thread sanitizer delivers no signal to a thread that
  // waits for a mutex, and most signals are sent to this thread.
  std::unique_lock<std::mutex> outputForWatcher() {
    std::unique_lock output(output_, std::try_to_lock);
    while (!output && !output.try_lock()) poll(nullptr, 0, 5);
    return output;
  }

  // Writes and flushes all finished records, up to the first unfinished one.
  void writeFinished() {
    const std::unique_lock output = outputForWatcher();
    guardOutput([this] {
      for (InWork& work : inWork_) writer_.write(work.take(nextOut_));
      writer_.flush();
    });
  }

  // Runs on the calling thread until all workers have ended. If the run ends for another reason while a long
  // record is unfinished, it ends the process (RunEnd::leave).
  void watch(uint64_t workers) {
    std::array<pollfd, 3> events{{{workerEnded_.descriptor(), POLLIN, 0},
                                  {wake_.descriptor(), POLLIN, 0},
                                  {signals_ != nullptr ? signals_->descriptor() : -1, POLLIN, 0}}};
    const bool awaited = interval_ == 0 || options_.progressSeconds > 0;
    const int delay = awaited ? static_cast<int>(kLongestDelay.count()) : -1;
    uint64_t ended = 0;
    while (ended < workers && !stopping()) {
      if (poll(events.data(), events.size(), delay) == 0) {
        if (interval_ == 0) writeFinished();
        const std::unique_lock output = outputForWatcher();
        reportProgress();
      }
      ended += workerEnded_.count();
    }
    if (ended == workers) return;
    if (!stopped_) endForSignal();
    for (const auto end = Clock::now() + kGrace; ended < workers;) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
      if (left.count() <= 0) break;
      poll(events.data(), 1, static_cast<int>(left.count()));
      ended += workerEnded_.count();
    }
    if (ended < workers && end_.leave) end_.leave(conclude());
  }

  // Answers that workers finish within kGrace are also written, and their errors are reported: if a file
  // grows too large, both SIGXFSZ and an error of write(2) occur, and the latter names the file.
  void endForSignal() {
    writeFinished();
    const std::unique_lock output = outputForWatcher();
    endInput();
  }

  // Writes the remaining answers. Returns the reason why the run ended, or null at the end of the input.
  std::exception_ptr conclude() {
    const std::unique_lock output = outputForWatcher();
    outputEnded_ = true;  // remaining workers write nothing
    try {
      writer_.flush();
    } catch (const rad::Error&) {
      if (!error_) error_ = std::current_exception();  // only the first error is reported
    }
    if (end_.ended) end_.ended();
    if (error_) return error_;
    if (signals_ != nullptr && signals_->raised())
      return std::make_exception_ptr(rad::Error(signals_->name(), rad::Status::signal));
    if (remaining_ == kNoLimit || remaining_ == 0) return nullptr;
    if (end_.shortInput)
      end_.shortInput();
    else
      messages_.warning("unexpected EOF on input");
    return nullptr;
  }

  void waitingForInput(bool waiting) {
    waiting_ = waiting;
    if (!waiting || interval_ != 0) return;
    const std::lock_guard output(output_);
    guardOutput([this] { writer_.flush(); });
  }

  void reportProgress() {
    if (options_.progressSeconds <= 0) return;
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - lastReport_).count() < options_.progressSeconds) return;
    lastReport_ = now;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const auto done = static_cast<double>(recordsOut_);
    if (recordsOut_ == 0)
      return messages_.report(fmt::format("no record finished after {:.1f} seconds", seconds));
    std::string text =
        fmt::format("{} records after {:.1f} seconds, {:.4g} a second", recordsOut_, seconds, done / seconds);
    if (const double all = expectedRecords(); all > 0 && done > 0)
      text += fmt::format(", {:.1f}% done, {:.0f} seconds left", 100 * std::min(done / all, 1.),
                          seconds * std::max(all / done - 1, 0.));
    messages_.report(text);
  }

  // An estimate of the total number of records; 0 if it is unknown. For a file, it assumes that the unread
  // part has as many records per byte as the part already read.
  double expectedRecords() const {
    if (options_.height > 0)
      return static_cast<double>(options_.height) * static_cast<double>(std::max<int64_t>(options_.width, 1));
    const double read = inputShare_;
    return read > 0 ? static_cast<double>(recordsTaken_) / read : 0;
  }

  void stop(std::exception_ptr error) {
    const std::lock_guard output(output_);
    if (!error_) error_ = error;
    outputEnded_ = true;
    endInput();
  }

  // Wakes the thread that waits for input, and the threads that wait for answers to be written.
  void endInput() {
    stopped_ = true;
    wake_.raise();
    written_.notify_all();
  }

  bool stopping() const { return stopped_ || (signals_ != nullptr && signals_->raised()); }
  bool isBogus(const double* record) const { return perRecord_ == 6 && hasNoDirection({record, 6}); }

  RecordReader& reader_;
  RecordSink& writer_;
  const AnswerOptions& options_;
  const Messages& messages_;
  const StopSignals* signals_;
  const AnswerRecord& answer_;
  const RunEnd& end_;
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
  std::vector<InWork> inWork_;  // by worker
  Clock::time_point start_ = Clock::now(), lastReport_ = start_;

  std::atomic<bool> stopped_{false}, waiting_{false};
  std::atomic<uint64_t> recordsTaken_{0};  // like inputShare_, only for progress reports
  std::atomic<double> inputShare_{0};
  Event wake_;         // the run ends: no thread waits for input any longer
  Event workerEnded_;  // raised once by each worker
};

}  // namespace

void runRecords(RecordReader& reader, RecordSink& writer, const AnswerOptions& options,
                const Messages& messages, StopSignals* signals, const AnswerRecord& answer,
                const RunEnd& end) {
  if (signals != nullptr) signals->defer(true);
  Batch(reader, writer, options, messages, signals, answer, end).run();
  if (signals != nullptr) signals->defer(false);
}

}  // namespace rsphere
