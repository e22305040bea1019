#pragma once
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "rad_parser/error.h"

namespace rad {

// Reads a descriptor on in a block of `size` bytes: what lies between keep and end moves to the block's front
// together with next, and the data that come behind it end at end. The descriptor becomes -1 at the end of
// the data. Returns whether there were more. where(): for the message where they cannot be read.
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
  if (got < 0) throw Error(where() + ": cannot read: " + std::strerror(errno), Status::system);
  if (got == 0) descriptor = -1;
  end += got;
  return got > 0;
}

}  // namespace rad
