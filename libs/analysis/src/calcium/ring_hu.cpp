#include "calcium/ring_hu.h"

#include "walls/contour_measures.h"

#include "ostia/geometry/frame.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ostia::analysis {
namespace {

// The lattice is as fine as this share of the ring's width, within limits.
constexpr double steps_across = 10.0, finest_mm = 0.02, coarsest_mm = 0.1;
// Of an area: nodes a voxel, and how many at most.
constexpr double nodes_across_voxel = 4.0, most_nodes = 4e5;

bool outline_encloses(const std::vector<Vec2>& line, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 &a = line[i], &b = line[(i + 1) % line.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x())
      inside = !inside;
  }
  return inside;
}

/// How far a place lies from a closed line; negative within it.
double signed_distance(const std::vector<Vec2>& line, const Vec2& p) {
  double least = INFINITY;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 &a = line[i], &b = line[(i + 1) % line.size()];
    const Vec2 along = b - a;
    const double t = std::clamp((p - a).dot(along) / std::max(along.squaredNorm(), 1e-24), 0.0, 1.0);
    least = std::min(least, (p - a - t * along).squaredNorm());
  }
  return outline_encloses(line, p) ? -std::sqrt(least) : std::sqrt(least);
}

/// Mean and deviation without the loss of places that sums of squares have (Welford 1962).
class Statistics {
 public:
  void add(double value) {
    ++result_.samples;
    result_.least = result_.samples == 1 ? value : std::min(result_.least, value);
    result_.largest = result_.samples == 1 ? value : std::max(result_.largest, value);
    const double off = value - result_.mean;
    result_.mean += off / static_cast<double>(result_.samples);
    squares_ += off * (value - result_.mean);
  }
  RingStatistics result() const {
    RingStatistics done = result_;
    if (done.samples > 0) done.deviation = std::sqrt(squares_ / static_cast<double>(done.samples));
    return done;
  }

 private:
  RingStatistics result_;
  double squares_ = 0.0;
};

}  // namespace

RingStatistics ring_statistics(const MeasuredSection& section, double inner_mm, double outer_mm,
                               const imaging::ImageVolume& image) {
  const Vec3 origin = section.measures.centroid, normal = section.measures.normal;
  const Vec3 x = geometry::initial_normal(normal).normalized(), y = normal.cross(x);
  std::vector<Vec2> line;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  for (const Vec3& p : section.contour) {
    line.emplace_back((p - origin).dot(x), (p - origin).dot(y));
    low = low.cwiseMin(line.back());
    high = high.cwiseMax(line.back());
  }
  const double h = std::clamp((outer_mm - inner_mm) / steps_across, finest_mm, coarsest_mm);
  const auto node = [h](double at) { return static_cast<long>(std::floor(at / h)); };
  Statistics statistics;
  for (long j = node(low.y() - outer_mm); j <= node(high.y() + outer_mm); ++j) {
    for (long i = node(low.x() - outer_mm); i <= node(high.x() + outer_mm); ++i) {
      const Vec2 p((static_cast<double>(i) + 0.5) * h, (static_cast<double>(j) + 0.5) * h);
      const double distance = signed_distance(line, p);
      if (!(distance >= inner_mm && distance <= outer_mm && distance > 0.0)) continue;
      const Vec3 place = origin + p.x() * x + p.y() * y;
      if (image.geometry.contains(place)) statistics.add(imaging::sample(image, place));
    }
  }
  return statistics.result();
}

RingStatistics area_statistics(const std::vector<Vec3>& outline, const imaging::ImageVolume& image) {
  Vec3 origin = Vec3::Zero(), doubled = Vec3::Zero();
  for (const Vec3& p : outline) origin += p / static_cast<double>(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i)
    doubled += (outline[i] - origin).cross(outline[(i + 1) % outline.size()] - origin);
  if (!(doubled.norm() > 1e-12)) return {};
  const Vec3 normal = doubled.normalized(), x = geometry::initial_normal(normal).normalized(),
             y = normal.cross(x);
  std::vector<Vec2> line;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
  for (const Vec3& p : outline) {
    line.emplace_back((p - origin).dot(x), (p - origin).dot(y));
    low = low.cwiseMin(line.back());
    high = high.cwiseMax(line.back());
  }
  const double box = (high - low).prod();
  const double h =
      std::max(image.geometry.spacing.minCoeff() / nodes_across_voxel, std::sqrt(box / most_nodes));
  Statistics statistics;
  for (Vec2 p = low + Vec2::Constant(0.5 * h); p.y() < high.y(); p.y() += h)
    for (p.x() = low.x() + 0.5 * h; p.x() < high.x(); p.x() += h) {
      const Vec3 place = origin + p.x() * x + p.y() * y;
      if (!outline_encloses(line, p) || !image.geometry.contains(place)) continue;
      const Vec3 at = image.geometry.index(place);
      const auto nearest = [&](int k) {
        return std::clamp(static_cast<std::int64_t>(std::llround(at[k])), std::int64_t{0},
                          image.geometry.size[static_cast<std::size_t>(k)] - 1);
      };
      statistics.add(image(nearest(0), nearest(1), nearest(2)));
    }
  return statistics.result();
}

}  // namespace ostia::analysis
