#pragma once
/// \file A small CT series on disk, its source, and a mask on its grid.

#include "shared_data.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/dicom/object.h"
#include "ostia/dicom/segmentation.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/dicom_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace ostia::dicom::testing {

namespace fs = std::filesystem;
using imaging::Geometry;
using imaging::MaskVolume;
using imaging::Mat3;

/// The 24 rotations that take axes to axes.
inline std::vector<Mat3> axis_rotations() {
  std::vector<Mat3> all;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      if (a == b) continue;
      for (const double sa : {1.0, -1.0})
        for (const double sb : {1.0, -1.0}) {
          Mat3 m = Mat3::Zero();
          m(a, 0) = sa;
          m(b, 1) = sb;
          m.col(2) = m.col(0).cross(m.col(1));
          all.push_back(m);
        }
    }
  return all;
}

/// Turned about an axis that is none of the grid's.
inline Mat3 oblique() {
  return Eigen::AngleAxisd(0.41, Vec3(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
}

/// Sizes and spacings differ along each axis, so that none can be taken for another.
inline Geometry grid_with(const Mat3& direction) {
  Geometry grid;
  grid.size = {13, 10, 7};
  grid.spacing = {0.4, 0.5, 0.8};
  grid.direction = direction;
  grid.origin = {-21.5, 34.25, -160.75};
  return grid;
}

struct MadeSeries {
  fs::path folder;
  imaging::DicomSeries series;
  SourceSeries source;
};

inline MadeSeries made_series(const Geometry& grid, const std::string& name = "DOE^JANE") {
  MadeSeries made;
  made.folder = ostia::testing::temporary_folder("dicom");
  imaging::ImageVolume image{grid, std::vector<std::int16_t>(static_cast<std::size_t>(grid.voxels()), 40)};
  imaging::DicomSeriesOptions options;
  options.patient_name = name;
  options.patient_id = "4711";
  imaging::write_dicom_series(made.folder / "CT", image, options);
  made.series = imaging::scan_dicom(made.folder / "CT").series.at(0);
  made.source = source_of(made.series);
  return made;
}

/// A mask with two labels that has no symmetry: a block near one corner, two voxels near another.
inline MaskVolume lopsided_mask(const Geometry& grid) {
  MaskVolume mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxels()), 0)};
  for (std::int64_t k = 1; k < 3; ++k)
    for (std::int64_t j = 1; j < 4; ++j)
      for (std::int64_t i = 2; i < 7; ++i) mask(i, j, k) = 1;
  mask(11, 8, 5) = 2;
  mask(11, 7, 5) = 2;
  return mask;
}

inline std::vector<Segment> two_segments() {
  Segment lumen{"Coronary lumen", "", codes::body_structure, codes::vessel_lumen, codes::coronary_artery,
                {1.0, 0.0, 0.0},  {1}};
  Segment plaque{
      "Plaque",        "", codes::abnormal_structure, codes::calcified_plaque, codes::coronary_artery,
      {1.0, 1.0, 1.0}, {2}};
  return {lumen, plaque};
}

inline fs::path written(const DicomDataset& object, const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name;
  core::write_file(file, imaging::dicom_file(object));
  return file;
}

/// World places of the voxels with a label.
inline std::vector<Vec3> places_of(const MaskVolume& mask, std::uint8_t label) {
  std::vector<Vec3> places;
  for (std::int64_t k = 0; k < mask.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < mask.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < mask.geometry.size[0]; ++i)
        if (mask(i, j, k) == label)
          places.push_back(
              mask.geometry.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}));
  return places;
}

/// The largest distance of a place of `a` from the nearest one of `b`; infinite where their numbers differ.
inline double apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const Vec3& p : a) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& q : b) least = std::min(least, (p - q).norm());
    most = std::max(most, least);
  }
  return most;
}

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

/// Runs a line of the shell; its whole output comes back.
struct ShellRun {
  bool good = false;
  std::string output;
};
inline ShellRun shell_run(const fs::path& folder, const std::string& line,
                          const core::ChildLimits& limits = {}) {
  const fs::path log = folder / "shell.log";
  const core::ChildResult child = core::run_child(
      "/bin/sh", {"-c", "cd '" + folder.string() + "' && ( " + line + " ) > '" + log.string() + "' 2>&1"},
      limits);
  return {child.ok(), fs::exists(log) ? core::read_file(log) : child.standard_error};
}

}  // namespace ostia::dicom::testing
