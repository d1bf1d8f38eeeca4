#include "kept_scan.h"

#include "ostia/core/error.h"
#include "ostia/coronary/mask_tree.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace ostia::coronary {
namespace {

using imaging::MaskVolume;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

/// The lumen of a whole heart at 0.7 x 0.7 x 0.9 mm as a perfect network would have it, and its aorta.
struct MaskedHeart {
  phantom::CasePlan plan;
  MaskVolume lumen, aorta;
};
const MaskedHeart& masked_heart() {
  static const MaskedHeart made = [] {
    phantom::CaseOptions options;
    options.preset = phantom::Preset::small;
    MaskedHeart heart{phantom::plan_case(options), {}, {}};
    const MaskVolume labels = ostia::testing::kept_scan(heart.plan).labels;
    heart.lumen.geometry = heart.aorta.geometry = labels.geometry;
    for (const std::uint8_t voxel : labels.voxels) {
      heart.lumen.voxels.push_back(voxel == static_cast<std::uint8_t>(phantom::Label::coronary_lumen) ? 1
                                                                                                      : 0);
      heart.aorta.voxels.push_back(voxel == static_cast<std::uint8_t>(phantom::Label::aorta) ? 1 : 0);
    }
    return heart;
  }();
  return made;
}

/// Everything within a ball gets a value.
void paint(MaskVolume& mask, const Vec3& centre, double radius_mm, std::uint8_t value) {
  const imaging::Geometry& grid = mask.geometry;
  const Vec3 at = grid.index(centre);
  std::array<std::int64_t, 3> low{}, high{};
  for (int d = 0; d < 3; ++d) {
    const auto k = static_cast<std::size_t>(d);
    low[k] = std::max<std::int64_t>(0, std::lround(at[d] - radius_mm / grid.spacing[d] - 1.0));
    high[k] =
        std::min<std::int64_t>(grid.size[k] - 1, std::lround(at[d] + radius_mm / grid.spacing[d] + 1.0));
  }
  for (std::int64_t k = low[2]; k <= high[2]; ++k)
    for (std::int64_t j = low[1]; j <= high[1]; ++j)
      for (std::int64_t i = low[0]; i <= high[0]; ++i) {
        const Vec3 here =
            grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if ((here - centre).norm() <= radius_mm) mask(i, j, k) = value;
      }
}

void paint_tube(MaskVolume& mask, const Vec3& from, const Vec3& to, double radius_mm, std::uint8_t value) {
  const int steps = 1 + static_cast<int>((to - from).norm() / 0.2);
  for (int i = 0; i <= steps; ++i)
    paint(mask, from + (static_cast<double>(i) / steps) * (to - from), radius_mm, value);
}

const geometry::Vessel& masked_vessel(const geometry::VesselTree& tree, const std::string& name) {
  for (const geometry::Vessel& vessel : tree.vessels)
    if (vessel.name == name) return vessel;
  throw InvalidInput("there is no " + name);
}

std::vector<Vec3> axis_of(const geometry::VesselTree& tree, const std::string& name) {
  return geometry::vessel_axis(tree, masked_vessel(tree, name)).points;
}

double off_all_axes(const geometry::VesselTree& tree, const Vec3& place) {
  double nearest = 1e9;
  for (const geometry::TreeSegment& segment : tree.segments)
    nearest = std::min(nearest, (geometry::closest(segment.axis.points, place).point - place).norm());
  return nearest;
}

/// Of the truth's vessels that are 1 mm wide or more, how much lies within a millimetre of an axis.
double share_found(const geometry::VesselTree& tree) {
  const geometry::VesselTree truth = phantom::vessel_tree(masked_heart().plan.tree);
  double found = 0.0, all = 0.0;
  for (const geometry::TreeSegment& segment : truth.segments)
    for (std::size_t i = 0; i < segment.axis.points.size(); ++i) {
      if (segment.axis.radius[i] < 0.5) continue;
      all += 1.0;
      if (off_all_axes(tree, segment.axis.points[i]) < 1.0) found += 1.0;
    }
  return found / all;
}

TEST(MaskTreePhantom, FindsBothTreesAndNamesThemAndLosesNothing) {
  const MaskTree found = mask_tree(masked_heart().lumen);
  const geometry::VesselTree& tree = found.vessels.tree;
  EXPECT_EQ(geometry::find_fault(tree).value_or("none"), "none");
  ASSERT_EQ(found.ostia.size(), 2U);
  EXPECT_EQ(geometry::roots(tree).size(), 2U);
  EXPECT_EQ(found.notes.size(), tree.vessels.size());
  const geometry::VesselTree truth = phantom::vessel_tree(masked_heart().plan.tree);
  for (const char* name : {"LAD", "LCX", "RCA"}) {
    const std::vector<Vec3> wanted = axis_of(truth, name), made = axis_of(tree, name);
    EXPECT_LT((made.front() - wanted.front()).norm(), 4.0) << name;
    EXPECT_GT(geometry::length(made), 0.85 * geometry::length(wanted)) << name;
  }
  EXPECT_GT(share_found(tree), 0.97);
  EXPECT_TRUE(found.bridges.empty());
  EXPECT_TRUE(found.cuts.empty());
}

TEST(MaskTreePhantom, GapsAreBridgedAndTold) {
  MaskVolume mask = masked_heart().lumen;
  const std::vector<Vec3> lad = axis_of(phantom::vessel_tree(masked_heart().plan.tree), "LAD");
  const Vec3 gap = geometry::at_abscissa(lad, 0.6 * geometry::length(lad)).point;
  paint(mask, gap, 2.6, 0);
  const MaskTree found = mask_tree(mask);
  ASSERT_EQ(found.bridges.size(), 1U);
  EXPECT_LT((0.5 * (found.bridges[0].from + found.bridges[0].to) - gap).norm(), 2.0);
  EXPECT_NEAR(found.bridges[0].length_mm(), 5.2, 3.0);
  EXPECT_GT(found.bridges[0].probability, 0.5);
  EXPECT_THAT(found.warnings, Contains(AllOf(HasSubstr("bridged"), HasSubstr("probability"))));
  EXPECT_EQ(geometry::roots(found.vessels.tree).size(), 2U);
  EXPECT_GT(geometry::length(axis_of(found.vessels.tree, "LAD")), 0.85 * geometry::length(lad));
}

TEST(MaskTreePhantom, AnAttachedAortaIsLeftOutAndTheVesselsBeginAtIt) {
  MaskVolume mask = masked_heart().lumen;
  for (std::size_t n = 0; n < mask.voxels.size(); ++n)
    if (masked_heart().aorta.voxels[n] != 0) mask.voxels[n] = 1;
  const MaskTree found = mask_tree(mask);
  EXPECT_THAT(found.warnings, Contains(HasSubstr("thicker than arteries")));
  const geometry::VesselTree truth = phantom::vessel_tree(masked_heart().plan.tree);
  for (const char* name : {"LAD", "LCX", "RCA"})
    EXPECT_LT((axis_of(found.vessels.tree, name).front() - axis_of(truth, name).front()).norm(), 6.0) << name;
  EXPECT_GT(share_found(found.vessels.tree), 0.95);
}

TEST(MaskTreePhantom, AHundredSpecksAreLeftOutAndCounted) {
  MaskVolume mask = masked_heart().lumen;
  std::uint32_t state = 7;
  const auto next = [&](std::int64_t below) {
    state = state * 1664525U + 1013904223U;
    return static_cast<std::int64_t>(state >> 8) % below;
  };
  int painted = 0;
  while (painted < 100) {
    const std::int64_t i = 2 + next(mask.geometry.size[0] - 4), j = 2 + next(mask.geometry.size[1] - 4),
                       k = 2 + next(mask.geometry.size[2] - 4);
    bool alone = true;
    for (std::int64_t c = -2; c <= 3; ++c)
      for (std::int64_t b = -2; b <= 2; ++b)
        for (std::int64_t a = -2; a <= 2; ++a)
          if (k + c < mask.geometry.size[2]) alone = alone && mask(i + a, j + b, k + c) == 0;
    if (!alone) continue;
    mask(i, j, k) = mask(i, j, std::min(k + 1, mask.geometry.size[2] - 1)) = 1;
    ++painted;
  }
  const MaskTree found = mask_tree(mask);
  EXPECT_THAT(found.warnings, Contains(HasSubstr("100 specks")));
  EXPECT_EQ(geometry::roots(found.vessels.tree).size(), 2U);
  EXPECT_GT(share_found(found.vessels.tree), 0.97);
}

TEST(MaskTreePhantom, TreesThatTouchAtTheirEndsArePartedThere) {
  MaskVolume mask = masked_heart().lumen;
  const geometry::VesselTree truth = phantom::vessel_tree(masked_heart().plan.tree);
  const Vec3 right = axis_of(truth, "RCA").back(), left = axis_of(truth, "LCX").back();
  paint_tube(mask, right, left, 0.7, 1);
  const MaskTree found = mask_tree(mask);
  ASSERT_EQ(found.ostia.size(), 2U);
  ASSERT_GE(found.cuts.size(), 1U);
  EXPECT_EQ(geometry::roots(found.vessels.tree).size(), 2U);
  EXPECT_LT((geometry::closest({right, left}, found.cuts[0].place).point - found.cuts[0].place).norm(), 20.0);
  for (const char* name : {"LAD", "LCX", "RCA"})
    EXPECT_LT((axis_of(found.vessels.tree, name).front() - axis_of(truth, name).front()).norm(), 4.0) << name;
}

TEST(MaskTreePhantom, CirclesAreOpened) {
  MaskVolume mask = masked_heart().lumen;
  const geometry::VesselTree truth = phantom::vessel_tree(masked_heart().plan.tree);
  const std::vector<Vec3> lad = axis_of(truth, "LAD"), lcx = axis_of(truth, "LCX");
  // A thin false bridge between two vessels that are wider, over whatever lies between them.
  const Vec3 from = geometry::at_abscissa(lad, 45.0).point, to = geometry::at_abscissa(lcx, 45.0).point;
  paint_tube(mask, from, to, 0.6, 1);
  const MaskTree found = mask_tree(mask);
  EXPECT_EQ(geometry::find_fault(found.vessels.tree).value_or("none"), "none");
  EXPECT_EQ(geometry::roots(found.vessels.tree).size(), 2U);
  ASSERT_GE(found.cuts.size(), 1U);
  for (const MaskCut& cut : found.cuts)
    EXPECT_LT((geometry::closest({from, to}, cut.place).point - cut.place).norm(), 2.0);
  for (const char* name : {"LAD", "LCX", "RCA"})
    EXPECT_GT(geometry::length(axis_of(found.vessels.tree, name)),
              0.85 * geometry::length(axis_of(truth, name)))
        << name;
}

TEST(MaskTreePhantom, OneTreeAloneHasOneOstium) {
  MaskVolume mask = masked_heart().lumen;
  const geometry::VesselTree truth = phantom::vessel_tree(masked_heart().plan.tree);
  const MaskTree both = mask_tree(mask);
  // The right tree goes: all voxels nearer to it.
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) {
    if (mask.voxels[n] == 0) continue;
    const auto v = static_cast<std::int64_t>(n);
    const imaging::Geometry& grid = mask.geometry;
    const Vec3 at = grid.world(Vec3(static_cast<double>(v % grid.size[0]),
                                    static_cast<double>(v / grid.size[0] % grid.size[1]),
                                    static_cast<double>(v / (grid.size[0] * grid.size[1]))));
    double left = 1e9, right = 1e9;
    for (std::size_t i = 0; i < both.vessels.tree.vessels.size(); ++i) {
      double& side = both.vessels.labels[i].side == CoronarySide::left ? left : right;
      for (const std::int32_t id : both.vessels.tree.vessels[i].segments)
        side = std::min(
            side,
            (geometry::closest(geometry::segment(both.vessels.tree, id).axis.points, at).point - at).norm());
    }
    if (right < left) mask.voxels[n] = 0;
  }
  const MaskTree found = mask_tree(mask);
  ASSERT_EQ(found.ostia.size(), 1U);
  EXPECT_THAT(found.warnings, Contains(HasSubstr("one coronary tree alone")));
  for (const char* name : {"LAD", "LCX"})
    EXPECT_LT((axis_of(found.vessels.tree, name).front() - axis_of(truth, name).front()).norm(), 4.0) << name;
}

std::string refusal_of(const MaskVolume& mask) {
  try {
    mask_tree(mask);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), ExitCode::bad_input);
    return error.what();
  }
  return "no refusal";
}

TEST(MaskTreePhantom, MasksWithoutVesselsAreRefusedWithTheReason) {
  MaskVolume mask = masked_heart().lumen;
  std::fill(mask.voxels.begin(), mask.voxels.end(), std::uint8_t{0});
  EXPECT_THAT(refusal_of(mask), HasSubstr("empty"));
  mask(10, 10, 10) = mask(20, 20, 20) = 1;
  EXPECT_THAT(refusal_of(mask), HasSubstr("specks"));
  EXPECT_THAT(refusal_of(masked_heart().aorta), HasSubstr("organ"));
  std::fill(mask.voxels.begin(), mask.voxels.end(), std::uint8_t{1});
  EXPECT_THAT(refusal_of(mask), HasSubstr("full"));
  mask.voxels.pop_back();
  EXPECT_THROW(mask_tree(mask), InvalidInput);
}

TEST(MaskTreePhantom, OptionsOutOfRangeAreNamed) {
  MaskTreeOptions options;
  options.thick_mm = 1.0;
  EXPECT_THROW(mask_tree(masked_heart().lumen, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::coronary
