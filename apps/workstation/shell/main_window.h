#pragma once
/// \file The window: panels, menus, and what goes from one to the other.

#include "shell/jobs.h"
#include "shell/panel.h"
#include "shell/theme.h"
#include "views/picture_widget.h"
#include "views/scene_widget.h"

#include "ostia/session/machine_state.h"
#include "ostia/session/workbench.h"

#include <QMainWindow>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

class QLabel;
class QSplitter;

namespace ostia::workstation {

class Opening;
class Reporting;
class MeshingExport;
class FlowCases;
class FlowResults;
class BeatingCase;
class QaPanel;
class Hanging;
class VesselFinder;
class OuterWalls;
class TreeOpening;

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
  const std::filesystem::path& case_path() const;  ///< of the case that is open; empty where none is
  session::Workbench& bench() { return bench_; }
  session::MachineState& machine() { return machine_; }
  Jobs& jobs() { return *jobs_; }
  VesselFinder& finder() { return *finder_; }
  FlowCases& flow_cases() { return *flow_cases_; }
  FlowResults& flow_results() { return *flow_results_; }
  BeatingCase& beating() { return *beating_; }
  TreeOpening& trees() { return *trees_; }
  /// Runs it; what is refused comes up in the status line (or, `loud`, as a dialog) and ends there.
  bool guarded(const std::function<void()>& act, bool loud = false);
  void say(const QString& text);                                  ///< in the status line
  void complain(const QString& text, const QString& title = {});  ///< one dialog
  void set_shown_name(const QString& text);                       ///< patient and series, in the window alone
  /// As if a person closed it, but without a question: work that is not finished is given up, the case is
  /// safe.
  void end();
  SceneWidget& scene() { return *scene_; }
  Reporting& reporting() { return *reporting_; }
  QaPanel& qa() { return *qa_; }
  OuterWalls& outer_walls() { return *outer_walls_; }
  const std::filesystem::path& state_folder() const { return state_folder_; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  // layout (main_window.cpp)
  void build_views();
  Panel* picture_panel(const QString& title, const QString& name, std::unique_ptr<view::PictureView> view);
  QWidget* curved_column();
  QWidget* section_column();
  Panel* right_column();
  QWidget* side_column();
  void remember_layout();
  void restore_layout();
  void maximise(Panel* panel);
  // menus (main_window_actions.cpp)
  void build_actions();
  void build_tool_bar();
  QAction* build_qa();                 // main_window_qa.cpp
  void build_tree_menu(QMenu* tools);  // main_window_trees.cpp
  QAction* action(const QString& id, const QString& text, const std::function<void()>& run);
  void refresh_actions();
  void join_with_parent();
  void fill_recent(QMenu* menu);
  void pin_view();
  void turn(double degrees);
  void walk(double mm);
  void next_vessel(int by);
  void set_theme(Theme theme);

  std::filesystem::path state_folder_;
  session::Workbench bench_;
  session::MachineState machine_;
  Guard guard_;
  Jobs* jobs_ = nullptr;
  std::unique_ptr<Opening> opening_;
  std::unique_ptr<Reporting> reporting_;
  std::unique_ptr<VesselFinder> finder_;
  std::unique_ptr<MeshingExport> meshing_export_;
  SceneWidget* scene_ = nullptr;
  ProfileWidget* profile_ = nullptr;
  std::vector<PictureWidget*> pictures_;
  std::vector<QSplitter*> splitters_;
  Hanging* hanging_ = nullptr;
  Panel* alone_ = nullptr;
  bool must_end_ = false;
  std::unique_ptr<OuterWalls> outer_walls_;  // goes before the views that it draws on
  std::shared_ptr<QaPanel> qa_;              // so does this
  std::unique_ptr<FlowResults> flow_results_;
  std::unique_ptr<FlowCases> flow_cases_;
  std::unique_ptr<TreeOpening> trees_;
  BeatingCase* beating_ = nullptr;
  QLabel* place_ = nullptr;
  QLabel* shown_name_ = nullptr;
  std::map<QString, QAction*> actions_;
  QTimer heartbeat_;
  QElapsedTimer beat_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
