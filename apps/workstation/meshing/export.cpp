#include "meshing/export.h"

#include "meshing/dock.h"
#include "meshing/forecast.h"
#include "shell/desk.h"
#include "shell/file_dialogs.h"
#include "shell/new_folder.h"
#include "shell/open_file.h"
#include "shell/panel.h"
#include "views/scene_widget.h"

#include "ostia/core/error.h"

#include <cmath>
#include <new>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

// Stages of these jobs, which the libraries name.
[[maybe_unused]] const char* const texts_of_mesh_jobs[] = {
    QT_TRANSLATE_NOOP("stages", "walls"),
    QT_TRANSLATE_NOOP("stages", "ends cut"),
    QT_TRANSLATE_NOOP("stages", "clipping"),
    QT_TRANSLATE_NOOP("stages", "caps"),
    QT_TRANSLATE_NOOP("stages", "centerlines of the cut lumen"),
    QT_TRANSLATE_NOOP("stages", "remeshing"),
    QT_TRANSLATE_NOOP("stages", "flow extensions"),
    QT_TRANSLATE_NOOP("stages", "boundary layers"),
    QT_TRANSLATE_NOOP("stages", "tetrahedra"),
    QT_TRANSLATE_NOOP("stages", "quadratic elements"),
    QT_TRANSLATE_NOOP("stages", "quality"),
    QT_TRANSLATE_NOOP("stages", "mesh quality"),
    QT_TRANSLATE_NOOP("stages", "preview"),
    QT_TRANSLATE_NOOP("stages", "reading"),
};

QString job_name(ExportKind kind) {
  return kind == ExportKind::mesh ? QStringLiteral("mesh") : QStringLiteral("surface");
}

std::vector<std::int32_t> shown_in_3d(const session::Session& session) {
  std::vector<std::int32_t> shown;
  for (const geometry::Vessel& vessel : session.file().model()->tree.vessels) {
    const session::VesselMark* mark = session::find_mark(*session.file().annotations(), vessel.id);
    if (!mark || mark->visible) shown.push_back(vessel.id);
  }
  return shown;
}

}  // namespace

MeshingExport::MeshingExport(Desk& desk, SceneWidget& scene)
    : QObject(&desk.window),
      desk_(desk),
      scene_(scene),
      dock_(new MeshDock(desk.bench, scene, &desk.window)) {
  dock_->hide();
  last_[ExportKind::surface].size.size = SizeChoice::Size::as_modelled;
  session::Workbench& bench = desk.bench;
  own_.push_back(bench.case_changed.observe([this] {
    ++case_;
    desk_.jobs.cancel("mesh_preview");
    if (dialog_) dialog_->reject();
  }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent&) {
    const session::Workbench& now = desk_.bench;
    if (dialog_)
      dialog_->set_model(now.session().file().model(), shown_in_3d(now.session()), now.vessel.get());
  }));
}

void MeshingExport::ask(ExportKind kind, const fs::path& case_file) {
  if (dialog_ && dialog_->isVisible() && dialog_->subject().kind == kind) {
    dialog_->raise();
    dialog_->activateWindow();
    return;
  }
  if (dialog_ && dialog_->isVisible()) dialog_->reject();
  session::Workbench& bench = desk_.bench;
  ExportSubject subject;
  subject.kind = kind;
  subject.model = bench.session().file().model();
  subject.visible = shown_in_3d(bench.session());
  subject.selected = bench.vessel.get();
  subject.folder = free_folder_beside(case_file, job_name(kind).toStdString());
  subject.one_is_running = desk_.jobs.running(job_name(kind));
  auto* dialog = new MeshingDialog(std::move(subject), last_[kind], &desk_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this,
          [this, kind, dialog] { start(kind, *dialog, dialog->subject().model); });
  if (kind == ExportKind::mesh) new MeshingForecast(desk_, scene_, *dialog);
  dialog_ = dialog;
  dialog->show();
}

