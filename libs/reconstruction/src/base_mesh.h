#pragma once
/// \file The coarse mesh of quadrilaterals: rings along the branches, joints between them, ends closed.

#include "joint.h"

#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::reconstruction {

enum class Place : std::uint8_t {
  joint,  ///< on the union of the vessels of a joint
  wall,   ///< on one branch, at an abscissa
  rim,    ///< on the edge of an open end
  cap     ///< inside an open end
};

/// Where a point of the mesh belongs.
struct Tag {
  Place place = Place::wall;
  std::int32_t owner = 0;  ///< the joint, or the branch
  double abscissa = 0.0;   ///< of wall and rim, mm
};

struct QuadMesh {
  std::vector<Vec3> points;
  std::vector<Tag> tags;
  std::vector<geometry::Quad> quads;
  std::vector<std::int32_t> branch_of_quad;
  /// Of each tube, between which abscissas its own sections lie, where it has joints: beyond them the wall
  /// is made of circles.
  std::vector<std::array<double, 2>> clear;
  std::vector<std::uint8_t> face_of_quad;  ///< 0 wall, 1 the branch's proximal end, 2 its distal end
  std::vector<std::uint8_t> flat_joints;   ///< of each joint its style's `flat`
  int level = 0;
  /// From level 2 on, of quadrilaterals at flat joints and of their points: they are no longer rounded.
  std::vector<std::uint8_t> flat_quads, fixed_points;
};

/// The ellipse of a place on a tube whose own sections lie within `clear`: near them it becomes a circle.
Stretch clear_stretch(const TubePlace& place, double abscissa, const std::array<double, 2>& clear);
/// Makes the polygon of a section have its circle's area.
double polygon_scale(const ReconstructionOptions& options, int level);
/// Whether the diagonal from the first corner is the shorter one.
bool along_first_diagonal(const QuadMesh& mesh, const geometry::Quad& quad);
/// Two of each quadrilateral, along its shorter diagonal.
std::vector<geometry::Triangle> triangles_of(const QuadMesh& mesh);
/// Of these tubes (ascending); their ends without a joint are closed.
QuadMesh base_mesh(const std::vector<Tube>& tubes, const std::vector<std::int32_t>& wanted,
                   const std::vector<Joint>& joints, const ReconstructionOptions& options);

}  // namespace ostia::reconstruction
