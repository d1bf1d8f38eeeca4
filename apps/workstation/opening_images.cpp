#include "main_window.h"
#include "opening.h"
#include "series_browser.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/imaging/archive.h"
#include "ostia/imaging/series_preview.h"
#include "ostia/pipeline/source.h"
#include "ostia/session/image_digest.h"

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

bool is_volume_file(const fs::path& path) {
  const std::string name = path.filename().string();
  for (const char* end : {".nrrd", ".mhd", ".mha", ".nii", ".nii.gz"})
    if (name.ends_with(end)) return true;
  return false;
}

/// What stands in the window and nowhere else.
QString shown_name(const imaging::ShownIdentity& shown) {
  QStringList parts;
  for (const std::string& part : {shown.patient_name, shown.study_date, shown.series_description})
    if (!part.empty()) parts << QString::fromStdString(part);
  return parts.join(QStringLiteral("  \u00b7  "));
}

struct FirstSight {
  imaging::SeriesSlice slice;
  imaging::ShownIdentity shown;
};

}  // namespace

void Opening::open_image(const fs::path& path) {
  // From here on the log knows the path, which may name the patient, as "the image".
  core::redact_in_logs(path.string(), "the image");
  if (is_volume_file(path))
    load_file(path);
  else
    scan(path);
}

void Opening::scan(const fs::path& path) {
  window_.jobs().run(
      "open", tr("Looking for series"),
      [path](const core::TaskContext& task) { return std::any(imaging::scan_dicom(path, task)); },
      [this, path](const std::any& result) {
        choose_series(path, std::any_cast<const imaging::DicomFolder&>(result));
      },
      [this](const QString& message) { window_.complain(message, tr("This cannot be opened")); });
}

void Opening::choose_series(const fs::path& path, const imaging::DicomFolder& folder) {
  const bool plain = folder.series.size() == 1 && folder.series.front().faults.empty() &&
                     !folder.series.front().uneven && folder.damaged.empty();
  if (plain) {
    load_series(path, folder.series.front(), {});
    return;
  }
  auto* browser = new SeriesBrowser(folder, window_.jobs(), &window_);
  browser->setAttribute(Qt::WA_DeleteOnClose);
  connect(browser, &SeriesBrowser::chosen, this,
          [this, path](const imaging::DicomSeries& series, const imaging::DicomReadOptions& options) {
            load_series(path, series, options);
          });
  browser->open();
}

void Opening::load_series(const fs::path& path, const imaging::DicomSeries& series,
                          const imaging::DicomReadOptions& options) {
  show_first_slice(series);
  window_.jobs().run(
      "open", tr("Reading the image"),
      [path, series, options](const core::TaskContext& task) {
        Loaded loaded;
        // Of a zip what was in it counts, so that it is the same image as the folder it was made of.
        loaded.image.reference =
            session::image_reference(series.archive ? series.archive->folder() : path, task.sub(0.0, 0.2));
        auto read = imaging::read_dicom_series(series, options, task.sub(0.2, 1.0));
        loaded.image.volume = std::make_shared<const imaging::ImageVolume>(std::move(read.volume));
        loaded.warnings = read.header.warnings;
        return std::any(loaded);
      },
      [this, path](const std::any& result) { show(std::any_cast<const Loaded&>(result), path); },
      [this](const QString& message) { window_.complain(message, tr("The image cannot be opened")); });
}

void Opening::show_first_slice(const imaging::DicomSeries& series) {
  window_.jobs().run(
      "first slice", tr("First slice"),
      [series](const core::TaskContext& task) {
        return std::any(
            FirstSight{imaging::first_slice(series, -1, task), imaging::preview(series, 16, task).shown});
      },
      [this](const std::any& result) {
        const auto& first = std::any_cast<const FirstSight&>(result);
        session::Workbench& bench = window_.bench();
        window_.set_shown_name(shown_name(first.shown));
        if (first.slice.window.from_file)
          bench.grey.set({first.slice.window.centre_hu, first.slice.window.width_hu});
        // What is on the table stays there until the whole image has come.
        if (bench.has_case() || bench.image().volume) return;
        window_.guarded([&] {
          bench.set_image({std::make_shared<const imaging::ImageVolume>(first.slice.image), {}});
        });
      },
      [](const QString&) {});  // the reading of the whole says what is wrong
}

Opening::Loaded Opening::read_file(const fs::path& path, const core::TaskContext& task) {
  const pipeline::Source source = pipeline::load(path, {}, task);
  if (!source.image) throw InvalidInput(path.string() + " is no CT image: open an angiogram");
  return {{source.image, {source.sha256, source.pseudonym}}, source.warnings};
}

Opening::ImageBeside Opening::read_beside(const std::optional<fs::path>& path) {
  if (!path || !is_volume_file(*path)) return {};
  return std::make_shared<core::Beside<Loaded>>(
      [path = *path](const core::TaskContext& task) { return read_file(path, task); });
}

void Opening::load_file(const fs::path& path, const ImageBeside& beside) {
  window_.jobs().run(
      "open", tr("Reading the image"),
      [path, beside](const core::TaskContext& task) {
        return std::any(beside ? beside->get(task) : read_file(path, task));
      },
      [this, path](const std::any& result) {
        window_.set_shown_name(QString::fromStdString(path.filename().string()));
        show(std::any_cast<const Loaded&>(result), path);
      },
      [this](const QString& message) { window_.complain(message, tr("The image cannot be opened")); });
}

void Opening::show(const Loaded& loaded, const fs::path& path) {
  session::Workbench& bench = window_.bench();
  const bool shown_now = window_.guarded(
      [&] {
        if (bench.has_case()) {
          const auto wanted = bench.session().file().image();
          const bool other = !wanted || wanted->sha256 != loaded.image.reference.sha256;
          // A case that waits for its image refuses another; one that has it makes room.
          if (other && wanted && !bench.image().volume)
            bench.session().file().check_image(loaded.image.reference);
          if (other) close_case();
        }
        bench.set_image(loaded.image);
        window_.machine().remember_image(loaded.image.reference.sha256, path);
      },
      true);
  if (shown_now && !loaded.warnings.empty()) window_.say(QString::fromStdString(loaded.warnings.front()));
}

}  // namespace ostia::workstation
