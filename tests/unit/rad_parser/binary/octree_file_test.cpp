#include "rad_parser/binary/octree_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "rad_parser/binary/binary_reader.h"
#include "rad_parser/printable.h"
#include "tests/unit/rad_parser/binary/binary_data.h"
#include "tests/unit/rad_parser/scene_text.h"

namespace octree_file_test {
namespace {

using rad::Description;
using rad::kVoid;
using rad::Primitive;
using rad::PrimitiveId;
using rad::Status;
using rad::Type;

std::string fixture(const std::string& name) { return RSPHERE_TESTS "/scenes/octree/" + name; }

// Octrees that are not frozen name their files relative to the folder in which they were made.
class InFolder {
 public:
  explicit InFolder(const std::string& path) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(path);
  }
  ~InFolder() { std::filesystem::current_path(before_); }

 private:
  std::filesystem::path before_;
};

// Compares primitives, with a relative error of `within` for real arguments.
// more: primitives at the end of a that b does not have.
void expectSame(const Description& a, const Description& b, double within, size_t more = 0) {
  ASSERT_EQ(a.primitives.size(), b.primitives.size() + more);
  for (size_t i = 0; i < b.primitives.size(); ++i) {
    const Primitive &p = a.primitives.at(i), &q = b.primitives.at(i);
    SCOPED_TRACE(fmt::format("{} {}", i, q.name));
    EXPECT_EQ(p.type, q.type);
    EXPECT_EQ(p.modifier, q.modifier);
    EXPECT_EQ(p.aliased, q.aliased);
    EXPECT_EQ(p.name, q.name);
    ASSERT_EQ(p.strings, q.strings);
    for (uint32_t k = 0; k < p.strings; ++k) EXPECT_EQ(a.string(p, k), b.string(q, k));
    ASSERT_EQ(p.reals, q.reals);
    for (uint32_t k = 0; k < p.reals; ++k)
      EXPECT_NEAR(a.reals(p)[k], b.reals(q)[k], within * std::abs(b.reals(q)[k])) << k;
  }
}

// The fields of an octree that a test writes: "mat" and two spheres in one leaf.
struct OctreeData {
  int width = 4;
  std::string header = "#?RADIANCE\noconv made by hand\nFORMAT=Radiance_octree\n\n";
  std::vector<std::string> files = {};
  int64_t objects = 3;
  std::string cells;  // empty: one leaf with both spheres
  std::string types = std::string("sphere\0plastic\0alias\0\0", 22);

