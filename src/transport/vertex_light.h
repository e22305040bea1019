#pragma once
// The light of plain surfaces by paths from both ends: direct light by a shadow ray to one source, indirect
// light by shadow rays to light vertices.
//
// Light of vertices arrives with the kernel 1 / (d^2 + c^2) instead of 1 / d^2, which has no bound. One ray
// in a random direction brings the missing part: the light of the place that it hits at the distance d is
// added with the probability c^2 / (d^2 + c^2) (Kollig and Keller 2004, "Illumination in the presence of weak
// singularities"). Such rays do not bring light that has reached a vertex by a highlight or a sharp
// reflection, so that c is 0 for these vertices. From a place that is joined to the eye, they also find
// highlights of sources on near surfaces, which light paths meet too rarely in a corner.
#include "transport/light_vertices.h"
#include "transport/vertex_clusters.h"

namespace rsphere {

// Shared by all threads; constant. Keeps references.
class VertexLight {
 public:
  // emission, paths, seed: of the light paths. REQUIRES that PlainSurfaces::obstacle() found none.
  VertexLight(const PreparedScene& prepared, const PlainSurfaces& surfaces, SourceEmission emission,
              size_t paths, uint64_t seed);

  const PlainSurfaces& surfaces() const { return surfaces_; }
  const LightVertices& vertices() const { return vertices_; }

  // Memory of one thread, kept for speed alone.
  struct Scratch {
    std::vector<double> weights;
    std::vector<SourceSample> samples;
    FunctionScratch functions;
  };

  // A place that is seen by sampling directions at the eye. Its direct light is also found by joining light
  // vertices to the eye; the two are weighted by the balance heuristic.
  struct Seen {
    V3d view;            // direction (unit) of the ray that shows it
    double density = 0;  // of the eye's samples there, per area of the surface (1/m2)
    double joins =
        0;  // probability that a light vertex there is joined to the eye, divided by joinedReflectance()
    Shown shown = Shown::all;
  };
  // The direct light that the place sends to the eye, diffusely and by a rough highlight (W/sr/m2).
  Radiance directOf(const PlainPlace& at, const Seen& seen, Random& random, Scratch& scratch) const;

  // Where the contributions of light vertices are recorded.
  struct Record {
    BatchSums batches{};
    // The part of the batches' variance that is due to the random choice of vertices, not to the vertices
    // themselves: the sum of the squared contributions, each times the fraction of similar vertices that were
    // not chosen.
    Color squares{0, 0, 0};
    double squaredBrightness = 0;
    const SpectralSampling* sampling = nullptr;

    void add(uint8_t batch, const Irradiance& part, double notChosen);
  };
  struct Indirect {
    int bounces = 1;  // maximum for the light: -ab minus the bounces between the eye and the place
    // Distance from the eye if light vertices at the place are joined to it, and so bring closeShare();
    // otherwise 0.
    double fromEye = 0;
    Record* record = nullptr;  // null: none
    Coefficient scale{1};      // factor on the recorded contributions (sr)
  };
  // The mean radiance that arrives over the hemisphere of the place after one bounce or more (W/sr/m2).
  Radiance indirectAt(const PlainPlace& at, const Indirect& how, Random& random, Scratch& scratch) const;

 private:
  struct Chosen {
    SourceSample sample;
    double probability = 0;  // 0: no light arrives
  };
  Chosen chooseSource(const PlainPlace& at, double finest, Random& random, Scratch& scratch) const;
  Radiance arriving(const PlainPlace& at, const SourceSample& sample, FunctionScratch& scratch) const;
  Coefficient passing(const PlainPlace& at, const SourceSample& sample) const;
  Radiance arrivingByMirrors(const PlainPlace& at, const SourceSample& sample,
                             FunctionScratch& scratch) const;
  Radiance directAt(const PlainPlace& at, Random& random, Scratch& scratch) const;
  Radiance ofVertices(const PlainPlace& at, const Indirect& how, Random& random) const;
  Radiance ofVertex(const PlainPlace& at, size_t i) const;
  Radiance ofNear(const PlainPlace& at, const Indirect& how, Random& random, Scratch& scratch) const;

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  LightVertices vertices_;
  VertexClusters clusters_;
};

}  // namespace rsphere
