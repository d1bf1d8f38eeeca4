#include "ostia/lumen/start_surface.h"

#include "vessel_trees.h"

#include "ostia/core/error.h"
#include "ostia/geometry/kd_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

namespace ostia::lumen {
namespace {

using geometry::AxisCurve;
using std::numbers::pi;
using testing::straight_vessel;
using testing::tree_of;

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

void expect_says(const std::string& message, std::initializer_list<const char*> words) {
  for (const char* word : words)
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in: " << message;
}

std::vector<SurfaceSample> walls(const std::vector<SurfaceSample>& samples) {
  std::vector<SurfaceSample> result;
  for (const SurfaceSample& s : samples) {
    if (s.origin != SampleOrigin::cap) result.push_back(s);
  }
  return result;
}

/// Largest distance from any place of a wall to its nearest sample.
double widest_hole(const AxisCurve& axis, const RadialWall& wall, const std::vector<SurfaceSample>& samples,
                   double from, double to) {
  double widest = 0.0;
  for (double s = from; s <= to; s += 0.25) {
    for (int k = 0; k < 24; ++k) {
      const double theta = 2.0 * pi * k / 24.0;
      const Vec3 place = axis.place(s, theta, wall(s, theta));
      double nearest = std::numeric_limits<double>::infinity();
      for (const SurfaceSample& sample : samples)
        nearest = std::min(nearest, (sample.position - place).norm());
      widest = std::max(widest, nearest);
    }
  }
  return widest;
}

TEST(SamplesOf, LieOnATaperedTubeWithItsNormals) {
  const auto shape = geometry::tapered_tube(30.0, 2.0, 1.0);
  const AxisCurve axis(shape.tubes[0].axis);
  const RadialWall wall = [](double s, double) { return 2.0 - s / 30.0; };
  const auto samples = walls(samples_of(axis, wall, 0.0, 30.0, 1));
  ASSERT_GT(samples.size(), 200U);
  const double slope = -1.0 / 30.0, norm = std::hypot(1.0, slope);
  for (const SurfaceSample& sample : samples) {
    const double rho = std::hypot(sample.position.x(), sample.position.y());
    EXPECT_NEAR(rho, 2.0 - sample.position.z() / 30.0, 1e-9);
    EXPECT_NEAR(sample.s_mm, sample.position.z(), 1e-9);
    const Vec3 normal(sample.position.x() / rho / norm, sample.position.y() / rho / norm, -slope / norm);
    EXPECT_LT((sample.normal - normal).norm(), 1e-6);
  }
}

TEST(SamplesOf, NormalsOfABentAndWavyWallAreItsGradient) {
  const auto shape = geometry::helix_tube(8.0, 10.0, 0.8, 1.5, 0.05);
  const AxisCurve axis(shape.tubes[0].axis);
  const RadialWall wall = [](double s, double theta) {
    return 1.5 + 0.2 * std::sin(0.6 * s) + 0.15 * std::cos(2.0 * theta) * std::cos(0.3 * s);
  };
  const auto samples = walls(samples_of(axis, wall, 0.0, axis.length(), 1));
  for (const SurfaceSample& sample : samples) {
    const auto foot = axis.foot_near(sample.position, sample.s_mm, 1.0);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->rho_mm, wall(foot->s_mm, foot->theta), 1e-7);
    // The implicit function rho - wall(s, theta) falls off across the wall along its gradient alone.
    if (sample.s_mm < 0.2 || sample.s_mm > axis.length() - 0.2) continue;
    const auto f = [&](const Vec3& place) {
      const auto at = axis.foot_near(place, sample.s_mm, 1.0);
      return at->rho_mm - wall(at->s_mm, at->theta);
    };
    Vec3 gradient;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = 1e-3 * Vec3::Unit(k);
      gradient[k] = f(sample.position + step) - f(sample.position - step);
    }
    EXPECT_LT((sample.normal - gradient.normalized()).norm(), 2e-4);
  }
}

