#pragma once
#include <ctime>
#include <span>
#include <string>
#include <string_view>

#include "answer/answer_options.h"
#include "answer/record_writer.h"

namespace rsphere {

// The program's name and version, for the line SOFTWARE=.
std::string versionLine();

// The text that -version prints if the program is called by this name. Programs that look for RADIANCE
// run "rtrace -version" and take the first number, the first digit or the second word as RADIANCE's
// version. Under the names rtrace and rcontrib, the text therefore begins with the version of RADIANCE that
// is matched; that of rsphere follows.
std::string versionAnswer(std::string_view program);

// The command line: program and options, and the scene if withScene. Words are quoted where this is necessary
// to type the command again. No line end.
std::string commandLine(const AnswerOptions& options, bool withScene);

// The first lines of a header, which are those of rtrace and rpict:
//   - the lines of sceneHeader, the header of an octree (without line ends); for scene text, "#?RADIANCE"
//   - the command line. As in rtrace, it does not name an octree, whose own header does; it does name scene
//     text, which has no header
//   - SOFTWARE=
std::string provenance(const AnswerOptions& options, std::span<const std::string> sceneHeader);

// The name of a format in FORMAT= and -defaults: "ascii", "float", "double", or the format of the pixels.
std::string_view formatName(NumberFormat format, const ColorOptions& color);

// What a header says of the records of one output.
struct RecordLayout {
  int components = 0;   // NCOMP=; 0: no such line
  std::string lines{};  // further lines, with line ends
  bool resolution = true;  // whether the resolution line follows with -x and -y
};

// Writes the information header of rtrace, unless it is switched off (-h-):
//   - provenance()
//   - CAPDATE= (local time), GMT=
//   - NCOMP=, except for ray trees
//   - WAVELENGTH_SPLITS= or PRIMARIES=, if colors are not written as RGB
//   - the layout's lines; of points with -Sp: CONTRIBUTORS= and their names, in the order of the parts; with
//     -Sz: ZONES= and their numbers in each row
//   - BigEndian=, for floats and doubles
//   - FORMAT=, an empty line
// If -x and -y are both given, the resolution line follows, even without a header.
// If the output is floats or doubles and can seek, blanks after FORMAT= align the records to their size.
// Source: RADIANCE file formats, "Information header"; rtrace(1).
void writeHeader(RecordWriter& writer, const AnswerOptions& options, std::span<const std::string> sceneHeader,
                 std::time_t now, const RecordLayout& layout);
// The same for the records of rtrace and of points.
void writeHeader(RecordWriter& writer, const AnswerOptions& options, std::span<const std::string> sceneHeader,
                 std::time_t now);

}  // namespace rsphere
