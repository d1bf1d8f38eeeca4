#include "options/validators.h"
#include "output/outputs.h"
#include "tree/grow.h"
#include "tree/tree_input.h"

#include "ostia/analysis/tree_growth.h"
#include "ostia/core/log.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/surface_file.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <utility>
#include <vector>

namespace ostia::app {
namespace {

constexpr double most_left_out = 0.1;  // of all elements; a growth that fails is told by its exit code

analysis::CoronaryArtery artery_of(const std::string& name) {
  if (name == "rca") return analysis::CoronaryArtery::right;
  return name == "lad" ? analysis::CoronaryArtery::left_anterior : analysis::CoronaryArtery::circumflex;
}

analysis::GrowthDomain domain_of(const GrowCommand& o, const geometry::VesselGraph& tree) {
  if (o.domain.empty()) return analysis::domain_of(analysis::shell_about(tree, o.wall_mm));
  const io::LoadedSurface loaded = io::read_surface(o.domain);
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  const geometry::SurfaceFaults facts = geometry::find_faults(loaded.surface.mesh, false);
  if (facts.open_edges > 0)
    throw InvalidInput(o.domain.filename().string() + " has " + std::to_string(facts.open_edges) +
                       " open edges: an open surface has no inside to grow in; `ostia convert --repair "
                       "--fill-holes MM` closes it");
  return analysis::domain_of(loaded.surface.mesh);
}

void print(const analysis::GrownTree& grown, std::size_t scanned, bool as_json) {
  if (!as_json) {
    std::printf(
        "%zu segments, %zu of them grown; %lld elements, %lld left out for want of room, %lld shorter\n",
        grown.graph.edges.size(), grown.graph.edges.size() - scanned, static_cast<long long>(grown.elements),
        static_cast<long long>(grown.elements_left_out), static_cast<long long>(grown.elements_shortened));
    return;
  }
  const nlohmann::json facts{{"v", 1},
                             {"kind", "growth"},
                             {"segments", grown.graph.edges.size()},
                             {"grown_segments", grown.graph.edges.size() - scanned},
                             {"elements", grown.elements},
                             {"elements_left_out", grown.elements_left_out},
                             {"elements_shortened", grown.elements_shortened}};
  std::puts(facts.dump(2).c_str());
}

}  // namespace

ExitCode run_grow(const GrowCommand& o, std::uint64_t seed, const core::TaskContext& task) {
  require_output(o.output, {".vtp", ".swc", ".csv"});
  task.set_stage("reading");
  io::LoadedGraph loaded = io::read_graph(o.input, task.sub(0.0, 0.04));
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  join_lines_side_by_side(loaded, task.sub(0.04, 0.05));
  geometry::require_sound(loaded.graph, o.input.filename().string(), true, task, loaded.reference_name);
  analysis::GrownTree grown =
      analysis::grow_tree(loaded.graph, domain_of(o, loaded.graph),
                          {artery_of(o.artery), seed, o.most_segments}, task.sub(0.05, 0.9));
  task.set_stage("writing");
  const std::vector<io::SegmentValues> values{{"Order", std::move(grown.order)},
                                              {"Element", std::move(grown.element)}};
  for (const std::string& lost : io::write_graph(o.output, grown.graph, values, task.sub(0.9, 1.0)))
    core::log_warning(lost);
  print(grown, loaded.graph.edges.size(), o.json);
  if (static_cast<double>(grown.elements_left_out) <= most_left_out * static_cast<double>(grown.elements))
    return ExitCode::ok;
  core::log_warning(std::to_string(grown.elements_left_out) + " of " + std::to_string(grown.elements) +
                    " elements had no room: do the tree's ends lie in the domain? give a thicker --wall, or "
                    "the surface of the myocardium (--domain)");
  return ExitCode::quality_failed;
}

void define_grow(CLI::App& app, GrowCommand& c, const std::uint64_t& seed,
                 std::function<ExitCode(const core::TaskContext&)>& run) {
  CLI::App* grow = app.add_subcommand(
      "grow", "From the ends of a tree down to the capillaries, by published morphometry of pigs' hearts");
  grow->footer("Example:\n  ostia grow tree.vtp -o grown.vtp --domain myocardium.stl --artery lad --seed 7");
  grow->fallthrough();
  grow->add_option("TREE", c.input, "Tree of vessels in mm: .vtp, .vtk, .swc, .csv, .gxl")->required();
  grow->add_option("-o,--output", c.output,
                   ".vtp, .csv, with the Order and the Element of each segment; or .swc, without")
      ->required();
  grow->add_option("--domain", c.domain,
                   "Closed surface in which vessels may grow; left out: a spherical shell about the tree");
  grow->add_option("--wall", c.wall_mm, "Thickness of that shell, mm")->check(above_zero());
  grow->add_option("--artery", c.artery, "Whose table: rca, lad or lcx")
      ->check(CLI::IsMember({"rca", "lad", "lcx"}));
  grow->add_option("--most-segments", c.most_segments, "More than this are refused")->check(above_zero());
  grow->add_flag("--json", c.json, "One JSON object on standard output");
  grow->callback([&] { run = [&](const core::TaskContext& task) { return run_grow(c, seed, task); }; });
}

}  // namespace ostia::app
