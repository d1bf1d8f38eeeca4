// The strip's model on folders of DICOM files whose phases, sizes and patients are known.
#include "ostia/session/series_stack.h"

#include "case_tools.h"
#include "dicom_writer.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/workbench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;
using ::ostia::testing::CtSlice;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

/// Series of files in one folder, each of some slices along z.
struct StudyFolder {
  fs::path at;
  int files = 0;
  explicit StudyFolder(const fs::path& folder) : at(folder) { fs::create_directories(at); }
  void add(
      const std::string& uid, const std::string& description, const std::string& patient = "P1",
      const std::string& study = "1.2.9", int slices = 4,
      const std::function<void(CtSlice&, int)>& change = [](CtSlice&, int) {}) {
    for (int k = 0; k < slices; ++k) {
      CtSlice slice;
      slice.series = uid;
      slice.description = description;
      slice.patient_id = patient;
      slice.study = study;
      slice.sop_instance = "1.2.3.4." + std::to_string(++files);
      slice.instance = std::to_string(k + 1);
      slice.position = "0\\0\\" + std::to_string(0.5 * k);
      change(slice, k);
      slice.write(at / ("f" + std::to_string(files) + ".dcm"));
    }
  }
  imaging::DicomFolder scan() const { return imaging::scan_dicom(at); }
  SeriesStack beside(const std::string& uid) const { return stack_beside(scan(), uid); }
};

std::vector<double> phases_in(const SeriesStack& stack) {
  std::vector<double> phases;
  for (const StackEntry& one : stack.entries)
    if (one.has_phase) phases.push_back(one.source.phase);
  return phases;
}

TEST(SeriesStack, PhasesByTheirDescriptionsRiseAndReconstructionsFollow) {
  const TempFolder folder;
  StudyFolder study(folder / "study");
  study.add("1.1", "CTA 75 % B26f 0.6");
  study.add("1.2", "CTA 35% B26f 0.6");
  study.add("1.3", "CTA 45 % B26f 0.6");
  study.add("1.4", "Chest 1.0 B70f", "P1", "1.2.9", 5);
  const SeriesStack stack = study.beside("1.3");
  ASSERT_EQ(stack.entries.size(), 4u);
  EXPECT_THAT(phases_in(stack),
              ElementsAre(DoubleNear(0.35, 1e-9), DoubleNear(0.45, 1e-9), DoubleNear(0.75, 1e-9)));
  EXPECT_EQ(stack.own, 1u);
  EXPECT_FALSE(stack.entries[3].has_phase) << "1.0 is no phase";
  EXPECT_EQ(stack.entries[3].slices, 5);
  EXPECT_EQ(stack.entries[0].bytes, 5u * 4u * 4u * 2u);
  EXPECT_EQ(stack.of_others, 0u);
  EXPECT_THAT(cine_of(stack), ElementsAre(0u, 1u, 2u));
}

TEST(SeriesStack, PartsOfOneSeriesByTheirTriggerTimes) {
  const TempFolder folder;
  StudyFolder study(folder / "study");
  for (const int ms : {0, 200, 400, 600, 800})
    study.add("1.1", "4D", "P1", "1.2.9", 4,
              [&](CtSlice& slice, int) { slice.trigger_time = std::to_string(ms); });
  const imaging::DicomFolder found = study.scan();
  ASSERT_EQ(found.series.size(), 5u);
  const SeriesStack stack = stack_beside(found, found.series[2].uid);
  EXPECT_THAT(phases_in(stack),
              ElementsAre(DoubleNear(0.0, 1e-9), DoubleNear(0.2, 1e-9), DoubleNear(0.4, 1e-9),
                          DoubleNear(0.6, 1e-9), DoubleNear(0.8, 1e-9)));
  EXPECT_EQ(cine_of(stack).size(), 5u);
}

TEST(SeriesStack, TwoPatientsAndTwoStudiesAreNeverMixed) {
  const TempFolder folder;
  StudyFolder study(folder / "study");
  study.add("1.1", "CTA 35 %");
  study.add("1.2", "CTA 75 %");
  study.add("2.1", "CTA 35 %", "P2", "1.2.10");
  study.add("3.1", "CTA 45 %", "P1", "1.2.11");  // the same patient at another day
  study.add("4.1", "CTA 55 %", "", "");          // does not say
  const SeriesStack stack = study.beside("1.2");
  EXPECT_EQ(stack.entries.size(), 2u);
  EXPECT_EQ(stack.of_others, 3u);
  const SeriesStack other = study.beside("2.1");
  EXPECT_EQ(other.entries.size(), 1u);
  EXPECT_EQ(other.of_others, 4u);
  EXPECT_EQ(study.beside("4.1").entries.size(), 1u) << "who says nothing is beside nobody";
  EXPECT_THROW(study.beside("9.9"), InvalidInput);
}

TEST(SeriesStack, APatientsNumberWithinAnotherStudyNumberIsAnotherPatients) {
  const TempFolder folder;
  StudyFolder study(folder / "study");
  study.add("1.1", "CTA 35 %", "P1", "1.2.9");
  study.add("1.2", "CTA 75 %", "P2", "1.2.9");  // one study's number for two patients: a mistake in the files
  EXPECT_EQ(study.beside("1.1").entries.size(), 1u);
  EXPECT_EQ(study.beside("1.2").of_others, 1u);
}