  std::string sphere(int64_t modifier, std::string_view name) const {
    BinaryData d;
    d.integer(0, 1).integer(modifier, width).string(name).integer(0, 2).integer(4, 2);
    for (int i = 0; i < 4; ++i) d.real(1073741823, 1);
    return d.bytes;
  }
  std::string scene() const {
    BinaryData d;
    d.integer(1, 1).integer(-1, width).string("mat").integer(0, 2).integer(0, 2);
    return types + d.bytes + sphere(0, "a") + sphere(0, "b") + '\xff';
  }
  std::string beforeScene() const {
    BinaryData d;
    d.bytes = header;
    d.integer(283 + width, 2).string("-1").string("-2.5").string("3e0").string("10");
    for (const std::string& file : files) d.string(file);
    d.string("").integer(objects, width);
    if (cells.empty())
      d.integer(1, 1).integer(2, width).integer(1, width).integer(2, width);
    else
      d.bytes += cells;
    return d.bytes;
  }
  std::string bytes() const { return beforeScene() + scene(); }
};

Description readBytes(std::string_view bytes, std::vector<std::string>* warnings = nullptr) {
  const TestFolder folder;
  return readFile(folder.write("t.oct", bytes), warnings);
}
std::string errorOfBytes(std::string_view bytes) {
  const TestFolder folder;
  const std::string path = folder.write("t.oct", bytes);
  const std::string error = errorOf([&] { readFile(path); });
  return error.starts_with(path) ? error.substr(path.size() - 5) : error;
}

TEST(OctreeFile, FrozenIsItsText) {
  std::vector<std::string> warnings;
  const Description octree = readFile(fixture("frozen.oct"), &warnings);
  const Description text = readFile(fixture("every.rad"));
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(text.primitives.size(), 17u);
  expectSame(octree, text, 1.0001 / 0x80000000);
  EXPECT_EQ(octree.header, (std::vector<std::string>{"#?RADIANCE", "oconv -f every.rad"}));
  ASSERT_TRUE(octree.cube);  // the numbers are from getinfo -d frozen.oct
  EXPECT_EQ(octree.cube->size, 5.12502);
  EXPECT_EQ(octree.cube->origin, (std::array{-1.56251, -2.50001, -2.00001}));
  EXPECT_TRUE(text.header.empty());
  EXPECT_FALSE(text.cube);
  EXPECT_EQ(octree.at(octree.primitives.at(0).place), fixture("frozen.oct") + ": object 1");
  EXPECT_EQ(octree.at(octree.primitives.at(16).place), fixture("frozen.oct") + ": object 17");
}

TEST(OctreeFile, NamedFilesAreReadFromWhereItWasMade) {
  Description octree;
  {
    const InFolder here(fixture(""));
    octree = readFile("named.oct");
  }
  Description text = readFile(fixture("every.rad"));
  ASSERT_EQ(octree.primitives.size(), text.primitives.size() + 2);
  EXPECT_EQ(octree.at(octree.primitives.at(17).place), "ball.rad:1 (from named.oct)");
  EXPECT_EQ(octree.at(octree.primitives.at(18).place),
            "!echo glass sphere third 0 0 4 0 2 0 .25:1 (from named.oct)");
  EXPECT_EQ(octree.primitives[octree.primitives.at(18).modifier].name, "glass");
  EXPECT_EQ(octree.header[1], "oconv every.rad ball.rad \"!echo glass sphere third 0 0 4 0 2 0 .25\"");
  expectSame(octree, text, 0, 2);

  const TestFolder elsewhere;
  const InFolder there(elsewhere.path());
  EXPECT_EQ(errorOf([] { readFile(fixture("named.oct")); }, Status::system),
            "every.rad (from " + fixture("named.oct") +
                "): cannot open scene file: No such file or directory (an octree that is not frozen is used "
                "in the folder that it was made in)");
}

TEST(OctreeFile, FailuresOfCommandsInNamedFilesAreWarnings) {
  const TestFolder folder;
  for (const char* name : {"named.oct", "every.rad", "ball.rad"})
    std::filesystem::copy(fixture(name), folder.path(name));
  const InFolder here(folder.path());
  std::ofstream("every.rad", std::ios::app) << "\n!exit 3\n!xform -q 3 ball.rad\n!xform missing.rad\n";
  std::vector<std::string> warnings;
  EXPECT_EQ(readFile("named.oct", &warnings).primitives.size(), 19u);
  std::erase_if(warnings, [](const std::string& w) { return w.find("writes nothing") != w.npos; });
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_NE(warnings[0].find("bad status from \"!exit 3\": exit status 3"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("xform: bad option or argument"), std::string::npos) << warnings[1];
  EXPECT_NE(warnings[2].find("xform: cannot find file \"missing.rad\""), std::string::npos) << warnings[2];
}

TEST(OctreeFile, NamedFilesThatChangedAreStale) {
  const TestFolder folder;
  for (const char* name : {"named.oct", "every.rad", "ball.rad"})
    std::filesystem::copy(fixture(name), folder.path(name));
  const InFolder here(folder.path());
  EXPECT_EQ(readFile("named.oct").primitives.size(), 19u);
  EXPECT_EQ(errorOf([] { readFile("named.oct", nullptr, false); }),
            "named.oct: commands are not allowed: \"!echo glass sphere third 0 0 4 0 2 0 .25\"");

  folder.write("ball.rad", "glass bubble second 0 0 4 0 0 -4 1 glass bubble third 0 0 4 0 0 -5 1");
  EXPECT_EQ(errorOf([] { readFile("named.oct"); }),
            "named.oct: bad object count: 20 in its scene files, 19 when it was made; octree stale?");
  folder.write("ball.rad", "void glass second 0 0 3 1 1 1");
  EXPECT_EQ(errorOf([] { readFile("named.oct"); }), "named.oct: modifier in tree; octree stale?");
  folder.write("ball.rad", "void glass");
  EXPECT_EQ(errorOf([] { readFile("named.oct"); }),
            "ball.rad:1 (from named.oct): text ends within glass \"\"");
}

TEST(OctreeFile, FromACommand) {
  const std::string command = "!cat " + fixture("frozen.oct");
  std::vector<std::string> warnings;
  const Description d = readFile(command, &warnings);
  expectSame(d, readFile(fixture("frozen.oct")), 0);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(d.at(d.primitives.at(1).place), rad::printable(command, 100) + ": object 2");
  EXPECT_NE(errorOf([&] { readFile(command + "; exit 4"); }).find("\": exit status 4; surfaces"),
            std::string::npos);
  constexpr std::string_view kWhatToDo =
      "; a command that is given as the scene must write an octree or scene text to standard output";
  EXPECT_EQ(errorOf([] { readFile("!false"); }),
            fmt::format("!false: not an octree: 0 bytes, exit status 1{}", kWhatToDo));
  EXPECT_EQ(errorOf([] { readFile("!:"); }), fmt::format("!:: not an octree: 0 bytes{}", kWhatToDo));
  EXPECT_NE(errorOf([&] { readFile(command, nullptr, false); }).find("commands are not allowed"),
            std::string::npos);
}

TEST(OctreeFile, EveryWidthOfObjectNumbers) {
  for (int width = 1; width <= 8; ++width) {
    OctreeData data;
    data.width = width;
    const Description d = readBytes(data.bytes());
    ASSERT_EQ(d.primitives.size(), 3u) << width;
    EXPECT_EQ(d.primitives.at(0).modifier, kVoid);
    EXPECT_EQ(d.primitives.at(2).modifier, PrimitiveId(0));
    EXPECT_EQ(d.reals(d.primitives.at(1))[0], 1);
    EXPECT_EQ(d.cube->origin, (std::array{-1., -2.5, 3.}));
  }
  OctreeData data;
  const std::string whole = data.bytes();
  for (const int number : {0, 283, 292, 0x7fff, 0xffff}) {
    std::string bytes = whole;
    bytes[data.header.size()] = static_cast<char>(number >> 8);
    bytes[data.header.size() + 1] = static_cast<char>(number);
    EXPECT_EQ(errorOfBytes(bytes),
              fmt::format("t.oct: incompatible format at byte {}", data.header.size() + 2));
  }
}

// The encoding truncates to a mantissa of 31 bits. The ends of its range are included.
TEST(OctreeFile, Reals) {
  const auto decoded = [](int64_t m, int e) {
    OctreeData data;
    std::string bytes = data.bytes();
    BinaryData real;
    real.real(m, e);
    bytes.replace(bytes.size() - 6, 5, real.bytes);
    const Description d = readBytes(bytes);
    return d.realArgs.back();
  };
  EXPECT_EQ(decoded(1073741823, 1), 1);
  EXPECT_EQ(decoded(-1073741823, 1), -1);
  EXPECT_EQ(decoded(1073741823, 127), std::ldexp(1, 126));
  EXPECT_EQ(decoded(-1073741823, -128), -std::ldexp(1, -129));
  EXPECT_EQ(decoded(0, 0), 0);
  EXPECT_EQ(decoded(0, -7), 0);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-80, 80);
  for (int i = 0; i < 200; ++i) {
    const double x = std::pow(2, exponent(random)) * (i % 2 ? 1 : -1);
    int e;
    const auto m = static_cast<int64_t>(std::frexp(x, &e) * 0x7fffffff);
    EXPECT_NEAR(decoded(m, e), x, std::abs(x) / 0x7fffffff) << x;
  }
}

TEST(OctreeFile, HeadersAsProgramsWriteThem) {
  OctreeData data;
  data.header = "#?RADIANCE\nxform -t 1 2 3\n\tCAPDATE= 2020:01:01\nFORMAT= Radiance_octree \n\n";
  EXPECT_EQ(readBytes(data.bytes()).header,
            (std::vector<std::string>{"#?RADIANCE", "xform -t 1 2 3", "\tCAPDATE= 2020:01:01"}));
  data.header = "#?RADIANCE\r\nFORMAT=Radiance_octree\r\n\r\n";
  EXPECT_EQ(readBytes(data.bytes()).header, std::vector<std::string>{"#?RADIANCE"});
  data.header = "#?RADIANCE\noconv\n\n";  // without a format, the number decides
  EXPECT_EQ(readBytes(data.bytes()).primitives.size(), 3u);
  data.header = "#?RADIANCE\n" + std::string(70000, 'x') + "\nFORMAT=Radiance_octree\n\n";
  EXPECT_NE(errorOfBytes(data.bytes()), "");  // the format is behind the beginning that is examined
  data.header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  EXPECT_EQ(errorOfBytes(data.bytes()), "t.oct: not an octree: its header says FORMAT=32-bit_rle_rgbe");
}

// Headers without the first line, as programs wrote them before it was introduced, and headers that
// other programs have changed.
TEST(OctreeFile, WithoutAFirstLineOfItsOwnIsAnOctree) {
  OctreeData data;
  data.header = "oconv -f -n 8 !fuzzmaker \nFORMAT=Radiance_octree\n\n";
  EXPECT_EQ(readBytes(data.bytes()).header, std::vector<std::string>{"oconv -f -n 8 !fuzzmaker "});
  EXPECT_EQ(readBytes(data.bytes()).primitives.size(), 3u);
  const TestFolder folder;
  const std::string file = folder.write("t.oct", data.bytes());
  EXPECT_EQ(rad::readOctree(file).primitives.size(), 3u) << "as an instance";
  EXPECT_EQ(readFile("!cat " + file).primitives.size(), 3u);
  for (const char* header : {"FORMAT=Radiance_octree\n\n", "oconv\n\n", "oconv\r\n\r\n",
                             "FORMAT=ascii\nFORMAT=Radiance_octree\n\n"}) {
    data.header = header;
    EXPECT_EQ(readBytes(data.bytes()).primitives.size(), 3u) << header;
  }
  data.header = "oconv\nFORMAT=Radiance_octree\nFORMAT=ascii\n\n";
  EXPECT_EQ(errorOfBytes(data.bytes()), "t.oct: not an octree: its header says FORMAT=ascii");
  data.header = "\n\n";  // no header at all
  EXPECT_NE(errorOfBytes(data.bytes()), "");
  // Scene text may contain empty lines, and words like these.
  for (const char* text :
       {"void plastic m\n\n0 0 0\n", "void plastic FORMAT=x 0 0 0\n\n", "void plastic\nFORMAT=x\n\n0 0 0\n"})
    EXPECT_EQ(readFile(folder.write("text.rad", text)).primitives.size(), 1u) << text;
}

TEST(OctreeFile, WhatIsNoOctree) {
  const TestFolder folder;
  const std::string empty = folder.write("empty.oct", ""),
                    text = folder.write("text.oct", "void plastic m 0 0 0");
  EXPECT_EQ(errorOf([&] { readFile(empty); }),
            empty + ": not an octree: 0 bytes (did the program that makes it fail?)");
  EXPECT_EQ(readFile(text).primitives.size(), 1u);  // the contents decide, not the name
  EXPECT_EQ(errorOf([&] { rad::readOctree(text); }), text + ": not an octree");
  EXPECT_EQ(errorOf([&] { rad::readOctree(empty); }),
            empty + ": not an octree: 0 bytes (did the program that makes it fail?)");
  std::filesystem::create_directory(folder.path("dir.oct"));
  EXPECT_EQ(errorOf([&] { readFile(folder.path("dir.oct")); }, Status::system),
            folder.path("dir.oct") + ": cannot read: Is a directory");
  EXPECT_EQ(errorOf([&] { readFile(folder.path("none.oct")); }, Status::system),
            folder.path("none.oct") + ": cannot open octree file: No such file or directory");
  EXPECT_EQ(errorOf([&] { rad::readOctree("none.oct"); }, Status::system),
            "none.oct: cannot find octree file" + rad::FileAccess().remark("none.oct", true));
  EXPECT_EQ(errorOf([&] {
              rad::readScene(std::vector{text, fixture("frozen.oct")});
            }),
            fixture("frozen.oct") + ": an octree is a whole scene: it cannot be combined with other files");
  EXPECT_EQ(readFile(folder.write("note.rad", "#? no header\nvoid plastic m 0 0 0")).primitives.size(), 1u);
}

TEST(OctreeFile, AliasesByNumber) {
  OctreeData data;
  data.objects = 4;
  const auto alias = [&](int64_t modifier) {
    BinaryData d;
    d.integer(2, 1).integer(modifier, data.width).string("x").integer(0, 2).integer(0, 2);
    std::string scene = data.scene();
    scene.pop_back();
    return data.beforeScene() + scene + d.bytes + '\xff';
  };
  const Description d = readBytes(alias(0));
  EXPECT_EQ(d.primitives.at(3).aliased, PrimitiveId(0));
  EXPECT_EQ(d.primitives.at(3).modifier, kVoid);
  EXPECT_EQ(d.string(d.primitives.at(3), 0), "mat");
  EXPECT_NE(errorOfBytes(alias(-1)).find("an alias of nothing at byte"), std::string::npos);
  EXPECT_NE(errorOfBytes(alias(1)).find("t.oct: object 4: object 2 is not a modifier"), std::string::npos);
  EXPECT_NE(errorOfBytes(alias(3)).find("t.oct: object 4: modifier 4 does not precede it"),
            std::string::npos);
  EXPECT_NE(errorOfBytes(alias(-2)), "");
}

TEST(OctreeFile, UnknownTypesAreAWarningUntilUsed) {
  OctreeData data;
  std::vector<std::string> warnings;
  data.types = std::string("sphere\0plastic\0alias\0tesseract\0\0", 32);
  EXPECT_EQ(readBytes(data.bytes(), &warnings).primitives.size(), 3u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].ends_with("t.oct: unknown type \"tesseract\"")) << warnings[0];
  data.types = std::string("tesseract\0plastic\0alias\0\0", 25);
  EXPECT_TRUE(errorOfBytes(data.bytes()).starts_with("t.oct: object 2: unknown type"));
  data.types = std::string("sphere\0\0", 8);
  EXPECT_TRUE(errorOfBytes(data.bytes()).starts_with("t.oct: object 1: unknown type number 1 (byte"));
}

