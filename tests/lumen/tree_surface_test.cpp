#include "ostia/lumen/tree_surface.h"

#include "formula_fields.h"
#include "vessel_trees.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/lumen/incremental_surface.h"
#include "ostia/lumen/start_surface.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <set>

namespace ostia::lumen {
namespace {

using geometry::TriMesh;
using test::ball;
using test::capsule;
using test::Field;
using test::torus;

using std::numbers::pi;

TriMesh wall_of(std::shared_ptr<const ScalarField> field, const std::vector<Vec3>& seeds,
                double cell_mm = 0.25) {
  TreeSurface surface({.cell_mm = cell_mm});
  surface.build(std::move(field), seeds);
  return surface.mesh();
}

long euler(const TriMesh& mesh) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c) edges.insert(std::minmax(t[c], t[(c + 1) % 3]));
  return static_cast<long>(mesh.points.size()) - static_cast<long>(edges.size()) +
         static_cast<long>(mesh.triangles.size());
}

void expect_sound(const TriMesh& mesh) {
  const auto faults = geometry::find_faults(mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.unused_points, 0u);
  EXPECT_EQ(faults.self_intersections, 0u) << faults.summary();
}

double off_level_p95(const TriMesh& mesh, const ScalarField& field) {
  std::vector<double> off;
  for (const Vec3& p : mesh.points) off.push_back(std::abs(field.value(p)) / field.gradient(p).norm());
  std::sort(off.begin(), off.end());
  return off[off.size() * 95 / 100];
}

bool same(const TriMesh& a, const TriMesh& b) {
  return a.points == b.points && a.triangles == b.triangles;
}

TEST(TreeSurface, ABallHasItsVolumeAreaAndTopology) {
  const double radius = 3.1;
  const Field field = ball({0.3, -20.2, 7.7}, radius);
  const TriMesh mesh = wall_of(field, {{0.3 + radius, -20.2, 7.7}});
  expect_sound(mesh);
  EXPECT_EQ(euler(mesh), 2);
  EXPECT_NEAR(geometry::volume(mesh), 4.0 / 3.0 * pi * std::pow(radius, 3),
              0.01 * 4.0 / 3.0 * pi * std::pow(radius, 3));
  EXPECT_NEAR(geometry::area(mesh), 4.0 * pi * radius * radius, 0.01 * 4.0 * pi * radius * radius);
  EXPECT_LT(off_level_p95(mesh, *field), 1e-4);
}

TEST(TreeSurface, ATorusHasAHole) {
  const Field field = torus({-8.01, 3.3, 0.02}, 6.0, 1.5);
  const TriMesh mesh = wall_of(field, {{-8.01 + 7.5, 3.3, 0.02}});
  expect_sound(mesh);
  EXPECT_EQ(euler(mesh), 0);
  EXPECT_NEAR(geometry::volume(mesh), 2.0 * pi * pi * 6.0 * 1.5 * 1.5,
              0.02 * 2.0 * pi * pi * 6.0 * 1.5 * 1.5);
  EXPECT_LT(off_level_p95(mesh, *field), 1e-3);
}

TEST(TreeSurface, ATubeIsClosedByItsCapsWhereverItRuns) {
  const double radius = 0.9, length = 30.0;
  const Vec3 from(-11.0, 4.0, -9.0), along = Vec3(2.0, -3.0, 5.0).normalized();
  const Field field = capsule(from, from + length * along, radius);
  const Vec3 seed = from + 0.5 * length * along + radius * along.unitOrthogonal();
  const TriMesh mesh = wall_of(field, {seed}, 0.2);
  expect_sound(mesh);
  EXPECT_EQ(euler(mesh), 2);
  const double truth = pi * radius * radius * (length + 4.0 / 3.0 * radius);
  EXPECT_NEAR(geometry::volume(mesh), truth, 0.02 * truth);
  EXPECT_LT(off_level_p95(mesh, *field), 1e-3);
  // Along the wall alone: far fewer places than the box has nodes, or even the tube.
  EXPECT_LT(field->asked, mesh.points.size() * 5);
}

