#include "ostia/coronary/heart_region.h"

#include "median.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/imaging/morphology.h"
#include "ostia/segmentation/tissue_removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace ostia::coronary {
namespace {

using imaging::Geometry;
using imaging::ImageVolume;
using imaging::MaskVolume;

constexpr int hull_directions = 256;
constexpr double muscle_hu = 60.0;   // without contrast agent
constexpr double faint_share = 0.4;  // of the arteries' contrast: what a right heart has late
constexpr double least_blood_hu = 130.0;
constexpr double thin_wall_mm = 2.0;    // of vessels and atria
constexpr double thick_wall_mm = 11.0;  // of the left ventricle
constexpr double apex_mm = 30.0;        // arteries end before the apex, or are seen so far only
constexpr double wall_hu = 0.0;         // fat is darker
constexpr double bone_rim_mm = 1.6;     // of a bone what only partly fills its voxels

/// Directions that are nearly evenly spread over the sphere, by the golden angle.
std::vector<Vec3> spread_directions(int count) {
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int n = 0; n < count; ++n) {
    const double z = 1.0 - (2.0 * n + 1.0) / count, across = std::sqrt(1.0 - z * z);
    directions.emplace_back(across * std::cos(golden * n), across * std::sin(golden * n), z);
  }
  return directions;
}

/// Half-spaces whose common part is the convex hull of the places, a little rounded outwards, and so many mm
/// more.
struct Hull {
  std::vector<Vec3> normals;
  std::vector<double> bounds;
};

Hull hull_about(const std::vector<ArteryPlace>& arteries, double about_mm) {
  Hull hull{spread_directions(hull_directions), {}};
  for (const Vec3& normal : hull.normals) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const ArteryPlace& each : arteries)
      farthest = std::max(farthest, each.place.dot(normal) + each.radius_mm);
    hull.bounds.push_back(farthest + about_mm);
  }
  return hull;
}

/// 1 in the hull. Row by row: each half-space leaves an interval of a row.
MaskVolume inside(const Hull& hull, const Geometry& grid) {
  MaskVolume mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxels()), 0)};
  const Vec3 step = grid.world(Vec3::UnitX()) - grid.world(Vec3::Zero());
  core::parallel_for(static_cast<std::size_t>(grid.size[2]), 1, [&](std::size_t slice) {
    for (std::int64_t j = 0; j < grid.size[1]; ++j) {
      const Vec3 first = grid.world({0.0, static_cast<double>(j), static_cast<double>(slice)});
      double from = 0.0, to = static_cast<double>(grid.size[0] - 1);
      for (std::size_t n = 0; n < hull.normals.size() && from <= to; ++n) {
        const double along = step.dot(hull.normals[n]), room = hull.bounds[n] - first.dot(hull.normals[n]);
        if (std::abs(along) < 1e-12) {
          if (room < 0.0) to = -1.0;
        } else if (along > 0.0) {
          to = std::min(to, room / along);
        } else {
          from = std::max(from, room / along);
        }
      }
      for (auto i = static_cast<std::int64_t>(std::ceil(from)); static_cast<double>(i) <= to; ++i)
        mask(i, j, static_cast<std::int64_t>(slice)) = 1;
    }
  });
  return mask;
}

/// What the arteries' lumen has, of those that are wide enough to show it.
double blood_hu(const ImageVolume& image, const std::vector<ArteryPlace>& arteries) {
  constexpr double wide_mm = 1.0;
  std::vector<double> values;
  for (const bool wide : {true, false}) {
    for (const ArteryPlace& each : arteries)
      if (!wide || each.radius_mm >= wide_mm) {
        const Vec3 at = image.geometry.index(each.place);
        std::array<std::int64_t, 3> voxel{};
        bool there = true;
        for (std::size_t d = 0; d < 3; ++d) {
          voxel[d] = std::llround(at[static_cast<Eigen::Index>(d)]);
          there = there && voxel[d] >= 0 && voxel[d] < image.geometry.size[d];
        }
        if (there) values.push_back(image(voxel[0], voxel[1], voxel[2]));
      }
    if (!values.empty()) break;
  }
  return values.empty() ? least_blood_hu : median(values);
}

/// Sets what is within an artery's radius and so much more of its places.
void add_arteries(MaskVolume& mask, const std::vector<ArteryPlace>& arteries, double about_mm) {
  const Geometry& grid = mask.geometry;
  for (const ArteryPlace& each : arteries) {
    const double reach = each.radius_mm + about_mm;
    const Vec3 at = grid.index(each.place);
    std::array<std::int64_t, 3> low{}, high{};
    for (std::size_t d = 0; d < 3; ++d) {
      const double place = at[static_cast<Eigen::Index>(d)];
      const double voxels = reach / grid.spacing[static_cast<Eigen::Index>(d)];
      low[d] = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(place - voxels)));
      high[d] =
          std::min<std::int64_t>(grid.size[d] - 1, static_cast<std::int64_t>(std::floor(place + voxels)));
    }
    for (std::int64_t k = low[2]; k <= high[2]; ++k)
      for (std::int64_t j = low[1]; j <= high[1]; ++j)
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
          const Vec3 voxel(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
          if ((voxel - at).cwiseProduct(grid.spacing).squaredNorm() <= reach * reach) mask(i, j, k) = 1;
        }
  }
}

