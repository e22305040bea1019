#include "companions/report/page.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "companions/report/markup.h"
#include "rad_parser/error.h"

namespace rsphere {

extern const std::string_view kPageStyle;  // page.css

namespace {

// Text that may be broken before an option, but neither within an option nor between an option and its value.
std::string withOptionsWhole(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const size_t next = std::min(text.find(" -", 1), text.size());
    const std::string_view part = text.substr(0, next);
    const bool isOption = part.starts_with('-') || part.starts_with(" -");
    const std::string_view blank = part.starts_with(' ') ? " " : "";
    out += isOption ? fmt::format("{}<span>{}</span>", blank, escaped(part.substr(blank.size())))
                    : escaped(part);
    text.remove_prefix(next);
  }
  return out;
}

std::string markupOf(const PageTable& table) {
  std::string out = "<div class=\"wide\"><table>\n";
  const auto row = [&](const std::vector<std::string>& cells, std::string_view tag) {
    for (size_t i = 0; i < cells.size(); ++i) {
      const bool isText = i < table.textColumns || (table.lastIsText && i + 1 == cells.size());
      out += fmt::format("<{0}{1}>{2}</{0}>", tag, isText ? " class=\"text\"" : "",
                         isText ? withOptionsWhole(cells[i]) : escaped(cells[i]));
    }
    out += "</tr>\n";
  };
  out += "<thead><tr>";
  row(table.head, "th");
  out += "</thead><tbody>\n";
  for (const PageTable::Row& one : table.rows) {
    out += one.chosen ? "<tr class=\"chosen\">" : "<tr>";
    row(one.cells, "td");
  }
  return out + "</tbody></table></div>\n";
}

// errno as `why`; 0 if the stream has not kept it.
rad::Error cannotWrite(const std::string& name, int why) {
  return rad::Error(
      fmt::format("cannot write \"{}\"{}{}", name, why ? ": " : "", why ? std::strerror(why) : ""),
      rad::Status::system);
}

}  // namespace

Page::Page(std::string title, std::string above) : title_(std::move(title)), above_(std::move(above)) {}

void Page::heading(std::string_view text) { body_ += fmt::format("<h2>{}</h2>\n", escaped(text)); }

void Page::note(std::string_view text) { body_ += fmt::format("<p class=\"note\">{}</p>\n", escaped(text)); }

void Page::banner(Tone tone, std::string_view text) {
  constexpr std::array kClasses = {"good", "open", "bad"};
  body_ += fmt::format("<p class=\"banner {}\">{}</p>\n", kClasses[static_cast<size_t>(tone)], escaped(text));
}

void Page::command(std::string_view line) {
  body_ += fmt::format("<pre class=\"command\">{}</pre>\n", escaped(line));
}

void Page::lines(std::string_view text) { body_ += fmt::format("<pre>{}</pre>\n", escaped(text)); }

void Page::facts(const std::vector<std::pair<std::string, std::string>>& pairs) {
  body_ += "<table class=\"facts\">\n";
  for (const auto& [name, value] : pairs)
    body_ += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", escaped(name), escaped(value));
  body_ += "</table>\n";
}

void Page::table(const PageTable& table) { body_ += markupOf(table); }

void Page::foldedTable(std::string_view summary, const PageTable& table) {
  body_ += fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(summary), markupOf(table));
}

void Page::figure(const std::string& svg, std::string_view caption) {
  body_ += fmt::format("<figure><div class=\"plot\">\n{}</div><figcaption>{}</figcaption></figure>\n", svg,
                       escaped(caption));
}

void Page::pictures(std::span<const PagePicture> pictures) {
  body_ += "<div class=\"pictures\">\n";
  for (const PagePicture& picture : pictures)
    body_ += fmt::format("<figure><img src=\"{}\" alt=\"{}\"/><figcaption>{}</figcaption></figure>\n",
                         pngUri(picture.png), escaped(picture.caption), escaped(picture.caption));
  body_ += "</div>\n";
}

std::string Page::html() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<p class=\"above\">{2}</p>\n<h1>{0}</h1>\n"
      "{3}</body>\n</html>\n",
      escaped(title_), kPageStyle, escaped(above_), body_);
}

std::string dateAndTime(std::time_t when) {
  std::tm local{};
  std::array<char, 64> text{};
  if (localtime_r(&when, &local) == nullptr) return "";
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M %Z", &local)};
}

void requireWritable(const std::string& name) {
  if (name.empty()) return;
  const std::filesystem::path path(name);
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) throw cannotWrite(name, EISDIR);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  if (access(folder.c_str(), F_OK) != 0) throw cannotWrite(name, errno);
  if (!std::filesystem::is_directory(folder, unknown)) throw cannotWrite(name, ENOTDIR);
  const bool there = access(name.c_str(), F_OK) == 0;
  if (access(there ? name.c_str() : folder.c_str(), there ? W_OK : W_OK | X_OK) != 0)
    throw cannotWrite(name, errno);
}

void writeTextFile(const std::string& name, std::string_view text) {
  errno = 0;
  std::ofstream file(name, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw cannotWrite(name, errno);
}

}  // namespace rsphere
