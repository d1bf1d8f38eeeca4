#include "calcium/page.h"

#include "calcium/reading.h"
#include "commands/table.h"
#include "shell/desk.h"
#include "shell/docks.h"
#include "shell/library_texts.h"
#include "shell/list_rows.h"
#include "shell/quantities.h"
#include "views/overlay_colors.h"

#include "ostia/core/text.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QMainWindow>
#include <QScopedValueRollback>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

using analysis::CalciumPlace;

enum LesionCells { place_cell, score_cell, volume_cell, mass_cell, peak_cell, sure_cell, calcium_cells };
constexpr int calcium_page_width = 400, lesion_role = Qt::UserRole;

QString score_text(double agatston) {
  return QString::fromStdString(core::shown_text(agatston, 1));
}

QIcon square_of(CalciumPlace place) {
  return color_square(role_color(view::calcium_role(place), Ground::image));
}

QString category_text(analysis::CalciumCategory category) {
  using analysis::CalciumCategory;
  switch (category) {
    case CalciumCategory::none:
      return CalciumPage::tr("none");
    case CalciumCategory::minimal:
      return CalciumPage::tr("minimal (1 to 10)");
    case CalciumCategory::mild:
      return CalciumPage::tr("mild (11 to 100)");
    case CalciumCategory::moderate:
      return CalciumPage::tr("moderate (101 to 400)");
    case CalciumCategory::severe:
      break;
  }
  return CalciumPage::tr("severe (above 400)");
}

QString calcium_place_word(CalciumPlace place) {
  switch (place) {
    case CalciumPlace::aorta:
      return CalciumPage::tr("aorta");
    case CalciumPlace::valve:
      return CalciumPage::tr("valve");
    case CalciumPlace::bone:
      return CalciumPage::tr("bone");
    case CalciumPlace::other:
      return CalciumPage::tr("other");
    default:
      return QString::fromStdString(analysis::to_string(place));
  }
}

}  // namespace

CalciumPage::CalciumPage(Desk& desk, Calcium& calcium)
    : QDockWidget(tr("Calcium score"), &desk.window), desk_(desk), calcium_(calcium) {
  setObjectName("calcium");
  auto* whole = new QWidget;
  auto* rows = new QVBoxLayout(whole);
  rows->setContentsMargins(6, 6, 6, 6);
  total_ = new QLabel;
  total_->setObjectName("calcium_total");
  total_->setWordWrap(true);
  total_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  QFont large = total_->font();
  large.setPointSizeF(1.3 * large.pointSizeF());
  total_->setFont(large);
  state_ = new QLabel;
  state_->setObjectName("calcium_state");
  state_->setWordWrap(true);
  vessels_ = figures_table("calcium_vessels", tr("Calcium by artery"),
                           {tr("Artery"), tr("Agatston"), tr("mm\u00b3"), tr("mg")});
  vessels_->setSelectionMode(QAbstractItemView::NoSelection);
  vessels_->setFocusPolicy(Qt::NoFocus);
  lesions_ =
      figures_table("calcium_lesions", tr("Lesions of calcium"),
                    {tr("Place"), tr("Agatston"), tr("mm\u00b3"), tr("mg"), tr("Peak HU"), tr("Sure")});
  lesions_->setToolTip(
      tr("Click: slices go to the lesion. A click on it in a slice chooses it here. Sure: how much the "
         "place that the program proposes can be trusted."));
  all_ = new QCheckBox(tr("&Bones and what else is bright, too"));
  all_->setObjectName("calcium_all");
  buttons_ = new QWidget;
  auto* grid = new QGridLayout(buttons_);
  grid->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(total_);
  rows->addWidget(state_);
  rows->addWidget(vessels_, 2);
  rows->addWidget(lesions_, 5);
  rows->addWidget(all_);
  rows->addWidget(buttons_);
  rows->addWidget(calibration_row());
  setWidget(whole);
  calcium.set_page(this);
  connect(this, &QDockWidget::visibilityChanged, this, [this](bool visible) {
    calcium_.board().shown.set(!isHidden());
    if (!visible) return;
    size_at_first(*qobject_cast<QMainWindow*>(&desk_.window), *this, calcium_page_width, Qt::Horizontal);
    fill();
  });
  connect(all_, &QCheckBox::toggled, this, &CalciumPage::hide_what_is_not_wanted);
  connect(lesions_, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* item) {
    if (item && !filling_) calcium_.choose(item->data(0, lesion_role).toInt());
  });
  connect(&desk.jobs, &Jobs::changed, this, &CalciumPage::fill_total);
  own_.push_back(calcium.board().changed.observe([this] { fill(); }));
  own_.push_back(calcium.board().chosen.observe([this](const int&) { show_chosen(); }));
  own_.push_back(desk.bench.image_changed.observe([this] { fill_total(); }));
  own_.push_back(desk.bench.other_image_changed.observe([this] { fill_total(); }));
  fill();
}

