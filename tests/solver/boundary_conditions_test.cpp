#include "ostia/solver/boundary_conditions.h"

#include "solver_test_support.h"

#include <set>
#include <string_view>

namespace ostia::solver {
namespace {

const geometry::MixedMesh& fork() {
  static const geometry::MixedMesh mesh = vessel(geometry::y_junction(6.0, 6.0, 1.5, 1.2, 60.0), 0.5, 0);
  return mesh;
}

TEST(BoundaryFlow, TakesTheUsualFlowOfTheInletsDiameter) {
  const BoundaryFlow flow = boundary_flow(fork(), {});
  ASSERT_EQ(flow.inlets.size(), 1u);
  EXPECT_EQ(flow.outlets.size(), 2u);
  EXPECT_EQ(flow.walls, std::vector<std::string>{"wall"});
  EXPECT_NEAR(flow.inlets[0].section.diameter_mm(), 3.0, 0.05);
  // 1.43 x 0.003^2.55 m3/s = 0.527 ml/s.
  EXPECT_NEAR(usual_flow_ml_s(3.0), 0.527, 0.001);
  EXPECT_NEAR(flow.mean_flow_ml_s, usual_flow_ml_s(flow.inlets[0].section.diameter_mm()), 1e-12);
  EXPECT_TRUE(flow.warnings.empty());
}

TEST(BoundaryFlow, TakesFlowVelocityOrReynoldsNumber) {
  BoundaryFlowOptions options;
  options.reynolds = 300.0;
  const BoundaryFlow by_reynolds = boundary_flow(fork(), options);
  EXPECT_NEAR(by_reynolds.inlets[0].reynolds, 300.0, 1e-9);
  // Re = 4 Q / (pi d nu).
  const double d = by_reynolds.inlets[0].section.diameter_mm();
  EXPECT_NEAR(4e3 * by_reynolds.mean_flow_ml_s / (std::numbers::pi * d * 3.5e3 / 1060.0), 300.0, 1e-9);
  options.reynolds.reset();
  options.mean_velocity_cm_s = 20.0;
  EXPECT_NEAR(boundary_flow(fork(), options).mean_flow_ml_s, 0.2 * by_reynolds.inlets[0].section.area_mm2,
              1e-12);
  options.inlet_flow_ml_s[by_reynolds.inlets[0].name] = 1.25;
  EXPECT_EQ(boundary_flow(fork(), options).mean_flow_ml_s, 1.25);
}

TEST(OutletModels, HaveANameEachByWhichTheyAreFound) {
  std::set<std::string_view> names;
  for (const OutletTraits& one : outlet_models()) {
    EXPECT_EQ(outlet_model(one.name), one.model);
    EXPECT_EQ(name_of(one.model), one.name);
    EXPECT_FALSE(one.what.empty());
    names.insert(one.name);
  }
  EXPECT_EQ(names, (std::set<std::string_view>{"zero", "split", "resistance"}));
  EXPECT_THROW(outlet_model("Split"), InvalidInput);
}

TEST(BoundaryFlow, SharesByDiameterAndResists) {
  geometry::MixedMesh mesh = vessel(geometry::y_junction(6.0, 6.0, 1.5, 1.2, 60.0), 0.5, 0);
  BoundaryFlowOptions options;
  options.flow_ml_s = 2.0;
  options.split_exponent = 3.0;
  options.outlets = OutletModel::resistance;
  options.total_resistance_mmhg_s_ml = 45.0;
  const BoundaryFlow flow = boundary_flow(mesh, options);
  const Outlet &a = flow.outlets[0], &b = flow.outlets[1];
  EXPECT_GE(a.diameter_mm, b.diameter_mm);
  EXPECT_NEAR(a.share + b.share, 1.0, 1e-12);
  EXPECT_NEAR(a.share / b.share, std::pow(a.diameter_mm / b.diameter_mm, 3.0), 1e-9);
  // Side by side they are the whole: 45 mmHg s / ml.
  const double both = 1.0 / (1.0 / a.resistance_pa_s_m3 + 1.0 / b.resistance_pa_s_m3);
  EXPECT_NEAR(both / (45.0 * 133.322e6), 1.0, 1e-5);
  options.total_resistance_mmhg_s_ml.reset();
  EXPECT_NEAR(boundary_flow(mesh, options).outlets[0].resistance_pa_s_m3, a.resistance_pa_s_m3, 1e-3);
}

TEST(BoundaryFlow, WaveformsAreScaledOrTakenAsTheyAre) {
  BoundaryFlowOptions options;
  options.waveform = builtin_waveform("coronary-left");
  options.flow_ml_s = 0.8;
  const BoundaryFlow relative = boundary_flow(fork(), options);
  double mean = 0.0;
  for (int i = 0; i < 400; ++i) mean += relative.flow_ml_s(0.8 * i / 400.0) / 400.0;
  EXPECT_NEAR(mean, 0.8, 1e-9);
  EXPECT_GT(relative.inlets[0].largest_flow_ml_s(), 1.2);
  options.flow_ml_s.reset();
  options.waveform = FlowWaveform{{0.0, 0.2, 0.6}, {1.0, 3.0, 1.0}, 0.8, false};
  EXPECT_NEAR(boundary_flow(fork(), options).mean_flow_ml_s, mean_flow(*options.waveform), 1e-12);
}

TEST(BoundaryFlow, WarnsBeyondLaminarFlow) {
  BoundaryFlowOptions options;
  options.reynolds = 2500.0;
  const BoundaryFlow flow = boundary_flow(fork(), options);
  ASSERT_EQ(flow.warnings.size(), 1u);
  EXPECT_NE(flow.warnings[0].find("Reynolds number at " + flow.inlets[0].name), std::string::npos);
  EXPECT_NE(flow.warnings[0].find("2500"), std::string::npos);
}

TEST(BoundaryFlow, RefusesMeshesThatNoSolverTakes) {
  const auto refused = [](const std::function<void(geometry::MixedMesh&)>& spoil,
                          const std::vector<std::string>& parts) {
    geometry::MixedMesh mesh = fork();
    spoil(mesh);
    expect_refusal([&] { boundary_flow(mesh, {}); }, parts);
  };
  const auto without = [](geometry::FaceKind kind, geometry::FaceKind instead) {
    return [=](geometry::MixedMesh& mesh) {
      for (geometry::Face& face : mesh.faces)
        if (face.kind == kind) face.kind = instead;
    };
  };
  refused(without(geometry::FaceKind::inlet, geometry::FaceKind::outlet), {"no inlet", "wall"});
  refused(without(geometry::FaceKind::outlet, geometry::FaceKind::wall), {"no outlet"});
  refused([](geometry::MixedMesh& mesh) { std::swap(mesh.tetrahedra[7][0], mesh.tetrahedra[7][1]); },
          {"tetrahedron 7", "mm"});
  refused(
      [](geometry::MixedMesh& mesh) {
        for (geometry::Vec3& p : mesh.points) p *= 1e-3;
      },
      {"metres", "inlet"});
  refused(
      [](geometry::MixedMesh& mesh) {
        for (geometry::Vec3& p : mesh.points) p *= 1e3;
      },
      {"no vessel", "inlet"});
}

TEST(BoundaryFlow, RefusesOptionsByName) {
  const auto refused = [](const std::function<void(BoundaryFlowOptions&)>& spoil, const std::string& part) {
    BoundaryFlowOptions options;
    spoil(options);
    expect_refusal([&] { boundary_flow(fork(), options); }, {part});
  };
  refused([](auto& o) { o.blood.density_kg_m3 = 1.06; }, "density_kg_m3");
  refused([](auto& o) { o.blood.viscosity_mpa_s = 0.0035; }, "viscosity_mpa_s");
  refused([](auto& o) { o.flow_ml_s = -1.0; }, "flow_ml_s");
  refused([](auto& o) { o.reynolds = 0.0; }, "reynolds");
  refused([](auto& o) { o.flow_ml_s = o.reynolds = 1.0; }, "one of flow");
  refused([](auto& o) { o.split_exponent = 9.0; }, "split_exponent");
  refused([](auto& o) { o.total_resistance_mmhg_s_ml = 9.0; }, "outlets with resistance");
  refused([](auto& o) { o.inlet_flow_ml_s["inlet_moon"] = 1.0; }, "inlet_moon");
}

}  // namespace
}  // namespace ostia::solver
