#pragma once
/// \file Centerlines and trees of vessels.

#include "rooms.h"

namespace ostia::python {

void bind_trees(py::module_& m);

}  // namespace ostia::python
