#include "moving/smooth_motion.h"

#include "moving/motion_parts.h"

#include "ostia/core/parallel.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr double across_mm = 0.3, along_mm = 1.0;  // deviations of the displacements
constexpr double bending_mm = 10.0;                // deviation of what is not affine
constexpr double shift_mm = 100.0, slope = 1.0;    // of the affine part: hardly a bound
constexpr double least_axis_step_mm = 2.5;
constexpr double most_places = 250.0;

struct Place {
  std::size_t branch, point;
};

/// Evenly along all branches, one after the other.
std::vector<Place> places_of(const MovingTree& tree) {
  double length = 0.0;
  for (const MovingBranch& branch : tree.branches) length += branch.s_mm.back();
  const double step = std::max(least_axis_step_mm, length / most_places);
  std::vector<Place> places;
  double before = 0.0, next = 0.0;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const std::vector<double>& s = tree.branches[b].s_mm;
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (before + s[i] < next) continue;
      places.push_back({b, i});
      next = std::max(next + step, before + s[i] + 0.5 * step);
    }
    before += s.back();
  }
  return places;
}

/// How displacements at two places go together, mm^2, each axis for itself.
class Kernel {
 public:
  explicit Kernel(const Vec3& centre) : centre_(centre) {}
  double operator()(const Vec3& a, const Vec3& b) const {
    const double way = (a - b).squaredNorm() / (common_length_mm * common_length_mm);
    return shift_mm * shift_mm + slope * slope * (a - centre_).dot(b - centre_) +
           bending_mm * bending_mm * std::exp(-0.5 * way);
  }

 private:
  Vec3 centre_;
};

Vec3 tangent_at(const std::vector<Vec3>& points, std::size_t i) {
  const Vec3 step = points[std::min(i + 1, points.size() - 1)] - points[i > 0 ? i - 1 : 0];
  return step.norm() > 0.0 ? Vec3(step.normalized()) : Vec3(Vec3::Zero());
}

class Smoother {
 public:
  explicit Smoother(const MovingTree& tree)
      : tree_(tree), places_(places_of(tree)), kernel_(centre()), own_(between(rest_of(places_))) {
    for (const MovingBranch& branch : tree.branches) to_.push_back(between(branch.rest));
  }

  /// All branches at phase k.
  std::vector<std::vector<Vec3>> at(std::size_t k) const {
    const auto count = static_cast<Eigen::Index>(places_.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    Eigen::VectorXd values(3 * count);
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; b < count; ++b)
        matrix.block<3, 3>(3 * a, 3 * b).diagonal().setConstant(own_(a, b));
      const Place& place = places_[static_cast<std::size_t>(a)];
      const MovingBranch& branch = tree_.branches[place.branch];
      const std::vector<Vec3>& points = shape_of(branch)[k];
      const Vec3 tangent = tangent_at(points, place.point);
      matrix.block<3, 3>(3 * a, 3 * a) +=
          across_mm * across_mm * Eigen::Matrix3d::Identity() +
          (along_mm * along_mm - across_mm * across_mm) * tangent * tangent.transpose();
      values.segment<3>(3 * a) = points[place.point] - branch.rest[place.point];
    }
    const Eigen::VectorXd weights = matrix.llt().solve(values);
    const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> columns(weights.data(), 3, count);
    std::vector<std::vector<Vec3>> places;
    for (std::size_t b = 0; b < to_.size(); ++b) {
      const Eigen::Matrix<double, 3, Eigen::Dynamic> moved = columns * to_[b].transpose();
      places.push_back(tree_.branches[b].rest);
      for (std::size_t i = 0; i < places.back().size(); ++i)
        places.back()[i] += moved.col(static_cast<Eigen::Index>(i));
    }
    return places;
  }

 private:
  std::vector<Vec3> rest_of(const std::vector<Place>& places) const {
    std::vector<Vec3> points;
    for (const Place& place : places) points.push_back(tree_.branches[place.branch].rest[place.point]);
    return points;
  }
  Vec3 centre() const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : rest_of(places_)) sum += p;
    return sum / static_cast<double>(places_.size());
  }
  /// [point][place]
  Eigen::MatrixXd between(const std::vector<Vec3>& points) const {
    const std::vector<Vec3> places = rest_of(places_);
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(points.size()),
                           static_cast<Eigen::Index>(places.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t a = 0; a < places.size(); ++a)
        matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a)) = kernel_(points[i], places[a]);
    return matrix;
  }

  const MovingTree& tree_;
  std::vector<Place> places_;
  Kernel kernel_;
  Eigen::MatrixXd own_;
  std::vector<Eigen::MatrixXd> to_;  ///< of each branch
};

}  // namespace

std::vector<PhasePoints> smooth_motion(const MovingTree& tree, const core::TaskContext& task) {
  const Smoother smoother(tree);
  std::vector<PhasePoints> all(tree.branches.size(), PhasePoints(tree.phases.size()));
  core::parallel_for(tree.phases.size(), 1, [&](std::size_t k) {
    task.throw_if_cancelled();
    std::vector<std::vector<Vec3>> places = smoother.at(k);
    for (std::size_t b = 0; b < all.size(); ++b) all[b][k] = std::move(places[b]);
  });
  return all;
}

}  // namespace ostia::analysis
