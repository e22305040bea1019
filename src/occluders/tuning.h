#pragma once
// Tuning constants (base/tuned.h). They affect variance and time, not the mean.
#include <cstddef>
#include <cstdint>

namespace rsphere::tuning {

// How a region is divided until what its places cannot see is known (hidden_boxes.cpp).
struct HiddenBoxes {
  // A region is divided if polygons hide at least the fraction kWorthHiding of its boxes, and at least
  // kLeastHidden boxes, from places in it. Division stops after kMostInVain successive divisions of which
  // none has hidden a quarter of the boxes. kMostInVain must be above five, because it takes five divisions
  // to isolate the region on one side of a slab: one along the slab, and one along each of its four edges.
  static constexpr double kWorthHiding = .4;
  static constexpr size_t kLeastHidden = 2;
  static constexpr int kMostInVain = 6;
  // Divisions along the edges of a slab cut thin strips off a region. Boxes that are hidden from the
  // remaining region are only searched for after the last division: a half with more than this fraction of
  // the region's width is divided first, but at most kMostUntested times.
  static constexpr double kSameRegion = .99;
  static constexpr int kMostUntested = 8;
  // A strip at the edge of a slab is also divided by its distance from the slab, until the farthest place in
  // it is this many times as far away as the nearest. With a million lamps below a bare floor, each ray
  // examines 340 lamps with the value 17 and 170 with 5, in an equal time; about 100,000 without these
  // divisions.
  static constexpr double kSameDistance = 5;
  // Number of boxes that are examined to decide whether a region is divided.
  static constexpr size_t kProbes = 32;
  // To decide whether to divide a region, only polygons are considered whose size times this factor is at
  // most the region's width. For larger polygons, division would gain little.
  static constexpr double kWorthDividing = .25;
  // Cap on the number of tests to find the boxes that are hidden from a region. To keep below it, groups of
  // boxes are tested first.
  static constexpr size_t kMostTests = 4096;
  // Up to this number of boxes, blockers are searched for from both ends of a segment; for more boxes this
  // takes more time than it saves.
  static constexpr size_t kFewFromBothEnds = 4096;
};

// Polygons that hide (blockers.cpp).
struct Blockers {
  static constexpr size_t kMostKnown = 8;  // number of recent blockers that are kept
  // Cap on the surfaces that are examined along the way to a box; furniture or glass may stand in front of a
  // wall.
  static constexpr int kSurfacesInTheWay = 6;
  // Cap on the blockers that are kept for all regions: 6 MB.
  static constexpr size_t kMostFound = 16384;
};

// Areas of several polygons (joined_polygons.cpp).
struct JoinedPolygons {
  // Polygons whose size is below this fraction of the scene's are not joined: a slab has few such pieces,
  // while furniture has many.
  static constexpr double kLeastSize = 1. / 4096;
  // Polygons with more vertices are not joined, because each of their edges is compared with all others.
  static constexpr uint32_t kMostVertices = 1024;
  // Cap on the edges that are compared to find outlines, for each vertex in a plane. Looking up a point
  // counts as kPerPoint edges. Slabs and walls stay far below the cap. Where it is exceeded, because a great
  // number of long polygons cross one another, none are joined.
  static constexpr size_t kPerPoint = 32;
  static constexpr size_t kMostCompared = 1024;
};

}  // namespace rsphere::tuning
