#include "dicom_series.h"

#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::imaging {
namespace {

using core::significant_text;

constexpr double kUnevenMm = 0.2;     // more than this off the even grid has to be resampled
constexpr double kUnevenPart = 0.25;  // of the spacing: what counts where slices are thin
constexpr double kShearPixels = 0.1;  // shifts in the plane below this are rounding of positions
constexpr double kDegrees = 57.29577951308232;

struct Axes {
  Vec3 row, column, normal;
};

std::optional<Axes> axes(const DicomFrame& frame) {
  if (!frame.orientation) return std::nullopt;
  const auto& o = *frame.orientation;
  Axes a{Vec3(o[0], o[1], o[2]), Vec3(o[3], o[4], o[5]), Vec3::Zero()};
  const double row = a.row.norm(), column = a.column.norm();
  if (!(std::abs(row - 1.0) < 1e-2 && std::abs(column - 1.0) < 1e-2)) return std::nullopt;
  a.row /= row;
  a.column /= column;
  if (std::abs(a.row.dot(a.column)) > 1e-2) return std::nullopt;
  a.column = (a.column - a.row.dot(a.column) * a.row).normalized();
  a.normal = a.row.cross(a.column);
  return a;
}

void set_in_plane(DicomSeriesDetail& series, const Axes& a) {
  DicomSeries& summary = series.summary;
  const DicomFrame& first = series.slices.front().info();
  Geometry& g = summary.geometry;
  g.direction.col(0) = a.row;
  g.direction.col(1) = a.column;
  g.direction.col(2) = a.normal;
  if (first.position) g.origin = *first.position;
  const DicomHeader& header = *series.slices.front().header;
  g.size = {header.columns, header.rows, static_cast<std::int64_t>(series.slices.size())};
  if (!first.pixel_spacing) {
    summary.faults.push_back("PixelSpacing is missing in " + series.slices.front().name() +
                             "; give it (pixel_spacing_mm, --pixel-spacing MM)");
    return;
  }
  const auto& spacing = *first.pixel_spacing;
  if (!(spacing[0] > 0.0 && spacing[1] > 0.0)) {
    summary.faults.push_back("PixelSpacing is " + significant_text(spacing[0], 6) + " by " +
                             significant_text(spacing[1], 6) + " mm in " + series.slices.front().name() +
                             "; it must be positive");
    return;
  }
  g.spacing = Vec3(spacing[1], spacing[0], 1.0);  // rows lie one below the other: the first number is y's
}

/// Gaps that are no multiple of the others, or missing slices. Fills in the even grid.
void check_distances(DicomSeriesDetail& series) {
  DicomSeries& summary = series.summary;
  const auto& slices = series.slices;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < slices.size(); ++i) gaps.push_back(slices[i].depth_mm - slices[i - 1].depth_mm);
  std::vector<double> sorted = gaps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  const double typical = sorted[sorted.size() / 2];
  const double smallest = *std::min_element(gaps.begin(), gaps.end());
  const double tolerance = std::min(kUnevenMm, kUnevenPart * typical);
  const double length = slices.back().depth_mm - slices.front().depth_mm;

  std::int64_t steps = 0;
  int missing = 0;
  bool multiples = true;
  std::vector<std::string> where;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const std::int64_t count = std::max<std::int64_t>(1, std::llround(gaps[i] / typical));
    steps += count;
    if (std::abs(gaps[i] - static_cast<double>(count) * typical) > tolerance) multiples = false;
    if (count == 1) continue;
    missing += static_cast<int>(count - 1);
    where.push_back("between slices " + std::to_string(i + 1) + " and " + std::to_string(i + 2) + " (" +
                    significant_text(gaps[i], 6) + " mm)");
  }
  if (multiples) {
    // Distances may each be right and yet add up to another grid.
    const double mean = length / static_cast<double>(steps);
    double at = 0.0;
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      at += std::max(1.0, std::round(gaps[i] / typical)) * mean;
      if (std::abs(slices[i + 1].depth_mm - slices.front().depth_mm - at) > tolerance) multiples = false;
    }
  }
  summary.geometry.spacing[2] =
      length / static_cast<double>(multiples ? steps : static_cast<std::int64_t>(gaps.size()));
  if (multiples && missing == 0) return;

  summary.uneven = true;
  if (multiples) {
    series.even_slices = steps + 1;
    std::string text =
        std::to_string(missing) + (missing == 1 ? " slice is missing " : " slices are missing ");
    for (std::size_t i = 0; i < std::min<std::size_t>(where.size(), 4); ++i)
      text += (i > 0 ? ", " : "") + where[i];
    if (where.size() > 4) text += " and at " + std::to_string(where.size() - 4) + " more places";
    summary.warnings.push_back(text + ", where slices are " +
                               significant_text(summary.geometry.spacing[2], 6) + " mm apart");
  } else {
    const double step = std::max(smallest, typical / 4.0);
    series.even_slices = std::max<std::int64_t>(2, std::llround(std::ceil(length / step - 1e-6)) + 1);
    summary.warnings.push_back("slices are unevenly apart: from " + significant_text(smallest, 6) + " to " +
                               significant_text(*std::max_element(gaps.begin(), gaps.end()), 6) + " mm");
  }
  series.even_spacing_mm = length / static_cast<double>(series.even_slices - 1);
}

