// A whole session of a person with the program: from the sample case to the report, by keys and mouse of the
// X server, with a kill in the middle. What came of it is read from the files that the program leaves.

#include "real_program.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/io/centerline_file.h"
#include "ostia/session/case_file.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QJsonArray>
#include <QStandardPaths>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using analysis::MeasureKind;
using ::testing::ElementsAre;
using testing::go;
using testing::keys;
using testing::Program;
using testing::xdo;
using view::Vec3;

constexpr int sample_ms = 900000, opening_ms = 120000, answer_ms = 20000, job_ms = 600000;
constexpr double theta_deg = 10.0;  // two presses of the key that turns the CPRs
constexpr int pull_px = 6;

/// Asked ten times a second: what is asked reads files and starts xdotool.
template <class Done>
bool eventually(const Done& done, int most_ms) {
  return testing::wait_until(
      [&] {
        QTest::qWait(100);
        return done();
      },
      most_ms);
}

std::string text_of(const fs::path& path) {
  return core::read_file(path);
}

/// What the program's views show, from its case and where its frame log says they are: finds places of
/// the patient on the screen.
class Twin {
 public:
  Twin(session::CaseFile now, const fs::path& log) {
    bench.set_session(session::Session(std::move(now)));
    for (const auto& [name, shown] : {std::pair<const char*, view::PictureView*>("cpr1", &first),
                                      {"cpr2", &second},
                                      {"section", &section}}) {
      places[name] = testing::place(log, name);
      shown->set_size(places[name].width(), places[name].height(), 1.0);
    }
    // As the person came there: to the vessel, to its root, to the stenosis.
    bench.theta_deg.set(kept("view.theta_deg"));
    bench.vessel.set(static_cast<std::int32_t>(kept("view.vessel")));
    bench.cursor_mm.set(0.0);
    bench.cursor_mm.set(kept("view.cursor_mm"));
  }
  /// Of the case's settings.
  double kept(const char* key) const { return std::stod(bench.session().file().setting(key).value()); }
  double cursor_mm() const { return bench.cursor_mm.get(); }
  struct Wall {
    Vec3 place = Vec3::Zero();
    QPoint on_screen, outwards;  ///< where it is, and a place farther from the axis
  };
  /// The wall on a view, at an abscissa and an angle in the view's plane.
  Wall wall(const char* name, view::PictureView& shown, double s_mm, double at_deg) {
    const double radius = bench.section(bench.vessel.get(), s_mm)->diameter_mm / 2.0;
    const auto axis = bench.axis();
    const auto near = shown.project(axis->place(s_mm, at_deg * M_PI / 180.0, radius));
    const auto hit = shown.wall_near(near->px, 8.0);
    if (!hit) throw std::runtime_error(std::string("no wall on ") + name);
    const view::Vec2 way = (hit->px - shown.project(axis->point(s_mm))->px).normalized();
    return {hit->place, on_screen(name, hit->px), on_screen(name, hit->px + pull_px * way)};
  }
  QPoint on_screen(const char* name, const view::Vec2& px) const {
    return places.at(name).topLeft() +
           QPoint(static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())));
  }
  session::Workbench bench;
  std::shared_ptr<view::CurvedFrame> frame = std::make_shared<view::CurvedFrame>();
  view::CurvedView first{bench, view::CurvedView::Which::first, frame};
  view::CurvedView second{bench, view::CurvedView::Which::second, frame};
  view::SectionView section{bench, 0.0};
  std::map<std::string, QRect> places;
};

struct WholeSession : ::testing::Test {
  testing::Folder folder;
  const fs::path state = folder / "state", log = folder / "frames.jsonl", sample = state / "sample",
                 image = sample / "image.nrrd", case_file = sample / "sample.ostia",
                 lines = folder / "lines.vtp";
  const std::string vessel = "RCA";
  std::unique_ptr<Program> program;
  std::vector<Twin::Wall> pulled;  ///< as they were before

