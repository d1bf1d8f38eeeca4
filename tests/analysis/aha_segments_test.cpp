// Standard segments of trees whose branches leave at known places.

#include "ostia/analysis/aha_segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

namespace ostia::analysis {
namespace {

using geometry::Vec3;

struct Course {
  std::string name, parent;
  double parent_s_mm = 0.0, length_mm = 0.0, radius_mm = 1.0;
};

/// A tree of straight vessels; each leaves its parent's end of a piece. A model of its axes alone.
class Tree {
 public:
  explicit Tree(const std::vector<Course>& courses) : courses_(courses) {
    for (std::size_t i = 0; i < courses.size(); ++i) place(i);
    for (std::size_t i = 0; i < courses.size(); ++i) add_vessel(i);
    EXPECT_EQ(geometry::find_fault(model_.tree), std::nullopt);
    for (const geometry::Vessel& vessel : model_.tree.vessels) {
      auto lumen = std::make_shared<lumen::VesselLumen>();
      lumen->vessel = vessel.id;
      lumen->axis = std::make_shared<geometry::AxisCurve>(geometry::vessel_axis(model_.tree, vessel));
      lumen->own_from_mm = lumen::own_from_mm(model_.tree, vessel.id);
      model_.vessels.push_back(lumen);
    }
  }
  const lumen::LumenModel& model() const { return model_; }

  /// "label from-to" of each segment of a vessel, from where it leaves its parent, in whole mm.
  std::string of(const std::string& name) const {
    std::string text;
    for (const VesselSegment& segment : segments_of(model_)) {
      const auto& vessel = model_.tree.vessels[static_cast<std::size_t>(segment.vessel - 1)];
      if (vessel.name != name) continue;
      const double own = lumen::vessel(model_, segment.vessel).own_from_mm;
      text += (text.empty() ? "" : ", ") + segment.label + " " +
              std::to_string(std::lround(segment.from_mm - own)) + "-" +
              std::to_string(std::lround(segment.to_mm - own));
    }
    return text;
  }

 private:
  std::size_t index(const std::string& name) const {
    for (std::size_t i = 0; i < courses_.size(); ++i) {
      if (courses_[i].name == name) return i;
    }
    return courses_.size();
  }
  void place(std::size_t i) {
    const Course& course = courses_[i];
    start_.push_back(course.parent.empty() ? Vec3(100.0 * static_cast<double>(i), 0, 0)
                                           : at(index(course.parent), course.parent_s_mm));
    const double turn = 1.3 * static_cast<double>(i);
    along_.push_back(
        course.parent.empty()
            ? Vec3(Vec3::UnitZ())
            : (along_[index(course.parent)] + Vec3(std::cos(turn), std::sin(turn), 0.2)).normalized());
  }
  Vec3 at(std::size_t vessel, double s) const { return start_[vessel] + s * along_[vessel]; }

  void add_vessel(std::size_t i) {
    const Course& course = courses_[i];
    std::vector<double> cuts{0.0, course.length_mm};
    for (const Course& other : courses_) {
      if (other.parent == course.name) cuts.push_back(other.parent_s_mm);
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    std::vector<std::int32_t> path;
    std::int32_t from = 0;
    if (course.parent.empty()) {
      from = add_node(at(i, 0.0));
    } else {
      std::tie(from, path) = nodes_.at({index(course.parent), course.parent_s_mm});
    }
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      geometry::TreeSegment segment;
      segment.id = next_++;
      segment.from = from;
      segment.to = from = add_node(at(i, cuts[k + 1]));
      for (double t = 0.0; t <= 1.0; t += 0.125) {
        segment.axis.points.push_back(at(i, cuts[k] + t * (cuts[k + 1] - cuts[k])));
        segment.axis.radius.push_back(course.radius_mm);
      }
      geometry::complete(segment.axis);
      path.push_back(segment.id);
      nodes_[{i, cuts[k + 1]}] = {from, path};
      model_.tree.segments.push_back(segment);
    }
    model_.tree.vessels.push_back({static_cast<std::int32_t>(i + 1), course.name, path});
  }
  std::int32_t add_node(const Vec3& p) {
    model_.tree.nodes.push_back({next_, p});
    return next_++;
  }

  std::vector<Course> courses_;
  std::vector<Vec3> start_, along_;
  std::map<std::pair<std::size_t, double>, std::pair<std::int32_t, std::vector<std::int32_t>>> nodes_;
  std::int32_t next_ = 1;
  lumen::LumenModel model_;
};

TEST(AhaSegments, AreNumberedFromOneToEighteen) {
  const auto& all = aha_segments();
  ASSERT_EQ(all.size(), 18u);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].number, static_cast<int>(i) + 1);
  EXPECT_EQ(all[5].code, "pLAD");
  EXPECT_EQ(all[5].name, "proximal LAD");
  EXPECT_EQ(all[5].vessel, "LAD");
  EXPECT_EQ(all[17].code, "L-PLB");
}

