#include "kept_scan.h"

#include "ostia/core/error.h"
#include "ostia/coronary/aorta.h"
#include "ostia/coronary/ostia.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::coronary {
namespace {

phantom::CasePlan plan(std::uint64_t seed, double spacing_mm) {
  phantom::CaseOptions options;
  options.seed = seed;
  options.preset = phantom::Preset::small;
  phantom::CasePlan made = phantom::plan_case(options);
  imaging::Geometry& grid = made.options.scan.grid;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    grid.size[a] =
        static_cast<std::int64_t>(static_cast<double>(grid.size[a]) * grid.spacing[axis] / spacing_mm);
  }
  grid.spacing.setConstant(spacing_mm);
  // A voxel this wide cannot show the scanner's sharpness.
  made.options.scan.psf_fwhm_mm = made.options.scan.psf_fwhm_z_mm = spacing_mm;
  made.options.scan.noise_peak_per_mm = 0.0;
  return made;
}

/// Every first vessel of the tree begins where an ostium was found, and nowhere else was one.
void expect_ostia(const phantom::CoronaryTree& tree, const std::vector<Ostium>& found, double within_mm) {
  std::size_t roots = 0;
  for (const phantom::CoronaryVessel& vessel : tree.vessels) {
    if (vessel.parent >= 0) continue;
    ++roots;
    double nearest = 1e9;
    for (const Ostium& ostium : found)
      nearest = std::min(nearest, (ostium.place - vessel.axis.points.front()).norm());
    EXPECT_LT(nearest, within_mm) << vessel.name;
  }
  EXPECT_EQ(found.size(), roots);
}

TEST(AortaOfAPhantom, IsAscendingAndBothOstiaAreFound) {
  const phantom::CasePlan made = plan(1, 1.0);
  const imaging::ImageVolume image = ostia::testing::kept_scan(made).image;
  const Aorta aorta = find_aorta(image);
  const phantom::AorticRoot& root = made.heart.root;
  const double first = root.axis.dot(aorta.stations.front().centre - root.annulus);
  EXPECT_LT(std::abs(first), 12.0) << "the root's lower end";
  for (const AortaStation& station : aorta.stations) {
    const double height = root.axis.dot(station.centre - root.annulus);
    if (height > root.sinus_height_mm + 5.0 && station.round > 0.9) {
      EXPECT_NEAR(station.radius_mm, root.ascending_radius_mm, 1.0);
    }
  }
  expect_ostia(made.tree, find_ostia(image, aorta), 1.5);
}

TEST(AortaOfAPhantom, OnlyTheRootInTheImageIsEnough) {
  phantom::CasePlan made = plan(2, 0.6);
  imaging::Geometry& grid = made.options.scan.grid;
  const Vec3 middle = made.heart.root.annulus + 20.0 * made.heart.root.axis;
  grid.origin = middle - Vec3(36.0, 36.0, 30.0);
  grid.size = {120, 120, 100};
  const imaging::ImageVolume image = ostia::testing::kept_scan(made).image;
  expect_ostia(made.tree, find_ostia(image, find_aorta(image)), 1.2);
}

TEST(AortaOfAPhantom, BelowTheRootThereIsNone) {
  phantom::CasePlan made = plan(3, 1.5);
  imaging::Geometry& grid = made.options.scan.grid;
  const double top = made.heart.root.annulus.z() - 12.0;
  grid.size[2] = static_cast<std::int64_t>((top - grid.origin.z()) / grid.spacing.z());
  EXPECT_THROW(find_aorta(ostia::testing::kept_scan(made).image), GeometryError);
}

}  // namespace
}  // namespace ostia::coronary
