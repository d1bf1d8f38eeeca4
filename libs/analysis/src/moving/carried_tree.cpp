// A tree that goes with a cage.

#include "moving/smooth_cage.h"
#include "names/tree_paths.h"

#include "ostia/analysis/moving_tree.h"
#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/frame.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace ostia::analysis {
namespace {

constexpr double least_pieces = 16.0;  // of a branch: a polynomial of degree 5 has points to spare

/// All branches' points in one row, and points beside them.
struct Cloud {
  std::vector<Vec3> axis, beside;
  std::vector<std::size_t> first;  ///< of each branch
};

void add_branch(const BranchPath& path, double step_mm, MovingTree& tree, Cloud& cloud,
                std::vector<double>& node_s) {
  std::vector<std::size_t> nodes;
  const geometry::Centerline line = joined(path, &nodes);
  const geometry::AxisCurve curve(line);
  const geometry::Centerline sampled = curve.sampled(std::min(step_mm, curve.length() / least_pieces));
  const double share = curve.length() / line.abscissa.back();  // chords are shorter by a common, small share
  for (const std::size_t i : nodes) node_s.push_back(share * line.abscissa[i]);
  cloud.first.push_back(cloud.axis.size());
  // The frames that twist is measured against (motion_branch.cpp), so that it is 0 here in sharp bends too.
  const std::vector<geometry::Frame> frames = geometry::rotation_minimising_frames(
      sampled.points, geometry::tangents(sampled.points), sampled.frames.front().normal);
  for (std::size_t i = 0; i < sampled.size(); ++i) {
    cloud.axis.push_back(sampled.points[i]);
    cloud.beside.emplace_back(sampled.points[i] + sampled.radius[i] * frames[i].normal);
  }
  tree.branches.push_back(
      {path.vessel, path.name, sampled.abscissa, sampled.radius, sampled.points, {}, {}, {}, {}});
}

std::vector<Vec3> cut(const std::vector<Vec3>& all, std::size_t first, std::size_t count) {
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

/// Points moved by the smooth reading of the cage.
class SmoothlyCarried {
 public:
  SmoothlyCarried(const geometry::CageGrid& grid, const std::vector<Vec3>& points)
      : cage_(grid), points_(points) {
    for (const Vec3& p : points) weights_.push_back(cage_.weights(p));
  }
  std::vector<Vec3> places(const std::vector<Vec3>& displacements) const {
    std::vector<Vec3> result(points_.size());
    core::parallel_for(points_.size(), 512, [&](std::size_t i) {
      result[i] = points_[i] + cage_.displacement(weights_[i], displacements);
    });
    return result;
  }

 private:
  SmoothCage cage_;
  const std::vector<Vec3>& points_;
  std::vector<SmoothCage::Weights> weights_;
};

}  // namespace

MovingTree carried_tree(const geometry::VesselTree& rest, const motion::MovingCage& cage,
                        const std::vector<double>& phases, double step_mm, const core::TaskContext& task) {
  if (const auto fault = geometry::find_fault(rest)) throw InvalidInput("the tree: " + *fault);
  if (rest.segments.empty()) throw InvalidInput("the tree has no axes");
  if (!(step_mm >= 0.05 && step_mm <= 5.0))
    throw InvalidInput("axes are sampled every 0.05 to 5 mm, not every " + std::to_string(step_mm) + " mm");
  MovingTree tree{cage.template_phase(), phases, {}, {}, {}};
  const std::vector<BranchPath> paths = branch_paths(rest);
  std::vector<std::vector<double>> node_s(paths.size());
  Cloud cloud;
  for (std::size_t b = 0; b < paths.size(); ++b) add_branch(paths[b], step_mm, tree, cloud, node_s[b]);
  tree.joints = joints_of(paths, node_s, tree.branches);

  const motion::CarriedPoints carried(cage.grid(), cloud.axis);
  if (std::string warning = motion::judge_outside(carried, "the axes"); !warning.empty())
    tree.warnings.push_back(std::move(warning));
  const SmoothlyCarried axis(cage.grid(), cloud.axis), beside(cage.grid(), cloud.beside);
  const std::vector<Vec3> at_rest = geometry::rest_points(cage.grid());
  for (std::size_t k = 0; k < phases.size(); ++k) {
    task.throw_if_cancelled();
    std::vector<Vec3> displacements = cage.at(phases[k]);
    const std::vector<Vec3> places = carried.places(displacements),
                            rates = carried.rates(cage.rate(phases[k]));
    for (std::size_t i = 0; i < displacements.size(); ++i) displacements[i] -= at_rest[i];
    const std::vector<Vec3> shape = axis.places(displacements), sides = beside.places(displacements);
    for (std::size_t b = 0; b < paths.size(); ++b) {
      MovingBranch& branch = tree.branches[b];
      const std::size_t first = cloud.first[b], count = branch.rest.size();
      branch.places.push_back(cut(places, first, count));
      branch.rates.push_back(cut(rates, first, count));
      branch.shape.push_back(cut(shape, first, count));
      branch.beside.push_back(cut(sides, first, count));
    }
    task.set_progress(static_cast<double>(k + 1) / static_cast<double>(phases.size()));
  }
  validate(tree);
  return tree;
}

}  // namespace ostia::analysis
