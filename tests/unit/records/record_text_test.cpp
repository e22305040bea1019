#include "records/record_text.h"

#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

TEST(RecordText, AsRtraceWritesIt) {
  std::string bytes;
  RecordText text(bytes, NumberFormat::ascii);
  text.vector(V3d(1, -.5, 1e10));
  text.integer(12345678901);
  text.name("wall");
  text.color(Color(0, 1, 2));
  text.end();
  EXPECT_EQ(bytes,
            "1.000000e+00\t-5.000000e-01\t1.000000e+10\t12345678901\twall\t0.000000e+00\t1.000000e+00\t2."
            "000000e+00\t\n");
  bytes.clear();
  RecordText floats(bytes, NumberFormat::float32);
  floats.number(.1);
  floats.name("wall");
  floats.integer(3);
  floats.end();
  EXPECT_EQ(bytes, bytesOf<float>({.1f}) + "wall\t" + bytesOf<float>({3}));
  bytes.clear();
  RecordText doubles(bytes, NumberFormat::float64);
  doubles.vector(V3d(1, 2, .1));
  EXPECT_EQ(bytes, bytesOf<double>({1, 2, .1}));
}

}  // namespace
}  // namespace rsphere
