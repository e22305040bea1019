#include "answer/answer_writer.h"

#include <algorithm>
#include <cmath>

#include "points/kernels.h"
#include "records/record_text.h"

namespace rsphere {
namespace {

// Distance (scene units) from a sensor (-I) at which rtrace starts its ray, so that it clears the surface of
// the sensor.
constexpr double kSensorHeight = 1.1e-4;

// Normalizes a vector and returns its length. A vector of length 0 leaves `unit` unchanged. The result
// equals, bit by bit, that of an rtrace compiled with fused multiply-add. If the length is 1 to six digits
// (the precision of text), the vector is corrected to first order (error below 4e-13); otherwise it is
// multiplied by a reciprocal. The bits matter where rounding decides on which side of a plane a hit lies, and
// so, for example, which square of a checkered floor a function file sees.
double makeUnit(const V3d& vector, V3d& unit) {
  const double square = std::fma(vector.z, vector.z, std::fma(vector.x, vector.x, vector.y * vector.y));
  if (square == 0) return 0;
  if (!std::isfinite(square)) {
    const double largest = std::max({std::fabs(vector.x), std::fabs(vector.y), std::fabs(vector.z)});
    return largest * makeUnit(vector / largest, unit);
  }
  constexpr double kNearlyUnit = 1e-6;
  const bool nearly = square <= 1 + kNearlyUnit && square >= 1 - kNearlyUnit;
  const double length = nearly ? .5 + .5 * square : std::sqrt(square);
  unit = vector * (nearly ? 2 - length : 1 / length);
  return length;
}

}  // namespace

// Calls write() for the color or, if there are contributors, for the part due to each.
template <class Write>
void AnswerWriter::eachPart(const Color& color, const Write& write) const {
  if (options_.contributors.empty()) return write(color);
  for (size_t i = 0; i < options_.contributors.size(); ++i) write(color.part(i));
}

// The error of a part's brightness is an upper bound that assumes full correlation of the errors of the
// channels. They are nearly correlated, because the same paths contribute to all channels.
void AnswerWriter::writeError(RecordText& text, const RayAnswer& answer) const {
  if (options_.contributors.empty())
    return colors_.writeError(text, answer.standardError, answer.brightnessError);
  eachPart(answer.standardError.color,
           [&](const Color& part) { colors_.writeError(text, Radiance(part), brightness(part)); });
}

void AnswerWriter::writeLetter(RecordText& text, char letter, const RayAnswer& answer) const {
  const auto radiance = [&](const Radiance& all) {
    eachPart(all.color, [&](const Color& part) { colors_.write(text, Radiance(part)); });
  };
  switch (letter) {
    case 'o': return text.vector(answer.origin);
    case 'd': return text.vector(answer.direction);
    case 'v': return radiance(answer.value);
    case 'e': return writeError(text, answer);
    case 'V': return radiance(answer.value * answer.contribution);
    case 'r': return radiance(answer.mirroredContribution);
    case 'x': return radiance(answer.unmirroredContribution);
    case 'R': return text.number(answer.mirroredLength);
    case 'X': return text.number(answer.unmirroredLength);
    case 'l': return text.number(answer.effectiveLength);
    case 'L': return text.number(answer.firstLength);
    case 'c': text.number(answer.u); return text.number(answer.v);
    case 'p': return text.vector(answer.point);
    case 'n': return text.vector(answer.normal);
    case 'N': return text.vector(answer.unperturbedNormal);
    case 's': return text.name(answer.surface.text());
    case 'm': return text.name(answer.modifier);
    case 'M': return text.name(answer.material);
    case 'w': return text.number(answer.rayWeight);
    case 'W': return colors_.write(text, answer.contribution);
    case '~': return text.name("~");
  }
}

void AnswerWriter::write(std::string& bytes, const RayAnswer& answer, uint64_t record) const {
  if (options_.outputs.empty()) return;  // with -ot alone, only trees are written
  RecordText text(bytes, options_.out);
  for (const char letter : options_.outputs) {
    if (letter == 'i')
      text.integer(record);
    else if (letter == 'w' && options_.sphereMode)
      text.number(answer.solidAngle);
    else
      writeLetter(text, letter, answer);
  }
  text.end();
}

void AnswerWriter::writeLightVector(RecordText& text, const PointAnswer& answer) const {
  if (options_.contributors.empty()) return text.vector(answer.lightVector);
  const Irradiance* const f = answer.facing;
  for (size_t i = 0; i < options_.contributors.size(); ++i)
    for (size_t axis = 0; axis < 3; ++axis)
      text.number(brightness(f[2 * axis].color.part(i)) - brightness(f[2 * axis + 1].color.part(i)));
}

void AnswerWriter::writeErrorsOfLightVector(RecordText& text, const PointAnswer& answer) const {
  const size_t parts = options_.contributors.size();
  const auto* const errors = answer.quantityErrors.data() + Kernels::vector;
  for (size_t i = 0; i < std::max<size_t>(1, parts); ++i)
    for (size_t axis = 0; axis < 3; ++axis)
      text.number(parts > 0 ? brightness(errors[axis].channels.color.part(i)) : errors[axis].brightness);
}

void AnswerWriter::writeBranch(std::string& bytes, const RayAnswer& answer, int ancestors) const {
  const auto named = [&](const std::vector<std::string>& list) {
    return std::ranges::find(list, answer.modifier) != list.end();
  };
  const bool hit = !answer.surface.isNone();
  if (!options_.treeIncluded.empty() && !(hit && named(options_.treeIncluded))) return;
  if (hit && named(options_.treeExcluded)) return;
  bytes.append(static_cast<size_t>(ancestors), '\t');
  RecordText text(bytes, options_.out);
  for (const char letter : options_.treeOutputs) writeLetter(text, letter, answer);
  text.end();
}

// Writes all values of the first contributor, then those of the next.
void AnswerWriter::writeColors(RecordText& text, const PointQuantity& quantity,
                               const PointAnswer& answer) const {
  const size_t parts = options_.contributors.size();
  for (size_t i = 0; i < std::max<size_t>(1, parts); ++i)
    quantity.each(answer, options_.sphere, [&](const Color& all, double ofBrightness) {
      const Radiance own(parts > 0 ? all.part(i) : all);
      if (quantity.form == PointQuantity::Form::colors)
        colors_.write(text, own);
      else
        colors_.writeError(text, own, parts > 0 ? brightness(own) : ofBrightness);  // as in writeError()
    });
}

void AnswerWriter::write(std::string& bytes, const PointAnswer& answer) const {
  using Form = PointQuantity::Form;
  RecordText text(bytes, options_.out);
  for (const PointQuantity* const quantity : pointQuantities(options_.outputs)) {
    switch (quantity->form) {
      case Form::place: text.vector(answer.point); break;
      case Form::colors:
      case Form::errors: writeColors(text, *quantity, answer); break;
      case Form::vector: writeLightVector(text, answer); break;
      case Form::vectorErrors: writeErrorsOfLightVector(text, answer); break;
      case Form::count: text.integer(answer.directions); break;
    }
  }
  text.end();
}

void AnswerWriter::write(std::string& bytes, const GlareAnswer& answer) const {
  RecordText text(bytes, options_.out);
  for (const char letter : options_.outputs) switch (letter) {
      case 'o': text.vector(answer.eye); break;
      case 'd': text.vector(answer.gaze); break;
      case 'n': text.integer(answer.sources.size()); break;
      case 't': text.number(answer.threshold); break;
      case 'u': text.number(answer.indices.ugr); break;
      case 'U': text.number(answer.errors.ugr); break;
      case 'v': text.number(answer.indices.illuminance); break;
      case 'V': text.number(answer.errors.illuminance); break;
      case 'b': text.number(answer.indices.background); break;
      case 'B': text.number(answer.errors.background); break;
      case 'g': text.number(answer.indices.dgp); break;
      case 'G': text.number(answer.errors.dgp); break;
    }
  text.end();
}

void AnswerWriter::write(std::string& bytes, const GlareSource& source, const GlareAnswer& eye,
                         const Scene& scene, uint64_t record) const {
  RecordText text(bytes, options_.out);
  const bool known = source.surface != kNone;
  for (const char letter : options_.outputs) switch (letter) {
      case 'i': text.integer(record); break;
      case 'o': text.vector(eye.eye); break;
      case 'd': text.vector(source.direction); break;
      case 'l': text.number(source.luminance); break;
      case 'L': text.number(source.luminanceError); break;
      case 'w': text.number(source.solidAngle); break;
      case 'W': text.number(source.solidAngleError); break;
      case 'p': text.number(source.positionIndex); break;
      case 's': text.name(known ? SurfaceName(scene, source.surface).text() : "*"); break;
    }
  text.end();
}

InputRay inputRay(const double* numbers, IrradianceAt irradiance, double samePlace) {
  InputRay ray;
  ray.origin = V3d(numbers[0], numbers[1], numbers[2]);
  const V3d given(numbers[3], numbers[4], numbers[5]);
  ray.length = makeUnit(given, ray.direction);
  if (ray.length == 0) return ray;
  if (irradiance == IrradianceAt::point) {
    ray.origin += kSensorHeight * (samePlace / kSamePlace) * ray.direction;
    ray.direction = -ray.direction;
  }
  return ray;
}

RayAnswer bogusAnswer(const InputRay& before) {
  RayAnswer answer;
  answer.origin = answer.point = before.origin;
  answer.direction = before.direction;
  return answer;
}

}  // namespace rsphere
