#include "images/image_cage.h"

#include "images/image_cage_solver.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ostia::pipeline {

using geometry::CageGrid;
using geometry::CagePoint;
using geometry::Vec3;
using imaging::FloatVolume;
using Points = std::vector<Vec3>;

namespace {

struct Stage {
  int depth;
  double sigma_mm, reach_mm;  ///< blur; how far outside of the wall values are compared
};
// Far and blurred first: between two phases of twenty the right coronary artery goes 5 mm.
constexpr std::array<Stage, 7> stages{{{0, 4.0, 8.0},
                                       {1, 4.0, 8.0},
                                       {2, 2.5, 8.0},
                                       {3, 1.5, 5.0},
                                       {3, 0.8, 3.0},
                                       {4, 0.8, 3.0},
                                       {5, 0.8, 3.0}}};
// From the wall along its normal, mm: denser where the edge is.
constexpr std::array<double, 9> offsets_mm{-1.0, -0.4, 0.0, 0.4, 0.8, 1.6, 3.0, 5.0, 8.0};
constexpr std::size_t most_wall_points = 6000;
constexpr double image_margin_mm = 20.0;  // about what is looked for: further than a phase's step

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<Eigen::Index>(a.size());
  if (n < 2) return 0.0;
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), n), y(b.data(), n);
  const Eigen::ArrayXd dx = x - x.mean(), dy = y - y.mean();
  const double size = std::sqrt(dx.square().sum() * dy.square().sum());
  return size > 0.0 ? (dx * dy).sum() / size : 0.0;
}

double share_inside(const imaging::Geometry& image, const Points& points) {
  const auto inside = std::ranges::count_if(points, [&](const Vec3& p) { return image.contains(p); });
  return static_cast<double>(inside) / static_cast<double>(points.size());
}

}  // namespace

FloatVolume part_about(const imaging::ImageVolume& image, const geometry::Box3& box, double margin_mm) {
  geometry::Box3 inside;
  for (int c = 0; c < 8; ++c)
    inside.extend(image.geometry.index(box.corner(static_cast<geometry::Box3::CornerType>(c))));
  imaging::Region region;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double margin = margin_mm / image.geometry.spacing[axis];
    const auto last = static_cast<double>(image.geometry.size[a]);
    region.lower[a] =
        static_cast<std::int64_t>(std::clamp(std::floor(inside.min()[axis] - margin), 0.0, last));
    region.upper[a] =
        static_cast<std::int64_t>(std::clamp(std::ceil(inside.max()[axis] + margin) + 1.0, 0.0, last));
    if (region.lower[a] >= region.upper[a]) return {};
  }
  const imaging::ImageVolume part = imaging::cropped(image, region);
  return {part.geometry, std::vector<float>(part.voxels.begin(), part.voxels.end())};
}

ImageCage::ImageCage(const geometry::TriMesh& shape, const imaging::ImageVolume& still, int depth,
                     double margin, const core::TaskContext& task) {
  for (int d = 0; d <= depth; ++d) grids_.push_back(geometry::cage_around(shape.points, d, margin));
  const Points normals = geometry::vertex_normals(shape);
  const std::size_t every = (shape.points.size() + most_wall_points - 1) / most_wall_points;
  const FloatVolume part = part_about(still, geometry::bounds(shape.points), image_margin_mm);
  for (std::size_t i = 0; i < shape.points.size(); i += every) points_.push_back(shape.points[i]);
  FloatVolume blurred;
  double sigma = -1.0;
  for (const Stage& stage : stages) {
    if (stage.depth > depth) continue;
    if (stage.sigma_mm != sigma) blurred = imaging::gaussian_blurred(part, stage.sigma_mm, task);
    sigma = stage.sigma_mm;
    ImageCageLevel level;
    level.depth = stage.depth;
    level.sigma_mm = sigma;
    const CageGrid& own = grids_[static_cast<std::size_t>(stage.depth)];
    level.of.resize(own.cell_count());
    for (const double offset : offsets_mm) {
      if (offset > stage.reach_mm) continue;
      for (std::size_t i = 0; i < shape.points.size(); i += every) {
        const Vec3 place = shape.points[i] + offset * normals[i];
        if (!part.geometry.contains(place)) continue;
        level.own.push_back(geometry::cage_point(own, place));
        level.fine.push_back(geometry::cage_point(grid(), place));
        level.of[level.own.back().cell].push_back(static_cast<std::int32_t>(level.places.size()));
        level.places.push_back(place);
        level.values.push_back(imaging::sample(blurred, place));
      }
    }
    levels_.push_back(std::move(level));
  }
}

ImageCageFit ImageCage::fitted(const imaging::ImageVolume& image, const std::vector<Points>& starts,
                               const core::TaskContext& task) const {
  ImageCageFit fit;
  fit.control_points = starts.front();
  geometry::Box3 box;
  for (const Points& start : starts) box.extend(geometry::bounds(carried_points(start)));
  const FloatVolume part = part_about(image, box, image_margin_mm);
  if (part.voxels.empty() || levels_.front().places.empty()) return fit;
  FloatVolume blurred;
  double sigma = -1.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const ImageCageLevel& level = levels_[k];
    if (level.sigma_mm != sigma) blurred = imaging::gaussian_blurred(part, level.sigma_mm, task);
    sigma = level.sigma_mm;
    const ImageCageSolver solver(level, grids_[static_cast<std::size_t>(level.depth)], grid(), blurred);
    for (const Points& start : starts) {
      if (k > 0) break;
      if (&start != &starts.front() && least_jacobian_of(grid(), start) < least_jacobian) continue;
      const double cost = ImageCageSolver::cost_of(solver.differences(start), least_noise_hu);
      if (cost >= least) continue;
      least = cost;
      fit.control_points = start;
    }
    solver.run(fit.control_points, task);
    task.set_progress(static_cast<double>(k + 1) / static_cast<double>(levels_.size()));
    if (k + 1 == levels_.size()) fit.likeness = correlation(level.values, solver.values(fit.control_points));
  }
  fit.inside_share = share_inside(image.geometry, carried_points(fit.control_points));
  return fit;
}

ImageCageFit ImageCage::judged(const imaging::ImageVolume& image, Points control_points,
                               const core::TaskContext& task) const {
  ImageCageFit fit;
  fit.control_points = std::move(control_points);
  const Points carried = carried_points(fit.control_points);
  fit.inside_share = share_inside(image.geometry, carried);
  const ImageCageLevel& level = levels_.back();
  const FloatVolume part = part_about(image, geometry::bounds(carried), image_margin_mm);
  if (part.voxels.empty() || level.places.empty()) return fit;
  const FloatVolume blurred = imaging::gaussian_blurred(part, level.sigma_mm, task);
  const ImageCageSolver solver(level, grids_[static_cast<std::size_t>(level.depth)], grid(), blurred);
  fit.likeness = correlation(level.values, solver.values(fit.control_points));
  return fit;
}

Points ImageCage::carried_points(const Points& control_points) const {
  Points carried;
  carried.reserve(points_.size());
  for (const Vec3& p : points_)
    carried.push_back(geometry::carried(grid(), geometry::cage_point(grid(), p), control_points));
  return carried;
}

}  // namespace ostia::pipeline
