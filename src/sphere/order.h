#pragma once
#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

#include "sphere/delaunay.h"

// The order in which directions are inserted into a triangulation. Neighbours are inserted successively, so
// that walks are short and caches are warm. The order does not change the result.
namespace rsphere {

// The position of a direction along Hilbert curves on the faces of a cube, 27 bits: 2^12 steps per edge.
// Source: Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891.
std::uint32_t placeOnCurve(const V3d& direction);

// Sorts the indices 0..n-1 of the sites along the curve. scratch keeps its memory between calls.
struct OrderScratch {
  std::vector<std::uint64_t> keys;
  std::vector<std::uint32_t> order;
};
void orderAlongCurve(std::span<const Site> sites, OrderScratch& scratch, std::vector<std::uint32_t>& order);

// Sorts the indices like orderAlongCurve(), except for two groups that come first: a few extreme
// directions, whose hull contains the centre if possible, and a sample of all others. The sample keeps
// holes small at the edge of the region inserted so far.
void orderForBuild(std::span<const Site> sites, OrderScratch& scratch, std::vector<std::uint32_t>& order);

}  // namespace rsphere
