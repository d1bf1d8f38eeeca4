#pragma once
/// \file A volume mesh that has been checked, with what the writers of all formats need of it.

#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

enum class Shape { tetrahedron, prism, triangle, quad };
inline constexpr std::array<Shape, 2> volume_shapes = {Shape::tetrahedron, Shape::prism};
inline constexpr std::array<Shape, 2> facet_shapes = {Shape::triangle, Shape::quad};

/// A format's order of nodes: which of ours (MixedMesh: corners, then the second order) stands at each place.
struct NodeOrder {
  std::array<int, 10> tetrahedron = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  std::array<int, 18> prism = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17};
};

/// VTK's wedge runs the other way round: corners 1 and 2, 4 and 5 change places, and all between them.
inline constexpr NodeOrder vtk_order = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9},
                                        {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13, 17, 16, 15}};
/// Gmsh. Tetrahedron: the last two edges change places. Prism: edges 01 02 03 12 14 25 34 35 45, then 0143
/// 2035 1254.
inline constexpr NodeOrder gmsh_order = {{0, 1, 2, 3, 4, 5, 6, 7, 9, 8},
                                         {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16}};
/// Exodus II and CGNS: the edges between a prism's triangles come before those of the second triangle.
inline constexpr NodeOrder uprights_second_order = {
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11, 15, 16, 17}};

/// A side of an element; tetrahedra are counted first, then prisms. Sides of a tetrahedron: 021 013 123 032;
/// of a prism: 021 345 0143 1254 2035.
struct ElementSide {
  std::int32_t element = -1;
  std::int32_t side = 0;
};
/// A side between two elements; the first has the smaller number.
struct InnerSide {
  ElementSide first, second;
};

/// Behind the title, in the name of what holds the tetrahedra of layers.
inline constexpr const char* layers_suffix = "_layers";

/// A cell array: 1 for these tetrahedra, 0 for the other elements.
inline constexpr const char* layer_array = "layer";

/// Elements of one shape that formats name together.
struct ElementBlock {
  Shape shape;
  bool of_layers;  ///< tetrahedra that were prisms
  std::size_t first, count;
};

struct PreparedMesh {
  const geometry::MixedMesh& mesh;
  std::string title;
  std::vector<std::string> names;  ///< safe, one a face

  /// Boundary facets of each face: indices into the mesh's triangles and quads.
  struct Facets {
    std::vector<std::int32_t> triangles, quads;
    const std::vector<std::int32_t>& of(Shape shape) const {
      return shape == Shape::triangle ? triangles : quads;
    }
    std::size_t size() const { return triangles.size() + quads.size(); }
  };
  std::vector<Facets> facets;
  std::vector<ElementSide> triangle_parents, quad_parents;  ///< whose side each boundary facet is
  std::vector<InnerSide> inner;                             ///< by first element, then by second

  std::size_t layer_tetrahedra = 0;  ///< the last ones

  /// Tetrahedra, those of layers, prisms; none is empty.
  std::vector<ElementBlock> blocks() const;
  /// The title with `_tetrahedra`, `_layers` or `_prisms`.
  std::string name(const ElementBlock& block) const;
  std::vector<std::int32_t> connectivity(const ElementBlock& block, const NodeOrder& order = {}) const;
  std::size_t elements() const { return mesh.tetrahedra.size() + mesh.prisms.size(); }
  std::size_t count(Shape shape) const;
  /// Nodes of one element: 4 or 10, 6 or 18, 3 or 6, 4 or 9.
  std::size_t nodes(Shape shape) const;
  /// Of all elements of one shape, end to end, from 0.
  std::vector<std::int32_t> connectivity(Shape shape, const NodeOrder& order = {}) const;
  /// Of the facets named.
  std::vector<std::int32_t> connectivity(Shape shape, const std::vector<std::int32_t>& facets_named) const;
  const ElementSide& parent(Shape shape, std::int32_t facet) const {
    return (shape == Shape::triangle ? triangle_parents : quad_parents)[static_cast<std::size_t>(facet)];
  }
  /// Corners of a side, outward; the fourth of a triangle is -1.
  std::array<std::int32_t, 4> corners(const ElementSide& side) const;
};

/// Throws InvalidInput as export_mesh does. `mesh` must outlive the result.
PreparedMesh prepare(const geometry::MixedMesh& mesh, const std::string& title,
                     std::size_t layer_tetrahedra = 0);

}  // namespace ostia::io
