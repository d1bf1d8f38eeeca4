#include "growing_delaunay.h"

#include <algorithm>
#include <tuple>

namespace ostia::centerline {
namespace {

using geometry::Vec3;

// Beyond so many points around a hollow pairs of its edges are found by sorting.
constexpr std::size_t widest_table = 64;

std::size_t slot(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

// The corners beside i and j, in an order such that j, i and they are an even permutation: the two cells at a
// face with the new point name its other two corners in opposite orders.
constexpr std::array<std::array<std::array<std::uint8_t, 2>, 4>, 4> other_two = [] {
  std::array<std::array<std::array<std::uint8_t, 2>, 4>, 4> table{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      if (i == j) continue;
      std::array<std::size_t, 4> order{j, i, 0, 0};
      std::size_t place = 2;
      for (std::size_t k = 0; k < 4; ++k)
        if (k != i && k != j) order[place++] = k;
      int inversions = 0;
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b) inversions += order[a] > order[b];
      if (inversions % 2 != 0) std::swap(order[2], order[3]);
      table[i][j] = {static_cast<std::uint8_t>(order[2]), static_cast<std::uint8_t>(order[3])};
    }
  return table;
}();

constexpr std::array<std::array<std::uint8_t, 3>, 4> other_three{
    {{{1, 2, 3}}, {{0, 2, 3}}, {{0, 1, 3}}, {{0, 1, 2}}}};

bool has_nowhere(const GrowingDelaunay::Four& cell) {
  return (cell[0] | cell[1] | cell[2] | cell[3]) < 0;
}

}  // namespace

GrowingDelaunay::GrowingDelaunay(const std::vector<Vec3>& points)
    : numbers_(points.size() + 1), table_(widest_table * widest_table) {
  constexpr std::size_t cells_a_point = 9;
  sites_.reserve(points.size());
  plain_.reserve(points.size());
  for (const Vec3& p : points) {
    sites_.emplace_back(p.x(), p.y(), p.z());
    plain_.push_back({p.x(), p.y(), p.z()});
  }
  corners_.reserve(cells_a_point * points.size());
  across_.reserve(cells_a_point * points.size());
  seen_.reserve(cells_a_point * points.size());
}

int GrowingDelaunay::side(const Four& cell) const {
  const auto plain = [&](std::size_t k) -> const PlainPoint& { return plain_[slot(cell[k])]; };
  if (const int clear = clear_orientation(plain(0), plain(1), plain(2), plain(3)); clear != 0) return clear;
  return Kernel().orientation_3_object()(site(cell[0]), site(cell[1]), site(cell[2]), site(cell[3]));
}

int GrowingDelaunay::side_with(const Four& cell, std::size_t place, std::int32_t point) const {
  Four corners = cell;
  corners[place] = point;
  return side(corners);
}

// Where the five lie on one sphere, the paraboloid to which Delaunay's points are lifted is raised at each of
// them, infinitely more at the one that is last in the order of coordinates than at the one before it
// (Devillers and Teillaud, Perturbations and vertex removal in a 3D Delaunay triangulation, SODA 2003). The
// last for which that makes a difference decides: `point` itself is raised out of the sphere; a corner raises
// the sphere's plane on the side where it is itself.
bool GrowingDelaunay::in_sphere(const Four& cell, std::int32_t point) const {
  const auto plain = [&](std::int32_t p) -> const PlainPoint& { return plain_[slot(p)]; };
  int place =
      clear_side_of_sphere(plain(cell[0]), plain(cell[1]), plain(cell[2]), plain(cell[3]), plain(point));
  if (place == 0)
    place = Kernel().side_of_oriented_sphere_3_object()(site(cell[0]), site(cell[1]), site(cell[2]),
                                                        site(cell[3]), site(point));
  if (place != 0) return place > 0;
  std::array<std::size_t, 5> order{0, 1, 2, 3, 4};
  const auto five = [&](std::size_t k) -> const Site& { return site(k < 4 ? cell[k] : point); };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return five(b) < five(a); });
  for (const std::size_t k : order) {
    if (k == 4) return false;
    if (const int turn = side_with(cell, k, point); turn != 0) return turn > 0;
  }
  return false;
}

