#include "opening/opening.h"
#include "opening/series_browser.h"
#include "shell/desk.h"
#include "shell/library_texts.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/imaging/archive.h"
#include "ostia/imaging/series_preview.h"
#include "ostia/pipeline/source.h"
#include "ostia/session/found_model.h"
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

struct FirstSlice {
  imaging::SeriesSlice slice;
  imaging::ShownIdentity shown;
};

}  // namespace

void Opening::open_image(const session::KnownImage& image) {
  // From here on the log knows the path, which may name the patient, as "the image".
  core::redact_in_logs(image.path.string(), "the image");
  if (is_volume_file(image.path))
    load_file(image.path);
  else
    scan(image);
}

void Opening::scan(const session::KnownImage& image, bool ask) {
  desk_.jobs.cancel("first slice");
  scanned_ = image.path;
  desk_.jobs.run(
      "open", tr("Looking for series"),
      [path = image.path](const core::TaskContext& task) {
        return std::any(imaging::scan_dicom(path, task));
      },
      [this, image, ask](const std::any& result) {
        choose_series(image, std::any_cast<const imaging::DicomFolder&>(result), ask);
      },
      [this](const QString& message) {
        scanned_.clear();
        desk_.cannot_open(message, tr("This cannot be opened"));
      });
}

bool Opening::has_series() const {
  return !scanned_.empty();
}

void Opening::choose_another_series() {
  if (has_series()) scan({scanned_, {}}, true);
}

void Opening::choose_series(const session::KnownImage& image, const imaging::DicomFolder& folder, bool ask) {
  const auto whole = std::make_shared<const imaging::DicomFolder>(folder);
  const auto readable = [](const imaging::DicomSeries& one) { return one.faults.empty() && !one.uneven; };
  const auto known_series = [&](const imaging::DicomSeries& one) {
    return !image.series_uid.empty() && one.uid == image.series_uid;
  };
  for (const imaging::DicomSeries& one : folder.series) {
    if (!ask && known_series(one) && one.lacks_orientation) {  // consent was given when it was opened first
      imaging::DicomReadOptions options;
      options.assume_axial = true;
      load_series(whole, image.path, one, options);
      return;
    }
    const bool alone = folder.series.size() == 1 && folder.damaged.empty() && one.warnings.empty();
    if (ask || !readable(one) || !(known_series(one) || alone)) continue;
    load_series(whole, image.path, one, {});
    return;
  }
  auto* browser = new SeriesBrowser(folder, desk_.jobs, &desk_.window);
  browser->setAttribute(Qt::WA_DeleteOnClose);
  connect(browser, &SeriesBrowser::chosen, this,
          [this, whole, path = image.path](const imaging::DicomSeries& series,
                                           const imaging::DicomReadOptions& options) {
            load_series(whole, path, series, options);
          });
  browser->open();
}

void Opening::open_beside(const imaging::DicomSeries& series,
                          const std::shared_ptr<const imaging::DicomFolder>& folder, const fs::path& path) {
  load_series(folder, path, series, {});
}

void Opening::load_series(const std::shared_ptr<const imaging::DicomFolder>& folder, const fs::path& path,
                          const imaging::DicomSeries& series, const imaging::DicomReadOptions& options) {
  show_first_slice(series);
  desk_.jobs.run(
      "open", tr("Reading the image"),
      [series, options](const core::TaskContext& task) {
        Loaded loaded;
        loaded.series_uid = series.uid;
        loaded.image.reference = session::image_reference(series, task.sub(0.0, 0.2));
        auto read = imaging::read_dicom_series(series, options, task.sub(0.2, 1.0));
        loaded.image.volume = std::make_shared<const imaging::ImageVolume>(std::move(read.volume));
        loaded.as_read = loaded.image.volume->geometry;
        loaded.axes_guessed = series.lacks_orientation;
        loaded.warnings = read.header.warnings;
        loaded.whose = imaging::shown_identity(series);
        return std::any(loaded);
      },
      [this, folder, path](const std::any& result) {
        folder_ = folder;
        show(std::any_cast<const Loaded&>(result), path);
      },
      [this](const QString& message) { desk_.cannot_open(message, tr("The image cannot be opened")); });
}

