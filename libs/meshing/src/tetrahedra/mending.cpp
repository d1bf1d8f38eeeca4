#include "tetrahedra/mending.h"

#include "tetrahedra/cavity.h"
#include "tetrahedra/complex.h"
#include "tetrahedra/flips.h"
#include "tetrahedra/orthogonality.h"
#include "tetrahedra/quality.h"
#include "tetrahedra/smoothing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

namespace ostia::meshing {

using geometry::Vec3;
using Id = TetrahedraComplex::Id;

namespace {

struct Bad {
  double quality;
  Id tetrahedron;
  bool operator<(const Bad& o) const {  // the worst is on top of a heap
    return quality != o.quality ? quality > o.quality : tetrahedron > o.tetrahedron;
  }
};

class Mender {
 public:
  Mender(TetrahedraComplex& mesh, const MendingOptions& options)
      : mesh_(mesh),
        options_(options),
        goal_(quality_of_angle(options.goal_deg)),
        most_(most_of(mesh.alive_count(), options.most_growth)),
        smoothing_(mesh),
        flips_(mesh),
        cavity_(mesh) {}

  MendingReport run(const core::TaskContext& task) {
    for (int round = 0; round < options_.rounds; ++round) {
      for (std::size_t t = 0; t < mesh_.slots(); ++t) enqueue(static_cast<Id>(t));
      // Each round has far less to do than the one before.
      if (!work_off(round > 0, task.sub(1.0 - std::exp2(-round), 1.0 - std::exp2(-round - 1)))) break;
    }
    task.set_progress(1.0);
    return report_;
  }

 private:
  static std::size_t most_of(std::size_t count, double growth) {
    constexpr std::size_t few = 8;  // may come to the smallest meshes too
    return count + few + static_cast<std::size_t>(growth * static_cast<double>(count));
  }

  void enqueue(Id t) {
    if (mesh_.alive(t) && mesh_.quality(t) < goal_) queue_.push({mesh_.quality(t), t});
  }

  bool work_off(bool with_points, const core::TaskContext& task) {
    constexpr std::size_t check_every = 64;
    const auto waiting = static_cast<double>(queue_.size());
    bool changed = false;
    for (std::size_t i = 0; !queue_.empty(); ++i) {
      if (i % check_every == 0) {
        task.throw_if_cancelled();
        task.set_progress(std::min(1.0, static_cast<double>(i) / waiting));
      }
      const Bad bad = queue_.top();
      queue_.pop();
      if (!mesh_.alive(bad.tetrahedron) || mesh_.quality(bad.tetrahedron) != bad.quality) continue;
      mesh_.touched().clear();
      if (!improve(bad.tetrahedron, with_points)) continue;
      changed = true;
      for (const Id t : mesh_.touched()) enqueue(t);
    }
    return changed;
  }

  bool improve(Id t, bool with_points) {
    bool moved = false;
    for (const Id v : TetrahedraComplex::Corners(mesh_.corners(t)))
      if (smoothing_.improve(v)) ++report_.points_moved, moved = true;
    if (moved && mesh_.quality(t) >= goal_) return true;
    if (flips_.improve(t)) {
      ++report_.flips;
      return true;
    }
    if (moved || !with_points) return moved;
    if (cavity_.contract(t)) {
      ++report_.points_removed;
      return true;
    }
    if (mesh_.alive_count() >= most_ || !cavity_.insert(t)) return false;
    ++report_.points_added;
    return true;
  }

  TetrahedraComplex& mesh_;
  MendingOptions options_;
  double goal_;
  std::size_t most_;
  TetrahedraSmoothing smoothing_;
  TetrahedraFlips flips_;
  TetrahedraCavity cavity_;
  std::priority_queue<Bad> queue_;
  MendingReport report_;
};

/// Dihedral angle of a tetrahedron between the faces opposite corners i and j, degrees.
double angle_between(const TetrahedraComplex& mesh, Id t, std::size_t i, std::size_t j) {
  auto normal = [&](std::size_t opposite) {
    const TetrahedraComplex::Face f = mesh.face(t, opposite);
    return (mesh.point(f[1]) - mesh.point(f[0])).cross(mesh.point(f[2]) - mesh.point(f[0])).normalized();
  };
  return std::acos(std::clamp(-normal(i).dot(normal(j)), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

void find_held(const TetrahedraComplex& mesh, double goal, MendingReport& report) {
  for (std::size_t s = 0; s < mesh.slots(); ++s) {
    const auto t = static_cast<Id>(s);
    if (!mesh.alive(t) || mesh.quality(t) >= goal) continue;
    ++report.below_goal;
    double least = 180.0, between_surface = 180.0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double angle = angle_between(mesh, t, i, j);
        least = std::min(least, angle);
        if (mesh.neighbour(t, i) == TetrahedraComplex::none &&
            mesh.neighbour(t, j) == TetrahedraComplex::none)
          between_surface = std::min(between_surface, angle);
      }
    if (between_surface > least || quality_of_angle(between_surface) >= goal) continue;
    ++report.held_by_surface;
    if (between_surface >= report.least_held_deg) continue;
    report.least_held_deg = between_surface;
    const TetrahedraComplex::Corners& c = mesh.corners(t);
    report.held_place = 0.25 * (mesh.point(c[0]) + mesh.point(c[1]) + mesh.point(c[2]) + mesh.point(c[3]));
  }
}

}  // namespace

MendingReport mend_tetrahedra(geometry::VolumeMesh& mesh, const MendingOptions& options,
                              const core::TaskContext& task) {
  TetrahedraComplex complex(mesh);
  const std::size_t before = mesh.tetrahedra.size();
  MendingReport report = Mender(complex, options).run(task.sub(0.0, 0.9));
  const core::TaskContext rest = task.sub(0.9, 1.0);
  make_orthogonal(complex, options.orthogonal_deg, quality_of_angle(options.goal_deg), report, rest);
  // What is still far off costs flatter tetrahedra.
  constexpr double far_deg = 3.0, lower_goal = 0.75;
  make_orthogonal(complex, options.orthogonal_deg + far_deg, quality_of_angle(lower_goal * options.goal_deg),
                  report, rest);
  task.set_progress(1.0);
  report.tetrahedra_before = before;
  find_held(complex, quality_of_angle(options.goal_deg), report);
  complex.write_to(mesh);
  return report;
}

}  // namespace ostia::meshing
