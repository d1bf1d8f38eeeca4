#include "comparison/comparing.h"

#include "comparison/former_case.h"
#include "comparison/lesion_changes.h"
#include "shell/desk.h"
#include "shell/file_dialogs.h"
#include "shell/library_texts.h"
#include "shell/new_folder.h"
#include "shell/two_patients.h"
#include "views/scene_widget.h"

#include "ostia/core/error.h"
#include "ostia/figure/plot.h"
#include "ostia/session/report_digest.h"

#include <QMessageBox>
#include <QPushButton>
#include <any>
#include <tuple>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

const char* const comparison_job = "comparison";

QString compared_path(const fs::path& path) {
  return QString::fromStdString(path.string());
}

/// Of lesions that a reader has rejected, which are not compared.
std::vector<std::tuple<std::int32_t, double, double>> rejected_lesions(const session::Annotations& of) {
  std::vector<std::tuple<std::int32_t, double, double>> rejected;
  for (const session::VesselMark& mark : of.marks)
    for (const session::LesionWord& word : mark.lesions)
      if (word.state == session::LesionState::rejected)
        rejected.emplace_back(mark.vessel, word.from_mm, word.to_mm);
  return rejected;
}

/// Where a person looks first: the narrowest place of the scan's lesions in the stretch, else its middle.
double place_in(const analysis::PlacedStretch& stretch, const std::vector<std::size_t>& lesions,
                const session::ComparedCase& of) {
  const analysis::Stenosis* worst = nullptr;
  for (const std::size_t i : lesions) {
    const analysis::Stenosis& one = of.tree.lesions[i].stenosis;
    if (one.vessel == stretch.vessel && (!worst || one.least_area_mm2 < worst->least_area_mm2)) worst = &one;
  }
  return worst ? worst->throat_mm : 0.5 * (stretch.from_mm + stretch.to_mm);
}

std::shared_ptr<const geometry::TriMesh> carried_wall(geometry::TriMesh wall,
                                                      const geometry::RigidFit& motion) {
  for (geometry::Vec3& point : wall.points) point = motion(point);
  return std::make_shared<const geometry::TriMesh>(std::move(wall));
}

}  // namespace

/// What a job has found.
struct Comparing::Made {
  std::shared_ptr<const FormerCase> former;
  FormerImage image;
  std::string image_trouble;  ///< it could not be read: nothing was compared
  session::Comparison comparison;
  std::shared_ptr<const geometry::TriMesh> former_wall;     ///< in the former scan
  std::shared_ptr<const session::Annotations> annotations;  ///< of the case on the table
  std::string now_digest;                                   ///< session::report_digest
};

Comparing::Comparing(Desk& desk) : QObject(&desk.window), desk_(desk), cursor_(desk.bench, former_) {
  own_.push_back(desk.bench.case_changed.observe([this] { close(); }));
  own_.push_back(desk.bench.model_changed.observe([this](const session::ModelEvent&) {
    if (shown_) outdated.set(true);
  }));
  own_.push_back(desk.bench.annotations_changed.observe([this] {
    if (!shown_ || !desk_.bench.has_case()) return;
    const auto now = desk_.bench.session().file().annotations();
    if (rejected_lesions(*now) != rejected_lesions(*shown_->annotations)) outdated.set(true);
  }));
}

Comparing::~Comparing() = default;

bool Comparing::running() const {
  return desk_.jobs.running(comparison_job);
}

QString Comparing::why_not_choose() const {
  return desk_.bench.has_case() ? QString() : tr("No case is open.");
}

QString Comparing::why_none() const {
  return made_ ? QString() : tr("The case has not been compared with a former one.");
}

QString Comparing::former_name() const {
  const auto image = shown_ ? shown_->former->moment.reference : std::nullopt;
  return image ? QString::fromStdString(image->pseudonym) : tr("the former scan");
}

void Comparing::choose() {
  const QString chosen = ask_open_file(&desk_.window, tr("The same patient's former case"),
                                       tr("Cases (*.ostia);;All files (*)"));
  if (!chosen.isEmpty()) compare_with(chosen.toStdString());
}

void Comparing::compare_with(const fs::path& former_case) {
  if (!desk_.bench.has_case()) return desk_.messages.say(why_not_choose());
  std::error_code ignored;
  if (fs::equivalent(former_case, desk_.case_path, ignored))
    return desk_.messages.complain(
        tr("%1 is the case that is open. Choose the case of the patient's former scan.")
            .arg(compared_path(former_case)),
        tr("Nothing was compared"));
  desk_.jobs.run(
      comparison_job, tr("Reading the former case"),
      [former_case](const core::TaskContext&) { return std::any(read_former_case(former_case)); },
      [this](const std::any& result) {
        const auto former = std::any_cast<std::shared_ptr<const FormerCase>>(result);
        if (!desk_.bench.has_case()) return;
        const auto& image = former->moment.reference;
        const auto known = image ? desk_.machine.find_image(image->sha256) : std::nullopt;
        if (image && !known)
          ask_for_image(former, {});
        else
          compare(former, {known, {}});
      },
      [this](const QString& message) { desk_.messages.complain(message, tr("Nothing was compared")); });
}