TEST(SamplesOf, NormalsOnAHelicalTubeAreRadial) {
  const auto shape = geometry::helix_tube(8.0, 10.0, 0.8, 1.5, 0.1);
  const AxisCurve axis(shape.tubes[0].axis);
  const auto samples = walls(samples_of(
      axis, [](double, double) { return 1.5; }, 0.0, axis.length(), 1));
  for (const SurfaceSample& sample : samples) {
    const Vec3 out = sample.position - axis.point(sample.s_mm);
    EXPECT_NEAR(out.norm(), 1.5, 1e-9);
    EXPECT_LT((sample.normal - out / 1.5).norm(), 1e-6);
  }
}

TEST(SamplesOf, StandAsDenselyAsAsked) {
  const AxisCurve axis(geometry::straight_tube(30.0, 1.5).tubes[0].axis);
  const RadialWall wall = [](double, double) { return 1.5; };
  for (const double spacing : {0.5, 1.0, 1.4}) {
    SamplingOptions options;
    options.spacing_mm = spacing;
    const auto samples = samples_of(axis, wall, 0.0, 30.0, 1, options);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        nearest = std::min(nearest, (samples[i].position - samples[j].position).norm());
    }
    const double step = std::min(spacing, 2.0 * pi * 1.5 / 8.0);
    EXPECT_GT(nearest, 0.44 * step);
    EXPECT_LT(widest_hole(axis, wall, samples, 0.0, 30.0), 0.75 * step);
  }
}

TEST(SamplesOf, ANarrowingIsSampledMoreDensely) {
  const auto shape = geometry::stenosed_tube(40.0, 1.6, 0.6, 20.0, 8.0);
  const AxisCurve axis(shape.tubes[0].axis);
  const auto samples = walls(samples_of(
      axis, [&](double s, double) { return axis.radius(s); }, 0.0, 40.0, 1));
  const auto rings = [&](double from, double to) {
    std::set<double> at;
    for (const SurfaceSample& s : samples) {
      if (s.s_mm >= from && s.s_mm < to) at.insert(s.s_mm);
    }
    return at.size();
  };
  EXPECT_LE(rings(4.0, 12.0), 9U);
  EXPECT_GE(rings(16.0, 24.0), 12U);
  std::set<double> at;
  for (const SurfaceSample& s : samples) at.insert(s.s_mm);
  double before = -1.0;
  for (const double s : at) {
    if (before >= 0.0) {
      EXPECT_GT(s - before, 0.35);
      EXPECT_LT(s - before, 1.01);
    }
    before = s;
  }
}

TEST(SamplesOf, RingsAreStaggered) {
  const AxisCurve axis(geometry::straight_tube(20.0, 1.2).tubes[0].axis);
  const auto samples = walls(samples_of(
      axis, [](double, double) { return 1.2; }, 0.0, 20.0, 1));
  std::map<double, double> first_angle;
  for (const SurfaceSample& s : samples) {
    const double theta = axis.nearest_foot(s.position).theta;
    const double turn = theta < -1e-9 ? theta + 2.0 * pi : theta;
    const auto [at, fresh] = first_angle.emplace(s.s_mm, turn);
    if (!fresh) at->second = std::min(at->second, turn);
  }
  double before = -1.0;
  for (const auto& [s, theta] : first_angle) {
    if (before >= 0.0) {
      EXPECT_NEAR(std::abs(theta - before), pi / 8.0, 0.05);
    }
    before = theta;
  }
}

TEST(SamplesOf, CapsAreHemispheresBeyondBothEnds) {
  const AxisCurve axis(geometry::straight_tube(20.0, 1.2).tubes[0].axis);
  const auto samples = samples_of(
      axis, [](double, double) { return 1.2; }, 0.0, 20.0, 7);
  int before = 0, beyond = 0;
  std::int64_t id = 7;
  for (const SurfaceSample& s : samples) {
    EXPECT_EQ(s.id, id++);
    EXPECT_NEAR(s.normal.norm(), 1.0, 1e-12);
    if (s.origin != SampleOrigin::cap) continue;
    const Vec3 end(0.0, 0.0, s.position.z() < 10.0 ? 0.0 : 20.0);
    (s.position.z() < 10.0 ? before : beyond)++;
    EXPECT_NEAR((s.position - end).norm(), 1.2, 1e-9);
    EXPECT_LT((s.normal - (s.position - end).normalized()).norm(), 1e-9);
    EXPECT_DOUBLE_EQ(s.s_mm, end.z());
  }
  EXPECT_GE(before, 5);
  EXPECT_EQ(before, beyond);
}

