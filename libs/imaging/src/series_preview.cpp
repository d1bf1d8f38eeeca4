#include "ostia/imaging/series_preview.h"

#include "dicom_pixels.h"
#include "dicom_shown.h"
#include "dicom_syntax.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"

#include <algorithm>
#include <cmath>

namespace ostia::imaging {
namespace {

constexpr int kSmallest = 16, kLargest = 2048;
constexpr GreyWindow kAngiography{250.0, 900.0, false};  // contrast-filled lumen light grey, calcium white

void check_size(int size_px) {
  if (size_px >= kSmallest && size_px <= kLargest) return;
  throw InvalidInput("preview: size_px is " + std::to_string(size_px) + "; it must be in [" +
                     std::to_string(kSmallest) + ", " + std::to_string(kLargest) + "]");
}

/// The 1st and the 99th percentile.
GreyWindow percentile_window(const std::vector<std::int16_t>& values) {
  std::vector<std::int16_t> sorted = values;
  const auto at = [&](double part) {
    const auto n =
        sorted.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), n, sorted.end());
    return static_cast<double>(*n);
  };
  const double low = at(0.01), high = at(0.99);
  return {0.5 * (low + high), std::max(1.0, high - low), false};
}

GreyWindow window_of(const DicomFrame& frame, const DicomSeries& series, const ImageVolume& slice) {
  if (frame.window_centre && frame.window_width && *frame.window_width >= 1.0)
    return {*frame.window_centre, *frame.window_width, true};
  return series.modality == "CT" ? kAngiography : percentile_window(slice.voxels);
}

std::uint8_t grey(double hu, const GreyWindow& window) {
  const double part = (hu - window.centre_hu) / window.width_hu + 0.5;
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
}

/// Which voxel axis runs across the picture, and whether each is turned round.
struct View {
  bool across_reversed = false, down_reversed = false;
};

/// Across: towards the patient's left; down: towards the back, or the feet where the slice stands upright.
View view_of(const Geometry& geometry) {
  const Vec3 i = geometry.direction.col(0), j = geometry.direction.col(1);
  int main_i = 0, main_j = 0;
  i.cwiseAbs().maxCoeff(&main_i);
  j.cwiseAbs().maxCoeff(&main_j);
  // LPS: x grows to the left and y to the back, as the picture wants them; z grows to the head.
  const auto reversed = [](double component, int axis) {
    return axis == 2 ? component > 0.0 : component < 0.0;
  };
  return {reversed(i[main_i], main_i), reversed(j[main_j], main_j)};
}

/// Means over the parts of voxels that each pixel covers.
SeriesPreview drawn(const Geometry& geometry, const std::int16_t* slice, const GreyWindow& window,
                    int size_px) {
  const auto columns = static_cast<int>(geometry.size[0]), rows = static_cast<int>(geometry.size[1]);
  const double wide = geometry.spacing[0] * columns, high = geometry.spacing[1] * rows;
  const double pixel = std::max(wide, high) / size_px;
  SeriesPreview result;
  result.window = window;
  result.width = std::clamp(static_cast<int>(std::lround(wide / pixel)), 1, size_px);
  result.height = std::clamp(static_cast<int>(std::lround(high / pixel)), 1, size_px);
  result.pixels.resize(static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height));
  const View view = view_of(geometry);
  // From one end of the pixel to the other in voxels; the ends count with the part that is covered.
  struct Span {
    int first, last;
    double first_part, last_part;
  };
  const auto span = [](int pixels, int voxels, int at, bool reversed) {
    if (reversed) at = pixels - 1 - at;
    const double from = static_cast<double>(at) * voxels / pixels,
                 to = static_cast<double>(at + 1) * voxels / pixels;
    Span s{static_cast<int>(from), std::min(voxels - 1, static_cast<int>(std::ceil(to)) - 1), 1.0, 1.0};
    s.last = std::max(s.first, s.last);
    s.first_part = std::min(to, s.first + 1.0) - from;
    s.last_part = to - s.last;
    return s;
  };
  for (int y = 0; y < result.height; ++y) {
    const Span down = span(result.height, rows, y, view.down_reversed);
    for (int x = 0; x < result.width; ++x) {
      const Span across = span(result.width, columns, x, view.across_reversed);
      double sum = 0.0, weights = 0.0;
      for (int j = down.first; j <= down.last; ++j) {
        const double wj = j == down.first ? down.first_part : j == down.last ? down.last_part : 1.0;
        for (int i = across.first; i <= across.last; ++i) {
          const double wi = i == across.first ? across.first_part : i == across.last ? across.last_part : 1.0;
          const std::int16_t hu = slice[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                                        static_cast<std::size_t>(i)];
          sum += wi * wj * hu;
          weights += wi * wj;
        }
      }
      result.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(result.width) +
                    static_cast<std::size_t>(x)] = grey(sum / weights, window);
    }
  }
  return result;
}

