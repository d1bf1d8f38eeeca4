#include "path/target.h"

#include "fronts/fast_marching.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>

namespace ostia::segmentation::detail {
namespace {

constexpr double kSampleMm = 0.4;
constexpr double kUnknownRadiusMm = 1.0;  // of a tree without radii
constexpr double kCore = 0.75;            // part of the radius that a front must reach
constexpr double kClearMm = 0.7;          // between two lumina that are apart
constexpr double kStraightMm = 5.0;       // of the branch that gives its direction
constexpr double kReach = 3.5;            // back along it, in distances from the axis: down to 17 degrees
constexpr double kMostOfTheWay = 0.6;     // of a short branch is kept in any case

/// The place on a line that a ray comes closest to.
Vec3 met_by(const std::vector<Vec3>& axis, const Vec3& from, const Vec3& direction, double reach) {
  Vec3 best = Vec3::Zero();
  double least = 1e9;
  for (double t = 0.0; t <= reach; t += 0.1) {
    const Vec3 p = from + t * direction;
    const Vec3 foot = geometry::closest(axis, p).point;
    if ((foot - p).norm() >= least) continue;
    least = (foot - p).norm();
    best = foot;
  }
  return best;
}

}  // namespace

PathTarget::PathTarget(const imaging::ImageVolume& image, const geometry::VesselTree& tree,
                       const Vec3& centre, double reach_mm)
    : tree_(tree), marks_(image.geometry.size, -1) {
  for (std::size_t n = 0; n < tree.segments.size(); ++n) add(image, n, centre, reach_mm);
}

void PathTarget::add(const imaging::ImageVolume& image, std::size_t segment, const Vec3& centre,
                     double reach_mm) {
  const geometry::Centerline& axis = tree_.segments[segment].axis;
  if (axis.points.size() < 2) return;
  const bool radii = axis.radius.size() == axis.points.size();
  const std::vector<double> s = geometry::abscissas(axis.points);
  double next = 0.0;
  for (std::size_t i = 0; i < axis.points.size(); ++i) {
    if (s[i] < next && i + 1 < axis.points.size()) continue;
    // Long straight pieces are filled in.
    const std::size_t last = i + 1 < axis.points.size() ? i + 1 : i;
    const auto pieces = std::max(1, static_cast<int>(std::ceil((s[last] - s[i]) / kSampleMm)));
    next = s[i] + kSampleMm;
    for (int p = 0; p < pieces; ++p) {
      const double t = static_cast<double>(p) / pieces;
      Sample sample{axis.points[i] + t * (axis.points[last] - axis.points[i]), kUnknownRadiusMm, segment};
      if (radii) sample.radius = axis.radius[i] + t * (axis.radius[last] - axis.radius[i]);
      if (!sample.point.allFinite() || !(sample.radius > 0.0)) continue;
      if ((sample.point - centre).norm() > reach_mm || !image.geometry.contains(sample.point)) continue;
      mark(image.geometry, sample);
      samples_.push_back(sample);
    }
  }
}

void PathTarget::mark(const imaging::Geometry& geometry, const Sample& sample) {
  const auto index = static_cast<std::int32_t>(samples_.size());
  const double radius = std::max(kCore * sample.radius, 0.6 * geometry.spacing.maxCoeff());
  const Vec3 at = geometry.index(sample.point);
  const Vec3 reach = Vec3::Constant(radius).cwiseQuotient(geometry.spacing);
  std::array<std::int32_t, 3> low{}, high{};
  for (int d = 0; d < 3; ++d) {
    const auto last = static_cast<double>(geometry.size[static_cast<std::size_t>(d)] - 1);
    low[static_cast<std::size_t>(d)] = static_cast<std::int32_t>(std::max(0.0, std::ceil(at[d] - reach[d])));
    high[static_cast<std::size_t>(d)] =
        static_cast<std::int32_t>(std::min(last, std::floor(at[d] + reach[d])));
  }
  for (std::int32_t k = low[2]; k <= high[2]; ++k) {
    for (std::int32_t j = low[1]; j <= high[1]; ++j) {
      for (std::int32_t i = low[0]; i <= high[0]; ++i) {
        const Vec3 away = (Vec3(i, j, k) - at).cwiseProduct(geometry.spacing);
        const Voxel v{i, j, k};
        if (away.norm() <= radius && marks_.get(v) < 0) marks_.at(v) = index;
      }
    }
  }
}

const geometry::Vessel& PathTarget::owner(std::size_t segment) const {
  const std::int32_t id = tree_.segments[segment].id;
  for (const geometry::Vessel& vessel : tree_.vessels) {
    if (std::find(vessel.segments.begin(), vessel.segments.end(), id) != vessel.segments.end()) return vessel;
  }
  throw InvalidInput("segment " + std::to_string(id) + " of the tree belongs to no vessel; name a vessel");
}

PathJunction PathTarget::owned(std::size_t segment, const Vec3& point) const {
  const geometry::Vessel& vessel = owner(segment);
  const geometry::PolylineLocation at = geometry::closest(geometry::vessel_axis(tree_, vessel).points, point);
  return {vessel.id, at.abscissa, at.point};
}

std::optional<std::int32_t> PathTarget::vessel_around(const Vec3& place) const {
  for (const Sample& sample : samples_) {
    if ((sample.point - place).norm() <= sample.radius) return owner(sample.segment).id;
  }
  return std::nullopt;
}

std::vector<Vec3> PathTarget::axis_points_near(const Vec3& place, double radius_mm,
                                               std::size_t fewest) const {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < samples_.size(); ++i)
    order.emplace_back((samples_[i].point - place).squaredNorm(), i);
  std::sort(order.begin(), order.end());
  std::vector<Vec3> result;
  for (const auto& [squared, i] : order) {
    if (result.size() >= fewest && squared > radius_mm * radius_mm) break;
    result.push_back(samples_[i].point);
  }
  return result;
}

