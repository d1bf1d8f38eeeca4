#pragma once
/// \file Connected sets of a surface's triangles that may be caps.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/flat_caps.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace ostia::meshing {

constexpr std::size_t fewest_on_rim = 6;  // edges: four corners are a flat spot of a rough wall

/// An edge between two triangles.
struct SharedEdge {
  std::int32_t a, b;         ///< its points
  std::int32_t left, right;  ///< its triangles; right < 0 on a border
};

/// What is looked at once for all candidates.
struct Look {
  const geometry::TriMesh& mesh;
  std::vector<SharedEdge> edges;
  std::vector<geometry::Vec3> normals;  ///< unit; zero for a triangle without area

  explicit Look(const geometry::TriMesh& m);
  double angle_deg(const SharedEdge& e) const;
};

/// A connected set of triangles that may be a cap.
struct Region {
  std::vector<std::int32_t> triangles;
  std::vector<std::size_t> rim;  ///< of Look::edges
  double area_mm2 = 0.0, rim_mm = 0.0, rim_deg = 0.0, deviation_mm = 0.0;
  double flat_area_mm2 = 0.0;  ///< seen along its normal
  bool one_loop = false, on_border = false;
  GivenEnd end;
};

geometry::Vec3 doubled_area(const geometry::TriMesh& mesh, std::int32_t triangle);

/// Triangles joined across the edges that `same` accepts.
std::vector<Region> regions(const Look& look, const std::function<bool(const SharedEdge&)>& same);

void measure(const Look& look, Region& region);

/// Whether it is flat, about round and within one rim.
bool is_flat(const Region& region, const FlatCapOptions& options);

/// Whether the lumen behind it is about as wide as the region: a bump of a rough wall has its own width only
/// as far as it is high. `tree` holds the surface.
bool is_as_wide_as_lumen(const geometry::AabbTree& tree, const GivenEnd& end);

/// What labels say.
struct LabelledCaps {
  std::vector<Region> caps;
  std::vector<LabelNotTaken> not_taken;
};

/// A label is a cap's where each of its pieces is flat, or domed or shaken within limits, has one rim all
/// round and is as wide as the lumen behind it; pieces of next to nothing belong to what is about them.
LabelledCaps caps_by_label(const Look& look, const geometry::FacedSurface& surface,
                           const FlatCapOptions& options);

}  // namespace ostia::meshing
