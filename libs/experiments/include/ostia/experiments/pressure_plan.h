#pragma once
/// \file The vessels of the pressure experiment: drawn from seeds, known exactly
/// (docs/experiments/pressure.md).

#include "ostia/hemodynamics/network.h"
#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::experiments {

enum class PressureKind { tube, concentric, eccentric, tapered, bend, series, fork, patient };
std::string_view name_of(PressureKind kind);
/// Throws InvalidInput for any other name.
PressureKind pressure_kind(std::string_view name);

/// A narrowing of a vessel: the radius falls along half a cosine to (1 - severity) of what it were without,
/// stays there, and rises likewise.
struct PlannedStenosis {
  int vessel = 0;           ///< 0 main (the trunk's, too), 1 side
  double at_mm = 0.0;       ///< its middle, from the root
  double length_mm = 10.0;  ///< with both shoulders
  double shoulder_mm = 3.0;
  double severity = 0.5;  ///< of the diameter, [0, 0.9]
  double aside_mm = 0.0;  ///< that the throat's middle lies off the vessel's
  double aside_deg = 0.0;
  double oval = 1.0;  ///< longer half axis over the radius of equal area
};

/// One vessel, or one fork (a trunk with a main and a side branch).
struct PressureCase {
  std::string id;  ///< "concentric-03"
  PressureKind kind = PressureKind::tube;
  std::uint64_t seed = 0;
  bool judged = false;        ///< the judging half; the other one may be fitted to
  std::string medina;         ///< "1,0,1" of forks
  double diameter_mm = 3.0;   ///< at the root
  double taper = 0.0;         ///< share of the diameter that is lost from the root to the end
  double length_mm = 40.0;    ///< of the main vessel, from the root
  double bend_radius_mm = 0;  ///< of an arc about the first narrowing; 0: straight
  double bend_length_mm = 0;  ///< of the arc
  double fork_mm = 0.0;       ///< where a fork is, from the root; 0: none
  double main_mm = 0.0;       ///< diameters behind it
  double side_mm = 0.0;
  double main_deg = 0.0, side_deg = 0.0;  ///< turns of the branches, to opposite sides
  double side_length_mm = 0.0;            ///< from the root
  std::vector<PlannedStenosis> stenoses;
  double dilation = 1.0;   ///< resistance of the bed over that at rest: 1 rest, 0.24 adenosine
  double flow_ml_s = 0.0;  ///< through the root
  double reynolds = 0.0;   ///< the largest at a throat (of a tube: of its diameter)
};

/// How many of each kind a plan has; forks go through Medina's seven kinds in turn.
struct PressurePlanOptions {
  std::uint64_t first_seed = 1;
  int concentric = 12, eccentric = 10, tapered = 8, bend = 8, series = 7, fork = 21;  ///< [0, 1000] each
};
void validate(const PressurePlanOptions& options);  ///< throws InvalidInput

/// A tube without a narrowing, then all kinds in turn, in an order whose first few are of all kinds, both
/// halves and all severities. Seeds go up from the first; odd ones are for fitting, even ones for judging.
/// Severities (30 to 85 %) and flows (rest to hyperaemia) are spread evenly within each kind. Deterministic.
std::vector<PressureCase> plan_pressure(const PressurePlanOptions& options = {});
/// A line of all that a case is made of, numbers to nine digits.
std::string text_of(const PressureCase& one);

/// Its wall as a case of the program has it: samples on the exact sections r(s, theta). Throws as
/// lumen::model_of_walls does.
lumen::LumenModel pressure_model(const PressureCase& one);
/// The exact sections, every 0.25 mm: of single vessels, none of a fork.
std::optional<hemodynamics::Network> exact_network(const PressureCase& one);

}  // namespace ostia::experiments
