#include "two_scans.h"

#include "ostia/registration/register.h"

#include <gtest/gtest.h>

namespace ostia::registration {
namespace {

using namespace two_scans;

TEST(RegisterPhases, PhasesOfOneScanNeedNoLinearMap) {
  const Way way{0.0, Vec3::Zero(), 3.0};
  RegistrationOptions options = phase_options();
  options.finest_voxel_mm = 2.0;
  options.levels = 2;
  options.node_spacing_mm = 14.0;
  options.samples = 15000;
  const Registration found = register_phases(first_scan(), second_scan(way), {}, options);
  EXPECT_LT(mean_error_mm(way, found.transform, landmarks_of(way)), 1.0);
  EXPECT_TRUE(found.affine.linear().isIdentity());
  EXPECT_GT(found.quality.jacobian_min, 0.3);
}

}  // namespace
}  // namespace ostia::registration
