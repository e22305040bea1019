#include "rad_parser/tables/bsdf_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rad {
namespace {

// Lines 1 to 6, before the definition, as in files of WINDOW 6.
std::string xml(std::string_view definition, std::string_view bands) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<WindowElement xmlns=\"http://windows.lbl.gov\">\n"
      "<FileType>BSDF</FileType>\n"
      "<Optical>\n"
      "<Layer>\n"
      "<Material><Name>a</Name></Material>\n"
      "<DataDefinition>\n{}</DataDefinition>\n{}</Layer>\n</Optical>\n</WindowElement>\n",
      definition, bands);
}

std::string band(std::string_view name, std::string_view direction, std::string_view bases,
                 std::string_view data) {
  return fmt::format(
      "<WavelengthData>\n<Wavelength unit=\"Integral\">{}</Wavelength>\n<WavelengthDataBlock>\n"
      "<WavelengthDataDirection>{}</WavelengthDataDirection>\n{}\n"
      "<ScatteringData>\n{}</ScatteringData>\n</WavelengthDataBlock>\n</WavelengthData>\n",
      name, direction, bases, data);
}

constexpr std::string_view kColumns = "<IncidentDataStructure>Columns</IncidentDataStructure>\n";
constexpr std::string_view kRows = "<IncidentDataStructure>Rows</IncidentDataStructure>\n";
constexpr std::string_view kTree3 = "<IncidentDataStructure>TensorTree3</IncidentDataStructure>\n";
constexpr std::string_view kTree4 = "<IncidentDataStructure>TensorTree4</IncidentDataStructure>\n";
constexpr std::string_view kTreeBasis = "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>";

std::string block(double theta, double lower, double upper, int cells) {
  return fmt::format(
      "<AngleBasisBlock><Theta>{}</Theta><nPhis>{}</nPhis><ThetaBounds><LowerTheta>{}</LowerTheta>"
      "<UpperTheta>{}</UpperTheta></ThetaBounds></AngleBasisBlock>\n",
      theta, cells, lower, upper);
}
// Rings of 1 and 2 cells.
std::string smallBasis() {
  return "<AngleBasis><AngleBasisName>small</AngleBasisName>\n" + block(0, 0, 30, 1) + block(60, 30, 90, 2) +
         "</AngleBasis>\n";
}
// One ring of 2 cells.
std::string pairBasis() {
  return "<AngleBasis><AngleBasisName>Pair</AngleBasisName>\n" + block(45, 0, 90, 2) + "</AngleBasis>\n";
}
constexpr std::string_view kSmall =
    "<ColumnAngleBasis>small</ColumnAngleBasis><RowAngleBasis>small</RowAngleBasis>";
constexpr std::string_view kOblong =
    "<ColumnAngleBasis>small</ColumnAngleBasis><RowAngleBasis>pair</RowAngleBasis>";

