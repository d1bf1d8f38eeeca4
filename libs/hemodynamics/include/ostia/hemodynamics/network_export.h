#pragma once
/// \file A solved network as a case of other programs, and svZeroDSolver's cases read back
/// (docs/reference/ffr.md).

#include "ostia/hemodynamics/network_solver.h"

#include <string>
#include <string_view>
#include <vector>

namespace ostia::hemodynamics {

enum class NetworkFormat {
  svzerod,  ///< svZeroDSolver: JSON of resistances and stenosis coefficients
  svoned,   ///< svOneDSolver: segments with sections, rigid walls
  openbf,   ///< openBF: YAML of tapering vessels, stiff walls, and a file of the inlet's flow
};
std::string_view name_of(NetworkFormat format);  ///< "svzerod", "svoned", "openbf"
/// Throws InvalidInput for any other name.
NetworkFormat network_format(std::string_view name);

struct NetworkExportOptions {
  /// A branch is cut into cones; at each section between they are off by no more than this share of the
  /// radius, [0.001, 0.5].
  double tolerance = 0.02;
};
struct NetworkFile {
  std::string name, text;
};
/// The network in the state that was solved. svZeroDSolver's elements have the developed friction as
/// resistance, and as stenosis coefficient what the piece takes of the pressure beside it at this flow,
/// junctions included, so that its own solution has these pressures; the others compute along the sections
/// with their own models. svOneDSolver and openBF have one inlet: a file a root. What lies beyond an
/// occlusion is left out, and of the latter two what nothing flows through. Throws InvalidInput for options,
/// for an outlet whose flow is told (svOneDSolver, openBF), and where nothing flows at all.
std::vector<NetworkFile> export_network(const PreparedNetwork& network, const Boundary& boundary,
                                        const Solution& solution, NetworkFormat format,
                                        const NetworkExportOptions& options = {});

/// A case of svZeroDSolver in its own units (whichever they are: numbers are taken as they stand).
struct SvzerodCase {
  Network network;  ///< a branch a vessel, without sections: `lumped`, and the vessel's name
  Boundary boundary;
  std::vector<std::string> notes;  ///< one sentence each: what a steady state does not need
};
/// Steady cases of trees: BloodVessel elements, NORMAL_JUNCTION and internal_junction with one inlet, FLOW,
/// PRESSURE, RESISTANCE, RCR and CORONARY boundaries that do not change in time. Throws InvalidInput that
/// names what is another: a loop, another element, a flow over time, two inlets that are not one pressure.
SvzerodCase read_svzerod(std::string_view json);

/// Of a solution of it: the columns of svZeroDSolver's own result (name, time, flow_in, flow_out,
/// pressure_in, pressure_out), a row a vessel.
std::string svzerod_result_csv(const SvzerodCase& problem, const Solution& solution);

}  // namespace ostia::hemodynamics