// Two branches out of a trunk.
std::vector<std::shared_ptr<const ScalarField>> tree_surface_fork() {
  return {capsule({0, 0, -12}, {0, 0, 8}, 1.6), capsule({0, 0, 0}, {7, 1, 9}, 1.1),
          capsule({0, 0, -5}, {-6, 2, 1}, 0.8)};
}
const std::vector<Vec3> fork_seeds{{1.6, 0, -9}, {0, 0, 9.6}};

TEST(TreeSurface, AForkIsSoundHoweverItsBranchesAreJoined) {
  for (const JointShape joints : {JointShape::sharp, JointShape::smooth}) {
    const auto field = std::make_shared<const TreeField>(tree_surface_fork(), BlendOptions{0.25, joints});
    const TriMesh mesh = wall_of(field, fork_seeds);
    expect_sound(mesh);
    EXPECT_EQ(euler(mesh), 2);
    EXPECT_LT(off_level_p95(mesh, *field), 2e-3);
  }
}

TEST(TreeSurface, TheSharpForkIsTheExactUnion) {
  const auto branches = tree_surface_fork();
  const auto field = std::make_shared<const TreeField>(branches, BlendOptions{0.25, JointShape::sharp});
  for (const Vec3& p : wall_of(field, fork_seeds).points) {
    double least = 1e9;
    for (const auto& branch : branches) least = std::min(least, branch->value(p));
    EXPECT_NEAR(least, 0.0, 5e-3);
  }
}

TEST(TreeSurface, PiecesWithoutASeedDoNotAppear) {
  const auto field = std::make_shared<const TreeField>(
      std::vector<std::shared_ptr<const ScalarField>>{ball({0, 0, 0}, 1.0), ball({2.8, 0, 0}, 1.0),
                                                      ball({40, 0, 0}, 1.0)},
      BlendOptions{});
  EXPECT_EQ(geometry::find_faults(wall_of(field, {{1, 0, 0}}), false).components, 1u);
  EXPECT_EQ(geometry::find_faults(wall_of(field, {{1, 0, 0}, {39, 0, 0}}), false).components, 2u);
  EXPECT_EQ(geometry::find_faults(wall_of(field, {{1, 0, 0}, {1.8, 0, 0}, {39, 0, 0}}), false).components,
            3u);
}

TEST(TreeSurface, ASeedBesideTheWallFindsIt) {
  const Field field = ball({0.1, 0.1, 0.1}, 2.0);
  for (const double beside : {-0.2, -0.1, 0.1, 0.2}) {
    const TriMesh mesh = wall_of(field, {Vec3(0.1, 0.1, 2.1 + beside)});
    EXPECT_EQ(euler(mesh), 2) << beside;
  }
}

TEST(TreeSurface, TheSameForAnyNumberOfThreads) {
  const auto field = std::make_shared<const TreeField>(tree_surface_fork(), BlendOptions{});
  const int threads = core::max_threads();
  core::set_max_threads(1);
  const TriMesh one = wall_of(field, fork_seeds);
  core::set_max_threads(4);
  const TriMesh four = wall_of(field, fork_seeds);
  core::set_max_threads(threads);
  EXPECT_TRUE(same(one, four));
}

TEST(TreeSurface, TheSameFromOtherSeedsOnTheSameWall) {
  const auto field = std::make_shared<const TreeField>(tree_surface_fork(), BlendOptions{});
  EXPECT_TRUE(same(wall_of(field, fork_seeds), wall_of(field, {{0, -1.6, 5}})));
}

/// The fork with dents and bumps, each within its own ball.
struct Bumps {
  struct Bump {
    Vec3 centre;
    double reach, height;
  };
  std::vector<Bump> all;
  std::shared_ptr<const ScalarField> base =
      std::make_shared<const TreeField>(tree_surface_fork(), BlendOptions{1.0, JointShape::smooth});

  Field field() const {
    return std::make_shared<test::Formula>(
        [bumps = all, f = base](const Vec3& p) {
          double value = f->value(p);
          for (const Bump& b : bumps) {
            const double x = 1.0 - (p - b.centre).squaredNorm() / (b.reach * b.reach);
            if (x > 0.0) value += b.height * x * x;
          }
          return value;
        },
        [](const Vec3&) -> Vec3 { return Vec3::Zero(); }, base->box());
  }
};

