// Axes and landmarks as markups: nothing is lost on the way out and back.

#include "io_test_support.h"

#include "ostia/io/centerline_file.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/markups_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::io {
namespace {

using geometry::Vec3;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using MarkupsJson = nlohmann::json;

/// A stem of 10 mm that divides in two.
geometry::VesselTree forked_tree() {
  geometry::VesselTree tree;
  const auto add = [&](std::int32_t id, std::int32_t from, std::int32_t to, double radius) {
    geometry::TreeSegment segment{id, from, to, {}};
    const Vec3 a = tree.nodes[static_cast<std::size_t>(from)].position;
    const Vec3 b = tree.nodes[static_cast<std::size_t>(to)].position;
    for (int i = 0; i <= 10; ++i) {
      segment.axis.points.push_back(a + (b - a) * i / 10.0);
      segment.axis.radius.push_back(radius - 0.01 * i);
    }
    geometry::complete(segment.axis);
    tree.segments.push_back(segment);
  };
  tree.nodes = {{0, {0, 0, 0}}, {1, {0, 0, 10}}, {2, {4, 0, 18}}, {3, {-4, 1, 18}}};
  add(10, 0, 1, 2.0);
  add(11, 1, 2, 1.9);
  add(12, 1, 3, 1.9);
  tree.vessels = {{1, "LAD", {10, 11}}, {2, "LCX", {10, 12}}};
  return tree;
}

TEST(MarkupsOut, AxesAreCurvesWithARadiusAtEachPoint) {
  const auto path = testing::temporary_folder("io") / "axes.mrk.json";
  write_centerlines(path, forked_tree());
  const MarkupsJson file = MarkupsJson::parse(core::read_file(path));
  EXPECT_EQ(
      file["@schema"],
      "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
      "markups-schema-v1.0.3.json#");
  ASSERT_EQ(file["markups"].size(), 2u) << "one curve for each vessel";
  for (const MarkupsJson& curve : file["markups"]) {
    EXPECT_EQ(curve["type"], "Curve");
    EXPECT_EQ(curve["coordinateSystem"], "LPS");
    EXPECT_EQ(curve["coordinateUnits"], "mm");
    ASSERT_EQ(curve["controlPoints"].size(), 21u);
    ASSERT_EQ(curve["measurements"].size(), 1u);
    EXPECT_EQ(curve["measurements"][0]["name"], "Radius");
    EXPECT_EQ(curve["measurements"][0]["units"], "mm");
    EXPECT_EQ(curve["measurements"][0]["controlPointValues"].size(), 21u);
  }
  EXPECT_EQ(file["markups"][0]["name"], "LAD");
  EXPECT_EQ(file["markups"][0]["controlPoints"][20]["position"], MarkupsJson({4.0, 0.0, 18.0}));
  EXPECT_EQ(file["markups"][0]["measurements"][0]["controlPointValues"][0], 2.0);
}

TEST(MarkupsOut, AxesComeBackAsTheTree) {
  const auto path = testing::temporary_folder("io") / "axes.mrk.json";
  const geometry::VesselTree tree = forked_tree();
  write_centerlines(path, tree);
  const geometry::VesselTree back = read_centerlines(path);
  EXPECT_FALSE(geometry::find_fault(back).has_value());
  ASSERT_EQ(back.segments.size(), 3u) << "the stem once";
  ASSERT_EQ(back.vessels.size(), 2u);
  for (std::size_t v = 0; v < 2; ++v) {
    EXPECT_EQ(back.vessels[v].name, tree.vessels[v].name);
    const geometry::Centerline a = geometry::vessel_axis(tree, tree.vessels[v]);
    const geometry::Centerline b = geometry::vessel_axis(back, back.vessels[v]);
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_EQ(a.points[i], b.points[i]);
      EXPECT_NEAR(a.radius[i], b.radius[i], 1e-12);
    }
  }
  EXPECT_TRUE(is_graph_file(path));
  EXPECT_EQ(read_graph(path).graph.edges.size(), 30u);
}

