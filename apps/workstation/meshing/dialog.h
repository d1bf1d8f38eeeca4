#pragma once
/// \file What is asked before a surface or a mesh is made.

#include "meshing/check.h"
#include "meshing/fields.h"
#include "meshing/sizes.h"
#include "shell/fitted_dialog.h"

#include "ostia/pipeline/vessel_export.h"

#include <filesystem>
#include <memory>
#include <vector>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QPushButton;
class QTabWidget;

namespace ostia::workstation {

class NewFolderField;

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
  Vessels vessels = Vessels::all;
  pipeline::SurfaceEnds ends = pipeline::SurfaceEnds::capped;
  SizeChoice size;
  std::vector<std::string> formats{"vtp", "stl"};
  VolumeChoice volume;  ///< of a mesh
  std::filesystem::path folder;
};

/// Checks while it is filled in: what is wrong stands under its field, which is marked as is its page, and
/// the button waits. A mesh's fields are on pages. Leaves the window to the hand.
class MeshingDialog final : public FittedDialog {
  Q_OBJECT
 public:
  MeshingDialog(ExportSubject subject, const ExportChoice& last, QWidget* parent);
  ExportChoice choice() const;
  pipeline::SurfaceExportOptions surface_options() const;
  pipeline::MeshExportOptions mesh_options() const;
  const ExportSubject& subject() const { return subject_; }
  /// The model was edited: vessels may be others.
  void set_model(std::shared_ptr<const lumen::LumenModel> model, std::vector<std::int32_t> visible,
                 std::int32_t selected);
  MeshingCheck* check_page() { return check_; }  ///< null for a surface
  void accept() override;

 private:
  QFormLayout* page(const QString& title);
  void add_vessels(QFormLayout* form);
  void fill_vessels(ExportChoice::Vessels chosen);
  void add_ends(QFormLayout* form, const ExportChoice& last);
  void add_formats(QFormLayout* form, const ExportChoice& last);
  void add_check();
  void repair(const meshing::ForecastPlace& place);
  void check();
  void mark_pages();
  QString count_trouble() const;
  QString formats_trouble() const;
  void show_estimate();
  std::vector<std::int32_t> vessel_ids() const;
  QString names_of(const std::vector<std::int32_t>& ids) const;

  ExportSubject subject_;
  QComboBox *vessels_ = nullptr, *ends_ = nullptr;
  QLabel *parents_ = nullptr, *estimate_ = nullptr;
  QTabWidget* pages_ = nullptr;
  std::vector<QCheckBox*> formats_;
  NewFolderField* folder_ = nullptr;
  QPushButton* go_ = nullptr;
  SizeFields* size_ = nullptr;
  VolumeFields* volume_ = nullptr;
  MeshingCheck* check_ = nullptr;
  FormField formats_field_;
};

}  // namespace ostia::workstation
