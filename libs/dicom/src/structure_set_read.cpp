// Contours of radiotherapy structure sets.

#include "label_parts.h"
#include "tags.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace ostia::dicom {
namespace {

using imaging::Geometry;
using imaging::Vec3;

constexpr double own_pixel_mm = 0.25;  // of a grid that follows from the contours
constexpr double margin_mm = 1.0;
constexpr double same_plane_mm = 0.1;    // of contours of two structures
constexpr double most_off_slice = 0.25;  // of the distance of slices
constexpr std::size_t most_contour_points = 20'000'000;

struct ReadContour {
  std::size_t segment = 0;
  std::vector<Vec3> points;
};

std::vector<Vec3> points_of(const DicomDataset& item, int number) {
  const std::vector<double> values = item.decimals(0x30060050);
  if (values.size() < 9 || values.size() % 3 != 0)
    throw InvalidInput("ContourData (3006,0050) of structure " + std::to_string(number) +
                       " is missing or no list of points");
  std::vector<Vec3> points;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
    points.emplace_back(values[i], values[i + 1], values[i + 2]);
    if (!points.back().allFinite())
      throw InvalidInput("ContourData (3006,0050) of structure " + std::to_string(number) + " is not finite");
  }
  return points;
}

std::vector<ReadContour> contours_in(const DicomDataset& data, LabelObject& to) {
  std::map<int, std::size_t> places;
  for (const DicomDataset& item : data.items(0x30060020)) {
    const std::optional<std::int64_t> number = item.integer(0x30060022);
    if (!number || *number < 0 || *number > 1'000'000)
      throw InvalidInput("ROINumber (3006,0022) is missing or no number that can be");
    if (!places.emplace(static_cast<int>(*number), to.segments.size()).second)
      throw InvalidInput("ROINumber (3006,0022) " + std::to_string(*number) + " is there twice");
    to.segments.push_back({static_cast<int>(*number), 0, item.text(0x30060026), {}, {}});
  }
  if (places.empty()) throw InvalidInput("StructureSetROISequence (3006,0020) is missing or empty");
  std::vector<ReadContour> contours;
  std::size_t points = 0, left_out = 0;
  for (const DicomDataset& roi : data.items(0x30060039)) {
    const std::int64_t number = roi.integer(0x30060084).value_or(-1);
    const auto place = places.find(static_cast<int>(std::clamp<std::int64_t>(number, -1, 2'000'000)));
    if (place == places.end())
      throw InvalidInput("ReferencedROINumber (3006,0084) " + std::to_string(number) +
                         " is none of the structures");
    for (const DicomDataset& item : roi.items(0x30060040)) {
      const std::string kind = item.text(0x30060042);
      if (kind != "CLOSED_PLANAR" && kind != "CLOSEDPLANAR_XOR") {
        ++left_out;
        continue;
      }
      contours.push_back({place->second, points_of(item, place->first)});
      points += contours.back().points.size();
      if (points > most_contour_points) throw InvalidInput("its contours have too many points");
    }
  }
  if (left_out > 0)
    to.warnings.push_back(std::to_string(left_out) + " contours that are not closed and planar are left out");
  if (contours.empty()) throw InvalidInput("it has no closed planar contour");
  return contours;
}

/// The plane that all contours are parallel to: the axis or, of an oblique one, the contour's own normal.
Vec3 common_normal(const std::vector<ReadContour>& contours) {
  Vec3 sum = Vec3::Zero();
  double largest = 0.0;
  for (const ReadContour& one : contours) {
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 0; i < one.points.size(); ++i)
      area += (one.points[i] - one.points[0]).cross(one.points[(i + 1) % one.points.size()] - one.points[0]);
    if (area.norm() <= largest) continue;
    largest = area.norm();
    sum = area;
  }
  if (!(largest > 0.0)) throw InvalidInput("its contours have no area");
  Vec3 normal = sum.normalized();
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(std::abs(normal[axis]) - 1.0) < 1e-4) normal = Vec3::Unit(axis);
  return normal;
}

