#include "ostia/analysis/fat_attenuation.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"
#include "ostia/imaging/filters.h"
#include "ostia/imaging/morphology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace ostia::analysis {
namespace {

using geometry::Vec3;
using std::numbers::pi;

constexpr double deciding_blur_mm = 0.4;  // what is fat is told apart from noise on a slightly blurred image
constexpr double widest_mm = 12.0;        // no coronary artery's outer wall is farther from its axis

void require_fat(bool fine, const char* name, double value, const char* range) {
  if (!fine)
    throw InvalidInput(std::string("fat: ") + name + " is " + core::rounded_text(value, 3) +
                       "; it has to be in " + range);
}

/// Sums that a mean and a deviation are made of, whole numbers: the order does not matter.
struct FatSums {
  std::int64_t count = 0, sum = 0, squares = 0, all_count = 0, all_sum = 0;
  void add(std::int64_t hu, bool clear) {
    ++all_count;
    all_sum += hu;
    if (!clear) return;
    ++count;
    sum += hu;
    squares += hu * hu;
  }
  void add(const FatSums& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
    all_count += other.all_count;
    all_sum += other.all_sum;
  }
};

FatAmount amount_of(const FatSums& s, double voxel_mm3) {
  FatAmount out;
  out.voxels = s.count;
  out.all_voxels = s.all_count;
  out.volume_mm3 = voxel_mm3 * static_cast<double>(s.all_count);
  if (s.all_count > 0) out.all_mean_hu = static_cast<double>(s.all_sum) / static_cast<double>(s.all_count);
  if (s.count == 0) return out;
  const auto n = static_cast<double>(s.count);
  out.mean_hu = static_cast<double>(s.sum) / n;
  out.sd_hu = std::sqrt(std::max(0.0, static_cast<double>(s.squares) / n - out.mean_hu * out.mean_hu));
  return out;
}

double mean_diameter(const FatStretch& stretch) {
  constexpr int around = 32;
  const int rows = std::max(2, static_cast<int>(stretch.to_mm - stretch.from_mm) * 2);
  double sum = 0.0;
  for (int r = 0; r < rows; ++r) {
    const double s = stretch.from_mm + (stretch.to_mm - stretch.from_mm) * (r + 0.5) / rows;
    double squares = 0.0;
    for (int a = 0; a < around; ++a) {
      const double radius = stretch.outer_mm(s, 2.0 * pi * a / around);
      if (!(radius > 0.0 && radius <= widest_mm))
        throw InvalidInput("fat: the outer wall at " + core::rounded_text(s, 1) + " mm is " +
                           core::rounded_text(radius, 2) + " mm from the axis; it has to be in (0, 12]");
      squares += radius * radius;
    }
    sum += 2.0 * std::sqrt(squares / around);
  }
  return sum / rows;
}

/// The part of the image that holds everything within `about_mm` of the stretch; nothing where that is empty.
std::optional<imaging::Region> region_about(const geometry::AxisCurve& axis, const FatStretch& stretch,
                                            const imaging::Geometry& grid, double about_mm) {
  geometry::Box3 box;
  for (double s = stretch.from_mm;; s = std::min(s + 1.0, stretch.to_mm)) {
    box.extend(grid.index(axis.point(s)));
    if (s >= stretch.to_mm) break;
  }
  imaging::Region region;
  for (int d = 0; d < 3; ++d) {
    const auto a = static_cast<std::size_t>(d);
    const double more = (about_mm + 1.0) / grid.spacing[d];
    const auto most = static_cast<double>(grid.size[a]);
    region.lower[a] = static_cast<std::int64_t>(std::clamp(std::floor(box.min()[d] - more), 0.0, most));
    region.upper[a] = static_cast<std::int64_t>(std::clamp(std::ceil(box.max()[d] + more) + 1.0, 0.0, most));
    if (region.lower[a] >= region.upper[a]) return std::nullopt;
  }
  return region;
}

/// 1 where what is no fat is nearer than the options' edge.
imaging::MaskVolume beside_edges(const imaging::ImageVolume& image, const FatOptions& o,
                                 const core::TaskContext& task) {
  imaging::FloatVolume values{image.geometry, std::vector<float>(image.voxels.begin(), image.voxels.end())};
  values = imaging::gaussian_blurred(values, deciding_blur_mm, task);
  imaging::MaskVolume other{image.geometry, std::vector<std::uint8_t>(image.voxels.size())};
  for (std::size_t n = 0; n < other.voxels.size(); ++n) {
    const double hu = values.voxels[n];
    other.voxels[n] = hu < o.from_hu || hu > o.to_hu ? 1 : 0;
  }
  return imaging::dilated(other, o.edge_mm);
}

/// Where each voxel of a stretch belongs, and what it adds there.
class FatCounting {
 public:
  FatCounting(const geometry::AxisCurve& axis, const FatStretch& stretch, const imaging::ImageVolume& part,
              const imaging::MaskVolume& edges, const FatOptions& options, double reach_mm)
      : axis_(axis), stretch_(stretch), part_(part), edges_(edges), options_(options), reach_mm_(reach_mm) {
    slabs_ = static_cast<std::size_t>(
        std::max(1.0, std::ceil((stretch.to_mm - stretch.from_mm) / options.slab_mm - 1e-9)));
  }
  std::size_t pieces() const { return slabs_ * static_cast<std::size_t>(options_.sectors); }
  std::size_t slabs() const { return slabs_; }
  std::vector<FatSums> slice(std::int64_t k) const;

