#include "phases/beating_case.h"

#include "phases/bar.h"
#include "phases/profile.h"
#include "shell/desk.h"
#include "shell/docks.h"
#include "shell/file_dialogs.h"
#include "views/paint_queue.h"
#include "views/scene_widget.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/io/cage_motion_file.h"

#include <QMainWindow>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr int least_frame_ms = 16;
constexpr int profile_lines = 12;           // of text, as high as the profile over the cycle is at first
constexpr double own_phase_percent = 0.05;  // the slider's step, halved

}  // namespace

BeatingCase::BeatingCase(Desk& desk, QMainWindow& window)
    : QObject(&window), desk_(desk), room_(new QToolBar), bar_(new PhaseBar(clock_)) {
  room_->setObjectName("phase_room");
  room_->setWindowTitle(tr("Phase of the heart"));
  room_->setMovable(false);
  room_->toggleViewAction()->setVisible(false);  // it comes and goes with the motion
  room_->addWidget(bar_);
  window.addToolBar(Qt::BottomToolBarArea, room_);
  room_->hide();
  profile_ = new PhaseProfile(desk, clock_, [this] {
    std::shared_ptr<const session::Beating> now;
    if (motion_) desk_.messages.guarded([&] { now = beating(); });
    return now;
  });
  window.addDockWidget(Qt::BottomDockWidgetArea, profile_);
  profile_->hide();
  profile_->toggleViewAction()->setVisible(false);
  connect(&bar_->profile_button(), &QToolButton::clicked, profile_, [this, &window](bool wanted) {
    profile_->setVisible(wanted);
    if (wanted)
      size_at_first(window, *profile_, profile_->fontMetrics().height() * profile_lines, Qt::Vertical);
  });
  connect(profile_, &QDockWidget::visibilityChanged, &bar_->profile_button(), &QToolButton::setChecked);
  connect(bar_, &PhaseBar::images_wanted, this, &BeatingCase::ask_images);
  connect(&images_, &PhaseLoader::arrived, this, &BeatingCase::show);
  connect(&images_, &PhaseLoader::failed, this, [this](const QString& why) { desk_.messages.say(why); });
  frame_.setSingleShot(true);
  frame_.setTimerType(Qt::PreciseTimer);
  connect(&frame_, &QTimer::timeout, this, &BeatingCase::next_frame);
  connect(bar_, &PhaseBar::back_wanted, this, &BeatingCase::go_to_own);
  connect(bar_, &PhaseBar::close_wanted, this, &BeatingCase::close);
  session::Workbench& bench = desk.bench;
  own_.push_back(clock_.percent.observe([this](const double&) { show(); }));
  own_.push_back(clock_.playing.observe([this](const bool& playing) {
    since_frame_.start();
    playing ? frame_.start(0) : frame_.stop();
  }));
  own_.push_back(bench.case_changed.observe([this] {
    desk_.jobs.cancel("motion");  // what is still being read is for the former case
    close();
  }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) { beating_.reset(); }));
  own_.push_back(bench.phase_changed.observe([this] { bar_->set_away(desk_.bench.other_phase()); }));
  own_.push_back(bench.phase_refused.observe([this] {
    clock_.playing.set(false);
    if (motion_) bar_->offer_way_back();
  }));
}

BeatingCase::~BeatingCase() = default;

void BeatingCase::ask() {
  const QString chosen =
      ask_open_file(&desk_.window, tr("Open a motion"), tr("Motions (*.json);;All files (*)"));
  if (!chosen.isEmpty()) open(chosen.toStdString());
}

void BeatingCase::open(const std::filesystem::path& file) {
  desk_.jobs.run(
      "motion", tr("Reading the motion"),
      [file](const core::TaskContext&) { return std::any(io::read_cage_motion(file).motion); },
      [this](const std::any& read) {
        if (!desk_.bench.has_case()) return;
        desk_.messages.guarded([&] { take(std::any_cast<const geometry::CageMotion&>(read)); }, true);
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The motion cannot be opened"));
      });
}

void BeatingCase::take(const geometry::CageMotion& motion) {
  close();
  motion_ = motion;
  beating_.reset();
  try {
    beating();  // it may be another tree's
  } catch (...) {
    close();
    throw;
  }
  bar_->set_motion(motion);
  clock_.percent.set(100.0 * motion.template_phase);
  room_->show();
  emit shown_changed();
}

void BeatingCase::ask_images() {
  const QString chosen = ask_folder(&desk_.window, tr("Folder with the images of the phases"));
  if (!chosen.isEmpty()) open_images(chosen.toStdString());
}

void BeatingCase::open_images(const std::filesystem::path& folder) {
  core::redact_in_logs(folder.string(), "the phases");  // it may name the patient
  desk_.jobs.run(
      "phase_images", tr("Looking for the phases"),
      [folder](const core::TaskContext& task) { return std::any(session::find_phase_images(folder, task)); },
      [this](const std::any& found) {
        if (!motion_) return;
        take_images(std::any_cast<const std::vector<session::PhaseSource>&>(found));
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The images of the phases cannot be opened"));
      });
}

void BeatingCase::take_images(std::vector<session::PhaseSource> sources) {
  if (!motion_ || sources.empty()) return;
  bar_->set_images(sources.size());
  images_.set(std::move(sources), motion_->template_phase);
  show();
}

std::shared_ptr<const session::Beating> BeatingCase::carrying() {
  if (!motion_) throw InvalidInput("no motion is open");
  return beating();
}

void BeatingCase::close() {
  clock_.playing.set(false);
  motion_.reset();
  beating_.reset();
  desk_.jobs.cancel("phase_images");
  images_.clear();
  desk_.messages.guarded([this] { desk_.bench.show_phase(nullptr); });  // what follows is done all the same
  put_away();
  profile_->refresh();
  emit shown_changed();
}

void BeatingCase::put_away() {
  room_->hide();
  profile_->hide();
}

void BeatingCase::toggle() {
  if (motion_) clock_.toggle();
}

void BeatingCase::go_to_own() {
  if (!motion_) return;
  clock_.playing.set(false);
  clock_.percent.set(100.0 * motion_->template_phase);
  show();
}

const std::shared_ptr<const session::Beating>& BeatingCase::beating() {
  if (!beating_) {
    session::Session& session = desk_.bench.session();
    beating_ = session::Beating::made(*motion_, session.file().model(),
                                      session.live().wall(SceneWidget::screen_cell_mm));
  }
  return beating_;
}

void BeatingCase::show() {
  if (!motion_ || !desk_.bench.has_case()) return;
  const bool shown = desk_.messages.guarded([&] {
    // While it plays it goes through its own phase as through the others.
    if (!clock_.playing.get() &&
        100.0 * session::phase_distance(clock_.phase(), motion_->template_phase) < own_phase_percent)
      desk_.bench.show_phase(nullptr);
    else
      desk_.bench.show_phase(beating()->at(clock_.phase()), images_.image_for(clock_.phase()));
  });
  if (!shown) clock_.playing.set(false);
}

/// The next one comes when all views have been painted, so that they show the same phase.
void BeatingCase::next_frame() {
  if (!clock_.playing.get()) return;
  const double seconds = static_cast<double>(since_frame_.restart()) / 1000.0;
  clock_.pass(seconds);
  if (!clock_.playing.get()) return;
  PaintQueue::instance().add_last(this, [this] {
    if (!clock_.playing.get()) return;
    frame_.start(static_cast<int>(std::max<qint64>(0, least_frame_ms - since_frame_.elapsed())));
  });
}

}  // namespace ostia::workstation
