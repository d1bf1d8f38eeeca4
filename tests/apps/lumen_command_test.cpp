// `ostia lumen` and `ostia replay`: a model made, edited and exported by a script.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/rotterdam_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"
#include "ostia/session/edit_json.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <numbers>
#include <stdexcept>

namespace ostia::testing {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::json;
namespace fs = std::filesystem;

using std::numbers::pi;

geometry::Centerline line(const Vec3& from, const Vec3& to, double radius) {
  geometry::Centerline axis;
  const int pieces = static_cast<int>(std::ceil((to - from).norm() / 0.5));
  for (int i = 0; i <= pieces; ++i) {
    axis.points.emplace_back(from + (to - from) * i / pieces);
    axis.radius.push_back(radius);
  }
  geometry::complete(axis);
  return axis;
}

/// 20 mm along z with a radius of 1.5 mm.
std::string tube_csv() {
  std::string text = "x,y,z,radius\n";
  for (int i = 0; i <= 40; ++i) text += "0,0," + std::to_string(0.5 * i) + ",1.5\n";
  return text;
}

fs::path tube_folder() {
  fs::path folder = temporary_folder("lumen");
  core::write_file(folder / "tube.csv", tube_csv());
  return folder;
}

/// A trunk that divides in two.
geometry::VesselTree y_tree() {
  geometry::VesselTree tree;
  const Vec3 root(0, 0, 0), fork(0, 0, 12), left(-7, 0, 22), right(7, 0, 22);
  tree.nodes = {{0, root}, {1, fork}, {2, left}, {3, right}};
  tree.segments = {
      {0, 0, 1, line(root, fork, 1.8)}, {1, 1, 2, line(fork, left, 1.4)}, {2, 1, 3, line(fork, right, 1.2)}};
  tree.vessels = {{0, "LAD", {0, 1}}, {1, "LCX", {0, 2}}};
  return tree;
}

/// A closed contour of another radius across the tube.
lumen::Edit ring(double z, double radius, std::int32_t vessel = 0) {
  lumen::SectionContour edit;
  edit.vessel = vessel;
  edit.s_mm = z;
  edit.eps_mm = 3.0;
  for (int i = 0; i < 12; ++i) {
    const double a = 2.0 * pi * i / 12.0;
    edit.points.emplace_back(radius * std::cos(a), radius * std::sin(a), z);
  }
  return edit;
}

/// What a run says that must succeed.
Json lumen_json(const std::vector<std::string>& arguments, const fs::path& folder) {
  const Outcome done = ostia(arguments, {folder, ""});
  if (done.code != 0) throw std::runtime_error("exit code " + std::to_string(done.code) + ": " + done.err);
  return Json::parse(done.out);
}

TEST(LumenCommand, MakesAClosedTubeOfALine) {
  const fs::path folder = tube_folder();
  const Json out = lumen_json({"lumen", "tube.csv", "-o", "tube.vtp", "--json"}, folder);
  EXPECT_EQ(out["kind"], "lumen");
  EXPECT_EQ(out["start"], "tube");
  EXPECT_EQ(out["open_edges"], 0);
  EXPECT_EQ(out["non_manifold_edges"], 0);
  EXPECT_EQ(out["edits"], 0);
  ASSERT_EQ(out["vessels"].size(), 1u);
  EXPECT_NEAR(out["vessels"][0]["length_mm"].get<double>(), 20.0, 1e-6);
  const double cylinder = pi * 1.5 * 1.5 * 20.0, caps = 4.0 / 3.0 * pi * std::pow(1.5, 3);
  EXPECT_GT(out["volume_mm3"].get<double>(), 0.97 * cylinder);
  EXPECT_LT(out["volume_mm3"].get<double>(), 1.03 * (cylinder + caps));
  const Json wide =
      lumen_json({"lumen", "tube.csv", "-o", "wide.stl", "--radius", "2", "--cell", "0.4", "--json"}, folder);
  EXPECT_GT(wide["volume_mm3"].get<double>(), 1.6 * out["volume_mm3"].get<double>());
  EXPECT_EQ(names_in(folder), (std::vector<std::string>{"tube.csv", "tube.vtp", "wide.stl"}));
}

TEST(LumenCommand, ReadsAReferenceOfTheRotterdamChallenge) {
  const fs::path folder = temporary_folder("lumen");
  io::RotterdamReference reference;
  for (int i = 0; i <= 500; ++i) {
    reference.points.emplace_back(0.001 * i, 0.0, 0.03 * i);
    reference.radius.push_back(1.2);
    reference.observer_spread.push_back(0.2);
  }
  io::write_rotterdam_reference(folder / "reference.txt", reference);
  const Json out = lumen_json({"lumen", "reference.txt", "-o", "lumen.ply", "--json"}, folder);
  EXPECT_EQ(out["vessels"][0]["name"], "vessel");
  EXPECT_NEAR(out["vessels"][0]["length_mm"].get<double>(), 15.0, 0.1);
}

TEST(LumenCommand, JoinsTheBranchesOfATree) {
  const fs::path folder = temporary_folder("lumen");
  io::write_centerlines(folder / "y.vtp", y_tree());
  const Json out = lumen_json(
      {"lumen", "y.vtp", "-o", "y.stl", "--case", "y.ostia", "--lines", "lines.vtp", "--json"}, folder);
  ASSERT_EQ(out["vessels"].size(), 2u);
  EXPECT_EQ(out["vessels"][0]["name"], "LAD");
  const Json surface = Json::parse(ostia({"info", "y.stl", "--json"}, {folder, ""}).out);
  EXPECT_EQ(surface["components"], 1);
  EXPECT_EQ(surface["open_edges"], 0);
  EXPECT_EQ(io::read_centerlines(folder / "lines.vtp").vessels.size(), 2u);
  const Json again = lumen_json({"lumen", "y.ostia", "-o", "again.stl", "--json"}, folder);
  EXPECT_EQ(again["digest"], out["digest"]);
  EXPECT_EQ(again["start"], "case");
  EXPECT_EQ(core::read_file(folder / "again.stl"), core::read_file(folder / "y.stl"));
}

TEST(LumenCommand, ItsCaseIsMeshedAsItIs) {
  const fs::path folder = tube_folder();
  lumen_json({"lumen", "tube.csv", "-o", "tube.stl", "--case", "tube.ostia", "--json"}, folder);
  const std::vector<std::string> command{"mesh", "tube.ostia", "-o", "mesh", "--edge-ratio", "0.3", "--json"};
  const Json quality = lumen_json(command, folder);
  EXPECT_EQ(quality["volume"]["inverted"], 0);
  EXPECT_EQ(quality["surface"]["open_edges"], 0);
  EXPECT_EQ(quality["verdict"]["passed"], true);
  const auto written = fs::last_write_time(folder / "mesh" / "mesh.vtu");
  EXPECT_EQ(lumen_json(command, folder), quality);  // done already
  EXPECT_EQ(fs::last_write_time(folder / "mesh" / "mesh.vtu"), written);
  EXPECT_EQ(ostia({"mesh", "tube.ostia", "-o", "other", "--source", "0,0,0"}, {folder, ""}).code, 2);
  EXPECT_FALSE(fs::exists(folder / "other"));
}

TEST(LumenCommand, AppliesEditsAndKeepsThemInACase) {
  const fs::path folder = tube_folder();
  session::write_edits(folder / "edits.jsonl", {ring(8.0, 1.0), ring(12.0, 0.9)});
  const std::vector<std::string> command{"lumen",   "tube.csv",    "-o",     "tube.vtp",
                                         "--edits", "edits.jsonl", "--json", "--quiet"};
  const Json before = lumen_json({"lumen", "tube.csv", "-o", "start.vtp", "--json"}, folder);
  const Json plain = lumen_json(command, folder);
  EXPECT_EQ(plain["edits"], 2);
  EXPECT_GT(plain["vessels"][0]["edited_samples"].get<int>(), 16);
  EXPECT_LT(plain["volume_mm3"].get<double>(), before["volume_mm3"].get<double>() - 5.0);
  EXPECT_NE(plain["digest"], before["digest"]);
  const Json kept = lumen_json(command + std::vector<std::string>{"--case", "tube.ostia"}, folder);
  EXPECT_EQ(kept["digest"], plain["digest"]);

  const Json replayed = lumen_json({"replay", "tube.ostia", "--json"}, folder);
  EXPECT_EQ(replayed["edits"], 2);
  EXPECT_EQ(replayed["same"], true);
  EXPECT_EQ(replayed["digest"], plain["digest"]);
  EXPECT_EQ(replayed["stored_digest"], plain["digest"]);
  const Json copied = lumen_json({"replay", "tube.ostia", "-o", "copy.ostia", "--json"}, folder);
  EXPECT_EQ(copied["digest"], plain["digest"]);
  const Json of_copy = lumen_json({"lumen", "copy.ostia", "-o", "copy.vtp", "--json"}, folder);
  EXPECT_EQ(of_copy["digest"], plain["digest"]);
}

TEST(LumenCommand, NeverWritesOverACase) {
  const fs::path folder = tube_folder();
  core::write_file(folder / "kept.ostia", "whatever it is");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"lumen", "tube.csv", "-o", "tube.vtp", "--case", "kept.ostia"},
        {"replay", "kept.ostia", "-o", "kept.ostia"}}) {
    EXPECT_EQ(ostia(command, {folder, ""}).code, 3);
    EXPECT_EQ(core::read_file(folder / "kept.ostia"), "whatever it is");
    EXPECT_EQ(names_in(folder), (std::vector<std::string>{"kept.ostia", "tube.csv"}));
  }
}

