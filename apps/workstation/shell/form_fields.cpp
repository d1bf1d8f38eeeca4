#include "shell/form_fields.h"

#include "shell/theme.h"

#include <QApplication>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

/// Of a field that has to be changed.
QColor trouble_ground() {
  return current_theme() == Theme::dark ? QColor(82, 44, 18) : QColor(255, 224, 200);
}

}  // namespace

QColor trouble_color() {
  return current_theme() == Theme::dark ? QColor(255, 150, 60) : QColor(168, 70, 0);
}

FormField add_form_field(QFormLayout* form, const QString& text, QWidget* row, QWidget* input,
                         const QString& name) {
  FormField field{input, new QLabel};
  field.trouble->setObjectName(name + "_trouble");
  field.trouble->setWordWrap(true);
  QPalette palette = field.trouble->palette();
  palette.setColor(QPalette::WindowText, trouble_color());
  field.trouble->setPalette(palette);
  field.trouble->hide();
  auto* both = new QWidget;
  both->setSizePolicy(QSizePolicy::Preferred,
                      QSizePolicy::Maximum);  // what is left over stands below all rows
  auto* column = new QVBoxLayout(both);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(row);
  column->addWidget(field.trouble);
  form->addRow(form_field_label(text, input), both);
  return field;
}

QLabel* form_field_label(const QString& text, QWidget* field) {
  auto* label = new QLabel(text);
  label->setBuddy(field);
  label->setContentsMargins(0, 0, 2, 0);  // the last letter is wider than its advance at some scales
  return label;
}

QWidget* in_a_row(const std::vector<QWidget*>& widgets, const QWidget* stretched) {
  auto* row = new QWidget;
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(0, 0, 0, 0);
  if (!stretched) stretched = widgets.front();
  for (QWidget* widget : widgets) line->addWidget(widget, widget == stretched ? 1 : 0);
  return row;
}

QDoubleSpinBox* number_field(const QString& name, const QString& accessible, double most, int decimals,
                             double step, double value) {
  auto* box = new QDoubleSpinBox;
  box->setObjectName(name);
  box->setAccessibleName(accessible);
  box->setRange(0.0, most);
  box->setDecimals(decimals);
  box->setSingleStep(step);
  box->setValue(value);
  return box;
}

bool mark(const FormField& field, const QString& trouble) {
  field.trouble->setText(trouble);
  field.trouble->setVisible(!trouble.isEmpty());
  QPalette palette = QApplication::palette(field.input);
  if (!trouble.isEmpty()) {
    palette.setColor(QPalette::Base, trouble_ground());
    palette.setColor(QPalette::WindowText, trouble_color());
  }
  field.input->setPalette(palette);
  field.input->setAccessibleDescription(trouble);
  return trouble.isEmpty();
}

}  // namespace ostia::workstation
