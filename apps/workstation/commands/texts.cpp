#include "commands/texts.h"

#include <QCoreApplication>
#include <QMap>

namespace ostia::workstation {
namespace {

QString tips(const char* text) {
  return QCoreApplication::translate("tips", text);
}
QString gestures(const char* text) {
  return QCoreApplication::translate("gestures", text);
}

const QMap<QString, const char*>& tip_table() {
  static const QMap<QString, const char*> all{
      {"file.open", QT_TRANSLATE_NOOP("tips",
                                      "Opens a case, an image file, or a zip of DICOM files; dropping it on "
                                      "the window does the same.")},
      {"file.open_folder", QT_TRANSLATE_NOOP("tips", "Looks for CT series in a folder of DICOM files.")},
      {"file.sample",
       QT_TRANSLATE_NOOP("tips", "Opens a computed patient with disease, made on the first use.")},
      {"file.save_as",
       QT_TRANSLATE_NOOP("tips", "Makes a copy of the case and goes on in it. A case is always saved.")},
      {"file.close", QT_TRANSLATE_NOOP("tips", "Closes the case; nothing is lost.")},
      {"file.report",
       QT_TRANSLATE_NOOP("tips", "Makes the report of the case as it is now, in a folder beside it.")},
      {"file.pin",
       QT_TRANSLATE_NOOP("tips", "The view that was clicked last becomes a key image of the next report.")},
      {"file.export_surface",
       QT_TRANSLATE_NOOP("tips", "Makes a surface of the wall (VTP, STL, PLY) in the background.")},
      {"file.export_mesh",
       QT_TRANSLATE_NOOP("tips", "Fills the lumen with tetrahedra for a solver, in the background.")},
      {"file.flow_case",
       QT_TRANSLATE_NOOP("tips", "Writes a case of blood flow in a mesh for a solver, and runs it.")},
      {"file.open_mesh",
       QT_TRANSLATE_NOOP("tips", "Shows a mesh made earlier, here or elsewhere, and how good it is.")},
      {"file.flow_results",
       QT_TRANSLATE_NOOP("tips", "Colours the wall in 3D by a solver's result, such as its shear stress.")},
      {"file.motion",
       QT_TRANSLATE_NOOP("tips", "Shows the case beating: a motion that was fitted to its phases.")},
      {"file.export_centerlines",
       QT_TRANSLATE_NOOP("tips", "Writes the centerlines with their radii (VTP).")},
      {"file.quit", QT_TRANSLATE_NOOP("tips", "Ends the program; nothing is lost.")},
      {"edit.undo", QT_TRANSLATE_NOOP("tips", "Takes the last step back.")},
      {"edit.redo", QT_TRANSLATE_NOOP("tips", "Does again what was taken back.")},
      {"edit.preferences", QT_TRANSLATE_NOOP("tips", "Keys, theme and language.")},
      {"vessel.find",
       QT_TRANSLATE_NOOP("tips", "Finds aorta, ostia and arteries in the image, and names them.")},
      {"vessel.split", QT_TRANSLATE_NOOP("tips",
                                         "Makes two vessels of this one; the second begins at the cursor "
                                         "and takes the side branches from there on.")},
      {"vessel.merge", QT_TRANSLATE_NOOP("tips",
                                         "Makes this vessel part of the one from whose end it goes on; "
                                         "takes a split back.")},
      {"vessel.cut", QT_TRANSLATE_NOOP("tips",
                                       "Cuts the vessel in two; what lies distal of the cursor, with its "
                                       "branches, is a tree of its own.")},
      {"vessel.connect", QT_TRANSLATE_NOOP("tips",
                                           "A new piece of vessel leads from the cursor to where the vessel "
                                           "that you choose begins.")},
      {"tool.smaller",
       QT_TRANSLATE_NOOP("tips", "Makes the brush's ball smaller, or the reach of a pull shorter.")},
      {"tool.larger",
       QT_TRANSLATE_NOOP("tips", "Makes the brush's ball larger, or the reach of a pull longer.")},
      {"view.turn_left",
       QT_TRANSLATE_NOOP("tips", "Turns both CPRs by five degrees about the vessel's axis.")},
      {"view.turn_right",
       QT_TRANSLATE_NOOP("tips", "Turns both CPRs by five degrees about the vessel's axis.")},
      {"view.proximal", QT_TRANSLATE_NOOP("tips", "The cursor goes half a millimetre towards the ostium.")},
      {"view.distal",
       QT_TRANSLATE_NOOP("tips", "The cursor goes half a millimetre towards the vessel's end.")},
      {"view.root", QT_TRANSLATE_NOOP("tips", "The cursor goes to where the vessel begins.")},
      {"view.end", QT_TRANSLATE_NOOP("tips", "The cursor goes to where the vessel ends.")},
      {"view.next_lesion",
       QT_TRANSLATE_NOOP("tips", "The cursor goes to the narrowest place of the next stenosis distally.")},
      {"view.previous_lesion",
       QT_TRANSLATE_NOOP("tips", "The cursor goes to the narrowest place of the next stenosis proximally.")},
      {"view.next_vessel", QT_TRANSLATE_NOOP("tips", "Shows the next vessel of the list.")},
      {"view.previous_vessel", QT_TRANSLATE_NOOP("tips", "Shows the previous vessel of the list.")},
      {"view.stretched",
       QT_TRANSLATE_NOOP("tips", "The CPRs keep the vessel's bends in one direction instead of none.")},
      {"view.mip",
       QT_TRANSLATE_NOOP("tips", "2D views show the largest CT number within the slab's thickness.")},
      {"view.mean",
       QT_TRANSLATE_NOOP("tips", "2D views show the mean CT number within the slab's thickness.")},
      {"view.thinner", QT_TRANSLATE_NOOP("tips", "Makes the slab of the 2D views thinner.")},
      {"view.thicker", QT_TRANSLATE_NOOP("tips", "Makes the slab of the 2D views thicker.")},
      {"view.contours", QT_TRANSLATE_NOOP("tips", "Shows or hides the lumen's contour on all views.")},
      {"view.outer_wall",
       QT_TRANSLATE_NOOP(
           "tips",
           "Looks for the outer wall of the selected vessel, draws it on the 2D views and tells "
           "what plaque there is.")},
      {"view.plaque",
       QT_TRANSLATE_NOOP(
           "tips", "Colours what lies between lumen and outer wall on sections and CPRs by its class.")},
      {"view.play",
       QT_TRANSLATE_NOOP("tips", "Plays the phases of the heart in all views, or pauses; needs a motion.")},
      {"view.own_phase",
       QT_TRANSLATE_NOOP("tips", "Shows the phase that the case is of again, at which it can be edited.")},
      {"view.fit", QT_TRANSLATE_NOOP("tips", "All views show all there is.")},
      {"view.theme", QT_TRANSLATE_NOOP("tips", "Changes between the dark and the light theme.")},
      {"view.qa",
       QT_TRANSLATE_NOOP("tips", "Holds the case against contours that somebody else knows to be right.")},
      {"window.1", QT_TRANSLATE_NOOP("tips", "Grey levels for contrast-filled vessels.")},
      {"window.2", QT_TRANSLATE_NOOP("tips", "Grey levels for muscle, fat and thrombus.")},
      {"window.3", QT_TRANSLATE_NOOP("tips", "Grey levels for the lungs.")},
      {"window.4", QT_TRANSLATE_NOOP("tips", "Grey levels for bone and calcium.")},
      {"panel.next", QT_TRANSLATE_NOOP("tips", "The keyboard goes to the next panel.")},
      {"panel.previous", QT_TRANSLATE_NOOP("tips", "The keyboard goes to the previous panel.")},
      {"panel.alone",
       QT_TRANSLATE_NOOP("tips", "The panel with the keyboard fills the window; again: all panels.")},
      {"mouse.left", QT_TRANSLATE_NOOP("tips", "Moves the mouse pointer by one pixel; held down, faster.")},
      {"mouse.right", QT_TRANSLATE_NOOP("tips", "Moves the mouse pointer by one pixel; held down, faster.")},
      {"mouse.up", QT_TRANSLATE_NOOP("tips", "Moves the mouse pointer by one pixel; held down, faster.")},
      {"mouse.down", QT_TRANSLATE_NOOP("tips", "Moves the mouse pointer by one pixel; held down, faster.")},
      {"mouse.press",
       QT_TRANSLATE_NOOP("tips", "Presses the main mouse button and holds it; again: lets it go.")},
      {"help.manual", QT_TRANSLATE_NOOP("tips", "The user's manual; needs no network.")},
      {"help.shortcuts", QT_TRANSLATE_NOOP("tips", "All keys and mouse gestures, to be searched.")},
      {"help.tour", QT_TRANSLATE_NOOP("tips", "Goes through the parts of the window.")},
      {"help.about", QT_TRANSLATE_NOOP("tips", "Version, licences, and what the program is not.")},
  };
  return all;
}

}  // namespace

QString command_tip(const QString& id) {
  const char* text = tip_table().value(id, nullptr);
  return text ? tips(text) : QString();
}

QString command_group(const QString& id) {
  static const QMap<QString, const char*> groups{
      {"file", QT_TRANSLATE_NOOP("gestures", "File")},
      {"edit", QT_TRANSLATE_NOOP("gestures", "Edit")},
      {"vessel", QT_TRANSLATE_NOOP("gestures", "Vessel")},
      {"tool", QT_TRANSLATE_NOOP("gestures", "Tools")},
      {"tree", QT_TRANSLATE_NOOP("gestures", "Vessel tree")},
      {"view", QT_TRANSLATE_NOOP("gestures", "Views")},
      {"window", QT_TRANSLATE_NOOP("gestures", "Grey levels")},
      {"panel", QT_TRANSLATE_NOOP("gestures", "Panels")},
      {"mouse", QT_TRANSLATE_NOOP("gestures", "Mouse by keys")},
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
