// What views say they have written where, held against the pixels; and whose tree it is, in its corner.

#include "painted_faults.h"
#include "tube_window.h"
#include "views/overlay_painter.h"

#include <gmock/gmock.h>

#include <QPainter>
#include <QScreen>
#include <random>

namespace ostia::workstation {
namespace {

using testing::painted_faults;
using view::Vec2;
using view::Vec3;

/// Where the picture is not as it was before.
QRect changed(const QImage& before, const QImage& after) {
  QRect box;
  for (int y = 0; y < after.height(); ++y)
    for (int x = 0; x < after.width(); ++x)
      if (before.pixel(x, y) != after.pixel(x, y)) box |= QRect(x, y, 1, 1);
  return box;
}

QRectF in_qt(const view::LabelRect& rect) {
  return {rect.low.x(), rect.low.y(), rect.size.x(), rect.size.y()};
}

TEST(OverlayPainter, LettersLieWithinTheirRectangle) {
  QImage sheet(400, 120, QImage::Format_RGB32);
  sheet.fill(QColor(90, 90, 90));
  for (const double density : {1.0, 2.0})
    for (const char* text :
         {"LAD  straightened 30\u00b0", "Gjpqy \u00c4\u00d6\u00dc \u00d8 3.21 mm\u00b2", "W"}) {
      QImage painted = sheet;
      QPainter painter(&painted);
      QFont font = painter.font();
      font.setPixelSize(static_cast<int>(12.0 * density));
      painter.setFont(font);
      view::Overlay overlay;
      overlay.texts.push_back({Vec2(40.0, 40.0), text});
      const auto placed = paint_overlay(painter, overlay, {QSizeF(painted.size()), density, Ground::image});
      painter.end();
      ASSERT_EQ(placed.size(), 1U);
      const QRectF halo =
          in_qt(placed[0].rect).adjusted(-2 * density, -2 * density, 2 * density, 2 * density);
      const QRect letters = changed(sheet, painted);
      EXPECT_TRUE(halo.contains(QRectF(letters))) << text << " at " << density;
      EXPECT_GT(letters.width(), 0.7 * placed[0].rect.size.x()) << text << ": the rectangle is too large";
    }
}

struct PaintedTexts : testing::TubeWindow {
  PaintedTexts() { open_case(); }
  view::TreeScene& scene() { return window().scene().scene(); }
  QImage on_screen() {
    const QPoint at = native->mapToGlobal(QPoint(0, 0));
    return QGuiApplication::primaryScreen()
        ->grabWindow(0, at.x(), at.y(), native->width(), native->height())
        .toImage()
        .convertToFormat(QImage::Format_RGB32);
  }
  void know_the_patient() {
    imaging::ShownIdentity whose;
    whose.patient_name = "M\u00fcller-L\u00fcdenscheidt, \u0410\u043d\u043d\u0430";
    whose.patient_id = "4711";
    whose.study_date = "2024-03-01";
    whose.series_description = "CTA 75 % 0.6 Bv40";
    window().desk().identity.take(test->bench().image().reference.sha256, whose);
    settle();
  }
  std::vector<std::string> scene_texts() {
    std::vector<std::string> all;
    for (const view::SceneText& one : scene().texts()) all.push_back(one.text);
    return all;
  }
};

TEST_F(PaintedTexts, WhoseTreeItIsStandsInItsCornerWhileItIsWantedAndInNoSavedPicture) {
  look_from_front();
  const QImage before = on_screen();
  const auto saved = scene().snapshot(400, 300);
  know_the_patient();
  EXPECT_THAT(scene_texts(), ::testing::Contains(::testing::HasSubstr("4711")));
  const QImage with = on_screen();
  const QRect letters = changed(before, with);
  ASSERT_FALSE(letters.isEmpty());
  for (const view::SceneText& one : scene().texts())
    if (one.text.find("4711") != std::string::npos) {
      EXPECT_TRUE(in_qt(one.rect).adjusted(-1, -1, 1, 1).contains(QRectF(letters)))
          << letters.left() << ' ' << letters.top() << ' ' << letters.width() << ' ' << letters.height();
    }
  EXPECT_GT(letters.height(), 40) << "four lines";
  EXPECT_TRUE(painted_faults(window()).isEmpty()) << painted_faults(window()).join('\n').toStdString();
  EXPECT_EQ(scene().snapshot(400, 300).rgba, saved.rgba) << "a saved picture has it";

  part<QAction>("view.identity")->trigger();
  settle();
  EXPECT_THAT(scene_texts(), ::testing::Not(::testing::Contains(::testing::HasSubstr("4711"))));
  EXPECT_TRUE(changed(before, on_screen()).isEmpty());
}

TEST_F(PaintedTexts, TextsOfTheTreeAreWhereItSaysTheyAre) {
  look_from_front();
  const QImage plain = on_screen();
  analysis::Measurement note;
  note.kind = analysis::MeasureKind::note;
  note.name = "gyp \u00c4 (calcified)";
  note.points = {{4.0, 0.0, 22.0}};
  test->bench().annotate(session::MeasureAdd{note});
  settle();
  const QImage noted = on_screen();
  bool found = false;
  for (const view::SceneText& one : scene().texts()) {
    if (one.text != note.name) continue;
    found = true;
    const QRect label = in_qt(one.rect).toAlignedRect();
    // Beside the dot, which is near: what has changed and is not within the dot's surroundings is the label.
    const Vec2 dot = scene().project(note.points[0]);
    const QRect about_dot(static_cast<int>(dot.x()) - 9, noted.height() - static_cast<int>(dot.y()) - 9, 18,
                          18);
    QRect outside;
    for (int y = 0; y < noted.height(); ++y)
      for (int x = 0; x < noted.width(); ++x)
        if (noted.pixel(x, y) != plain.pixel(x, y) && !about_dot.contains(x, y)) outside |= QRect(x, y, 1, 1);
    EXPECT_TRUE(label.adjusted(-2, -2, 2, 2).contains(outside))
        << outside.left() << ' ' << outside.top() << ' ' << outside.width() << ' ' << outside.height()
        << " in " << label.left() << ' ' << label.top() << ' ' << label.width() << ' ' << label.height();
    EXPECT_GT(outside.width(), 0.8 * label.width());
  }
  EXPECT_TRUE(found);
}

TEST_F(PaintedTexts, TheScalesNumberIsWhereItSaysItIs) {
  look_from_front();
  const QImage with = on_screen();
  QRectF number;
  for (const view::SceneText& one : scene().texts())
    if (one.text.size() > 3 && one.text.substr(one.text.size() - 3) == " mm") number = in_qt(one.rect);
  ASSERT_FALSE(number.isNull());
  scene().set_scale_bar_shown(false);
  window().scene().request_render();
  settle();
  const QRect rows(0, number.toAlignedRect().top(), with.width(), number.toAlignedRect().height());
  const QRect letters = changed(on_screen().copy(rows), with.copy(rows)).translated(rows.topLeft());
  EXPECT_TRUE(number.adjusted(-2, -2, 2, 2).contains(QRectF(letters)))
      << letters.left() << ' ' << letters.top() << ' ' << letters.width() << ' ' << letters.height();
  EXPECT_GT(letters.width(), 0.8 * number.width());
  EXPECT_GT(letters.height(), 0.4 * number.height());
}

TEST_F(PaintedTexts, LabelsOfTheTreeKeepOffTheirOwnLinesFromAllSides) {
  look_from_front();
  const auto add = [&](analysis::MeasureKind kind, const std::vector<Vec3>& points) {
    analysis::Measurement one;
    one.kind = kind;
    one.points = points;
    test->bench().annotate(session::MeasureAdd{one});
  };
  add(analysis::MeasureKind::distance, {{-1.5, 0.0, 8.0}, {1.5, 0.5, 31.0}});
  add(analysis::MeasureKind::arrow, {{1.5, 0.0, 20.0}, {7.0, 2.0, 30.0}});
  add(analysis::MeasureKind::angle, {{0.0, 0.0, 4.0}, {1.0, 1.0, 18.0}, {6.0, 4.0, 28.0}});
  settle();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> px(-160.0, 160.0);
  int labels = 0;
  for (int turn = 0; turn < 25; ++turn) {
    scene().rotate_by(px(random), px(random));
    window().scene().request_render();
    settle();
    EXPECT_TRUE(painted_faults(window()).isEmpty()) << painted_faults(window()).join('\n').toStdString();
    for (const view::SceneText& one : scene().texts()) {
      labels += one.lines.empty() ? 0 : 1;
      for (const view::LabelLine& line : one.lines) EXPECT_FALSE(line.crosses(one.rect)) << one.text;
    }
  }
  EXPECT_GT(labels, 60);
}

}  // namespace
}  // namespace ostia::workstation