TEST(SamplesOf, NoSampleLiesInsideAnotherRingOfATightBend) {
  // A half circle of 1.2 mm about the axis of a vessel as wide as 1.8 mm.
  geometry::Centerline line;
  const double bend = 1.2;
  for (double z = -12.0; z < 0.0; z += 0.2) line.points.push_back({bend, 0.0, z});
  for (double a = 0.0; a < pi; a += 0.1) line.points.push_back({bend * std::cos(a), 0.0, bend * std::sin(a)});
  for (double z = 0.0; z > -12.0; z -= 0.2) line.points.push_back({-bend - 0.15 * -z, 0.0, z});
  line.radius.assign(line.points.size(), 1.8);
  const AxisCurve axis(line);
  const auto samples = samples_of(
      axis, [](double, double) { return 1.8; }, 0.0, axis.length(), 1);
  for (const SurfaceSample& s : walls(samples)) EXPECT_GT(axis.nearest_foot(s.position).rho_mm, 1.8 - 2e-3);
  EXPECT_GT(samples.size(), 200U);
}

TEST(SamplesOf, RefusesAWallWithoutWidthAndAForeignStretch) {
  const AxisCurve axis(geometry::straight_tube(20.0, 1.2).tubes[0].axis);
  const auto one = [](double, double) { return 1.0; };
  expect_says(message_of([&] {
                samples_of(
                    axis, [](double s, double) { return 5.0 - s; }, 0.0, 20.0, 1);
              }),
              {"mm from the axis at", "positive"});
  expect_says(message_of([&] { samples_of(axis, one, 3.0, 25.0, 1); }), {"25.0", "20.0"});
  expect_says(message_of([&] { samples_of(axis, one, 9.0, 3.0, 1); }), {"9.0"});
  SamplingOptions options;
  options.spacing_mm = 9.0;
  expect_says(message_of([&] { samples_of(axis, one, 0.0, 20.0, 1, options); }), {"9.0", "0.1 to 5 mm"});
}

TEST(ModelOfTubes, IsSoundForTreesAndBranchesBeginInsideTheirParents) {
  for (const auto& shape :
       {geometry::coronary_like_tree(0.25), geometry::y_junction(15.0, 15.0, 1.8, 1.4, 70.0, 0.25)}) {
    const auto tree = tree_of(shape);
    const LumenModel model = model_of_tubes(tree);
    EXPECT_EQ(find_fault(model), std::nullopt);
    const geometry::TubeDistance distance(shape);
    const double trunk_end = shape.tubes.front().axis.abscissa.back();
    for (const auto& lumen : model.vessels) {
      EXPECT_GT(lumen->interpolation.support_radius_mm, 1.0);
      double least = std::numeric_limits<double>::infinity();
      for (const SurfaceSample& sample : lumen->samples) {
        least = std::min(least, sample.s_mm);
        // Caps beyond free ends stand out by no more than the end balls do.
        EXPECT_LT(distance(sample.position), 0.03) << lumen->vessel << " at " << sample.s_mm;
        const geometry::AxisFoot foot = lumen->axis->nearest_foot(sample.position);
        const double from = lumen->own_from_mm > 0.0 ? lumen->own_from_mm + 0.5 : 0.0;
        const bool step = std::abs(sample.s_mm - trunk_end) < 0.5;  // a radius there jumps to the child's
        if (sample.origin != SampleOrigin::cap && sample.s_mm >= from && !step) {
          EXPECT_NEAR(foot.rho_mm, lumen->axis->radius(sample.s_mm), 0.01) << foot.s_mm;
        }
      }
      if (lumen->own_from_mm > 0.0) {
        EXPECT_LT(least, lumen->own_from_mm);
        EXPECT_GT(least, lumen->own_from_mm - 2.5);
        // All of the starting cap is within the parent.
        for (const SurfaceSample& sample : lumen->samples) {
          if (sample.s_mm < lumen->own_from_mm - 0.05) {
            EXPECT_LT(distance(sample.position), 1e-3);
          }
        }
      }
    }
  }
}

