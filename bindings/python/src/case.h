#pragma once
/// \file The case file as Python has it.

#include "rooms.h"

#include "ostia/lumen/edit.h"

namespace ostia::python {

void bind_case(py::module_& m);

/// An edit from its name and fields by keyword, or from its line. Throws InvalidInput.
lumen::Edit edit_of(const py::object& op, const py::kwargs& fields);

}  // namespace ostia::python
