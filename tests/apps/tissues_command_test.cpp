// `ostia calcium`, `ostia fat`, `ostia territories`.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/image_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <utility>

namespace ostia::testing {
namespace {

using geometry::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;
namespace fs = std::filesystem;

imaging::ImageVolume image_of(const std::array<std::int64_t, 3>& size, const Vec3& spacing,
                              const Vec3& origin, const std::function<double(const Vec3&)>& hu_at) {
  imaging::ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.geometry.origin = origin;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        image.voxels.push_back(static_cast<std::int16_t>(std::lround(hu_at(image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))))));
  return image;
}

/// A ball of a heart in lung with calcium where LAD and RCA usually run.
fs::path calcium_folder(double blood_hu = 45.0) {
  const fs::path folder = temporary_folder("calcium");
  const Vec3 middle(80.0, 80.0, 66.0), lad = middle + 45.0 * Vec3(0.8, -0.47, 0.46),
                                       rca = middle + 45.0 * Vec3(-1.1, -0.1, -0.2);
  imaging::write_image(
      folder / "scan.nrrd", image_of({80, 80, 44}, {2.0, 2.0, 3.0}, Vec3::Zero(), [&](const Vec3& at) {
        if ((at - lad).cwiseAbs().maxCoeff() < 3.0) return 450.0;
        if ((at - rca).cwiseAbs().maxCoeff() < 3.0) return 250.0;
        const double away = (at - middle).norm();
        if (away < 45.0) return blood_hu;
        return away < 54.0 ? -90.0 : std::hypot(at.x() - 80.0, at.y() - 80.0) < 72.0 ? -850.0 : 50.0;
      }));
  return folder;
}

TEST(CalciumCommand, ScoresByVesselAndTakesAPersonsWord) {
  const Setting in{calcium_folder(), ""};
  const Outcome done = ostia({"calcium", "scan.nrrd", "-o", "out", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json found = Json::parse(done.out);
  ASSERT_EQ(found["lesions"].size(), 2U);
  const double lad = found["vessels"]["LAD"]["agatston"], rca = found["vessels"]["RCA"]["agatston"];
  EXPECT_GT(lad, 0.0);
  EXPECT_GT(rca, 0.0);
  EXPECT_DOUBLE_EQ(found["total"]["agatston"].get<double>(), lad + rca);
  EXPECT_TRUE(found["total"]["mass_mg"].is_null());
  EXPECT_THAT(names_in(in.folder / "out"),
              ElementsAre("calcium.json", "lesions.csv", "lesions.nrrd", "manifest.json", "slices.png"));
  EXPECT_THAT(ostia({"calcium", "scan.nrrd", "-o", "out"}, in).err, HasSubstr("done already"));

  const Outcome said = ostia(
      {"calcium", "scan.nrrd", "-o", "said", "--json", "--assign", "1:none", "--calibration", "0.8"}, in);
  ASSERT_EQ(said.code, 0) << said.err;
  const Json corrected = Json::parse(said.out);
  EXPECT_DOUBLE_EQ(corrected["total"]["agatston"].get<double>(), rca);
  EXPECT_TRUE(corrected["lesions"][0]["assigned"].get<bool>());
  EXPECT_GT(corrected["total"]["mass_mg"].get<double>(), 0.0);
}

TEST(CalciumCommand, WhatCannotBeDoneIsRefused) {
  const Setting in{calcium_folder(300.0), ""};
  const Outcome contrast = ostia({"calcium", "scan.nrrd", "-o", "out"}, in);
  EXPECT_EQ(contrast.code, 3);
  EXPECT_THAT(contrast.err, HasSubstr("scan.nrrd: calcium score: the blood has contrast agent"));
  EXPECT_FALSE(fs::exists(in.folder / "out"));
  EXPECT_EQ(ostia({"calcium", "scan.nrrd", "-o", "out", "--assign", "LAD"}, in).code, 2);
  EXPECT_EQ(ostia({"calcium", "scan.nrrd", "-o", "out", "--assign", "1:D1"}, in).code, 2);
  const Setting plain{calcium_folder(), ""};
  const Outcome missing = ostia({"calcium", "scan.nrrd", "-o", "out", "--assign", "7:LAD"}, plain);
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("there is no lesion 7; there are 2"));
}

/// 30 mm along z: a tube of blood with a wall, in fat.
geometry::VesselTree tissue_tube(const char* name) {
  geometry::VesselTree tree;
  geometry::Centerline axis = geometry::straight_tube(30.0, 1.5, 0.5).tubes.front().axis;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, name, {3}}};
  return tree;
}

