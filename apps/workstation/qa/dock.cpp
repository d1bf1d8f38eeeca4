#include "qa/dock.h"

#include "shell/bind.h"
#include "shell/docks.h"
#include "shell/file_dialogs.h"
#include "views/overlay_colors.h"

#include "ostia/io/contour_file.h"
#include "ostia/view/value_scale.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMainWindow>
#include <QProgressBar>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr int figures_after_ms = 20;        // of an edit
constexpr double figures_budget_ms = 30.0;  // at once
constexpr double worst_mm = 0.5;            // a mean distance with the last colour of the scale
constexpr int wide_window = 1500, wide_panel = 345, narrow_panel = 240;  // units of the interface
constexpr int section_role = Qt::UserRole;
enum ScoreColumn { name_column, vessel_column, msd_column, max_column, area_column, dice_column };

QString millimetres(double value, int decimals = 2) {
  return std::isfinite(value) ? QString::number(value, 'f', decimals) : QStringLiteral("\u2013");
}

QIcon error_icon(double msd_mm) {
  const figure::Color color = view::scale_color(view::ColorScale::sequential, msd_mm / worst_mm);
  return color_square(QColor::fromRgbF(color.r, color.g, color.b));
}

QString text_of(const session::WholeError& error) {
  if (error.sections == error.unmatched) return QaDock::tr("no annotated section");
  QString text = QaDock::tr("MSD %1 mm, maximum %2 mm, Dice %3, %4 mm annotated")
                     .arg(millimetres(error.surfaces.mean_mm(), 3), millimetres(error.surfaces.max_mm))
                     .arg(error.dice, 0, 'f', 3)
                     .arg(error.length_mm, 0, 'f', 0);
  if (error.missing_mm > 0.05)
    text += QaDock::tr(", %1 mm of it without a wall").arg(error.missing_mm, 0, 'f', 1);
  return text;
}

QPushButton* tool_button(const QString& text, const QString& name, const QString& tip) {
  auto* made = new QPushButton(text);
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setFocusPolicy(Qt::TabFocus);
  return made;
}

}  // namespace

QaDock::QaDock(session::Workbench& bench, std::vector<PictureWidget*> pictures, SceneWidget& scene,
               Jobs& jobs, Guard loud, QWidget* parent)
    : QDockWidget(tr("QA"), parent),
      bench_(bench),
      pictures_(std::move(pictures)),
      scene_(scene),
      jobs_(jobs),
      loud_(std::move(loud)),
      check_(bench) {
  setObjectName("qa");
  auto* all = new QWidget;
  auto* rows = new QVBoxLayout(all);
  rows->setContentsMargins(6, 6, 6, 6);
  rows->addWidget(truth_rows(), 1);
  rows->addWidget(session_rows());
  setWidget(all);
  figures_soon_.setSingleShot(true);
  figures_soon_.setInterval(figures_after_ms);
  connect(&figures_soon_, &QTimer::timeout, this, &QaDock::show_figures);
  time_.setInterval(1000);
  connect(&time_, &QTimer::timeout, this, &QaDock::show_time);
  connect(&replay_tick_, &QTimer::timeout, this, &QaDock::replay_some);
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool) { set_mode(!isHidden()); });
  const auto soon = [this](const auto&...) {
    if (mode_) figures_soon_.start();
  };
  own_.push_back(check_.stale.observe([this] {
    if (mode_ && !figures_soon_.isActive()) figures_soon_.start();
  }));
  own_.push_back(bench.vessel.observe(soon));
  own_.push_back(bench.image_changed.observe([this] { follow_patient(); }));
  own_.push_back(bench.case_changed.observe([this] {
    follow_patient();
    if (replay_) end_replay();
    if (recorder_) stop_recording();
    show_session();
  }));
  for (PictureWidget* picture : pictures_)
    own_.push_back(
        picture->pointer().acting.observe([this](const view::HandAct&) { check_.timer().touch(); }));
  scene_.set_wall_painter([this](const geometry::TriMesh& wall) { color_tree(wall); });
  show_observers();
  show_time();
  show_session();
}

QaDock::~QaDock() {
  scene_.set_wall_painter({});
}