TEST(ReplayCommand, HoldsAJournalAgainstItsCase) {
  const fs::path folder = tube_folder();
  session::write_edits(folder / "tube.jsonl", {ring(8.0, 1.0), ring(12.0, 0.9)});
  session::write_edits(folder / "other.jsonl", {ring(8.0, 1.0)});
  lumen_json(
      {"lumen", "tube.csv", "-o", "tube.vtp", "--edits", "tube.jsonl", "--case", "tube.ostia", "--json"},
      folder);
  EXPECT_EQ(lumen_json({"replay", "tube.jsonl", "--json"}, folder)["same"], true);  // the case beside it
  const Outcome lonely = ostia({"replay", "other.jsonl"}, {folder, ""});
  EXPECT_EQ(lonely.code, 3);
  EXPECT_THAT(lonely.err, HasSubstr("--start"));
  const Outcome other = ostia({"replay", "other.jsonl", "--start", "tube.ostia", "--json"}, {folder, ""});
  EXPECT_EQ(other.code, 4) << other.err;
  EXPECT_EQ(Json::parse(other.out)["same"], false);
  EXPECT_EQ(ostia({"replay", "tube.ostia", "--start", "tube.ostia"}, {folder, ""}).code, 2);
}

TEST(LumenCommand, NamesTheFileThatIsWrong) {
  const fs::path folder = tube_folder();
  core::write_file(folder / "bad.stl", "hello");
  core::write_file(folder / "bad.json", "[]");
  for (const auto& [option, file] : {std::pair{"--surface", "bad.stl"}, {"--contours", "bad.json"}}) {
    const Outcome done = ostia({"lumen", "tube.csv", "-o", "tube.stl", option, file}, {folder, ""});
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_THAT(done.err, HasSubstr(file));
    EXPECT_THAT(done.err, Not(HasSubstr("tube.csv")));
  }
}

