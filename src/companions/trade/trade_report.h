#pragma once
#include <ctime>
#include <span>
#include <string>
#include <vector>

#include "companions/trade/curve.h"

namespace rsphere {

// Tables with a line for each setting: as text with an explanation of marks, and as comma-separated values.
std::string tradeTable(std::span<const Figures> all);
std::string tradeCsv(std::span<const Figures> all, const Reference& reference);

// States that errors do not include the light of further bounces, because the reference omits it as well, and
// how to measure it.
std::string bouncesText(int bounces);

// The subject of a report, apart from the settings.
struct TradeSubject {
  std::string scene;       // files of the scene
  std::string pointsFile;  // file of points, and number of points in it
  size_t pointsInFile = 0;
  std::vector<double> points;  // measured points, or the origins and directions of rays
  size_t perPoint = 3;         // numbers of each: 3 of a point, 6 of a ray
  double accuracy = 0;         // requested accuracy
  int bounces = 0;             // of the reference (-ab)
  Recommendation recommended;
  std::string command;         // command line with the recommended setting
  std::string given;           // the command line of rsphere-trade
  std::string referenceWords;  // the setting of the reference
  int repeats = 0;             // number of repeats of each setting
  size_t repeatsOfLast = 0;    // number of repeats of the last setting, if a signal ended it early; otherwise
                               // 0
};

// An SVG plot of rms error against seconds for a point, with logarithmic axes. Each setting is a mark in the
// color of its weights (-Sw). A line connects the best settings, and a ring marks the recommended one.
// Settings without error or time are omitted.
std::string tradePlot(std::span<const Figures> all, const TradeSubject& subject);

// An HTML page with the plot, the table, the command and the points.
// REQUIRES: reference was computed for subject.points.
std::string tradePage(std::span<const Figures> all, const Reference& reference, const TradeSubject& subject,
                      std::time_t when);

}  // namespace rsphere
