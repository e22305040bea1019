#pragma once
// Where light comes from: what directions are aimed at. See find_aims.h for how it is found.
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

// Those of `more` where it has any, otherwise those of `some`.
inline Aims joined(const Aims& some, const Aims& more) {
  return {more.openings ? more.openings : some.openings, more.spots ? more.spots : some.spots,
          more.highlights ? more.highlights : some.highlights};
}

}  // namespace rsphere
