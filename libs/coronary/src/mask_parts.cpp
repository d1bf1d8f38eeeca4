#include "mask_parts.h"

#include "mask_rim.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/imaging/morphology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace ostia::coronary {
namespace {

using imaging::MaskVolume;
using VoxelIndex = std::array<std::int64_t, 3>;

constexpr double coarse_voxel_mm = 1.2;  // on which aorta and chambers are sought
constexpr std::int64_t margin_voxels = 8;
constexpr double least_left_mm3 = 30.0;  // 10 mm of a vessel of 2 mm
constexpr double rind_share = 0.2;       // of a part that touches what was too thick: its rind, and no vessel

struct VoxelBox {
  VoxelIndex lower{0, 0, 0}, upper{0, 0, 0};  // [lower, upper)
  bool empty() const { return upper[0] <= lower[0]; }
};

VoxelBox object_box(const MaskVolume& mask, std::int64_t& count) {
  const VoxelIndex& size = mask.geometry.size;
  VoxelBox box{size, {0, 0, 0}};
  count = 0;
  std::size_t n = 0;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i, ++n) {
        if (mask.voxels[n] == 0) continue;
        ++count;
        const VoxelIndex at{i, j, k};
        for (std::size_t d = 0; d < 3; ++d) {
          box.lower[d] = std::min(box.lower[d], at[d]);
          box.upper[d] = std::max(box.upper[d], at[d] + 1);
        }
      }
  return box;
}

/// The box of a mask with background about it, beyond the image's border, too.
MaskVolume boxed(const MaskVolume& mask, const VoxelBox& box) {
  MaskVolume out;
  out.geometry = mask.geometry;
  Vec3 corner = Vec3::Zero();
  for (std::size_t d = 0; d < 3; ++d) {
    out.geometry.size[d] = box.upper[d] - box.lower[d] + 2 * margin_voxels;
    corner[static_cast<Eigen::Index>(d)] = static_cast<double>(box.lower[d] - margin_voxels);
  }
  out.geometry.origin = mask.geometry.world(corner);
  out.voxels.assign(static_cast<std::size_t>(out.geometry.voxels()), 0);
  for (std::int64_t k = box.lower[2]; k < box.upper[2]; ++k)
    for (std::int64_t j = box.lower[1]; j < box.upper[1]; ++j)
      for (std::int64_t i = box.lower[0]; i < box.upper[0]; ++i)
        out(i - box.lower[0] + margin_voxels, j - box.lower[1] + margin_voxels,
            k - box.lower[2] + margin_voxels) = mask(i, j, k);
  return out;
}

/// Blocks of voxels of which at least half are object.
struct CoarseMask {
  MaskVolume mask;
  VoxelIndex block{1, 1, 1};
};
CoarseMask coarsened(const MaskVolume& mask) {
  CoarseMask out;
  for (std::size_t d = 0; d < 3; ++d) {
    const double spacing = mask.geometry.spacing[static_cast<Eigen::Index>(d)];
    out.block[d] = std::max<std::int64_t>(1, std::lround(coarse_voxel_mm / spacing));
    out.mask.geometry.size[d] = (mask.geometry.size[d] + out.block[d] - 1) / out.block[d];
    out.mask.geometry.spacing[static_cast<Eigen::Index>(d)] = spacing * static_cast<double>(out.block[d]);
  }
  out.mask.geometry.direction = mask.geometry.direction;
  std::vector<std::int32_t> inside(static_cast<std::size_t>(out.mask.geometry.voxels()), 0);
  for (std::int64_t k = 0; k < mask.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < mask.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < mask.geometry.size[0]; ++i)
        if (mask(i, j, k) != 0)
          ++inside[static_cast<std::size_t>(
              out.mask.geometry.offset(i / out.block[0], j / out.block[1], k / out.block[2]))];
  const std::int64_t whole = out.block[0] * out.block[1] * out.block[2];
  for (const std::int32_t n : inside) out.mask.voxels.push_back(2 * n >= whole ? 1 : 0);
  return out;
}

double voxel_mm3(const imaging::Geometry& grid) {
  return grid.spacing.prod();
}

