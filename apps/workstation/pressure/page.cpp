#include "pressure/page.h"

#include "commands/table.h"
#include "pressure/live.h"
#include "shell/bind.h"
#include "shell/desk.h"
#include "shell/docks.h"
#include "shell/language.h"
#include "shell/library_texts.h"
#include "shell/list_rows.h"
#include "shell/quantities.h"

#include "ostia/session/pressure_document.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QMainWindow>
#include <QSplitter>
#include <QTabWidget>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <utility>

namespace ostia::workstation {
namespace {

constexpr int fill_page_after_ms = 60;  // of the last change: the number at the cursor does not wait
constexpr int page_width = 400;

const core::Phrasebook& pressure_book() {
  return session::pressure_words(session::report_language(language_in_use().toStdString()));
}

}  // namespace

PressurePage::PressurePage(Desk& desk, Pressures& pressures)
    : QDockWidget(tr("Pressure"), &desk.window),
      desk_(desk),
      pressures_(pressures),
      guard_([&desk](const std::function<void()>& act) { desk.messages.guarded(act); }) {
  setObjectName("pressure");
  auto* whole = new QWidget;
  auto* rows = new QVBoxLayout(whole);
  rows->setContentsMargins(6, 6, 6, 6);
  auto* sentence = new QLabel(QString::fromStdString(pressure_book().say(hemodynamics::research_use)));
  sentence->setObjectName("research_use");
  sentence->setWordWrap(true);
  QFont bold = sentence->font();
  bold.setBold(true);
  sentence->setFont(bold);
  at_cursor_ = new QLabel;
  at_cursor_->setObjectName("ffr_at_cursor");
  at_cursor_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont large = at_cursor_->font();
  large.setPointSizeF(1.3 * large.pointSizeF());
  at_cursor_->setFont(large);
  state_ = new QLabel;
  state_->setObjectName("pressure_state");
  state_->setWordWrap(true);
  auto* tabs = new QTabWidget;
  tabs->setObjectName("pressure_tabs");
  tabs->setDocumentMode(true);
  tabs->addTab(readings(), tr("Readings"));
  tabs->addTab(new PressureInputs(desk.bench, pressures.board(), guard_), tr("Inputs"));
  rows->addWidget(sentence);
  rows->addWidget(at_cursor_);
  rows->addWidget(state_);
  rows->addWidget(tabs, 1);
  setWidget(whole);
  soon_.setSingleShot(true);
  soon_.setInterval(fill_page_after_ms);
  connect(&soon_, &QTimer::timeout, this, &PressurePage::fill);
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool visible) {
    pressures_.board().shown.set(!isHidden());
    if (visible) size_at_first(*qobject_cast<QMainWindow*>(&desk_.window), *this, page_width, Qt::Horizontal);
  });
  const auto at_cursor = [this](const auto&...) { show_cursor(); };
  own_.push_back(desk.bench.vessel.observe(at_cursor));
  own_.push_back(desk.bench.cursor_mm.observe(at_cursor));
  own_.push_back(pressures.board().changed.observe([this] {
    show_cursor();
    if (!soon_.isActive()) soon_.start();
  }));
  own_.push_back(desk.bench.annotations_changed.observe([this] { soon_.start(); }));
  own_.push_back(desk.bench.case_changed.observe([this] { soon_.start(); }));
  fill();
}

QWidget* PressurePage::readings() {
  auto* parts = new QSplitter(Qt::Vertical);
  parts->setObjectName("pressure_parts");
  lesions_ = figures_table("pressure_lesions", tr("FFR behind narrowings"),
                           {tr("Vessel"), tr("At (mm)"), tr("FFR"), tr("Takes"), tr("What if")});
  lesions_->setToolTip(tr("Read about 25 mm behind each narrowing, under hyperaemia."));
  connect(lesions_, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* item) {
    desk_.bench.vessel.set(item->data(0, Qt::UserRole).toInt());
    desk_.bench.cursor_mm.set(desk_.bench.here_mm(item->data(1, Qt::UserRole).toDouble()));
  });
  outlets_ = figures_table("pressure_outlets", tr("Ends of the vessels"),
                           {tr("End of"), tr("FFR"), tr("ml/min"), tr("Reserve"), tr("PPG"), tr("What if")});
  outlets_->setToolTip(
      tr("Flow under hyperaemia, flow reserve, pullback pressure gradient index (1: focal)."));
  marks_ = new QListWidget;
  marks_->setObjectName("pressure_marks");
  marks_->setAccessibleName(tr("What is to be looked at"));
  marks_->setWordWrap(true);
  marks_->setMinimumSize(120, 40);
  parts->addWidget(lesions_);
  parts->addWidget(what_if_rows());
  parts->addWidget(outlets_);
  parts->addWidget(marks_);
  parts->setSizes({150, 190, 150, 110});
  return parts;
}

