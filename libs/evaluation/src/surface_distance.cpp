#include "ostia/evaluation/surface_distance.h"

#include "sampled_distance.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ostia::evaluation {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

struct SurfacePoint {
  Vec3 point = Vec3::Zero();
  double weight = 0.0;    // area, mm^2
  double distance = 0.0;  // mm
  double sign = 1.0;      // of the distance
};

std::vector<SurfacePoint> samples_of(const TriMesh& mesh, double sample_mm, const Region& counts) {
  std::vector<SurfacePoint> out;
  for (const geometry::Triangle& t : mesh.triangles) {
    for_each_sample(mesh, t, sample_mm, [&](const Vec3& point, double area) {
      if (!counts || counts(point)) out.push_back({point, area, 0.0, 1.0});
    });
  }
  return out;
}

/// On which side of its nearest triangle a point lies: 1 outside, -1 inside, 0 where the triangle is seen so
/// flatly that a fold could deceive. A point on the surface has no side that matters.
double side_of(const TriMesh& mesh, const geometry::SurfacePoint& near, const Vec3& point) {
  constexpr double on_surface_mm = 1e-12, clear_cosine = 0.7;
  if (near.distance < on_surface_mm) return 1.0;
  const auto corner = [&](std::size_t i) {
    return mesh.points[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(near.triangle)][i])];
  };
  const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  const double height = normal.dot(point - near.point), full = normal.norm() * near.distance;
  if (!(std::abs(height) > clear_cosine * full)) return 0.0;
  return height > 0.0 ? 1.0 : -1.0;
}

double side_by_winding(const geometry::AabbTree& to, const Vec3& point) {
  return to.inside(point) ? -1.0 : 1.0;
}

/// Distances and, when asked for, sides of samples in the order of the triangles. The sample before is mostly
/// near: by the triangle inequality its distance bounds how far the search has to look. The side is that of
/// the nearest triangle; every 16th sample asks the winding number too, and where the two ever disagree (the
/// reference overlaps itself, or is turned) all samples of the chunk go by the winding number.
void measure_chunk(SurfacePoint* first, SurfacePoint* last, const TriMesh& mesh, const geometry::AabbTree& to,
                   bool with_sign) {
  constexpr double rounding = 1.0 + 1e-9;
  bool trusted = true;
  for (SurfacePoint* s = first; s != last; ++s) {
    std::optional<geometry::SurfacePoint> near;
    if (s != first) {
      const SurfacePoint& before = *(s - 1);
      near = to.closest_within(s->point, (before.distance + (s->point - before.point).norm()) * rounding);
    }
    if (!near) near = to.closest(s->point);
    s->distance = near->distance;
    if (!with_sign || !trusted) continue;
    const double side = side_of(mesh, *near, s->point);
    const bool asked = side == 0.0 || (s - first) % 16 == 0;
    s->sign = asked ? side_by_winding(to, s->point) : side;
    if (asked && side != 0.0 && near->distance > 1e-9 && s->sign != side) trusted = false;
  }
  if (!with_sign || trusted) return;
  for (SurfacePoint* s = first; s != last; ++s) s->sign = side_by_winding(to, s->point);
}

void measure(std::vector<SurfacePoint>& samples, const TriMesh& mesh, bool with_sign,
             const core::TaskContext& task) {
  const geometry::AabbTree to(mesh);
  core::parallel_chunks(samples.size(), 1024, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    measure_chunk(samples.data() + first, samples.data() + last, mesh, to, with_sign);
  });
}

double quantile_95(std::vector<SurfacePoint> samples) {
  std::sort(samples.begin(), samples.end(),
            [](const SurfacePoint& a, const SurfacePoint& b) { return a.distance < b.distance; });
  double total = 0.0;
  for (const SurfacePoint& s : samples) total += s.weight;
  double reached = 0.0;
  for (const SurfacePoint& s : samples) {
    reached += s.weight;
    if (reached >= 0.95 * total) return s.distance;
  }
  return samples.back().distance;
}

double largest(const std::vector<SurfacePoint>& samples) {
  double out = 0.0;
  for (const SurfacePoint& s : samples) out = std::max(out, s.distance);
  return out;
}

struct DistanceMoments {
  double weight = 0.0, first = 0.0, second = 0.0;
  void add(double value, double w) {
    weight += w;
    first += w * value;
    second += w * value * value;
  }
  double mean() const { return first / weight; }
  double rms() const { return std::sqrt(second / weight); }
  double deviation() const { return std::sqrt(std::max(0.0, second / weight - mean() * mean())); }
};

}  // namespace

SurfaceDistances compare_surfaces(const TriMesh& reference, const TriMesh& result,
                                  const SurfaceDistanceOptions& options, const core::TaskContext& task) {
  if (!(options.sample_mm > 0.0)) throw InvalidInput("sample_mm must be positive");
  std::vector<SurfacePoint> of_reference = samples_of(reference, options.sample_mm, options.reference_region);
  std::vector<SurfacePoint> of_result = samples_of(result, options.sample_mm, options.result_region);
  if (of_reference.empty() || of_result.empty())
    throw InvalidInput("nothing to compare: a surface has no point in the region that counts");
  measure(of_reference, result, false, task);
  task.set_progress(0.5);
  measure(of_result, reference, true, task);
  task.set_progress(1.0);

  DistanceMoments both, with_sign;
  for (const SurfacePoint& s : of_reference) both.add(s.distance, s.weight);
  for (const SurfacePoint& s : of_result) {
    both.add(s.distance, s.weight);
    with_sign.add(s.sign * s.distance, s.weight);
  }
  SurfaceDistances out;
  out.msd_mm = both.mean();
  out.rms_sd_mm = both.rms();
  out.hd95_mm = std::max(quantile_95(of_reference), quantile_95(of_result));
  out.max_sd_mm = std::max(largest(of_reference), largest(of_result));
  out.signed_mean_mm = with_sign.mean();
  out.signed_sd_mm = with_sign.deviation();
  return out;
}

}  // namespace ostia::evaluation
