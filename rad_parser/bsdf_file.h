#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/error.h"

namespace rad {

// A division of the hemisphere of directions: rings about the normal, each divided evenly in azimuth. The
// first division of each ring lies evenly about azimuth 0.
struct AngleBasis {
  struct Ring {
    double upper = 0;  // polar angle where it ends and the next begins, degrees; the first begins at 0
    size_t cells = 1;
    bool operator==(const Ring&) const = default;
  };
  std::string name;
  std::vector<Ring> rings;
  size_t cells = 0;  // of all rings
};

// Scattering (1/sr) from each cell of one basis into each of another, by tristimulus value.
struct BsdfMatrix {
  size_t incident = 0, scattered = 0;  // index in BsdfFile::bases
  std::vector<float> y;                // [scattered * number of incident cells + incident]
  std::vector<float> x, z;             // the same; both empty: grey
};

// A function on the unit cube of `rank` dimensions that is constant on cubes, each a cell of a halved,
// quartered .. grid.
struct TensorTree {
  struct Node {
    float value = 0;        // of a leaf
    uint32_t children = 0;  // index of the first of 2^rank; bit i of a child's number says that it has the
                            // upper half in dimension i. 0: a leaf
  };
  std::vector<Node> nodes;  // the first is the root
};
struct BsdfTrees {
  TensorTree y;     // scattering, 1/sr
  TensorTree u, v;  // chromaticity u', v' (CIE 1976); both empty: grey
};

// What an XML file of WINDOW 6, genBSDF(1) and others says of a surface's bidirectional scattering. The front
// is the surface's own, the side that its normal points to; the files call it "Back", as it is the inside of
// a window.
//
// Sources: LBNL, "BSDF XML schema 1.4" and WINDOW 6 technical documentation (the Klems bases); Ward et al.,
// "A practical framework for sharing and rendering real-world bidirectional scattering distribution
// functions", LBNL-6535E, 2012 (tensor trees); RADIANCE's notes on BSDF directions.
struct BsdfFile {
  enum Component : size_t { kReflectionFront, kReflectionBack, kTransmissionFront, kTransmissionBack };
  static constexpr size_t kComponents = 4;
  // The smallest cell of a tree is 2^-kDeepest wide.
  static constexpr int kDeepest = 15;

  int rank = 0;                   // 3 or 4: trees; 0: matrices
  std::vector<AngleBasis> bases;  // that matrices use
  std::array<std::optional<BsdfMatrix>, kComponents> matrices;
  std::array<std::optional<BsdfTrees>, kComponents> trees;

  // Reads such a file. name: for messages. Negative scattering is taken as 0; of several layers the first is
  // read, of several blocks for the same component the last; spectral bands other than the visible one and
  // its chromaticity are left out. Memory is bounded by the text's length. Throws Error "NAME:LINE: ..": what
  // is no XML or no BSDF, a structure or an angle basis that is not known, numbers that are missing or wrong,
  // trees that are unbalanced or deeper than kDeepest. Warns of numbers beyond the matrix's, and of a
  // definition of a Klems basis that differs from the known one, which counts.
  static BsdfFile parse(std::string_view text, std::string_view name, const Warn& warn = {});
};

// A name of one of the Klems bases, in any case: "LBNL/Klems Full" (145 cells), "LBNL/Klems Half" (77),
// "LBNL/Klems Quarter" (41). Null for others.
const AngleBasis* klemsBasis(std::string_view name);

}  // namespace rad
