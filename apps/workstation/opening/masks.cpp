#include "opening/opening.h"
#include "shell/desk.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/dicom/label_object.h"
#include "ostia/session/found_model.h"
#include "ostia/session/machine_state.h"

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

/// Of the image on the table where there is one, else of the mask alone.
session::MaskModel model_for(const imaging::MaskVolume& labels, const session::OpenImage& image,
                             const core::TaskContext& task) {
  if (!image.volume) return session::model_of_mask(labels, nullptr, {}, task);
  try {
    return session::model_of_mask(labels, image.volume.get(), {}, task);
  } catch (const InvalidInput& error) {
    throw InvalidInput(std::string("this mask and the image that is open: ") + error.what() +
                       "; close the image to open the mask alone");
  }
}

}  // namespace

Opening::MaskCase Opening::case_of_mask(const fs::path& mask, const session::OpenImage& image,
                                        const fs::path& state_folder, const core::TaskContext& task) {
  if (image.volume)
    if (const auto known = session::MachineState(state_folder).find_image(image.reference.sha256))
      if (const std::string why = dicom::other_origin(mask, known->path, known->series_uid); !why.empty())
        throw InvalidInput("this mask and the image that is open do not belong together: " + why +
                           "; close the image to open the mask alone");
  const auto grid = image.volume ? std::optional(image.volume->geometry) : std::nullopt;
  const auto loaded = dicom::read_labels(mask, task.sub(0.0, 0.1), grid);
  const session::MaskModel made = model_for(loaded.volume, image, task.sub(0.1, 0.95));
  task.throw_if_cancelled();
  MaskCase result;
  const bool with_image = image.volume != nullptr;
  result.path = unused_case_path(state_folder, with_image ? image.reference.pseudonym : "mask");
  session::create_case(result.path, made.found, with_image ? std::optional(image.reference) : std::nullopt);
  result.vessels = static_cast<int>(made.found.model.tree.vessels.size());
  if (!made.found.found.warnings.empty()) result.first_warning = made.found.found.warnings.front();
  for (const std::string& warning : made.found.found.warnings) core::log_warning(warning);
  return result;
}

void Opening::take_mask(const MaskCase& made) {
  const QString found =
      tr("%n vessel(s) of the mask; a question mark says where to look first.", nullptr, made.vessels);
  open_case(made.path, made.first_warning.empty()
                           ? found
                           : found + QStringLiteral(" ") + QString::fromStdString(made.first_warning));
}

}  // namespace ostia::workstation
