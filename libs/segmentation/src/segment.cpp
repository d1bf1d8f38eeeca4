#include "ostia/segmentation/segment.h"

#include "level_set/evolve_region.h"
#include "level_set/initialization.h"
#include "path/prepared_image.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace ostia::segmentation {
namespace {

/// A box of all regions' grids.
imaging::Region united(const std::vector<InitialRegion>& parts) {
  imaging::Region box = parts.front().region;
  for (const InitialRegion& part : parts) {
    for (int d = 0; d < 3; ++d) {
      box.lower[d] = std::min(box.lower[d], part.region.lower[d]);
      box.upper[d] = std::max(box.upper[d], part.region.upper[d]);
    }
  }
  return box;
}

imaging::FloatVolume on_region(const imaging::Geometry& image, const imaging::Region& region, float value) {
  imaging::FloatVolume out;
  out.geometry = image;
  for (int d = 0; d < 3; ++d) out.geometry.size[d] = region.upper[d] - region.lower[d];
  out.geometry.origin =
      image.world(Vec3(static_cast<double>(region.lower[0]), static_cast<double>(region.lower[1]),
                       static_cast<double>(region.lower[2])));
  out.voxels.assign(static_cast<std::size_t>(out.geometry.voxels()), value);
  return out;
}

void lower_by(imaging::FloatVolume& whole, const imaging::Region& box, const InitialRegion& part) {
  const auto& size = part.level_set.geometry.size;
  for (std::int64_t k = 0; k < size[2]; ++k) {
    for (std::int64_t j = 0; j < size[1]; ++j) {
      const float* from = part.level_set.voxels.data() + part.level_set.geometry.offset(0, j, k);
      float* to = whole.voxels.data() + whole.geometry.offset(part.region.lower[0] - box.lower[0],
                                                              part.region.lower[1] - box.lower[1] + j,
                                                              part.region.lower[2] - box.lower[2] + k);
      for (std::int64_t i = 0; i < size[0]; ++i) to[i] = std::min(to[i], from[i]);
    }
  }
}

/// A cylinder about a seed, along the vessel.
struct Slice {
  Vec3 seed;
  Vec3 axis;  ///< unit, out of the vessel
  double radius = 0.0;
  double from = 0.0;  ///< along the axis, from the seed
  double to = 0.0;

