#include "motion/unfolding.h"

#include "intake/intake_ends.h"

#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/smoothing.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr int unfolding_rounds = 5;
constexpr int unfolding_steps = 30;  // of the filter; each round has as many more
constexpr double unfolding_pass_band = 0.05;
constexpr int rings_at_first = 3, rings_more = 2;
// A wall that crosses itself about this share of its points, and has so many, is rough all over.
constexpr double rough_share = 0.2;
constexpr std::size_t fewest_rough_points = 200;
constexpr double worth_while =
    0.2;  // smoothing all of it pays where no more than this share of crossings stays

/// Pairs of triangles of one part: parts that run through each other are no folds.
Crossings folds_among(Crossings crossings, const std::vector<std::int32_t>& part) {
  std::erase_if(crossings, [&](const auto& pair) {
    return part[static_cast<std::size_t>(pair.first)] != part[static_cast<std::size_t>(pair.second)];
  });
  return crossings;
}

Crossings folds_of(const TriMesh& mesh, const std::vector<std::int32_t>& part) {
  return folds_among(geometry::self_intersections(mesh), part);
}

/// The points of a surface that may move.
class MovingPoints {
 public:
  explicit MovingPoints(const TriMesh& mesh)
      : mesh_(mesh), neighbours_(geometry::vertex_neighbours(mesh)), moves_(mesh.points.size(), false) {}

  void add(const Crossings& crossings, int rings) {
    std::vector<std::int32_t> front;
    for (const auto& [a, b] : crossings)
      for (const std::int32_t t : {a, b})
        for (const std::int32_t p : mesh_.triangles[static_cast<std::size_t>(t)]) front.push_back(p);
    for (int ring = 0; ring <= rings; ++ring) {
      std::vector<std::int32_t> next;
      for (const std::int32_t p : front) {
        moves_[static_cast<std::size_t>(p)] = true;
        const auto& around = neighbours_[static_cast<std::size_t>(p)];
        next.insert(next.end(), around.begin(), around.end());
      }
      std::ranges::sort(next);
      next.erase(std::unique(next.begin(), next.end()), next.end());
      front = std::move(next);
    }
  }
  void add_all() { moves_.assign(moves_.size(), true); }

  double share() const {
    return static_cast<double>(std::ranges::count(moves_, true)) / static_cast<double>(moves_.size());
  }
  const std::vector<bool>& flags() const { return moves_; }

  /// Those that hang together with the points of a crossing become what they were.
  void put_back(const Crossings& crossings, const std::vector<Vec3>& before,
                std::vector<Vec3>& points) const {
    geometry::DisjointSets sets(moves_.size());
    for (std::size_t p = 0; p < moves_.size(); ++p)
      for (const std::int32_t n : neighbours_[p])
        if (moves_[p] && moves_[static_cast<std::size_t>(n)]) sets.join(static_cast<std::int32_t>(p), n);
    std::vector<bool> crossed(moves_.size(), false);
    for (const auto& [a, b] : crossings)
      for (const std::int32_t t : {a, b})
        for (const std::int32_t p : mesh_.triangles[static_cast<std::size_t>(t)])
          crossed[static_cast<std::size_t>(sets.find(p))] = true;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (crossed[static_cast<std::size_t>(sets.find(static_cast<std::int32_t>(p)))]) points[p] = before[p];
  }

 private:
  const TriMesh& mesh_;
  std::vector<std::vector<std::int32_t>> neighbours_;
  std::vector<bool> moves_;
};

void measure_moves(const std::vector<Vec3>& before, const std::vector<Vec3>& after, Unfolded& out) {
  double sum = 0.0;
  std::size_t moved = 0;
  for (std::size_t p = 0; p < before.size(); ++p) {
    const double mm = (after[p] - before[p]).norm();
    if (!(mm > 0.0)) continue;
    sum += mm;
    ++moved;
    if (mm > out.most_mm) out.most_mm = mm, out.where = before[p];
  }
  if (moved > 0) out.mean_mm = sum / static_cast<double>(moved);
}

}  // namespace

std::string Unfolded::text() const {
  return "moved by " + core::fixed_text(mean_mm, 2) + " mm in the mean, " + core::fixed_text(most_mm, 2) +
         " mm at most, at " + place_text(where);
}

Unfolded unfold(TriMesh& mesh, KnownCrossings& known, const core::TaskContext& task) {
  Unfolded out;
  const std::vector<std::int32_t> part = geometry::components(mesh);
  if (!known) known = geometry::self_intersections(mesh);
  Crossings crossings = folds_among(*known, part);
  if (crossings.empty()) return out;
  const std::size_t at_first = crossings.size();
  const TriMesh before = mesh;
  MovingPoints moving(before);
  moving.add(crossings, rings_at_first);
  for (int round = 1; round <= unfolding_rounds; ++round) {
    task.throw_if_cancelled();
    if (moving.share() > rough_share && before.points.size() >= fewest_rough_points) out.everywhere = true;
    if (out.everywhere) moving.add_all();
    geometry::VolumeSmoothingOptions how;
    how.filter = {.iterations = round * unfolding_steps, .pass_band = unfolding_pass_band};
    how.free = moving.flags();
    how.borders_move = true;
    mesh = geometry::smoothed_in_volume(before, how, task);
    crossings = folds_of(mesh, part);
    if (crossings.empty()) break;
    if (round < unfolding_rounds) moving.add(crossings, rings_more + round);
  }
  if (!crossings.empty() && !out.everywhere) {
    moving.put_back(crossings, before.points, mesh.points);
    crossings = folds_of(mesh, part);
  }
  const double most_left =
      out.everywhere ? worth_while * static_cast<double>(at_first) : static_cast<double>(at_first) - 0.5;
  if (static_cast<double>(crossings.size()) > most_left) {  // too little is gained
    mesh = before;
    return {};
  }
  known.reset();
  out.crossings = at_first - crossings.size();
  measure_moves(before.points, mesh.points, out);
  return out;
}

}  // namespace ostia::pipeline
