#pragma once
/// \file What a mesh of a made surface must be.

#include "made_surfaces.h"

#include "ostia/pipeline/model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::pipeline {

inline std::size_t outlets_of(const geometry::FacedSurface& surface) {
  return static_cast<std::size_t>(
      std::ranges::count(surface.faces, geometry::FaceKind::outlet, &geometry::Face::kind));
}

inline void expect_whole(const Model& model, const ForeignKind& kind) {
  const MeshQuality& quality = model.meshed.quality;
  EXPECT_TRUE(quality.verdict.ok()) << quality.verdict.summary();
  EXPECT_EQ(outlets_of(model.meshed.surface), kind.outlets);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(model.meshed.surface.faces, geometry::FaceKind::inlet,
                                                        &geometry::Face::kind)),
            kind.parts);
  EXPECT_EQ(model.source.unit_mm, kind.unit_mm);
  ASSERT_TRUE(quality.shape);
  ::testing::Test::RecordProperty("volume_change", std::to_string(quality.shape->volume_change()));
  ::testing::Test::RecordProperty("p999_share",
                                  std::to_string(std::max(quality.shape->mesh_to_surface.p999_share,
                                                          quality.shape->surface_to_mesh.p999_share)));
  EXPECT_LE(std::abs(quality.shape->volume_change()), 0.01);
  EXPECT_LE(quality.shape->mesh_to_surface.p999_share, 1.0);
  EXPECT_LE(quality.shape->surface_to_mesh.p999_share, 1.0);
}

inline std::string name_of_kind(const ::testing::TestParamInfo<ForeignKind>& kind) {
  return kind.param.name;
}

}  // namespace ostia::pipeline
