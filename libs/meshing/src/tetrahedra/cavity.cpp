#include "tetrahedra/cavity.h"

#include <algorithm>

namespace ostia::meshing {

using geometry::Vec3;

namespace {
constexpr double margin = 1e-6;           // of quality
constexpr double worth_a_point = 1.5e-3;  // of quality: half a degree at ten degrees
}  // namespace

bool TetrahedraCavity::contract(Id t) {
  const TetrahedraComplex::Corners corners = mesh_.corners(t);
  for (const Id v : corners) {
    if (mesh_.fixed(v)) continue;
    mesh_.star(v, star_);
    double before = 1.0;
    for (const Id s : star_) before = std::min(before, mesh_.quality(s));
    for (const Id w : corners) {
      if (w == v) continue;
      fresh_.clear();
      bool better = true;
      for (std::size_t i = 0; better && i < star_.size(); ++i) {
        if (mesh_.corner_of(star_[i], w) < 4) continue;
        const TetrahedraComplex::Face f = mesh_.face(star_[i], mesh_.corner_of(star_[i], v));
        better = mesh_.quality_with(f, mesh_.point(w)) > std::max(before, 0.0) + margin;
        fresh_.push_back({f[0], f[1], f[2], w});
      }
      if (!better) continue;
      mesh_.replace(star_, fresh_);
      return true;
    }
  }
  return false;
}

bool TetrahedraCavity::inside(Id t) const {
  return std::find(old_.begin(), old_.end(), t) != old_.end();
}

void TetrahedraCavity::begin(const std::vector<Id>& tetrahedra) {
  old_.clear();
  walls_.clear();
  for (const Id t : tetrahedra) swallow(t);
}

void TetrahedraCavity::swallow(Id t) {
  walls_.erase(std::remove_if(walls_.begin(), walls_.end(), [t](const Wall& w) { return w.beyond == t; }),
               walls_.end());
  for (std::size_t f = 0; f < 4; ++f) {
    const Id n = mesh_.neighbour(t, f);
    if (n == TetrahedraComplex::none || !inside(n)) walls_.push_back({mesh_.face(t, f), n});
  }
  old_.push_back(t);
}

std::size_t TetrahedraCavity::worst_wall(const Vec3& p, double& quality) const {
  std::size_t worst = 0;
  quality = 1.0;
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const double q = mesh_.quality_with(walls_[i].face, p);
    if (q < quality) quality = q, worst = i;
  }
  return worst;
}

void TetrahedraCavity::keep_if_best(const Vec3& p, double quality) {
  if (!(quality > best_.quality)) return;
  surroundings_.clear();
  for (const Wall& w : walls_) surroundings_.add(mesh_, w.face);
  if (surroundings_.nearest(p) < nearest_share * surroundings_.mean_edge()) return;
  best_.quality = quality;
  best_.place = p;
  best_.old = old_;
  best_.fresh.clear();
  for (const Wall& w : walls_)
    best_.fresh.push_back({w.face[0], w.face[1], w.face[2], TetrahedraComplex::none});
}

/// The worst of the cavity's tetrahedra gets better only when the one beyond its face joins the cavity, or
/// when the point moves: both in turns.
void TetrahedraCavity::grow(Vec3 p) {
  constexpr int rounds = 5, a_round = 5;
  for (int round = 0; round < rounds; ++round) {
    double quality = 0.0;
    worst_wall(p, quality);
    surroundings_.clear();
    for (const Wall& w : walls_) surroundings_.add(mesh_, w.face);
    quality = surroundings_.search(p, quality);
    keep_if_best(p, quality);
    bool grown = false;
    for (int i = 0; i < a_round && old_.size() < most_tetrahedra; ++i) {
      const Id beyond = walls_[worst_wall(p, quality)].beyond;
      if (beyond == TetrahedraComplex::none) break;
      swallow(beyond);
      grown = true;
    }
    if (!grown) return;
  }
}

bool TetrahedraCavity::insert(Id t) {
  const TetrahedraComplex::Corners c = mesh_.corners(t);
  best_.quality = mesh_.quality(t) + worth_a_point;
  best_.old.clear();
  begin({t});
  grow(0.25 * (mesh_.point(c[0]) + mesh_.point(c[1]) + mesh_.point(c[2]) + mesh_.point(c[3])));
  constexpr std::size_t most_around = 12;
  for (const auto& e : tetrahedron_edges) {
    if (!mesh_.ring(t, c[e[0]], c[e[1]], most_around, star_, around_)) continue;
    begin(star_);
    grow(0.5 * (mesh_.point(c[e[0]]) + mesh_.point(c[e[1]])));
  }
  if (best_.old.empty()) return false;
  const Id p = mesh_.add_point(best_.place);
  for (TetrahedraComplex::Corners& f : best_.fresh) f[3] = p;
  mesh_.replace(best_.old, best_.fresh);
  return true;
}

}  // namespace ostia::meshing
