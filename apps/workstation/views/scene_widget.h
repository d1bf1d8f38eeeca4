#pragma once
/// \file The tree in three dimensions, in a native window of its own.

#include "views/picture_widget.h"
#include "views/scene_grip.h"

#include "ostia/session/workbench.h"
#include "ostia/view/scene_pointer.h"
#include "ostia/view/tree_scene.h"

#include <QColor>
#include <QElapsedTimer>
#include <QPointF>
#include <QTimer>
#include <QWidget>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

class QVTKOpenGLWindow;

namespace ostia::workstation {

class SceneWidget final : public QWidget {
  Q_OBJECT
 public:
  /// Cells of the wall that is shown: about a pixel of the whole tree, half the triangles of the default's.
  static constexpr double screen_cell_mm = 0.35;
  SceneWidget(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);
  ~SceneWidget() override;
  view::TreeScene& scene() { return *scene_; }
  view::ScenePointer& pointer() { return *pointer_; }
  /// Of a vessel in the tree; where none has been drawn yet, the one that it will have.
  QColor color_of(std::int32_t vessel) const;
  /// Moves smoothly to another pose.
  void go_to(const view::CameraPose& pose);
  void set_volume_mode(view::VolumeMode mode);
  view::VolumeMode volume_mode() const { return volume_mode_; }
  void set_dark(bool dark);
  /// Writes at the lower left whose image it is, while the person wants it there; outlived by it. No picture
  /// that is saved has it.
  void show_identity(Identity& identity);
  /// Called with each new wall, to colour it.
  void set_wall_painter(std::function<void(const geometry::TriMesh&)> painter);
  /// The same, after that one: what it colours is seen.
  void set_top_painter(std::function<void(const geometry::TriMesh&)> painter);
  void repaint_wall();  ///< the painter would colour it otherwise
  /// In the wall's place, all of it in the picture; null: the wall again.
  void show_guest(std::shared_ptr<view::SceneGuest> guest);
  /// A wall of another time over this one (TreeScene::set_other_wall); null: none.
  void show_other_wall(std::shared_ptr<const geometry::TriMesh> wall);
  /// What a press of the left button may take hold of; null: nothing. It has to outlive the events.
  void set_grip(SceneGrip* grip);
  SceneGrip* grip() const { return grip_; }
  /// As it is shown, `scale` times as many pixels along each side with texts and lines as much larger. Throws
  /// as TreeScene::snapshot and figure::Picture::write_png do.
  void save_picture(const std::filesystem::path& png, double scale);
  QSize picture_size() const;  ///< of the picture on the screen, device pixels
  /// Controls below the picture.
  void add_below(QWidget* controls);
  QSize minimumSizeHint() const override;

 signals:
  void styles_changed();  ///< vessels have colours now, or others
  void volume_wanted();   ///< the CT is to be shown and has not been reduced yet
  void volume_mode_changed(view::VolumeMode mode);
  void guest_changed(const view::SceneGuest* guest);  ///< null: the wall is shown
  void pointed(const geometry::Vec2& display);        ///< the mouse is there, no button held
  void left();                                        ///< by the mouse

 public slots:
  void request_render();  ///< soon, once for many requests

 protected:
  bool eventFilter(QObject* object, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void refresh();
  void make_wall();
  void take_wall();
  void paint_wall();
  void refresh_phase();
  void refresh_styles();
  void refresh_cursor();
  void refresh_section();
  void refresh_measurements();
  void refresh_identity();
  bool key_pressed(int key);
  void mouse_pressed(const QMouseEvent& event);
  void mouse_moved(const QMouseEvent& event);
  void mouse_released(const QMouseEvent& event);
  void let_go();
  void turn_camera(const QMouseEvent& event);
  void hand(const std::function<void()>& act);
  geometry::Vec2 display(const QPointF& at) const;
  view::PointerEvent pointer_event(const QPointF& at, Qt::MouseButton button,
                                   Qt::KeyboardModifiers keys) const;
  session::Workbench& bench_;
  QVTKOpenGLWindow* window_;
  QWidget* container_;
  std::unique_ptr<view::TreeScene> scene_;
  std::unique_ptr<view::ScenePointer> pointer_;
  Guard guard_;
  QTimer flight_, refining_;
  view::CameraPose from_, to_;
  QElapsedTimer flight_clock_;
  bool wall_stale_ = true, styles_stale_ = true, cursor_stale_ = true, marks_stale_ = true,
       fit_wanted_ = true, phase_stale_ = false;
  view::VolumeMode volume_mode_ = view::VolumeMode::off;
  bool wall_unseen_ = false;                                   // it was made and not drawn yet
  std::shared_ptr<const geometry::TriMesh> wall_, made_wall_;  // in the scene; made for it since
  std::shared_ptr<const lumen::LumenModel> made_of_;
  std::function<void(const geometry::TriMesh&)> wall_painter_, top_painter_;
  QPointF pressed_, last_;
  Qt::MouseButtons buttons_;
  HeldButton button_;
  bool moved_ = false, holding_ = false;  // the camera; a handle
  const Identity* identity_ = nullptr;
  session::Subscription identity_changed_;
  bool dark_ = true;
  SceneGrip* grip_ = nullptr;
  bool gripped_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
