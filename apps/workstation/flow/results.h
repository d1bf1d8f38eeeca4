#pragma once
/// \file Results of a flow computation on the wall, in the 3D view.

#include "flow/arrays.h"

#include "ostia/session/workbench.h"

#include <QObject>
#include <filesystem>
#include <memory>
#include <vector>

namespace ostia::workstation {

class FlowBar;
struct Desk;
class ProfileWidget;
class SceneWidget;

/// Reads a surface with values in the background and shows it in the wall's place, coloured by one of its
/// arrays, with a bar of controls below the picture. It goes with the case, and when something else is shown
/// there. Where it has shear stress or pressure, the profile shows both along the selected vessel.
class FlowResults final : public QObject {
  Q_OBJECT
 public:
  FlowResults(Desk& desk, SceneWidget& view, ProfileWidget& profile);
  void ask();  ///< for the file
  /// Of each tree one: left and right artery are shown together.
  void open(const std::vector<std::filesystem::path>& files);
  void show(FlowSurface result);
  void hide();
  bool shown() const { return scene_ != nullptr; }

 signals:
  void pointed(const QString& value);  ///< under the mouse; empty beside the surface

 private:
  void show_array();
  void color();
  void tell(const geometry::Vec2& display);
  void save_picture();
  void follow_vessels();
  void show_along();
  Desk& desk_;
  SceneWidget& view_;
  ProfileWidget& profile_;
  FlowBar* bar_;
  FlowSurface result_;
  std::shared_ptr<view::SurfaceFieldScene> scene_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
