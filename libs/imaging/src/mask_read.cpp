// Masks, labels and probabilities.

#include "image_voxels.h"

#include <cmath>
#include <limits>

namespace ostia::imaging {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_mask_values = 16;
constexpr std::size_t most_label_values = 128;  // an 8-bit picture has more
constexpr double rounding = 1e-5;               // of a value, by a slope in single precision

bool is_whole(double value) {
  return std::abs(value - std::round(value)) <= std::min(0.01, rounding * std::max(1.0, std::abs(value)));
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

/// Whether values are those of looks_like_probabilities, as far as they were seen.
class Probabilities {
 public:
  bool see(double value) {
    if (!(value >= -rounding && value <= 1.0 + rounding)) return possible_ = false;
    ++count_;
    low_ += value < 0.05;
    high_ = high_ || value > 0.5;
    between_ = between_ || !is_whole(value);
    return true;
  }
  bool are() const { return possible_ && high_ && between_ && 2 * low_ > count_; }

 private:
  bool possible_ = true, high_ = false, between_ = false;
  std::size_t count_ = 0, low_ = 0;
};

bool are_probabilities(const ImageSource& source) {
  Probabilities seen;
  visit_voxels(source, core::no_task(), [&](std::size_t, const auto* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      if (!seen.see(static_cast<double>(values[i]) * source.slope + source.intercept)) return false;
    return true;
  });
  return seen.are();
}

void note_probabilities(Prepared& p) {
  p.header.warnings.push_back("its values are probabilities: a voxel of 0.5 or more is taken as the mask's");
}

/// 0 and one other value, which is smaller than 1/2.
bool is_faint_mask(const ImageSource& source) {
  FewValues seen(2);
  bool few = true;
  visit_voxels(source, core::no_task(), [&](std::size_t, const auto* values, std::size_t count) {
    return few = seen.see(values, count);
  });
  if (!few || seen.values().size() != 2) return false;
  const auto value = [&](std::size_t i) { return seen.values()[i] * source.slope + source.intercept; };
  const double low = std::min(value(0), value(1)), high = std::max(value(0), value(1));
  return low == 0.0 && high < 0.5;
}

/// The labels above 0 of a file that has some above 255, rising; that of each new value, 0 first.
std::vector<std::int64_t> labels_to_renumber(const ImageSource& source) {
  FewValues seen(most_label_values);
  bool few = true;
  visit_voxels(source, core::no_task(), [&](std::size_t, const auto* values, std::size_t count) {
    return few = seen.see(values, count);
  });
  std::vector<std::int64_t> labels{0};
  for (const double stored : seen.values()) {
    const double value = stored * source.slope + source.intercept;
    few = few && is_whole(value) && value >= 0.0 && value < 9e15;
    if (few && value >= 0.5) labels.push_back(std::llround(value));
  }
  if (!few)
    refuse(source.header_path, "voxels",
           "values above 255 that are no labels (whole numbers, at most " +
               std::to_string(most_label_values) + " different ones): an image, not a mask");
  std::sort(labels.begin(), labels.end());
  return labels;
}

/// Labels above 255 counted up.
LoadedImage<std::uint8_t> read_renumbered(Prepared&& p, const core::TaskContext& task) {
  p.header.file_labels = labels_to_renumber(p.source);
  const std::vector<std::int64_t>& labels = p.header.file_labels;
  std::vector<std::uint8_t> voxels = room_for<std::uint8_t>(p.source);
  const double slope = p.source.slope, intercept = p.source.intercept;
  note_surplus(p, visit_voxels(p.source, task.sub(0.0, 0.9),
                               [&](std::size_t first, const auto* values, std::size_t count) {
                                 for (std::size_t i = 0; i < count; ++i) {
                                   const double value = static_cast<double>(values[i]) * slope + intercept;
                                   const auto at = std::ranges::lower_bound(
                                       labels, value < 0.5 ? 0 : std::llround(value));
                                   voxels[first + i] = static_cast<std::uint8_t>(at - labels.begin());
                                 }
                                 return true;
                               }));
  p.header.warnings.push_back("labels up to " + std::to_string(labels.back()) + ": its " +
                              std::to_string(labels.size() - 1) + " labels are counted up from 1 within");
  return placed(std::move(p), std::move(voxels), Interpolation::nearest, Beyond::outside_value,
                std::uint8_t{0}, task.sub(0.9, 1.0));
}

}  // namespace

LoadedImage<std::uint8_t> read_mask(const fs::path& path, const core::TaskContext& task) {
  Prepared p = prepare(path);
  std::vector<std::uint8_t> voxels = room_for<std::uint8_t>(p.source);
  FewValues seen;
  const double slope = p.source.slope, intercept = p.source.intercept;
  const bool probabilities = are_probabilities(p.source);
  if (probabilities) note_probabilities(p);
  note_surplus(
      p, visit_voxels(
             p.source, task.sub(0.0, 0.9), [&](std::size_t first, const auto* values, std::size_t count) {
               if (probabilities) {
                 for (std::size_t i = 0; i < count; ++i)
                   voxels[first + i] = static_cast<double>(values[i]) * slope + intercept >= 0.5 ? 1 : 0;
                 return true;
               }
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
  bool large = false, any = false;
  Probabilities chances;
  const auto read = [&](std::size_t first, const auto* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double value = static_cast<double>(values[i]) * slope + intercept;
      if (value != value)
        refuse(p.source.header_path, "voxels", "voxel " + std::to_string(first + i) + " is no number");
      if (!(value < 255.5)) {
        large = true;
        return false;
      }
      chances.see(value);
      any = any || value >= 0.5;
      voxels[first + i] = value < 0.5 ? 0 : static_cast<std::uint8_t>(std::lround(value));
    }
    return true;
  };
  const bool surplus = visit_voxels(p.source, task.sub(0.0, 0.9), read);
  if (large) return read_renumbered(std::move(p), task);
  if (!any && is_faint_mask(p.source)) return read_mask(path, task);
  note_surplus(p, surplus);
  if (chances.are()) note_probabilities(p);
  return placed(std::move(p), std::move(voxels), Interpolation::nearest, Beyond::outside_value,
                std::uint8_t{0}, task.sub(0.9, 1.0));
}

bool looks_like_mask(const fs::path& path) {
  const ImageSource source = prepare(path).source;
  FewValues seen;
  bool few = true;
  visit_voxels(source, core::no_task(), [&](std::size_t, const auto* values, std::size_t count) {
    return few = seen.see(values, count);
  });
  if (!few) return false;
  bool zero = false, whole = true;
  for (const double stored : seen.values()) {
    const double value = stored * source.slope + source.intercept;
    whole = whole && is_whole(value);
    zero = zero || value == 0.0;
  }
  return zero && (whole || seen.values().size() == 2);
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
    return is_whole(value) && value >= 0.0 && value <= 255.0 + rounding;
  };
  return few && std::all_of(seen.values().begin(), seen.values().end(), label);
}

bool looks_like_probabilities(const fs::path& path) {
  return are_probabilities(prepare(path).source);
}

}  // namespace ostia::imaging
