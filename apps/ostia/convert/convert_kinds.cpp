#include "convert/convert_kinds.h"

#include "motion/motion_input.h"
#include "options/model_options.h"
#include "output/outputs.h"

#include "ostia/core/log.h"
#include "ostia/geometry/graph_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/mixed_mesh_split.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/mesh_export.h"
#include "ostia/io/surface_file.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/session/case_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using ConvertJson = nlohmann::ordered_json;

void refuse_repairs(const ConvertCommand& o, const std::string& what) {
  if (o.tree.repair || o.keep_parts || o.largest_part || o.fill_holes_mm > 0.0 || o.smooth > 0 ||
      o.subdivide > 0)
    throw UsageError(
        "--repair, --fill-holes, --keep-parts, --smooth and --subdivide are for surfaces and trees, "
        "and this is " +
        what);
}

ConvertJson from_case(const ConvertCommand& o, const core::TaskContext& task) {
  refuse_repairs(o, "a case");
  if (!o.input.units.empty()) throw UsageError("--units is for surfaces: a case is in mm");
  require_output(o.output, {".stl", ".ply", ".vtp", ".csv", ".swc"});
  const auto model = session::CaseFile::open(o.input.input, session::OpenMode::read_only).model();
  if (has_extension(o.output, {".stl", ".ply"})) {
    const geometry::TriMesh wall = lumen::surface_of(*model, 0.0, task);
    io::write_surface(o.output, wall);
    return {{"points", wall.points.size()}, {"triangles", wall.triangles.size()}};
  }
  const geometry::VesselGraph graph = geometry::graph_of(model->tree);
  if (has_extension(o.output, {".swc"})) {
    for (const std::string& lost : io::write_graph(o.output, graph, task)) core::log_warning(lost);
  } else {
    io::write_centerlines(o.output, model->tree);
  }
  return {{"points", graph.points.size()}, {"segments", graph.edges.size()}};
}

/// Extensions of volume meshes with what they mean where that could be several formats: ".vtu, .msh (Gmsh
/// 4.1), ...".
std::string mesh_extensions() {
  std::string all;
  for (const io::MeshFormat format : io::mesh_formats) {
    const std::string_view extension = io::extension_of(format);
    if (extension.empty() || io::usual_mesh_format(extension) != format) continue;
    all += (all.empty() ? "" : ", ") + std::string(extension);
    if (io::shares_extension(format)) all += " (" + std::string(io::title_of(format)) + ")";
  }
  return all;
}

/// What is written as a file or folder of this name.
io::MeshFormat format_of(const ConvertCommand& o) {
  if (!o.format.empty()) return io::mesh_format(o.format);
  if (const auto usual = io::usual_mesh_format(o.output.extension().string())) return *usual;
  throw UsageError("cannot write " + o.output.string() + ": a volume mesh becomes " + mesh_extensions() +
                   ", or a folder (" + std::string(io::title_of(*io::usual_mesh_format(""))) +
                   "; --format for others), its boundary .stl, .ply or .vtp");
}

geometry::FacedSurface boundary_of(const geometry::MixedMesh& mesh) {
  geometry::FacedSurface surface;
  surface.mesh = {mesh.points, mesh.triangles};
  surface.face_ids = mesh.triangle_face_ids;
  surface.faces = mesh.faces;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    for (const geometry::Triangle& half : geometry::split_quad(mesh.quads[q])) {
      surface.mesh.triangles.push_back(half);
      surface.face_ids.push_back(mesh.quad_face_ids[q]);
    }
  surface.mesh = geometry::subset(surface.mesh, std::vector<bool>(surface.mesh.triangles.size(), true));
  return surface;
}

ConvertJson from_mesh(const ConvertCommand& o) {
  refuse_repairs(o, "a volume mesh");
  const bool as_surface = o.format.empty() && has_extension(o.output, surface_outputs);
  const io::MeshFormat format = as_surface ? io::MeshFormat::vtu : format_of(o);
  io::LayeredMesh read = io::read_layered_mesh(o.input.input);
  if (const auto unit_mm = source_options(o.input).unit_mm)
    for (geometry::Vec3& p : read.mesh.points) p *= *unit_mm;
  if (read.hexahedra > 0)
    core::log_info("its " + std::to_string(read.hexahedra) + " hexahedra are two prisms each");
  if (as_surface) {
    const geometry::FacedSurface surface = boundary_of(read.mesh);
    if (has_extension(o.output, {".vtp"}))
      io::write_surface(o.output, surface);
    else
      io::write_surface(o.output, surface.mesh);
    return {{"points", surface.mesh.points.size()}, {"triangles", surface.mesh.triangles.size()}};
  }
  const auto made = io::export_mesh(read.mesh, format, o.output,
                                    {.title = "mesh", .layer_tetrahedra = layers_at_end(read)});
  for (const std::string& warning : made.warnings) core::log_warning(warning);
  return {{"points", read.mesh.points.size()},
          {"tetrahedra", read.mesh.tetrahedra.size()},
          {"prisms", read.mesh.prisms.size()},
          {"format", io::name_of(format)}};
}

}  // namespace

bool converts_own_kind(const ConvertCommand& o) {
  return o.input.input.extension() == ".ostia" || io::is_volume_mesh(o.input.input);
}

ExitCode convert_own_kind(const ConvertCommand& o, const core::TaskContext& task) {
  ConvertJson done{{"v", 1}, {"kind", "conversion"}};
  done.update(o.input.input.extension() == ".ostia" ? from_case(o, task) : from_mesh(o));
  if (o.json) std::fputs((done.dump(2) + "\n").c_str(), stdout);
  return ExitCode::ok;
}

}  // namespace ostia::app