bool GrowingDelaunay::conflicts(std::int32_t cell, std::int32_t point) const {
  const Four& corners = corners_[slot(cell)];
  if (!has_nowhere(corners)) return in_sphere(corners, point);
  const auto none = static_cast<std::size_t>(std::ranges::find(corners, nowhere) - corners.begin());
  if (const int beyond = side_with(corners, none, point); beyond != 0) return beyond > 0;
  // In the hull's plane the sphere of the cell inside is the circle about the face.
  return in_sphere(corners_[slot(neighbour(slot(cell), none))], point);
}

bool GrowingDelaunay::begin(std::vector<std::int32_t>& order) {
  const auto at = [&](std::size_t i) -> const Site& { return site(order[i]); };
  const auto move_to_front = [&](std::size_t from, std::size_t to) {
    std::rotate(order.begin() + static_cast<std::ptrdiff_t>(to),
                order.begin() + static_cast<std::ptrdiff_t>(from),
                order.begin() + static_cast<std::ptrdiff_t>(from) + 1);
  };
  const auto take = [&](std::size_t to, const auto& fits) {
    for (std::size_t i = to; i < order.size(); ++i)
      if (fits(i)) return move_to_front(i, to), true;
    return false;
  };
  const Kernel kernel;
  if (order.size() < 4 || !take(1, [&](std::size_t i) { return at(i) != at(0); }) ||
      !take(2, [&](std::size_t i) { return !kernel.collinear_3_object()(at(0), at(1), at(i)); }) ||
      !take(3, [&](std::size_t i) { return !kernel.coplanar_3_object()(at(0), at(1), at(2), at(i)); }))
    return false;
  Four first{order[0], order[1], order[2], order[3]};
  if (side(first) < 0) std::swap(first[2], first[3]);
  corners_ = {first};
  for (std::size_t i = 0; i < 4; ++i) {
    // Two corners change places: seen from beyond a face the cell lies on its other side.
    Four beyond = first;
    beyond[i] = nowhere;
    std::swap(beyond[i == 0 ? 1 : 0], beyond[i < 2 ? 2 : 1]);
    corners_.push_back(beyond);
  }
  across_.assign(corners_.size(), {});
  // Each two of the five share a face: what each has alone is opposite it.
  const auto alone = [&](std::size_t cell, std::size_t other) {
    std::size_t i = 0;
    while (std::ranges::find(corners_[other], corners_[cell][i]) != corners_[other].end()) ++i;
    return static_cast<std::int32_t>(4 * cell + i);
  };
  for (std::size_t a = 0; a < corners_.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) join(alone(a, b), alone(b, a));
  seen_.assign(corners_.size(), {});
  near_ = 0;
  return true;
}

// Walks from cell to cell towards the point. Returns a cell that has to go, or -1 where the point is there
// already. Ways through Delaunay's cells have no circles (Edelsbrunner, Combinatorica 10, 1990).
std::int32_t GrowingDelaunay::find(std::int32_t point) const {
  std::int32_t cell = near_, from = -1;
  for (bool moved = true; moved;) {
    moved = false;
    const Four& corners = corners_[slot(cell)];
    if (has_nowhere(corners)) return cell;
    for (std::int32_t i = 0; i < 4 && !moved; ++i) {
      if (i == from) continue;
      if (side_with(corners, slot(i), point) >= 0) continue;
      const std::int32_t to = across_[slot(cell)][slot(i)];
      cell = to >> 2;
      from = to & 3;
      moved = true;
    }
  }
  const auto equal = [&](std::int32_t corner) { return site(corner) == site(point); };
  return std::ranges::any_of(corners_[slot(cell)], equal) ? -1 : cell;
}

void GrowingDelaunay::hollow_out(std::int32_t start, std::int32_t point) {
  ++round_;
  hollow_ = {start};
  faces_.clear();
  seen_[slot(start)] = {round_, 1};
  for (std::size_t k = 0; k < hollow_.size(); ++k) {
    const std::int32_t cell = hollow_[k];
    for (std::int32_t i = 0; i < 4; ++i) {
      const std::int32_t outside = across_[slot(cell)][slot(i)], next = outside >> 2;
      Mark& mark = seen_[slot(next)];
      if (mark.round != round_) {
        mark = {round_, conflicts(next, point) ? 1 : 0};
        if (mark.value != 0) hollow_.push_back(next);
      }
      if (mark.value != 0) continue;
      Face& face = faces_.emplace_back(Face{corners_[slot(cell)], i, outside});
      face.corners[slot(i)] = point;
    }
  }
}

