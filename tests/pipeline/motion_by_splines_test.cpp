// A beating tree carried from image to image by ITK's B-splines; minutes.
#include "beating_images.h"

#include "ostia/pipeline/motion_images.h"

#include <gmock/gmock.h>

#include <iostream>
#include <random>

namespace ostia::pipeline {
namespace {

using imaging::ImageVolume;
using motion::testing::beating_grid;
using motion::testing::beating_image;
using motion::testing::far_amount_at;
using motion::testing::still_tree;

PhaseView beating_view(double phase) {
  return {phase, "", [phase](const core::TaskContext&) {
            return std::make_shared<const ImageVolume>(beating_image(phase, beating_grid(1.0)));
          }};
}

PhaseView noise_view(double phase) {
  return {phase, "", [](const core::TaskContext&) {
            auto image = std::make_shared<ImageVolume>();
            image->geometry = beating_grid(1.0);
            image->voxels.resize(static_cast<std::size_t>(image->geometry.voxels()));
            std::mt19937 random(1);
            std::normal_distribution<double> noise(-50.0, 20.0);
            for (std::int16_t& v : image->voxels) v = static_cast<std::int16_t>(noise(random));
            return image;
          }};
}

double surface_error(const geometry::TriMesh& found, double phase) {
  return motion::testing::target_distance(motion::testing::moved(still_tree(), far_amount_at(phase)), found);
}

TEST(MotionBySplines, FindTheLumenOfEveryPhaseAndTellOneWithoutIt) {
  ImagePhasesOptions options;
  options.carrier = ImageCarrier::b_splines;
  options.depth = 3;
  std::vector<PhaseView> views;
  for (const double phase : {0.0, 0.125, 0.25, 0.375, 0.625, 0.75, 0.875})
    views.push_back(beating_view(phase));
  views.push_back(noise_view(0.5));
  const ImagePhases found = surfaces_from_images(still_tree(), std::move(views), options);
  ASSERT_EQ(found.surfaces.size(), 8U);
  for (std::size_t k = 0; k < 8; ++k) {
    const PhaseSurface& one = found.surfaces[k];
    if (one.phase == 0.5) {
      EXPECT_FALSE(found.found[k].found);
      EXPECT_THAT(one.why, ::testing::HasSubstr("image"));
      continue;
    }
    ASSERT_TRUE(found.found[k].found) << one.phase << one.why;
    EXPECT_EQ(one.surface.triangles, still_tree().triangles);
    EXPECT_GT(found.found[k].likeness, 0.85) << one.phase;
    const motion::testing::Error point =
        motion::testing::vertex_error(still_tree(), one.surface, far_amount_at(one.phase));
    std::cout << one.phase << ": surface " << surface_error(one.surface, one.phase) << " mm, the same point "
              << point.mean << " mm, likeness " << found.found[k].likeness << '\n';
    // Of 14 mm, and of 3 mm beside the template's own phase.
    const bool beside = one.phase == 0.625 || one.phase == 0.875;
    EXPECT_LT(surface_error(one.surface, one.phase), beside ? 0.12 : 0.4) << one.phase;
    EXPECT_LT(point.mean, beside ? 0.4 : 1.2) << one.phase;
  }
  EXPECT_GT(surface_error(still_tree(), 0.25), 3.0) << "it had far to go";
}

}  // namespace
}  // namespace ostia::pipeline
