#pragma once
/// \file Tetrahedra that know their neighbours, for local changes of their connectivity.

#include "ostia/geometry/tri_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ostia::meshing {

/// Corners of the edges of a tetrahedron.
constexpr std::size_t tetrahedron_edges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/// A tetrahedral mesh in which sets of tetrahedra are exchanged for others that fill the same cavity. Numbers
/// of tetrahedra stay; numbers of points that vanish are not used again.
class TetrahedraComplex {
 public:
  using Id = std::int32_t;
  static constexpr Id none = -1;
  using Corners = geometry::Tetrahedron;
  /// A face seen from inside: {f[0], f[1], f[2], p} has a positive volume for a point p of the inside.
  using Face = std::array<Id, 3>;

  /// The mesh's boundary and whatever points it has are never changed.
  explicit TetrahedraComplex(const geometry::VolumeMesh& mesh);

  std::size_t slots() const { return corners_.size(); }
  std::size_t alive_count() const { return alive_; }
  bool alive(Id t) const { return corners_[at(t)][0] != none; }
  const Corners& corners(Id t) const { return corners_[at(t)]; }
  double quality(Id t) const { return quality_[at(t)]; }
  /// Across the face opposite corner `face`; none at the boundary.
  Id neighbour(Id t, std::size_t face) const { return neighbours_[at(t)][face]; }
  Face face(Id t, std::size_t opposite) const { return face_of(corners(t), opposite); }
  static Face face_of(const Corners& corners, std::size_t opposite);
  std::size_t corner_of(Id t, Id point) const;  ///< 4 when it is none of the corners
  double quality_with(const Face& face, const geometry::Vec3& p) const;
  double quality_of(const Corners& t) const;

  const geometry::Vec3& point(Id v) const { return points_[at(v)]; }
  bool fixed(Id v) const { return fixed_[at(v)] != 0; }
  Id add_point(const geometry::Vec3& p);
  std::size_t point_count() const { return points_.size(); }

  /// The tetrahedra around a point.
  void star(Id v, std::vector<Id>& out);
  /// The tetrahedra around the edge a-b, in order and counter-clockwise seen from b to a, with the points
  /// `around`: tetrahedron i has around[i] and around[i + 1]. Starts with t. False at the boundary's edges,
  /// or with more than `most`.
  bool ring(Id t, Id a, Id b, std::size_t most, std::vector<Id>& tetrahedra, std::vector<Id>& around) const;

  /// Exchanges `old` for `fresh`, which must fill the same cavity. Throws GeometryError where their outer
  /// faces differ. Numbers of the new ones are added to touched().
  void replace(const std::vector<Id>& old, const std::vector<Corners>& fresh);
  /// Moves a point. `star` is all around it, and is added to touched().
  void move(Id v, const geometry::Vec3& p, const std::vector<Id>& star);
  std::vector<Id>& touched() { return touched_; }

  /// The mesh without the points that vanished; the others keep their order.
  void write_to(geometry::VolumeMesh& mesh) const;

 private:
  struct OpenFace {
    std::array<Id, 3> key;
    Id tetrahedron;
    std::size_t face;
  };
  static std::size_t at(Id i) { return static_cast<std::size_t>(i); }
  OpenFace open_face(Id t, std::size_t f) const;
  void find_neighbours();
  void join(const OpenFace& a, const OpenFace& b);
  void close(Id t);
  Id free_slot();

  std::vector<geometry::Vec3> points_;
  std::vector<char> fixed_, used_;
  std::vector<Id> some_tetrahedron_;  // of each point
  std::vector<Corners> corners_, neighbours_;
  std::vector<double> quality_;
  std::vector<std::uint32_t> mark_;
  std::uint32_t stamp_ = 0;
  std::vector<Id> free_, touched_;
  std::vector<OpenFace> open_;
  std::size_t alive_ = 0;
};

}  // namespace ostia::meshing