TEST(SeriesStack, ASeriesThatChangesItsSizeHalfWayIsTwoEntries) {
  const TempFolder folder;
  StudyFolder study(folder / "study");
  study.add("1.1", "CTA 75 %", "P1", "1.2.9", 8, [](CtSlice& slice, int k) {
    if (k >= 5) slice.rows = 6;
  });
  study.add("1.2", "CTA 35 %", "P1", "1.2.9", 8);
  const imaging::DicomFolder found = study.scan();
  const SeriesStack stack = stack_beside(found, "1.2");
  ASSERT_EQ(stack.entries.size(), 3u);
  EXPECT_EQ(stack.entries[1].slices + stack.entries[2].slices, 8);
  EXPECT_NE(stack.entries[1].bytes, stack.entries[2].bytes);
  EXPECT_TRUE(cine_of(stack).empty()) << "no two phases have the same voxels";
}

TEST(SeriesStack, WhatCannotBeReadStandsLastWithItsReason) {
  const TempFolder folder;
  StudyFolder study(folder / "study");
  study.add("1.1", "CTA 35 %");
  study.add("1.2", "CTA 45 %", "P1", "1.2.9", 4, [](CtSlice& slice, int) { slice.pixel_spacing = ""; });
  study.add("1.3", "CTA 75 %");
  const SeriesStack stack = study.beside("1.1");
  ASSERT_EQ(stack.entries.size(), 3u);
  EXPECT_EQ(stack.readable(), 2u);
  EXPECT_EQ(stack.entries[2].source.phase, 0.45);
  EXPECT_NE(stack.entries[2].fault, "");
  EXPECT_THAT(cine_of(stack), ElementsAre(0u, 1u));
}

TEST(SeriesStack, OfTwoReconstructionsOfAPhaseTheCineTakesTheOneOnTheTable) {
  const TempFolder folder;
  StudyFolder study(folder / "study");
  study.add("1.1", "CTA 35 % B26f");
  study.add("1.2", "CTA 75 % B26f");
  study.add("1.3", "CTA 75 % B46f");
  const SeriesStack stack = study.beside("1.3");
  const std::vector<std::size_t> cine = cine_of(stack);
  ASSERT_EQ(cine.size(), 2u);
  EXPECT_EQ(cine[1], *stack.own);
}

TEST(SeriesStack, FilesOfPhasesKnowWhichIsOnTheTable) {
  const TempFolder folder;
  imaging::ImageVolume image;
  image.geometry.size = {4, 4, 4};
  image.voxels.assign(64, 0);
  std::vector<PhaseSource> sources;
  for (const int percent : {75, 35}) {
    const fs::path file = folder / ("phase_" + std::to_string(percent) + ".nrrd");
    imaging::write_image(file, image);
    sources.push_back({percent / 100.0, file, {}});
  }
  const SeriesStack stack = stack_of_files(sources, sources[0].file);
  EXPECT_THAT(phases_in(stack), ElementsAre(0.35, 0.75));
  EXPECT_EQ(stack.own, 1u);
  EXPECT_FALSE(stack_of_files(sources, folder / "other.nrrd").own);
}

TEST(OtherImage, IsShownInThePlaceOfTheOneOnTheTable) {
  Workbench bench;
  const auto image_at = [](double x) {
    imaging::ImageVolume image;
    image.geometry.size = {8, 8, 8};
    image.geometry.origin = geometry::Vec3(x, 0, 0);
    image.voxels.assign(512, 7);
    return std::make_shared<const imaging::ImageVolume>(std::move(image));
  };
  const auto other =
      std::make_shared<const OtherImage>(OtherImage{image_at(1.0), "45 %", "image 45 %, axes of 75 %", true});
  EXPECT_THROW(bench.show_other_image(other), InvalidInput) << "nothing is on the table";
  const auto own = image_at(0.0);
  bench.set_image({own, {}});
  int told = 0;
  const auto kept = bench.other_image_changed.observe([&] { ++told; });
  bench.show_other_image(other);
  EXPECT_EQ(told, 1);
  EXPECT_EQ(bench.shown_volume(), other->volume.get());
  EXPECT_EQ(bench.image().volume, own) << "what is on the table stays";
  EXPECT_NO_THROW(bench.require_own_phase()) << "there is no case to be edited";
  EXPECT_THROW(bench.show_other_image(std::make_shared<const OtherImage>(OtherImage{image_at(500.0)})),
               InvalidInput);
  EXPECT_THROW(bench.show_other_image(std::make_shared<const OtherImage>()), InvalidInput);
  EXPECT_EQ(bench.shown_volume(), other->volume.get()) << "what is refused changes nothing";
  bench.set_image({image_at(2.0), {}});
  EXPECT_FALSE(bench.other_image()) << "another patient's image is alone";
  EXPECT_EQ(told, 2);
}

}  // namespace
}  // namespace ostia::session
