#pragma once
#include <cstdint>
#include <string>

#include "answer/answer_options.h"
#include "answer/output_colors.h"
#include "importance/point_answer.h"
#include "transport/ray_answer.h"

namespace rsphere {

// How many numbers and names one record of the chosen -o letters has: what the header says as NCOMP. '~'
// counts as none, as in rtrace.
int componentCount(const AnswerOptions& options);

// Appends records of the chosen -o letters, in their order and in the output format, to a string of bytes.
// REQUIRES options from parseOptions(), alive as long as this is.
class AnswerWriter {
 public:
  explicit AnswerWriter(const AnswerOptions& options) : options_(options), colors_(options.color) {}

  // One ray, in ray mode and under -Sd, where `record` is the number of the point's record, from 0 (letter
  // i).
  void write(std::string& bytes, const RayAnswer& answer, uint64_t record = 0) const;

  // One ray of a tree (-ot), behind a TAB for each of its ancestors, unless -te or -ti leaves it out.
  void writeBranch(std::string& bytes, const RayAnswer& answer, int ancestors) const;

  // One point, in sphere mode.
  void write(std::string& bytes, const PointAnswer& answer) const;

 private:
  const AnswerOptions& options_;
  OutputColors colors_;
};

// The ray that rtrace traces for the six numbers of an input record: direction made a unit vector; under -I
// the origin is moved 1.1e-4 scene units along it and the direction turned round, and -o prints them so.
// `length` is that of the given direction (-ld limits the ray to it), 0 where it has none.
struct InputRay {
  V3d origin{0, 0, 0}, direction{0, 0, 0};
  double length = 0;
};
InputRay inputRay(const double* numbers, Irradiance irradiance);

// What rtrace writes for a record whose direction is zero: the ray before it (zeros if there is none), seeing
// nothing.
RayAnswer bogusAnswer(const InputRay& before);

}  // namespace rsphere
