#pragma once
/// \file The rows of the export dialogs about what fills the lumen.

#include "shell/form_fields.h"

#include "ostia/pipeline/volume_mesh.h"

#include <QObject>
#include <vector>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QListWidget;
class QSpinBox;

namespace ostia::workstation {

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
  FormField layers_field_, formats_field_;
};

}  // namespace ostia::workstation
