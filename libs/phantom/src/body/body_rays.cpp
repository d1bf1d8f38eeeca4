#include "body/body_rays.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::phantom {
namespace {

using geometry::Vec3;

constexpr double cell_mm = 5.0, plane_mm = 10.0;
constexpr int cells = 104;      // along a side of what is looked at
constexpr int block_cells = 8;  // of the scene's parts
constexpr int ray_angles = 90;  // over half a turn
constexpr int ray_bins = 150;   // of a cell's width: the diagonal
constexpr float most_hu = 3000.0f;

double cell_place(int n) {
  return cell_mm * (n - 0.5 * (cells - 1));
}

/// Attenuation times the cell's side, in a row of blocks of a plane at this height.
void look(const Scene& scene, const imaging::Geometry& grid, const Vec3& centre, double height_mm,
          int block_row, std::vector<float>& seen) {
  const auto place = [&](double i, double j) {
    return Vec3(centre + grid.direction * Vec3(i, j, height_mm));
  };
  for (int block = 0; block < cells / block_cells; ++block) {
    geometry::Box3 box;
    for (const int i : {block * block_cells, block * block_cells + block_cells - 1})
      for (const int j : {block_row * block_cells, block_row * block_cells + block_cells - 1})
        box.extend(place(cell_place(i), cell_place(j)));
    const auto part = scene.part({box.min() - Vec3::Constant(1e-6), box.max() + Vec3::Constant(1e-6)});
    for (int j = block_row * block_cells; j < (block_row + 1) * block_cells; ++j) {
      for (int i = block * block_cells; i < (block + 1) * block_cells; ++i) {
        const float hu = std::clamp(part->at(place(cell_place(i), cell_place(j))).hu, -1000.0f, most_hu);
        seen[static_cast<std::size_t>(i + cells * j)] =
            static_cast<float>(cell_mm * BodyRays::water_per_mm) * (1.0f + hu / 1000.0f);
      }
    }
  }
}

void project(const std::vector<float>& seen, int angle, float* bins) {
  const double a = std::numbers::pi * angle / ray_angles, c = std::cos(a), s = std::sin(a);
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const float value = seen[static_cast<std::size_t>(i + cells * j)];
      if (value < 1e-4f) continue;
      const double at = (cell_place(i) * c + cell_place(j) * s) / cell_mm + 0.5 * (ray_bins - 1);
      const auto low = static_cast<int>(at);
      const auto part = static_cast<float>(at - low);
      bins[low] += (1.0f - part) * value;
      bins[low + 1] += part * value;
    }
  }
}

}  // namespace

BodyRays::BodyRays(const Scene& scene, const imaging::Geometry& grid, const Vec3& centre_mm,
                   const core::TaskContext& task) {
  const double lowest = (grid.origin - centre_mm).dot(grid.direction.col(2));
  const double highest = lowest + grid.spacing.z() * static_cast<double>(grid.size[2] - 1);
  first_plane_ = static_cast<int>(std::floor(lowest / plane_mm));
  planes_ = static_cast<int>(std::ceil(highest / plane_mm)) - first_plane_ + 1;
  constexpr int rows = cells / block_cells;
  std::vector<std::vector<float>> seen(static_cast<std::size_t>(planes_),
                                       std::vector<float>(static_cast<std::size_t>(cells * cells), 0.0f));
  core::parallel_for(static_cast<std::size_t>(planes_ * rows), 1, [&](std::size_t n) {
    task.throw_if_cancelled();
    const auto plane = static_cast<int>(n) / rows;
    look(scene, grid, centre_mm, plane_mm * (first_plane_ + plane), static_cast<int>(n) % rows,
         seen[static_cast<std::size_t>(plane)]);
  });
  lines_.assign(static_cast<std::size_t>(planes_) * ray_angles * ray_bins, 0.0f);
  core::parallel_for(static_cast<std::size_t>(planes_ * ray_angles), 4, [&](std::size_t n) {
    task.throw_if_cancelled();
    project(seen[n / ray_angles], static_cast<int>(n % ray_angles), lines_.data() + n * ray_bins);
  });
}

double BodyRays::at(int plane, int angle, double bin) const {
  // Beyond half a turn the same rays are seen from the other side.
  if (angle == ray_angles) return at(plane, 0, ray_bins - 1 - bin);
  if (!(bin >= 0.0 && bin < ray_bins - 1)) return 0.0;
  const auto low = static_cast<std::size_t>(bin);
  const double part = bin - static_cast<double>(low);
  const float* line = lines_.data() + static_cast<std::size_t>(plane * ray_angles + angle) * ray_bins;
  return (1.0 - part) * line[low] + part * line[low + 1];
}

double BodyRays::line_integral(double angle, double distance_mm, double height_mm) const {
  const double bin = distance_mm / cell_mm + 0.5 * (ray_bins - 1);
  const double turn = std::clamp(angle / std::numbers::pi * ray_angles, 0.0, ray_angles - 1e-9);
  const double height =
      std::clamp(height_mm / plane_mm - first_plane_, 0.0, static_cast<double>(planes_ - 1));
  const int a = static_cast<int>(turn), p = std::min(static_cast<int>(height), std::max(planes_ - 2, 0));
  const double fa = turn - a, fp = height - p;
  double sum = 0.0;
  for (int da = 0; da < 2; ++da) {
    const double wa = da != 0 ? fa : 1.0 - fa;
    sum += wa * (1.0 - fp) * at(p, a + da, bin);
    if (fp > 0.0) sum += wa * fp * at(std::min(p + 1, planes_ - 1), a + da, bin);
  }
  return sum;
}

}  // namespace ostia::phantom
