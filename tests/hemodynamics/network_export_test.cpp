// Networks as cases of other programs, and svZeroDSolver's own cases read and solved.

#include "ostia/hemodynamics/network_export.h"

#include "flow_networks.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <sstream>

namespace ostia::hemodynamics {
namespace {

using testing::circle_mm2, testing::narrowed, testing::tube_of, testing::vessel_of;
using ::testing::HasSubstr, ::testing::Not, ::testing::ThrowsMessage;

constexpr double exported_inlet_pa = 93.0 * 133.322387415;

/// A trunk with a throat before its fork, a fork of three, one branch that forks again, and a second root.
Network exported_tree() {
  Network network;
  network.branches = {vessel_of(25.0, narrowed(2.0, 18.0, 8.0, 0.5)),
                      vessel_of(40.0, narrowed(1.6, 20.0, 10.0, 0.5), 0),
                      tube_of(30.0, 1.3, 0),
                      tube_of(22.0, 0.9, 0),
                      tube_of(25.0, 1.1, 1),
                      tube_of(35.0, 1.2, 1),
                      tube_of(50.0, 1.5)};
  network.branches[1].angle_rad = -0.3;
  network.branches[2].angle_rad = 0.7;
  network.branches[3].angle_rad = 1.1;
  network.branches[4].angle_rad = 0.5;
  network.branches[5].angle_rad = -0.2;
  return network;
}

struct Solved {
  PreparedNetwork network;
  Boundary boundary;
  Solution solution;
};
Solved solved_tree(Network tree = exported_tree()) {
  FlowModel model;
  model.from_rest = true;
  const PreparedNetwork network(std::move(tree), model);
  Boundary boundary{exported_inlet_pa, std::nullopt, {}};
  for (std::size_t k = 0; k < network.outlets().size(); ++k)
    boundary.outlets.push_back({4000.0 + 1500.0 * static_cast<double>(k), 650.0, {}});
  const Solution solution = solve(network, boundary);
  return {network, boundary, solution};
}

std::vector<NetworkFile> files_of(const Solved& one, NetworkFormat format) {
  return export_network(one.network, one.boundary, one.solution, format);
}

TEST(NetworkExport, SvzerodComesBackWithTheSamePressures) {
  const Solved ours = solved_tree();
  const auto files = files_of(ours, NetworkFormat::svzerod);
  ASSERT_EQ(files.size(), 1u);
  const SvzerodCase back = read_svzerod(files.front().text);
  const Solution theirs = solve(PreparedNetwork(back.network, {}), back.boundary);
  std::map<std::string, std::size_t> last;  // piece of each branch
  for (std::size_t b = 0; b < back.network.branches.size(); ++b)
    last[back.network.branches[b].name.substr(0, back.network.branches[b].name.find('_'))] = b;
  ASSERT_EQ(last.size(), ours.network.size());
  for (std::size_t b = 0; b < ours.network.size(); ++b) {
    const std::size_t piece = last.at("branch" + std::to_string(b));
    EXPECT_NEAR(theirs.flow_ml_s[piece] / ours.solution.flow_ml_s[b], 1.0, 1e-6) << b;
    EXPECT_NEAR(theirs.to_pa[piece] / (10.0 * ours.solution.to_pa[b]), 1.0, 1e-6) << b;
  }
  // Friction is told apart: of the tube without inertia's part it is Poiseuille's.
  double friction = 0.0;
  for (const Branch& branch : back.network.branches)
    if (branch.name.starts_with("branch6_")) friction += branch.lumped.linear_pa_s_ml;
  EXPECT_NEAR(friction / (10.0 * testing::poiseuille_pa_s_ml(50.0, 1.5)), 1.0, 1e-9);
}

/// SimVascular/svZeroDSolver, tests/cases: its vessels and boundaries.
nlohmann::json published_case(const std::vector<std::array<double, 2>>& vessels,
                              const nlohmann::json& outlets) {
  nlohmann::json root{{"simulation_parameters", {{"number_of_cardiac_cycles", 2}}}};
  root["boundary_conditions"] = outlets;
  root["boundary_conditions"].push_back(
      {{"bc_name", "INFLOW"}, {"bc_type", "FLOW"}, {"bc_values", {{"Q", {5.0, 5.0}}, {"t", {0.0, 1.0}}}}});
  for (std::size_t i = 0; i < vessels.size(); ++i) {
    nlohmann::json vessel{{"vessel_id", i},
                          {"vessel_length", 10.0},
                          {"vessel_name", "branch" + std::to_string(i) + "_seg0"},
                          {"zero_d_element_type", "BloodVessel"},
                          {"zero_d_element_values", {{"R_poiseuille", vessels[i][0]}}}};
    if (vessels[i][1] != 0.0) vessel["zero_d_element_values"]["stenosis_coefficient"] = vessels[i][1];
    if (i == 0) vessel["boundary_conditions"]["inlet"] = "INFLOW";
    if (vessels.size() == 1 || i > 0)
      vessel["boundary_conditions"]["outlet"] = vessels.size() == 1 ? "OUT" : "OUT" + std::to_string(i);
    root["vessels"].push_back(vessel);
  }
  if (vessels.size() > 1)
    root["junctions"] = {{{"inlet_vessels", {0}},
                          {"junction_name", "J0"},
                          {"junction_type", "NORMAL_JUNCTION"},
                          {"outlet_vessels", {1, 2}}}};
  return root;
}
nlohmann::json resistance_at(const char* name, double resistance, double distal) {
  return {{"bc_name", name}, {"bc_type", "RESISTANCE"}, {"bc_values", {{"Pd", distal}, {"R", resistance}}}};
}
Solution solution_of(const nlohmann::json& root) {
  const SvzerodCase problem = read_svzerod(root.dump());
  return solve(PreparedNetwork(problem.network, {}), problem.boundary);
}

TEST(NetworkExport, ReadsSvzerodsOwnSteadyCases) {
  const auto out = nlohmann::json::array({resistance_at("OUT", 100.0, 100.0)});
  EXPECT_NEAR(solution_of(published_case({{100.0, 0.0}}, out)).inlet_pa, 1100.0, 1100.0e-6);
  EXPECT_NEAR(solution_of(published_case({{100.0, 100.0}}, out)).inlet_pa, 3600.0, 3600.0e-6);
  const auto coronary = nlohmann::json::array({{{"bc_name", "OUT"},
                                                {"bc_type", "CORONARY"},
                                                {"bc_values",
                                                 {{"Ca", 1e-4},
                                                  {"Cc", 1e-4},
                                                  {"Pim", {1000.0, 1000.0}},
                                                  {"P_v", 0.0},
                                                  {"Ra1", 100.0},
                                                  {"Ra2", 100.0},
                                                  {"Rv1", 100.0},
                                                  {"t", {0.0, 1.0}}}}}});
  EXPECT_NEAR(solution_of(published_case({{100.0, 0.0}}, coronary)).inlet_pa, 2000.0, 2000.0e-6);
  const auto two =
      nlohmann::json::array({resistance_at("OUT1", 100.0, 50.0), resistance_at("OUT2", 1000.0, 200.0)});
  const auto uneven = published_case({{300.0, 0.0}, {400.0, 0.0}, {500.0, 0.0}}, two);
  const Solution s = solution_of(uneven);
  EXPECT_NEAR(s.inlet_pa, 3462.5, 3462.5e-6);
  EXPECT_NEAR(s.to_pa[1], 432.5, 432.5e-6);
  EXPECT_NEAR(s.to_pa[2], 1375.0, 1375.0e-6);
  EXPECT_NEAR(s.flow_ml_s[1], 3.825, 3.825e-6);
  const std::string csv = svzerod_result_csv(read_svzerod(uneven.dump()), s);
  EXPECT_THAT(csv, ::testing::StartsWith("name,time,flow_in,flow_out,pressure_in,pressure_out\n"));
  EXPECT_THAT(csv, HasSubstr("branch2_seg0,0,"));
}

TEST(NetworkExport, ReadsAChainOfAnyLength) {
  nlohmann::json root =
      published_case({{1.0, 0.0}}, nlohmann::json::array({resistance_at("OUT", 100.0, 0.0)}));
  const nlohmann::json one = root["vessels"][0];
  root["vessels"][0]["boundary_conditions"].erase("outlet");
  constexpr int count = 50000;
  for (int i = 1; i < count; ++i) {
    nlohmann::json& next = root["vessels"].emplace_back(one);
    next["vessel_id"] = i;
    next["boundary_conditions"].erase("inlet");
    if (i + 1 < count) next.erase("boundary_conditions");
    root["junctions"].push_back({{"inlet_vessels", {i - 1}},
                                 {"junction_name", "J" + std::to_string(i)},
                                 {"junction_type", "internal_junction"},
                                 {"outlet_vessels", {i}}});
  }
  const SvzerodCase problem = read_svzerod(root.dump());
  ASSERT_EQ(problem.network.branches.size(), static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    ASSERT_EQ(problem.network.branches[static_cast<std::size_t>(i)].parent, i - 1);
}

TEST(NetworkExport, RefusesWhatIsNoSteadyTree) {
  const auto out = nlohmann::json::array({resistance_at("OUT", 100.0, 100.0)});
  const nlohmann::json good = published_case({{100.0, 0.0}}, out);
  const auto refused = [](const nlohmann::json& root, const std::string& says) {
    EXPECT_THAT([&] { read_svzerod(root.dump()); }, ThrowsMessage<InvalidInput>(HasSubstr(says)));
  };
  nlohmann::json bad = good;
  bad["boundary_conditions"][1]["bc_values"]["Q"] = {5.0, 6.0};
  refused(bad, "changes in time");
  bad = good;
  bad["boundary_conditions"][0]["bc_type"] = "ClosedLoopRCR";
  refused(bad, "ClosedLoopRCR");
  bad = good;
  bad["vessels"][0]["zero_d_element_type"] = "ValveTanh";
  refused(bad, "ValveTanh");
  bad = good;
  bad["vessels"][0].erase("boundary_conditions");
  refused(bad, "begins in nothing");
  bad = good;
  bad["vessels"].push_back(nlohmann::json(good["vessels"][0]));
  refused(bad, "two vessels of the number 0");
  bad = good;
  bad["boundary_conditions"].push_back(nlohmann::json(good["boundary_conditions"][0]));
  refused(bad, "two boundary conditions named");
  bad = good;
  bad.erase("vessels");
  refused(bad, "no case of svZeroDSolver");
  bad = good;
  bad["junctions"] = {
      {{"inlet_vessels", {0}}, {"junction_type", "NORMAL_JUNCTION"}, {"outlet_vessels", {7}}}};
  refused(bad, "not there");
  bad["junctions"][0]["inlet_vessels"] = {0, 1};
  refused(bad, "2 inlets");
  EXPECT_THROW(read_svzerod("no JSON"), InvalidInput);
  EXPECT_THROW(network_format("cgns"), InvalidInput);
}

TEST(NetworkExport, SvonedHasSectionsJointsAndOutlets) {
  const Solved ours = solved_tree();
  const auto files = files_of(ours, NetworkFormat::svoned);
  ASSERT_EQ(files.size(), 2u);  // a root each
  EXPECT_EQ(files[0].name, "svoned-1.in");
  std::istringstream lines(files[0].text);
  std::string line;
  double length = 0.0;
  int outlets = 0, nodes = 0, segments = 0, joints = 0;
  std::map<std::string, int> words;
  std::vector<double> area_to;
  while (std::getline(lines, line)) {
    std::istringstream in(line);
    std::string card, name, id;
    in >> card;
    ++words[card];
    if (card != "SEGMENT") continue;
    double own = 0.0, from = 0.0, to = 0.0;
    int elements = 0, a = 0, b = 0;
    in >> name >> id >> own >> elements >> a >> b >> from >> to;
    length += own;
    ++segments;
    EXPECT_EQ(b, std::stoi(id) + 1);  // ends at a node of its own
    EXPECT_GE(elements, 2);
    EXPECT_GT(from, 0.0);
    outlets += line.find("RESISTANCE OUT") != std::string::npos ? 1 : 0;
  }
  nodes = words["NODE"], joints = words["JOINT"];
  EXPECT_NEAR(length, 2.5 + 4.0 + 3.0 + 2.2 + 2.5 + 3.5, 1e-9);  // cm
  EXPECT_EQ(outlets, 4);
  EXPECT_EQ(nodes, segments + 1);
  EXPECT_EQ(joints, segments - outlets);
  EXPECT_EQ(words["JOINTINLET"], joints);
  EXPECT_EQ(words["JOINTOUTLET"], joints);
  EXPECT_THAT(files[0].text, HasSubstr("MATERIAL BLOOD OLUFSEN 1.06 0.035 0 2.0 1.0e15 -20 1e9"));
  EXPECT_THAT(files[0].text, HasSubstr("INLETDATA PRESSURE_WAVE"));
  // R and distal pressure in dyn s/cm5 and dyn/cm2.
  EXPECT_THAT(files[0].text, HasSubstr("\n0.0 40000\n0.0 6500\n"));
}

TEST(NetworkExport, OpenbfHasNoForkOfThree) {
  const Solved ours = solved_tree();
  const auto files = files_of(ours, NetworkFormat::openbf);
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[0].name, "openbf-1.yaml");
  EXPECT_EQ(files[1].name, "openbf-1_inlet.dat");
  EXPECT_THAT(files[0].text, HasSubstr("inlet_file: \"openbf-1_inlet.dat\""));
  EXPECT_THAT(files[0].text, HasSubstr("    E: 1.0e+07\n"));  // a number to YAML 1.1, which 1e+07 is not
  EXPECT_THAT(files[0].text, HasSubstr("  rho: 1060.0\n"));
  std::istringstream lines(files[0].text);
  std::string word;
  std::map<int, int> leave, enter;
  double length = 0.0, connectors = 0.0;
  int beds = 0;
  for (std::string label; lines >> word;) {
    double value = 0.0;
    if (word == "label:") lines >> label;
    if (word == "sn:") lines >> value, ++leave[static_cast<int>(value)];
    if (word == "tn:") lines >> value, ++enter[static_cast<int>(value)];
    if (word == "L:") lines >> value, (label.starts_with("connector") ? connectors : length) += value;
    if (word == "R1:") ++beds;
  }
  EXPECT_NEAR(length, 1e-3 * (25.0 + 40.0 + 30.0 + 22.0 + 25.0 + 35.0), 1e-9);
  EXPECT_NEAR(connectors, 1e-3, 1e-12);
  EXPECT_EQ(beds, 4);
  EXPECT_EQ(leave[1], 1);  // the inlet's vessel
  for (const auto& [node, count] : leave) EXPECT_LE(count, 2) << node;
  for (const auto& [node, count] : enter) EXPECT_EQ(count, 1) << node;
}

TEST(NetworkExport, CutsConesWithinTheTolerance) {
  const Solved ours = solved_tree();
  const auto count = [&](double tolerance) {
    const auto file =
        export_network(ours.network, ours.boundary, ours.solution, NetworkFormat::svzerod, {tolerance});
    return nlohmann::json::parse(file.front().text)["vessels"].size();
  };
  EXPECT_LT(count(0.3), count(0.02));
  EXPECT_LT(count(0.02), count(0.001));
  EXPECT_GE(count(0.3), ours.network.size());
  EXPECT_THROW(count(0.9), InvalidInput);
}

TEST(NetworkExport, LeavesOutWhatLiesBeyondAnOcclusion) {
  Network tree = exported_tree();
  tree.branches[1].stations[10].area_mm2 = 0.0;
  const Solved ours = solved_tree(tree);
  const std::string text = files_of(ours, NetworkFormat::svzerod).front().text;
  EXPECT_THAT(text, Not(HasSubstr("branch1_")));
  EXPECT_THAT(text, Not(HasSubstr("branch4_")));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  const SvzerodCase back = read_svzerod(text);
  const Solution theirs = solve(PreparedNetwork(back.network, {}), back.boundary);
  EXPECT_NEAR(theirs.flow_ml_s[0], ours.solution.flow_ml_s[0], 1e-6);
}

TEST(NetworkExport, ABranchWhoseChildrenAreAllOccludedIsNoOutletOfOtherPrograms) {
  Network tree = exported_tree();
  for (const std::size_t child : {4, 5}) tree.branches[child].stations[0].area_mm2 = 0.0;
  tree.branches[6].stations[0].area_mm2 = 0.0;  // the second root
  const Solved ours = solved_tree(tree);
  for (const NetworkFormat format : {NetworkFormat::svoned, NetworkFormat::openbf}) {
    const std::vector<NetworkFile> files = files_of(ours, format);
    ASSERT_FALSE(files.empty());
    for (const NetworkFile& file : files) {
      EXPECT_THAT(file.text, Not(HasSubstr("branch1_")));
      EXPECT_THAT(file.text, Not(HasSubstr("nan")));
    }
  }
}

}  // namespace
}  // namespace ostia::hemodynamics
