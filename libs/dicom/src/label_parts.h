#pragma once
/// \file The two kinds of label objects; messages come without the file's name.

#include "ostia/core/error.h"
#include "ostia/dicom/label_object.h"

namespace ostia::dicom {

using imaging::DicomDataset;

LabelObject labels_of_segmentation(const imaging::DicomObject& object, const LabelObjectOptions& options,
                                   const core::TaskContext& task);
LabelObject labels_of_structure_set(const imaging::DicomObject& object, const LabelObjectOptions& options,
                                    const core::TaskContext& task);

/// Gives values to the segments of a file, in its order, and puts them into the volume: where they overlap
/// the one with fewer voxels counts.
class LabelLayers {
 public:
  LabelLayers(imaging::Geometry grid, std::size_t segments);
  /// Voxel `at` is in the segment (its place in the file's list).
  void add(std::size_t segment, std::size_t at) {
    Layer& layer = layers_[segment];
    if (!layer.runs.empty() && layer.runs.back().second == at) {
      ++layer.runs.back().second;
    } else {
      if (++runs_ > most_runs)
        throw InvalidInput("its segments are scattered over more pieces of rows than any vessel has");
      layer.runs.emplace_back(at, at + 1);
    }
  }
  /// Fills `volume`, the segments' values and a warning about overlaps. Throws InvalidInput for more than 255
  /// segments with voxels, or none.
  void finish(LabelObject& to);

 private:
  struct Layer {
    std::vector<std::pair<std::size_t, std::size_t>> runs;  // of voxels, [first, last)
  };
  static constexpr std::size_t most_runs = 1U << 25;  // half a gigabyte

  imaging::Geometry grid_;
  std::vector<Layer> layers_;
  std::size_t runs_ = 0;
};

/// Throws InvalidInput for a grid with more voxels than that, without multiplying beyond the range.
void require_room(const imaging::Geometry& grid, std::int64_t most_voxels);

}  // namespace ostia::dicom
