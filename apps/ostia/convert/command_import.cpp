#include "commands.h"
#include "options/model_options.h"
#include "output/outputs.h"
#include "output/told.h"

#include "ostia/core/log.h"
#include "ostia/core/text.h"
#include "ostia/imaging/image_file.h"
#include "ostia/pipeline/source.h"

namespace ostia::app {

ExitCode run_import(const ImportOptions& options, const core::TaskContext& task) {
  require_output(options.output, image_outputs);
  task.set_stage("reading");
  const pipeline::Source source =
      pipeline::load(options.input.input, source_options(options.input), task.sub(0.0, 0.8));
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  if (!source.image)
    throw InvalidInput("cannot import " + options.input.input.string() + ": it is a " +
                       pipeline::name_of(source.kind) + "; use `ostia convert`");
  task.set_stage("writing");
  imaging::write_image(options.output, *source.image);
  task.set_progress(1.0);
  const imaging::Geometry& grid = source.image->geometry;
  const auto of_axes = [](const auto& values, const char* between) {
    std::string text;
    for (int d = 0; d < 3; ++d)
      text += (d == 0 ? "" : between) + core::significant_text(static_cast<double>(values[d]), 6);
    return text;
  };
  tell("import",
       {{"size", grid.size}, {"spacing_mm", {grid.spacing.x(), grid.spacing.y(), grid.spacing.z()}}},
       of_axes(grid.size, " x ") + " voxels of " + of_axes(grid.spacing, " x ") + " mm", options.json);
  return ExitCode::ok;
}

}  // namespace ostia::app