TEST(FatCommand, MeasuresTheFatOfACase) {
  const fs::path folder = temporary_folder("fat");
  constexpr double sigma = 0.3, fat_hu = -85.0;
  const auto step = [&](double rho, double radius) {
    return 0.5 * std::erfc((rho - radius) / (sigma * std::sqrt(2.0)));
  };
  imaging::write_image(folder / "heart.nrrd",
                       image_of({60, 60, 62}, {0.4, 0.4, 0.5}, {-11.8, -11.8, -0.5}, [&](const Vec3& at) {
                         const double rho = std::hypot(at.x(), at.y());
                         return fat_hu + (50.0 - fat_hu) * step(rho, 2.0) + 350.0 * step(rho, 1.5);
                       }));
  session::CaseFile::create(folder / "heart.ostia", lumen::model_of_tubes(tissue_tube("LAD")),
                            session::image_reference(folder / "heart.nrrd"));
  const Setting in{folder, ""};
  const Outcome done =
      ostia({"fat", "heart.ostia", "--image", "heart.nrrd", "-o", "out", "--tube-kv", "100", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json found = Json::parse(done.out);
  ASSERT_EQ(found["vessels"].size(), 1U);
  const Json& lad = found["vessels"][0];
  EXPECT_NEAR(lad["mean_hu"].get<double>(), fat_hu, 1.0);
  EXPECT_GT(lad["all_mean_hu"].get<double>(), lad["mean_hu"].get<double>());
  EXPECT_NEAR(lad["diameter_mm"].get<double>(), 4.0, 0.3);
  EXPECT_NEAR(lad["all_mean_at_120_kv_hu"].get<double>(), lad["all_mean_hu"].get<double>() / 1.080, 1e-9);
  EXPECT_THAT(done.err, HasSubstr("no vessel is named RCA"));
  EXPECT_THAT(done.err, HasSubstr("taken at 100 kV"));
  EXPECT_THAT(names_in(folder / "out"),
              ElementsAre("fat-map.csv", "fat.csv", "fat.json", "fat.png", "manifest.json"));
}

TEST(TerritoriesCommand, DividesAMaskAmongLines) {
  const fs::path folder = temporary_folder("territories");
  session::CaseFile::create(folder / "heart.ostia", lumen::model_of_tubes(tissue_tube("LAD")));
  imaging::MaskVolume mask;
  mask.geometry.size = {10, 10, 30};
  mask.geometry.origin = {4.0, 0.0, 0.5};
  mask.voxels.assign(3000, 2);
  imaging::write_image(folder / "muscle.nrrd", mask);
  const Setting in{folder, ""};
  const Outcome done = ostia({"territories", "heart.ostia", "--myocardium", "muscle.nrrd", "--label", "2",
                              "-o", "out", "--behind", "LAD:15", "--json"},
                             in);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json found = Json::parse(done.out);
  EXPECT_NEAR(found["mass_g"].get<double>(), 3.15, 1e-9);
  EXPECT_NEAR(found["vessels"][0]["share"].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(found["places"][0]["share"].get<double>(), 0.5, 0.04);
  EXPECT_THAT(names_in(folder / "out"),
              ElementsAre("manifest.json", "territories.csv", "territories.json", "territories.nrrd"));
  EXPECT_EQ(
      ostia({"territories", "heart.ostia", "--myocardium", "muscle.nrrd", "--label", "5", "-o", "x"}, in)
          .code,
      3);
  EXPECT_EQ(
      ostia({"territories", "heart.ostia", "--myocardium", "muscle.nrrd", "-o", "x", "--behind", "LAD"}, in)
          .code,
      2);
  EXPECT_EQ(
      ostia({"territories", "heart.ostia", "--myocardium", "muscle.nrrd", "-o", "x", "--behind", "D1:3"}, in)
          .code,
      3);
}

}  // namespace
}  // namespace ostia::testing
