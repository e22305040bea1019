#include "rad_parser/primitive_list.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "rad_parser/description.h"

namespace rad {
namespace {

void expectSame(const Primitive& a, const Primitive& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.modifier, b.modifier);
  EXPECT_EQ(a.aliased, b.aliased);
  EXPECT_EQ(a.place.file, b.place.file);
  EXPECT_EQ(a.place.line, b.place.line);
  EXPECT_EQ(a.firstString, b.firstString);
  EXPECT_EQ(a.strings, b.strings);
  EXPECT_EQ(a.firstReal, b.firstReal);
  EXPECT_EQ(a.reals, b.reals);
  EXPECT_EQ(a.name, b.name);
}

// Any values at all, of which some follow from the preceding primitive as they do in scenes.
std::vector<Primitive> anyPrimitives(size_t count) {
  std::mt19937 random(1);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  const auto any = [&] { return static_cast<uint32_t>(random() >> below(32)); };
  std::vector<Primitive> all;
  for (size_t i = 0; i < count; ++i) {
    Primitive p;
    p.type = static_cast<Type>(below(kTypes));
    if (below(4)) p.modifier = PrimitiveId(any() / 2);
    if (p.type == Type::alias) p.aliased = PrimitiveId(any() / 2);
    p.place = below(4) ? Place{3, static_cast<uint32_t>(i)} : Place{any(), any()};
    p.firstString = any();
    p.strings = any();
    p.firstReal = static_cast<uint64_t>(any()) << below(20);
    p.reals = any();
    p.name =
        below(2) ? fmt::format("part.{}", i) : std::string(below(4) ? below(20) : below(300), 'a' + below(2));
    all.push_back(p);
  }
  return all;
}

TEST(PrimitiveList, HasWhatWasPutIn) {
  const std::vector<Primitive> all = anyPrimitives(10 * PrimitiveList::kBlock + 5);
  PrimitiveList list;
  EXPECT_TRUE(list.empty());
  EXPECT_TRUE(list.begin() == list.end());
  for (const Primitive& p : all) {
    list.push_back(p);
    expectSame(list.back(), p);
  }
  list.shrink();
  ASSERT_EQ(list.size(), all.size());
  size_t i = 0;
  for (const Primitive& p : list) expectSame(p, all[i++]);
  EXPECT_EQ(i, all.size());
  for (const PrimitiveId id : list.ids()) {
    SCOPED_TRACE(id.number());
    expectSame(list[id], all[id.index()]);
    EXPECT_EQ(list.name(id), all[id.index()].name);
    EXPECT_EQ(list.isSurface(id), isSurface(all[id.index()].type));
    auto at = list.from(id.index());
    EXPECT_EQ(at.id(), id);
    if (id == list.last()) continue;
    ++at;
    expectSame(*at, all[id.index() + 1]);
  }
  EXPECT_TRUE(list.from(list.size()) == list.end());
}

TEST(PrimitiveList, NamesAreFrontCoded) {
  PrimitiveList list;
  const std::vector<std::string> names = {"",
                                          "a",
                                          "ab",
                                          "ab",
                                          "b",
                                          std::string(15, 'x'),
                                          std::string(30, 'x'),
                                          std::string(31, 'x'),
                                          std::string(70000, 'x'),
                                          "x",
                                          std::string("\0\xff", 2)};
  Primitive p;
  for (const std::string& name : names) {
    p.name = name;
    list.push_back(p);
  }
  for (size_t i = 0; i < names.size(); ++i) EXPECT_EQ(list.at(i).name, names[i]) << i;
}

// Polygons and the other primitives have their arguments in two lists.
TEST(PrimitiveList, ArgumentsFollowOneAnother) {
  PrimitiveList list;
  const auto add = [&](Type type, uint64_t first, uint32_t reals) {
    Primitive p;
    p.type = type;
    p.firstReal = first;
    p.reals = reals;
    list.push_back(p);
  };
  add(Type::plastic, 0, 5);
  add(Type::polygon, 0, 9);
  add(Type::sphere, 5, 4);
  add(Type::polygon, 3, 10);
  add(Type::polygon, 7, 12);
  add(Type::ring, 9, 8);
  const std::vector<uint64_t> first = {0, 0, 5, 3, 7, 9};
  for (size_t i = 0; i < first.size(); ++i) EXPECT_EQ(list.at(i).firstReal, first[i]) << i;
}

}  // namespace
}  // namespace rad
