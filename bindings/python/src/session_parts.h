#pragma once
/// \file What the room session adds beside cases: pressures, walls and plaque, reports.

#include "rooms.h"

namespace ostia::python {

void bind_pressure(py::module_& m);
void bind_session_walls(py::module_& m);
void bind_session_reports(py::module_& m);
void bind_session_tissues(py::module_& m);
void bind_session_comparison(py::module_& m);

}  // namespace ostia::python
