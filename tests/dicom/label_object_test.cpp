#include "ostia/dicom/label_object.h"

#include "made_series.h"

#include "ostia/core/error.h"

namespace ostia::dicom {
namespace {

using namespace testing;
using ::testing::HasSubstr;

struct MadeLabels {
  MadeSeries made = made_series(grid_with(oblique()));
  MaskVolume mask = lopsided_mask(made.series.geometry);
  DicomDataset object = segmentation(made.source, mask, two_segments());
  std::string refused() {
    return refusal([&] { read(); });
  }
  LabelObject read() { return read_label_object(written(object, made.folder, "object.dcm")); }
  DicomDataset& item(imaging::DicomTag tag, std::size_t n) { return object.find(tag)->items[n]; }
  /// Of the functional groups of a frame.
  DicomDataset& group(std::size_t frame, imaging::DicomTag tag) {
    return item(0x52009230, frame).find(tag)->items[0];
  }
};

TEST(LabelObject, TheKindIsTheSopClasss) {
  MadeLabels labels;
  EXPECT_EQ(label_object_kind(written(labels.object, labels.made.folder, "seg.dcm")),
            LabelObjectKind::segmentation);
  EXPECT_EQ(label_object_kind(labels.made.series.files.front()), LabelObjectKind::none);
  core::write_file(labels.made.folder / "text.dcm", "no DICOM");
  EXPECT_EQ(label_object_kind(labels.made.folder / "text.dcm"), LabelObjectKind::none);
}

TEST(LabelObject, AFolderWithOneObjectMeansThatOne) {
  MadeLabels labels;
  const fs::path folder = labels.made.folder / "SEG";
  fs::create_directory(folder);
  const fs::path file = written(labels.object, folder, "a.dcm");
  EXPECT_EQ(label_object_in(folder), file);
  EXPECT_EQ(label_object_in(labels.made.folder / "CT"), std::nullopt);
  written(labels.object, folder, "b.dcm");
  EXPECT_THAT(refusal([&] { label_object_in(folder); }), HasSubstr("several"));
}

TEST(LabelObject, EveryCutIsRefusedOrReadWhole) {
  MadeLabels labels;
  const std::string whole = imaging::dicom_file(labels.object);
  const fs::path file = labels.made.folder / "cut.dcm";
  for (std::size_t length = 0; length < whole.size(); length += 101) {
    core::write_file(file, whole.substr(0, length));
    EXPECT_THROW(read_label_object(file), InvalidInput) << length;
  }
}

TEST(LabelObject, ChangedBytesNeverDoMoreThanBeRefused) {
  MadeLabels labels;
  const std::string whole = imaging::dicom_file(labels.object);
  const fs::path file = labels.made.folder / "changed.dcm";
  for (std::size_t at = 132; at < whole.size(); at += 41) {
    std::string changed = whole;
    changed[at] = static_cast<char>(~changed[at]);
    core::write_file(file, changed);
    try {
      read_label_object(file);
    } catch (const InvalidInput&) {
    }
  }
}

TEST(LabelObject, SizesThatDoNotFitAreNamed) {
  MadeLabels labels;
  labels.object.set_u16(0x00280010, {65535});
  labels.object.set_u16(0x00280011, {65535});
  EXPECT_THAT(labels.refused(), HasSubstr("PixelData (7FE0,0010)"));
  labels.object.set_u16(0x00280010, {0});
  EXPECT_THAT(labels.refused(), HasSubstr("Rows (0028,0010)"));
}

TEST(LabelObject, FramesThatAreNotDescribedAreRefused) {
  MadeLabels labels;
  labels.object.set_text(0x00280008, "IS", "2");
  EXPECT_THAT(labels.refused(), HasSubstr("describes 3 frames"));
  labels.object.set_text(0x00280008, "IS", "99999999999");
  EXPECT_THAT(labels.refused(), HasSubstr("NumberOfFrames (0028,0008)"));
}

TEST(LabelObject, AFrameFarAwayIsNoImage) {
  MadeLabels labels;
  DicomDataset& plane = labels.group(2, 0x00209113);
  const std::vector<double> p = plane.decimals(0x00200032);
  const Vec3 far = Vec3(p[0], p[1], p[2]) + 1e7 * labels.mask.geometry.direction.col(2);
  plane.set_decimals(0x00200032, {far.x(), far.y(), far.z()});
  EXPECT_THAT(labels.refused(), HasSubstr("mm apart"));
}

TEST(LabelObject, AShiftedFrameIsRefused) {
  MadeLabels labels;
  DicomDataset& plane = labels.group(1, 0x00209113);
  const std::vector<double> p = plane.decimals(0x00200032);
  const Vec3 moved = Vec3(p[0], p[1], p[2]) + 2.0 * labels.mask.geometry.direction.col(0);
  plane.set_decimals(0x00200032, {moved.x(), moved.y(), moved.z()});
  EXPECT_THAT(labels.refused(), HasSubstr("shifted within its plane"));
}

TEST(LabelObject, AFrameOfAnUnknownSegmentIsRefused) {
  MadeLabels labels;
  labels.group(0, 0x0062000A).set_u16(0x0062000B, {9});
  EXPECT_THAT(labels.refused(), HasSubstr("segment 9"));
}

TEST(LabelObject, SegmentsBeyondTheEighthBitAreCountedUp) {
  MadeLabels labels;
  labels.item(0x00620002, 1).set_u16(0x00620004, {65535});
  labels.group(2, 0x0062000A).set_u16(0x0062000B, {65535});
  const LabelObject read = labels.read();
  EXPECT_EQ(read.segments[1].number, 65535);
  EXPECT_EQ(read.segments[1].value, 2);
  const auto image = read_labels(labels.made.folder / "object.dcm");
  EXPECT_EQ(image.header.file_labels, (std::vector<std::int64_t>{0, 1, 65535}));
}

TEST(LabelObject, EmptySegmentsHaveNoValue) {
  MadeLabels labels;
  DicomDataset added = labels.item(0x00620002, 0);
  added.set_u16(0x00620004, {3});
  labels.object.add_item(0x00620002) = added;
  EXPECT_EQ(labels.read().segments[2].value, 0);
}

TEST(LabelObject, NothingInItIsRefused) {
  MadeLabels labels;
  std::string& bits = labels.object.find(0x7FE00010)->value;
  std::fill(bits.begin(), bits.end(), '\0');
  EXPECT_THAT(labels.refused(), HasSubstr("no segment has a voxel"));
}

TEST(LabelObject, AnotherFrameOfReferenceOrPatientIsTold) {
  MadeLabels labels;
  const ObjectOrigin a = labels.read().origin;
  EXPECT_EQ(other_origin(a, object_origin(labels.made.series.files.front())), "");
  ObjectOrigin b = a;
  b.frame_of_reference = "1.2.3";
  EXPECT_THAT(other_origin(a, b), HasSubstr("frames of reference"));
  b.patient_id = "other";
  EXPECT_THAT(other_origin(a, b), HasSubstr("two patients"));
}

/// A structure set of one square contour a slice, as planning systems write them.
DicomDataset squares(const Geometry& grid, const std::vector<std::int64_t>& slices) {
  DicomDataset d;
  d.set_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.481.3");
  d.set_text(0x00080018, "UI", "1.2.3.4");
  DicomDataset& roi = d.add_item(0x30060020);
  roi.set_text(0x30060022, "IS", "7");
  roi.set_text(0x30060026, "LO", "LAD");
  DicomDataset contours;
  contours.set_text(0x30060084, "IS", "7");
  for (const std::int64_t k : slices) {
    DicomDataset& contour = contours.add_item(0x30060040);
    contour.set_text(0x30060042, "CS", "CLOSED_PLANAR");
    std::string text;
    for (const auto& [i, j] :
         std::vector<std::pair<double, double>>{{2.5, 1.5}, {6.5, 1.5}, {6.5, 4.5}, {2.5, 4.5}}) {
      const Vec3 p = grid.world({i, j, static_cast<double>(k)});
      for (int axis = 0; axis < 3; ++axis)
        text += (text.empty() ? "" : "\\") + imaging::dicom_decimal(p[axis]);
    }
    contour.set_text(0x30060050, "DS", text);
  }
  d.add_item(0x30060039) = contours;
  return d;
}

TEST(StructureSet, FillsTheGridOfItsImage) {
  const Geometry grid = grid_with(oblique());
  const MadeSeries made = made_series(grid);
  LabelObjectOptions options;
  options.grid = made.series.geometry;
  const LabelObject read =
      read_label_object(written(squares(made.series.geometry, {2, 3}), made.folder, "rt.dcm"), options);
  std::vector<Vec3> truth;
  for (std::int64_t k = 2; k < 4; ++k)
    for (std::int64_t j = 2; j < 5; ++j)
      for (std::int64_t i = 3; i < 7; ++i)
        truth.push_back(made.series.geometry.world(
            {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
  EXPECT_LT(apart(places_of(read.volume, 7), truth), 1e-6);
  EXPECT_EQ(read.segments.at(0).label, "LAD");
}

TEST(StructureSet, WithoutAnImageItHasAGridOfItsOwn) {
  for (const Mat3& direction : axis_rotations()) {
    const Geometry grid = grid_with(direction);
    const MadeSeries made = made_series(grid);
    const LabelObject read = read_label_object(written(squares(grid, {1, 2, 3, 4}), made.folder, "rt.dcm"));
    const std::vector<Vec3> places = places_of(read.volume, 7);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : places) middle += p / static_cast<double>(places.size());
    const Geometry& own = read.volume.geometry;
    EXPECT_LT((middle - grid.world({4.5, 3.0, 2.5})).norm(), 0.5 * own.spacing.norm());
    EXPECT_NEAR(static_cast<double>(places.size()) * own.spacing.prod(), 4 * 0.4 * 3 * 0.5 * 4 * 0.8,
                2 * (4 * 0.4 + 3 * 0.5) * 4 * 0.8 * 0.5 * own.spacing.x());  // half a pixel along the rim
    EXPECT_GT(own.direction.determinant(), 0.99);
  }
}

TEST(StructureSet, PlanesBetweenTheSlicesAreRefused) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  LabelObjectOptions options;
  options.grid = made.series.geometry;
  Geometry between = made.series.geometry;
  between.origin += between.direction.col(2) * 0.4 * between.spacing.z();
  const fs::path shifted = written(squares(between, {2, 3}), made.folder, "shifted.dcm");
  EXPECT_THAT(refusal([&] { read_label_object(shifted, options); }), HasSubstr("does not lie in a slice"));
  const fs::path sheets = written(squares(made.series.geometry, {1, 3, 5}), made.folder, "sheets.dcm");
  EXPECT_THAT(refusal([&] { read_label_object(sheets, options); }), HasSubstr("2 slices of the image apart"));
}

TEST(StructureSet, OfOtherPlanesIsRefused) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  LabelObjectOptions options;
  options.grid = made.series.geometry;
  const fs::path file = written(squares(grid_with(oblique()), {2}), made.folder, "rt.dcm");
  EXPECT_THAT(refusal([&] { read_label_object(file, options); }), HasSubstr("does not lie in a slice"));
}

}  // namespace
}  // namespace ostia::dicom
