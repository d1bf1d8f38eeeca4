#include "comparison/page.h"

#include "commands/table.h"
#include "comparison/along.h"
#include "comparison/comparing.h"
#include "comparison/lesion_changes.h"
#include "shell/desk.h"
#include "shell/library_texts.h"
#include "shell/quantities.h"

#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QMainWindow>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace ostia::workstation {
namespace {

using view::CurvedView;
using view::SectionView;
using view::SliceKind;
using view::SliceView;

constexpr int least_side_width = 300, notes_height = 110;

std::unique_ptr<CurvedView> curved_view(session::Workbench& bench) {
  return std::make_unique<CurvedView>(bench, CurvedView::Which::first, std::make_shared<view::CurvedFrame>());
}

}  // namespace

ComparisonPage::ComparisonPage(Desk& desk, QMainWindow& window, Comparing& comparing)
    : OverViews(window), desk_(desk), comparing_(comparing) {
  setObjectName("comparison_page");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  auto* columns = new QSplitter(Qt::Horizontal);
  columns->addWidget(side());
  columns->addWidget(views());
  columns->setStretchFactor(0, 0);
  columns->setStretchFactor(1, 1);
  columns->setSizes({480, 1120});
  row->addWidget(columns);
  const auto again = [this] { fill(); };
  own_.push_back(comparing.changed.observe(again));
  own_.push_back(comparing.outdated.observe([this](const bool&) { fill_state(); }));
  own_.push_back(comparing.cursor().reached.observe([this](const Reached&) { show_reached(); }));
  own_.push_back(desk.bench.vessel.observe([this](const std::int32_t&) { fill_vessels(); }));
  fill();
}

ComparisonPage::~ComparisonPage() = default;

QWidget* ComparisonPage::side() {
  auto* whole = new QWidget;
  whole->setMinimumWidth(least_side_width);
  auto* rows = new QVBoxLayout(whole);
  rows->setContentsMargins(6, 6, 6, 6);
  state_ = new QLabel;
  state_->setObjectName("compared_state");
  state_->setWordWrap(true);
  state_->setTextFormat(Qt::PlainText);
  state_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  buttons_ = new QWidget;
  auto* grid = new QGridLayout(buttons_);
  grid->setContentsMargins(0, 0, 0, 0);
  lesions_ = new LesionChanges;
  connect(lesions_, &LesionChanges::chosen, this, [this](int lesion) { comparing_.go_to(lesion); });
  notes_ = new QListWidget;
  notes_->setObjectName("compared_notes");
  notes_->setAccessibleName(tr("What is to be known of this comparison"));
  notes_->setWordWrap(true);
  notes_->setMaximumHeight(notes_height);
  rows->addWidget(state_);
  rows->addWidget(buttons_);
  rows->addWidget(lesions_, 1);
  rows->addWidget(notes_);
  return whole;
}

QWidget* ComparisonPage::views() {
  session::Workbench &now = desk_.bench, &before = comparing_.former();
  curved_ = new TwinViews(desk_, tr("CPR"), "compared_cpr", curved_view(now), curved_view(before));
  vessel_ = new QComboBox;
  vessel_->setObjectName("compared_vessel");
  vessel_->setAccessibleName(tr("Vessel"));
  connect(vessel_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int index) { desk_.bench.vessel.set(vessel_->itemData(index).toInt()); });
  curved_->add_control(vessel_);
  auto before_section = std::make_unique<SectionView>(before, 0.0);
  own_.push_back(comparing_.cursor().turn_deg.observe(
      [view = before_section.get()](const double& turn) { view->set_turn_deg(turn); }));
  section_ = new TwinViews(desk_, tr("Section"), "compared_section", std::make_unique<SectionView>(now, 0.0),
                           std::move(before_section));
  auto now_slice = std::make_unique<SliceView>(now, SliceKind::axial);
  auto before_slice = std::make_unique<SliceView>(before, SliceKind::axial);
  auto* kind = new QComboBox;
  kind->setObjectName("compared_slice_kind");
  kind->setAccessibleName(tr("Orientation of the slice"));
  for (const auto& [name, value] : {std::pair(tr("Axial"), SliceKind::axial),
                                    {tr("Coronal"), SliceKind::coronal},
                                    {tr("Sagittal"), SliceKind::sagittal}})
    kind->addItem(name, static_cast<int>(value));
  connect(kind, QOverload<int>::of(&QComboBox::activated), this,
          [kind, one = now_slice.get(), other = before_slice.get()](int index) {
            for (SliceView* slice : {one, other})
              slice->set_kind(static_cast<SliceKind>(kind->itemData(index).toInt()));
          });
  slice_ = new TwinViews(desk_, tr("Slice"), "compared_slice", std::move(now_slice), std::move(before_slice));
  slice_->add_control(kind);
  along_ = new AlongWidget(now);
  for (TwinViews* twins : {curved_, section_, slice_}) {
    connect(twins, &TwinViews::hovered, this, &ComparisonPage::hovered);
    twins->now().show_identity(desk_.identity);
  }
  auto* across = new QSplitter(Qt::Vertical);
  across->addWidget(section_);
  across->addWidget(slice_);
  auto* pictures = new QSplitter(Qt::Horizontal);
  pictures->addWidget(curved_);
  pictures->addWidget(across);
  auto* rows = new QSplitter(Qt::Vertical);
  rows->addWidget(pictures);
  rows->addWidget(along_);
  rows->setStretchFactor(0, 1);
  rows->setSizes({720, 200});
  pictures->setSizes({560, 620});
  return rows;
}

