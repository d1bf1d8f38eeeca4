#include "ostia/dicom/measurement_report.h"

#include "made_series.h"

#include "ostia/core/error.h"

namespace ostia::dicom {
namespace {

using namespace testing;
using ::testing::HasSubstr;

MeasurementReport small_report() {
  MeasurementReport report;
  report.groups.push_back({"S1",
                           codes::stenosis,
                           segment_site(6),
                           {{codes::lumen_diameter, 1.234567, codes::millimetre, codes::minimum},
                            {codes::diameter_stenosis, 62.0, codes::percent, {}}},
                           {{{"vessel_name", "99OSTIA", "Name of the vessel"}, {}, "LAD"}}});
  const auto four_a = cad_rads_codes("4A");
  report.statements.push_back({cad_assessment, four_a->assessment, {}});
  report.statements.push_back({cad_stenosis_modifier, four_a->stenosis_modifier, {}});
  return report;
}

TEST(DicomMeasurementReport, IsReadAsItWasWritten) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  const MeasurementReport read = read_measurement_report(
      written(measurement_report(made.source, small_report()), made.folder, "sr.dcm"));
  ASSERT_EQ(read.groups.size(), 1U);
  const MeasurementGroup& group = read.groups[0];
  EXPECT_EQ(group.tracking, "S1");
  EXPECT_EQ(*group.finding, codes::stenosis);
  EXPECT_EQ(group.site->meaning, "Proximal Left Anterior Descending Coronary Artery");
  ASSERT_EQ(group.numbers.size(), 2U);
  EXPECT_EQ(group.numbers[0].name, codes::lumen_diameter);
  EXPECT_DOUBLE_EQ(group.numbers[0].value, 1.23457);
  EXPECT_EQ(*group.numbers[0].derivation, codes::minimum);
  EXPECT_EQ(group.numbers[1].unit, codes::percent);
  ASSERT_EQ(group.statements.size(), 1U);
  EXPECT_EQ(group.statements[0].text, "LAD");
  ASSERT_EQ(read.statements.size(), 2U);
  EXPECT_EQ(read.statements[0].value->meaning, "4 - Severe stenosis");
  EXPECT_EQ(read.statements[1].value->meaning, "4A - Severe stenosis");
}

TEST(DicomMeasurementReport, NamesItsImages) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  const DicomDataset d = measurement_report(made.source, small_report());
  const DicomDataset* study = d.item(0x0040A375);
  ASSERT_NE(study, nullptr);
  EXPECT_EQ(study->text(0x0020000D), made.source.study_uid);
  EXPECT_EQ(study->item(0x00081115)->text(0x0020000E), made.source.series_uid);
  EXPECT_EQ(study->item(0x00081115)->items(0x00081199).size(), 7U);
}

TEST(DicomMeasurementReport, WhatIsNoNumberIsRefused) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  MeasurementReport report = small_report();
  report.groups[0].numbers[0].value = std::nan("");
  EXPECT_THAT(refusal([&] { measurement_report(made.source, report); }), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal([&] { measurement_report(made.source, {}); }), HasSubstr("nothing was measured"));
  EXPECT_THAT(refusal([&] { read_measurement_report(made.series.files.front()); }),
              HasSubstr("no structured report"));
}

TEST(DicomCode, EverySegmentHasASite) {
  EXPECT_EQ(segment_site(5).meaning, "Left Main Coronary Artery");
  EXPECT_EQ(segment_site(0), codes::coronary_artery);
  EXPECT_EQ(segment_site(19), codes::coronary_artery);
  for (int a = 1; a <= 18; ++a)
    for (int b = a + 1; b <= 18; ++b) EXPECT_FALSE(segment_site(a) == segment_site(b)) << a << " " << b;
}

TEST(DicomCode, CadRadsHasTheCodesOfThreeContextGroups) {
  EXPECT_EQ(cad_rads_codes("0")->assessment.value, "130723");
  EXPECT_EQ(cad_rads_codes("4B")->stenosis_modifier->value, "130729");
  EXPECT_EQ(cad_rads_codes("5")->assessment.value, "130730");
  EXPECT_EQ(cad_rads_codes("N")->assessment.value, "130731");
  EXPECT_FALSE(cad_rads_codes("6"));
}

}  // namespace
}  // namespace ostia::dicom
