#include "ostia/segmentation/tissue_removal.h"

#include "range_about_seeds.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/morphology.h"
#include "ostia/imaging/reduced_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace ostia::segmentation {
namespace {

using imaging::ImageVolume;
using imaging::MaskVolume;

constexpr double kCoarse = 1.0;             // mm, of the voxels on which bones are told from vessels
constexpr double kRim = 2.4;                // mm: where a bone has its shell
constexpr double kBeside = 1.5;             // mm about a coarse part in which its surface lies
constexpr double kShellOverMiddle = 1.2;    // a bone's rim is brighter than its middle by this
constexpr double kShellPart = 0.75;         // the percentile of the rim that is its shell
constexpr std::size_t kMiddleVoxels = 20;   // fewer have no middle to speak of
constexpr double kLeastBone = 100.0;        // mm^3
constexpr double kAirAboutBodyHu = -940.0;  // air about the body; lungs are brighter
constexpr double kMarrowHu = 100.0;         // a hole in a bone that is darker is none of it

template <class Test>
MaskVolume where(const ImageVolume& image, const Test& test) {
  MaskVolume mask{image.geometry, {}};
  mask.voxels.resize(image.voxels.size());
  core::parallel_for(mask.voxels.size(), 262144, [&](std::size_t n) { mask.voxels[n] = test(n) ? 1 : 0; });
  return mask;
}

ImageVolume coarse_of(const ImageVolume& image, const core::TaskContext& task) {
  imaging::ReducedVolumeOptions options;
  const double volume = image.geometry.spacing.prod() * static_cast<double>(image.geometry.voxels());
  options.most_voxels = std::clamp<std::int64_t>(
      static_cast<std::int64_t>(volume / (kCoarse * kCoarse * kCoarse)), 8, 1'000'000'000);
  return imaging::reduced_volume(image, options, task);
}

std::int16_t percentile(std::vector<std::int16_t>& values, double part) {
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The parts of a mask when necks are cut: those of the eroded mask, each grown back within the mask as far
/// as it was eroded. Label 0 outside.
imaging::Components parts_of(const MaskVolume& mask, double contact_mm) {
  imaging::Components parts = imaging::components(imaging::eroded(mask, contact_mm));
  const auto& size = mask.geometry.size;
  const std::array<std::int64_t, 3> stride{1, size[0], size[0] * size[1]};
  const int steps = 1 + static_cast<int>(std::ceil(1.8 * contact_mm / mask.geometry.spacing.minCoeff()));
  std::vector<std::size_t> front, next;
  for (std::size_t n = 0; n < parts.label.size(); ++n)
    if (parts.label[n] != 0) front.push_back(n);
  for (int step = 0; step < steps; ++step, front.swap(next)) {
    next.clear();
    for (const std::size_t n : front) {
      const auto at = static_cast<std::int64_t>(n);
      const std::array<std::int64_t, 3> index{at % size[0], at / size[0] % size[1], at / stride[2]};
      for (std::size_t d = 0; d < 3; ++d)
        for (const std::int64_t sign : {-1, 1}) {
          if (index[d] + sign < 0 || index[d] + sign >= size[d]) continue;
          const auto m = static_cast<std::size_t>(at + sign * stride[d]);
          if (mask.voxels[m] == 0 || parts.label[m] != 0) continue;
          parts.label[m] = parts.label[n];
          next.push_back(m);
        }
    }
  }
  return parts;
}

enum class Part : std::uint8_t { small, bone, vessel };

/// Bones have a shell brighter than what is in them, and no point of the lumen. What has no middle to speak
/// of is small: a thin vessel, or a splinter of a bone.
std::vector<Part> kinds_of(const imaging::Components& parts, const ImageVolume& coarse,
                           const std::vector<Vec3>& lumen, const TissueOptions& options) {
  const MaskVolume bright = where(coarse, [&](std::size_t n) { return parts.label[n] != 0; });
  const MaskVolume middle = imaging::eroded(bright, kRim);
  std::vector<std::vector<std::int16_t>> rim_hu(parts.voxels.size()), middle_hu(parts.voxels.size());
  for (std::size_t n = 0; n < parts.label.size(); ++n) {
    if (parts.label[n] == 0) continue;
    (middle.voxels[n] != 0 ? middle_hu : rim_hu)[parts.label[n]].push_back(coarse.voxels[n]);
  }
  const double voxel = coarse.geometry.spacing.prod();
  std::vector<Part> kind(parts.voxels.size(), Part::small);
  for (std::size_t p = 1; p < kind.size(); ++p) {
    if (rim_hu[p].empty() || middle_hu[p].size() < kMiddleVoxels) continue;
    if (static_cast<double>(rim_hu[p].size() + middle_hu[p].size()) * voxel < kLeastBone) continue;
    const double shell = percentile(rim_hu[p], kShellPart), inside = percentile(middle_hu[p], 0.5);
    kind[p] = shell >= options.shell_hu && shell >= kShellOverMiddle * inside ? Part::bone : Part::vessel;
  }
  for (const Vec3& point : lumen) {
    const Vec3 index = coarse.geometry.index(point);
    std::array<std::int64_t, 3> at{};
    for (int d = 0; d < 3; ++d)
      at[static_cast<std::size_t>(d)] = std::clamp<std::int64_t>(
          std::llround(index[d]), 0, coarse.geometry.size[static_cast<std::size_t>(d)] - 1);
    kind[parts.label[static_cast<std::size_t>(coarse.geometry.offset(at[0], at[1], at[2]))]] = Part::vessel;
  }
  kind[0] = Part::small;
  return kind;
}

/// For each voxel along an axis of the image the voxel of the coarse one that holds it; grids are parallel.
std::array<std::vector<std::int64_t>, 3> coarse_places(const imaging::Geometry& fine,
                                                       const imaging::Geometry& coarse) {
  std::array<std::vector<std::int64_t>, 3> places;
  for (int d = 0; d < 3; ++d)
    for (std::int64_t n = 0; n < fine.size[static_cast<std::size_t>(d)]; ++n) {
      const Vec3 index = coarse.index(fine.world(static_cast<double>(n) * Vec3::Unit(d)));
      places[static_cast<std::size_t>(d)].push_back(
          std::clamp<std::int64_t>(std::llround(index[d]), 0, coarse.size[static_cast<std::size_t>(d)] - 1));
    }
  return places;
}

/// Where a bone may be: 0 nowhere, 1 its surface, 2 its middle.
MaskVolume bone_zones(const ImageVolume& coarse, const std::vector<Vec3>& lumen,
                      const TissueOptions& options) {
  MaskVolume bright = where(coarse, [&](std::size_t n) { return coarse.voxels[n] >= options.candidate_hu; });
  imaging::Components parts = parts_of(bright, options.contact_mm);
  std::vector<Part> kind = kinds_of(parts, coarse, lumen, options);
  MaskVolume others = where(coarse, [&](std::size_t n) { return kind[parts.label[n]] == Part::vessel; });
  // What is left, its shells filled: faint marrow, as the breastbone's, is not as bright as a candidate, and
  // splinters of a shell show no middle.
  for (std::size_t n = 0; n < bright.voxels.size(); ++n)
    if (others.voxels[n] != 0) bright.voxels[n] = 0;
  imaging::fill_bright_holes(bright, coarse, kMarrowHu);
  parts = parts_of(bright, options.contact_mm);
  kind = kinds_of(parts, coarse, lumen, options);
  MaskVolume whole = where(coarse, [&](std::size_t n) { return kind[parts.label[n]] == Part::bone; });
  // With the shells filled what is small is no splinter any more but a thin vessel.
  for (std::size_t n = 0; n < others.voxels.size(); ++n)
    if (parts.label[n] != 0 && kind[parts.label[n]] != Part::bone) others.voxels[n] = 1;
  imaging::fill_bright_holes(whole, coarse, kMarrowHu);
  MaskVolume zones = imaging::dilated(whole, kBeside);
  const MaskVolume middle = imaging::eroded(whole, kBeside);
  const MaskVolume beside = imaging::dilated(others, 1.01 * coarse.geometry.spacing.maxCoeff());
  for (std::size_t n = 0; n < zones.voxels.size(); ++n) {
    if (middle.voxels[n] != 0) zones.voxels[n] = 2;
    // The edge of a vessel that lies beside a bone is the vessel's.
    if (others.voxels[n] != 0 || (beside.voxels[n] != 0 && whole.voxels[n] == 0)) zones.voxels[n] = 0;
  }
  return zones;
}

MaskVolume bone_mask(const ImageVolume& image, const std::vector<Vec3>& lumen, const TissueOptions& options,
                     const core::TaskContext& task) {
  const ImageVolume coarse = coarse_of(image, task.sub(0.0, 0.2));
  const MaskVolume zones = bone_zones(coarse, lumen, options);
  task.throw_if_cancelled();
  const auto places = coarse_places(image.geometry, coarse.geometry);
  const auto& size = image.geometry.size;
  const auto zone = [&](std::size_t n) {
    const auto at = static_cast<std::int64_t>(n);
    return zones(places[0][static_cast<std::size_t>(at % size[0])],
                 places[1][static_cast<std::size_t>(at / size[0] % size[1])],
                 places[2][static_cast<std::size_t>(at / (size[0] * size[1]))]);
  };
  MaskVolume bone = where(image, [&](std::size_t n) {
    const std::uint8_t z = zone(n);
    return z == 2 || (z == 1 && image.voxels[n] >= options.shell_hu);
  });
  task.throw_if_cancelled();
  imaging::fill_bright_holes(bone, image, kMarrowHu);
  return bone;
}

/// Bright spots and what blooms about them.
MaskVolume calcium_mask(const ImageVolume& image, const std::vector<Vec3>& lumen,
                        const TissueOptions& options) {
  if (lumen.empty()) throw InvalidInput("tissue removal: calcium needs a point in the lumen");
  const detail::SeedIntensities seeds = detail::seed_intensities(image, lumen);
  const double contrast = seeds.brightest - detail::background_hu(image, lumen, seeds.darkest);
  const double sure =
      options.calcium_hu > 0.0 ? options.calcium_hu : seeds.brightest + 0.5 * std::max(contrast, 100.0);
  const double blooming = 0.5 * (sure + seeds.brightest);
  const MaskVolume bright = where(image, [&](std::size_t n) { return image.voxels[n] >= sure; });
  const imaging::Components spots = imaging::components(bright);
  const double voxel = image.geometry.spacing.prod();
  const MaskVolume small = where(image, [&](std::size_t n) {
    return spots.label[n] != 0 &&
           static_cast<double>(spots.voxels[spots.label[n]]) * voxel <= options.largest_calcium_mm3;
  });
  MaskVolume grown = imaging::dilated(small, 1.01 * image.geometry.spacing.maxCoeff());
  for (std::size_t n = 0; n < grown.voxels.size(); ++n)
    if (small.voxels[n] == 0 && image.voxels[n] < blooming) grown.voxels[n] = 0;
  return grown;
}

/// The layer under the air that reaches the image's sides (the airway and the lungs reach its ends at most).
MaskVolume skin_mask(const ImageVolume& image, const TissueOptions& options, const core::TaskContext& task) {
  const ImageVolume coarse = coarse_of(image, task);
  const imaging::Components air =
      imaging::components(where(coarse, [&](std::size_t n) { return coarse.voxels[n] < kAirAboutBodyHu; }));
  std::vector<std::uint8_t> outside(air.voxels.size(), 0);
  const auto& size = coarse.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (const std::int64_t i : {std::int64_t{0}, size[0] - 1})
        outside[air.label[static_cast<std::size_t>(coarse.geometry.offset(i, j, k))]] = 1;
    for (std::int64_t i = 0; i < size[0]; ++i)
      for (const std::int64_t j : {std::int64_t{0}, size[1] - 1})
        outside[air.label[static_cast<std::size_t>(coarse.geometry.offset(i, j, k))]] = 1;
  }
  outside[0] = 0;
  // Noise in the lungs makes single voxels as dark as air.
  const double voxel = coarse.geometry.spacing.prod();
  for (std::size_t p = 1; p < outside.size(); ++p)
    if (static_cast<double>(air.voxels[p]) * voxel < 10.0 * kLeastBone) outside[p] = 0;
  const MaskVolume about = where(coarse, [&](std::size_t n) { return outside[air.label[n]] != 0; });
  const MaskVolume near = imaging::dilated(about, options.skin_mm + 0.5 * coarse.geometry.spacing.maxCoeff());
  const auto places = coarse_places(image.geometry, coarse.geometry);
  const auto& fine = image.geometry.size;
  return where(image, [&](std::size_t n) {
    const auto at = static_cast<std::int64_t>(n);
    return image.voxels[n] > kAirAboutBodyHu &&
           near(places[0][static_cast<std::size_t>(at % fine[0])],
                places[1][static_cast<std::size_t>(at / fine[0] % fine[1])],
                places[2][static_cast<std::size_t>(at / (fine[0] * fine[1]))]) != 0;
  });
}

}  // namespace

void validate(const TissueOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("tissue removal: ") + what);
  };
  require(std::isfinite(o.candidate_hu), "candidate_hu must be finite");
  require(std::isfinite(o.shell_hu) && o.shell_hu > o.candidate_hu, "shell_hu must be above candidate_hu");
  require(o.contact_mm >= 0.0 && o.contact_mm <= 5.0, "contact_mm must be in [0, 5]");
  require(o.calcium_hu >= 0.0 && std::isfinite(o.calcium_hu), "calcium_hu must be 0 or more");
  require(o.largest_calcium_mm3 > 0.0, "largest_calcium_mm3 must be positive");
  require(o.skin_mm > 0.0 && o.skin_mm <= 20.0, "skin_mm must be in (0, 20]");
  require(o.fill_hu >= -1024.0 && o.fill_hu <= 3071.0, "fill_hu must be in [-1024, 3071]");
}

