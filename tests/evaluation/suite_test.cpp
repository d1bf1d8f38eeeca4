// Two runs of a suite: what is found, and what is refused.

#include "ostia/evaluation/suite.h"

#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/evaluation/suite_report.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>

#include <cmath>

namespace ostia::evaluation {
namespace {

namespace fs = std::filesystem;
using ostia::testing::temporary_folder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Runs {
  fs::path golden, result;
};

Runs two_runs() {
  const fs::path folder = temporary_folder("suite");
  Runs runs{folder / "golden", folder / "result"};
  for (const fs::path& root : {runs.golden, runs.result}) {
    fs::create_directories(root / "case00");
    fs::create_directories(root / "case01");
    for (const char* name : {"case00", "case01"})
      core::write_file(root / name / "lumen.json",
                       R"({"v":1,"seconds":3.5,"sections":[{"section":"s01","dice":0.9,"msd_mm":0.1},
                           {"section":"s02","dice":0.8,"msd_mm":0.2}],"unit":"mm"})");
  }
  return runs;
}

void write_both(const Runs& runs, const std::string& name, const std::string& golden,
                const std::string& result) {
  core::write_file(runs.golden / name, golden);
  core::write_file(runs.result / name, result);
}

std::vector<std::string> kinds_of(const SuiteResult& suite) {
  std::vector<std::string> kinds;
  for (const Finding& f : suite.findings) kinds.push_back(name_of(f.kind));
  return kinds;
}

geometry::TriMesh tube(const geometry::Vec3& shift, double radius_mm = 1.5) {
  const auto shape = geometry::straight_tube(20.0, radius_mm);
  geometry::TriMesh mesh = geometry::structured_surface(shape.tubes.front(), 64, 0.5);
  for (auto& p : mesh.points) p += shift + geometry::Vec3(40.0, 60.0, 80.0);
  return mesh;
}

geometry::VesselTree line_tree(const geometry::Vec3& shift, double radius_mm) {
  geometry::VesselTree tree;
  geometry::TreeSegment segment;
  segment.id = 0;
  segment.from = 0;
  segment.to = 1;
  for (int i = 0; i <= 100; ++i) {
    segment.axis.points.push_back(shift + geometry::Vec3(0.1 * i, 5.0, -3.0));
    segment.axis.radius.push_back(radius_mm);
  }
  geometry::complete(segment.axis);
  tree.nodes = {{0, segment.axis.points.front()}, {1, segment.axis.points.back()}};
  tree.segments.push_back(segment);
  tree.vessels.push_back({0, "LAD", {0}});
  return tree;
}

imaging::MaskVolume slab(std::int64_t thickness) {
  imaging::MaskVolume mask;
  mask.geometry.size = {10, 10, 10};
  mask.voxels.assign(1000, 0);
  for (std::int64_t i = 0; i < thickness * 100; ++i) mask.voxels[static_cast<std::size_t>(i)] = 1;
  return mask;
}

const FigurePair& figure_of(const SuiteResult& suite, const std::string& file, const std::string& key) {
  for (const ComparedFile& f : suite.files)
    for (const FigurePair& p : f.figures)
      if (f.file == file && p.key == key) return p;
  throw std::out_of_range(file + " " + key);
}

TEST(Suite, PatternsFitAsShellPatternsDo) {
  EXPECT_TRUE(fits("*", ""));
  EXPECT_TRUE(fits("*.msd_mm", "sections[s01].msd_mm"));
  EXPECT_TRUE(fits("case0?/*", "case01/a/b.json"));
  EXPECT_TRUE(fits("a*b*c", "a__b_b__c"));
  EXPECT_FALSE(fits("*.dice", "dice"));
  EXPECT_FALSE(fits("case0?", "case0"));
  EXPECT_FALSE(fits("", "x"));
}

TEST(Suite, EqualRunsHaveNoFindings) {
  const Runs runs = two_runs();
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_TRUE(suite.passed());
  EXPECT_THAT(suite.findings, IsEmpty());
  EXPECT_EQ(suite.files.size(), 2u);
  EXPECT_EQ(suite.figures, 10u) << "v and two figures of two sections, in two files; no seconds";
}

