#include "call.h"
#include "figures.h"
#include "options.h"
#include "rooms.h"
#include "values.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/hex_mesh_file.h"
#include "ostia/io/quad_surface_file.h"
#include "ostia/reconstruction/frusta.h"
#include "ostia/reconstruction/hexahedra.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace ostia::python {

using reconstruction::FrustaMesh;
using reconstruction::FrustaOptions;
using reconstruction::HexahedraOptions;
using reconstruction::Narrowing;
using reconstruction::ReconstructedSurface;
using reconstruction::ReconstructionOptions;
using reconstruction::SweptHexahedra;
OSTIA_OPTIONS(ReconstructionOptions, (level, sides, spacing, bending, lambda, blend, untangling), ())
OSTIA_OPTIONS(HexahedraOptions, (shell, layers, growth, wanted_jacobian, relaxations), ())
OSTIA_OPTIONS(FrustaOptions, (sides, pieces, smooth), ())
OSTIA_FIGURES(Narrowing, (branch, radius_factor), ())

namespace {

namespace fs = std::filesystem;
using geometry::HexMesh;
using geometry::TriMesh;
using geometry::VesselGraph;

void require_network(const VesselGraph& graph, const core::TaskContext& task) {
  geometry::require_sound(graph, "graph", false, task);
}

/// Around the network with circles of its radii, or with elliptic sections as the wall has them.
ReconstructedSurface surface_of(const VesselGraph& graph, const TriMesh* wall,
                                const ReconstructionOptions& how, const core::TaskContext& task) {
  require_network(graph, task);
  if (wall == nullptr) return reconstruction::reconstruct_surface(graph, how, task);
  const auto fit = reconstruction::fit_elliptic_sections(graph, *wall, {}, task.sub(0.0, 0.3));
  if (fit.used == 0)
    throw InvalidInput("wall: of " + std::to_string(fit.cut) +
                       " sections across the vessels none is closed, elliptic and of about the graph's "
                       "radius; it must be a surface in millimetres around this graph");
  return reconstruction::reconstruct_surface(fit.graph, fit.sections, how, task.sub(0.3, 1.0));
}

bool is_closed(const ReconstructedSurface& made) {
  return made.self_intersections == 0 && geometry::find_faults(made.surface.mesh, false).closed_manifold();
}

void bind_surface(py::module_& m) {
  py::class_<ReconstructedSurface, std::shared_ptr<ReconstructedSurface>>(
      m, "ReconstructedSurface", "A surface of quadrilaterals around a network of vessels.")
      .def_property_readonly("points", view(&ReconstructedSurface::points), "(n, 3) float64, mm, LPS")
      .def_property_readonly("quads", view(&ReconstructedSurface::quads),
                             "(m, 4) int32, counter-clockwise from outside")
      .def_property_readonly("branch_of_quad", view(&ReconstructedSurface::branch_of_quad),
                             "(m,) int32, which branch each quadrilateral is of")
      .def_property_readonly("surface", part(&ReconstructedSurface::surface),
                             "FacedSurface: the same points, two triangles a quadrilateral")
      .def_property_readonly(
          "narrowed", [](const ReconstructedSurface& s) { return figures_of(s.narrowed); },
          "Where vessels overlap and gave way: a dictionary of branch and radius_factor each")
      .def_property_readonly("moved", view(&ReconstructedSurface::moved),
                             "(k,) int32, branches whose axes were moved")
      .def_readonly("self_intersections", &ReconstructedSurface::self_intersections,
                    "Pairs of triangles that still cross")
      .def_property_readonly("closed", &is_closed, "Closed, and nothing crosses itself")
      .def("__repr__", [](const ReconstructedSurface& s) {
        return py::str("<ostia.ReconstructedSurface: level {}, {} quadrilaterals, {} self-intersections>")
            .format(s.level, s.quads.size(), s.self_intersections);
      });
  const std::string text = with_options<ReconstructionOptions>(
      m, "reconstruct_surface",
      "A smooth closed surface of quadrilaterals around a network, its sections circles of the graph's radii "
      "or, with a wall (a surface around it, mm), ellipses as the wall has them.");
  m.def(
      "reconstruct_surface",
      [](const VesselGraph& graph, const TriMesh* wall, const py::object& progress,
         const py::kwargs& options) {
        const auto how = options_of<ReconstructionOptions>(options);
        reconstruction::validate(how);
        return std::make_shared<ReconstructedSurface>(
            watched(progress, [&](const auto& task) { return surface_of(graph, wall, how, task); }));
      },
      py::arg("graph"), py::arg("wall") = py::none(), py::kw_only(), py::arg("progress") = py::none(),
      text.c_str());
  m.def(
      "write_quad_surface",
      [](const fs::path& path, const ReconstructedSurface& surface) {
        return watched_or_left(py::none(), [path, surface = kept(surface)](const auto& task) {
          return io::write_quad_surface(
              path, io::quads_of_pairs(surface->surface, surface->points, surface->branch_of_quad), task);
        });
      },
      py::arg("path"), py::arg("surface"),
      "By extension: .vtp, .vtk, .ply or .obj, and .stl as triangles; returns what the format could not "
      "hold.");
}

void bind_hexahedra(py::module_& m) {
  py::class_<HexMesh, std::shared_ptr<HexMesh>> mesh(m, "HexMesh", "Hexahedra with their boundary.");
  mesh.def_property_readonly("points", view(&HexMesh::points), "(n, 3) float64, mm, LPS")
      .def_property_readonly("hexahedra", view(&HexMesh::hexahedra), "(m, 8) int32, in VTK's order")
      .def_property_readonly("quads", view(&HexMesh::quads), "of the boundary, (k, 4) int32, outward")
      .def_property_readonly("quad_face_ids", view(&HexMesh::quad_face_ids), "(k,) int32")
      .def_readonly("faces", &HexMesh::faces, "A list of Face.")
      .def("__repr__",
           [](const HexMesh& h) {
             return py::str("<ostia.HexMesh: {} points, {} hexahedra, {} faces>")
                 .format(h.points.size(), h.hexahedra.size(), h.faces.size());
           })
      .def(py::pickle(
          [](const HexMesh& h) {
            return py::make_tuple(array_of(h.points), array_of(h.hexahedra), array_of(h.quads),
                                  array_of(h.quad_face_ids), h.faces);
          },
          [](const py::tuple& s) {
            return HexMesh{places_of(s[0], "points"), rows_of<8>(s[1], "hexahedra"),
                           rows_of<4>(s[2], "quads"), whole_numbers_of(s[3], "quad_face_ids"),
                           s[4].cast<std::vector<geometry::Face>>()};
          }));
  same_when_copied(mesh);
  py::class_<SweptHexahedra, std::shared_ptr<SweptHexahedra>>(m, "SweptHexahedra",
                                                              "What sweep_hexahedra made.")
      .def_property_readonly("mesh", part(&SweptHexahedra::mesh), "HexMesh, with the surface's faces")
      .def_readonly("volume_mm3", &SweptHexahedra::volume_mm3, "mm3")
      .def_readonly("least_jacobian", &SweptHexahedra::least_jacobian, "The least scaled Jacobian, [-1, 1]")
      .def_readonly("mean_jacobian", &SweptHexahedra::mean_jacobian, "The mean scaled Jacobian, [-1, 1]")
      .def_readonly("folded", &SweptHexahedra::folded, "Hexahedra that no solver takes")
      .def("__repr__", [](const SweptHexahedra& s) {
        return py::str("<ostia.SweptHexahedra: {} hexahedra, least scaled Jacobian {:.3f}>")
            .format(s.mesh.hexahedra.size(), s.least_jacobian);
      });
  const std::string text = with_options<HexahedraOptions>(
      m, "sweep_hexahedra",
      "Hexahedra inside of a reconstructed surface of level 1 or more, swept along its vessels.");
  m.def(
      "sweep_hexahedra",
      [](const ReconstructedSurface& surface, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<HexahedraOptions>(options);
        return std::make_shared<SweptHexahedra>(watched(
            progress, [&](const auto& task) { return reconstruction::sweep_hexahedra(surface, how, task); }));
      },
      py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  m.def(
      "write_hex_mesh",
      [](const fs::path& path, const HexMesh& hexahedra) {
        watched_or_left(py::none(), [path, hexahedra = kept(hexahedra)](const auto& task) {
          io::write_hex_mesh(path, *hexahedra, task);
        });
      },
      py::arg("path"), py::arg("mesh"), ".vtu, or without an extension a folder for OpenFOAM.");
}

void bind_frusta(py::module_& m) {
  py::class_<FrustaMesh, std::shared_ptr<FrustaMesh>>(m, "FrustaMesh",
                                                      "Truncated cones along vessels, to be drawn.")
      .def_property_readonly("mesh", part(&FrustaMesh::mesh), "TriMesh; branches overlap at forks")
      .def_property_readonly("normals", view(&FrustaMesh::normals), "(n, 3), unit, outward, one a point")
      .def_property_readonly(
          "texture",
          [](const py::object& self) {
            const auto& texture = self.cast<const FrustaMesh&>().texture;
            static_assert(sizeof(geometry::Vec2) == 2 * sizeof(double));
            return view_of(py::dtype::of<double>(), {static_cast<py::ssize_t>(texture.size()), 2},
                           texture.data(), self);
          },
          "(n, 2): along the vessel in mm, and around it in [0, 1]")
      .def_property_readonly("edge_of_triangle", view(&FrustaMesh::edge_of_triangle),
                             "(m,) int32, the graph's edge of each triangle")
      .def("__repr__", [](const FrustaMesh& f) {
        return py::str("<ostia.FrustaMesh: {} triangles>").format(f.mesh.triangles.size());
      });
  const std::string text = with_options<FrustaOptions>(
      m, "frusta", "A network as truncated cones that share the circles at their joints, for quick drawing.");
  m.def(
      "frusta",
      [](const VesselGraph& graph, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<FrustaOptions>(options);
        return std::make_shared<FrustaMesh>(watched(progress, [&](const auto& task) {
          require_network(graph, task);
          return reconstruction::frusta(graph, how, task);
        }));
      },
      py::arg("graph"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

}  // namespace

void bind_reconstruction(py::module_& m) {
  bind_surface(m);
  bind_hexahedra(m);
  bind_frusta(m);
}

}  // namespace ostia::python
