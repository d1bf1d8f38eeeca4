#include "ostia/analysis/tree_growth.h"
#include "ostia/core/error.h"
#include "ostia/geometry/aabb_tree.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace ostia::analysis {
namespace {

using geometry::Vec3;

/// About the distance to an ellipsoid of revolution, positive inside: (1 - q) / |grad q| with q = 1 on it.
double depth_in(double across, double along, double radius, double length) {
  const double x = across / radius, z = along / length;
  const double gradient = 2.0 * std::hypot(x / radius, z / length);
  const double most = std::min(radius, length);
  const double off = 1.0 - x * x - z * z;
  return gradient * most > std::abs(off) ? off / gradient : std::copysign(most, off);
}

}  // namespace

GrowthDomain domain_of(const MyocardialShell& shell) {
  const double least = std::min(shell.length_mm, shell.radius_mm);
  if (!shell.base.allFinite() || !(shell.axis.norm() > 0.0) || !std::isfinite(shell.axis.norm()) ||
      !(shell.wall_mm > 0.0) || !(least > shell.wall_mm) || !std::isfinite(shell.length_mm + shell.radius_mm))
    throw InvalidInput(
        "a wall of " + std::to_string(shell.wall_mm) + " mm in a heart of length " +
        std::to_string(shell.length_mm) + " mm and radius " + std::to_string(shell.radius_mm) +
        " mm makes no shell; the wall must be the least of the three, and above 0. Is the tree in mm? "
        "`ostia convert --units m --radius-units mm` brings it there");
  const Vec3 axis = shell.axis.normalized();
  return [shell, axis](const Vec3& point) {
    const Vec3 off = point - shell.base;
    const double along = off.dot(axis), across = (off - along * axis).norm();
    const double outer = depth_in(across, along, shell.radius_mm, shell.length_mm);
    const double inner =
        -depth_in(across, along, shell.radius_mm - shell.wall_mm, shell.length_mm - shell.wall_mm);
    const double depth = std::min(outer, inner);
    return shell.whole ? depth : std::min(depth, along);
  };
}

GrowthDomain domain_of(const geometry::TriMesh& closed) {
  if (closed.triangles.empty()) throw InvalidInput("growth: the surface to grow in has no triangles");
  const auto tree = std::make_shared<const geometry::AabbTree>(closed);
  return [tree](const Vec3& point) { return -tree->signed_distance(point); };
}

MyocardialShell shell_about(const geometry::VesselGraph& graph, double wall_mm) {
  // |p|^2 = 2 c.p + (R^2 - |c|^2), linear in the centre and the last term; about the mean for its condition.
  const auto count = static_cast<Eigen::Index>(graph.points.size());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : graph.points)
    mean += point / static_cast<double>(std::max<Eigen::Index>(count, 1));
  Eigen::MatrixXd left(count, 4);
  Eigen::VectorXd right(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3 p = graph.points[static_cast<std::size_t>(i)] - mean;
    left.row(i) << 2.0 * p.transpose(), 1.0;
    right[i] = p.squaredNorm();
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver;
  if (count >= 4 && left.allFinite()) {
    solver.setThreshold(1e-6);
    solver.compute(left);
  }
  if (count < 4 || !left.allFinite() || solver.rank() < 4)
    throw InvalidInput(
        "no sphere can be laid about the tree: its points lie in a plane, are too few or are "
        "no places in space; give the surface of the myocardium");
  const Eigen::Vector4d fit = solver.solve(right);
  MyocardialShell shell;
  shell.base = mean + fit.head<3>();
  shell.radius_mm = shell.length_mm = std::sqrt(std::max(0.0, fit[3] + fit.head<3>().squaredNorm()));
  shell.wall_mm = wall_mm;
  shell.whole = true;
  return shell;
}

}  // namespace ostia::analysis