  bool holds(const Vec3& point) const {
    const Vec3 away = point - seed;
    const double along = away.dot(axis);
    return along >= from && along <= to && (away - along * axis).norm() <= radius;
  }
};

/// Calls visit(i, j, k) on the voxels of a slice that can be reached from those about its seed through voxels
/// of the slice for which `open` holds.
template <class Open, class Visit>
void flood_slice(const imaging::Geometry& g, const Slice& slice, const Open& open, const Visit& visit) {
  const Vec3 index = g.index(slice.seed);
  std::vector<std::array<std::int64_t, 3>> front;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(g.voxels()), 0);
  const auto look_at = [&](const std::array<std::int64_t, 3>& v) {
    for (int d = 0; d < 3; ++d) {
      if (v[d] < 0 || v[d] >= g.size[d]) return;
    }
    std::uint8_t& mark = seen[static_cast<std::size_t>(g.offset(v[0], v[1], v[2]))];
    if (mark != 0) return;
    mark = 1;
    const Vec3 centre(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
    if (slice.holds(g.world(centre)) && open(v)) front.push_back(v);
  };
  constexpr int kAbout = 2;
  for (int k = -kAbout; k <= kAbout; ++k) {
    for (int j = -kAbout; j <= kAbout; ++j) {
      for (int i = -kAbout; i <= kAbout; ++i) {
        look_at({std::llround(index[0]) + i, std::llround(index[1]) + j, std::llround(index[2]) + k});
      }
    }
  }
  while (!front.empty()) {
    const auto v = front.back();
    front.pop_back();
    visit(v);
    for (int d = 0; d < 3; ++d) {
      for (const int s : {-1, 1}) {
        auto n = v;
        n[d] += s;
        look_at(n);
      }
    }
  }
}

constexpr double kSeamVoxels = 2.5;
constexpr double kCutVoxels = 6.0;

/// What is in range within the slice joins the inside.
void fill_slice(const imaging::ImageVolume& image, const imaging::Region& box, const Slice& slice,
                const IntensityRange& range, imaging::FloatVolume& level_set) {
  const auto in_range = [&](const std::array<std::int64_t, 3>& v) {
    const double hu = image(v[0] + box.lower[0], v[1] + box.lower[1], v[2] + box.lower[2]);
    return hu >= range.lower && hu <= range.upper;
  };
  flood_slice(level_set.geometry, slice, in_range, [&](const std::array<std::int64_t, 3>& v) {
    level_set(v[0], v[1], v[2]) = std::min(level_set(v[0], v[1], v[2]), -0.1F);
  });
}

/// Where two branches share a seed, their ends stand face to face: fills the lumen between them.
void close_seam(const imaging::ImageVolume& image, const imaging::Region& box, const LevelSetEnd& end,
                const IntensityRange& range, imaging::FloatVolume& level_set) {
  const double reach = kSeamVoxels * level_set.geometry.spacing.maxCoeff();
  fill_slice(image, box, {end.point, end.outward.normalized(), end.radius_mm, -reach, reach}, range,
             level_set);
}

bool inside_at(const imaging::FloatVolume& level_set, const Vec3& point) {
  const imaging::Geometry& g = level_set.geometry;
  const Vec3 index = g.index(point);
  std::array<std::int64_t, 3> v{};
  for (int d = 0; d < 3; ++d) {
    v[d] = std::llround(index[d]);
    if (v[d] < 0 || v[d] >= g.size[d]) return false;
  }
  return level_set(v[0], v[1], v[2]) < 0.0F;
}

/// The fronts end raggedly where the image is noisy: makes a free end flat, at the plane through its seed.
void flatten_end(const LevelSetEnd& end, imaging::FloatVolume& level_set) {
  const double h = level_set.geometry.spacing.maxCoeff();
  const Vec3 axis = end.outward.normalized();
  // The section a little further in is drawn out to the plane; what lies beside it may be another vessel.
  const auto ahead_of_section = [&](const std::array<std::int64_t, 3>& v) {
    const Vec3 centre(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
    const Vec3 point = level_set.geometry.world(centre);
    bool found = false;  // noise may have left holes in one section, hardly in all
    for (const double back : {3.0, 4.0, 5.0, 6.0}) found |= inside_at(level_set, point - back * h * axis);
    return found;
  };
  flood_slice(level_set.geometry, {end.point, axis, end.radius_mm, -kSeamVoxels * h, 0.0}, ahead_of_section,
              [&](const std::array<std::int64_t, 3>& v) {
                level_set(v[0], v[1], v[2]) = std::min(level_set(v[0], v[1], v[2]), -0.1F);
              });
  const auto inside = [&](const std::array<std::int64_t, 3>& v) {
    return level_set(v[0], v[1], v[2]) < 0.0F;
  };
  flood_slice(level_set.geometry, {end.point, axis, end.radius_mm, 0.5 * h, kCutVoxels * h}, inside,
              [&](const std::array<std::int64_t, 3>& v) { level_set(v[0], v[1], v[2]) = 0.1F; });
}

/// Signs blurred over 3 x 3 x 3 voxels (binomial), every voxel on its side: takes the stairs off the initial
/// surface.
imaging::FloatVolume without_stairs(const imaging::FloatVolume& level_set, const detail::Shell& shell) {
  imaging::FloatVolume out = level_set;
  const auto& size = level_set.geometry.size;
  const std::array<std::int64_t, 3> strides{1, size[0], size[0] * size[1]};
  const double h = level_set.geometry.spacing.minCoeff();
  core::parallel_for(out.voxels.size(), 262144, [&](std::size_t n) {
    out.voxels[n] = static_cast<float>(level_set.voxels[n] < 0.0F ? -h : h);
  });
  constexpr std::array<double, 3> kWeight{0.25, 0.5, 0.25};
  const auto blurred = [&](std::int64_t n) {
    double sum = 0.0;
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const std::int64_t m = n + i * strides[0] + j * strides[1] + k * strides[2];
          sum += kWeight[i + 1] * kWeight[j + 1] * kWeight[k + 1] * (level_set.voxels[m] < 0.0F ? -1.0 : 1.0);
        }
      }
    }
    return sum;
  };
  const auto visit = [&](std::int64_t n) {
    const std::array<std::int64_t, 3> at{n % size[0], n / size[0] % size[1], n / (size[0] * size[1])};
    for (int d = 0; d < 3; ++d) {
      if (at[d] < 1 || at[d] + 1 >= size[d]) return;
    }
    const double value = blurred(n);
    out.voxels[n] =
        static_cast<float>(h * (level_set.voxels[n] < 0.0F ? std::min(value, -0.1) : std::max(value, 0.1)));
  };
  for (const std::int64_t n : shell.surface) {
    visit(n);
    for (const std::int64_t s : strides) {
      if (level_set.voxels[n - s] >= 0.0F) visit(n - s);
      if (level_set.voxels[n + s] >= 0.0F) visit(n + s);
    }
  }
  return out;
}

