#pragma once
/// \file The program's sample in its coarse form, as an image and a case of it.

#include "kept_scan.h"

#include "ostia/imaging/image_file.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <filesystem>

namespace ostia::workstation::testing {

/// Writes both: the tree with walls from its image, as the search would leave it.
inline session::ImageReference make_sample_patient(const std::filesystem::path& image_file,
                                                   const std::filesystem::path& case_file) {
  phantom::CaseOptions options;
  options.preset = phantom::Preset::small;
  const phantom::CasePlan plan = phantom::plan_case(options);
  const imaging::ImageVolume image = ostia::testing::kept_scan(plan).image;
  imaging::write_image(image_file, image);
  const geometry::VesselTree tree = phantom::vessel_tree(plan.tree);
  const session::ImageReference reference = session::image_reference(image_file);
  session::CaseFile::create(
      case_file, lumen::model_of_walls(tree, pipeline::walls_from_image(tree, image, core::no_task())),
      reference);
  return reference;
}

}  // namespace ostia::workstation::testing
