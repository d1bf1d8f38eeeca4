#pragma once
/// \file What each room adds to the module; one source a room, or a few. Here are the hands that a caller is
/// given, and no algorithm.

#include <pybind11/pybind11.h>

namespace ostia::python {

namespace py = pybind11;

// In the order of the rooms: a function can name the types of those before it alone.
void bind_core(py::module_& m);
void bind_geometry(py::module_& m);
void bind_imaging(py::module_& m);
void bind_io(py::module_& m);
void bind_filtering(py::module_& m);
void bind_segmentation(py::module_& m);
void bind_centerline(py::module_& m);
void bind_reconstruction(py::module_& m);
void bind_lumen(py::module_& m);
void bind_meshing(py::module_& m);
void bind_hemodynamics(py::module_& m);
void bind_solver(py::module_& m);
void bind_motion(py::module_& m);
void bind_analysis(py::module_& m);
void bind_phantom(py::module_& m);
void bind_evaluation(py::module_& m);
void bind_coronary(py::module_& m);
void bind_pipeline(py::module_& m);
void bind_session(py::module_& m);
void bind_display(py::module_& m);
void bind_experiments(py::module_& m);

}  // namespace ostia::python