TEST(LumenCommand, StartsFromASurface) {
  const fs::path folder = tube_folder();
  const Json tube = lumen_json({"lumen", "tube.csv", "-o", "wide.stl", "--radius", "2", "--json"}, folder);
  const Json taken =
      lumen_json({"lumen", "tube.csv", "-o", "taken.stl", "--surface", "wide.stl", "--json"}, folder);
  EXPECT_EQ(taken["start"], "surface");
  EXPECT_NEAR(taken["volume_mm3"].get<double>(), tube["volume_mm3"].get<double>(),
              0.06 * tube["volume_mm3"].get<double>());
}

/// Rings of 1.2 (observer A) and 1.8 mm (observer B) on the tube between 6 and 14 mm.
geometry::ContourSet contours(const std::string& vessel) {
  geometry::ContourSet set;
  for (const auto& [observer, radius] : {std::pair{"A", 1.2}, std::pair{"B", 1.8}}) {
    geometry::ContourSection section;
    section.section = "s01";
    section.vessel = vessel;
    section.observer = observer;
    for (double z = 6.0; z <= 14.0; z += 0.5) {
      geometry::Contour ring{z, {}};
      // Frames along z start with +x; theta grows counter-clockwise looking along +z, from +x to -y.
      for (int i = 0; i < 16; ++i) {
        const double a = -2.0 * pi * i / 16.0;
        ring.points.emplace_back(radius * std::cos(a), radius * std::sin(a), z);
      }
      section.contours.push_back(std::move(ring));
    }
    set.sections.push_back(std::move(section));
  }
  return set;
}

