#include "qa/dock.h"
#include "window_hand.h"

#include "ostia/core/error.h"
#include "ostia/io/contour_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTreeWidget>
#include <cmath>
#include <fstream>

namespace ostia::workstation {
namespace {

using testing::sweep;
using testing::TestWindow;
using testing::wait_until;
using view::Vec2;
using view::Vec3;

geometry::VesselTree straight_tree() {
  geometry::Centerline axis;
  for (int i = 0; i <= 80; ++i) {
    axis.points.push_back({0.0, 0.0, 0.5 * i});
    axis.radius.push_back(1.5);
  }
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, axis}};
  tree.vessels = {{4, "LAD", {3}}};
  return tree;
}

geometry::ContourSection section(const std::string& name, const std::string& observer, double from, double to,
                                 double radius) {
  const geometry::AxisCurve axis(straight_tree().segments[0].axis);
  geometry::ContourSection out;
  out.section = name;
  out.vessel = "LAD";
  out.observer = observer;
  for (double s = from; s <= to; s += 1.0) {
    geometry::Contour contour{s, {}};
    for (int i = 0; i < 48; ++i) contour.points.push_back(axis.place(s, 2 * M_PI * i / 48, radius));
    out.contours.push_back(contour);
  }
  return out;
}

class QaDockTest : public ::testing::Test {
 protected:
  QaDockTest() {
    session::CaseFile::create(folder_ / "a.ostia", lumen::model_of_tubes(straight_tree()))
        .copy_to(folder_ / "b.ostia");
    io::write_contours(folder_ / "truth.json",
                       {{section("s01", "truth", 5, 15, 1.7), section("s02", "truth", 20, 35, 1.2),
                         section("s01", "observer1", 5, 15, 1.8)}});
  }
  static QPoint place(PictureWidget& picture, const Vec3& at) {
    const auto shown = picture.view().project(at);
    return shown ? QPoint(static_cast<int>(std::lround(shown->px.x())),
                          static_cast<int>(std::lround(shown->px.y())))
                 : QPoint();
  }
  testing::Folder folder_;
};

TEST_F(QaDockTest, ShowsTheTruthItsFiguresAndTheWorstSection) {
  TestWindow window(folder_ / "state");
  window.open(folder_ / "a.ostia");
  QaDock& qa = window.window().qa();
  EXPECT_TRUE(qa.isHidden());
  qa.show();
  qa.open_truth(folder_ / "truth.json");
  auto* list = qa.findChild<QTreeWidget*>("qa_sections");
  ASSERT_TRUE(wait_until([&] { return list->topLevelItemCount() == 2; }));
  EXPECT_NEAR(list->topLevelItem(0)->text(2).toDouble(), 0.20, 0.03);
  EXPECT_NEAR(list->topLevelItem(1)->text(2).toDouble(), 0.30, 0.03);
  EXPECT_TRUE(qa.findChild<QLabel*>("qa_vessel")->text().contains("LAD"));
  const auto truth_lines = [&](const char* name) {
    int count = 0;
    for (const auto& line : window.picture(name).view().overlay().lines)
      count += line.role == view::Role::truth ? 1 : 0;
    return count;
  };
  qa.findChild<QPushButton*>("qa_next")->click();
  EXPECT_GE(window.bench().cursor_mm.get(), 20.0);
  EXPECT_GE(truth_lines("cpr1"), 2);
  EXPECT_EQ(truth_lines("section"), 1);
  // Better by a drawn contour: the figures follow.
  const double before = qa.check().sections()[1].surfaces.mean_mm();
  window.bench().tool.set(session::Tool::draw);
  window.bench().cursor_mm.set(27.0);
  window.bench().section_eps_mm.set(6.0);
  auto& picture = window.picture("section");
  std::vector<QPoint> ring;
  for (int i = 0; i <= 24; ++i)
    ring.push_back(place(picture, window.bench().axis()->place(27.0, 2 * M_PI * i / 24, 1.2)));
  sweep(picture, ring);
  const double after = qa.check().sections()[1].surfaces.mean_mm();
  EXPECT_LT(after, before - 0.01);
  ASSERT_TRUE(
      wait_until([&] { return list->topLevelItem(1)->text(2) == QString::number(after, 'f', 3); }, 3000));
  qa.findChild<QComboBox*>("qa_observer")->setCurrentText("observer1");
  qa.check().observer.set("observer1");
  ASSERT_TRUE(wait_until([&] { return list->topLevelItemCount() == 1; }));
  qa.hide();
  EXPECT_EQ(truth_lines("section"), 0);
  EXPECT_FALSE(qa.check().timer().running());
}

