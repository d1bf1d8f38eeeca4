// A file of a vessel tree in the window: opened, clicked, measured, repaired, closed, by mouse and keys.

#include "shell/language.h"
#include "trees/opening.h"
#include "window_hand.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QStatusBar>
#include <QTableWidget>
#include <QToolButton>
#include <QtTest>
#include <cstdlib>
#include <numbers>

namespace ostia::workstation {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;
using testing::wait_until;

/// A trunk of 10 mm up z, then 6 mm along x and 8 mm on along z.
constexpr const char* tree_csv =
    "x1,y1,z1,radius1,x2,y2,z2,radius2\n"
    "0,0,0,1,0,0,10,1\n0,0,10,0.8,6,0,10,0.8\n0,0,10,0.8,0,0,18,0.8\n";
constexpr const char* loop_csv =
    "x1,y1,z1,radius1,x2,y2,z2,radius2\n"
    "0,0,0,1,0,0,10,0\n0,0,10,0.8,6,0,10,0.8\n0,0,0,0.8,6,0,10,0.8\n";

struct TreePageTest : ::testing::Test {
  testing::Folder folder;
  const QString language = use_language(std::string("en"));
  testing::TestWindow test{folder / "state"};

  TreePage* page() { return test.window().trees().page(); }
  void open(const char* content) {
    core::write_file(folder / "tree.csv", content);
    test.window().open(folder / "tree.csv");
  }
  void open_tree() {
    open(tree_csv);
    ASSERT_TRUE(wait_until([&] { return page() != nullptr; }));
    ASSERT_TRUE(wait_until([&] { return page()->view().isValid() && page()->width() > 500; }));
    QApplication::setActiveWindow(&test.window());  // keys reach commands of the active window alone
    testing::let_rest();
  }
  void click(const Vec3& point) {
    const auto at = page()->view().place_of(point);
    ASSERT_TRUE(at);
    QTest::mouseClick(&page()->view(), Qt::LeftButton, Qt::NoModifier, at->toPoint());
  }
  /// The panel's button.
  void press(const char* command) {
    QTest::mouseClick(page()->findChild<QWidget*>(QStringLiteral("button.") + command), Qt::LeftButton);
  }
  void keys(int key) {
    QTest::keyClick(&page()->view(), static_cast<Qt::Key>(key), Qt::ControlModifier | Qt::AltModifier);
  }
  /// Whether the tree is drawn there.
  bool red_at(const Vec3& point) {
    const QImage picture = page()->view().grabFramebuffer();
    const double ratio = page()->view().devicePixelRatioF();
    const QColor c = picture.pixelColor((*page()->view().place_of(point) * ratio).toPoint());
    return c.red() > 80 && c.red() > 2 * c.blue();
  }
  std::string facts() { return page()->findChild<QLabel*>("tree_facts")->text().toStdString(); }
  /// Kept where OSTIA_PICTURES says.
  void look(const char* name) {
    testing::let_rest();
    const QImage picture = test.window().screen()->grabWindow(test.window().winId()).toImage();
    if (const char* pictures = std::getenv("OSTIA_PICTURES"))
      picture.save(QString("%1/%2.png").arg(pictures, name));
  }
};

TEST_F(TreePageTest, ClicksMeasureWhatIsKnown) {
  open_tree();
  EXPECT_FALSE(test.window().centralWidget()->isVisible());
  click({0, 0, 14});
  EXPECT_EQ(page()->chosen(), 2);
  EXPECT_THAT(facts(), HasSubstr("Length 8 mm"));
  press("tree.along");
  click({0, 0, 5});
  click({3, 0, 10});
  const auto& measured = page()->measuring().measured();
  ASSERT_EQ(measured.size(), 1u);
  EXPECT_EQ(measured[0].tool, TreeTool::along);
  EXPECT_NEAR(measured[0].value, 8.0, 0.2) << "to a pixel or two";
  press("tree.angle");
  click({0, 0, 5});
  click({3, 0, 10});
  ASSERT_EQ(measured.size(), 2u);
  EXPECT_NEAR(measured[1].value, 90.0, 1e-9);
  press("tree.straight");
  click({0, 0, 3});
  click({0, 0, 7});
  ASSERT_EQ(measured.size(), 3u);
  EXPECT_NEAR(measured[2].value, 4.0, 0.2);
  press("tree.grid");
  look("tree_page");
  EXPECT_EQ(page()->findChild<QTableWidget*>("tree_measured")->rowCount(), 3);
  press("tree.copy");
  EXPECT_THAT(QApplication::clipboard()->text().toStdString(), HasSubstr("\nangle,90,deg,"));
  press("tree.close");
  EXPECT_FALSE(page());
  EXPECT_TRUE(test.window().centralWidget()->isVisible());
}

TEST_F(TreePageTest, TheTreeIsDrawnAndTurnsWithTheMouse) {
  open_tree();
  const auto reddish = [&] {
    const QImage picture = page()->view().grabFramebuffer();
    int found = 0;
    for (int y = 0; y < picture.height(); y += 2)
      for (int x = 0; x < picture.width(); x += 2) {
        const QColor c = picture.pixelColor(x, y);
        if (c.red() > 80 && c.red() > 2 * c.green()) ++found;
      }
    return found;
  };
  EXPECT_GT(reddish(), 500);
  const QPointF before = *page()->view().place_of({6, 0, 10});
  const QPoint middle = page()->view().rect().center();
  testing::sweep(page()->view(), {middle, middle + QPoint(60, 0), middle + QPoint(120, 10)});
  EXPECT_GT((*page()->view().place_of({6, 0, 10}) - before).manhattanLength(), 10.0);
  EXPECT_EQ(page()->chosen(), -1) << "a drag is no click";
}

TEST_F(TreePageTest, ASubtreeIsShownAloneAndComesBack) {
  open_tree();
  const Vec3 trunk(0, 0, 5), branch(3, 0, 10), end(0, 0, 14);
  press("tree.subtree");
  EXPECT_THAT(test.window().statusBar()->currentMessage().toStdString(), HasSubstr("Click a segment first"));
  EXPECT_FALSE(test.window().findChild<QAction*>("tree.subtree")->isChecked());
  for (const Vec3& place : {trunk, branch, end}) EXPECT_TRUE(red_at(place)) << place.transpose();
  click(end);
  EXPECT_THAT(facts(), HasSubstr("3 segments\n"));
  EXPECT_THAT(facts(), HasSubstr("With all behind it: 1 segment,"));
  press("tree.subtree");
  EXPECT_FALSE(red_at(trunk));
  EXPECT_FALSE(red_at(branch));
  EXPECT_TRUE(red_at(end));
  click(branch);
  EXPECT_EQ(page()->chosen(), -1) << "what is not shown is not there to be clicked";
  press("tree.subtree");
  for (const Vec3& place : {trunk, branch, end}) EXPECT_TRUE(red_at(place)) << place.transpose();
  click(trunk);
  EXPECT_THAT(facts(), HasSubstr("With all behind it: 3 segments,"));
}

TEST_F(TreePageTest, ARegionHasWhatLiesWithinItsRadiusAndGoesToAFile) {
  open_tree();
  auto* radius = page()->findChild<QDoubleSpinBox*>("tree_region_radius");
  radius->setFocus();
  radius->selectAll();
  QTest::keyClicks(radius, "3");
  QTest::keyClick(radius, Qt::Key_Return);
  press("tree.region");
  click({0, 0, 5});
  const auto& measured = page()->measuring().measured();
  ASSERT_EQ(measured.size(), 1u);
  EXPECT_EQ(measured[0].value, 3.0);
  ASSERT_TRUE(measured[0].totals);
  EXPECT_EQ(measured[0].totals->segments, 1);
  EXPECT_NEAR(measured[0].totals->length_mm, 6.0, 1e-9);
  EXPECT_NEAR(measured[0].totals->volume_mm3, 6.0 * std::numbers::pi, 1e-9);
  testing::answer_file_dialog(folder / "measured.csv");
  press("tree.export");
  const std::string file = core::read_file(folder / "measured.csv");
  EXPECT_EQ(file, measured_csv(measured));
  EXPECT_THAT(file, HasSubstr("\nregion,3,mm,"));
  press("tree.clear");
  EXPECT_TRUE(measured.empty());
  EXPECT_EQ(page()->findChild<QTableWidget*>("tree_measured")->rowCount(), 0);
}

TEST_F(TreePageTest, ReadingALargeTreeCanBeCancelled) {
  std::string rows = "x1,y1,z1,radius1,x2,y2,z2,radius2\n";
  for (int i = 0; i < 400000; ++i) rows += std::to_string(i) + ",0,0,1," + std::to_string(i + 1) + ",0,0,1\n";
  open(rows.c_str());
  // A tree that is read is measured next: that is another job, with a line and a cross of its own.
  const auto cross = [&]() -> QToolButton* {
    for (auto* one : test.window().jobs().findChildren<QToolButton*>("cancel.open"))
      if (one->isVisible()) return one;
    return nullptr;
  };
  ASSERT_TRUE(wait_until([&] { return cross() != nullptr; }));
  QTest::mouseClick(cross(), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return !test.window().jobs().any(); }));
  EXPECT_FALSE(page());
  EXPECT_TRUE(testing::open_boxes().empty()) << "who cancelled need not be told";
  open_tree();  // the window is as it was
}

