#include "ostia/experiments/beating_heart.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/remesh.h"
#include "ostia/phantom/heartbeat.h"
#include "ostia/phantom/moving_case.h"
#include "ostia/phantom/noise.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/vessel_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::experiments {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr double fine_mm = 0.4;       // of the exact surface before it gets even triangles
constexpr double axis_step_mm = 0.5;  // as analysis::carried_tree's

/// The vessels of the left ostium alone.
phantom::CoronaryTree left_tree(const phantom::CoronaryTree& whole) {
  phantom::CoronaryTree left;
  left.dominance = whole.dominance;
  std::vector<std::int32_t> number(whole.vessels.size(), -1);
  for (const phantom::CoronaryVessel& vessel : whole.vessels) {
    const bool root = vessel.parent < 0;
    if (root ? vessel.name != "LAD" : number[static_cast<std::size_t>(vessel.parent)] < 0) continue;
    phantom::CoronaryVessel copy = vessel;
    copy.id = static_cast<std::int32_t>(left.vessels.size());
    copy.parent = root ? -1 : number[static_cast<std::size_t>(vessel.parent)];
    number[static_cast<std::size_t>(vessel.id)] = copy.id;
    left.vessels.push_back(std::move(copy));
  }
  return left;
}

/// Vessels that no other begins at, but LAD and LCX: what a blurred phase may lack.
std::vector<std::int32_t> side_branches(const phantom::CoronaryTree& tree) {
  std::vector<std::int32_t> ends;
  for (const phantom::CoronaryVessel& vessel : tree.vessels) {
    const bool has_children = std::any_of(tree.vessels.begin(), tree.vessels.end(),
                                          [&](const auto& other) { return other.parent == vessel.id; });
    if (vessel.parent >= 0 && !has_children && vessel.name != "LCX") ends.push_back(vessel.id);
  }
  return ends;
}

/// Without the triangles that lie in the vessel beyond where it is free of its parent.
TriMesh without(const TriMesh& mesh, const phantom::VesselField& field, const phantom::CoronaryVessel& lost) {
  std::vector<char> gone(mesh.points.size(), 0);
  core::parallel_for(mesh.points.size(), 512, [&](std::size_t i) {
    std::vector<phantom::VesselField::Place> places;
    field.places(mesh.points[i], 1.0, places);
    const auto deepest = std::min_element(places.begin(), places.end(), [](const auto& a, const auto& b) {
      return a.rho_mm - a.lumen_mm < b.rho_mm - b.lumen_mm;
    });
    gone[i] = deepest != places.end() && deepest->vessel == lost.id && deepest->s_mm > lost.s_free_mm + 2.0;
  });
  TriMesh rest;
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const geometry::Triangle& triangle : mesh.triangles) {
    if (std::any_of(triangle.begin(), triangle.end(),
                    [&](std::int32_t p) { return gone[static_cast<std::size_t>(p)] != 0; }))
      continue;
    geometry::Triangle kept{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& n = number[static_cast<std::size_t>(triangle[k])];
      if (n < 0) {
        n = static_cast<std::int32_t>(rest.points.size());
        rest.points.push_back(mesh.points[static_cast<std::size_t>(triangle[k])]);
      }
      kept[k] = n;
    }
    rest.triangles.push_back(kept);
  }
  return rest;
}

/// Even triangles with about so many points.
TriMesh with_points(const TriMesh& surface, int points, const core::TaskContext& task) {
  const double of_triangle = geometry::area(surface) / (2.0 * points);
  const double edge = std::sqrt(of_triangle * 4.0 / std::numbers::sqrt3);
  return meshing::remesh(surface, std::vector<double>(surface.points.size(), edge), {}, task).mesh;
}

void add_noise(TriMesh& mesh, std::uint64_t seed, const BeatingHeartOptions& options) {
  if (options.noise_mm == 0.0) return;
  const auto field = smooth_field(seed, options.noise_length_mm);
  const std::vector<Vec3> normals = geometry::vertex_normals(mesh);
  core::parallel_for(mesh.points.size(), 1024, [&](std::size_t i) {
    mesh.points[i] += options.noise_mm * field(mesh.points[i]) * normals[i];
  });
}

std::uint64_t seed_of(const BeatingHeartOptions& options, int phase, std::uint64_t what) {
  return options.seed * 1'000'003U + static_cast<std::uint64_t>(phase) * 101U + what;
}

}  // namespace