TEST(TreeSurface, AfterAnyNumberOfEditsItIsWhatAFreshBuildGives) {
  std::mt19937 random(11);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
  };
  Bumps bumps;
  TreeSurface kept({.cell_mm = 0.3});
  kept.build(bumps.field(), fork_seeds);
  int topologies = 0;
  for (int edit = 0; edit < 60; ++edit) {
    Box3 changed;
    const auto touch = [&](const Bumps::Bump& b) {
      changed.extend(Box3(b.centre - Vec3::Constant(b.reach), b.centre + Vec3::Constant(b.reach)));
    };
    if (bumps.all.size() > 4) {
      touch(bumps.all.front());
      bumps.all.erase(bumps.all.begin());
    }
    // Dents that cut a branch off, bumps, and drops beside the wall that nothing leads to.
    bumps.all.push_back(
        {{uniform(-3, 4), uniform(-1, 1), uniform(-11, 9)}, uniform(1.0, 4.0), uniform(-2.0, 2.0)});
    touch(bumps.all.back());
    std::vector<Vec3> seeds = fork_seeds;
    if (edit % 3 == 0) seeds.push_back({7.7, 1.1, 9.6});
    const auto report = kept.update(bumps.field(), changed, seeds);
    TreeSurface fresh({.cell_mm = 0.3});
    const auto whole = fresh.build(bumps.field(), seeds);
    const TriMesh mesh = kept.mesh();
    ASSERT_TRUE(same(mesh, fresh.mesh())) << "edit " << edit;
    EXPECT_EQ(report.triangles, whole.triangles);
    EXPECT_EQ(report.triangles, mesh.triangles.size());
    EXPECT_EQ(report.blocks, whole.blocks);
    const auto faults = geometry::find_faults(mesh, false);
    EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
    topologies += faults.components != 1 || euler(mesh) != 2 ? 1 : 0;
  }
  EXPECT_GT(topologies, 3);  // the edits did cut and join
}

TEST(TreeSurface, AnUpdateAsksAndMakesWhatChangedAlone) {
  Bumps bumps;
  TreeSurface surface;
  const auto whole = surface.build(bumps.field(), fork_seeds);
  const auto before = surface.parts();
  bumps.all.push_back({{0, 1.6, -9}, 1.0, 0.2});
  const Box3 changed(Vec3(-1, 0.6, -10), Vec3(1, 2.6, -8));
  const auto report = surface.update(bumps.field(), changed, fork_seeds);
  EXPECT_LT(report.evaluations * 20, whole.evaluations);
  EXPECT_LE(report.blocks_made, 12u);
  EXPECT_GE(report.blocks_made, 1u);
  std::set<const TriMesh*> meshes;
  for (const auto& part : before) meshes.insert(part.mesh.get());
  std::size_t new_parts = 0, triangles = 0;
  for (const auto& part : surface.parts()) {
    new_parts += meshes.contains(part.mesh.get()) ? 0 : 1;
    triangles += part.mesh->triangles.size();
  }
  EXPECT_LT(new_parts, before.size() / 2);
  EXPECT_EQ(triangles, report.triangles);
  EXPECT_EQ(surface.update(bumps.field(), Box3(), fork_seeds).evaluations, 0u);
}

TEST(TreeSurface, RoundingErrorsOutsideTheChangeDoNotCrackIt) {
  // Nodes lie on the wall to within the error: each call sees them on another side.
  int call = 0;
  const auto field = [&call] {
    const double error = (++call % 2 == 0 ? 1.0 : -1.0) * 1e-9;
    return std::make_shared<test::Formula>(
        [error](const Vec3& p) { return p.cwiseAbs().maxCoeff() - 6.0 + error; },
        [](const Vec3&) -> Vec3 { return Vec3::Zero(); }, Box3(Vec3::Constant(-9), Vec3::Constant(9)));
  };
  TreeSurface surface({.cell_mm = 0.25});
  const std::vector<Vec3> seeds{{5.9, 0, 0}};
  surface.build(field(), seeds);
  for (const Vec3& place : {Vec3(6, 0, 0), Vec3(6, 6, 0), Vec3(-6, 6, 6), Vec3(0, 0, -6)}) {
    surface.update(field(), Box3(place - Vec3::Constant(1.1), place + Vec3::Constant(1.1)), seeds);
    const auto faults = geometry::find_faults(surface.mesh(), true);
    EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
    EXPECT_EQ(faults.self_intersections, 0u);
  }
}