TEST_F(TreePageTest, KeysRunTheCommands) {
  open_tree();
  keys(Qt::Key_4);
  EXPECT_EQ(page()->measuring().tool(), TreeTool::angle);
  keys(Qt::Key_W);
  EXPECT_FALSE(page());
}

TEST_F(TreePageTest, FaultsAreToldAndRepairedWhereThatIsWanted) {
  open(loop_csv);
  ASSERT_TRUE(wait_until([] { return !testing::open_boxes().empty(); }));
  QMessageBox* box = testing::open_boxes().front();
  EXPECT_THAT(box->text().toStdString(), HasSubstr("radius"));
  EXPECT_FALSE(page());
  for (QAbstractButton* button : box->buttons())
    if (button->text() == "Repair and open") QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return page() != nullptr; }));
  EXPECT_THAT(facts(), HasSubstr("radi"));
}

TEST_F(TreePageTest, PlacesInAnotherUnitThanRadiiAreSaid) {
  open("x1,y1,z1,radius1,x2,y2,z2,radius2\n0,0,0,2,0,0.003,0.004,1.5\n");
  ASSERT_TRUE(wait_until([&] { return page() != nullptr; }));
  EXPECT_THAT(facts(), HasSubstr("in different units?"));
}

TEST_F(TreePageTest, WhatIsNoTreeIsSaid) {
  open("x1,y1,z1,radius1,x2,y2,z2,radius2\n0,0,zero,1,0,0,10,1\n");
  EXPECT_THAT(testing::message(), HasSubstr("tree.csv"));
  EXPECT_FALSE(page());
}

}  // namespace
}  // namespace ostia::workstation
