#include "ostia/coronary/extract.h"

#include "heart_chambers.h"
#include "input_checks.h"
#include "search_image.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace ostia::coronary {
namespace {

constexpr std::size_t most_branches = 60;  // a tree that is seen well has about 20
constexpr std::size_t few_vessels = 6;
constexpr double no_names = 1.0;  // confidence that no vessel reaches

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

struct BelievedAorta {
  Aorta aorta;
  std::string warning;  ///< of its heart
};

/// A bright tube without a heart as bright below it may be a vein full of undiluted contrast: then the next
/// fainter one is looked at.
BelievedAorta aorta_of(const imaging::ImageVolume& image, AortaOptions options,
                       const core::TaskContext& task) {
  constexpr int tries = 3;
  constexpr double fainter = 0.9;
  std::string refusal;
  for (int i = 0; i < tries; ++i) {
    Aorta aorta;
    try {
      aorta = find_aorta(image, options, task);
    } catch (const GeometryError& error) {
      throw GeometryError(refusal.empty() ? error.what() + why_no_aorta(image, task) : refusal);
    }
    const HeartVerdict heart = judge(chambers_beside(image, aorta, task));
    if (heart.refusal.empty()) return {std::move(aorta), heart.warning};
    if (refusal.empty()) refusal = heart.refusal;
    options.most_hu = fainter * aorta.lumen_hu;
    if (options.most_hu < options.least_hu) break;
  }
  throw GeometryError(refusal);
}

/// Vessels that the image cuts off.
void tell_borders(Extraction& result, const imaging::Geometry& grid) {
  constexpr double beside_mm = 2.0;
  const auto inside = [&](const Vec3& place) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double way : {-beside_mm, beside_mm})
        if (!grid.contains(place + way * grid.direction.col(axis))) return false;
    return true;
  };
  for (const geometry::Vessel& vessel : result.vessels.tree.vessels)
    if (!inside(geometry::vessel_axis(result.vessels.tree, vessel).points.back()))
      result.warnings.push_back(vessel.name + ": it leaves the image; what goes on is not in it");
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
  const std::size_t vessels = result.vessels.tree.vessels.size();
  if (vessels < few_vessels)
    result.warnings.push_back("only " + std::to_string(vessels) +
                              (vessels == 1 ? " vessel was" : " vessels were") +
                              " found, where a sharp image shows about ten: look for side branches and ends "
                              "that are missing");
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

namespace {

/// What begins beyond the wall is looked for beside an artery that does not: where none leaves the aorta,
/// what was taken for it may be something else.
void require_ostium(const std::vector<Ostium>& ostia) {
  if (ostia.empty())
    throw GeometryError(
        "no coronary artery was found where one should leave the aorta: the root may lie outside of the "
        "image, or the arteries hold too little contrast; draw a first vessel by its two ends");
}

void require_found(const Extraction& result, const GrownTree& grown) {
  if (grown.branches.empty())
    throw GeometryError(
        "nothing that looks like an artery goes on from where one leaves the aorta; draw a first vessel by "
        "its two ends");
  if (grown.branches.size() > most_branches)
    throw GeometryError(
        "what was found has " + std::to_string(grown.branches.size()) +
        " branches, more than coronary arteries show: the image is too noisy (a deviation of " +
        std::to_string(std::lround(result.aorta.noise_hu)) +
        " HU in the aorta, in cubes of 1.5 mm) or veins and muscle are as bright as arteries; "
        "take a smoother reconstruction, or draw a first vessel by its two ends");
}

Extraction extracted(const imaging::ImageVolume& image, const ExtractOptions& options,
                     const InputNotes& notes, const core::TaskContext& task) {
  Extraction result;
  result.warnings = notes.warnings;
  task.set_stage("finding the aorta");
  BelievedAorta believed = aorta_of(image, options.aorta, task.sub(0.0, 0.2));
  result.aorta = std::move(believed.aorta);
  LabelOptions labels = options.labels;
  if (notes.turned) labels.least_confidence = no_names;
  if (!believed.warning.empty()) {
    result.warnings.push_back(believed.warning);
    labels.least_confidence = no_names;
  }
  task.set_stage("finding where the coronary arteries leave it");
  const SearchImage search = search_image(image, result.aorta, task.sub(0.2, 0.22));
  const imaging::ImageVolume& seen = search.of(image);
  result.warnings.insert(result.warnings.end(), search.warnings.begin(), search.warnings.end());
  result.ostia = find_ostia(seen, result.aorta, options.ostia, task.sub(0.22, 0.25));
  require_ostium(result.ostia);
  task.set_stage("growing the coronary tree");
  GrowthOptions growth = options.growth;
  growth.noise_hu = std::max(growth.noise_hu, search.noise_hu);
  growth.image_blur_mm = std::hypot(growth.image_blur_mm, search.blur_mm);
  const GrownTree grown = grow_tree(seen, result.aorta, result.ostia, growth, task.sub(0.25, 0.85));
  require_found(result, grown);
  result.ostia.insert(result.ostia.end(), grown.lost.begin(), grown.lost.end());
  task.set_stage("centring the vessels");
  CentredTree centred = centred_tree(image, grown, result.ostia, options.axes, task.sub(0.85, 0.98));
  result.warnings.insert(result.warnings.end(), centred.warnings.begin(), centred.warnings.end());
  result.left_out = std::move(centred.left_out);
  task.set_stage("naming the vessels");
  result.vessels = label_branches(centred.tree, labels);
  result.notes = in_order_of(result.vessels.tree, centred.notes);
  result.certainty = certainty_of(image, result.vessels.tree, result.aorta);
  tell(result);
  tell_borders(result, image.geometry);
  task.set_progress(1.0);
  return result;
}

}  // namespace

Extraction extract(const imaging::ImageVolume& image, const ExtractOptions& options,
                   const core::TaskContext& task) {
  validate(options);
  const InputNotes notes = check_input(image);
  try {
    return extracted(image, options, notes, task);
  } catch (const GeometryError& error) {
    // What is odd about the image may be why.
    std::string what = error.what();
    for (const std::string& one : notes.warnings) what += "; besides, " + one;
    throw GeometryError(what);
  }
}

bool lacks_contrast(const imaging::ImageVolume& image, const core::TaskContext& task) {
  return !why_no_contrast(image, task).empty();
}

}  // namespace ostia::coronary
