#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "answer/answer_options.h"
#include "answer/output_colors.h"
#include "importance/glare_answer.h"
#include "importance/point_answer.h"
#include "transport/ray_answer.h"

namespace rsphere {

// The number of numbers and names in a record of the chosen -o letters, for NCOMP= of the header.
// '~' adds none, as in rtrace.
int componentCount(const AnswerOptions& options);

// Appends records to a string of bytes: the quantities that the -o letters name, in their order, in the
// output format. With contributors (-Sp), the letters v e E C H u z Z, in ray mode v V r x, each have the
// part of every contributor in turn. REQUIRES: the options are from parseOptions() and live as long as the
// writer.
class AnswerWriter {
 public:
  explicit AnswerWriter(const AnswerOptions& options) : options_(options), colors_(options.color) {}

  // A ray of ray mode, or a direction of sphere mode (-Sd). `record` is the number of the input
  // record from 0, for letter i.
  void write(std::string& bytes, const RayAnswer& answer, uint64_t record = 0) const;

  // A ray of a tree (-ot), after a TAB for each of its ancestors. Writes nothing if
  // -te or -ti excludes the ray.
  void writeBranch(std::string& bytes, const RayAnswer& answer, int ancestors) const;

  // A point of sphere mode.
  void write(std::string& bytes, const PointAnswer& answer) const;

  // An eye (-Su).
  void write(std::string& bytes, const GlareAnswer& answer) const;

  // A glare source of an eye (-Su -Sd). `record` is the number of the eye's record from 0, for letter i.
  void write(std::string& bytes, const GlareSource& source, const GlareAnswer& eye, const Scene& scene,
             uint64_t record) const;

 private:
  template <class Write>
  void eachPart(const Color& color, const Write& write) const;
  // Writes the quantity of a ray that an -o letter names.
  void writeLetter(RecordText& text, char letter, const RayAnswer& answer) const;
  void writeError(RecordText& text, const PointAnswer& answer) const;
  void writeErrorOfPart(RecordText& text, const Color& part) const;
  void writeZones(RecordText& text, const PointAnswer& answer) const;
  void writeZoneErrors(RecordText& text, const PointAnswer& answer) const;
  void writeFaces(RecordText& text, const PointAnswer& answer) const;
  void writeLightVector(RecordText& text, const PointAnswer& answer) const;

  const AnswerOptions& options_;
  OutputColors colors_;
};

// The ray that rtrace traces for the six numbers of an input record. The direction is normalized. Under -I,
// the origin is moved by 1.1e-4 scene units along it, and the direction is reversed; -oo and -od show them
// so. `length` is that of the given direction, which -ld makes the limit of the ray; 0 for a bogus record.
struct InputRay {
  V3d origin{0, 0, 0}, direction{0, 0, 0};
  double length = 0;
};
InputRay inputRay(const double* numbers, IrradianceAt irradiance);

// Whether a record of ray mode (six numbers) has no direction. As in rtrace, it has none if the squared
// length is zero in floating point.
inline bool hasNoDirection(std::span<const double> ray) {
  return ray[3] * ray[3] + ray[4] * ray[4] + ray[5] * ray[5] == 0;
}

// The answer of rtrace to a record whose direction is zero: the ray before it (zeros if there is
// none), as if it hit nothing.
RayAnswer bogusAnswer(const InputRay& before);

}  // namespace rsphere