/// A grid about all contours, its slices in their planes.
Geometry own_grid(const std::vector<ReadContour>& contours) {
  const Vec3 normal = common_normal(contours);
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  Geometry grid;
  const Vec3 column = normal.cross(Vec3::Unit(least)).normalized();
  grid.direction.col(2) = normal;
  grid.direction.col(0) = column.cross(normal);
  grid.direction.col(1) = normal.cross(grid.direction.col(0));
  if ((normal - Vec3::UnitZ()).norm() < 1e-9) grid.direction = imaging::Mat3::Identity();
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  std::vector<double> planes;
  for (const ReadContour& one : contours) {
    for (const Vec3& p : one.points) {
      const Vec3 local = grid.direction.transpose() * p;
      low = low.cwiseMin(local);
      high = high.cwiseMax(local);
    }
    planes.push_back(normal.dot(one.points.front()));
  }
  std::sort(planes.begin(), planes.end());
  double step = 0.0;
  for (std::size_t i = 1; i < planes.size(); ++i)
    if (planes[i] - planes[i - 1] > same_plane_mm && (step == 0.0 || planes[i] - planes[i - 1] < step))
      step = planes[i] - planes[i - 1];
  if (step == 0.0)
    throw InvalidInput("all its contours lie in one plane; give the CT that they were drawn on");
  if (!((high - low).maxCoeff() < 5'000.0))
    throw InvalidInput("its contours lie further apart than a patient is");
  grid.spacing = {own_pixel_mm, own_pixel_mm, step};
  for (int axis = 0; axis < 3; ++axis) {
    // Half a pixel more, so that lines along the grid do not run through its pixels' centres.
    const double more = axis == 2 ? 0.0 : margin_mm + 0.5 * own_pixel_mm;
    low[axis] -= more;
    grid.size[static_cast<std::size_t>(axis)] =
        static_cast<std::int64_t>(std::ceil((high[axis] + more - low[axis]) / grid.spacing[axis] - 1e-6)) + 1;
  }
  grid.origin = grid.direction * low;
  return grid;
}

/// Crosses a row of pixel centres: sorted columns where the contour goes from outside to inside and back.
void fill_row(const std::vector<Vec3>& contour, double j, std::vector<double>& crossings) {
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const Vec3& a = contour[i];
    const Vec3& b = contour[(i + 1) % contour.size()];
    if ((a.y() <= j) == (b.y() <= j)) continue;
    crossings.push_back(a.x() + (j - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
  }
}

/// By segment and slice, in index coordinates.
using LoopsBySlice = std::map<std::pair<std::size_t, std::int64_t>, std::vector<std::vector<Vec3>>>;

/// Contours that were drawn on every second slice or fewer would be sheets with nothing between them.
void require_no_gaps(const LoopsBySlice& slices) {
  std::int64_t least = 0;
  for (auto one = slices.begin(), next = std::next(one); next != slices.end(); ++one, ++next) {
    if (one->first.first != next->first.first) continue;
    const std::int64_t apart = next->first.second - one->first.second;
    least = least == 0 ? apart : std::min(least, apart);
  }
  if (least > 1)
    throw InvalidInput("its contours lie " + std::to_string(least) +
                       " slices of the image apart; open it without the image, or on one of its own slices");
}

}  // namespace

LabelObject labels_of_structure_set(const imaging::DicomObject& object, const LabelObjectOptions& options,
                                    const core::TaskContext& task) {
  LabelObject result;
  std::vector<ReadContour> contours = contours_in(object.data, result);
  const Geometry grid = options.grid ? *options.grid : own_grid(contours);
  require_room(grid, options.most_voxels);
  LoopsBySlice slices;
  std::size_t outside = 0;
  for (ReadContour& one : contours) {
    double low = 1e300, high = -1e300;
    for (Vec3& p : one.points) {
      p = grid.index(p);
      low = std::min(low, p.z());
      high = std::max(high, p.z());
    }
    const std::int64_t k = std::llround(0.5 * (low + high));
    if (high - low > 0.5 || std::abs(0.5 * (low + high) - static_cast<double>(k)) > most_off_slice)
      throw InvalidInput(
          "a contour of structure " + std::to_string(result.segments[one.segment].number) +
          " does not lie in a slice of the image; structure sets on other planes cannot be read");
    if (k < 0 || k >= grid.size[2]) {
      ++outside;
      continue;
    }
    slices[{one.segment, k}].push_back(std::move(one.points));
  }
  if (slices.empty()) throw InvalidInput("none of its contours lies within the image");
  require_no_gaps(slices);
  if (outside > 0) result.warnings.push_back(std::to_string(outside) + " contours lie outside the image");
  LabelLayers layers(grid, result.segments.size());
  for (const auto& [place, loops] : slices) {
    task.throw_if_cancelled();
    for (std::int64_t j = 0; j < grid.size[1]; ++j) {
      std::vector<double> crossings;
      for (const std::vector<Vec3>& loop : loops) fill_row(loop, static_cast<double>(j), crossings);
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t c = 0; c + 1 < crossings.size(); c += 2) {
        const double last = std::min(std::floor(crossings[c + 1]), static_cast<double>(grid.size[0] - 1));
        for (double i = std::max(0.0, std::ceil(crossings[c])); i <= last; i += 1.0)
          layers.add(place.first,
                     static_cast<std::size_t>(grid.offset(static_cast<std::int64_t>(i), j, place.second)));
      }
    }
  }
  layers.finish(result);
  return result;
}

}  // namespace ostia::dicom
