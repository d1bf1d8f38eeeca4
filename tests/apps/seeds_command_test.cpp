// Seeds from files of points, in whichever frame and unit they are; axes and landmarks as markups.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/markups_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;
using ::testing::HasSubstr;
using ::testing::Not;
using SeedsJson = nlohmann::json;
using Words = std::vector<std::string>;

constexpr double tube_mm = 30.0;
const Vec3 tube_start(20.0, -40.0, 70.0);  // far from the origin: another frame or unit is elsewhere

/// An open tube from `tube_start` along z, its coordinates multiplied.
void write_seeds_tube(const fs::path& path, double scale = 1.0) {
  const auto shape = geometry::straight_tube(tube_mm, 1.5);
  geometry::TriMesh mesh = geometry::structured_surface(shape.tubes.front(), 48, 0.4);
  for (Vec3& p : mesh.points) p = scale * (p + tube_start);
  io::write_surface(path, mesh);
}

/// One list of points as Slicer writes it.
std::string seeds_markup(const std::vector<Vec3>& points, const std::string& system = "LPS",
                         const std::string& type = "Fiducial") {
  SeedsJson markup{{"type", type}, {"coordinateSystem", system}, {"coordinateUnits", "mm"}};
  markup["controlPoints"] = SeedsJson::array();
  for (const Vec3& p : points)
    markup["controlPoints"].push_back({{"position", {p.x(), p.y(), p.z()}}, {"positionStatus", "defined"}});
  return SeedsJson{{"@schema",
                    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/"
                    "Resources/Schema/markups-schema-v1.0.3.json#"},
                   {"markups", {markup}}}
      .dump();
}

std::string typed(const Vec3& p) {
  return std::to_string(p.x()) + "," + std::to_string(p.y()) + "," + std::to_string(p.z());
}

Vec3 ras_of(const Vec3& p) {
  return {-p.x(), -p.y(), p.z()};
}

/// Where the line of a tube's centerline begins.
Vec3 first_point(const fs::path& lines) {
  const geometry::VesselTree tree = io::read_centerlines(lines);
  return geometry::vessel_axis(tree, tree.vessels.front()).points.front();
}

/// The tube's ends, so that the line runs against z, which it does not by itself.
struct TubeSeeds {
  Vec3 source = tube_start + Vec3(0, 0, tube_mm - 0.5), target = tube_start + Vec3(0, 0, 0.5);
};

