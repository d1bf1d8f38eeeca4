#pragma once
/// \file The mesh that was made: in 3D in the colours of its quality, cut open, with its worst elements.

#include "mesh_preview.h"
#include "scene_widget.h"

#include "ostia/session/workbench.h"
#include "ostia/view/mesh_scene.h"

#include <QDockWidget>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QListWidget;
class QSlider;

namespace ostia::workstation {

class HistogramWidget;

/// The mesh stands in the tree's place in 3D while the dock is open.
class MeshPanel final : public QDockWidget {
  Q_OBJECT
 public:
  MeshPanel(session::Workbench& bench, SceneWidget& scene, QWidget* parent);
  ~MeshPanel() override;
  void show_mesh(std::shared_ptr<const MeshPreview> preview);
  void clear();  ///< and closes
  /// What is cut away now; nothing where the mesh is whole.
  std::optional<view::MeshCut> cut() const;

 private:
  enum class CutBy { none, vessel, left_right, front_back, head_feet, view };
  QWidget* rows();
  void add_colors(QFormLayout* form);
  void add_cut(QFormLayout* form);
  void show_in_scene(bool shown);
  void show_measure();
  void show_cut();
  void fly_to(int row);
  meshing::ElementMeasure measure() const;
  session::Workbench& bench_;
  SceneWidget& scene_;
  std::shared_ptr<const MeshPreview> preview_;
  std::shared_ptr<view::MeshScene> guest_;  // while it is shown
  std::vector<std::size_t> worst_;
  geometry::Box3 box_;
  QLabel *name_ = nullptr, *figures_ = nullptr;
  QComboBox *measure_ = nullptr, *cut_ = nullptr;
  QCheckBox *edges_ = nullptr, *turned_ = nullptr;
  HistogramWidget* histogram_ = nullptr;
  QSlider* place_ = nullptr;
  QListWidget* list_ = nullptr;
  QTimer cut_soon_;
  bool was_hidden_ = true;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
