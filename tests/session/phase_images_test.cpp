#include "ostia/session/phase_images.h"

#include "case_tools.h"
#include "dicom_writer.h"

#include "ostia/core/error.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::session {
namespace {

using namespace testing;
using ::ostia::testing::CtSlice;
using ::ostia::testing::part10;
using ::ostia::testing::write_bytes;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

imaging::ImageVolume image_of(std::int16_t hu, int side = 8) {
  imaging::ImageVolume image;
  image.geometry.size = {side, side, side};
  image.voxels.assign(static_cast<std::size_t>(side * side * side), hu);
  return image;
}

PhaseImage held(std::int16_t hu) {
  return {std::make_shared<const imaging::ImageVolume>(image_of(hu)), 0.0};
}
constexpr std::size_t one_image = 8 * 8 * 8 * 2;

std::vector<PhaseSource> every_tenth() {
  std::vector<PhaseSource> sources;
  for (int k = 0; k < 10; ++k) sources.push_back({k / 10.0, "none.nrrd", {}});
  return sources;
}

TEST(PhaseImages, NamesTellThePhase) {
  EXPECT_DOUBLE_EQ(*phase_of_name("phase_35"), 0.35);
  EXPECT_DOUBLE_EQ(*phase_of_name("heart2-007"), 0.07);
  EXPECT_DOUBLE_EQ(*phase_of_name("37.5%_recon3"), 0.375);
  EXPECT_DOUBLE_EQ(*phase_of_name("CTA 75 % B26f"), 0.75);
  EXPECT_DOUBLE_EQ(*phase_of_name("p40pct_v2"), 0.40);
  EXPECT_DOUBLE_EQ(*phase_of_name("phase_100"), 0.0) << "the next beat's";
  EXPECT_FALSE(phase_of_name("image"));
  EXPECT_FALSE(phase_of_name("scan20240131"));
}

TEST(PhaseImages, LabelsOfDicomTellThePhase) {
  EXPECT_THAT(phases_of_labels({"cardiac phase 0 %", "cardiac phase 40 %"}), ElementsAre(0.0, 0.4));
  EXPECT_THAT(phases_of_labels({"phase 1 of 4", "phase 3 of 4", "phase 4 of 4", "phase 2 of 4"}),
              ElementsAre(0.0, 0.5, 0.75, 0.25));
  EXPECT_THAT(phases_of_labels(
                  {"trigger time 0 ms", "trigger time 200 ms", "trigger time 600 ms", "trigger time 400 ms"}),
              ElementsAre(DoubleNear(0.0, 1e-12), DoubleNear(0.25, 1e-12), DoubleNear(0.75, 1e-12),
                          DoubleNear(0.5, 1e-12)));
  EXPECT_THAT(phases_of_labels({"phase 3 of 4", "phase 4 of 4"}), ElementsAre(0.5, 0.75)) << "of all four";
  EXPECT_THAT(phases_of_labels({"trigger time 0 ms", "trigger time 100 ms", "trigger time 200 ms",
                                "trigger time 300 ms", "trigger time 700 ms"}),
              ElementsAre(0.0, DoubleNear(0.125, 1e-12), DoubleNear(0.25, 1e-12), DoubleNear(0.375, 1e-12),
                          DoubleNear(0.875, 1e-12)))
      << "with a gap";
  EXPECT_THAT(phases_of_labels({"acquisition 1", "acquisition 2"}), IsEmpty());
  EXPECT_THAT(phases_of_labels({}), IsEmpty());
}

TEST(PhaseImages, TriggerTimesOfAPartOfTheCycleAreRefusedWithTheWayOut) {
  try {
    phases_of_labels({"trigger time 300 ms", "trigger time 350 ms", "trigger time 400 ms"});
    FAIL() << "nobody knows how long the cycle is";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("begin 300 ms"));
    EXPECT_THAT(error.what(), HasSubstr("phase_35.nrrd"));
  }
}

TEST(PhaseImages, AreFoundOneFolderDownByTheFoldersName) {
  const TempFolder folder;
  for (const int percent : {5, 35}) {
    const auto below = folder / ("phase-" + std::to_string(percent));
    std::filesystem::create_directories(below);
    imaging::write_image(below / "image00.nrrd", image_of(static_cast<std::int16_t>(percent)));
  }
  const auto found = find_phase_images(folder.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_DOUBLE_EQ(found[0].phase, 0.05);
  EXPECT_DOUBLE_EQ(found[1].phase, 0.35);
  EXPECT_EQ(read_phase_image(found[1]).volume->voxels.front(), 35);
}

TEST(PhaseImages, SeriesThatEachHaveAPhaseOfTheirOwnAreFound) {
  const TempFolder folder;
  for (const int percent : {0, 40, 75}) {
    imaging::DicomSeriesOptions options;
    options.series_description = "CTA";
    options.cardiac_phase_percent = percent;
    options.uid_seed = std::to_string(percent);
    imaging::write_dicom_series(folder / std::to_string(percent),
                                image_of(static_cast<std::int16_t>(percent)), options);
  }
  const auto found = find_phase_images(folder.path());
  ASSERT_EQ(found.size(), 3U);
  EXPECT_DOUBLE_EQ(found[1].phase, 0.40);
  EXPECT_EQ(read_phase_image(found[2]).volume->voxels.front(), 75);
}

TEST(PhaseImages, AreFoundInAFolderAndRead) {
  const TempFolder folder;
  for (const int percent : {75, 0, 35})
    imaging::write_image(folder / ("ct_" + std::to_string(percent) + ".nrrd"),
                         image_of(static_cast<std::int16_t>(percent)));
  imaging::write_image(folder / "whole.nrrd", image_of(1));
  const auto found = find_phase_images(folder.path());
  ASSERT_EQ(found.size(), 3U);
  EXPECT_DOUBLE_EQ(found[1].phase, 0.35);
  const PhaseImage read = read_phase_image(found[1]);
  EXPECT_EQ(read.volume->voxels.front(), 35);
  EXPECT_DOUBLE_EQ(read.phase, 0.35);
  imaging::write_image(folder / "again_35.nrrd", image_of(2));
  try {
    find_phase_images(folder.path());
    FAIL() << "two images of one phase";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("of the phase 35 %"));
  }
}

