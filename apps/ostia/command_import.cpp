#include "commands.h"
#include "outputs.h"
#include "points.h"

#include "ostia/core/log.h"
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
  return ExitCode::ok;
}

}  // namespace ostia::app
