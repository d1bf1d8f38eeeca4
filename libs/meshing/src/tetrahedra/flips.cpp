#include "tetrahedra/flips.h"

#include "tetrahedra/quality.h"

#include <algorithm>

namespace ostia::meshing {

namespace {
constexpr double flip_margin = 1e-6;  // of quality, so that no exchange is undone by round-off
}  // namespace

bool TetrahedraFlips::improve(Id t) {
  const TetrahedraComplex::Corners corners = mesh_.corners(t);
  for (const auto& e : tetrahedron_edges)
    if (remove_edge(t, corners[e[0]], corners[e[1]])) return true;
  for (std::size_t f = 0; f < 4; ++f)
    if (remove_face(t, f)) return true;
  return false;
}

double TetrahedraFlips::least_quality(const std::vector<Id>& tetrahedra) const {
  double least = 1.0;
  for (const Id t : tetrahedra) least = std::min(least, mesh_.quality(t));
  return least;
}

/// Of the two tetrahedra on a triangle of the ring's polygon.
double TetrahedraFlips::triangle_quality(std::size_t i, std::size_t k, std::size_t j, double at_least) const {
  const TetrahedraComplex::Face above{around_[i], around_[k], around_[j]},
      below{around_[i], around_[j], around_[k]};
  const double upper = mesh_.quality_with(above, mesh_.point(b_));
  if (upper <= at_least) return upper;
  return std::min(upper, mesh_.quality_with(below, mesh_.point(a_)));
}

void TetrahedraFlips::collect(const Choice& choice, std::size_t i, std::size_t j) {
  if (j < i + 2) return;
  const std::size_t k = choice[i][j];
  fresh_.push_back({around_[i], around_[k], around_[j], b_});
  fresh_.push_back({around_[i], around_[j], around_[k], a_});
  collect(choice, i, k);
  collect(choice, k, j);
}

bool TetrahedraFlips::find_ring(Id t, Id a, Id b) {
  a_ = a, b_ = b;
  return mesh_.ring(t, a, b, most_around, old_, around_) && old_.size() >= 3;
}

/// The best triangulation of the ring's polygon, if all its tetrahedra are above `floor`.
bool TetrahedraFlips::fill_ring(double floor) {
  const std::size_t n = around_.size();
  Table best;
  Choice choice{};
  for (std::size_t i = 0; i + 1 < n; ++i) best[i][i + 1] = 1.0;
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t j = i + span;
      best[i][j] = floor;
      for (std::size_t k = i + 1; k < j; ++k) {
        const double parts = std::min(best[i][k], best[k][j]);
        if (parts <= best[i][j]) continue;
        const double q = std::min(parts, triangle_quality(i, k, j, best[i][j]));
        if (q > best[i][j]) best[i][j] = q, choice[i][j] = k;
      }
    }
  if (!(best[0][n - 1] > floor)) return false;
  fresh_.clear();
  collect(choice, 0, n - 1);
  return true;
}

bool TetrahedraFlips::remove_edge(Id t, Id a, Id b) {
  if (!find_ring(t, a, b) || !fill_ring(least_quality(old_) + flip_margin)) return false;
  mesh_.replace(old_, fresh_);
  return true;
}

bool TetrahedraFlips::plan_edge_removal(Id t, Id a, Id b, double floor) {
  return find_ring(t, a, b) && fill_ring(floor);
}

/// The side u-w of the faces taken so far: either it stays, with the tetrahedron on it and the new edge, or
/// the face beyond it, if it lies between the same two points, is taken too. Returns the better's quality.
double TetrahedraFlips::open_side(Id top, Id bottom, Id u, Id w) {
  const double stays = mesh_.quality_of({b_, a_, u, w});
  const std::size_t olds = old_.size(), freshes = fresh_.size();
  const auto beyond = [&](Id t, Id apex) {
    const TetrahedraComplex::Corners& c = mesh_.corners(t);
    for (std::size_t i = 0; i < 4; ++i)
      if (c[i] != apex && c[i] != u && c[i] != w) return mesh_.neighbour(t, i);
    return TetrahedraComplex::none;
  };
  const Id next_top = beyond(top, a_), next_bottom = beyond(bottom, b_);
  constexpr std::size_t most = 20;
  if (next_top != TetrahedraComplex::none && next_bottom != TetrahedraComplex::none && olds < most &&
      mesh_.neighbour(next_top, mesh_.corner_of(next_top, a_)) == next_bottom &&
      std::find(old_.begin(), old_.end(), next_top) == old_.end()) {
    Id x = TetrahedraComplex::none;
    for (const Id v : mesh_.corners(next_top))
      if (v != a_ && v != u && v != w) x = v;
    old_.insert(old_.end(), {next_top, next_bottom});
    double taken = open_side(next_top, next_bottom, u, x);
    if (taken > stays) taken = std::min(taken, open_side(next_top, next_bottom, x, w));
    if (taken > stays) return taken;
    old_.resize(olds);
    fresh_.resize(freshes);
  }
  fresh_.push_back({b_, a_, u, w});
  return stays;
}

bool TetrahedraFlips::open_face(Id t, std::size_t opposite, double floor) {
  const Id other = mesh_.neighbour(t, opposite);
  const TetrahedraComplex::Face face = mesh_.face(t, opposite);
  a_ = mesh_.corners(t)[opposite];
  for (std::size_t i = 0; i < 4; ++i)
    if (mesh_.neighbour(other, i) == t) b_ = mesh_.corners(other)[i];
  old_ = {t, other};
  fresh_.clear();
  for (std::size_t i = 0; i < 3; ++i)
    if (open_side(t, other, face[i], face[(i + 1) % 3]) <= floor) return false;
  return true;
}

bool TetrahedraFlips::remove_face(Id t, std::size_t opposite) {
  const Id other = mesh_.neighbour(t, opposite);
  if (other == TetrahedraComplex::none ||
      !open_face(t, opposite, std::min(mesh_.quality(t), mesh_.quality(other))))
    return false;
  double after = 1.0;
  for (const TetrahedraComplex::Corners& c : fresh_) after = std::min(after, mesh_.quality_of(c));
  if (!(after > least_quality(old_) + flip_margin)) return false;
  mesh_.replace(old_, fresh_);
  return true;
}

bool TetrahedraFlips::plan_face_removal(Id t, std::size_t opposite, double floor) {
  return mesh_.neighbour(t, opposite) != TetrahedraComplex::none && open_face(t, opposite, floor);
}

}  // namespace ostia::meshing
