#include "tetrahedra/orthogonality.h"

#include "tetrahedra/smoothing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

constexpr double worth_it = 1e-3;         // of the cosine: a fifteenth of a degree at 60 degrees
constexpr std::size_t most_points = 200;  // added in all; a few are ever needed

}  // namespace

TetrahedraOrthogonality::Pair TetrahedraOrthogonality::pair(Id t, std::size_t opposite, Id other) const {
  Pair out{mesh_.face(t, opposite), mesh_.corners(t)[opposite], TetrahedraComplex::none};
  for (const Id v : mesh_.corners(other))
    if (v != out.face[0] && v != out.face[1] && v != out.face[2]) out.second = v;
  return out;
}

// The centres differ by a quarter of what the two points opposite the face do.
double TetrahedraOrthogonality::cosine(const Pair& pair, Id moved, const Vec3& p) const {
  const auto at = [&](Id v) -> const Vec3& { return v == moved ? p : mesh_.point(v); };
  const Vec3& a = at(pair.face[0]);
  const Vec3 normal = (at(pair.face[1]) - a).cross(at(pair.face[2]) - a);
  const Vec3 across = at(pair.first) - at(pair.second);
  const double lengths = normal.norm() * across.norm();
  return lengths > 0.0 ? normal.dot(across) / lengths : -1.0;
}

double TetrahedraOrthogonality::cosine(Id t, std::size_t opposite) const {
  const Id other = mesh_.neighbour(t, opposite);
  if (other == TetrahedraComplex::none) return 1.0;
  return cosine(pair(t, opposite, other), TetrahedraComplex::none, Vec3::Zero());
}

void TetrahedraOrthogonality::gather(Id v) {
  mesh_.star(v, star_);
  pairs_.clear();
  hull_.clear();
  for (const Id t : star_)
    for (std::size_t i = 0; i < 4; ++i) {
      const bool outer = mesh_.corners(t)[i] == v;
      if (outer) hull_.push_back(mesh_.face(t, i));
      const Id other = mesh_.neighbour(t, i);
      // A face at the point is met from both sides.
      if (other != TetrahedraComplex::none && (outer || t < other)) pairs_.push_back(pair(t, i, other));
    }
}

double TetrahedraOrthogonality::least_cosine(Id v, const Vec3& p, double give_up) const {
  double least = 1.0;
  for (const Pair& one : pairs_) {
    least = std::min(least, cosine(one, v, p));
    if (least <= give_up) break;
  }
  return least;
}

bool TetrahedraOrthogonality::keeps_quality(const Vec3& p, double floor) const {
  return std::all_of(hull_.begin(), hull_.end(), [&](const TetrahedraComplex::Face& face) {
    return mesh_.quality_with(face, p) >= floor;
  });
}

bool TetrahedraOrthogonality::move(Id v) {
  if (mesh_.fixed(v)) return false;
  gather(v);
  if (star_.empty()) return false;
  double floor = least_quality_;
  for (const Id t : star_) floor = std::min(floor, mesh_.quality(t));
  Vec3 place = mesh_.point(v), middle = Vec3::Zero();
  double reach = std::numeric_limits<double>::infinity();
  for (const TetrahedraComplex::Face& face : hull_)
    for (const Id w : face) {
      reach = std::min(reach, (mesh_.point(w) - place).norm());
      middle += mesh_.point(w) / (3.0 * static_cast<double>(hull_.size()));
    }
  const double before = least_cosine(v, place, -1.0);
  double best = before;
  const auto attempt = [&](const Vec3& p) {
    const double now = least_cosine(v, p, best);
    if (!(now > best) || !keeps_quality(p, floor)) return false;
    best = now;
    place = p;
    return true;
  };
  pattern_search(place, middle, reach, attempt);
  if (!(best > before + worth_it)) return false;
  mesh_.move(v, place, star_);
  return true;
}

