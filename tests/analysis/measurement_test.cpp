// What a person measures, where the answer is known.

#include "ostia/analysis/measurement.h"

#include "walls.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace ostia::analysis {
namespace {

using testing::bump;
using testing::pi;
using testing::Solved;

double named(const std::vector<MeasuredValue>& values, const std::string& name) {
  for (const MeasuredValue& value : values) {
    if (value.name == name) return value.value;
  }
  ADD_FAILURE() << "no " << name;
  return NAN;
}

Measurement of(MeasureKind kind, std::vector<Vec3> points) {
  Measurement measurement;
  measurement.kind = kind;
  measurement.points = std::move(points);
  return measurement;
}

/// A vessel of 1.5 mm with half a stenosis, its profile, and an image that rises along x by 10 HU a mm.
struct Bench {
  Solved vessel = testing::straight(
      40.0, [](double s, double) { return 1.5 * (1.0 - 0.5 * bump(s, 20.0, 10.0)); }, {.spacing_mm = 0.6});
  LumenProfile profile = vessel.profile();
  imaging::ImageVolume image;
  MeasureContext context;

  Bench() {
    image.geometry.size = {61, 41, 81};
    image.geometry.spacing = Vec3(0.5, 0.5, 0.5);
    image.geometry.origin = Vec3(-10.0, -10.0, 0.0);
    for (int k = 0; k < 81; ++k)
      for (int j = 0; j < 41; ++j)
        for (int i = 0; i < 61; ++i) image.voxels.push_back(static_cast<std::int16_t>(5 * i));
    context.model = &vessel.model;
    context.surface_of = vessel.surface_of();
    context.profile_of = [this](std::int32_t) -> const LumenProfile& { return profile; };
    context.image = &image;
  }
  Measurement stretch(MeasureKind kind, double from, double to) const {
    Measurement measurement;
    measurement.kind = kind;
    measurement.vessel = vessel.first();
    measurement.from_mm = from;
    measurement.to_mm = to;
    return measurement;
  }
};

TEST(Measured, DistanceAngleAndDiameter) {
  const auto distance = measured(of(MeasureKind::distance, {Vec3(1, 2, 3), Vec3(1, 5, 7)}), {});
  EXPECT_EQ(distance.front().name, "length");
  EXPECT_DOUBLE_EQ(distance.front().value, 5.0);
  EXPECT_EQ(distance.front().unit, "mm");
  const auto angle = measured(of(MeasureKind::angle, {Vec3(2, 0, 0), Vec3(0, 0, 0), Vec3(3, 3, 0)}), {});
  EXPECT_NEAR(angle.front().value, 45.0, 1e-12);
  EXPECT_EQ(angle.front().unit, "deg");
  const auto straight =
      measured(of(MeasureKind::angle, {Vec3(2, 0, 0), Vec3(0, 0, 0), Vec3(-1e-9, 0, 0)}), {});
  EXPECT_NEAR(straight.front().value, 180.0, 1e-12);
  EXPECT_DOUBLE_EQ(measured(of(MeasureKind::diameter, {Vec3(0, 0, 0), Vec3(0, 0, 3)}), {}).front().value,
                   3.0);
}

TEST(Measured, AreaOfAClosedLineHoweverItLiesAndRuns) {
  const Vec3 at(4, 5, 6), u = Vec3(1, 2, 2) / 3.0, v = Vec3(2, 1, -2) / 3.0;
  std::vector<Vec3> hollow{at, at + 4.0 * u, at + 4.0 * u + 3.0 * v, at + 2.0 * u + v, at + 3.0 * v};
  EXPECT_NEAR(measured(of(MeasureKind::area, hollow), {}).front().value, 8.0, 1e-9);
  std::reverse(hollow.begin(), hollow.end());
  const auto area = measured(of(MeasureKind::area, hollow), {});
  EXPECT_NEAR(area.front().value, 8.0, 1e-9);
  EXPECT_NEAR(named(area, "perimeter"), 10.0 + 2.0 * std::sqrt(8.0), 1e-9);
}

TEST(Measured, AreaWithAnImageTellsTheCtNumbersOfItsVoxels) {
  // Voxels of 0.5 mm: 100 HU for x < 0, 300 HU beyond, and a spot of 1000 HU that lies outside.
  imaging::ImageVolume image;
  image.geometry.size = {40, 40, 3};
  image.geometry.spacing = {0.5, 0.5, 0.5};
  image.geometry.origin = {-9.75, -9.75, -0.5};
  for (std::int64_t n = 0; n < image.geometry.voxels(); ++n)
    image.voxels.push_back(static_cast<std::int16_t>(n % 40 < 20 ? 100 : 300));
  image(39, 39, 1) = 1000;
  MeasureContext context;
  context.image = &image;
  const auto square = [](double from, double to) {
    return std::vector<Vec3>{{from, -4.0, 0.0}, {to, -4.0, 0.0}, {to, 4.0, 0.0}, {from, 4.0, 0.0}};
  };
  const auto half = measured(of(MeasureKind::area, square(-4.0, 4.0)), context);
  EXPECT_EQ(half.front().name, "area");
  EXPECT_NEAR(half.front().value, 64.0, 1e-9);
  EXPECT_NEAR(named(half, "mean"), 200.0, 1e-6);
  EXPECT_NEAR(named(half, "SD"), 100.0, 1e-6) << "of voxels, not of what lies between them";
  EXPECT_EQ(named(half, "largest"), 300.0);
  const auto even = measured(of(MeasureKind::area, square(-6.0, -2.0)), context);
  EXPECT_NEAR(named(even, "mean"), 100.0, 1e-9);
  EXPECT_NEAR(named(even, "SD"), 0.0, 1e-9);
  const auto outside = measured(of(MeasureKind::area, square(50.0, 54.0)), context);
  EXPECT_EQ(outside.size(), 2U) << "the image says nothing there";
}

TEST(Measured, RemarksMeasureNothing) {
  EXPECT_TRUE(measured(of(MeasureKind::arrow, {Vec3(1, 2, 3), Vec3(1, 5, 7)}), {}).empty());
  EXPECT_TRUE(measured(of(MeasureKind::note, {Vec3(1, 2, 3)}), {}).empty());
  EXPECT_THROW(measured(of(MeasureKind::note, {Vec3(1, 2, 3), Vec3(1, 5, 7)}), {}), InvalidInput);
  EXPECT_THROW(measured(of(MeasureKind::arrow, {Vec3(1, 2, 3)}), {}), InvalidInput);
}

TEST(Measured, StenosisAndVolumeOfAVessel) {
  const Bench bench;
  const auto stenosis = measured(bench.stretch(MeasureKind::stenosis, 10.0, 30.0), bench.context);
  EXPECT_EQ(stenosis.front().name, "percent diameter");
  EXPECT_NEAR(stenosis.front().value, 50.0, 2.5);
  EXPECT_NEAR(named(stenosis, "percent area"), 75.0, 2.5);
  EXPECT_NEAR(named(stenosis, "MLD"), 1.5, 0.05);
  EXPECT_NEAR(named(stenosis, "MLA"), pi * 0.5625, 0.1);
  EXPECT_NEAR(named(stenosis, "reference diameter"), 3.0, 0.04);
  const auto volume = measured(bench.stretch(MeasureKind::volume, 28.0, 36.0), bench.context);
  EXPECT_NEAR(volume.front().value, 8.0 * pi * 2.25, 0.01 * 8.0 * pi * 2.25);
  EXPECT_EQ(volume.front().unit, "mm3");
  EXPECT_NEAR(named(volume, "mean area"), pi * 2.25, 0.01 * pi * 2.25);
}

TEST(Measured, RingOfCtNumbersIsWeightedByArea) {
  const Bench bench;
  Measurement ring = bench.stretch(MeasureKind::ring_hu, 32.0, 0.0);
  ring.inner_mm = 0.5;
  ring.outer_mm = 2.0;
  const auto values = measured(ring, bench.context);
  EXPECT_EQ(values.front().name, "mean");
  EXPECT_NEAR(values.front().value, 100.0, 0.5);  // of 10 (x + 10) about x = 0
  // <x^2> of a ring from a = 2 to b = 3.5 mm is (a^2 + b^2) / 4: by length alone it would be less.
  EXPECT_NEAR(named(values, "SD"), 10.0 * std::sqrt((4.0 + 12.25) / 4.0), 0.2);
  EXPECT_NEAR(named(values, "least"), 65.0, 2.0);
  EXPECT_NEAR(named(values, "largest"), 135.0, 2.0);
  EXPECT_NEAR(named(values, "samples"), pi * (12.25 - 4.0) / 0.01, 60.0);
}

TEST(Measured, RingThatLeavesTheImageCountsWhatTheImageShows) {
  Bench bench;
  Measurement ring = bench.stretch(MeasureKind::ring_hu, 32.0, 0.0);
  const double whole = named(measured(ring, bench.context), "samples");
  bench.image.geometry.origin.x() = 0.25;  // contains x >= 0
  const auto half = measured(ring, bench.context);
  EXPECT_NEAR(named(half, "samples"), 0.5 * whole, 0.02 * whole);
  bench.image.geometry.origin.x() = 50.0;
  EXPECT_THROW(measured(ring, bench.context), InvalidInput);
}

TEST(Measured, RefusesFaultsAndWhatIsMissing) {
  const Bench bench;
  EXPECT_THROW(measured(of(MeasureKind::angle, {Vec3::Zero(), Vec3::UnitX()}), {}), InvalidInput);
  EXPECT_THROW(measured(bench.stretch(MeasureKind::volume, 5.0, 41.0), bench.context), InvalidInput);
  EXPECT_THROW(measured(bench.stretch(MeasureKind::ring_hu, 41.0, 0.0), bench.context), InvalidInput);
  Measurement other = bench.stretch(MeasureKind::stenosis, 10.0, 30.0);
  other.vessel = 99;
  EXPECT_THROW(measured(other, bench.context), InvalidInput);
  for (const MeasureKind kind : {MeasureKind::stenosis, MeasureKind::volume, MeasureKind::ring_hu})
    EXPECT_THROW(measured(bench.stretch(kind, 10.0, 30.0), {}), InvalidInput) << to_string(kind);
  MeasureContext blind = bench.context;
  blind.image = nullptr;
  EXPECT_THROW(measured(bench.stretch(MeasureKind::ring_hu, 10.0, 30.0), blind), InvalidInput);
}

TEST(Measurement, SaysWhatIsWrongWithIt) {
  using ::testing::HasSubstr;
  const auto fault = [](const Measurement& m) { return find_fault(m).value_or(""); };
  EXPECT_EQ(fault(of(MeasureKind::distance, {Vec3::Zero(), Vec3::UnitX()})), "");
  EXPECT_THAT(fault(of(MeasureKind::distance, {Vec3::Zero()})), HasSubstr("two points"));
  EXPECT_THAT(fault(of(MeasureKind::angle, {Vec3::Zero(), Vec3::UnitX()})),
              HasSubstr("an angle needs three points"));
  EXPECT_THAT(fault(of(MeasureKind::angle, {Vec3::Zero(), Vec3::Zero(), Vec3::UnitX()})),
              HasSubstr("vertex"));
  EXPECT_THAT(fault(of(MeasureKind::area, {Vec3::Zero(), Vec3::UnitX()})), HasSubstr("three points"));
  EXPECT_THAT(fault(of(MeasureKind::distance, {Vec3::Zero(), Vec3(0, NAN, 0)})), HasSubstr("not finite"));
  Measurement ring;
  ring.kind = MeasureKind::ring_hu;
  EXPECT_THAT(fault(ring), HasSubstr("vessel"));
  ring.vessel = 3;
  EXPECT_EQ(fault(ring), "");
  ring.outer_mm = ring.inner_mm;
  EXPECT_THAT(fault(ring), HasSubstr("ring"));
  Measurement volume;
  volume.kind = MeasureKind::volume;
  volume.vessel = 3;
  EXPECT_THAT(fault(volume), HasSubstr("distal"));
  volume.to_mm = 4.0;
  EXPECT_EQ(fault(volume), "");
  volume.from_mm = -1.0;
  EXPECT_THAT(fault(volume), HasSubstr("abscissa"));
}

TEST(MeasureKind, NamesGoThereAndBack) {
  std::set<std::string_view> names, labels;
  for (const MeasureKind kind : measure_kinds) {
    const MeasureTraits& traits = traits_of(kind);
    EXPECT_EQ(traits.kind, kind);
    EXPECT_EQ(measure_kind(to_string(kind)), kind);
    EXPECT_TRUE(names.insert(traits.name).second) << traits.name;
    EXPECT_TRUE(labels.insert(traits.label).second) << traits.label;
    EXPECT_NE(traits.points == 0, !traits.fault.empty()) << traits.name;
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("distance", "angle", "area", "diameter", "stenosis",
                                                     "volume", "ring_hu", "arrow", "note"))
      << "case files have these";
  EXPECT_EQ(to_string(MeasureKind::ring_hu), "ring_hu");
  EXPECT_THROW(measure_kind("length"), InvalidInput);
  EXPECT_THROW(to_string(static_cast<MeasureKind>(9)), InvalidInput);
}

TEST(ToText, GivesTheDecimalsThatCount) {
  EXPECT_EQ(to_text({"", 12.345, "mm"}), "12.3 mm");
  EXPECT_EQ(to_text({"", 2.349, "mm"}), "2.35 mm");
  EXPECT_EQ(to_text({"", 9.996, "mm"}), "10.0 mm");
  EXPECT_EQ(to_text({"", 123.45, "mm"}), "123.5 mm");
  EXPECT_EQ(to_text({"", 4.214, "mm2"}), "4.21 mm\u00b2");
  EXPECT_EQ(to_text({"", 154.4, "mm3"}), "154 mm\u00b3");
  EXPECT_EQ(to_text({"", 49.6, "%"}), "50 %");
  EXPECT_EQ(to_text({"", -85.4, "HU"}), "-85 HU");
  EXPECT_EQ(to_text({"", -0.2, "HU"}), "0 HU");
  EXPECT_EQ(to_text({"", 37.25, "deg"}).substr(0, 2), "37");
  EXPECT_EQ(to_text({"", 37.0, "deg"}), "37.0\u00b0");
  EXPECT_EQ(to_text({"", 1520.0, ""}), "1520");
  EXPECT_EQ(to_text({"", NAN, "mm"}), "-");
}

}  // namespace
}  // namespace ostia::analysis
