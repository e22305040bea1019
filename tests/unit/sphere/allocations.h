#pragma once
#include <cstddef>

namespace rsphere {

// How often operator new has been called in this program.
std::size_t allocations();

}  // namespace rsphere
