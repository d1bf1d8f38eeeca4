#include "ostia/experiments/carotid.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/experiments/carotid_report.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/surface_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace ostia::experiments {
namespace {

using geometry::Vec3;
using segmentation::WallFeature;
using Kind = AxisResponse::Kind;

SurfaceScanOptions scanner(Kind kind, double width) {
  SurfaceScanOptions how;
  how.grid.size = {40, 40, 40};
  how.grid.spacing = Vec3::Constant(0.5);
  how.grid.origin = Vec3::Constant(-9.75);
  how.response.fill({kind, width});
  how.inside = 1000.0;
  how.outside = 0.0;
  return how;
}

geometry::TriMesh tube() {
  return geometry::surface_of(geometry::straight_tube(12.0, 2.0), 0.2, false);
}

/// A tube that passes through the middle of the grid along z.
geometry::TriMesh centred_tube() {
  geometry::TriMesh mesh = tube();
  for (Vec3& p : mesh.points) p[2] -= 6.0;
  return mesh;
}

double sum(const imaging::ImageVolume& image) {
  double total = 0.0;
  for (const std::int16_t v : image.voxels) total += v;
  return total;
}

TEST(CarotidScan, ShowsTheVolumeOfWhatIsInside) {
  const geometry::TriMesh mesh = centred_tube();
  for (const auto& [kind, width] : {std::pair{Kind::gaussian, 1.2}, std::pair{Kind::k_space, 1.0}}) {
    const auto image = scan_surface(mesh, scanner(kind, width));
    EXPECT_NEAR(sum(image) / 1000.0 * 0.125, geometry::volume(mesh), 0.01 * geometry::volume(mesh));
  }
}

TEST(CarotidScan, GaussianBlurOfATubeIsThatOfADisc) {
  // In the middle of a long tube: 1 - exp(-r^2 / (2 s^2)) of the contrast.
  SurfaceScanOptions how = scanner(Kind::gaussian, 3.0);
  how.grid.origin = Vec3(-10.0, -10.0, -10.0);
  how.response[2].width_mm = 0.5;
  const double sigma = 3.0 / 2.3548200450309493;
  const auto image = scan_surface(centred_tube(), how);
  EXPECT_NEAR(image(20, 20, 20), 1000.0 * (1.0 - std::exp(-2.0 / (sigma * sigma))), 4.0);
}

TEST(CarotidScan, KSpaceRingsAndAGaussianDoesNot) {
  const auto extremes = [](const imaging::ImageVolume& image) {
    const auto [low, high] = std::minmax_element(image.voxels.begin(), image.voxels.end());
    return std::pair<int, int>(*low, *high);
  };
  const auto sharp = extremes(scan_surface(centred_tube(), scanner(Kind::k_space, 1.0)));
  EXPECT_LT(sharp.first, -50);  // Gibbs: some 9 % of the contrast on a flat wall
  EXPECT_GT(sharp.second, 1050);
  const auto smooth = extremes(scan_surface(centred_tube(), scanner(Kind::gaussian, 1.0)));
  EXPECT_GE(smooth.first, 0);
  EXPECT_LE(smooth.second, 1000);
  SurfaceScanOptions magnitude = scanner(Kind::k_space, 1.0);
  magnitude.magnitude = true;
  EXPECT_GE(extremes(scan_surface(centred_tube(), magnitude)).first, 0);
}

TEST(CarotidScan, NoiseHasTheDeviationAskedFor) {
  for (const auto& [kind, width] : {std::pair{Kind::gaussian, 1.2}, std::pair{Kind::k_space, 1.0}}) {
    SurfaceScanOptions how = scanner(kind, width);
    const auto clean = scan_surface(centred_tube(), how);
    how.noise = 50.0;
    const auto noisy = scan_surface(centred_tube(), how);
    double squares = 0.0;
    for (std::size_t n = 0; n < clean.voxels.size(); ++n)
      squares += std::pow(noisy.voxels[n] - clean.voxels[n], 2);
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(clean.voxels.size())), 50.0, 2.5);
    EXPECT_EQ(noisy.voxels, scan_surface(centred_tube(), how).voxels);
  }
}

