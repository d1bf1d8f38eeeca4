#pragma once
/// \file NRRD, MHD/MHA and NIfTI in and out. Headers are validated by our own code before any voxel
/// is read.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::imaging {

enum class PixelType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// What a header says, checked: sizes positive and their product within bounds, spacing finite and positive,
/// axes not singular, data there in full.
struct ImageHeader {
  std::string format;  ///< "NRRD", "MetaImage", "NIfTI-1", "NIfTI-2", "DICOM"
  Geometry geometry;   ///< after conversion to right-handed LPS with orthonormal axes
  PixelType pixel_type = PixelType::int16;
  double slope = 1.0, intercept = 0.0;
  std::vector<std::string> warnings;  ///< "left-handed axes: k reversed", "sheared axes: will be resampled"
  /// Of read_labels, where the file has labels above 255: the file's number of each value. Empty: the same.
  std::vector<std::int64_t> file_labels;
};

/// Reads and checks a header alone. Throws InvalidInput ("FILE: FIELD: what is wrong") or IoError.
ImageHeader read_image_header(const std::filesystem::path& path);

/// An image with what had to be said about it.
template <class T>
struct LoadedImage {
  Volume<T> volume;
  ImageHeader header;
};

// The readers check as read_image_header does, and in full: data that are cut short, damaged (gzip's check
// sum) or of another size throw InvalidInput. ResourceError where memory is short. Left-handed axes are
// reversed and sheared ones resampled, with a warning in the header. Compressed data are unpacked no further
// than the header's size.

/// A CT image in HU, rounded and clamped to int16 (a warning counts what was clamped, and NaN set to -1024
/// HU). Sheared axes: trilinear, the image's lowest value where there was no voxel.
LoadedImage<std::int16_t> read_image(const std::filesystem::path& path,
                                     const core::TaskContext& task = core::no_task());
/// A mask: nonzero becomes 1; of probabilities (looks_like_probabilities) 1/2 and more does, and a warning
/// says so. Throws InvalidInput for another image with more than 16 different values. Sheared axes: nearest.
LoadedImage<std::uint8_t> read_mask(const std::filesystem::path& path,
                                    const core::TaskContext& task = core::no_task());
/// Labels with their values, 0 to 255: what is below 1/2 is 0, else the nearest whole number, so that
/// probabilities are cut at one half (a warning says so). Labels above 255 are counted up in their order
/// where there are at most 128 values in all (ImageHeader::file_labels, and a warning); of a file of 0 and
/// one value that would become 0, too, the other value is 1. Throws InvalidInput for more. Sheared axes:
/// nearest.
LoadedImage<std::uint8_t> read_labels(const std::filesystem::path& path,
                                      const core::TaskContext& task = core::no_task());
/// True values as float (level sets, distance maps); a value that is not finite is refused. Sheared axes:
/// trilinear, the border's value where there was no voxel.
LoadedImage<float> read_float_image(const std::filesystem::path& path,
                                    const core::TaskContext& task = core::no_task());
/// True when the file's values are whole numbers (but for the rounding of a slope), at most 16 different
/// ones, 0 among them, or 0 and one value of any size: a mask rather than a CT. Reads no further than the
/// 17th value, so that damage behind it goes unseen here.
bool looks_like_mask(const std::filesystem::path& path);

/// True when the file's values are whole numbers from 0 to 255, at most 128 different ones; 0 need not be
/// among them. Reads as looks_like_mask does.
bool looks_like_labels(const std::filesystem::path& path);

/// True when the file's values lie in [0, 1], not all of them whole, some above 1/2 and most of them next to
/// 0: what a network gives for a mask. Reads no further than the first value elsewhere.
bool looks_like_probabilities(const std::filesystem::path& path);

/// By extension: .nrrd (gzip), .mhd (its voxels in NAME.raw beside it, or NAME-2.raw, ... where an older file
/// has that name), .mha, .nii and .nii.gz (NIfTI-1, right-anterior-superior axes in its header; places in
/// single precision). Whole or not at all: until the new image is complete the old one stays. Throws
/// InvalidInput, IoError, ResourceError (disk full).
void write_image(const std::filesystem::path& path, const ImageVolume& image);
void write_image(const std::filesystem::path& path, const MaskVolume& image);
void write_image(const std::filesystem::path& path, const FloatVolume& image);

}  // namespace ostia::imaging
