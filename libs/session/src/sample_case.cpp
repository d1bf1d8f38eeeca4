#include "ostia/session/sample_case.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/lumen/live_model.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <memory>
#include <system_error>

namespace ostia::session {
namespace fs = std::filesystem;

SampleCase sample_case(const fs::path& folder, phantom::Preset preset, const core::TaskContext& task) {
  const SampleCase sample{folder / "image.nrrd", folder / "sample.ostia"};
  std::error_code ignored;
  if (fs::exists(sample.image, ignored) && fs::exists(sample.case_file, ignored)) return sample;
  task.set_stage("synthetic patient");
  phantom::CaseOptions options;
  options.preset = preset;
  const phantom::CasePlan plan = phantom::plan_case(options);
  const phantom::Scan scan = phantom::scan_case(plan, task.sub(0.02, 0.7));
  fs::create_directories(folder.parent_path(), ignored);
  core::StagedFolder staged(folder);
  task.set_stage("writing the image");
  const fs::path image = staged.temporary() / "image.nrrd";
  imaging::write_image(image, scan.image);
  task.throw_if_cancelled();
  task.set_progress(0.8);
  task.set_stage("walls of the vessels");
  const geometry::VesselTree tree = phantom::vessel_tree(plan.tree);
  const lumen::LumenModel model =
      lumen::model_of_walls(tree, pipeline::walls_from_image(tree, scan.image, task.sub(0.8, 0.97)));
  const lumen::LiveModel solved(
      std::make_shared<const lumen::LumenModel>(model));  // throws where it cannot be shown
  CaseFile::create(staged.temporary() / "sample.ostia", model, image_reference(image));
  staged.commit();
  task.set_progress(1.0);
  return sample;
}

}  // namespace ostia::session
