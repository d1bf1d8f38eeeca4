#pragma once
/// \file A mesh that was made or opened: in 3D in the colours of its quality, cut open, with its worst
/// elements.

#include "meshing/cut_fields.h"
#include "meshing/preview.h"
#include "views/scene_widget.h"

#include "ostia/session/workbench.h"
#include "ostia/view/mesh_scene.h"

#include <QDockWidget>
#include <memory>
#include <vector>

class QComboBox;
class QFormLayout;
class QLabel;
class QListWidget;

namespace ostia::workstation {

class HistogramWidget;

/// The mesh stands in the tree's place in 3D while the dock is open.
class MeshDock final : public QDockWidget {
  Q_OBJECT
 public:
  MeshDock(session::Workbench& bench, SceneWidget& scene, QWidget* parent);
  ~MeshDock() override;
  void show_mesh(std::shared_ptr<const MeshPreview> preview);
  void clear();  ///< and closes
  /// What is cut away now; nothing where the mesh is whole.
  std::optional<view::MeshCut> cut() const { return cut_->cut(); }

 private:
  QWidget* rows(session::Workbench& bench);
  void show_gate();
  void add_colors(QFormLayout* form);
  void add_edges(QFormLayout* form);
  void show_in_scene(bool shown);
  void show_measure();
  void fly_to(int row);
  meshing::ElementMeasure measure() const;
  view::ShownEdges edges() const;
  SceneWidget& scene_;
  std::shared_ptr<const MeshPreview> preview_;
  std::shared_ptr<view::MeshScene> guest_;  // while it is shown
  std::vector<std::size_t> worst_;
  geometry::Box3 box_;
  QLabel *name_ = nullptr, *gate_ = nullptr, *figures_ = nullptr;
  QComboBox* measure_ = nullptr;
  QComboBox* edges_ = nullptr;
  CutFields* cut_ = nullptr;
  HistogramWidget* histogram_ = nullptr;
  QListWidget* list_ = nullptr;
  bool was_hidden_ = true;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
