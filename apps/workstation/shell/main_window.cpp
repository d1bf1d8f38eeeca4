#include "shell/main_window.h"

#include "flow/cases.h"
#include "flow/results.h"
#include "measuring/reporting.h"
#include "measuring/side_lists.h"
#include "meshing/export.h"
#include "meshing/preview.h"
#include "opening/opening.h"
#include "opening/start_page.h"
#include "phases/beating_case.h"
#include "shell/hanging.h"
#include "shell/unfinished_work.h"
#include "trees/opening.h"
#include "vessels/finder.h"
#include "vessels/list.h"
#include "vessels/outer_walls.h"
#include "views/frame_log.h"
#include "views/heart_behind.h"
#include "views/paint_queue.h"

#include "ostia/core/error.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <QCloseEvent>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialog>
#include <QDragEnterEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QMessageBox>
#include <QMimeData>
#include <QScreen>
#include <QSplitter>
#include <QStatusBar>
#include <QTabWidget>

namespace ostia::workstation {
namespace {

using view::CurvedView;
using view::SectionView;
using view::SliceKind;
using view::SliceView;

constexpr int heartbeat_ms = 20;
constexpr double blocked_ms = 50.0;
constexpr int message_ms = 8000;
constexpr double strip_step_mm = 1.0;
constexpr int strip_px = 56;  // of a neighbour at least

QStringList local_files(const QMimeData& data) {
  QStringList files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile()) files << url.toLocalFile();
  return files;
}

QByteArray decoded(const std::optional<std::string>& text) {
  return text ? QByteArray::fromBase64(QByteArray::fromStdString(*text)) : QByteArray();
}

}  // namespace

MainWindow::MainWindow(const std::filesystem::path& state_folder)
    : state_folder_(state_folder), machine_(state_folder) {
  setObjectName("ostia");
  setWindowTitle("Ostia");
  setAcceptDrops(true);
  resize(QSize(1600, 1000).boundedTo(screen()->availableSize()));
  guard_ = [this](const std::function<void()>& act) { guarded(act); };
  const auto theme = machine_.setting("theme");
  apply_theme(theme && *theme == "light" ? Theme::light : Theme::dark);
  opening_ = std::make_unique<Opening>(*this);
  reporting_ = std::make_unique<Reporting>(*this);
  meshing_export_ = std::make_unique<MeshingExport>(*this);
  finder_ = std::make_unique<VesselFinder>(*this, *opening_);
  build_views();
  flow_results_ = std::make_unique<FlowResults>(*this);
  flow_cases_ = std::make_unique<FlowCases>(*this);
  beating_ = new BeatingCase(*this);
  connect(flow_results_.get(), &FlowResults::pointed, place_, &QLabel::setText);
  outer_walls_ = std::make_unique<OuterWalls>(*this, pictures_, profile_);
  build_actions();
  build_tool_bar();
  new StartPage(*this, "curved");
  restore_layout();
  own_.push_back(bench_.image_changed.observe([this] {
    if (!bench_.image().volume) set_shown_name({});
    trees_->close();  // what was opened last is shown
  }));
  own_.push_back(bench_.case_changed.observe([this] { trees_->close(); }));
  own_.push_back(
      bench_.noted.observe([this](const std::string& note) { say(QString::fromStdString(note)); }));
  for (const std::string& notice : machine_.take_notices()) say(QString::fromStdString(notice));
  heartbeat_.setInterval(heartbeat_ms);
  connect(&heartbeat_, &QTimer::timeout, this, [this] {
    const double late = static_cast<double>(beat_.nsecsElapsed()) / 1e6 - heartbeat_ms;
    if (late > blocked_ms) FrameLog::instance().blocked(late);
    beat_.restart();
  });
  beat_.start();
  if (FrameLog::instance().on()) heartbeat_.start();
  QTimer::singleShot(0, this, [this] {
    if (!bench_.has_case() && !jobs_->any()) opening_->recover();
  });
}

MainWindow::~MainWindow() {
  // Children go in the order of their making: a dialog that is open would outlive the jobs that it cancels.
  while (QDialog* dialog = findChild<QDialog*>()) delete dialog;
}

bool MainWindow::guarded(const std::function<void()>& act, bool loud) {
  try {
    act();
    return true;
  } catch (const Cancelled&) {
  } catch (const std::bad_alloc&) {
    complain(tr("There is not enough memory for this. The case is unchanged."));
  } catch (const ResourceError& error) {
    complain(QString::fromStdString(error.what()));
  } catch (const IoError& error) {
    complain(QString::fromStdString(error.what()));
  } catch (const Error& error) {
    if (loud)
      complain(QString::fromStdString(error.what()));
    else
      say(QString::fromStdString(error.what()));
  }
  return false;
}

void MainWindow::say(const QString& text) {
  statusBar()->showMessage(text, message_ms);
}