TEST(Suite, FiguresAreJudgedByTheirDirectionAndTolerance) {
  const Runs runs = two_runs();
  core::write_file(runs.result / "case01" / "lumen.json",
                   R"({"v":1,"seconds":99,"sections":[{"section":"s02","dice":0.80,"msd_mm":0.15},
                       {"section":"s01","dice":0.85,"msd_mm":0.109}],"unit":"cm"})");
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_THAT(kinds_of(suite), ElementsAre("regression", "improvement", "change"));
  EXPECT_EQ(suite.findings[0].file, "case01/lumen.json");
  EXPECT_EQ(suite.findings[0].key, "sections[s01].dice") << "named, wherever it stands in the list";
  EXPECT_DOUBLE_EQ(*suite.findings[0].golden, 0.9);
  EXPECT_DOUBLE_EQ(*suite.findings[0].result, 0.85);
  EXPECT_EQ(suite.findings[1].key, "sections[s02].msd_mm");
  EXPECT_EQ(suite.findings[2].key, "unit");
  EXPECT_FALSE(suite.passed());
}

TEST(Suite, TheFirstRuleThatFitsHolds) {
  const Runs runs = two_runs();
  const fs::path file = runs.golden.parent_path() / "F.json";
  core::write_file(file, R"({"v":1,"figures":[
    {"file":"case01/*","key":"*.dice","direction":"higher_is_better","absolute":0.1},
    {"key":"*.dice","direction":"higher_is_better","absolute":0.01}]})");
  for (const char* name : {"case00", "case01"})
    core::write_file(runs.result / name / "lumen.json",
                     R"({"v":1,"sections":[{"section":"s01","dice":0.85,"msd_mm":0.1},
                         {"section":"s02","dice":0.8,"msd_mm":0.2}],"unit":"mm"})");
  const SuiteResult suite = compare_suites(runs.golden, runs.result, read_tolerances(file));
  EXPECT_THAT(kinds_of(suite), ElementsAre("regression"));
  EXPECT_EQ(suite.findings[0].file, "case00/lumen.json");
}

TEST(Suite, MissingAndExtraAreFindings) {
  const Runs runs = two_runs();
  fs::remove_all(runs.result / "case01");
  core::write_file(runs.result / "case00" / "more.json", R"({"v":1})");
  core::write_file(runs.result / "case00" / "lumen.json",
                   R"({"v":1,"sections":[{"section":"s01","dice":0.9,"msd_mm":0.1}],"unit":"mm","new":1})");
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_EQ(suite.count(FindingKind::missing), 4u) << "a case's file, and a section's name and two figures";
  EXPECT_EQ(suite.count(FindingKind::extra), 2u);
  EXPECT_FALSE(suite.passed());
}

TEST(Suite, SurfacesAreComparedInMillimetres) {
  const Runs runs = two_runs();
  io::write_surface(runs.golden / "case00" / "lumen.vtp", tube(geometry::Vec3::Zero()));
  io::write_surface(runs.result / "case00" / "lumen.vtp", tube(geometry::Vec3(0.0, 0.0, 0.5)));
  SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_NEAR(figure_of(suite, "case00/lumen.vtp", "max_mm").result, 0.5, 0.1) << "at the ends";
  EXPECT_EQ(suite.count(FindingKind::regression), 1u);

  // Another triangulation of the same tube, and another file of it: no byte is equal, nothing is found.
  const auto shape = geometry::straight_tube(20.0, 1.5);
  geometry::TriMesh other = geometry::structured_surface(shape.tubes.front(), 80, 0.35);
  for (auto& p : other.points) p += geometry::Vec3(40.0, 60.0, 80.0);
  io::write_surface(runs.result / "case00" / "lumen.vtp", other);
  suite = compare_suites(runs.golden, runs.result);
  EXPECT_TRUE(suite.passed()) << suite_text(suite);
}

TEST(Suite, OtherUnitsAndAxesAreSaid) {
  const Runs runs = two_runs();
  io::write_surface(runs.golden / "case00" / "lumen.vtp", tube(geometry::Vec3::Zero()));
  geometry::TriMesh metres = tube(geometry::Vec3::Zero());
  for (auto& p : metres.points) p *= 0.001;
  io::write_surface(runs.result / "case00" / "lumen.vtp", metres);
  EXPECT_THAT(suite_text(compare_suites(runs.golden, runs.result)), HasSubstr("metre"));
  geometry::TriMesh ras = tube(geometry::Vec3::Zero());
  for (auto& p : ras.points) p = geometry::Vec3(-p.x(), -p.y(), p.z());
  io::write_surface(runs.result / "case00" / "lumen.vtp", ras);
  EXPECT_THAT(suite_text(compare_suites(runs.golden, runs.result)), HasSubstr("RAS"));
}

