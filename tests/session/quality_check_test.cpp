#include "ostia/session/quality_check.h"

#include "case_tools.h"
#include "known_motion.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/lumen_scores.h"
#include "ostia/io/contour_file.h"
#include "ostia/session/beating.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::session {
namespace {

using ::testing::HasSubstr;
using testing::tube_vessel;

using std::numbers::pi;
constexpr double wall_mm = 1.5;  // of the case's tube

geometry::ContourSection section(const std::string& name, const std::string& observer, double from, double to,
                                 double radius, const std::string& vessel) {
  geometry::ContourSection out;
  out.section = name;
  out.vessel = vessel;
  out.observer = observer;
  for (double s = from; s <= to + 1e-9; s += 0.5) {
    geometry::Contour contour{s, {}};
    for (int i = 0; i < 64; ++i)
      contour.points.emplace_back(radius * std::cos(2 * pi * i / 64), -radius * std::sin(2 * pi * i / 64), s);
    out.contours.push_back(contour);
  }
  return out;
}

class QualityCheckTest : public ::testing::Test {
 protected:
  QualityCheckTest() {
    bench_.set_session(Session(CaseFile::create(folder_ / "case.ostia", testing::tube_model())));
    name_ = bench_.vessel_name(tube_vessel);
  }
  geometry::ContourSet truth() const {
    return {{section("s01", "truth", 4.0, 10.0, 1.7, name_), section("s02", "truth", 14.0, 24.0, 1.2, name_),
             section("s01", "observer1", 4.0, 10.0, 2.0, name_)}};
  }
  testing::TempFolder folder_;
  Workbench bench_;
  std::string name_;
  QualityCheck check_{bench_};
};

TEST_F(QualityCheckTest, MeasuresTubesOfKnownRadii) {
  check_.set_truth(truth());
  EXPECT_EQ(check_.observer.get(), "truth");
  EXPECT_THAT(check_.observers(), ::testing::ElementsAre("truth", "observer1"));
  const std::vector<SectionError>& found = check_.sections();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].vessel, tube_vessel);
  EXPECT_NEAR(found[0].from_mm, 4.0, 1e-3);
  EXPECT_NEAR(found[0].to_mm, 10.0, 1e-3);
  EXPECT_NEAR(found[0].mean_mm, 0.2, 0.03);
  EXPECT_NEAR(found[0].surfaces.mean_mm(), 0.2, 0.03);
  EXPECT_NEAR(found[0].area_difference_mm2, pi * (2.25 - 1.7 * 1.7), 0.3);
  EXPECT_NEAR(found[0].dice, 2 * 2.25 / (2.25 + 1.7 * 1.7), 0.02);
  EXPECT_EQ(found[0].missing, 0U);
  EXPECT_NEAR(found[1].surfaces.mean_mm(), 0.3, 0.03);
  const WholeError whole = check_.of_vessel(tube_vessel);
  EXPECT_EQ(whole.sections, 2U);
  EXPECT_NEAR(whole.length_mm, 16.0, 0.01);
  // The mean over both stretches, each weighted by its surfaces' area.
  const double a = 6.0 * (1.7 + 1.5), b = 10.0 * (1.2 + 1.5);
  EXPECT_NEAR(whole.surfaces.mean_mm(), (0.2 * a + 0.3 * b) / (a + b), 0.03);
  EXPECT_EQ(check_.of_case().surfaces.sum, whole.surfaces.sum);
  check_.observer.set("observer1");
  ASSERT_EQ(check_.sections().size(), 1U);
  EXPECT_NEAR(check_.sections()[0].surfaces.mean_mm(), 0.5, 0.03);
}

TEST_F(QualityCheckTest, IsTheDistanceThatTheEvaluationFinds) {
  check_.set_truth(truth());
  bench_.edit(testing::ring(18.0, 2.0));
  const evaluation::LumenResult judge(bench_.session().live().wall(0.1));
  for (std::size_t k = 0; k < 2; ++k) {
    const evaluation::SectionScore score = judge.score(truth().sections[k]);
    const SectionError& live = check_.sections()[k];
    EXPECT_NEAR(live.surfaces.mean_mm(), score.msd_mm, 0.01) << k;
    EXPECT_NEAR(live.surfaces.max_mm, score.max_sd_mm, 0.1) << k;
    EXPECT_NEAR(live.dice, score.dice, 0.01) << k;
  }
}

TEST_F(QualityCheckTest, FollowsEditsToTheSameFiguresAsAFreshOne) {
  check_.set_truth(truth());
  (void)check_.sections();
  int told = 0;
  const Subscription watch = check_.stale.observe([&] { ++told; });
  for (const double s : {6.0, 9.0, 16.0}) {
    bench_.edit(testing::drag(s, 0.4));
    EXPECT_GT(std::exchange(told, 0), 0);
    QualityCheck fresh(bench_);
    fresh.set_truth(truth());
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(check_.sections()[k].surfaces.mean_mm(), fresh.sections()[k].surfaces.mean_mm(), 2e-4) << s;
      EXPECT_NEAR(check_.sections()[k].mean_mm, fresh.sections()[k].mean_mm, 2e-4);
      EXPECT_NEAR(check_.sections()[k].dice, fresh.sections()[k].dice, 2e-4);
    }
  }
  const double before = check_.of_case().surfaces.mean_mm();
  while (bench_.undo()) {
  }
  EXPECT_NE(check_.of_case().surfaces.mean_mm(), before);
  QualityCheck fresh(bench_);
  fresh.set_truth(truth());
  EXPECT_NEAR(check_.of_case().surfaces.mean_mm(), fresh.of_case().surfaces.mean_mm(), 2e-4);
}

