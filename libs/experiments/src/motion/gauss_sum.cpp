#include "motion/gauss_sum.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/kd_tree.h"

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

constexpr double reach_widths = 6.0;
constexpr std::size_t grain = 128;

}  // namespace

std::array<int, 3> GaussSum::cell(const Vec3& p) const {
  std::array<int, 3> c{};
  for (int axis = 0; axis < 3; ++axis)
    c[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::clamp(std::floor((p[axis] - low_[axis]) / reach_), -2.0, 1e6));
  return c;
}

std::size_t GaussSum::start(const std::array<int, 3>& c) const {
  return static_cast<std::size_t>(c[0]) +
         static_cast<std::size_t>(cells_[0]) *
             (static_cast<std::size_t>(c[1]) +
              static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(c[2]));
}

GaussSum::GaussSum(const WeightedCloud& cloud, double width) : width_(width), reach_(reach_widths * width) {
  geometry::Box3 box;
  for (const Vec3& p : cloud.points) box.extend(p);
  low_ = box.min();
  // A cloud that is thrown far apart must not ask for all memory: wider cells are as right.
  reach_ = std::max(reach_, box.sizes().maxCoeff() / 256.0);
  cells_ = cell(box.max());
  for (int& n : cells_) ++n;
  starts_.assign(start({0, 0, cells_[2]}) + 1, 0);
  std::vector<std::size_t> of(cloud.points.size());
  for (std::size_t i = 0; i < of.size(); ++i) {
    of[i] = start(cell(cloud.points[i]));
    ++starts_[of[i] + 1];
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end());
  sorted_.points.resize(of.size());
  sorted_.weights.resize(of.size());
  for (std::size_t i = 0; i < of.size(); ++i) {
    const std::uint32_t at = next[of[i]]++;
    sorted_.points[at] = cloud.points[i];
    sorted_.weights[at] = cloud.weights[i];
  }
}

double GaussSum::operator()(const WeightedCloud& other, std::vector<Vec3>* by_points) const {
  if (by_points != nullptr) by_points->assign(other.points.size(), Vec3::Zero());
  const double farthest = reach_widths * reach_widths * width_ * width_,
               scale = 1.0 / (4.0 * width_ * width_);
  const double least = std::exp(-farthest * scale);
  const auto of_point = [&](std::size_t i) {
    const Vec3& p = other.points[i];
    const std::array<int, 3> c = cell(p);
    double sum = 0.0;
    Vec3 pull = Vec3::Zero();
    const int from = std::max(0, c[0] - 1), to = std::min(cells_[0] - 1, c[0] + 1);
    if (from > to) return 0.0;
    for (int k = std::max(0, c[2] - 1); k <= std::min(cells_[2] - 1, c[2] + 1); ++k)
      for (int j = std::max(0, c[1] - 1); j <= std::min(cells_[1] - 1, c[1] + 1); ++j)
        for (std::size_t q = starts_[start({from, j, k})]; q < starts_[start({to, j, k}) + 1]; ++q) {
          const Vec3 way = sorted_.points[q] - p;
          const double squared = way.squaredNorm();
          if (squared >= farthest) continue;
          const double value = sorted_.weights[q] * std::exp(-squared * scale);
          sum += value - sorted_.weights[q] * least;
          pull += value * way;
        }
    if (by_points != nullptr) (*by_points)[i] = other.weights[i] * 2.0 * scale * pull;
    return other.weights[i] * sum;
  };
  return core::parallel_reduce(
      other.points.size(), grain, 0.0,
      [&](std::size_t first, std::size_t last) {
        double sum = 0.0;
        for (std::size_t i = first; i < last; ++i) sum += of_point(i);
        return sum;
      },
      [](double a, double b) { return a + b; });
}

WeightedCloud thinned(const std::vector<Vec3>& points, double spacing, std::vector<std::size_t>& kept) {
  const geometry::KdTree tree(points);
  WeightedCloud cloud;
  kept.clear();
  std::vector<char> taken(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (taken[i] != 0) continue;
    kept.push_back(i);
    cloud.points.push_back(points[i]);
    for (const std::int32_t near : tree.within(points[i], spacing)) taken[static_cast<std::size_t>(near)] = 1;
  }
  cloud.weights.assign(kept.size(), 0.0);
  const geometry::KdTree left(cloud.points);
  for (const Vec3& p : points)
    cloud.weights[static_cast<std::size_t>(left.nearest(p))] += 1.0 / static_cast<double>(points.size());
  return cloud;
}

}  // namespace ostia::experiments