QWidget* QaDock::truth_rows() {
  auto* all = new QWidget;
  auto* rows = new QVBoxLayout(all);
  rows->setContentsMargins(0, 0, 0, 0);
  auto* first = new QHBoxLayout;
  open_ = tool_button(tr("Open truth\u2026"), "qa_open", tr("Contours that the case is held against"));
  connect(open_, &QPushButton::clicked, this, &QaDock::choose_truth);
  observer_ = new QComboBox;
  observer_->setObjectName("qa_observer");
  observer_->setAccessibleName(tr("Observer"));
  observer_->setToolTip(tr("Whose contours are the truth"));
  connect(observer_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int index) { check_.observer.set(observer_->itemText(index).toStdString()); });
  first->addWidget(open_);
  first->addWidget(observer_, 1);
  rows->addLayout(first);
  shown_ = new QCheckBox(tr("Truth over the pictures"));
  shown_->setObjectName("qa_shown");
  bind_checked(shown_, check_.shown);
  rows->addWidget(shown_);
  colored_ = new QCheckBox(tr("Tree coloured by its error"));
  colored_->setObjectName("qa_colored");
  connect(colored_, &QCheckBox::toggled, this, [this] { scene_.repaint_wall(); });
  rows->addWidget(colored_);
  list_ = new QTreeWidget;
  list_->setObjectName("qa_sections");
  list_->setAccessibleName(tr("Annotated sections"));
  list_->setRootIsDecorated(false);
  list_->setUniformRowHeights(true);
  list_->setHeaderLabels({tr("Section"), tr("Vessel"), tr("MSD"), tr("Max."), tr("\u0394 area"), tr("Dice")});
  list_->headerItem()->setToolTip(msd_column, tr("Mean distance of the surfaces, mm"));
  list_->headerItem()->setToolTip(max_column, tr("Largest distance of the surfaces, mm"));
  list_->headerItem()->setToolTip(area_column, tr("Mean difference of the areas, case - truth, mm\u00b2"));
  list_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  list_->header()->setStretchLastSection(false);
  list_->setMinimumSize(180, 90);
  connect(list_, &QTreeWidget::itemActivated, this,
          [this](QTreeWidgetItem* item) { check_.go_to(item->data(name_column, section_role).toUInt()); });
  connect(list_, &QTreeWidget::itemClicked, this,
          [this](QTreeWidgetItem* item) { check_.go_to(item->data(name_column, section_role).toUInt()); });
  rows->addWidget(list_, 1);
  next_ = tool_button(tr("Next worst section"), "qa_next",
                      tr("To the worst place of the section that is farthest off"));
  connect(next_, &QPushButton::clicked, this, [this] {
    if (const auto section = check_.next_worst())
      if (QTreeWidgetItem* item = list_->topLevelItem(static_cast<int>(*section)))
        list_->setCurrentItem(item);
  });
  rows->addWidget(next_);
  for (QLabel** label : {&vessel_, &whole_}) {
    *label = new QLabel;
    (*label)->setWordWrap(true);
    (*label)->setTextInteractionFlags(Qt::TextSelectableByMouse);
    rows->addWidget(*label);
  }
  vessel_->setObjectName("qa_vessel");
  whole_->setObjectName("qa_case");
  return all;
}

QWidget* QaDock::session_rows() {
  auto* all = new QWidget;
  auto* rows = new QVBoxLayout(all);
  rows->setContentsMargins(0, 0, 0, 0);
  auto* time = new QHBoxLayout;
  clock_ = new QLabel;
  clock_->setObjectName("qa_clock");
  clock_->setToolTip(tr("Time at work: it stops when nothing was done for a minute"));
  run_ = tool_button(tr("Pause"), "qa_run", tr("Stop or go on counting"));
  connect(run_, &QPushButton::clicked, this, [this] {
    session::ActiveTime& timer = check_.timer();
    timer.running() ? timer.pause() : timer.start();
    show_time();
  });
  auto* zero = tool_button(tr("Zero"), "qa_zero", tr("Count from zero"));
  connect(zero, &QPushButton::clicked, this, [this] {
    check_.timer().reset();
    show_time();
  });
  rows->addWidget(clock_);
  time->addWidget(run_);
  time->addWidget(zero);
  rows->addLayout(time);
  auto* hand = new QHBoxLayout;
  record_ = tool_button(tr("Record\u2026"), "qa_record", tr("Write down what the hand does in the views"));
  connect(record_, &QPushButton::clicked, this, &QaDock::choose_recording);
  again_ = tool_button(tr("Replay\u2026"), "qa_replay", tr("Do again what was recorded, on the same case"));
  connect(again_, &QPushButton::clicked, this, &QaDock::choose_replay);
  speed_ = new QComboBox;
  speed_->setObjectName("qa_speed");
  speed_->setAccessibleName(tr("Speed of a replay"));
  speed_->addItem(tr("Replay as fast as recorded"), false);
  speed_->addItem(tr("Replay at full speed"), true);
  hand->addWidget(record_);
  hand->addWidget(again_);
  rows->addLayout(hand);
  rows->addWidget(speed_);
  auto* run = new QHBoxLayout;
  progress_ = new QProgressBar;
  progress_->setObjectName("qa_progress");
  cancel_ = tool_button(tr("Cancel"), "qa_cancel", tr("End the replay here"));
  connect(cancel_, &QPushButton::clicked, this, &QaDock::cancel_replay);
  run->addWidget(progress_, 1);
  run->addWidget(cancel_);
  rows->addLayout(run);
  return all;
}

