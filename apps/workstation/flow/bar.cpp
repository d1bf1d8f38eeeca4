#include "flow/bar.h"

#include "shell/form_fields.h"

#include "ostia/view/value_scale.h"

#include <QAbstractItemView>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

namespace ostia::workstation {
namespace {

constexpr int digits_shown = 8;  // of a bound, as wide as its field

QToolButton* button(const QString& text, const QString& name, const QString& tip) {
  auto* made = new QToolButton;
  made->setText(text);
  made->setObjectName(name);
  made->setToolTip(tip);
  made->setAccessibleName(tip);
  made->setAutoRaise(true);
  made->setFocusPolicy(Qt::StrongFocus);
  return made;
}

QLineEdit* bound(const QString& name, const QString& accessible) {
  auto* made = new QLineEdit;
  made->setObjectName(name);
  made->setAccessibleName(accessible);
  made->setAlignment(Qt::AlignRight);
  made->setMaximumWidth((digits_shown + 2) * made->fontMetrics().horizontalAdvance('0'));
  made->setMinimumWidth(5 * made->fontMetrics().horizontalAdvance('0'));
  return made;
}

}  // namespace

FlowBar::FlowBar(QWidget* parent)
    : QWidget(parent), arrays_(new QComboBox), automatic_(new QCheckBox(tr("Automatic"))) {
  setObjectName("flow_bar");
  arrays_->setObjectName("flow_array");
  arrays_->setAccessibleName(tr("Result that is shown"));
  arrays_->view()->setAccessibleName(arrays_->accessibleName());
  arrays_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  arrays_->setMinimumContentsLength(8);
  automatic_->setObjectName("flow_automatic");
  automatic_->setToolTip(tr("Colours from the 2nd to the 98th percentile of all values"));
  low_ = bound("flow_low", tr("Value of the first colour"));
  high_ = bound("flow_high", tr("Value of the last colour"));
  trouble_ = new QLabel;
  trouble_->setObjectName("flow_range_trouble");
  auto* save = button({}, "flow_save", tr("Save the picture"));
  save->setIcon(style()->standardIcon(QStyle::SP_DialogSaveButton));
  along_ = button(QStringLiteral("\u223f"), "flow_along",
                  tr("Shear stress and pressure along the vessel, in the profile"));
  along_->setCheckable(true);
  along_->setChecked(true);
  auto* close = button(QStringLiteral("\u2715"), "flow_hide", tr("Hide the result"));
  auto* first = new QHBoxLayout;
  first->addWidget(arrays_, 1);
  first->addWidget(along_);
  first->addWidget(save);
  first->addWidget(close);
  auto* second = new QHBoxLayout;
  second->addWidget(automatic_, 1);
  second->addWidget(low_);
  second->addWidget(new QLabel(QStringLiteral("\u2013")));
  second->addWidget(high_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(4, 2, 4, 2);
  column->setSpacing(2);
  column->addLayout(first);
  column->addLayout(second);
  column->addWidget(trouble_);
  trouble_->hide();
  connect(arrays_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &FlowBar::array_changed);
  connect(arrays_, &QComboBox::currentTextChanged, arrays_, &QComboBox::setToolTip);  // where it is cut off
  connect(automatic_, &QCheckBox::toggled, this, [this] {
    check();
    emit range_changed();
  });
  for (QLineEdit* one : {low_, high_}) connect(one, &QLineEdit::textEdited, this, &FlowBar::check);
  for (QLineEdit* one : {low_, high_}) connect(one, &QLineEdit::textEdited, this, &FlowBar::range_changed);
  connect(save, &QToolButton::clicked, this, &FlowBar::save_wanted);
  connect(along_, &QToolButton::toggled, this, &FlowBar::along_toggled);
  connect(close, &QToolButton::clicked, this, &FlowBar::hide_wanted);
}

void FlowBar::set_arrays(const std::vector<FlowArray>& arrays, std::size_t first) {
  const QSignalBlocker quiet(this);
  arrays_->clear();
  for (const FlowArray& array : arrays) arrays_->addItem(title_with_unit(array));
  arrays_->setCurrentIndex(static_cast<int>(first));
  automatic_->setChecked(true);
  check();
}

std::size_t FlowBar::array() const {
  return static_cast<std::size_t>(std::max(0, arrays_->currentIndex()));
}

bool FlowBar::along() const {
  return along_->isChecked();
}

bool FlowBar::automatic() const {
  return automatic_->isChecked();
}

void FlowBar::set_range(const std::pair<double, double>& range) {
  low_->setText(QString::fromStdString(view::range_text(range.first, range)));
  high_->setText(QString::fromStdString(view::range_text(range.second, range)));
  for (QLineEdit* one : {low_, high_}) one->setCursorPosition(0);
}

std::optional<std::pair<double, double>> FlowBar::range() const {
  bool low_is_number = false, high_is_number = false;
  const double low = low_->text().toDouble(&low_is_number), high = high_->text().toDouble(&high_is_number);
  if (!low_is_number || !high_is_number || !std::isfinite(low) || !std::isfinite(high) || !(low < high))
    return std::nullopt;
  return std::pair(low, high);
}

void FlowBar::check() {
  for (QLineEdit* one : {low_, high_}) one->setEnabled(!automatic());
  const bool wrong = !automatic() && !range();
  mark({low_, trouble_}, {});
  mark({high_, trouble_}, wrong ? tr("Type two numbers, the smaller one first.") : QString());
}

}  // namespace ostia::workstation
