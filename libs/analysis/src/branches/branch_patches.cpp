// Patches of a mapped wall.

#include "ostia/analysis/branch_mapping.h"
#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace ostia::analysis {
namespace {

using std::numbers::pi;

constexpr double most_along = 1e5;
// What lies no farther beyond the last border, in patches, is of the patch before it (VMTK leaves it out).
constexpr double no_patch = 1e-3;

/// A corner of a piece of a triangle.
struct PatchCorner {
  Vec3 weights;                // of the triangle's corners
  std::array<double, 2> at{};  // along, around
};
using PatchPolygon = std::vector<PatchCorner>;

PatchCorner corner_between(const PatchCorner& a, const PatchCorner& b, std::size_t axis, double level) {
  const double t = (level - a.at[axis]) / (b.at[axis] - a.at[axis]);
  PatchCorner out;
  out.weights = (1.0 - t) * a.weights + t * b.weights;
  for (std::size_t k = 0; k < 2; ++k) out.at[k] = (1.0 - t) * a.at[k] + t * b.at[k];
  out.at[axis] = level;
  return out;
}

/// The part above a level, or below it.
PatchPolygon clipped(const PatchPolygon& polygon, std::size_t axis, double level, bool above) {
  PatchPolygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PatchCorner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const bool a_in = above ? a.at[axis] >= level : a.at[axis] <= level;
    const bool b_in = above ? b.at[axis] >= level : b.at[axis] <= level;
    if (a_in) out.push_back(a);
    if (a_in != b_in) out.push_back(corner_between(a, b, axis, level));
  }
  return out;
}

/// Calls use(index, piece) for each band of a width that the polygon has a part in.
template <class Use>
void for_bands(const PatchPolygon& polygon, std::size_t axis, double width, const Use& use) {
  double least = INFINITY, most = -INFINITY;
  for (const PatchCorner& corner : polygon) {
    least = std::min(least, corner.at[axis]);
    most = std::max(most, corner.at[axis]);
  }
  const auto first = static_cast<std::int32_t>(std::floor(least / width));
  const auto last = static_cast<std::int32_t>(std::floor(most / width));
  if (first == last) return use(first, polygon);
  for (std::int32_t i = first; i <= last; ++i) {
    const PatchPolygon piece = clipped(clipped(polygon, axis, i * width, true), axis, (i + 1) * width, false);
    if (piece.size() >= 3) use(i, piece);
  }
}

class Patching {
 public:
  explicit Patching(const PatchOptions& options)
      : options_(options), sector_(2.0 * pi / options.sectors), first_(-(options.sectors / 2)) {}

  void add(const MappedBranch& branch, const std::vector<std::vector<double>>& values) {
    for (const std::vector<double>& array : values)
      if (array.size() != branch.mesh.points.size())
        throw InvalidInput("an array for patches has " + std::to_string(array.size()) + " values for " +
                           std::to_string(branch.mesh.points.size()) + " points of branch " +
                           std::to_string(branch.group));
    const auto [least, largest] = std::minmax_element(branch.stretched_mm.begin(), branch.stretched_mm.end());
    if (least != branch.stretched_mm.end() && (*largest - *least) / options_.length_mm > most_along)
      throw InvalidInput("patches of " + std::to_string(options_.length_mm) + " mm along branch " +
                         std::to_string(branch.group) + " would be more than 100,000: make them longer");
    if (branch.mesh.triangles.empty()) return;
    const auto first = static_cast<std::int32_t>(std::floor(*least / options_.length_mm + no_patch));
    const auto last = static_cast<std::int32_t>(std::floor(*largest / options_.length_mm - no_patch));
    for (const geometry::Triangle& t : branch.mesh.triangles) {
      for_bands(
          polygon_of(branch, t), 0, options_.length_mm, [&](std::int32_t along, const PatchPolygon& band) {
            for_bands(band, 1, sector_, [&](std::int32_t around, const PatchPolygon& piece) {
              while (around < first_) around += options_.sectors;
              while (around >= first_ + options_.sectors) around -= options_.sectors;
              add_piece(branch, t, {branch.group, std::clamp(along, first, std::max(first, last)), around},
                        piece, values);
            });
          });
    }
  }

