#include "ostia/session/outer_walls.h"

#include "report_cases.h"

#include "ostia/core/error.h"
#include "ostia/session/plaque_sampling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

using std::numbers::pi;

TEST(OuterWalls, OfAModelsLumenInItsImage) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5);
  const imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const auto walls = vessel_walls(model, solved_surfaces(model), model.tree.vessels.front().id, image);
  ASSERT_TRUE(walls);
  EXPECT_GT(walls->outer.seen_share, 0.99);
  EXPECT_NEAR(walls->lumen.from_mm, 1.5, 0.1);  // without a radius at the ends
  EXPECT_NEAR(walls->plaque.to_mm, 38.5, 0.6);
  for (std::size_t n = 0; n < walls->lumen.radius_mm.size(); ++n) {
    EXPECT_NEAR(walls->lumen.radius_mm[n], 1.5, 0.03);
    EXPECT_NEAR(walls->outer.surface.radius_mm[n], 2.6, 0.12);
  }
  const analysis::PlaqueVolumes all = analysis::plaque_between(walls->plaque, 10.0, 30.0);
  EXPECT_NEAR(all.vessel_mm3, pi * 2.6 * 2.6 * 20.0, 0.05 * pi * 2.6 * 2.6 * 20.0);
  EXPECT_NEAR(all.of(analysis::PlaqueClass::fibrofatty), pi * (2.6 * 2.6 - 2.25) * 20.0,
              0.10 * pi * (2.6 * 2.6 - 2.25) * 20.0);
  const std::vector<geometry::Vec3> ring = outer_wall_ring(*walls, 20.0);
  ASSERT_EQ(ring.size(), 96U);
  for (const geometry::Vec3& p : ring) EXPECT_NEAR(p.head<2>().norm(), 2.6, 0.12);
  EXPECT_TRUE(outer_wall_ring(*walls, 0.5).empty());
}

TEST(OuterWalls, StayWithinTheImageAndSkipWhatIsTooShort) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5);
  imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const std::int32_t vessel = model.tree.vessels.front().id;
  image.geometry.origin.z() = 30.0;
  const auto walls = vessel_walls(model, solved_surfaces(model), vessel, image);
  ASSERT_TRUE(walls);
  EXPECT_GE(walls->lumen.from_mm, 29.5);
  image.geometry.origin.z() = 39.0;
  EXPECT_FALSE(vessel_walls(model, solved_surfaces(model), vessel, image));
}

TEST(OuterWalls, OfABranchBeginBehindItsTakeOff) {
  const lumen::LumenModel model = named_y();
  imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  image.geometry.origin = {-9.45, -9.45, -17.0};
  const auto of = [&](std::size_t vessel) {
    return vessel_walls(model, solved_surfaces(model), model.tree.vessels[vessel].id, image);
  };
  const auto first = of(0), second = of(1);
  ASSERT_TRUE(first && second);
  EXPECT_LT(first->lumen.from_mm, 2.5);
  EXPECT_GT(second->lumen.from_mm, 16.0);  // its own segment begins at 15 mm
}

TEST(OuterWalls, AShutLumenIsAllPlaque) {
  const lumen::LumenModel model = shut_tube();
  const imaging::ImageVolume image = walled_image(1.2, 2.3, 60.0);
  const auto walls = vessel_walls(model, solved_surfaces(model), model.tree.vessels.front().id, image);
  ASSERT_TRUE(walls);
  EXPECT_LT(analysis::plaque_between(walls->plaque, 18.0, 22.0).lumen_mm3, 0.1);
}

/// The lesion that narrows; in these tubes, plaque goes on from it to both sides.
const ReportStenosis& narrowing_of(const CaseReport& report) {
  return *std::find_if(report.stenoses.begin(), report.stenoses.end(),
                       [](const ReportStenosis& one) { return one.narrows; });
}

TEST(OuterWalls, AReportTellsThem) {
  const imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const CaseReport with = report_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6), {}, {}, &image);
  ASSERT_EQ(with.stenoses.size(), 3U);
  const ReportStenosis& narrow = narrowing_of(with);
  EXPECT_EQ(narrow.number, 2);
  ASSERT_TRUE(with.vessels.front().plaque && narrow.plaque);
  const ReportPlaque& lesion = *narrow.plaque;
  EXPECT_NEAR(lesion.volumes.length_mm, narrow.stenosis.length_mm(), 1e-6);
  for (const ReportStenosis& one : with.stenoses) {
    if (one.narrows) continue;
    EXPECT_EQ(analysis::cad_rads(one.graded_percent), analysis::CadRads::one);
  }
  EXPECT_GT(lesion.volumes.burden_percent(), with.vessels.front().plaque->volumes.burden_percent());
  ASSERT_TRUE(narrow.remodelling_index);
  EXPECT_NEAR(*narrow.remodelling_index, 1.0, 0.15);  // the image's wall is even
  const CaseReport without = report_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6));
  EXPECT_FALSE(without.vessels.front().plaque || without.stenoses.front().plaque ||
               without.stenoses.front().remodelling_index);
}

