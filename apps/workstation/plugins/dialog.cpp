#include "plugins/dialog.h"

#include "ostia/core/error.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

using session::PluginParameter;
using session::PluginType;

/// "by_mm" as "By, mm".
QString parameter_label(const std::string& name) {
  QString text = QString::fromStdString(name);
  QString unit;
  for (const char* known : {"mm", "hu", "deg", "percent", "s"}) {
    const QString ending = QStringLiteral("_") + known;
    if (!text.endsWith(ending)) continue;
    text.chop(ending.size());
    unit = known == QStringLiteral("hu")        ? QStringLiteral("HU")
           : known == QStringLiteral("deg")     ? QStringLiteral("\u00b0")
           : known == QStringLiteral("percent") ? QStringLiteral("%")
                                                : QString(known);
    break;
  }
  text.replace('_', ' ');
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return unit.isEmpty() ? text : text + QStringLiteral(", ") + unit;
}

QLabel* wrapped_label(const QString& text, const QString& name) {
  auto* label = new QLabel(text);
  label->setObjectName(name);
  label->setWordWrap(true);
  label->setTextFormat(Qt::PlainText);
  return label;
}

bool is_no_value(const PluginParameter& parameter, const std::string& typed) {
  try {
    session::plugin_value(parameter, typed);
    return false;
  } catch (const InvalidInput&) {
    return true;
  }
}

}  // namespace

PluginDialog::PluginDialog(const session::Plugin& plugin, bool is_new,
                           const std::vector<NamedVessel>& vessels, QWidget* parent)
    : FittedDialog(parent) {
  setObjectName("plugin_dialog");
  setWindowTitle(QString::fromStdString(plugin.title));
  auto* layout = new QVBoxLayout(this);
  if (!plugin.text.empty())
    layout->addWidget(wrapped_label(QString::fromStdString(plugin.text), "plugin_text"));
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  layout->addLayout(form);
  for (const PluginParameter& one : plugin.parameters) add_row(form, one, vessels);
  if (is_new) add_question(plugin, *layout);
  layout->addStretch(1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  go_ = buttons->addButton(is_new ? tr("Trust it and run") : tr("Run"), QDialogButtonBox::AcceptRole);
  go_->setObjectName("go");
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  layout->addWidget(buttons);
  go_->setDefault(!is_new);
  check();
}

void PluginDialog::add_question(const session::Plugin& plugin, QVBoxLayout& layout) {
  auto* question =
      wrapped_label(tr("The script %1 is new here, or has changed. It is a program that may do what you "
                       "may do on this computer. Run it if you know where it is from.")
                        .arg(QString::fromStdString(plugin.script.string())),
                    "plugin_question");
  QPalette palette = question->palette();
  palette.setColor(QPalette::WindowText, trouble_color());
  question->setPalette(palette);
  layout.addWidget(question);
}

void PluginDialog::add_row(QFormLayout* form, const PluginParameter& parameter,
                           const std::vector<NamedVessel>& vessels) {
  const QString name = QStringLiteral("plugin.") + QString::fromStdString(parameter.name);
  const QString label = parameter_label(parameter.name);
  const QString value = QString::fromStdString(session::plugin_value_text(parameter.value));
  Row row{parameter, {}, {}};
  QWidget* input = nullptr;
  if (parameter.type == PluginType::flag) {
    auto* box = new QCheckBox;
    box->setChecked(std::get<bool>(parameter.value));
    row.typed = [box] { return std::string(box->isChecked() ? "true" : "false"); };
    input = box;
  } else if (parameter.type == PluginType::choice || parameter.type == PluginType::vessel) {
    auto* box = new QComboBox;
    for (const std::string& one : parameter.choices)
      box->addItem(QString::fromStdString(one), QString::fromStdString(one));
    if (parameter.type == PluginType::vessel)
      for (const NamedVessel& one : vessels) {
        box->addItem(one.name, QString::number(one.id));
        if (one.selected && value.isEmpty()) box->setCurrentIndex(box->count() - 1);
      }
    if (const int at = box->findData(value); at >= 0) box->setCurrentIndex(at);
    row.typed = [box] { return box->currentData().toString().toStdString(); };
    input = box;
  } else {
    auto* line = new QLineEdit(value);
    connect(line, &QLineEdit::textChanged, this, &PluginDialog::check);
    row.typed = [line] { return line->text().trimmed().toStdString(); };
    input = line;
  }
  input->setObjectName(name);
  input->setAccessibleName(label);
  row.field = add_form_field(form, label, input, input, name);
  rows_.push_back(std::move(row));
}

void PluginDialog::check() {
  bool good = true;
  for (const Row& row : rows_) {
    QString trouble;
    if (is_no_value(row.parameter, row.typed()))
      trouble = row.parameter.type == PluginType::whole ? tr("A whole number.") : tr("A number.");
    good = mark(row.field, trouble) && good;
  }
  if (go_) go_->setEnabled(good);
  fit();
}

session::PluginValues PluginDialog::values() const {
  session::PluginValues values;
  for (const Row& row : rows_) values[row.parameter.name] = session::plugin_value(row.parameter, row.typed());
  return values;
}

}  // namespace ostia::workstation
