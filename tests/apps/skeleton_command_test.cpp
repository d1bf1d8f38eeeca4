#include "program.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A tube of 2 mm radius along z, 30 mm long unless its slices are given.
imaging::MaskVolume tube(std::int64_t first = 8, std::int64_t last = 83) {
  imaging::MaskVolume mask;
  mask.geometry.size = {30, 30, 90};
  mask.geometry.spacing = {0.4, 0.4, 0.4};
  mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxels()), 0);
  for (std::int64_t k = first; k < last; ++k)
    for (std::int64_t j = 0; j < 30; ++j)
      for (std::int64_t i = 0; i < 30; ++i)
        if (std::hypot(0.4 * static_cast<double>(i) - 6.0, 0.4 * static_cast<double>(j) - 6.0) <= 2.0)
          mask(i, j, k) = 1;
  return mask;
}

TEST(SkeletonCommand, AMaskBecomesLinesWithRadiiAndATable) {
  const auto folder = temporary_folder("skeleton");
  imaging::write_image(folder / "tube.nrrd", tube());
  const Setting in{folder, ""};
  const Outcome done = ostia({"skeleton", "tube.nrrd", "-o", "lines.vtp", "--sections", "sections.csv",
                              "--inlet", "15,15,8", "--coords", "ijk", "--json"},
                             in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto facts = nlohmann::json::parse(done.out);
  EXPECT_EQ(facts["lines"], 1);
  EXPECT_EQ(facts["loops"], 0);
  EXPECT_NEAR(facts["length_mm"].get<double>(), 30.0, 1.0);
  const auto tree = io::read_centerlines(folder / "lines.vtp");
  ASSERT_EQ(tree.segments.size(), 1U);
  const auto& line = tree.segments.front().axis;
  EXPECT_LT(line.points.front().z(), line.points.back().z());
  EXPECT_NEAR(line.radius[line.radius.size() / 2], 2.0, 0.15);
  EXPECT_THAT(core::read_file(folder / "sections.csv"), StartsWith("edge,point,x_mm,"));
}

TEST(SkeletonCommand, AVesselMayLeaveTheImage) {
  const auto folder = temporary_folder("skeleton");
  imaging::write_image(folder / "through.nrrd", tube(0, 90));
  const Outcome done = ostia({"skeleton", "through.nrrd", "-o", "lines.vtp", "--json"}, {folder, ""});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NEAR(nlohmann::json::parse(done.out)["length_mm"].get<double>(), 36.0, 1.0);
  const auto tree = io::read_centerlines(folder / "lines.vtp");
  ASSERT_EQ(tree.segments.size(), 1U);
  for (const double radius : tree.segments.front().axis.radius) EXPECT_NEAR(radius, 2.0, 0.2);
}

TEST(SkeletonCommand, LinesAreCutAndRemovedByHand) {
  const auto folder = temporary_folder("skeleton");
  imaging::write_image(folder / "tube.nrrd", tube());
  const Setting in{folder, ""};
  const Outcome cut = ostia({"skeleton", "tube.nrrd", "-o", "cut.vtp", "--cut", "6,6,20", "--json"}, in);
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_EQ(nlohmann::json::parse(cut.out)["components"], 2);
  const Outcome less = ostia(
      {"skeleton", "tube.nrrd", "-o", "less.vtp", "--cut", "6,6,20", "--remove", "6,6,8", "--json"}, in);
  ASSERT_EQ(less.code, 0) << less.err;
  EXPECT_EQ(nlohmann::json::parse(less.out)["lines"], 1);
  EXPECT_NEAR(nlohmann::json::parse(less.out)["length_mm"].get<double>(), 13.2, 1.0);
  const Outcome ring =
      ostia({"skeleton", "tube.nrrd", "-o", "ring.vtp", "--connect", "6,6,10:6,6,25", "--json"}, in);
  ASSERT_EQ(ring.code, 0) << ring.err;
  EXPECT_EQ(nlohmann::json::parse(ring.out)["loops"], 1);
  const Outcome wrong = ostia({"skeleton", "tube.nrrd", "-o", "no.vtp", "--connect", "6,6,10"}, in);
  EXPECT_EQ(wrong.code, 3) << wrong.err;
  EXPECT_THAT(wrong.err, HasSubstr("two places"));
}

TEST(SkeletonCommand, WhatIsNoMaskOrCannotBeWrittenIsRefusedAndNothingIsLeft) {
  const auto folder = temporary_folder("skeleton");
  const Setting in{folder, ""};
  imaging::write_image(folder / "tube.nrrd", tube());
  const Outcome name = ostia({"skeleton", "tube.nrrd", "-o", "lines.stl"}, in);
  EXPECT_NE(name.code, 0);
  EXPECT_THAT(name.err, HasSubstr("lines.stl"));
  const Outcome inlet = ostia({"skeleton", "tube.nrrd", "-o", "lines.vtp", "--inlet", "500,0,0"}, in);
  EXPECT_EQ(inlet.code, 3) << inlet.err;
  const Outcome surface = ostia({"skeleton", "none.nrrd", "-o", "lines.vtp"}, in);
  EXPECT_EQ(surface.code, 3) << surface.err;
  EXPECT_THAT(surface.err, HasSubstr("none.nrrd"));
  EXPECT_THAT(names_in(folder), ::testing::ElementsAre("tube.nrrd"));
}

}  // namespace
}  // namespace ostia::testing
