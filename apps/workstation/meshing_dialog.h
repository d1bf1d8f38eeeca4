#pragma once
/// \file What is asked before a surface or a mesh is made.

#include "meshing_fields.h"

#include "ostia/pipeline/vessel_export.h"

#include <QDialog>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace ostia::workstation {

enum class ExportKind { surface, mesh };

/// What the dialog is about.
struct ExportSubject {
  ExportKind kind = ExportKind::mesh;
  std::shared_ptr<const lumen::LumenModel> model;
  std::vector<std::int32_t> visible;  ///< vessels that are shown in 3D
  std::int32_t selected = 0;
  std::filesystem::path folder;  ///< proposed
  bool one_is_running = false;   ///< a job of this kind, which a new one would end
};

/// What was chosen; kept for the next time.
struct ExportChoice {
  enum class Vessels { all, visible, selected };
  enum class Size { as_modelled, by_calibre, even };  ///< the first for a surface alone
  Vessels vessels = Vessels::all;
  pipeline::SurfaceEnds ends = pipeline::SurfaceEnds::capped;
  Size size = Size::by_calibre;
  double edges_around = 16.0, edge_mm = 0.4;
  std::vector<std::string> formats{"vtp", "stl"};
  VolumeChoice volume;  ///< of a mesh
  std::filesystem::path folder;
};

/// Checks while it is filled in: what is wrong stands under its field, which is marked, and the button waits.
class MeshingDialog final : public QDialog {
  Q_OBJECT
 public:
  MeshingDialog(ExportSubject subject, const ExportChoice& last, QWidget* parent);
  ExportChoice choice() const;
  pipeline::SurfaceExportOptions surface_options() const;
  pipeline::MeshExportOptions mesh_options() const;
  void accept() override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void add_vessels(QFormLayout* form, const ExportChoice& last);
  void add_ends(QFormLayout* form, const ExportChoice& last);
  void add_size(QFormLayout* form, const ExportChoice& last);
  void add_formats(QFormLayout* form, const ExportChoice& last);
  void add_folder(QFormLayout* form);
  void choose_folder();
  void check();
  void fit();
  QString size_trouble() const;
  QString formats_trouble() const;
  QString folder_trouble() const;
  void show_estimate();
  std::vector<std::int32_t> vessel_ids() const;
  std::optional<meshing::SizingOptions> sizing() const;
  QString names_of(const std::vector<std::int32_t>& ids) const;

  ExportSubject subject_;
  QComboBox *vessels_ = nullptr, *ends_ = nullptr, *size_ = nullptr;
  QLabel *parents_ = nullptr, *estimate_ = nullptr;
  QDoubleSpinBox *edges_ = nullptr, *edge_mm_ = nullptr;
  std::vector<QCheckBox*> formats_;
  QLineEdit* folder_ = nullptr;
  QPushButton* go_ = nullptr;
  VolumeFields* volume_ = nullptr;
  ExportField size_field_, formats_field_, folder_field_;
};

}  // namespace ostia::workstation
