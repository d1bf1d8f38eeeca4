#include "ostia/phantom/moving_case.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::phantom {
namespace {

using geometry::Box3;
using geometry::Centerline;

constexpr double lattice_mm = 1.0;
/// The map back stretches no distance by more.
constexpr double most_stretch = 3.0;

/// What lies in a box at a phase, asked from the part of the still scene that it came from.
class MovedPart : public ScenePart {
 public:
  MovedPart(const Scene& still, const BeatPhase& phase, const Box3& box) {
    // The lattice is the world's, not the box's: the same answer at a place from every box.
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      first_[a] = static_cast<std::int64_t>(std::floor(box.min()[axis] / lattice_mm));
      count_[a] = static_cast<std::int64_t>(std::ceil(box.max()[axis] / lattice_mm)) - first_[a] + 1;
      count_[a] = std::max<std::int64_t>(count_[a], 2);
    }
    Box3 from;
    places_.reserve(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
    for (std::int64_t k = 0; k < count_[2]; ++k) {
      for (std::int64_t j = 0; j < count_[1]; ++j) {
        for (std::int64_t i = 0; i < count_[0]; ++i) {
          const Vec3 node(static_cast<double>(first_[0] + i), static_cast<double>(first_[1] + j),
                          static_cast<double>(first_[2] + k));
          places_.push_back(phase.template_of(lattice_mm * node));
          from.extend(places_.back());
        }
      }
    }
    part_ = still.part({from.min() - Vec3::Constant(1e-6), from.max() + Vec3::Constant(1e-6)});
  }

  Material at(const Vec3& p) const override { return part_->at(place(p)); }
  std::optional<Material> uniform() const override { return part_->uniform(); }
  bool fine_near(const Vec3& p, double reach_mm) const override {
    return part_->fine_near(place(p), most_stretch * reach_mm);
  }

 private:
  Vec3 place(const Vec3& p) const {
    std::array<std::int64_t, 3> cell{};
    Vec3 t;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      const double x = p[axis] / lattice_mm - static_cast<double>(first_[a]);
      cell[a] = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(x)), 0, count_[a] - 2);
      t[axis] = x - static_cast<double>(cell[a]);
    }
    const auto at = static_cast<std::size_t>(cell[0] + count_[0] * (cell[1] + count_[1] * cell[2]));
    const auto row = static_cast<std::size_t>(count_[0]), plane = row * static_cast<std::size_t>(count_[1]);
    const auto along = [&](std::size_t n) -> Vec3 {
      return (1.0 - t.x()) * places_[n] + t.x() * places_[n + 1];
    };
    const auto across = [&](std::size_t n) -> Vec3 {
      return (1.0 - t.y()) * along(n) + t.y() * along(n + row);
    };
    return (1.0 - t.z()) * across(at) + t.z() * across(at + plane);
  }

  std::array<std::int64_t, 3> first_{}, count_{};
  std::vector<Vec3> places_;
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
  return acquire(MovedScene(body, phase), options, task);
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