/// Calls visit on the 26 neighbours within the grid.
template <class Visit>
void for_all_neighbours(const imaging::Geometry& grid, std::int64_t n, const Visit& visit) {
  const VoxelIndex at{n % grid.size[0], n / grid.size[0] % grid.size[1], n / (grid.size[0] * grid.size[1])};
  for (std::int64_t k = -1; k <= 1; ++k)
    for (std::int64_t j = -1; j <= 1; ++j)
      for (std::int64_t i = -1; i <= 1; ++i) {
        const VoxelIndex to{at[0] + i, at[1] + j, at[2] + k};
        bool inside = i != 0 || j != 0 || k != 0;
        for (std::size_t d = 0; d < 3; ++d) inside = inside && to[d] >= 0 && to[d] < grid.size[d];
        if (inside) visit(grid.offset(to[0], to[1], to[2]));
      }
}

/// Takes out what holds a large ball, and what lies about that within a coarse voxel. Marks it with 1.
std::vector<std::uint8_t> thick_voxels(const MaskVolume& mask, double radius_mm) {
  std::vector<std::uint8_t> thick(mask.voxels.size(), 0);
  const CoarseMask coarse = coarsened(mask);
  const MaskVolume core = imaging::eroded(coarse.mask, radius_mm);
  if (std::none_of(core.voxels.begin(), core.voxels.end(), [](std::uint8_t v) { return v != 0; }))
    return thick;
  const MaskVolume grown = imaging::dilated(core, radius_mm + coarse_voxel_mm);
  std::size_t n = 0;
  for (std::int64_t k = 0; k < mask.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < mask.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < mask.geometry.size[0]; ++i, ++n)
        thick[n] =
            mask.voxels[n] != 0 && grown(i / coarse.block[0], j / coarse.block[1], k / coarse.block[2]) != 0
                ? 1
                : 0;
  return thick;
}

struct VoxelPart {
  std::vector<std::int64_t> voxels;
  double extent_mm = 0.0;
  Vec3 middle = Vec3::Zero();
};

std::vector<VoxelPart> connected_parts(const MaskVolume& mask) {
  std::vector<std::uint8_t> seen(mask.voxels.size(), 0);
  std::vector<VoxelPart> parts;
  const imaging::Geometry& grid = mask.geometry;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (mask.voxels[first] == 0 || seen[first] != 0) continue;
    VoxelPart part;
    part.voxels.push_back(static_cast<std::int64_t>(first));
    seen[first] = 1;
    geometry::Box3 box;
    for (std::size_t n = 0; n < part.voxels.size(); ++n) {
      const std::int64_t v = part.voxels[n];
      const Vec3 at = grid.world(Vec3(static_cast<double>(v % grid.size[0]),
                                      static_cast<double>(v / grid.size[0] % grid.size[1]),
                                      static_cast<double>(v / (grid.size[0] * grid.size[1]))));
      box.extend(at);
      part.middle += at;
      for_all_neighbours(grid, v, [&](std::int64_t m) {
        const auto to = static_cast<std::size_t>(m);
        if (mask.voxels[to] == 0 || seen[to] != 0) return;
        seen[to] = 1;
        part.voxels.push_back(m);
      });
    }
    part.middle /= static_cast<double>(part.voxels.size());
    part.extent_mm = box.diagonal().norm() + grid.spacing.maxCoeff();
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Where a part touches the thick one.
struct Contact {
  std::vector<Vec3> places;  // the middle of each
  double share = 0.0;        // of its voxels
};
Contact contact_of(const MaskVolume& lumen, const std::vector<std::uint8_t>& thick, const VoxelPart& part) {
  MaskVolume rim{lumen.geometry, std::vector<std::uint8_t>(lumen.voxels.size(), 0)};
  std::int64_t voxels = 0;
  for (const std::int64_t v : part.voxels) {
    bool touches = false;
    for_all_neighbours(lumen.geometry, v,
                       [&](std::int64_t m) { touches = touches || thick[static_cast<std::size_t>(m)] != 0; });
    if (!touches) continue;
    rim.voxels[static_cast<std::size_t>(v)] = 1;
    ++voxels;
  }
  Contact contact;
  if (voxels == 0) return contact;
  contact.share = static_cast<double>(voxels) / static_cast<double>(part.voxels.size());
  for (const VoxelPart& one : connected_parts(rim)) contact.places.push_back(one.middle);
  return contact;
}

std::string millilitres(double mm3) {
  return core::rounded_text(mm3 / 1000.0, mm3 < 10000.0 ? 1 : 0) + " ml";
}

void refuse_what_is_left(const MaskParts& parts, double left_mm3, double object_mm3) {
  if (left_mm3 >= least_left_mm3 && left_mm3 >= 0.002 * object_mm3) return;
  if (parts.thick_mm3 > 0.5 * object_mm3)
    throw GeometryError(
        "the mask holds no vessels: " + millilitres(parts.thick_mm3) + " of its " + millilitres(object_mm3) +
        " are thicker than coronary arteries are, as in an organ, a chamber or a mask that is "
        "full; export the label of the coronary arteries, with voxels in mm");
  throw GeometryError(
      "the mask holds specks alone, " + core::rounded_text(object_mm3, 1) +
      " mm3 in all, and no vessel; look whether the right label was exported, with voxels in mm");
}

}  // namespace