 private:
  void add(std::int64_t i, std::int64_t j, std::int64_t k, std::vector<FatSums>& sums) const;

  const geometry::AxisCurve& axis_;
  const FatStretch& stretch_;
  const imaging::ImageVolume& part_;
  const imaging::MaskVolume& edges_;
  const FatOptions& options_;
  double reach_mm_;
  std::size_t slabs_ = 1;
};

void FatCounting::add(std::int64_t i, std::int64_t j, std::int64_t k, std::vector<FatSums>& sums) const {
  const std::int16_t hu = part_(i, j, k);
  if (hu < options_.from_hu || hu > options_.to_hu) return;
  const Vec3 place =
      part_.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
  const std::vector<geometry::AxisFoot> feet = axis_.feet(place, widest_mm + reach_mm_);
  if (feet.empty()) return;
  const geometry::AxisFoot& foot = feet.front();
  if (foot.past_end || foot.s_mm < stretch_.from_mm || foot.s_mm > stretch_.to_mm) return;
  const double beyond = foot.rho_mm - stretch_.outer_mm(foot.s_mm, foot.theta);
  if (beyond <= 0.0 || beyond > reach_mm_) return;
  const auto slab =
      std::min(slabs_ - 1, static_cast<std::size_t>((foot.s_mm - stretch_.from_mm) / options_.slab_mm));
  const double turns = foot.theta / (2.0 * pi);
  const auto sectors = static_cast<std::size_t>(options_.sectors);
  const std::size_t sector =
      std::min(sectors - 1, static_cast<std::size_t>((turns - std::floor(turns)) * options_.sectors));
  sums[slab * sectors + sector].add(hu, beyond >= options_.edge_mm && edges_(i, j, k) == 0);
}

std::vector<FatSums> FatCounting::slice(std::int64_t k) const {
  std::vector<FatSums> sums(pieces());
  for (std::int64_t j = 0; j < part_.geometry.size[1]; ++j)
    for (std::int64_t i = 0; i < part_.geometry.size[0]; ++i) add(i, j, k, sums);
  return sums;
}

void check_stretch(const geometry::AxisCurve& axis, const FatStretch& stretch) {
  if (!stretch.outer_mm) throw InvalidInput("fat: the outer wall is missing");
  if (!(stretch.from_mm >= -1e-6 && stretch.from_mm < stretch.to_mm && stretch.to_mm <= axis.length() + 1e-6))
    throw InvalidInput("fat: from " + core::rounded_text(stretch.from_mm, 2) + " to " +
                       core::rounded_text(stretch.to_mm, 2) + " mm is no stretch of an axis of " +
                       core::rounded_text(axis.length(), 2) + " mm");
}

void fill_in(FatProfile& out, const std::vector<FatSums>& sums, std::size_t slabs, double voxel_mm3) {
  const auto sectors = static_cast<std::size_t>(out.options.sectors);
  FatSums all;
  for (std::size_t slab = 0; slab < slabs; ++slab) {
    FatSums of_slab;
    for (std::size_t n = 0; n < sectors; ++n) {
      const FatSums& one = sums[slab * sectors + n];
      of_slab.add(one);
      FatPiece piece;
      piece.from_mm = out.from_mm + static_cast<double>(slab) * out.options.slab_mm;
      piece.to_mm = std::min(out.to_mm, piece.from_mm + out.options.slab_mm);
      piece.from_theta = 2.0 * pi * static_cast<double>(n) / static_cast<double>(sectors);
      piece.fat = amount_of(one, voxel_mm3);
      out.pieces.push_back(piece);
    }
    out.slabs.push_back(amount_of(of_slab, voxel_mm3));
    all.add(of_slab);
  }
  out.fat = amount_of(all, voxel_mm3);
}

}  // namespace