TEST(LumenCommand, StartsFromOneObserversContours) {
  const fs::path folder = temporary_folder("lumen");
  io::RotterdamReference reference;
  for (int i = 0; i <= 400; ++i) {
    reference.points.emplace_back(0.0, 0.0, 0.05 * i);
    reference.radius.push_back(1.5);
    reference.observer_spread.push_back(0.2);
  }
  io::write_rotterdam_reference(folder / "line.txt", reference);
  io::write_contours(folder / "contours.json", contours("RCA"));
  const std::vector<std::string> command{"lumen",      "line.txt",      "-o",       "a.stl",
                                         "--contours", "contours.json", "--vessel", "RCA"};
  const Outcome which = ostia(command, {folder, ""});
  EXPECT_EQ(which.code, 3);
  EXPECT_THAT(which.err, HasSubstr("A, B"));
  EXPECT_THAT(which.err, HasSubstr("--observer"));
  const Outcome unnamed = ostia(
      {"lumen", "line.txt", "-o", "a.stl", "--contours", "contours.json", "--observer", "A"}, {folder, ""});
  EXPECT_EQ(unnamed.code, 3);
  EXPECT_THAT(unnamed.err, HasSubstr("RCA"));
  const Json a = lumen_json(command + std::vector<std::string>{"--observer", "A", "--json"}, folder);
  const Json b = lumen_json(command + std::vector<std::string>{"--observer", "B", "--json"}, folder);
  EXPECT_EQ(a["start"], "contours");
  EXPECT_EQ(a["vessels"][0]["name"], "RCA");
  const double more = b["volume_mm3"].get<double>() - a["volume_mm3"].get<double>();
  const double covered = 8.0 * pi * (1.8 * 1.8 - 1.2 * 1.2);  // and smooth passages beyond
  EXPECT_GT(more, 0.98 * covered);
  EXPECT_LT(more, 1.6 * covered);
}

TEST(LumenCommand, NamesFileAndLineOfAnEditThatIsRefused) {
  const fs::path folder = tube_folder();
  const std::string good = session::to_json(ring(8.0, 1.0));
  core::write_file(folder / "broken.jsonl", good + "\n\n{\"v\":1,\"op\":\"cpr.strok\"}\n");
  core::write_file(folder / "stranger.jsonl", good + "\n\n\n" + session::to_json(ring(8.0, 1.0, 99)) + "\n");
  for (const auto& [file, line_number] :
       {std::pair{"broken.jsonl", "line 3"}, std::pair{"stranger.jsonl", "line 4"}}) {
    for (const bool with_case : {false, true}) {
      std::vector<std::string> command{"lumen", "tube.csv", "-o", "tube.vtp", "--edits", file};
      if (with_case) command.insert(command.end(), {"--case", "tube.ostia"});
      const Outcome done = ostia(command, {folder, ""});
      EXPECT_EQ(done.code, 3) << done.err;
      EXPECT_THAT(done.err, HasSubstr(file));
      EXPECT_THAT(done.err, HasSubstr(line_number));
      EXPECT_EQ(names_in(folder), (std::vector<std::string>{"broken.jsonl", "stranger.jsonl", "tube.csv"}));
    }
  }
}

