#include "ostia/phantom/moving_case.h"

#include "body/place_lattice.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::phantom {
namespace {

using geometry::Box3;
using geometry::Centerline;

/// The map back stretches no distance by more.
constexpr double most_stretch = 3.0;

/// What lies in a box at a phase, asked from the part of the still scene that it came from.
class MovedPart : public ScenePart {
 public:
  MovedPart(const Scene& still, const BeatPhase& phase, const Box3& box)
      : lattice_(box, [&](const Vec3& p) { return phase.template_of(p); }) {
    const Box3& from = lattice_.from();
    part_ = still.part({from.min() - Vec3::Constant(1e-6), from.max() + Vec3::Constant(1e-6)});
  }

  Material at(const Vec3& p) const override { return part_->at(lattice_.at(p)); }
  std::optional<Material> uniform() const override { return part_->uniform(); }
  bool fine_near(const Vec3& p, double reach_mm) const override {
    return part_->fine_near(lattice_.at(p), most_stretch * reach_mm);
  }

 private:
  PlaceLattice lattice_;
  std::unique_ptr<const ScenePart> part_;
};

/// Radii at a phase, from points, radii and directions of the template.
template <class Tangent>
std::vector<double> moved_radii(const std::vector<Vec3>& points, const std::vector<double>& radius,
                                const BeatPhase& phase, const Tangent& tangent) {
  std::vector<double> out(radius.size());
  core::parallel_for(radius.size(), 256,
                     [&](std::size_t i) { out[i] = radius[i] * phase.growth_across(points[i], tangent(i)); });
  return out;
}

}  // namespace

std::vector<double> phase_percents(int phases) {
  if (phases < 1 || phases > 100)
    throw InvalidInput("the number of phases is " + std::to_string(phases) + "; it must be 1 to 100");
  std::vector<double> out;
  for (int i = 0; i < phases; ++i) out.push_back(100.0 * i / phases);
  return out;
}

std::string phase_name(double percent) {
  const auto whole = static_cast<int>(std::floor(percent + 1e-9));
  return std::string("phase-") + (whole < 10 ? "0" : "") + std::to_string(whole);
}

Heartbeat heartbeat_of(const CasePlan& plan) {
  return draw_heartbeat(plan.heart, plan.options.seed);
}

std::unique_ptr<const ScenePart> MovedScene::part(const Box3& box) const {
  return std::make_unique<const MovedPart>(still_, phase_, box);
}

Scan scan_phase(const CasePlan& plan, const Body& body, const BeatPhase& phase,
                const core::TaskContext& task) {
  ScanOptions options = plan.options.scan;
  // Another noise for every phase, and none that another case's image has.
  options.seed +=
      (std::uint64_t{1} << 32) * (1 + static_cast<std::uint64_t>(std::lround(1e3 * phase.percent())));
  const CarriedScene still(body, things_of(plan, body));
  return acquire(MovedScene(still, phase), options, task);
}

geometry::VesselTree moved(const geometry::VesselTree& tree, const BeatPhase& phase) {
  geometry::VesselTree out = tree;
  if (phase.still()) return out;
  for (geometry::TreeNode& node : out.nodes) node.position = phase.at(node.position);
  for (geometry::TreeSegment& segment : out.segments) {
    Centerline& axis = segment.axis;
    axis.radius =
        moved_radii(axis.points, axis.radius, phase, [&](std::size_t i) { return axis.frames[i].tangent; });
    const Vec3 first = axis.points.front();
    const Vec3 normal = phase.gradient(first) * axis.frames.front().normal;
    axis.points = moved(axis.points, phase);
    geometry::complete(axis, normal);
  }
  return out;
}

geometry::ContourSet moved(const geometry::ContourSet& contours, const BeatPhase& phase) {
  geometry::ContourSet out = contours;
  for (geometry::ContourSection& section : out.sections)
    for (geometry::Contour& contour : section.contours) contour.points = moved(contour.points, phase);
  return out;
}

ChallengeVessel moved(const ChallengeVessel& vessel, const BeatPhase& phase) {
  ChallengeVessel out = vessel;
  const std::vector<Vec3>& points = vessel.reference.points;
  out.reference.radius = moved_radii(points, vessel.reference.radius, phase, [&](std::size_t i) -> Vec3 {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, points.size() - 1);
    return (points[after] - points[before]).normalized();
  });
  out.reference.points = moved(points, phase);
  for (std::vector<Vec3>& line : out.observers) line = moved(line, phase);
  for (Vec3* p : {&out.point_a, &out.point_b, &out.point_s, &out.point_e}) *p = phase.at(*p);
  return out;
}

}  // namespace ostia::phantom
