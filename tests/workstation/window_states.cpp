#include "window_states.h"

#include "help/tour.h"
#include "measuring/lesions.h"
#include "measuring/list.h"
#include "measuring/reporting.h"
#include "qa/dock.h"
#include "shell/panel.h"
#include "tube_case.h"
#include "vessels/evaluability.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/lumen/edit.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <QAction>
#include <QComboBox>
#include <QCursor>
#include <QDialog>
#include <QIcon>
#include <QPushButton>
#include <QScreen>
#include <QStatusBar>
#include <QTabWidget>
#include <QTest>
#include <QTreeWidget>
#include <functional>
#include <map>
#include <set>

namespace ostia::workstation::testing {
namespace {

constexpr const char* font_folder = "/usr/share/fonts/truetype/dejavu";  // package fonts-dejavu-core
constexpr double window_states_narrowing = 0.5;
constexpr int settle_ms = 20000, looks_alike = 2, quiet_ms = 400;
constexpr int filled_ms = 150;  // the lists of an opened case

geometry::ContourSection true_section(const std::string& name, double from_mm, double to_mm, double larger) {
  const lumen::LumenModel model = tube_model(window_states_narrowing);
  const geometry::AxisCurve axis(model.tree.segments[0].axis);
  geometry::ContourSection out;
  out.section = name;
  out.vessel = "LAD";
  out.observer = "truth";
  for (double s = from_mm; s <= to_mm; s += 1.0) {
    geometry::Contour contour{s, {}};
    for (int i = 0; i < 48; ++i)
      contour.points.push_back(
          axis.place(s, 2 * M_PI * i / 48, larger * tube_radius(s, window_states_narrowing)));
    out.contours.push_back(contour);
  }
  return out;
}

template <class Widget>
Widget& child(QWidget& window, const char* name) {
  auto* found = window.findChild<Widget*>(name);
  if (!found) throw std::runtime_error(std::string("the window has no ") + name);
  return *found;
}

}  // namespace

void pin_fonts(const Folder& folder) {
  if (!std::filesystem::exists(std::string(font_folder) + "/DejaVuSans.ttf"))
    throw std::runtime_error(std::string(font_folder) +
                             "/DejaVuSans.ttf is missing: install fonts-dejavu-core");
  // Of the folder's fonts the two that the window is written in; outlines as they are, grey edges.
  const std::string text =
      std::string(R"(<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "fonts.dtd"><fontconfig>
<dir>)") +
      font_folder + "</dir><cachedir>" + (folder / "font-cache").string() + R"(</cachedir>
<selectfont><rejectfont><glob>*</glob></rejectfont><acceptfont>)" +
      "<glob>" + font_folder + "/DejaVuSans.ttf</glob><glob>" + font_folder +
      "/DejaVuSans-Bold.ttf</glob><glob>" + font_folder + R"(/DejaVuSansMono.ttf</glob>
</acceptfont></selectfont>
<match target="font"><edit name="antialias" mode="assign"><bool>true</bool></edit>
<edit name="hinting" mode="assign"><bool>false</bool></edit>
<edit name="hintstyle" mode="assign"><const>hintnone</const></edit>
<edit name="autohint" mode="assign"><bool>false</bool></edit>
<edit name="rgba" mode="assign"><const>none</const></edit>
<edit name="lcdfilter" mode="assign"><const>lcdnone</const></edit></match></fontconfig>)";
  const std::filesystem::path file = folder / "fonts.conf";
  core::write_file(file, text);
  qputenv("FONTCONFIG_FILE", file.string().c_str());
  qputenv("QT_FONT_DPI", "96");
  qputenv("OSTIA_NO_TOUR", "1");
  qputenv("TZ", "UTC");
  qputenv("SOURCE_DATE_EPOCH", "1767225600");  // at which steps are done
  for (const char* of_the_desktop :
       {"XDG_CURRENT_DESKTOP", "DESKTOP_SESSION", "QT_QPA_PLATFORMTHEME", "QT_STYLE_OVERRIDE"})
    qunsetenv(of_the_desktop);
}

void pin_look() {
  QFont font("DejaVu Sans", 9);
  font.setHintingPreference(QFont::PreferNoHinting);
  QApplication::setFont(font);
  QApplication::setCursorFlashTime(0);
  QIcon::setThemeSearchPaths({});
  QIcon::setThemeName("none");
  QApplication::setApplicationName("ostia");
  QApplication::setApplicationVersion("0.0.0");
}

