#include <gtest/gtest.h>

#include "ostia/pipeline/model.h"
#include "shared_data.h"

namespace ostia::pipeline {
namespace {

using geometry::Vec3;

TEST(ModelReal, AscendingAortaOfACta) {
  OSTIA_REQUIRE_SHARED(path, "cta/totalsegmentator-aorta-cta/ct_cropped.nii.gz");
  ModelOptions options;
  options.branches = {{Vec3(8.5, -187.6, 675.2), std::nullopt, Vec3(5.6, -177.9, 720.2)}};
  const Model model = build_model(load(path), options);
  EXPECT_TRUE(model.meshed.verdict.ok()) << model.meshed.verdict.summary();
  ASSERT_EQ(model.centerlines.lines.size(), 1u);
  EXPECT_GT(model.centerlines.lines[0].abscissa.back(), 30.0);
}

TEST(ModelReal, CarotidSurface) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/lumen.stl");
  const Model model = build_model(load(path), {});
  EXPECT_TRUE(model.meshed.verdict.ok()) << model.meshed.verdict.summary();
  EXPECT_EQ(model.centerlines.tree.vessels.size(), 2u);
}

}  // namespace
}  // namespace ostia::pipeline
