#include "array.h"
#include "call.h"
#include "mesh_options.h"
#include "options.h"
#include "rooms.h"

#include "ostia/meshing/sizing.h"

#include <pybind11/stl.h>

namespace ostia::python {
namespace {

py::array array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

}  // namespace

void bind_meshing(py::module_& m) {
  std::string text = with_options<meshing::SizingOptions>(
      m, "target_edge_lengths",
      "Edge length at each point of a surface by its distance from the axes, mm, (n,).");
  m.def(
      "target_edge_lengths",
      [](const geometry::TriMesh& surface, const geometry::VesselTree& tree, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<meshing::SizingOptions>(options);
        return array_of(watched(progress, [&](const auto& task) {
          return meshing::target_edge_lengths(surface, meshing::TubeFunction(tree), how, task);
        }));
      },
      py::arg("surface"), py::arg("tree"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<meshing::RemeshOptions>(
      m, "remesh", "A surface with edges as long as is asked for, one length for all or one a point, mm.");
  m.def(
      "remesh",
      [](const geometry::TriMesh& surface, const py::object& edge_lengths_mm, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<meshing::RemeshOptions>(options);
        const bool one = PyFloat_Check(edge_lengths_mm.ptr()) || PyLong_Check(edge_lengths_mm.ptr());
        const auto lengths = one ? std::vector<double>(surface.points.size(), edge_lengths_mm.cast<double>())
                                 : numbers_of(edge_lengths_mm, "edge_lengths_mm");
        auto found =
            watched(progress, [&](const auto& task) { return meshing::remesh(surface, lengths, how, task); });
        return std::move(found.mesh);
      },
      py::arg("surface"), py::arg("edge_lengths_mm"), py::kw_only(), py::arg("progress") = py::none(),
      text.c_str());
  text = with_options<meshing::TetrahedralizeOptions>(
      m, "tetrahedralize", "The inside of a closed surface with faces as tetrahedra.");
  m.def(
      "tetrahedralize",
      [](const geometry::FacedSurface& surface, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<meshing::TetrahedralizeOptions>(options);
        auto found =
            watched(progress, [&](const auto& task) { return meshing::tetrahedralize(surface, how, task); });
        return std::move(found.mesh);
      },
      py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace ostia::python
