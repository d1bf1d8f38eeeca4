#pragma once
/// \file Segmentations and structure sets of any program as label volumes.

#include "ostia/core/task_context.h"
#include "ostia/dicom/code.h"
#include "ostia/imaging/image_file.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::dicom {

enum class LabelObjectKind { none, segmentation, structure_set };
/// By the file's SOP class; none for anything else, too large or damaged headers included. Reads little.
LabelObjectKind label_object_kind(const std::filesystem::path& path);

/// Where an object says that it belongs; texts as they stand in the file.
struct ObjectOrigin {
  std::string frame_of_reference, patient_id;
};
ObjectOrigin object_origin(const std::filesystem::path& path);
/// In words why two objects cannot be of one image; empty where they can: patient or frame of reference
/// differ.
std::string other_origin(const ObjectOrigin& a, const ObjectOrigin& b);
/// The same of a mask and the CT that it is opened on, or empty where one of them is no DICOM object on disk.
/// `series_uid`: imaging::DicomSeries::uid; empty means the one that can be read.
std::string other_origin(const std::filesystem::path& mask, const std::filesystem::path& image,
                         const std::string& series_uid = {});

struct ReadSegment {
  int number = 0;          ///< of the file
  std::uint8_t value = 0;  ///< in the volume; 0: it has no voxel
  std::string label;
  std::optional<Code> category, type;
};

struct LabelObject {
  imaging::MaskVolume volume;  ///< right-handed, slices along the normal; 0 outside
  std::vector<ReadSegment> segments;
  std::vector<std::string> warnings;
  ObjectOrigin origin;
};

struct LabelObjectOptions {
  /// Of a structure set: the grid to fill, that of its CT. Nothing: one of its own, by its contours.
  std::optional<imaging::Geometry> grid;
  std::int64_t most_voxels = 1LL << 31;
};

/// Binary and fractional segmentations, uncompressed or deflated: of fractions half of the largest and more
/// is in. Frames in any order, with slices left out; those of one segment in one plane are joined. Where
/// segments overlap the one with fewer voxels counts. Numbers above 255, and those without a voxel, are
/// counted up anew. Structure sets: closed planar contours by the even-odd rule, slice by slice. Throws
/// InvalidInput naming the file and the attribute: damaged or cut short, compressed, frames without a place,
/// tilted against each other, of unequal spacing, or further apart than the voxels that are allowed; more
/// than 255 segments with voxels; nothing in it.
LabelObject read_label_object(const std::filesystem::path& path, const LabelObjectOptions& options = {},
                              const core::TaskContext& task = core::no_task());

/// A mask of any kind: imaging::read_labels, or read_label_object where it is one of these. A folder is
/// looked through for the one such object in it. `image`: of a structure set, the grid to fill.
imaging::LoadedImage<std::uint8_t> read_labels(const std::filesystem::path& path,
                                               const core::TaskContext& task = core::no_task(),
                                               const std::optional<imaging::Geometry>& grid = {});
/// The object that is meant by a path: the file itself, or the only one of these in a folder. Nothing where
/// it is none, or the folder has images, too.
std::optional<std::filesystem::path> label_object_in(const std::filesystem::path& path);

}  // namespace ostia::dicom
