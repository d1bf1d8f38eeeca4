// Segmentation objects of any program.

#include "label_parts.h"
#include "tags.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace ostia::dicom {
namespace {

using imaging::Geometry;
using imaging::Vec3;

constexpr std::int64_t most_planes = 16'384;
constexpr double spacing_tolerance = 0.05;  // of a slice's distance
constexpr double in_plane_tolerance = 0.1;  // of a pixel

/// What a frame needs, from its own groups or the shared ones.
struct ReadFrame {
  Vec3 position = Vec3::Zero();
  int segment = 0;
  std::int64_t k = 0;
};

/// An attribute of a frame: in its own functional groups, in the shared ones, or in the data set itself.
const DicomDataset* macro_of(const DicomDataset& data, std::size_t frame, imaging::DicomTag sequence,
                             imaging::DicomTag needed) {
  const std::vector<DicomDataset>& own = data.items(tag::per_frame_groups);
  if (frame < own.size())
    if (const DicomDataset* item = own[frame].item(sequence); item && item->has(needed)) return item;
  if (const DicomDataset* shared = data.item(tag::shared_groups))
    if (const DicomDataset* item = shared->item(sequence); item && item->has(needed)) return item;
  return data.has(needed) ? &data : nullptr;
}

Vec3 three(const std::vector<double>& v, std::size_t first = 0) {
  return {v[first], v[first + 1], v[first + 2]};
}

/// Row and column directions, and pixel spacing: the same in all frames.
struct PlaneShape {
  Vec3 row = Vec3::Zero(), column = Vec3::Zero();
  double between_rows = 0.0, between_columns = 0.0;
};

PlaneShape plane_shape(const DicomDataset& data, std::size_t frame) {
  const std::string where = " of frame " + std::to_string(frame + 1);
  const DicomDataset* plane = macro_of(data, frame, tag::plane_orientation, tag::image_orientation);
  const std::vector<double> o = plane ? plane->decimals(tag::image_orientation) : std::vector<double>();
  const DicomDataset* measures = macro_of(data, frame, tag::pixel_measures, tag::pixel_spacing);
  const std::vector<double> s = measures ? measures->decimals(tag::pixel_spacing) : std::vector<double>();
  if (o.size() != 6)
    throw InvalidInput("ImageOrientationPatient (0020,0037)" + where + " is missing or no six numbers");
  if (s.size() != 2 || !(s[0] > 0.0) || !(s[1] > 0.0) || !std::isfinite(s[0] + s[1]))
    throw InvalidInput("PixelSpacing (0028,0030)" + where + " is missing or not two positive numbers");
  PlaneShape shape{three(o), three(o, 3), s[0], s[1]};
  if (!(std::abs(shape.row.norm() - 1.0) < 1e-3) || !(std::abs(shape.column.norm() - 1.0) < 1e-3) ||
      !(std::abs(shape.row.dot(shape.column)) < 1e-3))
    throw InvalidInput("ImageOrientationPatient (0020,0037)" + where +
                       " is not two unit vectors at right angles");
  shape.row.normalize();
  shape.column = (shape.column - shape.row * shape.row.dot(shape.column)).normalized();
  return shape;
}

std::vector<ReadFrame> frames_in(const DicomDataset& data, std::size_t count, const PlaneShape& shape) {
  std::vector<ReadFrame> frames(count);
  for (std::size_t f = 0; f < count; ++f) {
    const std::string where = " of frame " + std::to_string(f + 1);
    const PlaneShape own = plane_shape(data, f);
    if ((own.row - shape.row).norm() > 1e-3 || (own.column - shape.column).norm() > 1e-3 ||
        std::abs(own.between_rows - shape.between_rows) > 1e-3 * shape.between_rows ||
        std::abs(own.between_columns - shape.between_columns) > 1e-3 * shape.between_columns)
      throw InvalidInput("orientation or pixel spacing" + where + " differ from those of the first frame");
    const DicomDataset* plane = macro_of(data, f, tag::plane_position, tag::image_position);
    const std::vector<double> p = plane ? plane->decimals(tag::image_position) : std::vector<double>();
    if (p.size() != 3 || !std::isfinite(p[0] + p[1] + p[2]))
      throw InvalidInput("ImagePositionPatient (0020,0032)" + where + " is missing or no three numbers");
    const DicomDataset* segment =
        macro_of(data, f, tag::segment_identification, tag::segment_number_reference);
    const std::optional<std::uint16_t> number =
        segment ? segment->u16(tag::segment_number_reference) : std::nullopt;
    if (!number) throw InvalidInput("ReferencedSegmentNumber (0062,000B)" + where + " is missing");
    frames[f] = {three(p), *number, 0};
  }
  return frames;
}

/// The grid that all frames lie on; sets their k.
Geometry grid_of_frames(const DicomDataset& data, const PlaneShape& shape, int rows, int columns,
                        std::vector<ReadFrame>& frames, std::int64_t most_voxels) {
  const Vec3 normal = shape.row.cross(shape.column);
  std::vector<double> heights;
  for (const ReadFrame& one : frames) heights.push_back(normal.dot(one.position));
  std::vector<double> planes = heights;
  std::sort(planes.begin(), planes.end());
  const DicomDataset* measures = macro_of(data, 0, tag::pixel_measures, 0x00180088);
  double spacing = measures ? std::abs(measures->decimal(0x00180088).value_or(0.0)) : 0.0;
  double least = 0.0;  // distance of two planes
  for (std::size_t i = 1; i < planes.size(); ++i) {
    const double step = planes[i] - planes[i - 1];
    if (step > 1e-3 && (least == 0.0 || step < least)) least = step;
  }
  if (least > 0.0) {
    // Slices that are left out make gaps of whole steps. What is said of the distance holds where the planes
    // agree; some programs write there the thickness of the slices.
    const double steps = spacing > 0.0 ? least / spacing : 0.5;
    if (!(steps > 0.5 && std::abs(steps - std::round(steps)) <= spacing_tolerance * std::round(steps)))
      spacing = least;
  }
  if (!(spacing > 0.0)) {
    const DicomDataset* thick = macro_of(data, 0, tag::pixel_measures, 0x00180050);
    spacing = thick ? std::abs(thick->decimal(0x00180050).value_or(0.0)) : 0.0;
  }
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw InvalidInput(
        "it has one plane, and neither SpacingBetweenSlices (0018,0088) nor SliceThickness "
        "(0018,0050) says how thick that is");
  if (!((planes.back() - planes.front()) / spacing < static_cast<double>(most_planes)))
    throw InvalidInput("its frames lie " + std::to_string(planes.back() - planes.front()) +
                       " mm apart, at slices of " + std::to_string(spacing) +
                       " mm; that is no image: ImagePositionPatient (0020,0032) is wrong");
  // The mean step over the whole, so that rounding does not add up.
  const double whole = std::round((planes.back() - planes.front()) / spacing);
  if (whole > 0.0 && std::abs((planes.back() - planes.front()) / spacing - whole) <= 0.5)
    spacing = (planes.back() - planes.front()) / whole;
  Geometry grid;
  grid.size = {columns, rows, static_cast<std::int64_t>(whole) + 1};
  grid.spacing = {shape.between_columns, shape.between_rows, spacing};
  grid.direction.col(0) = shape.row;
  grid.direction.col(1) = shape.column;
  grid.direction.col(2) = normal;
  const auto lowest = std::min_element(heights.begin(), heights.end()) - heights.begin();
  grid.origin = frames[static_cast<std::size_t>(lowest)].position;
  require_room(grid, most_voxels);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Vec3 index = grid.index(frames[f].position);
    if (std::abs(index.x()) > in_plane_tolerance || std::abs(index.y()) > in_plane_tolerance)
      throw InvalidInput("frame " + std::to_string(f + 1) +
                         " is shifted within its plane against the others (a tilted gantry?); resample the "
                         "segmentation to upright slices");
    frames[f].k = std::llround(index.z());
    if (std::abs(index.z() - static_cast<double>(frames[f].k)) > 0.25)
      throw InvalidInput("the planes of its frames are not equally far apart (frame " +
                         std::to_string(f + 1) + "); resample the segmentation to even slices");
  }
  return grid;
}

