// Two patients in one folder, whatever their files say of series: never one image.

#include "dicom_writer.h"
#include "shared_data.h"

#include "ostia/imaging/dicom.h"
#include "ostia/imaging/series_preview.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;
using testing::CtSlice;
using testing::write_series;

/// Slices of the one and of the other, by turns along z, with one series' number for all.
fs::path shared_folder(const std::function<void(CtSlice&, bool second)>& whose) {
  const fs::path folder = testing::temporary_folder("two-patients");
  write_series(folder, 8, 1.0, [&](CtSlice& slice, int k) { whose(slice, k % 2 == 1); });
  return folder;
}

/// Each series' files are all of the one or all of the other: even numbers or odd ones.
void expect_parted(const fs::path& folder) {
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 2U);
  EXPECT_NE(found.series[0].uid, found.series[1].uid);
  for (const DicomSeries& one : found.series) {
    std::set<int> parity;
    for (const fs::path& file : one.files) parity.insert((file.stem().string().back() - '0') % 2);
    EXPECT_EQ(one.files.size(), 4U);
    EXPECT_EQ(parity.size(), 1U);
    EXPECT_NEAR(one.geometry.spacing[2], 2.0, 1e-9);
  }
}

TEST(TwoPatients, AreTwoSeriesByTheirIdentifiers) {
  const fs::path folder =
      shared_folder([](CtSlice& slice, bool second) { slice.patient_id = second ? "4712" : "4711"; });
  expect_parted(folder);
  EXPECT_EQ(patients_in(scan_dicom(folder).series), 2U);
}

TEST(TwoPatients, AreTwoSeriesByTheirNamesWhereNoIdentifiersAre) {
  const fs::path folder = shared_folder(
      [](CtSlice& slice, bool second) { slice.patient_name = second ? "ROE^RICHARD" : "DOE^JANE"; });
  expect_parted(folder);
  EXPECT_EQ(patients_in(scan_dicom(folder).series), 2U);
}

TEST(TwoPatients, TwoStudiesOfOneAreTwoSeries) {
  const fs::path folder = shared_folder([](CtSlice& slice, bool second) {
    slice.patient_id = "4711";
    slice.study = second ? "1.2.9" : "1.2.8";
  });
  expect_parted(folder);
  EXPECT_EQ(patients_in(scan_dicom(folder).series), 1U);
}

TEST(TwoPatients, OneWhoseNameIsWrittenInTwoWaysIsOne) {
  const fs::path folder = shared_folder([](CtSlice& slice, bool second) {
    slice.patient_id = "4711";
    slice.patient_name = second ? "DOE^JANE^^" : "Doe^Jane";
  });
  EXPECT_EQ(scan_dicom(folder).series.size(), 1U);
}

TEST(TwoPatients, WhatSaysNothingPartsNothing) {
  const fs::path folder = shared_folder([](CtSlice& slice, bool second) {
    slice.patient_name = second ? "" : "DOE^JANE";
    slice.patient_id = second ? "4711" : "";
  });
  const DicomFolder found = scan_dicom(folder);
  ASSERT_EQ(found.series.size(), 1U);
  EXPECT_EQ(found.series[0].files.size(), 8U);
}

TEST(ShownIdentity, OfASeriesIsThatOfItsMiddleSlice) {
  const fs::path folder = testing::temporary_folder("identity");
  write_series(folder, 3, 1.0, [](CtSlice& slice, int) {
    slice.patient_id = " 47-11 ";
    slice.study_date = "20240301";
    slice.description = "CTA 0.6";
  });
  const ShownIdentity shown = shown_identity(scan_dicom(folder).series.at(0));
  EXPECT_EQ(shown, (ShownIdentity{"DOE, JANE", "47-11", "2024-03-01", "CTA 0.6", 3}));
  EXPECT_FALSE(shown.anonymous());
  EXPECT_TRUE(shown_identity(DicomSeries{}).anonymous());
}

}  // namespace
}  // namespace ostia::imaging