  void start() {
    fs::remove(log);
    program = std::make_unique<Program>(QStringList{"--state-folder", QString::fromStdString(state.string()),
                                                    "--frame-log", QString::fromStdString(log.string()),
                                                    "--no-tour"});
    ASSERT_TRUE(eventually([&] { return testing::place(log, "cpr1").isValid(); }, opening_ms));
  }
  bool shows_the_image(int most_ms) const {
    return eventually([&] { return testing::picture(log, "cpr1") > 0 && testing::picture(log, "slice") > 0; },
                      most_ms) &&
           testing::settled(log);
  }
  /// What a window manager does with a click: here on a view's title, where it does nothing else.
  void front() const {
    xdo({"windowfocus", program->windows("^Ostia$").value(0)});
    go(testing::place(log, "cpr1").topLeft() + QPoint(30, -10), {"click", "1"});
    QTest::qWait(600);  // the next click is no double click
  }
  /// The case as it lies on the disk. The program holds it alone, so that a copy of its files is read, as it
  /// would be found after the machine went down at this moment.
  session::CaseFile case_on_disk() const {
    const fs::path copy = folder / "copy.ostia";
    for (int tries = 1;; ++tries) try {
        for (const char* part : {"", "-wal"}) {
          fs::remove(copy.string() + part);
          if (fs::exists(case_file.string() + part))
            fs::copy_file(case_file.string() + part, copy.string() + part);
        }
        return session::CaseFile::open(copy, session::OpenMode::read_only);
      } catch (const Error&) {
        if (tries == 5) throw;  // copied while the program tidied up its log
        QTest::qWait(200);
      }
  }
  template <class Read>
  auto stored(const Read& read) const {
    return read(case_on_disk());
  }
  std::size_t count_of_edits() const {
    return stored([](const session::CaseFile& file) { return file.edits().size(); });
  }
  std::size_t count_of_measurements() const {
    return stored([](const session::CaseFile& file) { return file.annotations()->measurements.size(); });
  }
  bool has_edits(std::size_t count) const {
    return eventually([&] { return count_of_edits() == count; }, answer_ms);
  }
  bool has_measurements(std::size_t count) const {
    return eventually([&] { return count_of_measurements() == count; }, answer_ms);
  }

