#pragma once
/// \file A first model of an image, found without a click.

#include "ostia/core/task_context.h"
#include "ostia/coronary/extract.h"
#include "ostia/session/case_file.h"

#include <filesystem>
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

/// A new case with the model, and a mark with a note for each vessel that is in doubt. Throws as
/// CaseFile::create does; then there is no such file.
CaseFile create_case(const std::filesystem::path& path, const FoundModel& found, const ImageReference& image);

}  // namespace ostia::session
