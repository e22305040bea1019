#pragma once
// Reports as a web page: one file with everything in it, without scripts. Pages use light or dark colors as
// the reader's system does, and can be printed.
#include <ctime>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rsphere {

struct PageTable {
  struct Row {
    std::vector<std::string> cells;
    bool chosen = false;  // is emphasized
  };
  std::vector<std::string> head;
  std::vector<Row> rows;
  size_t textColumns = 1;   // at the left; the other columns are numbers, which are aligned at the right
  bool lastIsText = false;  // so is the last column
};

struct PagePicture {
  std::string png, caption;  // the bytes of a PNG file
};

enum class Tone { good, open, bad };

// All text is plain text, which the functions escape; `svg` alone is markup.
class Page {
 public:
  // title: also that of the window. above: a line of small text above it.
  Page(std::string title, std::string above);

  void heading(std::string_view text);
  // An explanation, in smaller text.
  void note(std::string_view text);
  // A conspicuous sentence.
  void banner(Tone tone, std::string_view text);
  // A command line to be copied.
  void command(std::string_view line);
  // Lines of fixed pitch.
  void lines(std::string_view text);
  // Names and values, a pair for each line.
  void facts(const std::vector<std::pair<std::string, std::string>>& pairs);
  void table(const PageTable& table);
  // folded: is shown when the reader opens it.
  void foldedTable(std::string_view summary, const PageTable& table);
  void figure(const std::string& svg, std::string_view caption);
  void pictures(std::span<const PagePicture> pictures);

  // The page, which is well-formed as XML too.
  std::string html() const;

 private:
  std::string title_, above_, body_;
};

// A moment in local time, with the name of its zone: "2026-11-23 14:05 CET".
std::string dateAndTime(std::time_t when);

// Writes a file. Throws rad::Error (Status::system), with its name, if it cannot be written.
void writeTextFile(const std::string& name, std::string_view text);

}  // namespace rsphere
