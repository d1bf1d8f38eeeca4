#pragma once
/// \file A triangle surface that can be edited: half-edges in groups of three.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace ostia::meshing {

/// Half-edge 3 f + i runs from corner i of face f to corner (i + 1) mod 3. An oriented manifold surface with
/// or without borders. Removed vertices and faces stay as holes in the numbering until `compact`.
class EditMesh {
 public:
  static constexpr std::int32_t none = -1;

  /// Throws GeometryError when the mesh is not manifold or not consistently oriented. Unused points become
  /// dead vertices.
  explicit EditMesh(const geometry::TriMesh& mesh);

  std::vector<geometry::Vec3> points;

  static std::int32_t face(std::int32_t h) { return h / 3; }
  static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::int32_t prev(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::int32_t origin(std::int32_t h) const { return origin_[static_cast<std::size_t>(h)]; }
  std::int32_t target(std::int32_t h) const { return origin(next(h)); }
  std::int32_t twin(std::int32_t h) const { return twin_[static_cast<std::size_t>(h)]; }
  /// A half-edge from v; of a border vertex the one without a twin. `none` for a dead vertex.
  std::int32_t out(std::int32_t v) const { return out_[static_cast<std::size_t>(v)]; }

  std::int32_t vertex_count() const { return static_cast<std::int32_t>(points.size()); }
  std::int32_t half_edge_count() const { return static_cast<std::int32_t>(origin_.size()); }
  std::int32_t face_count() const { return half_edge_count() / 3; }
  std::size_t live_faces() const { return live_faces_; }
  bool alive_face(std::int32_t f) const { return origin_[static_cast<std::size_t>(3 * f)] != none; }
  bool alive(std::int32_t h) const { return origin_[static_cast<std::size_t>(h)] != none; }
  bool alive_vertex(std::int32_t v) const { return out(v) != none; }
  bool border(std::int32_t v) const { return twin(out(v)) == none; }
  /// One half-edge of each edge: the one of lower number, or the one without a twin.
  bool canonical(std::int32_t h) const { return alive(h) && (twin(h) == none || h < twin(h)); }

  /// Calls visit(h) for each half-edge that starts at v, counter-clockwise.
  template <class Visit>
  void around(std::int32_t v, const Visit& visit) const {
    const std::int32_t start = out(v);
    std::int32_t h = start;
    do {
      visit(h);
      h = twin(prev(h));
    } while (h != none && h != start);
  }
  std::int32_t valence(std::int32_t v) const;  ///< number of neighbours
  bool connected(std::int32_t a, std::int32_t b) const;
  geometry::Vec3 area_normal(std::int32_t f) const;  ///< twice the area times the unit normal
  double length(std::int32_t h) const { return (at(target(h)) - at(origin(h))).norm(); }
  const geometry::Vec3& at(std::int32_t v) const { return points[static_cast<std::size_t>(v)]; }

  bool can_flip(std::int32_t h) const;
  void flip(std::int32_t h);
  /// A new vertex at p on the edge.
  std::int32_t split(std::int32_t h, const geometry::Vec3& p);
  /// May origin(h) go into target(h) and the surface stay a manifold of the same kind?
  bool can_collapse(std::int32_t h) const;
  void collapse(std::int32_t h);

  /// The live part; `old_vertices` receives the former number of each point.
  geometry::TriMesh compact(std::vector<std::int32_t>* old_vertices = nullptr,
                            std::vector<std::int32_t>* old_faces = nullptr) const;

 private:
  std::int32_t& origin_of(std::int32_t h) { return origin_[static_cast<std::size_t>(h)]; }
  void pair(std::int32_t a, std::int32_t b);
  void settle_out(std::int32_t v, std::int32_t h);
  std::int32_t add_face(std::int32_t a, std::int32_t b, std::int32_t c);
  std::vector<std::int32_t> origin_, twin_, out_;
  std::vector<std::int32_t> free_faces_;
  std::size_t live_faces_ = 0;
};

}  // namespace ostia::meshing