TEST(PhaseImages, SeriesWithAPercentInTheirDescriptionAreFound) {
  const TempFolder folder;
  for (const int percent : {40, 75}) {
    imaging::DicomSeriesOptions options;
    options.series_description = "CTA " + std::to_string(percent) + " %";
    options.uid_seed = std::to_string(percent);
    imaging::write_dicom_series(folder / std::to_string(percent),
                                image_of(static_cast<std::int16_t>(percent)), options);
  }
  const auto found = find_phase_images(folder.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_DOUBLE_EQ(found[0].phase, 0.40);
  EXPECT_EQ(read_phase_image(found[1]).volume->voxels.front(), 75);
}

std::string refusal_of(const std::filesystem::path& folder) {
  try {
    find_phase_images(folder);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST(PhaseImages, CineImagesOfSinglePositionsAreRefusedWithTheReason) {
  const TempFolder folder;
  for (int position = 0; position < 2; ++position)
    for (int time = 0; time < 5; ++time) {
      const std::string number = std::to_string(10 * position + time);
      CtSlice slice;
      slice.modality = "MR";
      slice.series = "1.2.3." + std::to_string(position);
      slice.sop_instance = "1.2.3.4." + number;
      slice.instance = number;
      slice.position = "0\\0\\" + std::to_string(8 * position);
      slice.trigger_time = std::to_string(40 * time);
      write_bytes(folder / (number + ".dcm"), part10(slice.transfer_syntax, slice.data_set()));
    }
  const std::string told = refusal_of(folder.path());
  EXPECT_THAT(told, HasSubstr("10 single slices"));
  EXPECT_THAT(told, HasSubstr("a phase needs a volume"));
  EXPECT_THAT(told, HasSubstr("phase_35.nrrd"));
}

TEST(PhaseImages, SeriesThatSayNoPhaseAreRefusedWithWhatWasLookedFor) {
  const TempFolder folder;
  for (const char* name : {"one", "two"}) {
    imaging::DicomSeriesOptions options;
    options.series_description = "CTA";
    options.uid_seed = name;
    imaging::write_dicom_series(folder / name, image_of(1), options);
  }
  const std::string told = refusal_of(folder.path());
  EXPECT_THAT(told, HasSubstr("none of the folder's 2 DICOM series says its phase"));
  EXPECT_THAT(told, HasSubstr("0020,9241"));
}

TEST(PhaseImages, AFolderWithoutPhasesIsRefusedWithTheWayOut) {
  const TempFolder folder;
  imaging::write_image(folder / "whole.nrrd", image_of(1));
  try {
    find_phase_images(folder.path());
    FAIL() << "no phases";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("phase_35.nrrd"));
    EXPECT_THAT(error.what(), ::testing::Not(HasSubstr(folder.path().string()))) << "it may name a patient";
  }
  EXPECT_THROW(find_phase_images(folder / "none"), IoError);
  EXPECT_THROW(PhaseImages({}), InvalidInput);
}

TEST(PhaseImages, TheNearestInTimeIsWantedFirstAndAllThatHaveRoomAreHeld) {
  PhaseImages images(every_tenth(), 3 * one_image);
  EXPECT_EQ(images.nearest(0.97), 0U) << "around the cycle";
  std::vector<std::size_t> read;
  while (const auto next = images.wanted(0.51)) {
    read.push_back(*next);
    images.take(*next, held(1), 0.51);
    ASSERT_LE(read.size(), 10U) << "it goes on without end";
    EXPECT_LE(images.bytes(), 3 * one_image);
  }
  EXPECT_THAT(read, ElementsAre(5U, 6U, 4U));
}

TEST(PhaseImages, WhatIsFarGoesWhenThePhaseGoesOn) {
  PhaseImages images(every_tenth(), 3 * one_image);
  for (const double phase : {0.51, 0.81})
    while (const auto next = images.wanted(phase)) images.take(*next, held(1), phase);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(images.held(i) != nullptr, i >= 7 && i <= 9) << i;
  EXPECT_EQ(images.bytes(), 3 * one_image);
}

TEST(PhaseImages, OneIsHeldHoweverSmallTheBudgetAndOneThatFailedIsNotWantedAgain) {
  PhaseImages images(every_tenth(), 10);
  images.take(*images.wanted(0.2), held(1), 0.2);
  EXPECT_TRUE(images.held(2));
  EXPECT_FALSE(images.wanted(0.2));
  EXPECT_EQ(*images.wanted(0.6), 6U);
  images.failed(6);
  EXPECT_EQ(*images.wanted(0.61), 7U);
}

}  // namespace
}  // namespace ostia::session