TEST(Suite, LinesAreComparedWithTheirRadii) {
  const Runs runs = two_runs();
  io::write_centerlines(runs.golden / "case00" / "lines.vtp", line_tree(geometry::Vec3::Zero(), 1.0));
  io::write_centerlines(runs.result / "case00" / "lines.vtp", line_tree(geometry::Vec3(0, 0.3, 0), 1.2));
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_NEAR(figure_of(suite, "case00/lines.vtp", "mean_mm").result, 0.3, 1e-9);
  EXPECT_NEAR(figure_of(suite, "case00/lines.vtp", "max_mm").result, 0.3, 1e-9);
  EXPECT_NEAR(figure_of(suite, "case00/lines.vtp", "radius_mm").result, 0.2, 1e-9);
  EXPECT_EQ(suite.count(FindingKind::regression), 3u);
}

TEST(Suite, ChallengeFilesAreLinesAndPoints) {
  const Runs runs = two_runs();
  write_both(runs, "case00/reference.txt", "0 0 0 1 0.1\n1 0 0 1 0.1\n2 0 0 1 0.1\n",
             "0 0 0.25 1 0.1\n1 0 0.25 1 0.1\n2 0 0.25 1 0.1\n");
  write_both(runs, "case00/pointA.txt", "1 2 3\n", "1 2 3.05\n");
  write_both(runs, "case00/notes.txt", "one text", "another text");
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_NEAR(figure_of(suite, "case00/reference.txt", "max_mm").result, 0.25, 1e-12);
  EXPECT_NEAR(figure_of(suite, "case00/pointA.txt", "max_mm").result, 0.05, 1e-12);
  EXPECT_EQ(suite.count(FindingKind::regression), 2u) << suite_text(suite);
}

TEST(Suite, MasksByDiceImagesByHounsfieldUnits) {
  const Runs runs = two_runs();
  imaging::write_image(runs.golden / "case00" / "labels.nrrd", slab(4));
  imaging::write_image(runs.result / "case00" / "labels.nrrd", slab(6));
  imaging::ImageVolume image;
  image.geometry.size = {10, 10, 10};
  for (int i = 0; i < 1000; ++i) image.voxels.push_back(static_cast<std::int16_t>(i));
  imaging::write_image(runs.golden / "case00" / "image.nrrd", image);
  for (auto& v : image.voxels) v = static_cast<std::int16_t>(v + 3);
  imaging::write_image(runs.result / "case00" / "image.nrrd", image);
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_NEAR(figure_of(suite, "case00/labels.nrrd", "dice[1]").result, 0.8, 1e-12);
  EXPECT_NEAR(figure_of(suite, "case00/image.nrrd", "mean_hu").result, 3.0, 1e-12);
  EXPECT_EQ(suite.count(FindingKind::regression), 2u);
}

TEST(Suite, FilesThatCannotBeReadAreNamedAndTheRestIsCompared) {
  const Runs runs = two_runs();
  write_both(runs, "case00/a.json", R"({"dice":0.5})", "");
  write_both(runs, "case00/b.json", R"({"dice":0.5})", R"({"dice":)");
  write_both(runs, "case00/c.json", R"({"dice":0.5})", R"({"dice":null})");
  write_both(runs, "case00/reference.txt", "0 0 0\n1 1 1\n", "0 0 0\n1 0,5 1\n");
  write_both(runs, "case00/pointB.txt", "0 0 0\n", "nan 0 0\n");
  io::write_surface(runs.golden / "case00" / "lumen.stl", tube(geometry::Vec3::Zero()));
  core::write_file(runs.result / "case00" / "lumen.stl", "solid");
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_EQ(suite.count(FindingKind::regression), 6u) << suite_text(suite);
  for (const char* name : {"a.json", "b.json", "c.json", "reference.txt", "pointB.txt", "lumen.stl"})
    EXPECT_THAT(suite_text(suite), HasSubstr(std::string("case00/") + name)) << name;
  EXPECT_EQ(suite.files.size(), 8u);
}

TEST(Suite, WhatIsNoSuiteIsRefused) {
  const Runs runs = two_runs();
  const fs::path empty = runs.golden.parent_path() / "empty";
  fs::create_directory(empty);
  EXPECT_THROW(compare_suites(empty, runs.result), InvalidInput);
  EXPECT_THROW(compare_suites(runs.golden, empty), InvalidInput);
  EXPECT_THROW(compare_suites(runs.golden / "case00" / "lumen.json", runs.result), InvalidInput);
  EXPECT_THROW(compare_suites(runs.golden / "nowhere", runs.result), InvalidInput);
  core::write_file(empty / "something.json", "{}");
  EXPECT_THROW(compare_suites(runs.golden, empty), InvalidInput) << "no file in common";
}

