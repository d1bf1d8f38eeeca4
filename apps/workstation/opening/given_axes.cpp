// The axes of the image on the table, where a person says them and not its file.
#include "opening/opening.h"
#include "shell/desk.h"

#include "ostia/core/error.h"

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

/// A file of settings may hold anything.
bool axes_are_good(const std::string& axes) {
  try {
    if (!axes.empty()) imaging::validate_axes(axes);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

/// Of the machine's settings: axes that a person gave this image, empty or missing for those of its file.
std::string axes_setting(const std::string& image_sha256) {
  return "image_axes." + image_sha256;
}

}  // namespace

std::string Opening::wanted_axes(const session::ImageReference& image) const {
  if (desk_.bench.has_case()) {
    const auto of_case = desk_.bench.session().file().image();
    return of_case ? of_case->axes : std::string();
  }
  const std::string axes = desk_.machine.setting(axes_setting(image.sha256)).value_or(std::string());
  return axes_are_good(axes) ? axes : std::string();
}

void Opening::turn(const Loaded& loaded, const std::string& axes, const fs::path& path) {
  desk_.jobs.run(
      "open", tr("Turning the image"),
      [loaded, axes](const core::TaskContext&) {
        const imaging::AxesGiven now = imaging::given_axes(loaded.as_read, loaded.image.reference.axes);
        Loaded turned = loaded;
        turned.image.reference.axes = axes;
        turned.image.volume = std::make_shared<const imaging::ImageVolume>(
            imaging::laid(*loaded.image.volume, now, imaging::given_axes(loaded.as_read, axes)));
        return std::any(turned);
      },
      [this, path](const std::any& result) { show(std::any_cast<const Loaded&>(result), path); },
      [this](const QString& message) { desk_.cannot_open(message, tr("The image cannot be turned")); });
}

void Opening::open_with_axes(const fs::path& case_file, const std::string& axes) {
  const std::string of = desk_.bench.image().reference.sha256;
  if (desk_.messages.guarded([&] { desk_.machine.set_setting(axes_setting(of), axes); }, true))
    open_case(case_file);
}

bool Opening::give_axes(const std::string& axes) {
  const session::OpenImage& image = desk_.bench.image();
  if (!image.volume || reading()) return false;
  const std::string given = axes == imaging::axes_of(shown_.as_read) ? std::string() : axes;
  if (given == image.reference.axes) return false;
  Loaded loaded = shown_;
  loaded.image = image;
  loaded.warnings.clear();
  if (!desk_.messages.guarded(
          [&] {
            if (!given.empty()) imaging::validate_axes(given);
            desk_.machine.set_setting(axes_setting(image.reference.sha256), given);
          },
          true))
    return false;
  // What is being sought in the image as it was would begin a case of it.
  for (const char* job : {"tree", "path"}) desk_.jobs.cancel(job);
  if (desk_.bench.has_case()) close_case();
  turn(loaded, given, shown_path_);
  return true;
}

}  // namespace ostia::workstation
