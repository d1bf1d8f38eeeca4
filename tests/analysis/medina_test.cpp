// Medina's classes of made bifurcations.

#include "ostia/analysis/medina.h"

#include "y_junction.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::analysis {
namespace {

using testing::Narrowing;
using testing::Solved;
using testing::YJunction;

struct Read {
  LumenProfile profile;
  ReferenceLine line;
  MeasuredVessel of() const { return {profile, line}; }
};
Read read(const Solved& solved, std::int32_t vessel) {
  Read out{lumen_profile(solved.model, solved.surface_of(), vessel), {}};
  out.line = reference_line(out.profile, branch_abscissas(solved.model, vessel),
                            reading_from_ostium(ostia_of(solved.model, solved.surface_of(), vessel)));
  return out;
}

MedinaClass classed(const YJunction& y, const MedinaOptions& options = {}) {
  const Solved solved = y.solved();
  const Read main = read(solved, y.main_id), side = read(solved, y.side_id);
  return medina_class(main.of(), side.of(), ostium_of(solved.model, solved.surface_of(), y.side_id), options);
}

YJunction with(bool proximal, bool distal, bool side, double share = 0.65) {
  YJunction y;
  if (proximal) y.main = Narrowing{y.joint_mm - 3.0, 5.0, share};
  if (distal) y.distal = Narrowing{y.ostium_mm() + 2.5, 5.0, share};
  if (side) y.side = Narrowing{y.ostium_mm() + 2.5, 5.0, share};
  return y;
}

TEST(Medina, OfAllClasses) {
  for (int bits = 0; bits < 8; ++bits) {
    const bool proximal = bits & 4, distal = bits & 2, side = bits & 1;
    const MedinaClass found = classed(with(proximal, distal, side));
    const std::string wanted =
        std::string(proximal ? "1" : "0") + "," + (distal ? "1" : "0") + "," + (side ? "1" : "0");
    EXPECT_EQ(to_string(found), wanted)
        << found.proximal_percent << ' ' << found.distal_percent << ' ' << found.side_percent;
    EXPECT_EQ(found.any(), bits != 0);
    EXPECT_NEAR(found.proximal_percent, proximal ? 65.0 : 0.0, 8.0);
    EXPECT_NEAR(found.side_percent, side ? 65.0 : 0.0, 8.0);
  }
}

TEST(Medina, LessThanHalfOrFartherAwayIsNone) {
  EXPECT_EQ(to_string(classed(with(true, true, true, 0.4))), "0,0,0");
  YJunction y;
  y.main = Narrowing{y.joint_mm - 9.0, 5.0, 0.65};
  EXPECT_EQ(to_string(classed(y)), "0,0,0");
  EXPECT_EQ(to_string(classed(y, {.region_mm = 10.0})), "1,0,0");
}

TEST(Medina, KnowsWhatLesionsBelongToIt) {
  const YJunction y = with(true, false, true);
  const MedinaClass found = classed(y);
  EXPECT_TRUE(found.holds(y.main_id, y.joint_mm - 5.0, y.joint_mm - 1.0));
  EXPECT_FALSE(found.holds(y.main_id, y.ostium_mm() + 1.0, y.ostium_mm() + 3.0));  // a 0
  EXPECT_FALSE(found.holds(y.main_id, 2.0, 6.0));
  EXPECT_TRUE(found.holds(y.side_id, y.ostium_mm() + 1.0, y.ostium_mm() + 3.0));
  EXPECT_FALSE(found.holds(99, y.joint_mm - 2.0, y.joint_mm));
}

TEST(Medina, OfAShutSideBranchAndOfBadInput) {
  const YJunction y;
  const Solved solved = y.solved();
  const Read main = read(solved, y.main_id);
  Read side = read(solved, y.side_id);
  const Ostium ostium = ostium_of(solved.model, solved.surface_of(), y.side_id);
  EXPECT_NEAR(side_calibre_mm(side.of(), ostium), 2.0 * y.side_radius_mm, 0.1);
  for (SectionMeasures& one : side.profile.sections)
    if (one.s_mm > ostium.ostium_mm + 1.0 && one.s_mm < ostium.ostium_mm + 3.0)
      one.found = false, one.diameter_mm = one.area_mm2 = 0.0;
  EXPECT_EQ(medina_class(main.of(), side.of(), ostium).side_percent, 100.0);
  for (SectionMeasures& one : side.profile.sections) one.open = !one.found;
  EXPECT_FALSE(medina_class(main.of(), side.of(), ostium).side_branch);  // of an open wall nothing is known
  EXPECT_THROW(medina_class(main.of(), side.of(), ostium, {.region_mm = 0.0}), InvalidInput);
  EXPECT_THROW(medina_class(main.of(), side.of(), ostium, {.least_percent = 120.0}), InvalidInput);
  side.line.diameter_mm.pop_back();
  EXPECT_THROW(medina_class(main.of(), side.of(), ostium), InvalidInput);
}

TEST(ReadingOrder, RightFirstThenLeftByAnatomyThenTheUnknown) {
  geometry::VesselTree tree;
  const auto add = [&](std::int32_t id, const char* name, std::int32_t first) {
    tree.vessels.push_back({id, name, {first}});
  };
  add(1, "LAD", 100), add(2, "V1", 300), add(3, "OM2", 100), add(4, "D2", 100), add(5, "RCA", 200),
      add(6, "LCX", 100), add(7, "OM1", 100), add(8, "PDA", 200), add(9, "D1", 100), add(10, "PLB", 100);
  EXPECT_EQ(vessels_in_reading_order(tree), (std::vector<std::int32_t>{5, 8, 1, 9, 4, 6, 7, 3, 10, 2}));
  tree.vessels.push_back({11, "LAD distal", {100, 101}});
  EXPECT_EQ(vessels_in_reading_order(tree), (std::vector<std::int32_t>{5, 8, 1, 11, 9, 4, 6, 7, 3, 10, 2}));
  EXPECT_EQ(usual_name("m 2"), "OM2");
  EXPECT_EQ(usual_name("R-PDA"), "PDA");
  EXPECT_EQ(usual_name("Diag"), "D1");
  EXPECT_EQ(usual_name("graft"), "");
}

}  // namespace
}  // namespace ostia::analysis
