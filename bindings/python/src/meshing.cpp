#include "array.h"
#include "call.h"
#include "figures.h"
#include "mesh_options.h"
#include "options.h"
#include "rooms.h"
#include "values.h"

#include "ostia/core/log.h"
#include "ostia/meshing/field_sizing.h"
#include "ostia/meshing/sizing.h"

#include <pybind11/stl.h>

namespace ostia::python {

using meshing::BoundaryLayerReport;
using meshing::FieldSizing;
using meshing::FieldSizingOptions;
using meshing::ThinPlace;
OSTIA_OPTIONS(FieldSizingOptions,
              (error_share, elements, most_refinement, most_coarsening, gradation, min_edge_mm, max_edge_mm),
              ())
OSTIA_FIGURES(ThinPlace, (point, thickness_mm, wanted_mm), ())
OSTIA_FIGURES(BoundaryLayerReport,
              (prisms, inverted, full_share, min_scaled_jacobian, mean_scaled_jacobian, min_inner_angle_deg,
               thickness_mm, wanted_mm, thin_places, rounds, warnings),
              ())
OSTIA_FIGURES(FieldSizing,
              (sizes, old_edge_mm, range, largest_error, target_error, reached_error, refined_share,
               held_share, elements_before, elements, warnings),
              ())

namespace {

void bind_layers(py::module_& m) {
  const std::string text =
      with_options<meshing::BoundaryLayerOptions>(m, "fill_with_layers",
                                                  "Layers of prisms on the walls of a closed surface with "
                                                  "flat caps, and tetrahedra inside (the options of "
                                                  "tetrahedralize in `inside`): (MixedMesh, what the layers "
                                                  "are: shares, thickness at the wall's points (n,), "
                                                  "mm).");
  m.def(
      "fill_with_layers",
      [](const geometry::FacedSurface& surface, const py::dict& inside, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<meshing::BoundaryLayerOptions>(options);
        meshing::TetrahedralizeOptions filling;
        take(filling, inside, "inside");
        auto made = watched(progress, [&](const core::TaskContext& task) {
          auto found = meshing::fill_with_layers(surface, how, filling, task);
          for (const std::string& warning : found.layers.warnings) core::log_warning(warning);
          return found;
        });
        return py::make_tuple(std::make_shared<geometry::MixedMesh>(std::move(made.mesh)),
                              figures(made.layers));
      },
      py::arg("surface"), py::kw_only(), py::arg("inside") = py::dict(), py::arg("progress") = py::none(),
      text.c_str());
}

void bind_sizes(py::module_& m) {
  m.def(
      "end_planes",
      [](const geometry::VesselTree& tree, double inset_radii) {
        py::list rows;
        for (const meshing::EndPlane& plane : meshing::end_planes(tree, inset_radii)) {
          py::dict row = figures(meshing::PlacedPlane{meshing::end_name(plane), plane.origin, plane.normal});
          row["radius_mm"] = plane.radius_mm;
          rows.append(row);
        }
        return rows;
      },
      py::arg("tree"), py::arg("inset_radii") = 1.0,
      "Where a tree's ends would be cut: a dictionary each with end, origin and normal, as the option planes "
      "takes them, and radius_mm.");
  const std::string text = with_options<FieldSizingOptions>(
      m, "sizes_from_field",
      "Edge lengths from a field that a solver has computed: values (n,) or (n, k) at a mesh's points, or at "
      "its "
      "elements. `sizes` of the result is what the options field of sizing and tetrahedralize take; mm.");
  m.def(
      "sizes_from_field",
      [](const geometry::MixedMesh& mesh, const py::object& values, bool at_elements,
         const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<FieldSizingOptions>(options);
        const py::array any = any_array(values, "values");
        const std::vector<py::ssize_t> shape =
            any.ndim() == 1 ? std::vector<py::ssize_t>{-1} : std::vector<py::ssize_t>{-1, -1};
        const py::array array = taken(any, {"values", 'f', 8, shape}, {true, true});
        const auto* first = static_cast<const double*>(array.data());
        const meshing::MeshField field{any.ndim() == 1 ? 1 : static_cast<int>(array.shape(1)),
                                       at_elements,
                                       {first, first + array.size()}};
        return figures(watched(progress, [&](const core::TaskContext& task) {
          return meshing::sizes_from_field(mesh, field, how, task);
        }));
      },
      py::arg("mesh"), py::arg("values"), py::kw_only(), py::arg("at_elements") = false,
      py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_meshing(py::module_& m) {
  bind_layers(m);
  bind_sizes(m);
  std::string text = with_options<meshing::SizingOptions>(
      m, "target_edge_lengths",
      "Edge length at each of a surface's n points by its distance from the axes: (n,), mm.");
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
      m, "remesh",
      "A surface with edges as long as is asked for, mm: one number for all, or (n,), one a point.");
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
