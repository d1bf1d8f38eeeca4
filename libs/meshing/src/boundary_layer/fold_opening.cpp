#include "ostia/meshing/fold_opening.h"

#include "boundary_layer/march.h"
#include "boundary_layer/wall.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/meshing/quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

constexpr double least_angle_deg = 20.0;  // that a triangle keeps; below it, it gets no worse
constexpr std::array<double, 3> steps{1.0, 0.5, 0.2};
constexpr double gained = 1e-4;   // of a product: less is no progress
constexpr int rounds_a_ring = 4;  // without success, until one more ring of points may move
constexpr int most_rings = 4;
constexpr double not_seen_below = 1e-7;

/// The wall while its folds are opened.
class FoldOpening {
 public:
  FoldOpening(LayerWall wall, const FoldOptions& options)
      : wall_(std::move(wall)), options_(options), start_(wall_.mesh.points), edges_(ring_edges(wall_)) {
    for (std::size_t v = 0; v < start_.size(); ++v)
      products_.push_back(product(static_cast<std::int32_t>(v)));
  }

  OpenedFolds run(const core::TaskContext& task) {
    task.throw_if_cancelled();
    OpenedFolds report;
    std::set<std::int32_t> sharp = folds();
    report.folds = sharp.size();
    if (sharp.empty()) return report;
    std::set<std::int32_t> movable = sharp;
    widen(movable);
    for (int round = 0, rings = 1; round < options_.max_rounds && !sharp.empty(); ++round) {
      task.throw_if_cancelled();
      const bool moved = sweep(movable);
      sharp = folds();
      if ((moved && round % rounds_a_ring != rounds_a_ring - 1) || sharp.empty()) continue;
      if (++rings > most_rings) break;
      movable.insert(sharp.begin(), sharp.end());
      widen(movable);
    }
    report.closed = sharp.size();
    for (std::size_t v = 0; v < start_.size(); ++v) {
      const double mm = (wall_.mesh.points[v] - start_[v]).norm();
      if (mm > 0.0) ++report.moved;
      if (mm > report.most_moved_mm) report.most_moved_mm = mm, report.place = start_[v];
    }
    return report;
  }

  const std::vector<Vec3>& points() const { return wall_.mesh.points; }

 private:
  std::set<std::int32_t> folds() const {
    std::set<std::int32_t> sharp;
    for (std::size_t v = 0; v < products_.size(); ++v)
      if (products_[v] < options_.open_below && asked(start_[v])) sharp.insert(static_cast<std::int32_t>(v));
    return sharp;
  }

  bool asked(const Vec3& place) const {
    return options_.about.empty() ||
           std::any_of(options_.about.begin(), options_.about.end(),
                       [&](const Vec3& near) { return (place - near).norm() <= options_.about_mm; });
  }

  void widen(std::set<std::int32_t>& points) const {
    const std::set<std::int32_t> old = points;
    for (const std::int32_t v : old)
      for (const std::int32_t u : wall_.neighbours[static_cast<std::size_t>(v)]) points.insert(u);
  }

