// svZeroDSolver's JSON read back as a steady network.

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/hemodynamics/network_export.h"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>

namespace ostia::hemodynamics {
namespace {

using ReadJson = nlohmann::json;

/// A number, or a course in time that does not change.
double steady(const ReadJson& value, const std::string& of) {
  if (value.is_number()) return value.get<double>();
  const auto course = value.get<std::vector<double>>();
  if (course.empty()) throw InvalidInput(of + " of the svZeroDSolver case has no values");
  for (const double one : course)
    if (one != course.front())
      throw InvalidInput(of + " of the svZeroDSolver case changes in time; steady cases alone are computed");
  return course.front();
}

struct ReadCondition {
  ReadCondition(std::string type_told, ReadJson values_told)
      : type(std::move(type_told)), values(std::move(values_told)) {}
  std::string type;
  ReadJson values;
};

/// A vessel before it has found its place in the tree.
struct ReadVessel {
  Branch branch;
  std::string inlet, outlet;  // names of conditions
  std::optional<int> before;  // vessel's id
  std::vector<int> behind;
};

Outlet outlet_of_json(const std::string& name, const ReadCondition& condition) {
  const auto at = [&](const char* key) { return steady(condition.values.at(key), key + (" of " + name)); };
  if (condition.type == "RESISTANCE") return {at("R"), at("Pd"), std::nullopt};
  if (condition.type == "RCR") return {at("Rp") + at("Rd"), at("Pd"), std::nullopt};
  if (condition.type == "CORONARY") return {at("Ra1") + at("Ra2") + at("Rv1"), at("P_v"), std::nullopt};
  if (condition.type == "PRESSURE") return {0.0, at("P"), std::nullopt};
  if (condition.type == "FLOW") return {0.0, 0.0, at("Q")};
  throw InvalidInput("the svZeroDSolver case has a boundary of type " + condition.type +
                     " at an outlet; FLOW, PRESSURE, RESISTANCE, RCR and CORONARY are read");
}

std::map<int, ReadVessel> vessels_of_json(const ReadJson& root, bool& capacitive) {
  std::map<int, ReadVessel> vessels;
  for (const ReadJson& one : root.at("vessels")) {
    ReadVessel vessel;
    vessel.branch.name = one.at("vessel_name").get<std::string>();
    const auto type = one.at("zero_d_element_type").get<std::string>();
    if (type != "BloodVessel")
      throw InvalidInput("vessel " + vessel.branch.name + " of the svZeroDSolver case is a " + type +
                         "; BloodVessel alone is read");
    const ReadJson& values = one.at("zero_d_element_values");
    vessel.branch.lumped = {values.value("R_poiseuille", 0.0), values.value("stenosis_coefficient", 0.0)};
    capacitive = capacitive || values.value("C", 0.0) != 0.0 || values.value("L", 0.0) != 0.0;
    if (one.contains("boundary_conditions")) {
      vessel.inlet = one["boundary_conditions"].value("inlet", std::string());
      vessel.outlet = one["boundary_conditions"].value("outlet", std::string());
    }
    vessel.branch.segment = vessel.branch.vessel = one.at("vessel_id").get<int>();
    const int id = vessel.branch.vessel;
    if (vessels.contains(id))
      throw InvalidInput("the svZeroDSolver case has two vessels of the number " + std::to_string(id));
    vessels[id] = std::move(vessel);
  }
  return vessels;
}

void join_vessels(const ReadJson& root, std::map<int, ReadVessel>& vessels) {
  if (!root.contains("junctions")) return;
  for (const ReadJson& one : root.at("junctions")) {
    const auto name = one.value("junction_name", std::string("a junction"));
    const auto type = one.at("junction_type").get<std::string>();
    if (type != "NORMAL_JUNCTION" && type != "internal_junction")
      throw InvalidInput("junction " + name + " of the svZeroDSolver case is a " + type +
                         "; NORMAL_JUNCTION and internal_junction are read");
    const auto inlets = one.at("inlet_vessels").get<std::vector<int>>();
    if (inlets.size() != 1)
      throw InvalidInput("junction " + name + " of the svZeroDSolver case has " +
                         std::to_string(inlets.size()) + " inlets; trees are read, with one");
    for (const int behind : one.at("outlet_vessels").get<std::vector<int>>()) {
      ReadVessel& vessel = vessels.at(behind);
      if (vessel.before)
        throw InvalidInput("vessel " + vessel.branch.name +
                           " of the svZeroDSolver case leaves two junctions");
      vessel.before = inlets.front();
      vessels.at(inlets.front()).behind.push_back(behind);
    }
  }
}

/// A vessel and all behind it, each way to its end before the next one begins.
void add_tree(const std::map<int, ReadVessel>& vessels, int root,
              const std::map<std::string, ReadCondition>& conditions, SvzerodCase& problem) {
  struct Next {
    int id, parent;
  };
  std::vector<Next> waiting{{root, -1}};
  while (!waiting.empty()) {
    const Next next = waiting.back();
    waiting.pop_back();
    const ReadVessel& vessel = vessels.at(next.id);
    const int index = static_cast<int>(problem.network.branches.size());
    problem.network.branches.push_back(vessel.branch);
    problem.network.branches.back().parent = next.parent;
    if (vessel.behind.empty()) {
      if (!conditions.contains(vessel.outlet))
        throw InvalidInput("vessel " + vessel.branch.name + " of the svZeroDSolver case ends in nothing");
      problem.boundary.outlets.push_back(outlet_of_json(vessel.outlet, conditions.at(vessel.outlet)));
    }
    for (auto behind = vessel.behind.rbegin(); behind != vessel.behind.rend(); ++behind)
      waiting.push_back({*behind, index});
  }
}

/// All roots have one pressure, or the one root has a flow.
void set_inlets(const std::map<int, ReadVessel>& vessels,
                const std::map<std::string, ReadCondition>& conditions, SvzerodCase& problem) {
  std::optional<double> pressure;
  std::size_t roots = 0;
  for (const auto& [id, vessel] : vessels) {
    if (vessel.before) continue;
    ++roots;
    if (!conditions.contains(vessel.inlet))
      throw InvalidInput("vessel " + vessel.branch.name + " of the svZeroDSolver case begins in nothing");
    const ReadCondition& inlet = conditions.at(vessel.inlet);
    if (inlet.type == "FLOW") {
      problem.boundary.inlet_flow_ml_s = steady(inlet.values.at("Q"), "Q of " + vessel.inlet);
    } else if (inlet.type == "PRESSURE") {
      const double told = steady(inlet.values.at("P"), "P of " + vessel.inlet);
      if (pressure && *pressure != told)
        throw InvalidInput("the inlets of the svZeroDSolver case have different pressures");
      pressure = problem.boundary.inlet_pa = told;
    } else {
      throw InvalidInput("the svZeroDSolver case has a boundary of type " + inlet.type +
                         " at an inlet; FLOW and PRESSURE are read");
    }
  }
  if (roots == 0) throw InvalidInput("the svZeroDSolver case has no inlet");
  if (problem.boundary.inlet_flow_ml_s && roots > 1)
    throw InvalidInput(
        "the svZeroDSolver case has several inlets, and one has a flow; one inlet is read then");
}

}  // namespace

SvzerodCase read_svzerod(std::string_view json) {
  SvzerodCase problem;
  try {
    const ReadJson root = ReadJson::parse(json);
    std::map<std::string, ReadCondition> conditions;
    for (const ReadJson& one : root.at("boundary_conditions")) {
      const auto name = one.at("bc_name").get<std::string>();
      if (!conditions.try_emplace(name, one.at("bc_type").get<std::string>(), one.at("bc_values")).second)
        throw InvalidInput("the svZeroDSolver case has two boundary conditions named " + name);
    }
    bool capacitive = false;
    std::map<int, ReadVessel> vessels = vessels_of_json(root, capacitive);
    join_vessels(root, vessels);
    set_inlets(vessels, conditions, problem);
    for (const auto& [id, vessel] : vessels)
      if (!vessel.before) add_tree(vessels, id, conditions, problem);
    if (problem.network.branches.size() != vessels.size())
      throw InvalidInput("the svZeroDSolver case has vessels that no inlet leads to");
    if (capacitive) problem.notes.emplace_back("C and L of vessels do not matter to a steady state");
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput(std::string("this is no case of svZeroDSolver: ") + error.what());
  } catch (const std::out_of_range&) {
    throw InvalidInput("a junction of the svZeroDSolver case names a vessel that is not there");
  }
  validate(problem.network);
  return problem;
}

std::string svzerod_result_csv(const SvzerodCase& problem, const Solution& solution) {
  using core::shortest_text;
  std::string text = core::csv_line({"name", "time", "flow_in", "flow_out", "pressure_in", "pressure_out"});
  for (std::size_t b = 0; b < problem.network.branches.size(); ++b)
    text += core::csv_line({problem.network.branches[b].name, "0", shortest_text(solution.flow_ml_s[b]),
                            shortest_text(solution.flow_ml_s[b]), shortest_text(solution.from_pa[b]),
                            shortest_text(solution.to_pa[b])});
  return text;
}

}  // namespace ostia::hemodynamics
