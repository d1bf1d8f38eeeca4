#include "ostia/session/dicom_objects.h"

#include "report_cases.h"
#include "schema_rules.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/dicom/label_object.h"
#include "ostia/dicom/measurement_report.h"
#include "ostia/session/doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <bit>

namespace ostia::session {
namespace {

using namespace testing;
using geometry::Vec3;
using ::testing::HasSubstr;

imaging::Geometry turned_grid() {
  imaging::Geometry grid;
  grid.size = {40, 44, 60};
  grid.spacing = {0.5, 0.45, 0.8};
  grid.direction.col(0) = Vec3(0, -1, 0);
  grid.direction.col(1) = Vec3(-1, 0, 0);
  grid.direction.col(2) = Vec3(0, 0, -1);
  grid.origin = Vec3(9.0, 10.0, 44.0);
  return grid;
}

/// Bright within the tube about the z axis, fat around.
imaging::ImageVolume bright_tube(const imaging::Geometry& grid) {
  imaging::ImageVolume image{grid, {}};
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i) {
        const Vec3 p = grid.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        image.voxels.push_back(std::hypot(p.x(), p.y()) < 1.5 ? 400 : -90);
      }
  return image;
}

struct SmallDicomCase {
  TempFolder folder;
  imaging::ImageVolume image = bright_tube(turned_grid());
  CaseFile file = CaseFile::create(folder / "heart.ostia", narrowed_tube("LAD", 40.0, 1.5, 20.0, 0.6),
                                   ImageReference{std::string(64, 'a'), "image-aaaaaaaa"});
  dicom::SourceSeries source = dicom::pseudonymous_source("image-aaaaaaaa", "seed");

  DicomObjects made(const std::string& kinds, const std::string& ffr = {}) {
    DicomObjectsOptions options;
    options.kinds = dicom_object_kinds(kinds);
    options.ffr_json = ffr;
    return dicom_objects(file, source, &image, options);
  }
};

/// Names and types are the schema's.
void check_json(const std::string& schema_name, const Json& json) {
  const Schema schema(schema_name);
  EXPECT_EQ(names_in(schema["properties"]), names_in(json));
  for (const auto& [name, value] : json.items())
    EXPECT_TRUE(schema.is_valid(schema["properties"].at(name), value)) << name << ": " << value;
}

Vec3 middle_of_label(const imaging::MaskVolume& mask, std::uint8_t label) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (std::int64_t k = 0; k < mask.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < mask.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < mask.geometry.size[0]; ++i)
        if (mask(i, j, k) == label) {
          sum +=
              mask.geometry.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
          count += 1.0;
        }
  return sum / count;
}

/// Mean of the corners of a binary STL.
Vec3 middle_of_stl(const std::string& stl) {
  Vec3 sum = Vec3::Zero();
  const std::size_t triangles = (stl.size() - 84) / 50;
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t n = 0; n < 9; ++n) {
      std::uint32_t bits = 0;
      for (std::size_t b = 0; b < 4; ++b)
        bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(stl[84 + 50 * t + 12 + 4 * n + b]))
                << (8 * b);
      sum[static_cast<Eigen::Index>(n % 3)] += std::bit_cast<float>(bits);
    }
  return sum / (3.0 * static_cast<double>(triangles));
}

TEST(DicomObjects, SegmentationAndSurfaceLieAtTheSamePlace) {
  SmallDicomCase made;
  const DicomObjects objects = made.made("seg,stl");
  ASSERT_EQ(objects.objects.size(), 2U);
  core::write_file(made.folder / "seg.dcm", imaging::dicom_file(objects.objects[0].data));
  const dicom::LabelObject read = dicom::read_label_object(made.folder / "seg.dcm");
  const Vec3 truth(0.0, 0.0, 20.0);  // the tube's middle
  EXPECT_EQ(read.segments.at(0).label, "Coronary lumen");
  EXPECT_LT((middle_of_label(read.volume, 1) - truth).norm(), 0.25);
  EXPECT_LT((middle_of_stl(objects.objects[1].data.find(0x00420011)->value) - truth).norm(), 0.25);
}

