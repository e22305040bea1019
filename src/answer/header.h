#pragma once
#include <ctime>
#include <span>
#include <string>
#include <string_view>

#include "answer/answer_options.h"
#include "records/record_writer.h"

namespace rsphere {

// The program's name and version, for the header line SOFTWARE=.
std::string versionLine();

// The text printed by -version if the program is called by this name. Other programs run "rtrace -version" to
// find RADIANCE's version, and take the first number, the first digit or the second word of the text. For the
// names rtrace and rcontrib, the text therefore begins with the matched version of RADIANCE, followed by that
// of rsphere.
std::string versionAnswer(std::string_view program);

// The command line: program, options and, if withScene, the scene. Words are quoted if this is necessary to
// repeat the command. No line end.
std::string commandLine(const AnswerOptions& options, bool withScene);

// The first lines of a header, as in rtrace and rpict:
//   - sceneHeader, the lines of the header of an octree (without line ends); for scene text, "#?RADIANCE"
//   - the command line. As in rtrace, it omits the name of an octree, which the octree's own header contains,
//     but includes names of scene text, which has no header
//   - SOFTWARE=
std::string provenance(const AnswerOptions& options, std::span<const std::string> sceneHeader);

// The name of a format in FORMAT= and -defaults: "ascii", "float", "double", or the format of the pixels.
std::string_view formatName(NumberFormat format, const ColorOptions& color);

// The description of an output's records in its header.
struct RecordLayout {
  int components = 0;      // NCOMP=; 0: no such line
  std::string lines{};     // further lines, including line ends
  bool resolution = true;  // whether -x and -y add the resolution line
};

// The line "-Y 480 +X 640" of -x and -y.
std::string resolutionLine(const AnswerOptions& options);

// Writes an information header like rtrace's, unless it is disabled (-h-):
//   - provenance()
//   - CAPDATE= (local time), GMT=
//   - NCOMP=, except for ray trees
//   - WAVELENGTH_SPLITS= or PRIMARIES=, if colors are not written as RGB
//   - the lines of the layout; for points with -Sp: CONTRIBUTORS= and their names, in the order of the parts;
//     with -Sz: ZONES= and the number of zones in each row
//   - BigEndian=, for floats and doubles
//   - FORMAT=, an empty line
// If -x and -y are both given, the resolution line follows, even without a header. If the output is floats or
// doubles in a seekable file, blanks after FORMAT= align the records to their size. Source: RADIANCE file
// formats, "Information header"; rtrace(1).
void writeHeader(RecordWriter& writer, const AnswerOptions& options, std::span<const std::string> sceneHeader,
                 std::time_t now, const RecordLayout& layout);
// Writes the header of the records of rays, as rtrace does, or of points.
void writeHeader(RecordWriter& writer, const AnswerOptions& options, std::span<const std::string> sceneHeader,
                 std::time_t now);

}  // namespace rsphere