void QaDock::set_mode(bool on) {
  if (on == mode_) return;
  mode_ = on;
  layers_.clear();
  if (on) {
    for (PictureWidget* picture : pictures_)
      layers_.push_back(std::make_unique<view::TruthLayer>(picture->view(), check_));
    if (auto* main = qobject_cast<QMainWindow*>(parentWidget()))
      size_at_first(*main, *this, main->width() >= wide_window ? wide_panel : narrow_panel, Qt::Horizontal);
    check_.timer().start();
    time_.start();
    figures_soon_.start();
  } else {
    check_.timer().pause();
    time_.stop();
  }
  show_time();
  scene_.repaint_wall();
}

void QaDock::open_truth(const std::filesystem::path& path) {
  check_.open(path);
  show_truth();
}

void QaDock::show_truth() {
  truth_of_ = patient();
  show_observers();
  show_figures();
}

/// Of the case's image, else of its first tree; without a case of the image, empty where none is wholly read.
std::string QaDock::patient() const {
  if (!bench_.has_case()) return bench_.image().reference.sha256;
  const session::CaseFile& file = bench_.session().file();
  const std::optional<session::ImageReference> image = file.image();
  return image ? image->sha256 : lumen::digest(*file.starting_model());
}

/// Contours of one patient say nothing of another, though the vessels have the same names.
void QaDock::follow_patient() {
  if (!check_.has_truth()) return;
  const std::string now = patient();
  if (now.empty() || now == truth_of_) return;
  if (!truth_of_.empty()) check_.close();
  show_truth();
}

void QaDock::choose_truth() {
  const QString chosen = ask_open_file(this, tr("Contours"), tr("Contours (*.json)"));
  if (chosen.isEmpty()) return;
  const std::filesystem::path path = chosen.toStdString();
  jobs_.run(
      "truth", tr("Reading the truth"),
      [path](const core::TaskContext&) { return std::any(io::read_contours(path)); },
      [this, of = patient()](const std::any& read) {
        if (of != patient()) return;  // another one came while it was read
        loud_([&] {
          check_.set_truth(std::any_cast<const geometry::ContourSet&>(read));
          show_truth();
        });
      },
      [this](const QString& message) { emit refused(message); });
}

void QaDock::show_observers() {
  const QSignalBlocker quiet(observer_);
  observer_->clear();
  for (const std::string& name : check_.observers()) observer_->addItem(QString::fromStdString(name));
  observer_->setCurrentText(QString::fromStdString(check_.observer.get()));
  observer_->setEnabled(observer_->count() > 0);
}

