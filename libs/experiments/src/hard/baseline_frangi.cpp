#include "hard/baseline_frangi.h"

#include "ostia/core/parallel.h"
#include "ostia/imaging/filters.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::experiments {
namespace {

/// Second derivatives of one scale in the image's own axes, times the scale's variance.
class ScaleHessian {
 public:
  ScaleHessian(const imaging::FloatVolume& blurred, double sigma_mm)
      : field_(blurred), row_(blurred.geometry.size[0]), slice_(row_ * blurred.geometry.size[1]) {
    const geometry::Vec3& h = blurred.geometry.spacing;
    for (int a = 0; a < 3; ++a) {
      pure_[a] = sigma_mm * sigma_mm / (h[a] * h[a]);
      const int b = (a + 1) % 3;
      mixed_[a] = sigma_mm * sigma_mm / (4.0 * h[a] * h[b]);
    }
  }
  /// At an inner voxel.
  Eigen::Matrix3d at(std::int64_t offset) const {
    const std::array<std::int64_t, 3> step{1, row_, slice_};
    const float* f = field_.voxels.data() + offset;
    Eigen::Matrix3d hessian;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const std::int64_t u = step[static_cast<std::size_t>(a)], v = step[static_cast<std::size_t>(b)];
      hessian(a, a) = pure_[a] * (double(f[u]) - 2.0 * f[0] + f[-u]);
      hessian(a, b) = hessian(b, a) = mixed_[a] * (double(f[u + v]) - f[u - v] - f[v - u] + f[-u - v]);
    }
    return hessian;
  }

 private:
  const imaging::FloatVolume& field_;
  std::int64_t row_, slice_;
  geometry::Vec3 pure_, mixed_;
};

/// Calls visit(offset) for each voxel of a slice that has all its neighbours.
template <class Visit>
void for_inner(const imaging::Geometry& grid, std::int64_t k, const Visit& visit) {
  for (std::int64_t j = 1; j + 1 < grid.size[1]; ++j)
    for (std::int64_t i = 1; i + 1 < grid.size[0]; ++i) visit(grid.offset(i, j, k));
}

double largest_norm(const ScaleHessian& hessian, const imaging::Geometry& grid) {
  const auto slices = static_cast<std::size_t>(std::max<std::int64_t>(grid.size[2] - 2, 0));
  return core::parallel_reduce(
      slices, 4, 0.0,
      [&](std::size_t first, std::size_t last) {
        double most = 0.0;
        for (std::size_t k = first; k < last; ++k)
          for_inner(grid, static_cast<std::int64_t>(k) + 1,
                    [&](std::int64_t at) { most = std::max(most, hessian.at(at).squaredNorm()); });
        return std::sqrt(most);
      },
      [](double a, double b) { return std::max(a, b); });
}

/// 0 where it could not be more than `least`, too.
double tube_answer(const Eigen::Matrix3d& hessian, double c, double least, const FrangiOptions& options) {
  if (hessian.trace() >= 0.0) return 0.0;  // l2 and l3 are not both below 0, or |l1| is the largest
  const double strength = 1.0 - std::exp(-0.5 * hessian.squaredNorm() / (c * c));
  if (strength <= least) return 0.0;  // the other factors are 1 at most
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(hessian, Eigen::EigenvaluesOnly);
  std::array<double, 3> l{solver.eigenvalues()[0], solver.eigenvalues()[1], solver.eigenvalues()[2]};
  std::ranges::sort(l, {}, [](double value) { return std::abs(value); });
  if (l[1] >= 0.0 || l[2] >= 0.0) return 0.0;
  const double a = l[1] / l[2], b2 = l[0] * l[0] / (l[1] * l[2]);
  const double plate = 1.0 - std::exp(-0.5 * a * a / (options.alpha * options.alpha));
  const double blob = std::exp(-0.5 * b2 / (options.beta * options.beta));
  return plate * blob * strength;
}

}  // namespace

imaging::FloatVolume frangi_vesselness(const imaging::ImageVolume& image, const FrangiOptions& options,
                                       const core::TaskContext& task) {
  const imaging::Geometry& grid = image.geometry;
  const imaging::FloatVolume source{grid, {image.voxels.begin(), image.voxels.end()}};
  imaging::FloatVolume best{grid, std::vector<float>(image.voxels.size(), 0.0F)};
  const double scales = static_cast<double>(options.sigmas_mm.size());
  for (std::size_t n = 0; n < options.sigmas_mm.size(); ++n) {
    const auto done = static_cast<double>(n);
    const core::TaskContext part = task.sub(done / scales, (done + 1.0) / scales);
    const double sigma = options.sigmas_mm[n];
    const imaging::FloatVolume blurred = imaging::gaussian_blurred(source, sigma, part.sub(0.0, 0.4));
    const ScaleHessian hessian(blurred, sigma);
    const double c = options.c_share * largest_norm(hessian, grid);
    part.throw_if_cancelled();
    if (!(c > 0.0)) continue;
    core::parallel_for(static_cast<std::size_t>(std::max<std::int64_t>(grid.size[2] - 2, 0)), 1,
                       [&](std::size_t k) {
                         for_inner(grid, static_cast<std::int64_t>(k) + 1, [&](std::int64_t at) {
                           float& value = best.voxels[static_cast<std::size_t>(at)];
                           value = std::max(value, float(tube_answer(hessian.at(at), c, value, options)));
                         });
                       });
    part.set_progress(1.0);
    part.throw_if_cancelled();
  }
  return best;
}

}  // namespace ostia::experiments
