// The extension module `_ostia`; the package `ostia` is what people import.

#include "array.h"
#include "rooms.h"

PYBIND11_MODULE(_ostia, m) {
  m.doc() = "Ostia's libraries; import the package ostia instead";
  ostia::python::require_known_vectors();
  ostia::python::bind_core(m);
  ostia::python::bind_geometry(m);
  ostia::python::bind_imaging(m);
  ostia::python::bind_io(m);
  ostia::python::bind_segmentation(m);
  ostia::python::bind_centerline(m);
  ostia::python::bind_lumen(m);
  ostia::python::bind_meshing(m);
  ostia::python::bind_analysis(m);
  ostia::python::bind_pipeline(m);
  ostia::python::bind_session(m);
}
