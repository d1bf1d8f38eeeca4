#pragma once
/// \file The window: puts the parts together, and says what goes from one to the other.

#include "shell/desk.h"
#include "shell/panel_layout.h"
#include "views/scene_widget.h"

#include <QElapsedTimer>
#include <QMainWindow>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <vector>

class QActionGroup;
class QLabel;

namespace ostia::workstation {

class BeatingCase;
class Calcium;
class CalciumPage;
class CommandTable;
class Comparing;
class ComparisonPage;
class FlowCases;
class FlowResults;
class Lesions;
class MeshingExport;
class Opening;
class Orientation;
class OuterWalls;
class Evaluability;
class Fat;
class FatPage;
class QaDock;
class HeartDock;
class HeartVolume;
class Layouts;
class PlanesDock;
class PressurePage;
class Pressures;
class Reporting;
class Scissors;
struct StepsBeside;
class StudySeries;
class TreeOpening;
class VesselFinder;

class MainWindow final : public QMainWindow {
  Q_OBJECT
 public:
  /// `state_folder`: where this machine's recent cases, image places and window settings are kept.
  explicit MainWindow(const std::filesystem::path& state_folder);
  ~MainWindow() override;

  /// Any of: a case, an image, a DICOM folder or file, a zip of them, a volume mesh. In the background; what
  /// cannot be opened is said in one dialog.
  void open(const std::filesystem::path& path);
  void open_sample();
  /// As if a person closed it, but without a question: work that is not finished is given up, the case is
  /// safe.
  void end();
  void complain(const QString& text, const QString& title = {}) { desk_.messages.complain(text, title); }
  Desk& desk() { return desk_; }
  session::Workbench& bench() { return desk_.bench; }
  session::MachineState& machine() { return desk_.machine; }
  Jobs& jobs() { return desk_.jobs; }
  CommandTable& commands() { return *commands_; }
  SceneWidget& scene() { return panels_->scene(); }
  VesselFinder& finder() { return *finder_; }
  Reporting& reporting() { return *reporting_; }
  FlowCases& flow_cases() { return *flow_cases_; }
  FlowResults& flow_results() { return *flow_results_; }
  BeatingCase& beating() { return *beating_; }
  TreeOpening& trees() { return *trees_; }
  QaDock& qa() { return *qa_; }
  OuterWalls& outer_walls() { return *outer_walls_; }
  Evaluability& evaluability() { return *evaluability_; }
  PlanesDock& planes() { return *planes_; }
  HeartVolume& heart() { return *heart_; }
  StudySeries& series() { return *series_; }
  Layouts& layouts() { return *layouts_; }
  Lesions& lesions() { return *lesions_; }
  Pressures& pressures() { return *pressures_; }
  PressurePage& pressure_page() { return *pressure_page_; }
  Calcium& calcium() { return *calcium_; }
  Fat& fat() { return *fat_; }
  Comparing& comparing() { return *comparing_; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  void build_status_bar();
  void build_parts();
  void build_qa();
  void build_tissues();
  void build_comparison();
  void build_commands();
  StepsBeside steps_beside();
  void connect_parts();
  void watch_case();
  void show_whether_editable();
  void show_title();
  void remember_layout();
  void restore_layout();
  void count_blocks();

  Desk desk_;
  QLabel *place_ = nullptr, *shown_name_ = nullptr, *read_only_ = nullptr;
  std::unique_ptr<Opening> opening_;
  std::unique_ptr<Reporting> reporting_;
  std::unique_ptr<VesselFinder> finder_;
  std::unique_ptr<Orientation> orientation_;
  PanelLayout* panels_ = nullptr;
  PlanesDock* planes_ = nullptr;
  HeartVolume* heart_ = nullptr;
  HeartDock* heart_dock_ = nullptr;
  std::unique_ptr<Scissors> scissors_;
  std::unique_ptr<Layouts> layouts_;
  std::unique_ptr<MeshingExport> meshing_;
  bool must_end_ = false;
  // These go before the views that they draw on.
  std::unique_ptr<OuterWalls> outer_walls_;
  std::unique_ptr<Evaluability> evaluability_;
  std::unique_ptr<Lesions> lesions_;  // asks evaluability_
  std::shared_ptr<QaDock> qa_;        // so does this
  std::unique_ptr<Pressures> pressures_;
  PressurePage* pressure_page_ = nullptr;
  std::unique_ptr<Calcium> calcium_;
  CalciumPage* calcium_page_ = nullptr;
  std::unique_ptr<Fat> fat_;
  FatPage* fat_page_ = nullptr;
  std::unique_ptr<Comparing> comparing_;
  ComparisonPage* comparison_page_ = nullptr;
  std::unique_ptr<FlowResults> flow_results_;
  std::unique_ptr<FlowCases> flow_cases_;
  std::unique_ptr<TreeOpening> trees_;
  BeatingCase* beating_ = nullptr;
  StudySeries* series_ = nullptr;
  CommandTable* commands_ = nullptr;
  QTimer heartbeat_;
  QElapsedTimer beat_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
