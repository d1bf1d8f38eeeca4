#include "ostia/solver/start_flow.h"

#include "solver_test_support.h"

#include "ostia/solver/boundary_conditions.h"

#include <gtest/gtest.h>

namespace ostia::solver {
namespace {

using geometry::Vec3;

/// A vessel of 3 mm along z, narrowed to half of that about z = 15.
hemodynamics::Network narrowed() {
  hemodynamics::Branch branch;
  branch.name = "main";
  for (double s = 0.0; s <= 40.0; s += 0.25) {
    const double narrow = std::abs(s - 15.0) < 5.0 ? 0.5 * (1.0 + std::cos(M_PI * (s - 15.0) / 5.0)) : 0.0;
    const double radius = 1.5 * (1.0 - 0.5 * narrow);
    hemodynamics::Station station;
    station.s_mm = s;
    station.area_mm2 = M_PI * radius * radius;
    station.shape = hemodynamics::shape_of_ellipse(radius, radius);
    station.point = Vec3(0.0, 0.0, s);
    branch.stations.push_back(station);
  }
  return {{branch}};
}

struct Started {
  hemodynamics::PreparedNetwork network;
  hemodynamics::Solution solution;
  StartFlowAt start;
  explicit Started(double flow_ml_s) : network(narrowed(), model()) {
    hemodynamics::Boundary boundary;
    boundary.inlet_pa = 12000.0;
    boundary.outlets.emplace_back().flow_ml_s = flow_ml_s;
    solution = hemodynamics::solve(network, boundary);
    start = start_flow(network, solution);
  }
  static hemodynamics::FlowModel model() {
    hemodynamics::FlowModel developed;
    developed.root_momentum = hemodynamics::developed_momentum;
    return developed;
  }
};

TEST(StartFlow, EverySectionCarriesTheFlow) {
  const Started one(1.5);
  for (const double z : {2.1, 12.0, 15.0, 17.3, 25.0, 39.0}) {
    double flow = 0.0;
    constexpr double step = 0.02;
    for (double x = -1.6; x <= 1.6; x += step)
      for (double y = -1.6; y <= 1.6; y += step) {
        const StartFlow at = one.start(Vec3(x, y, z));
        flow += at.velocity_m_s.z() * step * step;
        EXPECT_EQ(at.velocity_m_s.head<2>().norm(), 0.0);
      }
    // Where the lumen widens, places aside of the axis are nearest to sections a little farther on.
    EXPECT_NEAR(flow, 1.5, 0.05 * 1.5) << z;
  }
}

TEST(StartFlow, PressureIsOneDimensionsAboveTheOutlets) {
  const Started one(1.5);
  const auto along = hemodynamics::along(one.network, one.solution, 0);
  for (const std::size_t i : {std::size_t{0}, std::size_t{60}, along.size() - 1}) {
    const Vec3 place(0.3, 0.2, 0.25 * static_cast<double>(i));
    EXPECT_NEAR(one.start(place).pressure_pa, along[i].pressure_pa - one.solution.to_pa[0], 1e-6);
  }
}

TEST(StartFlow, ProfilesAreDevelopedFlatAndJets) {
  const Started one(1.5);
  const auto share = [&](double z) {
    const auto station = static_cast<std::size_t>(4.0 * z);
    const double area = one.network.network().branches[0].stations[station].area_mm2;
    return one.start(Vec3(0.0, 0.0, z)).velocity_m_s.z() * area / 1.5;
  };
  EXPECT_NEAR(share(1.0), 2.0, 0.05) << "a parabola's middle is twice the mean";
  EXPECT_LT(share(15.0), 1.7) << "flatter in the throat";
  EXPECT_GT(share(21.0), 3.0) << "a jet behind it";
  EXPECT_EQ(one.start(Vec3(1.4, 0.0, 21.0)).velocity_m_s.z(), 0.0) << "and dead water";
}

TEST(StartFlow, StandsInTheFieldsOfACase) {
  const geometry::MixedMesh mesh = vessel(geometry::straight_tube(6.0, 1.5), 0.6, 2, 0.3);
  OpenfoamCaseOptions options;
  options.flow.flow_ml_s = 0.5;
  options.start = [](const BoundaryFlow&) {
    return [](const Vec3& place) { return StartFlow{Vec3(0.0, 0.0, place.z()), 1060.0 * place.x()}; };
  };
  const std::filesystem::path folder = testing::temporary_folder("start") / "case";
  write_openfoam_case(mesh, options, folder);
  const std::size_t cells = mesh.tetrahedra.size() + mesh.prisms.size();
  const OpenfoamField velocity = read_openfoam_field(folder / "0" / "U", cells, facets_of(mesh));
  const OpenfoamField pressure = read_openfoam_field(folder / "0" / "p", cells, facets_of(mesh));
  ASSERT_EQ(velocity.cells.size(), 3 * cells);
  ASSERT_EQ(pressure.cells.size(), cells);
  Vec3 centre = Vec3::Zero();
  for (const std::int32_t corner : mesh.prisms.back())
    centre += mesh.points[static_cast<std::size_t>(corner)] / 6.0;
  EXPECT_NEAR(velocity.cells.back(), centre.z(), 1e-12);
  EXPECT_NEAR(pressure.cells.back(), centre.x(), 1e-12);
}

TEST(StartFlow, SharesAreFoundByTheVesselsNames) {
  const StartOf of = start_from(narrowed());
  BoundaryFlow flow;
  flow.inlets.emplace_back().mean_flow_ml_s = 1.5;
  flow.outlets.emplace_back().name = "outlet_other";
  flow.outlets.back().share = 1.0;
  EXPECT_FALSE(of(flow)) << "blood is at rest";
  flow.outlets.back().name = "outlet_main";
  const StartFlowAt start = of(flow);
  ASSERT_TRUE(start);
  const Started one(1.5);
  for (const double z : {1.0, 15.0, 30.0}) {
    const Vec3 place(0.1, 0.2, z);
    EXPECT_NEAR(start(place).pressure_pa, one.start(place).pressure_pa, 1e-6);
    EXPECT_NEAR((start(place).velocity_m_s - one.start(place).velocity_m_s).norm(), 0.0, 1e-9);
  }
}

TEST(StartFlow, RefusesANetworkWithoutSections) {
  hemodynamics::Branch lumped;
  lumped.lumped.linear_pa_s_ml = 1.0;
  const hemodynamics::PreparedNetwork network({{lumped}}, {});
  hemodynamics::Boundary boundary;
  boundary.outlets.emplace_back().flow_ml_s = 1.0;
  EXPECT_THROW(start_flow(network, hemodynamics::solve(network, boundary)), InvalidInput);
}

}  // namespace
}  // namespace ostia::solver
