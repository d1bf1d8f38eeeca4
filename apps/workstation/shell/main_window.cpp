#include "shell/main_window.h"

#include "calcium/page.h"
#include "calcium/reading.h"
#include "commands/table.h"
#include "comparison/comparing.h"
#include "comparison/page.h"
#include "flow/cases.h"
#include "flow/results.h"
#include "measuring/lesions.h"
#include "measuring/reporting.h"
#include "meshing/dock.h"
#include "meshing/export.h"
#include "meshing/preview.h"
#include "opening/opening.h"
#include "opening/orientation.h"
#include "opening/start_page.h"
#include "phases/beating_case.h"
#include "phases/study_series.h"
#include "pressure/live.h"
#include "pressure/page.h"
#include "qa/dock.h"
#include "shell/docks.h"
#include "shell/failure_panel.h"
#include "shell/hanging.h"
#include "shell/layouts.h"
#include "shell/library_texts.h"
#include "shell/status_line.h"
#include "shell/theme.h"
#include "shell/unfinished_work.h"
#include "trees/opening.h"
#include "vessels/evaluability.h"
#include "vessels/fat.h"
#include "vessels/finder.h"
#include "vessels/list.h"
#include "vessels/outer_walls.h"
#include "views/box_grip.h"
#include "views/frame_log.h"
#include "views/heart_behind.h"
#include "views/heart_dock.h"
#include "views/heart_memory.h"
#include "views/heart_volume.h"
#include "views/planes_dock.h"
#include "views/scissors.h"

#include <QCloseEvent>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialog>
#include <QDragEnterEvent>
#include <QLabel>
#include <QMimeData>
#include <QScreen>
#include <QSplitter>
#include <QStatusBar>

