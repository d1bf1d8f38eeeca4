#pragma once
/// \file Surfaces and meshes of the case, made beside the editing; meshes made earlier.

#include "meshing/dialog.h"

#include "ostia/session/workbench.h"

#include <QObject>
#include <QPointer>
#include <functional>
#include <map>
#include <vector>

namespace ostia::workstation {

struct Desk;
class MeshDock;
struct MeshPreview;
class SceneWidget;

/// Asks by a MeshingDialog, makes it from a snapshot in the background, and leaves a line that says what was
/// made and where. A folder appears whole or not at all. Of a case that is no longer open there is that line
/// alone.
class MeshingExport final : public QObject {
  Q_OBJECT
 public:
  MeshingExport(Desk& desk, SceneWidget& scene);
  /// The proposed folder is beside `case_file`.
  void ask(ExportKind kind, const std::filesystem::path& case_file);
  /// Asks for a mesh made earlier, here or elsewhere, and shows it as one that was made.
  void ask_for_mesh();
  void open_mesh(const std::filesystem::path& file);
  /// The dock with the mesh that was made or opened last, hidden at first; for the window to take in.
  MeshDock& dock() { return *dock_; }

 signals:
  void mesh_made(const QString& file);  ///< of the case that is open

 private:
  using MeshWork = std::function<std::shared_ptr<const MeshPreview>(const core::TaskContext&)>;
  void start(ExportKind kind, const MeshingDialog& dialog,
             const std::shared_ptr<const lumen::LumenModel>& model);
  static QString mesh_line(const QString& name, const pipeline::ExportSummary& summary);
  void show_mesh(const QString& title, const MeshWork& work,
                 const std::function<void(const QString&)>& failed);
  void tell(ExportKind kind, const std::filesystem::path& folder, const pipeline::ExportSummary& summary,
            bool shown);
  Desk& desk_;
  SceneWidget& scene_;
  int case_ = 0;  // another number with each case that is opened
  std::map<ExportKind, ExportChoice> last_;
  QPointer<MeshingDialog> dialog_;  // that is open
  MeshDock* dock_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