void QaDock::show_figures() {
  if (!mode_) return;
  if (!check_.advance(figures_budget_ms)) {  // the rest when what waits has been answered
    figures_soon_.start();
    return;
  }
  const std::vector<session::SectionError>& sections = check_.sections();
  while (list_->topLevelItemCount() > static_cast<int>(sections.size())) delete list_->takeTopLevelItem(0);
  while (list_->topLevelItemCount() < static_cast<int>(sections.size())) new QTreeWidgetItem(list_);
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const session::SectionError& one = sections[k];
    QTreeWidgetItem* item = list_->topLevelItem(static_cast<int>(k));
    const double msd = one.surfaces.mean_mm();
    item->setData(name_column, section_role, static_cast<uint>(k));
    item->setText(name_column, QString::fromStdString(one.section));
    item->setIcon(name_column, error_icon(one.matched() ? msd : std::nan("")));
    item->setText(vessel_column,
                  one.matched() ? QString::fromStdString(bench_.vessel_name(one.vessel))
                                : tr("%1: not in this case").arg(QString::fromStdString(one.vessel_name)));
    item->setText(msd_column, millimetres(msd, 3));
    item->setText(max_column, millimetres(one.matched() ? one.surfaces.max_mm : std::nan("")));
    item->setText(area_column, millimetres(one.area_difference_mm2));
    item->setText(dice_column,
                  std::isfinite(one.dice) ? QString::number(one.dice, 'f', 3) : QStringLiteral("\u2013"));
    for (int column = msd_column; column <= dice_column; ++column)
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  next_->setEnabled(!sections.empty());
  const std::int32_t vessel = bench_.vessel.get();
  const QString name = QString::fromStdString(bench_.vessel_name(vessel));
  if (!check_.has_truth()) {
    vessel_->setText(tr("No truth is open."));
    whole_->clear();
  } else {
    vessel_->setText(tr("<b>%1</b>: %2").arg(name.toHtmlEscaped(), text_of(check_.of_vessel(vessel))));
    whole_->setText(tr("<b>Case</b>: %1").arg(text_of(check_.of_case())));
  }
}

void QaDock::show_time() {
  const session::ActiveTime& timer = check_.timer();
  const int seconds = static_cast<int>(timer.seconds());
  QString text = QStringLiteral("%1:%2:%3")
                     .arg(seconds / 3600)
                     .arg(seconds / 60 % 60, 2, 10, QLatin1Char('0'))
                     .arg(seconds % 60, 2, 10, QLatin1Char('0'));
  if (timer.idle()) text += tr("  (idle)");
  clock_->setText(tr("At work %1").arg(text));
  run_->setText(timer.running() ? tr("Pause") : tr("Go on"));
}

void QaDock::show_session() {
  if (recorder_ && !recorder_->active()) recorder_.reset();
  record_->setText(recorder_ ? tr("Stop recording") : tr("Record\u2026"));
  record_->setEnabled(bench_.has_case() && !replay_);
  again_->setEnabled(bench_.has_case() && !replay_ && !recorder_);
  speed_->setEnabled(!replay_);
  progress_->setVisible(replay_ != nullptr);
  cancel_->setVisible(replay_ != nullptr);
}

void QaDock::color_tree(const geometry::TriMesh& wall) {
  if (!mode_ || !colored_->isChecked() || !check_.has_truth()) {
    scene_.scene().clear_wall_values();
    return;
  }
  const auto places = scene_.scene().wall_places();
  std::vector<session::QualityCheck::WallPlace> where;
  where.reserve(places.size());
  for (const view::WallPlace& place : places) where.push_back({place.vessel, place.s_mm});
  scene_.scene().set_wall_values(
      check_.wall_errors(wall.points, where),
      {tr("from the truth, mm").toStdString(), -worst_mm, worst_mm, view::ColorScale::diverging});
}

void QaDock::start_recording(const std::filesystem::path& path) {
  if (replay_) return;
  auto recorder = std::make_unique<view::HandRecorder>(bench_, path);
  for (PictureWidget* picture : pictures_)
    recorder->watch(picture->objectName().toStdString(), picture->view(), picture->pointer());
  recorder_ = std::move(recorder);
  emit said(tr("Recording: what the hand does in the views is written down."));
  show_session();
}

void QaDock::stop_recording() {
  const std::unique_ptr<view::HandRecorder> ended = std::move(recorder_);
  show_session();
  if (!ended) return;
  loud_([&] { ended->stop(); });
  emit said(tr("%n movement(s) were recorded.", "", static_cast<int>(ended->lines())));
}

void QaDock::choose_recording() {
  if (recorder_) return stop_recording();
  QString chosen = ask_save_file(this, tr("Record to"), tr("Recordings (*.jsonl)"));
  if (chosen.isEmpty()) return;
  if (!chosen.endsWith(".jsonl")) chosen += ".jsonl";
  loud_([&] { start_recording(chosen.toStdString()); });
}

void QaDock::choose_replay() {
  const QString chosen = ask_open_file(this, tr("Replay"), tr("Recordings (*.jsonl)"));
  if (!chosen.isEmpty()) loud_([&] { start_replay(chosen.toStdString(), speed_->currentData().toBool()); });
}

}  // namespace ostia::workstation
