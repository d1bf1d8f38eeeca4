#pragma once
/// \file Which sides of elements meet which, and which are the boundary's.

#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::meshing {

/// Three or four corners (the fourth is -1), outward.
using SideCorners = std::array<std::int32_t, 4>;

/// A side of an element (tetrahedra counted first, then prisms), or a facet of the boundary (triangles
/// counted first, then quadrilaterals).
struct Side {
  std::int32_t owner = -1;  ///< element, or facet
  std::int32_t side = -1;   ///< of the element; -1 for a facet
  bool facet() const { return side < 0; }
};
std::size_t side_count(const geometry::MixedMesh& mesh, std::size_t element);  ///< 4 or 5
SideCorners corners_of(const geometry::MixedMesh& mesh, const Side& side);
/// +1 where b runs as a, -1 where it runs against it, 0 where they are different sides.
int same_way(const SideCorners& a, const SideCorners& b);
/// Whether a facet has the second-order nodes of the element's side; true in a linear mesh.
bool same_nodes(const geometry::MixedMesh& mesh, const Side& element, const Side& facet);

/// All sides and facets, those with the same corners together.
class SideTable {
 public:
  explicit SideTable(const geometry::MixedMesh& mesh);
  std::size_t points() const { return first_.size() - 1; }
  /// Calls visit(first, last) for each set of sides with the same corners of which `point` is the lowest.
  template <class Visit>
  void for_each_group(std::size_t point, const Visit& visit) const {
    for (std::size_t i = first_[point]; i < first_[point + 1];) {
      std::size_t j = i + 1;
      while (j < first_[point + 1] && entries_[j].others == entries_[i].others) ++j;
      visit(&entries_[i], &entries_[i] + (j - i));
      i = j;
    }
  }

  struct Entry {
    std::array<std::int32_t, 3> others;  // corners but the lowest, ascending; -1 first for a triangle
    Side side;
  };

 private:
  std::vector<std::size_t> first_;
  std::vector<Entry> entries_;
};

}  // namespace ostia::meshing
