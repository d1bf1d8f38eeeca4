#include "ostia/geometry/thin_plate_spline.h"

#include "ostia/core/error.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::geometry {
namespace {

constexpr std::size_t most_landmarks = 4000;

/// R^2 log R, from R^2.
double kernel(double squared) {
  return squared > 0.0 ? 0.5 * squared * std::log(squared) : 0.0;
}

void check(const std::vector<Vec3>& sources, const std::vector<Vec3>& targets) {
  const auto refuse = [](const std::string& what) { throw InvalidInput("thin-plate spline: " + what); };
  if (sources.size() != targets.size())
    refuse(std::to_string(sources.size()) + " sources, but " + std::to_string(targets.size()) + " targets");
  if (sources.size() < 4 || sources.size() > most_landmarks)
    refuse(std::to_string(sources.size()) + " landmarks; 4 to " + std::to_string(most_landmarks) +
           " are needed");
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (!sources[i].allFinite() || !targets[i].allFinite())
      refuse("landmark " + std::to_string(i) + " is not finite");
}

}  // namespace

ThinPlateSpline::ThinPlateSpline(const std::vector<Vec3>& sources, const std::vector<Vec3>& targets) {
  check(sources, targets);
  const auto n = static_cast<Eigen::Index>(sources.size());
  for (const Vec3& p : sources) centre_ += p / static_cast<double>(n);
  double widest = 0.0;
  for (const Vec3& p : sources) widest = std::max(widest, (p - centre_).norm());
  scale_ = widest > 0.0 ? widest : 1.0;
  for (const Vec3& p : sources) sources_.push_back((p - centre_) / scale_);

  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 4, n + 4);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n + 4, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (Eigen::Index j = 0; j < i; ++j)
      system(i, j) = system(j, i) =
          kernel((sources_[k] - sources_[static_cast<std::size_t>(j)]).squaredNorm());
    system.block<1, 4>(i, n) << 1.0, sources_[k].transpose();
    system.block<4, 1>(n, i) = system.block<1, 4>(i, n).transpose();
    right.row(i) = ((targets[k] - centre_) / scale_).transpose();
  }
  const Eigen::MatrixXd solved = system.partialPivLu().solve(right);
  // Sources that coincide, or lie in one plane, leave no solution: it shows in what comes out.
  if (!solved.allFinite() || !((system * solved - right).cwiseAbs().maxCoeff() < 1e-8))
    throw GeometryError("thin-plate spline: two landmarks coincide, or all lie in one plane");
  for (Eigen::Index i = 0; i < n; ++i) weights_.emplace_back(solved.row(i).transpose());
  affine_ = solved.bottomRows<4>().transpose();
}

Vec3 ThinPlateSpline::operator()(const Vec3& point) const {
  const Vec3 p = (point - centre_) / scale_;
  Vec3 sum = affine_.col(0) + affine_.rightCols<3>() * p;
  for (std::size_t i = 0; i < sources_.size(); ++i)
    sum += kernel((p - sources_[i]).squaredNorm()) * weights_[i];
  return centre_ + scale_ * sum;
}

}  // namespace ostia::geometry
