// Markups of 3D Slicer and tables of points: what is read, what is refused, and that nothing is lost on the
// way out and back.

#include "ostia/io/markups_file.h"

#include "io_test_support.h"

#include <gmock/gmock.h>

namespace ostia::io {
namespace {

using geometry::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string slicer_schema =
    "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
    "markups-schema-v1.0.3.json#";

/// A file whose one markup has these further members.
std::string file_of(const std::string& members, const std::string& schema = slicer_schema) {
  return R"({"@schema":")" + schema + R"(","markups":[{)" + members + "}]}";
}

MarkupsFile from_text(const std::string& text, const std::string& name = "seeds.mrk.json") {
  return read_markups(file_with(name, text));
}

void refused(const std::string& text, const std::vector<std::string>& parts,
             const std::string& name = "seeds.mrk.json") {
  const auto path = file_with(name, text);
  expect_refusal(
      path, [&] { read_markups(path); }, parts);
}

// As Slicer's own documentation has it.
TEST(MarkupsFile, ReadsTheExampleOfSlicersDocumentation) {
  const MarkupsFile file = from_text(
      R"({"@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.0.json#",
"markups": [{"type": "Fiducial", "coordinateSystem": "LPS", "controlPoints": [
    { "label": "F-1", "position": [-53.388409961685827, -73.33572796934868, 0.0] },
    { "label": "F-2", "position": [49.8682950191571, -88.58955938697324, 0.0] },
    { "label": "F-3", "position": [-25.22749042145594, 59.255268199233729, 0.0] }
]}]})");
  ASSERT_EQ(file.markups.size(), 1u);
  EXPECT_EQ(file.markups[0].kind, MarkupKind::fiducials);
  EXPECT_THAT(file.markups[0].labels, ElementsAre("F-1", "F-2", "F-3"));
  EXPECT_EQ(file.markups[0].points[1], Vec3(49.8682950191571, -88.58955938697324, 0.0));
  EXPECT_TRUE(file.frame_told);
  EXPECT_FALSE(file.unit_mm.has_value());
  EXPECT_THAT(file.warnings, IsEmpty());
}

TEST(MarkupsFile, FramesAndUnitsAreTheFilesOwn) {
  const auto first = [](const std::string& members) {
    return from_text(file_of(R"("type":"Fiducial",)" + members + R"("controlPoints":[{"position":[1,2,3]}])"))
        .markups[0]
        .points[0];
  };
  EXPECT_EQ(first(""), Vec3(1, 2, 3)) << "LPS unless it is said";
  EXPECT_EQ(first(R"("coordinateSystem":"LPS",)"), Vec3(1, 2, 3));
  EXPECT_EQ(first(R"("coordinateSystem":"RAS",)"), Vec3(-1, -2, 3));
  EXPECT_EQ(first(R"("coordinateSystem":"0",)"), Vec3(-1, -2, 3));
  EXPECT_EQ(first(R"("coordinateSystem":1,)"), Vec3(1, 2, 3));
  EXPECT_EQ(first(R"("coordinateUnits":"cm",)"), Vec3(10, 20, 30));
  EXPECT_EQ(first(R"("coordinateUnits":["mm","UCUM","millimeter"],)"), Vec3(1, 2, 3));
  EXPECT_EQ(first(R"("coordinateSystem":"RAS","coordinateUnits":"m",)"), Vec3(-1000, -2000, 3000));
}

TEST(MarkupsFile, KindsOfMarkupsAndWhatIsLeftOut) {
  const MarkupsFile file = from_text(R"({"@schema":")" + slicer_schema + R"(","markups":[
    {"type":"Curve","name":"LAD","coordinateUnits":"mm","controlPoints":[{"position":[0,0,0]},{"position":[0,0,1]}],
     "measurements":[{"name":"length","value":1.0},{"name":"Radius","units":"mm","controlPointValues":[1.5,1.25]}]},
    {"type":"ClosedCurve","controlPoints":[{"position":[1,0,0]}]},
    {"type":"Line","controlPoints":[{"position":[2,0,0]},{"position":[3,0,0]}]},
    {"type":"Plane","controlPoints":[{"position":[4,0,0]}]},
    {"type":"Fiducial","name":"F","controlPoints":[
       {"label":"a","position":[5,0,0],"positionStatus":"defined"},
       {"label":"b","position":"","positionStatus":"undefined"},
       {"label":"c","positionStatus":"missing"},
       {"label":"d","position":[6,0,0]}]},
    {"type":"Fiducial","name":"none","controlPoints":[]}]})");
  ASSERT_EQ(file.markups.size(), 4u);
  EXPECT_EQ(file.markups[0].kind, MarkupKind::curve);
  EXPECT_EQ(file.markups[0].name, "LAD");
  EXPECT_THAT(file.markups[0].radius, ElementsAre(1.5, 1.25));
  EXPECT_EQ(file.markups[1].kind, MarkupKind::closed_curve);
  EXPECT_EQ(file.markups[2].kind, MarkupKind::line);
  EXPECT_THAT(file.markups[3].labels, ElementsAre("a", "d"));
  EXPECT_EQ(file.unit_mm, 1.0);
  ASSERT_EQ(file.warnings.size(), 3u);
  EXPECT_THAT(file.warnings[0], HasSubstr("markups[3] is of the type \"Plane\""));
  EXPECT_THAT(file.warnings[1], HasSubstr("2 points whose position is not defined"));
  EXPECT_THAT(file.warnings[2], HasSubstr("\"none\", has no points"));
}