TEST(DicomObjects, AnUnchangedCaseGivesTheSameObjectsAndAChangedOneNewInstances) {
  SmallDicomCase made;
  const DicomObjects first = made.made("stl"), again = made.made("stl");
  EXPECT_EQ(imaging::dicom_file(first.objects[0].data), imaging::dicom_file(again.objects[0].data));
  analysis::Measurement measurement;
  measurement.kind = analysis::MeasureKind::distance;
  measurement.points = {{0, 0, 0}, {1, 0, 0}};
  made.file.annotate(MeasureAdd{measurement});
  const DicomObjects amended = made.made("stl");
  EXPECT_EQ(first.objects[0].data.text(0x0020000E), amended.objects[0].data.text(0x0020000E));
  EXPECT_NE(first.objects[0].data.text(0x00080018), amended.objects[0].data.text(0x00080018));
  EXPECT_EQ(amended.objects[0].data.text(0x00200013), "2");
}

TEST(DicomObjects, TheReportOfNumbersHasTheLesionItsSiteAndItsFfr) {
  SmallDicomCase made;
  const lumen::LumenModel& model = *made.file.model();
  const CaseReport report = make_case_report(model, solved_surfaces(model), {}, {}, nullptr);
  ASSERT_EQ(report.stenoses.size(), 1U);
  const std::string ffr = R"({"kind": "ffr", "lesions": [{"throat": {"branch": 0, "vessel": )" +
                          std::to_string(report.stenoses[0].stenosis.vessel) + R"(, "s_mm": )" +
                          std::to_string(report.stenoses[0].stenosis.throat_mm) + R"(}, "ffr": 0.71}]})";
  const dicom::MeasurementReport measured = dicom_measurements(report, ffr);
  const auto lesion = std::find_if(measured.groups.begin(), measured.groups.end(),
                                   [](const auto& group) { return group.tracking == "S1"; });
  ASSERT_NE(lesion, measured.groups.end());
  EXPECT_EQ(*lesion->finding, dicom::codes::stenosis);
  std::map<std::string, double> values;
  for (const dicom::MeasuredNumber& one : lesion->numbers) values[one.name.value] = one.value;
  EXPECT_NEAR(values.at(dicom::codes::lumen_diameter.value), 1.2, 0.1);
  EXPECT_DOUBLE_EQ(values.at(dicom::codes::fractional_flow_reserve.value), 0.71);
  EXPECT_NEAR(values.at(dicom::codes::diameter_stenosis.value), 60.0, 4.0);
  ASSERT_FALSE(measured.statements.empty());
  EXPECT_EQ(measured.statements[0].name, dicom::cad_assessment);
  check_json("dicom-measurements.schema.json", Json::parse(dicom_measurements_json(measured)));
  for (const std::string& wrong :
       {std::string("{}"), std::string("text"), std::string(R"({"kind":"x","lesions":[{}]})")})
    EXPECT_THROW(dicom_measurements(report, wrong), InvalidInput) << wrong;
}

/// The values of statements of this name, a code's or a text.
std::vector<std::string> said_under(const std::vector<dicom::Statement>& statements,
                                    const std::string& name) {
  std::vector<std::string> values;
  for (const dicom::Statement& one : statements)
    if (one.name.value == name)
      values.push_back(one.value ? one.value->scheme + " " + one.value->value : one.text);
  return values;
}

TEST(DicomObjects, WhatIsHardlyAnArteryHasNoGradeInTheRecordEither) {
  SmallDicomCase made;
  const auto assessment = [&](const char* name) {
    write_dicom_objects(made.folder / name, made.made("sr"), made.source);
    const auto read = dicom::read_measurement_report(made.folder / name / "measurements.dcm");
    return said_under(read.statements, dicom::cad_assessment.value);
  };
  const auto of_report = [&](const std::vector<coronary::VesselCertainty>& certainty) {
    ReportOptions options;
    options.certainty = certainty;
    const CaseReport report = report_of(*made.file.model(), {}, {}, &made.image, options);
    return said_under(dicom_measurements(report, "").statements, dicom::cad_assessment.value);
  };
  const auto hardly = hardly_an_artery(*made.file.model(), 0.01);
  EXPECT_EQ(assessment("likely"), of_report({}));
  EXPECT_NE(assessment("as_likely"), of_report(hardly));
  keep_certainty(made.file, hardly);
  EXPECT_EQ(assessment("hardly"), of_report(hardly));
}

