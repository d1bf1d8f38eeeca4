#include "ostia/coronary/certainty.h"

#include "artery_scene.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ostia::coronary {
namespace {

using testing::Scene;

/// An axis along straight lines between places, a point every half millimetre.
geometry::Centerline line_along(const std::vector<Vec3>& places, double radius_mm) {
  geometry::Centerline axis;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const int steps = static_cast<int>((places[i + 1] - places[i]).norm() / 0.5);
    for (int k = i == 0 ? 0 : 1; k <= steps; ++k)
      axis.points.push_back(places[i] + (places[i + 1] - places[i]) * k / steps);
  }
  axis.radius.assign(axis.points.size(), radius_mm);
  geometry::complete(axis);
  return axis;
}

/// The scene's artery, its side branch, and a vessel that runs on through fat where nothing is.
struct Found {
  Scene scene;
  imaging::ImageVolume image = scene.image();
  geometry::VesselTree tree;
  Found() {
    const Vec3 fork(0.0, 0.0, 20.0), corner(8.0, 0.0, 20.0);
    tree.nodes = {
        {1, scene.ostium}, {2, fork}, {3, {22.0, 0.0, 10.0}}, {4, {8.0, 16.0, 30.0}}, {5, {0, -20, 30}}};
    tree.segments = {{1, 1, 2, line_along({scene.ostium, fork}, 1.6)},
                     {2, 2, 3, line_along({fork, corner, {22.0, 0.0, 10.0}}, 1.3)},
                     {3, 2, 4, line_along({fork, {8.0, 16.0, 30.0}}, 1.0)},
                     {4, 2, 5, line_along({fork, {0.0, -20.0, 30.0}}, 1.0)}};
    tree.vessels = {{11, "LAD", {1, 2}}, {12, "D1", {1, 3}}, {13, "V1", {1, 4}}};
  }
  std::vector<VesselCertainty> certainty() const { return certainty_of(image, tree, Scene::aorta()); }
};

std::size_t look(const char* name) {
  return static_cast<std::size_t>(std::find(piece_looks.begin(), piece_looks.end(), name) -
                                  piece_looks.begin());
}

TEST(Certainty, EachVesselsOwnPartIsCutIntoCentimetres) {
  const Found found;
  const std::vector<VesselCertainty> all = found.certainty();
  ASSERT_EQ(all.size(), 3U);
  const double side_mm = (Vec3(8.0, 16.0, 30.0) - Vec3(0.0, 0.0, 20.0)).norm();
  EXPECT_EQ(all[0].vessel, 11);
  EXPECT_EQ(all[0].pieces.size(), 5U);  // 45.2 mm
  EXPECT_EQ(all[0].pieces.front().from_mm, 0.0);
  EXPECT_EQ(all[1].pieces.size(), 2U);
  EXPECT_NEAR(all[1].pieces.front().from_mm, 20.0, 1e-9);
  EXPECT_NEAR(all[1].pieces.back().to_mm, 20.0 + side_mm, 1e-6);
  for (const VesselCertainty& one : all)
    for (std::size_t i = 1; i < one.pieces.size(); ++i)
      EXPECT_NEAR(one.pieces[i].from_mm, one.pieces[i - 1].to_mm, 1e-9);
  EXPECT_LT((all[0].pieces[0].place - Vec3(-15.5, 0.0, 20.0)).norm(), 0.6);
}

TEST(Certainty, LooksAreThoseOfTheImage) {
  const Found found;
  const std::vector<VesselCertainty> all = found.certainty();
  const VesselPiece &lumen = all[0].pieces[2], &nothing = all[2].pieces.back();
  EXPECT_NEAR(lumen.looks[look("brightness")], 1.0, 0.05);
  EXPECT_NEAR(lumen.looks[look("edges")], 1.0, 0.1);
  EXPECT_LT(lumen.looks[look("unevenness")], 0.1);
  EXPECT_NEAR(nothing.looks[look("brightness")], (testing::fat_hu - 60.0) / (testing::contrast_hu - 60.0),
              0.05);
  EXPECT_NEAR(nothing.looks[look("edges")], 0.0, 0.05);
  EXPECT_LT(nothing.looks[look("upstream")], 0.5) << "nothing was seen before it already";
  EXPECT_GT(all[1].pieces.back().looks[look("upstream")], 0.9);
  EXPECT_GT(all[0].pieces[0].probability, nothing.probability);
  EXPECT_GT(all[0].probability, all[2].probability);
  EXPECT_GT(all[1].probability, all[2].probability);
}

TEST(Certainty, AGapIsSeenAndMakesWhatComesBehindLessSure) {
  Found found;
  const std::vector<VesselCertainty> clear = found.certainty();
  Aorta noisy = Scene::aorta();
  noisy.noise_hu = 100.0;
  EXPECT_NEAR(certainty_of(found.image, found.tree, noisy)[0].pieces[2].looks[look("noise")], 100.0 / 340.0,
              0.02);
  EXPECT_EQ(clear[0].pieces[2].looks[look("noise")], 0.0);
  // Fat over five millimetres of the trunk.
  for (std::size_t i = 0; i < found.image.voxels.size(); ++i) {
    const auto k = static_cast<std::int64_t>(i);
    const auto& size = found.image.geometry.size;
    const Vec3 at = found.image.geometry.world({static_cast<double>(k % size[0]),
                                                static_cast<double>(k / size[0] % size[1]),
                                                static_cast<double>(k / (size[0] * size[1]))});
    if (std::abs(at.x() + 7.0) < 2.5) found.image.voxels[i] = -90;
  }
  const std::vector<VesselCertainty> broken = found.certainty();
  EXPECT_LT(broken[0].pieces[1].looks[look("darkest")], 0.2);
  EXPECT_LT(broken[1].probability, clear[1].probability);
  EXPECT_LT(broken[1].pieces[0].looks[look("upstream")], 0.2) << "the branch is reached through the gap";
}

TEST(Certainty, APlaceHasThePieceOfTheVesselThatOwnsIt) {
  const Found found;
  const std::vector<VesselCertainty> all = found.certainty();
  EXPECT_EQ(probability_at(all, found.tree, 11, 12.0), all[0].pieces[1].probability);
  EXPECT_EQ(probability_at(all, found.tree, 12, 12.0), all[0].pieces[1].probability) << "the shared way";
  EXPECT_EQ(probability_at(all, found.tree, 12, 25.0), all[1].pieces[0].probability);
  EXPECT_EQ(probability_at(all, found.tree, 12, 1e3), all[1].pieces.back().probability);
  EXPECT_TRUE(std::isnan(probability_at(all, found.tree, 99, 1.0)));
  EXPECT_TRUE(std::isnan(probability_at({}, found.tree, 11, 1.0)));
}

TEST(Certainty, AVesselsLooksAreItsPiecesLogits) {
  std::vector<VesselPiece> pieces(2);
  pieces[0].to_mm = 10.0;
  pieces[1].from_mm = 10.0, pieces[1].to_mm = 40.0;
  const auto looks = looks_of_vessel(pieces, {2.0, -100.0});
  EXPECT_NEAR(looks[0], (10.0 * 2.0 - 30.0 * 6.0) / 40.0, 1e-12);
  EXPECT_NEAR(looks[1], -6.0, 1e-12);
  EXPECT_NEAR(looks[2], 2.0, 1e-12);
  EXPECT_EQ(looks_of_vessel({}, {})[0], 0.0);
}

TEST(Certainty, RefusesNoImage) {
  EXPECT_THROW(certainty_of({}, Found().tree, Scene::aorta()), InvalidInput);
}

}  // namespace
}  // namespace ostia::coronary
