#pragma once
/// \file A first model of an image, found without a click.

#include "ostia/core/task_context.h"
#include "ostia/coronary/extract.h"
#include "ostia/coronary/mask_tree.h"
#include "ostia/pipeline/mask_walls.h"
#include "ostia/session/case_file.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// Axes and names (coronary::extract), and the wall about them (pipeline::walls_from_image).
struct FoundModel {
  lumen::LumenModel model;
  coronary::Extraction found;
  /// One a vessel, in the tree's order: why a person should look at it first; empty where the program is sure
  /// of its axis, its name and its wall.
  std::vector<std::string> doubts;
};

/// Throws as coronary::extract, segmentation::lumen_boundary and lumen::model_of_walls do.
FoundModel found_model(const imaging::ImageVolume& image, const coronary::ExtractOptions& options = {},
                       const core::TaskContext& task = core::no_task());

/// The same from a coronary mask of any network or hand (coronary::mask_tree), its walls those of the mask
/// (pipeline::walls_from_mask). `found` has ostia and vessels, but no aorta.
struct MaskModel {
  FoundModel found;
  coronary::MaskTree tree;                     ///< `vessels` and `notes` are those of `found`
  std::vector<pipeline::MaskOutside> outside;  ///< of the walls, the largest first
};
/// Whether an image file holds labels rather than a CT: whole numbers, few of them; false for no file. Throws
/// IoError, InvalidInput.
bool holds_labels(const std::filesystem::path& file);
/// `image`: the CT that the mask was drawn on, to see that both are of one patient; null: none. Throws as
/// coronary::mask_tree, pipeline::walls_from_mask and lumen::model_of_walls do, and InvalidInput for a mask
/// that does not lie on the image's vessels, with what lies there instead.
MaskModel model_of_mask(const imaging::MaskVolume& labels, const imaging::ImageVolume* image = nullptr,
                        const coronary::MaskTreeOptions& options = {},
                        const core::TaskContext& task = core::no_task());

/// A new case with the model, its probabilities, and a mark with a note for each vessel that is in doubt.
/// Throws as CaseFile::create does; then there is no such file.
CaseFile create_case(const std::filesystem::path& path, const FoundModel& found,
                     const std::optional<ImageReference>& image);

}  // namespace ostia::session
