#pragma once
/// \file Fields of the export dialogs: what is wrong stands under each.

#include "ostia/pipeline/volume_mesh.h"

#include <QObject>
#include <vector>

class QCheckBox;
class QColor;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QListWidget;
class QSpinBox;
class QWidget;

namespace ostia::workstation {

/// An input with the text about what is wrong with it.
struct ExportField {
  QWidget* input = nullptr;
  QLabel* trouble = nullptr;
};
/// A row of the form; the text under it is called `name`_trouble.
ExportField add_export_field(QFormLayout* form, const QString& text, QWidget* row, QWidget* input,
                             const QString& name);
QLabel* export_field_label(const QString& text, QWidget* field);
/// Side by side; the first takes the room that is left over, or `stretched`.
QWidget* in_a_row(const std::vector<QWidget*>& widgets, const QWidget* stretched = nullptr);
/// From 0 to `most`, which bounds what can be typed: what is allowed is checked.
QDoubleSpinBox* number_field(const QString& name, const QString& accessible, double most, int decimals,
                             double step, double value);
/// Of what is wrong, in words and of a field that has to be changed.
QColor trouble_color();
/// Colours the field and shows the text; nothing wrong: neither. Returns whether nothing is.
bool mark(const ExportField& field, const QString& trouble);

/// What fills the lumen, and the formats it is written in; kept for the next time.
struct VolumeChoice {
  int layers = 0;
  double thickness = 0.25;  ///< over the local edge
  bool split = false;
  int order = 1;
  std::vector<io::MeshFormat> formats;
};

/// The rows about it in the mesh's dialog.
class VolumeFields final : public QObject {
  Q_OBJECT
 public:
  VolumeFields(QFormLayout* elements, QFormLayout* formats, const VolumeChoice& last, QObject* parent);
  VolumeChoice choice() const;
  pipeline::VolumeOptions options() const;
  /// Marks what is wrong; returns whether nothing is.
  bool check();
  void scale_layers(double factor);  ///< their thickness
  void drop_layers();

 signals:
  void changed();

 private:
  void add_layers(QFormLayout* form, const VolumeChoice& last);
  void add_order(QFormLayout* form, const VolumeChoice& last);
  void add_formats(QFormLayout* form, const VolumeChoice& last);
  QString layers_trouble() const;
  QString formats_trouble() const;

  QSpinBox* layers_ = nullptr;
  QDoubleSpinBox* thickness_ = nullptr;
  QCheckBox* split_ = nullptr;
  QComboBox* order_ = nullptr;
  QListWidget* formats_ = nullptr;
  ExportField layers_field_, formats_field_;
};

}  // namespace ostia::workstation