const PathTarget::Sample& PathTarget::sample_at(const geometry::Vessel& vessel, const Vec3& place) const {
  const Sample* best = nullptr;
  for (const Sample& sample : samples_) {
    const auto& own = vessel.segments;
    if (std::find(own.begin(), own.end(), tree_.segments[sample.segment].id) == own.end()) continue;
    if (best == nullptr || (sample.point - place).squaredNorm() < (best->point - place).squaredNorm())
      best = &sample;
  }
  return *best;  // the vessel has one: the one that was met
}

PathTarget::Joint PathTarget::entry(const Voxel& reached, const std::vector<Vec3>& way) const {
  const Sample& at = met(reached);
  const std::vector<Vec3> axis = geometry::vessel_axis(tree_, owner(at.segment)).points;
  Joint result;
  while (result.first_free + 1 < way.size() &&
         (geometry::closest(axis, way[result.first_free]).point - way[result.first_free]).norm() <
             at.radius) {
    ++result.first_free;
  }
  const Vec3 point = geometry::closest(axis, way[result.first_free]).point;
  result.junction = owned(sample_at(owner(at.segment), point).segment, point);
  return result;
}

PathTarget::Joint PathTarget::rejoined(const Voxel& reached, const std::vector<Vec3>& line,
                                       double radius_mm) const {
  const geometry::Vessel& parent = owner(met(reached).segment);
  const std::vector<Vec3> axis = geometry::vessel_axis(tree_, parent).points;
  const std::vector<double> s = geometry::abscissas(line);
  Joint result;
  double distance = 0.0;
  for (std::size_t i = 0; i + 1 < line.size() && s[i] < kMostOfTheWay * s.back(); ++i) {
    const Vec3 foot = geometry::closest(axis, line[i]).point;
    distance = (foot - line[i]).norm();
    result.first_free = i;
    if (distance > sample_at(parent, foot).radius + radius_mm + kClearMm) break;
  }
  std::size_t on = result.first_free;
  while (on + 1 < line.size() && s[on] < s[result.first_free] + kStraightMm) ++on;
  const Vec3 free = line[result.first_free], back = free - line[on];
  Vec3 point = geometry::closest(axis, free).point;
  if (back.norm() > 1e-6) point = met_by(axis, free, back.normalized(), kReach * distance);
  result.junction = owned(sample_at(parent, point).segment, point);
  return result;
}

}  // namespace ostia::segmentation::detail
