// The time to evaluate a point, for each kind of function. It is compared with the tree walk of RADIANCE
// 6.1a, which no library offers: the user time of rtrace for 1.6 million rays (-h -w -ab 0) to a glow polygon
// with the function as its brightfunc or texfunc, minus that for a plain glow. One core of an AMD EPYC,
// 2026-11-21, ns a point, with real arguments given in advance:
//                                 RADIANCE    this
//   woodpat.cal                       1094     255
//   turbulence                        1262     131
//   dirt.cal                           537     187
//   pucker.cal                         281      93
//   paneltex.cal                       194      27
//   perezlum.cal                       644     100
//   branches                           256      53
//   recursion that branches          39838   29700
// The functions below are of these kinds.
#include <benchmark/benchmark.h>

#include <random>

#include "rad_parser/rayinit/interface.h"

namespace {

using namespace rad::calc;

const char* const kFunctions =
    "ring(u, v) = 10*sqrt(u*u + v*v) + noise3(u, v, .3);"
    "wood = hermite(.6 - A1/2, .6 + A1/2, 2, .5, 2*tri(ring(Px + turbulence(Px, Py, Pz, .25), Py), .5));"
    "turb = 1 - A1 + A1*turbulence(Px, Py, Pz, .0625);"
    "dust = 1 - A1*.5*(1 + fnoise3(Px, Py, Pz));"
    "bumpx = A1*noise3x(Px, Py, Pz); bumpy = A1*noise3y(Px, Py, Pz); bumpz = A1*noise3z(Px, Py, Pz);"
    "gap(x) = if(frac(x) - .05, 0, A1*cos(frac(x)*PI/.05));"
    "cosgamma = Dx*A8 + Dy*A9 + Dz*A10; gamma = Acos(cosgamma);"
    "perez = if(Dz - .01, A1*(1 + A3*Exp(A4/Dz))*(1 + A5*Exp(A6*gamma) + A7*cosgamma*cosgamma), A2);"
    "wave(v) = .5 + .4*sin(4.558*v); stripe = if(wave(Px) - .5, wave(Py), 1 - wave(Pz)/2);"
    "fib(n) = if(n - 1.5, fib(n-1) + fib(n-2), n);";

void evaluate(benchmark::State& state, const std::vector<std::string>& texts, bool realsGiven) {
  Library library(sceneInterface(), [](std::string_view name) {
    return name == "f.cal" ? std::optional<SourceText>({"f.cal", kFunctions}) : std::nullopt;
  });
  const std::vector<double> reals = {.3, .2, -1, -.3, 2, -3, .3, .2, .5, .84};
  Request request;
  request.file = "f.cal";
  request.expressions = texts;
  if (realsGiven) request.reals = reals;
  const auto program = library.compile(request);

  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(.1, 9.9);
  std::vector<double> xs(4096);
  for (double& x : xs) x = coordinate(random);
  std::vector<double> inputs(kInputs), out(texts.size());
  inputs[Nz] = 1;
  inputs[Dx] = .6;
  inputs[Dz] = .8;
  State evaluation;
  size_t i = 0;
  for (auto _ : state) {
    inputs[Px] = xs[i & 4095];
    inputs[Py] = xs[(i * 7 + 3) & 4095];
    ++i;
    program->evaluate({inputs, reals, {}}, evaluation, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["instructions"] = static_cast<double>(program->size());
}

void all(const char* name, const std::vector<std::string>& texts) {
  for (bool given : {false, true}) {
    benchmark::RegisterBenchmark((std::string(name) + (given ? "/reals_given" : "/reals_read")).c_str(),
                                 [=](benchmark::State& state) { evaluate(state, texts, given); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  all("wood", {"wood"});
  all("turbulence", {"turb"});
  all("fractal_noise", {"dust"});
  all("noise_texture", {"bumpx", "bumpy", "bumpz"});
  all("periodic_texture", {"gap(Px)", "gap(Py)", "gap(Pz)"});
  all("perez_sky", {"perez"});
  all("branches", {"stripe"});
  all("recursion", {"fib(floor(Px) + 8)"});
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
