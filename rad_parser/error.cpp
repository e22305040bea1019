#include "rad_parser/error.h"

#include "rad_parser/printable.h"

namespace rad {

Error::Error(std::string_view text, Status status) : std::runtime_error(messageLine(text)), status_(status) {}

}  // namespace rad
