#pragma once
// Reports as a web page: a single self-contained file, without scripts. Pages follow the reader's system in
// using light or dark colors, and are printable.
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
    bool chosen = false;  // whether it is emphasized
  };
  std::vector<std::string> head;
  std::vector<Row> rows;
  size_t textColumns = 1;   // number of text columns at the left; the other columns are numbers, aligned at
                            // the right
  bool lastIsText = false;  // whether the last column is text, too
};

struct PagePicture {
  std::string png, caption;  // the bytes of a PNG file
};

enum class Tone { good, open, bad };

// All arguments are plain text, which is escaped here, except `svg`, which is markup.
class Page {
 public:
  // title: also of the window. above: small text on a line above the title.
  Page(std::string title, std::string above);

  void heading(std::string_view text);
  // An explanation, in smaller text.
  void note(std::string_view text);
  // A conspicuous sentence.
  void banner(Tone tone, std::string_view text);
  // A command line to be copied.
  void command(std::string_view line);
  // Lines in a fixed-pitch font.
  void lines(std::string_view text);
  // Names and values, one pair per line.
  void facts(const std::vector<std::pair<std::string, std::string>>& pairs);
  void table(const PageTable& table);
  // The table is hidden until the reader opens it.
  void foldedTable(std::string_view summary, const PageTable& table);
  void figure(const std::string& svg, std::string_view caption);
  void pictures(std::span<const PagePicture> pictures);

  // The page as HTML that is also well-formed XML.
  std::string html() const;

 private:
  std::string title_, above_, body_;
};

// A moment in local time, with the name of its zone: "2026-11-23 14:05 CET".
std::string dateAndTime(std::time_t when);

// Throws the fault of writeTextFile() before the work whose result is to be written, and changes nothing. An
// empty name stands for no file.
void requireWritable(const std::string& name);

// Writes a file. Throws rad::Error (Status::system) with its name and the system's reason if it cannot.
void writeTextFile(const std::string& name, std::string_view text);

}  // namespace rsphere
