#pragma once
#include <cstdint>

namespace rad::calc {

// Indices in Point::inputs. Lengths and directions are in the coordinates of the primitive: its transform,
// and that of the instance that contains it, have been inverted.
//   Dx      unit ray direction
//   Nx      unit surface normal, unperturbed and not turned towards the ray
//   Px      intersection point
//   T       distance from the ray's origin, through all transmissions
//   Rdot    -D.N, within [-1,1]
//   S       reciprocal of the scale of the transform to world space
//   Tx      origin of world space
//   Ix      unit x axis of world space; Jx, Kx: y and z axes
//   Ts      length of this ray or, if it is part of a shadow ray, of the whole shadow ray
//   Lu, Lv  texture coordinates of meshes; 0 for other surfaces
//   NxP     perturbed surface normal, for materials with functions or data; RdotP: perturbed Rdot
//   CrP     perturbed material color
//   DxA     direction to the target light source, or 0, for prism1 and prism2
// clang-format off
enum Input : uint32_t {
  Dx, Dy, Dz, Nx, Ny, Nz, Px, Py, Pz, T, Rdot, S, Tx, Ty, Tz, Ix, Iy, Iz, Jx, Jy, Jz, Kx, Ky, Kz, Ts, Lu, Lv,
  NxP, NyP, NzP, RdotP, CrP, CgP, CbP, DxA, DyA, DzA, kInputs
};
// clang-format on

// Request::available for three kinds of primitives: patterns and textures, materials with functions or data,
// prisms.
inline constexpr uint64_t kPointInputs = (uint64_t{1} << NxP) - 1;
inline constexpr uint64_t kMaterialInputs = (uint64_t{1} << DxA) - 1;
inline constexpr uint64_t kPrismInputs = kPointInputs | (uint64_t{7} << DxA);

}  // namespace rad::calc
