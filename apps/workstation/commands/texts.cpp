#include "commands/texts.h"

#include <QCoreApplication>
#include <QMap>

namespace ostia::workstation {
namespace {

QString gestures(const char* text) {
  return QCoreApplication::translate("gestures", text);
}

}  // namespace

QString command_group(const QString& id) {
  static const QMap<QString, const char*> groups{
      {"file", QT_TRANSLATE_NOOP("gestures", "File")},
      {"edit", QT_TRANSLATE_NOOP("gestures", "Edit")},
      {"vessel", QT_TRANSLATE_NOOP("gestures", "Vessel")},
      {"lesion", QT_TRANSLATE_NOOP("gestures", "Lesions")},
      {"calcium", QT_TRANSLATE_NOOP("gestures", "Calcium score")},
      {"compare", QT_TRANSLATE_NOOP("gestures", "Compared with the last scan")},
      {"pressure", QT_TRANSLATE_NOOP("gestures", "Pressure")},
      {"tool", QT_TRANSLATE_NOOP("gestures", "Tools")},
      {"tree", QT_TRANSLATE_NOOP("gestures", "Vessel tree")},
      {"view", QT_TRANSLATE_NOOP("gestures", "Views")},
      {"window", QT_TRANSLATE_NOOP("gestures", "Grey levels")},
      {"heart", QT_TRANSLATE_NOOP("gestures", "Heart in 3D")},
      {"camera", QT_TRANSLATE_NOOP("gestures", "Camera")},
      {"panel", QT_TRANSLATE_NOOP("gestures", "Panels")},
      {"mouse", QT_TRANSLATE_NOOP("gestures", "Mouse by keys")},
      {"plugin", QT_TRANSLATE_NOOP("gestures", "Plug-ins")},
      {"plugins", QT_TRANSLATE_NOOP("gestures", "Plug-ins")},
      {"report", QT_TRANSLATE_NOOP("gestures", "Report")},
      {"qa", QT_TRANSLATE_NOOP("gestures", "Quality")},
      {"help", QT_TRANSLATE_NOOP("gestures", "Help")},
  };
  const char* text = groups.value(id.section('.', 0, 0), nullptr);
  return text ? gestures(text) : id.section('.', 0, 0);
}

QString plain_text(QString text) {
  text.remove(QStringLiteral("\u2026"));
  text.replace("&&", QChar(1));
  text.remove('&');
  text.replace(QChar(1), '&');
  return text;
}

std::vector<MouseGesture> mouse_gestures() {
  struct Row {
    const char *where, *gesture, *does;
  };
  static const std::vector<Row> rows{
      {QT_TRANSLATE_NOOP("gestures", "2D views"), QT_TRANSLATE_NOOP("gestures", "left button"),
       QT_TRANSLATE_NOOP("gestures", "what the tool says; browsing: the cursor goes there")},
      {QT_TRANSLATE_NOOP("gestures", "CPR, section, oblique slice"),
       QT_TRANSLATE_NOOP("gestures", "Shift and left button, drag"),
       QT_TRANSLATE_NOOP("gestures", "turn about the vessel's axis, or the slice")},
      {QT_TRANSLATE_NOOP("gestures", "2D views"), QT_TRANSLATE_NOOP("gestures", "right button, drag"),
       QT_TRANSLATE_NOOP("gestures", "window and level")},
      {QT_TRANSLATE_NOOP("gestures", "2D views"),
       QT_TRANSLATE_NOOP("gestures", "middle button, drag; or Ctrl and Shift and left button"),
       QT_TRANSLATE_NOOP("gestures", "move the picture")},
      {QT_TRANSLATE_NOOP("gestures", "CPR, section"), QT_TRANSLATE_NOOP("gestures", "wheel"),
       QT_TRANSLATE_NOOP("gestures", "the cursor goes along the vessel")},
      {QT_TRANSLATE_NOOP("gestures", "slice"), QT_TRANSLATE_NOOP("gestures", "wheel"),
       QT_TRANSLATE_NOOP("gestures", "the next slices")},
      {QT_TRANSLATE_NOOP("gestures", "three planes"), QT_TRANSLATE_NOOP("gestures", "a ring on a line, drag"),
       QT_TRANSLATE_NOOP("gestures", "turn the other two planes")},
      {QT_TRANSLATE_NOOP("gestures", "three planes"),
       QT_TRANSLATE_NOOP("gestures", "a dot on a slab's border, drag; Shift and wheel"),
       QT_TRANSLATE_NOOP("gestures", "the thickness of the slab")},
      {QT_TRANSLATE_NOOP("gestures", "2D views"), QT_TRANSLATE_NOOP("gestures", "Ctrl and wheel"),
       QT_TRANSLATE_NOOP("gestures", "zoom")},
      {QT_TRANSLATE_NOOP("gestures", "2D views, editing"), QT_TRANSLATE_NOOP("gestures", "Shift and wheel"),
       QT_TRANSLATE_NOOP("gestures", "the reach of a pull, the size of the ball")},
      {QT_TRANSLATE_NOOP("gestures", "2D views"), QT_TRANSLATE_NOOP("gestures", "a handle, drag"),
       QT_TRANSLATE_NOOP("gestures", "move a measurement's point")},
      {QT_TRANSLATE_NOOP("gestures", "2D views, centerline"), QT_TRANSLATE_NOOP("gestures", "double click"),
       QT_TRANSLATE_NOOP("gestures", "another control point")},
      {QT_TRANSLATE_NOOP("gestures", "2D views"), QT_TRANSLATE_NOOP("gestures", "key Delete"),
       QT_TRANSLATE_NOOP("gestures", "the measurement or control point under the mouse goes")},
      {QT_TRANSLATE_NOOP("gestures", "2D views"), QT_TRANSLATE_NOOP("gestures", "key Esc"),
       QT_TRANSLATE_NOOP("gestures", "what is begun is dropped; then: browsing")},
      {QT_TRANSLATE_NOOP("gestures", "2D views"), QT_TRANSLATE_NOOP("gestures", "keys Up, Down, Page"),
       QT_TRANSLATE_NOOP("gestures", "as the wheel, by one or ten steps")},
      {QT_TRANSLATE_NOOP("gestures", "2D views"), QT_TRANSLATE_NOOP("gestures", "keys +, - and 0"),
       QT_TRANSLATE_NOOP("gestures", "zoom, and all of it")},
      {QT_TRANSLATE_NOOP("gestures", "tree"), QT_TRANSLATE_NOOP("gestures", "left button, drag"),
       QT_TRANSLATE_NOOP("gestures", "turn")},
      {QT_TRANSLATE_NOOP("gestures", "tree"), QT_TRANSLATE_NOOP("gestures", "middle button, or Shift, drag"),
       QT_TRANSLATE_NOOP("gestures", "move")},
      {QT_TRANSLATE_NOOP("gestures", "tree"), QT_TRANSLATE_NOOP("gestures", "wheel, or right button, drag"),
       QT_TRANSLATE_NOOP("gestures", "zoom")},
      {QT_TRANSLATE_NOOP("gestures", "tree"), QT_TRANSLATE_NOOP("gestures", "click on a vessel"),
       QT_TRANSLATE_NOOP("gestures", "this vessel, and the cursor goes there")},
      {QT_TRANSLATE_NOOP("gestures", "tree, measuring"), QT_TRANSLATE_NOOP("gestures", "click on a vessel"),
       QT_TRANSLATE_NOOP("gestures", "place a measurement, or its next point, on the wall")},
      {QT_TRANSLATE_NOOP("gestures", "tree"),
       QT_TRANSLATE_NOOP("gestures", "a handle of the selected measurement, drag"),
       QT_TRANSLATE_NOOP("gestures", "move it over the wall")},
      {QT_TRANSLATE_NOOP("gestures", "tree"), QT_TRANSLATE_NOOP("gestures", "key Delete"),
       QT_TRANSLATE_NOOP("gestures", "the measurement under the mouse goes, or the selected one")},
      {QT_TRANSLATE_NOOP("gestures", "tree"), QT_TRANSLATE_NOOP("gestures", "double click"),
       QT_TRANSLATE_NOOP("gestures", "all of the tree")},
      {QT_TRANSLATE_NOOP("gestures", "tree"), QT_TRANSLATE_NOOP("gestures", "arrow keys, +, - and 0"),
       QT_TRANSLATE_NOOP("gestures", "turn, zoom, and all of it")},
      {QT_TRANSLATE_NOOP("gestures", "lumen profile"), QT_TRANSLATE_NOOP("gestures", "click, or drag"),
       QT_TRANSLATE_NOOP("gestures", "the cursor goes there")},
      {QT_TRANSLATE_NOOP("gestures", "lumen profile"),
       QT_TRANSLATE_NOOP("gestures", "wheel, or keys Left and Right"),
       QT_TRANSLATE_NOOP("gestures", "the cursor goes along the vessel")},
      {QT_TRANSLATE_NOOP("gestures", "panel's title"), QT_TRANSLATE_NOOP("gestures", "double click"),
       QT_TRANSLATE_NOOP("gestures", "this panel alone, and back")},
      {QT_TRANSLATE_NOOP("gestures", "vessel list"),
       QT_TRANSLATE_NOOP("gestures", "right click, or menu key"),
       QT_TRANSLATE_NOOP("gestures", "rename, colour, cut off, split, cut, delete, join, connect")},
      {QT_TRANSLATE_NOOP("gestures", "vessel list"), QT_TRANSLATE_NOOP("gestures", "keys F2, Space, Delete"),
       QT_TRANSLATE_NOOP("gestures", "another name, tick, delete")},
  };
  std::vector<MouseGesture> made;
  for (const Row& row : rows)
    made.push_back({gestures(row.where), gestures(row.gesture), gestures(row.does)});
  return made;
}

}  // namespace ostia::workstation
