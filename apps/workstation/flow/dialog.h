#pragma once
/// \file What is asked before a solver's case is written.

#include "shell/fitted_dialog.h"
#include "shell/form_fields.h"

#include "ostia/core/task_context.h"
#include "ostia/pipeline/solver_case.h"
#include "ostia/solver/boundary_conditions.h"

#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;

namespace ostia::workstation {

class NewFolderField;

QString title_of(pipeline::SolverKind kind);  ///< "OpenFOAM"

/// What was chosen; kept for the next time.
struct FlowChoice {
  std::filesystem::path mesh;  ///< of one tree; or the folder of an exported mesh, of all of its trees
  std::filesystem::path folder;
  pipeline::SolverKind solver = pipeline::SolverKind::openfoam;
  std::optional<double> flow_ml_s;  ///< through each inlet; nothing: by its diameter
  std::string waveform;             ///< as solver::builtin_waveform knows it; empty: steady
  solver::OutletModel outlets = solver::OutletModel::split;
  solver::Blood blood;
  bool run = true;
};

/// A tree's mesh with its open ends, as they were found.
struct FlowMesh {
  std::string name;  ///< of the tree; empty where there is one
  std::shared_ptr<const geometry::MixedMesh> mesh;
  solver::BoundaryFlow ends;
};
/// Reads those that a path means (pipeline::exported_meshes): nothing flows from one to another, so each is a
/// system, and a case, of its own. Throws InvalidInput where there is none, with the tree's name what
/// io::read_volume_mesh and solver::boundary_flow throw; Cancelled.
std::vector<FlowMesh> read_flow_meshes(const std::filesystem::path& path,
                                       const core::TaskContext& task = core::no_task());

/// Checks while it is filled in, as MeshingDialog does. The mesh is read by its owner in the background.
class FlowDialog final : public FittedDialog {
  Q_OBJECT
 public:
  FlowDialog(const FlowChoice& last, QWidget* parent);
  FlowChoice choice() const;
  solver::BoundaryFlowOptions flow_options() const;
  const std::vector<FlowMesh>& meshes() const { return meshes_; }
  /// The answer to `mesh_wanted`; one for a file that is no longer wanted is ignored.
  void set_meshes(const std::filesystem::path& file, std::vector<FlowMesh> meshes);
  void set_mesh_trouble(const std::filesystem::path& file, const QString& trouble);
  void accept() override;

 signals:
  void mesh_wanted(const QString& file);

 private:
  void add_mesh(QFormLayout* form, const FlowChoice& last);
  void add_ends(QFormLayout* form);
  void add_solver(QFormLayout* form, const FlowChoice& last);
  void add_flow(QFormLayout* form, const FlowChoice& last);
  void add_outlets(QFormLayout* form, const FlowChoice& last);
  void add_blood(QFormLayout* form, const FlowChoice& last);
  void add_folder(QFormLayout* form, const FlowChoice& last);
  void choose_mesh();
  void want_mesh();
  void propose_folder();
  void check();
  void show_ends();
  void show_ends_of(const FlowMesh& mesh, const FlowChoice& now);
  void show_note();
  QString mesh_trouble() const;
  QString flow_trouble() const;
  QString outlets_trouble() const;
  QString blood_trouble() const;
  pipeline::SolverKind solver() const;

  QLineEdit* mesh_file_ = nullptr;
  NewFolderField* folder_ = nullptr;
  QTreeWidget* ends_ = nullptr;
  QComboBox *solver_ = nullptr, *flow_ = nullptr, *waveform_ = nullptr, *outlets_ = nullptr,
            *rheology_ = nullptr;
  QDoubleSpinBox *flow_ml_s_ = nullptr, *viscosity_ = nullptr, *density_ = nullptr;
  QCheckBox* run_ = nullptr;
  QLabel* note_ = nullptr;
  QPushButton* go_ = nullptr;
  FormField mesh_field_, flow_field_, outlets_field_, blood_field_;
  std::vector<FlowMesh> meshes_;  // none: not read yet, or refused
  QString mesh_refused_;
  QTimer typing_;
};

}  // namespace ostia::workstation
