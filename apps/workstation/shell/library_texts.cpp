#include "shell/library_texts.h"

#include "ostia/core/phrasebook.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <utility>

namespace ostia::workstation {
namespace {

// Places in them: see core/phrasebook.h.
constexpr const char* sentences[] = {
    // The search for the arteries.
    QT_TRANSLATE_NOOP(
        "library",
        "no coronary artery was found where one should leave the aorta: the root may lie outside "
        "of the image, or the arteries hold too little contrast; draw a first vessel by its two "
        "ends"),
    QT_TRANSLATE_NOOP(
        "library",
        "nothing that looks like an artery goes on from where one leaves the aorta; draw a first "
        "vessel by its two ends"),
    QT_TRANSLATE_NOOP("library",
                      "what was found has %1 branches, more than coronary arteries show: the image is too "
                      "noisy (a deviation of %2 HU in the aorta, in cubes of 1.5 mm) or veins and muscle are "
                      "as bright as arteries; take a smoother reconstruction, or draw a first vessel by its "
                      "two ends"),
    QT_TRANSLATE_NOOP("library",
                      "no ascending aorta was found (an upright, evenly enhanced tube of %1 to %2 mm radius "
                      "above %3 HU, at least %4 mm long): %t5; draw a first vessel by its two ends instead"),
    QT_TRANSLATE_NOOP("library",
                      "no ascending aorta was found (an upright, evenly enhanced tube of %1 to %2 mm radius "
                      "above %3 HU, at least %4 mm long): %t5; draw a first vessel by its two ends instead; "
                      "%l6"),
    QT_TRANSLATE_NOOP("library",
                      "the brightest even region of %1 ml has %2, as blood without contrast agent: take the "
                      "angiogram of this patient"),
    QT_TRANSLATE_NOOP("library",
                      "contrast is there (%1): the top of the heart may be cut off, or the image may be "
                      "turned; look at its orientation"),
    QT_TRANSLATE_NOOP(
        "library",
        "the heart's chambers lie %1 mm above the middle of the aorta that was found, not below "
        "it: the image ends above the aortic root, stands on its head, or has its slices in the "
        "wrong order; take an image of the whole heart, set its orientation right, or draw a "
        "first vessel by its two ends"),
    QT_TRANSLATE_NOOP("library", "%l1; besides, %l2"),
    QT_TRANSLATE_NOOP("library",
                      "the lungs lie in front and behind, not at the sides: x and y may be exchanged, or the "
                      "image be turned by 90 degrees; no vessel was given a name; look at the image's "
                      "orientation first"),
    QT_TRANSLATE_NOOP(
        "library",
        "voxels of %1 mm are wide for coronary arteries: those below 2 mm are missed, and names "
        "and radii are less sure"),
    QT_TRANSLATE_NOOP(
        "library",
        "%1 ml of metal (above %2 HU): look at each vessel that passes near it, its shadows may "
        "cut or fake vessels"),
    QT_TRANSLATE_NOOP("library", "no upright tube of contrast is there"),
    QT_TRANSLATE_NOOP("library",
                      "the longest upright tube has a radius of %1 mm and %2 HU and is not even enough"),
    QT_TRANSLATE_NOOP("library",
                      "the longest upright tube has a radius of %1 mm and %2 HU, and lung behind it as the "
                      "descending aorta has"),
    QT_TRANSLATE_NOOP("library", "no branch of the coronary tree could be followed: %l1"),
    QT_TRANSLATE_NOOP(
        "library",
        "the image is too small to hold the root of the aorta: %1 voxels, %2 mm along one of its "
        "axes; %3 mm and %4 voxels are needed"),
    QT_TRANSLATE_NOOP(
        "library",
        "voxels of %1 mm are wider than coronary arteries, which are 2 to 4 mm wide (at most %2 "
        "mm can be used); take a series with thinner slices, or draw a first vessel by its two "
        "ends where you see one"),
    QT_TRANSLATE_NOOP(
        "library",
        "voxels of %1 mm are wider than coronary arteries, which are 2 to 4 mm wide (at most %2 "
        "mm can be used); take a series with thinner slices, or draw a first vessel by its two "
        "ends where you see one; %l3"),
    QT_TRANSLATE_NOOP("library", "the image is empty: every voxel is %1; take another image"),
    QT_TRANSLATE_NOOP("library",
                      "the image is noise: places %1 mm apart have nothing in common (correlation %2); take "
                      "another reconstruction"),
    QT_TRANSLATE_NOOP("library",
                      "the intensities lie from %1 to %2 only, these are no CT numbers (in HU fat is about "
                      "-100, blood with contrast agent 250 to 600): the image may have been scaled; convert "
                      "it back to HU"),
    QT_TRANSLATE_NOOP(
        "library",
        "the intensities lie from %1 to %2, far beyond CT numbers (in HU fat is about -100, "
        "blood with contrast agent 250 to 600): the image may have been scaled; convert it back "
        "to HU"),
    QT_TRANSLATE_NOOP(
        "library",
        "nothing in the image is darker than %1, so these are no CT numbers (in HU fat is about "
        "-100, blood with contrast agent 250 to 600): it may be a picture of 256 grey levels; "
        "convert it to HU"),
    QT_TRANSLATE_NOOP(
        "library",
        "nothing in the image is darker than %1, so these are no CT numbers (in HU fat is about "
        "-100, blood with contrast agent 250 to 600): 1024 may not have been subtracted (the "
        "rescale intercept); convert it to HU"),
    QT_TRANSLATE_NOOP("library",
                      "the image is darker than a CT in HU can be (nothing in it is brighter than %1): 1024 "
                      "may have been subtracted twice, or the image scaled; convert it to HU"),
    QT_TRANSLATE_NOOP("library",
                      "the image is darker than a CT in HU can be (%1 % lie below air, -1000): 1024 may have "
                      "been subtracted twice, or the image scaled; convert it to HU"),
    QT_TRANSLATE_NOOP("library",
                      "nothing in the image is darker than %1, though %2 % of it is as dark as lung may be: "
                      "lungs have -700 to -900 HU and air -1000, so the image may have been scaled; convert "
                      "it back to HU"),
    QT_TRANSLATE_NOOP("library",
                      "the image shows no chest: it holds hardly any lung (%1 % of %2 mm), as abdomen, head "
                      "or legs do; take an image of the heart, or draw a first vessel by its two ends where "
                      "you see one"),
    // A vessel by clicks.
    QT_TRANSLATE_NOOP("library",
                      "there is no contrast along the way between the two places (%1 HU); click into the "
                      "vessel's lumen at both ends"),
    QT_TRANSLATE_NOOP("library",
                      "the two places are too near to each other for a vessel; choose them farther apart"),
    QT_TRANSLATE_NOOP("library",
                      "the way runs for %1 mm through something wider than a coronary artery, an aorta or a "
                      "chamber"),
    QT_TRANSLATE_NOOP("library",
                      "the way runs for %1 mm through something wider than a coronary artery, an aorta or a "
                      "chamber; click a place in the vessel itself that is nearer, or the ostium first"),
    QT_TRANSLATE_NOOP("library",
                      "both ends of the way, %1 and %2 mm, lie in air: click in the contrast-filled lumen"),
    QT_TRANSLATE_NOOP("library",
                      "the two ends of the way, %1 and %2 mm, are one place: click them further apart"),
    QT_TRANSLATE_NOOP(
        "library",
        "the click %1 mm lies inside vessel '%2', which is in the tree already: click the distal "
        "end of one that is not"),
    QT_TRANSLATE_NOOP("library", "no way from %1 mm to %t2: %l3"),
    QT_TRANSLATE_NOOP("library", "the front has covered the image"),
    QT_TRANSLATE_NOOP("library", "the click was moved by %1 mm onto the lumen"),
    // Edits, as `by_names` has them.
    QT_TRANSLATE_NOOP("library", "%1: its branches go, too: %2"),
    QT_TRANSLATE_NOOP("library", "%1: what leaves it beyond the cut goes, too: %2"),
    QT_TRANSLATE_NOOP("library", "%1: no vessel would be left; the last one stays"),
    QT_TRANSLATE_NOOP("library", "the ball did not touch the wall; nothing changed"),
    QT_TRANSLATE_NOOP("library", "the wall was dragged nowhere; nothing changed"),
    QT_TRANSLATE_NOOP("library",
                      "the wall was stopped %1 before the axis at %2 places; a wall never passes its axis"),
    QT_TRANSLATE_NOOP("library",
                      "the reach of %1 is shorter than one and a half times the wall's %2 between samples: "
                      "the wall follows as smoothly as they allow"),
    QT_TRANSLATE_NOOP("library",
                      "the pull on %1 starts %2 from the vessel's wall; take hold of the wall itself"),
    QT_TRANSLATE_NOOP("library", "the pull on %1 moves the wall by more than %2; drag it in steps"),
    QT_TRANSLATE_NOOP(
        "library",
        "the pull on %1 ends %2 from the axis; keep the wall at least %3 away, or move the axis "
        "first"),
    QT_TRANSLATE_NOOP("library",
                      "the line on %1 comes within %2 of the axis at %3 along the vessel; draw each side of "
                      "the wall by itself"),
    QT_TRANSLATE_NOOP(
        "library",
        "the line on %1 crosses the axis near %2 along the vessel; draw each side of the wall by itself"),
    QT_TRANSLATE_NOOP("library",
                      "the line on %1 crosses itself near %2 along the vessel; draw it without a loop"),
    QT_TRANSLATE_NOOP("library", "the line on %1 runs back along the vessel at %2; draw it in one direction"),
    // Cases.
    QT_TRANSLATE_NOOP("library", "cannot open the case %1: %l2"),
    QT_TRANSLATE_NOOP("library",
                      "its format %1 is newer than this program's (%2, Ostia %3); open it with Ostia %4 or "
                      "newer"),
    QT_TRANSLATE_NOOP("library",
                      "its format %1 is newer than this program's (%2, Ostia %3); open it with Ostia of a "
                      "newer version"),
    QT_TRANSLATE_NOOP("library", "the file is empty; take a copy of it from a backup"),
    QT_TRANSLATE_NOOP("library", "it is not a case of Ostia; cases are made by `ostia lumen --case`"),
    QT_TRANSLATE_NOOP("library", "it is a database of another program, not a case of Ostia"),
    QT_TRANSLATE_NOOP("library", "the file is truncated to %1 bytes"),
    QT_TRANSLATE_NOOP("library",
                      "the file is truncated: it has %1 of %2 bytes; take a copy of it from a backup"),
    QT_TRANSLATE_NOOP("library", "the file is damaged (%1); take a copy of it from a backup"),
    QT_TRANSLATE_NOOP(
        "library", "its tables are not those of a case; the file is damaged or was made by another program"),
    QT_TRANSLATE_NOOP("library",
                      "it is open in another window or program; close it there, or wait until it is done"),
    QT_TRANSLATE_NOOP("library", "it is open in another window of this program; close it there"),
    QT_TRANSLATE_NOOP("library",
                      "cannot write the case %1: the disk is full; the case is what it was before. Make room "
                      "and try again"),
    // Images.
    QT_TRANSLATE_NOOP("library", "%1 is no CT image: open an angiogram"),
    QT_TRANSLATE_NOOP("library", "cannot read %1: %l2"),
    QT_TRANSLATE_NOOP("library", "there is no such file or folder"),
    QT_TRANSLATE_NOOP("library", "it is neither a file nor a folder"),
    QT_TRANSLATE_NOOP("library",
                      "it is no DICOM folder, file or zip, no image (.nrrd .nhdr .mhd .mha .nii .nii.gz) and "
                      "no surface (.stl .ply .obj .vtp .vtk)"),
    QT_TRANSLATE_NOOP("library", "'%1' is not a DICOM file"),
    QT_TRANSLATE_NOOP("library", "'%1' is DICOM, but holds no image"),
    QT_TRANSLATE_NOOP("library", "'%1' is damaged: %l2"),
    QT_TRANSLATE_NOOP("library", "'%1' does not exist"),
    QT_TRANSLATE_NOOP("library", "'%1' of the series is gone; open its folder again"),
    QT_TRANSLATE_NOOP("library", "the files of DICOM series %1 have changed; open their folder again"),
    // Calcium and fat.
    QT_TRANSLATE_NOOP("library",
                      "some contrast agent may be in the blood: a fifth of the heart is brighter than %1 HU, "
                      "and blood without contrast agent has 30 to 60; look at each lesion"),
    QT_TRANSLATE_NOOP("library",
                      "calcium score: the blood has contrast agent (a fifth of the heart is brighter than %1 "
                      "HU, and blood without contrast agent has 30 to 60), which counts as calcium from 130 "
                      "HU on; take the scan without contrast agent"),
    QT_TRANSLATE_NOOP("library",
                      "a part of %1 ml on the heart, about %2 mm, is taken for no coronary calcium and not "
                      "scored; look whether some of it is"),
    QT_TRANSLATE_NOOP("library",
                      "no heart was found, so no place could be proposed: no lesion counts until a person "
                      "has said where it lies"),
    QT_TRANSLATE_NOOP("library",
                      "the slices lie %1 mm apart, and the Agatston score is defined for %2 mm: %3 of them "
                      "were averaged to one of %4 mm"),
    QT_TRANSLATE_NOOP("library",
                      "the slices lie %1 mm apart, and the Agatston score is defined for %2 mm: %3 of them "
                      "were averaged to one of %4 mm, and a slice's score is multiplied by %5"),
    QT_TRANSLATE_NOOP("library",
                      "the slices lie %1 mm apart, and the Agatston score is defined for %2 mm: a slice's "
                      "score is multiplied by %3"),
    QT_TRANSLATE_NOOP("library", "no vessel is named %1"),
    QT_TRANSLATE_NOOP("library", "%1: less than 5 mm of its range were measured"),
    QT_TRANSLATE_NOOP("library", "%1: %2 of %3 mm were measured"),
    QT_TRANSLATE_NOOP("library", "%1: no fat was found that is clear of edges"),
    QT_TRANSLATE_NOOP("library",
                      "the tube voltage is not known: fat is darker at less than 120 kV (by about a quarter "
                      "at 80), and bounds of studies hold for theirs"),
    QT_TRANSLATE_NOOP("library",
                      "the scan was taken at %1 kV: compare its values with those of other voltages only as "
                      "estimated at 120 kV"),
    // Networks of vessels.
    QT_TRANSLATE_NOOP("library",
                      "its branches are shorter on average than the least radius: are radii and places in "
                      "different units? `ostia convert --units m --radius-units mm` settles it"),
    // Two scans compared.
    QT_TRANSLATE_NOOP("library", "hardly one patient: %l1"),
    QT_TRANSLATE_NOOP("library",
                      "one of the trees is mirrored: as they are their axes are %1 mm apart, mirrored %2 mm"),
    QT_TRANSLATE_NOOP(
        "library",
        "the axes of the vessels with the same names are %1 mm apart when the trees lie on each "
        "other as well as they can (one patient's: up to %2 mm)"),
    QT_TRANSLATE_NOOP(
        "library",
        "half of the ostia and forks with the same names are %1 mm or more apart when the trees "
        "lie on each other as well as they can (one patient's: up to %2 mm)"),
    QT_TRANSLATE_NOOP("library",
                      "only %1 % of the shorter tree runs beside the other (one patient's: %2 % or more)"),
    QT_TRANSLATE_NOOP("library",
                      "no vessel has the same name in both trees, so that nothing says how they lie to each "
                      "other; name the vessels (RCA, LAD, LCX, ...) in both"),
    QT_TRANSLATE_NOOP("library", "%1 is not compared: less than half of it is in both trees"),
    QT_TRANSLATE_NOOP("library", "%1 is in the former tree alone"),
    QT_TRANSLATE_NOOP("library", "%1 is in the later tree alone"),
    QT_TRANSLATE_NOOP("library", "the former scan: %l1"),
    QT_TRANSLATE_NOOP("library", "the later scan: %l1"),
    QT_TRANSLATE_NOOP("library", "%1: %2 mm could not be measured, the wall does not close there"),
    QT_TRANSLATE_NOOP("library", "plaque is not compared: the image of the former case was not at hand"),
    QT_TRANSLATE_NOOP("library", "plaque is not compared: the image of the later case was not at hand"),
    QT_TRANSLATE_NOOP(
        "library",
        "the scans were taken at %1 and %2 kV: classes of plaque and the fat's CT number change "
        "with that alone"),
    QT_TRANSLATE_NOOP(
        "library", "no repeatability was given: differences are told, and none of them is called a change"),
    QT_TRANSLATE_NOOP("library", "the former case has no vessels; choose one with a coronary tree"),
    QT_TRANSLATE_NOOP("library", "the series of the former image is not in its folder any more"),
    QT_TRANSLATE_NOOP("library", "what was chosen is another image than that of the former case"),
    // Pressures.
    QT_TRANSLATE_NOOP("library", "%1 is %2; it is a number above 0"),
    QT_TRANSLATE_NOOP("library", "the diastolic pressure, %1 mmHg, is not below the systolic one, %2 mmHg"),
    QT_TRANSLATE_NOOP("library", "the venous pressure, %1 mmHg, is not below the mean aortic one, %2 mmHg"),
    QT_TRANSLATE_NOOP("library", "no outlet of the tree has a diameter; its share of the flow is not known"),
    QT_TRANSLATE_NOOP("library", "no root of the tree has a diameter; its flow is not known"),
};

core::Phrasebook& book() {
  static core::Phrasebook made;
  return made;
}

/// Libraries name an edit and its vessel for those who write scripts, "branch.delete on vessel 7 (RCA)": who
/// made it by hand reads "RCA", and of what was drawn what it was.
std::string by_names(const std::string& text) {
  static const std::pair<QRegularExpression, const char*> names[] = {
      {QRegularExpression(QStringLiteral("\\bvessel \\d+ \\(([^()]+)\\)")), "\\1"},
      {QRegularExpression(QStringLiteral("\\b(axis|branch|vessel)\\.[a-z_]+ on ")), ""},
      {QRegularExpression(QStringLiteral("\\bwall\\.drag on ")), "the pull on "},
      {QRegularExpression(QStringLiteral("\\bwall\\.push on ")), "the brush on "},
      {QRegularExpression(QStringLiteral("\\bcpr\\.stroke on ")), "the line on "},
      {QRegularExpression(QStringLiteral("\\bsection\\.contour on ")), "the contour on "},
      {QRegularExpression(QStringLiteral(", or use section\\.contour$")), ""}};
  QString said = QString::fromStdString(text);
  for (const auto& [name, now] : names) said.replace(name, QString::fromLatin1(now));
  return said.toStdString();
}

}  // namespace

std::vector<std::string> library_sentences() {
  return {std::begin(sentences), std::end(sentences)};
}

void use_library_language() {
  std::vector<core::Phrase> phrases;
  for (const char* one : sentences) {
    const QString said = QCoreApplication::translate("library", one);
    if (said != QLatin1String(one)) phrases.push_back({one, said.toStdString()});
  }
  book() = core::Phrasebook(phrases);
}

QString library_text(const std::string& text) {
  return QString::fromStdString(book().say(by_names(text)));
}

}  // namespace ostia::workstation
