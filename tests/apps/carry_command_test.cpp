// `ostia carry`: the tree of one scan in the next, on a heart of formulas.

#include "program.h"
#include "registration/two_scans.h"

#include "ostia/core/files.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/image_file.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <csignal>

namespace ostia::testing {
namespace {

using geometry::Vec3;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

const two_scans::Way carried_way{8.0, Vec3(8.0, -6.0, 5.0), 0.0};

/// The straight piece of one artery.
lumen::LumenModel straight_artery() {
  const auto [from, to] = two_scans::vessels()[3];
  geometry::Centerline axis;
  axis.points = geometry::resample({from, to}, 0.5);
  axis.radius.assign(axis.points.size(), 2.2);
  geometry::complete(axis);
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, "LAD", {3}}};
  return lumen::model_of_tubes(tree);
}

/// CT-old.nrrd, CT-new.nrrd, the case of the first.
fs::path folder_of_two_scans() {
  const fs::path folder = temporary_folder("carry");
  imaging::write_image(folder / "CT-old.nrrd", two_scans::first_scan());
  imaging::write_image(folder / "CT-new.nrrd",
                       two_scans::second_scan(carried_way, {420.0, 450.0}, carried_way.shift_mm));
  session::CaseFile::create(folder / "old.ostia", straight_artery(),
                            session::image_reference(folder / "CT-old.nrrd"));
  return folder;
}

const std::vector<std::string> carry_words{"carry",       "old.ostia",   "--old-image",
                                           "CT-old.nrrd", "--no-search", "--new-image",
                                           "CT-new.nrrd", "-o",          "new.ostia"};

TEST(CarryCommand, MakesACaseOfTheLaterScan) {
  const fs::path folder = folder_of_two_scans();
  const Outcome made = ostia(carry_words + std::vector<std::string>{"--json", "--anyway"}, {folder, ""});
  ASSERT_TRUE(made.code == 0 || made.code == 4) << made.err;
  const nlohmann::json told = nlohmann::json::parse(made.out);
  EXPECT_EQ(told["vessels"][0]["name"], "LAD");
  EXPECT_EQ(told["vessels"][0]["how"], "followed");
  EXPECT_FALSE(told["searched"].get<bool>());
  const session::CaseFile file = session::CaseFile::open(folder / "new.ostia", session::OpenMode::read_only);
  EXPECT_EQ(file.image()->sha256, session::image_reference(folder / "CT-new.nrrd").sha256);
  const geometry::VesselTree& tree = file.model()->tree;
  const std::vector<Vec3> truth{two_scans::there(carried_way, two_scans::vessels()[3].first),
                                two_scans::there(carried_way, two_scans::vessels()[3].second)};
  for (const Vec3& point : tree.segments[0].axis.points)
    EXPECT_LT((geometry::closest(truth, point).point - point).norm(), 1.0);
  EXPECT_THAT(file.annotations()->marks.at(0).note, HasSubstr("not checked"));
  const Outcome again = ostia(carry_words, {folder, ""});
  EXPECT_NE(again.code, 0) << "a case is nobody's to overwrite";
  EXPECT_THAT(again.err, HasSubstr("new.ostia"));
}

TEST(CarryCommand, RefusesWhatIsNoPairAndLeavesNothing) {
  const fs::path folder = folder_of_two_scans();
  core::write_file(folder / "phases.nrrd",
                   "NRRD0005\ntype: short\ndimension: 4\nsizes: 9 9 9 2\nencoding: raw\nendian: little\n\n" +
                       std::string(2 * 9 * 9 * 9 * 2, '\0'));
  imaging::ImageVolume plain = two_scans::first_scan();
  for (std::int16_t& value : plain.voxels) value = std::min<std::int16_t>(value, 45);
  imaging::write_image(folder / "plain.nrrd", plain);
  const auto refused = [&](const std::string& before_image, const std::string& after_image, int code,
                           const std::string& why) {
    const Outcome made = ostia({"carry", "old.ostia", "--old-image", before_image, "--new-image", after_image,
                                "--no-search", "-o", "new.ostia"},
                               {folder, ""});
    EXPECT_EQ(made.code, code) << made.err;
    EXPECT_THAT(made.err, HasSubstr(why));
    EXPECT_FALSE(fs::exists(folder / "new.ostia"));
  };
  refused("CT-new.nrrd", "CT-old.nrrd", 3, "CT-new.nrrd");
  refused("CT-old.nrrd", "CT-old.nrrd", 3, "the image that the case was made with");
  refused("CT-old.nrrd", "phases.nrrd", 3, "phases.nrrd");
  refused("CT-old.nrrd", "plain.nrrd", 3, "without contrast");
  refused("CT-old.nrrd", "missing.nrrd", 3, "missing.nrrd");
  EXPECT_EQ(ostia({"carry", "old.ostia", "--old-image", "CT-old.nrrd", "--new-image", "CT-new.nrrd",
                   "--reach", "50", "-o", "new.ostia"},
                  {folder, ""})
                .code,
            3);
  EXPECT_THAT(names_in(folder), ::testing::UnorderedElementsAre("CT-new.nrrd", "CT-old.nrrd", "old.ostia",
                                                                "phases.nrrd", "plain.nrrd"));
}

TEST(CarryCommand, AnInterruptLeavesNothing) {
  const fs::path folder = folder_of_two_scans();
  double seconds = 0.0;
  const Outcome made = interrupted(carry_words, {folder, ""}, SIGINT, 0.5, seconds);
  EXPECT_NE(made.code, 0);
  EXPECT_THAT(names_in(folder), ::testing::UnorderedElementsAre("CT-new.nrrd", "CT-old.nrrd", "old.ostia"));
}

}  // namespace
}  // namespace ostia::testing
