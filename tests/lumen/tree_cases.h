#pragma once
/// \file Models of the phantom's coronary trees, and what their walls have to be.

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/lumen/live_model.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/phantom/phantom_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace ostia::lumen::testing {

/// A case of the suite that `ostia phantom --cases 18 --truth-only` makes: a healthy or diseased tree, drawn
/// in memory; no image is made.
inline phantom::CasePlan phantom_case(int number) {
  phantom::CaseOptions options;
  options.seed += static_cast<std::uint64_t>(number);
  return phantom::plan_case(options);
}

inline LumenModel tubes_of(const phantom::CasePlan& plan) {
  return model_of_tubes(phantom::vessel_tree(plan.tree));
}
/// From the true contours of the annotated sections, stenoses among them.
inline LumenModel contour_model_of(const phantom::CasePlan& plan) {
  phantom::ObserverOptions nobody;
  nobody.count = 0;
  return model_of_contours(phantom::vessel_tree(plan.tree),
                           phantom::annotate(plan.tree, plan.sections.sections, {}, nobody));
}

/// Distance of 95 in 100 vertices from the level, to first order; from every so manieth of a large mesh.
inline double off_level_p95_mm(const geometry::TriMesh& mesh, const ScalarField& field) {
  std::vector<double> off;
  const std::size_t step = mesh.points.size() / 20000 + 1;
  for (std::size_t i = 0; i < mesh.points.size(); i += step) {
    const FieldSample at = field.value_and_gradient(mesh.points[i]);
    off.push_back(std::abs(at.value) / std::max(at.gradient.norm(), 1e-9));
  }
  const auto p95 = off.begin() + static_cast<std::ptrdiff_t>(off.size() * 95 / 100);
  std::nth_element(off.begin(), p95, off.end());
  return *p95;
}

/// Closed, manifold, without self-intersections; 95 in 100 vertices within 0.02 mm of the level.
inline void expect_wall(const geometry::TriMesh& mesh, const ScalarField& field) {
  ASSERT_FALSE(mesh.triangles.empty());
  const auto faults = geometry::find_faults(mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(faults.unused_points, 0u);
  EXPECT_EQ(faults.self_intersections, 0u) << faults.summary();
  EXPECT_GT(geometry::volume(mesh), 0.0);
  const double off_mm = off_level_p95_mm(mesh, field);
  ::testing::Test::RecordProperty("off_level_p95_um", std::to_string(1000.0 * off_mm));
  EXPECT_LT(off_mm, 0.02);
}

/// Pulls places of the wall out and in until so many edits have been taken; what is refused is tried
/// elsewhere.
inline void edit(LiveModel& live, int edits, unsigned seed) {
  std::mt19937 random(seed);
  const auto one_of = [&](const auto& all) -> const auto& {
    return all[random() % all.size()];
  };
  for (int tries = 0, done = 0; done < edits; ++tries) {
    ASSERT_LT(tries, 20 * edits) << "edits are refused";
    const auto& vessel = one_of(live.model().vessels);
    const SurfaceSample& sample = one_of(vessel->samples);
    const double radius = (sample.position - vessel->axis->point(sample.s_mm)).norm();
    const double by = radius * (static_cast<double>(random()) / 4294967295.0 - 0.6);
    try {
      live.follow(apply(live.model(), WallDrag{.vessel = vessel->vessel,
                                               .from = sample.position,
                                               .to = sample.position + by * sample.normal,
                                               .reach_mm = 3.0}));
      ++done;
    } catch (const InvalidInput&) {
    }
  }
}

/// The wall of a model made anew and, after six edits, brought up to date. Cells of 0 mm: default_cell_mm.
inline void expect_walls(const LumenModel& model, double cell_mm, unsigned seed) {
  if (cell_mm == 0.0) cell_mm = default_cell_mm(model);
  LiveModel live(std::make_shared<const LumenModel>(model));
  for (const int edits : {0, 6}) {
    SCOPED_TRACE("after " + std::to_string(edits) + " edits, cells of " + std::to_string(cell_mm) + " mm");
    for (int one = 0; one < edits; ++one) {
      edit(live, 1, seed + static_cast<unsigned>(one));
      live.wall(cell_mm);
    }
    const geometry::TriMesh wall = live.wall(cell_mm);
    ::testing::Test::RecordProperty("triangles_" + std::to_string(edits),
                                    std::to_string(wall.triangles.size()));
    expect_wall(wall, *live.field());
  }
}

}  // namespace ostia::lumen::testing
