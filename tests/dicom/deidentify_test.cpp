#include "ostia/dicom/deidentify.h"

#include "made_series.h"

#include "ostia/core/error.h"

#include <set>

namespace ostia::dicom {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// A slice with a name in every corner: attributes of the profile, in a sequence, a private group.
DicomDataset named_slice(const fs::path& file) {
  DicomDataset d = imaging::require_dicom_object(file).data;
  for (const auto& [tag, vr] : std::vector<std::pair<imaging::DicomTag, const char*>>{{0x00080080, "LO"},
                                                                                      {0x00081010, "SH"},
                                                                                      {0x00081030, "LO"},
                                                                                      {0x0008103E, "LO"},
                                                                                      {0x00101001, "PN"},
                                                                                      {0x00104000, "LT"},
                                                                                      {0x00180010, "LO"},
                                                                                      {0x00181030, "LO"},
                                                                                      {0x00204000, "LT"},
                                                                                      {0x00400254, "LO"},
                                                                                      {0x00091001, "LO"}})
    d.set_text(tag, vr, "PLANTED");
  d.set_text(0x00090010, "LO", "PLANTED CREATOR");
  d.set_text(0x00100030, "DA", "19450101");
  d.set_text(0x00080020, "DA", "20240301");
  d.add_item(0x00081140).set_text(0x00081155, "UI", "1.2.3.4.5");
  d.add_item(0x00082218).set_text(0x00080104, "LO", "PLANTED");
  DicomDataset& shared = d.add_item(0x52009229);
  shared.add_item(0x00209116).set_text(0x00209158, "LT", "PLANTED");
  return d;
}

TEST(Deidentify, NothingThatWasPlantedIsLeft) {
  const MadeSeries made = made_series(grid_with(oblique()), "PLANTED^NAME");
  for (const fs::path& file : made.series.files)
    core::write_file(file, imaging::dicom_file(named_slice(file)));
  const fs::path out = made.folder / "anonymous";
  const DeidentifyReport report = deidentify(made.folder / "CT", out, {"ANONYMOUS", "key"});
  EXPECT_EQ(report.files, 7U);
  EXPECT_EQ(report.private_removed, 14U);
  EXPECT_EQ(report.tags.at(0x00100010).replaced, 7U);
  EXPECT_EQ(report.tags.at(0x00081030).removed, 7U);
  EXPECT_EQ(report.tags.at(0x00100030).emptied, 7U);
  for (const auto& entry : fs::directory_iterator(out)) {
    const std::string bytes = core::read_file(entry.path());
    for (const std::string& planted :
         {std::string("PLANTED"), std::string("4711"), std::string("19450101"), std::string("20240301"),
          made.source.study_uid, made.source.series_uid})
      EXPECT_EQ(bytes.find(planted), std::string::npos) << entry.path() << " " << planted;
  }
}

TEST(Deidentify, ASequenceThatCannotBeTakenApartIsNotKept) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  DicomDataset slice = imaging::require_dicom_object(made.series.files.front()).data;
  // An item that promises more bytes than there are, as an unknown VR may hide it.
  slice.set(0x52009229, {"UN", std::string("\xFE\xFF\x00\xE0\xFF\x00\x00\x00", 8) + "PLANTED^"});
  DeidentifyReport report;
  EXPECT_FALSE(deidentified(slice, "key", "A", report).has(0x52009229));
  EXPECT_EQ(report.tags.at(0x52009229).removed, 1U);
}

TEST(Deidentify, TheImageStaysTheImage) {
  const MadeSeries made = made_series(grid_with(oblique()));
  deidentify(made.folder / "CT", made.folder / "anonymous");
  const imaging::DicomFolder folder = imaging::scan_dicom(made.folder / "anonymous");
  ASSERT_EQ(folder.series.size(), 1U);
  EXPECT_TRUE(imaging::same_grid(folder.series[0].geometry, made.series.geometry));
  EXPECT_TRUE(folder.series[0].faults.empty());
  const SourceSeries source = source_of(folder.series[0]);
  EXPECT_EQ(source.identity.text(0x00100010), "ANONYMOUS");
  EXPECT_EQ(source.identity.text(0x00120062), "YES");
  std::set<std::string> instances;
  for (std::size_t k = 0; k < 7; ++k) {
    instances.insert(source.frames[k].sop_instance);
    const auto before = imaging::require_dicom_object(made.series.files[k]).data;
    const auto after = imaging::require_dicom_object(folder.series[0].files[k]).data;
    EXPECT_EQ(before.find(0x7FE00010)->value, after.find(0x7FE00010)->value);
  }
  EXPECT_EQ(instances.size(), 7U);
}

TEST(Deidentify, UidsFollowTheKeyAndNothingElse) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  DeidentifyReport report;
  const DicomDataset slice = imaging::require_dicom_object(made.series.files.front()).data;
  const auto uid = [&](const std::string& key) {
    return deidentified(slice, key, "A", report).text(0x0020000D);
  };
  EXPECT_EQ(uid("one"), uid("one"));
  EXPECT_NE(uid("one"), uid("another"));
  EXPECT_NE(uid("one"), made.source.study_uid);
}

TEST(Deidentify, PixelsThatShowTextsAreRefused) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  DicomDataset slice = imaging::require_dicom_object(made.series.files.front()).data;
  slice.set_text(0x00280301, "CS", "YES");
  DeidentifyReport report;
  EXPECT_THAT(refusal([&] { deidentified(slice, "key", "A", report); }), HasSubstr("BurnedInAnnotation"));
  slice.set_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.104.1");
  EXPECT_THAT(refusal([&] { deidentified(slice, "key", "A", report); }), HasSubstr("no image of CT or MR"));
}

TEST(Deidentify, WhatCannotBeCopiedIsCountedAndSaidWhy) {
  const MadeSeries made = made_series(grid_with(Mat3::Identity()));
  core::write_file(made.folder / "CT/notes.txt", "Jane Doe");
  core::write_file(made.folder / "CT/broken.dcm", core::read_file(made.series.files.front()).substr(0, 300));
  const fs::path out = made.folder / "anonymous";
  const DeidentifyReport report = deidentify(made.folder / "CT", out);
  EXPECT_EQ(report.files, 7U);
  EXPECT_THAT(report.left_out,
              ::testing::UnorderedElementsAre("it is no DICOM file", "the DICOM file is damaged"));
  EXPECT_EQ(core::read_file(out / "deidentified.json").find("notes"), std::string::npos);
  EXPECT_THAT(refusal([&] { deidentify(made.folder / "CT", out); }), HasSubstr("not an empty folder"));
  EXPECT_THAT(refusal([&] { deidentify(out / "deidentified.json", made.folder / "b"); }),
              HasSubstr("no DICOM image"));
  EXPECT_THAT(refusal([&] {
                deidentify(made.folder / "CT", made.folder / "c", {"J\xc3\xa4ne", ""});
              }),
              HasSubstr("printable ASCII"));
}

}  // namespace
}  // namespace ostia::dicom
