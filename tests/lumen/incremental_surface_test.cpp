#include "ostia/lumen/incremental_surface.h"

#include "tube_samples.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ostia::lumen {
namespace {

using testing::bent_axis;
using testing::straight_axis;
using testing::tube_vessel;

double radius_of(double s, double theta) {
  return 1.6 - 0.01 * s - 0.5 * std::exp(-std::pow((s - 25.0) / 4.0, 2)) + 0.05 * std::cos(2.0 * theta);
}

enum class Kind { replace, add, remove };
struct Edit {
  std::vector<std::int64_t> removed;
  std::vector<SurfaceSample> added;
};
// The samples nearest to a random one.
Edit edit_near(const std::vector<SurfaceSample>& samples, const Vec3& at, Kind kind, std::size_t count,
               double by, std::int64_t& id) {
  std::vector<SurfaceSample> near = samples;
  std::sort(near.begin(), near.end(), [&](const SurfaceSample& a, const SurfaceSample& b) {
    return (a.position - at).squaredNorm() < (b.position - at).squaredNorm();
  });
  Edit edit;
  for (std::size_t i = 0; i < count; ++i) {
    SurfaceSample sample = near[i];
    if (kind != Kind::add) edit.removed.push_back(sample.id);
    if (kind == Kind::remove) continue;
    sample.id = id++;
    sample.position += by * sample.normal;
    // Beside the one that stays, on the same tangent plane.
    if (kind == Kind::add) sample.position += 0.3 * sample.normal.unitOrthogonal() - by * sample.normal;
    sample.origin = SampleOrigin::edit;
    edit.added.push_back(sample);
  }
  return edit;
}

std::vector<Vec3> places_about(const VesselLumen& vessel, int count) {
  std::vector<Vec3> places;
  std::mt19937 random(5);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < count; ++i)
    places.push_back(vessel.axis->place(unit() * vessel.axis->length(), 6.3 * unit(), 5.0 * unit()));
  return places;
}

double greatest_difference(const ScalarField& a, const ScalarField& b, const std::vector<Vec3>& places) {
  double most = 0.0;
  for (const Vec3& p : places) most = std::max(most, std::abs(a.value(p) - b.value(p)));
  return most;
}

TEST(IncrementalSurface, TwoHundredRandomEditsEqualTheFreshSolution) {
  VesselLumen vessel = tube_vessel(bent_axis(60.0), radius_of);
  IncrementalSurface live(vessel);
  const std::vector<Vec3> places = places_about(vessel, 1500);
  std::mt19937 random(3);
  std::int64_t id = 100000;
  for (int i = 0; i < 200; ++i) {
    const Vec3 at = live.samples()[random() % live.samples().size()].position;
    const double by = 0.3 * static_cast<double>(random() % 1000) / 1000.0 - 0.15;
    const Edit edit = edit_near(live.samples(), at, Kind::replace, 12, by, id);
    const IncrementalReport report = live.change(edit.removed, edit.added);
    EXPECT_LE(report.residual, 1e-7);
    EXPECT_GE(report.rows_added, 12);
    if (i % 20 != 19) continue;
    vessel.samples = live.samples();
    EXPECT_LE(greatest_difference(*live.surface(), solve(vessel), places), 1e-6) << "after edit " << i;
  }
}

TEST(IncrementalSurface, EqualsTheFreshSolutionForAllKernelsFarFieldsAndKindsOfChange) {
  for (const Kernel kernel : {Kernel::morse_c0, Kernel::wendland_c2, Kernel::wendland_c4}) {
    for (const FarField far_field : {FarField::constant, FarField::linear}) {
      VesselLumen vessel = tube_vessel(bent_axis(40.0), radius_of);
      vessel.interpolation.kernel = kernel;
      vessel.interpolation.far_field = far_field;
      IncrementalSurface live(vessel);
      std::int64_t id = 100000;
      const Vec3 start = vessel.axis->point(-1.0), end = vessel.axis->point(41.0),
                 middle = vessel.axis->point(20.0);
      for (const auto& [at, kind, count] :
           {std::tuple{middle, Kind::add, std::size_t{12}}, std::tuple{middle, Kind::remove, std::size_t{2}},
            std::tuple{start, Kind::replace, std::size_t{12}},
            std::tuple{end, Kind::replace, std::size_t{12}}, std::tuple{start, Kind::add, std::size_t{4}},
            std::tuple{end, Kind::remove, std::size_t{1}}}) {
        const Edit edit = edit_near(live.samples(), at, kind, count, 0.1, id);
        live.change(edit.removed, edit.added);
      }
      vessel.samples = live.samples();
      EXPECT_LE(greatest_difference(*live.surface(), solve(vessel), places_about(vessel, 1500)), 1e-6)
          << name(kernel) << (far_field == FarField::linear ? ", linear" : ", constant");
    }
  }
}

