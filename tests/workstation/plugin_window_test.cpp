// Plug-ins in the window: a script becomes a command, is asked about once, edits as one step, fails in words,
// is cancelled; a field stands in the wall's place, and a mask becomes a case.

#include "commands/palette.h"
#include "commands/table.h"
#include "flow/results.h"
#include "layout_faults.h"
#include "real_program.h"
#include "shell/language.h"
#include "shell/step_list.h"
#include "tube_window.h"

#include <gmock/gmock.h>

#include <QCheckBox>
#include <QDialog>
#include <QMenu>
#include <QMenuBar>
#include <QStandardPaths>
#include <fstream>

namespace ostia::workstation {
namespace {

using ::testing::HasSubstr;
using testing::message;
using testing::wait_until;
using testing::xdo;

constexpr int run_ms = 90000;

struct PluginWindow : testing::TubeWindow {
  const testing::fs::path scripts = folder / "plugins";
  PluginWindow() {
    testing::fs::create_directories(scripts);
    ::setenv("OSTIA_PLUGINS", scripts.c_str(), 1);
    ::setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);
  }
  ~PluginWindow() override {
    ::unsetenv("OSTIA_PLUGINS");
    ::unsetenv("XDG_CONFIG_HOME");
  }
  void add_example(const std::string& name) {
    testing::fs::copy_file(testing::fs::path(OSTIA_EXAMPLES) / name, scripts / name);
  }
  void write(const std::string& name, const std::string& body) {
    std::ofstream(scripts / (name + ".py")) << "from ostia import plugin\nimport time\n" << body;
  }
  /// The window with the case open, and its plug-ins read.
  void begin(const char* wanted) {
    open_case();
    window().move(0, 0);
    window().activateWindow();
    ASSERT_TRUE(wait_until([&] { return command(wanted) != nullptr; }, run_ms));
    settle();
  }
  QAction* command(const char* name) {
    const Command* found = window().commands().find(QStringLiteral("plugin.") + name);
    return found ? found->action : nullptr;
  }
  QDialog* dialog() {
    for (auto* found : window().findChildren<QDialog*>("plugin_dialog"))
      if (found->isVisible()) return found;
    return nullptr;
  }
  QDialog* asked() {
    EXPECT_TRUE(wait_until([&] { return dialog() != nullptr; }));
    settle();
    return dialog();
  }
  void go_on() {
    auto* go = asked()->findChild<QPushButton*>("go");
    ASSERT_TRUE(go->isEnabled());
    QTest::mouseClick(go, Qt::LeftButton);
  }
  std::size_t steps() { return test->bench().session().file().journal().size(); }
  double area(double s_mm) { return test->bench().section(4, s_mm)->area_mm2; }
  QStringList menu_texts() {
    QStringList texts;
    for (const QAction* one : menu()->actions())
      if (!one->isSeparator() && one->isVisible()) texts << one->text();
    return texts;
  }
  QMenu* tools() {
    for (QAction* one : window().menuBar()->actions())
      if (one->menu()->actions().contains(part<QAction>("tool.brush"))) return one->menu();
    return nullptr;
  }
  QMenu* menu() {
    for (QAction* one : tools()->actions())
      if (one->menu() && one->menu()->actions().contains(part<QAction>("plugins.look"))) return one->menu();
    return nullptr;
  }
};

TEST_F(PluginWindow, TheMouseChoosesItTypesANumberAndTheWallIsWiderByOneStep) {
  add_example("widen_wall.py");
  begin("widen_wall");
  EXPECT_EQ(menu_texts(),
            QStringList({"Widen the wall", "&Look for plug-ins again", "&Open the folder of plug-ins"}));
  const auto lines = palette_lines(window().commands(), "widen");
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.front().command->id, "plugin.widen_wall");
  const double before = area(20.0);
  QMenuBar& bar = *window().menuBar();
  const bool real = !QStandardPaths::findExecutable("xdotool").isEmpty();
  const auto click = [&](QWidget& on, const QPoint& at) {
    if (!real) return QTest::mouseClick(&on, Qt::LeftButton, Qt::NoModifier, at);
    testing::go(on.mapToGlobal(at));
    QTest::qWait(60);
    xdo({"click", "1"});
  };
  click(bar, bar.actionGeometry(tools()->menuAction()).center());
  ASSERT_TRUE(wait_until([&] { return tools()->isVisible(); }));
  click(*tools(), tools()->actionGeometry(menu()->menuAction()).center());
  ASSERT_TRUE(wait_until([&] { return menu()->isVisible(); }));
  testing::on_screen(window(), "plugin-menu");
  click(*menu(), menu()->actionGeometry(command("widen_wall")).center());
  QDialog* box = asked();
  ASSERT_TRUE(box);
  EXPECT_EQ(box->windowTitle(), "Widen the wall");
  EXPECT_THAT(part<QLabel>("plugin_question", box)->text().toStdString(),
              HasSubstr("widen_wall.py is new here"));
  EXPECT_EQ(part<QComboBox>("plugin.vessel", box)->currentText(), "LAD");
  EXPECT_FALSE(part<QCheckBox>("plugin.narrow_alone", box)->isChecked());
  auto* by = part<QLineEdit>("plugin.by_mm", box);
  EXPECT_EQ(by->text(), "0.2");
  testing::type(by, "much");
  EXPECT_FALSE(part<QPushButton>("go", box)->isEnabled());
  EXPECT_EQ(part<QLabel>("plugin.by_mm_trouble", box)->text(), "A number.");
  testing::type(by, "0.3");
  EXPECT_TRUE(testing::layout_faults(*box).isEmpty());
  testing::on_screen(*box, "plugin-dialog");
  auto* go = part<QPushButton>("go", box);
  EXPECT_EQ(go->text(), "Trust it and run");
  click(*go, go->rect().center());
  ASSERT_TRUE(wait_until([&] { return steps() == 2; }, run_ms));
  settle();
  EXPECT_NEAR(area(20.0) / before, 1.44, 0.05) << "1.5 mm and 0.3 mm";
  auto* list = part<StepList>("steps");
  EXPECT_EQ(list->item(list->count() - 1)->text(), "Plug-in: Widen the wall 1.0");
  testing::on_screen(window(), "plugin-edited");
  part<QAction>("edit.undo")->trigger();
  EXPECT_TRUE(test->bench().session().file().edits().empty());
  EXPECT_NEAR(area(20.0), before, 1e-9);
}

