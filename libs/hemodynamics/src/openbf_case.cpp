// openBF's YAML in SI units (INSIGNEO/openBF, its manual's page on the configuration): tapering vessels, a
// windkessel of two elements at outlets, the inlet's flow in a file of its own.

#include "circle.h"
#include "network_pieces.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::hemodynamics {
namespace {

using core::shortest_text;

constexpr double stiff_pa = 1e7;        // Young's modulus: the lumen stays within about half a per cent
constexpr double bed_seconds = 0.1;     // resistance times compliance of a bed
constexpr double connector_mm = 1.0;    // between forks of more than two branches, which openBF has not
constexpr std::size_t most_behind = 2;  // branches of a node

/// With a point: without one YAML 1.1 takes 1e+07 for a word.
std::string yaml_number(double value) {
  std::string text = shortest_text(value);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

double radius_m(double area_mm2) {
  return 1e-3 * std::sqrt(area_mm2 / pi);
}

std::string vessel_text(const std::string& label, int from, int to, double length_mm, double from_mm2,
                        double to_mm2) {
  return "  - label: " + label + "\n    sn: " + std::to_string(from) + "\n    tn: " + std::to_string(to) +
         "\n    L: " + yaml_number(1e-3 * length_mm) + "\n    Rp: " + yaml_number(radius_m(from_mm2)) +
         "\n    Rd: " + yaml_number(radius_m(to_mm2)) + "\n    E: " + yaml_number(stiff_pa) +
         "\n    gamma_profile: 2\n";
}

/// The bed ends at no pressure in openBF: its resistance is that which leaves the pressure as it is.
std::string bed_text(const PreparedNetwork& network, const Boundary& boundary, const NetworkPiece& piece) {
  const Outlet& outlet = outlet_of(network, boundary, piece.branch);
  if (outlet.flow_ml_s || !(piece.flow_ml_s > 0.0))
    throw InvalidInput("the flow of an outlet is told; a case of openBF has resistances there");
  const double resistance = 1e6 * (outlet.resistance_pa_s_ml + outlet.distal_pa / piece.flow_ml_s);
  return "    R1: " + yaml_number(resistance) + "\n    Cc: " + yaml_number(bed_seconds / resistance) + "\n";
}

}  // namespace

std::vector<NetworkFile> openbf_files(const PreparedNetwork& network, const Boundary& boundary,
                                      const std::vector<NetworkPiece>& pieces, int number) {
  const std::string suffix = number > 0 ? "-" + std::to_string(number) : std::string();
  std::string vessels;
  std::vector<int> end(pieces.size());  // node that what follows leaves from
  std::vector<std::size_t> behind(pieces.size(), 0), placed(pieces.size(), 0);
  for (const NetworkPiece& piece : pieces)
    if (piece.parent >= 0) ++behind[static_cast<std::size_t>(piece.parent)];
  int node = 1;  // the inlet's
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const NetworkPiece& piece = pieces[i];
    int from = 1;
    if (piece.parent >= 0) {
      const auto parent = static_cast<std::size_t>(piece.parent);
      if (behind[parent] - placed[parent] > 1 && placed[parent] + 1 >= most_behind) {
        const int next = ++node;
        vessels += vessel_text("connector" + std::to_string(next), end[parent], next, connector_mm,
                               pieces[parent].to_mm2, pieces[parent].to_mm2);
        end[parent] = next;
      }
      from = end[parent];
      ++placed[parent];
    }
    end[i] = ++node;
    vessels += vessel_text("branch" + std::to_string(piece.branch) + "_" + std::to_string(i), from, end[i],
                           piece.length_mm, piece.from_mm2, piece.to_mm2);
    if (piece.outlet) vessels += bed_text(network, boundary, piece);
  }
  const std::string inlet = "openbf" + suffix + "_inlet.dat";
  const FlowModel& model = network.model();
  const std::string flow = yaml_number(1e-6 * pieces.front().flow_ml_s);
  return {{"openbf" + suffix + ".yaml",
           "project_name: \"openbf" + suffix + "\"\ninlet_file: \"" + inlet +
               "\"\nwrite_results: [\"P\", \"Q\", \"A\"]\n\nsolver:\n  Ccfl: 0.9\n  cycles: 20\n"
               "  convergence_tolerance: 1.0\n  jump: 100\n\nblood:\n  rho: " +
               yaml_number(model.density_kg_m3) + "\n  mu: " + yaml_number(1e-3 * model.viscosity_mpa_s) +
               "\n\nnetwork:\n" + vessels},
          {inlet, "0.0 " + flow + "\n0.5 " + flow + "\n1.0 " + flow + "\n"}};
}

}  // namespace ostia::hemodynamics
