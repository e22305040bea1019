#pragma once
// Compiles a function for several vector widths, one of which is selected when the program starts. The
// results must not depend on the width: nothing in such a function may be contracted or reordered.
#ifdef __x86_64__
#define RSPHERE_FOR_WIDTHS(...) __attribute__((target_clones(__VA_ARGS__, "default")))
#else
#define RSPHERE_FOR_WIDTHS(...)
#endif