QWidget* CalciumPage::calibration_row() {
  auto* whole = new QWidget;
  auto* line = new QHBoxLayout(whole);
  line->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(tr("Calibration for the mass"));
  calibration_ = new QDoubleSpinBox;
  calibration_->setObjectName("calcium_calibration");
  calibration_->setAccessibleName(label->text());
  calibration_->setToolTip(
      tr("mg of hydroxyapatite in 1 cm\u00b3 for each HU, of this scanner and protocol, from a phantom."));
  calibration_->setRange(0.0, 5.0);
  calibration_->setDecimals(3);
  calibration_->setSingleStep(0.05);
  calibration_->setSpecialValueText(tr("none"));
  calibration_->setKeyboardTracking(false);
  calibration_->setFocusPolicy(Qt::ClickFocus);
  label->setBuddy(calibration_);
  line->addWidget(label);
  line->addWidget(calibration_);
  line->addStretch(1);
  connect(calibration_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, [this](double value) {
    calcium_.set_calibration(value > 0.0 ? std::optional(value) : std::nullopt);
  });
  return whole;
}

void CalciumPage::add_buttons(const CommandTable& commands) {
  auto* grid = qobject_cast<QGridLayout*>(buttons_->layout());
  const auto add = [&](const char* id, int row, int column, int columns) {
    grid->addWidget(command_button(commands, id), row, column, 1, columns);
  };
  int column = 0;
  for (const char* id : {"calcium.lm", "calcium.lad", "calcium.lcx", "calcium.rca"}) {
    add(id, 0, column++, 1);
    lesions_->addAction(&commands.action(id));
  }
  add("calcium.none", 1, 0, 4);
  lesions_->addAction(&commands.action("calcium.none"));
  lesions_->setContextMenuPolicy(Qt::ActionsContextMenu);
  add("calcium.report", 2, 0, 2);
  add("calcium.save", 2, 2, 2);
}

void CalciumPage::fill() {
  if (isHidden()) return;
  fill_total();
  const QScopedValueRollback<bool> filling(filling_, true);
  fill_vessels();
  fill_lesions();
  hide_what_is_not_wanted();
  show_chosen();
}

void CalciumPage::fill_total() {
  if (isHidden()) return;
  const session::CalciumBoard& board = calcium_.board();
  if (!board.reading()) {
    total_->setText(calcium_.scoring() ? tr("The scan is being scored\u2026") : tr("No score yet"));
    state_->setText(tr("Open a CT without contrast agent, and choose Vessel > Calcium score."));
    return;
  }
  const analysis::CalciumScore& score = board.score();
  total_->setText(tr("Agatston %1: %2. CAC-DRS %3")
                      .arg(score_text(score.total.agatston), category_text(score.category()),
                           QString::fromStdString(analysis::cac_drs(score.total.agatston, score.vessels()))));
  QStringList lines;
  if (board.reading()->tube_kv)
    lines << tr("Tube voltage %1 kV; the threshold of %2 HU is for 120 kV.")
                 .arg(QString::fromStdString(core::shown_text(*board.reading()->tube_kv, 0)),
                      quantity::hu(score.options.threshold_hu));
  for (const std::string& warning : score.warnings) lines << library_text(warning);
  lines << tr("Places are proposals until you have looked at the lesions.");
  if (!board.is_of(desk_.bench.shown_image())) lines << tr("The image that is shown is another one.");
  state_->setText(lines.join('\n'));
}