  void open_the_sample() {
    start();
    front();
    keys({"alt+f"});
    QTest::qWait(500);
    keys({"s"});
    ASSERT_TRUE(eventually([&] { return fs::exists(case_file); }, sample_ms)) << "no sample case";
    ASSERT_TRUE(shows_the_image(opening_ms));
  }
  std::int32_t id_of_vessel() const {
    return stored([&](const session::CaseFile& file) {
      for (const geometry::Vessel& one : file.model()->tree.vessels)
        if (one.name == vessel) return one.id;
      throw std::runtime_error("the sample has no " + vessel);
    });
  }
  /// What the program keeps in the case of where the person looks.
  double kept(const char* key) const {
    return stored([&](const session::CaseFile& file) { return std::stod(file.setting(key).value_or("-1")); });
  }
  bool looks_at_the_vessel() const {
    return eventually([&] { return kept("view.vessel") == id_of_vessel(); }, answer_ms);
  }
  /// By the keys for the next vessel, from the first one of the list to the one that is wanted, then to its
  /// first stenosis.
  void walk_to_the_vessel() {
    const auto vessels = stored([](const session::CaseFile& file) { return file.model()->tree.vessels; });
    front();
    for (const geometry::Vessel& one : vessels) {
      if (one.name == vessel) break;
      const int before = testing::picture(log, "cpr1");
      keys({"ctrl+Right"});
      EXPECT_TRUE(eventually([&] { return testing::picture(log, "cpr1") > before; }, answer_ms))
          << "after " << one.name;
    }
    keys({"ctrl+Home", "l"});
    ASSERT_TRUE(looks_at_the_vessel()) << "the keys for the next vessel led elsewhere";
    ASSERT_TRUE(eventually([&] { return kept("view.cursor_mm") > 20.0; }, answer_ms)) << "no stenosis";
    ASSERT_TRUE(testing::settled(log));
  }
  void turn_both_cprs() {
    const int first = testing::picture(log, "cpr1"), second = testing::picture(log, "cpr2");
    keys({"bracketright", "bracketright", "bracketright", "bracketleft"});
    EXPECT_TRUE(eventually([&] { return testing::picture(log, "cpr1") > first; }, answer_ms));
    EXPECT_TRUE(eventually([&] { return testing::picture(log, "cpr2") > second; }, answer_ms));
    EXPECT_TRUE(eventually([&] { return kept("view.theta_deg") == theta_deg; }, answer_ms));
    ASSERT_TRUE(testing::settled(log));
  }
  void pull_on_three_views() {
    Twin twin(case_on_disk(), log);
    const double s = twin.cursor_mm();
    pulled = {twin.wall("cpr1", twin.first, s - 8.0, theta_deg),
              twin.wall("cpr2", twin.second, s - 16.0, theta_deg + 90.0),
              twin.wall("section", twin.section, s, theta_deg + 225.0)};
    keys({"e"});
    for (std::size_t i = 0; i < pulled.size(); ++i) {
      testing::pull(pulled[i].on_screen, pulled[i].outwards);
      ASSERT_TRUE(has_edits(i + 1)) << "pull " << i + 1;
    }
  }
  void undo_and_redo() {
    for (const std::size_t left : {2U, 1U}) {
      keys({"ctrl+z"});
      ASSERT_TRUE(has_edits(left));
    }
    for (const std::size_t again : {2U, 3U}) {
      keys({"ctrl+shift+z"});
      ASSERT_TRUE(has_edits(again));
    }
  }
  void expect_the_journal() const {
    const auto [entries, edits, model] = stored([](const session::CaseFile& file) {
      return std::tuple(file.journal(), file.edits(), file.starting_model());
    });
    std::vector<std::string> ops;
    for (const session::JournalEntry& one : entries) ops.push_back(one.op);
    EXPECT_THAT(ops, ElementsAre("case.begin", "wall.drag", "wall.drag", "wall.drag", "undo", "undo", "redo",
                                 "redo"));
    const std::int32_t id = id_of_vessel();
    geometry::Vessel walked;
    for (const geometry::Vessel& one : model->tree.vessels)
      if (one.id == id) walked = one;
    const geometry::AxisCurve axis(geometry::vessel_axis(model->tree, walked));
    std::vector<double> angles;
    ASSERT_EQ(edits.size(), pulled.size());
    for (std::size_t i = 0; i < edits.size(); ++i) {
      const auto& drag = std::get<lumen::WallDrag>(edits[i]);
      EXPECT_EQ(drag.vessel, id);
      EXPECT_LT((drag.from - pulled[i].place).norm(), 0.3) << i;
      EXPECT_GT(axis.nearest_foot(drag.to).rho_mm, axis.nearest_foot(drag.from).rho_mm + 0.2) << i;
      angles.push_back(axis.nearest_foot(drag.from).theta * 180.0 / M_PI);
    }
    EXPECT_NEAR(std::remainder(angles[0] - theta_deg, 360.0), 0.0, 3.0);
    EXPECT_NEAR(std::remainder(angles[1] - angles[0], 360.0), 90.0, 5.0);
  }
  void kill_and_start_again() {
    const double cursor_mm = kept("view.cursor_mm");
    program->process.kill();  // SIGKILL: nothing can be tidied up
    program->process.waitForFinished();
    EXPECT_EQ(count_of_edits(), 3U);
    start();
    ASSERT_TRUE(shows_the_image(opening_ms)) << "the case is not opened again";
    front();
    keys({"ctrl+z"});  // what can be undone is on the table
    ASSERT_TRUE(has_edits(2));
    keys({"ctrl+y"});
    ASSERT_TRUE(has_edits(3));
    keys({"ctrl+Down"});  // half a millimetre from where it was
    EXPECT_TRUE(
        eventually([&] { return std::abs(kept("view.cursor_mm") - cursor_mm - 0.5) < 0.01; }, answer_ms))
        << kept("view.cursor_mm") << " after " << cursor_mm;
    EXPECT_TRUE(looks_at_the_vessel());
    EXPECT_EQ(kept("view.theta_deg"), theta_deg);
    keys({"ctrl+Home", "l"});
    ASSERT_TRUE(eventually([&] { return kept("view.cursor_mm") > 20.0; }, answer_ms));
    ASSERT_TRUE(testing::settled(log));
  }
  void measure() {
    Twin twin(case_on_disk(), log);
    const auto one = twin.wall("section", twin.section, twin.cursor_mm(), 45.0);
    const auto other = twin.wall("section", twin.section, twin.cursor_mm(), 225.0);
    keys({"f"});
    testing::pull(one.on_screen, other.on_screen, 3);
    ASSERT_TRUE(has_measurements(1));
    keys({"s"});
    const auto on_cpr = [&](double s_mm) {
      return twin.on_screen("cpr1", view::Vec2(twin.first.axis_at(s_mm).x() + 40.0, twin.first.row_of(s_mm)));
    };
    testing::pull(on_cpr(twin.cursor_mm() - 12.0), on_cpr(twin.cursor_mm() + 7.0), 8);
    ASSERT_TRUE(has_measurements(2));
    stored([&](const session::CaseFile& file) {
      const auto& all = file.annotations()->measurements;
      EXPECT_EQ(all[0].kind, MeasureKind::diameter);
      EXPECT_NEAR((all[0].points.at(0) - all[0].points.at(1)).norm(), (one.place - other.place).norm(), 0.3);
      EXPECT_EQ(all[1].kind, MeasureKind::stenosis);
      EXPECT_EQ(all[1].vessel, twin.bench.vessel.get());
      EXPECT_NEAR(all[1].from_mm, twin.cursor_mm() - 12.0, 0.5);
      EXPECT_NEAR(all[1].to_mm, twin.cursor_mm() + 7.0, 0.5);
      return true;
    });
  }
  /// Waits for a window with this title and gives it keys, which close it.
  void answer_window(const char* title, const QStringList& then) const {
    QStringList found;
    ASSERT_TRUE(eventually(
        [&] {
          found = program->windows(title);
          return !found.isEmpty();
        },
        job_ms))
        << title;
    QTest::qWait(500);
    xdo({"windowfocus", found.front(), "mousemove", "--window", found.front(), "30", "20"});
    for (const QString& one : then) xdo({"key", "--delay", "60", one});
    EXPECT_TRUE(eventually([&] { return program->windows(title).isEmpty(); }, answer_ms)) << title;
    front();
  }
  void report_and_export() {
    keys({"Escape", "ctrl+r"});
    answer_window("^Report", {"Escape"});
    ASSERT_TRUE(fs::exists(sample / "sample-report" / "manifest.json"));
    keys({"ctrl+e"});
    answer_window("^Export the surface", {"Return"});
    ASSERT_TRUE(eventually([&] { return fs::exists(sample / "sample-surface" / "manifest.json"); }, job_ms));
    keys({"ctrl+shift+e"});
    ASSERT_TRUE(
        eventually([&] { return !program->windows("^Export the centerlines").isEmpty(); }, answer_ms));
    QTest::qWait(500);
    xdo({"type", "--delay", "20", QString::fromStdString(lines.string())});
    answer_window("^Export the centerlines", {"Return"});
    ASSERT_TRUE(eventually([&] { return fs::exists(lines); }, answer_ms));
  }
  void expect_the_files() const {
    const fs::path report = sample / "sample-report";
    EXPECT_EQ(text_of(report / "report.pdf").substr(0, 5), "%PDF-");
    EXPECT_NE(text_of(report / "report.html").find("<html"), std::string::npos);
    EXPECT_NE(text_of(report / "measurements.csv").find("stenosis"), std::string::npos);
    EXPECT_GT(fs::file_size(report / "stenoses.csv"), 100U);
    const QJsonObject json =
        QJsonDocument::fromJson(QByteArray::fromStdString(text_of(report / "report.json"))).object();
    std::vector<std::string> kinds;
    for (const auto& one : json["measurements"].toArray()) {
      kinds.push_back(one.toObject()["kind"].toString().toStdString());
      EXPECT_EQ(one.toObject()["problem"].toString(), QString());
      EXPECT_EQ(one.toObject()["vessel_name"].toString().toStdString(), vessel);
      EXPECT_FALSE(one.toObject()["values"].toArray().isEmpty());
    }
    EXPECT_THAT(kinds, ElementsAre("diameter", "stenosis"));
    EXPECT_EQ(json["steps"].toArray().size(), 1 + 3 + 2);
    EXPECT_TRUE(json["image"].toObject()["at_hand"].toBool());
    EXPECT_EQ(io::read_centerlines(lines).vessels.size(),
              stored([](const session::CaseFile& file) { return file.model()->tree.vessels.size(); }));
  }
  /// Of all that could be handed on.
  void expect_no_path() const {
    std::vector<fs::path> files{case_file, lines};
    for (const char* made : {"sample-report", "sample-surface"})
      for (const auto& entry : fs::recursive_directory_iterator(sample / made))
        if (entry.is_regular_file()) files.push_back(entry.path());
    EXPECT_GT(files.size(), 12U);
    for (const fs::path& file : files) {
      const std::string bytes = text_of(file);
      for (const std::string& secret : {image.string(), state.string(), std::string("image.nrrd")})
        EXPECT_EQ(bytes.find(secret), std::string::npos) << file << " holds " << secret;
    }
  }
  void close() {
    front();
    keys({"ctrl+q"});
    ASSERT_TRUE(eventually([&] { return !program->runs(); }, answer_ms));
    EXPECT_EQ(program->process.exitStatus(), QProcess::NormalExit);
    EXPECT_EQ(program->process.exitCode(), 0);
    EXPECT_EQ(count_of_edits(), 3U);
    EXPECT_EQ(count_of_measurements(), 2U);
  }
};

TEST_F(WholeSession, FromTheSampleToTheReportWithAKillInTheMiddle) {
  if (QStandardPaths::findExecutable("xdotool").isEmpty()) GTEST_SKIP() << "xdotool is not installed";
  ASSERT_NO_FATAL_FAILURE(open_the_sample());
  ASSERT_NO_FATAL_FAILURE(walk_to_the_vessel());
  ASSERT_NO_FATAL_FAILURE(turn_both_cprs());
  ASSERT_NO_FATAL_FAILURE(pull_on_three_views());
  ASSERT_NO_FATAL_FAILURE(undo_and_redo());
  ASSERT_NO_FATAL_FAILURE(expect_the_journal());
  ASSERT_NO_FATAL_FAILURE(kill_and_start_again());
  ASSERT_NO_FATAL_FAILURE(measure());
  ASSERT_NO_FATAL_FAILURE(report_and_export());
  ASSERT_NO_FATAL_FAILURE(expect_the_files());
  expect_no_path();
  ASSERT_NO_FATAL_FAILURE(close());
}

}  // namespace
}  // namespace ostia::workstation