MaskVolume tissues_to_remove(const ImageVolume& image, const std::vector<Vec3>& lumen_mm,
                             const TissueOptions& options, const core::TaskContext& task) {
  validate(options);
  if (image.voxels.empty()) throw InvalidInput("tissue removal: the image is empty");
  for (const Vec3& point : lumen_mm)
    if (!image.geometry.contains(point)) throw InvalidInput("tissue removal: a point is outside the image");
  MaskVolume out{image.geometry, {}};
  out.voxels.assign(image.voxels.size(), static_cast<std::uint8_t>(Tissue::kept));
  const auto add = [&](const MaskVolume& mask, Tissue tissue) {
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
      if (mask.voxels[n] != 0 && out.voxels[n] == 0) out.voxels[n] = static_cast<std::uint8_t>(tissue);
  };
  task.throw_if_cancelled();
  if (options.bone) add(bone_mask(image, lumen_mm, options, task.sub(0.0, 0.6)), Tissue::bone);
  task.throw_if_cancelled();
  if (options.calcium) add(calcium_mask(image, lumen_mm, options), Tissue::calcium);
  task.throw_if_cancelled();
  if (options.skin) add(skin_mask(image, options, task.sub(0.8, 0.9)), Tissue::skin);
  task.set_progress(1.0);
  return out;
}

ImageVolume without_tissues(const ImageVolume& image, const MaskVolume& mask, double fill_hu) {
  if (!imaging::same_grid(image.geometry, mask.geometry) || image.voxels.size() != mask.voxels.size())
    throw InvalidInput("tissue removal: the mask does not lie on the image's grid");
  ImageVolume out = image;
  const auto fill = static_cast<std::int16_t>(std::lround(std::clamp(fill_hu, -1024.0, 3071.0)));
  for (std::size_t n = 0; n < out.voxels.size(); ++n)
    if (mask.voxels[n] != 0) out.voxels[n] = fill;
  return out;
}

}  // namespace ostia::segmentation
