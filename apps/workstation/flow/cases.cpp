#include "flow/cases.h"

#include "flow/results.h"
#include "flow/systems.h"
#include "shell/desk.h"
#include "shell/open_file.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/pipeline/exported_meshes.h"
#include "ostia/pipeline/solver_case.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <new>
#include <tuple>
#include <utility>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

// Stages of these jobs, which the libraries name.
[[maybe_unused]] const char* const texts_of_flow_jobs[] = {
    QT_TRANSLATE_NOOP("stages", "checking the mesh"),
    QT_TRANSLATE_NOOP("stages", "iteration, residual"),
    QT_TRANSLATE_NOOP("stages", "time, s"),
    QT_TRANSLATE_NOOP("stages", "reading the result"),
};

/// CASE-mesh, CASE-mesh-2, ...: what the export proposes. CASE-2-mesh is of another case.
bool is_mesh_folder_of(const std::string& stem, const std::string& name) {
  const std::string first = stem + "-mesh";
  if (!name.starts_with(first)) return false;
  const std::string number = name.substr(first.size());
  return number.empty() || (number.size() > 1 && number[0] == '-' &&
                            number.find_first_not_of("0123456789", 1) == std::string::npos);
}

/// The newest mesh that was exported beside the case, into a folder that bears its name: the file, or the
/// folder where it holds several trees' meshes; empty where there is none.
fs::path newest_mesh(const fs::path& case_file) {
  std::error_code error;
  fs::path newest;
  fs::file_time_type time;
  const std::string stem = case_file.stem().string();
  for (fs::directory_iterator at(case_file.parent_path(), error), end; !error && at != end;
       at.increment(error)) {
    if (fs::exists(at->path() / "flow-case.json", error)) continue;  // a case keeps its mesh
    if (!is_mesh_folder_of(stem, at->path().filename().string())) continue;
    const std::vector<pipeline::ExportedMesh> meshes = pipeline::exported_meshes(at->path());
    if (meshes.empty()) continue;
    const fs::file_time_type written = fs::last_write_time(meshes.front().file, error);
    const fs::path mesh = meshes.size() > 1 ? at->path() : meshes.front().file;
    if (newest.empty() || written > time) std::tie(newest, time) = std::pair(mesh, written);
  }
  return newest;
}

using Warnings = std::vector<std::string>;

QString as_text(const fs::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace

FlowCases::FlowCases(Desk& desk, FlowResults& results)
    : QObject(&desk.window), desk_(desk), results_(results) {
  // A run that was cancelled or failed can be begun again.
  connect(&desk.jobs, &Jobs::changed, this, [this] {
    if (being_run_.empty() || desk_.jobs.running("flow_run")) return;
    leave_case(std::exchange(being_run_, {}), {}, being_run_of_);
  });
  other_case_ = desk.bench.case_changed.observe([this] {
    if (dialog_) dialog_->reject();
    made_mesh_.clear();
    last_.mesh.clear();
    last_.flow_ml_s.reset();
  });
}

void FlowCases::mesh_made(const fs::path& mesh) {
  made_mesh_ = mesh;
}

void FlowCases::ask(const fs::path& case_file) {
  FlowChoice proposed = last_;
  const fs::path newest = case_file.empty() ? fs::path() : newest_mesh(case_file);
  if (!newest.empty()) proposed.mesh = newest;
  if (std::error_code ignored; fs::exists(made_mesh_, ignored)) proposed.mesh = made_mesh_;
  auto* dialog = new FlowDialog(proposed, &desk_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &FlowDialog::mesh_wanted, this,
          [this, dialog](const QString& file) { read_mesh(*dialog, file); });
  connect(dialog, &QDialog::accepted, this, [this, dialog] { write(*dialog); });
  connect(dialog, &QDialog::finished, this, [this] { desk_.jobs.cancel("flow_mesh"); });
  dialog_ = dialog;
  dialog->open();
}

void FlowCases::read_mesh(FlowDialog& dialog, const QString& file) {
  desk_.jobs.cancel("flow_mesh");
  if (!QFileInfo::exists(file)) return;
  const fs::path path = file.toStdString();
  desk_.jobs.run(
      "flow_mesh", tr("Mesh"),
      [path](const core::TaskContext& task) { return std::any(read_flow_meshes(path, task)); },
      [asked = QPointer(&dialog), path](const std::any& meshes) {
        if (asked) asked->set_meshes(path, std::any_cast<const std::vector<FlowMesh>&>(meshes));
      },
      [asked = QPointer(&dialog), path](const QString& message) {
        if (asked) asked->set_mesh_trouble(path, message);
      });
}

void FlowCases::write(const FlowDialog& dialog) {
  last_ = dialog.choice();
  desk_.jobs.run(
      "flow_case", tr("Flow case"),
      [choice = last_, flow = dialog.flow_options(),
       meshes = dialog.meshes()](const core::TaskContext& task) {
        try {
          return std::any(write_cases(choice, flow, meshes, task));
        } catch (const std::bad_alloc&) {
          throw ResourceError(QCoreApplication::translate(
                                  "jobs", "There is not enough memory for this case: use a coarser mesh.")
                                  .toStdString());
        }
      },
      [this, choice = last_, of = desk_.case_path](const std::any& warnings) {
        tell_written(choice, std::any_cast<const Warnings&>(warnings), of);
      },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The flow case could not be written"));
      });
}