TEST(MarkupsFile, ARadiusThatDoesNotFitIsLeftOutAndTold) {
  for (const char* values : {"[1.5]", "[1.5,-1]", "[1.5,null]", "[1.5,1e99]"}) {
    const MarkupsFile file = from_text(file_of(
        R"("type":"Curve","controlPoints":[{"position":[0,0,0]},{"position":[0,0,1]}],"measurements":[{"name":"Radius","controlPointValues":)" +
        std::string(values) + "}]"));
    EXPECT_THAT(file.markups[0].radius, IsEmpty()) << values;
    ASSERT_EQ(file.warnings.size(), 1u) << values;
    EXPECT_THAT(file.warnings[0], HasSubstr("Radius"));
  }
}

TEST(MarkupsFile, BadJsonIsNamedWithItsPlace) {
  const auto point = [](const std::string& members) {
    return file_of(R"("type":"Fiducial","controlPoints":[{"position":[0,0,0]},{)" + members + "}]");
  };
  refused("", {"no JSON"});
  refused("{", {"no JSON"});
  refused("[]", {"no list \"markups\""});
  refused(R"({"markups":{}})", {"no list \"markups\""});
  refused(R"({"v":1,"kind":"case"})", {"no list \"markups\""});
  refused(point(R"("position":[0,NaN,0])"), {"no JSON", "NaN"});
  refused(point(R"("position":[0,1e999,0])"), {"no JSON"});
  refused(point(R"("position":[0,1e300,0])"), {"markups[0].controlPoints[1].position"});
  refused(point(R"("position":[0,0])"), {"controlPoints[1].position is not [x, y, z]"});
  refused(point(R"("position":["0",0,0])"), {"controlPoints[1].position is not [x, y, z]"});
  refused(point(R"("label":"x")"), {"controlPoints[1] has no position"});
  refused(point(R"("position":[0,0,0],"positionStatus":"lost")"), {"controlPoints[1].positionStatus"});
  refused(file_of(R"("type":"Fiducial","controlPoints":[3])"), {"controlPoints[0] is no object"});
  refused(file_of(R"("type":"Fiducial")"), {"markups[0] has no list"});
  refused(file_of(R"("type":"Fiducial","controlPoints":[])"), {"no point"});
  refused(file_of(R"("type":"ROI","controlPoints":[{"position":[0,0,0]}])"), {"no point"});
  refused(file_of(R"("type":"Fiducial","controlPoints":[{"position":"","positionStatus":"undefined"}])"),
          {"no point whose position is defined"});
  refused(file_of(R"("type":"Fiducial","coordinateSystem":"IJK","controlPoints":[])"),
          {"neither LPS nor RAS"});
  refused(file_of(R"("type":"Fiducial","coordinateSystem":2,"controlPoints":[])"), {"neither LPS nor RAS"});
  refused(file_of(R"("type":"Fiducial","coordinateUnits":"inch","controlPoints":[])"), {"coordinateUnits"});
  refused(file_of(R"("type":"Fiducial","controlPoints":[])", "https://example.org/other-v2.json"),
          {"schema is https://example.org/other-v2.json"});
  refused(file_of(R"("type":"Fiducial","controlPoints":[])", "markups-schema-v2.0.0.json"), {"schema 1"});
  refused(std::string(100000, '['), {"no JSON"});
  std::string many;
  for (int i = 0; i < 1'000'001; ++i) many += i == 0 ? "0" : ",0";
  refused(file_of(R"("type":"Fiducial","controlPoints":[)" + many + "]"), {"more than a million points"});
  EXPECT_THROW(read_markups("/nowhere/seeds.mrk.json"), IoError);
}

