#include "covered_region.h"
#include "evaluate.h"

#include "ostia/evaluation/volume_overlap.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/surface_file.h"

#include <nlohmann/json.hpp>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

bool is_surface(const fs::path& path) {
  return io::is_surface_file(path);
}

Json figures(const evaluation::VolumeOverlap& v) {
  return {{"dice", v.dice},
          {"jaccard", v.jaccard},
          {"reference_mm3", v.reference_mm3},
          {"result_mm3", v.result_mm3},
          {"both_mm3", v.both_mm3},
          {"relative_difference", v.relative_difference}};
}

}  // namespace

ExitCode run_evaluate_volume(const EvaluateCommand& command, const core::TaskContext& task) {
  require_pair(command);
  const std::vector<std::string> names{"lumen.vtp", "lumen.stl", "lumen.ply", "mask.nrrd"};
  const fs::path reference = file_in(command.reference, names, "surface or mask");
  const std::vector<fs::path> parts = files_in(command.result, names, "surface or mask");
  const fs::path& result = parts.front();
  if (is_surface(reference) != is_surface(result))
    throw InvalidInput("cannot compare " + reference.string() + " and " + result.string() +
                       ": one is a surface and the other a mask");
  Json out{{"v", 1}, {"kind", "volume"}};
  if (!is_surface(reference)) {
    if (command.covered_only) throw UsageError("--covered is for surfaces of models");
    out["method"] = "voxels";
    out.update(figures(evaluation::compare_masks(imaging::read_mask(reference, task).volume,
                                                 imaging::read_mask(result, task).volume)));
    return finish(command, out);
  }
  evaluation::Region region;
  if (command.covered_only) {
    if (!fs::is_directory(command.result))
      throw UsageError(
          "--covered needs the folder of a model as RESULT: its centerlines tell what it covers");
    region = covered_region(lines_of_parts(
        files_in(command.result, {"centerlines.vtp", "centerlines.csv"}, "centerlines"), command.units));
  }
  out["method"] = "lines";
  out["resolution_mm"] = command.resolution_mm;
  out["covered_only"] = command.covered_only;
  out.update(figures(evaluation::compare_enclosed(surface_from(reference, command.units),
                                                  surface_of_parts(parts, command.units),
                                                  command.resolution_mm, region, task)));
  task.set_progress(1.0);
  return finish(command, out);
}

}  // namespace ostia::app
