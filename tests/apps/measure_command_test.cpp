#include "program.h"

#include "ostia/core/files.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/io/surface_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace ostia::testing {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

/// A trunk of 10 mm, two children of 5 mm each, all as wide as Murray's law wants; a stray vessel across one.
constexpr const char* measure_fork =
    "x1,y1,z1,radius1,x2,y2,z2,radius2\n"
    "0,0,0,1,0,0,10,1\n"
    "0,0,10,0.793700526,3,0,14,0.793700526\n"
    "0,0,10,0.793700526,-3,0,14,0.793700526\n";

TEST(MeasureCommand, AForkIsMeasuredAsItIs) {
  const auto folder = temporary_folder("measure");
  core::write_file(folder / "tree.csv", measure_fork);
  const Setting in{folder, ""};
  const Outcome done = ostia({"measure", "tree.csv", "-o", "out", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const json m = json::parse(done.out);
  EXPECT_EQ(m["segments"], 3);
  EXPECT_EQ(m["ends"], 2);
  EXPECT_NEAR(m["length_mm"].get<double>(), 20.0, 1e-9);
  const double child = 0.793700526;
  EXPECT_NEAR(m["volume_mm3"].get<double>(), std::numbers::pi * (10.0 + 10.0 * child * child), 1e-6);
  EXPECT_NEAR(m["murray_exponent"].get<double>(), 3.0, 1e-6);
  EXPECT_NEAR(m["median_angles_deg"]["between"].get<double>(), 2.0 * std::atan2(3.0, 4.0) * 180.0 / M_PI,
              1e-6);
  EXPECT_EQ(m["overlaps"]["count"], 0);
  EXPECT_EQ(core::read_file(folder / "out/measures.json"), done.out);
  for (const char* name : {"segments.csv", "branches.csv", "orders.csv", "connectivity.csv", "forks.csv",
                           "overlaps.csv", "report.html", "manifest.json", "pictures/murray.png"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_THAT(core::read_file(folder / "out/segments.csv"), HasSubstr("0.793700526"));
  EXPECT_THAT(ostia({"measure", "tree.csv", "-o", "out"}, in).err, HasSubstr("done already"));
}

TEST(MeasureCommand, VesselsThatCrossAreListedByTheirLines) {
  const auto folder = temporary_folder("measure_cross");
  core::write_file(folder / "tree.csv", std::string(measure_fork) + "-5,0,5,0.5,5,0,5,0.5\n");
  const Setting in{folder, ""};
  const Outcome done = ostia({"measure", "tree.csv", "-o", "out", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const json overlaps = json::parse(done.out)["overlaps"];
  ASSERT_EQ(overlaps["count"], 1);
  EXPECT_EQ(overlaps["first"][0]["references"], (json{2, 5}));  // lines of the file
  EXPECT_NEAR(overlaps["first"][0]["depth_mm"].get<double>(), 1.5, 1e-6);
}

TEST(MeasureCommand, ASurfaceIsMeasuredByItsCenterlines) {
  const auto folder = temporary_folder("measure_surface");
  io::write_surface(folder / "tube.stl",
                    geometry::structured_surface(geometry::straight_tube(30.0, 2.0).tubes.front(), 48, 0.5));
  const Setting in{folder, ""};
  const Outcome done = ostia({"measure", "tube.stl", "-o", "out", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const json m = json::parse(done.out);
  EXPECT_NEAR(m["length_mm"].get<double>(), 30.0, 1.0);
  EXPECT_NEAR(m["volume_mm3"].get<double>() / (std::numbers::pi * 4.0 * 30.0), 1.0, 0.06);
}

TEST(MeasureCommand, WhatCannotBeMeasuredIsToldAndLeavesNothing) {
  const auto folder = temporary_folder("measure_bad");
  core::write_file(folder / "bad.csv", "x1,y1,z1,radius1,x2,y2,z2,radius2\n0,0,0,1,0,0,0,1\n");
  core::write_file(folder / "tree.csv", measure_fork);
  const Setting in{folder, ""};
  const Outcome bad = ostia({"measure", "bad.csv", "-o", "out"}, in);
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("--repair"));
  EXPECT_EQ(ostia({"measure", "none.csv", "-o", "out"}, in).code, 3);
  const Outcome useless = ostia({"measure", "tree.csv", "-o", "out", "--source", "0,0,0"}, in);
  EXPECT_EQ(useless.code, 2);
  EXPECT_THAT(useless.err, HasSubstr("surfaces"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace ostia::testing