TEST(OctreeFile, DamagedCells) {
  OctreeData data;
  const auto leaf = [&](std::initializer_list<int64_t> words) {
    BinaryData d;
    d.integer(1, 1);
    for (const int64_t word : words) d.integer(word, data.width);
    return d.bytes;
  };
  const auto with = [&](const std::string& cells) {
    data.cells = cells;
    return errorOfBytes(data.bytes());
  };
  EXPECT_EQ(with(leaf({2, 1, 2})), "");
  EXPECT_EQ(with(leaf({0})), "");
  EXPECT_EQ(with("\2" + leaf({1, 1}) + std::string(7, '\0')), "");
  EXPECT_NE(with(leaf({1, 3})).find("damaged octree: object 4 of 3 at byte"), std::string::npos);
  EXPECT_NE(with(leaf({1, -1})).find("damaged octree: object 0 of 3"), std::string::npos);
  EXPECT_NE(with(leaf({2, 2, 1})).find("damaged octree: a leaf out of order"), std::string::npos);
  EXPECT_NE(with(leaf({-1})).find("damaged octree: a leaf of negative size"), std::string::npos);
  EXPECT_NE(with("\3").find("damaged octree at byte"), std::string::npos);
  data.objects = 4;
  EXPECT_NE(with(leaf({0})).find("damaged octree: 3 objects instead of 4"), std::string::npos);
}