void ComparisonPage::add_buttons(const CommandTable& commands) {
  auto* grid = qobject_cast<QGridLayout*>(buttons_->layout());
  int number = 0;
  for (const char* id : {"compare.previous", "compare.next", "compare.blink", "compare.side", "compare.again",
                         "compare.report", "compare.save", "compare.in_3d", "compare.page"}) {
    grid->addWidget(command_button(commands, id), number / 2, number % 2);
    ++number;
  }
}

void ComparisonPage::blink() {
  show_twins(twins_ == TwinsShown::before ? TwinsShown::now : TwinsShown::before);
}

void ComparisonPage::side_by_side() {
  show_twins(TwinsShown::both);
}

void ComparisonPage::show_twins(TwinsShown shown) {
  twins_ = shown;
  for (TwinViews* twins : {curved_, section_, slice_}) twins->show_twins(shown);
}

void ComparisonPage::step_lesion(int by) {
  lesions_->step(by);
}

void ComparisonPage::fit() {
  for (TwinViews* twins : {curved_, section_, slice_}) twins->fit();
}

void ComparisonPage::fill() {
  lesions_->show_comparison(comparing_.made());
  along_->show_comparison(comparing_.made());
  fill_vessels();
  fill_state();
  show_reached();
}

void ComparisonPage::fill_state() {
  notes_->clear();
  const auto& made = comparing_.made();
  if (!made) {
    state_->setText(comparing_.why_none());
    return;
  }
  using analysis::LesionFate;
  const auto count = [&](LesionFate fate) {
    return static_cast<int>(std::ranges::count(made->change.lesions, fate, &analysis::LesionChange::fate));
  };
  QStringList lines;
  if (comparing_.outdated.get()) lines << tr("Out of date: the case has changed since. Compare again.");
  lines << tr("Compared with the scan %1.").arg(comparing_.former_name());
  lines << tr("Lesions: %1 in both, %2 new, %3 gone, %4 not reached by one scan.")
               .arg(count(LesionFate::both))
               .arg(count(LesionFate::appeared))
               .arg(count(LesionFate::gone))
               .arg(count(LesionFate::before_unseen) + count(LesionFate::after_unseen));
  state_->setText(lines.join('\n'));
  for (const std::string& one : made->change.unmatched) notes_->addItem(library_text(one));
  for (const std::string& one : made->warnings) notes_->addItem(library_text(one));
}

void ComparisonPage::fill_vessels() {
  const QSignalBlocker quiet(vessel_);
  vessel_->clear();
  const auto& made = comparing_.made();
  if (!made) return;
  for (const analysis::VesselMatch& match : made->change.match.vessels)
    vessel_->addItem(QString::fromStdString(desk_.bench.vessel_name(match.after)), match.after);
  vessel_->setCurrentIndex(vessel_->findData(desk_.bench.vessel.get()));
}

void ComparisonPage::show_reached() {
  const Reached reached = comparing_.cursor().reached.get();
  for (TwinViews* twins : {curved_, section_})
    twins->set_reached(reached != Reached::before_alone, reached != Reached::now_alone);
}

void ComparisonPage::showEvent(QShowEvent* event) {
  OverViews::showEvent(event);
  QTimer::singleShot(0, curved_, &TwinViews::begin);  // once it has its size
  curved_->now().setFocus();
  emit shown(true);
}

void ComparisonPage::hideEvent(QHideEvent* event) {
  OverViews::hideEvent(event);
  if (isHidden()) emit shown(false);
}

}  // namespace ostia::workstation
