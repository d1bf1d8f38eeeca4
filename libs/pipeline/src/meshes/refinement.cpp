#include "ostia/pipeline/refinement.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/volume_fields.h"
#include "ostia/io/volume_mesh_file.h"

#include <algorithm>
#include <cstdio>

namespace ostia::pipeline {
namespace fs = std::filesystem;
namespace {

fs::path file_of(const RefinementOptions& options) {
  if (options.field.empty()) throw InvalidInput("refinement: which field? --by NAME, such as velocity_m_s");
  std::error_code error;
  const fs::path file =
      fs::is_directory(options.result, error) ? options.result / "result.vtu" : options.result;
  if (file.extension() != ".vtu")
    throw InvalidInput("cannot refine by " + file.string() +
                       ": a result is a VTU file; `ostia result CASE -o DIR` makes one of a solved case");
  if (!fs::exists(file, error))
    throw InvalidInput("cannot refine by " + file.string() + ": there is no such file");
  return file;
}

std::string names_of(const std::map<std::string, io::FieldValues>& fields) {
  std::string names;
  for (const auto& [name, values] : fields) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

meshing::MeshField field_of(const fs::path& file, const std::string& name) {
  io::VolumeFields fields = io::read_vtu_fields(file);
  const auto taken = [&](io::FieldValues& values, bool at_elements) {
    return meshing::MeshField{values.components, at_elements, std::move(values.values)};
  };
  // A solver of finite volumes computes those of cells; at points stand their means, which are blunter.
  if (const auto at = fields.cells.find(name); at != fields.cells.end()) return taken(at->second, true);
  if (const auto at = fields.points.find(name); at != fields.points.end()) return taken(at->second, false);
  throw InvalidInput(file.string() + " has no field " + name + "; in its cells it has " +
                     names_of(fields.cells) + ", at its points " + names_of(fields.points));
}

/// Flow extensions and cut ends make the two differ; they overlap all the same, and are about as large.
void require_same_place(const fs::path& file, const geometry::MixedMesh& mesh, const geometry::Box3& box) {
  const geometry::Box3 result = geometry::bounds(mesh.points);
  const double size = result.diagonal().norm(), wanted = box.diagonal().norm();
  constexpr double metres = 1e-3, tolerance = 5.0, most_ratio = 20.0;
  const auto near = [&](double ratio) {
    return size > wanted * ratio / tolerance && size < wanted * ratio * tolerance;
  };
  char text[300];
  std::snprintf(
      text, sizeof text,
      ": the result reaches over %.3g x %.3g x %.3g mm from %.4g,%.4g,%.4g, the surface over %.3g x %.3g x "
      "%.3g mm from %.4g,%.4g,%.4g",
      result.sizes().x(), result.sizes().y(), result.sizes().z(), result.min().x(), result.min().y(),
      result.min().z(), box.sizes().x(), box.sizes().y(), box.sizes().z(), box.min().x(), box.min().y(),
      box.min().z());
  if (near(metres))
    throw InvalidInput("cannot refine by " + file.string() + text +
                       "; it seems to be in metres: scale its points by 1000");
  if (!result.intersects(box) || size * most_ratio < wanted || size > most_ratio * wanted)
    throw InvalidInput("cannot refine by " + file.string() + text + "; it is of another vessel");
}

}  // namespace

Refinement refinement_by(const RefinementOptions& options, const geometry::Box3& box,
                         const core::TaskContext& task) {
  meshing::validate(options.sizing);
  const fs::path file = file_of(options);
  task.set_stage("reading the result");
  const geometry::MixedMesh mesh = io::read_volume_mesh(file);
  require_same_place(file, mesh, box);
  const meshing::MeshField field = field_of(file, options.field);
  meshing::FieldSizing made = meshing::sizes_from_field(mesh, field, options.sizing, task.sub(0.2, 1.0));
  const auto [least, largest] = std::ranges::minmax(made.sizes.edge_mm);
  Refinement out;
  out.report = {options.field,
                field.at_elements,
                options.sizing,
                made.range,
                made.largest_error,
                made.target_error,
                made.reached_error,
                made.refined_share,
                made.held_share,
                least,
                largest,
                made.elements_before,
                made.elements,
                0};
  out.warnings = std::move(made.warnings);
  out.sizes = std::make_shared<const meshing::SizeField>(std::move(made.sizes));
  return out;
}

}  // namespace ostia::pipeline
