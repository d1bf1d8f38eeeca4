#include "ostia/geometry/rigid_fit.h"

#include "ostia/core/error.h"

#include <Eigen/SVD>

namespace ostia::geometry {
namespace {

Vec3 mean_of_pairs(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& point : points) {
    if (!point.allFinite()) throw InvalidInput("a rigid motion needs points that are finite");
    sum += point;
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace

RigidFit rigid_fit(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  if (from.empty() || from.size() != to.size())
    throw InvalidInput("a rigid motion needs pairs of points; there are " + std::to_string(from.size()) +
                       " and " + std::to_string(to.size()));
  const Vec3 from_middle = mean_of_pairs(from), to_middle = mean_of_pairs(to);
  Mat3 covariance = Mat3::Zero();
  for (std::size_t i = 0; i < from.size(); ++i)
    covariance += (to[i] - to_middle) * (from[i] - from_middle).transpose();
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 proper = Mat3::Identity();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) proper(2, 2) = -1.0;
  RigidFit fit;
  fit.rotation = svd.matrixU() * proper * svd.matrixV().transpose();
  fit.shift = to_middle - fit.rotation * from_middle;
  return fit;
}

}  // namespace ostia::geometry
