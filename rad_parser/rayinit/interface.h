#pragma once
#include <cstdint>

#include "rad_parser/calc/library.h"

// What scenes take for granted in function files: the variables and functions of RADIANCE's rtrace, and the
// definitions of its rayinit.cal. The renderer supplies values for the inputs; it need not know how they are
// used. Source: RADIANCE reference manual, "Function files"; rayinit.cal's list of names.
namespace rad::calc {

// Index in Point::inputs. Lengths and directions are those of the primitive's own space: its transform, and
// that of the instance it is seen in, are undone.
enum Input : uint32_t {
  Dx,
  Dy,
  Dz,  // ray direction, unit
  Nx,
  Ny,
  Nz,  // surface normal, unit, unperturbed, as the surface has it (not turned to the ray)
  Px,
  Py,
  Pz,    // intersection point
  T,     // distance from the ray's start, along all its transmissions
  Rdot,  // -D.N, within [-1,1]
  S,     // 1 over the scale of the transform from that space to the world
  Tx,
  Ty,
  Tz,  // world origin
  Ix,
  Iy,
  Iz,  // world x axis, unit
  Jx,
  Jy,
  Jz,  // world y axis
  Kx,
  Ky,
  Kz,  // world z axis
  Ts,  // length of this ray, or of the shadow ray that it belongs to
  Lu,
  Lv,  // local coordinates: of meshes; else 0
  NxP,
  NyP,
  NzP,    // perturbed surface normal: materials with functions or data
  RdotP,  // perturbed Rdot
  CrP,
  CgP,
  CbP,  // perturbed material colour
  DxA,
  DyA,
  DzA,  // direction to the target light source, or 0: prism1, prism2
  kInputs
};

// Request::available for the kinds of primitives.
inline constexpr uint64_t kPointInputs = (uint64_t{1} << NxP) - 1;
inline constexpr uint64_t kMaterialInputs = (uint64_t{1} << DxA) - 1;
inline constexpr uint64_t kPrismInputs = kPointInputs | (uint64_t{7} << DxA);

// The inputs in their order, the functions source_corr(value, kind), source_theta(any), source_phi(symmetry)
// of ies2rad, fprism_val(what, which, rank) of prism panels, and our rayinit.cal, which one along RAYPATH
// replaces.
Interface sceneInterface();

// Our rayinit.cal.
extern const std::string_view kRayinit;

}  // namespace rad::calc