TEST_F(PluginWindow, AScriptIsAskedAboutOnceAndAgainWhenItHasChanged) {
  write("name",
        "@plugin.edits('Name')\ndef name(given):\n    return [plugin.edit('vessel.rename', vessel=4, "
        "name='A')]\n");
  begin("name");
  command("name")->trigger();
  go_on();
  ASSERT_TRUE(wait_until([&] { return steps() == 2; }, run_ms));
  EXPECT_EQ(test->bench().vessel_name(4), "A");
  command("name")->trigger();
  ASSERT_TRUE(wait_until([&] { return steps() == 3; }, run_ms)) << "without parameters and trusted: at once";
  write("name",
        "@plugin.edits('Name')\ndef name(given):\n    return [plugin.edit('vessel.rename', vessel=4, "
        "name='B')]\n#\n");
  part<QAction>("plugins.look")->trigger();
  ASSERT_TRUE(wait_until([&] { return idle(); }, run_ms));
  command("name")->trigger();
  EXPECT_TRUE(part<QLabel>("plugin_question", asked()));
  QTest::keyClick(asked(), Qt::Key_Escape);
  settle();
  EXPECT_EQ(steps(), 3U) << "nobody allowed it";
}

TEST_F(PluginWindow, WhatFailsIsSaidWithFileAndLineAndNothingIsHalfDone) {
  write("wrong", "@plugin.edits('Wrong')\ndef wrong(given):\n    raise ValueError('no such place')\n");
  write("half",
        "@plugin.edits('Half')\ndef half(given):\n"
        "    return [plugin.edit('vessel.rename', vessel=v, name='A') for v in (4, 99)]\n");
  begin("wrong");
  command("wrong")->trigger();
  go_on();
  EXPECT_THAT(message(), HasSubstr("wrong.py, line 5: ValueError: no such place"));
  ASSERT_TRUE(wait_until([&] { return idle(); }));
  command("half")->trigger();
  go_on();
  EXPECT_THAT(message(), HasSubstr("edit 2 of 2 (vessel.rename) is refused, and none was made"));
  EXPECT_EQ(steps(), 1U);
  EXPECT_EQ(test->bench().vessel_name(4), "LAD");
}