void expect_from_the_far_end(const fs::path& folder, const Words& seeds,
                             const std::string& surface = "tube.stl") {
  const Outcome done = ostia(Words{"centerline", surface, "-o", "lines.csv"} + seeds, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_LT((first_point(folder / "lines.csv") - TubeSeeds{}.source).norm(), 2.0) << done.err;
}

TEST(SeedsCommand, SourceAndTargetFromFilesOfEveryKind) {
  const fs::path folder = temporary_folder("seeds");
  write_seeds_tube(folder / "tube.stl");
  const TubeSeeds at;
  core::write_file(folder / "s.mrk.json", seeds_markup({at.source}));
  core::write_file(folder / "t.mrk.json", seeds_markup({ras_of(at.target)}, "RAS"));
  const Vec3 ras = ras_of(at.source);
  core::write_file(folder / "s.fcsv", "# Markups fiducial file version = 4.11\n# CoordinateSystem = RAS\n1," +
                                          typed(ras) + ",0,0,0,1,1,1,0,F-1,,\n");
  core::write_file(folder / "s.csv", "x,y,z\n" + typed(at.source) + "\n");
  core::write_file(folder / "ras.csv", typed(ras) + ",source\n");
  expect_from_the_far_end(folder, {"--source", typed(at.source), "--target", typed(at.target)});
  expect_from_the_far_end(folder, {"--source", "s.mrk.json", "--target", "t.mrk.json"});
  expect_from_the_far_end(folder, {"--source", "s.fcsv", "--target", typed(at.target)});
  expect_from_the_far_end(folder, {"--source", "s.csv", "--target", "t.mrk.json"});
  expect_from_the_far_end(folder, {"--source", "ras.csv", "--coords", "ras"});
  expect_from_the_far_end(folder, {"--source", "s.mrk.json", "--coords", "ras"});  // markups say their own
}

TEST(SeedsCommand, SeedsAreInTheSurfacesOwnUnit) {
  const fs::path folder = temporary_folder("seeds");
  write_seeds_tube(folder / "cm.stl", 0.1);
  const TubeSeeds at;
  core::write_file(folder / "s.csv", typed(0.1 * at.source) + "\n");
  core::write_file(folder / "mm.csv", typed(at.source) + "\n");
  core::write_file(folder / "slicer.mrk.json", seeds_markup({0.1 * at.source}));  // Slicer knows no cm
  core::write_file(folder / "mm.mrk.json", seeds_markup({at.source}));
  const Words cm{"--units", "cm"};
  expect_from_the_far_end(folder, cm + Words{"--source", typed(0.1 * at.source)}, "cm.stl");
  expect_from_the_far_end(folder, cm + Words{"--source", "s.csv"}, "cm.stl");
  expect_from_the_far_end(folder, cm + Words{"--source", "slicer.mrk.json"}, "cm.stl");
  expect_from_the_far_end(folder, cm + Words{"--source", "mm.mrk.json"}, "cm.stl");
  expect_from_the_far_end(folder, cm + Words{"--source", "mm.csv", "--seed-units", "mm"}, "cm.stl");
  expect_from_the_far_end(folder, cm + Words{"--source", typed(at.source), "--seed-units", "mm"}, "cm.stl");
  const Outcome told = ostia(
      Words{"centerline", "cm.stl", "-o", "lines.csv", "--source", "slicer.mrk.json"} + cm, {folder, ""});
  EXPECT_THAT(told.err, HasSubstr("the surface's own unit"));
}

TEST(SeedsCommand, BranchesFromAFileAreThoseThatAreTyped) {
  const SmallCase small = small_case();
  const Setting in{small.folder, ""};
  ASSERT_EQ(ostia(Words{"segment", small.image, "-o", "typed.ply"} + small.branch_arguments, in).code, 0);
  std::vector<std::string> rows;
  for (const std::string& argument : small.branch_arguments_ras)
    if (argument != "--branch") {
      std::string row = argument;
      std::replace(row.begin(), row.end(), ':', '\n');
      rows.push_back(row + "\n");
    }
  core::write_file(small.folder / "two.csv", rows[0] + "\n" + rows[1]);  // an empty row between two vessels
  const Outcome done =
      ostia({"segment", small.image, "-o", "read.ply", "--branch", "two.csv", "--coords", "ras"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(core::read_file(small.folder / "read.ply"), core::read_file(small.folder / "typed.ply"));
}

TEST(SeedsCommand, ACurveOfManyPointsIsOneVessel) {
  const SmallCase small = small_case();
  const Setting in{small.folder, ""};
  const std::string& branch = small.branch_arguments[1];
  ASSERT_EQ(ostia({"segment", small.image, "-o", "typed.vtp", "--branch", branch}, in).code, 0);
  ASSERT_EQ(ostia({"centerline", "typed.vtp", "-o", "curve.mrk.json"}, in).code, 0);
  const Outcome done = ostia({"segment", small.image, "-o", "read.vtp", "--branch", "curve.mrk.json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const SeedsJson likeness =
      SeedsJson::parse(ostia({"evaluate", "surface", "typed.vtp", "read.vtp", "--json"}, in).out);
  EXPECT_LT(likeness["msd_mm"].get<double>(), 0.15);
}

TEST(SeedsCommand, BadSeedFilesAreThreeAndNamed) {
  const fs::path folder = temporary_folder("seeds");
  write_seeds_tube(folder / "tube.stl");
  const TubeSeeds at;
  core::write_file(folder / "two.mrk.json", seeds_markup({at.source, at.target}));
  core::write_file(folder / "bad.mrk.json", "{");
  core::write_file(folder / "bad.csv", "1,2\n");
  core::write_file(folder / "seeds.txt", "1 2 3\n");
  const auto refused = [&](const Words& seeds, const std::string& why) {
    const Outcome done = ostia(Words{"centerline", "tube.stl", "-o", "lines.csv"} + seeds, {folder, ""});
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_THAT(done.err, HasSubstr(why));
    EXPECT_FALSE(fs::exists(folder / "lines.csv"));
  };
  refused({"--source", "two.mrk.json"}, "--source: two.mrk.json has 2 points where one is wanted");
  refused({"--source", "bad.mrk.json"}, "no JSON");
  refused({"--target", "bad.csv"}, "line 1");
  refused({"--target", "seeds.txt"}, ".mrk.json, .fcsv, .csv");
  refused({"--target", "none.fcsv"}, "none.fcsv");
  const SmallCase small = small_case();
  core::write_file(small.folder / "one.mrk.json", seeds_markup({at.source}));
  const Outcome one =
      ostia({"segment", small.image, "-o", "a.ply", "--branch", "one.mrk.json"}, {small.folder, ""});
  EXPECT_EQ(one.code, 3);
  EXPECT_THAT(one.err, HasSubstr("one.mrk.json"));
  EXPECT_THAT(one.err, HasSubstr("has one point"));
}

TEST(SeedsCommand, ResultsKnowASeedFileByItsContentAlone) {
  const fs::path folder = temporary_folder("seeds");
  write_seeds_tube(folder / "tube.stl");
  core::write_file(folder / "SmithJohn.mrk.json", seeds_markup({TubeSeeds{}.source}));
  const Words measure{"measure", "tube.stl", "-o", "out", "--source", "SmithJohn.mrk.json"};
  ASSERT_EQ(ostia(measure, {folder, ""}).code, 0);
  for (const std::string& name : names_in(folder / "out"))
    if (name.ends_with(".json") || name.ends_with(".html")) {
      EXPECT_THAT(core::read_file(folder / "out" / name), Not(HasSubstr("SmithJohn"))) << name;
    }
  EXPECT_THAT(ostia(measure, {folder, ""}).err, HasSubstr("done already"));
  core::write_file(folder / "SmithJohn.mrk.json", seeds_markup({TubeSeeds{}.target}));
  EXPECT_THAT(ostia(measure, {folder, ""}).err, Not(HasSubstr("done already"))) << "the seeds are others";
}

TEST(SeedsCommand, AxesGoOutAsMarkupsAndComeBack) {
  const fs::path folder = temporary_folder("seeds");
  const Setting in{folder, ""};
  write_seeds_tube(folder / "tube.stl");
  ASSERT_EQ(ostia({"centerline", "tube.stl", "-o", "lines.mrk.json"}, in).code, 0);
  ASSERT_EQ(ostia({"centerline", "tube.stl", "-o", "lines.vtp"}, in).code, 0);
  ASSERT_EQ(ostia({"convert", "lines.vtp", "axes.mrk.json"}, in).code, 0);
  EXPECT_EQ(core::read_file(folder / "axes.mrk.json"), core::read_file(folder / "lines.mrk.json"));
  const SeedsJson axes = SeedsJson::parse(core::read_file(folder / "axes.mrk.json"));
  ASSERT_EQ(axes["markups"].size(), 1u);
  EXPECT_NEAR(axes["markups"][0]["measurements"][0]["controlPointValues"][10].get<double>(), 1.5, 0.05);
  ASSERT_EQ(ostia({"convert", "axes.mrk.json", "back.csv"}, in).code, 0);
  ASSERT_EQ(ostia({"convert", "lines.vtp", "lines.csv"}, in).code, 0);
  EXPECT_EQ(core::read_file(folder / "back.csv"), core::read_file(folder / "lines.csv"));
  const Outcome info = ostia({"info", "axes.mrk.json", "--json"}, in);
  ASSERT_EQ(info.code, 0) << info.err;
  EXPECT_EQ(SeedsJson::parse(info.out)["ends"], 1);
  EXPECT_EQ(ostia({"measure", "axes.mrk.json", "-o", "measures"}, in).code, 0);
  EXPECT_EQ(ostia({"convert", "tube.stl", "axes.mrk.json"}, in).code, 3) << "a surface has no axes yet";
  EXPECT_EQ(ostia({"convert", "lines.vtp", "a.csv", "--landmarks"}, in).code, 2);
}

TEST(SeedsCommand, LandmarksOfACase) {
  const fs::path folder = temporary_folder("seeds");
  geometry::VesselTree tree;
  geometry::Centerline axis = geometry::straight_tube(24.0, 1.5, 0.5).tubes.front().axis;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, "LAD", {3}}};
  {
    auto file = session::CaseFile::create(folder / "heart.ostia", lumen::model_of_tubes(tree), {});
    analysis::Measurement distance;
    distance.name = "neck";
    distance.points = {{1, 2, 3}, {4, 5, 6}};
    file.annotate(session::MeasureAdd{distance});
  }
  const Setting in{folder, ""};
  ASSERT_EQ(ostia({"convert", "heart.ostia", "marks.mrk.json", "--landmarks"}, in).code, 0);
  const io::MarkupsFile marks = io::read_markups(folder / "marks.mrk.json");
  ASSERT_EQ(marks.markups.size(), 3u) << "no bifurcation";
  EXPECT_EQ(marks.markups[0].labels, (Words{"LAD ostium"}));
  EXPECT_EQ(marks.markups[1].labels, (Words{"LAD end"}));
  EXPECT_LT((marks.markups[1].points[0] - Vec3(0, 0, 24)).norm(), 1e-9);
  EXPECT_EQ(marks.markups[2].labels, (Words{"neck, 1", "neck, 2"}));
  EXPECT_EQ(marks.markups[2].points[1], Vec3(4, 5, 6));
  ASSERT_EQ(ostia({"convert", "heart.ostia", "marks.fcsv"}, in).code, 0);
  EXPECT_EQ(io::read_markups(folder / "marks.fcsv").markups[0].points.size(), 4u);
  ASSERT_EQ(ostia({"convert", "heart.ostia", "axes.mrk.json"}, in).code, 0);
  EXPECT_EQ(io::read_markups(folder / "axes.mrk.json").markups[0].kind, io::MarkupKind::curve);
  EXPECT_EQ(ostia({"convert", "heart.ostia", "axes.mrk.json", "--repair"}, in).code, 2);
}

}  // namespace
}  // namespace ostia::testing