TEST(MarkupsOut, LandmarksAreWhereVesselsBeginDivideAndEnd) {
  const std::vector<Markup> lists = landmarks_of(forked_tree());
  ASSERT_EQ(lists.size(), 3u);
  EXPECT_EQ(lists[0].name, "ostia");
  EXPECT_THAT(lists[0].points, ElementsAre(Vec3(0, 0, 0)));
  EXPECT_THAT(lists[0].labels, ElementsAre("LAD ostium"));
  EXPECT_EQ(lists[1].name, "bifurcations");
  EXPECT_THAT(lists[1].points, ElementsAre(Vec3(0, 0, 10)));
  EXPECT_THAT(lists[1].labels, ElementsAre("LAD/LCX bifurcation"));
  EXPECT_EQ(lists[2].name, "ends");
  EXPECT_THAT(lists[2].labels, ElementsAre("LAD end", "LCX end"));
  EXPECT_THAT(landmarks_of({}), IsEmpty());
}

TEST(MarkupsOut, ListsRoundTrip) {
  const std::vector<Markup> lists = landmarks_of(forked_tree());
  const auto folder = testing::temporary_folder("io");
  write_markups(folder / "a.mrk.json", lists);
  const MarkupsFile json = read_markups(folder / "a.mrk.json");
  EXPECT_THAT(json.warnings, IsEmpty());
  ASSERT_EQ(json.markups.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(json.markups[i].name, lists[i].name);
    EXPECT_EQ(json.markups[i].points, lists[i].points);
    EXPECT_EQ(json.markups[i].labels, lists[i].labels);
  }
  write_markups(folder / "A.FCSV", lists);
  const MarkupsFile fcsv = read_markups(folder / "A.FCSV");
  ASSERT_EQ(fcsv.markups.size(), 1u);
  EXPECT_THAT(fcsv.markups[0].points,
              ElementsAre(Vec3(0, 0, 0), Vec3(0, 0, 10), Vec3(4, 0, 18), Vec3(-4, 1, 18)));
  EXPECT_THAT(core::read_file(folder / "A.FCSV"), HasSubstr("\n3,-4,0,18,0,0,0,1,1,1,0,LAD end,ends,\n"))
      << "RAS";
}

TEST(MarkupsOut, WhatCannotBeReadAgainIsNotWritten) {
  const auto folder = testing::temporary_folder("io");
  const Markup good{MarkupKind::curve, "a", {{0, 0, 0}, {0, 0, 1}}, {}, {1.0, 1.0}};
  const auto refuses = [&](const auto& change, const std::string& name = "a.mrk.json") {
    Markup bad = good;
    change(bad);
    EXPECT_THROW(write_markups(folder / name, {bad}), InvalidInput);
    EXPECT_FALSE(std::filesystem::exists(folder / name));
  };
  refuses([](Markup& m) { m.points[1].x() = std::nan(""); });
  refuses([](Markup& m) { m.radius[1] = 0.0; });
  refuses([](Markup& m) { m.radius.pop_back(); });
  refuses([](Markup& m) { m.labels = {"one"}; });
  refuses([](Markup& m) { m.points.clear(); });
  refuses([](Markup&) {}, "a.json");
  EXPECT_THROW(write_markups(folder / "a.fcsv", {}), InvalidInput);
  Markup foreign = good;
  foreign.name = "K\xFCnstler";  // Latin-1
  write_markups(folder / "b.mrk.json", {foreign});
  EXPECT_EQ(read_markups(folder / "b.mrk.json").markups[0].points, good.points);
}

std::string lists_of(const std::string& members) {
  return R"({"@schema":"markups-schema-v1.0.3.json#","markups":[{)" + members + "}]}";
}

TEST(MarkupsOut, CurvesWithoutARadiusAreNoCenterlines) {
  const auto path = file_with(
      "axes.mrk.json",
      lists_of(R"("type":"Curve","name":"LAD","controlPoints":[{"position":[0,0,0]},{"position":[0,0,1]}])"));
  expect_refusal(path, [&] { read_centerlines(path); }, {"\"LAD\"", "Radius"});
  const auto points =
      file_with("p.mrk.json", lists_of(R"("type":"Fiducial","controlPoints":[{"position":[0,0,0]}])"));
  expect_refusal(points, [&] { read_centerlines(points); }, {"no curve"});
}

}  // namespace
}  // namespace ostia::io
