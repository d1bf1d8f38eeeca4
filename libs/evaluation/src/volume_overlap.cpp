#include "ostia/evaluation/volume_overlap.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>

namespace ostia::evaluation {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

struct Stretch {
  double from = 0.0, to = 0.0;
};

struct Volumes {
  double reference = 0.0, result = 0.0, both = 0.0;
  Volumes operator+(const Volumes& o) const {
    return {reference + o.reference, result + o.result, both + o.both};
  }
};

VolumeOverlap overlap_of(const Volumes& v) {
  if (!(v.reference + v.result > 0.0))
    throw InvalidInput("both volumes are empty: there is no overlap to speak of");
  VolumeOverlap out{v.reference, v.result, v.both, 0.0, 0.0, 0.0};
  out.dice = 2.0 * v.both / (v.reference + v.result);
  out.jaccard = v.both / (v.reference + v.result - v.both);
  out.relative_difference = (v.result - v.reference) / v.reference;
  return out;
}

void require_closed(const TriMesh& mesh, const char* what) {
  if (mesh.triangles.empty()) throw InvalidInput(std::string("the ") + what + " has no triangle");
  const geometry::SurfaceFaults faults = geometry::find_faults(mesh, false);
  if (faults.open_edges > 0)
    throw InvalidInput(std::string("the ") + what + " is open (" + std::to_string(faults.open_edges) +
                       " open edges): it encloses no volume; `ostia convert --repair` or a closed surface");
}

/// Turns the lines' direction onto z. The direction is tilted against all axes: vessels, phantoms and voxels
/// run along these, and a line along a wall is either wholly inside or not at all.
geometry::Mat3 turn() {
  const Vec3 along = Vec3(0.485, 0.318, 0.815).normalized();
  const Vec3 across = Vec3(0.83, -0.53, 0.17).cross(along).normalized();
  geometry::Mat3 rows;
  rows.row(0) = across;
  rows.row(1) = along.cross(across);
  rows.row(2) = along;
  return rows;
}

TriMesh turned(TriMesh mesh, const geometry::Mat3& by) {
  for (Vec3& p : mesh.points) p = by * p;
  return mesh;
}

/// Where a line runs inside: between places where the number of surfaces entered rises above nothing.
std::vector<Stretch> inside(const geometry::AabbTree& tree, const TriMesh& mesh, const Vec3& start) {
  std::vector<Stretch> out;
  int depth = 0;
  double from = 0.0;
  for (const geometry::RayHit& hit : tree.all_hits(start, Vec3::UnitZ())) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(hit.triangle)];
    const Vec3 a = mesh.points[static_cast<std::size_t>(t[0])];
    const Vec3 n = (mesh.points[static_cast<std::size_t>(t[1])] - a)
                       .cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
    const int before = depth;
    depth += n.z() < 0.0 ? 1 : -1;
    if (before <= 0 && depth > 0) from = hit.t;
    if (before > 0 && depth <= 0) out.push_back({from, hit.t});
  }
  return out;
}

double length_of(const std::vector<Stretch>& all) {
  double sum = 0.0;
  for (const Stretch& i : all) sum += i.to - i.from;
  return sum;
}

std::vector<Stretch> shared(const std::vector<Stretch>& a, const std::vector<Stretch>& b) {
  std::vector<Stretch> out;
  for (const Stretch& i : a)
    for (const Stretch& j : b)
      if (std::min(i.to, j.to) > std::max(i.from, j.from))
        out.push_back({std::max(i.from, j.from), std::min(i.to, j.to)});
  return out;
}

/// The parts of intervals where a place counts, in pieces of `step`.
std::vector<Stretch> counted(const std::vector<Stretch>& all, const Vec3& start, double step,
                             const Region& counts) {
  if (!counts) return all;
  std::vector<Stretch> out;
  for (const Stretch& i : all) {
    const auto pieces = static_cast<int>(std::ceil((i.to - i.from) / step));
    const double piece = (i.to - i.from) / std::max(pieces, 1);
    for (int k = 0; k < pieces; ++k) {
      const double from = i.from + k * piece;
      if (counts(start + (from + 0.5 * piece) * Vec3::UnitZ())) out.push_back({from, from + piece});
    }
  }
  return out;
}

}  // namespace

VolumeOverlap compare_masks(const imaging::MaskVolume& reference, const imaging::MaskVolume& result) {
  if (!imaging::same_grid(reference.geometry, result.geometry))
    throw InvalidInput("the two masks lie on different grids: other sizes, spacings, origins or axes");
  const double voxel = reference.geometry.spacing.prod();
  Volumes v;
  for (std::size_t i = 0; i < reference.voxels.size(); ++i) {
    const bool a = reference.voxels[i] != 0, b = result.voxels[i] != 0;
    v.reference += a;
    v.result += b;
    v.both += a && b;
  }
  return overlap_of({v.reference * voxel, v.result * voxel, v.both * voxel});
}

VolumeOverlap compare_enclosed(const TriMesh& given_reference, const TriMesh& given_result,
                               double resolution_mm, const Region& given_counts,
                               const core::TaskContext& task) {
  if (!(resolution_mm > 0.0)) throw InvalidInput("the resolution must be positive");
  require_closed(given_reference, "reference");
  require_closed(given_result, "result");
  const geometry::Mat3 by = turn();
  const TriMesh reference = turned(given_reference, by), result = turned(given_result, by);
  Region counts;
  if (given_counts) counts = [&](const Vec3& p) { return given_counts(by.transpose() * p); };
  geometry::Box3 box = geometry::bounds(reference.points);
  box.extend(geometry::bounds(result.points));
  const auto nx = static_cast<std::size_t>(std::ceil(box.sizes().x() / resolution_mm)) + 1;
  const auto ny = static_cast<std::size_t>(std::ceil(box.sizes().y() / resolution_mm)) + 1;
  if (nx * ny > 400'000'000)
    throw InvalidInput("the resolution of " + std::to_string(resolution_mm) +
                       " mm is too fine for surfaces of this size");
  const geometry::AabbTree a(reference), b(result);
  const Volumes sum = core::parallel_reduce(
      ny, 4, Volumes{},
      [&](std::size_t first, std::size_t last) {
        task.throw_if_cancelled();
        Volumes part;
        for (std::size_t j = first; j < last; ++j) {
          for (std::size_t i = 0; i < nx; ++i) {
            const Vec3 start(box.min().x() + (static_cast<double>(i) + 0.5) * resolution_mm,
                             box.min().y() + (static_cast<double>(j) + 0.5) * resolution_mm,
                             box.min().z() - 1.0);
            const auto ia = inside(a, reference, start), ib = inside(b, result, start);
            const double step = 0.5 * resolution_mm;
            part.reference += length_of(counted(ia, start, step, counts));
            part.result += length_of(counted(ib, start, step, counts));
            part.both += length_of(counted(shared(ia, ib), start, step, counts));
          }
        }
        return part;
      },
      [](const Volumes& x, const Volumes& y) { return x + y; });
  const double cell = resolution_mm * resolution_mm;
  return overlap_of({sum.reference * cell, sum.result * cell, sum.both * cell});
}

}  // namespace ostia::evaluation
