#include "rcontrib/output_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace rsphere {
namespace {

// The parsed value of -o or -oe: text, and parts to be inserted.
struct Format {
  enum class Kind : uint8_t { text, modifier, number };
  struct Part {
    Kind kind;
    std::string text;  // for a number: the digits between % and d
  };
  std::vector<Part> parts;

  bool has(Kind kind) const { return std::ranges::find(parts, kind, &Part::kind) != parts.end(); }
};

[[noreturn]] void wrongFormat(std::string_view option, const std::string& spec) {
  throw rad::Error(
      fmt::format("{} '{}': only %s, the modifier, and %d, the bin (%04d and the like), each "
                  "once, can be put in; %% is a percent sign",
                  option, spec));
}

Format formatOf(std::string_view option, const std::string& spec) {
  using Kind = Format::Kind;
  Format format{{{Kind::text, ""}}};
  for (size_t i = 0; i < spec.size(); ++i) {
    if (spec[i] != '%' || (i + 1 < spec.size() && spec[i + 1] == '%')) {
      format.parts.back().text += spec[i];
      i += spec[i] == '%';
      continue;
    }
    const size_t end = std::min(spec.find_first_not_of("0123456789", i + 1), spec.size());
    const std::string digits = spec.substr(i + 1, end - i - 1);
    const char letter = end < spec.size() ? spec[end] : 0;
    const Kind kind = letter == 's' ? Kind::modifier : Kind::number;
    if ((letter != 's' && letter != 'd') || digits.size() > 3 || format.has(kind)) wrongFormat(option, spec);
    format.parts.push_back({kind, digits});
    format.parts.push_back({Kind::text, ""});
    i = end;
  }
  return format;
}

// A number as printed by printf's %d with a width.
std::string padded(uint64_t number, const std::string& digits) {
  const int width = digits.empty() ? 0 : std::stoi(digits);
  return digits.starts_with('0') ? fmt::format("{:0{}}", number, width) : fmt::format("{:{}}", number, width);
}

std::string nameOf(const Format& format, const std::string& modifier, uint64_t number) {
  std::string name;
  for (const Format::Part& part : format.parts)
    name += part.kind == Format::Kind::text       ? part.text
            : part.kind == Format::Kind::modifier ? modifier
                                                  : padded(number, part.text);
  return name;
}

class Planner {
 public:
  explicit Planner(const ContributionOptions& options)
      : pictures_(options.out == NumberFormat::rgbe && options.hasResolution()) {}

  // spec: of -o, or of -oe.
  void add(const TrackedName& tracked, const std::string& spec, bool errors, ColumnRange columns) {
    const Format format = formatOf(errors ? "-oe" : "-o", spec);
    errors_ = errors;
    const bool named = format.has(Format::Kind::modifier);
    if (!format.has(Format::Kind::number)) {
      join(nameOf(format, tracked.name, 0), {tracked.name, named}, columns, std::nullopt);
      return;
    }
    uint64_t& before = numbersBefore_[spec];
    for (uint32_t i = 0; i < columns.count; ++i) {
      const uint64_t number = before + i;
      join(nameOf(format, tracked.name, number), {tracked.name, named}, {columns.first + i, 1}, number);
    }
    if (pictures_ && !named) before += columns.count;
  }

  std::vector<OutputPlan> plans() && {
    for (const OutputPlan& plan : plans_)
      if (pictures_ && plan.columnCount() > 1)
        throw rad::Error(
            fmt::format("{} would have {} values at a pixel: a picture for each needs %d, %s or "
                        "both in the name of -o",
                        plan.name.empty() ? "standard output" : '"' + plan.name + '"', plan.columnCount()));
    return std::move(plans_);
  }

 private:
  struct Modifier {
    const std::string& name;
    bool inFileName;  // by %s
  };

  // As in RADIANCE, the header names the modifier if the name of the file does, or if the file has one value
  // per record.
  void join(const std::string& name, const Modifier& modifier, ColumnRange columns,
            const std::optional<uint64_t>& number) {
    const auto [found, isNew] = byName_.emplace(name, plans_.size());
    if (isNew) {
      plans_.push_back({name, {}, "", number ? fmt::format("{}", *number) : "", errors_});
      if (modifier.inFileName || columns.count == 1) plans_.back().modifier = modifier.name;
      isNamed_.push_back(modifier.inFileName);
    }
    OutputPlan& plan = plans_[found->second];
    if (plan.errors != errors_)
      throw rad::Error(
          fmt::format("-oe '{}': this output has values: standard errors need one of their own", name));
    plan.columns.push_back(columns);
    if (!isNew && !isNamed_[found->second]) plan.modifier.clear();
  }

  const bool pictures_;
  bool errors_ = false;  // of the output that is being added
  std::vector<OutputPlan> plans_;
  std::vector<bool> isNamed_;  // of each plan: by %s of the first -o with this name
  std::map<std::string, size_t> byName_;
  std::map<std::string, uint64_t> numbersBefore_;  // by -o: numbers already used for pictures
};

}  // namespace

uint32_t OutputPlan::columnCount() const {
  uint32_t count = 0;
  for (const ColumnRange& range : columns) count += range.count;
  return count;
}

std::vector<OutputPlan> planOutputs(const ContributionOptions& options, const Tracked& tracked) {
  Planner planner(options);
  for (size_t i = 0; i < options.tracked.size(); ++i) {
    const TrackedName& name = options.tracked[i];
    const ColumnRange columns{tracked.firstColumn(i), tracked.modifiers()[i].bins};
    planner.add(name, name.output, false, columns);
    if (!name.errors.empty()) planner.add(name, name.errors, true, columns);
  }
  return std::move(planner).plans();
}

}  // namespace rsphere