TEST(Suite, ToleranceFilesAreRead) {
  const fs::path file = temporary_folder("tolerance") / "F.json";
  const auto refused = [&](const std::string& text, const std::string& why) {
    core::write_file(file, text);
    try {
      read_tolerances(file);
      ADD_FAILURE() << text << " was taken";
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr(why)) << text;
      EXPECT_THAT(error.what(), HasSubstr("F.json"));
    }
  };
  refused("", "JSON");
  refused("[]", "object");
  refused("{}", "v");
  refused(R"({"v":2})", "v");
  refused(R"({"v":1,"figurs":[]})", "figurs");
  refused(R"({"v":1,"figures":[{"key":"*","absolut":1}]})", "figures[0].absolut");
  refused(R"({"v":1,"figures":[{"key":"*","absolute":-1}]})", "figures[0].absolute");
  refused(R"({"v":1,"figures":[{"key":"*","absolute":"1"}]})", "number");
  refused(R"({"v":1,"figures":[{"direction":"up"}]})", "direction");
  refused(R"({"v":1,"surfaces":[{"mean_mm":-0.1}]})", "surfaces[0].mean_mm");
  refused(R"({"v":1,"images":[{"dice":1.5}]})", "dice");
  refused(R"({"v":1,"ignore":{"keys":[1]}})", "ignore.keys");
  EXPECT_THROW(read_tolerances(file.parent_path() / "none.json"), IoError);
  core::write_file(file, R"({"v":1,"ignore":{"files":["*.html"],"keys":["*.note"]}})");
  EXPECT_THAT(read_tolerances(file).ignored_files, ElementsAre("*.html"));
  Tolerances wrong;
  wrong.figures.push_back({"*", "*", Direction::two_sided, std::nan(""), 0.0});
  EXPECT_THROW(validate(wrong), InvalidInput);
}

TEST(Suite, ContoursAreComparedWhereTheyStand) {
  const Runs runs = two_runs();
  const auto set_of = [](double radius, int sections) {
    geometry::ContourSet set;
    for (int k = 0; k < sections; ++k) {
      geometry::ContourSection section;
      section.section = "s0" + std::to_string(k + 1);
      section.vessel = "LAD";
      section.observer = "truth";
      for (int i = 0; i < 3; ++i) {
        geometry::Contour contour;
        contour.s_mm = 0.5 * i;
        for (int j = 0; j < 64; ++j) {
          const double a = -2.0 * M_PI * j / 64;  // counter-clockwise looking along +z
          contour.points.emplace_back(radius * std::cos(a), radius * std::sin(a), 0.5 * i);
        }
        section.contours.push_back(contour);
      }
      set.sections.push_back(section);
    }
    return set;
  };
  io::write_contours(runs.golden / "case00" / "contours.json", set_of(1.5, 2));
  io::write_contours(runs.result / "case00" / "contours.json", set_of(1.8, 1));
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  EXPECT_NEAR(figure_of(suite, "case00/contours.json", "mean_mm").result, 0.3, 0.002);
  EXPECT_EQ(suite.count(FindingKind::missing), 1u);
  EXPECT_EQ(suite.count(FindingKind::regression), 2u);
}

TEST(Suite, TheReportShowsWhatWasFound) {
  const Runs runs = two_runs();
  io::write_surface(runs.golden / "case00" / "lumen.vtp", tube(geometry::Vec3::Zero()));
  io::write_surface(runs.result / "case00" / "lumen.vtp", tube(geometry::Vec3(0.0, 0.3, 0.0), 1.7));
  imaging::write_image(runs.golden / "case01" / "labels.nrrd", slab(4));
  imaging::write_image(runs.result / "case01" / "labels.nrrd", slab(6));
  core::write_file(runs.result / "case01" / "lumen.json",
                   R"({"v":1,"sections":[{"section":"s01","dice":0.5,"msd_mm":0.1}],"unit":"mm"})");
  const SuiteResult suite = compare_suites(runs.golden, runs.result);
  const fs::path page = runs.golden.parent_path() / "report.html";
  write_suite_report(page, suite, runs.golden, runs.result);
  const std::string html = core::read_file(page);
  for (const char* text : {"Not passed", "sections[s01].dice", "case00/lumen.vtp", "signed distance",
                           "case01/labels.nrrd", "data:image/png"})
    EXPECT_THAT(html, HasSubstr(text));
  EXPECT_THAT(html, ::testing::Not(HasSubstr(runs.golden.parent_path().string()))) << "no path is kept";
  EXPECT_THAT(suite_json(suite), HasSubstr("\"passed\": false"));
}

TEST(Suite, CancelledItStops) {
  const Runs runs = two_runs();
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(compare_suites(runs.golden, runs.result, default_tolerances(), task), Cancelled);
}

}  // namespace
}  // namespace ostia::evaluation