std::string place_in_words(const Vec3& place) {
  return core::rounded_text(place.x(), 1) + "," + core::rounded_text(place.y(), 1) + "," +
         core::rounded_text(place.z(), 1) + " mm (LPS)";
}

MaskParts parts_of_mask(const MaskVolume& labels, const MaskTreeOptions& options,
                        const core::TaskContext& task) {
  if (labels.voxels.empty() || static_cast<std::int64_t>(labels.voxels.size()) != labels.geometry.voxels())
    throw InvalidInput("tree of a mask: its geometry does not fit its " +
                       std::to_string(labels.voxels.size()) + " voxels");
  MaskParts parts;
  const VoxelBox box = object_box(labels, parts.object_voxels);
  if (box.empty())
    throw InvalidInput("the mask is empty: all its " + std::to_string(labels.voxels.size()) +
                       " voxels are 0; look whether the right label was exported");
  parts.lumen = boxed(labels, box);
  task.throw_if_cancelled();
  const double voxel = voxel_mm3(labels.geometry);
  const std::vector<std::uint8_t> thick = thick_voxels(parts.lumen, options.thick_mm);
  task.throw_if_cancelled();
  for (std::size_t n = 0; n < thick.size(); ++n) {
    if (thick[n] == 0) continue;
    parts.lumen.voxels[n] = 0;
    parts.thick_mm3 += voxel;
  }
  const double thick_mm3 = parts.thick_mm3;
  int specks = 0;
  double specks_mm3 = 0.0, left_mm3 = 0.0, largest = 0.0;
  Vec3 largest_at = Vec3::Zero();
  for (const VoxelPart& part : connected_parts(parts.lumen)) {
    const double mm3 = voxel * static_cast<double>(part.voxels.size());
    const Contact contact = thick_mm3 > 0.0 ? contact_of(parts.lumen, thick, part) : Contact{};
    if (contact.share > rind_share) {
      parts.thick_mm3 += mm3;
    } else if (part.extent_mm >= options.speck_mm) {
      left_mm3 += mm3;
      parts.contacts.insert(parts.contacts.end(), contact.places.begin(), contact.places.end());
      continue;
    } else {
      ++specks;
      specks_mm3 += mm3;
      if (mm3 > largest) largest = mm3, largest_at = part.middle;
    }
    for (const std::int64_t v : part.voxels) parts.lumen.voxels[static_cast<std::size_t>(v)] = 0;
  }
  const double object_mm3 = voxel * static_cast<double>(parts.object_voxels);
  refuse_what_is_left(parts, left_mm3, object_mm3);
  if (parts.thick_mm3 > 0.0)
    parts.warnings.push_back("a part of " + millilitres(parts.thick_mm3) +
                             " is thicker than arteries are (aorta or a chamber) and was left out");
  if (specks > 0)
    parts.warnings.push_back(std::to_string(specks) + (specks == 1 ? " speck" : " specks") + " of " +
                             core::rounded_text(specks_mm3, 1) + " mm3 in all " +
                             (specks == 1 ? "was" : "were") + " left out, the largest, " +
                             core::rounded_text(largest, 1) + " mm3, at " + place_in_words(largest_at));
  if (smooth_rough_rim(parts.lumen, task))
    parts.warnings.emplace_back(
        "the mask's rim is as rough as noise is; it was made smooth, with as many voxels as before");
  return parts;
}

}  // namespace ostia::coronary