Stage::Stage(const QSize& size) : size_(size) {
  imaging::write_image(folder_ / "image.nrrd", tube_image(window_states_narrowing));
  const session::ImageReference reference = session::image_reference(folder_ / "image.nrrd");
  session::CaseFile::create(folder_ / "tube.ostia", tube_model(window_states_narrowing), reference);
  session::MachineState(folder_ / "state").remember_image(reference.sha256, folder_ / "image.nrrd");
  window_ = std::make_unique<MainWindow>(folder_ / "state");
  window_->setGeometry(QRect(QPoint(0, 0), size));
  window_->show();
  window_->activateWindow();
  if (!QTest::qWaitForWindowActive(window_.get())) throw std::runtime_error("the window does not come up");
  const QRect screen = QGuiApplication::primaryScreen()->geometry();
  QCursor::setPos(screen.bottomRight());  // over no part of the window
}

Stage::~Stage() = default;

std::vector<std::string> window_states() {
  return {"empty", "case",   "light",  "editing",     "section_alone",    "profile_alone", "measuring",
          "steps", "truth",  "series", "preferences", "preferences_keys", "about",         "manual",
          "keys",  "report", "heart",  "tour",        "complaint",        "failure"};
}

void Stage::enter(const std::string& state) {
  const std::map<std::string, std::function<void()>> ways{
      {"empty", [] {}},
      {"case", [] {}},
      {"light", [this] { run("view.theme"); }},
      {"editing", [this] { edit(); }},
      {"section_alone", [this] { show_alone("section"); }},
      {"profile_alone", [this] { show_alone("profile"); }},
      {"measuring", [this] { measure(); }},
      {"steps", [this] { edit(), run("panel.steps"); }},
      {"truth", [this] { open_truth(); }},
      {"series", [this] { open_series(); }},
      {"preferences", [this] { run("edit.preferences"); }},
      {"preferences_keys",
       [this] {
         run("edit.preferences");
         child<QDialog>(*window_, "preferences").findChild<QTabWidget*>()->setCurrentIndex(1);
       }},
      {"about", [this] { run("help.about"); }},
      {"manual", [this] { run("help.manual"); }},
      {"keys", [this] { run("help.shortcuts"); }},
      {"report",
       [this] {
         std::filesystem::current_path(folder_ / ".");  // the dialog shows the folder's name: always the same
         window_->reporting().make_report_in("tube-report");
       }},
      {"heart",
       [this] {
         auto& mode = child<QComboBox>(*window_, "volume_mode");
         mode.setCurrentIndex(1);
         emit mode.activated(1);
         show_alone("tree");
       }},
      {"tour",
       [this] {
         run("help.tour");
         child<Tour>(*window_, "tour").go(2);
       }},
      {"orientation", [this] { run("file.orientation"); }},
      {"failure", [this] { window_->open(folder_ / "image.nrrd"); }},
      {"complaint",
       [this] {
         window_->complain("There is no file or folder lad-follow-up.ostia.", "The case cannot be opened");
       }},
  };
  const std::set<std::string> without_case{"empty",  "series", "preferences", "preferences_keys", "about",
                                           "manual", "keys",   "complaint",   "failure"};
  if (!without_case.count(state)) open_case();
  ways.at(state)();
  if (!wait_until([&] { return !window_->jobs().any(); }, 240000))
    throw std::runtime_error(state + ": the window does not get there");
  window_->statusBar()->clearMessage();
}

QImage Stage::settled() {
  QScreen* screen = QGuiApplication::primaryScreen();
  QImage last;
  int alike = 0;
  wait_until([&] { return window_->evaluability().idle() && window_->lesions().idle(); }, settle_ms);
  const bool quiet = wait_until(
      [&] {
        let_rest();
        const QImage now = screen->grabWindow(0, 0, 0, size_.width(), size_.height())
                               .toImage()
                               .convertToFormat(QImage::Format_RGB32);
        alike = now == last ? alike + 1 : 1;
        last = now;
        return alike >= looks_alike;
      },
      settle_ms);
  if (!quiet) throw std::runtime_error("the window goes on changing");
  return last;
}

void Stage::open_case() {
  window_->open(folder_ / "tube.ostia");
  if (!wait_until([&] {
        return window_->bench().has_case() && window_->bench().image().volume && !window_->jobs().any();
      }))
    throw std::runtime_error("the case was not opened");
  window_->bench().cursor_mm.set(16.0);
  let_work(filled_ms);
}

void Stage::run(const char* command) {
  child<QAction>(*window_, command).trigger();
  QApplication::processEvents();
}

void Stage::show_alone(const char* view) {
  for (QWidget* at = &child<QWidget>(*window_, view); at; at = at->parentWidget())
    if (auto* panel = qobject_cast<Panel*>(at)) {
      emit panel->maximise_wanted();
      return;
    }
  throw std::runtime_error(std::string(view) + " is in no panel");
}

