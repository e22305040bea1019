#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "cli/option_table.h"
#include "rad_parser/error.h"

namespace rsphere {

inline Options parse(std::initializer_list<const char*> words) {
  const std::vector<std::string> list(words.begin(), words.end());
  return parseOptions(list);
}

// The text of the fault that `action` throws, whose status must be the given one.
template <class Action>
std::string faultOf(Action action, rad::Status status = rad::Status::input) {
  try {
    action();
  } catch (const rad::Error& error) {
    EXPECT_EQ(error.status(), status) << error.what();
    return error.what();
  }
  return "no fault";
}

inline std::string faultOfOptions(std::initializer_list<const char*> words,
                                  rad::Status status = rad::Status::input) {
  return faultOf([&] { parse(words); }, status);
}

inline std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The bytes of a file of floats or doubles.
template <class Number>
std::string bytesOf(std::initializer_list<Number> numbers) {
  std::string bytes;
  for (const Number x : numbers) bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  return bytes;
}

// A file that the destructor removes.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text = {}) {
    descriptor = mkstemp(path.data());
    EXPECT_GE(descriptor, 0);
    std::ofstream(path, std::ios::binary) << text;
  }
  ~TemporaryFile() {
    close(descriptor);
    unlink(path.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path = "/tmp/rsphere_cli_XXXXXX";
  int descriptor = -1;
};

// Both ends of a pipe.
class Pipe {
 public:
  Pipe() {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    out = ends[0];
    in = ends[1];
  }
  ~Pipe() {
    closeIn();
    closeOut();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void put(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t n = write(in, text.data(), text.size());
      if (n < 0) return;
      text.remove_prefix(static_cast<size_t>(n));
    }
  }
  // Waits for data.
  std::string get() const {
    char block[65536];
    const ssize_t n = read(out, block, sizeof block);
    return std::string(block, n > 0 ? static_cast<size_t>(n) : 0);
  }
  std::string getAll() const {
    std::string all;
    for (std::string more = get(); !more.empty(); more = get()) all += more;
    return all;
  }
  // Waits for this number of line ends.
  std::string getLines(long lines) const {
    std::string all;
    while (std::count(all.begin(), all.end(), '\n') < lines) {
      const std::string more = get();
      if (more.empty()) break;
      all += more;
    }
    return all;
  }
  void closeIn() { closeOnce(in); }
  void closeOut() { closeOnce(out); }

  int out = -1, in = -1;

 private:
  static void closeOnce(int& fd) {
    if (fd >= 0) close(fd);
    fd = -1;
  }
};

}  // namespace rsphere