void Opening::show_first_slice(const imaging::DicomSeries& series) {
  desk_.jobs.run(
      "first slice", tr("First slice"),
      [series](const core::TaskContext& task) {
        return std::any(
            FirstSlice{imaging::first_slice(series, -1, task), imaging::preview(series, 16, task).shown});
      },
      [this, uid = series.uid](const std::any& result) {
        const auto& first = std::any_cast<const FirstSlice&>(result);
        first_sight_ = {uid, shown_name(first.shown), std::nullopt};
        if (const auto& window = first.slice.window; window.from_file)
          first_sight_->window = session::GreyWindow{window.centre_hu, window.width_hu};
        session::Workbench& bench = desk_.bench;
        const bool whole_is_there = bench.image().volume && series_uid_ == uid;
        // What is on the table stays there until the whole image has come.
        const bool table_is_free = !bench.has_case() && !bench.image().volume;
        if (!whole_is_there && table_is_free && desk_.jobs.running("open")) {
          desk_.messages.guarded([&] {
            desk_.identity.expect(first.shown);
            bench.set_image({std::make_shared<const imaging::ImageVolume>(first.slice.image), {}});
            series_uid_ = uid;
          });
          connect(&desk_.jobs, &Jobs::changed, this, &Opening::drop_unread, Qt::UniqueConnection);
        }
        take_first_sight();
      },
      [](const QString&) {});  // the reading of the whole says what is wrong
}

void Opening::take_first_sight() {
  if (!first_sight_ || !desk_.bench.image().volume || first_sight_->series_uid != series_uid_) return;
  desk_.messages.set_shown_name(first_sight_->name);
  // Once: from then on the grey is the person's, as it is where the case knows one.
  if (first_sight_->window && !memory_.knows_grey()) desk_.bench.grey.set(*first_sight_->window);
  first_sight_->window.reset();
}

bool Opening::reading() const {
  const session::OpenImage& image = desk_.bench.image();
  return image.volume && image.reference.sha256.empty();
}

void Opening::drop_unread() {
  if (reading() && !desk_.jobs.running("open")) desk_.bench.close_image();
}

Opening::Loaded Opening::read_file(const fs::path& path, const core::TaskContext& task) {
  const pipeline::Source source = pipeline::load(path, {}, task);
  if (!source.image) throw InvalidInput(path.string() + " is no CT image: open an angiogram");
  Loaded loaded{
      {source.image, {source.sha256, source.pseudonym}}, path.filename().string(), {}, source.warnings};
  loaded.as_read = source.image->geometry;
  return loaded;
}

Opening::ImageBeside Opening::read_beside(const std::optional<session::KnownImage>& image) {
  if (!image || !is_volume_file(image->path)) return {};
  return std::make_shared<core::BackgroundTask<Loaded>>(
      [path = image->path](const core::TaskContext& task) { return read_file(path, task); });
}

void Opening::load_file(const fs::path& path, const ImageBeside& beside) {
  desk_.jobs.cancel("first slice");
  scanned_.clear();
  desk_.jobs.run(
      "open", tr("Reading the image"),
      [path, beside, image = reading() ? session::OpenImage{} : desk_.bench.image(),
       state = desk_.state_folder](const core::TaskContext& task) {
        if (!beside && session::holds_labels(path)) return std::any(case_of_mask(path, image, state, task));
        return std::any(beside ? beside->get(task) : read_file(path, task));
      },
      [this, path](const std::any& result) {
        if (const auto* made = std::any_cast<MaskCase>(&result))
          take_mask(*made);
        else
          show(std::any_cast<const Loaded&>(result), path);
      },
      [this](const QString& message) { desk_.cannot_open(message, tr("The image cannot be opened")); });
}

void Opening::show(const Loaded& loaded, const fs::path& path) {
  session::Workbench& bench = desk_.bench;
  const session::ImageReference& reference = loaded.image.reference;
  if (bench.has_case()) {
    const auto wanted = bench.session().file().image();
    const bool other = !wanted || wanted->sha256 != reference.sha256;
    // A case that waits for its image refuses another; one that has it makes room.
    if (other && wanted && !bench.image().volume) {
      image_missing(*wanted, tr("What was chosen is another image."));
      return;
    }
    if (other) close_case();
  }
  if (const std::string axes = wanted_axes(reference); axes != reference.axes)
    return turn(loaded, axes, path);
  // Before the image is there: no moment with the one's name over the other's pictures.
  desk_.messages.guarded([&] { desk_.identity.take(reference.sha256, loaded.whose); });
  const bool shown_now = desk_.messages.guarded(
      [&] {
        bench.set_image(loaded.image);
        series_uid_ = loaded.series_uid;
        shown_ = loaded;
        shown_.image.volume.reset();
        shown_path_ = path;
        desk_.messages.set_shown_name(QString::fromStdString(loaded.name));
        take_first_sight();
        desk_.machine.remember_image(reference.sha256, path, loaded.series_uid);
      },
      true);
  if (!shown_now) return;
  if (!reference.axes.empty())
    desk_.messages.say(tr("The image is turned as a person said: File > Set orientation."));
  if (!loaded.warnings.empty()) desk_.messages.say(library_text(loaded.warnings.front()));
  if (loaded.series_uid.empty() || !folder_)
    emit image_alone();
  else
    emit series_shown(folder_, loaded.series_uid, path);
  if (loaded.axes_guessed && reference.axes.empty() && !bench.has_case())
    emit axes_unknown();
  else if (!bench.has_case())
    emit image_without_case();
}

}  // namespace ostia::workstation
