#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "answer/answer_options.h"
#include "points/glare_answer.h"
#include "points/point_answer.h"
#include "points/quantities.h"
#include "rays/ray_answer.h"
#include "records/output_colors.h"

namespace rsphere {

// Appends records to a string of bytes: the quantities of the -o letters, in this order, in the output
// format. With contributors (-Sp), the letters v e E C S h H u z Z (in ray mode v V r x) write the part due
// to each contributor in turn. REQUIRES: the options come from parseOptions() and exist as long as the
// writer.
class AnswerWriter {
 public:
  explicit AnswerWriter(const AnswerOptions& options) : options_(options), colors_(options.color) {}

  // Writes a ray of ray mode, or a direction of sphere mode (-Sd). `record`: number of the input record from
  // 0, for letter i.
  void write(std::string& bytes, const RayAnswer& answer, uint64_t record = 0) const;

  // Writes a ray of a tree (-ot), after a TAB for each of its ancestors; nothing if -te or -ti excludes the
  // ray.
  void writeBranch(std::string& bytes, const RayAnswer& answer, int ancestors) const;

  // Writes a point of sphere mode.
  void write(std::string& bytes, const PointAnswer& answer) const;

  // Writes an eye (-Su).
  void write(std::string& bytes, const GlareAnswer& answer) const;

  // Writes a glare source of an eye (-Su -Sd). `record`: number of the eye's record from 0, for letter i.
  void write(std::string& bytes, const GlareSource& source, const GlareAnswer& eye, const Scene& scene,
             uint64_t record) const;

 private:
  template <class Write>
  void eachPart(const Color& color, const Write& write) const;
  // Writes the quantity of an -o letter for a ray.
  void writeLetter(RecordText& text, char letter, const RayAnswer& answer) const;
  void writeError(RecordText& text, const RayAnswer& answer) const;
  void writeErrorsOfLightVector(RecordText& text, const PointAnswer& answer) const;
  void writeColors(RecordText& text, const PointQuantity& quantity, const PointAnswer& answer) const;
  void writeLightVector(RecordText& text, const PointAnswer& answer) const;

  const AnswerOptions& options_;
  OutputColors colors_;
};

// The ray that rtrace traces for the six numbers of an input record, with a normalized direction. With -I,
// the origin is moved along the direction by 1.1e-4 scene units, or less in small scenes, and the direction
// is then reversed; -oo and -od print the result. `length`: of the given direction, which is the ray's limit
// with -ld; 0 for a bogus record. samePlace: Scene::samePlace.
struct InputRay {
  V3d origin{0, 0, 0}, direction{0, 0, 0};
  double length = 0;
};
InputRay inputRay(const double* numbers, IrradianceAt irradiance, double samePlace = kSamePlace);

// Whether a record of ray mode (six numbers) has no direction: as in rtrace, if its squared length is zero in
// floating point.
inline bool hasNoDirection(std::span<const double> ray) {
  return ray[3] * ray[3] + ray[4] * ray[4] + ray[5] * ray[5] == 0;
}

// rtrace's answer to a record whose direction is zero: the preceding ray (zeros if there is none), as if it
// had hit nothing.
RayAnswer bogusAnswer(const InputRay& before);

}  // namespace rsphere