TEST_F(QaDockTest, WhatWasRecordedInOneWindowIsDoneAgainInAnother) {
  std::string digest;
  {
    TestWindow window(folder_ / "state");
    window.open(folder_ / "a.ostia");
    QaDock& qa = window.window().qa();
    qa.show();
    QApplication::processEvents();
    qa.start_recording(folder_ / "hand.jsonl");
    session::Workbench& bench = window.bench();
    const auto axis = bench.axis();
    bench.cursor_mm.set(12.0);
    bench.tool.set(session::Tool::draw);
    auto& cpr = window.picture("cpr1");
    std::vector<QPoint> stroke;
    for (double s = 8.0; s <= 16.0; s += 0.5)
      stroke.push_back(place(cpr, axis->place(s, 0.0, 1.5 + 0.4 * std::sin((s - 8.0) / 8.0 * M_PI))));
    sweep(cpr, stroke);
    bench.tool.set(session::Tool::drag);
    auto& twin = window.picture("cpr2");
    const auto hit = twin.view().wall_near(twin.view().project(axis->place(12.0, M_PI / 2, 1.5))->px, 100.0);
    ASSERT_TRUE(hit.has_value());
    const QPoint from(static_cast<int>(hit->px.x()), static_cast<int>(hit->px.y()));
    sweep(twin, {from, from + QPoint(4, 0), from + QPoint(9, 1), from + QPoint(14, 2)});
    bench.undo();
    bench.redo();
    bench.tool.set(session::Tool::brush);
    auto& flat = window.picture("section");
    sweep(flat, {place(flat, axis->place(12.0, 2.0, 0.7)), place(flat, axis->place(12.0, 2.0, 1.1))});
    qa.stop_recording();
    EXPECT_EQ(bench.session().file().edits().size(), 3U);
    digest = lumen::digest(*bench.model());
  }
  TestWindow window(folder_ / "state2");
  window.window().resize(1300, 900);
  window.open(folder_ / "b.ostia");
  QaDock& qa = window.window().qa();
  qa.show();
  for (int i = 0; i < 5; ++i) QApplication::processEvents();
  const int width = window.picture("cpr1").view().width();
  int told = -1;
  QObject::connect(&qa, &QaDock::replayed, &qa, [&](bool same) { told = same ? 1 : 0; });
  qa.start_replay(folder_ / "hand.jsonl", true);
  EXPECT_TRUE(qa.findChild<QProgressBar*>("qa_progress")->isVisible());
  // The person's own hand does nothing meanwhile.
  auto& cpr = window.picture("cpr1");
  sweep(cpr, {QPoint(30, 30), QPoint(60, 90)});
  ASSERT_TRUE(wait_until([&] { return !qa.replaying(); }));
  EXPECT_EQ(told, 1);
  EXPECT_EQ(lumen::digest(*window.bench().model()), digest);
  EXPECT_EQ(window.picture("cpr1").view().width(), width);
  // It is no longer the model that it began with.
  EXPECT_THROW(qa.start_replay(folder_ / "hand.jsonl", true), InvalidInput);
}

TEST_F(QaDockTest, AReplayAtTheRecordedSpeedCanBeCancelled) {
  TestWindow window(folder_ / "state");
  window.open(folder_ / "a.ostia");
  const std::string digest = lumen::digest(*window.bench().model());
  {
    std::ofstream out(folder_ / "slow.jsonl");
    out << R"({"v":1,"kind":"ostia.hand","start_digest":")" << digest << "\"}\n"
        << R"({"t_ms":1,"view":"cpr1","act":"leave"})"
        << "\n"
        << R"({"t_ms":600000,"view":"cpr1","act":"leave"})"
        << "\n";
  }
  QaDock& qa = window.window().qa();
  qa.show();
  qa.start_replay(folder_ / "slow.jsonl", false);
  auto* progress = qa.findChild<QProgressBar*>("qa_progress");
  ASSERT_TRUE(wait_until([&] { return progress->value() == 1; }));
  EXPECT_TRUE(qa.replaying());
  qa.findChild<QPushButton*>("qa_cancel")->click();
  EXPECT_FALSE(qa.replaying());
  EXPECT_TRUE(progress->isHidden());
}

}  // namespace
}  // namespace ostia::workstation
