#include "affine_resample.h"
#include "image_data.h"
#include "image_source.h"
#include "pixel_types.h"
#include "placement.h"

#include "ostia/core/error.h"
#include "ostia/imaging/image_file.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t block_voxels = std::size_t{1} << 16;
constexpr std::size_t most_mask_values = 16;
constexpr std::size_t most_label_values = 128;  // an 8-bit picture has more

/// Calls visit(first voxel, pointer to values of the stored type, count) block by block; returns whether
/// there is more data than needed. `visit` returns false to stop early.
template <class Visit>
bool visit_voxels(const ImageSource& source, const core::TaskContext& task, const Visit& visit) {
  VoxelStream stream(source);
  std::vector<std::uint64_t> buffer(block_voxels);  // room for the widest type, aligned for all
  const std::size_t voxels = static_cast<std::size_t>(source.voxels());
  bool on = true;
  for (std::size_t first = 0; first < voxels && on; first += block_voxels) {
    task.throw_if_cancelled();
    const std::size_t count = std::min(block_voxels, voxels - first);
    stream.read(buffer.data(), count);
    with_pixel_type(source.pixel_type, [&](auto zero) {
      on = visit(first, reinterpret_cast<const decltype(zero)*>(buffer.data()), count);
    });
    task.set_progress(static_cast<double>(first + count) / static_cast<double>(voxels));
  }
  return on && stream.more_than_needed();
}

/// The different values among those seen, as long as there are few.
class FewValues {
 public:
  explicit FewValues(std::size_t most = most_mask_values) : most_(most) {}
  /// False once there are more than that, or one that is not finite.
  template <class Stored>
  bool see(const Stored* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double value = static_cast<double>(values[i]);
      if (value == last_) continue;
      if (!std::isfinite(value)) return false;
      last_ = value;
      if (std::find(values_.begin(), values_.end(), value) != values_.end()) continue;
      if (values_.size() == most_) return false;
      values_.push_back(value);
    }
    return true;
  }
  const std::vector<double>& values() const { return values_; }

 private:
  std::size_t most_;
  std::vector<double> values_;
  double last_ = std::numeric_limits<double>::quiet_NaN();
};

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

struct Prepared {
  ImageSource source;
  Placement placement;
  ImageHeader header;
};

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

template <class T>
std::vector<T> room_for(const ImageSource& source) {
  try {
    return std::vector<T>(static_cast<std::size_t>(source.voxels()));
  } catch (const std::bad_alloc&) {
    throw ResourceError(source.header_path.string() + ": not enough memory for " +
                        std::to_string(source.voxels()) + " voxels");
  }
}

/// Puts the stored voxels in the order, and on the grid, of the placement.
template <class T>
LoadedImage<T> placed(Prepared&& p, std::vector<T>&& stored, Interpolation how, Beyond beyond, T outside,
                      const core::TaskContext& task) {
  if (p.placement.slices_reversed) {
    const std::int64_t slice = p.source.size[0] * p.source.size[1], slices = p.source.size[2];
    for (std::int64_t k = 0; k < slices / 2; ++k)
      std::swap_ranges(stored.begin() + k * slice, stored.begin() + (k + 1) * slice,
                       stored.begin() + (slices - 1 - k) * slice);
  }
  LoadedImage<T> result;
  result.header = std::move(p.header);
  result.volume.geometry = p.placement.geometry;
  if (p.placement.sheared) {
    affine_resample(stored.data(), p.source.size, p.placement.linear, p.placement.offset, how, beyond,
                    outside, result.volume, task);
  } else {
    result.volume.voxels = std::move(stored);
  }
  return result;
}

void note_surplus(Prepared& p, bool surplus) {
  if (surplus)
    p.header.warnings.push_back(
        "the file holds more data than the header announces; the rest was not read (if the picture looks "
        "shifted, the header lacks an offset)");
}

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
                              "Hounsfield units");
}

}  // namespace

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

LoadedImage<std::uint8_t> read_mask(const fs::path& path, const core::TaskContext& task) {
  Prepared p = prepare(path);
  std::vector<std::uint8_t> voxels = room_for<std::uint8_t>(p.source);
  FewValues seen;
  const double slope = p.source.slope, intercept = p.source.intercept;
  note_surplus(
      p, visit_voxels(
             p.source, task.sub(0.0, 0.9), [&](std::size_t first, const auto* values, std::size_t count) {
               if (!seen.see(values, count))
                 refuse(p.source.header_path, "voxels",
                        "more than " + std::to_string(most_mask_values) +
                            " different values, or one that is not finite: an image, not a mask");
               for (std::size_t i = 0; i < count; ++i)
                 voxels[first + i] = static_cast<double>(values[i]) * slope + intercept != 0.0 ? 1 : 0;
               return true;
             }));
  return placed(std::move(p), std::move(voxels), Interpolation::nearest, Beyond::outside_value,
                std::uint8_t{0}, task.sub(0.9, 1.0));
}

LoadedImage<std::uint8_t> read_labels(const fs::path& path, const core::TaskContext& task) {
  Prepared p = prepare(path);
  std::vector<std::uint8_t> voxels = room_for<std::uint8_t>(p.source);
  const double slope = p.source.slope, intercept = p.source.intercept;
  const auto read = [&](std::size_t first, const auto* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double value = static_cast<double>(values[i]) * slope + intercept;
      if (!(value < 255.5))
        refuse(p.source.header_path, "voxels",
               "voxel " + std::to_string(first + i) + " is " + std::to_string(value) +
                   "; labels are whole numbers up to 255: an image, not a mask");
      voxels[first + i] = value < 0.5 ? 0 : static_cast<std::uint8_t>(std::lround(value));
    }
    return true;
  };
  note_surplus(p, visit_voxels(p.source, task.sub(0.0, 0.9), read));
  return placed(std::move(p), std::move(voxels), Interpolation::nearest, Beyond::outside_value,
                std::uint8_t{0}, task.sub(0.9, 1.0));
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

bool looks_like_mask(const fs::path& path) {
  const ImageSource source = prepare(path).source;
  FewValues seen;
  bool few = true;
  visit_voxels(source, core::no_task(), [&](std::size_t, const auto* values, std::size_t count) {
    return few = seen.see(values, count);
  });
  if (!few) return false;
  bool zero = false;
  for (const double stored : seen.values()) {
    const double value = stored * source.slope + source.intercept;
    if (value != std::round(value)) return false;
    zero = zero || value == 0.0;
  }
  return zero;
}

bool looks_like_labels(const fs::path& path) {
  const ImageSource source = prepare(path).source;
  FewValues seen(most_label_values);
  bool few = true;
  visit_voxels(source, core::no_task(), [&](std::size_t, const auto* values, std::size_t count) {
    return few = seen.see(values, count);
  });
  const auto label = [&](double stored) {
    const double value = stored * source.slope + source.intercept;
    return value == std::round(value) && value >= 0.0 && value <= 255.0;
  };
  return few && std::all_of(seen.values().begin(), seen.values().end(), label);
}

}  // namespace ostia::imaging