QWidget* PressurePage::what_if_rows() {
  auto* all = new QWidget;
  auto* rows = new QVBoxLayout(all);
  rows->setContentsMargins(0, 0, 0, 0);
  buttons_ = new QWidget;
  auto* grid = new QGridLayout(buttons_);
  grid->setContentsMargins(0, 0, 0, 0);
  const auto percent = [&](const QString& name, const QString& tip, session::Property<double>& property) {
    auto* box = new QDoubleSpinBox;
    box->setObjectName(name);
    box->setAccessibleName(tip);
    box->setToolTip(tip);
    box->setDecimals(0);
    box->setSuffix(QStringLiteral(" %"));
    box->setFocusPolicy(Qt::ClickFocus);
    bind(box, property);
    return box;
  };
  grid->addWidget(percent("what_if_left", tr("Diameter stenosis that stays"), pressures_.left_percent), 0, 1);
  grid->addWidget(percent("what_if_narrow", tr("Diameter stenosis at the throat"), pressures_.narrow_percent),
                  1, 1);
  grid->setColumnStretch(0, 1);
  stretches_ = figures_table("what_if_stretches", tr("What if: stretches"),
                             {tr("Vessel"), tr("mm from its root"), tr("What if")});
  stretches_->setToolTip(tr("Delete takes the chosen stretch away; Undo brings it back."));
  auto* remove = new QAction(tr("Take this stretch back"), stretches_);
  remove->setShortcut(QKeySequence::Delete);
  remove->setShortcutContext(Qt::WidgetShortcut);
  connect(remove, &QAction::triggered, this, [this] {
    const int row = stretches_->indexOfTopLevelItem(stretches_->currentItem());
    if (row >= 0) guard_([&] { pressures_.board().remove_what_if(static_cast<std::size_t>(row)); });
  });
  stretches_->addAction(remove);
  stretches_->setContextMenuPolicy(Qt::ActionsContextMenu);
  rows->addWidget(buttons_);
  rows->addWidget(stretches_, 1);
  return all;
}

void PressurePage::add_buttons(const CommandTable& commands) {
  auto* grid = qobject_cast<QGridLayout*>(buttons_->layout());
  int row = 0;
  for (const char* id : {"pressure.open", "pressure.narrow", "pressure.clear"}) {
    grid->addWidget(command_button(commands, id), row, 0, 1, row == 2 ? 2 : 1);
    ++row;
  }
}

void PressurePage::show_cursor() {
  if (isHidden()) return;
  const session::Workbench& bench = desk_.bench;
  const auto& now = pressures_.board().now();
  QString text, more;
  if (now && bench.axis()) {
    const double s = bench.own_mm(bench.cursor_mm.get());
    text = tr("%1 at %2 mm: FFR %3")
               .arg(QString::fromStdString(bench.vessel_name(bench.vessel.get())), quantity::length(s),
                    quantity::ratio(pressures_.board().ffr_at_cursor()));
    if (const auto interval = session::ffr_interval_at(*now, bench.vessel.get(), s))
      more = tr("95 %: %1 to %2; at or below %3 with %4 %")
                 .arg(quantity::ratio(interval->low), quantity::ratio(interval->high),
                      quantity::ratio(now->options.reading.threshold),
                      quantity::percent(100.0 * interval->probability));
    if (now->after)
      text += tr(", what if %1").arg(quantity::ratio(session::ffr_after_at(*now, bench.vessel.get(), s)));
  }
  at_cursor_->setText(text);
  if (!bench.has_case())
    more = tr("No case is open.");
  else if (!pressures_.board().problem().empty())
    more = library_text(pressures_.board().problem());
  else if (!now)
    more = tr("Sections are being measured\u2026");
  state_->setText(more);
  state_->setVisible(!more.isEmpty());
}

void PressurePage::fill() {
  if (isHidden()) return;
  show_cursor();
  fill_stretches();
  const auto& now = pressures_.board().now();
  if (now) {
    fill_lesions(*now);
    fill_outlets(*now);
  } else {
    lesions_->clear();
    outlets_->clear();
  }
  const std::vector<std::string> marks = now ? now->warnings : std::vector<std::string>();
  if (marks != shown_marks_) {
    shown_marks_ = marks;
    marks_->clear();
    for (const std::string& mark : marks) marks_->addItem(QString::fromStdString(pressure_book().say(mark)));
  }
  const bool what_if = now && now->after;
  lesions_->setColumnHidden(4, !what_if);
  outlets_->setColumnHidden(5, !what_if);
}

}  // namespace ostia::workstation
