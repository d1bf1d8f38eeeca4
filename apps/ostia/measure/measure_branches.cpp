#include "measure/measure_branches.h"

#include "input/points.h"
#include "options/model_options.h"

#include "ostia/core/log.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/surface_fields.h"
#include "ostia/lumen/tree_surface.h"
#include "ostia/pipeline/source.h"
#include "ostia/session/case_file.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <set>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;

bool is_case(const MeasureCommand& c) {
  return c.input.input.extension() == ".ostia";
}
bool is_surface(const MeasureCommand& c) {
  return !is_case(c) && !io::is_graph_file(c.input.input);
}

geometry::BranchedLines branched_lines(const MeasureCommand& c, const geometry::VesselTree& tree) {
  const fs::path& lines = c.centerline.empty() ? c.input.input : c.centerline;
  if (!is_surface(c) || !c.centerline.empty()) {
    if (auto split = io::read_branched_lines(lines)) return std::move(*split);
  }
  return geometry::branch_groups(tree);
}

/// What the mapping itself calls so.
const std::set<std::string> names_taken{"GroupIds",        "AbscissaMetric",   "AngularMetric",
                                        "HarmonicMapping", "StretchedMapping", "DistanceToCenterlines"};

/// The arrays are those of the file's own points: with arrays the surface is taken as its file has it.
pipeline::BranchWall wall_of_surface(const MeasureCommand& c, const core::TaskContext& task) {
  pipeline::Source source = pipeline::load(c.input.input, source_options(c.input), task);
  const std::string extension = c.input.input.extension().string();
  if (c.patch_length_mm && (extension == ".vtp" || extension == ".vtk")) {
    io::SurfaceWithFields read = io::read_surface_with_fields(c.input.input);
    std::erase_if(read.points, [](const auto& field) { return names_taken.contains(field.first); });
    if (!read.points.empty()) {
      for (geometry::Vec3& p : read.mesh.points) p *= source.unit_mm;
      return {std::move(read.mesh), std::move(read.points)};
    }
  }
  return {std::move(source.surface), {}};
}

std::optional<pipeline::BranchWall> wall_of(const MeasureCommand& c, const core::TaskContext& task) {
  if (!c.sections && !c.patch_length_mm) return std::nullopt;
  if (!is_case(c)) return wall_of_surface(c, task);
  const auto model = session::CaseFile::open(c.input.input, session::OpenMode::read_only).model();
  return pipeline::BranchWall{lumen::surface_of(*model, 0.0, task), {}};
}

}  // namespace

bool wants_branches(const MeasureCommand& c) {
  return c.bifurcations || c.sections || c.patch_length_mm;
}

void check_branch_options(const MeasureCommand& c) {
  if ((c.sections || c.patch_length_mm) && !is_case(c) && !is_surface(c))
    throw UsageError(
        "--sections and --patch-length need a lumen's surface: give the surface as input and the " +
        std::string("tree as --centerline"));
  if (!c.centerline.empty() && !is_surface(c))
    throw UsageError("--centerline is for surfaces: " + std::string(is_case(c) ? "a case" : "a tree") +
                     " has its lines");
  if (!c.centerline.empty() && (!c.ends.source.empty() || !c.ends.targets.empty()))
    throw UsageError("--centerline gives the lines that --source and --target would ask for");
  if (c.section_spheres != 1 && !c.sections) throw UsageError("--section-spheres is for --sections");
  if (c.patch_sectors != 1 && !c.patch_length_mm) throw UsageError("--patch-sectors is for --patch-length");
}

nlohmann::json branch_parameters(const MeasureCommand& c) {
  return {{"bifurcations", c.bifurcations},
          {"sections", c.sections},
          {"section_spheres", c.section_spheres},
          {"patch_length_mm", c.patch_length_mm.value_or(0.0)},
          {"patch_sectors", c.patch_sectors}};
}

std::optional<geometry::VesselTree> given_lines(const MeasureCommand& c) {
  if (c.centerline.empty()) return std::nullopt;
  return io::read_centerlines(c.centerline);
}

pipeline::BranchReport branches_of(const MeasureCommand& c, const geometry::VesselTree& tree,
                                   const core::TaskContext& task) {
  const std::optional<pipeline::BranchWall> wall = wall_of(c, task.sub(0.0, 0.2));
  pipeline::BranchReportOptions options;
  options.bifurcations = c.bifurcations;
  options.sections = c.sections;
  options.section.spheres_apart = c.section_spheres;
  if (c.patch_length_mm) options.patches = analysis::PatchOptions{*c.patch_length_mm, c.patch_sectors};
  pipeline::BranchReport report =
      pipeline::measured_branches(branched_lines(c, tree), wall, options, task.sub(0.2, 1.0));
  for (const std::string& warning : report.warnings) core::log_warning(warning);
  return report;
}

void print_branches(const nlohmann::json& m) {
  std::printf("bifurcations of inscribed spheres: %zu, with %zu branches\n", m["bifurcations"].size(),
              m["branches"].size());
  for (const nlohmann::json& one : m["bifurcations"])
    std::printf("  bifurcation %d: %.1f degrees between its branches\n", one["group"].get<int>(),
                one["angle_between_deg"].get<double>());
}

}  // namespace ostia::app