void Comparing::ask_for_image(const std::shared_ptr<const FormerCase>& former, const QString& reason) {
  auto* box = new QMessageBox(
      QMessageBox::Question, tr("The image of the former case"),
      (reason.isEmpty() ? reason : reason + "\n\n") +
          tr("The image that the former case was made on (%1) is not where it was, or has never been opened "
             "on "
             "this computer. Without it lumens are compared, and neither plaque nor pictures.")
              .arg(QString::fromStdString(former->moment.reference->pseudonym)),
      QMessageBox::NoButton, &desk_.window);
  box->setObjectName("comparison_image");
  box->setAttribute(Qt::WA_DeleteOnClose);
  const QAbstractButton* file = box->addButton(tr("Find the file\u2026"), QMessageBox::AcceptRole);
  const QAbstractButton* folder = box->addButton(tr("Find the DICOM folder\u2026"), QMessageBox::AcceptRole);
  const QAbstractButton* without = box->addButton(tr("Go on without"), QMessageBox::ActionRole);
  box->addButton(QMessageBox::Cancel);
  connect(box, &QMessageBox::buttonClicked, this,
          [this, former, file, folder, without](QAbstractButton* button) {
            const QString title = tr("The image of the former case");
            QString chosen;
            if (button == file) chosen = ask_open_file(&desk_.window, title);
            if (button == folder) chosen = ask_folder(&desk_.window, title);
            if (!chosen.isEmpty())
              compare(former, {session::KnownImage{chosen.toStdString(), {}}, {}});
            else if (button == without)
              compare(former, {});
          });
  box->open();
}

void Comparing::compare(const std::shared_ptr<const FormerCase>& former, const FormerImage& image) {
  if (!desk_.bench.has_case()) return;
  const session::CaseFile& file = desk_.bench.session().file();
  session::CaseMoment now = session::moment_of(file);
  const session::OpenImage& shown = desk_.bench.image();
  std::optional<session::KnownImage> known;
  if (!shown.reference.sha256.empty()) {  // else one slice of it alone has been read
    now.image = shown.volume;
    known = desk_.machine.find_image(shown.reference.sha256);
  }
  // Measured once, however often it is compared.
  const bool same_former = shown_ && shown_->former == former;
  const auto measured = same_former ? made_ : nullptr;
  const auto wall = same_former ? shown_->former_wall : nullptr;
  desk_.jobs.run(
      comparison_job, tr("Comparing the two scans"),
      [former, image, now, known, measured, wall,
       digest = session::report_digest(file)](const core::TaskContext& task) {
        auto found = std::make_shared<Made>();
        found->former = former;
        found->annotations = now.annotations;
        found->now_digest = digest;
        try {
          found->image = read_former_image(*former, image, task.sub(0.0, 0.2));
        } catch (const Cancelled&) {
          throw;
        } catch (const Error& error) {
          found->image_trouble = error.what();
          return std::any(found);
        }
        session::ComparedCase before =
            measured ? measured->before : measured_former(*former, found->image, task.sub(0.2, 0.5));
        found->former_wall = wall ? wall
                                  : std::make_shared<const geometry::TriMesh>(former->session->live().wall(
                                        SceneWidget::screen_cell_mm, task.sub(0.5, 0.6)));
        found->comparison = compared_now(std::move(before), now, known, task.sub(0.6, 1.0));
        return std::any(found);
      },
      [this](const std::any& result) { take(std::any_cast<std::shared_ptr<Made>>(result)); },
      [this](const QString& message) { desk_.messages.complain(message, tr("Nothing was compared")); });
}

void Comparing::compare_again() {
  if (shown_) compare(shown_->former, shown_->image);
}

void Comparing::take(const std::shared_ptr<Made>& found) {
  if (!desk_.bench.has_case()) return;
  if (!found->image_trouble.empty()) return ask_for_image(found->former, library_text(found->image_trouble));
  QStringList why;
  const auto now = desk_.bench.session().file().image();
  const auto& then = found->former->moment.reference;
  if (now && then &&
      two_patients(desk_.identity.of_image(now->sha256), desk_.identity.of_image(then->sha256)))
    why << tr("The images are known as those of two patients.");
  if (!found->comparison.another_patient.empty()) why << library_text(found->comparison.another_patient);
  const bool agreed = shown_ && shown_->former == found->former;  // it was asked before
  if (why.isEmpty() || agreed)
    show(found);
  else
    doubt(found, why);
}

