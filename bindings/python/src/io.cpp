#include "array.h"
#include "call.h"
#include "fields.h"
#include "meshes.h"
#include "rooms.h"
#include "values.h"

#include "ostia/core/log.h"
#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/markups_file.h"
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
  return watched_or_left(progress, [path](const TaskContext&) {
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
        watched_or_left(py::none(), [path, surface = kept(surface)](const TaskContext&) {
          io::write_surface(path, *surface);
        });
      },
      py::arg("path"), py::arg("surface"), "By extension, .vtp, .stl or .ply; whole or not at all.");
  m.def(
      "write_surface",
      [](const fs::path& path, const geometry::FacedSurface& surface) {
        watched_or_left(py::none(), [path, surface = kept(surface)](const TaskContext&) {
          io::write_surface(path, *surface);
        });
      },
      py::arg("path"), py::arg("surface"));
}

void bind_fields(py::module_& m) {
  m.def(
      "read_surface_fields",
      [](const fs::path& path) {
        auto found = watched_or_left(
            py::none(), [path](const TaskContext&) { return io::read_surface_with_fields(path); });
        return py::make_tuple(std::make_shared<geometry::TriMesh>(std::move(found.mesh)),
                              field_arrays(found.points), field_arrays(found.triangles));
      },
      py::arg("path"),
      "(surface, fields at points, fields on triangles) of a VTP or VTK file; fields by name, (n,) or (n, "
      "k), in the file's own units.");
  m.def(
      "write_surface_fields",
      [](const fs::path& path, const geometry::TriMesh& surface, const py::dict& fields) {
        require_indices(surface);
        watched_or_left(py::none(),
                        [path, surface = kept(surface), values = fields_of(fields)](const TaskContext&) {
                          io::write_vtp_with_fields(path, {*surface, {}, {}}, values);
                        });
      },
      py::arg("path"), py::arg("surface"), py::arg("fields"),
      "VTP with arrays at its n points, (n,) or (n, k), in any unit.");
  m.def(
      "read_mesh_fields",
      [](const fs::path& path) {
        const auto found =
            watched_or_left(py::none(), [path](const TaskContext&) { return io::read_vtu_fields(path); });
        return py::make_tuple(field_arrays(found.cells), field_arrays(found.points));
      },
      py::arg("path"),
      "(fields at elements, tetrahedra first, fields at points) of a VTU file; by name, (n,) or (n, k), in "
      "the file's own units.");
  m.def(
      "write_mesh_fields",
      [](const fs::path& path, const geometry::MixedMesh& mesh, const py::dict& cells,
         const py::dict& points) {
        watched_or_left(
            py::none(),
            [path, mesh = kept(mesh), fields = io::VolumeFields{fields_of(cells), fields_of(points)}](
                const TaskContext&) { io::write_vtu_with_fields(path, *mesh, fields); });
      },
      py::arg("path"), py::arg("mesh"), py::arg("cells") = py::dict(), py::arg("points") = py::dict(),
      "VTU with arrays at its elements (tetrahedra, then prisms) and points, (n,) or (n, k), in any unit.");
}

void bind_lines(py::module_& m) {
  m.def(
      "read_centerlines",
      [](const fs::path& path) {
        return watched_or_left(py::none(), [path](const TaskContext&) { return io::read_centerlines(path); });
      },
      py::arg("path"), "A tree of centerlines: VTP, VTK, CSV, markups, SWC ...");
  m.def(
      "write_centerlines",
      [](const fs::path& path, const geometry::VesselTree& tree) {
        watched_or_left(py::none(), [path, tree = kept(tree)](const TaskContext&) {
          io::write_centerlines(path, *tree);
        });
      },
      py::arg("path"), py::arg("tree"), ".vtp, .csv or .mrk.json.");
  m.def(
      "read_contours",
      [](const fs::path& path) {
        return watched_or_left(py::none(), [path](const TaskContext&) { return io::read_contours(path); });
      },
      py::arg("path"), "A ContourSet of a contours.json.");
  m.def(
      "write_contours",
      [](const fs::path& path, const geometry::ContourSet& contours) {
        watched_or_left(py::none(), [path, contours = kept(contours)](const TaskContext&) {
          io::write_contours(path, *contours);
        });
      },
      py::arg("path"), py::arg("contours"), "contours.json; whole or not at all.");
}

const char* word(io::MarkupKind kind) {
  switch (kind) {
    case io::MarkupKind::line:
      return "line";
    case io::MarkupKind::curve:
      return "curve";
    case io::MarkupKind::closed_curve:
      return "closed_curve";
    default:
      return "fiducials";
  }
}