/// The header of one file of the series, fit to be decoded.
std::shared_ptr<const DicomHeader> readable_header(const std::filesystem::path& path, std::int64_t frame) {
  auto file = parse_dicom(path);
  const auto refuse = [&](const std::string& why) {
    return InvalidInput("slice '" + path.filename().string() + "' cannot be shown: " + why);
  };
  if (!file) throw refuse("it is no DICOM file any more");
  if (!file->header.damage.empty()) throw refuse(file->header.damage);
  if (const std::string fault = pixel_fault(file->header); !fault.empty()) throw refuse(fault);
  if (frame < 0 || frame >= file->header.frame_count) throw refuse("it has no such frame");
  return std::make_shared<const DicomHeader>(std::move(file->header));
}

}  // namespace

SeriesSlice first_slice(const DicomSeries& series, std::int64_t index, const core::TaskContext& task) {
  const auto count = static_cast<std::int64_t>(std::min(series.files.size(), series.frames.size()));
  if (count == 0) throw InvalidInput("the series has no slice to show");
  SeriesSlice result;
  result.index = index < 0 ? count / 2 : index;
  if (result.index >= count) {
    throw InvalidInput("slice " + std::to_string(index) + " was asked for; the series has " +
                       std::to_string(count));
  }
  const auto n = static_cast<std::size_t>(result.index);
  DicomSlice slice;
  slice.header = readable_header(series.files[n], series.frames[n]);
  slice.frame = series.frames[n];
  Geometry geometry = series.geometry;
  geometry.size = {slice.header->columns, slice.header->rows, 1};
  const std::optional<Vec3>& position = slice.info().position;
  if (position && position->allFinite()) {
    geometry.origin = *position;
  } else {
    geometry.origin = series.geometry.world(Vec3(0.0, 0.0, static_cast<double>(result.index)));
  }
  Rescaled count_of;
  result.image = decode_slices({slice}, geometry, count_of, task);
  result.window = window_of(slice.info(), series, result.image);
  return result;
}

SeriesPreview preview(const DicomSeries& series, int size_px, const core::TaskContext& task) {
  check_size(size_px);
  const SeriesSlice slice = first_slice(series, -1, task);
  SeriesPreview result = drawn(slice.image.geometry, slice.image.voxels.data(), slice.window, size_px);
  result.shown = shown_identity(series);
  return result;
}

SeriesPreview preview(const std::filesystem::path& image_file, int size_px, const core::TaskContext& task) {
  check_size(size_px);
  const ImageVolume image = read_image(image_file, task).volume;
  const Geometry& g = image.geometry;
  const auto first = image.voxels.begin() + static_cast<std::ptrdiff_t>(g.offset(0, 0, g.size[2] / 2));
  const std::vector<std::int16_t> slice(first, first + static_cast<std::ptrdiff_t>(g.size[0] * g.size[1]));
  SeriesPreview result = drawn(g, slice.data(), percentile_window(slice), size_px);
  result.shown.slices = g.size[2];
  return result;
}

}  // namespace ostia::imaging