// Data that are announced but missing are an error as soon as the data end, whatever was announced.
TEST(OctreeFile, HostileCounts) {
  OctreeData data;
  data.width = 8;
  data.objects = std::numeric_limits<int32_t>::max();
  EXPECT_NE(errorOfBytes(data.bytes()).find("damaged octree: 3 objects instead of 2147483647"),
            std::string::npos);
  data.objects = int64_t{1} << 40;
  EXPECT_NE(errorOfBytes(data.bytes()).find("damaged octree: 1099511627776 objects"), std::string::npos);
  data.objects = -1;
  EXPECT_NE(errorOfBytes(data.bytes()).find("damaged octree: -1 objects"), std::string::npos);
  data.objects = 3;
  data.cells = "\1" + std::string("\x7f\xff\xff\xff\xff\xff\xff\xff", 8);
  EXPECT_NE(errorOfBytes(data.beforeScene()).find("truncated octree at byte"), std::string::npos);
  data.cells = std::string(10 << 20, '\2');  // ten million nested cells
  EXPECT_NE(errorOfBytes(data.beforeScene()).find("truncated octree at byte"), std::string::npos);
  data.cells = std::string(1, '\0');
  data.files = {std::string(1 << 20, 'x')};
  EXPECT_NE(errorOfBytes(data.bytes()).find("a string of more than 65536 bytes"), std::string::npos);
  data.files = {std::string(65536, 'x')};
  EXPECT_NE(errorOf([&] { readBytes(data.bytes()); }, Status::system).find("cannot open scene file"),
            std::string::npos);
}

