#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "rad_parser/binary/binary_reader.h"
#include "rad_parser/description_builder.h"

namespace rad {

// Reads as much of the beginning of the data from a descriptor as isOctree() needs: at most 64 kB, or all
// data if there are fewer. Read errors are ignored, because they occur again when reading continues.
std::string readBeginning(int descriptor);

// Whether data with this beginning are an octree. The information header, which ends with an empty line,
// decides: its last line that begins with FORMAT= must name Radiance_octree. If there is no such line, the
// format number after the header must be that of an octree. As in rtrace, "#?RADIANCE" need not be the first
// line. Throws if the header of an octree, or any header that begins with "#?", contains a different format.
bool isOctree(std::string_view beginning, std::string_view name);

// Reads an octree into the builder's description, which must be empty except for `file`, the octree itself. A
// frozen octree contains its primitives, whose places are their numbers. For any other octree,
// sceneFile(name) is called for each scene file that it names, in order; it must add the primitives of that
// file to the builder.
//
// Header and bounds are stored. Cells are read only to check them against the scene. Bytes after the end are
// ignored. Throws
// - for truncated or damaged data, with the byte at which the error was noticed;
// - like rtrace(1), "bad object count; octree stale?" if the number of primitives in the scene files has
//   changed;
// - "modifier in tree; octree stale?" if a cell contains a primitive that is not a surface; rtrace checks
//   this only if a scene file is newer than the octree.
// Source: RADIANCE file formats, "Octree format".
void readOctree(BinaryReader& input, uint32_t file, DescriptionBuilder& builder, const Warn& warn,
                const std::function<void(const std::string&)>& sceneFile);

}  // namespace rad