TEST(OuterWalls, ShowPieceByPieceWhatTheyCount) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5);
  const imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const std::int32_t vessel = model.tree.vessels.front().id;
  OuterWallsOptions options;
  EXPECT_TRUE(vessel_walls(model, solved_surfaces(model), vessel, image, options)->maps.empty());
  options.maps = true;
  const auto walls = vessel_walls(model, solved_surfaces(model), vessel, image, options);
  ASSERT_TRUE(walls);
  ASSERT_EQ(walls->maps.size(), walls->plaque.slabs.size());
  // Areas of the pieces that a ray shows, summed over the rays, are the volumes of the slab.
  for (const double s : {10.0, 20.0}) {
    std::array<double, analysis::plaque_classes> shown{};
    constexpr int rays = 720, steps = 400;
    for (int a = 0; a < rays; ++a) {
      const auto ray = plaque_ray(*walls, s, 2.0 * pi * (a + 0.5) / rays);
      ASSERT_TRUE(ray);
      EXPECT_FALSE(ray->at(ray->lumen_mm - 0.01) || ray->at(ray->outer_mm + 0.01));
      for (int i = 0; i < steps; ++i) {
        const double rho = 4.0 * (i + 0.5) / steps;
        if (const auto one = ray->at(rho))
          shown[static_cast<std::size_t>(*one)] += rho * 4.0 / steps * 2.0 * pi / rays;
      }
    }
    const analysis::PlaqueVolumes counted = analysis::plaque_between(walls->plaque, s - 0.125, s + 0.125);
    for (std::size_t i = 0; i < shown.size(); ++i)
      EXPECT_NEAR(shown[i], counted.class_mm3[i] / 0.25, 0.05 * counted.plaque_mm3() / 0.25) << i;
  }
  EXPECT_FALSE(plaque_ray(*walls, 0.5, 0.0));
  const auto diameters = outer_diameters_mm(*walls);
  ASSERT_EQ(diameters.size(), walls->plaque.slabs.size());
  for (const auto& [s, diameter] : diameters) EXPECT_NEAR(diameter, 5.2, 0.24) << s;
}

TEST(OuterWalls, TellTheSameOfAStenosisAsTheReport) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  const imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const CaseReport report = report_of(model, {}, {}, &image);
  const auto walls = vessel_walls(model, solved_surfaces(model), model.tree.vessels.front().id, image);
  ASSERT_TRUE(walls);
  ASSERT_EQ(report.stenoses.size(), 3U);
  const ReportStenosis& told = narrowing_of(report);
  const auto found = plaque_of(*walls, told.stenosis);
  ASSERT_TRUE(found && told.plaque);
  EXPECT_DOUBLE_EQ(found->volumes.plaque_mm3(), told.plaque->volumes.plaque_mm3());
  EXPECT_DOUBLE_EQ(found->volumes.burden_percent(), told.plaque->volumes.burden_percent());
  EXPECT_EQ(found->remodelling_index, told.remodelling_index);
  analysis::Stenosis beyond = told.stenosis;
  beyond.from_mm = 100.0;
  beyond.to_mm = 110.0;
  EXPECT_FALSE(plaque_of(*walls, beyond));
}

TEST(OuterWalls, AnImageWithoutContrastSaysSo) {
  imaging::ImageVolume image = tube_image();
  for (std::int16_t& hu : image.voxels) hu = 60;
  const CaseReport report = report_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6), {}, {}, &image);
  EXPECT_THAT(report.warnings, ::testing::Contains(HasSubstr("RCA: fat is seen beyond the wall on 0 %")));
}

TEST(OuterWalls, RefuseWhatMakesNoSense) {
  const lumen::LumenModel model = tube_model();
  const imaging::ImageVolume image = tube_image();
  EXPECT_THROW(vessel_walls(model, solved_surfaces(model), 99, image), InvalidInput);
  OuterWallsOptions options;
  options.around = 4;
  EXPECT_THROW(vessel_walls(model, solved_surfaces(model), model.tree.vessels.front().id, image, options),
               InvalidInput);
}

}  // namespace
}  // namespace ostia::session
