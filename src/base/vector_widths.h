#pragma once
// Compiles a function for several vector widths, one of which is selected when the program starts. The
// results must not depend on the width: nothing in such a function may be contracted or reordered. clang 14
// gives such a function a name that no other file finds, so that clang compiles it for one width.
#if defined(__x86_64__) && !defined(__clang__)
#define RSPHERE_FOR_WIDTHS(...) __attribute__((target_clones(__VA_ARGS__, "default")))
#else
#define RSPHERE_FOR_WIDTHS(...)
#endif
