#pragma once
/// \file Networks of vessels as arrays.

#include "rooms.h"

namespace ostia::python {

void bind_graphs(py::module_& m);

}  // namespace ostia::python
