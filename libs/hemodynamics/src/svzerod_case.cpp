// svZeroDSolver's JSON: vessels as resistances with a stenosis coefficient, in centimetres, grams and
// seconds. The format is that of its own cases (SimVascular/svZeroDSolver, tests/cases).

#include "network_pieces.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace ostia::hemodynamics {
namespace {

using SvzerodJson = nlohmann::ordered_json;

constexpr double cgs = 10.0;  // dyn/cm2 a Pa; so are resistances, since a ml is a cm3

std::string vessel_name(std::size_t branch, int segment) {
  return "branch" + std::to_string(branch) + "_seg" + std::to_string(segment);
}

/// A value that stays.
SvzerodJson constant(const char* what, double value) {
  return {{what, {value, value}}, {"t", {0.0, 1.0}}};
}

SvzerodJson boundary_json(const std::string& name, const Outlet& outlet) {
  if (outlet.flow_ml_s)
    return {{"bc_name", name}, {"bc_type", "FLOW"}, {"bc_values", constant("Q", *outlet.flow_ml_s)}};
  return {{"bc_name", name},
          {"bc_type", "RESISTANCE"},
          {"bc_values", {{"Pd", outlet.distal_pa * cgs}, {"R", outlet.resistance_pa_s_ml * cgs}}}};
}

/// What the piece takes beside its friction, over the flow's square: pressure may come back, too.
double coefficient_of(const NetworkPiece& piece) {
  const double square = piece.flow_ml_s * std::abs(piece.flow_ml_s);
  if (square == 0.0) return 0.0;
  return (piece.from_pa - piece.to_pa - piece.friction_pa_s_ml * piece.flow_ml_s) / square;
}

}  // namespace

NetworkFile svzerod_file(const PreparedNetwork& network, const Boundary& boundary, const Solution& solution,
                         const std::vector<NetworkPiece>& pieces) {
  SvzerodJson conditions = SvzerodJson::array(), junctions = SvzerodJson::array(),
              vessels = SvzerodJson::array(), names = SvzerodJson::object();
  std::map<int, std::vector<int>> children;
  int roots = 0, outlets = 0, segment = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const NetworkPiece& piece = pieces[i];
    segment = piece.first ? 0 : segment + 1;
    SvzerodJson vessel{{"vessel_id", i},
                       {"vessel_length", piece.length_mm / 10.0},
                       {"vessel_name", vessel_name(piece.branch, segment)},
                       {"zero_d_element_type", "BloodVessel"},
                       {"zero_d_element_values",
                        {{"R_poiseuille", piece.friction_pa_s_ml * cgs},
                         {"stenosis_coefficient", coefficient_of(piece) * cgs}}}};
    SvzerodJson ends = SvzerodJson::object();
    if (piece.parent < 0) {
      const std::string name = "INLET" + std::to_string(roots++);
      conditions.push_back({{"bc_name", name},
                            {"bc_type", "PRESSURE"},
                            {"bc_values", constant("P", solution.inlet_pa * cgs)}});
      ends["inlet"] = name;
    } else {
      children[piece.parent].push_back(static_cast<int>(i));
    }
    if (piece.outlet) {
      const std::string name = "OUT" + std::to_string(outlets++);
      conditions.push_back(boundary_json(name, outlet_of(network, boundary, piece.branch)));
      ends["outlet"] = name;
    }
    if (!ends.empty()) vessel["boundary_conditions"] = ends;
    vessels.push_back(std::move(vessel));
    names["branch" + std::to_string(piece.branch)] = network.network().branches[piece.branch].name;
  }
  for (const auto& [parent, behind] : children)
    junctions.push_back({{"inlet_vessels", {parent}},
                         {"junction_name", "J" + std::to_string(junctions.size())},
                         {"junction_type", "NORMAL_JUNCTION"},
                         {"outlet_vessels", behind}});
  const SvzerodJson file{
      {"description",
       {{"units", "cm, g, s: pressures in dyn/cm2, flows in ml/s"},
        {"branches", names},
        {"stenosis_coefficient", "such that each piece takes what it took in this state"}}},
      {"simulation_parameters",
       {{"number_of_cardiac_cycles", 2},
        {"number_of_time_pts_per_cardiac_cycle", 5},
        {"absolute_tolerance", 1e-9}}},
      {"boundary_conditions", conditions},
      {"junctions", junctions},
      {"vessels", vessels}};
  return {"svzerod.json", file.dump(1, ' ', false, SvzerodJson::error_handler_t::replace) + "\n"};
}

}  // namespace ostia::hemodynamics
