#include "input/input_digest.h"
#include "motion/motion.h"
#include "motion/motion_input.h"
#include "output/refusal.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/pipeline/motion_export.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace ostia::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

pipeline::MotionExportOptions options_of(const MotionExportCommand& c) {
  if (!std::isfinite(c.rr_seconds)) throw UsageError("--rr is the length of the cycle in seconds, a number");
  pipeline::MotionExportOptions options;
  options.times = c.times;
  options.rr_seconds = c.rr_seconds;
  if (!c.mesh.empty()) options.formats = {pipeline::MotionFormat::vtu};
  if (!c.formats.empty()) options.formats.clear();
  for (const std::string& name : c.formats) options.formats.push_back(pipeline::motion_format(name));
  return options;
}

pipeline::JobKey job_of(const MotionExportCommand& c, const pipeline::MotionExportOptions& options,
                        const fs::path& surface) {
  Json formats = Json::array();
  for (const pipeline::MotionFormat one : options.formats) formats.push_back(pipeline::name_of(one));
  const Json parameters{
      {"formats", formats}, {"times", c.times}, {"rr_seconds", c.rr_seconds}, {"units", c.units}};
  pipeline::JobKey key{"motion export", {}, parameters.dump()};
  key.inputs["motion"] = core::sha256_file(motion_path(c.motion));
  key.inputs["surface"] = core::sha256_file(surface);
  if (fs::exists(c.mesh)) key.inputs["mesh"] = digest_of(c.mesh);
  return key;
}

Json result_of(const pipeline::MotionExport& made) {
  Json out{{"v", 1},
           {"kind", "motion-export"},
           {"outside", made.outside},
           {"inverted", made.inverted()},
           {"times", Json::array()}};
  for (const pipeline::MotionTime& t : made.times)
    out["times"].push_back({{"percent", 100.0 * t.phase},
                            {"seconds", t.seconds},
                            {"mean_displacement_mm", t.mean_displacement_mm},
                            {"max_displacement_mm", t.max_displacement_mm},
                            {"inverted", t.inverted},
                            {"min_scaled_jacobian", t.min_scaled_jacobian}});
  return out;
}

void print(const Json& result) {
  double farthest = 0.0, least = 1.0;
  for (const Json& t : result["times"]) {
    farthest = std::max(farthest, t["max_displacement_mm"].get<double>());
    least = std::min(least, t["min_scaled_jacobian"].get<double>());
  }
  std::printf(
      "%zu times, up to %.2f mm from the template; %d elements inverted, least scaled Jacobian %.3f\n",
      result["times"].size(), farthest, result["inverted"].get<int>(), least);
}

pipeline::MotionExport make(const MotionExportCommand& c, pipeline::MotionExportOptions options,
                            const fs::path& surface_path, const fs::path& folder,
                            const core::TaskContext& task) {
  const io::CageMotionFile file = io::read_cage_motion(motion_path(c.motion));
  const motion::MovingCage cage(file.motion);
  const geometry::TriMesh surface = surface_from(surface_path, c.surface.empty() ? "mm" : c.units);
  std::optional<io::LayeredMesh> layered;
  if (!c.mesh.empty()) layered = io::read_layered_mesh(c.mesh);
  options.surface_name = own_name(surface_path);
  if (layered) {
    options.mesh_name = own_name(c.mesh);
    options.layer_tetrahedra = layers_at_end(*layered);
  }
  task.set_stage("writing");
  return pipeline::export_motion(folder, cage, surface, layered ? &layered->mesh : nullptr, options, task);
}

}  // namespace

ExitCode run_motion_export(const MotionExportCommand& c, const core::TaskContext& task) {
  const auto start = Clock::now();
  const pipeline::MotionExportOptions options = options_of(c);
  for (const pipeline::MotionFormat one : {pipeline::MotionFormat::vtu, pipeline::MotionFormat::openfoam})
    if (c.mesh.empty() && std::ranges::find(options.formats, one) != options.formats.end())
      throw UsageError("--format " + std::string(pipeline::name_of(one)) +
                       " is of a volume mesh; name one with --mesh");
  pipeline::require_free_folder(c.output);
  task.set_stage("reading");
  const fs::path surface = template_path(c.motion, io::read_cage_motion(motion_path(c.motion)), c.surface);
  const pipeline::JobKey key = job_of(c, options, surface);
  std::optional<ExitCode> code = pipeline::already_done(c.output, key);
  if (code) {
    core::log_info("done already with the same motion and parameters; nothing to do");
  } else {
    core::StagedFolder staged(c.output);
    const pipeline::MotionExport made = make(c, options, surface, staged.temporary(), task.sub(0.1, 0.95));
    for (const std::string& warning : made.warnings) core::log_warning(warning);
    const Json result = result_of(made);
    core::write_file(staged.temporary() / "export.json", result.dump(2) + "\n");
    code = made.inverted() == 0 ? ExitCode::ok : ExitCode::quality_failed;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    Json quality = result;
    quality.erase("times");
    pipeline::write_manifest(staged.temporary(), {key, *code, seconds, made.warnings, quality.dump()});
    task.throw_if_cancelled();
    staged.commit();
  }
  const std::string result = core::read_file(c.output / "export.json");
  if (c.json)
    std::fputs(result.c_str(), stdout);
  else
    print(Json::parse(result));
  task.set_progress(1.0);
  return *code;
}

}  // namespace ostia::app
