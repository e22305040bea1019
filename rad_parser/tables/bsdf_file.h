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

// A division of the hemisphere of directions into rings around the normal. Each ring is divided evenly in
// azimuth; its first cell is centred at azimuth 0.
struct AngleBasis {
  struct Ring {
    double upper = 0;  // largest polar angle, degrees; the smallest is that of the preceding ring, or 0
    size_t cells = 1;
    bool operator==(const Ring&) const = default;
  };
  std::string name;
  std::vector<Ring> rings;
  size_t cells = 0;  // in all rings
};

// Scattering (1/sr) from each cell of one basis to each cell of another, by tristimulus value.
struct BsdfMatrix {
  size_t incident = 0, scattered = 0;  // index in BsdfFile::bases
  std::vector<float> y;                // at [scattered cell * number of incident cells + incident cell]
  std::vector<float> x, z;             // in the order of y; both are empty for gray scattering
};

// A function on the unit cube of `rank` dimensions. It is constant on smaller cubes, obtained by repeated
// halving along all dimensions.
struct TensorTree {
  struct Node {
    float value = 0;  // of a leaf
    // Index of the first of 2^rank children; 0 for a leaf. Bit i of a child's number is set if the child is
    // the upper half in dimension i.
    uint32_t children = 0;
  };
  std::vector<Node> nodes;  // the first is the root
};
struct BsdfTrees {
  TensorTree y;     // scattering, 1/sr
  TensorTree u, v;  // chromaticity u', v' (CIE 1976); both are empty for gray scattering
};

// The bidirectional scattering of a surface, from an XML file of WINDOW 6, genBSDF(1) or other programs. The
// front of the surface is the side to which its normal points. The files call this side "Back", because it
// is the inside of a window.
//
// Sources: LBNL, "BSDF XML schema 1.4" and WINDOW 6 technical documentation (the Klems bases); Ward et al.,
// "A practical framework for sharing and rendering real-world bidirectional scattering distribution
// functions", LBNL-6535E, 2012 (tensor trees); RADIANCE's notes on BSDF directions.
struct BsdfFile {
  enum Component : size_t { kReflectionFront, kReflectionBack, kTransmissionFront, kTransmissionBack };
  static constexpr size_t kComponents = 4;
  // The smallest possible cell of a tree has the width 2^-kDeepest.
  static constexpr int kDeepest = 15;

  int rank = 0;                   // 3 or 4: trees; 0: matrices
  std::vector<AngleBasis> bases;  // bases used by the matrices
  std::array<std::optional<BsdfMatrix>, kComponents> matrices;
  std::array<std::optional<BsdfTrees>, kComponents> trees;

  // Reads an XML file. name: for messages.
  // - Negative scattering is replaced by 0.
  // - The first of several layers is read, and the last of several blocks for the same component.
  // - Spectral bands are ignored, except the visible band and its chromaticity.
  // Memory is in proportion to the length of the text. Throws Error "NAME:LINE: .." for text that is not XML
  // or not a BSDF, an unsupported structure or angle basis, missing or wrong numbers, and trees that are
  // unbalanced or deeper than kDeepest. Warns of surplus numbers after a matrix, and if a Klems basis is
  // defined differently from the standard; the standard basis is then used.
  static BsdfFile parse(std::string_view text, std::string_view name, const Warn& warn = {});
};

// The Klems basis of this name, in upper or lower case: "LBNL/Klems Full" (145 cells), "LBNL/Klems Half"
// (77), "LBNL/Klems Quarter" (41). Null for other names.
const AngleBasis* klemsBasis(std::string_view name);

}  // namespace rad
