#include "reports/wall_profiles.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr double profile_step_mm = 0.1;
// Not further inside: the other wall of a narrow vessel would be compared, too.
constexpr int inner_steps = 6, outer_steps = 8;
constexpr int rows = inner_steps + outer_steps + 1;
constexpr int most_shift = 10;  // steps
constexpr int sweeps = 20;
constexpr double neighbours_weight = 0.5;
constexpr double most_confidence = 4.0;  // of the median's

/// Values at steps -inner - `more` ... outer + `more` along each normal.
std::vector<float> along_normals(const TriMesh& mesh, const imaging::FloatVolume& image, int more) {
  const std::vector<Vec3> normals = geometry::vertex_normals(mesh);
  const int count = rows + 2 * more;
  std::vector<float> values(mesh.points.size() * static_cast<std::size_t>(count));
  core::parallel_for(mesh.points.size(), 512, [&](std::size_t i) {
    for (int k = 0; k < count; ++k)
      values[i * static_cast<std::size_t>(count) + static_cast<std::size_t>(k)] =
          static_cast<float>(imaging::sample(
              image,
              mesh.points[i] + profile_step_mm * static_cast<double>(k - inner_steps - more) * normals[i]));
  });
  return values;
}

struct Shift {
  double steps = 0.0, confidence = 0.0;
};

/// The shift of least squared difference, to a fraction of a step by a parabola; the difference's curvature
/// tells how clear it is.
Shift best_shift(const float* profile, const float* wanted) {
  std::array<double, 2 * most_shift + 1> cost{};
  for (std::size_t d = 0; d < cost.size(); ++d)
    for (std::size_t k = 0; k < rows; ++k) {
      const double off = static_cast<double>(profile[d + k]) - static_cast<double>(wanted[k]);
      cost[d] += off * off;
    }
  const auto best = static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  if (best == 0 || best + 1 == cost.size()) return {};  // not seen from here
  const double bend = cost[best - 1] - 2.0 * cost[best] + cost[best + 1];
  if (!(bend > 0.0)) return {};
  const double part = 0.5 * (cost[best - 1] - cost[best + 1]) / bend;
  return {static_cast<double>(best) - most_shift + part, bend};
}

/// Made comparable: 1 is usual.
void scale_confidence(std::vector<Shift>& shifts) {
  std::vector<double> all;
  for (const Shift& one : shifts) all.push_back(one.confidence);
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  const double usual = std::max(*middle, 1e-12);
  for (Shift& one : shifts) one.confidence = std::min(one.confidence / usual, most_confidence);
}

/// Each shift drawn to its neighbours', the less the clearer it is.
std::vector<double> smoothed(const std::vector<Shift>& shifts, const TriMesh& mesh) {
  const auto neighbours = geometry::vertex_neighbours(mesh);
  std::vector<double> now, next(shifts.size());
  for (const Shift& one : shifts) now.push_back(one.steps);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    core::parallel_for(shifts.size(), 2048, [&](std::size_t i) {
      double sum = shifts[i].confidence * shifts[i].steps, weight = shifts[i].confidence;
      for (const std::int32_t j : neighbours[i]) {
        sum += neighbours_weight * now[static_cast<std::size_t>(j)];
        weight += neighbours_weight;
      }
      next[i] = weight > 0.0 ? sum / weight : 0.0;
    });
    now.swap(next);
  }
  return now;
}

}  // namespace

WallProfiles wall_profiles(const TriMesh& shape, const imaging::FloatVolume& image) {
  return {along_normals(shape, image, 0)};
}

FoundWall found_wall(const TriMesh& carried, const WallProfiles& wanted, const imaging::FloatVolume& image) {
  const std::vector<float> profiles = along_normals(carried, image, most_shift);
  std::vector<Shift> shifts(carried.points.size());
  constexpr std::size_t wide = rows + 2 * most_shift;
  core::parallel_for(shifts.size(), 512, [&](std::size_t i) {
    shifts[i] = best_shift(&profiles[i * wide], &wanted.values[i * rows]);
  });
  scale_confidence(shifts);
  const std::vector<double> steps = smoothed(shifts, carried);
  const std::vector<Vec3> normals = geometry::vertex_normals(carried);
  FoundWall found;
  found.points = carried.points;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    found.points[i] += profile_step_mm * steps[i] * normals[i];
    found.mean_shift_mm += profile_step_mm * std::abs(steps[i]) / static_cast<double>(steps.size());
  }
  return found;
}

double wall_contrast(const WallProfiles& profiles) {
  std::vector<float> contrast;
  for (std::size_t i = 0; i + rows <= profiles.values.size(); i += rows)
    contrast.push_back(profiles.values[i] - profiles.values[i + rows - 1]);
  if (contrast.empty()) return 0.0;
  const auto middle = contrast.begin() + static_cast<std::ptrdiff_t>(contrast.size() / 2);
  std::nth_element(contrast.begin(), middle, contrast.end());
  return static_cast<double>(*middle);
}

}  // namespace ostia::pipeline
