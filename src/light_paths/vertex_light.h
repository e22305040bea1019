#pragma once
// The light of plain surfaces by paths from both ends (bidirectional estimation): direct light by a shadow
// ray to one source, indirect light by shadow rays to light vertices.
//
// The light of vertices is computed with the bounded kernel d^2 / (d^4 + c^4) instead of 1 / d^2. One ray in
// a random direction supplies the difference: the light of the place that it hits at a distance d is added
// with the probability c^4 / (d^4 + c^4) (Kollig and Keller 2004, "Illumination in the presence of weak
// singularities"). These rays do not sample light that has reached a vertex by a highlight or a sharp
// reflection, so that c is 0 for such vertices. If the place is connected to the eye, these rays also find
// highlights of sources on near surfaces, which light paths hit too rarely in corners.
#include "light_paths/light_vertices.h"
#include "light_paths/vertex_clusters.h"

namespace rsphere {

// Shared by all threads; constant. Keeps references.
class VertexLight {
 public:
  // emission, paths, seed: of the light paths. outdoors: null without portals. REQUIRES that
  // PlainSurfaces::obstacle() found none.
  VertexLight(const PreparedScene& prepared, const PlainSurfaces& surfaces, SourceEmission emission,
              size_t paths, uint64_t seed, const OutdoorParts* outdoors = nullptr);

  const PlainSurfaces& surfaces() const { return surfaces_; }
  const LightVertices& vertices() const { return vertices_; }

  // Memory that a thread reuses, only to save time.
  struct Scratch {
    std::vector<double> weights;
    std::vector<SourceSample> samples;
    FunctionScratch functions;
  };

  // A place that is seen along a sampled direction from the eye. Its direct light is also estimated by joins
  // of light vertices with the eye; the balance heuristic weights the two estimates.
  struct Seen {
    V3d view;            // direction (unit) of the ray that hits it
    double density = 0;  // of the eye's samples there, per area of the surface (1/m2)
    double joins =
        0;  // probability that a light vertex there is connected to the eye, divided by joinedReflectance()
    Shown shown = Shown::all;
  };
  // The direct light that the place sends to the eye, diffusely and by a rough highlight (W/sr/m2): by a
  // shadow ray and, if the highlight is strong, by a sample of its lobe.
  Radiance directOf(const PlainPlace& at, const Seen& seen, Random& random, Scratch& scratch) const;
  // The density of lobe samples from the place towards a source, divided by the density of light paths from
  // there (m2); 0 if lobe samples do not estimate its light. view: of the ray from the eye (unit).
  double lobesOver(const PlainPlace& at, const V3d& view, const SourceSample& sample) const;

  // Collects the contributions of light vertices.
  struct Record {
    BatchSums batches{};
    // The part of the variance of `batches` that is caused by the random choice among vertices, not by the
    // vertices. It is the sum of the squared contributions, each times the probability that the vertex is not
    // chosen.
    Color squares{0, 0, 0};
    double squaredBrightness = 0;
    const SpectralSampling* sampling = nullptr;

    void add(uint8_t batch, const Irradiance& part, double notChosen);
  };
  struct Indirect {
    int bounces = 1;  // limit for the light: -ab minus the bounces between the eye and the place
    // Distance from the eye, if joins of light vertices at the place with the eye estimate closeShare() and
    // joinedOfMirrored(); otherwise 0.
    double fromEye = 0;
    Record* record = nullptr;                   // null: contributions are not recorded
    Coefficient scale{1};                       // factor on the recorded contributions (sr)
    const OutdoorRadiance* outdoors = nullptr;  // the light beyond portals. REQUIRED if there are any
  };
  // The mean radiance that arrives over the hemisphere of the place after at least one bounce, or
  // straight through a portal (W/sr/m2).
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
  bool samplesLobe(const PlainPlace& at) const;
  bool isFoundByLobes(LightId source) const;
  double shareOf(const PlainPlace& at, const Seen& seen, const SourceSample& sample, double shadowRays,
                 double lobes) const;
  Radiance ofLobe(const PlainPlace& at, const Seen& seen, Random& random, Scratch& scratch) const;
  Radiance directAt(const PlainPlace& at, Random& random, Scratch& scratch) const;
  Radiance ofVertices(const PlainPlace& at, const Indirect& how, Random& random) const;
  Radiance ofVertex(const PlainPlace& at, size_t i) const;
  Radiance ofPortals(const PlainPlace& at, const Indirect& how, Random& random) const;
  Radiance ofNear(const PlainPlace& at, const Indirect& how, Random& random, Scratch& scratch) const;
  Radiance ofMirrored(const PlainPlace& at, const Indirect& how, Random& random, Scratch& scratch) const;
  Radiance diffusedAt(const PlainPlace& there, const Coefficient& share, const Indirect& how, Random& random,
                      Scratch& scratch) const;

  const PreparedScene& prepared_;
  const PlainSurfaces& surfaces_;
  LightVertices vertices_;
  VertexClusters clusters_;
};

}  // namespace rsphere
