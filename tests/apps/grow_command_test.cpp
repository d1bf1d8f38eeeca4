#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace ostia::testing {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A fork on a sphere of radius 40 mm about the origin: its ends have the diameter of order 5.
constexpr const char* fork =
    "id,x,y,z,radius,parent\n"
    "1,40,0,0,0.2,-1\n"
    "2,38.637033,10.352762,0,0.15,1\n"
    "3,34.641016,17.320508,10,0.033,2\n"
    "4,34.641016,17.320508,-10,0.033,2\n";

TEST(GrowCommand, ATreeGrowsAndIsTheSameForItsSeed) {
  const auto folder = temporary_folder("grow");
  core::write_file(folder / "tree.csv", fork);
  const Setting in{folder, ""};
  const Outcome done = ostia({"grow", "tree.csv", "-o", "grown.vtp", "--seed", "3", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto facts = nlohmann::json::parse(done.out);
  const auto segments = facts["segments"].get<std::size_t>();
  EXPECT_GT(segments, 100U);
  EXPECT_EQ(facts["grown_segments"].get<std::size_t>(), segments - 3);
  EXPECT_EQ(io::read_graph(folder / "grown.vtp").graph.edges.size(), segments);
  const std::string first = core::read_file(folder / "grown.vtp");
  ASSERT_EQ(ostia({"grow", "tree.csv", "-o", "again.vtp", "--seed", "3"}, in).code, 0);
  EXPECT_EQ(core::read_file(folder / "again.vtp"), first);
}

// Each grown segment's order and element; 0 and -1 for what was there before.
TEST(GrowCommand, OrdersAndElementsAreKept) {
  const auto folder = temporary_folder("grow_orders");
  core::write_file(folder / "tree.csv", fork);
  const Setting in{folder, ""};
  ASSERT_EQ(ostia({"grow", "tree.csv", "-o", "grown.csv"}, in).code, 0);
  const std::string table = core::read_file(folder / "grown.csv");
  EXPECT_THAT(table, StartsWith("x1,y1,z1,radius1,x2,y2,z2,radius2,Order,Element\n40,0,0,0.2,"));
  EXPECT_THAT(table.substr(0, table.find('\n', table.find("40,0,0"))), EndsWith(",0,-1"));
  EXPECT_THAT(table, HasSubstr(",5,0\n"));
  EXPECT_THAT(table, HasSubstr(",1,"));
  ASSERT_EQ(ostia({"grow", "tree.csv", "-o", "grown.vtp"}, in).code, 0);
  const std::string vtp = core::read_file(folder / "grown.vtp");
  EXPECT_THAT(vtp, HasSubstr("Name=\"Order\""));
  EXPECT_THAT(vtp, HasSubstr("Name=\"Element\""));
  const Outcome swc = ostia({"grow", "tree.csv", "-o", "grown.swc"}, in);
  ASSERT_EQ(swc.code, 0);
  EXPECT_THAT(swc.err, HasSubstr("SWC has no place for the segments' Order"));
}

TEST(GrowCommand, RefusesWhatIsNoTreeAndWrongWords) {
  const auto folder = temporary_folder("grow_bad");
  core::write_file(folder / "line.csv", "id,x,y,z,radius,parent\n1,0,0,0,1,-1\n2,0,0,1,1,1\n");
  core::write_file(folder / "bad.csv", "id,x,y,z,radius,parent\n1,0,0,0,1,-1\n2,0,0,1,-4,1\n");
  core::write_file(folder / "tree.csv", fork);
  const Setting in{folder, ""};
  const Outcome flat = ostia({"grow", "line.csv", "-o", "grown.vtp"}, in);
  EXPECT_EQ(flat.code, 3);
  EXPECT_THAT(flat.err, HasSubstr("sphere"));
  const Outcome bad = ostia({"grow", "bad.csv", "-o", "grown.vtp"}, in);
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("--repair"));
  EXPECT_THAT(bad.err, HasSubstr("(line 3)"));
  EXPECT_EQ(ostia({"grow", "tree.csv", "-o", "grown.vtp", "--artery", "aorta"}, in).code, 2);
  EXPECT_EQ(ostia({"grow", "tree.csv", "-o", "grown.vtp", "--most-segments", "10"}, in).code, 5);
  EXPECT_FALSE(std::filesystem::exists(folder / "grown.vtp"));
}

TEST(GrowCommand, AnOpenDomainAndAGrowthWithoutRoomAreTold) {
  const auto folder = temporary_folder("grow_room");
  core::write_file(folder / "tree.csv", fork);
  io::write_surface(folder / "open.stl", geometry::structured_surface(
                                             geometry::straight_tube(80.0, 60.0).tubes.front(), 24, 10.0));
  const Setting in{folder, ""};
  const Outcome open = ostia({"grow", "tree.csv", "-o", "grown.vtp", "--domain", "open.stl"}, in);
  EXPECT_EQ(open.code, 3);
  EXPECT_THAT(open.err, HasSubstr("open edges"));
  const Outcome narrow = ostia({"grow", "tree.csv", "-o", "grown.vtp", "--wall", "0.001"}, in);
  EXPECT_EQ(narrow.code, 4);
  EXPECT_THAT(narrow.err, HasSubstr("--wall"));
}

}  // namespace
}  // namespace ostia::testing