constexpr double kRoomVoxels = 3.0;

/// How far the section across the vessel a little inside of its end reaches, found on a lattice of its plane,
/// with room.
double section_radius(const imaging::FloatVolume& initial, const Vec3& seed, const Vec3& outward) {
  const double h = initial.geometry.spacing.maxCoeff();
  const Vec3 u = outward.unitOrthogonal();
  const Vec3 v = outward.cross(u);
  const Vec3 centre = seed - 3.0 * h * outward;
  constexpr int kReach = 64;
  constexpr int kWidth = 2 * kReach + 1;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(kWidth) * kWidth, 0);
  std::vector<std::array<int, 2>> front{{0, 0}};
  double radius = 0.0;
  while (!front.empty()) {
    const auto [a, b] = front.back();
    front.pop_back();
    if (std::abs(a) > kReach || std::abs(b) > kReach) continue;
    std::uint8_t& mark = seen[static_cast<std::size_t>((a + kReach) * kWidth + b + kReach)];
    if (mark != 0) continue;
    mark = 1;
    const Vec3 away = h * (a * u + b * v);
    if (!inside_at(initial, centre + away) && std::abs(a) + std::abs(b) > 1) continue;
    radius = std::max(radius, away.norm());
    for (const auto& [da, db] : {std::array{1, 0}, std::array{-1, 0}, std::array{0, 1}, std::array{0, -1}}) {
      front.push_back({a + da, b + db});
    }
  }
  return radius + kRoomVoxels * h;
}

/// An end of a branch that stands free in the open lumen; none where the united region goes on beyond it.
std::optional<LevelSetEnd> free_end(const imaging::FloatVolume& initial, const Vec3& seed,
                                    const Vec3& outward) {
  if (inside_at(initial, seed + 4.0 * initial.geometry.spacing.maxCoeff() * outward)) return std::nullopt;
  const double radius = section_radius(initial, seed, outward);
  // Of a vessel of few voxels the direction is not known well enough; there the walls hold the end.
  if (radius <= (kRoomVoxels + 2.5) * initial.geometry.spacing.maxCoeff()) return std::nullopt;
  return LevelSetEnd{seed, outward, radius};
}

bool shared_seed(const std::vector<BranchSeeds>& branches, std::size_t own, const Vec3& seed,
                 double distance) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    if (b == own) continue;
    if ((branches[b].from - seed).norm() < distance || (branches[b].to - seed).norm() < distance) return true;
  }
  return false;
}

constexpr int kBalloonRoom = 12;  // voxels about the initial region into which a balloon may grow

constexpr double kRestlessVoxels = 0.03;  // motion in ten iterations that a person should know of

std::string restless(const LevelSetResult& evolved, double voxel_mm) {
  std::array<char, 200> text{};
  std::snprintf(
      text.data(), text.size(),
      "the level set was stopped after %d iterations while it still moved by %.2f mm (root mean square) "
      "in ten iterations; look at the surface, or allow more iterations",
      evolved.iterations, evolved.rms_voxels * voxel_mm);
  return text.data();
}

}  // namespace

void validate(const SegmentOptions& options) {
  validate(options.fronts);
  validate(options.level_set);
  validate(options.remove);
  if (options.denoise) imaging::validate(*options.denoise);
  const auto require = [](bool good, const char* what) {
    if (!good) throw InvalidInput(std::string("segmentation: ") + what);
  };
  require(options.gaussian_sigma_mm >= 0.0 && options.gaussian_sigma_mm <= 10.0,
          "gaussian_sigma_mm must be in [0, 10]");
  if (!options.balloon) return;
  const IntensityBalloon& balloon = *options.balloon;
  require(balloon.tau > 0.0 && balloon.tau < 1.0, "the balloon's tau must be in (0, 1)");
  require(!balloon.mean_hu || std::isfinite(*balloon.mean_hu), "the balloon's mean_hu must be finite");
  require(!balloon.sigma_hu || (*balloon.sigma_hu > 0.0 && std::isfinite(*balloon.sigma_hu)),
          "the balloon's sigma_hu must be positive");
  require(options.level_set.inflation > 0.0, "the balloon needs an inflation weight above 0");
}