void validate(const BeatingHeartOptions& o) {
  if (o.phases < 4 || o.phases > 100 || o.phases % 4 != 0)
    throw InvalidInput("a heartbeat of " + std::to_string(o.phases) +
                       " phases: 4, 8, ... to 100 can be made, so that 75 % is among them");
  if (o.template_points < 500 || o.target_points < 500 || o.template_points > 1000000 ||
      o.target_points > 1000000)
    throw InvalidInput("a tree's surface must have 500 to 1000000 points");
  if (!(o.noise_mm >= 0.0 && o.noise_mm <= 1.0) || !(o.noise_length_mm > 0.0))
    throw InvalidInput("noise of a wall must be 0 to 1 mm, correlated over more than 0 mm");
  if (!(o.phases_with_loss >= 0.0 && o.phases_with_loss <= 1.0))
    throw InvalidInput("the share of phases with loss must lie in [0, 1]");
}

std::function<double(const Vec3&)> smooth_field(std::uint64_t seed, double length_mm, int waves) {
  struct Wave {
    Vec3 number;
    double phase;
  };
  std::vector<Wave> all(static_cast<std::size_t>(waves));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint64_t at = 4 * i;
    all[i].number =
        Vec3(phantom::normal(seed, at), phantom::normal(seed, at + 1), phantom::normal(seed, at + 2)) /
        length_mm;
    all[i].phase = 2.0 * std::numbers::pi * phantom::uniform(seed, at + 3);
  }
  return [all = std::move(all)](const Vec3& p) {
    double sum = 0.0;
    for (const Wave& wave : all) sum += std::cos(wave.number.dot(p) + wave.phase);
    return sum * std::sqrt(2.0 / static_cast<double>(all.size()));
  };
}

std::string heart_name(const BeatingHeartOptions& options) {
  return "heart " + std::to_string(options.seed);
}

BeatingHeart beating_heart(const BeatingHeartOptions& options, const core::TaskContext& task) {
  validate(options);
  phantom::CaseOptions patient;
  patient.seed = options.seed;
  const phantom::CasePlan plan = phantom::plan_case(patient);
  const phantom::CoronaryTree tree = left_tree(plan.tree);
  const phantom::VesselField field(tree);
  const phantom::Heartbeat beat = phantom::draw_heartbeat(plan.heart, options.seed);
  BeatingHeart heart;
  heart.name = heart_name(options);
  heart.template_phase = phantom::template_percent / 100.0;
  heart.axes = phantom::vessel_tree(tree);
  for (geometry::TreeSegment& segment : heart.axes.segments)
    segment.axis = geometry::resample(segment.axis, axis_step_mm);
  const TriMesh exact = phantom::tree_surface(field, phantom::Boundary::lumen, fine_mm, task.sub(0.0, 0.3));
  heart.model = with_points(exact, options.template_points, task.sub(0.3, 0.5));
  const TriMesh other = with_points(exact, options.target_points, task.sub(0.5, 0.7));
  const std::vector<std::int32_t> branches = side_branches(tree);
  for (int k = 0; k < options.phases; ++k) {
    task.throw_if_cancelled();
    HeartPhaseModel one;
    one.phase = static_cast<double>(k) / options.phases;
    one.segmented = other;
    const std::uint64_t dice = seed_of(options, k, 1);
    if (!branches.empty() && phantom::uniform(dice, 0) < options.phases_with_loss) {
      const auto which =
          static_cast<std::size_t>(phantom::uniform(dice, 1) * static_cast<double>(branches.size()));
      const auto& lost = tree.vessels[static_cast<std::size_t>(branches[which])];
      one.segmented = without(one.segmented, field, lost);
      one.lost = lost.name;
    }
    const phantom::BeatPhase now = beat.phase(100.0 * one.phase);
    one.segmented = phantom::moved(one.segmented, now);
    add_noise(one.segmented, seed_of(options, k, 2), options);
    one.truth = phantom::moved(heart.model.points, now);
    one.axes = phantom::moved(heart.axes, now);
    heart.phases.push_back(std::move(one));
    task.sub(0.7, 1.0).set_progress(static_cast<double>(k + 1) / options.phases);
  }
  return heart;
}

}  // namespace ostia::experiments