TEST(LumenCommand, RefusesWrongUsage) {
  const fs::path folder = tube_folder();
  core::write_file(folder / "x.ostia", "not a case");
  const std::vector<std::vector<std::string>> wrong{
      {"lumen", "tube.csv"},
      {"lumen", "tube.csv", "-o", "tube.txt"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--no-such-option"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--case", "tube.db"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--lines", "lines.stl"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--start", "image"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--start", "guess"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--kernel", "gauss"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--radius", "-1"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--surface", "a.stl", "--contours", "b.json"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--surface", "a.stl", "--radius", "2"},
      {"lumen", "x.ostia", "-o", "tube.vtp", "--radius", "2"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--observer", "A"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--vessel", "LAD"},
      {"replay"},
      {"replay", "x.ostia", "-o", "x.vtp"},
      {"replay", "x.ostia", "--no-such-option"}};
  for (const auto& command : wrong) {
    const Outcome done = ostia(command, {folder, ""});
    EXPECT_EQ(done.code, 2) << ::testing::PrintToString(command) << done.err;
    EXPECT_THAT(done.err, Not(IsEmpty()));
    EXPECT_THAT(done.out, IsEmpty());
  }
  EXPECT_EQ(names_in(folder), (std::vector<std::string>{"tube.csv", "x.ostia"}));
}

TEST(LumenCommand, RefusesInputsThatAreNotThereOrNotWhatTheySay) {
  const fs::path folder = tube_folder();
  core::write_file(folder / "x.ostia", "not a case");
  core::write_file(folder / "none.csv", "x,y,z\n0,0,0\n0,0,1\n");
  const std::vector<std::vector<std::string>> bad{
      {"lumen", "missing.csv", "-o", "tube.vtp"},
      {"lumen", "none.csv", "-o", "tube.vtp"},
      {"lumen", "x.ostia", "-o", "tube.vtp"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--edits", "missing.jsonl"},
      {"lumen", "tube.csv", "-o", "none.csv/tube.vtp"},
      {"lumen", "tube.csv", "-o", "/proc/tube.vtp"},
      {"lumen", "tube.csv", "-o", "tube.vtp", "--case", "/proc/tube.ostia"},
      {"replay", "missing.ostia"},
      {"replay", "x.ostia"},
      {"replay", "x.ostia", "-o", "y.ostia"}};
  for (const auto& command : bad) {
    const Outcome done = ostia(command, {folder, ""});
    EXPECT_EQ(done.code, 3) << ::testing::PrintToString(command) << done.err;
    EXPECT_THAT(done.err, Not(IsEmpty()));
  }
  EXPECT_EQ(names_in(folder), (std::vector<std::string>{"none.csv", "tube.csv", "x.ostia"}));
}

TEST(LumenCommand, LeavesNothingWhenInterrupted) {
  const fs::path folder = temporary_folder("lumen");
  io::write_centerlines(folder / "y.vtp", y_tree());
  double seconds = 0.0;
  const Outcome done =
      interrupted({"lumen", "y.vtp", "-o", "y.stl", "--case", "y.ostia", "--cell", "0.05", "--threads", "1"},
                  {folder, ""}, SIGINT, 0.4, seconds);
  EXPECT_EQ(done.code, 130) << done.err;
  EXPECT_EQ(names_in(folder), (std::vector<std::string>{"y.vtp"}));
}

/// What is in the way of an edit, and what the message must say beside file, line and vessel.
struct Refusal {
  std::string what;
  lumen::Edit edit;
  std::string said, way_out;
};

lumen::CprStroke stroke(const std::vector<Vec3>& points) {
  lumen::CprStroke edit;
  edit.points = points;
  return edit;
}

lumen::SectionContour drawn(const std::vector<Vec3>& points) {
  lumen::SectionContour edit = std::get<lumen::SectionContour>(ring(10.0, 1.5));
  edit.points = points;
  return edit;
}

std::vector<Refusal> refusals() {
  std::vector<Vec3> crossed = std::get<lumen::SectionContour>(ring(10.0, 1.5)).points;
  std::swap(crossed[3], crossed[6]);
  std::vector<Vec3> beside = std::get<lumen::SectionContour>(ring(10.0, 1.0)).points;
  for (Vec3& point : beside) point.x() += 2.0;
  lumen::SectionContour wide = drawn(crossed);
  wide.eps_mm = 30.0;
  return {
      {"crossed", drawn(crossed), "crosses itself", "without a loop"},
      {"beside", drawn(beside), "does not go around the axis", "move the axis"},
      {"on-axis", drawn({{0, 0, 10}, {1, 0, 10}, {0, 1, 10}}), "of the axis", "move the axis"},
      {"two-points", drawn({{1, 0, 10}, {0, 1, 10}}), "2 points", "at least 3"},
      {"through", stroke({{1.8, 0, 5}, {-1.8, 0, 15}}), "crosses the axis", "each side"},
      {"back", stroke({{1.8, 0, 5}, {1.8, 0, 10}, {1.7, 0, 6}, {1.6, 0, 12}}), "runs back", "one direction"},
      {"eps", wide, "eps is 30.00 mm", "at most 20 mm"},
      {"no-vessel", ring(10.0, 1.0, 99), "no vessel 99", ""},
      {"fold", lumen::AxisMove{0, {0, 0, 10}, {9, 0, 10}, 5.0}, "fold", "longer reach"}};
}

TEST(LumenCommand, RefusesEditsThatMakeNoWall) {
  const fs::path folder = tube_folder();
  for (const Refusal& refusal : refusals()) {
    SCOPED_TRACE(refusal.what);
    session::write_edits(folder / "edits.jsonl", {ring(5.0, 1.0), refusal.edit});
    const Outcome done =
        ostia({"lumen", "tube.csv", "-o", "tube.vtp", "--edits", "edits.jsonl", "--case", "tube.ostia"},
              {folder, ""});
    EXPECT_EQ(done.code, 3) << done.err;
    for (const std::string& part : {std::string("edits.jsonl: line 2"), refusal.said, refusal.way_out})
      EXPECT_THAT(done.err, HasSubstr(part));
    EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
    EXPECT_EQ(names_in(folder), (std::vector<std::string>{"edits.jsonl", "tube.csv"}));
  }
}

TEST(LumenCommand, OfEditsThatContradictEachOtherTheLaterWins) {
  const fs::path folder = tube_folder();
  const auto volume = [&](const std::vector<lumen::Edit>& edits) {
    session::write_edits(folder / "edits.jsonl", edits);
    const Json out =
        lumen_json({"lumen", "tube.csv", "-o", "tube.stl", "--edits", "edits.jsonl", "--json"}, folder);
    EXPECT_EQ(out["open_edges"], 0);
    return out["volume_mm3"].get<double>();
  };
  EXPECT_NEAR(volume({ring(10.0, 2.0), ring(10.0, 1.1)}), volume({ring(10.0, 1.1)}), 0.3);
  const lumen::Edit wide = stroke({{2.0, 0, 5}, {2.0, 0, 10}, {2.0, 0, 15}}),
                    narrow = stroke({{1.1, 0, 5}, {1.1, 0, 10}, {1.1, 0, 15}});
  EXPECT_NEAR(volume({wide, narrow}), volume({narrow}), 0.3);
}

TEST(LumenCommand, PointsOnOnePlaceMakeASoundWall) {
  const fs::path folder = tube_folder();
  lumen::SectionContour twice = std::get<lumen::SectionContour>(ring(10.0, 1.3)), shifted = twice;
  twice.points.clear();
  for (const Vec3& point : shifted.points) twice.points.insert(twice.points.end(), {point, point});
  shifted.s_mm += 1e-12;
  for (Vec3& point : shifted.points) point += Vec3(1e-13, 0.0, 1e-12);
  // An epsilon too small to dismiss the ring before leaves two on one place.
  shifted.eps_mm = 1e-13;
  session::write_edits(folder / "edits.jsonl", {twice, shifted});
  const Json out =
      lumen_json({"lumen", "tube.csv", "-o", "tube.stl", "--edits", "edits.jsonl", "--json"}, folder);
  EXPECT_EQ(out["open_edges"], 0);
  EXPECT_EQ(out["non_manifold_edges"], 0);
  EXPECT_THAT(out["warnings"][0].get<std::string>(), HasSubstr("line 1: 12 points"));
}

TEST(LumenCommand, RefusesAxesThatBearNoWall) {
  const fs::path folder = temporary_folder("lumen");
  const auto csv = [&](const char* name, const std::vector<Vec3>& points) {
    std::string text = "x,y,z,radius\n";
    for (const Vec3& p : points)
      text += std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z()) + ",1\n";
    core::write_file(folder / name, text);
  };
  std::vector<Vec3> kink, loop;
  for (double z = 0.0; z <= 10.0; z += 0.5) kink.emplace_back(0.0, 0.0, z);
  for (double x = 0.5; x <= 10.0; x += 0.5) kink.emplace_back(x, 0.0, 10.0 - 0.4 * x);
  for (double a = -1.0; a < 2.0 * pi + 1.0; a += 0.1)
    loop.emplace_back(6.0 * std::cos(a), 6.0 * std::sin(a), 0.02 * a);
  csv("two.csv", {{0, 0, 0}, {0, 0, 10}});
  csv("kink.csv", kink);
  csv("loop.csv", loop);
  const auto before = names_in(folder);
  for (const auto& [file, said] : {std::pair{"two.csv", "at least three"},
                                   {"kink.csv", "smooth the axis there"},
                                   {"loop.csv", "take the loop out"}}) {
    const Outcome done = ostia({"lumen", file, "-o", "lumen.vtp", "--case", "lumen.ostia"}, {folder, ""});
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_THAT(done.err, HasSubstr(file));
    EXPECT_THAT(done.err, HasSubstr(said));
    EXPECT_EQ(names_in(folder), before);
  }
}

TEST(LumenCommand, AWallThatWouldNotFitIsFive) {
  const fs::path folder = tube_folder();
  const Outcome done =
      ostia({"lumen", "tube.csv", "-o", "tube.vtp", "--radius", "40", "--case", "tube.ostia"}, {folder, ""});
  EXPECT_EQ(done.code, 5) << done.err;
  EXPECT_THAT(done.err, HasSubstr("MiB"));
  EXPECT_THAT(done.err, HasSubstr("number of samples"));
  EXPECT_EQ(names_in(folder), (std::vector<std::string>{"tube.csv"}));
}

/// A case of the tube with one edit.
fs::path case_folder() {
  fs::path folder = tube_folder();
  session::CaseFile file = session::CaseFile::create(
      folder / "tube.ostia", lumen::model_of_tubes(io::read_centerlines(folder / "tube.csv")));
  file.apply(ring(8.0, 1.0));
  return folder;
}

TEST(LumenCommand, GoesOnWithACaseAndItsJournal) {
  const fs::path folder = case_folder();
  const std::string bytes = core::read_file(folder / "tube.ostia");
  session::write_edits(folder / "more.jsonl", {ring(12.0, 0.9)});
  const Json more = lumen_json(
      {"lumen", "tube.ostia", "-o", "tube.stl", "--edits", "more.jsonl", "--case", "more.ostia", "--json"},
      folder);
  EXPECT_EQ(more["edits"], 1);
  EXPECT_EQ(core::read_file(folder / "tube.ostia"), bytes);
  const Json replayed = lumen_json({"replay", "more.ostia", "-o", "all.jsonl", "--json"}, folder);
  EXPECT_EQ(replayed["edits"], 2);
  EXPECT_EQ(replayed["same"], true);
  EXPECT_EQ(replayed["digest"], more["digest"]);
  const Json anew =
      lumen_json({"lumen", "tube.csv", "-o", "anew.stl", "--edits", "all.jsonl", "--json"}, folder);
  EXPECT_EQ(anew["digest"], more["digest"]);
  const Outcome piped =
      ostia({"lumen", "tube.csv", "-o", "piped.stl", "--edits", "-", "--json"}, {folder, "cat all.jsonl |"});
  EXPECT_EQ(Json::parse(piped.out)["digest"], more["digest"]) << piped.err;
}

TEST(LumenCommand, CasesThatCannotBeOpened) {
  const fs::path folder = case_folder();
  const std::string bytes = core::read_file(folder / "tube.ostia");
  core::write_file(folder / "short.ostia", bytes.substr(0, bytes.size() / 2));
  core::write_file(folder / "empty.ostia", "");
  std::string newer = bytes;
  newer[63] += 1;  // SQLite's user_version, big-endian
  core::write_file(folder / "newer.ostia", newer);
  std::string damaged = bytes;
  std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(damaged.size() / 2), 3000, 'x');
  core::write_file(folder / "damaged.ostia", damaged);
  const session::CaseFile held = session::CaseFile::open(folder / "tube.ostia");
  const auto before = names_in(folder);
  for (const auto& [file, said] : {std::pair{"short.ostia", "truncated"},
                                   {"empty.ostia", "empty"},
                                   {"newer.ostia", "open it with Ostia"},
                                   {"damaged.ostia", "damaged"},
                                   {"tube.ostia", "another window or program"},
                                   {"none.ostia", "check the name"}}) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"lumen", file, "-o", "a.vtp"}, {"replay", file, "-o", "copy.ostia"}}) {
      const Outcome done = ostia(command, {folder, ""});
      EXPECT_EQ(done.code, 3) << done.err;
      EXPECT_THAT(done.err, HasSubstr(file));
      EXPECT_THAT(done.err, HasSubstr(said));
      EXPECT_EQ(names_in(folder), before);
    }
  }
  EXPECT_EQ(core::read_file(folder / "short.ostia").size(), bytes.size() / 2);
}

