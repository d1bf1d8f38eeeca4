#include "hard/hard_truth.h"

#include "ostia/phantom/stair_steps.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

const phantom::ChallengeVessel* annotated(const phantom::CasePlan& plan, const std::string& name) {
  for (const phantom::ChallengeVessel& vessel : plan.challenge.vessels)
    if (vessel.name == name) return &vessel;
  return nullptr;
}

io::RotterdamReference own_reference(const phantom::CasePlan& plan, const phantom::CoronaryVessel& vessel) {
  constexpr double observers_mm = 0.2;  // no observer traced it; the spread of those that did
  const geometry::Centerline path = phantom::path_from_ostium(plan.tree, vessel.id);
  return {path.points, path.radius, std::vector<double>(path.size(), observers_mm)};
}

/// As an observer sees it who traces what the image shows: moved by the steps between blocks of slices. A
/// section that a step runs through has no whole contour any more and is left out.
void show_steps(const phantom::ScanOptions& scan, ExtractionTruth& truth) {
  if (scan.stair_step_mm <= 0.0) return;
  const auto show = [&](std::vector<Vec3>& points) {
    for (Vec3& point : points) point = phantom::shown_at(scan, point);
  };
  const auto side = [&](const Vec3& p) {
    return phantom::stair_shift(scan, std::lround(scan.grid.index(p).z()));
  };
  const auto is_torn = [&](const geometry::ContourSection& section) {
    const Vec3 first = side(section.contours.front().points.front());
    return std::ranges::any_of(section.contours, [&](const geometry::Contour& contour) {
      return std::ranges::any_of(contour.points, [&](const Vec3& p) { return side(p) != first; });
    });
  };
  for (TrueVessel& vessel : truth.vessels) show(vessel.reference.points);
  for (geometry::TreeNode& node : truth.tree.nodes) node.position = phantom::shown_at(scan, node.position);
  for (geometry::TreeSegment& segment : truth.tree.segments) {
    show(segment.axis.points);
    geometry::complete(segment.axis);
  }
  std::erase_if(truth.contours.sections, is_torn);
  for (geometry::ContourSection& section : truth.contours.sections)
    for (geometry::Contour& contour : section.contours) show(contour.points);
}

/// The mean of the observers' traces, which go along the same axis in equal steps, with the reference's radii
/// and spreads.
io::RotterdamReference mean_trace(const phantom::ChallengeVessel& vessel) {
  const io::RotterdamReference& exact = vessel.reference;
  const std::size_t count = vessel.observers.front().size();
  io::RotterdamReference out;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 sum = Vec3::Zero();
    for (const std::vector<Vec3>& trace : vessel.observers) sum += trace[i];
    const std::size_t at = i * (exact.points.size() - 1) / (count - 1);
    out.points.push_back(sum / static_cast<double>(vessel.observers.size()));
    out.radius.push_back(exact.radius[at]);
    out.observer_spread.push_back(exact.observer_spread[at]);
  }
  return out;
}

}  // namespace

ExtractionTruth truth_as_traced(const phantom::CasePlan& plan, ExtractionTruth truth) {
  for (TrueVessel& vessel : truth.vessels) {
    const phantom::ChallengeVessel* drawn = annotated(plan, vessel.name);
    if (!drawn || drawn->observers.empty()) continue;
    vessel.reference = mean_trace(*drawn);
    for (Vec3& point : vessel.reference.points) point = phantom::shown_at(plan.options.scan, point);
  }
  return truth;
}

ExtractionTruth truth_of_plan(const phantom::CasePlan& plan, double least_mm) {
  ExtractionTruth truth;
  truth.case_name = "seed " + std::to_string(plan.options.seed);
  truth.tree = phantom::vessel_tree(plan.tree);
  phantom::ObserverOptions nobody;
  nobody.count = 0;
  truth.contours = phantom::annotate(plan.tree, plan.sections.sections, plan.options.contours, nobody);
  for (const phantom::CoronaryVessel& vessel : plan.tree.vessels) {
    for (const phantom::Stenosis& one : vessel.stenoses)
      truth.lesions.push_back({vessel.name, one.s_from_mm, one.s_to_mm, one.s_throat_mm,
                               1.0 - std::sqrt(1.0 - one.area_stenosis)});
    const phantom::ChallengeVessel* drawn = annotated(plan, vessel.name);
    if (!drawn && 2.0 * vessel.lumen.mean_at(vessel.s_free_mm) < least_mm) continue;
    truth.vessels.push_back(
        {vessel.name, drawn != nullptr, drawn ? drawn->reference : own_reference(plan, vessel)});
  }
  show_steps(plan.options.scan, truth);
  return truth;
}

}  // namespace ostia::experiments
