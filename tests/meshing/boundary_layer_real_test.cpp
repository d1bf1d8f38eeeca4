// Layers of prisms in real lumina, remeshed by the pipeline, and the tetrahedra inside them.
#include "shared_data.h"

#include "ostia/meshing/boundary_layer.h"
#include "ostia/pipeline/model.h"
#include "ostia/pipeline/repair.h"
#include "ostia/pipeline/source.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace ostia::meshing {
namespace {

geometry::FacedSurface lumen_of(const std::filesystem::path& path) {
  pipeline::Source source = pipeline::load(path);
  source.surface = pipeline::repaired(source.surface).mesh;
  return pipeline::build_model(std::move(source), {}).meshed.surface;
}

void expect_layers_of_all_settings(const geometry::FacedSurface& surface) {
  struct Setting {
    int layers;
    double thickness;
  };
  for (const Setting& setting : {Setting{2, 0.25}, {4, 0.5}, {3, 1.0}, {5, 0.6}}) {
    BoundaryLayerOptions options;
    options.layers = setting.layers;
    options.thickness = setting.thickness;
    const FilledWithLayers filled = fill_with_layers(surface, options);
    const BoundaryLayerReport& report = filled.layers;
    const std::string name = std::to_string(setting.layers) + " layers";
    ::testing::Test::RecordProperty(name + " least scaled Jacobian",
                                    std::to_string(report.min_scaled_jacobian));
    ::testing::Test::RecordProperty(name + " full share", std::to_string(report.full_share));
    ::testing::Test::RecordProperty(name + " smallest dihedral angle",
                                    std::to_string(filled.tetrahedra.quality.min_dihedral_deg));
    EXPECT_EQ(filled.tetrahedra.below_10_deg, 0u) << name;
    EXPECT_LE(1000 * filled.tetrahedra.below_12_deg, filled.tetrahedra.quality.tetrahedra) << name;
    EXPECT_EQ(report.inverted, 0u) << name;
    EXPECT_GE(report.min_scaled_jacobian, 0.1) << name;
    if (setting.layers == 2) {
      EXPECT_GE(report.full_share, 0.95);
    }
  }
}

TEST(BoundaryLayerReal, Carotid) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/lumen.stl");
  expect_layers_of_all_settings(lumen_of(path));
}

TEST(BoundaryLayerReal, VesselWithAneurysm) {
  OSTIA_REQUIRE_SHARED(path, "vessels/aneurysm-v4a/aneurysm_vascular_model.stl");
  expect_layers_of_all_settings(lumen_of(path));
}

TEST(BoundaryLayerReal, CoronaryPhantom) {
  OSTIA_REQUIRE_SHARED(path, "coronary/xra-phantom/phantom-tri3-coarse.stl");
  expect_layers_of_all_settings(lumen_of(path));
}

}  // namespace
}  // namespace ostia::meshing
