#pragma once
// The position of a glare source in the field of view, and how much less disturbing it is there than on the
// line of sight.
#include <Imath/ImathVec.h>

#include <optional>

namespace rsphere {

using Imath::V3d;

// A line of sight, and the upward direction.
struct Gaze {
  V3d direction{0, 1, 0};  // unit
  V3d up{0, 0, 1};         // unit, perpendicular to the direction

  // The line of sight of an upright head: z is up. direction: of any length. Empty if it is 0 or vertical
  // (within 1e-6 rad), because the upward direction is then undefined.
  static std::optional<Gaze> upright(const V3d& direction);
};

// Guth's position index P: the luminance in this direction that is as uncomfortable as a luminance of 1 on
// the line of sight. 1 on the line of sight; at most 16. direction: unit, in front of the eye (within 90
// degrees of the line of sight). sigma is its angle from the line of sight, and tau the angle between the
// upward direction and the plane of both, seen from the eye (degrees). Sources:
// - On and above the horizontal plane of the line of sight, the formula for Guth's data by Levin 1975, J. IES
//   4/2, from the IES Lighting Handbook. It is within 12% of the data (Levin), which CIE 117 lists in a
//   table.
//     ln P = (35.2 - .31889 tau - 1.22 exp(-2 tau / 9)) sigma / 1e3
//          + (21 + .26667 tau - .002963 tau^2) sigma^2 / 1e5
// - Below this plane, where Guth has no data, the formula by Iwata and Osterhaus 2010 (CIE conference
//   "Lighting Quality and Energy Efficiency") for data of Iwata and Tokura 1997, Lighting Research and
//   Technology 29/3:
//     ln P = 6.49 beta / 1e3 + 21 beta^2 / 1e5,  tan beta = tan sigma sqrt(1 + .3225 cos^2 tau)
// - The cap of 16, where the formulas extend beyond the data, is that of evalglare.
double positionIndex(const V3d& direction, const Gaze& gaze);

}  // namespace rsphere
