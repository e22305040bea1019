#pragma once
#include <Imath/ImathVec.h>

#include <cstdint>
#include <span>
#include <vector>

#include "sphere/delaunay.h"

// The order in which directions enter a triangulation: neighbours follow each other, so that walks are short
// and caches warm. It does not change the answer.
namespace rsphere {

// Place of a direction along a Hilbert curve on each face of a cube, 27 bits: 2^12 steps an edge.
// Source: Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891.
std::uint32_t placeOnCurve(const V3d& direction);

// Sorts numbers 0..n-1 of the sites along the curve. scratch keeps its memory between calls.
struct OrderScratch {
  std::vector<std::uint64_t> keys, spare;
  std::vector<std::uint32_t> order;
};
void orderAlongCurve(std::span<const Site> sites, OrderScratch& scratch, std::vector<std::uint32_t>& order);

// The same, after a few extreme directions, whose hull holds the centre where possible, and a sample of the
// rest, which keeps holes small at the edge of what has been inserted.
void orderForBuild(std::span<const Site> sites, OrderScratch& scratch, std::vector<std::uint32_t>& order);

}  // namespace rsphere