void check_shear(DicomSeriesDetail& series, const Axes& a) {
  DicomSeries& summary = series.summary;
  const Vec3 first = *series.slices.front().info().position;
  double largest = 0.0;
  for (DicomSlice& slice : series.slices) {
    const Vec3 offset = *slice.info().position - first;
    slice.shift_mm[0] = offset.dot(a.row);
    slice.shift_mm[1] = offset.dot(a.column);
    largest = std::max(largest, std::hypot(slice.shift_mm[0], slice.shift_mm[1]));
  }
  if (largest <= kShearPixels * summary.geometry.spacing.head<2>().minCoeff()) return;
  series.sheared = true;
  const DicomSlice& last = series.slices.back();
  const double length = last.depth_mm - series.slices.front().depth_mm;
  summary.gantry_tilt_deg = std::atan2(std::hypot(last.shift_mm[0], last.shift_mm[1]), length) * kDegrees;
  summary.warnings.push_back("slices are shifted in their plane by up to " + significant_text(largest, 6) +
                             " mm (tilted gantry, " + significant_text(summary.gantry_tilt_deg, 6) +
                             " degrees): corrected by resampling");
}

void check_duplicates(DicomSeriesDetail& series) {
  const auto& slices = series.slices;
  for (std::size_t i = 1; i < slices.size(); ++i) {
    if (slices[i].depth_mm - slices[i - 1].depth_mm >= kSameDepthMm) continue;
    const bool same = !slices[i].header->sop_instance.empty() &&
                      slices[i].header->sop_instance == slices[i - 1].header->sop_instance &&
                      slices[i].frame == slices[i - 1].frame;
    series.summary.faults.push_back(slices[i - 1].name() + " and " + slices[i].name() +
                                    (same ? " are the same image twice; remove one"
                                          : " lie at the same place, and neither phase, time nor acquisition "
                                            "number tells such slices apart"));
    return;
  }
}

}  // namespace

std::string DicomSlice::name() const {
  std::string text = "'" + header->path.filename().string() + "'";
  if (header->frame_count > 1) text += " frame " + std::to_string(frame + 1);
  return text;
}

bool set_depths(std::vector<DicomSlice>& slices) {
  for (DicomSlice& slice : slices) {
    const auto a = axes(slices.front().info());
    if (!a || !slice.info().position) return false;
    slice.depth_mm = slice.info().position->dot(a->normal);
  }
  return true;
}

void place_slices(DicomSeriesDetail& series) {
  DicomSeries& summary = series.summary;
  std::vector<DicomSlice>& slices = series.slices;
  const bool placed = set_depths(slices);
  std::stable_sort(slices.begin(), slices.end(),
                   [](const DicomSlice& a, const DicomSlice& b) { return a.depth_mm < b.depth_mm; });
  const auto a = axes(slices.front().info());
  if (!placed || !a) {
    const auto lacking =
        std::find_if(slices.begin(), slices.end(), [](const DicomSlice& s) { return !s.info().position; });
    if (lacking != slices.end()) {
      summary.faults.push_back(
          "ImagePositionPatient is missing in " + lacking->name() +
          ": nothing else says where slices lie (SliceThickness does not); give their distance "
          "(slice_spacing_mm, --slice-spacing MM) to stack them by instance number");
    } else {
      summary.lacks_orientation = summary.faults.empty() && !slices.front().info().orientation;
      summary.faults.push_back(
          std::string("ImageOrientationPatient is ") +
          (slices.front().info().orientation ? "not two perpendicular unit vectors" : "missing") + " in " +
          slices.front().name());
    }
    set_in_plane(series, a.value_or(Axes{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}));
    return;
  }
  set_in_plane(series, *a);
  if (slices.size() < 2) {
    summary.faults.push_back(slices.front().name() + " is a single slice; a volume takes at least two");
    return;
  }
  check_duplicates(series);
  if (!summary.faults.empty()) return;
  check_distances(series);
  check_shear(series, *a);
}

}  // namespace ostia::imaging