void validate(const FatOptions& o) {
  require_fat(o.from_hu >= -300.0 && o.from_hu <= 0.0, "from_hu", o.from_hu, "[-300, 0] HU");
  require_fat(o.to_hu > o.from_hu && o.to_hu <= 0.0, "to_hu", o.to_hu, "(from_hu, 0] HU");
  require_fat(o.reach_diameters > 0.0 && o.reach_diameters <= 5.0, "reach_diameters", o.reach_diameters,
              "(0, 5]");
  require_fat(o.edge_mm >= 0.0 && o.edge_mm <= 3.0, "edge_mm", o.edge_mm, "[0, 3] mm");
  require_fat(o.slab_mm >= 0.25 && o.slab_mm <= 10.0, "slab_mm", o.slab_mm, "[0.25, 10] mm");
  require_fat(o.sectors >= 1 && o.sectors <= 64, "sectors", o.sectors, "[1, 64]");
}

FatProfile fat_profile(const geometry::AxisCurve& axis, const FatStretch& stretch,
                       const imaging::ImageVolume& image, const FatOptions& options,
                       const core::TaskContext& task) {
  validate(options);
  check_stretch(axis, stretch);
  task.set_stage("fat");
  FatProfile out;
  out.options = options;
  out.from_mm = stretch.from_mm;
  out.to_mm = stretch.to_mm;
  out.diameter_mm = mean_diameter(stretch);
  const double reach_mm = options.reach_diameters * out.diameter_mm;
  const auto region = region_about(axis, stretch, image.geometry, widest_mm + reach_mm + options.edge_mm);
  if (!region) throw InvalidInput("fat: the stretch lies outside of the image");
  const imaging::ImageVolume part = imaging::cropped(image, *region);
  const imaging::MaskVolume edges = beside_edges(part, options, task.sub(0.0, 0.3));
  const FatCounting counting(axis, stretch, part, edges, options, reach_mm);
  const auto slices = static_cast<std::size_t>(part.geometry.size[2]);
  std::vector<std::vector<FatSums>> by_slice(slices);
  core::parallel_for(slices, 1, [&](std::size_t k) {
    task.throw_if_cancelled();
    by_slice[k] = counting.slice(static_cast<std::int64_t>(k));
  });
  std::vector<FatSums> sums(counting.pieces());
  for (const std::vector<FatSums>& one : by_slice)
    for (std::size_t n = 0; n < sums.size(); ++n) sums[n].add(one[n]);
  fill_in(out, sums, counting.slabs(), part.geometry.spacing.prod());
  return out;
}

std::optional<FatRange> fat_range(std::string_view vessel) {
  if (vessel == "RCA") return FatRange{10.0, 50.0};
  if (vessel == "LAD" || vessel == "LCX") return FatRange{0.0, 40.0};
  return std::nullopt;
}

std::optional<double> fat_hu_at_120_kv(double mean_hu, double tube_kv) {
  // Mean at a tube voltage over that at 120 kV: Eur. Radiol. 33:2324-2330, 2023.
  constexpr std::array<std::pair<double, double>, 4> ratios{
      {{80.0, 1.267}, {100.0, 1.080}, {120.0, 1.0}, {140.0, 0.947}}};
  if (!(tube_kv >= ratios.front().first && tube_kv <= ratios.back().first)) return std::nullopt;
  std::size_t i = 0;
  while (i + 2 < ratios.size() && tube_kv > ratios[i + 1].first) ++i;
  const double t = (tube_kv - ratios[i].first) / (ratios[i + 1].first - ratios[i].first);
  return mean_hu / ((1.0 - t) * ratios[i].second + t * ratios[i + 1].second);
}

}  // namespace ostia::analysis
