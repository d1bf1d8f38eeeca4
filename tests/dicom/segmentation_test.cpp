#include "ostia/dicom/segmentation.h"

#include "made_series.h"

#include "ostia/core/error.h"
#include "ostia/dicom/label_object.h"

namespace ostia::dicom {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// The frames in the other order, as another program may write them.
DicomDataset with_frames_reversed(const DicomDataset& object) {
  DicomDataset result = object;
  imaging::DicomElement groups = *object.find(0x52009230);
  std::reverse(groups.items.begin(), groups.items.end());
  const std::size_t plane = static_cast<std::size_t>(*object.u16(0x00280010)) * *object.u16(0x00280011);
  const std::string& bits = object.find(0x7FE00010)->value;
  const std::size_t frames = groups.items.size();
  std::string turned(bits.size(), '\0');
  for (std::size_t f = 0; f < frames; ++f)
    for (std::size_t i = 0; i < plane; ++i) {
      const std::size_t from = f * plane + i, to = (frames - 1 - f) * plane + i;
      if (static_cast<unsigned char>(bits[from / 8]) >> (from % 8) & 1)
        turned[to / 8] = static_cast<char>(turned[to / 8] | 1 << (to % 8));
    }
  result.set(0x52009230, std::move(groups));
  result.set_bytes(0x7FE00010, "OB", std::move(turned));
  return result;
}

void expect_at_its_place(const Mat3& direction) {
  const MadeSeries made = made_series(grid_with(direction));
  const MaskVolume mask = lopsided_mask(made.series.geometry);
  const DicomDataset object = segmentation(made.source, mask, two_segments());
  for (const DicomDataset& one : {object, with_frames_reversed(object)}) {
    const LabelObject read = read_label_object(written(one, made.folder, "seg.dcm"));
    for (const std::uint8_t label : {1, 2})
      EXPECT_LT(apart(places_of(read.volume, label), places_of(mask, label)), 1e-4) << "label " << int{label};
  }
}

TEST(DicomSegmentation, LiesAtItsPlaceIn48Orientations) {
  for (const Mat3& direction : axis_rotations()) expect_at_its_place(direction);
}

TEST(DicomSegmentation, LiesAtItsPlaceInObliqueSlices) {
  for (const Mat3& turned : axis_rotations()) expect_at_its_place(oblique() * turned);
}

TEST(DicomSegmentation, RefersToTheSourcesSlices) {
  const MadeSeries made = made_series(grid_with(oblique()));
  const DicomDataset d = segmentation(made.source, lopsided_mask(made.series.geometry), two_segments());
  EXPECT_EQ(d.text(0x0020000D), made.source.study_uid);
  EXPECT_EQ(d.text(0x00200052), made.source.frame_of_reference);
  EXPECT_NE(d.text(0x0020000E), made.source.series_uid);
  EXPECT_EQ(d.text(0x00100010), "DOE^JANE");
  EXPECT_EQ(d.item(0x00081115)->text(0x0020000E), made.source.series_uid);
  EXPECT_EQ(d.item(0x00081115)->items(0x0008114A).size(), 7U);
  ASSERT_EQ(d.items(0x52009230).size(), 3U);  // slices 1 and 2 of the lumen, 5 of the plaque
  const std::vector<std::size_t> slices{1, 2, 5};
  for (std::size_t f = 0; f < 3; ++f) {
    const DicomDataset* image = d.items(0x52009230)[f].item(0x00089124)->item(0x00082112);
    EXPECT_EQ(image->text(0x00081155), made.source.frames[slices[f]].sop_instance);
  }
}

TEST(DicomSegmentation, TheSameMaskIsTheSameObjectAndAnotherOneANewInstanceOfTheSeries) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  MaskVolume mask = lopsided_mask(made.series.geometry);
  const DicomDataset first = segmentation(made.source, mask, two_segments());
  EXPECT_EQ(imaging::dicom_file(first), imaging::dicom_file(segmentation(made.source, mask, two_segments())));
  mask(0, 0, 0) = 1;
  const DicomDataset amended = segmentation(made.source, mask, two_segments());
  EXPECT_EQ(first.text(0x0020000E), amended.text(0x0020000E));
  EXPECT_NE(first.text(0x00080018), amended.text(0x00080018));
}

TEST(DicomSegmentation, SegmentsMayShareVoxels) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  const MaskVolume mask = lopsided_mask(made.series.geometry);
  std::vector<Segment> segments = two_segments();
  segments.push_back(segments.front());
  segments.back().values = {1, 2};
  const DicomDataset d = segmentation(made.source, mask, segments);
  EXPECT_EQ(d.text(0x00620013), "YES");
  const LabelObject read = read_label_object(written(d, made.folder, "shared.dcm"));
  EXPECT_EQ(read.segments.size(), 3U);
  // The one with fewer voxels counts: the plaque and the lumen against both together.
  EXPECT_EQ(places_of(read.volume, 1).size(), 30U);
  EXPECT_EQ(places_of(read.volume, 2).size(), 2U);
  ASSERT_EQ(read.warnings.size(), 1U);
  EXPECT_THAT(read.warnings[0], HasSubstr("overlap in 32 voxels"));
}

TEST(DicomSegmentation, OccupanciesAreReadFromHalfOn) {
  const MadeSeries made = made_series(grid_with(oblique()));
  MaskVolume shares{made.series.geometry, std::vector<std::uint8_t>(13 * 10 * 7, 0)};
  shares(4, 4, 3) = 64;
  shares(5, 4, 3) = 32;
  shares(6, 4, 3) = 31;
  SegmentationOptions options;
  options.fractional = true;
  options.most = 64;
  const DicomDataset d = segmentation(made.source, shares, {two_segments().front()}, options);
  EXPECT_EQ(d.text(0x00620001), "FRACTIONAL");
  const LabelObject read = read_label_object(written(d, made.folder, "shares.dcm"));
  EXPECT_LT(
      apart(places_of(read.volume, 1), {shares.geometry.world({4, 4, 3}), shares.geometry.world({5, 4, 3})}),
      1e-4);
}

TEST(DicomSegmentation, WhatCannotBeWrittenIsRefused) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  MaskVolume mask = lopsided_mask(made.series.geometry);
  EXPECT_THAT(refusal([&] { segmentation(made.source, mask, {}); }), HasSubstr("0 segments"));
  EXPECT_THAT(refusal([&] { segmentation(made.source, MaskVolume{}, two_segments()); }), HasSubstr("empty"));
  std::fill(mask.voxels.begin(), mask.voxels.end(), std::uint8_t{0});
  EXPECT_THAT(refusal([&] { segmentation(made.source, mask, two_segments()); }),
              HasSubstr("no segment has a voxel"));
}

}  // namespace
}  // namespace ostia::dicom
