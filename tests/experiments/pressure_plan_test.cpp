// The vessels of the pressure experiment are what they are said to be.

#include "ostia/experiments/pressure_plan.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/session/case_report.h"
#include "ostia/session/pressure_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace ostia::experiments {
namespace {

const PressureCase& first_of(const std::vector<PressureCase>& plan, PressureKind kind,
                             double severity = 0.0) {
  for (const PressureCase& one : plan)
    if (one.kind == kind && (one.stenoses.empty() || one.stenoses.front().severity >= severity)) return one;
  throw InvalidInput("none");
}

hemodynamics::Network measured(const PressureCase& one) {
  const lumen::LumenModel model = pressure_model(one);
  return session::pressure_tree(model, session::solved_surfaces(model)).network;
}

TEST(PressurePlan, TheSameSeedsAreTheSameVessels) {
  const std::vector<PressureCase> plan = plan_pressure(), again = plan_pressure();
  ASSERT_EQ(plan.size(), again.size());
  for (std::size_t i = 0; i < plan.size(); ++i) EXPECT_EQ(text_of(plan[i]), text_of(again[i]));
  EXPECT_EQ(lumen::digest(pressure_model(plan[3])), lumen::digest(pressure_model(again[3])));
  PressurePlanOptions other;
  other.first_seed = 1001;
  std::set<std::string> texts;
  for (const PressureCase& one : plan) texts.insert(text_of(one));
  for (const PressureCase& one : plan_pressure(other)) {
    if (one.kind == PressureKind::tube) continue;
    EXPECT_FALSE(texts.contains(text_of(one))) << one.id;
  }
}

TEST(PressurePlan, CoversAllKindsSeveritiesLengthsAndFlows) {
  const std::vector<PressureCase> plan = plan_pressure();
  std::map<PressureKind, int> kinds;
  std::map<std::string, std::set<bool>> medina;
  std::set<std::string> names;
  int judged = 0, stenosed = 0;
  double mildest = 1.0, severest = 0.0, shortest = 99.0, longest = 0.0, calm = 1.0, wide = 0.0, re = 0.0;
  for (const PressureCase& one : plan) {
    EXPECT_TRUE(names.insert(one.id).second) << one.id;
    ++kinds[one.kind];
    EXPECT_GT(one.flow_ml_s, 0.05) << one.id;
    EXPECT_LE(one.reynolds, 600.0 + 1e-6) << one.id;
    if (one.kind == PressureKind::tube) continue;
    ++stenosed;
    judged += one.judged ? 1 : 0;
    if (one.kind == PressureKind::fork) medina[one.medina].insert(one.judged);
    EXPECT_GE(one.dilation, 0.24) << one.id;
    EXPECT_LE(one.dilation, 1.0) << one.id;
    calm = std::min(calm, one.dilation);
    wide = std::max(wide, one.dilation);
    re = std::max(re, one.reynolds);
    ASSERT_FALSE(one.stenoses.empty()) << one.id;
    for (const PlannedStenosis& s : one.stenoses) {
      mildest = std::min(mildest, s.severity);
      severest = std::max(severest, s.severity);
      shortest = std::min(shortest, s.length_mm);
      longest = std::max(longest, s.length_mm);
    }
  }
  EXPECT_GE(stenosed, 60);
  EXPECT_EQ(2 * judged, stenosed);
  EXPECT_EQ(kinds.size(), 7u) << "all but patients";
  EXPECT_EQ(medina.size(), 7u);
  for (const auto& [kind, halves] : medina) EXPECT_EQ(halves.size(), 2u) << kind;
  EXPECT_GE(mildest, 0.30);
  EXPECT_LT(mildest, 0.35);
  EXPECT_GT(severest, 0.80);
  EXPECT_LE(severest, 0.85);
  EXPECT_LT(shortest, 5.0);
  EXPECT_GE(shortest, 3.0);
  EXPECT_GT(longest, 20.0);
  EXPECT_LE(longest, 25.0);
  EXPECT_LT(calm, 0.35);
  EXPECT_GT(wide, 0.9);
  EXPECT_GT(re, 500.0);
  // The first few are of all kinds, and a third of the plan is of both halves and of all severities.
  std::set<PressureKind> first;
  for (std::size_t i = 0; i < 8; ++i) first.insert(plan[i].kind);
  EXPECT_GE(first.size(), 4u);
  int to_judge = 0;
  double least = 1.0, largest = 0.0;
  for (std::size_t i = 1; i <= 22; ++i) {
    to_judge += plan[i].judged ? 1 : 0;
    least = std::min(least, plan[i].stenoses.front().severity);
    largest = std::max(largest, plan[i].stenoses.front().severity);
  }
  EXPECT_NEAR(to_judge, 11, 3);
  EXPECT_LT(least, 0.36);
  EXPECT_GT(largest, 0.75);
}

TEST(PressurePlan, AWallHasItsExactSections) {
  const std::vector<PressureCase> plan = plan_pressure();
  for (const PressureKind kind : {PressureKind::tube, PressureKind::concentric, PressureKind::eccentric,
                                  PressureKind::tapered, PressureKind::bend, PressureKind::series}) {
    const PressureCase& one = first_of(plan, kind, 0.45);
    const hemodynamics::Network found = measured(one), exact = *exact_network(one);
    ASSERT_EQ(found.branches.size(), 1u) << one.id;
    const auto& truth = exact.branches.front().stations;
    double least_found = 99.0, least_true = 99.0;
    for (const auto& station : truth) least_true = std::min(least_true, station.diameter_mm());
    for (const auto& station : found.branches.front().stations) {
      least_found = std::min(least_found, station.diameter_mm());
      std::size_t k = 1;
      while (k + 1 < truth.size() && truth[k].s_mm < station.s_mm) ++k;
      const double t = (station.s_mm - truth[k - 1].s_mm) / (truth[k].s_mm - truth[k - 1].s_mm);
      const double d = (1.0 - t) * truth[k - 1].diameter_mm() + t * truth[k].diameter_mm();
      EXPECT_NEAR(station.diameter_mm(), d, 0.03 * d + 0.02) << one.id << " at " << station.s_mm;
    }
    EXPECT_NEAR(least_found, least_true, 0.03 * least_true + 0.02) << one.id;
  }
}

TEST(PressurePlan, AForkHasThreeBranchesAndItsNarrowings) {
  const std::vector<PressureCase> plan = plan_pressure();
  for (const PressureCase& one : plan) {
    if (one.kind != PressureKind::fork || one.medina != "1,1,1") continue;
    const hemodynamics::Network network = measured(one);
    ASSERT_EQ(network.branches.size(), 3u);
    EXPECT_EQ(hemodynamics::outlets_of(network).size(), 2u);
    for (const auto& branch : network.branches) {
      double least = 99.0, most = 0.0;
      for (const auto& station : branch.stations) {
        least = std::min(least, station.diameter_mm());
        most = std::max(most, station.diameter_mm());
      }
      EXPECT_LT(least, 0.85 * most) << branch.name;
    }
    EXPECT_FALSE(exact_network(one).has_value());
    const geometry::SurfaceFaults faults =
        geometry::find_faults(lumen::surface_of(pressure_model(one)), false);
    EXPECT_TRUE(faults.closed_manifold());
    EXPECT_EQ(faults.components, 1u);
    break;
  }
}

TEST(PressurePlan, ABendTurnsAndAnEccentricThroatLiesAside) {
  const std::vector<PressureCase> plan = plan_pressure();
  double turned = 0.0;
  for (const auto& station : exact_network(first_of(plan, PressureKind::bend))->branches.front().stations)
    turned = std::max(turned, station.curvature_per_mm);
  EXPECT_GT(turned, 0.9 / 25.0);
  EXPECT_LT(turned, 1.3 / 8.0);
  const PressureCase& aside = first_of(plan, PressureKind::eccentric, 0.45);
  const auto& stations = exact_network(aside)->branches.front().stations;
  double off = 0.0;
  for (const auto& station : stations) off = std::max(off, std::hypot(station.point.x(), station.point.y()));
  EXPECT_NEAR(off, aside.stenoses.front().aside_mm, 0.02);
  EXPECT_GT(off, 0.1);
}

TEST(PressurePlan, RefusesNumbersAndNames) {
  PressurePlanOptions options;
  options.fork = -1;
  EXPECT_THROW(plan_pressure(options), InvalidInput);
  EXPECT_THROW(pressure_kind("straight"), InvalidInput);
  EXPECT_EQ(pressure_kind("fork"), PressureKind::fork);
}

}  // namespace
}  // namespace ostia::experiments
