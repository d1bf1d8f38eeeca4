#include "ostia/experiments/mixture_deformation.h"

#include "motion/gauss_sum.h"
#include "motion/kernel_deformation.h"
#include "motion/lbfgs.h"
#include "motion/mixture_distance.h"

#include "ostia/core/error.h"
#include "ostia/geometry/cage.h"

#include <algorithm>
#include <string>

namespace ostia::experiments {
namespace {

using Eigen::VectorXd;
using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr double thinning_widths = 0.25;

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("cannot deform by mixtures: " + what);
}

/// Lengths in which the longest side of the control points' box is from -1 to 1.
struct Units {
  Vec3 centre;
  double mm;  ///< of one
  Points normal(Points points) const {
    for (Vec3& p : points) p = (p - centre) / mm;
    return points;
  }
};

Units units_of(const geometry::CageGrid& grid) {
  const Vec3 sizes = grid.cells * grid.cell_mm;
  return {grid.origin + sizes / 2.0, sizes.maxCoeff() / 2.0};
}

/// Sum of cost and bending at one width.
class Level {
 public:
  Level(const KernelDeformation& deformation, const Points& source, const Points& target, double width,
        const MixtureOptions& options)
      : deformation_(deformation), options_(options) {
    std::vector<std::size_t> kept;
    WeightedCloud cloud = thinned(source, thinning_widths * width, kept);
    cloud_ = deformation.prepared(cloud.points);
    distance_ = std::make_unique<MixtureDistance>(options.cost, cloud.weights,
                                                  thinned(target, thinning_widths * width, kept), width);
  }

  double operator()(const VectorXd& unknowns, VectorXd& gradient) const {
    const Coordinates moved = deformation_.moved(cloud_, unknowns);
    Coordinates by_points;
    const double cost = (*distance_)(moved, by_points);
    gradient = deformation_.gradient(cloud_, by_points);
    if (options_.stiffness <= 0.0) return cost;
    VectorXd by_bending;
    const double bending = deformation_.bending(unknowns, by_bending);
    gradient += options_.stiffness * by_bending;
    return cost + options_.stiffness * bending;
  }

 private:
  const KernelDeformation& deformation_;
  const MixtureOptions& options_;
  KernelDeformation::Prepared cloud_;
  std::unique_ptr<MixtureDistance> distance_;
};

}  // namespace

void validate(const MixtureOptions& options) {
  const auto bad = [](double v, double low, double high) { return !(v >= low && v <= high); };
  if (options.depth < 1 || options.depth > 4) refuse("the control points' depth must be 1 to 4");
  if (bad(options.margin, 0.01, 10.0)) refuse("the margin must be 0.01 to 10");
  if (options.widths_mm.empty()) refuse("there is no width of the Gaussians");
  double before = 1e6;
  for (const double width : options.widths_mm) {
    if (bad(width, 1e-3, before)) refuse("the Gaussians' widths must fall, and be 0.001 mm at least");
    before = width;
  }
  if (bad(options.stiffness, 0.0, 1e9)) refuse("the stiffness must be 0 to 1e9");
  if (bad(options.basis_width_cells, 0.1, 10.0)) refuse("the basis functions' width must be 0.1 to 10 cells");
  if (options.most_iterations < 1 || options.most_iterations > 100000)
    refuse("the iterations must be 1 to 100000");
  if (bad(options.tolerance, 1e-15, 0.999)) refuse("the tolerance must be above 0 and below 1");
}

MixtureDeformation deform_by_mixtures(const geometry::TriMesh& source, const geometry::TriMesh& target,
                                      const MixtureOptions& options, const core::TaskContext& task) {
  validate(options);
  if (source.points.empty() || target.points.empty()) refuse("one of the two surfaces has no points");
  const geometry::CageGrid grid = geometry::cage_around(source.points, options.depth, options.margin);
  const Units units = units_of(grid);
  const KernelDeformation deformation(options.kind, units.normal(rest_points(grid)),
                                      options.basis_width_cells * grid.cell_mm.maxCoeff() / units.mm);
  const Points from = units.normal(source.points), to = units.normal(target.points);
  VectorXd unknowns = VectorXd::Zero(deformation.unknowns());
  MixtureDeformation result;
  const auto levels = static_cast<double>(options.widths_mm.size());
  for (std::size_t i = 0; i < options.widths_mm.size(); ++i) {
    const Level level(deformation, from, to, options.widths_mm[i] / units.mm, options);
    const Minimum found =
        minimise([&](const VectorXd& x, VectorXd& gradient) { return level(x, gradient); }, unknowns,
                 options.most_iterations, options.tolerance,
                 task.sub(static_cast<double>(i) / levels, static_cast<double>(i + 1) / levels));
    unknowns = found.place;
    result.report.iterations += found.iterations;
    result.report.evaluations += found.evaluations;
    result.report.converged = result.report.converged && found.converged;
    result.report.cost = found.value;
  }
  const Coordinates moved = deformation.moved(deformation.prepared(from), unknowns);
  result.surface.triangles = source.triangles;
  for (Eigen::Index i = 0; i < moved.rows(); ++i)
    result.surface.points.emplace_back(units.centre + units.mm * moved.row(i).transpose());
  return result;
}

}  // namespace ostia::experiments
