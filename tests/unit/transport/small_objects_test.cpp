#include "transport/small_objects.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

// A ground of 512 m with a table of 2 m on it, and tiles of 1 m that lie in its plane.
const std::string kGround =
    "void plastic gray 0 0 5 .5 .5 .5 0 0\n"
    "gray polygon ground 0 0 12 -256 -256 0 256 -256 0 256 256 0 -256 256 0\n"
    "gray polygon tile 0 0 12 100 100 0 101 100 0 101 101 0 100 101 0\n";
const std::string kTable = "gray polygon table 0 0 12 10 10 .7 12 10 .7 12 12 .7 10 12 .7\n";

class Objects {
 public:
  explicit Objects(const std::string& text)
      : traced_(text),
        grid_(traced_.transport().tracer().bounds()),
        objects_(traced_.scene(), traced_.transport().tracer(), grid_, .1) {}
  bool anyNear(double x, double y, double side) const {
    return objects_.anyNear({V3d(x, y, grid_.lift), V3d(0, 0, 1)}, side);
  }

 private:
  Traced traced_;
  CellGrid grid_;
  SmallObjects objects_;
};

TEST(SmallObjects, AreFoundFromAsFarAsTheCellIsWide) {
  const Objects objects(kGround + kTable);
  for (const double side : {64., 32., 16., 8., 4.}) {
    EXPECT_TRUE(objects.anyNear(11, 11, side)) << side;
    EXPECT_TRUE(objects.anyNear(12 + .45 * side, 11, side)) << side;
    EXPECT_FALSE(objects.anyNear(12 + 2.1 * side, 11, side)) << side;
  }
}

TEST(SmallObjects, AreSmallerThanTheCell) {
  const Objects objects(kGround + kTable);
  for (const double side : {2., 1., .5, .25}) EXPECT_FALSE(objects.anyNear(11, 11, side)) << side;
}

TEST(SmallObjects, AreNoneInThePlaneOfTheSite) {
  const Objects objects(kGround);
  for (const double side : {64., 8., 2.}) EXPECT_FALSE(objects.anyNear(100.5, 100.5, side)) << side;
  // Seen from a wall beside them, the same tiles are objects.
  const Traced traced(kGround);
  const CellGrid grid(traced.transport().tracer().bounds());
  const SmallObjects all(traced.scene(), traced.transport().tracer(), grid, .1);
  EXPECT_TRUE(all.anyNear({V3d(99.9, 100.5, .5), V3d(1, 0, 0)}, 8));
}

TEST(SmallObjects, AreFoundWhereNothingElseIs) {
  const Objects objects("void plastic gray 0 0 5 .5 .5 .5 0 0\n" + kTable);
  EXPECT_FALSE(objects.anyNear(11, 11, 100)) << "as large as the scene";
}

}  // namespace
}  // namespace rsphere
