#include "shared_data.h"

#include "ostia/imaging/image_file.h"
#include "ostia/imaging/sampling.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::segmentation {
namespace {

using geometry::Vec3;

geometry::AxisCurve axis_through(const std::vector<Vec3>& points) {
  geometry::Centerline line;
  line.points = points;
  geometry::complete(line);
  return geometry::AxisCurve(line);
}

/// What a reader checks at a glance: bright just inside, dark just outside, and how wide it is.
struct Look {
  double inside_hu = 0.0, outside_hu = 0.0;                ///< medians
  double least_mm = 1e9, mean_mm = 0.0, largest_mm = 0.0;  ///< mean radii of rows
};
Look look_at(const imaging::ImageVolume& image, const geometry::AxisCurve& axis, const LumenBoundary& found,
             double margin_mm) {
  Look look;
  std::vector<double> inside, outside;
  for (int row = 0; row < found.rows(); ++row) {
    const double s = found.from_mm + row * found.step_mm;
    double mean = 0.0;
    for (int a = 0; a < found.around; ++a) {
      const double theta = 2.0 * std::numbers::pi * a / found.around;
      const double r = found.radius_mm[static_cast<std::size_t>(row) * found.around + a];
      mean += r / found.around;
      inside.push_back(imaging::sample(image, axis.place(s, theta, std::max(0.0, r - margin_mm))));
      outside.push_back(imaging::sample(image, axis.place(s, theta, r + margin_mm)));
    }
    look.least_mm = std::min(look.least_mm, mean);
    look.largest_mm = std::max(look.largest_mm, mean);
    look.mean_mm += mean / found.rows();
  }
  const auto middle = [](std::vector<double>& v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
  };
  look.inside_hu = middle(inside);
  look.outside_hu = middle(outside);
  return look;
}

/// A pulmonary artery of about 5 mm across in a chest CTA of 0.65 mm voxels, from the hilum to the base.
TEST(LumenBoundaryReal, PulmonaryArtery) {
  OSTIA_REQUIRE_SHARED(path, "cta/rider-pilot-chest-pe-cta/heart-crop.nrrd");
  const auto image = imaging::read_image(path).volume;
  const auto axis = axis_through({{93.4, -0.6, -242.4},
                                  {88.4, -1.5, -237.6},
                                  {83.5, -1.9, -232.8},
                                  {78.0, -1.7, -228.0},
                                  {72.7, -1.7, -223.2},
                                  {67.9, -1.7, -218.4},
                                  {62.3, -1.4, -213.6},
                                  {56.9, -1.5, -208.8},
                                  {53.0, -1.9, -204.8}});
  LumenBoundaryOptions options;
  options.blur_sigma_mm = 0.55;
  options.largest_radius_mm = 6.0;
  const LumenBoundary found = lumen_boundary(image, axis, 0.0, axis.length(), options);
  EXPECT_NEAR(found.lumen_hu, 267.0, 25.0);
  const Look look = look_at(image, axis, found, 1.1);
  EXPECT_GT(look.inside_hu, 200.0);
  EXPECT_LT(look.outside_hu, -300.0);  // lung
  EXPECT_NEAR(look.mean_mm, 2.4, 0.25);
  EXPECT_GT(look.least_mm, 2.0);
  EXPECT_LT(look.largest_mm, 2.9);  // it leaves the branches at its ends
}

/// The left common carotid artery beside a stented arch, voxels of 1.5 mm.
TEST(LumenBoundaryReal, CarotidArtery) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  const auto image = imaging::read_image(path).volume;
  const auto axis = axis_through({{3.9, -181.3, 739.7},
                                  {5.7, -181.3, 745.7},
                                  {7.5, -179.2, 751.7},
                                  {9.6, -177.0, 757.7},
                                  {11.8, -174.7, 763.7},
                                  {13.6, -172.7, 769.7},
                                  {15.1, -171.4, 775.7},
                                  {16.8, -170.5, 781.7},
                                  {17.6, -170.2, 784.7}});
  LumenBoundaryOptions options;
  options.blur_sigma_mm = 0.7;
  options.largest_radius_mm = 7.0;
  const LumenBoundary found = lumen_boundary(image, axis, 0.0, axis.length(), options);
  const Look look = look_at(image, axis, found, 1.2);
  EXPECT_GT(look.inside_hu, 350.0);
  EXPECT_LT(look.outside_hu, 200.0);
  EXPECT_NEAR(look.mean_mm, 3.0, 0.4);
  EXPECT_GT(look.least_mm, 2.0);
  EXPECT_LT(look.largest_mm, 4.2);
}

}  // namespace
}  // namespace ostia::segmentation
