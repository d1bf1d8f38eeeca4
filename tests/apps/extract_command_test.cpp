#include "kept_scan.h"
#include "program.h"

#include "ostia/imaging/image_file.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace ostia::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ExtractCommand, AnAngiogramBecomesACaseWithLabelledVesselsAndTheirDoubts) {
  const auto folder = temporary_folder("extract");
  phantom::CaseOptions options;
  options.preset = phantom::Preset::small;
  imaging::write_image(folder / "heart.nrrd", kept_scan(phantom::plan_case(options)).image);
  const Setting in{folder, ""};
  const Outcome done =
      ostia({"extract", "heart.nrrd", "-o", "heart.ostia", "--lines", "lines.vtp", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto facts = nlohmann::json::parse(done.out);
  EXPECT_EQ(facts["ostia"], 2);
  const auto opened = session::CaseFile::open(folder / "heart.ostia", session::OpenMode::read_only);
  EXPECT_EQ(opened.image()->sha256, session::image_reference(folder / "heart.nrrd").sha256);
  const geometry::VesselTree& tree = opened.model()->tree;
  ASSERT_EQ(tree.vessels.size(), facts["vessels"].size());
  for (const char* wanted : {"LAD", "LCX", "RCA"})
    EXPECT_EQ(std::count_if(tree.vessels.begin(), tree.vessels.end(),
                            [&](const geometry::Vessel& one) { return one.name == wanted; }),
              1)
        << wanted;
  std::size_t doubts = 0;
  for (const auto& vessel : facts["vessels"]) doubts += vessel["doubt"].get<std::string>().empty() ? 0U : 1U;
  EXPECT_EQ(opened.annotations()->marks.size(), doubts);
  EXPECT_EQ(io::read_centerlines(folder / "lines.vtp").vessels.size(), tree.vessels.size());
  // What is there is nobody's to overwrite.
  const Outcome again = ostia({"extract", "heart.nrrd", "-o", "heart.ostia"}, in);
  EXPECT_EQ(again.code, 3);
  EXPECT_THAT(again.err, HasSubstr("heart.ostia"));
}

TEST(ExtractCommand, AnImageOnItsHeadIsTurnedByItsAxesWhichTheCaseKeeps) {
  const auto folder = temporary_folder("extract");
  phantom::CaseOptions options;
  options.preset = phantom::Preset::small;
  imaging::ImageVolume image = kept_scan(phantom::plan_case(options)).image;
  const auto slice = image.geometry.size[0] * image.geometry.size[1];
  const imaging::ImageVolume upright = image;
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k)  // its slices in the wrong order
    std::copy_n(upright.voxels.begin() + (image.geometry.size[2] - 1 - k) * slice, slice,
                image.voxels.begin() + k * slice);
  imaging::write_image(folder / "wrong.nrrd", image);
  const Setting in{folder, ""};
  EXPECT_EQ(ostia({"extract", "wrong.nrrd", "--axes", "LPX", "-o", "heart.ostia"}, in).code, 2);
  const Outcome done = ostia({"extract", "wrong.nrrd", "--axes", "LPI", "-o", "heart.ostia"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const auto opened = session::CaseFile::open(folder / "heart.ostia", session::OpenMode::read_only);
  EXPECT_EQ(opened.image()->axes, "LPI");
  for (const char* wanted : {"LAD", "LCX", "RCA"})
    EXPECT_TRUE(std::any_of(opened.model()->tree.vessels.begin(), opened.model()->tree.vessels.end(),
                            [&](const geometry::Vessel& one) { return one.name == wanted; }))
        << wanted;
}

TEST(ExtractCommand, WhatHoldsNoHeartIsRefusedAndNoCaseIsLeft) {
  const auto folder = temporary_folder("extract");
  imaging::ImageVolume noise;
  noise.geometry.size = {96, 96, 96};
  noise.geometry.spacing = {0.8, 0.8, 0.8};
  noise.voxels.resize(static_cast<std::size_t>(noise.geometry.voxels()));
  std::uint32_t state = 1;
  for (std::int16_t& voxel : noise.voxels) {
    state = state * 1664525U + 1013904223U;
    voxel = static_cast<std::int16_t>(static_cast<int>(state >> 16) % 600 - 200);
  }
  imaging::write_image(folder / "noise.nrrd", noise);
  const Setting in{folder, ""};
  const Outcome done = ostia({"extract", "noise.nrrd", "-o", "noise.ostia"}, in);
  EXPECT_EQ(done.code, 3) << done.err;
  EXPECT_THAT(done.err, AllOf(HasSubstr("noise.nrrd"), HasSubstr("the image is noise")));
  EXPECT_THAT(names_in(folder), ::testing::ElementsAre("noise.nrrd"));
}

TEST(ExtractCommand, ASurfaceIsRefusedAsOneHoweverLargeItIs) {
  const auto folder = temporary_folder("extract");
  const geometry::TriMesh corner{{{0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.0, 0.02, 0.0}, {0.0, 0.0, 0.02}},
                                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  io::write_surface(folder / "in_metres.stl", corner);
  const Outcome done = ostia({"extract", "in_metres.stl", "-o", "heart.ostia"}, {folder, ""});
  EXPECT_EQ(done.code, 3);
  EXPECT_THAT(done.err, AllOf(HasSubstr("in_metres.stl is a surface and no CT image"),
                              ::testing::Not(HasSubstr("--units"))));
  EXPECT_THAT(names_in(folder), ::testing::ElementsAre("in_metres.stl"));
}

}  // namespace
}  // namespace ostia::testing
