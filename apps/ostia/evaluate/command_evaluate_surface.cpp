#include "evaluate/covered_region.h"
#include "evaluate/evaluate.h"
#include "output/outputs.h"

#include "ostia/core/log.h"
#include "ostia/evaluation/distance_picture.h"
#include "ostia/evaluation/frame_hint.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/evaluation/surface_shape.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/plot.h"
#include "ostia/geometry/mesh_topology.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::app {
namespace {

using evaluation::Region;
using geometry::TriMesh;

const std::vector<std::string> surface_names{"lumen.vtp", "lumen.stl", "lumen.ply"};
const std::vector<std::string> line_names{"centerlines.vtp", "centerlines.csv"};

void add_curvatures(Json& to, const TriMesh& mesh, const core::TaskContext& task) {
  const evaluation::SurfaceShape shape = evaluation::shape_of(mesh, task);
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  to["rms_kappa1_per_mm"] = number(shape.rms_kappa1);
  to["rms_kappa2_per_mm"] = number(shape.rms_kappa2);
  to["rms_curvature_per_mm"] = number(shape.rms_curvature);
}

Json facts(const TriMesh& mesh) {
  const geometry::SurfaceFaults faults = geometry::find_faults(mesh, false);
  return {{"triangles", mesh.triangles.size()},
          {"area_mm2", geometry::area(mesh)},
          {"open_edges", faults.open_edges},
          {"non_manifold_edges", faults.non_manifold_edges}};
}

Region region_of(const EvaluateCommand& command, const std::filesystem::path& result) {
  if (!command.covered_only) return {};
  if (!std::filesystem::is_directory(result))
    throw UsageError("--covered needs the folder of a model as RESULT: its centerlines tell what it covers");
  return covered_region(lines_of_parts(files_in(result, line_names, "centerlines"), command.units));
}

/// The part of a surface whose triangles all lie where the region counts.
TriMesh part_in(const TriMesh& mesh, const Region& region) {
  if (!region) return mesh;
  std::vector<bool> keep;
  keep.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    bool all = true;
    for (const std::int32_t corner : t) all = all && region(mesh.points[static_cast<std::size_t>(corner)]);
    keep.push_back(all);
  }
  return geometry::subset(mesh, keep);
}

void write_page(const std::filesystem::path& path, const figure::Picture& coloured,
                const std::vector<double>& distances, const std::string& text) {
  figure::HtmlReport page("Surface against its reference");
  page.section("Figures");
  page.paragraph(
      "Exact distances from point to triangle, both ways, weighted by area; signed values are positive "
      "where the result lies outside the reference.");
  std::vector<std::pair<std::string, std::string>> rows;
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t to = text.find('\n', from), blank = text.find("  ", from);
    if (blank < to)
      rows.emplace_back(
          text.substr(from, blank - from),
          text.substr(text.find_first_not_of(' ', blank), to - text.find_first_not_of(' ', blank)));
    from = to + 1;
  }
  page.key_values(rows);
  page.section("Where they differ");
  page.picture(coloured, "The result, coloured by its signed distance from the reference.");
  figure::PlotOptions how;
  how.x_label = "signed distance (mm), positive outside";
  how.y_label = "triangles";
  page.picture(figure::histogram_plot(figure::histogram(distances, 80), how),
               "Distribution of the signed distance over the result's triangles.");
  page.write(path);
}

void write_pictures(const EvaluateCommand& command, const TriMesh& reference, const TriMesh& result,
                    const Region& region, const std::string& text, const core::TaskContext& task) {
  if (command.report.empty() && command.picture.empty()) return;
  task.set_stage("pictures");
  const TriMesh shown = part_in(result, region);
  const std::vector<double> distances = evaluation::signed_distances(reference, shown, task);
  const figure::Picture coloured = evaluation::distance_figure(shown, distances, {}, task);
  if (!command.picture.empty()) coloured.write(command.picture);
  if (!command.report.empty()) write_page(command.report, coloured, distances, text);
}

Json figures(const evaluation::SurfaceDistances& d) {
  return {
      {"msd_mm", d.msd_mm},          {"rms_sd_mm", d.rms_sd_mm},           {"hd95_mm", d.hd95_mm},
      {"hausdorff_mm", d.max_sd_mm}, {"signed_mean_mm", d.signed_mean_mm}, {"signed_sd_mm", d.signed_sd_mm}};
}

}  // namespace

ExitCode run_evaluate_surface(const EvaluateCommand& command, const core::TaskContext& task) {
  require_pair(command);
  require_output(command.report, {".html", ".htm"});
  require_output(command.picture, {".png", ".svg", ".pdf"});
  const TriMesh reference = surface_from(file_in(command.reference, surface_names, "surface"), command.units);
  const TriMesh result = surface_of_parts(files_in(command.result, surface_names, "surface"), command.units);
  const std::string hint = evaluation::hint_of_other_frame(reference.points, result.points);
  if (!hint.empty() && !command.covered_only) core::log_warning(hint);
  const Region region = region_of(command, command.result);
  task.set_stage("distances");
  const auto distances = evaluation::compare_surfaces(reference, result, {command.sample_mm, region, region},
                                                      task.sub(0.0, 0.8));
  Json out{{"v", 1}, {"kind", "surface"}};
  out["reference"] = facts(reference);
  out["result"] = facts(result);
  if (command.curvature) {
    add_curvatures(out["reference"], reference, task);
    add_curvatures(out["result"], result, task);
  }
  out["covered_only"] = command.covered_only;
  out.update(figures(distances));
  out["warnings"] = hint.empty() ? Json::array() : Json::array({hint});
  write_pictures(command, reference, result, region, table_text(out), task.sub(0.8, 1.0));
  task.set_progress(1.0);
  return finish(command, out);
}

}  // namespace ostia::app
