// A coronary tree of ten vessels: solved, solved again after an edit, and its forms of section.

#include "flow_networks.h"

#include "ostia/hemodynamics/flow_state.h"
#include "ostia/hemodynamics/readings.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace ostia;
using testing::narrowed, testing::vessel_of;

/// Left and right tree, ten named vessels in 17 branches, sections 0.5 mm apart, two stenoses.
hemodynamics::Network ten_vessels(double least = 0.45) {
  hemodynamics::Network network;
  const auto add = [&](double length, double radius, int parent, double angle, double narrowing = 1.0) {
    network.branches.push_back(vessel_of(length, narrowed(radius, 0.5 * length, 10.0, narrowing), parent));
    network.branches.back().angle_rad = angle;
    for (auto& station : network.branches.back().stations) station.curvature_per_mm = 0.02;
    return static_cast<int>(network.branches.size()) - 1;
  };
  const int lm = add(10, 2.2, -1, 0.0);
  const int lad = add(25, 1.8, lm, 0.4, least), lcx = add(20, 1.7, lm, -0.7);
  const int lad2 = add(25, 1.6, lad, 0.1);
  add(40, 1.1, lad, 0.8);  // D1
  const int lad3 = add(20, 1.4, lad2, 0.1);
  add(35, 0.9, lad2, 0.7);  // D2
  add(50, 1.2, lad3, 0.1);
  add(25, 0.8, lad3, -0.8);  // septal
  const int lcx2 = add(25, 1.5, lcx, 0.1, 0.6);
  add(40, 1.1, lcx, -0.6);  // OM1
  add(30, 1.1, lcx2, 0.2);
  add(35, 1.0, lcx2, -0.6);  // OM2
  const int rca = add(50, 1.9, -1, 0.0);
  const int rca2 = add(50, 1.7, rca, 0.1);
  add(30, 0.9, rca, 0.8);  // AM
  add(45, 1.3, rca2, 0.3);
  add(40, 1.1, rca2, -0.4);
  return network;
}

void whole_tree(benchmark::State& state) {
  const hemodynamics::Network network = ten_vessels();
  const hemodynamics::Conditions conditions;
  int iterations = 0;
  for (auto _ : state) {
    const hemodynamics::PreparedNetwork prepared(network, {});
    const auto resting = hemodynamics::resting_flow(network, conditions);
    const auto flow =
        hemodynamics::flow_state(prepared, conditions, resting, hemodynamics::State::hyperaemia);
    iterations = flow.solution.iterations;
    benchmark::DoNotOptimize(flow);
  }
  state.counters["newton"] = iterations;
}
BENCHMARK(whole_tree)->Unit(benchmark::kMillisecond);

void after_an_edit(benchmark::State& state) {
  const hemodynamics::PreparedNetwork prepared(ten_vessels(), {});
  const hemodynamics::Conditions conditions;
  const auto resting = hemodynamics::resting_flow(prepared.network(), conditions);
  const auto before =
      hemodynamics::flow_state(prepared, conditions, resting, hemodynamics::State::hyperaemia);
  const hemodynamics::Branch edited = ten_vessels(0.43).branches[1];
  for (auto _ : state) {
    const auto after = prepared.with_branch(1, edited);
    const auto flow = hemodynamics::flow_state(after, conditions, resting, hemodynamics::State::hyperaemia,
                                               &before.solution);
    benchmark::DoNotOptimize(flow);
  }
}
BENCHMARK(after_an_edit)->Unit(benchmark::kMillisecond);

void read_off(benchmark::State& state) {
  const hemodynamics::PreparedNetwork prepared(ten_vessels(), {});
  const hemodynamics::Conditions conditions;
  const auto resting = hemodynamics::resting_flow(prepared.network(), conditions);
  const auto flow = hemodynamics::flow_state(prepared, conditions, resting, hemodynamics::State::hyperaemia);
  for (auto _ : state) benchmark::DoNotOptimize(hemodynamics::read_tree(prepared, flow, {}));
}
BENCHMARK(read_off)->Unit(benchmark::kMillisecond);

void a_beat(benchmark::State& state) {
  const hemodynamics::PreparedNetwork prepared(ten_vessels(), {});
  const hemodynamics::Conditions conditions;
  const auto resting = hemodynamics::resting_flow(prepared.network(), conditions);
  const auto rest = hemodynamics::flow_state(prepared, conditions, resting, hemodynamics::State::rest);
  for (auto _ : state) benchmark::DoNotOptimize(hemodynamics::pulse(prepared, conditions, rest, {{1, 20.0}}));
}
BENCHMARK(a_beat)->Unit(benchmark::kMillisecond);

void form_of_a_section(benchmark::State& state) {
  std::vector<geometry::Vec2> contour;
  for (int i = 0; i < 64; ++i) {
    const double t = 2.0 * M_PI * i / 64,
                 r = 1.3 * (1.0 + 0.2 * std::cos(2.0 * t) + 0.05 * std::sin(3.0 * t));
    contour.emplace_back(r * std::cos(t), r * std::sin(t));
  }
  for (auto _ : state) benchmark::DoNotOptimize(hemodynamics::shape_of_contour(contour));
}
BENCHMARK(form_of_a_section)->Unit(benchmark::kMicrosecond);

}  // namespace
