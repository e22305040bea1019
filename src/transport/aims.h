#pragma once
// Where much light comes from, so that directions are aimed there. See find_aims.h for how these places are
// found.
#include <memory>

#include "transport/bright_spots.h"
#include "transport/highlights.h"
#include "transport/openings.h"

namespace rsphere {

// What the rays of gathers are aimed at; null: nothing.
struct Aims {
  const Openings* openings = nullptr;
  const BrightSpots* spots = nullptr;
  const Highlights* highlights = nullptr;
};

// The owner of aims. Null: none were looked for, or none were found.
struct FoundAims {
  std::unique_ptr<const Openings> openings;
  std::unique_ptr<const BrightSpots> spots;
  std::unique_ptr<const Highlights> highlights;

  operator Aims() const { return {openings.get(), spots.get(), highlights.get()}; }
};

// The aims of `more`; where it has none of a kind, those of `some`.
inline Aims joined(const Aims& some, const Aims& more) {
  return {more.openings ? more.openings : some.openings, more.spots ? more.spots : some.spots,
          more.highlights ? more.highlights : some.highlights};
}

}  // namespace rsphere
