#include "shared_data.h"

#include "ostia/coronary/mask_tree.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace ostia::coronary {
namespace {

/// Ten patients' masks drawn by hand for a public data set.
class PatientMask : public ::testing::TestWithParam<const char*> {};

/// Distance beyond the wall that an axis' radius says, of the vessel that is nearest.
double beyond_wall_mm(const geometry::VesselTree& tree, const Vec3& place) {
  double least = 1e9;
  for (const geometry::TreeSegment& segment : tree.segments) {
    const geometry::PolylineLocation near = geometry::closest(segment.axis.points, place);
    least = std::min(least, (near.point - place).norm() - segment.axis.radius[near.segment]);
  }
  return least;
}

TEST_P(PatientMask, BothTreesAreFoundNamedAndWhole) {
  OSTIA_REQUIRE_SHARED(file, "coronary/patient-masks/" + std::string(GetParam()) + ".nrrd");
  const MaskTree found = mask_tree(imaging::read_labels(file).volume);
  const geometry::VesselTree& tree = found.vessels.tree;
  EXPECT_EQ(geometry::find_fault(tree).value_or("none"), "none");
  ASSERT_EQ(found.ostia.size(), 2U);
  EXPECT_EQ(geometry::roots(tree).size(), 2U);
  for (const char* name : {"LAD", "LCX", "RCA"})
    EXPECT_EQ(std::count_if(tree.vessels.begin(), tree.vessels.end(),
                            [&](const geometry::Vessel& vessel) { return vessel.name == name; }),
              1)
        << name;
  // Nothing that is a millimetre wide or more is lost: all but roughness and stubs lies within a wall.
  std::int64_t all = 0, away = 0;
  const imaging::Geometry& grid = found.lumen.geometry;
  for (std::size_t n = 0; n < found.lumen.voxels.size(); ++n) {
    if (found.lumen.voxels[n] == 0) continue;
    const auto v = static_cast<std::int64_t>(n);
    ++all;
    if (beyond_wall_mm(tree, grid.world(Vec3(static_cast<double>(v % grid.size[0]),
                                             static_cast<double>(v / grid.size[0] % grid.size[1]),
                                             static_cast<double>(v / (grid.size[0] * grid.size[1]))))) > 2.0)
      ++away;
  }
  EXPECT_LT(static_cast<double>(away), 0.02 * static_cast<double>(all));
}

INSTANTIATE_TEST_SUITE_P(ImageCas, PatientMask,
                         ::testing::Values("patient001", "patient002", "patient010", "patient075",
                                           "patient171", "patient401", "patient491", "patient561",
                                           "patient595", "patient627"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace ostia::coronary