TEST(MarkupsFile, AFileWithoutASchemaIsTakenAndTold) {
  const MarkupsFile file =
      from_text(R"({"markups":[{"type":"Fiducial","controlPoints":[{"position":[1,2,3]}]}]})", "hand.json");
  EXPECT_EQ(file.markups[0].points[0], Vec3(1, 2, 3));
  ASSERT_EQ(file.warnings.size(), 1u);
}

// Slicer 3, 4.6, 4.11 and 5 have written them so.
TEST(MarkupsFile, ReadsFcsvOfAllVersions) {
  const MarkupsFile slicer3 = from_text(
      "# Fiducial List file /tmp/L.fcsv\n# version = 2\n# name = L\n# numPoints = 2\n# symbolScale = 5\n"
      "# columns = label,x,y,z,sel,vis\nL-P,1,2,3,1,1\nL-P1,4,5,6,1,1\n",
      "L.fcsv");
  EXPECT_EQ(slicer3.markups[0].name, "L");
  EXPECT_THAT(slicer3.markups[0].points, ElementsAre(Vec3(-1, -2, 3), Vec3(-4, -5, 6))) << "RAS";
  EXPECT_THAT(slicer3.markups[0].labels, ElementsAre("L-P", "L-P1"));
  const std::string columns = "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  const MarkupsFile slicer4 =
      from_text("# Markups fiducial file version = 4.6\n# CoordinateSystem = 0\n" + columns +
                    "vtkMRMLMarkupsFiducialNode_0,1.29,-40.18,60.15,0,0,0,1,1,1,0,F-1,,\r\n",
                "F.fcsv");
  EXPECT_EQ(slicer4.markups[0].points[0], Vec3(-1.29, 40.18, 60.15));
  EXPECT_EQ(slicer4.markups[0].labels[0], "F-1");
  for (const char* lps : {"LPS", "1"}) {
    const MarkupsFile file =
        from_text("# Markups fiducial file version = 4.11\n# CoordinateSystem = " + std::string(lps) + "\n" +
                      columns + "1,1,2,3,0,0,0,1,1,1,0,\"LAD, proximal\",,vtkMRMLScalarVolumeNode1\n",
                  "F.fcsv");
    EXPECT_EQ(file.markups[0].points[0], Vec3(1, 2, 3)) << lps;
    EXPECT_EQ(file.markups[0].labels[0], "LAD, proximal");
    EXPECT_FALSE(file.unit_mm.has_value());
  }
  const MarkupsFile slicer5 =
      from_text("# Markups fiducial file version = 5.6\n# CoordinateSystem = LPS\n" + columns +
                    "1,1,2,3,0,0,0,1,1,1,0,F-1,,,2,0\n2,0,0,0,0,0,0,1,1,1,0,F-2,,,0,0\n",
                "F.fcsv");
  EXPECT_THAT(slicer5.markups[0].labels, ElementsAre("F-1"));
  ASSERT_EQ(slicer5.warnings.size(), 1u);
  EXPECT_THAT(slicer5.warnings[0], HasSubstr("1 point whose position is not defined"));
}

TEST(MarkupsFile, BadFcsvIsNamedWithItsLine) {
  const std::string head = "# Markups fiducial file version = 4.11\n";
  refused("", {"no point"}, "F.fcsv");
  refused(head, {"no point"}, "F.fcsv");
  refused(head + "# CoordinateSystem = IJK\n1,1,2,3\n", {"line 2", "neither RAS (0) nor LPS (1)"}, "F.fcsv");
  refused(head + "# CoordinateSystem = 2\n1,1,2,3\n", {"line 2"}, "F.fcsv");
  refused(head + "1,1,nan,3,0,0,0,1,1,1,0,F,,\n", {"line 2", "\"nan\""}, "F.fcsv");
  refused(head + "1,1,2\n", {"line 2", "no coordinate"}, "F.fcsv");
  refused(head + "# columns = id,label\n1,a\n", {"line 3"}, "F.fcsv");
}

