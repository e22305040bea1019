#pragma once
// A point's distribution of radiance as a picture.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "importance/direction_sample.h"

namespace rsphere {

// Size of the pictures: .35 degrees a pixel, a twelfth of the distance between 2048 base directions.
inline constexpr int kPictureWidth = 1024, kPictureHeight = 512;

// Pixels from the top row on, three channels each: the radiance (W/sr/m2) of the sample whose direction is
// nearest to the pixel's middle; over that, for directions to light sources (toSource), caps as large as
// their solid angles, at least a pixel each. Columns are the azimuth from 0 at the left edge to 2 pi,
// counterclockwise about +z from +x; rows go from the zenith +z to the nadir. Samples of no solid angle count
// for nothing. Black where there is none at all.
struct DistributionPicture {
  int width = kPictureWidth, height = kPictureHeight;
  std::vector<float> pixels;
};
DistributionPicture drawDistribution(std::span<const DirectionSample> samples, int width = kPictureWidth,
                                     int height = kPictureHeight);

// The pattern with its one %d, or %4d, %04d and the like, replaced by the record number, and %% by %. Throws
// rad::Error where there is another %, and where there is no %d for a record after the first, whose picture
// would be lost.
std::string pictureName(const std::string& pattern, uint64_t record);

// Draws the samples to the file that pattern and record name (none where the pattern is empty), in the format
// of its suffix: radiance where the format is HDR, EXR or TIFF; else (PNG and so on) exposed so that twice
// the mean over all directions is mid-bright (.5), on the sRGB curve. Threads may write different files at
// the same time. Throws rad::Error (Status::system) with the file's name where it cannot be written.
void writeDistribution(const std::string& pattern, uint64_t record, std::span<const DirectionSample> samples);

}  // namespace rsphere
