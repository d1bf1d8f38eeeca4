#pragma once
/// \file Trees grown down to the capillaries.

#include "rooms.h"

namespace ostia::python {

void bind_growth(py::module_& m);

}  // namespace ostia::python
