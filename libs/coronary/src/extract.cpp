#include "ostia/coronary/extract.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::coronary {
namespace {

/// Both trees have the same ends, and so the same vessels.
std::vector<AxisNotes> in_order_of(const geometry::VesselTree& tree, const std::vector<AxisNotes>& notes) {
  std::vector<AxisNotes> result;
  for (const geometry::Vessel& vessel : tree.vessels) {
    const auto found = std::find_if(notes.begin(), notes.end(),
                                    [&](const AxisNotes& one) { return one.vessel == vessel.id; });
    result.push_back(found != notes.end() ? *found : AxisNotes{vessel.id, 0.0, {}});
  }
  return result;
}

void tell(Extraction& result) {
  const std::size_t roots = geometry::roots(result.vessels.tree).size();
  if (roots == 1)
    result.warnings.push_back(
        "one coronary artery alone was found where it leaves the aorta; add the other by a click at its end");
  if (roots > 2)
    result.warnings.push_back(
        std::to_string(roots) +
        " vessels were found where they leave the aorta; look whether each is an artery");
  for (const std::string& warning : result.vessels.warnings) result.warnings.push_back(warning);
  for (std::size_t i = 0; i < result.notes.size(); ++i)
    for (const std::string& warning : result.notes[i].warnings)
      result.warnings.push_back(result.vessels.tree.vessels[i].name + ": " + warning);
}

}  // namespace

void validate(const ExtractOptions& options) {
  validate(options.aorta);
  validate(options.ostia);
  validate(options.growth);
  validate(options.axes);
  validate(options.labels);
}

Extraction extract(const imaging::ImageVolume& image, const ExtractOptions& options,
                   const core::TaskContext& task) {
  validate(options);
  Extraction result;
  task.set_stage("finding the aorta");
  result.aorta = find_aorta(image, options.aorta, task.sub(0.0, 0.2));
  task.set_stage("finding where the coronary arteries leave it");
  result.ostia = find_ostia(image, result.aorta, options.ostia, task.sub(0.2, 0.25));
  if (result.ostia.empty())
    throw GeometryError(
        "no coronary artery was found where one should leave the aorta: the root may lie outside of the "
        "image, "
        "or the arteries hold too little contrast; draw a first vessel by its two ends");
  task.set_stage("growing the coronary tree");
  const GrownTree grown = grow_tree(image, result.aorta, result.ostia, options.growth, task.sub(0.25, 0.85));
  if (grown.branches.empty())
    throw GeometryError(
        "nothing that looks like an artery goes on from where one leaves the aorta; draw a first vessel by "
        "its "
        "two ends");
  task.set_stage("centring the vessels");
  CentredTree centred = centred_tree(image, grown, result.ostia, options.axes, task.sub(0.85, 0.98));
  result.warnings = std::move(centred.warnings);
  task.set_stage("naming the vessels");
  result.vessels = label_branches(centred.tree, options.labels);
  result.notes = in_order_of(result.vessels.tree, centred.notes);
  tell(result);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::coronary