TEST(OctreeFile, TruncatedAnywhereIsAnError) {
  const TestFolder folder;
  for (const char* name : {"frozen.oct", "named.oct"}) {
    const InFolder here(fixture(""));
    const std::string whole = bytesOf(fixture(name));
    const size_t header = whole.find("\n\n") + 2;
    for (size_t length = 0; length < whole.size(); ++length) {
      const std::string path = folder.write("t.oct", whole.substr(0, length));
      const std::string error = errorOf([&] { rad::readOctree(path); });
      ASSERT_NE(error, "") << name << " " << length;
      if (length >= header)
        EXPECT_EQ(error, fmt::format("{}: truncated octree at byte {}", path, length));
      else
        EXPECT_TRUE(error.find("not an octree") != error.npos ||
                    error.find(": truncated octree at") != error.npos ||
                    error.find("its header says") != error.npos)
            << error;
    }
  }
}

// Any bytes give either a consistent description or an error with the name of the file.
TEST(OctreeFile, FlippedBytesAreReadOrRefused) {
  const TestFolder folder;
  std::mt19937_64 random(5);
  int refused = 0;
  for (const char* name : {"frozen.oct", "ball.oct"}) {
    std::string whole = name == std::string("ball.oct") ? OctreeData().bytes() : bytesOf(fixture(name));
    for (int trial = 0; trial < 3000; ++trial) {
      std::string bytes = whole;
      for (int k = static_cast<int>(random() % 3); k >= 0; --k)
        bytes[random() % bytes.size()] =
            static_cast<char>(trial % 2 ? random() : bytes[0] ^ (1 << random() % 8));
      const std::string path = folder.write("t.oct", bytes);
      try {
        rad::ReadOptions options;
        options.commands = false;
        const Description d = rad::readOctree(path, options);
        for (size_t i = 0; i < d.primitives.size(); ++i) {
          const Primitive& p = d.primitives.at(i);
          ASSERT_LT(p.modifier, PrimitiveId(i));
          ASSERT_LE(p.type == Type::polygon ? p.firstReal + (p.reals + 2) / 3 : p.firstReal + p.reals,
                    p.type == Type::polygon ? d.vertices.size() : d.realArgs.size());
          ASSERT_LE(p.firstString + p.strings, d.stringArgs.size());
          ASSERT_EQ(p.type == Type::alias, p.aliased != kVoid);
        }
      } catch (const rad::Error& error) {
        ++refused;
        EXPECT_NE(std::string(error.what()).find("t.oct"), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace octree_file_test
