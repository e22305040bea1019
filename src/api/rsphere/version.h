#pragma once
// The version of the library with these headers. Programs compiled for 1.x run with any later 1.y; version()
// returns the version in use.

#define RSPHERE_VERSION_MAJOR 1
#define RSPHERE_VERSION_MINOR 0
#define RSPHERE_VERSION_PATCH 0

// All public names are in namespace rsphere for programs. Their symbols are in rsphere::v1. While the library
// itself is compiled, v1 is not inline, because internal types in rsphere have these names, too.
#ifdef RSPHERE_LIBRARY_SOURCE
#define RSPHERE_API_NAMESPACE rsphere::v1
#else
#define RSPHERE_API_NAMESPACE rsphere::inline v1
#endif
#define RSPHERE_API __attribute__((visibility("default")))

namespace RSPHERE_API_NAMESPACE {

// The version of the library in use: "1.0.0", or "1.0.0-rc1" for a release candidate.
RSPHERE_API const char* version();

}  // namespace RSPHERE_API_NAMESPACE