TEST(IncrementalSurface, NothingMovesOutsideTheBoxThatIsTold) {
  for (const Kernel kernel : {Kernel::morse_c0, Kernel::wendland_c2, Kernel::wendland_c4}) {
    VesselLumen vessel = tube_vessel(bent_axis(100.0), [](double s, double) { return 1.8 - 0.008 * s; });
    vessel.interpolation.kernel = kernel;
    IncrementalSurface live(vessel);
    const std::vector<Vec3> places = places_about(vessel, 20000);
    std::int64_t id = 100000;
    for (const double s : {1.0, 30.0, 50.0, 99.0}) {
      const auto before = live.surface();
      const Vec3 at = vessel.axis->place(s, 1.0, 1.5);
      const Edit edit = edit_near(live.samples(), at, Kind::replace, 12, 0.12, id);
      const IncrementalReport report = live.change(edit.removed, edit.added);
      ASSERT_FALSE(report.refactored);
      EXPECT_TRUE(report.changed.contains(at));
      EXPECT_LE(report.changed_from_mm, s);
      EXPECT_GE(report.changed_to_mm, s);
      EXPECT_LT(report.changed_to_mm - report.changed_from_mm, 60.0) << "no better than the whole vessel";
      for (const Vec3& p : places) {
        const double s_of = vessel.axis->nearest_foot(p).s_mm;
        const bool told =
            report.changed.contains(p) && s_of >= report.changed_from_mm && s_of <= report.changed_to_mm;
        if (told) continue;
        EXPECT_LE(std::abs(before->value(p) - live.surface()->value(p)), 1e-6) << name(kernel) << " " << s_of;
      }
    }
  }
}

TEST(IncrementalSurface, TakingAnEditBackGivesTheFormerWall) {
  const VesselLumen vessel = tube_vessel(bent_axis(40.0), radius_of);
  IncrementalSurface live(vessel);
  const auto before = live.surface();
  std::int64_t id = 100000;
  const Edit edit = edit_near(live.samples(), vessel.axis->point(20.0), Kind::replace, 12, 0.15, id);
  std::vector<SurfaceSample> gone;
  for (const SurfaceSample& s : live.samples())
    if (std::count(edit.removed.begin(), edit.removed.end(), s.id) > 0) gone.push_back(s);
  live.change(edit.removed, edit.added);
  EXPECT_GT(greatest_difference(*before, *live.surface(), places_about(vessel, 2000)), 0.02);
  std::vector<std::int64_t> ids;
  for (const SurfaceSample& s : edit.added) ids.push_back(s.id);
  live.change(ids, gone);
  EXPECT_LE(greatest_difference(*before, *live.surface(), places_about(vessel, 2000)), 1e-9);
}

TEST(IncrementalSurface, ManyAddedSamplesAreCutAnewByTheirCount) {
  VesselLumen vessel = tube_vessel(straight_axis(20.0), [](double, double) { return 1.5; });
  IncrementalSurface live(vessel);
  std::int64_t id = 100000;
  bool refactored = false;
  for (int ring = 0; ring < 12; ++ring) {
    std::vector<SurfaceSample> added;
    for (int i = 0; i < 9; ++i) {
      const double s = 10.0 + 0.12 * (ring - 6),
                   theta = 2.0 * std::numbers::pi * (i + 0.5 * (ring % 2)) / 9.0 + 0.05;
      const Vec3 normal = vessel.axis->place(s, theta, 1.0) - vessel.axis->point(s);
      added.push_back({id++, vessel.axis->place(s, theta, 1.5), normal, s, SampleOrigin::edit});
    }
    refactored = live.change({}, added).refactored || refactored;
  }
  EXPECT_TRUE(refactored);
  vessel.samples = live.samples();
  EXPECT_LE(greatest_difference(*live.surface(), solve(vessel), places_about(vessel, 1500)), 1e-6);
}

TEST(IncrementalSurface, ARefusedChangeLeavesAllAsItWas) {
  const VesselLumen vessel = tube_vessel(straight_axis(30.0), [](double, double) { return 1.5; });
  IncrementalSurface live(vessel);
  const auto before = live.surface();
  const std::size_t count = live.samples().size();
  EXPECT_THROW(live.change({123456789}, {}), InvalidInput);
  SurfaceSample bad = vessel.samples[10];
  bad.id = 5555;
  bad.position.x() = std::nan("");
  EXPECT_THROW(live.change({}, {bad}), InvalidInput);
  std::vector<std::int64_t> gap;
  for (const SurfaceSample& s : vessel.samples)
    if (s.s_mm > 10.0 && s.s_mm < 20.0) gap.push_back(s.id);
  EXPECT_THROW(live.change(gap, {}), InvalidInput);
  EXPECT_EQ(live.surface(), before);
  EXPECT_EQ(live.samples().size(), count);
  std::int64_t id = 100000;
  const Edit edit = edit_near(live.samples(), vessel.axis->point(15.0), Kind::replace, 12, 0.1, id);
  live.change(edit.removed, edit.added);
  VesselLumen fresh = vessel;
  fresh.samples = live.samples();
  EXPECT_LE(greatest_difference(*live.surface(), solve(fresh), places_about(vessel, 1000)), 1e-6);
}

TEST(IncrementalSurface, ConstructionThrowsAsSolveDoes) {
  VesselLumen vessel = tube_vessel(straight_axis(20.0), [](double, double) { return 1.5; });
  vessel.interpolation.support_radius_mm = 0.6;
  EXPECT_THROW(IncrementalSurface{vessel}, InvalidInput);
  vessel.samples.clear();
  EXPECT_THROW(IncrementalSurface{vessel}, InvalidInput);
}

}  // namespace
}  // namespace ostia::lumen
