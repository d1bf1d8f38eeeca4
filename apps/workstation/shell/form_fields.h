#pragma once
/// \file Fields of a form: what is wrong stands under each.

#include <QString>
#include <vector>

class QColor;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QWidget;

namespace ostia::workstation {

/// An input with the text about what is wrong with it.
struct FormField {
  QWidget* input = nullptr;
  QLabel* trouble = nullptr;
};
/// A row of the form; the text under it is called `name`_trouble.
FormField add_form_field(QFormLayout* form, const QString& text, QWidget* row, QWidget* input,
                         const QString& name);
QLabel* form_field_label(const QString& text, QWidget* field);
/// Side by side; the first takes the room that is left over, or `stretched`.
QWidget* in_a_row(const std::vector<QWidget*>& widgets, const QWidget* stretched = nullptr);
/// From 0 to `most`, which bounds what can be typed: what is allowed is checked.
QDoubleSpinBox* number_field(const QString& name, const QString& accessible, double most, int decimals,
                             double step, double value);
/// Of what is wrong, in words and of a field that has to be changed.
QColor trouble_color();
/// Colours the field and shows the text; nothing wrong: neither. Returns whether nothing is.
bool mark(const FormField& field, const QString& trouble);

}  // namespace ostia::workstation