/// Off the level, mm, of the vertex that is farthest from it.
double off_level_most(const TriMesh& mesh, const ScalarField& field) {
  double most = 0.0;
  for (const Vec3& p : mesh.points)
    most = std::max(most, std::abs(field.value(p)) / field.gradient(p).norm());
  return most;
}

/// A straight vessel, solved incrementally while neighbours on its wall move out and in.
struct EditedVessel {
  IncrementalSurface vessel{*model_of_tubes(testing::straight_vessel(40.0, 1.5)).vessels.front()};
  std::mt19937 random{3};
  std::int64_t next_id = 100000;

  std::shared_ptr<const TreeField> field() const {
    return std::make_shared<const TreeField>(
        std::vector<std::shared_ptr<const ImplicitSurface>>{vessel.surface()}, BlendOptions{});
  }
  std::vector<Vec3> seeds() const {
    std::vector<Vec3> places;
    for (const SurfaceSample& sample : vessel.samples()) places.push_back(sample.position);
    return places;
  }
  Box3 edit() {
    auto samples = vessel.samples();
    const Vec3 centre = samples[random() % samples.size()].position;
    const auto nearer = [&](const SurfaceSample& a, const SurfaceSample& b) {
      return (a.position - centre).squaredNorm() < (b.position - centre).squaredNorm();
    };
    std::partial_sort(samples.begin(), samples.begin() + 12, samples.end(), nearer);
    samples.resize(12);
    std::vector<std::int64_t> removed;
    const double step = 0.1 * (static_cast<double>(random()) / 2147483648.0 - 1.0);
    for (SurfaceSample& sample : samples) {
      removed.push_back(std::exchange(sample.id, next_id++));
      sample.position += step * sample.normal;
      sample.origin = SampleOrigin::edit;
    }
    return vessel.change(removed, samples).changed;
  }
};

TEST(TreeSurface, WhatIsKeptWithinAToleranceStaysSoHoweverManyEditsAreMade) {
  EditedVessel edited;
  TreeSurface kept({.keep_within_mm = unseen_mm}), exact;
  kept.build(edited.field(), edited.seeds());
  exact.build(edited.field(), edited.seeds());
  std::size_t asked = 0, asked_exact = 0;
  for (int edit = 0; edit < 12; ++edit) {
    const Box3 changed = edited.edit();
    asked += kept.update(edited.field(), changed, edited.seeds()).evaluations;
    asked_exact += exact.update(edited.field(), changed, edited.seeds()).evaluations;
    const TriMesh mesh = kept.mesh();
    if (edit % 6 == 5) expect_sound(mesh);
    TreeSurface fresh;
    fresh.build(edited.field(), edited.seeds());
    const double most = off_level_most(fresh.mesh(), *edited.field());
    EXPECT_LT(off_level_most(mesh, *edited.field()), most + 5.0 * unseen_mm) << "edit " << edit;
  }
  EXPECT_LT(3 * asked, 2 * asked_exact);
}

TEST(TreeSurface, WhatIsKeptDoesNotDependOnTheNumberOfThreads) {
  const int threads = core::max_threads();
  const auto edited_with = [](int used) {
    core::set_max_threads(used);
    EditedVessel edited;
    TreeSurface surface({.keep_within_mm = unseen_mm});
    surface.build(edited.field(), edited.seeds());
    for (int edit = 0; edit < 4; ++edit) {
      const Box3 changed = edited.edit();
      surface.update(edited.field(), changed, edited.seeds());
    }
    return surface.mesh();
  };
  const TriMesh one = edited_with(1), four = edited_with(4);
  core::set_max_threads(threads);
  EXPECT_TRUE(same(one, four));
}