  PatchedWall result() {
    std::vector<std::size_t> becomes(sums_.size());
    for (const auto& [key, index] : index_) {
      becomes[index] = out_.patches.size();
      out_.patches.push_back(std::move(sums_[index]));
      for (double& mean : out_.patches.back().means) mean /= out_.patches.back().area_mm2;
    }
    for (PatchTriangle& triangle : out_.triangles) triangle.patch = becomes[triangle.patch];
    return std::move(out_);
  }

 private:
  using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t>;  // group, along, around

  static PatchPolygon polygon_of(const MappedBranch& branch, const geometry::Triangle& t) {
    PatchPolygon polygon;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(t[k]);
      double around = branch.angle_rad[i];
      // Across the seam the angle goes on.
      if (k > 0 && around - polygon[0].at[1] > pi) around -= 2.0 * pi;
      if (k > 0 && around - polygon[0].at[1] < -pi) around += 2.0 * pi;
      polygon.push_back({Vec3::Unit(static_cast<Eigen::Index>(k)), {branch.stretched_mm[i], around}});
    }
    return polygon;
  }

  void add_piece(const MappedBranch& branch, const geometry::Triangle& t, const Key& key,
                 const PatchPolygon& piece, const std::vector<std::vector<double>>& values) {
    const auto index_of = [&](std::size_t k) { return static_cast<std::size_t>(t[k]); };
    const auto place = [&](const PatchCorner& corner) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t k = 0; k < 3; ++k)
        sum += corner.weights[static_cast<Eigen::Index>(k)] * branch.mesh.points[index_of(k)];
      return sum;
    };
    for (std::size_t i = 2; i < piece.size(); ++i) {
      const std::array<Vec3, 3> corners{place(piece[0]), place(piece[i - 1]), place(piece[i])};
      const double area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
      if (!(area > 0.0)) continue;
      const auto [found, fresh] = index_.try_emplace(key, sums_.size());
      const auto& [group, along, around] = key;
      if (fresh) sums_.push_back({group, along, around, 0.0, std::vector<double>(values.size(), 0.0)});
      WallPatch& sum = sums_[found->second];
      sum.area_mm2 += area;
      const Vec3 centre = (piece[0].weights + piece[i - 1].weights + piece[i].weights) / 3.0;
      for (std::size_t v = 0; v < values.size(); ++v)
        for (std::size_t k = 0; k < 3; ++k)
          sum.means[v] += area * centre[static_cast<Eigen::Index>(k)] * values[v][index_of(k)];
      out_.triangles.push_back({found->second, corners});
    }
  }

  PatchOptions options_;
  double sector_;
  std::int32_t first_;  // sector
  std::map<Key, std::size_t> index_;
  std::vector<WallPatch> sums_;
  PatchedWall out_;
};

}  // namespace

void validate(const PatchOptions& options) {
  if (!(options.length_mm > 0.0) || !std::isfinite(options.length_mm))
    throw InvalidInput("patches: length_mm is " + std::to_string(options.length_mm) + "; give more than 0");
  if (options.sectors < 1)
    throw InvalidInput("patches: sectors is " + std::to_string(options.sectors) + "; give 1 or more");
}

PatchedWall patch_branches(const MappedWall& wall,
                           const std::vector<std::vector<std::vector<double>>>& values,
                           const PatchOptions& options, const core::TaskContext& task) {
  validate(options);
  if (values.size() != wall.branches.size())
    throw InvalidInput("patches: arrays of " + std::to_string(values.size()) + " branches for " +
                       std::to_string(wall.branches.size()) + " branches");
  Patching patching(options);
  for (std::size_t i = 0; i < wall.branches.size(); ++i) {
    task.throw_if_cancelled();
    patching.add(wall.branches[i], values[i]);
    task.set_progress(static_cast<double>(i + 1) / static_cast<double>(wall.branches.size()));
  }
  return patching.result();
}

}  // namespace ostia::analysis
