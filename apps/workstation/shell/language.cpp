#include "shell/language.h"

#include "shell/library_texts.h"

#include "ostia/view/words.h"

#include <QApplication>
#include <QLibraryInfo>
#include <QLocale>
#include <QTranslator>
#include <algorithm>

// Outside of any namespace: what rcc makes is there.
static void init_translations() {
  Q_INIT_RESOURCE(ostia_translations);
}

namespace ostia::workstation {
namespace {

// Qt's own texts that dialogs of ours show, where Qt's translations are not installed.
[[maybe_unused]] const char* const texts_of_qt[] = {
    QT_TRANSLATE_NOOP("QPlatformTheme", "OK"),    QT_TRANSLATE_NOOP("QPlatformTheme", "Save"),
    QT_TRANSLATE_NOOP("QPlatformTheme", "Open"),  QT_TRANSLATE_NOOP("QPlatformTheme", "&Yes"),
    QT_TRANSLATE_NOOP("QPlatformTheme", "&No"),   QT_TRANSLATE_NOOP("QPlatformTheme", "Cancel"),
    QT_TRANSLATE_NOOP("QPlatformTheme", "Close"), QT_TRANSLATE_NOOP("QPlatformTheme", "Discard"),
    QT_TRANSLATE_NOOP("QPlatformTheme", "Apply"), QT_TRANSLATE_NOOP("QPlatformTheme", "Reset"),
    QT_TRANSLATE_NOOP("QPlatformTheme", "Help"),  QT_TRANSLATE_NOOP("QShortcut", "Ctrl"),
    QT_TRANSLATE_NOOP("QShortcut", "Shift"),      QT_TRANSLATE_NOOP("QShortcut", "Alt"),
    QT_TRANSLATE_NOOP("QShortcut", "Esc"),        QT_TRANSLATE_NOOP("QShortcut", "Space"),
    QT_TRANSLATE_NOOP("QShortcut", "Up"),         QT_TRANSLATE_NOOP("QShortcut", "Down"),
    QT_TRANSLATE_NOOP("QShortcut", "Left"),       QT_TRANSLATE_NOOP("QShortcut", "Right"),
    QT_TRANSLATE_NOOP("QShortcut", "Home"),       QT_TRANSLATE_NOOP("QShortcut", "End"),
    QT_TRANSLATE_NOOP("QShortcut", "Ins"),        QT_TRANSLATE_NOOP("QShortcut", "Del"),
    QT_TRANSLATE_NOOP("QShortcut", "Tab"),        QT_TRANSLATE_NOOP("QKeySequenceEdit", "Press shortcut"),
};

[[maybe_unused]] const char* const texts_of_analysis[] = {
    QT_TRANSLATE_NOOP("measures", "distance"),
    QT_TRANSLATE_NOOP("measures", "angle"),
    QT_TRANSLATE_NOOP("measures", "area"),
    QT_TRANSLATE_NOOP("measures", "diameter"),
    QT_TRANSLATE_NOOP("measures", "stenosis"),
    QT_TRANSLATE_NOOP("measures", "volume"),
    QT_TRANSLATE_NOOP("measures", "ring_hu"),
    QT_TRANSLATE_NOOP("measures", "arrow"),
    QT_TRANSLATE_NOOP("measures", "note"),
    QT_TRANSLATE_NOOP("measures", "length"),
    QT_TRANSLATE_NOOP("measures", "perimeter"),
    QT_TRANSLATE_NOOP("measures", "percent diameter"),
    QT_TRANSLATE_NOOP("measures", "percent area"),
    QT_TRANSLATE_NOOP("measures", "MLD"),
    QT_TRANSLATE_NOOP("measures", "MLA"),
    QT_TRANSLATE_NOOP("measures", "reference diameter"),
    QT_TRANSLATE_NOOP("measures", "reference area"),
    QT_TRANSLATE_NOOP("measures", "mean area"),
    QT_TRANSLATE_NOOP("measures", "mean"),
    QT_TRANSLATE_NOOP("measures", "SD"),
    QT_TRANSLATE_NOOP("measures", "least"),
    QT_TRANSLATE_NOOP("measures", "largest"),
    QT_TRANSLATE_NOOP("measures", "samples"),
};

// Stages of jobs, which the libraries name.
[[maybe_unused]] const char* const texts_of_jobs[] = {
    QT_TRANSLATE_NOOP("stages", "reading DICOM headers"),
    QT_TRANSLATE_NOOP("stages", "decoding DICOM"),
    QT_TRANSLATE_NOOP("stages", "resampling DICOM"),
    QT_TRANSLATE_NOOP("stages", "unpacking"),
    QT_TRANSLATE_NOOP("stages", "synthetic patient"),
    QT_TRANSLATE_NOOP("stages", "scan"),
    QT_TRANSLATE_NOOP("stages", "writing"),
    QT_TRANSLATE_NOOP("stages", "writing the image"),
    QT_TRANSLATE_NOOP("stages", "walls of the vessels"),
    QT_TRANSLATE_NOOP("stages", "lumen boundary"),
    QT_TRANSLATE_NOOP("stages", "surface"),
    QT_TRANSLATE_NOOP("stages", "measuring"),
    QT_TRANSLATE_NOOP("stages", "key images"),
    QT_TRANSLATE_NOOP("stages", "report"),
    QT_TRANSLATE_NOOP("stages", "finding the way to the tree"),
    QT_TRANSLATE_NOOP("stages", "finding the way between two points"),
};

// Names of window presets, which the session has.
[[maybe_unused]] const char* const texts_of_session[] = {
    QT_TRANSLATE_NOOP("presets", "CTA"),
    QT_TRANSLATE_NOOP("presets", "Soft tissue"),
    QT_TRANSLATE_NOOP("presets", "Lung"),
    QT_TRANSLATE_NOOP("presets", "Bone"),
};

std::string word(const char* text) {
  return QCoreApplication::translate("views", text).toStdString();
}

view::Words words_of_views() {
  view::Words words;
  words.straightened = word(QT_TRANSLATE_NOOP("views", "straightened"));
  words.stretched = word(QT_TRANSLATE_NOOP("views", "stretched"));
  words.axial = word(QT_TRANSLATE_NOOP("views", "axial"));
  words.coronal = word(QT_TRANSLATE_NOOP("views", "coronal"));
  words.sagittal = word(QT_TRANSLATE_NOOP("views", "sagittal"));
  words.oblique = word(QT_TRANSLATE_NOOP("views", "oblique"));
  words.slab_mean = word(QT_TRANSLATE_NOOP("views", "mean"));
  words.slab_maximum = word(QT_TRANSLATE_NOOP("views", "MIP"));
  words.slab_minimum = word(QT_TRANSLATE_NOOP("views", "MinIP"));
  words.diameter = word(QT_TRANSLATE_NOOP("views", "diameter, mm"));
  words.area = word(QT_TRANSLATE_NOOP("views", "area, mm\302\262"));
  words.from_root = word(QT_TRANSLATE_NOOP("views", "mm from its root"));
  words.outer_wall = word(QT_TRANSLATE_NOOP("views", "outer wall"));
  words.low_attenuation = word(QT_TRANSLATE_NOOP("views", "low attenuation"));
  words.fibrofatty = word(QT_TRANSLATE_NOOP("views", "fibrofatty"));
  words.fibrous = word(QT_TRANSLATE_NOOP("views", "fibrous"));
  words.calcified = word(QT_TRANSLATE_NOOP("views", "calcified"));
  words.evaluable = word(QT_TRANSLATE_NOOP("views", "evaluable"));
  words.limited = word(QT_TRANSLATE_NOOP("views", "limited"));
  words.not_evaluable = word(QT_TRANSLATE_NOOP("views", "not evaluable"));
  words.by_reader = word(QT_TRANSLATE_NOOP("views", "reader"));
  words.reasons = {word(QT_TRANSLATE_NOOP("views", "the image ends")),
                   word(QT_TRANSLATE_NOOP("views", "voxels too coarse for its calibre")),
                   word(QT_TRANSLATE_NOOP("views", "hardly brighter than the noise")),
                   word(QT_TRANSLATE_NOOP("views", "no clear edge")),
                   word(QT_TRANSLATE_NOOP("views", "calcium hides the lumen")),
                   word(QT_TRANSLATE_NOOP("views", "the edge is blurred"))};
  words.image = word(QT_TRANSLATE_NOOP("views", "image"));
  words.tree = word(QT_TRANSLATE_NOOP("views", "tree"));
  words.kinds = {word(QT_TRANSLATE_NOOP("views", "Distance")), word(QT_TRANSLATE_NOOP("views", "Angle")),
                 word(QT_TRANSLATE_NOOP("views", "Area")),     word(QT_TRANSLATE_NOOP("views", "Diameter")),
                 word(QT_TRANSLATE_NOOP("views", "Stenosis")), word(QT_TRANSLATE_NOOP("views", "Volume")),
                 word(QT_TRANSLATE_NOOP("views", "HU ring")),  word(QT_TRANSLATE_NOOP("views", "Arrow")),
                 word(QT_TRANSLATE_NOOP("views", "Note"))};
  words.ffr = word(QT_TRANSLATE_NOOP("views", "FFR (research)"));
  words.what_if = word(QT_TRANSLATE_NOOP("views", "what if"));
  words.not_measurable = word(QT_TRANSLATE_NOOP("views", "not measurable"));
  words.off_wall = word(QT_TRANSLATE_NOOP("views", "There is no vessel: click on the wall of one."));
  words.other_vessel =
      word(QT_TRANSLATE_NOOP("views", "This is another vessel: both places have to lie along one."));
  words.no_lumen = word(
      QT_TRANSLATE_NOOP("views", "The lumen is shut or open here: there is nothing to measure across it."));
  return words;
}

void install(const QString& file, const QString& folder) {
  auto* translator = new QTranslator(qApp);
  if (translator->load(file, folder))
    QCoreApplication::installTranslator(translator);
  else
    delete translator;
}

QString& in_use() {
  static QString code = QStringLiteral("en");
  return code;
}

}  // namespace

QString language_in_use() {
  return in_use();
}

const std::vector<Language>& languages() {
  static const std::vector<Language> all{{"en", "English"}, {"de", "Deutsch"}};
  return all;
}

QString chosen_language(const std::optional<std::string>& setting, const QStringList& system) {
  QStringList wishes = system;
  if (setting && !setting->empty()) wishes.prepend(QString::fromStdString(*setting));
  for (const QString& wish : wishes)
    for (const Language& one : languages())
      if (wish == one.code || wish.startsWith(one.code + '-') || wish.startsWith(one.code + '_'))
        return one.code;
  return languages().front().code;
}

QString use_language(const std::optional<std::string>& setting) {
  init_translations();
  const QString code = chosen_language(setting, QLocale::system().uiLanguages());
  QLocale numbers = QLocale::c();
  numbers.setNumberOptions(QLocale::OmitGroupSeparator);
  QLocale::setDefault(numbers);
  if (code != languages().front().code)
    install("qtbase_" + code, QLibraryInfo::location(QLibraryInfo::TranslationsPath));
  install("ostia_" + code, ":/translations");  // of English the plurals
  view::set_words(words_of_views());
  use_library_language();
  in_use() = code;
  return code;
}

QString measure_word(const std::string& name) {
  return QCoreApplication::translate("measures", name.c_str());
}

QString stage_word(const std::string& stage) {
  const std::size_t end = std::min(stage.find(": "), stage.size());  // figures follow the words
  return QCoreApplication::translate("stages", stage.substr(0, end).c_str()) +
         QString::fromStdString(stage.substr(end));
}

}  // namespace ostia::workstation
