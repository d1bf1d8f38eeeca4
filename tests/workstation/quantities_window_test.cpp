// One unit and no more digits than its quantity has, in all that the window shows: asked of the widgets, of
// what the views have painted, and of a report.

#include "views/picture_widget.h"
#include "views/scene_widget.h"
#include "window_states.h"

#include "ostia/core/files.h"

#include <QVTKOpenGLNativeWidget.h>
#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QLabel>
#include <QRegularExpression>
#include <QSurfaceFormat>
#include <clocale>
#include <map>

namespace ostia::workstation {
namespace {

using testing::Stage;

/// Decimals that are allowed behind a number of each unit.
const std::map<QString, int>& most_decimals() {
  static const std::map<QString, int> most{{"mm", 2}, {"mm\u00b2", 2}, {"mm\u00b3", 1}, {"HU", 0},
                                           {"%", 0},  {"\u00b0", 1},   {"bpm", 0}};
  return most;
}

/// What is wrong with the numbers of a text: too many digits, or another unit than the window's own.
QStringList number_faults(const QString& text) {
  static const QRegularExpression number(
      QStringLiteral("(?<![\\w.])-?(\\d+)(?:\\.(\\d+))?(?:[ "
                     "\u2009]?(mm\u00b3|mm\u00b2|mm|HU|%|\u00b0|bpm)(?![\\w\u00b2\u00b3]))?"));
  static const QRegularExpression other_unit(QStringLiteral(
      "\\d[ ]?(cm|\u00b5m|um|cm\u00b2|cm\u00b3|ml|mm\\^2|mm\\^3|mm2|mm3|deg|degrees|percent)(?!\\w)"));
  QStringList faults;
  for (auto it = number.globalMatch(text); it.hasNext();) {
    const auto found = it.next();
    const QString unit = found.captured(3), decimals = found.captured(2);
    const bool too_many = unit.isEmpty() ? decimals.size() > 2 : decimals.size() > most_decimals().at(unit);
    // An area or a volume has three digits that count.
    const bool large =
        unit.startsWith("mm") && unit != "mm" && found.captured(1).size() > 2 && !decimals.isEmpty();
    if (too_many || large) faults << QStringLiteral("\"%1\" in \"%2\"").arg(found.captured(0), text);
  }
  if (const auto found = other_unit.match(text); found.hasMatch())
    faults << QStringLiteral("the unit of \"%1\" in \"%2\"").arg(found.captured(0), text);
  return faults;
}

QStringList texts_of_items(const QAbstractItemModel& model, const QModelIndex& parent = {}) {
  QStringList all;
  for (int row = 0; row < model.rowCount(parent); ++row)
    for (int column = 0; column < model.columnCount(parent); ++column) {
      const QModelIndex at = model.index(row, column, parent);
      all << at.data().toString() << at.data(Qt::ToolTipRole).toString();
      if (column == 0) all << texts_of_items(model, at);
    }
  return all;
}

QStringList painted(const std::vector<view::PlacedText>& texts) {
  QStringList all;
  for (const view::PlacedText& one : texts) all << QString::fromStdString(one.text);
  return all;
}

/// All that can be read, by the part that says it.
std::map<QString, QStringList> texts_of(QWidget& window) {
  std::map<QString, QStringList> all;
  for (auto* one : window.findChildren<QLabel*>())
    if (one->isVisible()) all["labels"] << one->text() << one->toolTip();
  for (auto* one : window.findChildren<QAbstractItemView*>())
    if (one->isVisible() && one->model()) all["lists"] << texts_of_items(*one->model());
  for (auto* one : window.findChildren<PictureWidget*>())
    if (one->isVisible()) all["pictures"] << painted(one->painted_texts());
  for (auto* one : window.findChildren<ProfileWidget*>())
    if (one->isVisible()) all["profile"] << painted(one->painted_texts());
  for (auto* one : window.findChildren<SceneWidget*>())
    if (one->isVisible())
      for (const view::SceneText& text : one->scene().texts())
        all["tree"] << QString::fromStdString(text.text);
  return all;
}

int numbers_in(const QStringList& texts) {
  return texts.filter(QRegularExpression("\\d")).size();
}

TEST(Quantities, TheCheckSeesWhatIsWrong) {
  EXPECT_EQ(
      number_faults(
          "2.71 mm, 4.21 mm\u00b2  \u00d8 2.31 (1.99\u20132.80) mm, 512 mm\u00b3, 57 %, -85 HU, 31.4\u00b0"),
      QStringList());
  for (const char* text : {"2.714 mm", "12.345", "57.3 %", "-85.4 HU", "512.4 mm\u00b2", "3.21 mm\u00b3",
                           "1.3 ml", "0.4 cm", "30 degrees", "5 mm2", "31.44\u00b0"})
    EXPECT_EQ(number_faults(QString::fromUtf8(text)).size(), 1) << text;
  for (const char* text : {"Ostia 0.2.0", "2024-03-01", "LAD (6)", "case-1a2b3c4d"})
    EXPECT_EQ(number_faults(QString::fromUtf8(text)), QStringList()) << text;
}

class QuantitiesIn : public ::testing::TestWithParam<const char*> {};

TEST_P(QuantitiesIn, AllNumbersHaveTheDigitsOfTheirQuantity) {
  Stage stage(QSize(1600, 1150));
  stage.enter("case");
  stage.crowd();
  if (std::string(GetParam()) != "crowd") stage.enter(GetParam());
  stage.settled();
  const auto texts = texts_of(stage.window());
  for (const auto& [part, of] : texts)
    for (const QString& text : of)
      for (const QString& fault : number_faults(text))
        ADD_FAILURE() << part.toStdString() << ": " << fault.toStdString();
  for (const char* part : {"lists", "pictures", "profile"})
    EXPECT_GT(texts.count(part) ? numbers_in(texts.at(part)) : 0, 2) << part << " have shown hardly a number";
}

INSTANTIATE_TEST_SUITE_P(States, QuantitiesIn, ::testing::Values("crowd", "editing"),
                         [](const auto& one) { return std::string(one.param); });

TEST(Quantities, AReportHasThemToo) {
  Stage stage(QSize(1600, 1150));
  stage.enter("case");
  stage.crowd();
  stage.enter("report");
  const std::filesystem::path folder = std::filesystem::current_path() / "tube-report";
  const QString html = QString::fromStdString(core::read_file(folder / "report.html"));
  QStringList cells;
  static const QRegularExpression cell("<(td|th|p|li|figcaption)[^>]*>(.*?)</\\1>",
                                       QRegularExpression::DotMatchesEverythingOption);
  for (auto it = cell.globalMatch(html); it.hasNext();) {
    QString text = it.next().captured(2);
    text.replace(QRegularExpression("<[^>]*>"), " ").replace("&#39;", "'").replace("&amp;", "&");
    cells << text;
  }
  EXPECT_GT(numbers_in(cells), 20);
  for (const QString& text : cells)
    for (const QString& fault : number_faults(text)) ADD_FAILURE() << fault.toStdString();
}

}  // namespace
}  // namespace ostia::workstation

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const ostia::workstation::testing::Folder folder;
  ostia::workstation::testing::pin_fonts(folder);
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication::setAttribute(Qt::AA_DontCreateNativeWidgetSiblings);
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  ostia::workstation::testing::pin_look();
  return RUN_ALL_TESTS();
}
