#include "ostia/experiments/simulated_reader.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <variant>

namespace ostia::experiments {
namespace {

using std::numbers::pi;

/// A tube about the z axis whose radius is 1.6 mm but for a bulge between z = 18 and 22.
class Tube final : public lumen::ScalarField {
 public:
  explicit Tube(double radius_mm, double bulge_mm = 0.0) : radius_(radius_mm), bulge_(bulge_mm) {}
  double value(const Vec3& p) const override {
    const double bulge = std::abs(p.z() - 20.0) < 2.0 ? bulge_ : 0.0;
    return std::hypot(p.x(), p.y()) - radius_ - bulge;
  }
  Vec3 gradient(const Vec3& p) const override { return Vec3(p.x(), p.y(), 0.0).normalized(); }
  void values(std::span<const Vec3> places, std::span<double> out) const override {
    for (std::size_t i = 0; i < places.size(); ++i) out[i] = value(places[i]);
  }
  lumen::Box3 box() const override { return {Vec3(-9, -9, -9), Vec3(9, 9, 49)}; }

 private:
  double radius_, bulge_;
};

std::shared_ptr<const geometry::AxisCurve> axis() {
  geometry::Centerline line;
  for (double z = 0.0; z <= 40.0; z += 0.5) line.points.push_back({0.0, 0.0, z});
  return std::make_shared<const geometry::AxisCurve>(line);
}

geometry::ContourSection overlay(double radius_mm) {
  geometry::ContourSection section;
  section.section = "s01";
  section.vessel = "LAD";
  section.observer = "observer1";
  const auto curve = axis();
  for (double s = 5.0; s <= 35.0; s += 1.0) {
    geometry::Contour contour;
    contour.s_mm = s;
    for (int i = 0; i < 64; ++i) contour.points.push_back(curve->place(s, 2.0 * pi * i / 64, radius_mm));
    section.contours.push_back(contour);
  }
  return section;
}

TEST(SimulatedReader, SeesNothingWhereAllAgrees) {
  SimulatedReader reader(overlay(1.6), axis(), 4);
  EXPECT_FALSE(reader.next(Tube(1.6)));
  EXPECT_EQ(reader.why_stopped(), "no visible disagreement");
  EXPECT_NEAR(reader.from_mm(), 5.0, 1e-6);
  EXPECT_NEAR(reader.to_mm(), 35.0, 1e-6);
}

TEST(SimulatedReader, DrawsAlongTheOverlay) {
  SimulatedReader reader(overlay(1.6), axis(), 4);
  const auto stroke = reader.next(Tube(2.2));
  ASSERT_TRUE(stroke);
  ASSERT_TRUE(std::holds_alternative<lumen::CprStroke>(stroke->edit));
  const auto& drawn = std::get<lumen::CprStroke>(stroke->edit);
  EXPECT_LE(drawn.points.size(), 12U);
  EXPECT_GE(drawn.points.size(), 2U);
  EXPECT_NEAR(stroke->worst_mm, 0.6, 0.01);
  for (const Vec3& p : drawn.points) EXPECT_NEAR(std::hypot(p.x(), p.y()), 1.6, 0.4);
  EXPECT_LT(drawn.points.front().z(), 5.5);
  EXPECT_GT(drawn.points.back().z(), 34.5);
}

TEST(SimulatedReader, GoesWhereTheWallIsOff) {
  SimulatedReader reader(overlay(1.6), axis(), 4);
  const auto stroke = reader.next(Tube(1.6, 0.8));
  ASSERT_TRUE(stroke);
  ASSERT_TRUE(std::holds_alternative<lumen::CprStroke>(stroke->edit));
  for (const Vec3& p : std::get<lumen::CprStroke>(stroke->edit).points) EXPECT_NEAR(p.z(), 20.0, 4.0);
}

TEST(SimulatedReader, PointsWithTheErrorItIsGiven) {
  // With a fine picture the error is that of the hand: its deviation shows in many strokes.
  ReaderOptions options;
  options.picture_px = 4096;
  options.pointing_sigma_mm = 0.05;
  options.most_strokes = 200;
  SimulatedReader reader(overlay(1.6), axis(), 4, options);
  double sum = 0.0;
  int count = 0;
  for (int n = 0; n < 100; ++n) {
    const auto stroke = reader.next(Tube(2.2));
    ASSERT_TRUE(stroke);
    if (stroke->on_section) continue;
    for (const Vec3& p : std::get<lumen::CprStroke>(stroke->edit).points) {
      sum += std::pow(std::hypot(p.x(), p.y()) - 1.6, 2);
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(sum / count), 0.05, 0.006);
}

TEST(SimulatedReader, KeepsToItsShareOfCrossSections) {
  SimulatedReader reader(overlay(1.6), axis(), 4);
  int sections = 0, all = 0;
  while (const auto stroke = reader.next(Tube(2.2))) {
    sections += stroke->on_section ? 1 : 0;
    ++all;
    EXPECT_LE(sections, 0.3 * all + 1e-9);
  }
  EXPECT_EQ(all, 30);
  EXPECT_EQ(reader.why_stopped(), "gave up after 30 strokes");
}

TEST(SimulatedReader, IsTheSameForTheSameSeed) {
  ReaderOptions options;
  SimulatedReader a(overlay(1.6), axis(), 4, options), b(overlay(1.6), axis(), 4, options);
  options.seed = 2;
  SimulatedReader c(overlay(1.6), axis(), 4, options);
  const auto first = std::get<lumen::CprStroke>(a.next(Tube(2.2))->edit);
  EXPECT_EQ(first.points, std::get<lumen::CprStroke>(b.next(Tube(2.2))->edit).points);
  EXPECT_NE(first.points, std::get<lumen::CprStroke>(c.next(Tube(2.2))->edit).points);
}

TEST(SimulatedReader, RefusesASectionElsewhere) {
  geometry::ContourSection far_away = overlay(1.6);
  for (auto& contour : far_away.contours)
    for (Vec3& p : contour.points) p.x() += 50.0;
  EXPECT_THROW(SimulatedReader(far_away, axis(), 4), InvalidInput);
  ReaderOptions options;
  options.points = 2;
  EXPECT_THROW(SimulatedReader(overlay(1.6), axis(), 4, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::experiments
