#include "kept_scan.h"
#include "program.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/case_file.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace ostia::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A folder with a synthetic heart's CT and the labels of all that is in it.
const fs::path& heart_with_labels() {
  static const fs::path folder = [] {
    const fs::path made = temporary_folder("masks");
    phantom::CaseOptions options;
    options.preset = phantom::Preset::small;
    const phantom::Scan scan = kept_scan(phantom::plan_case(options));
    imaging::write_image(made / "ct.nrrd", scan.image);
    imaging::write_image(made / "labels.nii.gz", scan.labels);
    imaging::MaskVolume lumen = scan.labels;
    for (std::uint8_t& voxel : lumen.voxels) voxel = voxel == 20 ? 1 : 0;  // coronary lumen
    imaging::write_image(made / "mask.nii.gz", lumen);
    return made;
  }();
  return folder;
}

std::vector<std::string> names_of(const nlohmann::json& facts) {
  std::vector<std::string> names;
  for (const auto& vessel : facts["vessels"]) names.push_back(vessel["name"]);
  return names;
}

/// Makes heart.ostia of the mask, once.
const Outcome& case_of_mask() {
  static const Outcome done =
      ostia({"extract", "mask.nii.gz", "-o", "heart.ostia", "--json"}, {heart_with_labels(), ""});
  return done;
}

TEST(MaskCommands, AMaskBecomesACaseAndItsLabelsComeBack) {
  const Setting in{heart_with_labels(), ""};
  const Outcome& done = case_of_mask();
  ASSERT_EQ(done.code, 0) << done.err;
  const auto facts = nlohmann::json::parse(done.out);
  EXPECT_EQ(facts["ostia"], 2);
  EXPECT_THAT(names_of(facts), ::testing::IsSupersetOf({"LAD", "LCX", "RCA"}));
  EXPECT_FALSE(session::CaseFile::open(in.folder / "heart.ostia", session::OpenMode::read_only).image());
  const Outcome back = ostia({"convert", "heart.ostia", "back.nii.gz", "--grid", "ct.nrrd", "--json"}, in);
  ASSERT_EQ(back.code, 0) << back.err;
  const Outcome judged = ostia({"evaluate", "volume", "mask.nii.gz", "back.nii.gz", "--json"}, in);
  ASSERT_EQ(judged.code, 0) << judged.err;
  EXPECT_GT(nlohmann::json::parse(judged.out)["dice"].get<double>(), 0.85) << judged.out;
  const auto before = imaging::read_mask(in.folder / "mask.nii.gz").volume.voxels;
  const auto after = imaging::read_mask(in.folder / "back.nii.gz").volume.voxels;
  const auto object = [](const std::vector<std::uint8_t>& voxels) {
    return static_cast<double>(std::count_if(voxels.begin(), voxels.end(), [](auto v) { return v != 0; }));
  };
  EXPECT_NEAR(object(after), object(before), 0.03 * object(before));
}

TEST(MaskCommands, InfoListsTheLabelsOfAMask) {
  const fs::path folder = temporary_folder("labels");
  imaging::MaskVolume mask;
  mask.geometry.size = {4, 3, 2};
  mask.geometry.spacing = {0.5, 0.5, 2.0};
  mask.voxels.assign(24, 0);
  mask.voxels[3] = mask.voxels[4] = mask.voxels[9] = 1;
  mask.voxels[20] = 7;
  imaging::write_image(folder / "mask.nrrd", mask);
  const Outcome told = ostia({"info", "mask.nrrd"}, {folder, ""});
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_THAT(told.out,
              AllOf(HasSubstr("3 voxels, 1.5 mm3"), HasSubstr("label 7"), ::testing::Not(HasSubstr("HU"))));
  const auto facts = nlohmann::json::parse(ostia({"info", "mask.nrrd", "--json"}, {folder, ""}).out);
  EXPECT_EQ(facts["labels"], nlohmann::json::parse(R"([{"label": 1, "voxels": 3, "volume_mm3": 1.5},
                                                     {"label": 7, "voxels": 1, "volume_mm3": 0.5}])"));
  mask.voxels.assign(24, 0);
  imaging::write_image(folder / "empty.nrrd", mask);
  EXPECT_THAT(ostia({"info", "empty.nrrd"}, {folder, ""}).out, HasSubstr("none"));
}