/// Adds to `heart` the parts of `bright` that begin in it, their necks cut, with their walls: muscle where
/// that is `near`, a little elsewhere.
void add_blood(MaskVolume& heart, const MaskVolume& bright, const ImageVolume& image, const MaskVolume& near,
               double neck_mm) {
  MaskVolume cores = imaging::eroded(bright, neck_mm);
  const imaging::Components parts = imaging::components(cores);
  std::vector<std::uint8_t> begins(parts.voxels.size(), 0);
  for (std::size_t n = 0; n < parts.label.size(); ++n)
    if (heart.voxels[n] != 0) begins[parts.label[n]] = 1;
  begins[0] = 0;
  for (std::size_t n = 0; n < parts.label.size(); ++n) cores.voxels[n] = begins[parts.label[n]];
  const MaskVolume thin = imaging::dilated(cores, neck_mm + thin_wall_mm);
  const MaskVolume thick = imaging::dilated(cores, neck_mm + thick_wall_mm);
  core::parallel_for(heart.voxels.size(), 262144, [&](std::size_t n) {
    const bool muscle = thick.voxels[n] != 0 && near.voxels[n] != 0 && image.voxels[n] >= wall_hu;
    if (thin.voxels[n] != 0 || muscle) heart.voxels[n] = 1;
  });
}

std::vector<Vec3> places_in(const Geometry& grid, const std::vector<ArteryPlace>& arteries) {
  std::vector<Vec3> places;
  for (const ArteryPlace& each : arteries) {
    if (!each.place.allFinite() || !(each.radius_mm >= 0.0) || !std::isfinite(each.radius_mm))
      throw InvalidInput("heart region: an artery has a place or a radius that is not finite");
    if (grid.contains(each.place)) places.push_back(each.place);
  }
  if (places.empty() && !arteries.empty())
    throw InvalidInput("heart region: all arteries lie outside of the image");
  return places;
}

MaskVolume bones_of(const ImageVolume& image, const std::vector<Vec3>& lumen, const core::TaskContext& task) {
  segmentation::TissueOptions tissues;
  tissues.bone = true;
  return imaging::dilated(segmentation::tissues_to_remove(image, lumen, tissues, task), bone_rim_mm);
}

}  // namespace

void validate(const HeartRegionOptions& o) {
  const auto require = [](double value, double most, const char* name) {
    if (!(value >= 0.0 && value <= most))
      throw InvalidInput(std::string("heart region: ") + name + " is " + std::to_string(value) +
                         " mm, it has to be in [0, " + std::to_string(std::lround(most)) + "]");
  };
  require(o.about_tree, 50.0, "about_tree");
  require(o.blood, 150.0, "blood");
  require(o.neck, 10.0, "neck");
  require(o.about_artery, 10.0, "about_artery");
}

MaskVolume heart_region(const ImageVolume& image, const std::vector<ArteryPlace>& arteries,
                        const HeartRegionOptions& options, const core::TaskContext& task) {
  validate(options);
  if (image.voxels.empty()) throw InvalidInput("heart region: the image is empty");
  const Geometry& grid = image.geometry;
  const std::vector<Vec3> lumen = places_in(grid, arteries);
  const MaskVolume bones = bones_of(image, lumen, task.sub(0.0, 0.6));
  task.throw_if_cancelled();
  MaskVolume heart{grid, std::vector<std::uint8_t>(image.voxels.size(), 1)};
  if (!arteries.empty()) {
    heart = inside(hull_about(arteries, options.about_tree), grid);
    MaskVolume bright = inside(hull_about(arteries, options.about_tree + options.blood), grid);
    const double least =
        std::max(least_blood_hu, muscle_hu + faint_share * (blood_hu(image, arteries) - muscle_hu));
    core::parallel_for(bright.voxels.size(), 262144, [&](std::size_t n) {
      if (bones.voxels[n] != 0 || image.voxels[n] < least) bright.voxels[n] = 0;
    });
    task.throw_if_cancelled();
    const MaskVolume near = inside(hull_about(arteries, options.about_tree + apex_mm), grid);
    add_blood(heart, bright, image, near, options.neck);
  }
  core::parallel_for(heart.voxels.size(), 262144, [&](std::size_t n) {
    if (bones.voxels[n] != 0) heart.voxels[n] = 0;
  });
  add_arteries(heart, arteries, options.about_artery);
  task.set_progress(1.0);
  return heart;
}

}  // namespace ostia::coronary