/// Of all faces of tetrahedra that fill the place of a cavity's, the cavity's own included.
double TetrahedraOrthogonality::least_cosine(
    const std::vector<Id>& cavity, const std::vector<TetrahedraComplex::Corners>& tetrahedra) const {
  struct Side {
    std::array<Id, 3> key;
    Pair pair;
  };
  std::vector<Side> sides;  // seen from one side so far
  const auto key_of = [](TetrahedraComplex::Face face) {
    std::sort(face.begin(), face.end());
    return face;
  };
  double least = 1.0;
  const auto meet = [&](const Pair& one) {
    const auto key = key_of(one.face);
    const auto other = std::find_if(sides.begin(), sides.end(), [&](const Side& s) { return s.key == key; });
    if (other == sides.end()) {
      sides.push_back({key, one});
      return;
    }
    Pair both = one;
    both.second = other->pair.first;
    least = std::min(least, cosine(both, TetrahedraComplex::none, Vec3::Zero()));
  };
  for (const TetrahedraComplex::Corners& c : tetrahedra)
    for (std::size_t i = 0; i < 4; ++i)
      meet({TetrahedraComplex::face_of(c, i), c[i], TetrahedraComplex::none});
  for (const Id t : cavity)
    for (std::size_t i = 0; i < 4; ++i) {
      const Id n = mesh_.neighbour(t, i);
      if (n == TetrahedraComplex::none || std::find(cavity.begin(), cavity.end(), n) != cavity.end())
        continue;
      const Pair outer = pair(t, i, n);
      meet({{outer.face[0], outer.face[2], outer.face[1]}, outer.second, TetrahedraComplex::none});
    }
  return least;
}

bool TetrahedraOrthogonality::flip(Id t, std::size_t opposite) {
  std::vector<Id> old;
  std::vector<TetrahedraComplex::Corners> fresh, before;
  double best = worth_it;  // gain of the exchange
  const auto weigh = [&](bool possible) {
    if (!possible) return;
    before.clear();
    double floor = least_quality_, quality = 1.0;
    for (const Id i : flips_.old())
      before.push_back(mesh_.corners(i)), floor = std::min(floor, mesh_.quality(i));
    for (const TetrahedraComplex::Corners& c : flips_.fresh())
      quality = std::min(quality, mesh_.quality_of(c));
    if (quality < floor) return;
    const double gain = least_cosine(flips_.old(), flips_.fresh()) - least_cosine(flips_.old(), before);
    if (gain > best) best = gain, old = flips_.old(), fresh = flips_.fresh();
  };
  const TetrahedraComplex::Face face = mesh_.face(t, opposite);
  for (std::size_t i = 0; i < 3; ++i) weigh(flips_.plan_edge_removal(t, face[i], face[(i + 1) % 3], 0.0));
  weigh(flips_.plan_face_removal(t, opposite, 0.0));
  if (fresh.empty()) return false;
  mesh_.replace(old, fresh);
  return true;
}

/// The least cosine of a cavity filled around its point v at p; below -1 where a tetrahedron is worse than
/// `floor`, and then the better the less it is.
double TetrahedraOrthogonality::worth_of(const Vec3& p, Id v, const std::vector<Id>& cavity,
                                         const std::vector<TetrahedraComplex::Corners>& fresh, double floor) {
  mesh_.move(v, p, {});
  double quality = 1.0;
  for (const TetrahedraComplex::Corners& c : fresh) quality = std::min(quality, mesh_.quality_of(c));
  return quality < floor ? std::max(quality, -1.0) - 3.0 : least_cosine(cavity, fresh);
}