TEST(MainVesselOf, KnowsTheUsualNames) {
  for (const char* name : {"LAD", "D1", "d 2", "Diag-1", "S1"})
    EXPECT_EQ(main_vessel_of(name), "LAD") << name;
  for (const char* name : {"LCX", "LCx", "Cx", "OM1", "OM 2", "RI", "L-PDA"})
    EXPECT_EQ(main_vessel_of(name), "LCX") << name;
  for (const char* name : {"RCA", "PDA", "R-PDA", "AM", "CB", "PLB"})
    EXPECT_EQ(main_vessel_of(name), "RCA") << name;
  for (const char* name : {"LM", "Left main"}) EXPECT_EQ(main_vessel_of(name), "LM") << name;
  for (const char* name : {"", "vessel 3", "X", "LADX"}) EXPECT_EQ(main_vessel_of(name), "") << name;
}

TEST(SegmentsOf, ARightDominantTree) {
  const Tree tree({{"LAD", "", 0, 120},
                   {"LCX", "LAD", 10, 80},
                   {"RI", "LAD", 11, 40},
                   {"D1", "LAD", 32, 40},
                   {"D2", "LAD", 60, 40},
                   {"S1", "LAD", 22, 20, 0.6},
                   {"OM1", "LCX", 15, 40},
                   {"OM2", "LCX", 40, 40},
                   {"OM3", "LCX", 60, 20},
                   {"RCA", "", 0, 140},
                   {"CB", "RCA", 10, 20},
                   {"AM", "RCA", 60, 40},
                   {"PDA", "RCA", 110, 50}});
  EXPECT_EQ(tree.of("LAD"), "LM (5) 0-10, pLAD (6) 10-32, mLAD (7) 32-60, dLAD (8) 60-120");
  EXPECT_EQ(tree.of("LCX"), "pLCX (11) 0-15, dLCX (13) 15-80");
  EXPECT_EQ(tree.of("RCA"), "pRCA (1) 0-30, mRCA (2) 30-60, dRCA (3) 60-110, R-PLB (16) 110-140");
  EXPECT_EQ(tree.of("D1"), "D1 (9) 0-40");
  EXPECT_EQ(tree.of("D2"), "D2 (10) 0-40");
  EXPECT_EQ(tree.of("OM1"), "OM1 (12) 0-40");
  EXPECT_EQ(tree.of("OM2"), "OM2 (14) 0-40");
  EXPECT_EQ(tree.of("OM3"), "OM3 0-20");
  EXPECT_EQ(tree.of("RI"), "RI (17) 0-40");
  EXPECT_EQ(tree.of("PDA"), "R-PDA (4) 0-50");
  EXPECT_EQ(tree.of("CB"), "CB 0-20");
}

TEST(SegmentsOf, ALeftDominantTreeWithItsCircumflexFirst) {
  const Tree tree({{"LCX", "", 0, 100},
                   {"LAD", "LCX", 8, 90},
                   {"PDA", "LCX", 80, 40},
                   {"PLB", "LCX", 70, 30},
                   {"RCA", "", 0, 60}});
  EXPECT_EQ(tree.of("LCX"), "LM (5) 0-8, pLCX (11) 8-54, dLCX (13) 54-100");
  EXPECT_EQ(tree.of("LAD"), "pLAD (6) 0-30, mLAD (7) 30-60, dLAD (8) 60-90");
  EXPECT_EQ(tree.of("PDA"), "L-PDA (15) 0-40");
  EXPECT_EQ(tree.of("PLB"), "L-PLB (18) 0-30");
  EXPECT_EQ(tree.of("RCA"), "pRCA (1) 0-15, mRCA (2) 15-30, dRCA (3) 30-60");
}

TEST(SegmentsOf, UsesLargeBranchesWithoutNames) {
  const Tree tree(
      {{"LAD", "", 0, 100}, {"a", "LAD", 15, 30, 0.6}, {"b", "LAD", 30, 30, 0.9}, {"c", "LAD", 33, 30, 0.9}});
  EXPECT_EQ(tree.of("LAD"), "pLAD (6) 0-30, mLAD (7) 30-65, dLAD (8) 65-100");
  EXPECT_EQ(tree.of("b"), "b 0-30");
}

TEST(SegmentsOf, CoversEachOwnStretchWithoutGaps) {
  const Tree tree({{"LAD", "", 0, 50}, {"LCX", "LAD", 49.8, 30}, {"D1", "LAD", 49.9, 20}});
  std::map<std::int32_t, double> reached;
  for (const VesselSegment& segment : segments_of(tree.model())) {
    const lumen::VesselLumen& vessel = lumen::vessel(tree.model(), segment.vessel);
    const double from = reached.count(segment.vessel) ? reached[segment.vessel] : vessel.own_from_mm;
    EXPECT_DOUBLE_EQ(segment.from_mm, from);
    EXPECT_GT(segment.to_mm, segment.from_mm);
    reached[segment.vessel] = segment.to_mm;
  }
  ASSERT_EQ(reached.size(), 3u);
  for (const auto& [id, to] : reached) EXPECT_DOUBLE_EQ(to, lumen::vessel(tree.model(), id).axis->length());
}

}  // namespace
}  // namespace ostia::analysis
