#pragma once
// Delaunay tetrahedra that grow point by point.

#include "clear_signs.h"

#include "ostia/geometry/vec.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::centerline {

/// Bowyer's and Watson's way (Comput. J. 24, 1981): the cells whose spheres hold a new point go, and their
/// hollow is filled with cells about it. Beyond the hull are cells with a point that is nowhere (`nowhere`).
/// Predicates are exact, and where five points lie on one sphere they are moved off it in mind (see
/// growing_delaunay.cpp): the cells do not depend on the order of the points. Points have to be finite.
class GrowingDelaunay {
 public:
  using Four = std::array<std::int32_t, 4>;
  static constexpr std::int32_t nowhere = -1, gone = -2;

  explicit GrowingDelaunay(const std::vector<geometry::Vec3>& points);

  /// The first cell, of the first four points of `order` that span a volume; false: there are none. The four
  /// are moved to the order's beginning, where `insert` need not be called.
  bool begin(std::vector<std::int32_t>& order);
  /// False: an equal point is there already.
  bool insert(std::int32_t point);

  /// Corners of each cell, positively oriented; with `nowhere` among them beyond the hull, `gone` in front
  /// where there is none in this place.
  const std::vector<Four>& corners() const { return corners_; }
  /// The cell beyond the face opposite corner i.
  std::int32_t neighbour(std::size_t cell, std::size_t i) const { return across_[cell][i] >> 2; }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Site = Kernel::Point_3;
  /// A face of the hollow, as a corner list of the cell on its inner side with the new point in place of the
  /// corner opposite.
  struct Face {
    Four corners;
    std::int32_t apex = 0;     // which of them is the new point
    std::int32_t outside = 0;  // face of the cell beyond
  };
  struct Mark {
    std::uint32_t round = 0;
    std::int32_t value = 0;
  };

  int side(const Four& cell) const;
  int side_with(const Four& cell, std::size_t place, std::int32_t point) const;
  bool in_sphere(const Four& cell, std::int32_t point) const;
  bool conflicts(std::int32_t cell, std::int32_t point) const;
  std::int32_t find(std::int32_t point) const;
  void hollow_out(std::int32_t start, std::int32_t point);
  void fill();
  std::int32_t free_place(std::size_t i);
  void join_round_the_point();
  void join_many_round_the_point();
  void join(std::int32_t face, std::int32_t other);
  std::int32_t number_in_round(std::int32_t corner);

  const Site& site(std::int32_t point) const { return sites_[static_cast<std::size_t>(point)]; }

  std::vector<Site> sites_;
  std::vector<PlainPoint> plain_;       // the same, for signs that are clear
  std::vector<Four> corners_, across_;  // across_: 4 times the neighbour and its face to here
  std::vector<Mark> seen_;              // of a cell: 1 in the hollow, 0 beyond it
  std::vector<Mark> numbers_;           // of a point on the hollow's faces; the last is of `nowhere`
  std::uint32_t round_ = 0;
  std::int32_t numbered_ = 0;
  std::vector<std::int32_t> hollow_, free_, made_;
  std::vector<std::int32_t>
      table_;  // by a directed edge of the hollow's surface: the side of the new cell there
  std::vector<std::array<std::uint8_t, 4>> numbered_corners_;  // of each face
  std::vector<Face> faces_;
  std::int32_t near_ = 0;  // a cell by the last point
};

}  // namespace ostia::centerline