TEST_F(PluginWindow, TheCrossEndsItAndAnEditMeanwhileKeepsItsResultAway) {
  const testing::fs::path there = scripts / "there";
  write("slow", "@plugin.edits('Slow')\ndef slow(given):\n    given.progress(0.4, 'sleeping')\n    open(r'" +
                    there.string() + "', 'w').close()\n    time.sleep(300)\n");
  const testing::fs::path begun = scripts / "begun", may_end = scripts / "may_end";
  write("late", "import os\n@plugin.edits('Late')\ndef late(given):\n    open(r'" + begun.string() +
                    "', 'w').close()\n    while not os.path.exists(r'" + may_end.string() +
                    "'):\n        time.sleep(0.02)\n"
                    "    return [plugin.edit('vessel.rename', vessel=4, name='A')]\n");
  begin("slow");
  command("slow")->trigger();
  go_on();
  ASSERT_TRUE(wait_until([&] { return testing::fs::exists(there); }, run_ms));
  auto* cross = part<QToolButton>("cancel.plugin.slow");
  ASSERT_TRUE(wait_until([&] { return cross->isVisible(); }));
  testing::on_screen(window(), "plugin-running");
  QTest::mouseClick(cross, Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return idle(); }));
  EXPECT_EQ(steps(), 1U);
  EXPECT_TRUE(testing::open_boxes().empty()) << "a cancelled job ends without a word";
  command("late")->trigger();
  go_on();
  ASSERT_TRUE(wait_until([&] { return testing::fs::exists(begun); }, run_ms));
  test->bench().edit(lumen::VesselRename{4, "meanwhile"});
  std::ofstream(may_end) << "";
  EXPECT_THAT(message(), HasSubstr("The case was edited while Late was at work"));
  EXPECT_EQ(test->bench().vessel_name(4), "meanwhile");
}

TEST_F(PluginWindow, AFieldStandsInTheWallsPlace) {
  write(
      "height",
      "@plugin.field('Height')\ndef height(given):\n    return {'height_mm': given.surface.points[:, 2]}\n");
  begin("height");
  command("height")->trigger();
  go_on();
  ASSERT_TRUE(wait_until([&] { return window().flow_results().shown(); }, run_ms));
  settle();
  testing::on_screen(window(), "plugin-field");
  EXPECT_EQ(steps(), 1U) << "the case is as it was";
}

TEST_F(PluginWindow, AMaskBecomesACaseOfItsTree) {
  add_example("grow_mask.py");
  begin("grow_mask");
  ASSERT_TRUE(wait_until([&] { return command("grow_mask")->isEnabled(); })) << "once the image is read";
  const testing::fs::path before = window().desk().case_path;
  command("grow_mask")->trigger();
  testing::type(part<QLineEdit>("plugin.lower_hu", asked()), "200");
  go_on();
  ASSERT_TRUE(
      wait_until([&] { return test->bench().has_case() && window().desk().case_path != before; }, run_ms));
  settle();
  const lumen::LumenModel& model = *test->bench().model();
  ASSERT_EQ(model.tree.vessels.size(), 1U);
  const auto axis = geometry::vessel_axis(model.tree, model.tree.vessels[0]);
  EXPECT_GT(axis.abscissa.back(), 35.0);
  for (const geometry::Vec3& point : axis.points) EXPECT_LT(std::hypot(point.x(), point.y()), 0.5);
  testing::on_screen(window(), "plugin-mask");
}

TEST_F(PluginWindow, ScriptsThatAreNoneAreSaidAndNewOnesComeWhenTheMenuIsOpened) {
  write("broken", "@plugin.edits('Broken')\ndef broken(given, x=1):\n    return []\n");
  write("good", "@plugin.edits('Good')\ndef good(given):\n    return []\n");
  begin("good");
  part<QAction>("plugins.look")->trigger();
  EXPECT_THAT(message(), HasSubstr("broken.py, line 4: the parameter x needs a type"));
  testing::fs::remove(scripts / "good.py");
  write("other", "@plugin.edits('Other & more')\ndef other(given):\n    return []\n");
  menu()->popup(window().mapToGlobal({200, 200}));
  ASSERT_TRUE(wait_until([&] { return command("other") != nullptr; }, run_ms));
  menu()->close();
  EXPECT_EQ(command("good"), nullptr);
  EXPECT_EQ(menu_texts().first(), "Other && more");
}

}  // namespace
}  // namespace ostia::workstation