void Stage::edit() {
  run("tool.axis");
  const auto axis = window_->bench().axis();
  lumen::WallDrag pull;
  pull.vessel = window_->bench().vessel.get();
  pull.from = axis->place(12.0, 0.0, tube_radius_mm);
  pull.to = axis->place(12.0, 0.0, 1.4 * tube_radius_mm);
  window_->bench().edit(pull);
}

void Stage::measure() {
  session::Workbench& bench = window_->bench();
  analysis::Measurement distance;
  distance.kind = analysis::MeasureKind::distance;
  distance.points = {{-3.0, 0.0, 16.0}, {4.0, 2.0, 16.0}};
  bench.annotate(session::MeasureAdd{distance});
  analysis::Measurement stenosis;
  stenosis.kind = analysis::MeasureKind::stenosis;
  stenosis.vessel = bench.vessel.get();
  stenosis.from_mm = 17.0;
  stenosis.to_mm = 31.0;
  bench.annotate(session::MeasureAdd{stenosis});
  auto& list = child<MeasurementList>(*window_, "measurements");
  if (!wait_until([&] { return list.topLevelItemCount() == 2; }, 3000))
    throw std::runtime_error("the measurements are not listed");
  list.expandAll();
}

void Stage::crowd() {
  session::Workbench& bench = window_->bench();
  imaging::ShownIdentity whose;
  whose.patient_name = "Schmidt-Hohenstein, Maria Theresia Elisabeth";
  whose.patient_id = "0815-4711";
  whose.study_date = "2024-03-01";
  whose.series_description = "Cor CTA 0.6 Bv40 BestDiast 75 %";
  window_->desk().identity.take(bench.image().reference.sha256, whose);
  measure();
  bench.place.set(bench.axis()->point(16.0));
  const auto add = [&](analysis::MeasureKind kind, const std::vector<geometry::Vec3>& points, double s_mm) {
    analysis::Measurement one;
    one.kind = kind;
    one.points = points;
    if (points.empty()) one.vessel = bench.vessel.get(), one.from_mm = s_mm, one.to_mm = s_mm + 6.0;
    bench.annotate(session::MeasureAdd{one});
  };
  using analysis::MeasureKind;
  add(MeasureKind::area, {{-3, -3, 16}, {3, -3, 16}, {3, 3, 16}, {-3, 3, 16}}, 0.0);
  add(MeasureKind::angle, {{-2, 1, 16}, {0, 0, 16}, {1, 3, 16}}, 0.0);
  add(MeasureKind::arrow, {{1.5, 0, 16}, {5, 5, 16}}, 0.0);
  add(MeasureKind::note, {{-4, 4, 16}}, 0.0);
  add(MeasureKind::volume, {}, 6.0);
  add(MeasureKind::ring_hu, {}, 12.0);
  run("view.mip");
  run("view.plaque");
  bench.grey.set({260.0, 910.0});
  wait_until([&] { return !window_->jobs().any() && window_->evaluability().idle(); }, 60000);
  let_work(quiet_ms);
  bench.grey.set({250.0, 900.0});  // told for a while
  let_rest();
}

void Stage::open_truth() {
  const std::filesystem::path file = folder_ / "truth.json";
  io::write_contours(file, {{true_section("s01", 5, 15, 1.1), true_section("s02", 20, 34, 0.9)}});
  QaDock& qa = window_->qa();
  qa.show();
  qa.open_truth(file);
  auto& list = child<QTreeWidget>(qa, "qa_sections");
  if (!wait_until([&] { return list.topLevelItemCount() == 2; }, 5000))
    throw std::runtime_error("the truth is not shown");
  child<QPushButton>(qa, "qa_next").click();
  let_work(quiet_ms);
  // The clock stands still at zero.
  if (qa.check().timer().running()) child<QPushButton>(qa, "qa_run").click();
  child<QPushButton>(qa, "qa_zero").click();
}

void Stage::open_series() {
  const std::filesystem::path all = folder_ / "series";
  std::filesystem::create_directories(all);
  imaging::DicomSeriesOptions options;
  options.series_description = "CTA 75 %";
  options.uid_seed = "first";
  imaging::write_dicom_series(all / "first", tube_image(window_states_narrowing), options);
  options.series_description = "CTA 40 %";
  options.uid_seed = "second";
  imaging::write_dicom_series(all / "second", tube_image(), options);
  // A slice of the second is missing.
  std::filesystem::remove(all / "second" / "CT0050.dcm");
  window_->open(all);
  if (!wait_until([&] { return window_->findChild<QDialog*>("series") != nullptr; }))
    throw std::runtime_error("the series are not shown");
}

}  // namespace ostia::workstation::testing
