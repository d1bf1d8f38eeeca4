#include "ostia/dicom/segmentation.h"

#include "color_lab.h"
#include "tags.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::dicom {
namespace {

constexpr const char* segmentation_storage = "1.2.840.10008.5.1.4.1.1.66.4";

struct SegmentFrame {
  std::size_t segment = 0;  ///< from 0
  std::int64_t k = 0;
};

void require_grid(const imaging::MaskVolume& volume, const std::vector<Segment>& segments,
                  const SegmentationOptions& options) {
  const imaging::Geometry& g = volume.geometry;
  if (g.voxels() < 1 || static_cast<std::int64_t>(volume.voxels.size()) != g.voxels())
    throw InvalidInput("DICOM segmentation: the mask is empty or does not fill its grid");
  if (g.size[0] > 65535 || g.size[1] > 65535)
    throw InvalidInput("DICOM segmentation: the mask has more than 65,535 rows or columns");
  if (segments.empty() || segments.size() > 65535)
    throw InvalidInput("DICOM segmentation: " + std::to_string(segments.size()) +
                       " segments; 1 to 65,535 can be written");
  if (options.fractional && segments.size() != 1)
    throw InvalidInput("DICOM segmentation: occupancies are those of one segment");
  const Vec3 normal = g.direction.col(0).cross(g.direction.col(1));
  if (!g.direction.isUnitary(1e-6) || normal.dot(g.direction.col(2)) < 1.0 - 1e-6)
    throw InvalidInput("DICOM segmentation: the k axis does not run along the normal of the slices");
}

/// The source's slice in the plane of slice k; null: none.
class SlicesByPlane {
 public:
  SlicesByPlane(const SourceSeries& source, const imaging::Geometry& grid) : source_(source), grid_(grid) {}
  const SourceFrame* at(std::int64_t k) const {
    const Vec3 normal = grid_.direction.col(2);
    const double plane = normal.dot(grid_.world(Vec3(0.0, 0.0, static_cast<double>(k))));
    const SourceFrame* best = nullptr;
    double least = 0.5 * grid_.spacing.z();
    for (const SourceFrame& one : source_.frames) {
      const double away = std::abs(normal.dot(one.position) - plane);
      if (away >= least) continue;
      least = away;
      best = &one;
    }
    return best;
  }

 private:
  const SourceSeries& source_;
  const imaging::Geometry& grid_;
};

/// Whether each value of the volume is in each segment.
using InSegment = std::vector<std::array<bool, 256>>;
InSegment in_segments(const std::vector<Segment>& segments, bool fractional) {
  InSegment in(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s) {
    in[s].fill(fractional);
    if (fractional) in[s][0] = false;
    for (const std::uint8_t value : segments[s].values) in[s][value] = true;
  }
  return in;
}

std::vector<SegmentFrame> frames_of(const imaging::MaskVolume& volume, const InSegment& in) {
  const std::int64_t plane = volume.geometry.size[0] * volume.geometry.size[1];
  std::vector<std::array<bool, 256>> seen(static_cast<std::size_t>(volume.geometry.size[2]));
  for (std::int64_t k = 0; k < volume.geometry.size[2]; ++k) {
    auto& here = seen[static_cast<std::size_t>(k)];
    here.fill(false);
    for (std::int64_t i = 0; i < plane; ++i)
      here[volume.voxels[static_cast<std::size_t>(k * plane + i)]] = true;
  }
  std::vector<SegmentFrame> frames;
  for (std::size_t s = 0; s < in.size(); ++s)
    for (std::int64_t k = 0; k < volume.geometry.size[2]; ++k)
      for (std::size_t value = 0; value < 256; ++value)
        if (seen[static_cast<std::size_t>(k)][value] && in[s][value]) {
          frames.push_back({s, k});
          break;
        }
  return frames;
}

void add_segments(DicomDataset& d, const std::vector<Segment>& segments, const SegmentationOptions& options) {
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const Segment& one = segments[s];
    DicomDataset item;
    set_code(item, 0x00620003, one.category);
    item.set_u16(0x00620004, {static_cast<std::uint16_t>(s + 1)});
    set_own_text(item, d, 0x00620005, "LO", one.label);
    if (!one.description.empty()) set_own_text(item, d, 0x00620006, "ST", one.description);
    item.set_text(0x00620008, "CS", "SEMIAUTOMATIC");
    set_own_text(item, d, 0x00620009, "LO", options.algorithm);
    const std::array<std::uint16_t, 3> lab = cie_lab(one.rgb);
    item.set_u16(0x0062000D, {lab[0], lab[1], lab[2]});
    set_code(item, 0x0062000F, one.type);
    if (!(one.region == one.type)) set_code(item, 0x00082218, one.region);
    d.add_item(0x00620002) = std::move(item);
  }
}