TEST(ModelOfTubes, TakesOneRadiusForAll) {
  const LumenModel model = model_of_tubes(straight_vessel(20.0, 1.2), 0.8);
  for (const SurfaceSample& s : walls(model.vessels[0]->samples))
    EXPECT_NEAR(std::hypot(s.position.x(), s.position.y()), 0.8, 1e-9);
}

TEST(ModelOfWalls, TakesTheWallsGivenAndTubesElsewhere) {
  const auto tree = tree_of(geometry::y_junction(15.0, 15.0, 1.8, 1.4, 70.0, 0.25));
  const RadialWall wall = [](double s, double theta) { return 1.5 + 0.1 * std::sin(theta) + 0.001 * s; };
  const LumenModel model = model_of_walls(tree, {wall, {}});
  const LumenModel tubes = model_of_tubes(tree);
  for (const SurfaceSample& s : walls(model.vessels[0]->samples)) {
    const auto foot = model.vessels[0]->axis->foot_near(s.position, s.s_mm, 1.0);
    ASSERT_TRUE(foot);
    EXPECT_NEAR(foot->rho_mm, wall(foot->s_mm, foot->theta), 1e-7);
  }
  ASSERT_EQ(model.vessels[1]->samples.size(), tubes.vessels[1]->samples.size());
  EXPECT_EQ(model.vessels[1]->samples[5].position, tubes.vessels[1]->samples[5].position);
  expect_says(message_of([&] { model_of_walls(tree, {wall}); }), {"1 walls", "2 vessels"});
}

TEST(ModelOfSurface, FindsAStenosedTubeAlongAnAxisBesideItsMiddle) {
  const auto shape = geometry::stenosed_tube(30.0, 1.6, 0.5, 15.0, 10.0);
  const auto surface = geometry::surface_of(shape, 0.3, true);
  geometry::Centerline line = shape.tubes[0].axis;
  for (Vec3& p : line.points) p += Vec3(0.2, -0.1, 0.0);
  geometry::complete(line);
  const LumenModel model = model_of_surface(tree_of(line), surface);
  const geometry::TubeDistance distance(shape);
  for (const SurfaceSample& s : walls(model.vessels[0]->samples)) {
    if (s.s_mm > 1.0 && s.s_mm < 29.0) {
      EXPECT_NEAR(distance(s.position), 0.0, 0.04) << s.s_mm;
    }
  }
}

TEST(ModelOfSurface, DoesNotRunIntoSideBranches) {
  const auto shape = geometry::coronary_like_tree(0.25);
  const auto surface = geometry::surface_of(shape, 0.3, true);
  const auto tree = tree_of(shape);
  const LumenModel model = model_of_surface(tree, surface);
  EXPECT_EQ(find_fault(model), std::nullopt);
  const geometry::TubeDistance distance(shape);
  const AxisCurve& trunk = *model.vessels[0]->axis;
  for (const SurfaceSample& s : walls(model.vessels[0]->samples)) {
    // The trunk passes its branches as wide as it is; elsewhere its wall is the surface's.
    EXPECT_LT((s.position - trunk.point(s.s_mm)).norm(), 1.6 * trunk.radius(s.s_mm)) << s.s_mm;
    EXPECT_LT(distance(s.position), 0.08) << s.s_mm;
  }
  for (const auto& lumen : model.vessels) {
    for (const SurfaceSample& s : walls(lumen->samples)) {
      if (s.s_mm > lumen->own_from_mm + 12.0 && s.s_mm < lumen->axis->length() - 1.0 &&
          lumen->own_from_mm > 0.0) {
        EXPECT_NEAR(distance(s.position), 0.0, 0.04) << lumen->vessel << " at " << s.s_mm;
      }
    }
  }
}

