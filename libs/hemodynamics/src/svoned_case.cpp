// svOneDSolver's cards, in centimetres, grams and seconds, as its own cases have them
// (SimVascular/svOneDSolver, tests/cases): rigid walls, a pressure at the inlet, resistances with a distal
// pressure at the outlets.

#include "network_pieces.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <cmath>
#include <map>

namespace ostia::hemodynamics {
namespace {

using core::shortest_text;

constexpr double pressure_cgs = 10.0, area_cgs = 0.01, length_cgs = 0.1;
constexpr double element_cm = 0.05;

std::string svoned_node(std::size_t index, const Vec3& point) {
  return "NODE " + std::to_string(index) + " " + shortest_text(point.x() * length_cgs) + " " +
         shortest_text(point.y() * length_cgs) + " " + shortest_text(point.z() * length_cgs) + "\n";
}

std::string segment_card(const NetworkPiece& piece, std::size_t index, std::size_t from, std::size_t to) {
  const double length = piece.length_mm * length_cgs;
  const int elements = std::max(2, static_cast<int>(std::ceil(length / element_cm)));
  return "SEGMENT branch" + std::to_string(piece.branch) + "_" + std::to_string(index) + " " +
         std::to_string(index) + " " + shortest_text(length) + " " + std::to_string(elements) + " " +
         std::to_string(from) + " " + std::to_string(to) + " " + shortest_text(piece.from_mm2 * area_cgs) +
         " " + shortest_text(piece.to_mm2 * area_cgs) + " 0.0 BLOOD NONE 0.0 0 0 " +
         (piece.outlet ? "RESISTANCE OUT" + std::to_string(index) : std::string("NOBOUND NONE")) + "\n";
}

std::string joint_cards(std::size_t number, std::size_t node, std::size_t inlet,
                        const std::vector<std::size_t>& behind) {
  const std::string n = std::to_string(number);
  std::string text = "JOINT JOINT" + n + " " + std::to_string(node) + " IN" + n + " OUT" + n +
                     "\nJOINTINLET IN" + n + " 1 " + std::to_string(inlet) + "\nJOINTOUTLET OUT" + n + " " +
                     std::to_string(behind.size());
  for (const std::size_t one : behind) text += " " + std::to_string(one);
  return text + "\n\n";
}

}  // namespace

NetworkFile svoned_file(const PreparedNetwork& network, const Boundary& boundary, const Solution& solution,
                        const std::vector<NetworkPiece>& pieces, int number) {
  std::string nodes = svoned_node(0, pieces.front().from), joints, segments, tables;
  std::map<std::size_t, std::vector<std::size_t>> children;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const NetworkPiece& piece = pieces[i];
    nodes += svoned_node(i + 1, piece.to);  // a piece ends at the node that follows its number
    segments += segment_card(piece, i, static_cast<std::size_t>(piece.parent + 1), i + 1);
    if (piece.parent >= 0) children[static_cast<std::size_t>(piece.parent)].push_back(i);
    if (!piece.outlet) continue;
    const Outlet& outlet = outlet_of(network, boundary, piece.branch);
    if (outlet.flow_ml_s)
      throw InvalidInput("the flow of an outlet is told; a case of svOneDSolver has resistances there");
    tables += "DATATABLE OUT" + std::to_string(i) + " LIST\n0.0 " +
              shortest_text(outlet.resistance_pa_s_ml * pressure_cgs) + "\n0.0 " +
              shortest_text(outlet.distal_pa * pressure_cgs) + "\nENDDATATABLE\n\n";
  }
  for (const auto& [parent, behind] : children) joints += joint_cards(parent, parent + 1, parent, behind);
  const std::string inlet = shortest_text(solution.inlet_pa * pressure_cgs);
  const FlowModel& model = network.model();
  const std::string suffix = number > 0 ? "-" + std::to_string(number) : std::string();
  return {"svoned" + suffix + ".in",
          "# cm, g, s; rigid walls; mean aortic pressure at the inlet\nMODEL results_svoned_\n\n" + nodes +
              "\n" + joints + segments + "\n" + tables + "DATATABLE INLETDATA LIST\n0.0 " + inlet + "\n1.0 " +
              inlet +
              "\nENDDATATABLE\n\nSOLVEROPTIONS 0.001 100 1000 2 INLETDATA PRESSURE_WAVE 1.0e-6 1 1\n\n"
              "MATERIAL BLOOD OLUFSEN " +
              shortest_text(model.density_kg_m3 / 1000.0) + " " +
              shortest_text(model.viscosity_mpa_s / 100.0) + " 0 2.0 1.0e15 -20 1e9\n\nOUTPUT TEXT\n"};
}

}  // namespace ostia::hemodynamics