  /// The largest least product of any direction. Where none sees all triangles that of their mean normal,
  /// which tells how far from it that is.
  double product(std::int32_t v) const {
    const SightCone cone = sight_cone(wall_, edges_, v);
    const double best = least_product(cone, most_visible(cone));
    if (best > not_seen_below) return best;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& m : cone) mean += m;
    return mean.norm() > 0.0 ? std::min(0.0, least_product(cone, mean.normalized())) : -1.0;
  }

  double least_angle_about(std::int32_t v) const {
    double least = 180.0;
    for (const std::int32_t f : wall_.triangles_of[static_cast<std::size_t>(v)]) {
      const geometry::Triangle& t = wall_.mesh.triangles[static_cast<std::size_t>(f)];
      least = std::min(least, min_angle_deg(wall_.point(t[0]), wall_.point(t[1]), wall_.point(t[2])));
    }
    return least;
  }

  /// The sharpest folds first: the products of a point and its neighbours in order.
  std::vector<double> standing(std::int32_t v) const {
    std::vector<double> all{product(v)};
    for (const std::int32_t u : wall_.neighbours[static_cast<std::size_t>(v)]) all.push_back(product(u));
    std::sort(all.begin(), all.end());
    return all;
  }
  /// What counts of a fold: how far it is from open.
  double worth(const std::vector<double>& products) const {
    double sum = 0.0;
    for (const double p : products) {
      const double lacks = std::max(0.0, options_.open_below - p);
      sum += lacks * lacks;
    }
    return sum;
  }

  Vec3 within_reach(std::int32_t v, const Vec3& place) const {
    const auto i = static_cast<std::size_t>(v);
    const double most = options_.most_moved * wall_.local_edge_mm[i];
    const Vec3 way = place - start_[i];
    return way.norm() > most ? Vec3(start_[i] + most * way.normalized()) : place;
  }

  bool move(std::int32_t v) {
    const auto i = static_cast<std::size_t>(v);
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t u : wall_.neighbours[i]) middle += wall_.point(u);
    middle /= static_cast<double>(wall_.neighbours[i].size());
    const Vec3 before = wall_.mesh.points[i];
    const double worth_before = worth(standing(v));
    if (worth_before <= 0.0) return false;
    const double angle = std::min(least_angle_deg, least_angle_about(v) - 1e-9);
    Vec3 best = before;
    double least = worth_before - gained * gained;
    for (const double step : steps) {
      wall_.mesh.points[i] = within_reach(v, before + step * (middle - before));
      if (least_angle_about(v) < angle) continue;
      const double now = worth(standing(v));
      if (now < least) least = now, best = wall_.mesh.points[i];
    }
    wall_.mesh.points[i] = best;
    if (best == before) return false;
    products_[i] = product(v);
    for (const std::int32_t u : wall_.neighbours[i]) products_[static_cast<std::size_t>(u)] = product(u);
    return true;
  }

  bool sweep(const std::set<std::int32_t>& movable) {
    bool moved = false;
    for (const std::int32_t v : movable)
      if (wall_.ring_of[static_cast<std::size_t>(v)] < 0) moved = move(v) || moved;
    return moved;
  }

  LayerWall wall_;
  FoldOptions options_;
  std::vector<Vec3> start_;
  std::vector<SightCone> edges_;  // of the rings, in their caps' planes
  std::vector<double> products_;
};

}  // namespace

void validate(const FoldOptions& o) {
  const auto refuse = [](const std::string& what) { throw InvalidInput("opening folds: " + what); };
  if (!(o.open_below > 0.0 && o.open_below <= 0.5))
    refuse("open_below " + std::to_string(o.open_below) + " must lie in (0, 0.5]");
  if (!(o.most_moved > 0.0 && o.most_moved <= 2.0))
    refuse("most_moved " + std::to_string(o.most_moved) + " must lie in (0, 2] local edges");
  if (o.max_rounds < 1 || o.max_rounds > 1000)
    refuse("max_rounds " + std::to_string(o.max_rounds) + " must lie in [1, 1000]");
  if (!(o.about_mm > 0.0)) refuse("about_mm " + std::to_string(o.about_mm) + " must be above 0");
}

OpenedFolds open_folds(geometry::FacedSurface& surface, const FoldOptions& options,
                       const core::TaskContext& task) {
  validate(options);
  std::vector<std::int32_t> numbers;
  FoldOpening opening(layer_wall(surface, &numbers), options);
  OpenedFolds report = opening.run(task);
  if (report.moved == 0) return report;
  geometry::FacedSurface opened = surface;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] >= 0) opened.mesh.points[i] = opening.points()[static_cast<std::size_t>(numbers[i])];
  if (!geometry::self_intersections(opened.mesh).empty()) {
    report.closed = report.folds;
    report.moved = 0;
    report.most_moved_mm = 0.0;
    return report;
  }
  surface = std::move(opened);
  report.warnings.push_back(
      "the wall's sharpest folds were rounded off for layers to grow there: " + std::to_string(report.moved) +
      " points moved, by " + core::rounded_text(report.most_moved_mm, 2) + " mm at most, near " +
      place_text(report.place));
  return report;
}

}  // namespace ostia::meshing