TEST(TreeSurface, RefusesWhatItCannotFollow) {
  const Field field = ball({0, 0, 0}, 2.0);
  TreeSurface surface;
  EXPECT_THROW(surface.build(nullptr, {{2, 0, 0}}), InvalidInput);
  EXPECT_THROW(surface.build(field, {}), InvalidInput);
  EXPECT_THROW(surface.build(field, {{0, 0, 0}, {9, 9, 9}}), InvalidInput);
  EXPECT_THROW(surface.build(field, {{std::nan(""), 0, 0}}), InvalidInput);
  EXPECT_THROW(surface.build(field, {{1e300, 0, 0}}), InvalidInput);
  for (const double cell : {0.0, -0.25, 0.019, 2.1, std::nan("")})
    EXPECT_THROW(TreeSurface({.cell_mm = cell}), InvalidInput);
  for (const double within : {-1e-9, 0.011, std::nan("")})
    EXPECT_THROW(TreeSurface({.keep_within_mm = within}), InvalidInput);
  EXPECT_THROW(TreeSurface({.memory_limit_mib = 0.0}), InvalidInput);
  const auto broken = std::make_shared<test::Formula>(
      [](const Vec3& p) { return p.x() > 1.0 ? std::nan("") : p.norm() - 2.0; },
      [](const Vec3&) -> Vec3 { return Vec3::Zero(); }, field->box());
  EXPECT_THROW(surface.build(broken, {{-2, 0, 0}}), InvalidInput);
  surface.build(field, {{2, 0, 0}});
  EXPECT_THROW(surface.update(broken, broken->box(), {{-2, 0, 0}}), InvalidInput);
  EXPECT_TRUE(surface.mesh().triangles.empty());
  // After an error all is made anew, whatever is said to have changed.
  surface.update(field, Box3(), {{2, 0, 0}});
  EXPECT_TRUE(same(surface.mesh(), wall_of(field, {{2, 0, 0}})));
}

TEST(TreeSurface, StopsAtTheMemoryLimit) {
  TreeSurface surface({.cell_mm = 0.05, .memory_limit_mib = 1.0});
  EXPECT_THROW(surface.build(ball({0, 0, 0}, 4.0), {{4, 0, 0}}), ResourceError);
  EXPECT_TRUE(surface.mesh().points.empty());
}

TEST(TreeSurface, StopsWhenCancelled) {
  const core::TaskContext task;
  const auto field = std::make_shared<test::Formula>(
      [&task](const Vec3& p) {
        if (p.z() > 3.0) task.cancel();
        return p.norm() - 8.0;
      },
      [](const Vec3&) -> Vec3 { return Vec3::Zero(); }, Box3(Vec3::Constant(-10), Vec3::Constant(10)));
  TreeSurface surface;
  EXPECT_THROW(surface.build(field, {{0, 0, -8}}, task), Cancelled);
  EXPECT_TRUE(surface.mesh().points.empty());
}

TEST(SurfaceOf, AModelOfAYHasTheShapesWall) {
  const geometry::AnalyticShape shape = geometry::y_junction(14.0, 16.0, 1.6, 1.2, 60.0);
  const LumenModel model = model_of_tubes(testing::tree_of(shape));
  EXPECT_NEAR(default_cell_mm(model), 0.25, 1e-12);
  const TriMesh mesh = surface_of(model);
  expect_sound(mesh);
  EXPECT_EQ(euler(mesh), 2);
  const geometry::TubeDistance truth(shape);
  std::vector<double> off;
  for (const Vec3& p : mesh.points) off.push_back(std::abs(truth(p)));
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], 0.02);
  EXPECT_LT(off[off.size() * 95 / 100], 0.15);
  EXPECT_TRUE(same(mesh, surface_of(model, 0.25)));
  EXPECT_GT(surface_of(model, 0.15).triangles.size(), 2 * mesh.triangles.size());
  EXPECT_THROW(surface_of(model, 0.001), InvalidInput);
  EXPECT_THROW(surface_of(LumenModel{}), InvalidInput);
}

TEST(SurfaceOf, NarrowVesselsGetSmallerCells) {
  const LumenModel model = model_of_tubes(testing::straight_vessel(10.0, 0.5));
  EXPECT_NEAR(default_cell_mm(model), 0.125, 1e-3);
  const TriMesh mesh = surface_of(model);
  expect_sound(mesh);
  EXPECT_NEAR(geometry::volume(mesh), pi * 0.25 * (10.0 + 4.0 / 3.0 * 0.5), 0.05 * pi * 0.25 * 10.0);
}

}  // namespace
}  // namespace ostia::lumen
