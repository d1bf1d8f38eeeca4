#include "shared_data.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/kd_tree.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/vessel_export.h"
#include "ostia/session/found_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::session {
namespace {

using geometry::Vec3;
namespace fs = std::filesystem;

/// Ten patients' masks drawn by hand for a public data set: from a mask to a mesh with three layers.
class PatientMaskMesh : public ::testing::TestWithParam<const char*> {};

std::vector<geometry::TriMesh> lumens_in(const fs::path& folder) {
  std::vector<geometry::TriMesh> lumens;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename() == "lumen.vtp") lumens.push_back(io::read_surface(entry.path()).surface.mesh);
  return lumens;
}

std::vector<Vec3> voxel_centres(const imaging::MaskVolume& mask) {
  std::vector<Vec3> centres;
  const auto& size = mask.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        if (mask(i, j, k) != 0)
          centres.push_back(mask.geometry.world(
              Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))));
  return centres;
}

TEST_P(PatientMaskMesh, PassesTheGateAndKeepsTheLumen) {
  OSTIA_REQUIRE_SHARED(file, "coronary/patient-masks/" + std::string(GetParam()) + ".nrrd");
  const imaging::MaskVolume mask = imaging::read_labels(file).volume;
  const MaskModel made = model_of_mask(mask);
  pipeline::MeshExportOptions options;
  options.volume.layers = meshing::BoundaryLayerOptions{};
  options.volume.layers->layers = 3;
  options.surface_formats = {"vtp"};
  const fs::path folder = ostia::testing::temporary_folder("mask_mesh") / "mesh";
  const pipeline::ExportSummary summary = pipeline::export_mesh(folder, made.found.model, options);
  EXPECT_TRUE(summary.verdict.ok()) << summary.verdict.summary();
  EXPECT_EQ(summary.trees, 2U);
  EXPECT_GT(summary.full_layers.value_or(0.0), 0.95);

  const std::vector<Vec3> voxels = voxel_centres(mask);
  const double mm3 = mask.geometry.spacing.prod() * static_cast<double>(voxels.size());
  EXPECT_GT(summary.volume_mm3, 0.93 * mm3);  // ends are cut a radius inside the mask's
  EXPECT_LT(summary.volume_mm3, 1.02 * mm3);

  const std::vector<geometry::TriMesh> lumens = lumens_in(folder);
  ASSERT_EQ(lumens.size(), 2U);
  const geometry::AabbTree first(lumens[0]), second(lumens[1]);
  std::size_t away = 0;
  for (const Vec3& voxel : voxels) {
    if (first.inside(voxel) || second.inside(voxel)) continue;
    const double off =
        std::min((first.closest(voxel).point - voxel).norm(), (second.closest(voxel).point - voxel).norm());
    if (off > 1.0) ++away;
  }
  EXPECT_LT(static_cast<double>(away), 0.025 * static_cast<double>(voxels.size()));
  const geometry::KdTree near(voxels);
  std::vector<double> off;
  for (const geometry::TriMesh& lumen : lumens)
    for (const Vec3& point : lumen.points)
      off.push_back((voxels[static_cast<std::size_t>(near.nearest(point))] - point).norm());
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[static_cast<std::size_t>(0.99 * static_cast<double>(off.size()))], 1.5);
}

INSTANTIATE_TEST_SUITE_P(ImageCas, PatientMaskMesh,
                         ::testing::Values("patient001", "patient002", "patient010", "patient075",
                                           "patient171", "patient401", "patient491", "patient561",
                                           "patient595", "patient627"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace ostia::session
