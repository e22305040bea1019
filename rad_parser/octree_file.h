#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "rad_parser/binary_reader.h"
#include "rad_parser/description_builder.h"

namespace rad {

// The beginning of the data of a descriptor, as far as isOctree() needs it: at most 64 kB, all of it where it
// is shorter. What cannot be read is left for who reads on, who meets the same fault.
std::string readBeginning(int descriptor);

// Whether data that begin like this are an octree, by its information header: lines up to an empty one, of
// which the last that begins with FORMAT= names Radiance_octree; or, where no line names a format, by the
// octree's format number behind the header. As rtrace has it, "#?RADIANCE" need not be the first line. Throws
// where the header of an octree, or one that begins with "#?", names another format.
bool isOctree(std::string_view beginning, std::string_view name);

// Reads an octree into the builder's description, which is empty but for `file`, the octree's own. A frozen
// one has its primitives with it; places are their numbers. Otherwise sceneFile(name) is called for each
// scene file that it names, in turn, and must add that file's primitives to the builder.
//
// Header and bounds are kept. The cells are passed over: only what they say of the scene is checked. Throws
// for what is truncated or damaged with the byte where it was noticed, and, as rtrace(1) does, "bad object
// count; octree stale?" where the scene files have changed in number of primitives, and "modifier in tree;
// octree stale?" where a cell holds what is no surface (rtrace looks only where a scene file is newer than
// the octree). Bytes behind the end are ignored. Source: RADIANCE file formats, "Octree format".
void readOctree(BinaryReader& input, uint32_t file, DescriptionBuilder& builder, const Warn& warn,
                const std::function<void(const std::string&)>& sceneFile);

}  // namespace rad
