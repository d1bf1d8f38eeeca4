// Balls painted into label volumes.

#include "ostia/evaluation/label_scores.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::evaluation {
namespace {

using imaging::ImageVolume;
using imaging::Vec3;

using std::numbers::pi;
constexpr double spacing_mm = 0.2;

ImageVolume nothing(std::int64_t n = 60) {
  imaging::Geometry g;
  g.size = {n, n, n};
  g.spacing = Vec3::Constant(spacing_mm);
  g.origin = Vec3::Constant(-0.5 * spacing_mm * static_cast<double>(n - 1));
  return {g, std::vector<std::int16_t>(static_cast<std::size_t>(g.voxels()), 0)};
}

void paint(ImageVolume& image, double radius_mm, const Vec3& centre, std::int16_t label) {
  const auto& size = image.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const Vec3 p = image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        if ((p - centre).norm() < radius_mm) image(i, j, k) = label;
      }
}

ImageVolume label_ball(double radius_mm, const Vec3& centre = Vec3::Zero(), std::int16_t label = 1) {
  ImageVolume image = nothing();
  paint(image, radius_mm, centre, label);
  return image;
}

double ball_mm3(double r) {
  return 4.0 / 3.0 * pi * r * r * r;
}

TEST(BoundaryOf, ABallIsClosedAndWithinAVoxel) {
  const geometry::TriMesh mesh = boundary_of(label_ball(4.0), 1);
  EXPECT_EQ(geometry::find_faults(mesh, false).open_edges, 0u);
  EXPECT_NEAR(geometry::volume(mesh), ball_mm3(4.0), 0.03 * ball_mm3(4.0));
  for (const Vec3& p : mesh.points)
    EXPECT_NEAR(p.norm(), 4.0, 0.87 * spacing_mm) << "half a voxel's diagonal";
  EXPECT_TRUE(boundary_of(label_ball(4.0), 2).triangles.empty());
}

TEST(CompareLabels, ConcentricBalls) {
  const std::vector<LabelScore> scores = compare_labels(label_ball(4.0), label_ball(4.6));
  ASSERT_EQ(scores.size(), 1u);
  const LabelScore& s = scores.front();
  const double a = ball_mm3(4.0), b = ball_mm3(4.6);
  EXPECT_NEAR(s.overlap.reference_mm3, a, 0.01 * a);
  EXPECT_NEAR(s.overlap.result_mm3, b, 0.01 * b);
  EXPECT_NEAR(s.difference_mm3, b - a, 0.02 * (b - a));
  EXPECT_NEAR(s.overlap.dice, 2.0 * a / (a + b), 0.005);
  EXPECT_NEAR(s.overlap.jaccard, a / b, 0.01);
  EXPECT_NEAR(s.boundary.msd_mm, 0.6, 0.25 * spacing_mm) << "steps of voxels are evened out in the mean";
  EXPECT_NEAR(s.boundary.rms_sd_mm, 0.6, 0.25 * spacing_mm);
  EXPECT_NEAR(s.boundary.signed_mean_mm, 0.6, 0.25 * spacing_mm);
  EXPECT_NEAR(s.boundary.hd95_mm, 0.6, spacing_mm);
  EXPECT_NEAR(s.boundary.max_sd_mm, 0.6, 1.8 * spacing_mm);
}

TEST(CompareLabels, ShiftedBallsShareALens) {
  const double r = 3.0, d = 1.0;  // whole voxels: both are painted alike
  const LabelScore s = compare_labels(label_ball(r), label_ball(r, Vec3(d, 0.0, 0.0))).front();
  const double lens = pi * (4.0 * r + d) * (2.0 * r - d) * (2.0 * r - d) / 12.0;
  EXPECT_NEAR(s.overlap.dice, lens / ball_mm3(r), 0.01);
  EXPECT_NEAR(s.difference_mm3, 0.0, 1e-9);
  // Distance from a point of one sphere to the other: | |p - c| - r |; its cosine is even on [-1, 1].
  double mean = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double cosine = -1.0 + (i + 0.5) / 1000.0;
    mean += std::abs(std::sqrt(r * r + d * d - 2.0 * r * d * cosine) - r) / 2000.0;
  }
  EXPECT_NEAR(s.boundary.msd_mm, mean, 0.25 * spacing_mm);
  EXPECT_NEAR(s.boundary.max_sd_mm, d, 1.0 * spacing_mm);
}

TEST(CompareLabels, TheSameIsTheSame) {
  const LabelScore s = compare_labels(label_ball(3.0), label_ball(3.0)).front();
  EXPECT_DOUBLE_EQ(s.overlap.dice, 1.0);
  EXPECT_DOUBLE_EQ(s.overlap.jaccard, 1.0);
  EXPECT_NEAR(s.boundary.max_sd_mm, 0.0, 1e-9);
}

TEST(CompareLabels, LabelByLabel) {
  ImageVolume a = label_ball(2.0, Vec3(-3.0, 0.0, 0.0), 3), b = label_ball(2.0, Vec3(-3.0, 0.0, 0.0), 3);
  paint(a, 1.0, Vec3(3.0, 0.0, 0.0), 7);
  paint(b, 1.0, Vec3(3.0, 0.0, 0.0), 9);
  const std::vector<LabelScore> scores = compare_labels(a, b);
  ASSERT_EQ(scores.size(), 3u);
  EXPECT_EQ(scores[0].label, 3);
  EXPECT_DOUBLE_EQ(scores[0].overlap.dice, 1.0);
  EXPECT_EQ(scores[1].label, 7);
  EXPECT_FALSE(scores[1].in_result);
  EXPECT_EQ(scores[1].overlap.dice, 0.0);
  EXPECT_TRUE(std::isnan(scores[1].boundary.msd_mm));
  EXPECT_EQ(scores[2].label, 9);
  EXPECT_FALSE(scores[2].in_reference);
}

TEST(CompareLabels, ABallAtTheBorderIsClosedThere) {
  const ImageVolume cut = label_ball(3.0, Vec3(6.0, 0.0, 0.0));
  EXPECT_EQ(geometry::find_faults(boundary_of(cut, 1), false).open_edges, 0u);
  EXPECT_NEAR(compare_labels(cut, cut).front().boundary.max_sd_mm, 0.0, 1e-9);
}

std::string refusal(const ImageVolume& a, const ImageVolume& b) {
  try {
    compare_labels(a, b);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(CompareLabels, BadInputIsNamed) {
  ImageVolume moved = label_ball(3.0);
  moved.geometry.origin.x() += 0.1;
  EXPECT_NE(refusal(label_ball(3.0), moved).find("grids"), std::string::npos);
  EXPECT_NE(refusal(label_ball(3.0), nothing(50)).find("grids"), std::string::npos);
  EXPECT_NE(refusal(nothing(), nothing()).find("empty"), std::string::npos);
  EXPECT_NE(refusal(nothing(), label_ball(3.0)).find("swapped"), std::string::npos);
  ImageVolume grey = nothing();
  for (std::size_t i = 0; i < grey.voxels.size(); ++i) grey.voxels[i] = static_cast<std::int16_t>(i % 500);
  EXPECT_NE(refusal(grey, grey).find("grey"), std::string::npos);
  EXPECT_EQ(compare_labels(label_ball(3.0), nothing()).front().overlap.dice, 0.0) << "an empty result counts";
}

}  // namespace
}  // namespace ostia::evaluation
