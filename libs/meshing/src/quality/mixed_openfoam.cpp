// Formulas of OpenFOAM's primitiveMesh: makeFaceCentresAndAreas, makeCellCentresAndVols, faceOrthogonality,
// faceSkewness, boundaryFaceSkewness, cellClosedness.
#include "quality/mixed_openfoam.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::meshing {

using geometry::MixedMesh;
using geometry::Vec3;

namespace {

constexpr std::size_t side_grain = 4096;
constexpr double tiny = 1e-150;  // OpenFOAM's ROOTVSMALL

struct FaceGeometry {
  Vec3 centre = Vec3::Zero(), area = Vec3::Zero();
};

FaceGeometry geometry_of(const MixedMesh& mesh, const SideCorners& corners) {
  const auto at = [&](std::size_t i) -> const Vec3& {
    return mesh.points[static_cast<std::size_t>(corners[i])];
  };
  if (corners[3] < 0) return {(at(0) + at(1) + at(2)) / 3.0, 0.5 * (at(1) - at(0)).cross(at(2) - at(0))};
  // A quadrilateral is four triangles about the mean of its corners.
  const Vec3 middle = (at(0) + at(1) + at(2) + at(3)) / 4.0;
  Vec3 sum = Vec3::Zero(), weighted = Vec3::Zero();
  double areas = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &a = at(i), &b = at((i + 1) % 4);
    const Vec3 normal = (b - a).cross(middle - a);
    const double size = normal.norm();
    sum += normal;
    areas += size;
    weighted += size * (a + b + middle);
  }
  return {areas < tiny ? middle : Vec3(weighted / (3.0 * areas)), 0.5 * sum};
}

struct Cells {
  std::vector<Vec3> centres;
  std::vector<double> volumes;
};

struct CellSums {
  double aspect = 0.0, openness = 0.0, volume = 0.0;
  double least = std::numeric_limits<double>::infinity(), largest = -std::numeric_limits<double>::infinity();
};

void measure_cell(const MixedMesh& mesh, std::size_t e, Cells& cells, CellSums& sums) {
  std::array<FaceGeometry, 5> faces;
  const std::size_t n = side_count(mesh, e);
  Vec3 estimate = Vec3::Zero(), magnitudes = Vec3::Zero(), closed = Vec3::Zero();
  for (std::size_t s = 0; s < n; ++s) {
    faces[s] =
        geometry_of(mesh, corners_of(mesh, {static_cast<std::int32_t>(e), static_cast<std::int32_t>(s)}));
    estimate += faces[s].centre / static_cast<double>(n);
    magnitudes += faces[s].area.cwiseAbs();
    closed += faces[s].area;
  }
  Vec3 moment = Vec3::Zero();
  double volume = 0.0;  // three times
  for (std::size_t s = 0; s < n; ++s) {
    const double pyramid = faces[s].area.dot(faces[s].centre - estimate);
    moment += pyramid * (0.75 * faces[s].centre + 0.25 * estimate);
    volume += pyramid;
  }
  cells.centres[e] = std::abs(volume) > tiny * tiny ? Vec3(moment / volume) : estimate;
  cells.volumes[e] = volume /= 3.0;
  const double by_components = magnitudes.maxCoeff() / (magnitudes.minCoeff() + tiny);
  const double by_area = magnitudes.sum() / 6.0 / std::pow(std::max(tiny, volume), 2.0 / 3.0);
  sums.aspect = std::max({sums.aspect, by_components, by_area});
  sums.openness =
      std::max(sums.openness, (closed.cwiseAbs().array() / (magnitudes.array() + tiny)).maxCoeff());
  sums.volume += volume;
  sums.least = std::min(sums.least, volume);
  sums.largest = std::max(sums.largest, volume);
}

CellSums measure_cells(const MixedMesh& mesh, Cells& cells, const core::TaskContext& task) {
  const std::size_t count = mesh.tetrahedra.size() + mesh.prisms.size();
  cells.centres.resize(count);
  cells.volumes.resize(count);
  return core::parallel_reduce(
      count, side_grain, CellSums{},
      [&](std::size_t first, std::size_t last) {
        task.throw_if_cancelled();
        CellSums sums;
        for (std::size_t e = first; e < last; ++e) measure_cell(mesh, e, cells, sums);
        return sums;
      },
      [](const CellSums& a, const CellSums& b) {
        return CellSums{std::max(a.aspect, b.aspect), std::max(a.openness, b.openness), a.volume + b.volume,
                        std::min(a.least, b.least), std::max(a.largest, b.largest)};
      });
}

