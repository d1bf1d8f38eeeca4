#pragma once
/// \file A first model of an image, found without a click.

#include "ostia/core/task_context.h"
#include "ostia/coronary/extract.h"
#include "ostia/session/annotation.h"
#include "ostia/session/case_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::session {

/// Axes and names (coronary::extract), and the wall about them (pipeline::walls_from_image).
struct FoundModel {
  lumen::LumenModel model;
  coronary::Extraction found;
  std::vector<VesselMark>
      marks;  ///< of the vessels that a person should look at first, with a note that says why
};

/// Throws as coronary::extract, segmentation::lumen_boundary and lumen::model_of_walls do.
FoundModel found_model(const imaging::ImageVolume& image, const coronary::ExtractOptions& options = {},
                       const core::TaskContext& task = core::no_task());

/// Why a person should look at a vessel; empty where the program is sure of its axis and its name.
std::string doubt_about(const coronary::VesselLabel& label, const coronary::AxisNotes& axis,
                        double least_confidence = 0.5);

/// A new case with the model and its marks. Throws as CaseFile::create does; then there is no such file.
CaseFile create_case(const std::filesystem::path& path, const FoundModel& found, const ImageReference& image);

}  // namespace ostia::session
