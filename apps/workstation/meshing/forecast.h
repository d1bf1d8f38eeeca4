#pragma once
/// \file Will it mesh?: looked for in the background, shown in 3D.

#include "meshing/dialog.h"

#include "ostia/pipeline/vessel_forecast.h"
#include "ostia/view/forecast_scene.h"

#include <QObject>
#include <memory>
#include <string>

namespace ostia::workstation {

class MainWindow;

/// Between a mesh's dialog and the window: a child of the dialog, and gone with it, as is what it shows.
class MeshingForecast final : public QObject {
  Q_OBJECT
 public:
  MeshingForecast(MainWindow& window, MeshingDialog& dialog);
  ~MeshingForecast() override;

 private:
  void start();
  void give_up();
  void show(const pipeline::VesselForecast& made);
  void fly_to(int place);
  void take_away();
  MainWindow& window_;
  MeshingDialog& dialog_;
  meshing::MeshForecast forecast_;
  std::shared_ptr<view::ForecastScene> guest_;
};

/// What is said where surfaces and meshes do not fit into the memory; from any thread.
std::string too_little_memory();

/// Brings a view to the front where it is on a page behind others; alone where there is no room for it else.
void reveal(QWidget& widget);

}  // namespace ostia::workstation
