#include "input/case_image.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/imaging/image_axes.h"

namespace ostia::app {

pipeline::Source case_image(const std::filesystem::path& path, const session::CaseFile& file,
                            const core::TaskContext& task) {
  task.set_stage("reading");
  pipeline::SourceOptions reading;
  reading.dicom.assume_axial = true;  // whoever made the case of it has seen how it lies
  pipeline::Source source = pipeline::load_ct(path, reading, task);
  for (const std::string& warning : source.warnings) core::log_warning(warning);
  try {
    file.check_image({source.sha256, source.pseudonym});
  } catch (const InvalidInput& error) {
    throw InvalidInput(path.string() + ": " + error.what());
  }
  if (const auto own = file.image(); own && !own->axes.empty())
    source.image = std::make_shared<const imaging::ImageVolume>(imaging::with_axes(*source.image, own->axes));
  return source;
}

}  // namespace ostia::app
