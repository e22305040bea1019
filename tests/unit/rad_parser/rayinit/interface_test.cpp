#include "rad_parser/rayinit/interface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rad_parser/file_path.h"

namespace rad::calc {
namespace {

Library sceneLibrary() {
  return Library(sceneInterface(), [](std::string_view) { return std::optional<SourceText>(); });
}

// The inputs at the point where a ray hits the plane z = 0, for a primitive with the
// transform -s 2 -t -.1 .2 0.
std::vector<double> inputsOf(std::array<double, 3> from, std::array<double, 3> along) {
  std::vector<double> in(kInputs);
  const double length = std::hypot(along[0], along[1], along[2]);
  for (uint32_t i = 0; i < 3; ++i) in[Dx + i] = along[i] / length;
  in[Nz] = 1;
  const double distance = -from[2] / in[Dz];
  in[Px] = (from[0] + distance * in[Dx] + .1) / 2;
  in[Py] = (from[1] + distance * in[Dy] - .2) / 2;
  in[T] = in[Ts] = distance / 2;
  in[Rdot] = -in[Dz];
  in[S] = .5;
  in[Tx] = .05;
  in[Ty] = -.1;
  in[Ix] = in[Jy] = in[Kz] = 1;
  return in;
}

// The radiance in RADIANCE 6.1a of
//   void brightfunc f 8 EXPRESSION . -s 2 -t -.1 .2 0 0 4 .9 2 3 4
//   f glow g 0 0 4 1 1 1 0
//   g polygon p 0 0 12 0 0 0 10 0 0 10 10 0 0 10 0
// for the rays 3.7 6.1 6 .1 -.05 -1 and 8.25 1.3 4 -.3 .15 -1, with rtrace -h -w -ab 0 -fad, which computes
// radiance in single precision.
TEST(CalcScene, ValuesOfTheOriginal) {
  struct Row {
    const char* text;
    double first, second;
  };
  const Row table[] = {
      {"noise3(Px,Py,Px*Py)", 0.035376795, 0.13404392},
      {"noise3x(Px,Py,Px*Py)", -0.67750925, -0.056591615},
      {"noise3y(Px,Py,Px*Py)", -1.4926313, -0.87237197},
      {"noise3z(Px,Py,Px*Py)", -0.86500591, -0.29280239},
      {"noise3b(Px,Py,Px-Py)", 0.54931545, -0.89287937},
      {"fnoise3(Px+.00013,Py+.00021,Px*Py+.00017)", -0.27982372, 0.091918528},
      {"fnoise3(-Px-.00013,-Py*3-.00017,Px*Py+.00019)", -0.071131468, -0.60575867},
      {"rand(Px*Py)", 0.26430473, 0.67740881},
      {"turbulence(Px,Py,.3,.125)", 0.52254081, 0.16127315},
      {"turbulencex(Px,Py,.3,.125)", -0.33555159, -2.3599155},
      {"turbulencey(Px,Py,.3,.125)", 0.0075687612, -0.3042708},
      {"turbulencez(Px,Py,.3,.125)", 0.67510206, 0.13548066},
      {"hermite(.2,.9,1.5,-2,Px/10)", 0.56300879, 0.79002446},
      {"bezier(.2,.9,1.5,-2,Px/10)", 0.60488802, 0.72964519},
      {"bspline(.2,.9,1.5,-2,Px/10)", 1.0168147, 1.0788575},
      {"nrand(Px)", -0.41598332, 1.0915678},
      {"unif2norm(Px/20+.4)", 0.024998346, 0.19832478},
      {"fade(2,5,Px)", 4.4863014, 4.7823029},
      {"tri(Px,.7)", 0.60000002, 0.625},
      {"mod(-Px,.7)", 0.60000002, 0.625},
      {"frac(-Px)", 0.80000001, 0.42500001},
      {"cross(2,D,P)", -2.1863775, -3.389425},
      {"erf(Px/5)", 0.46622512, 0.68806142},
      {"erfc(Px/5)", 0.53377491, 0.31193855},
      {"U+10*V", 30.200001, 12.075},
      {"Acos(Px)+Asin(Px)+Atan2(0,0)+Exp(-Px*100)+Sqrt(-Px)", 1.5707964, 1.5707964},
      {"T+Ts*100", 304.88788, 213.05974},
      {"Rdot", 0.99380797, 0.94809091},
      {"S+10*Tx+100*Ix+1000*Jy+10000*Kz", 11101, 11101},
      {"A2*arg(3)+AC", 10, 10},
      {"grey(Px,-Py,3)+clipgrey(.1,.2,.9)+clip_r(Px,1,1)", 1.2188605, 1.7913368},
      {"xor(Px-5,Py-5)+or(Px-5,Py-5)*10+inside(2,Px,4)*100", 155.8, -3.1500001},
      {"linterp(.3,Px,Py)+sgn(Px-5)+noneg(5-Px)+bound(2,Px,5)", 6.3800001, 6.7575002},
      {"source_theta(0)+source_phi(90)*1000+source_phi(180)*100", 42082.168, 29383.014},
      {"source_corr(7,3)", 0.66963935, 0.34881535},
      {"source_corr(7,4)", 1.6627927, 1.2892632},
      {"source_corr(7,1)", 6.3392529, 6.6449323},
      {"source_corr(7,2)", 0.83411223, 0.61527151},
      {"Px^2+Px^3+Px^4+Px^.5+Px^1.7", 44.217327, 232.42757},
  };
  Library library = sceneLibrary();
  const std::vector<double> points[] = {inputsOf({3.7, 6.1, 6}, {.1, -.05, -1}),
                                        inputsOf({8.25, 1.3, 4}, {-.3, .15, -1})};
  const std::vector<double> reals = {.9, 2, 3, 4};
  State state;
  for (const Row& row : table) {
    const std::vector<std::string> texts = {row.text};
    Request request;
    request.expressions = texts;
    request.available = kPointInputs;
    for (int given = 0; given < 2; ++given) {
      if (given) request.reals = reals;
      const auto program = library.compile(request);
      const double expected[] = {row.first, row.second};
      for (int i = 0; i < 2; ++i) {
        const double value = program->evaluate({points[i], reals, {}}, state);
        EXPECT_NEAR(value, expected[i], 1e-7 * (1 + std::abs(expected[i]))) << row.text;
      }
    }
  }
  EXPECT_EQ(state.faults, 0u);
}

TEST(CalcScene, VariablesOfSomePrimitivesOnly) {
  Library library = sceneLibrary();
  const std::vector<std::string> texts = {"NxP+CrP"};
  Request request;
  request.expressions = texts;
  request.available = kPointInputs;
  EXPECT_THROW(library.compile(request), Error);
  request.available = kPrismInputs;
  EXPECT_THROW(library.compile(request), Error);
  request.available = kMaterialInputs;
  EXPECT_EQ(library.compile(request)->inputs(), uint64_t{1} << NxP | uint64_t{1} << CrP);
  const std::vector<std::string> prism = {"DzA"};
  request.expressions = prism;
  EXPECT_THROW(library.compile(request), Error);
  request.available = kPrismInputs;
  EXPECT_NO_THROW(library.compile(request));
}

// Idx, Idy, Idz rotate the reversed ray direction into the frame of the perturbed normal and the up vector.
TEST(CalcScene, HemisphereFrameIsARotation) {
  Library library = sceneLibrary();
  const std::vector<std::string> texts = {"Idx",          "Idy",          "Idz",
                                          "Ldx(.6,0,.8)", "Ldy(.6,0,.8)", "Ldz(.6,0,.8)"};
  Request request;
  request.expressions = texts;
  request.available = kMaterialInputs;
  const auto program = library.compile(request);
  std::vector<double> in(kInputs), reals = {5, 0, 0, 1};
  in[Dx] = .48, in[Dy] = .6, in[Dz] = -.64;
  in[NxP] = .6, in[NyP] = 0, in[NzP] = .8;
  in[RdotP] = -(.48 * .6 - .64 * .8);
  State state;
  double out[6];
  program->evaluate({in, reals, {}}, state, out);
  EXPECT_NEAR(out[0] * out[0] + out[1] * out[1] + out[2] * out[2], 1, 1e-12);
  EXPECT_NEAR(out[3] * out[3] + out[4] * out[4] + out[5] * out[5], 1, 1e-12);
  EXPECT_NEAR(out[5], 1, 1e-12);
  // x = y x z, and the y axis of the frame is the up vector crossed with the normal.
  EXPECT_NEAR(out[1], -.6, 1e-12);
  EXPECT_NEAR(out[0], .8 * .48 + .6 * .64, 1e-12);
}

TEST(CalcScene, PhotometryNeedsItsArguments) {
  Library library = sceneLibrary();
  State state;
  const std::vector<double> in = inputsOf({3.7, 6.1, 6}, {.1, -.05, -1});
  const std::vector<double> reals = {.9, 2};
  for (const char* text :
       {"source_corr(1,2)", "source_corr(1,3)", "source_corr(1,4)", "source_corr(1,7)", "source_phi(45)"}) {
    const std::vector<std::string> texts = {text};
    Request request;
    request.expressions = texts;
    const auto program = library.compile(request);
    EXPECT_THROW(program->evaluate({in, reals, {}}, state), Error) << text;
  }
}

TEST(CalcScene, MessagesSayWhereFilesWereLookedFor) {
  Library library = sceneLibrary();
  Request request;
  request.place = "room.rad:3";
  request.file = "gone.cal";
  try {
    library.compile(request);
    FAIL() << "a file that is not there was found";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(),
              "room.rad:3: cannot find function file \"gone.cal\"" + FileAccess().remark("gone.cal", true));
    EXPECT_EQ(error.status(), Status::system);
  }
}

}  // namespace
}  // namespace rad::calc