TEST(LumenCommand, ReadOnlyCasesAreReadAndFullDisksLeaveNothing) {
  const fs::path folder = case_folder();
  const std::string bytes = core::read_file(folder / "tube.ostia");
  fs::permissions(folder / "tube.ostia", fs::perms::owner_read);
  EXPECT_EQ(lumen_json({"replay", "tube.ostia", "--json"}, folder)["same"], true);
  const auto before = names_in(folder);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"lumen", "tube.ostia", "-o", "a.stl", "--case", "b.ostia"},
        {"lumen", "tube.csv", "-o", "a.stl", "--case", "b.ostia"},
        {"replay", "tube.ostia", "-o", "b.ostia"}}) {
    const Outcome done = ostia(command, {folder, "ulimit -f 40;"});  // blocks of 512 bytes
    EXPECT_EQ(done.code, 5) << done.err;
    EXPECT_THAT(done.err, HasSubstr("the case b.ostia; make room"));
    EXPECT_EQ(names_in(folder), before);
  }
  EXPECT_EQ(core::read_file(folder / "tube.ostia"), bytes);
}

TEST(LumenCommand, KilledItLeavesNoHalfCase) {
  const fs::path folder = temporary_folder("lumen");
  io::write_centerlines(folder / "y.vtp", y_tree());
  for (const double seconds : {0.02, 0.1, 0.3}) {
    double ended = 0.0;
    interrupted({"lumen", "y.vtp", "-o", "y.stl", "--case", "y.ostia", "--cell", "0.1"}, {folder, ""},
                SIGKILL, seconds, ended);
    // What a killed program cannot take away has a hidden name.
    for (const std::string& name : names_in(folder)) {
      if (!name.starts_with(".") && name != "y.vtp") {
        EXPECT_EQ(lumen_json({"lumen", "y.ostia", "-o", "again.stl", "--json"}, folder)["start"], "case");
      }
    }
  }
}

