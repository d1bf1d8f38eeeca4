// Narrowings and segments of a drawn coronary tree, whose truth is known.

#include "walls.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/analysis/stenosis.h"
#include "ostia/phantom/phantom_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

using phantom::CoronaryVessel;

/// The tree of a case, its walls from the true profiles.
struct Case {
  phantom::CoronaryTree tree;
  lumen::LumenModel model;
  std::map<std::int32_t, std::shared_ptr<const lumen::ImplicitSurface>> walls;

  explicit Case(std::uint64_t seed) {
    phantom::CaseOptions options;
    options.seed = seed;
    options.preset = phantom::Preset::tiny;
    tree = phantom::plan_case(options).tree;
    const geometry::VesselTree axes = phantom::vessel_tree(tree);
    std::vector<lumen::RadialWall> radial;
    for (std::size_t i = 0; i < axes.vessels.size(); ++i) {
      const double own = lumen::own_from_mm(axes, axes.vessels[i].id);
      radial.push_back(
          [this, i, own](double s, double theta) {  // the theta of its own frame does not matter here
            return tree.vessels[i].lumen.at(std::max(0.0, s - own), theta);
          });
    }
    model = lumen::model_of_walls(axes, radial);
  }
  SurfaceOfVessel surface_of() {
    return [this](std::int32_t id) {
      auto& wall = walls[id];
      if (!wall)
        wall = std::make_shared<const lumen::ImplicitSurface>(lumen::solve(lumen::vessel(model, id)));
      return wall;
    };
  }
  const CoronaryVessel& truth(std::int32_t id) const {
    return tree.vessels[static_cast<std::size_t>(id - 1)];
  }
};

TEST(PhantomStenoses, AreFoundWithTheirDesignedPercent) {
  int designed = 0, close = 0;
  double worst = 0.0, sum = 0.0;
  for (const std::uint64_t seed : {1u, 2u}) {
    Case one(seed);
    for (const geometry::Vessel& vessel : one.model.tree.vessels) {
      const CoronaryVessel& truth = one.truth(vessel.id);
      const bool any = std::any_of(truth.stenoses.begin(), truth.stenoses.end(),
                                   [](const phantom::Stenosis& s) { return s.diameter_stenosis >= 0.3; });
      if (!any) continue;
      const LumenProfile profile = lumen_profile(one.model, one.surface_of(), vessel.id);
      const auto found =
          find_stenoses(profile, reference_line(profile, branch_abscissas(one.model, vessel.id)));
      const double own = lumen::own_from_mm(one.model.tree, vessel.id);
      for (const phantom::Stenosis& stenosis : truth.stenoses) {
        if (stenosis.diameter_stenosis < 0.3) continue;
        ++designed;
        const double throat = own + stenosis.s_throat_mm;
        const auto match = std::find_if(found.begin(), found.end(), [&](const Stenosis& s) {
          return s.from_mm <= throat && throat <= s.to_mm;
        });
        ASSERT_NE(match, found.end()) << "seed " << seed << ", " << vessel.name << ", "
                                      << 100.0 * stenosis.diameter_stenosis << " % at " << throat << " mm";
        const double off = match->diameter_percent - 100.0 * (1.0 - std::sqrt(1.0 - stenosis.area_stenosis));
        worst = std::max(worst, std::abs(off));
        sum += std::abs(off);
        close += std::abs(off) <= 5.0 ? 1 : 0;
        EXPECT_NEAR(off, 0.0, 10.0) << "seed " << seed << ", " << vessel.name << ", "
                                    << 100.0 * stenosis.diameter_stenosis << " % at " << throat << " mm";
        EXPECT_NEAR(match->throat_mm, throat, 2.0);
      }
    }
  }
  RecordProperty("designed", designed);
  RecordProperty("mean_off_percent", std::to_string(sum / designed));
  RecordProperty("largest_off_percent", std::to_string(worst));
  ASSERT_GE(designed, 4);
  EXPECT_GE(close, designed * 8 / 10);
  EXPECT_LT(sum / designed, 4.0);
}

TEST(PhantomStenoses, HealthyTreesHaveFew) {
  phantom::CoronaryTree tree = phantom::draw_coronaries(phantom::draw_heart(3), {.seed = 3, .disease = 0.0});
  for (const CoronaryVessel& vessel : tree.vessels) {
    LumenProfile profile = testing::profile_of(vessel.axis.abscissa.back(), 0.5, [&](double s) {
      return 2.0 * std::sqrt(vessel.lumen.area_at(s) / testing::pi);
    });
    std::vector<double> branches;
    for (const CoronaryVessel& other : tree.vessels) {
      if (other.parent == vessel.id) branches.push_back(other.parent_s_mm);
    }
    for (const Stenosis& s : find_stenoses(profile, reference_line(profile, branches)))
      ADD_FAILURE() << vessel.name << ": " << s.diameter_percent << " % at " << s.throat_mm << " mm";
  }
}

TEST(PhantomSegments, AgreeWithTheTreesOwn) {
  const Case one(1);
  int compared = 0;
  for (const VesselSegment& segment : segments_of(one.model)) {
    if (!segment.aha) continue;
    const CoronaryVessel& truth = one.truth(segment.vessel);
    const double own = lumen::own_from_mm(one.model.tree, segment.vessel);
    for (const phantom::SegmentSpan& span : truth.segments) {
      if (span.aha != segment.aha->number) continue;
      ++compared;
      EXPECT_NEAR(segment.from_mm - own, span.s_from_mm, 0.5) << segment.label;
      EXPECT_NEAR(segment.to_mm - own, span.s_to_mm, 0.5) << segment.label;
    }
  }
  EXPECT_GE(compared, 10);
}

}  // namespace
}  // namespace ostia::analysis
