#include "ostia/pipeline/motion_images.h"

#include "beating_images.h"

#include "ostia/core/error.h"
#include "ostia/motion/moving_cage.h"

#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <string>

namespace ostia::pipeline {
namespace {

using geometry::PhaseOrigin;
using geometry::Vec3;
using imaging::ImageVolume;
using motion::testing::beat;
using motion::testing::beating_grid;
using motion::testing::beating_image;
using motion::testing::far_amount_at;
using motion::testing::still_tree;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Image = std::shared_ptr<const ImageVolume>;

constexpr double spacing_mm = 1.0;

Image image_at(double phase) {
  static std::map<double, Image> made;
  Image& image = made[phase];
  if (!image) image = std::make_shared<const ImageVolume>(beating_image(phase, beating_grid(spacing_mm)));
  return image;
}

PhaseView view_of(double phase, const Image& image) {
  return {phase, "phase_" + percent_text(phase), [image](const core::TaskContext&) { return image; }};
}

std::vector<PhaseView> beating_views(const std::vector<double>& phases) {
  std::vector<PhaseView> views;
  for (const double phase : phases) views.push_back(view_of(phase, image_at(phase)));
  return views;
}

const std::vector<double>& eight() {
  static const std::vector<double> phases{0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875};
  return phases;
}

ImagePhasesOptions motion_images_coarse() {
  ImagePhasesOptions options;
  options.depth = 3;
  return options;
}

geometry::TriMesh true_tree(double phase) {
  return motion::testing::moved(still_tree(), far_amount_at(phase));
}

double surface_error(const geometry::TriMesh& found, double phase) {
  return motion::testing::target_distance(true_tree(phase), found);
}

motion::testing::Error point_error(const geometry::TriMesh& found, double phase) {
  return motion::testing::vertex_error(still_tree(), found, far_amount_at(phase));
}

TEST(MotionImages, TheTestsInverseIsOne) {
  for (const Vec3& p : still_tree().points)
    ASSERT_LT((motion::testing::unbeaten(beat(p, 0.9), 0.9) - p).norm(), 1e-9);
}

class InImages : public ::testing::Test {
 protected:
  static const ImagePhases& whole() {
    static const ImagePhases found =
        surfaces_from_images(still_tree(), beating_views(eight()), motion_images_coarse());
    return found;
  }
};

TEST_F(InImages, FindsTheLumenOfEveryPhase) {
  const ImagePhases& all = whole();
  ASSERT_EQ(all.surfaces.size(), 8U);
  EXPECT_THAT(all.warnings, IsEmpty());
  for (std::size_t k = 0; k < 8; ++k) {
    const PhaseSurface& one = all.surfaces[k];
    EXPECT_EQ(one.phase, eight()[k]);
    ASSERT_TRUE(all.found[k].found) << k << one.why;
    EXPECT_EQ(one.surface.triangles, still_tree().triangles);
    EXPECT_GT(all.found[k].likeness, 0.85) << k;
    EXPECT_LT(surface_error(one.surface, one.phase), 0.15) << k;
    EXPECT_LT(point_error(one.surface, one.phase).mean, 0.35) << k;
  }
  EXPECT_EQ(all.surfaces[6].surface.points, still_tree().points);
  // They had far to go, and the last step along the normals was worth it.
  EXPECT_GT(surface_error(still_tree(), 0.25), 3.0);
  EXPECT_GT(all.found[2].wall_shift_mm, 0.01);
}

TEST_F(InImages, AreFittedAsSurfacesAre) {
  MotionFitOptions options;
  options.registration.depth = 3;
  options.registration.most_rounds = 6;
  const MotionFit fit = fit_motion(whole().surfaces, options);
  EXPECT_THAT(fit.warnings, IsEmpty());
  const motion::MovingCage cage(fit.motion);
  const motion::CarriedPoints carried(cage.grid(), fit.template_shape.points);
  for (const double phase : {0.0, 0.25, 0.5, 0.3125}) {
    const geometry::TriMesh now{carried.places(cage.at(phase)), fit.template_shape.triangles};
    EXPECT_LT(surface_error(now, phase), 0.15) << phase;
    EXPECT_LT(point_error(now, phase).mean, 0.5) << phase;
  }
}

// Each on a grid of its own, one of them turned.
TEST_F(InImages, MayLieOnUnequalGrids) {
  imaging::Geometry turned = beating_grid(1.0);
  const Vec3 middle =
      turned.world(0.5 * Vec3(static_cast<double>(turned.size[0]), static_cast<double>(turned.size[1]),
                              static_cast<double>(turned.size[2])));
  turned.direction = Eigen::AngleAxisd(0.2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  turned.origin += middle - turned.world(0.5 * Vec3(static_cast<double>(turned.size[0]),
                                                    static_cast<double>(turned.size[1]),
                                                    static_cast<double>(turned.size[2])));
  std::vector<PhaseView> views = beating_views({0.75, 0.875});
  views.push_back(view_of(0.625, std::make_shared<const ImageVolume>(beating_image(0.625, turned))));
  const ImagePhases found = surfaces_from_images(still_tree(), std::move(views), motion_images_coarse());
  ASSERT_TRUE(found.found[0].found) << found.surfaces[0].why;
  EXPECT_LT(surface_error(found.surfaces[0].surface, 0.625), 0.15);
}

// The cage cannot follow that: it is the last step's.
TEST_F(InImages, FindTheWallOfAVesselThatSwells) {
  std::vector<PhaseView> views = beating_views({0.75, 0.625});
  views.push_back(view_of(
      0.875, std::make_shared<const ImageVolume>(beating_image(0.875, beating_grid(spacing_mm), 0.3))));
  const ImagePhases found = surfaces_from_images(still_tree(), std::move(views), motion_images_coarse());
  const auto swollen = [&](std::size_t k) {
    const geometry::TubeDistance tree(motion::testing::tree_shape());
    double sum = 0.0;
    for (const Vec3& p : found.surfaces[k].surface.points)
      sum += tree(motion::testing::unbeaten(p, far_amount_at(found.surfaces[k].phase)));
    return sum / static_cast<double>(found.surfaces[k].surface.points.size());
  };
  EXPECT_NEAR(swollen(2), 0.3, 0.1);
  EXPECT_NEAR(swollen(0), 0.0, 0.05);
}

Image empty_image() {
  auto image = std::make_shared<ImageVolume>(*image_at(0.875));
  std::mt19937 random(1);
  std::normal_distribution<double> noise(-50.0, 20.0);
  for (std::int16_t& v : image->voxels) v = static_cast<std::int16_t>(noise(random));
  return image;
}

// The lower part of the image alone.
Image short_image(double phase) {
  const ImageVolume& whole = *image_at(phase);
  return std::make_shared<const ImageVolume>(imaging::cropped(
      whole, {{0, 0, 0}, {whole.geometry.size[0], whole.geometry.size[1], whole.geometry.size[2] / 3}}));
}

TEST_F(InImages, MarksAPhaseWithoutTheVesselAndGoesOn) {
  std::vector<PhaseView> views = beating_views({0.75, 0.0, 0.5, 0.625});
  views.push_back(view_of(0.875, empty_image()));
  views.push_back(view_of(0.375, short_image(0.375)));
  const ImagePhases found = surfaces_from_images(still_tree(), std::move(views), motion_images_coarse());
  ASSERT_EQ(found.surfaces.size(), 6U);
  EXPECT_THAT(found.surfaces[5].why, HasSubstr("does not show the vessel"));
  EXPECT_TRUE(found.surfaces[5].surface.triangles.empty());
  EXPECT_THAT(found.surfaces[1].why, HasSubstr("would lie within its image"));
  EXPECT_LT(surface_error(found.surfaces[0].surface, 0.0), 0.2);  // the next one is found all the same
  MotionFitOptions options;
  options.registration.depth = 3;
  options.registration.most_rounds = 3;
  const MotionFit fit = fit_motion(found.surfaces, options);
  ASSERT_EQ(fit.phases.back().phase, 0.875);
  EXPECT_EQ(fit.phases.back().origin, PhaseOrigin::bridged);
  EXPECT_THAT(fit.phases.back().why, HasSubstr("correlation"));
}

std::string motion_images_refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST_F(InImages, RefusesWhatCannotBeCompared) {
  const auto told = [](const std::vector<double>& phases, const geometry::TriMesh& shape,
                       double template_phase = 0.75) {
    ImagePhasesOptions options = motion_images_coarse();
    options.template_phase = template_phase;
    return motion_images_refusal([&] { surfaces_from_images(shape, beating_views(phases), options); });
  };
  EXPECT_THAT(told({0.75, 0.0}, still_tree()), HasSubstr("three phases at least; there are 2"));
  EXPECT_THAT(told({0.75, 0.0, 0.5}, still_tree(), 0.7), HasSubstr("there are 0 %, 50 %, 75 %"));
  EXPECT_THAT(told({0.75, 0.5, 0.5}, still_tree()), HasSubstr("are the same phase"));
  EXPECT_THAT(told({0.75, 0.0, 0.5}, {}), HasSubstr("no triangles"));
  geometry::TriMesh apart = still_tree();
  for (Vec3& p : apart.points) p.x() += 200.0;
  EXPECT_THAT(told({0.75, 0.0, 0.5}, apart), HasSubstr("only 0 % of the template lie within the image of its "
                                                       "phase 75 % (phase_75 %)"));
}

TEST_F(InImages, WarnsOfATemplateOfAnotherPhase) {
  ImagePhasesOptions options = motion_images_coarse();
  options.depth = 1;
  const ImagePhases found = surfaces_from_images(true_tree(0.25), beating_views({0.75, 0.0, 0.5}), options);
  EXPECT_THAT(found.warnings, ::testing::ElementsAre(HasSubstr("is it the surface of that phase?")));
}

TEST_F(InImages, DoNotDependOnOrderOrThreads) {
  ImagePhasesOptions options = motion_images_coarse();
  options.depth = 2;
  core::set_max_threads(1);
  const ImagePhases one = surfaces_from_images(still_tree(), beating_views({0.625, 0.75, 0.875}), options);
  core::set_max_threads(0);
  const ImagePhases all = surfaces_from_images(still_tree(), beating_views({0.875, 0.75, 0.625}), options);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(one.surfaces[k].surface.points, all.surfaces[k].surface.points);
    EXPECT_EQ(one.found[k].likeness, all.found[k].likeness);
  }
}

TEST_F(InImages, CanBeCancelled) {
  core::TaskContext task;
  std::vector<PhaseView> views = beating_views({0.625, 0.75, 0.875});
  const auto read = views[2].read;
  views[2].read = [&](const core::TaskContext& own) {
    task.cancel();
    return read(own);
  };
  EXPECT_THROW(surfaces_from_images(still_tree(), std::move(views), motion_images_coarse(), task), Cancelled);
}

}  // namespace
}  // namespace ostia::pipeline
