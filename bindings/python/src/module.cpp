// The extension module `_ostia`; the package `ostia` is what people import.

#include "call.h"
#include "growth.h"
#include "rooms.h"

#include <initializer_list>

PYBIND11_MODULE(_ostia, m) {
  m.doc() = "Ostia's libraries; import the package ostia instead";
  using namespace ostia::python;
  for (const auto bind :
       {bind_core,        bind_geometry,       bind_imaging,  bind_io,      bind_segmentation,
        bind_centerline,  bind_reconstruction, bind_lumen,    bind_meshing, bind_hemodynamics,
        bind_solver,      bind_motion,         bind_analysis, bind_growth,  bind_phantom,
        bind_evaluation,  bind_coronary,       bind_pipeline, bind_session, bind_display,
        bind_experiments, bind_filtering})
    bind(m);
  // Before threads that Python does not wait for can come back to it.
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_all_calls));
}
