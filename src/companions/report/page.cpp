#include "companions/report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "companions/report/markup.h"
#include "rad_parser/error.h"

namespace rsphere {
namespace {

// Contains no < and &, because HTML and XML would need different escapes.
constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark; --paper: #ffffff; --ink: #1d2229; --soft: #58616d; --line: #d9dee4;
  --tint: #eef5fc; --code: #f4f6f8; --good: #1a7f37; --open: #9a6700; --bad: #c62828; --mark: #c2185b; }
@media (prefers-color-scheme: dark) { :root { --paper: #15181c; --ink: #e4e8ed; --soft: #9aa4b0;
  --line: #353c45; --tint: #1b2c3f; --code: #1e2329; --good: #4cc26b; --open: #d9a62e; --bad: #ff6b63;
  --mark: #ff5c97; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 68rem; padding: 1.5rem 1rem 3rem; background: var(--paper);
  color: var(--ink); font: 16px/1.5 system-ui, sans-serif; }
h1 { margin: 0 0 1rem; font-size: 1.7rem; line-height: 1.25; overflow-wrap: anywhere; }
h2 { margin: 2rem 0 .6rem; font-size: 1.15rem; }
p { margin: .5rem 0; }
.note { color: var(--soft); font-size: .9rem; max-width: 50rem; }
.above { margin: 0; color: var(--soft); font-size: .9rem; }
.banner { padding: .7rem 1rem; border-left: .35rem solid; background: var(--code); font-weight: 600; }
.good { border-color: var(--good); } .open { border-color: var(--open); } .bad { border-color: var(--bad); }
pre { margin: .5rem 0; padding: .8rem 1rem; overflow-x: auto; background: var(--code);
  border: 1px solid var(--line); border-radius: .3rem; font: .85rem/1.5 ui-monospace, monospace; }
pre.command { white-space: pre-wrap; overflow-wrap: anywhere; border-color: var(--soft); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .87rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .5rem; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap; }
th { color: var(--soft); font-weight: 600; vertical-align: bottom; white-space: normal; }
th.text, td.text { text-align: left; }
td.text { white-space: normal; }
td.text span { white-space: nowrap; }
tr.chosen td { background: var(--tint); font-weight: 600; }
tr.chosen td:first-child { color: var(--mark); }
table.facts td { white-space: normal; overflow-wrap: anywhere; text-align: left; vertical-align: top; }
table.facts td:first-child { color: var(--soft); white-space: nowrap; }
summary { cursor: pointer; color: var(--soft); }
figure { margin: 1rem 0; }
figcaption { color: var(--soft); font-size: .87rem; }
.plot { overflow-x: auto; }
.plot svg { display: block; width: 100%; min-width: 34rem; max-width: 56rem; }
.plot text { fill: var(--ink); }
.plot .paper { fill: var(--paper); }
.plot .grid { stroke: var(--line); }
.plot .frame { stroke: var(--soft); }
.plot .ink { stroke: var(--ink); }
.pictures { display: flex; flex-wrap: wrap; gap: 1rem; }
.pictures figure { flex: 1 1 16rem; max-width: 30rem; margin: 0; }
.pictures img { display: block; width: 100%; border: 1px solid var(--line); image-rendering: pixelated; }
@media print { body { max-width: none; padding: 0; font-size: 11px; } h2 { break-after: avoid; }
  figure, tr, pre { break-inside: avoid; } pre { white-space: pre-wrap; } .wide, .plot { overflow: visible; }
  .plot svg { min-width: 0; max-width: 17cm; } table { font-size: 8.5px; } th, td { padding: 1px 4px; }
  * { print-color-adjust: exact; } }
)";

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
      escaped(title_), kStyle, escaped(above_), body_);
}

std::string dateAndTime(std::time_t when) {
  std::tm local{};
  std::array<char, 64> text{};
  if (localtime_r(&when, &local) == nullptr) return "";
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M %Z", &local)};
}

void writeTextFile(const std::string& name, std::string_view text) {
  std::ofstream file(name, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw rad::Error(fmt::format("cannot write \"{}\"", name), rad::Status::system);
}

}  // namespace rsphere
