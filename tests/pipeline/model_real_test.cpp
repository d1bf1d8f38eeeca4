#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ostia/imaging/sampling.h"
#include "ostia/pipeline/model.h"
#include "ostia/reformat/section.h"
#include "shared_data.h"

namespace ostia::pipeline {
namespace {

using geometry::Centerline;
using geometry::Vec3;

/// Diameter at half-maximum of the profiles across the axis, the mean over directions: what a radiologist's calliper shows.
double half_maximum_diameter(const imaging::ImageVolume& image, const Centerline& axis, std::size_t at, double reach_mm) {
  constexpr int directions = 24;
  constexpr double step = 0.05;
  double sum = 0.0;
  const double lumen = imaging::sample(image, axis.points[at]);
  std::vector<double> radii;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2.0 * std::numbers::pi * d / directions;
    const Vec3 way = std::cos(angle) * axis.frames[at].normal + std::sin(angle) * axis.frames[at].binormal;
    double least = lumen;
    for (double r = 0.0; r < reach_mm; r += step) least = std::min(least, imaging::sample(image, axis.points[at] + r * way));
    for (double r = 0.0; r < reach_mm; r += step) {
      if (imaging::sample(image, axis.points[at] + r * way) < 0.5 * (lumen + least)) {
        radii.push_back(r);
        break;
      }
    }
  }
  // Directions along a side branch or a neighbour have no wall: the median leaves them out.
  std::sort(radii.begin(), radii.end());
  for (std::size_t i = radii.size() / 4; i < 3 * radii.size() / 4; ++i) sum += radii[i];
  return 2.0 * sum / static_cast<double>(3 * radii.size() / 4 - radii.size() / 4);
}

/// The same statistic of the model's section: the middle half of the radii, so that both leave side branches out.
double section_diameter(const geometry::TriMesh& lumen, const Centerline& axis, std::size_t at) {
  std::vector<double> radii;
  for (const auto& line : reformat::section(lumen, axis.points[at], axis.frames[at].tangent)) {
    for (const Vec3& p : line) {
      const double r = (p - axis.points[at]).norm();
      if (r < 4.0 * axis.radius[at]) radii.push_back(r);
    }
  }
  std::sort(radii.begin(), radii.end());
  double sum = 0.0;
  for (std::size_t i = radii.size() / 4; i < 3 * radii.size() / 4; ++i) sum += radii[i];
  return 2.0 * sum / static_cast<double>(3 * radii.size() / 4 - radii.size() / 4);
}

TEST(ModelReal, AscendingAortaOfACta) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  ModelOptions options;
  options.branches = {{Vec3(8.5, -187.6, 675.2), std::nullopt, Vec3(5.6, -177.9, 720.2)}};
  const Model model = build_model(load(path), options);
  EXPECT_TRUE(model.meshed.verdict.ok()) << model.meshed.verdict.summary();
  ASSERT_EQ(model.meshed.centerlines.lines.size(), 1u);
  EXPECT_GT(model.meshed.centerlines.lines[0].abscissa.back(), 25.0);
}

TEST(ModelReal, CarotidSurface) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/lumen.stl");
  const Model model = build_model(load(path), {});
  EXPECT_TRUE(model.meshed.verdict.ok()) << model.meshed.verdict.summary();
  EXPECT_EQ(model.meshed.centerlines.tree.vessels.size(), 2u);
}

TEST(ModelReal, DescendingAortaFromADicomFolder) {
  OSTIA_REQUIRE_SHARED(zip, "cta/rider-pilot-chest-pe-cta/dicom-series-95.zip");
  ModelOptions options;
  options.branches = {{Vec3(-4.3, -12.3, -273.0), std::nullopt, Vec3(-0.2, 8.7, -210.4)}};
  const Model model = build_model(load(testing::unpacked(zip)), options);
  EXPECT_TRUE(model.meshed.verdict.ok()) << model.meshed.verdict.summary();
}

TEST(ModelReal, LungArteryHasItsHalfMaximumDiameter) {
  OSTIA_REQUIRE_SHARED(zip, "cta/rider-pilot-chest-pe-cta/dicom-series-95.zip");
  ModelOptions options;
  options.branches = {{Vec3(60.0, -1.4, -211.6), std::nullopt, Vec3(91.0, -1.1, -240.0)}};
  const Source source = load(testing::unpacked(zip));
  const auto image = source.image;
  const Model model = build_model(source, options);
  EXPECT_TRUE(model.meshed.verdict.ok()) << model.meshed.verdict.summary();
  const Centerline& axis = model.meshed.centerlines.lines.at(0);
  for (int place = 1; place <= 10; ++place) {
    const std::size_t at = axis.size() * static_cast<std::size_t>(place) / 11;
    const double profile = half_maximum_diameter(*image, axis, at, 6.0);
    EXPECT_NEAR(section_diameter(model.lumen, axis, at), profile, 0.5) << "at " << axis.abscissa[at] << " mm";
    EXPECT_GT(profile, 3.0);
    EXPECT_LT(profile, 6.0);
  }
}

}  // namespace
}  // namespace ostia::pipeline