TEST(MarkupsFile, ReadsTablesOfPoints) {
  const auto points = [](const std::string& text, const std::string& name = "points.csv") {
    return from_text(text, name).markups[0].points;
  };
  const std::vector<Vec3> two{{1, -2, 3.5}, {4, 5, 6}};
  EXPECT_EQ(points("1,-2,3.5\n4,5,6\n"), two);
  EXPECT_EQ(points("\xEF\xBB\xBFx,y,z\r\n1,-2,3.5\r\n4,5,6\r\n"), two);
  EXPECT_EQ(points("# a comment\n1, -2, +3.5, tip\n4,5,6,base"), two);
  EXPECT_EQ(points("label,Z (mm),Y (mm),X (mm)\na,3.5,-2,1\nb,6,5,4\n"), two);
  EXPECT_EQ(points("1;-2;3.5\n4;5;6\n"), two);
  EXPECT_EQ(points("x\ty\tz\n1\t-2\t3.5\n4\t5\t6\n", "points.tsv"), two);
  EXPECT_EQ(from_text("1,-2,3.5,tip\n4,5,6,\n", "a.csv").markups[0].labels,
            (std::vector<std::string>{"tip", ""}));
  EXPECT_FALSE(from_text("x,y,z\n1,2,3\n", "a.csv").frame_told);
}

// Slicer's own export of control points.
TEST(MarkupsFile, TablesMaySayTheirFrame) {
  const MarkupsFile ras = from_text(
      "label,r,a,s,defined,selected,visible,locked,description\nF-1,1,2,3,1,1,1,0,\n"
      "F-2,7,8,9,0,1,1,0,\n",
      "F.csv");
  EXPECT_TRUE(ras.frame_told);
  EXPECT_THAT(ras.markups[0].points, ElementsAre(Vec3(-1, -2, 3)));
  EXPECT_EQ(ras.warnings.size(), 1u) << "F-2 is not defined";
  const MarkupsFile lps = from_text("label,l,p,s\nF-1,1,2,3\n", "F.csv");
  EXPECT_TRUE(lps.frame_told);
  EXPECT_EQ(lps.markups[0].points[0], Vec3(1, 2, 3));
}

TEST(MarkupsFile, ListsOfATableAreToldApart) {
  const MarkupsFile rows = from_text("0,0,0\n0,0,1\n\n5,0,0\n5,0,1\n", "a.csv");
  ASSERT_EQ(rows.markups.size(), 2u);
  EXPECT_EQ(rows.markups[1].points[0], Vec3(5, 0, 0));
  const MarkupsFile named =
      from_text("vessel,x,y,z,radius,abscissa\nLAD,0,0,0,1,0\nLAD,0,0,1,1,1\nD1,0,1,0,1,0\n", "a.csv");
  ASSERT_EQ(named.markups.size(), 2u);
  EXPECT_EQ(named.markups[0].name, "LAD");
  EXPECT_EQ(named.markups[1].points.size(), 1u);
}

TEST(MarkupsFile, BadTablesAreNamedWithTheirLine) {
  refused("", {"no point"}, "a.csv");
  refused("x,y,z\n", {"no point"}, "a.csv");
  refused("x,y\n1,2\n", {"line 1", "header that names x,y,z"}, "a.csv");
  refused("1,2\n", {"line 1"}, "a.csv");
  refused("1,2,3\n1,2\n", {"line 2", "no coordinate"}, "a.csv");
  refused("1,2,3\n1,inf,3\n", {"line 2", "\"inf\""}, "a.csv");
  refused("x,y,z\n1,2,1e300\n", {"line 2"}, "a.csv");
  refused("1,5;2,5;3,5\n", {"line 1"}, "a.csv");
  refused("x,y,z\n1,\"2,3\n", {"line 2", "quotation"}, "a.csv");
  refused("1,2,3\n", {"end in .mrk.json, .fcsv, .csv or .tsv"}, "a.txt");
}

}  // namespace
}  // namespace ostia::io
