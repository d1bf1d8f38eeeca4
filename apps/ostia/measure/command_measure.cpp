// `ostia measure`: lengths, areas, volumes, orders, angles, scaling laws and overlaps of a tree of vessels.

#include "input/seeds.h"
#include "input/surface_axes.h"
#include "measure/measure.h"
#include "measure/measure_branches.h"
#include "tree/tree_input.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_tree.h"
#include "ostia/io/graph_file.h"
#include "ostia/pipeline/tree_report.h"
#include "ostia/session/case_file.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Options that would do nothing are told.
void check_options(const MeasureCommand& c) {
  check_branch_options(c);
  if (c.input.input.extension() != ".ostia" && !io::is_graph_file(c.input.input)) return;
  if (!c.ends.source.empty() || !c.ends.targets.empty() || !c.ends.seed_units.empty() ||
      c.ends.step_mm != 0.0)
    throw UsageError("--source, --target, --seed-units and --step are for surfaces: a tree has its lines");
  if (!c.input.units.empty())
    throw UsageError("--units is for surfaces; `ostia convert --units` brings a tree to mm");
}

struct NamedGraph {
  geometry::VesselGraph graph;
  std::string reference_name = "segment";
  std::optional<geometry::VesselTree> tree;  // where it was one to begin with
};

NamedGraph graph_of_tree(geometry::VesselTree tree) {
  return {geometry::graph_of(tree), "segment", std::move(tree)};
}

NamedGraph graph_in(const MeasureCommand& c, const core::TaskContext& task) {
  const fs::path& path = c.input.input;
  if (path.extension() == ".ostia") {
    const auto model = session::CaseFile::open(path, session::OpenMode::read_only).model();
    return graph_of_tree(model->tree);
  }
  if (auto lines = given_lines(c)) return graph_of_tree(std::move(*lines));
  if (!io::is_graph_file(path)) return graph_of_tree(axes_of_surface(c.input, c.ends, task).axes.tree);
  io::LoadedGraph loaded = io::read_graph(path, task);
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  join_lines_side_by_side(loaded, task);
  return {std::move(loaded.graph), loaded.reference_name, std::nullopt};
}

/// Of a folder that a command has made its lines or, where the wall is measured or there are none, its lumen.
MeasureCommand within_folder(MeasureCommand c) {
  const fs::path folder = c.input.input;
  if (!fs::is_directory(folder)) return c;
  const auto there = [&](const char* name) { return fs::is_regular_file(folder / name); };
  const bool of_wall = c.sections || c.patch_length_mm;
  if (there("lumen.vtp") && (of_wall || !c.centerline.empty() || !there("centerlines.vtp"))) {
    c.input.input = folder / "lumen.vtp";
    if (c.centerline.empty() && c.ends.source.empty() && c.ends.targets.empty() && there("centerlines.vtp"))
      c.centerline = folder / "centerlines.vtp";
  } else if (there("centerlines.vtp")) {
    c.input.input = folder / "centerlines.vtp";
  } else {
    throw InvalidInput(
        "cannot measure " + folder.string() + ": it is a folder without centerlines.vtp and lumen.vtp" +
        (there("mesh.vtu") ? "; `ostia convert` makes a surface of its mesh.vtu, which can be measured"
                           : "; give the surface, the lines or the case inside it"));
  }
  core::log_info("measured of the folder: " + c.input.input.filename().string());
  return c;
}

pipeline::JobKey job_of(const MeasureCommand& c) {
  nlohmann::json targets = nlohmann::json::array();
  for (const std::string& target : c.ends.targets) targets.push_back(seed_digest(target));
  nlohmann::json parameters{{"source", seed_digest(c.ends.source)},
                            {"targets", targets},
                            {"seed_units", c.ends.seed_units},
                            {"step_mm", c.ends.step_mm},
                            {"units", c.input.units},
                            {"coords", c.input.coords}};
  if (wants_branches(c)) parameters["branches"] = branch_parameters(c);
  pipeline::JobKey key{"measure", {}, parameters.dump()};
  key.inputs["input"] = core::sha256_file(c.input.input);
  if (!c.centerline.empty()) key.inputs["centerline"] = core::sha256_file(c.centerline);
  return key;
}

void measure(const MeasureCommand& c, const pipeline::JobKey& key, const core::TaskContext& task) {
  const auto start = Clock::now();
  task.set_stage("reading");
  NamedGraph read = graph_in(c, task.sub(0.0, 0.3));
  geometry::require_sound(read.graph, c.input.input.filename().string(), true, task, read.reference_name);
  if (wants_branches(c) && !read.tree) read.tree = geometry::tree_of(read.graph, task);
  pipeline::MeasuredTree tree = pipeline::measured(std::move(read.graph), task.sub(0.3, 0.6));
  tree.reference_name = read.reference_name;
  if (wants_branches(c)) tree.branches = branches_of(c, *read.tree, task.sub(0.6, 0.8));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  pipeline::write_tree_report(c.output, tree, key, seconds, task.sub(0.8, 1.0));
}

void print(const nlohmann::json& m) {
  std::printf("%lld segments, %lld branches, %lld ends\n", m["segments"].get<long long>(),
              m["branches"].get<long long>(), m["ends"].get<long long>());
  std::printf("length %.6g mm, area %.6g mm2, volume %.6g mm3\n", m["length_mm"].get<double>(),
              m["area_mm2"].get<double>(), m["volume_mm3"].get<double>());
  std::printf("orders by diameter: %zu; Murray's exponent %.2f\n", m["orders"].size(),
              m["murray_exponent"].get<double>());
  const auto overlaps = m["overlaps"]["count"].get<long long>();
  if (overlaps == 0)
    std::printf("no two vessels run into each other\n");
  else
    std::printf("pairs of segments that run into each other: %lld, in overlaps.csv\n", overlaps);
}

}  // namespace

ExitCode run_measure(const MeasureCommand& given, const core::TaskContext& task) {
  pipeline::require_free_folder(given.output);
  const MeasureCommand c = within_folder(given);
  if (!fs::is_regular_file(c.input.input))
    throw IoError("cannot read " + c.input.input.string() + ": there is no such file");
  check_options(c);
  const pipeline::JobKey key = job_of(c);
  if (pipeline::already_done(c.output, key))
    core::log_info("done already with the same input and parameters; nothing to do");
  else
    measure(c, key, task);
  std::string result = core::read_file(c.output / "measures.json");
  nlohmann::json branches;
  if (wants_branches(c)) branches = nlohmann::json::parse(core::read_file(c.output / "branches.json"));
  if (c.json && !branches.is_null()) {
    nlohmann::json both = nlohmann::json::parse(result);
    both["branch_measures"] = branches;
    result = both.dump(1) + "\n";
  }
  if (c.json) {
    std::fputs(result.c_str(), stdout);
  } else {
    print(nlohmann::json::parse(result));
    if (!branches.is_null()) print_branches(branches);
  }
  task.set_progress(1.0);
  return ExitCode::ok;
}

}  // namespace ostia::app
