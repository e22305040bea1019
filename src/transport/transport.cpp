#include "transport/transport.h"

#include "transport/find_aims.h"

namespace rsphere {

Transport::Transport(const Scene& scene, const RayOptions& options, IrradianceAt irradiance,
                     bool basicRadiance, const rad::Warn& warn)
    : prepared_(scene, options, irradiance, basicRadiance, warn),
      aims_(findAimsOfGathers(prepared_)),
      caches_(makeCaches(prepared_, aims_, warn)) {}

Transport::Transport(const Transport& other, const RayOptions& options)
    : prepared_(other.prepared_, options),
      aims_(findAimsOfGathers(prepared_)),
      caches_(makeCaches(prepared_, aims_, {})) {}

}  // namespace rsphere