namespace ostia::workstation {
namespace {

constexpr int heartbeat_ms = 20;
constexpr double blocked_ms = 50.0;
constexpr int message_ms = 8000;
constexpr int most_letters_of_name = 40;  // what is said has the rest

QStringList local_files(const QMimeData& data) {
  QStringList files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files << url.toLocalFile();
  return files;
}

}  // namespace

MainWindow::MainWindow(const std::filesystem::path& state_folder)
    : desk_(
          *this, state_folder, [this](const QString& text) { statusBar()->showMessage(text, message_ms); },
          [this](const QString& text) { shown_name_->setText(text); }) {
  setObjectName("ostia");
  setWindowTitle("Ostia");
  setAcceptDrops(true);
  resize(QSize(1600, 1000).boundedTo(screen()->availableSize()));
  const auto theme = desk_.machine.setting("theme");
  apply_theme(theme && *theme == "light" ? Theme::light : Theme::dark);
  build_status_bar();
  build_parts();
  build_commands();
  connect_parts();
  auto* start = new StartPage(desk_, *commands_, panels_->curved());
  new FailurePanel(desk_, *commands_, panels_->curved());
  connect(start, &StartPage::file_chosen, this, [this](const QString& path) { open(path.toStdString()); });
  restore_layout();
  watch_case();
  for (const std::string& notice : desk_.machine.take_notices()) desk_.messages.say(library_text(notice));
  count_blocks();
  QTimer::singleShot(0, this, [this] {
    if (!desk_.bench.has_case() && !desk_.jobs.any()) opening_->recover();
  });
}

MainWindow::~MainWindow() {
  // Children go in the order of their making: a dialog that is open would outlive the jobs that it cancels.
  while (QDialog* dialog = findChild<QDialog*>()) delete dialog;
  delete pressure_page_;  // these and the list watch what goes before them
  delete calcium_page_;
  delete fat_page_;
  delete comparison_page_;
  panels_->lesions().show_pressures(nullptr);
}

void MainWindow::build_status_bar() {
  setStatusBar(new StatusLine(this));
  place_ = new QLabel(this);
  place_->setObjectName("place");
  shown_name_ = new ElidedLabel(most_letters_of_name, this);
  shown_name_->setObjectName("shown_name");
  shown_name_->setContentsMargins(0, 0, 12, 0);
  read_only_ = new QLabel(tr("Read-only"), this);
  read_only_->setObjectName("read_only");
  read_only_->setContentsMargins(0, 0, 12, 0);
  read_only_->setToolTip(
      tr("The case's file or its folder may not be written. File > Save the case as makes a copy that can "
         "be edited."));
  read_only_->hide();
  statusBar()->addPermanentWidget(&desk_.jobs);
  // A strut and not the bar's own minimum, which would hold it at one line however many jobs run.
  place_->setMinimumHeight(desk_.jobs.line_height());
  statusBar()->addPermanentWidget(read_only_);
  read_only_->hide();  // taking it in shows it
  statusBar()->addPermanentWidget(shown_name_);
  statusBar()->addPermanentWidget(place_);
  place_->setMinimumWidth(
      place_->fontMetrics().horizontalAdvance("-1000 HU   x -000.0  y -000.0  z -0000.0 mm"));
}

void MainWindow::build_qa() {
  const Guard loud = [this](const std::function<void()>& act) { desk_.messages.guarded(act, true); };
  qa_ = std::make_shared<QaDock>(desk_.bench, panels_->pictures(), panels_->scene(), desk_.jobs, loud, this);
  connect(qa_.get(), &QaDock::said, this, [this](const QString& text) { desk_.messages.say(text); });
  connect(qa_.get(), &QaDock::refused, this,
          [this](const QString& why) { desk_.messages.complain(why, tr("The truth cannot be opened")); });
  addDockWidget(Qt::RightDockWidgetArea, qa_.get());
  qa_->hide();
}

void MainWindow::build_parts() {
  opening_ = std::make_unique<Opening>(desk_);
  reporting_ = std::make_unique<Reporting>(desk_);
  finder_ = std::make_unique<VesselFinder>(desk_, *opening_);
  orientation_ = std::make_unique<Orientation>(desk_, *opening_, [this] { finder_->find_tree(); });
  panels_ = new PanelLayout(desk_);
  panels_->add_beside_tree(heart_behind(panels_->scene()));
  heart_ = new HeartVolume(desk_, panels_->scene(), [this] { return opening_->reading(); });
  new BoxGrip(*heart_, panels_->scene());
  auto* memory = new HeartMemory(desk_, *heart_);
  connect(opening_.get(), &Opening::leaving_case, memory, &HeartMemory::keep);
  scissors_ =
      std::make_unique<Scissors>(panels_->scene(), [this](const view::VolumeCut& cut) { heart_->cut(cut); });
  setCentralWidget(&panels_->whole());
  meshing_ = std::make_unique<MeshingExport>(desk_, panels_->scene());
  flow_results_ = std::make_unique<FlowResults>(desk_, panels_->scene(), panels_->profile());
  flow_cases_ = std::make_unique<FlowCases>(desk_, *flow_results_);
  beating_ = new BeatingCase(desk_, *this);
  series_ = new StudySeries(desk_, *this, *beating_);
  outer_walls_ = std::make_unique<OuterWalls>(desk_, panels_->pictures(), &panels_->profile());
  evaluability_ =
      std::make_unique<Evaluability>(desk_, panels_->pictures(), panels_->profile(), panels_->scene());
  panels_->vessels().show_evaluability(evaluability_->board());
  lesions_ = std::make_unique<Lesions>(desk_, evaluability_->board(), outer_walls_->board().found(),
                                       panels_->lesions());
  pressures_ = std::make_unique<Pressures>(desk_, panels_->pictures(), panels_->profile(), panels_->scene());
  panels_->lesions().show_pressures(&pressures_->board());
  pressure_page_ = new PressurePage(desk_, *pressures_);
  addDockWidget(Qt::RightDockWidgetArea, pressure_page_);
  pressure_page_->hide();
  build_qa();
  addDockWidget(Qt::RightDockWidgetArea, &meshing_->dock());
  meshing_->dock().hide();
  planes_ = new PlanesDock(desk_, this);
  addDockWidget(Qt::RightDockWidgetArea, planes_);
  planes_->hide();
  heart_dock_ = new HeartDock(*heart_, this);
  addDockWidget(Qt::RightDockWidgetArea, heart_dock_);
  heart_dock_->hide();
  layouts_ = std::make_unique<Layouts>(desk_, *this, *panels_, *planes_, *heart_);
  build_tissues();
  build_comparison();
}

/// Calcium and fat.
void MainWindow::build_tissues() {
  std::vector<PictureWidget*> slices = panels_->pictures();
  slices.insert(slices.end(), planes_->pictures().begin(), planes_->pictures().end());
  calcium_ =
      std::make_unique<Calcium>(desk_, *opening_, slices, [this]() -> std::optional<imaging::DicomSeries> {
        const int n = series_->shown();
        if (n < 0) return std::nullopt;
        return series_->stack().entries[static_cast<std::size_t>(n)].source.series;
      });
  calcium_page_ = new CalciumPage(desk_, *calcium_);
  addDockWidget(Qt::RightDockWidgetArea, calcium_page_);
  calcium_page_->hide();
  fat_ = std::make_unique<Fat>(desk_, panels_->pictures());
  fat_page_ = new FatPage(desk_, *fat_);
  addDockWidget(Qt::RightDockWidgetArea, fat_page_);
  fat_page_->hide();
}

void MainWindow::build_comparison() {
  comparing_ = std::make_unique<Comparing>(desk_);
  comparison_page_ = new ComparisonPage(desk_, *this, *comparing_);
}

void MainWindow::connect_parts() {
  connect(panels_, &PanelLayout::hovered, place_, &QLabel::setText);
  connect(panels_, &PanelLayout::end_chosen, finder_.get(), &VesselFinder::find_vessel);
  connect(&panels_->vessels(), &VesselList::last_deleted, finder_.get(), &VesselFinder::delete_last);
  connect(planes_, &PlanesDock::hovered, place_, &QLabel::setText);
  connect(comparison_page_, &ComparisonPage::hovered, place_, &QLabel::setText);
  connect(planes_, &PlanesDock::end_chosen, finder_.get(), &VesselFinder::find_vessel);
  connect(panels_, &PanelLayout::narrow_changed, place_, [this, wide = place_->minimumWidth()](bool narrow) {
    place_->setMinimumWidth(narrow ? 0 : wide);  // what a tool says needs the room
  });
  connect(opening_.get(), &Opening::file_chosen, this,
          [this](const QString& path) { open(path.toStdString()); });
  connect(opening_.get(), &Opening::series_shown, series_, &StudySeries::take);
  connect(opening_.get(), &Opening::image_alone, series_, &StudySeries::take_alone);
  connect(series_, &StudySeries::series_wanted, opening_.get(), &Opening::open_beside);
  connect(series_, &StudySeries::file_wanted, opening_.get(), &Opening::file_chosen);
  connect(opening_.get(), &Opening::image_without_case, this, [this] {
    if (!calcium_->expects_shown()) finder_->find_tree();
  });
  connect(opening_.get(), &Opening::calcium_case_chosen, calcium_page_, &QWidget::show);
  connect(flow_results_.get(), &FlowResults::pointed, place_, &QLabel::setText);
  connect(meshing_.get(), &MeshingExport::mesh_made, flow_cases_.get(),
          [this](const QString& file) { flow_cases_->mesh_made(file.toStdString()); });
}

void MainWindow::watch_case() {
  own_.push_back(desk_.bench.image_changed.observe([this] {
    if (!desk_.bench.image().volume) desk_.messages.set_shown_name({});
    trees_->close();  // what was opened last is shown
  }));
  own_.push_back(desk_.bench.case_changed.observe([this] {
    trees_->close();
    show_whether_editable();
  }));
  own_.push_back(desk_.identity.changed.observe([this] { show_title(); }));
  own_.push_back(
      desk_.bench.noted.observe([this](const std::string& note) { desk_.messages.say(library_text(note)); }));
}

void MainWindow::show_whether_editable() {
  read_only_->setVisible(desk_.bench.has_case() && !desk_.bench.session().file().editable());
  show_title();
}

void MainWindow::show_title() {
  const QString whose = identity_line(desk_.identity.now());
  if (read_only_->isHidden())
    setWindowTitle(whose.isEmpty() ? QStringLiteral("Ostia") : whose);
  else
    setWindowTitle(whose.isEmpty() ? tr("Ostia \u2013 read-only") : tr("%1 \u2013 read-only").arg(whose));
}

void MainWindow::count_blocks() {
  heartbeat_.setInterval(heartbeat_ms);
  connect(&heartbeat_, &QTimer::timeout, this, [this] {
    const double late = static_cast<double>(beat_.nsecsElapsed()) / 1e6 - heartbeat_ms;
    if (late > blocked_ms) FrameLog::instance().blocked(late);
    beat_.restart();
  });
  beat_.start();
  if (FrameLog::instance().on()) heartbeat_.start();
}

void MainWindow::open(const std::filesystem::path& path) {
  if (!mesh_meant_by(path).empty())
    meshing_->open_mesh(path);
  else if (TreeOpening::takes(path))
    trees_->open(path);
  else
    opening_->open(path);
}

void MainWindow::open_sample() {
  opening_->open_sample();
}

void MainWindow::remember_layout() {
  desk_.messages.guarded([&] { desk_.machine.set_settings(layouts_->now()); });
}

void MainWindow::restore_layout() {
  layouts_->arrange(desk_.machine.settings());
  // What was open of a mesh or a motion comes back with one.
  meshing_->dock().hide();
  beating_->put_away();
  series_->put_away();
  layouts_->begin();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!must_end_ && !may_be_left(desk_.jobs, this)) {
    event->ignore();
    return;
  }
  remember_layout();
  opening_->close_case();
  event->accept();
}

void MainWindow::end() {
  must_end_ = true;
  close();
  QCoreApplication::quit();  // boxes that are open, too
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (!local_files(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  const QStringList files = local_files(*event->mimeData());
  if (files.isEmpty()) return;
  event->acceptProposedAction();
  if (files.size() == 1)
    open(files.front().toStdString());
  else
    desk_.messages.complain(
        tr("Drop one case, image or folder at a time; of a DICOM series drop its folder."));
}

}  // namespace ostia::workstation
