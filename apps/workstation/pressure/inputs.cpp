#include "pressure/inputs.h"

#include "shell/language.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/session/pressure_document.h"

#include <QHeaderView>
#include <QScopedValueRollback>
#include <QStyledItemDelegate>
#include <string>

namespace ostia::workstation {
namespace {

constexpr int key_role = Qt::UserRole;

QString word_of(std::string_view text) {
  const core::Phrasebook& words =
      session::pressure_words(session::report_language(language_in_use().toStdString()));
  return QString::fromStdString(words.say(text));
}

QString number_text(double value) {
  return QString::fromStdString(core::shortest_text(value));
}

/// Values alone can be typed into.
class OnlyValues final : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const override {
    return index.column() == PressureInputs::value_column
               ? QStyledItemDelegate::createEditor(parent, option, index)
               : nullptr;
  }
};

}  // namespace

PressureInputs::PressureInputs(session::Workbench& bench, session::PressureBoard& board, PressureGuard guard)
    : bench_(bench), board_(board), guard_(std::move(guard)) {
  setObjectName("pressure_inputs");
  setAccessibleName(tr("Inputs of the pressures"));
  setColumnCount(columns);
  setHeaderLabels({tr("Input"), tr("Value"), tr("Unit"), tr("Usual"), tr("Source")});
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setAllColumnsShowFocus(true);
  setItemDelegate(new OnlyValues(this));
  setEditTriggers(EditKeyPressed | DoubleClicked | SelectedClicked);
  setMinimumSize(120, 40);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(name_column, QHeaderView::Stretch);
  header()->setSectionResizeMode(source_column, QHeaderView::Interactive);
  header()->resizeSection(source_column, 14 * fontMetrics().averageCharWidth());
  setToolTip(tr("Double click on a value to type another; nothing typed: the usual one."));
  connect(this, &QTreeWidget::itemChanged, this, &PressureInputs::typed);
  own_.push_back(bench.annotations_changed.observe([this] { fill(); }));
  own_.push_back(bench.case_changed.observe([this] { fill(); }));
  fill();
}

void PressureInputs::fill() {
  if (state() == EditingState) return;
  const QScopedValueRollback<bool> filling(filling_, true);
  const session::PressureNotes notes = board_.notes();
  const hemodynamics::Conditions now = session::conditions_of(notes);
  const auto inputs = hemodynamics::condition_inputs();
  while (topLevelItemCount() < static_cast<int>(inputs.size())) {
    auto* item = new QTreeWidgetItem(this);
    item->setFlags(item->flags() | Qt::ItemIsEditable);
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const hemodynamics::ConditionInput& input = inputs[i];
    QTreeWidgetItem& item = *topLevelItem(static_cast<int>(i));
    const QString key = QString::fromUtf8(input.key.data(), static_cast<int>(input.key.size()));
    const auto value = input.value ? std::optional(now.*input.value) : now.*input.optional;
    const bool told = notes.inputs.contains(std::string(input.key));
    item.setData(name_column, key_role, key);
    item.setText(name_column, word_of(input.meaning));
    item.setText(value_column, value ? number_text(*value) : QString());
    item.setText(unit_column, QString::fromUtf8(input.unit.data(), static_cast<int>(input.unit.size())));
    item.setText(usual_column,
                 number_text(input.usual_low) + QStringLiteral("\u2013") + number_text(input.usual_high));
    item.setText(source_column, told ? tr("given here") : word_of(input.source));
    const QString tip = tr("%1: %2 to %3 are taken; source of the usual value: %4")
                            .arg(word_of(input.meaning), number_text(input.least), number_text(input.most),
                                 word_of(input.source));
    QFont font = item.font(value_column);
    font.setBold(told);
    for (int c = 0; c < columns; ++c) {
      item.setToolTip(c, tip);
      item.setFont(c, font);
    }
    item.setTextAlignment(value_column, Qt::AlignRight | Qt::AlignVCenter);
  }
  setEnabled(bench_.has_case());
}

void PressureInputs::typed(QTreeWidgetItem* item, int column) {
  if (filling_ || column != value_column) return;
  const std::string key = item->data(name_column, key_role).toString().toStdString();
  const QString text = item->text(value_column).trimmed().replace(',', '.');
  guard_([&] {
    bool is_number = false;
    const double value = text.toDouble(&is_number);
    if (!text.isEmpty() && !is_number)
      throw InvalidInput(tr("\u201c%1\u201d is no number").arg(text).toStdString());
    board_.set_input(key, text.isEmpty() ? std::nullopt : std::optional(value));
  });
  QMetaObject::invokeMethod(
      this, [this] { fill(); }, Qt::QueuedConnection);  // what was refused is as it was
}

}  // namespace ostia::workstation
