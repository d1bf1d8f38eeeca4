#include "ostia/geometry/cage_motion.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::geometry {
namespace {

CageMotion whole() {
  CageMotion motion;
  motion.grid.cells = 2;
  for (const double phase : {0.0, 0.4, 0.75})
    motion.phases.push_back({phase, rest_points(motion.grid), PhaseOrigin::fitted});
  return motion;
}

std::string message(const CageMotion& motion) {
  try {
    validate(motion, "beat.json");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(CageMotion, AWholeOneIsTaken) {
  EXPECT_NO_THROW(validate(whole()));
}

TEST(CageMotion, WhatIsWrongIsNamedWithItsPhase) {
  CageMotion motion = whole();
  motion.phases[1].control_points.pop_back();
  EXPECT_EQ(message(motion), "beat.json: the phase 40 % has 26 control points, the grid has 27");
  motion = whole();
  motion.phases[2].control_points[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(motion), "beat.json: the phase 75 % has a control point that is not a number");
}

TEST(CageMotion, PhasesMustRiseWithinTheCycle) {
  for (const double wrong : {-0.1, 0.0, 0.75, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    CageMotion motion = whole();
    motion.phases[1].phase = wrong;
    EXPECT_NE(message(motion).find("phases must rise from 0 to below 1"), std::string::npos) << wrong;
  }
  CageMotion motion = whole();
  motion.phases.clear();
  EXPECT_EQ(message(motion), "beat.json has no phases");
  motion = whole();
  motion.template_phase = 1.0;
  EXPECT_NE(message(motion).find("the template's phase"), std::string::npos);
}

TEST(CageMotion, AGridWithoutSizeIsRefused) {
  CageMotion motion = whole();
  motion.grid.cell_mm.z() = 0.0;
  EXPECT_NE(message(motion).find("the grid needs"), std::string::npos);
  motion = whole();
  motion.grid.cells = 0;
  EXPECT_NE(message(motion).find("the grid needs"), std::string::npos);
}

}  // namespace
}  // namespace ostia::geometry