TEST(MaskCommands, WithItsCtTheCaseBelongsToTheCt) {
  const Setting in{heart_with_labels(), ""};
  const Outcome done =
      ostia({"extract", "labels.nii.gz", "--label", "20", "--image", "ct.nrrd", "-o", "with.ostia"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(session::CaseFile::open(in.folder / "with.ostia", session::OpenMode::read_only).image());
  const Outcome plaque =
      ostia({"convert", "with.ostia", "plaque.nrrd", "--grid", "ct.nrrd", "--labels", "plaque"}, in);
  ASSERT_EQ(plaque.code, 0) << plaque.err;
  EXPECT_THAT(plaque.out, AllOf(HasSubstr("lumen"), HasSubstr("fibrous")));
}

TEST(MaskCommands, MasksWithoutVesselsAreRefusedByNameAndLeaveNoCase) {
  const Setting in{heart_with_labels(), ""};
  const auto refused = [&](const std::vector<std::string>& more, const std::string& what) {
    const Outcome done =
        ostia(std::vector<std::string>{"extract"} + more + std::vector<std::string>{"-o", "none.ostia"}, in);
    EXPECT_EQ(done.code, 3) << done.err;
    EXPECT_THAT(done.err, HasSubstr(what));
    EXPECT_FALSE(fs::exists(in.folder / "none.ostia"));
  };
  refused({"labels.nii.gz", "--label", "77"}, "has no voxel of label 77; its labels are");
  refused({"labels.nii.gz", "--label", "7"}, "organ");           // liver
  refused({"labels.nii.gz"}, "thicker than coronary arteries");  // everything
  imaging::MaskVolume mask = imaging::read_mask(in.folder / "mask.nii.gz").volume;
  imaging::MaskVolume empty = mask, full = mask, moved = mask;
  std::fill(empty.voxels.begin(), empty.voxels.end(), std::uint8_t{0});
  std::fill(full.voxels.begin(), full.voxels.end(), std::uint8_t{1});
  moved.geometry.origin.x() += 30.0;
  imaging::write_image(in.folder / "empty.nrrd", empty);
  imaging::write_image(in.folder / "full.nrrd", full);
  imaging::write_image(in.folder / "moved.nrrd", moved);
  refused({"empty.nrrd"}, "empty.nrrd: the mask is empty");
  refused({"full.nrrd"}, "full");
  refused({"moved.nrrd", "--image", "ct.nrrd"}, "--image");
  // The CT itself is no mask.
  refused({"ct.nrrd", "--mask"}, "not a mask");
  const Outcome wrong = ostia({"extract", "ct.nrrd", "--image", "ct.nrrd", "-o", "none.ostia"}, in);
  EXPECT_EQ(wrong.code, 2);
}

/// A CT of which the vessels alone were left, on zeros or on air.
TEST(MaskCommands, AMaskWithTheValuesOfACtIsOfferedTheOptionThatTakesIt) {
  const Setting in{heart_with_labels(), ""};
  ASSERT_EQ(case_of_mask().code, 0) << case_of_mask().err;
  const imaging::MaskVolume mask = imaging::read_mask(in.folder / "mask.nii.gz").volume;
  for (const int outside : {0, -1024}) {
    imaging::ImageVolume image{mask.geometry, {}};
    for (std::size_t i = 0; i < mask.voxels.size(); ++i)
      image.voxels.push_back(
          static_cast<std::int16_t>(mask.voxels[i] != 0 ? 250 + static_cast<int>(i % 199) : outside));
    imaging::write_image(in.folder / "vessels.nrrd", image);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"extract", "vessels.nrrd", "-o", "none.ostia"},
          {"model", "vessels.nrrd", "-o", "none"},
          {"mesh", "vessels.nrrd", "-o", "none"}}) {
      const Outcome refused = ostia(command, in);
      EXPECT_EQ(refused.code, 3) << refused.err;
      EXPECT_THAT(refused.err, HasSubstr("--mask")) << command.front();
    }
    const Outcome taken = ostia({"extract", "vessels.nrrd", "--mask", "-o", "vessels.ostia"}, in);
    EXPECT_EQ(taken.code, 0) << taken.err;
    EXPECT_EQ(taken.out, ostia({"extract", "mask.nii.gz", "-o", "again.ostia"}, in).out);
    fs::remove(in.folder / "vessels.ostia");
    fs::remove(in.folder / "again.ostia");
  }
}

TEST(MaskCommands, LabelsNeedACaseAndAGrid) {
  const Setting in{heart_with_labels(), ""};
  ASSERT_EQ(case_of_mask().code, 0) << case_of_mask().err;
  EXPECT_EQ(ostia({"convert", "heart.ostia", "a.nrrd"}, in).code, 2);
  EXPECT_EQ(ostia({"convert", "mask.nii.gz", "a.nrrd", "--grid", "ct.nrrd"}, in).code, 2);
  imaging::MaskVolume far = imaging::read_mask(in.folder / "mask.nii.gz").volume;
  far.geometry.origin.z() += 900.0;
  imaging::write_image(in.folder / "far.nrrd", far);
  const Outcome other = ostia({"convert", "heart.ostia", "a.nrrd", "--grid", "far.nrrd"}, in);
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("another patient's"));
  EXPECT_FALSE(fs::exists(in.folder / "a.nrrd"));
}

}  // namespace
}  // namespace ostia::testing
