#include "ostia/imaging/scan_technique.h"

#include "dicom_writer.h"

#include <gtest/gtest.h>

namespace ostia::imaging {
namespace {

namespace fs = std::filesystem;
using testing::CtSlice;

ScanTechnique technique_of(const std::function<void(CtSlice&)>& change,
                           std::optional<double> cardiac_percent = {}) {
  const fs::path folder = testing::temporary_folder("technique");
  testing::write_series(folder, 3, 0.5, [&](CtSlice& slice, int) { change(slice); });
  DicomSeries series = scan_dicom(folder).series.at(0);
  series.cardiac_percent = cardiac_percent;
  return scan_technique(series);
}

TEST(ScanTechnique, IsAsTheHeadersSay) {
  const ScanTechnique said = technique_of(
      [](CtSlice& slice) {
        slice.tube_kv = " 100 ";
        slice.thickness = "0.60";
        slice.kernel = "Bv40d\\3";
      },
      75.0);
  EXPECT_EQ(said.tube_kv, 100.0);
  EXPECT_EQ(said.slice_mm, 0.6);
  EXPECT_EQ(said.phase_percent, 75.0);
  EXPECT_EQ(said.kernel, "Bv40d\\3");
}

TEST(ScanTechnique, WhatIsNotSaidOrNoNumberIsNothing) {
  for (const char* wrong : {"", "0", "-120", "120 kV", "many", "1e9"}) {
    const ScanTechnique said = technique_of([&](CtSlice& slice) {
      slice.tube_kv = wrong;
      slice.thickness = "";
    });
    EXPECT_FALSE(said.tube_kv || said.slice_mm || said.phase_percent) << wrong;
    EXPECT_EQ(said.kernel, "");
  }
  EXPECT_EQ(scan_technique(DicomSeries{}), ScanTechnique{});
}

}  // namespace
}  // namespace ostia::imaging
