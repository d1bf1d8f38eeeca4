// `ostia dicom` and `ostia deidentify`: a case's objects, and what such objects are taken for.

#include "program.h"

#include "ostia/core/files.h"
#include "ostia/dicom/label_object.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/dicom_dataset.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace ostia::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
namespace fs = std::filesystem;

lumen::LumenModel dicom_model() {
  geometry::VesselTree tree;
  geometry::Centerline axis = geometry::straight_tube(24.0, 1.5, 0.5).tubes.front().axis;
  geometry::complete(axis);
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, "LAD", {3}}};
  return lumen::model_of_tubes(tree);
}

/// A folder with the series `CT`, another one, and `heart.ostia` made with the first.
fs::path dicom_case_folder() {
  const fs::path folder = temporary_folder("dicom");
  imaging::ImageVolume image;
  image.geometry.size = {24, 24, 34};
  image.geometry.spacing = {0.8, 0.8, 0.8};
  image.geometry.origin = {-9.6, -9.6, -2.0};
  for (int z = 0; z < 34; ++z)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x)
        image.voxels.push_back(std::hypot(0.8 * x - 9.6, 0.8 * y - 9.6) < 1.5
                                   ? 400
                                   : static_cast<std::int16_t>(-100 + 7 * x + 3 * y + z));
  imaging::DicomSeriesOptions options;
  options.patient_name = "PLANTED^NAME";
  options.patient_id = "PLANTED-ID";
  imaging::write_dicom_series(folder / "CT", image, options);
  ++image.voxels.front();
  imaging::write_dicom_series(folder / "other", image, options);
  const auto series = imaging::scan_dicom(folder / "CT").series.at(0);
  session::CaseFile::create(folder / "heart.ostia", dicom_model(), session::image_reference(series));
  return folder;
}

TEST(DicomCommand, ObjectsBelongToThePatientOfTheSeries) {
  const Setting in{dicom_case_folder(), ""};
  const Outcome done =
      ostia({"dicom", "heart.ostia", "--series", "CT", "-o", "objects", "--objects", "seg,stl,sr,pdf"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  const Json summary = Json::parse(core::read_file(in.folder / "objects/objects.json"));
  EXPECT_FALSE(summary["pseudonym"].get<bool>());
  ASSERT_EQ(summary["objects"].size(), 4U);
  const auto slice =
      imaging::require_dicom_object(imaging::scan_dicom(in.folder / "CT").series.at(0).files.front());
  for (const Json& one : summary["objects"]) {
    const auto object = imaging::require_dicom_object(in.folder / "objects" / one["file"].get<std::string>());
    EXPECT_EQ(object.data.text(0x00100010), "PLANTED^NAME");
    EXPECT_EQ(object.data.text(0x0020000D), slice.data.text(0x0020000D));
    EXPECT_EQ(object.data.text(0x00080018), one["sop_instance"]);
  }
  const Outcome other = ostia({"dicom", "heart.ostia", "--series", "other", "-o", "b"}, in);
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("none of its 1 series is the image"));
  EXPECT_FALSE(fs::exists(in.folder / "b"));

  const Outcome told = ostia({"dicom", "objects/measurements.dcm"}, in);
  EXPECT_EQ(told.code, 0) << told.err;
  EXPECT_EQ(Json::parse(told.out)["kind"], "measurements of a structured report");
  const Outcome labels = ostia({"dicom", "objects/segmentation.dcm"}, in);
  EXPECT_EQ(Json::parse(labels.out)["segments"][0]["label"], "Coronary lumen");

  // What came out goes in: the segmentation is a mask like any other.
  const Outcome extracted =
      ostia({"extract", "objects/segmentation.dcm", "--label", "1", "-o", "again.ostia"}, in);
  EXPECT_EQ(extracted.code, 0) << extracted.err;
  const auto again = session::CaseFile::open(in.folder / "again.ostia", session::OpenMode::read_only);
  ASSERT_EQ(again.model()->tree.vessels.size(), 1U);
  EXPECT_NEAR(again.model()->vessels.front()->axis->length(), 24.0, 3.0);
  const Outcome converted = ostia({"convert", "objects/segmentation.dcm", "mask.nrrd"}, in);
  EXPECT_EQ(converted.code, 0) << converted.err;
}

TEST(DicomCommand, WithoutASeriesThereIsAPseudonym) {
  const Setting in{dicom_case_folder(), ""};
  const Outcome done = ostia({"dicom", "heart.ostia", "-o", "objects", "--objects", "stl,sr", "--json"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(Json::parse(done.out)["pseudonym"].get<bool>());
  EXPECT_THAT(done.err, HasSubstr("pseudonym"));
  for (const std::string& name : names_in(in.folder / "objects"))
    EXPECT_EQ(core::read_file(in.folder / "objects" / name).find("PLANTED"), std::string::npos) << name;
  EXPECT_EQ(ostia({"dicom", "heart.ostia"}, in).code, 2);
  EXPECT_EQ(ostia({"dicom", "heart.ostia", "-o", "x", "--objects", "seg"}, in).code, 3);
  EXPECT_EQ(ostia({"dicom", "heart.ostia", "-o", "x", "--objects", "word"}, in).code, 3);
}

TEST(DicomCommand, ASegmentationOfAnotherFrameOfReferenceIsRefused) {
  const Setting in{dicom_case_folder(), ""};
  ASSERT_EQ(ostia({"dicom", "heart.ostia", "--series", "CT", "-o", "objects", "--objects", "seg"}, in).code,
            0);
  const Outcome other =
      ostia({"extract", "objects/segmentation.dcm", "--image", "other", "-o", "again.ostia"}, in);
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("frames of reference"));
  EXPECT_FALSE(fs::exists(in.folder / "again.ostia"));
}

TEST(DeidentifyCommand, NamesNobody) {
  const Setting in{dicom_case_folder(), ""};
  const Outcome done = ostia({"deidentify", "CT", "-o", "anonymous", "--patient", "P1"}, in);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("34 images"));
  for (const std::string& name : names_in(in.folder / "anonymous"))
    EXPECT_EQ(core::read_file(in.folder / "anonymous" / name).find("PLANTED"), std::string::npos) << name;
}

}  // namespace
}  // namespace ostia::testing