/// Where all five points of a face belong to the surface, only a new one can help: each inner edge is split,
/// and the point on it goes where it is best.
bool TetrahedraOrthogonality::insert(Id t, std::size_t opposite) {
  constexpr std::size_t most_around = 12;
  const TetrahedraComplex::Face face = mesh_.face(t, opposite);
  std::vector<Id> ring, around, old;
  std::vector<TetrahedraComplex::Corners> before, fresh, best_fresh;
  const Id v = mesh_.add_point(Vec3::Zero());
  Vec3 best_place = Vec3::Zero();
  double best = worth_it;  // gain
  for (std::size_t i = 0; i < 3; ++i) {
    const Id a = face[i], b = face[(i + 1) % 3];
    if (!mesh_.ring(t, a, b, most_around, ring, around)) continue;
    before.clear(), fresh.clear();
    for (const Id r : ring) {
      before.push_back(mesh_.corners(r));
      for (const Id end : {a, b}) {
        fresh.push_back(mesh_.corners(r));
        fresh.back()[mesh_.corner_of(r, end)] = v;
      }
    }
    const Vec3 middle = 0.5 * (mesh_.point(a) + mesh_.point(b));
    Vec3 place = middle;
    double worth = worth_of(place, v, ring, fresh, least_quality_);
    pattern_search(place, middle, 0.5 * (mesh_.point(a) - mesh_.point(b)).norm(), [&](const Vec3& p) {
      const double now = worth_of(p, v, ring, fresh, least_quality_);
      if (!(now > worth)) return false;
      worth = now;
      place = p;
      return true;
    });
    const double gain = worth - least_cosine(ring, before);
    if (gain > best) best = gain, best_place = place, old = ring, best_fresh = fresh;
  }
  if (best_fresh.empty()) return false;
  mesh_.move(v, best_place, {});
  mesh_.replace(old, best_fresh);
  return true;
}

bool TetrahedraOrthogonality::improve(Id t, std::size_t opposite, MendingReport& report) {
  const Pair at = pair(t, opposite, mesh_.neighbour(t, opposite));
  for (const Id v : {at.first, at.second, at.face[0], at.face[1], at.face[2]})
    if (move(v)) return ++report.points_moved, true;
  if (flip(t, opposite)) return ++report.flips, true;
  if (added_ < most_points && insert(t, opposite)) return ++added_, ++report.points_added, true;
  return false;
}

namespace {

struct OpenFace {
  double cosine;
  TetrahedraComplex::Id tetrahedron;
  std::size_t opposite;
  bool operator<(const OpenFace& o) const {  // the worst is on top of a heap
    return std::tie(o.cosine, o.tetrahedron, o.opposite) < std::tie(cosine, tetrahedron, opposite);
  }
};

}  // namespace

void make_orthogonal(TetrahedraComplex& mesh, double goal_deg, double least_quality, MendingReport& report,
                     const core::TaskContext& task) {
  const double goal = std::cos(goal_deg * std::numbers::pi / 180.0);
  TetrahedraOrthogonality faces(mesh, least_quality);
  std::priority_queue<OpenFace> queue;
  const auto enqueue = [&](TetrahedraComplex::Id t) {
    if (!mesh.alive(t)) return;
    for (std::size_t i = 0; i < 4; ++i) {
      const double cosine = faces.cosine(t, i);
      if (cosine < goal) queue.push({cosine, t, i});
    }
  };
  for (std::size_t t = 0; t < mesh.slots(); ++t) enqueue(static_cast<TetrahedraComplex::Id>(t));
  constexpr std::size_t check_every = 64;
  for (std::size_t i = 0; !queue.empty(); ++i) {
    if (i % check_every == 0) task.throw_if_cancelled();
    const OpenFace worst = queue.top();
    queue.pop();
    if (!mesh.alive(worst.tetrahedron) || faces.cosine(worst.tetrahedron, worst.opposite) != worst.cosine)
      continue;  // it has changed since
    mesh.touched().clear();
    if (!faces.improve(worst.tetrahedron, worst.opposite, report)) continue;
    for (const TetrahedraComplex::Id t : mesh.touched()) enqueue(t);
  }
}

}  // namespace ostia::meshing
