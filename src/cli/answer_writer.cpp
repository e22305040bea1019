#include "cli/answer_writer.h"

#include <cmath>

#include "cli/records.h"

namespace rsphere {
namespace {

// Scene units; rtrace starts there so as to be clear of the surface that a sensor lies on.
constexpr double kSensorHeight = 1.1e-4;

}  // namespace

int componentCount(const Options& options) {
  int count = 0;
  for (const char letter : options.outputs) switch (letter) {
      case 'o':
      case 'd':
      case 'v':
      case 'V':
      case 'r':
      case 'x':
      case 'p':
      case 'n':
      case 'N':
      case 'W':
      case 'e':
      case 'E':
      case 'C':
      case 'u':
        count += 3;
        break;
      case 'H':
        count += 18;
        break;
      case 'c':
        count += 2;
        break;
      case '~':
        break;
      default:
        count += 1;
        break;
    }
  return count;
}

void AnswerWriter::write(std::string& bytes, const RayAnswer& answer, uint64_t record) const {
  RecordText text(bytes, options_.out);
  for (const char letter : options_.outputs) switch (letter) {
      case 'i':
        text.integer(record);
        break;
      case 'o':
        text.vector(answer.origin);
        break;
      case 'd':
        text.vector(answer.direction);
        break;
      case 'v':
        text.color(answer.value);
        break;
      case 'V':
        text.color(answer.value * answer.weight);
        break;
      case 'r':
        text.color(answer.mirroredContribution);
        break;
      case 'x':
        text.color(answer.unmirroredContribution);
        break;
      case 'R':
        text.number(answer.mirroredLength);
        break;
      case 'X':
        text.number(answer.unmirroredLength);
        break;
      case 'l':
        text.number(answer.effectiveLength);
        break;
      case 'L':
        text.number(answer.firstLength);
        break;
      case 'c':
        text.number(answer.u);
        text.number(answer.v);
        break;
      case 'p':
        text.vector(answer.point);
        break;
      case 'n':
        text.vector(answer.normal);
        break;
      case 'N':
        text.vector(answer.unperturbedNormal);
        break;
      case 's':
        text.name(answer.surface);
        break;
      case 'm':
        text.name(answer.modifier);
        break;
      case 'M':
        text.name(answer.material);
        break;
      case 'w':
        text.number(options_.sphere.on ? answer.solidAngle : brightness(answer.weight));
        break;
      case 'W':
        text.color(answer.weight);
        break;
      case '~':
        text.name("~");
        break;
    }
  text.end();
}

void AnswerWriter::write(std::string& bytes, const PointAnswer& answer) const {
  RecordText text(bytes, options_.out);
  for (const char letter : options_.outputs) switch (letter) {
      case 'o':
        text.vector(answer.point);
        break;
      case 'v':
        text.color(answer.mean);
        break;
      case 'e':
        text.color(answer.standardError);
        break;
      case 'E':
        text.color(answer.scalarIrradiance);
        break;
      case 'C':
        text.color(answer.cylindricalIrradiance);
        break;
      case 'H':
        for (const Rgb& face : answer.facing) text.color(face);
        break;
      case 'u':
        text.vector(answer.lightVector);
        break;
      case 'k':
        text.integer(answer.directions);
        break;
    }
  text.end();
}

namespace {

// Sets unit to the vector's direction; returns its length, and leaves unit alone where that is 0. A vector of
// unit length to six digits, as text has them, is corrected to first order (right to 4e-13), every other is
// multiplied by a reciprocal: to the bit what rtrace does where products are fused. On which side of a plane
// a hit is rounded to depends on it, and with that which square of a checkered floor function files see.
double makeUnit(const V3d& vector, V3d& unit) {
  const double square = std::fma(vector.z, vector.z, std::fma(vector.x, vector.x, vector.y * vector.y));
  if (square == 0) return 0;
  constexpr double kNearlyUnit = 1e-6;
  const bool nearly = square <= 1 + kNearlyUnit && square >= 1 - kNearlyUnit;
  const double length = nearly ? .5 + .5 * square : std::sqrt(square);
  unit = vector * (nearly ? 2 - length : 1 / length);
  return length;
}

}  // namespace

InputRay inputRay(const double* numbers, Irradiance irradiance) {
  InputRay ray;
  ray.origin = V3d(numbers[0], numbers[1], numbers[2]);
  const V3d given(numbers[3], numbers[4], numbers[5]);
  ray.length = makeUnit(given, ray.direction);
  if (ray.length == 0) return ray;
  if (irradiance == Irradiance::point) {
    ray.origin += kSensorHeight * ray.direction;
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
