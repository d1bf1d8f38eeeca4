// The calibre without disease, against profiles whose healthy calibre is known.

#include "walls.h"

#include "ostia/analysis/stenosis.h"
#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

using testing::bump;
using testing::profile_of;

double largest_share_off(const LumenProfile& profile, const ReferenceLine& line,
                         const std::function<double(double)>& healthy) {
  double off = 0.0;
  for (std::size_t i = 0; i < line.diameter_mm.size(); ++i) {
    const double truth = healthy(profile.sections[i].s_mm);
    off = std::max(off, std::abs(line.diameter_mm[i] - truth) / truth);
  }
  return off;
}

TEST(ReferenceLine, FollowsATaper) {
  const auto healthy = [](double s) { return 4.0 - 0.018 * s; };
  const LumenProfile profile = profile_of(120.0, 0.5, healthy);
  const ReferenceLine line = reference_line(profile, {});
  ASSERT_EQ(line.diameter_mm.size(), profile.sections.size());
  EXPECT_LT(largest_share_off(profile, line, healthy), 0.005);
}

TEST(ReferenceLine, PassesOverLesions) {
  const auto healthy = [](double s) { return 4.0 - 0.018 * s; };
  for (const double severity : {0.3, 0.5, 0.8}) {
    const auto diseased = [&](double s) {
      return healthy(s) * (1.0 - severity * (bump(s, 40.0, 14.0) + bump(s, 90.0, 8.0)));
    };
    const LumenProfile profile = profile_of(120.0, 0.5, diseased);
    EXPECT_LT(largest_share_off(profile, reference_line(profile, {}), healthy), 0.03) << severity;
  }
}

TEST(ReferenceLine, PassesOverAnEctasiaAndALesionAtEitherEnd) {
  const auto healthy = [](double s) { return 3.6 - 0.012 * s; };
  const auto diseased = [&](double s) {
    return healthy(s) *
           (1.0 + 0.6 * bump(s, 50.0, 12.0) - 0.6 * bump(s, 1.0, 12.0) - 0.5 * bump(s, 99.0, 12.0));
  };
  const LumenProfile profile = profile_of(100.0, 0.5, diseased);
  EXPECT_LT(largest_share_off(profile, reference_line(profile, {}), healthy), 0.04);
}

TEST(ReferenceLine, StepsAtBranches) {
  const auto healthy = [](double s) { return (s < 12.0 ? 4.6 : s < 40.0 ? 3.5 : 2.9) - 0.008 * s; };
  const LumenProfile profile = profile_of(90.0, 0.5, healthy);
  const auto with = reference_line(profile, {12.0, 40.0}), without = reference_line(profile, {});
  EXPECT_LT(largest_share_off(profile, with, healthy), 0.02);
  EXPECT_GT(largest_share_off(profile, without, healthy), 0.05);
}

TEST(ReferenceLine, AThinSideBranchHasALineOfItsOwn) {
  const auto healthy = [](double s) { return s < 30.0 ? 4.0 - 0.01 * s : 1.5 - 0.004 * (s - 30.0); };
  const LumenProfile profile = profile_of(80.0, 0.5, [&](double s) {  // the mouth is a funnel
    return healthy(s) + (s >= 30.0 && s < 32.5 ? 0.6 * (32.5 - s) : 0.0);
  });
  const ReferenceLine line = reference_line(profile, {30.0}, {.joints = {{30.0, 0.0}}});
  EXPECT_LT(largest_share_off(profile, line, healthy), 0.03);
  EXPECT_TRUE(find_stenoses(profile, line).empty());
  const auto narrowed = [&](double s) { return healthy(s) * (1.0 - 0.5 * bump(s, 50.0, 10.0)); };
  const LumenProfile ill = profile_of(80.0, 0.5, narrowed);
  const auto found = find_stenoses(ill, reference_line(ill, {30.0}, {.joints = {{30.0, 0.0}}}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found.front().diameter_percent, 50.0, 3.0);
  for (const double own : {-3.0, 0.0, 80.0, 500.0})  // outside the vessel: one line
    EXPECT_EQ(reference_line(ill, {30.0}, {.joints = {{own, 0.0}}}).diameter_mm,
              reference_line(ill, {30.0}).diameter_mm);
}

TEST(ReferenceLine, OverAShortDiseasedStretchBetweenBranchesLiesBetweenItsNeighbours) {
  const auto healthy = [](double s) { return s < 30.0 ? 3.4 : s < 40.0 ? 3.1 : 2.8; };
  const LumenProfile profile =
      profile_of(80.0, 0.5, [&](double s) { return s >= 30.0 && s < 40.0 ? 1.4 : healthy(s); });
  const ReferenceLine line = reference_line(profile, {30.0, 40.0});
  for (std::size_t i = 61; i < 80; ++i) {
    EXPECT_GT(line.diameter_mm[i], 2.75);
    EXPECT_LT(line.diameter_mm[i], 3.45);
  }
}

TEST(ReferenceLine, NeverRisesAndBridgesWhatIsNotMeasured) {
  const LumenProfile profile = profile_of(100.0, 0.5, [](double s) {
    if (s > 45.0 && s < 60.0) return 0.0;
    return 3.0 - 0.01 * s + 0.12 * std::sin(0.9 * s) + 0.05 * std::sin(2.3 * s);
  });
  const ReferenceLine line = reference_line(profile, {22.0});
  for (std::size_t i = 1; i < line.diameter_mm.size(); ++i)
    EXPECT_LE(line.diameter_mm[i], line.diameter_mm[i - 1]);
  EXPECT_NEAR(line.diameter_mm[105], 3.0 - 0.525, 0.15);
  const LumenProfile shut = profile_of(20.0, 0.5, [](double) { return 0.0; });
  for (const double d : reference_line(shut, {}).diameter_mm) EXPECT_EQ(d, 0.0);
}

TEST(ReferenceLine, RefusesBadOptions) {
  const LumenProfile profile = profile_of(20.0, 0.5, [](double) { return 3.0; });
  EXPECT_THROW(reference_line(profile, {}, {.window_mm = 2.0}), InvalidInput);
  EXPECT_THROW(reference_line(profile, {std::nan("")}), InvalidInput);
  EXPECT_THROW(reference_line(LumenProfile{}, {}), InvalidInput);
  EXPECT_EQ(reference_line(profile, {-5.0, 0.0, 20.0, 400.0}).diameter_mm.size(),
            41u);  // ends are no branches
}

TEST(BranchAbscissas, AreWhereOthersLeave) {
  const lumen::LumenModel model =
      lumen::model_of_tubes(lumen::testing::tree_of(geometry::coronary_like_tree()));
  for (const geometry::Vessel& vessel : model.tree.vessels) {
    const std::vector<double> branches = branch_abscissas(model, vessel.id);
    EXPECT_TRUE(std::is_sorted(branches.begin(), branches.end()));
    EXPECT_EQ(branches.size() + 1, vessel.segments.size());
    const double own = lumen::own_from_mm(model.tree, vessel.id);
    if (own > 0.0) {
      EXPECT_TRUE(std::any_of(branches.begin(), branches.end(), [&](double s) {
        return std::abs(s - own) < 0.05;
      })) << vessel.name;
    }
  }
  EXPECT_THROW(branch_abscissas(model, 77), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
