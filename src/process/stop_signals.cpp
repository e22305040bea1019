#include "process/stop_signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>

#include "rad_parser/printable.h"

namespace rsphere {
namespace {

struct Named {
  int number;
  const char* text;
};
constexpr std::array<Named, 6> kSignals = {{{SIGINT, "Interrupt"},
                                            {SIGHUP, "Hangup"},
                                            {SIGTERM, "Terminate"},
                                            {SIGALRM, "Alarm clock"},
                                            {SIGXCPU, "CPU limit exceeded"},
                                            {SIGXFSZ, "File size exceeded"}}};
constexpr int kStatus = 3;          // as in rtrace(1)
constexpr unsigned kPatience = 15;  // time to finish, in seconds; as in rtrace
// Signals within this time are a single request. timeout(1) sends its signal to the process and to its group:
// twice within microseconds, or more if it is interrupted in between. systemd sends HUP directly after TERM.
// A person who repeats a request is slower.
constexpr int64_t kOneRequest = 50'000'000;  // ns

struct State {
  std::atomic<int> raised{0};  // first signal
  std::atomic<int64_t> raisedAt{0};
  std::atomic<bool> deferred{false};
  std::atomic<bool> told{false};  // whether the caller of name() will write the message
  std::atomic<bool> ending{false};
  std::atomic<int> messageFd{2};
  int pipe[2] = {-1, -1};
  std::array<std::string, kSignals.size()> messages;
  std::array<struct sigaction, kSignals.size() + 1> before{};  // previous handlers, SIGPIPE last
};
State state;

// Opens /dev/null for each standard descriptor that is closed. Otherwise the next file opened would get its
// number, and be read or written instead. It is opened for the wrong direction, so that any use is an error,
// as for a closed descriptor.
void occupyStandardDescriptors() {
  for (int fd = 0; fd <= 2; ++fd)
    if (fcntl(fd, F_GETFD) < 0) [[maybe_unused]]
      const int taken = open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY);
}

// Monotonic time, ns. A signal handler may call it, because it only calls clock_gettime(2).
int64_t now() { return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1); }

void onSignal(int number) {
  const int error = errno;
  int first = 0;
  const bool again = !state.raised.compare_exchange_strong(first, number);
  if (!again) state.raisedAt = now();
  // The time is still 0 while another thread is handling the first signal.
  const int64_t raisedAt = state.raisedAt;
  if (again && state.deferred && (raisedAt == 0 || now() - raisedAt < kOneRequest)) {
    errno = error;
    return;
  }
  if (again || !state.deferred) {
    // If another thread is already here, that thread writes the message.
    if (state.ending.exchange(true)) return;
    for (size_t i = 0; i < kSignals.size() && !state.told; ++i)
      if (kSignals[i].number == (again ? first : number)) {
        const std::string& text = state.messages[i];
        if (write(state.messageFd, text.data(), text.size()) < 0) [[maybe_unused]]
          const ssize_t n = write(2, text.data(), text.size());
      }
    _exit(kStatus);
  }
  alarm(kPatience);
  [[maybe_unused]] const ssize_t n = write(state.pipe[1], "", 1);
  errno = error;
}

}  // namespace

StopSignals::StopSignals(const std::string& program) {
  occupyStandardDescriptors();
  if (pipe2(state.pipe, O_CLOEXEC | O_NONBLOCK) != 0)
    throw rad::systemError("cannot create a pipe for signals");
  state.raised = 0;
  state.raisedAt = 0;
  state.deferred = false;
  state.told = false;
  state.ending = false;
  state.messageFd = 2;
  for (size_t i = 0; i < kSignals.size(); ++i) {
    state.messages[i] = rad::printable(program) + ": signal - " + kSignals[i].text + "\n";
    struct sigaction action {};
    action.sa_handler = onSignal;
    sigemptyset(&action.sa_mask);
    sigaction(kSignals[i].number, nullptr, &state.before[i]);
    if (state.before[i].sa_handler != SIG_IGN) sigaction(kSignals[i].number, &action, nullptr);
  }
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigemptyset(&ignore.sa_mask);
  sigaction(SIGPIPE, &ignore, &state.before.back());
}

StopSignals::~StopSignals() {
  if (raised()) alarm(0);
  for (size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i].number, &state.before[i], nullptr);
  sigaction(SIGPIPE, &state.before.back(), nullptr);
  close(state.pipe[0]);
  close(state.pipe[1]);
}

void StopSignals::reportTo(int fd) { state.messageFd = fd; }
void StopSignals::defer(bool on) { state.deferred = on; }
bool StopSignals::raised() const { return state.raised != 0; }
int StopSignals::descriptor() const { return state.pipe[0]; }

std::string StopSignals::name() const {
  state.told = true;
  for (const Named& signal : kSignals)
    if (signal.number == state.raised) return signal.text;
  return {};
}

}  // namespace rsphere
