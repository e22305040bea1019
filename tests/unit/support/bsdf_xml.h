#pragma once
// XML files of bidirectional scattering, made from functions.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "rad_parser/tables/bsdf_file.h"
#include "scene/scene.h"

namespace rsphere {

inline std::string bsdfXml(std::string_view structure, std::string_view bands,
                           std::string_view definitions = {}) {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<WindowElement xmlns="http://windows.lbl.gov">
<FileType>BSDF</FileType>
<Optical>
<Layer>
<DataDefinition>
<IncidentDataStructure>{}</IncidentDataStructure>
{}</DataDefinition>
{}</Layer>
</Optical>
</WindowElement>
)",
                     structure, definitions, bands);
}

inline std::string bsdfBand(std::string_view name, std::string_view direction, std::string_view bases,
                            std::string_view data) {
  return fmt::format(R"(<WavelengthData>
<Wavelength unit="Integral">{}</Wavelength>
<WavelengthDataBlock>
<WavelengthDataDirection>{}</WavelengthDataDirection>
{}
<ScatteringData>
{}</ScatteringData>
</WavelengthDataBlock>
</WavelengthData>
)",
                     name, direction, bases, data);
}

// Scattering (1/sr) between where light would go straight on (x, y of the unit vector) and where it goes.
using DiskFunction = std::function<double(double inX, double inY, double outX, double outY)>;

// Columns of a matrix: the middle of each cell of the basis decides.
inline std::string klemsData(const rad::AngleBasis& basis, const DiskFunction& f) {
  std::vector<std::array<double, 2>> middles;
  double lower = 0;
  for (const auto& ring : basis.rings) {
    const double theta = middles.empty() ? 0 : (lower + ring.upper) / 2 * (std::numbers::pi / 180);
    for (size_t k = 0; k < ring.cells; ++k) {
      const double phi = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(ring.cells);
      middles.push_back({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi)});
    }
    lower = ring.upper;
  }
  std::string text;
  for (const auto& out : middles) {
    for (const auto& in : middles) text += fmt::format("{:.4f}, ", f(in[0], in[1], out[0], out[1]));
    text += '\n';
  }
  return text;
}
inline std::string klemsBlock(std::string_view band, std::string_view direction, std::string_view basis,
                              const DiskFunction& f) {
  return bsdfBand(
      band, direction,
      fmt::format("<ColumnAngleBasis>{0}</ColumnAngleBasis>\n<RowAngleBasis>{0}</RowAngleBasis>", basis),
      klemsData(*rad::klemsBasis(basis), f));
}

// The point of the unit disk that the map of Shirley and Chiu has for one of the unit square.
inline std::array<double, 2> diskPoint(double sx, double sy) {
  const double a = 2 * sx - 1, b = 2 * sy - 1, quarter = std::numbers::pi / 4;
  if (std::abs(a) > std::abs(b)) return {a * std::cos(quarter * b / a), a * std::sin(quarter * b / a)};
  if (b == 0) return {0, 0};
  return {b * std::sin(quarter * a / b), b * std::cos(quarter * a / b)};
}

// A tree whose cells are halved down to 2^-deepest where the function's values at their middle and about it
// differ by more than `tolerance` of their size, and hold its value at the middle.
inline std::string treeData(int rank, int deepest, double tolerance, const DiskFunction& f) {
  const auto at = [&](const std::array<double, 4>& p) {
    const auto disk = [](double x, double y) {
      return diskPoint(std::min(std::max(x, 0.), 1.), std::min(std::max(y, 0.), 1.));
    };
    if (rank == 3) {
      const auto out = disk(p[1], p[2]);
      return f(std::max(0., 1 - 2 * p[0]), 0, out[0], out[1]);
    }
    const auto in = disk(p[0], p[1]), out = disk(p[2], p[3]);
    return f(in[0], in[1], out[0], out[1]);
  };
  std::string text;
  const std::function<void(std::array<double, 4>, int)> node = [&](std::array<double, 4> begin, int depth) {
    const double half = std::ldexp(.5, -depth);
    std::array<double, 4> middle = begin;
    for (int i = 0; i < rank; ++i) middle[i] += half;
    const double value = at(middle);
    double differs = 0;
    for (int i = 0; i < rank; ++i)
      for (double by : {-half, half}) {
        std::array<double, 4> p = middle;
        p[i] += by;
        differs = std::max(differs, std::abs(at(p) - value));
      }
    if (depth == deepest || (depth > 0 && differs < tolerance * value)) {
      text += fmt::format("{{{:.5f}}}", value);
      return;
    }
    text += "{";
    for (int child = 0; child < 1 << rank; ++child) {
      std::array<double, 4> p = begin;
      for (int i = 0; i < rank; ++i)
        if (child >> i & 1) p[i] += half;
      node(p, depth + 1);
    }
    text += "}\n";
  };
  node({0, 0, 0, 0}, 0);
  return text;
}
inline std::string treeBlock(std::string_view band, std::string_view direction, int rank, int deepest,
                             double tolerance, const DiskFunction& f) {
  return bsdfBand(band, direction, "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>",
                  treeData(rank, deepest, tolerance, f));
}