std::map<int, std::size_t> segments_in(const DicomDataset& data, LabelObject& to) {
  std::map<int, std::size_t> places;
  for (const DicomDataset& item : data.items(0x00620002)) {
    const std::optional<std::uint16_t> number = item.u16(0x00620004);
    if (!number) throw InvalidInput("SegmentNumber (0062,0004) is missing");
    if (!places.emplace(*number, to.segments.size()).second)
      throw InvalidInput("SegmentNumber (0062,0004) " + std::to_string(*number) + " is there twice");
    to.segments.push_back(
        {*number, 0, item.text(0x00620005), code_of(item, 0x00620003), code_of(item, 0x0062000F)});
  }
  if (places.empty()) throw InvalidInput("SegmentSequence (0062,0002) is missing or empty");
  return places;
}

struct PixelLayout {
  std::size_t rows = 0, columns = 0, frames = 0, bits = 1;
  unsigned threshold = 1;
  std::size_t plane() const { return rows * columns; }
};

PixelLayout layout_of(const DicomDataset& data, const std::string& transfer_syntax) {
  PixelLayout layout;
  layout.rows = data.u16(tag::rows).value_or(0);
  layout.columns = data.u16(tag::columns).value_or(0);
  layout.bits = data.u16(tag::bits_allocated).value_or(0);
  const std::int64_t frames = data.integer(tag::number_of_frames).value_or(0);
  if (layout.rows == 0 || layout.columns == 0)
    throw InvalidInput("Rows (0028,0010) or Columns (0028,0011) is missing or 0");
  if (frames < 1 || frames > 10'000'000)
    throw InvalidInput("NumberOfFrames (0028,0008) is missing or no number that can be");
  layout.frames = static_cast<std::size_t>(frames);
  if (layout.bits != 1 && layout.bits != 8 && layout.bits != 16)
    throw InvalidInput("BitsAllocated (0028,0100) is " + std::to_string(layout.bits) +
                       "; 1, 8 and 16 can be read");
  const imaging::DicomElement* pixels = data.find(tag::pixel_data);
  if (!pixels) throw InvalidInput("PixelData (7FE0,0010) is missing");
  if (pixels->encapsulated)
    throw InvalidInput("its pixel data are compressed (transfer syntax " + transfer_syntax +
                       "); write it uncompressed, as by `dcmdrle` or `dcmdjpeg` of DCMTK");
  // Frames of at most 2^32 pixels, so that no product overflows.
  const std::size_t needed = (layout.frames * layout.plane() * layout.bits + 7) / 8;
  if (pixels->value.size() < needed)
    throw InvalidInput("PixelData (7FE0,0010) has " + std::to_string(pixels->value.size()) + " bytes; " +
                       std::to_string(layout.frames) + " frames need " + std::to_string(needed));
  const std::size_t described = data.items(tag::per_frame_groups).size();
  if (described != layout.frames)
    throw InvalidInput("PerFrameFunctionalGroupsSequence (5200,9230) describes " + std::to_string(described) +
                       " frames; NumberOfFrames (0028,0008) is " + std::to_string(layout.frames));
  if (data.text(0x00620001) == "FRACTIONAL") {
    const std::uint16_t most = data.u16(0x0062000E).value_or(layout.bits == 8 ? 255 : 1);
    layout.threshold = std::max(1u, (most + 1u) / 2u);
  }
  return layout;
}

