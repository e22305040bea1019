#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rsphere/version.h"

namespace RSPHERE_API_NAMESPACE {

// A quantity for each record of a call, in the order of the records. Its numbers equal, bit by bit, those
// that the command writes with -fdd and equal options.
struct Quantity {
  size_t columns = 0;  // numbers for each record; 0: the quantity was not requested (Options::outputs)
  std::vector<double> numbers;  // columns for the first record, then columns for the second, ...

  // REQUIRES: the quantity was requested, and record is below RayAnswers::size or PointAnswers::size.
  std::span<const double> operator[](size_t record) const {
    return {numbers.data() + record * columns, columns};
  }
};

// A color has three columns, red, green and blue, unless options select another form: one column with -pY,
// -pS, -pM or -pA, and one for each band with -co and -cs.

// Answers to rays, by the letters of Options::outputs. A ray that hits nothing has names "*", lengths 1e10,
// normals 0, and its origin as the point. As in rtrace, a ray whose direction is 0 is not traced: it gets the
// record that the preceding ray would have if it had hit nothing.
struct RayAnswers {
  size_t size = 0;                    // the number of rays
  Quantity value;                     // v  radiance (W/sr/m2) along the ray; irradiance (W/m2) with -i and -I
  Quantity standardError;             // e  estimated standard error of value
  Quantity origin;                    // o  origin of the traced ray
  Quantity direction;                 // d  of length 1
  Quantity point;                     // p  point that the ray hits
  Quantity normal;                    // n  normal of the surface there, perturbed by textures
  Quantity unperturbedNormal;         // N
  Quantity firstLength;               // L  distance to the first hit (units of the scene)
  Quantity effectiveLength;           // l  distance to the surface whose light dominates the value
  Quantity localCoordinates;          // c  u, v on the surface
  Quantity weight;                    // w
  Quantity coefficient;               // W
  Quantity contribution;              // V
  Quantity mirroredValue;             // r  the mirrored part of the value
  Quantity mirroredLength;            // R
  Quantity unmirroredValue;           // x  the remaining part of the value
  Quantity unmirroredLength;          // X
  std::vector<std::string> surface;   // s  names; empty if they were not requested
  std::vector<std::string> modifier;  // m
  std::vector<std::string> material;  // M
};

// Answers to points. F is the integral of the radiance L over all 4 pi sr of directions. With contributors,
// every quantity except directions and point has one group of columns for each contributor, with the part due
// to it.
struct PointAnswers {
  size_t size = 0;  // the number of points
  // The modifiers of goals, or of light sources with -Sp; empty: quantities are totals.
  std::vector<std::string> contributors;
  Quantity mean;                   // v  mean radiance F/(4 pi) (W/sr/m2)
  Quantity meanStandardError;      // e  estimated standard error of mean: e first, or after v
  Quantity scalarIrradiance;       // E  F/4 (W/m2)
  Quantity cylindricalIrradiance;  // C  about the z axis: 1/pi times the integral of L sin(angle to z) (W/m2)
  Quantity semicylindricalIrradiance;  // S  of the curved surface of a half cylinder towards -So (W/m2)
  Quantity hemisphericalIrradiance;    // h  of the curved surface of the upper half of a sphere (W/m2)
  Quantity faceIrradiance;             // H  of faces towards +x -x +y -y +z -z, a color for each (W/m2)
  Quantity lightVector;  // u  integral of L d over directions d, of brightness, towards more light (W/m2)
  Quantity directions;   // k  number of directions used
  // z  mean radiance of each of Options::zones or directionBins in turn (W/sr/m2). Multiplied by
  // zoneSolidAngles, they sum to 4 pi times `mean` within rounding, if each direction is in a bin.
  Quantity zones;
  Quantity zonesStandardError;          // Z  estimated standard errors of zones
  size_t zoneCount = 0;                 // the number of zones or bins
  std::vector<double> zoneSolidAngles;  // solid angle of each, sr
  Quantity point;                       // o
  // e after the letter of the quantity: its estimated standard error, in its columns
  Quantity scalarIrradianceStandardError, cylindricalIrradianceStandardError;
  Quantity semicylindricalIrradianceStandardError, hemisphericalIrradianceStandardError;
  Quantity faceIrradianceStandardError, lightVectorStandardError;
};

// A glare source, as seen by an eye.
struct GlareSource {
  std::array<double, 3> direction{};  // of the middle of its light, unit
  double luminance = 0;               // mean (cd/m2)
  double luminanceStandardError = 0;
  double solidAngle = 0;  // of the visible part (sr)
  double solidAngleStandardError = 0;
  double positionIndex = 1;  // Guth's; below the line of sight Iwata's
  std::string surface;       // the light source, or the surface that sends most of the light; "*": none
};

// Glare at eyes, by the letters of Options::outputs. Luminances are in cd/m2 and illuminances in lx,
// regardless of the colors that options select. Definitions and sources: GLARE in man/rsphere.1.
struct GlareAnswers {
  size_t size = 0;                    // the number of eyes
  Quantity unifiedGlareRating;        // u  UGR, CIE 117; 0 without glare sources, infinite on a black
                                      // background
  Quantity ugrStandardError;          // U  estimated, like the other standard errors
  Quantity illuminance;               // v  at the eye, in a plane perpendicular to the gaze
  Quantity illuminanceStandardError;  // V
  Quantity background;                // b  luminance of the background, from the illuminance that is not due
                                      // to glare sources
  Quantity backgroundStandardError;   // B
  Quantity daylightGlareProbability;  // g  DGP, Wienold and Christoffersen 2006, 0 to 1
  Quantity dgpStandardError;          // G
  Quantity threshold;                 // t  luminance above which regions are glare sources
  // For each eye, the glare sources in descending order of their weights L^2 omega / P^2.
  std::vector<std::vector<GlareSource>> sources;
};

// The contributions of modifiers to rays: for each ray a color for each bin of each modifier. All bins of the
// first modifier come first, then those of the next.
struct Contributions {
  size_t size = 0;                     // the number of rays
  std::vector<std::string> modifiers;  // as given to contributions()
  size_t bins = 1;                     // of each modifier
  // Radiance (W/sr/m2), irradiance (W/m2) with -i and -I, or coefficients, in red, green and blue; with -cs
  // above 3 in bands.
  Quantity value;
  // Estimated standard error of value, in its units, from the spread of ContributionOptions::samples, or of
  // the sets of rays that an accuracy takes. No columns without an accuracy if samples is 1.
  Quantity standardError;
};

// RADIANCE's luminous efficacy of white light (lm/W), and the weights of red, green and blue in it.
inline constexpr double kLumensPerWatt = 179;
inline constexpr std::array<double, 3> kBrightnessWeights = {.265105820, .670105820, .064788360};

// Converts a color from radiance (W/sr/m2) to luminance (cd/m2), or from irradiance (W/m2) to illuminance
// (lx), like -pY. REQUIRES: the color has red, green and blue.
constexpr double photometric(std::span<const double> color) {
  return kLumensPerWatt * (kBrightnessWeights[0] * color[0] + kBrightnessWeights[1] * color[1] +
                           kBrightnessWeights[2] * color[2]);
}

}  // namespace RSPHERE_API_NAMESPACE
