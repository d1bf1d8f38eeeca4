#include "image_voxels.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstring>
#include <limits>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

/// Stored values to HU as int16.
struct ToHounsfield {
  double slope, intercept;
  std::size_t clamped = 0, undefined = 0;

  template <class Stored>
  void operator()(const Stored* from, std::int16_t* to, std::size_t count) {
    if constexpr (std::is_same_v<Stored, std::int16_t>) {
      if (slope == 1.0 && intercept == 0.0) {
        std::memcpy(to, from, count * sizeof(Stored));
        return;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      double value = static_cast<double>(from[i]) * slope + intercept;
      if (value != value) {
        ++undefined;
        value = -1024.0;
      } else if (value < -32768.49 || value > 32767.49) {
        ++clamped;
        value = value < 0.0 ? -32768.0 : 32767.0;
      }
      to[i] = static_cast<std::int16_t>(value < 0.0 ? value - 0.5 : value + 0.5);
    }
  }
};

/// Air lies at -1000 HU and tissues spread over hundreds of values; labels and 8-bit pictures do neither.
void note_lack_of_hounsfield(Prepared& p, const std::vector<std::int16_t>& voxels) {
  constexpr std::size_t most_values = 256, fewest_voxels = 4096;
  if (voxels.size() < fewest_voxels) return;
  std::bitset<std::numeric_limits<std::int16_t>::max() + 1> seen;
  std::size_t different = 0;
  for (const std::int16_t value : voxels) {
    if (value < 0) return;
    if (seen.test(static_cast<std::size_t>(value))) continue;
    seen.set(static_cast<std::size_t>(value));
    if (++different > most_values) return;
  }
  p.header.warnings.push_back("only " + std::to_string(different) +
                              " different values, none below 0: a label map or an 8-bit picture, not a CT in "
                              "Hounsfield units (a mask of any values is taken as one with --mask)");
}

}  // namespace

Prepared prepare(const fs::path& path) {
  Prepared p;
  p.source = read_source(path);
  p.placement = place(p.source.size, p.source.step, p.source.origin,
                      p.source.header_path.string() + ": " + p.source.axes_field);
  p.header.format = p.source.format;
  p.header.geometry = p.placement.geometry;
  p.header.pixel_type = p.source.pixel_type;
  p.header.slope = p.source.slope;
  p.header.intercept = p.source.intercept;
  p.header.warnings = p.source.warnings;
  p.header.warnings.insert(p.header.warnings.end(), p.placement.warnings.begin(), p.placement.warnings.end());
  return p;
}

void note_surplus(Prepared& p, bool surplus) {
  if (surplus)
    p.header.warnings.push_back(
        "the file holds more data than the header announces; the rest was not read (if the picture looks "
        "shifted, the header lacks an offset)");
}

ImageHeader read_image_header(const fs::path& path) {
  return prepare(path).header;
}

LoadedImage<std::int16_t> read_image(const fs::path& path, const core::TaskContext& task) {
  Prepared p = prepare(path);
  std::vector<std::int16_t> voxels = room_for<std::int16_t>(p.source);
  ToHounsfield convert{p.source.slope, p.source.intercept};
  note_surplus(p, visit_voxels(p.source, task.sub(0.0, 0.9),
                               [&](std::size_t first, const auto* values, std::size_t count) {
                                 convert(values, voxels.data() + first, count);
                                 return true;
                               }));
  if (convert.clamped > 0)
    p.header.warnings.push_back(std::to_string(convert.clamped) +
                                " voxels beyond -32768..32767 HU were clamped");
  if (convert.undefined > 0)
    p.header.warnings.push_back(std::to_string(convert.undefined) +
                                " voxels that are not numbers were set to -1024 HU");
  note_lack_of_hounsfield(p, voxels);
  const std::int16_t lowest =
      p.placement.sheared ? *std::min_element(voxels.begin(), voxels.end()) : std::int16_t{0};
  return placed(std::move(p), std::move(voxels), Interpolation::trilinear, Beyond::outside_value, lowest,
                task.sub(0.9, 1.0));
}

LoadedImage<float> read_float_image(const fs::path& path, const core::TaskContext& task) {
  Prepared p = prepare(path);
  std::vector<float> voxels = room_for<float>(p.source);
  const double slope = p.source.slope, intercept = p.source.intercept;
  note_surplus(p, visit_voxels(p.source, task.sub(0.0, 0.9),
                               [&](std::size_t first, const auto* values, std::size_t count) {
                                 for (std::size_t i = 0; i < count; ++i) {
                                   const float value =
                                       static_cast<float>(static_cast<double>(values[i]) * slope + intercept);
                                   if (!std::isfinite(value))
                                     refuse(p.source.header_path, "voxels",
                                            "voxel " + std::to_string(first + i) + " is not a finite number");
                                   voxels[first + i] = value;
                                 }
                                 return true;
                               }));
  return placed(std::move(p), std::move(voxels), Interpolation::trilinear, Beyond::border_value, 0.0F,
                task.sub(0.9, 1.0));
}

}  // namespace ostia::imaging
