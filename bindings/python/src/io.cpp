#include "array.h"
#include "call.h"
#include "meshes.h"
#include "rooms.h"

#include "ostia/core/log.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_fields.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

namespace ostia::python {
namespace {

namespace fs = std::filesystem;
using core::TaskContext;

void warn(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) core::log_warning(text);
}

io::LoadedSurface loaded(const fs::path& path, const py::object& progress) {
  return watched(progress, [&](const TaskContext&) {
    io::LoadedSurface found = io::read_surface(path);
    warn(found.warnings);
    return found;
  });
}

void bind_surfaces(py::module_& m) {
  m.def(
      "read_surface",
      [](const fs::path& path, const py::object& progress) {
        return std::move(loaded(path, progress).surface.mesh);
      },
      py::arg("path"), py::kw_only(), py::arg("progress") = py::none(),
      "A surface as its file has it: STL, PLY, OBJ, VTP or VTK.");
  m.def(
      "read_faced_surface",
      [](const fs::path& path, const py::object& progress) {
        return std::move(loaded(path, progress).surface);
      },
      py::arg("path"), py::kw_only(), py::arg("progress") = py::none(),
      "The same with its faces; none where the file has none.");
  m.def(
      "write_surface",
      [](const fs::path& path, const geometry::TriMesh& surface) {
        require_indices(surface);
        unlocked([&] { io::write_surface(path, surface); });
      },
      py::arg("path"), py::arg("surface"), "By extension, .vtp, .stl or .ply; whole or not at all.");
  m.def(
      "write_surface",
      [](const fs::path& path, const geometry::FacedSurface& surface) {
        unlocked([&] { io::write_surface(path, surface); });
      },
      py::arg("path"), py::arg("surface"));
}

/// (n,) or (n, components).
py::array array_of(const io::FieldValues& field) {
  const py::ssize_t rows = static_cast<py::ssize_t>(field.values.size()) / field.components;
  py::array_t<double> array = field.components == 1
                                  ? py::array_t<double>(rows)
                                  : py::array_t<double>({rows, static_cast<py::ssize_t>(field.components)});
  std::copy(field.values.begin(), field.values.end(), array.mutable_data());
  return array;
}

io::FieldValues field_of(const std::string& name, const py::object& given) {
  const py::ssize_t dimensions = py::module_::import("numpy").attr("ndim")(given).cast<py::ssize_t>();
  const std::vector<py::ssize_t> shape =
      dimensions == 1 ? std::vector<py::ssize_t>{-1} : std::vector<py::ssize_t>{-1, -1};
  const py::array array = taken(given, {"fields['" + name + "']", 'f', 8, shape}, {true, true});
  const auto* first = static_cast<const double*>(array.data());
  return {dimensions == 1 ? 1 : static_cast<int>(array.shape(1)), {first, first + array.size()}};
}

void bind_fields(py::module_& m) {
  m.def(
      "read_surface_fields",
      [](const fs::path& path) {
        const io::SurfaceWithFields found = unlocked([&] { return io::read_surface_with_fields(path); });
        py::dict points, triangles;
        for (const auto& [name, field] : found.points) points[name.c_str()] = array_of(field);
        for (const auto& [name, field] : found.triangles) triangles[name.c_str()] = array_of(field);
        return py::make_tuple(std::make_shared<geometry::TriMesh>(found.mesh), points, triangles);
      },
      py::arg("path"),
      "(surface, fields at points, fields on triangles) of a VTP or VTK file; fields by name.");
  m.def(
      "write_surface_fields",
      [](const fs::path& path, const geometry::TriMesh& surface, const py::dict& fields) {
        require_indices(surface);
        io::PointFields values;
        for (const auto& [key, value] : fields) {
          const std::string name = py::str(key);
          values[name] = field_of(name, py::reinterpret_borrow<py::object>(value));
        }
        unlocked([&] { io::write_vtp_with_fields(path, {surface, {}, {}}, values); });
      },
      py::arg("path"), py::arg("surface"), py::arg("fields"),
      "VTP with arrays at its points, (n,) or (n, k).");
}

void bind_lines(py::module_& m) {
  m.def(
      "read_centerlines",
      [](const fs::path& path) { return unlocked([&] { return io::read_centerlines(path); }); },
      py::arg("path"), "A tree of centerlines: VTP, VTK, CSV, markups, SWC ...");
  m.def(
      "write_centerlines",
      [](const fs::path& path, const geometry::VesselTree& tree) {
        unlocked([&] { io::write_centerlines(path, tree); });
      },
      py::arg("path"), py::arg("tree"), ".vtp, .csv or .mrk.json.");
}

void bind_graph_files(py::module_& m) {
  m.def(
      "read_graph",
      [](const fs::path& path, const py::object& progress) {
        return watched(progress, [&](const TaskContext& task) {
          io::LoadedGraph found = io::read_graph(path, task);
          warn(found.warnings);
          return std::move(found.graph);
        });
      },
      py::arg("path"), py::kw_only(), py::arg("progress") = py::none(),
      "A network as its file has it: VTP, VTK, SWC, CSV, GXL, OpenCCO's tables.");
  m.def(
      "write_graph",
      [](const fs::path& path, const geometry::VesselGraph& graph, const py::object& progress) {
        return watched(progress, [&](const TaskContext& task) { return io::write_graph(path, graph, task); });
      },
      py::arg("path"), py::arg("graph"), py::kw_only(), py::arg("progress") = py::none(),
      ".vtp, .swc or .csv; returns what the format could not hold.");
}

void bind_volume_meshes(py::module_& m) {
  m.def(
      "read_volume_mesh",
      [](const fs::path& path, const py::object& progress) {
        return watched(progress, [&](const TaskContext&) { return io::read_volume_mesh(path); });
      },
      py::arg("path"), py::kw_only(), py::arg("progress") = py::none(),
      "Tetrahedra and prisms: VTU, Gmsh, Fluent, OpenFOAM's folder, Exodus, Abaqus, CGNS, XDMF.");
  m.def(
      "export_mesh",
      [](const fs::path& path, const geometry::MixedMesh& mesh, const std::string& format,
         const py::object& progress) {
        const io::MeshFormat as = io::mesh_format(format);
        watched(progress, [&](const TaskContext&) {
          const io::MeshExportResult result = io::export_mesh(mesh, as, path);
          warn(result.warnings);
          return 0;
        });
      },
      py::arg("path"), py::arg("mesh"), py::arg("format") = "vtu", py::kw_only(),
      py::arg("progress") = py::none(), "As one of mesh_formats; a file or a folder, whole or not at all.");
  py::list names;
  for (const io::MeshFormat format : io::mesh_formats) names.append(std::string(io::name_of(format)));
  m.attr("mesh_formats") = py::tuple(names);
}

}  // namespace

void bind_io(py::module_& m) {
  bind_surfaces(m);
  bind_fields(m);
  bind_lines(m);
  bind_graph_files(m);
  bind_volume_meshes(m);
}

}  // namespace ostia::python
