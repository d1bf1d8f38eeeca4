#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/imaging/sampling.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/repair.h"
#include "ostia/pipeline/source.h"
#include "ostia/reformat/section.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace ostia::pipeline {
namespace {

using geometry::Centerline;
using geometry::Vec3;

constexpr int kDirections = 24;

/// Directions across the axis, all round.
Vec3 across(const Centerline& axis, std::size_t at, int direction) {
  const double angle = 2.0 * std::numbers::pi * direction / kDirections;
  return std::cos(angle) * axis.frames[at].normal + std::sin(angle) * axis.frames[at].binormal;
}

/// From the distances of the wall in these directions. Along a side branch or a neighbour there is no wall
/// near by: the middle half of the distances leaves those out.
double diameter(std::vector<double> radii) {
  std::sort(radii.begin(), radii.end());
  const std::size_t first = radii.size() / 4, last = 3 * radii.size() / 4;
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) sum += radii[i];
  return 2.0 * sum / static_cast<double>(last - first);
}

/// Diameter at half-maximum of the profiles across the axis: what a radiologist's calliper shows.
double half_maximum_diameter(const imaging::ImageVolume& image, const Centerline& axis, std::size_t at,
                             double reach_mm) {
  constexpr double step = 0.05;
  const double lumen = imaging::sample(image, axis.points[at]);
  std::vector<double> radii;
  for (int d = 0; d < kDirections; ++d) {
    const Vec3 way = across(axis, at, d);
    double least = lumen;
    for (double r = 0.0; r < reach_mm; r += step)
      least = std::min(least, imaging::sample(image, axis.points[at] + r * way));
    for (double r = 0.0; r < reach_mm; r += step) {
      if (imaging::sample(image, axis.points[at] + r * way) < 0.5 * (lumen + least)) {
        radii.push_back(r);
        break;
      }
    }
  }
  return diameter(radii);
}

/// The same of the model's section: where rays in the same directions meet it first.
double section_diameter(const geometry::TriMesh& lumen, const Centerline& axis, std::size_t at) {
  const auto lines = reformat::section(lumen, axis.points[at], axis.frames[at].tangent);
  std::vector<double> radii;
  for (int d = 0; d < kDirections; ++d) {
    const Vec3 way = across(axis, at, d);
    const Vec3 side = axis.frames[at].tangent.cross(way);
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& line : lines) {
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 a = line[i] - axis.points[at], b = line[i + 1] - axis.points[at];
        const double from = a.dot(side), to = b.dot(side);
        if ((from < 0.0) == (to < 0.0)) continue;
        const double r = (a + from / (from - to) * (b - a)).dot(way);
        if (r > 0.0) nearest = std::min(nearest, r);
      }
    }
    if (std::isfinite(nearest)) radii.push_back(nearest);
  }
  return diameter(radii);
}

/// VMTK's capper closed it, by fans whose middles stand a tenth of a radius off their rims.
TEST(SurfaceReal, ACappedCarotidKeepsAllOfItsLength) {
  OSTIA_REQUIRE_SHARED(file, "vessels/carotid-jackyko/leftlumen_capped.stl");
  const Source source = load(file);
  ASSERT_EQ(source.ends.size(), 3u);
  const auto loops = geometry::boundary_loops(source.surface);
  EXPECT_EQ(loops.size(), 3u);
  const geometry::Box3 box = geometry::bounds(source.surface.points);
  EXPECT_LT(box.min().z(), -21.5);
  EXPECT_GT(box.max().z(), 29.3);
}

TEST(ModelReal, AscendingAortaOfACta) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  ModelOptions options;
  options.branches = {{Vec3(8.5, -187.6, 675.2), std::nullopt, Vec3(5.6, -177.9, 720.2)}};
  const Model model = build_model(load(path), options);
  EXPECT_TRUE(model.meshed.quality.verdict.ok()) << model.meshed.quality.verdict.summary();
  ASSERT_EQ(model.meshed.centerlines.lines.size(), 1u);
  EXPECT_GT(model.meshed.centerlines.lines[0].abscissa.back(), 25.0);
}

TEST(ModelReal, CarotidSurface) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/lumen.stl");
  Source source = load(path);
  EXPECT_GE(source.warnings.size(), 2u);  // six non-manifold edges and a loose part
  const Model model = build_model(std::move(source), {});
  EXPECT_TRUE(model.meshed.quality.verdict.ok()) << model.meshed.quality.verdict.summary();
  EXPECT_EQ(model.meshed.centerlines.tree.vessels.size(), 2u);
}

TEST(ModelReal, DescendingAortaFromADicomFolder) {
  OSTIA_REQUIRE_SHARED(zip, "cta/rider-pilot-chest-pe-cta/dicom-series-95.zip");
  ModelOptions options;
  options.branches = {{Vec3(-4.3, -12.3, -273.0), std::nullopt, Vec3(-0.2, 8.7, -210.4)}};
  const Model model = build_model(load(testing::unpacked(zip)), options);
  EXPECT_TRUE(model.meshed.quality.verdict.ok()) << model.meshed.quality.verdict.summary();
}

TEST(ModelReal, LungArteryHasItsHalfMaximumDiameter) {
  OSTIA_REQUIRE_SHARED(zip, "cta/rider-pilot-chest-pe-cta/dicom-series-95.zip");
  ModelOptions options;
  options.branches = {{Vec3(60.0, -1.4, -211.6), std::nullopt, Vec3(91.0, -1.1, -240.0)}};
  const Source source = load(testing::unpacked(zip));
  const auto image = source.image;
  const Model model = build_model(source, options);
  EXPECT_TRUE(model.meshed.quality.verdict.ok()) << model.meshed.quality.verdict.summary();
  const Centerline& axis = model.meshed.centerlines.lines.at(0);
  for (int place = 1; place <= 10; ++place) {
    const std::size_t at = axis.size() * static_cast<std::size_t>(place) / 11;
    const double profile = half_maximum_diameter(*image, axis, at, 6.0);
    RecordProperty("at_" + std::to_string(place),
                   std::to_string(section_diameter(model.lumen, axis, at) - profile));
    EXPECT_NEAR(section_diameter(model.lumen, axis, at), profile, 0.25)
        << "at " << axis.abscissa[at] << " mm";
    EXPECT_GT(profile, 3.0);
    EXPECT_LT(profile, 6.0);
  }
}

}  // namespace
}  // namespace ostia::pipeline
