#include "array.h"
#include "call.h"
#include "graphs.h"
#include "meshes.h"
#include "options.h"
#include "rooms.h"
#include "trees.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/smoothing.h"

#include <pybind11/stl.h>

namespace ostia::python {

OSTIA_OPTIONS(geometry::TaubinOptions, (iterations, pass_band, lambda), ())

namespace {

using geometry::FacedSurface;
using geometry::MixedMesh;
using geometry::TriMesh;
using geometry::VolumeMesh;
using Meshes = py::class_<TriMesh, std::shared_ptr<TriMesh>>;

/// A member that is a vector, as a read-only view that keeps the object alive.
template <class T, class Member>
auto view(Member T::*member) {
  return [member](const py::object& self) { return view_of(self.cast<const T&>().*member, self); };
}

std::string size_text(const std::vector<geometry::Vec3>& points) {
  geometry::Box3 box;
  for (const geometry::Vec3& p : points) box.extend(p);
  if (box.isEmpty()) return "empty";
  const geometry::Vec3 size = box.sizes();
  return py::str("{:.4g} x {:.4g} x {:.4g} mm").format(size.x(), size.y(), size.z()).cast<std::string>();
}

/// Immutable values: a copy is the same.
template <class Class>
void same_when_copied(Class& type) {
  type.def("__copy__", [](const py::object& self) { return self; });
  type.def(
      "__deepcopy__", [](const py::object& self, const py::object&) { return self; }, py::arg("memo"));
}

void bind_surface(py::module_& m) {
  Meshes mesh(
      m, "TriMesh",
      "A triangle surface: points (n, 3), mm LPS, and triangles (m, 3), counter-clockwise from outside. Both "
      "are one memory with the arrays given; immutable.");
  mesh.def(py::init(&mesh_of), py::arg("points"), py::arg("triangles"), py::kw_only(),
           py::arg("copy") = py::none())
      .def_property_readonly("points", view(&TriMesh::points), "(n, 3) float64, mm, LPS")
      .def_property_readonly("triangles", view(&TriMesh::triangles), "(m, 3) int32")
      .def_property_readonly(
          "area", [](const TriMesh& s) { return geometry::area(s); }, "mm2")
      .def_property_readonly(
          "volume", [](const TriMesh& s) { return geometry::volume(s); }, "mm3, of a closed one")
      .def_property_readonly("closed", [](const TriMesh& s) { return geometry::boundary_loops(s).empty(); })
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
  m.def(
      "example_surface",
      [](double spacing_mm, bool open_ends) {
        return unlocked(
            [&] { return geometry::surface_of(geometry::coronary_like_tree(), spacing_mm, open_ends); });
      },
      py::arg("spacing_mm") = 0.3, py::arg("open_ends") = true,
      "The lumen of a tree like a coronary one, a root and three branches, whose axes are known exactly.");
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
      .def_readonly("name", &geometry::Face::name)
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
      m, "FacedSurface", "A surface whose triangles belong to named faces.");
  faced.def(py::init(make), py::arg("mesh"), py::arg("face_ids"), py::arg("faces"))
      .def_property_readonly("mesh",
                             [](const py::object& self) {
                               // Shares the memory of this object, and keeps it alive.
                               auto* surface = self.cast<FacedSurface*>();
                               auto owner = std::make_shared<Held>(self);
                               return std::shared_ptr<TriMesh>(&surface->mesh, [owner](TriMesh*) {});
                             })
      .def_property_readonly("face_ids", view(&FacedSurface::face_ids), "one a triangle")
      .def_readonly("faces", &FacedSurface::faces)
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

void bind_volumes(py::module_& m) {
  py::class_<VolumeMesh, std::shared_ptr<VolumeMesh>> tetrahedra(m, "VolumeMesh",
                                                                 "Tetrahedra with their boundary.");
  tetrahedra.def_property_readonly("points", view(&VolumeMesh::points), "(n, 3) float64, mm, LPS")
      .def_property_readonly("tetrahedra", view(&VolumeMesh::tetrahedra), "(m, 4) int32")
      .def_property_readonly("boundary", view(&VolumeMesh::boundary), "(k, 3) int32, outward")
      .def_property_readonly("boundary_face_ids", view(&VolumeMesh::boundary_face_ids))
      .def_readonly("faces", &VolumeMesh::faces)
      .def(
          "mixed", [](const VolumeMesh& mesh) { return std::make_shared<MixedMesh>(geometry::mixed(mesh)); },
          "The same as a MixedMesh.")
      .def("__repr__", [](const VolumeMesh& v) {
        return py::str("<ostia.VolumeMesh: {} points, {} tetrahedra, {} faces>")
            .format(v.points.size(), v.tetrahedra.size(), v.faces.size());
      });
  same_when_copied(tetrahedra);
  py::class_<MixedMesh, std::shared_ptr<MixedMesh>> mixed(
      m, "MixedMesh", "Tetrahedra and prisms, linear or quadratic, with their whole boundary.");
  mixed.def_property_readonly("points", view(&MixedMesh::points), "(n, 3) float64, mm, LPS")
      .def_property_readonly("tetrahedra", view(&MixedMesh::tetrahedra), "(m, 4) int32")
      .def_property_readonly("prisms", view(&MixedMesh::prisms), "(m, 6) int32")
      .def_property_readonly("triangles", view(&MixedMesh::triangles),
                             "of the boundary, (k, 3) int32, outward")
      .def_property_readonly("triangle_face_ids", view(&MixedMesh::triangle_face_ids))
      .def_property_readonly("quads", view(&MixedMesh::quads), "of the boundary, (k, 4) int32")
      .def_property_readonly("quad_face_ids", view(&MixedMesh::quad_face_ids))
      .def_property_readonly("tetrahedron_nodes", view(&MixedMesh::tetrahedron_nodes),
                             "(m, 6) int32, or (0, 6)")
      .def_property_readonly("prism_nodes", view(&MixedMesh::prism_nodes), "(m, 12) int32, or (0, 12)")
      .def_readonly("faces", &MixedMesh::faces)
      .def_property_readonly("quadratic", &MixedMesh::quadratic)
      .def("__repr__", [](const MixedMesh& v) {
        return py::str("<ostia.MixedMesh: {} points, {} tetrahedra, {} prisms, {} faces{}>")
            .format(v.points.size(), v.tetrahedra.size(), v.prisms.size(), v.faces.size(),
                    v.quadratic() ? ", quadratic" : "");
      });
  same_when_copied(mixed);
}

}  // namespace

void bind_geometry(py::module_& m) {
  bind_surface(m);
  bind_faces(m);
  bind_volumes(m);
  bind_trees(m);
  bind_graphs(m);
}

}  // namespace ostia::python
