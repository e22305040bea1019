#pragma once
// Places from which much light comes, and at which rays are aimed (importance sampling). find_aims.h finds
// them.
#include <memory>
#include <tuple>

#include "openings/light_finder.h"
#include "openings/opening_images.h"
#include "openings/openings.h"
#include "spots/bright_spots.h"
#include "spots/highlights.h"

namespace rsphere {

template <LightFinder... Finder>
struct FinderList {
  // A tuple of one Element<Finder> for each finder, in their order.
  template <template <class> class Element>
  using ForEach = std::tuple<Element<Finder>...>;
};

// All ways to find light for gathers. find_aims.cpp makes them.
using Finders = FinderList<Openings, OpeningImages, BrightSpots, Highlights>;

// The places at which the rays of gathers are aimed. A null finder: no rays are aimed at its places.
class Aims {
 public:
  Aims() = default;
  template <LightFinder... Finder>
  explicit Aims(const Finder*... finder) {
    ((std::get<const Finder*>(finders_) = finder), ...);
  }

  template <LightFinder Finder>
  const Finder* of() const {
    return std::get<const Finder*>(finders_);
  }
  // The finders in the order of the list.
  const auto& all() const { return finders_; }
  template <LightFinder... Finder>
  void leaveOut() {
    ((std::get<const Finder*>(finders_) = nullptr), ...);
  }
  // Adds the finders of others, which replace finders of equal type.
  void add(const Aims& others) {
    const auto replace = [](auto*& mine, auto* other) { mine = other ? other : mine; };
    std::apply([&](auto... other) { (replace(std::get<decltype(other)>(finders_), other), ...); },
               others.finders_);
  }

 private:
  template <class Finder>
  using Pointer = const Finder*;
  Finders::ForEach<Pointer> finders_;
};

// Owns the places of Aims. Null: not searched for, or none was found.
class FoundAims {
 public:
  template <LightFinder Finder>
  const Finder* of() const {
    return std::get<Owner<Finder>>(finders_).get();
  }
  // Keeps a finder unless it is empty.
  template <LightFinder Finder>
  void keep(Finder&& finder) {
    if (!finder.empty())
      std::get<Owner<Finder>>(finders_) = std::make_unique<const Finder>(std::move(finder));
  }
  operator Aims() const {
    return std::apply([](const auto&... finder) { return Aims(finder.get()...); }, finders_);
  }

 private:
  template <class Finder>
  using Owner = std::unique_ptr<const Finder>;
  Finders::ForEach<Owner> finders_;
};

}  // namespace rsphere
