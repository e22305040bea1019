#pragma once
// Compiles a function for several widths of vectors; the processor chooses when the program starts. A
// function so compiled must give the same answers at every width: nothing in it may be contracted or
// reordered.
#ifdef __x86_64__
#define RSPHERE_FOR_WIDTHS(...) __attribute__((target_clones(__VA_ARGS__, "default")))
#else
#define RSPHERE_FOR_WIDTHS(...)
#endif
