#include "ostia/session/evaluability.h"

#include "walls/vessel_look.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"
#include "ostia/imaging/noise.h"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <set>

namespace ostia::session {
namespace {

constexpr double least_own_mm = 2.0;  // by itself, to be looked at
constexpr double about_tree_mm = 20.0;

/// What a figure of a scan is usual for, and what is no longer fair.
struct Bound {
  double usual = 0.0, fair = 0.0;
};
constexpr Bound in_plane_mm{0.6, 1.0}, slices_mm{1.0, 1.5}, noise_hu_bound{30.0, 60.0}, blur_bound{0.6, 0.9},
    lumen_hu_bound{300.0, 200.0}, cnr_bound{10.0, 5.0};

double figure_median(const std::vector<VesselEvaluability>& vessels, double analysis::WallEvidence::*figure,
                     bool without_nothing) {
  std::vector<double> values;
  for (const VesselEvaluability& vessel : vessels)
    for (const analysis::WallEvidence& one : vessel.evidence)
      if (one.in_image && !(without_nothing && one.*figure == 0.0)) values.push_back(one.*figure);
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Grading {
 public:
  explicit Grading(ScanQuality& quality) : quality_(quality) {}
  void at_most(double value, const Bound& bound, const std::string& said, int decimals) {
    if (value > bound.usual) lower(value > bound.fair, said, "up to", bound.usual, decimals);
  }
  void at_least(double value, const Bound& bound, const std::string& said, int decimals) {
    if (value < bound.usual) lower(value < bound.fair, said, "at least", bound.usual, decimals);
  }
  void lower(bool to_poor, const std::string& said) {
    quality_.grade = std::max(quality_.grade, to_poor ? ScanGrade::poor : ScanGrade::fair);
    quality_.reasons.push_back(said);
  }

 private:
  void lower(bool to_poor, const std::string& said, const char* bound, double usual, int decimals) {
    lower(to_poor, said + "; " + bound + " " + core::shown_text(usual, decimals) + " is usual");
  }
  ScanQuality& quality_;
};

/// Checked.
analysis::WallEvidenceOptions evidence_options(const VesselEvaluabilityOptions& options, double noise_hu) {
  analysis::validate(options.grades);
  analysis::WallEvidenceOptions how;
  how.step_mm = options.step_mm;
  how.around = rays_around;
  how.noise_hu = std::min(noise_hu, 500.0);
  analysis::validate(how);
  return how;
}

std::string percent_text(double share) {
  return core::percent_text(100.0 * share) + " %";
}

}  // namespace

double noise_about(const lumen::LumenModel& model, const imaging::ImageVolume& image) {
  geometry::Box3 box;
  for (const geometry::TreeSegment& segment : model.tree.segments)
    for (const geometry::Vec3& p : segment.axis.points) box.extend(p);
  std::optional<double> noise;
  if (!box.isEmpty()) {
    const geometry::Vec3 reach = geometry::Vec3::Constant(about_tree_mm);
    noise = imaging::noise_level_hu(image, geometry::Box3(box.min() - reach, box.max() + reach));
  }
  if (!noise) noise = imaging::noise_level_hu(image);
  return noise.value_or(0.0);
}

VesselEvaluability evaluability_in(const OwnLumen& own, const lumen::LumenModel& model,
                                   const imaging::ImageVolume& image, double noise_hu,
                                   const VesselEvaluabilityOptions& options, const core::TaskContext& task) {
  const analysis::WallEvidenceOptions how = evidence_options(options, noise_hu);
  VesselEvaluability out;
  out.vessel = own.vessel;
  if (own.to_mm() - own.rows.from_mm < least_own_mm) return out;
  const geometry::AxisCurve& axis = *lumen::vessel(model, own.vessel).axis;
  out.evidence = analysis::wall_evidence(
      image, axis, [&](double s, double theta) { return own.rows.at(s, theta); }, own.rows.from_mm,
      own.to_mm(), how, task);
  out.stretches =
      analysis::evaluable_stretches(out.evidence, lumen::own_from_mm(model.tree, own.vessel), axis.length(),
                                    image.geometry.spacing.maxCoeff(), noise_hu, options.grades);
  return out;
}

VesselEvaluability vessel_evaluability(const lumen::LumenModel& model,
                                       const analysis::SurfaceOfVessel& surface_of, std::int32_t vessel,
                                       const imaging::ImageVolume& image, double noise_hu,
                                       const VesselEvaluabilityOptions& options,
                                       const core::TaskContext& task) {
  evidence_options(options, noise_hu);
  const OwnLumen own = own_lumen(model, surface_of, vessel, options.step_mm, rays_around, task.sub(0.0, 0.6));
  return evaluability_in(own, model, image, noise_hu, options, task.sub(0.6, 1.0));
}

std::vector<analysis::EvaluableStretch> judged_over(const std::vector<analysis::EvaluableStretch>& by_program,
                                                    const VesselMark* mark,
                                                    const analysis::EvaluableStretch& whole) {
  if (!mark || mark->evaluable.empty()) return by_program;
  if (!by_program.empty()) return analysis::overruled(by_program, mark->evaluable);
  analysis::EvaluableStretch unknown = whole;
  unknown.grade = analysis::Evaluability::not_evaluable;
  return analysis::overruled({unknown}, mark->evaluable);
}

std::string to_string(ScanGrade grade) {
  return grade == ScanGrade::good ? "good" : grade == ScanGrade::fair ? "fair" : "poor";
}

ScanQuality scan_quality(const imaging::Geometry& grid, double noise_hu,
                         const std::vector<VesselEvaluability>& vessels) {
  using analysis::WallEvidence;
  ScanQuality out;
  out.voxel_mm = grid.spacing;
  out.noise_hu = noise_hu;
  out.lumen_hu = figure_median(vessels, &WallEvidence::lumen_hu, false);
  out.contrast_hu = figure_median(vessels, &WallEvidence::contrast_hu, true);
  out.cnr = out.contrast_hu / std::max(noise_hu, 1.0);
  out.blur_mm = figure_median(vessels, &WallEvidence::blur_mm, true);
  std::vector<analysis::EvaluableStretch> all;
  for (const VesselEvaluability& vessel : vessels)
    all.insert(all.end(), vessel.stretches.begin(), vessel.stretches.end());
  out.evaluable_share = analysis::share_of(all, analysis::Evaluability::evaluable);
  out.limited_share = analysis::share_of(all, analysis::Evaluability::limited);
  out.not_evaluable_share = analysis::share_of(all, analysis::Evaluability::not_evaluable);

  Grading grading(out);
  const double plane = std::max(grid.spacing.x(), grid.spacing.y());
  grading.at_most(plane, in_plane_mm, "voxels of " + core::calibre_text(plane) + " mm in the plane", 1);
  grading.at_most(grid.spacing.z(), slices_mm, "slices " + core::calibre_text(grid.spacing.z()) + " mm apart",
                  1);
  grading.at_most(noise_hu, noise_hu_bound, "noise of " + core::hu_text(noise_hu) + " HU", 0);
  if (all.empty()) return out;
  grading.at_least(out.lumen_hu, lumen_hu_bound, "arteries of " + core::hu_text(out.lumen_hu) + " HU", 0);
  grading.at_least(out.cnr, cnr_bound, "contrast is " + core::shown_text(out.cnr, 1) + " times the noise", 0);
  grading.at_most(out.blur_mm, blur_bound,
                  "edges blurred by " + core::calibre_text(out.blur_mm) + " mm (motion, or the scanner)", 1);
  if (out.not_evaluable_share > 0.1)
    grading.lower(out.not_evaluable_share > 0.3,
                  percent_text(out.not_evaluable_share) + " of the arteries' length cannot be evaluated");
  return out;
}

std::vector<std::string> arteries_not_found(const lumen::LumenModel& model,
                                            const std::map<std::int32_t, double>& unlikely) {
  std::set<int> segments;
  for (const analysis::VesselSegment& one : analysis::segments_of(model))
    if (one.aha && !unlikely.count(one.vessel)) segments.insert(one.aha->number);
  const auto any = [&](std::initializer_list<int> numbers) {
    return std::any_of(numbers.begin(), numbers.end(), [&](int n) { return segments.count(n) > 0; });
  };
  std::string unnamed, hardly;
  for (const geometry::Vessel& vessel : model.tree.vessels)
    if (const auto found = unlikely.find(vessel.id); found != unlikely.end())
      hardly += (hardly.empty() ? "" : ", ") + vessel.name + " " + core::shown_text(found->second, 2);
    else if (analysis::main_vessel_of(vessel.name).empty())
      unnamed += (unnamed.empty() ? "" : ", ") + vessel.name;
  std::string perhaps;
  if (!unnamed.empty()) perhaps = ", or among the vessels without a coronary artery's name (" + unnamed + ")";
  if (!hardly.empty()) perhaps += ", what was found is hardly an artery (probability of " + hardly + ")";
  const bool lad = any({6, 7, 8}), lcx = any({11, 13}), rca = any({1, 2, 3});
  std::vector<std::string> out;
  const auto add = [&](const std::string& name) { out.push_back(name + ": not found" + perhaps); };
  if (!lad && !lcx && !any({5})) {
    add("left coronary artery (LM, LAD, LCX)");
  } else {
    if (!lad) add("LAD");
    if (!lcx) add("LCX");
  }
  if (!rca) add("RCA");
  return out;
}

}  // namespace ostia::session
