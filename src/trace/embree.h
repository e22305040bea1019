#pragma once
// The one place that knows Embree 3 from Embree 4.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <cstddef>

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

}  // namespace rsphere::embree