void add_dimensions(DicomDataset& d) {
  const std::string uid = imaging::dicom_uid(d.text(tag::series_uid) + "/dimensions");
  d.add_item(0x00209221).set_text(0x00209164, "UI", uid);
  const auto add = [&](imaging::DicomTag pointer, imaging::DicomTag group, const char* label) {
    DicomDataset& item = d.add_item(0x00209222);
    item.set_text(0x00209164, "UI", uid);
    item.set_tag(0x00209165, pointer);
    item.set_tag(0x00209167, group);
    item.set_text(0x00209421, "LO", label);
  };
  add(tag::segment_number_reference, tag::segment_identification, "Segment");
  add(tag::image_position, tag::plane_position, "Slice");
}

void add_shared(DicomDataset& d, const imaging::Geometry& g) {
  DicomDataset& shared = d.add_item(tag::shared_groups);
  const Vec3 row = g.direction.col(0), column = g.direction.col(1);
  shared.add_item(tag::plane_orientation)
      .set_decimals(tag::image_orientation, {row.x(), row.y(), row.z(), column.x(), column.y(), column.z()});
  DicomDataset& measures = shared.add_item(tag::pixel_measures);
  measures.set_decimals(0x00180050, {g.spacing.z()});
  measures.set_decimals(0x00180088, {g.spacing.z()});
  measures.set_decimals(tag::pixel_spacing, {g.spacing.y(), g.spacing.x()});  // between rows, between columns
}

void add_source_image(DicomDataset& groups, const SourceFrame& frame) {
  DicomDataset& derivation = groups.add_item(0x00089124);
  DicomDataset& image = derivation.add_item(0x00082112);
  image.set_text(tag::referenced_class, "UI", frame.sop_class);
  image.set_text(tag::referenced_instance, "UI", frame.sop_instance);
  if (frame.frame > 0) image.set_text(tag::referenced_frame, "IS", std::to_string(frame.frame));
  image.set_text(0x0028135A, "CS", "YES");  // the places of its pixels are kept
  set_code(image, 0x0040A170, {"121322", "DCM", "Source image for image processing operation"});
  set_code(derivation, 0x00089215, {"113076", "DCM", "Segmentation"});
}

void add_frames(DicomDataset& d, const SourceSeries& source, const imaging::Geometry& g,
                const std::vector<SegmentFrame>& frames) {
  const SlicesByPlane slices(source, g);
  d.set_sequence(tag::per_frame_groups);
  std::vector<std::int64_t> places;  // of slices, counted as the dimension index has them
  for (const SegmentFrame& one : frames) places.push_back(one.k);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const SegmentFrame& one : frames) {
    DicomDataset groups;
    if (const SourceFrame* slice = slices.at(one.k)) add_source_image(groups, *slice);
    const auto place = std::lower_bound(places.begin(), places.end(), one.k) - places.begin();
    groups.add_item(0x00209111)
        .set_u32(0x00209157,
                 {static_cast<std::uint32_t>(one.segment + 1), static_cast<std::uint32_t>(place + 1)});
    const Vec3 corner = g.world(Vec3(0.0, 0.0, static_cast<double>(one.k)));
    groups.add_item(tag::plane_position)
        .set_decimals(tag::image_position, {corner.x(), corner.y(), corner.z()});
    groups.add_item(tag::segment_identification)
        .set_u16(tag::segment_number_reference, {static_cast<std::uint16_t>(one.segment + 1)});
    d.add_item(tag::per_frame_groups) = std::move(groups);
  }
}