/// `across`: from the cell's centre to its neighbour's, or to the boundary.
double skewness(const MixedMesh& mesh, const SideCorners& corners, const FaceGeometry& face,
                const Vec3& centre, const Vec3& across, double share) {
  const Vec3 to_face = face.centre - centre;
  const Vec3 skew = to_face - (face.area.dot(to_face) / (face.area.dot(across) + tiny)) * across;
  const double size = skew.norm();
  const Vec3 direction = skew / (size + tiny);
  double reach = share * across.norm() + tiny;
  for (const std::int32_t corner : corners)
    if (corner >= 0)
      reach = std::max(reach,
                       std::abs(direction.dot(mesh.points[static_cast<std::size_t>(corner)] - face.centre)));
  return size / reach;
}

struct SideSums {
  double least_cosine = 1.0, cosines = 0.0, skewness = 0.0, volume_ratio = 1.0;
  std::size_t inner = 0, severe = 0, mismatches = 0;
  Vec3 least_orthogonal_at = Vec3::Zero(), most_skewed_at = Vec3::Zero(), mismatch_at = Vec3::Zero();

  void skewed(double value, const Vec3& at) {
    if (value > skewness) skewness = value, most_skewed_at = at;
  }
  void cosine(double value, const Vec3& at) {
    if (value < least_cosine) least_cosine = value, least_orthogonal_at = at;
  }
  void mismatch(const Vec3& at) {
    if (mismatches++ == 0) mismatch_at = at;
  }
  friend SideSums operator+(SideSums a, const SideSums& b) {
    a.cosine(b.least_cosine, b.least_orthogonal_at);
    a.skewed(b.skewness, b.most_skewed_at);
    if (a.mismatches == 0) a.mismatch_at = b.mismatch_at;
    a.mismatches += b.mismatches;
    a.cosines += b.cosines;
    a.volume_ratio = std::min(a.volume_ratio, b.volume_ratio);
    a.inner += b.inner;
    a.severe += b.severe;
    return a;
  }
};

void measure_inner(const MixedMesh& mesh, const Cells& cells, const Side& own, const Side& other,
                   SideSums& sums) {
  static const double severe = std::cos(70.0 * std::numbers::pi / 180.0);
  const SideCorners corners = corners_of(mesh, own);
  const FaceGeometry face = geometry_of(mesh, corners);
  const auto a = static_cast<std::size_t>(own.owner), b = static_cast<std::size_t>(other.owner);
  const Vec3 across = cells.centres[b] - cells.centres[a];
  const double cosine = across.dot(face.area) / (across.norm() * face.area.norm() + tiny);
  sums.cosines += cosine;
  ++sums.inner;
  if (cosine < severe) ++sums.severe;
  sums.cosine(cosine, face.centre);
  sums.skewed(skewness(mesh, corners, face, cells.centres[a], across, 0.2), face.centre);
  const double va = std::abs(cells.volumes[a]), vb = std::abs(cells.volumes[b]);
  sums.volume_ratio = std::min(sums.volume_ratio, std::min(va, vb) / (std::max(va, vb) + tiny * tiny));
}

void measure_outer(const MixedMesh& mesh, const Cells& cells, const Side& side, SideSums& sums) {
  const SideCorners corners = corners_of(mesh, side);
  const FaceGeometry face = geometry_of(mesh, corners);
  const Vec3& centre = cells.centres[static_cast<std::size_t>(side.owner)];
  const Vec3 normal = face.area / (face.area.norm() + tiny);
  const Vec3 across = normal.dot(face.centre - centre) * normal;
  sums.skewed(skewness(mesh, corners, face, centre, across, 0.4), face.centre);
}