unsigned pixel_at(const std::string& bytes, const PixelLayout& layout, std::size_t at) {
  if (layout.bits == 1) return static_cast<unsigned char>(bytes[at / 8]) >> (at % 8) & 1u;
  if (layout.bits == 8) return static_cast<unsigned char>(bytes[at]);
  return static_cast<unsigned char>(bytes[2 * at]) | static_cast<unsigned char>(bytes[2 * at + 1]) << 8;
}

}  // namespace

LabelObject labels_of_segmentation(const imaging::DicomObject& object, const LabelObjectOptions& options,
                                   const core::TaskContext& task) {
  const DicomDataset& data = object.data;
  LabelObject result;
  const PixelLayout layout = layout_of(data, object.transfer_syntax);
  const std::map<int, std::size_t> places = segments_in(data, result);
  const PlaneShape shape = plane_shape(data, 0);
  std::vector<ReadFrame> frames = frames_in(data, layout.frames, shape);
  const Geometry grid = grid_of_frames(data, shape, static_cast<int>(layout.rows),
                                       static_cast<int>(layout.columns), frames, options.most_voxels);
  const bool label_map = data.text(0x00620001) == "LABELMAP";
  if (label_map)
    throw InvalidInput("SegmentationType (0062,0001) LABELMAP cannot be read yet; write it as BINARY");
  LabelLayers layers(grid, result.segments.size());
  const std::string& bytes = data.find(tag::pixel_data)->value;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    task.throw_if_cancelled();
    const auto place = places.find(frames[f].segment);
    if (place == places.end())
      throw InvalidInput("frame " + std::to_string(f + 1) + " belongs to segment " +
                         std::to_string(frames[f].segment) + ", which SegmentSequence (0062,0002) lacks");
    const auto first = static_cast<std::size_t>(grid.offset(0, 0, frames[f].k));
    for (std::size_t i = 0; i < layout.plane(); ++i)
      if (pixel_at(bytes, layout, f * layout.plane() + i) >= layout.threshold)
        layers.add(place->second, first + i);
    task.set_progress(static_cast<double>(f + 1) / static_cast<double>(frames.size()));
  }
  layers.finish(result);
  return result;
}

}  // namespace ostia::dicom
