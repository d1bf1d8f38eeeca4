#include "flow/dialog.h"

#include "shell/file_dialogs.h"
#include "shell/new_folder.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/io/volume_mesh_file.h"
#include "ostia/pipeline/exported_meshes.h"
#include "ostia/solver/openfoam_launch.h"
#include "ostia/view/value_scale.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <cmath>
#include <string>

namespace ostia::workstation {
namespace {

using pipeline::SolverKind;
using solver::OutletModel;

constexpr double most_flow_ml_s = 50.0, least_flow_ml_s = 1e-3;
constexpr double least_viscosity = 0.1, most_viscosity = 100.0;
constexpr double least_density = 500.0, most_density = 2000.0;

QString program_of(bool pulsatile) {
  return pulsatile ? QStringLiteral("pimpleFoam") : QStringLiteral("simpleFoam");
}

bool between(double value, double least, double most) {
  return value >= least && value <= most;
}

}  // namespace

QString title_of(SolverKind kind) {
  return QString::fromStdString(std::string(traits_of(kind).title));
}

std::vector<FlowMesh> read_flow_meshes(const std::filesystem::path& path, const core::TaskContext& task) {
  const std::vector<pipeline::ExportedMesh> files = pipeline::exported_meshes(path);
  if (files.empty())
    throw InvalidInput(
        FlowDialog::tr("There is no mesh.vtu in this folder. Export a mesh from the case.").toStdString());
  std::vector<FlowMesh> meshes;
  for (const pipeline::ExportedMesh& file : files) {
    task.throw_if_cancelled();
    FlowMesh read{
        file.name, std::make_shared<const geometry::MixedMesh>(io::read_volume_mesh(file.file)), {}};
    try {
      read.ends = solver::boundary_flow(*read.mesh, {});
    } catch (const InvalidInput& error) {
      throw InvalidInput(file.name.empty() ? error.what() : file.name + ": " + error.what());
    }
    meshes.push_back(std::move(read));
  }
  return meshes;
}

void FlowDialog::set_meshes(const std::filesystem::path& file, std::vector<FlowMesh> meshes) {
  if (file != mesh_file_->text().toStdString()) return;
  meshes_ = std::move(meshes);
  mesh_refused_.clear();
  check();
}

void FlowDialog::set_mesh_trouble(const std::filesystem::path& file, const QString& trouble) {
  if (file != mesh_file_->text().toStdString()) return;
  meshes_.clear();
  mesh_refused_ = trouble;
  check();
}

/// What is typed is not read with every letter.
void FlowDialog::want_mesh() {
  meshes_.clear();
  mesh_refused_.clear();
  typing_.start();
  propose_folder();
  check();
}

void FlowDialog::choose_mesh() {
  const QString chosen = ask_open_file(this, tr("Mesh"), tr("Volume meshes (*.vtu);;All files (*)"),
                                       QFileInfo(mesh_file_->text()).absolutePath());
  if (!chosen.isEmpty()) mesh_file_->setText(chosen);
}

/// tube-mesh/mesh.vtu: tube-flow, tube-flow-2, ... beside the mesh's folder.
void FlowDialog::propose_folder() {
  if (mesh_file_->text().isEmpty()) return;
  const QFileInfo chosen(mesh_file_->text());  // a mesh.vtu, or the folder of several trees' meshes
  const QFileInfo mesh_folder(chosen.isDir() ? QDir(chosen.absoluteFilePath()).absolutePath()
                                             : chosen.absolutePath());
  QString name = mesh_folder.fileName();
  const int at = name.lastIndexOf("-mesh");
  name = at > 0 ? name.left(at) : name;
  folder_->propose(free_folder((mesh_folder.absolutePath() + "/" + name + "-flow").toStdString()));
}

QString FlowDialog::mesh_trouble() const {
  const QFileInfo file(mesh_file_->text());
  if (mesh_file_->text().isEmpty()) return tr("Choose a mesh: the mesh.vtu of an exported mesh.");
  if (!file.exists()) return tr("There is no file of this name.");
  if (!mesh_refused_.isEmpty()) return mesh_refused_;
  for (const FlowMesh& one : meshes_) {
    if (one.mesh->quadratic())
      return tr(
          "Its elements are quadratic, the solvers take linear ones. Export the mesh with linear elements.");
    if (!traits_of(solver()).prisms && !one.mesh->prisms.empty())
      return tr("It has prisms, %1 takes tetrahedra alone. Export it with layers as tetrahedra, or "
                "choose OpenFOAM.")
          .arg(title_of(solver()));
  }
  return {};
}

QString FlowDialog::flow_trouble() const {
  if (flow_->currentIndex() == 0 || between(flow_ml_s_->value(), least_flow_ml_s, most_flow_ml_s)) return {};
  return tr("A flow of %1 ml/s is not that of a vessel. Choose %2 to %3 ml/s.")
      .arg(flow_ml_s_->value(), 0, 'f', 3)
      .arg(least_flow_ml_s)
      .arg(most_flow_ml_s);
}

QString FlowDialog::outlets_trouble() const {
  if (traits_of(solver()).shares || choice().outlets != OutletModel::split) return {};
  return tr("%1 has no outlets with a given share. Choose pressure 0 or resistances, or OpenFOAM.")
      .arg(title_of(solver()));
}

QString FlowDialog::blood_trouble() const {
  if (viscosity_->isEnabled() && !between(viscosity_->value(), least_viscosity, most_viscosity))
    return tr("Choose a viscosity of %1 to %2 mPa s.").arg(least_viscosity).arg(most_viscosity);
  if (!between(density_->value(), least_density, most_density))
    return tr("Choose a density of %1 to %2 kg/m\u00b3.").arg(least_density).arg(most_density);
  return {};
}

void FlowDialog::check() {
  if (!go_) return;  // while it is put together
  flow_ml_s_->setVisible(flow_->currentIndex() == 1);
  viscosity_->setEnabled(rheology_->currentIndex() == 0);
  mark({viscosity_, blood_field_.trouble}, {});
  mark({density_, blood_field_.trouble}, {});
  FormField blood = blood_field_;
  if (!between(density_->value(), least_density, most_density)) blood.input = density_;
  bool fits = mark(mesh_field_, mesh_trouble());
  fits = mark(flow_field_, flow_trouble()) && fits;
  fits = mark(outlets_field_, outlets_trouble()) && fits;
  fits = mark(blood, blood_trouble()) && fits;
  const bool full = !QDir(folder_->text()).isEmpty();
  fits = folder_->check(full ? tr("The folder holds files. Name another one.") : QString()) && fits;
  go_->setEnabled(fits && !meshes_.empty());
  show_ends();
  show_note();
  fit();
}

void FlowDialog::show_ends() {
  ends_->clear();
  if (meshes_.empty()) {
    const bool reading = mesh_refused_.isEmpty() && QFileInfo::exists(mesh_file_->text());
    if (reading) new QTreeWidgetItem(ends_, {tr("reading\u2026")});
    return;
  }
  const FlowChoice now = choice();
  for (const FlowMesh& one : meshes_) show_ends_of(one, now);
  for (int column = 0; column < ends_->columnCount(); ++column) ends_->resizeColumnToContents(column);
}

/// Each system's outlets share what flows into it.
void FlowDialog::show_ends_of(const FlowMesh& mesh, const FlowChoice& now) {
  const auto digits = [](double value) { return QString::fromStdString(view::three_digits(value)); };
  const auto width = [&](double mm) { return tr("%1 mm").arg(digits(mm)); };
  const auto amount = [&](double ml_s) { return tr("%1 ml/s").arg(digits(ml_s)); };
  double through = 0.0;
  for (const solver::Inlet& inlet : mesh.ends.inlets) {
    const double diameter = inlet.section.diameter_mm();
    const double flow = now.flow_ml_s.value_or(solver::usual_flow_ml_s(diameter));
    through += flow;
    new QTreeWidgetItem(ends_, {QString::fromStdString(inlet.name), width(diameter), amount(flow)});
  }
  for (const solver::Outlet& outlet : mesh.ends.outlets)
    new QTreeWidgetItem(
        ends_, {QString::fromStdString(outlet.name), width(outlet.diameter_mm),
                now.outlets == OutletModel::split ? amount(outlet.share * through) : tr("computed")});
}

void FlowDialog::show_note() {
  const FlowChoice now = choice();
  const QString program = program_of(!now.waveform.empty());
  const bool openfoam = now.solver == SolverKind::openfoam;
  const bool here = openfoam && core::program_on_path(program.toStdString());
  run_->setEnabled(here);
  if (!openfoam)
    note_->setText(
        tr("Run it where %1 is installed: %2 in the folder.")
            .arg(title_of(now.solver), QString::fromStdString(std::string(traits_of(now.solver).run))));
  else if (!here)
    note_->setText(
        tr("%1 is not on the PATH. Install OpenFOAM (Debian: apt install openfoam), or run Allrun in "
           "the folder where it is installed.")
            .arg(program));
  else
    note_->clear();
  note_->setVisible(!note_->text().isEmpty());
}

SolverKind FlowDialog::solver() const {
  return static_cast<SolverKind>(solver_->currentData().toInt());
}

FlowChoice FlowDialog::choice() const {
  FlowChoice made;
  made.mesh = mesh_file_->text().toStdString();
  made.folder = folder_->path();
  made.solver = solver();
  if (flow_->currentIndex() == 1) made.flow_ml_s = flow_ml_s_->value();
  made.waveform = waveform_->currentData().toString().toStdString();
  made.outlets = static_cast<OutletModel>(outlets_->currentData().toInt());
  made.blood.rheology =
      rheology_->currentIndex() == 1 ? solver::Rheology::carreau : solver::Rheology::newtonian;
  made.blood.viscosity_mpa_s = viscosity_->value();
  made.blood.density_kg_m3 = density_->value();
  made.run = run_->isChecked();  // also where it cannot be run: it is kept for one that can
  return made;
}

solver::BoundaryFlowOptions FlowDialog::flow_options() const {
  const FlowChoice now = choice();
  solver::BoundaryFlowOptions options;
  options.blood = now.blood;
  options.flow_ml_s = now.flow_ml_s;
  options.outlets = now.outlets;
  if (!now.waveform.empty()) options.waveform = solver::builtin_waveform(now.waveform);
  return options;
}

void FlowDialog::accept() {
  check();
  if (go_->isEnabled()) QDialog::accept();
}

}  // namespace ostia::workstation
