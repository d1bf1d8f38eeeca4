#include "ostia/evaluation/rigid_alignment.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace ostia::evaluation {
namespace {

using geometry::Mat3;
using geometry::RigidFit;
using geometry::Vec3;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// The squares of the distances, and their linear model in a small turn about `centre` and a shift.
struct Normal {
  double squares = 0.0;
  Mat6 matrix = Mat6::Zero();
  Vec6 slope = Vec6::Zero();

  Normal& operator+=(const Normal& other) {
    squares += other.squares;
    matrix += other.matrix;
    slope += other.slope;
    return *this;
  }
};

Normal model_of(const geometry::AabbTree& surface, const std::vector<Vec3>& points, const RigidFit& motion,
                const Vec3& centre) {
  constexpr double on_surface_mm = 1e-12;  // has no direction, and no say
  return core::parallel_reduce(
      points.size(), std::size_t{512}, Normal(),
      [&](std::size_t first, std::size_t last) {
        Normal sum;
        for (std::size_t i = first; i < last; ++i) {
          const Vec3 at = motion(points[i]);
          const geometry::SurfacePoint near = surface.closest(at);
          if (near.distance < on_surface_mm) continue;
          const Vec3 away = (at - near.point) / near.distance;
          Vec6 row;
          row << (at - centre).cross(away), away;
          sum.squares += near.distance * near.distance;
          sum.matrix += row * row.transpose();
          sum.slope += row * near.distance;
        }
        return sum;
      },
      [](Normal a, const Normal& b) { return a += b; });
}

/// The motion followed by a turn about `centre` and a shift.
RigidFit after(const RigidFit& motion, const Vec6& step, const Vec3& centre) {
  const Vec3 turn = step.head<3>();
  const double angle = turn.norm();
  const Mat3 rotation =
      angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3::Identity();
  return {rotation * motion.rotation, rotation * (motion.shift - centre) + centre + Vec3(step.tail<3>())};
}

void require_usable(const std::vector<Vec3>& points, const AlignmentOptions& options) {
  if (points.size() < 6) throw InvalidInput("alignment: a rigid motion needs six points or more");
  if (!std::all_of(points.begin(), points.end(), [](const Vec3& p) { return p.allFinite(); }))
    throw InvalidInput("alignment: the points must be finite");
  if (options.iterations_max < 1) throw InvalidInput("alignment: iterations_max must be at least 1");
  if (!(options.tolerance_mm > 0.0)) throw InvalidInput("alignment: tolerance_mm must be positive");
}

}  // namespace

double angle_deg(const RigidFit& motion) {
  constexpr double degrees = 57.29577951308232;
  return degrees * Eigen::AngleAxisd(motion.rotation).angle();
}

RigidAlignment align_to(const geometry::AabbTree& surface, const std::vector<Vec3>& points,
                        const AlignmentOptions& options, const core::TaskContext& task) {
  require_usable(points, options);
  const auto count = static_cast<double>(points.size());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / count;
  double reach = 1e-9;
  for (const Vec3& p : points) reach = std::max(reach, (p - mean).norm());
  RigidAlignment out;
  Normal here = model_of(surface, points, out.motion, mean);
  out.rms_before_mm = std::sqrt(here.squares / count);
  double damping = 1e-6;
  while (out.iterations < options.iterations_max && !out.converged) {
    task.throw_if_cancelled();
    ++out.iterations;
    const Vec3 centre = out.motion(mean);
    // Turns and shifts in the same unit, mm at the points furthest out.
    Vec6 weight;
    weight << Vec3::Constant(reach * reach), Vec3::Ones();
    const double scale = std::max(here.matrix.trace() / 6.0, 1e-30);
    Mat6 damped = here.matrix;
    damped.diagonal() += damping * scale / (1.0 + reach * reach) * weight;
    const Vec6 step = -damped.ldlt().solve(here.slope);
    if (!step.allFinite()) break;
    const double largest = step.head<3>().norm() * reach + step.tail<3>().norm();
    const RigidFit next = after(out.motion, step, centre);
    const Normal there = model_of(surface, points, next, next(mean));
    if (there.squares <= here.squares) {
      out.motion = next;
      here = there;
      damping = std::max(damping * 0.1, 1e-12);
      out.converged = largest < options.tolerance_mm;
    } else {
      out.converged = largest < options.tolerance_mm;
      damping *= 10.0;
    }
  }
  out.rms_mm = std::sqrt(here.squares / count);
  return out;
}

}  // namespace ostia::evaluation
