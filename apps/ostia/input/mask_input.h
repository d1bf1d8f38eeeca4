#pragma once
/// \file Masks on the command line, of coronary arteries above all.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/session/found_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::app {

using session::holds_labels;

struct MaskInput {
  std::filesystem::path file;
  std::filesystem::path image;  ///< the CT that it was drawn on; empty: none
  std::vector<int> labels;      ///< that are meant; empty: all but 0
  bool told = false;            ///< said to be a mask, whatever its values are
};

struct MaskCase {
  session::MaskModel model;
  std::optional<session::ImageReference> image;  ///< of the CT, where there is one
};

/// The mask with its values, without those that were not asked for. Throws InvalidInput naming the labels
/// that are there where one that is asked for is not. What is told to be a mask, and has more values than
/// labels have, is 1 where it has not the value that most of its voxels have. `grid`: of the CT, which a
/// structure set's contours are filled on.
imaging::MaskVolume read_asked_labels(const MaskInput& input, const core::TaskContext& task,
                                      const std::optional<imaging::Geometry>& grid = {});

/// Whether most voxels have one value, as of a mask and hardly of a CT.
bool may_be_mask(const imaging::ImageVolume& image);

/// From the file to the model; of a DICOM segmentation or structure set patient and frame of reference must
/// be those of the CT. Throws what the readers and session::model_of_mask throw, with the file's name.
MaskCase mask_case(const MaskInput& input, const coronary::MaskTreeOptions& options,
                   const core::TaskContext& task);

}  // namespace ostia::app
