#pragma once
/// \file Will it mesh?: looked for in the background, shown in 3D.

#include "meshing/dialog.h"

#include "ostia/pipeline/vessel_forecast.h"
#include "ostia/view/forecast_scene.h"

#include <QObject>
#include <memory>
#include <string>

namespace ostia::workstation {

struct Desk;
class SceneWidget;

/// Between a mesh's dialog and the window: a child of the dialog, and gone with it, as is what it shows.
class MeshingForecast final : public QObject {
  Q_OBJECT
 public:
  MeshingForecast(Desk& desk, SceneWidget& scene, MeshingDialog& dialog);
  ~MeshingForecast() override;

 private:
  void start();
  void give_up();
  void show(const pipeline::VesselForecast& made);
  void fly_to(int place);
  void take_away();
  Desk& desk_;
  SceneWidget& scene_;
  MeshingDialog& dialog_;
  meshing::MeshForecast forecast_;
  std::shared_ptr<view::ForecastScene> guest_;
};

/// What is said where surfaces and meshes do not fit into the memory; from any thread.
std::string too_little_memory();

}  // namespace ostia::workstation
