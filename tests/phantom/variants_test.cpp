#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/vessel_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::phantom {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

CasePlan plan_with(const CaseVariant& variant, std::uint64_t seed = 1) {
  CaseOptions options;
  options.seed = seed;
  options.preset = Preset::small;
  options.variant = variant;
  return plan_case(options);
}

CasePlan plan_of(Anatomy anatomy) {
  return plan_with({.anatomy = anatomy, .contrast_hu = {}});
}

const CoronaryVessel& named(const CoronaryTree& tree, const std::string& name) {
  const auto at = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                               [&](const CoronaryVessel& vessel) { return vessel.name == name; });
  if (at == tree.vessels.end()) throw InvalidInput("no " + name);
  return *at;
}

/// From the root's axis.
double off_axis(const AorticRoot& root, const Vec3& place) {
  const Vec3 away = place - root.annulus;
  return (away - away.dot(root.axis) * root.axis).norm();
}

int nodules(const CoronaryTree& tree) {
  int count = 0;
  for (const CoronaryVessel& vessel : tree.vessels)
    for (const Plaque& plaque : vessel.plaques) count += plaque.kind == PlaqueKind::calcified ? 1 : 0;
  return count;
}

TEST(Variants, EveryAnatomyGivesASoundTreeAndIsCalledByItsWord) {
  EXPECT_THAT(anatomy_words(), ElementsAre("usual", "left-ostium-closed", "right-ostium-closed",
                                           "rca-from-left", "lcx-from-right", "bypass"));
  for (const std::string& one : anatomy_words()) {
    const Anatomy anatomy = anatomy_of(one);
    EXPECT_EQ(word(anatomy), one);
    EXPECT_EQ(geometry::find_fault(vessel_tree(plan_of(anatomy).tree)).value_or("none"), "none")
        << word(anatomy);
  }
  EXPECT_THAT([] { anatomy_of("odd"); }, ThrowsMessage<InvalidInput>(AllOf(
                                             HasSubstr("\"odd\""), HasSubstr("lcx-from-right or bypass"))));
}

TEST(Variants, AClosedOstiumLeavesAGapBesideTheAorta) {
  for (const auto& [anatomy, name] :
       {std::pair(Anatomy::left_ostium_closed, "LAD"), std::pair(Anatomy::right_ostium_closed, "RCA")}) {
    const CasePlan plan = plan_of(anatomy), usual = plan_of(Anatomy::usual);
    const AorticRoot& root = plan.heart.root;
    EXPECT_NEAR(off_axis(root, named(plan.tree, name).axis.points.front()), root.sinus_radius_mm + 6.0, 0.5);
    EXPECT_LT(off_axis(root, named(usual.tree, name).axis.points.front()), root.sinus_radius_mm);
  }
}

TEST(Variants, OtherOriginsLieInTheOtherSinusAndKeepOffTheRoot) {
  const CasePlan right = plan_of(Anatomy::rca_from_left);
  const AorticRoot& root = right.heart.root;
  const auto towards = [&](const CoronaryVessel& vessel, const Vec3& sinus) {
    return (vessel.axis.points.front() - root.annulus).dot(sinus);
  };
  const CoronaryVessel& rca = named(right.tree, "RCA");
  EXPECT_GT(towards(rca, root.left_sinus), towards(rca, root.right_sinus));
  const CasePlan behind = plan_of(Anatomy::lcx_from_right);
  const CoronaryVessel& lcx = named(behind.tree, "LCX");
  EXPECT_EQ(lcx.parent, -1);
  EXPECT_LT(named(behind.tree, "LAD").axis.radius.front(),
            named(plan_of(Anatomy::usual).tree, "LAD").axis.radius.front());
  EXPECT_GT(towards(lcx, root.right_sinus), towards(lcx, root.left_sinus));
  const Vec3 back = -(root.left_sinus + root.right_sinus).normalized();
  double farthest = 0.0;
  for (const Vec3& point : lcx.axis.points) farthest = std::max(farthest, (point - root.annulus).dot(back));
  EXPECT_GT(farthest, root.annulus_radius_mm) << "behind the root";
  for (const CoronaryVessel* vessel : {&rca, &lcx})
    for (std::size_t i = 80; i < vessel->axis.size(); ++i) {
      const double height = (vessel->axis.points[i] - root.annulus).dot(root.axis);
      if (height > 5.0 && height < root.sinus_height_mm) {
        EXPECT_GT(off_axis(root, vessel->axis.points[i]), root.sinus_radius_mm - 1.5)
            << vessel->name << " " << i;
      }
    }
}

