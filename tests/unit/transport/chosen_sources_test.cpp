// -Ss: direct light is estimated from a few light sources that are drawn at random.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/transport/transport_fixture.h"

namespace rsphere {
namespace {

RayOptions withChosen(int count) {
  RayOptions options;
  options.directThreshold = 0;
  options.directJitter = 1;
  options.chosenSources = count;
  return options;
}

// Four lamps over a floor, one of them hidden from it by a screen, one behind a pane, one near, and a mirror
// that makes a virtual source of each.
std::string room(const std::string& paint) {
  return "void light weak\n0\n0\n3 4 4 4\nvoid light strong\n0\n0\n3 30 30 30\nvoid glass pane\n0\n0\n3 .9 "
         ".9 .9\n"
         "void mirror silver\n0\n0\n3 .8 .8 .8\nvoid plastic black\n0\n0\n5 0 0 0 0 0\n" +
         paint +
         "weak polygon near\n0\n0\n12 .2 -.3 .4 .2 .3 .4 .8 .3 .4 .8 -.3 .4\n"
         "strong sphere bulb\n0\n0\n4 -1 2 2 .2\n"
         "strong ring hidden\n0\n0\n8 2 2 3 0 0 -1 0 .3\n"
         "black polygon screen\n0\n0\n12 1 1 1.5 1.5 1 1.5 1.5 1.5 1.5 1 1.5 1.5\n"
         "strong cylinder tube\n0\n0\n7 -2 -1 2 -2 1 2 .03\n"
         "pane polygon window\n0\n0\n12 -1 -2 0 -1 2 0 -1 2 4 -1 -2 4\n"
         "silver polygon wall\n0\n0\n12 0 3 0 2 3 0 2 3 3 0 3 3\n"
         "paint polygon floor\n0\n0\n12 -5 -5 0 5 -5 0 5 5 0 -5 5 0\n";
}

TEST(ChosenSources, StandForAll) {
  const std::string even = "void plastic paint\n0\n0\n5 .5 .5 .5 .03 .2\n";
  const V3d from(0, 0, 2), down(0, .01, -1);
  for (const int count : {1, 3}) {
    const Sample all = Traced(room(even), withChosen(0)).mean(from, down, 4000);
    const Sample chosen = Traced(room(even), withChosen(count)).mean(from, down, 20000, 7);
    EXPECT_GT(chosen.mean(), 0);
    expectMean(chosen, all.mean());
  }
}

// If a surface has a narrow highlight, all sources are tested, because random choice would rarely select the
// source in the highlight.
TEST(ChosenSources, AreAllWhereThereIsAHighlight) {
  const std::string polished = "void plastic paint\n0\n0\n5 .5 .5 .5 .05 .02\n";
  const V3d from(0, 0, 2), down(0, .01, -1);
  for (uint64_t seed = 1; seed < 20; ++seed)
    EXPECT_EQ(Traced(room(polished), withChosen(1)).value(from, down, seed),
              Traced(room(polished), withChosen(0)).value(from, down, seed));
}

}  // namespace
}  // namespace rsphere