// An even part and a lobe of the given width about where light goes straight on. Reciprocal.
inline DiskFunction lobe(double even, double height, double width) {
  return [=](double inX, double inY, double outX, double outY) {
    const double dx = inX - outX, dy = inY - outY;
    return even + height * std::exp(-(dx * dx + dy * dy) / (width * width));
  };
}
inline DiskFunction times(double factor, const DiskFunction& f) {
  return [=](double a, double b, double c, double d) { return factor * f(a, b, c, d); };
}

// The files that tests share.

// All four components, grey.
inline std::string halfXml() {
  constexpr std::string_view kBasis = "LBNL/Klems Half";
  return bsdfXml("Columns", klemsBlock("Visible", "Transmission Front", kBasis, lobe(.02, .9, .35)) +
                                klemsBlock("Visible", "Transmission Back", kBasis, lobe(.01, .5, .5)) +
                                klemsBlock("Visible", "Reflection Front", kBasis, lobe(.05, .3, .4)) +
                                klemsBlock("Visible", "Reflection Back", kBasis, lobe(0, .7, .3)));
}
// Transmission of the back only, and the front's reflection, in colour.
inline std::string quarterXml() {
  constexpr std::string_view kBasis = "LBNL/Klems Quarter";
  std::string bands;
  for (const auto& [band, factor] : {std::pair{"Visible", 1.}, {"CIE-X", 1.2}, {"CIE-Z", .5}})
    bands += klemsBlock(band, "Transmission Front", kBasis, times(factor, lobe(.01, .6, .4))) +
             klemsBlock(band, "Reflection Back", kBasis, lobe(.03 / factor, .4 * factor, .4));
  return bsdfXml("Rows", bands);
}
// A peak straight on over a wide lobe: what an aBSDF takes for a pane.
inline DiskFunction peaked() {
  return [wide = lobe(.02, .1, .5), peak = lobe(0, 12, .06)](double a, double b, double c, double d) {
    return wide(a, b, c, d) + peak(a, b, c, d);
  };
}
inline std::string tree4Xml() {
  return bsdfXml("TensorTree4", treeBlock("Visible", "Transmission Front", 4, 4, .7, peaked()) +
                                    treeBlock("Visible", "Reflection Back", 4, 3, .5, lobe(.03, .5, .4)));
}
inline std::string tree3Xml() {
  return bsdfXml("TensorTree3", treeBlock("Visible", "Transmission Back", 3, 5, .5, peaked()) +
                                    treeBlock("Visible", "Transmission Front", 3, 4, .5, lobe(.02, .5, .3)) +
                                    treeBlock("Visible", "Reflection Back", 3, 4, .5, lobe(.03, .5, .4)));
}
inline std::string coloredTreeXml() {
  std::string bands;
  bands += treeBlock("Visible", "Transmission Back", 4, 3, .5, lobe(.05, .5, .4));
  bands += treeBlock("CIE-u", "Transmission Back", 4, 2, .02,
                     [](double, double, double x, double) { return .21 + .03 * x; });
  bands += treeBlock("CIE-v", "Transmission Back", 4, 2, .02,
                     [](double, double, double, double y) { return .47 + .02 * y; });
  return bsdfXml("TensorTree4", bands);
}

}  // namespace rsphere
