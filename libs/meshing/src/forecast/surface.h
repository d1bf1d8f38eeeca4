#pragma once
/// \file What the forecast knows of a surface, and how flagged points become places.

#include "ostia/geometry/aabb_tree.h"
#include "ostia/meshing/mesh_forecast.h"

#include <functional>
#include <utility>
#include <vector>

namespace ostia::meshing {

/// An edge with the triangles along it.
struct SurfaceEdge {
  std::int32_t a = -1, b = -1;  ///< a < b
  std::vector<std::int32_t> triangles;
  int balance = 0;  ///< triangles that run from a to b less those that run from b to a
};

/// An inlet or outlet: a cap or an open flat end.
struct SurfaceEnd {
  std::string name;
  std::vector<std::int32_t> points;
  geometry::Vec3 centre = geometry::Vec3::Zero();
  double diameter_mm = 0.0;  ///< of the circle of the same area
};

struct ForecastSurface {
  ForecastSurface(const geometry::FacedSurface& faced, const ForecastOptions& options,
                  const core::TaskContext& task);

  const geometry::TriMesh& mesh;
  const ForecastOptions& options;
  std::vector<char> wall;  ///< of each triangle
  std::vector<std::vector<std::int32_t>> neighbours, triangles_of;
  std::vector<geometry::Vec3> normals;    ///< of points
  std::vector<SurfaceEdge> faulty_edges;  ///< those of other than two triangles, or of two turned ones
  std::vector<SurfaceEnd> ends;           ///< caps; open ends are added as they are found
  geometry::AabbTree tree;
  std::vector<double> edge_mm;  ///< target at each point; as given, also where it makes no sense

  const geometry::Vec3& point(std::int32_t v) const { return mesh.points[static_cast<std::size_t>(v)]; }
  geometry::Vec3 area(std::size_t triangle) const;  ///< vector, mm2
  bool on_wall(std::size_t point) const;            ///< all its triangles are the wall's
};

/// Points that are flagged, joined where neighbours or `links` join them; each set with its worst point
/// first. `badness` orders: the larger the worse.
std::vector<std::vector<std::int32_t>> clusters(
    const ForecastSurface& surface, const std::vector<char>& flagged, const std::vector<double>& badness,
    const std::vector<std::pair<std::int32_t, std::int32_t>>& links = {});

/// A place about a set of points, the first of which is the worst; triangles are those with a point of it.
ForecastPlace place_at(const ForecastSurface& surface, TroubleKind kind, bool fails,
                       const std::vector<std::int32_t>& points);

/// Adds the first `max_places`; the last one tells how many more there are.
void add_places(std::vector<ForecastPlace> found, const ForecastOptions& options,
                std::vector<ForecastPlace>& places);

std::string millimetres(double value);  ///< "0.05 mm"
/// "1 open edge", "2 open edges".
std::string counted(std::size_t count, const std::string& one, const std::string& many);

// The looks, each of which adds what it finds.
void look_at_edges(ForecastSurface& surface, std::vector<ForecastPlace>& places);
void look_at_orientation(const ForecastSurface& surface, std::vector<ForecastPlace>& places);
void look_at_crossings(const ForecastSurface& surface, std::vector<ForecastPlace>& places);

/// Distances along normals at the wall's points, mm; infinite where nothing is seen.
struct WallDistances {
  std::vector<double> across;   ///< inward, to the wall opposite
  std::vector<double> outside;  ///< outward, to a wall that faces this one
  std::vector<std::int32_t> outside_triangle;
};
WallDistances wall_distances(const ForecastSurface& surface, const core::TaskContext& task);
/// True where the numbers cannot be mm: then sizes mean nothing.
bool look_at_units(const ForecastSurface& surface, const WallDistances& distances,
                   std::vector<ForecastPlace>& places);
void look_at_sizes(const ForecastSurface& surface, const WallDistances& distances,
                   std::vector<ForecastPlace>& places);
void look_at_neighbours(const ForecastSurface& surface, const WallDistances& distances,
                        std::vector<ForecastPlace>& places);
void look_at_layers(const ForecastSurface& surface, std::vector<ForecastPlace>& places,
                    const core::TaskContext& task);

}  // namespace ostia::meshing
