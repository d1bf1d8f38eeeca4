#include "calcium/reading.h"

#include "opening/opening.h"
#include "opening/technique.h"
#include "shell/desk.h"
#include "shell/file_dialogs.h"
#include "shell/new_folder.h"
#include "shell/two_patients.h"
#include "views/picture_widget.h"

#include "ostia/core/text.h"
#include "ostia/pipeline/calcium_report.h"
#include "ostia/session/image_digest.h"

#include <QScopedValueRollback>
#include <any>
#include <cmath>
#include <utility>

namespace ostia::workstation {
namespace {

const char* const calcium_job = "calcium";

/// Among this machine's cases.
std::filesystem::path calcium_case_of(const Desk& desk, const session::ImageReference& image) {
  return desk.state_folder / "cases" / (image.pseudonym + "-calcium.ostia");
}

}  // namespace

Calcium::Calcium(Desk& desk, Opening& opening, const std::vector<PictureWidget*>& pictures,
                 ShownSeries series)
    : QObject(&desk.window), desk_(desk), shown_series_(std::move(series)) {
  for (PictureWidget* picture : pictures)
    if (auto* plane = dynamic_cast<view::PlaneView*>(&picture->view()))
      layers_.push_back(std::make_unique<view::CalciumLayer>(*plane, board_));
  connect(&opening, &Opening::calcium_case_chosen, this, [this](const QString& image, const QString& file) {
    expect(image.toStdString(), file.toStdString());
  });
  own_.push_back(desk.bench.place.observe([this](const geometry::Vec3&) { follow_place(); }));
  own_.push_back(desk.bench.image_changed.observe([this] {
    if (expects_shown()) score();
  }));
}

void Calcium::expect(const std::string& image_sha256, const std::filesystem::path& case_file) {
  expected_image_ = image_sha256;
  expected_case_ = case_file;
  if (expects_shown()) score(true);
}

bool Calcium::expects_shown() const {
  return !expected_image_.empty() && desk_.bench.image().volume &&
         desk_.bench.image().reference.sha256 == expected_image_;
}

bool Calcium::scoring() const {
  return desk_.jobs.running(calcium_job);
}

void Calcium::score(bool again) {
  board_.shown.set(true);
  const std::shared_ptr<const imaging::ImageVolume> scan = desk_.bench.shown_image();
  if (!scan || (board_.is_of(scan) && !again)) return;
  const bool beside = desk_.bench.other_image() != nullptr;
  const std::optional<imaging::DicomSeries> series = beside ? shown_series_() : std::nullopt;
  if (!beside && desk_.bench.image().reference.sha256.empty())
    return desk_.messages.say(tr("The image is still being read."));
  if (beside && !series)
    return desk_.messages.say(tr("Open this image by itself: it is not known which file it is of."));
  desk_.jobs.run(
      calcium_job, tr("Calcium score"),
      [scan, series, reference = desk_.bench.image().reference,
       known = desk_.machine.find_image(desk_.bench.image().reference.sha256),
       calibration = calibration_](const core::TaskContext& task) {
        session::CalciumReading reading;
        reading.scan = scan;
        reading.reference = series ? session::image_reference(*series, task.sub(0.0, 0.1)) : reference;
        const imaging::ScanTechnique technique =
            series ? imaging::scan_technique(*series) : technique_of(known, task.sub(0.0, 0.1));
        reading.tube_kv = technique.tube_kv;
        analysis::CalciumOptions options;
        options.slice_thickness_mm = technique.slice_mm;
        options.calibration = calibration;
        reading.scored = std::make_shared<const analysis::ScoredCalcium>(
            analysis::score_calcium(*scan, options, task.sub(0.1, 1.0)));
        return std::any(reading);
      },
      [this](const std::any& result) { take(std::any_cast<const session::CalciumReading&>(result)); },
      [this](const QString& message) { desk_.messages.complain(message, tr("There is no calcium score")); });
}

void Calcium::take(const session::CalciumReading& reading) {
  const bool expected = reading.reference.sha256 == expected_image_ && !expected_case_.empty();
  desk_.messages.guarded(
      [&] {
        board_.set_author(desk_.machine.setting(author_setting).value_or(""));
        board_.take(reading, expected ? expected_case_ : calcium_case_of(desk_, reading.reference));
      },
      true);
}

void Calcium::set_calibration(std::optional<double> calibration) {
  if (calibration == calibration_) return;
  calibration_ = calibration;
  if (board_.reading()) score(true);
}

void Calcium::say(analysis::CalciumPlace place) {
  board_.say(board_.chosen.get(), place);
}

void Calcium::choose(int number) {
  const analysis::CalciumLesion* lesion = board_.lesion(number);
  board_.chosen.set(lesion ? number : 0);
  if (!lesion || !board_.is_of(desk_.bench.shown_image())) return;
  const QScopedValueRollback<bool> choosing(choosing_, true);
  desk_.bench.place.set(lesion->centre);
}

/// A click on a lesion in a slice chooses it: the cursor has come to it.
void Calcium::follow_place() {
  if (choosing_ || !board_.shown.get() || !board_.is_of(desk_.bench.shown_image())) return;
  if (const int number = board_.lesion_at(desk_.bench.place.get())) board_.chosen.set(number);
}

bool Calcium::has_the_steps() const {
  if (!board_.reading() || !page_ || page_->isHidden()) return false;
  const QWidget* focus = desk_.window.focusWidget();
  return !desk_.bench.has_case() || (focus && page_->isAncestorOf(focus));
}

bool Calcium::can_take_back() const {
  return has_the_steps() && board_.can_undo();
}

bool Calcium::can_do_again() const {
  return has_the_steps() && board_.can_redo();
}

QString Calcium::why_not_into_report() const {
  if (!board_.reading()) return tr("No scan has been scored.");
  if (!desk_.bench.has_case()) return tr("No case is open whose report could take it.");
  const auto image = desk_.bench.session().file().image();
  if (image && two_patients(desk_.identity.of_image(image->sha256),
                            desk_.identity.of_image(board_.reading()->reference.sha256)))
    return tr("The case that is open is of another patient than the scan.");
  return {};
}

void Calcium::into_report() {
  session::ReportModifiers modifiers = desk_.bench.session().file().annotations()->report.modifiers;
  modifiers.agatston = std::round(10.0 * board_.score().total.agatston) / 10.0;
  desk_.bench.annotate(session::SetReportModifiers{modifiers});
  desk_.messages.say(tr("The report says an Agatston score of %1.")
                         .arg(QString::fromStdString(core::shown_text(*modifiers.agatston, 1))));
}

void Calcium::save() {
  const QString chosen = ask_folder(&desk_.window, tr("Where the calcium score's folder is made"));
  if (chosen.isEmpty()) return;
  const session::CalciumReading& reading = *board_.reading();
  const std::filesystem::path folder =
      free_folder(std::filesystem::path(chosen.toStdString()) / (reading.reference.pseudonym + "-calcium"));
  pipeline::ScoredScan scan{*reading.scored, reading.reference.pseudonym, reading.tube_kv};
  scan.scored.score = board_.score();
  const pipeline::JobKey key{"calcium", {{"image", reading.reference.sha256}}, "{}"};
  desk_.jobs.run(
      "calcium_report", tr("Calcium score"),
      [scan = std::make_shared<const pipeline::ScoredScan>(std::move(scan)), key,
       folder](const core::TaskContext& task) {
        pipeline::write_calcium_report(folder, *scan, key, 0.0, task);
        return std::any(true);
      },
      [this, folder](const std::any&) {
        desk_.messages.say(tr("The calcium score is in %1.").arg(QString::fromStdString(folder.string())));
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The calcium score was not written"));
      });
}

}  // namespace ostia::workstation
