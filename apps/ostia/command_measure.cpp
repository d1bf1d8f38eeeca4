// `ostia measure`: lengths, areas, volumes, orders, angles, scaling laws and overlaps of a tree of vessels.

#include "measure.h"
#include "surface_axes.h"

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
  if (c.input.input.extension() != ".ostia" && !io::is_graph_file(c.input.input)) return;
  if (!c.ends.source.empty() || !c.ends.targets.empty() || c.ends.step_mm != 0.0)
    throw UsageError("--source, --target and --step are for surfaces: a tree has its lines");
  if (!c.input.units.empty())
    throw UsageError("--units is for surfaces; `ostia convert --units` brings a tree to mm");
}

struct NamedGraph {
  geometry::VesselGraph graph;
  std::string reference_name = "segment";
};

NamedGraph graph_in(const MeasureCommand& c, const core::TaskContext& task) {
  const fs::path& path = c.input.input;
  if (path.extension() == ".ostia") {
    const auto model = session::CaseFile::open(path, session::OpenMode::read_only).model();
    return {geometry::graph_of(model->tree)};
  }
  if (!io::is_graph_file(path)) return {geometry::graph_of(axes_of_surface(c.input, c.ends, task).tree)};
  io::LoadedGraph loaded = io::read_graph(path, task);
  for (const std::string& warning : loaded.warnings) core::log_warning(warning);
  return {std::move(loaded.graph), loaded.reference_name};
}

pipeline::JobKey job_of(const MeasureCommand& c) {
  const nlohmann::json parameters{{"source", c.ends.source},
                                  {"targets", c.ends.targets},
                                  {"step_mm", c.ends.step_mm},
                                  {"units", c.input.units},
                                  {"coords", c.input.coords}};
  pipeline::JobKey key{"measure", {}, parameters.dump()};
  key.inputs["input"] = core::sha256_file(c.input.input);
  return key;
}

void measure(const MeasureCommand& c, const pipeline::JobKey& key, const core::TaskContext& task) {
  const auto start = Clock::now();
  task.set_stage("reading");
  NamedGraph read = graph_in(c, task.sub(0.0, 0.3));
  geometry::require_sound(read.graph, c.input.input.filename().string(), true, task, read.reference_name);
  pipeline::MeasuredTree tree = pipeline::measured(std::move(read.graph), task.sub(0.3, 0.7));
  tree.reference_name = read.reference_name;
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  pipeline::write_tree_report(c.output, tree, key, seconds, task.sub(0.7, 1.0));
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

ExitCode run_measure(const MeasureCommand& c, const core::TaskContext& task) {
  pipeline::require_free_folder(c.output);
  if (!fs::is_regular_file(c.input.input))
    throw IoError("cannot read " + c.input.input.string() + ": there is no such file");
  check_options(c);
  const pipeline::JobKey key = job_of(c);
  if (pipeline::already_done(c.output, key))
    core::log_info("done already with the same input and parameters; nothing to do");
  else
    measure(c, key, task);
  const std::string result = core::read_file(c.output / "measures.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print(nlohmann::json::parse(result));
  task.set_progress(1.0);
  return ExitCode::ok;
}

}  // namespace ostia::app
