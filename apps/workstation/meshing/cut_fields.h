#pragma once
/// \file How a mesh is cut open: the rows of its dock, and the plane that is dragged in 3D.

#include "views/scene_grip.h"
#include "views/scene_widget.h"

#include "ostia/session/workbench.h"
#include "ostia/view/mesh_scene.h"

#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QSlider;

namespace ostia::workstation {

/// The slider has the plane's place; a drag of its frame or arrow in the picture moves the slider.
class CutFields final : public QObject, private SceneGrip {
  Q_OBJECT
 public:
  CutFields(QFormLayout* form, session::Workbench& bench, SceneWidget& scene, QObject* parent);
  /// The scene whose mesh, in this box, is cut; null: none is shown.
  void set_guest(std::shared_ptr<view::MeshScene> guest, const geometry::Box3& box);
  void leave_whole();  ///< as it is for a new mesh
  /// What is cut away now; nothing where the mesh is whole.
  std::optional<view::MeshCut> cut() const;

 private:
  enum class CutBy { none, vessel, left_right, front_back, head_feet, view };
  CutBy by() const;
  void choose_direction();
  void show();
  geometry::Vec3 frame_sizes() const;
  double way_mm() const;  // of the plane, from one end of the slider to the other
  bool under(const geometry::Vec2& display) const override;
  void take(const geometry::Vec2& display) override;
  void drag(const geometry::Vec2& display) override;
  void put_back() override;
  /// The plane and what it was when it was taken hold of.
  struct Taken {
    geometry::Vec2 at = geometry::Vec2::Zero();
    view::MeshCut cut;
    int place = 0;
  };
  session::Workbench& bench_;
  SceneWidget& scene_;
  std::shared_ptr<view::MeshScene> guest_;
  geometry::Box3 box_;
  geometry::Vec3 towards_ = geometry::Vec3::UnitZ();  // the viewer, as it was when that was chosen
  std::vector<std::vector<geometry::Vec3>> handle_;   // as it is shown
  std::optional<Taken> taken_;
  QComboBox* cut_ = nullptr;
  QSlider* place_ = nullptr;
  QCheckBox* turned_ = nullptr;
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
