#include "tree/tree_input.h"

#include "input/seeds.h"
#include "options/model_options.h"
#include "options/validators.h"

#include "ostia/core/log.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_repair.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <utility>

namespace ostia::app {
namespace {

using geometry::Vec3;
using Json = nlohmann::ordered_json;

/// Some grown trees have their places in metres and their radii in millimetres.
void scale(const InputOptions& input, const TreeInputOptions& options, geometry::VesselGraph& graph) {
  InputOptions radii = input;
  if (!options.radius_units.empty()) radii.units = options.radius_units;
  const double place_mm = source_options(input).unit_mm.value_or(1.0);
  const double radius_mm = source_options(radii).unit_mm.value_or(1.0);
  for (geometry::Vec3& p : graph.points) p *= place_mm;
  for (geometry::GraphEdge& edge : graph.edges) {
    edge.radius_from *= radius_mm;
    edge.radius_to *= radius_mm;
  }
}

Json repair(const TreeInputOptions& options, double unit_mm, geometry::VesselGraph& graph,
            const core::TaskContext& task) {
  geometry::GraphRepairOptions how;
  how.merge_within_mm = options.merge_mm;
  how.keep_directions = options.keep_directions;
  for (const std::string& root : options.roots) {
    const std::vector<Vec3> places = seed_points(root, {.unit_mm = unit_mm});
    how.roots.insert(how.roots.end(), places.begin(), places.end());
  }
  geometry::RepairedGraph fixed = geometry::repaired(std::move(graph), how, task);
  Json steps = Json::array();
  for (const geometry::GraphRepairStep& step : fixed.steps) {
    core::log_info(step.text);
    steps.push_back({{"what", step.what}, {"count", step.count}, {"text", step.text}});
  }
  const std::string left = geometry::summary(fixed.left, fixed.graph, "reference");
  core::log_info("faults left: " + left);
  graph = std::move(fixed.graph);
  return {{"steps", steps}, {"left", left}};
}

}  // namespace

void add_tree_input(CLI::App& app, TreeInputOptions& o, const std::string& of_trees,
                    const std::string& of_repair) {
  app.add_option("--radius-units", o.radius_units,
                 of_trees.empty() ? "Unit of radii that is not the places'"
                                  : of_trees + "unit of radii that is not the places'")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  app.add_option("--root", o.roots,
                 of_repair + "where one begins, x,y,z in the file's unit, or a file of points; repeat")
      ->allow_extra_args(false);
  app.add_option("--join-within", o.merge_mm, of_repair + "also join points this near, mm")
      ->check(above_zero());
  app.add_flag("--keep-directions", o.keep_directions, of_repair + "turn no segments, but those of a --root");
}

void require_repair(const TreeInputOptions& o) {
  if (!o.repair && (o.merge_mm > 0.0 || !o.roots.empty() || o.keep_directions))
    throw UsageError("--root, --join-within and --keep-directions are for --repair");
}

std::string joined_side_by_side(io::LoadedGraph& loaded, const core::TaskContext& task) {
  using Kind = geometry::GraphFaultKind;
  const geometry::GraphFaults faults = geometry::find_faults(loaded.graph, task);
  const std::size_t shared = faults.count(Kind::duplicate_point);
  for (const geometry::GraphFault& fault : faults.found)
    if (fault.kind < Kind::duplicate_point && fault.count > 0) return "";
  if (shared == 0) return "";
  geometry::RepairedGraph joined = geometry::repaired(loaded.graph, {}, task);
  if (!joined.left.sound_trees()) return "";
  loaded.graph = std::move(joined.graph);
  return "lines that run side by side are joined: " + std::to_string(shared) +
         " points at the places of others";
}

void join_lines_side_by_side(io::LoadedGraph& loaded, const core::TaskContext& task) {
  if (const std::string told = joined_side_by_side(loaded, task); !told.empty()) core::log_warning(told);
}

io::LoadedGraph read_tree(const InputOptions& input, const TreeInputOptions& options, Json& done,
                          const core::TaskContext& task) {
  require_repair(options);
  io::LoadedGraph loaded = io::read_graph(input.input, task.sub(0.0, 0.6));
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  scale(input, options, loaded.graph);
  if (options.repair)
    done["repair"] =
        repair(options, source_options(input).unit_mm.value_or(1.0), loaded.graph, task.sub(0.6, 1.0));
  return loaded;
}

}  // namespace ostia::app
