// Areas, arrows and notes by the mouse of the X server, and the list of them: names, order, filter, copy. The
// image is known: 100 HU left of the plane x = 0, 300 HU right of it.

#include "measuring/list.h"
#include "real_program.h"
#include "tube_window.h"

#include <gmock/gmock.h>

#include <QClipboard>
#include <QHeaderView>
#include <QTabWidget>

namespace ostia::workstation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::wait_until;
using testing::xdo;
using view::Vec2;
using view::Vec3;

struct Measuring : testing::TubeWindow {
  Measuring() {
    imaging::ImageVolume two = testing::tube_image();
    for (std::size_t n = 0; n < two.voxels.size(); ++n) two.voxels[n] = n % 64 < 32 ? 100 : 300;
    image = folder / "two.nrrd";
    case_file = folder / "two.ostia";
    imaging::write_image(image, two);
    const auto reference = session::image_reference(image);
    session::CaseFile::create(case_file, testing::tube_model(), reference);
    session::MachineState(folder / "state").remember_image(reference.sha256, image);
    open_case();
    window().activateWindow();
    list().show();
    for (QWidget* page = &list(); page->parentWidget(); page = page->parentWidget())
      if (auto* tabs = qobject_cast<QTabWidget*>(page->parentWidget()->parentWidget()))
        tabs->setCurrentWidget(page);
    settle();
  }
  ~Measuring() override { xdo({"mouseup", "1"}); }
  MeasurementList& list() { return *part<MeasurementList>("measurements"); }
  PictureWidget& slice() { return test->picture("slice"); }
  std::vector<analysis::Measurement> made() {
    return test->bench().session().file().annotations()->measurements;
  }
  /// Where a place of the slice is on the screen.
  QPoint on_screen(double x_mm, double y_mm) {
    const Vec3 place(x_mm, y_mm, test->bench().place.get().z());
    const Vec2 px = slice().view().project(place)->px / slice().devicePixelRatioF();
    return slice().mapToGlobal(QPointF(px.x(), px.y()).toPoint());
  }
  static void step(const QPoint& at) {
    testing::go(at);
    QTest::qWait(12);
  }
  void draw(const std::vector<QPoint>& corners) {
    step(corners.front());
    xdo({"mousedown", "1"});
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const QPoint way = corners[i] - corners[i - 1];
      const int steps = std::max(1, std::max(std::abs(way.x()), std::abs(way.y())) / 6);
      for (int k = 1; k <= steps; ++k) step(corners[i - 1] + way * k / steps);
    }
    xdo({"mouseup", "1"});
    settle();
  }
  void area(double left, double right, double top, double bottom) {
    part<QAction>("tool.area")->trigger();
    draw({on_screen(left, top), on_screen(right, top), on_screen(right, bottom), on_screen(left, bottom),
          on_screen(left, top)});
  }
  void click(const QPoint& at) {
    testing::go(at, {"click", "1"});
    settle();
  }
  void write(const QString& text) {
    ASSERT_TRUE(wait_until([&] { return list().viewport()->findChild<QLineEdit*>() != nullptr; }, 4000));
    xdo({"type", "--delay", "30", text});
    settle();
    testing::keys({"Return"});
    settle();
  }
  void arrow(const QString& text) {
    part<QAction>("tool.arrow")->trigger();
    draw({on_screen(1.0, 1.0), on_screen(5.0, 6.0)});
    write(text);
  }
  void note(double x, double y, const QString& text) {
    part<QAction>("tool.note")->trigger();
    click(on_screen(x, y));
    write(text);
  }
  QTreeWidgetItem* row(const QString& name) {
    for (int i = 0; i < list().topLevelItemCount(); ++i)
      if (list().topLevelItem(i)->text(0) == name) return list().topLevelItem(i);
    throw std::runtime_error("no row " + name.toStdString());
  }
  double value(const QString& name, const char* quantity) {
    const QTreeWidgetItem* item = row(name);
    for (int k = 0; k < item->childCount(); ++k)
      if (item->child(k)->text(0) == quantity) return item->child(k)->text(1).split(' ').front().toDouble();
    return NAN;
  }
  std::vector<std::string> shown_rows() {
    std::vector<std::string> names;
    for (int i = 0; i < list().topLevelItemCount(); ++i)
      if (!list().topLevelItem(i)->isHidden()) names.push_back(list().topLevelItem(i)->text(0).toStdString());
    return names;
  }
  void click_header(int column) {
    QTest::qWait(QApplication::doubleClickInterval() + 200);  // the last one and this are two clicks
    QHeaderView* header = list().header();
    click(header->viewport()->mapToGlobal(
        QPoint(header->sectionViewportPosition(column) + 12, header->height() / 2)));
  }
  void click_row(const QString& name) {
    click(list().viewport()->mapToGlobal(list().visualItemRect(row(name)).topLeft() + QPoint(20, 6)));
  }
};