/// Frames of single bits follow each other without a gap, the first pixel in the lowest bit (PS3.5 8.1.1).
std::string packed_bits(const imaging::MaskVolume& volume, const std::vector<SegmentFrame>& frames,
                        const InSegment& in, const core::TaskContext& task) {
  const auto plane = static_cast<std::size_t>(volume.geometry.size[0] * volume.geometry.size[1]);
  std::string bits((frames.size() * plane + 7) / 8, '\0');
  std::size_t bit = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    task.throw_if_cancelled();
    const std::uint8_t* voxels = volume.voxels.data() + static_cast<std::size_t>(frames[f].k) * plane;
    const std::array<bool, 256>& wanted = in[frames[f].segment];
    for (std::size_t i = 0; i < plane; ++i, ++bit)
      if (wanted[voxels[i]]) bits[bit / 8] = static_cast<char>(bits[bit / 8] | 1 << (bit % 8));
    task.set_progress(static_cast<double>(f + 1) / static_cast<double>(frames.size()));
  }
  return bits;
}

std::string occupancies(const imaging::MaskVolume& volume, const std::vector<SegmentFrame>& frames) {
  const auto plane = static_cast<std::size_t>(volume.geometry.size[0] * volume.geometry.size[1]);
  std::string bytes;
  bytes.reserve(frames.size() * plane + 1);
  for (const SegmentFrame& one : frames)
    bytes.append(
        reinterpret_cast<const char*>(volume.voxels.data()) + static_cast<std::size_t>(one.k) * plane, plane);
  return bytes;
}

bool overlapping(const InSegment& in) {
  for (std::size_t value = 1; value < 256; ++value)
    if (std::count_if(in.begin(), in.end(), [&](const auto& one) { return one[value]; }) > 1) return true;
  return false;
}

void add_pixel_format(DicomDataset& d, const imaging::Geometry& g, std::size_t frames, bool fractional) {
  const std::uint16_t bits = fractional ? 8 : 1;
  d.set_u16(0x00280002, {1});
  d.set_text(0x00280004, "CS", "MONOCHROME2");
  d.set_text(tag::number_of_frames, "IS", std::to_string(frames));
  d.set_u16(tag::rows, {static_cast<std::uint16_t>(g.size[1])});
  d.set_u16(tag::columns, {static_cast<std::uint16_t>(g.size[0])});
  d.set_u16(tag::bits_allocated, {bits});
  d.set_u16(0x00280101, {bits});
  d.set_u16(0x00280102, {static_cast<std::uint16_t>(bits - 1)});
  d.set_u16(0x00280103, {0});
  d.set_text(0x00282110, "CS", "00");  // never compressed with loss
}

}  // namespace

DicomDataset segmentation(const SourceSeries& source, const imaging::MaskVolume& volume,
                          const std::vector<Segment>& segments, const SegmentationOptions& options,
                          const core::TaskContext& task) {
  require_grid(volume, segments, options);
  const imaging::Geometry& g = volume.geometry;
  const InSegment in = in_segments(segments, options.fractional);
  const std::vector<SegmentFrame> frames = frames_of(volume, in);
  if (frames.empty()) throw InvalidInput("DICOM segmentation: no segment has a voxel");
  DicomDataset d =
      object_head(source, segmentation_storage, "SEG",
                  options.fractional ? "fractional segmentation" : "segmentation", options.object);
  d.set_text(0x00080008, "CS", "DERIVED\\PRIMARY");
  add_referenced_series(source, d);
  d.set_text(tag::frame_of_reference, "UI", source.frame_of_reference);
  d.set_text(0x00201040, "LO", "");
  add_dimensions(d);
  add_pixel_format(d, g, frames.size(), options.fractional);
  d.set_text(0x00620001, "CS", options.fractional ? "FRACTIONAL" : "BINARY");
  if (options.fractional) {
    d.set_u16(0x0062000E, {options.most});
    d.set_text(0x00620010, "CS", "OCCUPANCY");
  }
  d.set_text(0x00620013, "CS", overlapping(in) ? "YES" : "NO");
  d.set_text(0x00700080, "CS", options.label);
  set_own_text(d, d, 0x00700081, "LO", options.description);
  set_own_text(d, d, 0x00700084, "PN", options.object.creator);
  add_segments(d, segments, options);
  add_shared(d, g);
  add_frames(d, source, g, frames);
  d.set_bytes(tag::pixel_data, "OB",
              options.fractional ? occupancies(volume, frames) : packed_bits(volume, frames, in, task));
  seal(d);
  return d;
}

}  // namespace ostia::dicom