TEST(CarotidScan, RefusesWhatItCannotScan) {
  SurfaceScanOptions how = scanner(Kind::k_space, 0.7);  // 20 mm are no whole number of 0.7 mm
  EXPECT_THROW(scan_surface(centred_tube(), how), InvalidInput);
  how = scanner(Kind::gaussian, 1.0);
  EXPECT_THROW(scan_surface(geometry::surface_of(geometry::straight_tube(12.0, 2.0), 0.2, true), how),
               InvalidInput);
}

TEST(CarotidPoints, HaveTheErrorAskedForAndDistancesToThemFollow) {
  const geometry::TriMesh mesh = tube();
  CarotidOptions options;
  const auto measured = measured_points(mesh, options);
  ASSERT_GT(measured.size(), 60u * 15u);
  std::vector<double> off;
  std::vector<Vec3> on_wall, normals;
  for (int n = 0; n < 400; ++n) {
    const double angle = 0.7 * n, z = 3.0 + 6.0 * n / 400.0;
    normals.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    on_wall.push_back(2.2 * normals.back() + z * Vec3::UnitZ());
  }
  for (const auto& m : measured)
    if (m.point[2] > 3.0 && m.point[2] < 9.0) off.push_back(m.point.head<2>().norm() - 2.0);
  const Spread error = spread_of(off), found = spread_of(distances_to(measured, on_wall, normals));
  EXPECT_NEAR(error.mean, -0.09, 0.01);
  EXPECT_NEAR(error.sd, 0.06, 0.01);
  EXPECT_NEAR(found.mean, 0.29, 0.015);  // 0.2 outside of a wall that was measured 0.09 inside of its place
  EXPECT_LT(found.sd, 0.05);
}

/// A wide bifurcation with open ends, of the calibre that the paper's phantom has.
CarotidPhantom small_phantom() {
  return carotid_phantom(geometry::surface_of(geometry::y_junction(14.0, 20.0, 3.2, 2.4, 70.0), 0.4, true));
}

TEST(Carotid, CentredDifferencesPutTheWallInsideOfUpwindOnes) {
  const CarotidPhantom phantom = small_phantom();
  ASSERT_EQ(phantom.lines.size(), 2u);
  CarotidOptions options;
  options.scans = {CarotidScan::ct, CarotidScan::mr_coronal};
  const CarotidResult result = run_carotid(phantom, options);
  ASSERT_EQ(result.runs.size(), 6u);
  for (std::size_t scan = 0; scan < 2; ++scan) {
    const CarotidRun &centred = result.runs[3 * scan], &upwind = result.runs[3 * scan + 1];
    EXPECT_LT(centred.surface.mean, -0.015) << name_of(centred.scan);
    EXPECT_GT(upwind.surface.mean, centred.surface.mean) << name_of(centred.scan);
    EXPECT_NEAR(upwind.points.mean - upwind.surface.mean, 0.09, 0.02);
    EXPECT_LT(upwind.alignment.rms_mm, upwind.alignment.rms_before_mm);
  }
  EXPECT_LT(result.runs[3].surface.mean, result.runs[0].surface.mean);  // more with larger voxels
  const std::filesystem::path folder = testing::temporary_folder("carotid");
  write_carotid_report(folder, phantom, result);
  for (const char* file : {"table.csv", "by-calibre.csv", "slices.png", "distances.png", "calibre.png",
                           "report.html", "ct-upwind.vtp", "mr-coronal-edges.vtp"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
}

TEST(Carotid, OfAPatientIsFoundInACt) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/lumen.stl");
  const CarotidPhantom phantom = carotid_phantom(io::read_surface(path).surface.mesh);
  CarotidOptions options;
  options.scans = {CarotidScan::ct};
  options.features = {WallFeature::upwind};
  const CarotidResult result = run_carotid(phantom, options);
  EXPECT_NEAR(result.runs[0].surface.mean, 0.0, 0.02);
  EXPECT_LT(result.runs[0].surface.sd, 0.07);
  EXPECT_NEAR(result.measured_error.mean, -0.09, 0.005);
}

TEST(Carotid, RefusesBadOptions) {
  CarotidOptions options;
  options.thresholds = {};
  EXPECT_THROW(validate(options), InvalidInput);
  options = {};
  options.features.clear();
  EXPECT_THROW(validate(options), InvalidInput);
}

}  // namespace
}  // namespace ostia::experiments
