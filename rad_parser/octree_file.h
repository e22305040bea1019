#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "rad_parser/binary_reader.h"
#include "rad_parser/description_builder.h"

namespace rad {

// The beginning of the data that a descriptor delivers, as much of it as isOctree() needs: at most 64 kB, or
// all data if there are fewer. Read errors are ignored, because the reader that continues meets them again.
std::string readBeginning(int descriptor);

// Whether data with this beginning are an octree. Its information header, which ends with an empty line,
// decides: the last line that begins with FORMAT= must name Radiance_octree. If no line names a format, the
// format number behind the header must be that of an octree. As in rtrace, "#?RADIANCE" need not be the first
// line. Throws if the header of an octree, or any header that begins with "#?", names a different format.
bool isOctree(std::string_view beginning, std::string_view name);

// Reads an octree into the builder's description, which must be empty except for `file`, the octree itself. A
// frozen octree contains its primitives, and their places are their numbers. For other octrees,
// sceneFile(name) is called for each scene file that the octree names, in order; it must add the primitives
// of that file to the builder.
//
// The header and the bounds are kept. The cells are read only to check them against the scene. Bytes behind
// the end are ignored. Throws
// - for truncated or damaged data, with the byte at which the error was noticed;
// - as rtrace(1) does, "bad object count; octree stale?" if the number of primitives in the
//   scene files has changed;
// - "modifier in tree; octree stale?" if a cell contains a primitive that is not a surface; rtrace checks
//   this only if a scene file is newer than the octree.
// Source: RADIANCE file formats, "Octree format".
void readOctree(BinaryReader& input, uint32_t file, DescriptionBuilder& builder, const Warn& warn,
                const std::function<void(const std::string&)>& sceneFile);

}  // namespace rad
