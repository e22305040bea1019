#pragma once
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "rad_parser/error.h"

namespace rad {

// Continues reading a descriptor into a block of `size` bytes. The data from keep to end are moved to the
// front of the block, next is adjusted, and new data are appended, up to the new end. At the end of the data,
// the descriptor becomes -1. Returns whether there were new data. where(): the beginning of the error message
// if the data cannot be read.
template <class Byte, class Where>
bool readOn(int& descriptor, Byte* block, size_t size, const Byte*& keep, const Byte*& next, const Byte*& end,
            const Where& where) {
  const auto kept = static_cast<size_t>(end - keep);
  std::memmove(block, keep, kept);
  next -= keep - block;
  keep = block;
  end = keep + kept;
  ssize_t got;
  do {
    got = read(descriptor, block + kept, size - kept);
  } while (got < 0 && errno == EINTR);
  if (got < 0) throw systemError(where() + ": cannot read");
  if (got == 0) descriptor = -1;
  end += got;
  return got > 0;
}

}  // namespace rad
