#pragma once
// Places from which much light comes, and at which rays are aimed (importance sampling). find_aims.h finds
// them.
#include <memory>

#include "openings/opening_images.h"
#include "openings/openings.h"
#include "spots/bright_spots.h"
#include "spots/highlights.h"

namespace rsphere {

// The places at which the rays of gathers are aimed. Null: no rays are aimed at places of this kind.
struct Aims {
  const Openings* openings = nullptr;
  const BrightSpots* spots = nullptr;
  const Highlights* highlights = nullptr;
  const OpeningImages* images = nullptr;
};

// Owns the places of Aims. Null: not searched for, or none was found.
struct FoundAims {
  std::unique_ptr<const Openings> openings;
  std::unique_ptr<const BrightSpots> spots;
  std::unique_ptr<const Highlights> highlights;
  std::unique_ptr<const OpeningImages> images;

  operator Aims() const { return {openings.get(), spots.get(), highlights.get(), images.get()}; }
};

// For each kind of place, the aims of `more`; where `more` has none, those of `some`.
inline Aims joined(const Aims& some, const Aims& more) {
  return {more.openings ? more.openings : some.openings, more.spots ? more.spots : some.spots,
          more.highlights ? more.highlights : some.highlights, more.images ? more.images : some.images};
}

}  // namespace rsphere