TEST(DicomObjects, BurdenModifiersAndHighRiskPlaqueAreInCodes) {
  using ::testing::ElementsAre;
  CaseReport report;
  ReportStenosis lesion;
  lesion.number = 1;
  lesion.high_risk = true;
  using Feature = analysis::PlaqueFeature;
  lesion.features = {{{Feature::low_attenuation, true, true, 2.5, 1.0}, LesionState::open, true},
                     {{Feature::positive_remodelling, true, true, 1.2, 1.1}, LesionState::open, true},
                     {{Feature::spotty_calcium, false, false, 0.0, 3.0}, LesionState::open, false},
                     {{Feature::napkin_ring, true, false, 20.0, 60.0}, LesionState::open, false}};
  report.stenoses = {lesion};
  report.category.category = analysis::CadRads::three;
  report.burden.by_segments = analysis::PlaqueBurden::p2;
  report.burden.by_calcium = report.burden.stated = analysis::PlaqueBurden::p3;
  report.statement = {report.category, analysis::PlaqueBurden::p3, true};
  report.statement.stent = report.statement.graft = true;
  const dicom::MeasurementReport measured = dicom_measurements(report);
  const auto& patient = measured.statements;
  EXPECT_THAT(said_under(patient, "plaque_burden"), ElementsAre("99OSTIA P3"));
  EXPECT_THAT(said_under(patient, "burden_segments"), ElementsAre("99OSTIA P2"));
  EXPECT_THAT(said_under(patient, "burden_calcium"), ElementsAre("99OSTIA P3"));
  EXPECT_THAT(said_under(patient, dicom::cad_modifier.value),
              ElementsAre("DCM 130733", "DCM 130734", "99OSTIA HRP"));
  EXPECT_THAT(said_under(patient, "cad_rads"), ElementsAre("3/P3/HRP/S/G"));
  ASSERT_EQ(measured.groups.size(), 1U);
  const auto& group = measured.groups.front();
  EXPECT_THAT(said_under(group.statements, "hrp_feature"),
              ElementsAre("99OSTIA low_attenuation", "99OSTIA pos_remodelling"));
  EXPECT_THAT(said_under(group.statements, "hrp"), ElementsAre("SCT 373066001"));
  for (const auto* statements : {&patient, &group.statements})
    for (const dicom::Statement& one : *statements) {
      EXPECT_LE(one.name.value.size(), 16U) << one.name.value;  // VR SH
      EXPECT_LE(one.value ? one.value->value.size() : 0U, 16U) << one.name.value;
    }
  std::map<std::string, std::string> units;
  for (const dicom::MeasuredNumber& one : group.numbers)
    if (one.name.scheme == "99OSTIA") units[one.name.value] = one.unit.value;
  EXPECT_EQ(units, (std::map<std::string, std::string>{{"low_attenuation", "mm3"}, {"napkin_ring", "deg"}}));
  check_json("dicom-measurements.schema.json", Json::parse(dicom_measurements_json(measured)));
}

TEST(DicomObjects, OccupanciesAddUpToTheVolume) {
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5);
  const imaging::MaskVolume shares = lumen_occupancy(model, turned_grid());
  double sum = 0.0;
  for (const std::uint8_t one : shares.voxels) sum += one;
  const double volume = sum / full_occupancy * turned_grid().spacing.prod();
  const double tube = std::numbers::pi * 1.5 * 1.5 * (40.0 + 4.0 / 3.0 * 1.5);  // with its domes
  EXPECT_NEAR(volume, tube, 0.02 * tube);
  EXPECT_EQ(*std::max_element(shares.voxels.begin(), shares.voxels.end()), full_occupancy);
}

TEST(DicomObjects, TheFolderIsWholeAndSaysWhatIsInIt) {
  SmallDicomCase made;
  const DicomObjects objects = made.made("stl,sr");
  const std::string json = write_dicom_objects(made.folder / "objects", objects, made.source);
  check_json("dicom-objects.schema.json", Json::parse(json));
  EXPECT_THAT(json, HasSubstr("pseudonym"));
  for (const DicomObjectFile& one : objects.objects)
    EXPECT_EQ(core::read_file(made.folder / "objects" / one.name), imaging::dicom_file(one.data));
  EXPECT_THROW(write_dicom_objects(made.folder / "objects", objects, made.source), IoError);
}

TEST(DicomObjects, WhatCannotBeIsRefused) {
  SmallDicomCase made;
  EXPECT_THROW(dicom_object_kinds("seg,xml"), InvalidInput);
  DicomObjectsOptions options;
  options.kinds = {DicomObjectKind::segmentation};
  EXPECT_THROW(dicom_objects(made.file, made.source, nullptr, options), InvalidInput);
  const CaseFile turned = CaseFile::create(made.folder / "turned.ostia", tube_model(),
                                           ImageReference{std::string(64, 'b'), "image-bbbbbbbb", "LPI"});
  options.kinds = {DicomObjectKind::surface};
  EXPECT_THROW(dicom_objects(turned, made.source, nullptr, options), InvalidInput);
}

}  // namespace
}  // namespace ostia::session
