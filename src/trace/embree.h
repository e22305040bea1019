#pragma once
// The only file that distinguishes between Embree 3 and Embree 4.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace rsphere::embree {

#if RTC_VERSION_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
inline void initContext(QueryContext& context) { rtcInitRayQueryContext(&context); }
inline void intersect(RTCScene scene, QueryContext& context, RTCRayHit& rayHit) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  arguments.context = &context;
  rtcIntersect1(scene, &rayHit, &arguments);
}
inline void occluded(RTCScene scene, QueryContext& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
#else
using QueryContext = RTCIntersectContext;
inline void initContext(QueryContext& context) { rtcInitIntersectContext(&context); }
inline void intersect(RTCScene scene, QueryContext& context, RTCRayHit& rayHit) {
  rtcIntersect1(scene, &context, &rayHit);
}
inline void occluded(RTCScene scene, QueryContext& context, RTCRay& ray) {
  rtcOccluded1(scene, &context, &ray);
}
#endif

// Calls visit(primitive) for each primitive whose bounds are within the radius of the center, until a call
// returns true. Returns whether one did. REQUIRES that the scene has only one geometry.
template <typename Visit>
bool anyWithin(RTCScene scene, float x, float y, float z, float radius, const Visit& visit) {
  struct Asked {
    const Visit& visit;
    bool found = false;
  } asked{visit};
  RTCPointQuery query{x, y, z, 0, radius};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(
      scene, &query, &context,
      [](RTCPointQueryFunctionArguments* arguments) {
        auto& asked = *static_cast<Asked*>(arguments->userPtr);
        if (!asked.found && asked.visit(arguments->primID)) {
          asked.found = true;
          arguments->query->radius = 0;
          return true;  // the radius has changed, which ends the search
        }
        return false;
      },
      &asked);
  return asked.found;
}

}  // namespace rsphere::embree