SegmentationResult segment_vessels(const imaging::ImageVolume& given, const std::vector<BranchSeeds>& asked,
                                   const SegmentOptions& options, const core::TaskContext& whole_task) {
  validate(options);
  if (asked.empty()) throw InvalidInput("segmentation: no branch is given; give two seeds, one at each end");
  const bool prepares = detail::needs_preparation(options);
  const std::optional<imaging::ImageVolume> made =
      prepares ? std::optional(detail::prepared_image(given, asked, options, whole_task.sub(0.0, 0.5)))
               : std::nullopt;
  const imaging::ImageVolume& image = made ? *made : given;
  const core::TaskContext task = whole_task.sub(prepares ? 0.5 : 0.0, 1.0);
  SegmentationResult result;
  CollidingFrontsOptions fronts = options.fronts;
  if (options.balloon) fronts.margin_voxels = std::max(fronts.margin_voxels, kBalloonRoom);
  if (options.bright_is_lumen) fronts.upper_hu = std::numeric_limits<std::int16_t>::max();
  task.set_stage("colliding fronts");
  detail::InitializedBranches followed =
      detail::initialize_branches(image, asked, fronts, options.leave_out_unfollowed, task.sub(0.0, 0.4));
  const std::vector<BranchSeeds>& branches = followed.branches;
  std::vector<InitialRegion>& parts = followed.parts;
  result.left_out = std::move(followed.left_out);
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const InitialRegion& part = parts[b];
    result.branches.push_back(
        {part.range, part.range_was_chosen, part.lumen_hu, part.voxels, part.visited, part.touches_border});
    if (part.touches_border) {
      result.touches_border = true;
      result.warnings.push_back(
          "branch " + std::to_string(followed.index[b] + 1) +
          " reaches the border of the image: the vessel goes on outside and is cut there");
    }
  }
  result.region = united(parts);
  SegmentOptions wanted = options;
  imaging::FloatVolume initial = on_region(image.geometry, result.region, 1.0F);
  for (InitialRegion& part : parts) {
    lower_by(initial, result.region, part);
    part.level_set = {};
    wanted.level_set.kept.insert(wanted.level_set.kept.end(), part.way.begin(), part.way.end());
  }
  std::vector<LevelSetEnd> ends;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const std::array<Vec3, 2> seeds{branches[b].from, branches[b].to};
    for (std::size_t e = 0; e < 2; ++e) {
      const auto end = free_end(initial, seeds[e], parts[b].outward[e]);
      if (shared_seed(branches, b, seeds[e], 3.0 * image.geometry.spacing.maxCoeff())) {
        const double radius = section_radius(initial, seeds[e], parts[b].outward[e]);
        close_seam(image, result.region, {seeds[e], parts[b].outward[e], radius, false}, parts[b].range,
                   initial);
      } else if (end) {
        flatten_end(*end, initial);
        ends.push_back(*end);
      }
    }
  }
  task.set_stage("level set");
  const detail::Shell shell = detail::shell_of(initial);
  initial = without_stairs(initial, shell);
  double brightest = 0.0;
  for (const InitialRegion& part : parts) brightest = std::max(brightest, part.lumen_hu);
  wanted.level_set.ends = std::move(ends);
  detail::EvolvedRegion region =
      detail::evolve_region(image, result.region, initial, shell, wanted, brightest, task.sub(0.4, 1.0));
  LevelSetResult& evolved = region.surface;
  result.balloon_mean_hu = region.balloon_mean_hu;
  result.balloon_sigma_hu = region.balloon_sigma_hu;
  result.level_set = std::move(evolved.level_set);
  result.iterations = evolved.iterations;
  result.converged = evolved.converged;
  result.rms_voxels = evolved.rms_voxels;
  if (!evolved.converged && evolved.rms_voxels > kRestlessVoxels) {
    result.warnings.push_back(restless(evolved, image.geometry.spacing.minCoeff()));
  }
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::segmentation
