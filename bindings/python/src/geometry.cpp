#include "array.h"
#include "call.h"
#include "contours.h"
#include "graphs.h"
#include "meshes.h"
#include "options.h"
#include "rooms.h"
#include "trees.h"
#include "values.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/smoothing.h"
#include "ostia/geometry/subdivision.h"

#include <pybind11/stl.h>

namespace ostia::python {

using geometry::SubdivisionOptions;
using geometry::VolumeSmoothingOptions;
OSTIA_OPTIONS(geometry::TaubinOptions, (iterations, pass_band, lambda), ())
OSTIA_OPTIONS(SubdivisionOptions, (levels, to_limit, max_triangles), ())
OSTIA_OPTIONS(VolumeSmoothingOptions, (filter, borders_move, restoring_rounds, mean_rings), (free))

namespace {

using geometry::FacedSurface;
using geometry::MixedMesh;
using geometry::TriMesh;
using geometry::VolumeMesh;
using Meshes = py::class_<TriMesh, std::shared_ptr<TriMesh>>;

std::string size_text(const std::vector<geometry::Vec3>& points) {
  geometry::Box3 box;
  for (const geometry::Vec3& p : points) box.extend(p);
  if (box.isEmpty()) return "empty";
  const geometry::Vec3 size = box.sizes();
  return py::str("{:.4g} x {:.4g} x {:.4g} mm").format(size.x(), size.y(), size.z()).cast<std::string>();
}

void bind_refinement(py::module_& m) {
  std::string text = with_options<SubdivisionOptions>(
      m, "loop_subdivided", "The surface with four smooth triangles of one, so many times (Loop 1987).");
  m.def(
      "loop_subdivided",
      [](const TriMesh& surface, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<SubdivisionOptions>(options);
        return watched(progress,
                       [&](const auto& task) { return geometry::loop_subdivided(surface, how, task); });
      },
      py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  text = with_options<VolumeSmoothingOptions>(
      m, "smoothed_in_volume",
      "The surface smoothed without changing its volume or the calibre of thin vessels.");
  m.def(
      "smoothed_in_volume",
      [](const TriMesh& surface, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<VolumeSmoothingOptions>(options);
        return watched(progress,
                       [&](const auto& task) { return geometry::smoothed_in_volume(surface, how, task); });
      },
      py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
}

void bind_surface(py::module_& m) {
  Meshes mesh(m, "TriMesh",
              "A triangle surface: points (n, 3) float64, mm, LPS, and triangles (m, 3) int32, "
              "counter-clockwise from outside. Both are one memory with the arrays given; immutable.");
  mesh.def(py::init(&mesh_of), py::arg("points"), py::arg("triangles"), py::kw_only(),
           py::arg("copy") = py::none())
      .def_property_readonly("points", view(&TriMesh::points), "(n, 3) float64, mm, LPS")
      .def_property_readonly("triangles", view(&TriMesh::triangles),
                             "(m, 3) int32, indices of points, counter-clockwise from outside")
      .def_property_readonly(
          "area", [](const TriMesh& s) { return geometry::area(s); }, "mm2")
      .def_property_readonly(
          "volume", [](const TriMesh& s) { return geometry::volume(s); }, "mm3, of a closed one")
      .def_property_readonly(
          "closed", [](const TriMesh& s) { return geometry::boundary_loops(s).empty(); },
          "Whether it has no open ends.")
      .def("__repr__",
           [](const TriMesh& s) {
             return py::str("<ostia.TriMesh: {} points, {} triangles, {}>")
                 .format(s.points.size(), s.triangles.size(), size_text(s.points));
           })
      .def(py::pickle(
          [](const py::object& self) { return py::make_tuple(self.attr("points"), self.attr("triangles")); },
          [](const py::tuple& s) { return mesh_of(s[0], s[1], py::none()); }));
  same_when_copied(mesh);
  const std::string text = with_options<geometry::TaubinOptions>(
      m, "taubin_smoothed", "The surface smoothed without shrinking (Taubin 1995).");
  m.def(
      "taubin_smoothed",
      [](const TriMesh& surface, const py::object& progress, const py::kwargs& options) {
        const auto how = options_of<geometry::TaubinOptions>(options);
        return watched(progress,
                       [&](const auto& task) { return geometry::taubin_smoothed(surface, how, task); });
      },
      py::arg("surface"), py::kw_only(), py::arg("progress") = py::none(), text.c_str());
  bind_refinement(m);
  m.def(
      "example_surface",
      [](double spacing_mm, bool open_ends) {
        return unlocked(
            [&] { return geometry::surface_of(geometry::coronary_like_tree(), spacing_mm, open_ends); });
      },
      py::arg("spacing_mm") = 0.3, py::arg("open_ends") = true,
      "The lumen of a tree like a coronary one, a root and three branches, whose axes are known exactly; "
      "spacing_mm: of its points.");
}

const char* word(geometry::FaceKind kind) {
  return kind == geometry::FaceKind::wall ? "wall" : kind == geometry::FaceKind::inlet ? "inlet" : "outlet";
}

geometry::FaceKind kind_of(const std::string& word) {
  if (word == "wall") return geometry::FaceKind::wall;
  if (word == "inlet") return geometry::FaceKind::inlet;
  if (word == "outlet") return geometry::FaceKind::outlet;
  throw InvalidInput("kind: wall, inlet or outlet, not " + word);
}

void bind_faces(py::module_& m) {
  py::class_<geometry::Face>(m, "Face", "A named part of a model's boundary.")
      .def(py::init([](std::int32_t id, std::string name, const std::string& kind) {
             return geometry::Face{id, std::move(name), kind_of(kind)};
           }),
           py::arg("id"), py::arg("name"), py::arg("kind") = "wall")
      .def_readonly("id", &geometry::Face::id, "CellEntityIds: 1 the wall, 2 and up the caps")
      .def_readonly("name", &geometry::Face::name, "As in files.")
      .def_property_readonly(
          "kind", [](const geometry::Face& f) { return word(f.kind); }, "wall, inlet, outlet")
      .def("__repr__",
           [](const geometry::Face& f) {
             return py::str("<ostia.Face {} '{}' ({})>").format(f.id, f.name, word(f.kind));
           })
      .def(py::pickle([](const geometry::Face& f) { return py::make_tuple(f.id, f.name, word(f.kind)); },
                      [](const py::tuple& s) {
                        return geometry::Face{s[0].cast<std::int32_t>(), s[1].cast<std::string>(),
                                              kind_of(s[2].cast<std::string>())};
                      }));
  const auto make = [](const TriMesh& mesh, const py::object& face_ids, std::vector<geometry::Face> faces) {
    require_indices(mesh);
    const py::array ids =
        taken(face_ids, {"face_ids", 'i', 4, {static_cast<py::ssize_t>(mesh.triangles.size())}}, {});
    const auto* first = static_cast<const std::int32_t*>(ids.data());
    return std::make_shared<FacedSurface>(FacedSurface{mesh, {first, first + ids.size()}, std::move(faces)});
  };
  py::class_<FacedSurface, std::shared_ptr<FacedSurface>> faced(
      m, "FacedSurface",
      "A surface whose triangles belong to named faces; face_ids (m,), the id of each triangle's.");
  faced.def(py::init(make), py::arg("mesh"), py::arg("face_ids"), py::arg("faces"))
      .def_property_readonly("mesh", part(&FacedSurface::mesh), "TriMesh, the same memory.")
      .def_property_readonly("face_ids", view(&FacedSurface::face_ids), "(m,) int32, one a triangle")
      .def_readonly("faces", &FacedSurface::faces, "A list of Face.")
      .def("__repr__",
           [](const FacedSurface& s) {
             return py::str("<ostia.FacedSurface: {} triangles, {} faces, {}>")
                 .format(s.mesh.triangles.size(), s.faces.size(), size_text(s.mesh.points));
           })
      .def(py::pickle(
          [](const py::object& self) {
            return py::make_tuple(self.attr("mesh"), self.attr("face_ids"), self.attr("faces"));
          },
          [make](const py::tuple& s) {
            return make(s[0].cast<const TriMesh&>(), s[1], s[2].cast<std::vector<geometry::Face>>());
          }));
  same_when_copied(faced);
}

py::tuple state_of(const VolumeMesh& mesh) {
  return py::make_tuple(array_of(mesh.points), array_of(mesh.tetrahedra), array_of(mesh.boundary),
                        array_of(mesh.boundary_face_ids), mesh.faces);
}

VolumeMesh volume_of_state(const py::tuple& s) {
  return {places_of(s[0], "points"), rows_of<4>(s[1], "tetrahedra"), rows_of<3>(s[2], "boundary"),
          whole_numbers_of(s[3], "boundary_face_ids"), s[4].cast<std::vector<geometry::Face>>()};
}

py::tuple state_of(const MixedMesh& mesh) {
  return py::make_tuple(array_of(mesh.points), array_of(mesh.tetrahedra), array_of(mesh.prisms),
                        array_of(mesh.triangles), array_of(mesh.triangle_face_ids), array_of(mesh.quads),
                        array_of(mesh.quad_face_ids), mesh.faces, array_of(mesh.tetrahedron_nodes),
                        array_of(mesh.prism_nodes), array_of(mesh.triangle_nodes), array_of(mesh.quad_nodes));
}

MixedMesh mixed_of_state(const py::tuple& s) {
  return {places_of(s[0], "points"),
          rows_of<4>(s[1], "tetrahedra"),
          rows_of<6>(s[2], "prisms"),
          rows_of<3>(s[3], "triangles"),
          whole_numbers_of(s[4], "triangle_face_ids"),
          rows_of<4>(s[5], "quads"),
          whole_numbers_of(s[6], "quad_face_ids"),
          s[7].cast<std::vector<geometry::Face>>(),
          rows_of<6>(s[8], "tetrahedron_nodes"),
          rows_of<12>(s[9], "prism_nodes"),
          rows_of<3>(s[10], "triangle_nodes"),
          rows_of<5>(s[11], "quad_nodes")};
}

void bind_volumes(py::module_& m) {
  py::class_<VolumeMesh, std::shared_ptr<VolumeMesh>> tetrahedra(m, "VolumeMesh",
                                                                 "Tetrahedra with their boundary.");
  tetrahedra.def_property_readonly("points", view(&VolumeMesh::points), "(n, 3) float64, mm, LPS")
      .def_property_readonly("tetrahedra", view(&VolumeMesh::tetrahedra), "(m, 4) int32, indices of points")
      .def_property_readonly("boundary", view(&VolumeMesh::boundary),
                             "(k, 3) int32, indices of points, outward")
      .def_property_readonly("boundary_face_ids", view(&VolumeMesh::boundary_face_ids),
                             "(k,) int32, the face of each triangle")
      .def_readonly("faces", &VolumeMesh::faces, "A list of Face.")
      .def(
          "mixed", [](const VolumeMesh& mesh) { return std::make_shared<MixedMesh>(geometry::mixed(mesh)); },
          "The same as a MixedMesh.")
      .def("__repr__", [](const VolumeMesh& v) {
        return py::str("<ostia.VolumeMesh: {} points, {} tetrahedra, {} faces>")
            .format(v.points.size(), v.tetrahedra.size(), v.faces.size());
      });
  tetrahedra.def(py::pickle(py::overload_cast<const VolumeMesh&>(&state_of), &volume_of_state));
  same_when_copied(tetrahedra);
  py::class_<MixedMesh, std::shared_ptr<MixedMesh>> mixed(
      m, "MixedMesh", "Tetrahedra and prisms, linear or quadratic, with their whole boundary.");
  mixed.def_property_readonly("points", view(&MixedMesh::points), "(n, 3) float64, mm, LPS")
      .def_property_readonly("tetrahedra", view(&MixedMesh::tetrahedra), "(m, 4) int32, indices of points")
      .def_property_readonly("prisms", view(&MixedMesh::prisms),
                             "(p, 6) int32, indices of points: two triangles")
      .def_property_readonly("triangles", view(&MixedMesh::triangles),
                             "of the boundary, (k, 3) int32, indices of points, outward")
      .def_property_readonly("triangle_face_ids", view(&MixedMesh::triangle_face_ids),
                             "(k,) int32, the face of each triangle")
      .def_property_readonly("quads", view(&MixedMesh::quads),
                             "of the boundary, (q, 4) int32, indices of points, outward")
      .def_property_readonly("quad_face_ids", view(&MixedMesh::quad_face_ids),
                             "(q,) int32, the face of each quadrilateral")
      .def_property_readonly(
          "tetrahedron_nodes", view(&MixedMesh::tetrahedron_nodes),
          "(m, 6) int32, indices of points on edges 01 12 20 03 13 23; (0, 6) where linear")
      .def_property_readonly("prism_nodes", view(&MixedMesh::prism_nodes),
                             "(p, 12) int32, indices of points on edges 01 12 20 34 45 53 03 14 25 and amid "
                             "0143 1254 2035; (0, 12) where linear")
      .def_readonly("faces", &MixedMesh::faces, "A list of Face.")
      .def_property_readonly("quadratic", &MixedMesh::quadratic, "Whether it has nodes of the second order.")
      .def("__repr__", [](const MixedMesh& v) {
        return py::str("<ostia.MixedMesh: {} points, {} tetrahedra, {} prisms, {} faces{}>")
            .format(v.points.size(), v.tetrahedra.size(), v.prisms.size(), v.faces.size(),
                    v.quadratic() ? ", quadratic" : "");
      });
  mixed.def(py::pickle(py::overload_cast<const MixedMesh&>(&state_of), &mixed_of_state));
  same_when_copied(mixed);
}

}  // namespace

void bind_geometry(py::module_& m) {
  bind_surface(m);
  bind_faces(m);
  bind_volumes(m);
  bind_trees(m);
  bind_graphs(m);
  bind_contours(m);
}

}  // namespace ostia::python
