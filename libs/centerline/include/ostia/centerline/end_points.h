#pragma once
/// \file Where centerlines begin and end: the open ends of a surface, and points given by a user.

#include "ostia/centerline/inner_voronoi.h"
#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::centerline {

/// A hole of the surface.
struct Opening {
  geometry::Vec3 centre = geometry::Vec3::Zero();  ///< barycentre of the border line
  double radius = 0.0;                             ///< of the circle with the border's length, mm
};

/// The openings of a surface, longest border first. Throws GeometryError for a border that is not manifold.
std::vector<Opening> find_openings(const geometry::TriMesh& lumen);
/// The same where geometry::boundary_loops are known.
std::vector<Opening> find_openings(const geometry::TriMesh& lumen,
                                   const std::vector<std::vector<std::int32_t>>& loops);

/// The inscribed sphere that holds a point deepest.
struct Snapped {
  std::int32_t point = -1;  ///< of the diagram
  double depth = 0.0;       ///< how deep inside the sphere, mm; negative outside
};
Snapped snap(const InnerVoronoi& diagram, const geometry::Vec3& query);

/// An end of a centerline as it will be used.
struct EndPoint {
  std::int32_t diagram_point = -1;
  geometry::Vec3 position = geometry::Vec3::Zero();
  bool at_opening = false;  ///< position is an opening's centre, and the line reaches it
};

struct EndPoints {
  EndPoint source;
  std::vector<EndPoint> targets;
  std::vector<std::string> warnings;
};

/// Decides source and targets as `extract_centerlines` describes. Throws InvalidInput or GeometryError that
/// names the point.
EndPoints choose_ends(const InnerVoronoi& diagram, const std::vector<Opening>& openings,
                      const std::optional<geometry::Vec3>& source,
                      const std::vector<geometry::Vec3>& targets);

/// "target 2 (1.5, 0, -3.25) mm": how messages name a point.
std::string describe_point(const std::string& role, const geometry::Vec3& point);

}  // namespace ostia::centerline