void CalciumPage::fill_vessels() {
  vessels_->clear();
  const session::CalciumBoard& board = calcium_.board();
  const bool mass = board.reading() && board.score().options.calibration;
  vessels_->setColumnHidden(3, !mass);
  if (!board.reading()) return;
  const auto add = [&](const QString& name, const analysis::CalciumAmount& amount) {
    auto* item =
        new QTreeWidgetItem(vessels_, {name, score_text(amount.agatston), quantity::volume(amount.volume_mm3),
                                       mass ? quantity::volume(amount.mass_mg) : QString()});
    for (int column = 1; column < 4; ++column) item->setTextAlignment(column, Qt::AlignRight);
    return item;
  };
  for (std::size_t n = 0; n < analysis::coronary_places; ++n) {
    const auto place = static_cast<CalciumPlace>(n);
    add(calcium_place_word(place), board.score().of(place))->setIcon(0, square_of(place));
  }
  QTreeWidgetItem* total = add(tr("Total"), board.score().total);
  QFont bold = vessels_->font();
  bold.setBold(true);
  for (int column = 0; column < 4; ++column) total->setFont(column, bold);
}

void CalciumPage::fill_lesions() {
  lesions_->clear();
  const session::CalciumBoard& board = calcium_.board();
  const bool mass = board.reading() && board.score().options.calibration;
  lesions_->setColumnHidden(mass_cell, !mass);
  if (!board.reading()) return;
  for (const analysis::CalciumLesion& lesion : board.score().lesions) {
    QStringList cells;
    cells << calcium_place_word(lesion.place) << score_text(lesion.amount.agatston)
          << quantity::volume(lesion.amount.volume_mm3)
          << (mass ? quantity::volume(lesion.amount.mass_mg) : QString()) << quantity::hu(lesion.peak_hu)
          << (lesion.assigned ? tr("reader") : tr("%1 %").arg(quantity::percent(100.0 * lesion.confidence)));
    auto* item = new QTreeWidgetItem(lesions_, cells);
    item->setIcon(place_cell, square_of(lesion.place));
    item->setData(0, lesion_role, lesion.number);
    for (int column = score_cell; column < sure_cell; ++column)
      item->setTextAlignment(column, Qt::AlignRight);
  }
}

bool CalciumPage::is_wanted(const analysis::CalciumLesion& lesion) const {
  return all_->isChecked() || lesion.assigned || lesion.number == calcium_.board().chosen.get() ||
         (lesion.place != CalciumPlace::bone && lesion.place != CalciumPlace::other);
}

void CalciumPage::hide_what_is_not_wanted() {
  for (int i = 0; i < lesions_->topLevelItemCount(); ++i) {
    QTreeWidgetItem* item = lesions_->topLevelItem(i);
    const analysis::CalciumLesion* lesion = calcium_.board().lesion(item->data(0, lesion_role).toInt());
    item->setHidden(!lesion || !is_wanted(*lesion));
  }
}

void CalciumPage::show_chosen() {
  if (isHidden()) return;
  const QScopedValueRollback<bool> filling(filling_, true);
  hide_what_is_not_wanted();
  QTreeWidgetItem* chosen = nullptr;
  for (int i = 0; i < lesions_->topLevelItemCount(); ++i)
    if (lesions_->topLevelItem(i)->data(0, lesion_role).toInt() == calcium_.board().chosen.get())
      chosen = lesions_->topLevelItem(i);
  lesions_->setCurrentItem(chosen);
  if (chosen) lesions_->scrollToItem(chosen);
}

}  // namespace ostia::workstation