TEST_F(Measuring, AnAreaTellsMeanAndSpreadOfTheCtNumbersInIt) {
  area(-4.0, 4.0, -4.0, 4.0);
  area(5.5, 9.0, -4.0, 3.0);
  ASSERT_EQ(made().size(), 2U);
  ASSERT_TRUE(wait_until([&] { return list().topLevelItemCount() == 2; }, 3000));
  EXPECT_NEAR(value("Area 1", "area"), 64.0, 3.0);
  EXPECT_NEAR(value("Area 1", "mean"), 200.0, 8.0) << "half of it is at 100 HU";
  EXPECT_NEAR(value("Area 1", "SD"), 100.0, 1.0);
  EXPECT_NEAR(value("Area 2", "area"), 24.5, 2.5);
  EXPECT_EQ(value("Area 2", "mean"), 300.0);
  EXPECT_EQ(value("Area 2", "SD"), 0.0);
  std::string label;
  for (const view::PlacedText& one : slice().painted_texts())
    if (one.shown && one.text.rfind("Area 2", 0) == 0) label = one.text;
  EXPECT_THAT(label, HasSubstr("300 \u00b1 0")) << "it is not written beside the outline";
}

TEST_F(Measuring, ArrowsAndNotesAskForTheirTextAndCoverNothing) {
  arrow("Ostial plaque");
  note(-6.0, 5.0, "Stent?");
  note(-4.0, 6.2, "Look again");
  ASSERT_EQ(made().size(), 3U);
  EXPECT_EQ(made()[0].name, "Ostial plaque");
  EXPECT_EQ(made()[0].points.size(), 2U);
  EXPECT_NEAR(made()[0].points[0].x(), 1.0, 0.15) << "its tip is where the hand began";
  EXPECT_EQ(made()[1].name, "Stent?");
  EXPECT_EQ(made()[2].name, "Look again");
  settle();
  const std::vector<view::PlacedText>& texts = slice().painted_texts();
  int labels = 0;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(texts[i].shown && texts[k].shown && texts[i].rect.meets(texts[k].rect))
          << texts[i].text << " over " << texts[k].text;
    if (texts[i].text != "Ostial plaque") continue;
    ++labels;
    for (const view::OverlayLine& line : slice().view().overlay().lines)
      for (std::size_t p = 1; line.of == made()[0].id && p < line.px.size(); ++p)
        EXPECT_FALSE((view::LabelLine{line.px[p - 1], line.px[p]}.crosses(texts[i].rect)))
            << "the name lies over its arrow";
  }
  EXPECT_EQ(labels, 1);
  part<QAction>("edit.undo")->trigger();
  part<QAction>("edit.undo")->trigger();
  settle();
  EXPECT_EQ(made().size(), 2U) << "name and note are a step each";
}

TEST_F(Measuring, TheListSortsFiltersRenamesAndIsCopiedAsText) {
  area(3.0, 8.0, -4.0, 3.0);
  note(-6.0, 5.0, "Zebra");
  note(-2.0, 8.0, "Antrum");
  ASSERT_TRUE(wait_until([&] { return list().topLevelItemCount() == 3; }, 3000));
  EXPECT_THAT(shown_rows(), ElementsAre("Area 1", "Zebra", "Antrum"));
  click_header(0);
  EXPECT_THAT(shown_rows(), ElementsAre("Antrum", "Area 1", "Zebra"));
  click_header(0);
  EXPECT_THAT(shown_rows(), ElementsAre("Zebra", "Area 1", "Antrum"));
  click_header(0);
  EXPECT_THAT(shown_rows(), ElementsAre("Area 1", "Zebra", "Antrum"));

  click_row("Area 1");
  EXPECT_EQ(test->bench().selected_measurement.get(), made()[0].id);
  testing::keys({"F2"});
  ASSERT_TRUE(wait_until([&] { return list().viewport()->findChild<QLineEdit*>() != nullptr; }, 4000));
  testing::keys({"ctrl+a"});
  xdo({"type", "--delay", "30", "Myocardium"});
  testing::keys({"Return"});
  settle();
  EXPECT_EQ(made()[0].name, "Myocardium");
  EXPECT_THAT(shown_rows(), ElementsAre("Myocardium", "Zebra", "Antrum"));

  auto* filter = part<QLineEdit>("measurements_filter");
  click(filter->mapToGlobal(filter->rect().center()));
  xdo({"type", "--delay", "30", "an"});
  settle();
  EXPECT_THAT(shown_rows(), ElementsAre("Antrum"));
  testing::keys({"ctrl+a", "BackSpace"});
  settle();
  EXPECT_EQ(shown_rows().size(), 3U);

  click_row("Myocardium");
  testing::keys({"ctrl+c"});
  settle();
  const std::string copied = QGuiApplication::clipboard()->text().toStdString();
  EXPECT_THAT(copied, HasSubstr("Myocardium\tmean\t300"));
  EXPECT_THAT(copied, HasSubstr("Myocardium\tSD\t0"));
  EXPECT_THAT(copied, HasSubstr("Zebra\t\t"));
  EXPECT_THAT(copied, Not(HasSubstr("Area")));
}

}  // namespace
}  // namespace ostia::workstation
