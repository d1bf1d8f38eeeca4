#pragma once
/// \file What the room pipeline adds beside meshes: motions, skeletons and measures of trees.

#include "rooms.h"

namespace ostia::python {

void bind_pipeline_motion(py::module_& m);
void bind_pipeline_trees(py::module_& m);

}  // namespace ostia::python
