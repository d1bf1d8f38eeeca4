#include "dicom_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace ostia::imaging {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

DicomSeriesDetail stack(const std::vector<Vec3>& positions,
                        const std::array<double, 6>& orientation = {1, 0, 0, 0, 1, 0}) {
  DicomSeriesDetail series;
  for (const Vec3& position : positions) {
    auto header = std::make_shared<DicomHeader>();
    header->path = "slice" + std::to_string(series.slices.size());
    header->rows = 10;
    header->columns = 20;
    header->frames.resize(1);
    header->frames[0].position = position;
    header->frames[0].orientation = orientation;
    header->frames[0].pixel_spacing = {0.7, 0.4};
    DicomSlice slice;
    slice.header = header;
    series.slices.push_back(slice);
  }
  return series;
}

TEST(PlaceSlices, ALandmarkOfAnObliqueStackLiesWhereTheStandardSays) {
  // PS3.3 C.7.6.2.1.1: position + column index * spacing along the row direction + row index * spacing along
  // the column's.
  const Vec3 row = Vec3(2, 1, -2) / 3.0, column = Vec3(1, 2, 2) / 3.0, normal = row.cross(column);
  std::vector<Vec3> positions;
  for (const int k : {3, 0, 2, 1}) positions.push_back(Vec3(5, -6, 7) + 1.25 * k * normal);
  DicomSeriesDetail series = stack(positions, {row[0], row[1], row[2], column[0], column[1], column[2]});
  place_slices(series);
  ASSERT_TRUE(series.summary.faults.empty());
  const Vec3 landmark = Vec3(5, -6, 7) + 1.25 * 2 * normal + 11 * 0.4 * row + 3 * 0.7 * column;
  EXPECT_NEAR((series.summary.geometry.world(Vec3(11, 3, 2)) - landmark).norm(), 0.0, 1e-9);
  EXPECT_FALSE(series.sheared);
}

TEST(PlaceSlices, ShiftsOfRoundingAreNoTilt) {
  DicomSeriesDetail series = stack({{0, 0, 0}, {0.003, 0.001, 1}, {-0.002, 0, 2}});
  place_slices(series);
  EXPECT_FALSE(series.sheared);
  EXPECT_TRUE(series.summary.warnings.empty());
}

TEST(PlaceSlices, EvenGridOfMissingSlicesKeepsTheOthersInPlace) {
  DicomSeriesDetail series = stack({{0, 0, 0}, {0, 0, 1.5}, {0, 0, 6.0}, {0, 0, 7.5}});
  place_slices(series);
  EXPECT_TRUE(series.summary.uneven);
  EXPECT_EQ(series.even_slices, 6);
  EXPECT_NEAR(series.even_spacing_mm, 1.5, 1e-12);
}

TEST(PlaceSlices, EvenGridOfUnevenSlicesIsAsFineAsTheFinest) {
  DicomSeriesDetail series = stack({{0, 0, 0}, {0, 0, 1.2}, {0, 0, 3.0}, {0, 0, 5.4}, {0, 0, 7.2}});
  place_slices(series);
  EXPECT_TRUE(series.summary.uneven);
  EXPECT_LE(series.even_spacing_mm, 1.2 + 1e-9);
  EXPECT_NEAR(series.even_spacing_mm * static_cast<double>(series.even_slices - 1), 7.2, 1e-9);
}

TEST(PlaceSlices, OrientationMustBeTwoPerpendicularUnitVectors) {
  for (const std::array<double, 6>& wrong :
       {std::array<double, 6>{0, 0, 0, 0, 0, 0}, {1, 0, 0, 1, 0, 0}, {2, 0, 0, 0, 1, 0}}) {
    DicomSeriesDetail series = stack({{0, 0, 0}, {0, 0, 1}}, wrong);
    place_slices(series);
    EXPECT_THAT(series.summary.faults, ElementsAre(HasSubstr("not two perpendicular unit vectors")));
  }
}

TEST(PlaceSlices, ASingleSliceIsNoVolume) {
  DicomSeriesDetail series = stack({{0, 0, 0}});
  place_slices(series);
  EXPECT_THAT(series.summary.faults, ElementsAre(HasSubstr("single slice")));
}

TEST(PlaceSlices, SlicesAtOnePlaceAreRefusedByName) {
  DicomSeriesDetail series = stack({{0, 0, 0}, {0, 0, 1}, {0, 0, 1.001}});
  place_slices(series);
  EXPECT_THAT(series.summary.faults, ElementsAre(HasSubstr("'slice1' and 'slice2' lie at the same place")));
}

}  // namespace
}  // namespace ostia::imaging