std::int32_t GrowingDelaunay::free_place(std::size_t i) {
  if (i < hollow_.size()) return hollow_[i];
  if (!free_.empty()) {
    const std::int32_t place = free_.back();
    free_.pop_back();
    return place;
  }
  corners_.emplace_back();
  across_.emplace_back();
  seen_.emplace_back();
  return static_cast<std::int32_t>(corners_.size() - 1);
}

void GrowingDelaunay::join(std::int32_t face, std::int32_t other) {
  across_[slot(face >> 2)][slot(face & 3)] = other;
  across_[slot(other >> 2)][slot(other & 3)] = face;
}

void GrowingDelaunay::fill() {
  made_.clear();
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const std::int32_t cell = free_place(i);
    corners_[slot(cell)] = faces_[i].corners;
    seen_[slot(cell)] = {};
    join(4 * cell + faces_[i].apex, faces_[i].outside);
    made_.push_back(cell);
    if (!has_nowhere(faces_[i].corners)) near_ = cell;
  }
  for (std::size_t i = faces_.size(); i < hollow_.size(); ++i) {
    corners_[slot(hollow_[i])].fill(gone);
    free_.push_back(hollow_[i]);
  }
  // A closed surface of triangles has twice as many of them as points, less four.
  if (faces_.size() / 2 + 2 <= widest_table)
    join_round_the_point();
  else
    join_many_round_the_point();
}

std::int32_t GrowingDelaunay::number_in_round(std::int32_t corner) {
  Mark& mark = corner == nowhere ? numbers_.back() : numbers_[slot(corner)];
  if (mark.round != round_) mark = {round_, numbered_++};
  return mark.value;
}

// Each edge of the hollow's surface lies between two of the new cells, which name its ends in opposite
// orders. First all write where they are, then each reads who is beyond: nothing depends on who came first,
// which a processor could not guess.
void GrowingDelaunay::join_round_the_point() {
  numbered_ = 0;
  numbered_corners_.resize(std::max(numbered_corners_.size(), faces_.size()));
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const std::size_t apex = slot(face.apex);
    std::array<std::uint8_t, 4>& number = numbered_corners_[f];
    for (const std::size_t k : other_three[apex])
      number[k] = static_cast<std::uint8_t>(number_in_round(face.corners[k]));
    for (const std::size_t k : other_three[apex]) {
      const auto [a, b] = other_two[apex][k];
      table_[std::size_t{number[a]} * widest_table + number[b]] = 4 * made_[f] + static_cast<std::int32_t>(k);
    }
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const std::size_t apex = slot(faces_[f].apex);
    const std::array<std::uint8_t, 4>& number = numbered_corners_[f];
    Four& across = across_[slot(made_[f])];
    for (const std::size_t k : other_three[apex]) {
      const auto [a, b] = other_two[apex][k];
      across[k] = table_[std::size_t{number[b]} * widest_table + number[a]];
    }
  }
}

void GrowingDelaunay::join_many_round_the_point() {
  std::vector<std::tuple<std::int32_t, std::int32_t, std::int32_t>> edges;
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (std::size_t j = 0; j < 4; ++j) {
      if (static_cast<std::int32_t>(j) == faces_[f].apex) continue;
      const auto [a, b] = other_two[slot(faces_[f].apex)][j];
      const auto [low, high] = std::minmax(faces_[f].corners[a], faces_[f].corners[b]);
      edges.emplace_back(low, high, 4 * made_[f] + static_cast<std::int32_t>(j));
    }
  std::ranges::sort(edges);
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
    join(std::get<2>(edges[i]), std::get<2>(edges[i + 1]));
}

bool GrowingDelaunay::insert(std::int32_t point) {
  const std::int32_t start = find(point);
  if (start < 0) return false;
  hollow_out(start, point);
  fill();
  return true;
}

}  // namespace ostia::centerline
