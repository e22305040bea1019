#pragma once
#include <ctime>
#include <span>
#include <string>
#include <string_view>

#include "answer/answer_options.h"
#include "answer/record_writer.h"

namespace rsphere {

// The program's name and version, as SOFTWARE= has them.
std::string versionLine();

// What -version prints of a program that was called by this name. Programs that look for RADIANCE run
// "rtrace -version" and take the first number, the first digit, or the second word for RADIANCE's version:
// under the name rtrace the version of RADIANCE that is matched comes first, and rsphere's behind it.
std::string versionAnswer(std::string_view program);

// The command as it can be typed again: program and options, words quoted where they need it, without a line
// end; the scene only where asked for.
std::string commandLine(const AnswerOptions& options, bool withScene);

// The first lines of a header, as rtrace and rpict begin theirs:
//   - the lines of the scene's own header (an octree has one: sceneHeader, without line ends), or
//     "#?RADIANCE"
//   - the command line; the octree is left out, as rtrace does: its header names it. Scene text has no
//     header, so its names are kept
//   - SOFTWARE=
std::string provenance(const AnswerOptions& options, std::span<const std::string> sceneHeader);

// The name that FORMAT= and -help give a format: "ascii", "float", "double", or that of the colors' pixels.
std::string_view formatName(NumberFormat format, const ColorOptions& color);

// Writes the information header that rtrace writes before its records, unless switched off (-h-), and then
// the resolution line where -x and -y are both given, header or not:
//   - provenance()
//   - CAPDATE= (local), GMT=, NCOMP= (not for trees), WAVELENGTH_SPLITS= or PRIMARIES= for what is
//   not RGB, BigEndian= for floats and doubles, FORMAT=, an empty line
// The FORMAT line of floats or doubles is padded with blanks so that the records are aligned, if the output
// can seek. Source: RADIANCE file formats, "Information header"; rtrace(1).
void writeHeader(RecordWriter& writer, const AnswerOptions& options, std::span<const std::string> sceneHeader,
                 std::time_t now);

}  // namespace rsphere