void measure_group(const MixedMesh& mesh, const Cells& cells, const SideTable::Entry* first,
                   const SideTable::Entry* last, SideSums& sums) {
  // Facets come before the sides of elements.
  const auto* sides = std::find_if(first, last, [](const auto& entry) { return !entry.side.facet(); });
  const auto facets = sides - first, elements = last - sides;
  const SideCorners corners = corners_of(mesh, first->side);
  bool matches = false;
  if (elements == 2 && facets == 0) {
    // The cell with the lower number owns the face, as in a polyMesh.
    const bool in_order = sides[0].side.owner < sides[1].side.owner;
    measure_inner(mesh, cells, sides[in_order ? 0 : 1].side, sides[in_order ? 1 : 0].side, sums);
    matches = same_way(corners, corners_of(mesh, sides[1].side)) == -1;
  } else if (elements == 1) {
    measure_outer(mesh, cells, sides->side, sums);
    matches = facets == 1 && same_way(corners, corners_of(mesh, sides->side)) == 1 &&
              same_nodes(mesh, sides->side, first->side);
  }
  if (!matches) sums.mismatch(geometry_of(mesh, corners).centre);
}

}  // namespace

namespace {

double angle_deg(double cosine) {
  return 180.0 / std::numbers::pi * std::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

void measure_sides_of_elements(const MixedMesh& mesh, std::vector<double>& non_orthogonality_deg,
                               std::vector<double>& skewness_of, const core::TaskContext& task) {
  Cells cells;
  measure_cells(mesh, cells, task);
  non_orthogonality_deg.assign(cells.volumes.size(), 0.0);
  skewness_of.assign(cells.volumes.size(), 0.0);
  task.set_progress(0.3);
  const SideTable table(mesh);
  task.set_progress(0.7);
  // One after another: elements have sides in several groups.
  for (std::size_t i = 0; i < table.points(); ++i) {
    if (i % side_grain == 0) task.throw_if_cancelled();
    table.for_each_group(i, [&](const SideTable::Entry* begin, const SideTable::Entry* end) {
      SideSums sums;
      measure_group(mesh, cells, begin, end, sums);
      for (const auto* entry = begin; entry != end; ++entry) {
        if (entry->side.facet()) continue;
        const auto e = static_cast<std::size_t>(entry->side.owner);
        non_orthogonality_deg[e] = std::max(non_orthogonality_deg[e], angle_deg(sums.least_cosine));
        skewness_of[e] = std::max(skewness_of[e], sums.skewness);
      }
    });
  }
  task.set_progress(1.0);
}

void measure_sides(const MixedMesh& mesh, MixedQuality& quality, const core::TaskContext& task) {
  Cells cells;
  const CellSums cell_sums = measure_cells(mesh, cells, task);
  task.set_progress(0.3);
  const SideTable table(mesh);
  task.set_progress(0.7);
  const SideSums sums = core::parallel_reduce(
      table.points(), side_grain, SideSums{},
      [&](std::size_t first, std::size_t last) {
        task.throw_if_cancelled();
        SideSums part;
        for (std::size_t i = first; i < last; ++i)
          table.for_each_group(i, [&](const SideTable::Entry* begin, const SideTable::Entry* end) {
            measure_group(mesh, cells, begin, end, part);
          });
        return part;
      },
      [](const SideSums& a, const SideSums& b) { return a + b; });
  OpenFoamQuality& q = quality.openfoam;
  if (sums.inner > 0) {
    q.max_non_orthogonality_deg = angle_deg(sums.least_cosine);
    // Of the mean cosine, as checkMesh has it.
    q.mean_non_orthogonality_deg = angle_deg(sums.cosines / static_cast<double>(sums.inner));
  }
  q.severely_non_orthogonal = sums.severe;
  q.max_skewness = sums.skewness;
  q.min_volume_ratio = sums.volume_ratio;
  q.least_orthogonal_at = sums.least_orthogonal_at;
  q.most_skewed_at = sums.most_skewed_at;
  q.max_aspect_ratio = cell_sums.aspect;
  q.max_openness = cell_sums.openness;
  q.volume_mm3 = cell_sums.volume;
  if (!cells.volumes.empty()) {
    q.min_volume_mm3 = cell_sums.least;
    q.max_volume_mm3 = cell_sums.largest;
  }
  quality.boundary_mismatches = sums.mismatches;
  quality.mismatch_at = sums.mismatch_at;
  task.set_progress(1.0);
}

}  // namespace ostia::meshing
