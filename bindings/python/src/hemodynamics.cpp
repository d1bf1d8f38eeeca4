#include "call.h"
#include "figures.h"
#include "options.h"
#include "rooms.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/hemodynamics/conditions.h"
#include "ostia/hemodynamics/network_export.h"
#include "ostia/hemodynamics/readings.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {
namespace {

namespace fs = std::filesystem;
using py::literals::operator""_a;

struct SolvedCase {
  hemodynamics::SvzerodCase problem;
  hemodynamics::Solution solution;
};

SolvedCase solved_case(const std::string& json) {
  SolvedCase made{hemodynamics::read_svzerod(json), {}};
  for (const std::string& note : made.problem.notes) core::log_info(note);
  made.solution =
      hemodynamics::solve(hemodynamics::PreparedNetwork(made.problem.network, {}), made.problem.boundary);
  return made;
}

py::dict shown(const SolvedCase& made) {
  py::list vessels;
  for (std::size_t b = 0; b < made.problem.network.branches.size(); ++b)
    vessels.append(py::dict("name"_a = made.problem.network.branches[b].name,
                            "flow"_a = made.solution.flow_ml_s[b], "pressure_in"_a = made.solution.from_pa[b],
                            "pressure_out"_a = made.solution.to_pa[b]));
  return py::dict("research_use"_a = std::string(hemodynamics::research_use),
                  "inlet_pressure"_a = made.solution.inlet_pa, "iterations"_a = made.solution.iterations,
                  "vessels"_a = vessels, "notes"_a = made.problem.notes,
                  "csv"_a = hemodynamics::svzerod_result_csv(made.problem, made.solution));
}

/// What an input is, for tables and studies.
py::list inputs_shown() {
  py::list rows;
  const hemodynamics::Conditions usual;
  for (const auto& input : hemodynamics::condition_inputs()) {
    const py::object value = input.value != nullptr  ? py::object(py::float_(usual.*input.value))
                             : usual.*input.optional ? py::object(py::float_(*(usual.*input.optional)))
                                                     : py::none();
    rows.append(py::dict("key"_a = std::string(input.key), "value"_a = value,
                         "unit"_a = std::string(input.unit), "meaning"_a = std::string(input.meaning),
                         "source"_a = std::string(input.source),
                         "usual"_a = py::make_tuple(input.usual_low, input.usual_high),
                         "allowed"_a = py::make_tuple(input.least, input.most)));
  }
  return rows;
}

}  // namespace

void bind_hemodynamics(py::module_& m) {
  m.def(
      "solve_network",
      [](const fs::path& path) {
        const SolvedCase made =
            watched_or_left(py::none(), [path](const auto&) { return solved_case(core::read_file(path)); });
        return shown(made);
      },
      py::arg("path"),
      "A steady case of svZeroDSolver (.json) by Ostia's own solver, in the file's own units: vessels, a "
      "dictionary each with flow, pressure_in, pressure_out; csv, the table that svZeroDSolver writes.");
  m.def(
      "condition_inputs", &inputs_shown,
      "What pressures are computed from: a dictionary an input with key, value, unit, meaning, source, usual "
      "and allowed range.");
}

}  // namespace ostia::python
