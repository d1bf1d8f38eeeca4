#include "ostia/lumen/view_contours.h"

#include "analytic_fields.h"
#include "tube_samples.h"

#include "ostia/core/error.h"
#include "ostia/lumen/incremental_surface.h"
#include "ostia/lumen/views.h"

#include <gtest/gtest.h>

#include <random>

namespace ostia::lumen {
namespace {

using testing::FunctionField;

double between(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A tube along x of radius 1.5 mm with dents and bulges that end 2 mm from their centres.
class DentedTube {
 public:
  /// Adds a dent and tells the box around it.
  Box3 dent(const Vec3& centre, double depth) {
    dents_.emplace_back(centre, depth);
    return {centre - Vec3::Constant(reach), centre + Vec3::Constant(reach)};
  }
  FunctionField field() const {
    return FunctionField([dents = dents_](const Vec3& p) {
      double f = std::hypot(p.y(), p.z()) - 1.5;
      for (const auto& [centre, depth] : dents)
        f += depth * phi(Kernel::wendland_c2, (p - centre).norm() / reach);
      return f;
    });
  }

 private:
  static constexpr double reach = 2.0;
  std::vector<std::pair<Vec3, double>> dents_;
};

void expect_same(const std::vector<ContourLine>& a, const std::vector<ContourLine>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].picture_px, b[i].picture_px);
    EXPECT_EQ(a[i].world, b[i].world);
  }
}

struct View {
  ViewSurface surface = testing::flat_view(200, 60, 0.15);
  std::vector<Vec2> seeds;
  View() {
    for (int column = 0; column < 200; ++column) seeds.emplace_back(column + 0.5, 30.0);
  }
};

TEST(ViewContours, EqualsFreshLinesAfterEveryEdit) {
  const View view;
  std::mt19937_64 random(42);
  std::size_t most_lines = 0;
  for (int round = 0; round < 6; ++round) {
    DentedTube tube;
    ViewContours kept(view.surface, view.seeds);
    kept.update(tube.field());
    expect_same(kept.lines(), contour_lines(tube.field(), view.surface, view.seeds));
    for (int edit = 0; edit < 25; ++edit) {
      const Vec3 centre(between(random, -15.0, 15.0), between(random, -2.5, 2.5), between(random, -0.5, 0.5));
      const Box3 changed = tube.dent(centre, between(random, -1.0, 2.6));  // also occlusions and islands
      kept.update(tube.field(), changed);
      expect_same(kept.lines(), contour_lines(tube.field(), view.surface, view.seeds));
      most_lines = std::max(most_lines, kept.lines().size());
      for (const ContourLine& line : kept.lines())
        for (const Vec3& p : line.world) ASSERT_LE(std::abs(tube.field().value(p)), 1e-6);
    }
  }
  EXPECT_GT(most_lines, 2U);
}

TEST(ViewContours, OnlyWhatChangedIsEvaluated) {
  const View view;
  DentedTube tube;
  ViewContours kept(view.surface, view.seeds);
  kept.update(tube.field());
  const std::size_t all = kept.evaluations();
  const Box3 changed = tube.dent({1.0, 1.5, 0.0}, 0.3);
  kept.update(tube.field(), changed);
  EXPECT_GT(kept.evaluations(), 0U);
  EXPECT_LT(kept.evaluations(), all / 4);
  kept.update(tube.field(), Box3(Vec3::Constant(500.0), Vec3::Constant(501.0)));
  EXPECT_EQ(kept.evaluations(), 0U);
  kept.update(tube.field(), Box3());
  EXPECT_EQ(kept.evaluations(), 0U);
  expect_same(kept.lines(), contour_lines(tube.field(), view.surface, view.seeds));
}

TEST(ViewContours, FailureLeavesTheLines) {
  const View view;
  DentedTube tube;
  ViewContours kept(view.surface, view.seeds);
  EXPECT_TRUE(kept.lines().empty());
  kept.update(tube.field());
  const std::vector<ContourLine> before = kept.lines();
  const Box3 changed = tube.dent({1.0, 1.5, 0.0}, 0.3);
  const FunctionField broken([](const Vec3&) { return std::nan(""); });
  EXPECT_THROW(kept.update(broken, changed), InvalidInput);
  expect_same(kept.lines(), before);
  kept.update(tube.field(), changed);
  expect_same(kept.lines(), contour_lines(tube.field(), view.surface, view.seeds));
  EXPECT_THROW(ViewContours(view.surface, {{-5.0, 3.0}}), InvalidInput);
}

TEST(ViewContours, FollowsAnEditedVessel) {
  const auto vessel = testing::tube_vessel(testing::bent_axis(40.0), [](double, double) { return 1.5; });
  IncrementalSurface solved(vessel);
  reformat::CurvedOptions options;
  options.s_start_mm = -4.0;
  options.width = 64;
  options.height = 192;
  const reformat::CurvedReformation cpr(vessel.axis, options), twin = cpr.twin();
  const reformat::Plane plane = reformat::cross_section_plane(*vessel.axis, 20.0, 8.0, 0.05);
  ViewContours a(view_of(cpr), cpr.axis_px()), b(view_of(twin), twin.axis_px()),
      c(view_of(plane), {Vec2(80.0, 80.0)});
  const std::array<ViewContours*, 3> all{&a, &b, &c};
  for (ViewContours* view : all) view->update(*solved.surface());

  std::vector<std::int64_t> removed;
  std::vector<SurfaceSample> added;
  for (const SurfaceSample& sample : vessel.samples) {
    if (std::abs(sample.s_mm - 20.0) > 0.8) continue;
    removed.push_back(sample.id);
    SurfaceSample moved = sample;
    moved.id += 100000;
    moved.position -= 0.4 * sample.normal;
    added.push_back(moved);
  }
  ASSERT_GT(removed.size(), 5U);
  const IncrementalReport report = solved.change(removed, added);
  update_views(all, *solved.surface(), report.changed);
  const std::array<ViewSurface, 3> surfaces{view_of(cpr), view_of(twin), view_of(plane)};
  const std::array<std::vector<Vec2>, 3> seeds{cpr.axis_px(), twin.axis_px(), {Vec2(80.0, 80.0)}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto fresh = contour_lines(*solved.surface(), surfaces[i], seeds[i]);
    ASSERT_EQ(all[i]->lines().size(), 1U);
    ASSERT_EQ(fresh.size(), 1U);
    EXPECT_NEAR(testing::area_on_the_left(all[i]->lines()[0]), testing::area_on_the_left(fresh[0]), 1e-2);
    EXPECT_TRUE(all[i]->lines()[0].closed());
    // f has changed by up to 1e-6 mm where the report says that it has not changed.
    for (const Vec3& p : all[i]->lines()[0].world) EXPECT_LE(std::abs(solved.surface()->value(p)), 1.2e-6);
  }
  // The narrowed wall is seen where it was narrowed.
  for (const Vec3& p : c.lines()[0].world) EXPECT_NEAR((p - vessel.axis->point(20.0)).norm(), 1.1, 0.1);
}

}  // namespace
}  // namespace ostia::lumen
