#pragma once
// The version of the library that these headers belong to. Programs compiled for 1.x run with any later 1.y;
// a program that must know which one it has asks version().

#define RSPHERE_VERSION_MAJOR 1
#define RSPHERE_VERSION_MINOR 0
#define RSPHERE_VERSION_PATCH 0

// Programs find everything public in namespace rsphere. Its symbols are in rsphere::v1 in any case. v1 is not
// inline where the library itself is compiled, because internal types of the same names are in rsphere.
#ifdef RSPHERE_LIBRARY_SOURCE
#define RSPHERE_API_NAMESPACE rsphere::v1
#else
#define RSPHERE_API_NAMESPACE rsphere::inline v1
#endif
#define RSPHERE_API __attribute__((visibility("default")))

namespace RSPHERE_API_NAMESPACE {

// The version of the library that the program runs with: "1.0.0", or "1.0.0-rc1" for a release candidate.
RSPHERE_API const char* version();

}  // namespace RSPHERE_API_NAMESPACE