void Comparing::doubt(const std::shared_ptr<Made>& found, const QStringList& why) {
  auto* box = new QMessageBox(
      QMessageBox::Warning, tr("Hardly one patient"),
      tr("The two cases are hardly of one patient, and nothing was compared.\n\n%1").arg(why.join('\n')),
      QMessageBox::NoButton, &desk_.window);
  box->setObjectName("comparison_doubt");
  box->setAttribute(Qt::WA_DeleteOnClose);
  const QAbstractButton* anyway = box->addButton(tr("Compare all the same"), QMessageBox::AcceptRole);
  box->setDefaultButton(box->addButton(QMessageBox::Cancel));
  connect(box, &QMessageBox::buttonClicked, this, [this, found, anyway](QAbstractButton* button) {
    if (button == anyway && desk_.bench.has_case()) show(found);
  });
  box->open();
}

void Comparing::show(const std::shared_ptr<Made>& found) {
  const bool same_former = shown_ && shown_->former == found->former;
  if (!same_former) close();
  const bool ready = desk_.messages.guarded(
      [&] {
        if (same_former) return;
        if (found->image.volume) former_.set_image({found->image.volume, *found->former->moment.reference});
        former_.set_session(std::move(*found->former->session));
      },
      true);
  if (!ready) return;
  made_ = std::make_shared<const session::Comparison>(std::move(found->comparison));
  shown_ = found;
  for (const analysis::ScannedVessel& vessel : made_->before.tree.vessels)
    if (const auto work = former_.profile_work(vessel.vessel)) former_.take_profile(*work, vessel.profile);
  former_wall_ = carried_wall(*found->former_wall, made_->fit.motion);
  outdated.set(false);
  cursor_.set(made_);
  changed.tell();
}

void Comparing::close() {
  desk_.jobs.cancel(comparison_job);
  if (!shown_) return;
  cursor_.set(nullptr);
  made_.reset();
  former_wall_.reset();
  shown_.reset();
  former_.close_case();
  former_.close_image();
  outdated.set(false);
  changed.tell();
}

void Comparing::go_to(int lesion) {
  if (!made_ || lesion < 0 || static_cast<std::size_t>(lesion) >= made_->change.lesions.size()) return;
  const analysis::LesionChange& one = made_->change.lesions[static_cast<std::size_t>(lesion)];
  session::Workbench& bench = one.after_stretch ? desk_.bench : former_;
  const auto& stretch = one.after_stretch ? one.after_stretch : one.before_stretch;
  if (!stretch || !bench.axis(stretch->vessel)) return;
  bench.vessel.set(stretch->vessel);
  bench.cursor_mm.set(bench.here_mm(one.after_stretch ? place_in(*stretch, one.after, made_->after)
                                                      : place_in(*stretch, one.before, made_->before)));
}

std::vector<session::KeyImage> Comparing::pages() const {
  std::vector<session::KeyImage> pages;
  if (!made_) return pages;
  const QString caption = tr("Compared with the scan %1").arg(former_name());
  std::vector<std::string> header;
  for (const QString& column : lesion_change_columns()) header.push_back(column.toStdString());
  std::vector<std::vector<std::string>> rows;
  for (const analysis::LesionChange& lesion : made_->change.lesions) {
    rows.emplace_back();
    for (const QString& cell : lesion_change_cells(*made_, lesion)) rows.back().push_back(cell.toStdString());
  }
  if (!rows.empty())
    pages.push_back({"", tr("%1: lesions, before \u2192 now").arg(caption).toStdString(),
                     figure::table_figure(header, rows, {})});
  for (session::KeyImage image : session::comparison_images(*made_)) {
    image.caption = caption.toStdString() + ": " + image.caption;
    pages.push_back(std::move(image));
  }
  return pages;
}

void Comparing::save() {
  const QString chosen = ask_folder(&desk_.window, tr("Where the comparison's folder is made"));
  if (chosen.isEmpty() || !made_) return;
  const fs::path folder =
      free_folder(fs::path(chosen.toStdString()) / (desk_.case_path.stem().string() + "-compared"));
  const ExitCode code = made_->another_patient.empty() ? ExitCode::ok : ExitCode::quality_failed;
  const pipeline::JobKey key{"compare", {{"old", shown_->former->digest}, {"new", shown_->now_digest}}, "{}"};
  desk_.jobs.run(
      "comparison_report", tr("Comparison"),
      [made = made_, folder, key, code](const core::TaskContext& task) {
        session::write_comparison(folder, *made, key, code, 0.0, task);
        return std::any(true);
      },
      [this, folder](const std::any&) {
        desk_.messages.say(tr("The comparison is in %1.").arg(compared_path(folder)));
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The comparison was not written"));
      });
}

}  // namespace ostia::workstation