/// A tube of contrast along z; `hu` is that of what lies around it.
void write_tube_image(const fs::path& path, std::int16_t hu) {
  imaging::ImageVolume image;
  image.geometry.size = {24, 24, 50};
  image.geometry.spacing = Vec3::Constant(0.5);
  image.geometry.origin = Vec3(-6.0, -6.0, -2.0);
  for (std::int64_t k = 0; k < 50; ++k)
    for (std::int64_t j = 0; j < 24; ++j)
      for (std::int64_t i = 0; i < 24; ++i) {
        const Vec3 p = image.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), 0.0));
        image.voxels.push_back(std::hypot(p.x(), p.y()) < 1.8 ? 400 : hu);
      }
  imaging::write_image(path, image);
}

TEST(LumenCommand, AnImageThatIsMissingOrNotTheCases) {
  const fs::path folder = tube_folder();
  write_tube_image(folder / "heart.nrrd", -80);
  write_tube_image(folder / "other.nrrd", -70);
  const Json found = lumen_json(
      {"lumen", "tube.csv", "-o", "a.stl", "--image", "heart.nrrd", "--case", "heart.ostia", "--json"},
      folder);
  EXPECT_EQ(found["start"], "image");
  EXPECT_EQ(lumen_json({"lumen", "heart.ostia", "-o", "a.stl", "--image", "heart.nrrd", "--json"},
                       folder)["digest"],
            found["digest"]);
  const auto before = names_in(folder);
  const std::string surface = core::read_file(folder / "a.stl");
  for (const auto& [file, said] : {std::pair{"other.nrrd", "choose the image that the case was made with"},
                                   {"none.nrrd", "there is no such"}}) {
    const Outcome done =
        ostia({"lumen", "heart.ostia", "-o", "a.stl", "--image", file, "--case", "b.ostia"}, {folder, ""});
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_THAT(done.err, HasSubstr(file));
    EXPECT_THAT(done.err, HasSubstr(said));
    EXPECT_EQ(names_in(folder), before);
    EXPECT_EQ(core::read_file(folder / "a.stl"), surface);
  }
}