void FlowCases::tell_written(const FlowChoice& made, const Warnings& warnings, const fs::path& of) {
  QStringList notes{as_text(made.folder)};
  for (const std::string& warning : warnings) notes << QString::fromStdString(warning);
  if (!warnings.empty()) desk_.messages.say(QString::fromStdString(warnings.front()));
  const std::string program = made.waveform.empty() ? "simpleFoam" : "pimpleFoam";
  const bool here = made.solver == pipeline::SolverKind::openfoam && core::program_on_path(program);
  if (here && made.run && !desk_.jobs.running("flow_run"))
    run(made.folder, of);
  else if (here)
    leave_case(made.folder, notes, of);
  else
    desk_.jobs.leave("flow_case", tr("%1: flow case written").arg(as_text(made.folder.filename())),
                     notes.join('\n'), tr("Open folder"),
                     [this, folder = made.folder] { open_with_desktop(desk_, folder); });
}

void FlowCases::leave_case(const fs::path& folder, const QStringList& notes, const fs::path& of) {
  // Where nothing is being run the line is the run's, which then takes its place.
  desk_.jobs.leave(desk_.jobs.running("flow_run") ? "flow_case" : "flow_run",
                   tr("%1: flow case written").arg(as_text(folder.filename())),
                   notes.isEmpty() ? as_text(folder) : notes.join('\n'), tr("Run the solver"),
                   [this, folder, of] { run(folder, of); });
}

void FlowCases::run(const fs::path& case_folder, const fs::path& of) {
  if (desk_.jobs.running("flow_run")) {  // a second one would begin before the first has ended
    desk_.messages.say(tr("The solver is running already: cancel it first."));
    return;
  }
  const QString name = as_text(case_folder.filename());
  being_run_ = case_folder;
  being_run_of_ = of;
  desk_.jobs.run(
      "flow_run", tr("Solver"),
      [case_folder](const core::TaskContext& task) { return std::any(run_cases(case_folder, task)); },
      [this, case_folder, name, of](const std::any& result) {
        being_run_.clear();
        const auto& runs = std::any_cast<const std::vector<FlowRun>&>(result);
        show_result(case_folder, walls_of(runs), outcome_of(name, runs), reasons_of(runs), of);
      },
      [this](const QString& message) { desk_.messages.complain(message, tr("The solver's run failed")); });
}

void FlowCases::show_result(const fs::path& folder, const std::vector<fs::path>& walls,
                            const QString& outcome, const QString& trouble, const fs::path& of) {
  const auto show = [this, walls, trouble] {
    if (!trouble.isEmpty())
      desk_.messages.complain(tr("The result is shown, but look at it before you use it: %1").arg(trouble),
                              tr("A result to look at"));
    results_.open(walls);
  };
  desk_.jobs.leave("flow_run", outcome, as_text(folder), tr("Show the result"), [this, show, folder, of] {
    if (of == desk_.case_path)
      show();
    else
      refuse_result(folder, of);
  });
  if (of == desk_.case_path) show();
}

void FlowCases::refuse_result(const fs::path& folder, const fs::path& of) {
  const QString name = as_text(folder.filename());
  desk_.messages.complain(
      of.empty() ? tr("The result of %1 was computed while no case was open. Close the case that "
                      "is open to see it.")
                       .arg(name)
                 : tr("The result of %1 belongs to the case %2, which is not open. Open that "
                      "case, then show the result.")
                       .arg(name, as_text(of.filename())),
      tr("A result of another case"));
}

}  // namespace ostia::workstation
