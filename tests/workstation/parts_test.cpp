// Parts of the window on a desk of their own, without the window: their commands, what they show, what they
// leave.

#include "commands/table.h"
#include "flow/cases.h"
#include "flow/commands.h"
#include "flow_window.h"
#include "known_motion.h"
#include "meshing/commands.h"
#include "meshing/dock.h"
#include "meshing/export.h"
#include "phases/beating_case.h"
#include "phases/commands.h"
#include "test_desk.h"
#include "views/picture_widget.h"
#include "views/scene_widget.h"

#include "ostia/io/cage_motion_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QToolBar>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::wait_until;

/// A desk with the 3D view in its window, and the tube's case on the table where it is wanted.
struct PartsTest : ::testing::Test {
  testing::Folder folder;
  fs::path case_file = folder / "tube.ostia";
  testing::TestDesk test{folder / "state"};
  CommandTable* table = new CommandTable(test.desk());
  SceneWidget* scene = new SceneWidget(
      test.bench(), [this](const std::function<void()>& act) { test.desk().messages.guarded(act); });
  PartsTest() {
    test.window().setCentralWidget(scene);
    session::CaseFile::create(case_file, testing::tube_model(), {});
  }
  ~PartsTest() override { test.bench().close_case(); }
  void open_case() {
    test.bench().set_session(session::Session::open(case_file));
    test.desk().case_path = case_file;
  }
  bool enabled(const char* id) { return table->action(id).isEnabled(); }
  void trigger(const char* id) { table->action(id).trigger(); }
};

struct FlowParts : PartsTest {
  ProfileWidget* profile = new ProfileWidget(
      test.bench(), [this](const std::function<void()>& act) { test.desk().messages.guarded(act); },
      &test.window());
  FlowResults results{test.desk(), *scene, *profile};
  FlowCases cases{test.desk(), results};
  FlowParts() {
    add_flow_commands(*table, test.desk(), cases, results);
    table->dress();
    test.show();
  }
};

TEST_F(FlowParts, AResultIsShownAndGoesWithItsCase) {
  open_case();
  testing::write_wall(folder / "wall.vtp");
  testing::answer_file_dialog(folder / "wall.vtp");
  trigger("file.flow_results");
  ASSERT_TRUE(wait_until([&] { return results.shown(); }));
  EXPECT_TRUE(test.window().findChild<QWidget*>("flow_bar")->isVisible());
  test.bench().close_case();
  EXPECT_FALSE(results.shown());
}

TEST_F(FlowParts, AFileThatIsNoResultIsSaidOnce) {
  core::write_file(folder / "wall.vtp", "no surface");
  results.open({folder / "wall.vtp"});
  EXPECT_FALSE(testing::message().empty());
  EXPECT_FALSE(results.shown());
}

TEST_F(FlowParts, TheDialogProposesTheMeshThatWasMadeAndGoesWithItsCase) {
  open_case();
  core::write_file(folder / "mesh.vtu", "of this case");
  cases.mesh_made(folder / "mesh.vtu");
  trigger("file.flow_case");
  auto* dialog = test.window().findChild<FlowDialog*>();
  ASSERT_TRUE(dialog);
  EXPECT_TRUE(dialog->isVisible());
  EXPECT_EQ(dialog->choice().mesh, folder / "mesh.vtu");
  test.bench().close_case();
  EXPECT_FALSE(dialog->isVisible());
}

struct MeshingParts : PartsTest {
  MeshingExport meshing{test.desk(), *scene};
  MeshingParts() {
    add_meshing_commands(*table, test.desk(), meshing);
    table->dress();
    test.window().addDockWidget(Qt::RightDockWidgetArea, &meshing.dock());
    meshing.dock().hide();
    test.show();
  }
};

TEST_F(MeshingParts, ExportsNeedACase) {
  EXPECT_FALSE(enabled("file.export_surface"));
  EXPECT_FALSE(enabled("file.export_mesh"));
  EXPECT_TRUE(enabled("file.open_mesh"));
  open_case();
  EXPECT_TRUE(enabled("file.export_surface"));
  EXPECT_TRUE(enabled("file.export_mesh"));
}

TEST_F(MeshingParts, ASurfaceIsMadeBesideTheCase) {
  open_case();
  trigger("file.export_surface");
  auto* dialog = test.window().findChild<MeshingDialog*>();
  ASSERT_TRUE(dialog);
  const fs::path made = dialog->choice().folder;
  EXPECT_EQ(made.parent_path(), case_file.parent_path());
  dialog->accept();
  ASSERT_TRUE(test.idle());
  EXPECT_TRUE(fs::exists(made / "manifest.json"));
}

TEST_F(MeshingParts, TheDialogGoesWithItsCase) {
  open_case();
  trigger("file.export_mesh");
  const auto* dialog = test.window().findChild<MeshingDialog*>();
  ASSERT_TRUE(dialog);
  EXPECT_TRUE(dialog->isVisible());
  test.bench().close_case();
  EXPECT_FALSE(dialog->isVisible());
}

TEST_F(MeshingParts, TheCommandOfThePanelIsItsMark) {
  EXPECT_FALSE(table->action("view.mesh").isChecked());
  trigger("view.mesh");
  EXPECT_TRUE(meshing.dock().isVisible());
  EXPECT_TRUE(table->action("view.mesh").isChecked());
  meshing.dock().close();
  EXPECT_FALSE(table->action("view.mesh").isChecked());
}

struct PhaseParts : PartsTest {
  BeatingCase* beating = new BeatingCase(test.desk(), test.window());
  fs::path motion_file = folder / "motion.json";
  PhaseParts() {
    add_phase_commands(*table, test.desk(), *beating);
    table->dress();
    io::write_cage_motion(motion_file,
                          {session::testing::known_motion({-9.0, -9.0, -4.0}, {9.0, 9.0, 44.0}), ""});
    test.show();
  }
};

TEST_F(PhaseParts, PlayingNeedsAMotion) {
  EXPECT_FALSE(enabled("file.motion"));
  open_case();
  EXPECT_TRUE(enabled("file.motion"));
  EXPECT_FALSE(enabled("view.play"));
  EXPECT_EQ(CommandTable::why_not(*table->find("view.play")), "No motion is open.");
  testing::answer_file_dialog(motion_file);
  trigger("file.motion");
  ASSERT_TRUE(wait_until([&] { return beating->shown(); }));
  EXPECT_TRUE(enabled("view.play"));
  EXPECT_TRUE(test.window().findChild<QToolBar*>("phase_room")->isVisible());
  beating->clock().percent.set(40.0);
  EXPECT_TRUE(test.bench().other_phase());
  trigger("view.own_phase");
  EXPECT_FALSE(test.bench().other_phase());
  test.bench().close_case();
  EXPECT_FALSE(enabled("view.play"));
}

TEST_F(PhaseParts, AFileThatIsNoMotionIsSaidOnce) {
  open_case();
  core::write_file(motion_file, "{}");
  beating->open(motion_file);
  EXPECT_FALSE(testing::message().empty());
  EXPECT_FALSE(beating->shown());
}

}  // namespace
}  // namespace ostia::workstation
