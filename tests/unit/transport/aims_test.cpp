#include "transport/aims.h"

#include <gtest/gtest.h>

namespace rsphere {
namespace {

TEST(Aims, AreLeftOutAndAddedByFinder) {
  const Openings some({}, 1, 1), others({}, 2, 1);
  Aims aims(&some);
  EXPECT_EQ(aims.of<Openings>(), &some);
  EXPECT_EQ(aims.of<OpeningImages>(), nullptr);
  aims.add(Aims{});
  EXPECT_EQ(aims.of<Openings>(), &some) << "nothing was added";
  aims.add(Aims(&others));
  EXPECT_EQ(aims.of<Openings>(), &others);
  aims.leaveOut<BrightSpots>();
  EXPECT_EQ(aims.of<Openings>(), &others);
  aims.leaveOut<Openings, BrightSpots>();
  EXPECT_EQ(aims.of<Openings>(), nullptr);
}

TEST(FoundAims, KeepWhatIsNotEmpty) {
  FoundAims found;
  found.keep(Openings({}, 1, 1));
  EXPECT_EQ(Aims(found).of<Openings>(), nullptr);
  found.keep(Openings({Opening()}, 1, 1));
  ASSERT_TRUE(found.of<Openings>());
  EXPECT_EQ(Aims(found).of<Openings>(), found.of<Openings>());
}

}  // namespace
}  // namespace rsphere