TEST(ModelOfSurface, IsATubeWhereThereIsNoSurface) {
  const auto far = geometry::straight_tube(5.0, 1.0);
  auto surface = geometry::surface_of(far, 0.3, true);
  for (Vec3& p : surface.points) p += Vec3(100.0, 0.0, 0.0);
  const LumenModel model = model_of_surface(straight_vessel(20.0, 1.2), surface);
  for (const SurfaceSample& s : walls(model.vessels[0]->samples))
    EXPECT_NEAR(std::hypot(s.position.x(), s.position.y()), 1.2, 1e-9);
}

geometry::Contour ellipse_at(double s, double a, double b) {
  geometry::Contour contour;
  contour.s_mm = s;
  const geometry::Frame frame{Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  for (int k = 0; k < 120; ++k) {
    const double t = 2.0 * pi * k / 120.0;
    contour.points.push_back(Vec3(0.0, 0.0, s) + a * std::cos(t) * geometry::radial_direction(frame, 0.0) +
                             b * std::sin(t) * geometry::radial_direction(frame, 0.5 * pi));
  }
  return contour;
}

geometry::ContourSet ellipses(double from, double to) {
  geometry::ContourSection section;
  section.section = "s01";
  section.vessel = "LAD";
  section.observer = "observer1";
  for (double s = from; s <= to + 1e-9; s += 0.5) section.contours.push_back(ellipse_at(s, 1.8, 1.2));
  return {{section}};
}

TEST(ModelOfContours, FollowsTheContoursAndPassesSmoothlyToTheTube) {
  const LumenModel model = model_of_contours(straight_vessel(30.0, 1.0), ellipses(10.0, 20.0));
  EXPECT_EQ(find_fault(model), std::nullopt);
  double before = 1.0;
  for (const SurfaceSample& s : walls(model.vessels[0]->samples)) {
    const double x = s.position.x(), y = s.position.y();
    const double level = std::hypot(x / 1.8, y / 1.2);
    if (s.s_mm >= 10.0 && s.s_mm <= 20.0) {
      EXPECT_NEAR(level, 1.0, 2e-3) << s.s_mm;
    }
    if (s.s_mm < 6.9 || s.s_mm > 23.1) {
      EXPECT_NEAR(std::hypot(x, y), 1.0, 1e-9);
    }
    if (s.s_mm < 10.0) {
      EXPECT_LT(level, 1.002);
      before = std::min(before, level);
    }
  }
  EXPECT_LT(before, 0.6);
}

TEST(ModelOfContours, RefusesContoursThatMissTheAxisOrOverlap) {
  const auto tree = straight_vessel(30.0, 1.0);
  auto aside = ellipses(10.0, 20.0);
  for (auto& contour : aside.sections[0].contours) {
    for (Vec3& p : contour.points) p += Vec3(4.0, 0.0, 0.0);
  }
  expect_says(message_of([&] { model_of_contours(tree, aside); }), {"s01", "LAD", "around"});
  auto twice = ellipses(10.0, 20.0);
  twice.sections.push_back(twice.sections[0]);
  twice.sections[1].observer = "observer2";
  expect_says(message_of([&] { model_of_contours(tree, twice); }), {"overlap", "observer2"});
  auto unknown = ellipses(10.0, 20.0);
  unknown.sections[0].vessel = "RCA";
  expect_says(message_of([&] { model_of_contours(tree, unknown); }), {"RCA", "does not have"});
  auto beyond = ellipses(40.0, 44.0);
  expect_says(message_of([&] { model_of_contours(tree, beyond); }), {"does not meet"});
}

TEST(ModelOfContours, FindsContoursWhoseAbscissasCountFromABranchsOrigin) {
  const auto shape = geometry::coronary_like_tree(0.25);
  const auto tree = tree_of(shape);
  const LumenModel tubes = model_of_tubes(tree);
  const VesselLumen& branch = *tubes.vessels[2];
  geometry::ContourSection section;
  section.section = "s02";
  section.vessel = tree.vessels[2].name;
  section.observer = "observer1";
  const double from = branch.own_from_mm + 12.0;
  for (double s = from; s < from + 8.0; s += 0.5) {
    geometry::Contour contour;
    contour.s_mm = s - branch.own_from_mm;
    for (int k = 0; k < 64; ++k) contour.points.push_back(branch.axis->place(s, 2.0 * pi * k / 64.0, 0.7));
    section.contours.push_back(contour);
  }
  const LumenModel model = model_of_contours(tree, {{section}});
  EXPECT_EQ(find_fault(model), std::nullopt);
  int inside = 0;
  for (const SurfaceSample& s : walls(model.vessels[2]->samples)) {
    if (s.s_mm < from || s.s_mm > from + 7.5) continue;
    EXPECT_NEAR((s.position - branch.axis->point(s.s_mm)).norm(), 0.7, 2e-3);
    ++inside;
  }
  EXPECT_GT(inside, 60);
}

TEST(ModelOfSurface, CanBeCancelled) {
  const auto shape = geometry::straight_tube(20.0, 1.2);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(model_of_surface(tree_of(shape.tubes[0]), geometry::surface_of(shape, 0.3, true), {}, task),
               Cancelled);
}

TEST(StartingAxis, RefusesWhatCannotBearAWall) {
  const auto refused = [](const geometry::Centerline& line) {
    return message_of([&] { model_of_tubes(tree_of(line)); });
  };
  geometry::Centerline two;
  two.points = {Vec3::Zero(), Vec3(0.0, 0.0, 9.0)};
  two.radius = {1.0, 1.0};
  expect_says(refused(two), {"vessel 4 (LAD)", "2 points"});

  geometry::Centerline kink;
  for (double z = 0.0; z < 10.0; z += 0.25) kink.points.push_back({0.0, 0.0, z});
  for (double x = 0.0; x < 10.0; x += 0.25) kink.points.push_back({x, 0.0, 10.0 - 0.3 * x});
  kink.radius.assign(kink.points.size(), 1.5);
  expect_says(refused(kink), {"vessel 4 (LAD)", "kink at", "mm"});

  geometry::Centerline loop;
  for (double a = -1.0; a < 2.0 * pi + 1.0; a += 0.05)
    loop.points.push_back({6.0 * std::cos(a), 6.0 * std::sin(a), 0.02 * a});
  loop.radius.assign(loop.points.size(), 1.0);
  expect_says(refused(loop), {"vessel 4 (LAD)", "loop", "mm"});

  auto thin = geometry::straight_tube(20.0, 1.0, 0.5).tubes[0].axis;
  thin.radius[12] = 0.0;
  expect_says(refused(thin), {"vessel 4 (LAD)", "0.00 mm at 6.00 mm", "positive"});

  expect_says(refused(geometry::straight_tube(1.0, 1.5).tubes[0].axis),
              {"vessel 4 (LAD)", "shorter", "1.50"});

  auto tree = straight_vessel(20.0, 1.0);
  tree.segments[0].to = 77;
  expect_says(message_of([&] { model_of_tubes(tree); }), {"77"});
  tree = straight_vessel(20.0, 1.0);
  tree.vessels.push_back({9, "again", {3}});
  expect_says(message_of([&] { model_of_tubes(tree); }), {"vessel 9 (again)", "own"});
  expect_says(message_of([&] { model_of_tubes(straight_vessel(20.0, 1.0), -1.0); }), {"positive"});
}

TEST(StartingAxis, TakesStrongButHonestBends) {
  geometry::Centerline line;
  for (double a = 0.0; a < pi; a += 0.05) line.points.push_back({2.0 * std::cos(a), 2.0 * std::sin(a), 0.0});
  line.radius.assign(line.points.size(), 1.5);
  EXPECT_EQ(find_fault(model_of_tubes(tree_of(line))), std::nullopt);
}

}  // namespace
}  // namespace ostia::lumen