std::string errorOf(const std::string& text) {
  try {
    BsdfFile::parse(text, "a.xml");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}
std::vector<std::string> warningsOf(const std::string& text) {
  std::vector<std::string> lines;
  BsdfFile::parse(text, "a.xml", [&](std::string_view line) { lines.emplace_back(line); });
  return lines;
}
std::string oneMatrix(std::string_view data, std::string_view bases = kSmall) {
  return xml(std::string(kColumns) + smallBasis() + pairBasis(),
             band("Visible", "Transmission Front", bases, data));
}
std::string oneTree(std::string_view data, std::string_view structure = kTree4) {
  return xml(structure, band("Visible", "Transmission Front", kTreeBasis, data));
}

// The numbers of cells of the Klems bases, and the projected solid angles of their
// rings, are those of WINDOW 6.
TEST(BsdfFile, KlemsBases) {
  EXPECT_EQ(klemsBasis("LBNL/Klems Full")->cells, 145u);
  EXPECT_EQ(klemsBasis("lbnl/klems half")->cells, 77u);
  EXPECT_EQ(klemsBasis("LBNL/Klems Quarter")->cells, 41u);
  EXPECT_EQ(klemsBasis("LBNL/Klems"), nullptr);
}

// As Windows PowerShell writes them.
TEST(BsdfFile, Utf16WithAByteOrderMark) {
  std::string text = oneMatrix("1 2 3 4 5 6 7 8 9");
  text.replace(text.find("<Name>a"), 7, "<Name>\xe2\x82\xac \xf0\x9f\x98\x80");
  std::string little = "\xff\xfe", big = "\xfe\xff";
  for (size_t i = 0; i < text.size();) {
    const auto byte = [&](size_t k) { return static_cast<unsigned char>(text[i + k]); };
    const auto put = [&](unsigned unit) {
      little += {static_cast<char>(unit & 0xff), static_cast<char>(unit >> 8)};
      big += {static_cast<char>(unit >> 8), static_cast<char>(unit & 0xff)};
    };
    if (byte(0) == 0xe2) {
      put(0x20ac), i += 3;
    } else if (byte(0) == 0xf0) {
      put(0xd83d), put(0xde00), i += 4;
    } else {
      put(byte(0)), ++i;
    }
  }
  const BsdfFile expected = BsdfFile::parse(text, "a");
  for (const std::string& other : {little, big}) {
    const BsdfFile file = BsdfFile::parse(other, "a");
    const auto& m = file.matrices[BsdfFile::kTransmissionBack];
    ASSERT_TRUE(m);
    EXPECT_EQ(m->y, expected.matrices[BsdfFile::kTransmissionBack]->y);
  }
  const size_t wrong = little.find(std::string("5\0 \0", 4));
  ASSERT_NE(wrong, little.npos);
  little[wrong] = 'x';
  EXPECT_EQ(errorOf(little), errorOf(std::string(text).replace(text.find("5 "), 1, "x"))) << "the same line";
  EXPECT_EQ(errorOf("\xff\xfe<").substr(0, 17), "a.xml:1: not XML:");
}

// The side that WINDOW calls the back is the inside of a window, which is the front of its surface.
TEST(BsdfFile, EachDirectionIsAComponent) {
  std::string bands;
  for (const char* direction : {"Transmission Front", "Transmission Back", "Reflection Front",
                                "Reflection Back", "Absorptance Front"})
    bands += band("Visible", direction, kOblong, "1 2 3 4 5 6");
  bands += band("Solar", "Transmission Front", kOblong, "9 9 9 9 9 9");
  const BsdfFile file = BsdfFile::parse(xml(std::string(kColumns) + smallBasis() + pairBasis(), bands), "a");
  EXPECT_EQ(file.rank, 0);
  for (const auto& m : file.matrices) {
    ASSERT_TRUE(m);
    EXPECT_EQ(file.bases[m->incident].name, "small");
    EXPECT_EQ(file.bases[m->scattered].name, "Pair");
    EXPECT_EQ(m->y, (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_TRUE(m->x.empty());
  }
  const BsdfFile one = BsdfFile::parse(oneMatrix("1 2 3 4 5 6 7 8 9"), "a");
  EXPECT_TRUE(one.matrices[BsdfFile::kTransmissionBack]);
  EXPECT_FALSE(one.matrices[BsdfFile::kTransmissionFront]);
}

TEST(BsdfFile, RowsAreIncidentWhereTheFileSaysSo) {
  const BsdfFile file = BsdfFile::parse(xml(std::string(kRows) + smallBasis() + pairBasis(),
                                            band("Visible", "Transmission Front", kOblong, "1 2 3 4 5 6")),
                                        "a");
  EXPECT_EQ(file.matrices[BsdfFile::kTransmissionBack]->y, (std::vector<float>{1, 3, 5, 2, 4, 6}));
}

TEST(BsdfFile, ColourNeedsBothItsParts) {
  const auto bands = [](bool z) {
    return band("Visible", "Reflection Back", kSmall, "1 2 3 4 5 6 7 8 9") +
           band("CIE-X", "Reflection Back", kSmall, "9 8 7 6 5 4 3 2 1") +
           (z ? band("CIE-Z", "Reflection Back", kSmall, "1 1 1 1 1 1 1 1 1") : std::string());
  };
  const std::string definition = std::string(kColumns) + smallBasis();
  const BsdfFile full = BsdfFile::parse(xml(definition, bands(true)), "a");
  EXPECT_EQ(full.matrices[BsdfFile::kReflectionFront]->x.at(0), 9);
  EXPECT_EQ(full.matrices[BsdfFile::kReflectionFront]->z.size(), 9u);
  const BsdfFile partly = BsdfFile::parse(xml(definition, bands(false)), "a");
  EXPECT_TRUE(partly.matrices[BsdfFile::kReflectionFront]->x.empty());
  const BsdfFile chroma =
      BsdfFile::parse(xml(definition, band("CIE-X", "Reflection Back", kSmall, "9 8 7 6 5 4 3 2 1")), "a");
  EXPECT_FALSE(chroma.matrices[BsdfFile::kReflectionFront]);
}

TEST(BsdfFile, NumbersAsFilesSpellThem) {
  const BsdfFile file =
      BsdfFile::parse(oneMatrix("1,\t-2 <!-- below nothing -->, 3e-1,4.,\n.5 <![CDATA[6, 7]]> 8,9,\n"), "a");
  EXPECT_EQ(file.matrices[BsdfFile::kTransmissionBack]->y,
            (std::vector<float>{1, 0, .3F, 4, .5, 6, 7, 8, 9}));
}

// The same values as a grid, and with its halves written as branches.
TEST(BsdfFile, GridsAndBranchesAreTheSame) {
  const auto valueAt = [](const TensorTree& tree, std::vector<double> p) {
    uint32_t node = 0;
    while (tree.nodes[node].children != 0) {
      uint32_t child = 0;
      for (size_t i = 0; i < p.size(); ++i) {
        p[i] *= 2;
        if (p[i] >= 1) child |= 1U << i, p[i] -= 1;
      }
      node = tree.nodes[node].children + child;
    }
    return tree.nodes[node].value;
  };
  // In a grid the index of the last dimension varies fastest, in branches that of the first.
  std::string grid = "{";
  for (int i = 0; i < 64; ++i) grid += std::to_string(i) + (i % 2 ? "," : " ");
  grid += "}";
  std::string branches = "{";
  for (int b = 0; b < 8; ++b) {
    branches += "{";
    for (int c = 0; c < 8; ++c) {
      int index = 0;
      for (int i = 0; i < 3; ++i) index += (2 * (b >> i & 1) + (c >> i & 1)) << (2 * (2 - i));
      branches += "{" + std::to_string(index) + "}, ";
    }
    branches += "}\n";
  }
  branches += "}";
  const TensorTree a = BsdfFile::parse(oneTree(grid, kTree3), "a").trees[BsdfFile::kTransmissionBack]->y;
  const TensorTree b = BsdfFile::parse(oneTree(branches, kTree3), "a").trees[BsdfFile::kTransmissionBack]->y;
  for (int i = 0; i < 64; ++i) {
    const std::vector<double> p{(i / 16 + .5) / 4, (i / 4 % 4 + .5) / 4, (i % 4 + .5) / 4};
    EXPECT_EQ(valueAt(a, p), i);
    EXPECT_EQ(valueAt(b, p), i);
  }
  const BsdfFile flat = BsdfFile::parse(oneTree(" { .25 } "), "a");
  EXPECT_EQ(flat.rank, 4);
  EXPECT_EQ(flat.trees[BsdfFile::kTransmissionBack]->y.nodes.size(), 1u);
}

TEST(BsdfFile, ErrorsHaveTheirPlace) {
  const std::string good = oneMatrix("1 2 3\n4 5 6\n7 8 9");
  ASSERT_EQ(errorOf(good), "no error");
  EXPECT_EQ(errorOf(""), "a.xml:1: not XML: No document element found");
  EXPECT_EQ(errorOf("<a>\n</b>"), "a.xml:2: not XML: Start-end tags mismatch");
  EXPECT_EQ(errorOf("\n<Window/>"), "a.xml:2: expected a WindowElement, got \"Window\"");
  EXPECT_EQ(errorOf("<WindowElement>\n<FileType>MGF</FileType></WindowElement>"),
            "a.xml:2: expected the FileType BSDF, got \"MGF\"");
  EXPECT_EQ(errorOf("<WindowElement/>"), "a.xml:1: no optical layer");
  EXPECT_EQ(errorOf(xml("", "")), "a.xml:5: no IncidentDataStructure");
  EXPECT_EQ(errorOf(xml("<IncidentDataStructure>Diagonal</IncidentDataStructure>", "")),
            "a.xml:8: the IncidentDataStructure \"Diagonal\" is not supported");
  EXPECT_EQ(errorOf(oneMatrix("1 2 3 4 5 6 7 8 9", "")), "a.xml:19: no ColumnAngleBasis");
  EXPECT_EQ(errorOf(oneMatrix("1", "<ColumnAngleBasis>round</ColumnAngleBasis>")),
            "a.xml:21: undefined ColumnAngleBasis \"round\"");
  EXPECT_EQ(errorOf(oneMatrix("1 2 3\n4 5 6\n7 8      ")),
            "a.xml:25: expected a number in the scattering data, got its end");
  EXPECT_EQ(errorOf(oneMatrix("1 2 3\n4 x5 6\n7 8 9")),
            "a.xml:24: expected a number in the scattering data, got \"x5\"");
  EXPECT_EQ(errorOf(oneMatrix("1 2 3\n4 1e39 6\n7 8 9")),
            "a.xml:24: expected a number in the scattering data, got \"1e39\"");
  EXPECT_EQ(errorOf(oneMatrix("1 nan 3\n4 5 6\n7 8 9")),
            "a.xml:23: expected a number in the scattering data, got \"nan\"");
  EXPECT_EQ(errorOf(oneMatrix("1 2 3")), "a.xml:22: fewer numbers than the 3 by 3 of the angle bases");
  EXPECT_EQ(errorOf(oneMatrix("")), "a.xml:22: no scattering data");
}

TEST(BsdfFile, AngleBasesMustCoverWhatTheySay) {
  const auto basis = [](const std::string& blocks) {
    return errorOf(xml(std::string(kColumns) + "<AngleBasis><AngleBasisName>b</AngleBasisName>\n" + blocks +
                           "</AngleBasis>\n",
                       ""));
  };
  EXPECT_EQ(basis(block(0, 0, 30, 1) + block(60, 30, 90, 4)), "no error");
  EXPECT_EQ(basis(block(0, 0, 30, 1) + block(60, 40, 90, 4)),
            "a.xml:11: a ring does not begin where the one before it ends");
  EXPECT_EQ(basis(block(0, 0, 30, 1) + block(60, 30, 30, 4)), "a.xml:11: a ring ends before it begins");
  EXPECT_EQ(basis(block(0, 0, 91, 1)), "a.xml:10: expected an angle from 0 to 90 as UpperTheta");
  EXPECT_EQ(basis(block(0, 0, 30, 0)),
            "a.xml:10: expected the number of azimuths as nPhis, at least 2 except around the normal");
  EXPECT_EQ(basis(block(0, 0, 30, 1) + block(60, 30, 90, 1)),
            "a.xml:11: expected the number of azimuths as nPhis, at least 2 except around the normal");
  EXPECT_EQ(basis(""), "a.xml:9: an angle basis without blocks");
  // Sizes that a file of this length cannot contain.
  EXPECT_EQ(
      errorOf(xml(std::string(kColumns) + "<AngleBasis><AngleBasisName>b</AngleBasisName>\n" +
                      block(0, 0, 90, 2000000000) + "</AngleBasis>\n",
                  band("Visible", "Transmission Front",
                       "<ColumnAngleBasis>b</ColumnAngleBasis><RowAngleBasis>b</RowAngleBasis>", "1 2"))),
      "a.xml:18: fewer numbers than the 2000000000 by 2000000000 of the angle bases");
}

TEST(BsdfFile, DoubtsAreWarnedOf) {
  EXPECT_TRUE(warningsOf(oneMatrix("1 2 3 4 5 6 7 8 9, ")).empty());
  EXPECT_EQ(warningsOf(oneMatrix("1 2 3 4 5 6 7 8 9 10")),
            std::vector<std::string>{"a.xml:22: more numbers than the 3 by 3 of the angle bases"});
  const std::string definition = std::string(kColumns) +
                                 "<AngleBasis><AngleBasisName>LBNL/Klems Half</AngleBasisName>\n" +
                                 block(0, 0, 90, 1) + "</AngleBasis>\n";
  EXPECT_EQ(warningsOf(xml(definition, "")),
            std::vector<std::string>{
                "a.xml:9: the angles differ from those of LBNL/Klems Half, which are used instead"});
}

TEST(BsdfFile, TreesThatAreWrong) {
  EXPECT_EQ(errorOf(oneTree("{1}\n{2}")), "a.xml:17: expected the end of the tensor tree");
  EXPECT_EQ(errorOf(oneTree("1")), "a.xml:16: expected '{' in the tensor tree");
  EXPECT_EQ(errorOf(oneTree("{1 2}")), "a.xml:16: 2 values do not form a grid of 4 dimensions");
  EXPECT_EQ(errorOf(oneTree("{}")), "a.xml:16: 0 values do not form a grid of 4 dimensions");
  EXPECT_EQ(errorOf(oneTree("{{1}{2}}", kTree3)), "a.xml:16: expected '{' in the tensor tree");
  EXPECT_EQ(errorOf(oneTree("{1")), "a.xml:16: expected '}' in the tensor tree");
  EXPECT_EQ(errorOf(xml(kTree3, band("Visible", "Transmission Front", "", "{1}"))),
            "a.xml:12: expected the AngleBasis LBNL/Shirley-Chiu, got \"\"");
  // Neither depth nor breadth may take unlimited stack or memory.
  EXPECT_EQ(errorOf(oneTree(std::string(1 << 20, '{'))), "a.xml:16: the tensor tree is too deep");
}

// A file that is cut off anywhere causes an error with a place, or none if the missing part is not needed.
TEST(BsdfFile, CutOffAnywhere) {
  for (const std::string& text : {oneMatrix("1 2 3\n4 5 6\n7 8 9"), oneTree("{1 2 3 4 5 6 7 8}", kTree3)})
    for (size_t length = 0; length + 2 < text.size(); ++length)
      EXPECT_TRUE(errorOf(text.substr(0, length)).starts_with("a.xml:")) << length;
}

}  // namespace
}  // namespace rad