TEST(Variants, AGraftRunsFromTheAscendingAortaIntoTheLad) {
  const CasePlan plan = plan_of(Anatomy::bypass);
  const CoronaryVessel &graft = named(plan.tree, "SVG"), &lad = named(plan.tree, "LAD");
  const AorticRoot& root = plan.heart.root;
  EXPECT_GT((graft.axis.points.front() - root.annulus).dot(root.axis), root.sinus_height_mm + 15.0);
  const Vec3 end = graft.axis.points.back();
  EXPECT_LT((geometry::closest(lad.axis.points, end).point - end).norm(), 4.0);
  EXPECT_GT(graft.axis.abscissa.back(), 50.0);
}

TEST(Variants, CalciumGoesAndComes) {
  const int usual = nodules(plan_with({.contrast_hu = {}}).tree);
  EXPECT_GT(usual, 0);
  EXPECT_EQ(nodules(plan_with({.calcium = 0.0, .contrast_hu = {}}).tree), 0);
  EXPECT_GT(nodules(plan_with({.calcium = 10.0, .contrast_hu = {}}).tree), usual + 100);
  EXPECT_THROW(plan_with({.calcium = -1.0, .contrast_hu = {}}), InvalidInput);
}

TEST(Variants, AStentIsATubeOfMetalInsideTheLumen) {
  const CasePlan plan = plan_with({.stent_mm = 18.0, .contrast_hu = {}});
  const CoronaryVessel& lad = named(plan.tree, "LAD");
  ASSERT_EQ(lad.stents.size(), 1U);
  const Stent& stent = lad.stents.front();
  EXPECT_NEAR(stent.s_to_mm - stent.s_from_mm, 18.0, 1e-9);
  const VesselField field(plan.tree);
  const auto i = static_cast<std::size_t>(10.0 * (stent.s_from_mm + 2.0));
  const auto label = [&](double rho) {
    return field.material(lad.axis.points[i] + rho * lad.axis.frames[i].normal)->label;
  };
  const double radius = lad.lumen.at(lad.axis.abscissa[i], 0.0);
  EXPECT_EQ(label(0.0), Label::coronary_lumen);
  EXPECT_EQ(label(radius - 0.05), Label::metal);
  EXPECT_EQ(label(radius - 0.2), Label::coronary_lumen);
  CoronaryVessel shorter = lad;
  EXPECT_THROW(add_stent(shorter, lad.axis.abscissa.back(), 5.0), InvalidInput);
}

TEST(Variants, ContrastIsAsAskedAndTheDefaultIsSilent) {
  CaseOptions options;
  const TissueHu drawn = body_of(options).hu;
  EXPECT_THAT(parameters_json(options), Not(HasSubstr("variant")));
  options.variant.contrast_hu = 250.0;
  EXPECT_EQ(body_of(options).hu.arterial, 250.0f);
  EXPECT_EQ(body_of(options).hu.vein, drawn.vein);
  options.variant.venous = 1.0;
  EXPECT_EQ(body_of(options).hu.vein, 250.0f);
  EXPECT_EQ(body_of(options).hu.right_heart, 250.0f);
  EXPECT_THAT(parameters_json(options), HasSubstr("\"venous\":1"));
  options.variant.venous = 2.0;
  EXPECT_THROW(validate(options), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