void MainWindow::complain(const QString& text, const QString& title) {
  // While the mouse goes on with what is refused, one message says so, not one for every move.
  for (const auto* open : findChildren<QMessageBox*>())
    if (open->isVisible() && open->text() == text) return;
  auto* box = new QMessageBox(QMessageBox::Warning, title.isEmpty() ? QStringLiteral("Ostia") : title, text,
                              QMessageBox::Ok, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  box->open();
}

void MainWindow::set_shown_name(const QString& text) {
  shown_name_->setText(text);
}

void MainWindow::open(const std::filesystem::path& path) {
  if (!mesh_meant_by(path).empty())
    meshing_export_->open_mesh(path);
  else if (TreeOpening::takes(path))
    trees_->open(path);
  else
    opening_->open(path);
}

void MainWindow::open_sample() {
  opening_->open_sample();
}

const std::filesystem::path& MainWindow::case_path() const {
  return opening_->case_path();
}

Panel* MainWindow::picture_panel(const QString& title, const QString& name,
                                 std::unique_ptr<view::PictureView> shown) {
  auto* picture = new PictureWidget(std::move(shown), name, guard_);
  picture->setAccessibleName(title);
  pictures_.push_back(picture);
  connect(picture, &PictureWidget::hovered, this, [this](const QString& text) { place_->setText(text); });
  own_.push_back(picture->pointer().end_chosen.observe(
      [this](const geometry::Vec3& end) { finder_->find_vessel(end); }));
  auto* panel = new Panel(title, picture);
  connect(panel, &Panel::maximise_wanted, this, [this, panel] { maximise(panel); });
  return panel;
}

QWidget* MainWindow::curved_column() {
  auto* pair = new QSplitter(Qt::Horizontal);
  pair->setObjectName("curved");
  const auto frame = std::make_shared<view::CurvedFrame>();
  pair->addWidget(picture_panel(tr("CPR"), "cpr1",
                                std::make_unique<CurvedView>(bench_, CurvedView::Which::first, frame)));
  pair->addWidget(picture_panel(tr("CPR + 90\u00b0"), "cpr2",
                                std::make_unique<CurvedView>(bench_, CurvedView::Which::second, frame)));
  pictures_[pictures_.size() - 2]->set_twin(pictures_.back());
  pictures_.back()->set_twin(pictures_[pictures_.size() - 2]);
  PaintQueue::instance().set_prepare(&PictureWidget::prepare);
  pair->setSizes({280, 280});
  for (int i = 0; i < 2; ++i) pair->setStretchFactor(i, 1);
  splitters_.push_back(pair);
  return pair;
}

QWidget* MainWindow::section_column() {
  auto* column = new QSplitter(Qt::Vertical);
  column->setObjectName("sections");
  column->addWidget(
      picture_panel(tr("Cross-section"), "section", std::make_unique<SectionView>(bench_, 0.0)));
  auto* strip = new QWidget;
  auto* row = new QHBoxLayout(strip);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(1);
  for (const int step : {-2, -1, 1, 2}) {
    auto* picture = new PictureWidget(std::make_unique<SectionView>(bench_, step * strip_step_mm, 12.0),
                                      QStringLiteral("strip%1").arg(step), guard_);
    picture->setAccessibleName(tr("Cross-section, %1 mm on").arg(step * strip_step_mm));
    picture->setMinimumSize(strip_px, strip_px);
    pictures_.push_back(picture);
    row->addWidget(picture);
  }
  auto* panel = new Panel(tr("Neighbours, every %1 mm").arg(strip_step_mm), strip);
  connect(panel, &Panel::maximise_wanted, this, [this, panel] { maximise(panel); });
  column->addWidget(panel);
  auto* slice = new SliceView(bench_, SliceKind::axial);
  Panel* slices = picture_panel(tr("Slice"), "slice", std::unique_ptr<view::PictureView>(slice));
  auto* kind = new QComboBox;
  kind->setObjectName("slice_kind");
  for (const auto& [name, value] : {std::pair(tr("Axial"), SliceKind::axial),
                                    {tr("Coronal"), SliceKind::coronal},
                                    {tr("Sagittal"), SliceKind::sagittal},
                                    {tr("Oblique"), SliceKind::oblique}})
    kind->addItem(name, static_cast<int>(value));
  kind->setToolTip(tr("Oblique: Shift and drag turns it"));
  kind->setAccessibleName(tr("Orientation of the slice"));
  connect(kind, QOverload<int>::of(&QComboBox::activated), this, [slice, kind](int index) {
    slice->set_kind(static_cast<SliceKind>(kind->itemData(index).toInt()));
  });
  slices->add_control(kind);
  column->addWidget(slices);
  column->setSizes({360, 130, 360});
  splitters_.push_back(column);
  return column;
}

Panel* MainWindow::right_column() {
  scene_ = new SceneWidget(bench_, guard_);
  scene_->set_dark(current_theme() == Theme::dark);
  auto* panel = new Panel(tr("Coronary tree"), scene_);
  connect(panel, &Panel::maximise_wanted, this, [this, panel] { maximise(panel); });
  panel->add_control(heart_behind(*this, *opening_));
  return panel;
}

QWidget* MainWindow::side_column() {
  auto* column = new QSplitter(Qt::Vertical);
  column->setObjectName("side");
  const auto color_of = [this](std::int32_t vessel) { return scene_->color_of(vessel); };
  auto* list = new VesselList(bench_, color_of, guard_);
  connect(scene_, &SceneWidget::styles_changed, list, &VesselList::refresh);
  auto* vessels = new Panel(tr("Vessels"), list);
  connect(vessels, &Panel::maximise_wanted, this, [this, vessels] { maximise(vessels); });
  column->addWidget(vessels);
  auto* tabs = new QTabWidget;
  tabs->setObjectName("lists");
  tabs->setDocumentMode(true);
  tabs->addTab(new MeasurementList(bench_, guard_), tr("Measurements"));
  tabs->addTab(new StepList(bench_, guard_), tr("Steps"));
  column->addWidget(tabs);
  column->setSizes({420, 320});
  list->setMinimumWidth(38 * fontMetrics().averageCharWidth());  // names and numbers of vessels
  splitters_.push_back(column);
  return column;
}

void MainWindow::build_views() {
  place_ = new QLabel(this);
  place_->setObjectName("place");
  shown_name_ = new QLabel(this);
  shown_name_->setObjectName("shown_name");
  shown_name_->setContentsMargins(0, 0, 12, 0);
  jobs_ = new Jobs(this);
  statusBar()->addPermanentWidget(jobs_);
  // A strut and not the bar's own minimum, which would hold it at one line however many jobs run.
  place_->setMinimumHeight(jobs_->line_height());
  statusBar()->addPermanentWidget(shown_name_);
  statusBar()->addPermanentWidget(place_);
  place_->setMinimumWidth(
      place_->fontMetrics().horizontalAdvance("-1000 HU   x -000.0  y -000.0  z -0000.0 mm"));
  connect(statusBar(), &QStatusBar::messageChanged, statusBar(),
          [bar = statusBar()](const QString& text) { bar->setToolTip(text); });  // a long one is cut off
  auto* columns = new QSplitter(Qt::Horizontal);
  columns->setObjectName("columns");
  Panel* tree = right_column();  // first: the list of vessels asks it for colours
  columns->addWidget(side_column());
  columns->addWidget(curved_column());
  columns->addWidget(section_column());
  columns->addWidget(tree);
  columns->setSizes({300, 560, 330, 380});
  columns->setStretchFactor(0, 0);
  for (int i = 1; i < 4; ++i) columns->setStretchFactor(i, 1);
  hanging_ = new Hanging(columns, columns->findChild<QTabWidget*>("lists"), tree);
  connect(hanging_, &Hanging::narrow_changed, place_, [this, wide = place_->minimumWidth()](bool narrow) {
    place_->setMinimumWidth(narrow ? 0 : wide);  // what a tool says needs the room
  });
  profile_ = new ProfileWidget(bench_, guard_);
  auto* profile = new Panel(tr("Lumen profile"), profile_);
  connect(profile, &Panel::maximise_wanted, this, [this, profile] { maximise(profile); });
  auto* rows = new QSplitter(Qt::Vertical);
  rows->setObjectName("rows");
  rows->addWidget(columns);
  rows->addWidget(profile);
  rows->setSizes({760, 170});
  rows->setStretchFactor(0, 1);
  rows->setStretchFactor(1, 0);
  splitters_.push_back(columns);
  splitters_.push_back(rows);
  setCentralWidget(rows);
}

void MainWindow::maximise(Panel* panel) {
  alone_ = alone_ == panel ? nullptr : panel;
  if (alone_) hanging_->rest(true);
  show_alone(centralWidget(), alone_);
  if (!alone_) hanging_->rest(false);
}

void MainWindow::remember_layout() {
  if (alone_) maximise(alone_);
  std::map<std::string, std::string> settings;
  settings["geometry"] = saveGeometry().toBase64().toStdString();
  for (const QSplitter* splitter : splitters_)
    settings["splitter." + splitter->objectName().toStdString()] =
        splitter->saveState().toBase64().toStdString();
  settings["splitter.columns"] = hanging_->sizes().toBase64().toStdString();
  guarded([&] { machine_.set_settings(settings); });
}

void MainWindow::restore_layout() {
  restoreGeometry(decoded(machine_.setting("geometry")));
  resize(size().boundedTo(screen()->availableSize()));
  for (QSplitter* splitter : splitters_)
    splitter->restoreState(decoded(machine_.setting("splitter." + splitter->objectName().toStdString())));
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!must_end_ && !may_be_left(*jobs_, this)) {
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
    complain(tr("Drop one case, image or folder at a time; of a DICOM series drop its folder."));
}

}  // namespace ostia::workstation