TEST(LumenCommand, NoNameOfAFolderOrFileIsWrittenAnywhere) {
  const fs::path holder = tube_folder();
  const fs::path folder = holder / "DOE^JANE";
  fs::create_directory(folder);
  fs::rename(holder / "tube.csv", folder / "DOE^JANE.csv");
  write_tube_image(folder / "DOE^JANE.nrrd", -80);
  session::write_edits(folder / "DOE^JANE.jsonl", {ring(8.0, 1.0), ring(12.0, 0.9)});
  session::write_edits(folder / "bad-DOE^JANE.jsonl", {ring(8.0, 1.0, 99)});
  const auto at = [&](const char* name) { return (folder / name).string(); };
  fs::create_directory(holder / "out");
  const std::vector<std::vector<std::string>> commands{
      {"lumen", at("DOE^JANE.csv"), "-o", "out/a.stl", "--image", at("DOE^JANE.nrrd"), "--edits",
       at("DOE^JANE.jsonl"), "--case", at("DOE^JANE.ostia"), "--lines", "out/lines.vtp"},
      {"lumen", at("DOE^JANE.ostia"), "-o", "out/b.vtp", "--case", "out/b.ostia", "--json"},
      {"replay", at("DOE^JANE.ostia"), "-o", "out/c.ostia"},
      {"replay", at("DOE^JANE.ostia"), "-o", "out/c.jsonl"},
      {"lumen", at("DOE^JANE.csv"), "-o", "out/d.stl", "--edits", at("bad-DOE^JANE.jsonl")},
      {"lumen", at("DOE^JANE.nrrd"), "-o", "out/d.stl"},
      {"replay", at("DOE^JANE.ostia"), "-o", at("DOE^JANE.ostia")}};
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const Outcome done = ostia(commands[i] + std::vector<std::string>{"--log", "json"}, {holder, ""});
    EXPECT_EQ(done.code, i < 4 ? 0 : 3) << done.err;
    EXPECT_THAT(done.out + done.err, Not(HasSubstr("DOE^JANE")));
  }
  for (const fs::path& place : {holder / "out", folder}) {
    for (const std::string& name : names_in(place))
      EXPECT_EQ(core::read_file(place / name).find("DOE^JANE"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace ostia::testing