TEST_F(QualityCheckTest, AnEditAsksOnlyTheContoursThatItMoved) {
  geometry::ContourSet all{{section("s01", "truth", 3.0, 27.0, 1.7, name_)}};
  check_.set_truth(all);
  (void)check_.sections();
  EXPECT_EQ(check_.last_update_contours(), 49U);
  bench_.edit(testing::drag(15.0, 0.3));
  (void)check_.sections();
  EXPECT_GT(check_.last_update_contours(), 4U);
  EXPECT_LT(check_.last_update_contours(), 40U);
}

TEST_F(QualityCheckTest, MatchesByPlaceWhereNamesDiffer) {
  geometry::ContourSet other = truth();
  for (auto& one : other.sections) one.vessel = "somewhere else";
  geometry::ContourSection far = section("s09", "truth", 4.0, 10.0, 1.2, name_);
  for (auto& c : far.contours)
    for (auto& p : c.points) p.x() += 30.0;
  other.sections.push_back(far);
  check_.set_truth(other);
  ASSERT_EQ(check_.sections().size(), 3U);
  EXPECT_EQ(check_.sections()[0].vessel, tube_vessel);
  EXPECT_FALSE(check_.sections()[2].matched());
  EXPECT_EQ(check_.of_case().unmatched, 1U);
  EXPECT_EQ(check_.of_vessel(tube_vessel).sections, 2U);
}

TEST_F(QualityCheckTest, GoesFromTheWorstToTheNext) {
  check_.set_truth(truth());
  EXPECT_EQ(check_.next_worst(), 1U);
  EXPECT_GE(bench_.cursor_mm.get(), 14.0);
  EXPECT_EQ(check_.next_worst(), 0U);
  EXPECT_LE(bench_.cursor_mm.get(), 10.0);
  EXPECT_EQ(check_.next_worst(), 1U);  // and round again
  check_.close();
  EXPECT_FALSE(check_.next_worst().has_value());
}

TEST_F(QualityCheckTest, GoesToTheSamePlaceOfTheVesselAtAnotherPhase) {
  check_.set_truth(truth());
  check_.go_to(1);
  const double own = bench_.cursor_mm.get();
  geometry::TriMesh wall = bench_.session().live().wall(0.35);
  geometry::Box3 box;
  for (const Vec3& p : wall.points) box.extend(p);
  const Vec3 by = Vec3::Constant(3.0);
  const auto beats = Beating::made(testing::known_motion(box.min() - by, box.max() + by),
                                   bench_.session().file().model(), std::move(wall));
  bench_.show_phase(beats->at(0.25));
  check_.go_to(1);
  EXPECT_NEAR(bench_.own_mm(bench_.cursor_mm.get()), own, 1e-6);
}

TEST_F(QualityCheckTest, TellsTheWallsSignedDistance) {
  check_.set_truth(truth());
  const std::vector<Vec3> points{{1.5, 0, 7}, {0, 1.5, 18}, {1.5, 0, 12}, {1.5, 0, 7}};
  const std::vector<QualityCheck::WallPlace> places{
      {tube_vessel, 7.0}, {tube_vessel, 18.0}, {tube_vessel, 12.0}, {99, 7.0}};
  const std::vector<double> errors = check_.wall_errors(points, places);
  EXPECT_NEAR(errors[0], -0.2, 0.005);
  EXPECT_NEAR(errors[1], 0.3, 0.005);
  EXPECT_TRUE(std::isnan(errors[2]));
  EXPECT_TRUE(std::isnan(errors[3]));
  EXPECT_THROW(check_.wall_errors(points, {}), InvalidInput);
}

TEST_F(QualityCheckTest, ReadsAFileAndRefusesWhatIsNone) {
  io::write_contours(folder_ / "contours.json", truth());
  check_.open(folder_ / "contours.json");
  EXPECT_EQ(check_.sections().size(), 2U);
  testing::write_bytes(folder_ / "bad.json", "{}");
  EXPECT_THROW(check_.open(folder_ / "bad.json"), InvalidInput);
  EXPECT_EQ(check_.sections().size(), 2U);  // as before
  geometry::ContourSet walls = truth();
  for (auto& one : walls.sections) one.boundary = "wall";
  EXPECT_THROW(check_.set_truth(walls), InvalidInput);
  bench_.close_case();
  EXPECT_TRUE(check_.sections().empty());
}

TEST_F(QualityCheckTest, AnEditIsActivity) {
  check_.set_truth(truth());
  check_.timer().start();
  bench_.edit(testing::drag(6.0, 0.2));
  EXPECT_FALSE(check_.timer().idle());
  EXPECT_GT(check_.timer().seconds(), 0.0);
}

}  // namespace
}  // namespace ostia::session