py::dict shown(const io::Markup& one) {
  using py::literals::operator""_a;
  return py::dict("kind"_a = word(one.kind), "name"_a = one.name, "points"_a = array_of(one.points),
                  "labels"_a = one.labels, "radius"_a = array_of(one.radius));
}

io::Markup markup_of(const py::dict& given, std::size_t number) {
  const std::string name = "markups[" + std::to_string(number) + "]";
  if (!given.contains("points")) throw InvalidInput(name + ": it has no points, (n, 3)");
  io::Markup one;
  one.points = places_of(given["points"], name + ".points");
  if (given.contains("name")) one.name = given["name"].cast<std::string>();
  if (given.contains("labels")) one.labels = given["labels"].cast<std::vector<std::string>>();
  if (given.contains("radius")) one.radius = numbers_of(given["radius"], name + ".radius");
  const std::string kind = given.contains("kind") ? given["kind"].cast<std::string>() : "fiducials";
  for (const auto known :
       {io::MarkupKind::fiducials, io::MarkupKind::line, io::MarkupKind::curve, io::MarkupKind::closed_curve})
    if (kind == word(known)) {
      one.kind = known;
      return one;
    }
  throw InvalidInput(name + ".kind: fiducials, line, curve or closed_curve, not " + kind);
}

void bind_markups(py::module_& m) {
  m.def(
      "read_markups",
      [](const fs::path& path) {
        const auto found = watched_or_left(py::none(), [path](const TaskContext&) {
          io::MarkupsFile file = io::read_markups(path);
          warn(file.warnings);
          return file;
        });
        py::list rows;
        for (const io::Markup& one : found.markups) rows.append(shown(one));
        return rows;
      },
      py::arg("path"),
      "Points, lines and curves that a person placed (.mrk.json, .fcsv, .csv, .tsv): a dictionary each with "
      "kind, "
      "name, points (n, 3), labels, radius (n,); mm, LPS where the file says so.");
  m.def(
      "write_markups",
      [](const fs::path& path, const py::sequence& markups) {
        std::vector<io::Markup> all;
        for (const py::handle one : markups) {
          if (!py::isinstance<py::dict>(one)) throw InvalidInput("markups: a list of dictionaries");
          all.push_back(markup_of(py::reinterpret_borrow<py::dict>(one), all.size()));
        }
        unlocked([&] { io::write_markups(path, all); });
      },
      py::arg("path"), py::arg("markups"), "The same, .mrk.json or .fcsv, mm, LPS; whole or not at all.");
  m.def(
      "landmarks",
      [](const geometry::VesselTree& tree) {
        py::list rows;
        for (const io::Markup& one : io::landmarks_of(tree)) rows.append(shown(one));
        return rows;
      },
      py::arg("tree"), "Where vessels begin, divide and end, as read_markups has them.");
}

std::vector<io::SegmentValues> segment_values_of(const py::dict& given) {
  std::vector<io::SegmentValues> values;
  for (const auto& [key, one] : given) {
    const std::string name = py::str(key);
    values.push_back(
        {name, whole_numbers_of(py::reinterpret_borrow<py::object>(one), "values['" + name + "']")});
  }
  return values;
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
      [](const fs::path& path, const geometry::VesselGraph& graph, const py::dict& values,
         const py::object& progress) {
        const auto beside = segment_values_of(values);
        return watched(progress,
                       [&](const TaskContext& task) { return io::write_graph(path, graph, beside, task); });
      },
      py::arg("path"), py::arg("graph"), py::arg("values") = py::dict(), py::kw_only(),
      py::arg("progress") = py::none(),
      ".vtp, .swc or .csv; values: whole numbers of its m edges by name, (m,). Returns what the format could "
      "not "
      "hold.");
}

void bind_volume_meshes(py::module_& m) {
  m.def(
      "read_volume_mesh",
      [](const fs::path& path, const py::object& progress) {
        return watched_or_left(progress, [path](const TaskContext&) { return io::read_volume_mesh(path); });
      },
      py::arg("path"), py::kw_only(), py::arg("progress") = py::none(),
      "Tetrahedra and prisms: VTU, Gmsh, Fluent, OpenFOAM's folder, Exodus, Abaqus, CGNS, XDMF.");
  m.def(
      "export_mesh",
      [](const fs::path& path, const geometry::MixedMesh& mesh, const std::string& format,
         const py::object& progress) {
        const io::MeshFormat as = io::mesh_format(format);
        watched_or_left(progress, [path, as, mesh = kept(mesh)](const TaskContext&) {
          warn(io::export_mesh(*mesh, as, path).warnings);
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
  bind_markups(m);
  bind_graph_files(m);
  bind_volume_meshes(m);
}

}  // namespace ostia::python