void MeshingExport::start(ExportKind kind, const MeshingDialog& dialog,
                          const std::shared_ptr<const lumen::LumenModel>& model) {
  last_[kind] = dialog.choice();
  const fs::path folder = last_[kind].folder;
  const auto made = [kind, folder, model, surface = dialog.surface_options(),
                     mesh = kind == ExportKind::mesh ? dialog.mesh_options() : pipeline::MeshExportOptions()](
                        const core::TaskContext& task) {
    try {
      return std::any(kind == ExportKind::mesh ? pipeline::export_mesh(folder, *model, mesh, task)
                                               : pipeline::export_surface(folder, *model, surface, task));
    } catch (const std::bad_alloc&) {
      throw ResourceError(too_little_memory());
    }
  };
  desk_.jobs.run(
      job_name(kind), kind == ExportKind::mesh ? tr("Mesh") : tr("Surface"), made,
      [this, kind, folder, asked = case_](const std::any& result) {
        tell(kind, folder, std::any_cast<const pipeline::ExportSummary&>(result), asked == case_);
      },
      [this, kind](const QString& message) {
        desk_.messages.complain(message, kind == ExportKind::mesh ? tr("The mesh could not be made")
                                                                  : tr("The surface could not be exported"));
      });
}

void MeshingExport::show_mesh(const QString& title, const MeshWork& work,
                              const std::function<void(const QString&)>& failed) {
  desk_.jobs.run(
      "mesh_preview", title,
      [work](const core::TaskContext& task) {
        try {
          return std::any(work(task));
        } catch (const std::bad_alloc&) {
          throw ResourceError(too_little_memory());
        }
      },
      [this](const std::any& made) {
        dock_->show_mesh(std::any_cast<const std::shared_ptr<const MeshPreview>&>(made));
        reveal(scene_);
      },
      failed);
}

void MeshingExport::ask_for_mesh() {
  const QString chosen = ask_open_file(
      &desk_.window, tr("Open a mesh"),
      tr("Volume meshes (*.vtu *.msh *.exo *.e *.ex2 *.inp *.cgns *.xdmf points);;All files (*)"));
  if (!chosen.isEmpty()) open_mesh(chosen.toStdString());
}

void MeshingExport::open_mesh(const fs::path& file) {
  show_mesh(
      tr("Opening the mesh"), [file](const core::TaskContext& task) { return opened_mesh(file, task); },
      [this](const QString& message) {
        desk_.messages.complain(message, tr("The mesh could not be opened"));
      });
}

QString MeshingExport::mesh_line(const QString& name, const pipeline::ExportSummary& summary) {
  QStringList parts{tr("%1: %2 cells, least dihedral angle %3\u00b0")
                        .arg(name)
                        .arg(summary.tetrahedra + summary.prisms)
                        .arg(summary.min_dihedral_deg, 0, 'f', 1)};
  if (summary.full_layers)
    parts << tr("layers of full thickness on %1 % of the wall")
                 .arg(std::floor(1000.0 * *summary.full_layers + 1e-6) / 10.0, 0, 'f', 1);
  parts << (summary.verdict.ok() ? tr("quality passed") : tr("quality not passed"));
  return parts.join(QStringLiteral(", "));
}

void MeshingExport::tell(ExportKind kind, const fs::path& folder, const pipeline::ExportSummary& summary,
                         bool shown) {
  const QString path = QString::fromStdString(folder.string());
  const QString name = QString::fromStdString(folder.filename().string());
  const QString text = kind == ExportKind::mesh ? mesh_line(name, summary)
                                                : tr("%1: %2 triangles").arg(name).arg(summary.triangles);
  QStringList notes{path};
  for (const std::string& warning : summary.warnings) notes << QString::fromStdString(warning);
  desk_.jobs.leave(job_name(kind), text, notes.join('\n'), tr("Open folder"),
                   [this, folder] { open_with_desktop(desk_, folder); });
  if (kind == ExportKind::mesh && shown) {
    show_mesh(
        tr("Preparing the mesh's picture"),
        [folder, verdict = summary.verdict](const core::TaskContext& task) {
          return preview_of(folder, verdict, task);
        },
        [this](const QString& message) { desk_.messages.say(message); });
    // With several trees (left and right artery) the folder stands for the meshes of all.
    emit mesh_made(QString::fromStdString((summary.trees > 1 ? folder : folder / "mesh.vtu").string()));
  }
  if (!summary.verdict.ok())
    desk_.messages.complain(
        tr("The mesh is in %1, but it does not pass the quality control: %2. Look at it before "
           "you compute with it, or mesh again with shorter edges.")
            .arg(path, QString::fromStdString(summary.verdict.summary())),
        tr("A mesh to look at"));
}

}  // namespace ostia::workstation
