#include "tetrahedra/complex.h"

#include "tetrahedra/quality.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// Corners of the face opposite each corner, seen from inside.
constexpr std::size_t face_corners[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

std::array<std::int32_t, 3> sorted(std::array<std::int32_t, 3> f) {
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  if (f[1] > f[2]) std::swap(f[1], f[2]);
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  return f;
}

}  // namespace

TetrahedraComplex::TetrahedraComplex(const geometry::VolumeMesh& mesh)
    : points_(mesh.points),
      fixed_(mesh.points.size(), 0),
      used_(mesh.points.size(), 0),
      some_tetrahedron_(mesh.points.size(), none),
      corners_(mesh.tetrahedra),
      neighbours_(mesh.tetrahedra.size(), Corners{none, none, none, none}),
      mark_(mesh.tetrahedra.size(), 0),
      alive_(mesh.tetrahedra.size()) {
  for (const geometry::Triangle& t : mesh.boundary)
    for (const Id v : t) fixed_[at(v)] = 1;
  quality_.reserve(corners_.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    for (const Id v : corners_[i]) some_tetrahedron_[at(v)] = static_cast<Id>(i), used_[at(v)] = 1;
    quality_.push_back(quality_of(corners_[i]));
  }
  find_neighbours();
}

void TetrahedraComplex::find_neighbours() {
  // Faces in buckets of their smallest point: a bucket is short enough for a plain search.
  std::vector<std::size_t> first(points_.size() + 1, 0);
  std::vector<OpenFace> faces;
  faces.reserve(4 * corners_.size());
  for (std::size_t i = 0; i < corners_.size(); ++i)
    for (std::size_t f = 0; f < 4; ++f) {
      faces.push_back(open_face(static_cast<Id>(i), f));
      ++first[at(faces.back().key[0]) + 1];
    }
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<std::uint32_t> order(faces.size());
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < faces.size(); ++i)
    order[next[at(faces[i].key[0])]++] = static_cast<std::uint32_t>(i);
  for (std::size_t v = 0; v + 1 < first.size(); ++v)
    for (std::size_t i = first[v]; i < first[v + 1]; ++i)
      for (std::size_t j = i + 1; j < first[v + 1]; ++j) {
        const OpenFace &a = faces[order[i]], &b = faces[order[j]];
        if (a.key[1] == b.key[1] && a.key[2] == b.key[2]) join(a, b);
      }
}

TetrahedraComplex::Face TetrahedraComplex::face_of(const Corners& c, std::size_t opposite) {
  const std::size_t* f = face_corners[opposite];
  return {c[f[0]], c[f[1]], c[f[2]]};
}

std::size_t TetrahedraComplex::corner_of(Id t, Id point) const {
  const Corners& c = corners_[at(t)];
  for (std::size_t i = 0; i < 4; ++i)
    if (c[i] == point) return i;
  return 4;
}

double TetrahedraComplex::quality_with(const Face& f, const Vec3& p) const {
  return tetrahedron_quality(point(f[0]), point(f[1]), point(f[2]), p);
}

double TetrahedraComplex::quality_of(const Corners& t) const {
  return tetrahedron_quality(point(t[0]), point(t[1]), point(t[2]), point(t[3]));
}

TetrahedraComplex::Id TetrahedraComplex::add_point(const Vec3& p) {
  points_.push_back(p);
  fixed_.push_back(0);
  used_.push_back(1);
  some_tetrahedron_.push_back(none);
  return static_cast<Id>(points_.size()) - 1;
}

void TetrahedraComplex::star(Id v, std::vector<Id>& out) {
  out.clear();
  const Id start = some_tetrahedron_[at(v)];
  if (start == none) return;
  ++stamp_;
  mark_[at(start)] = stamp_;
  out.push_back(start);
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t f = 0; f < 4; ++f) {
      const Id n = neighbours_[at(out[i])][f];
      if (n == none || mark_[at(n)] == stamp_ || corners_[at(out[i])][f] == v) continue;
      mark_[at(n)] = stamp_;
      out.push_back(n);
    }
}

bool TetrahedraComplex::ring(Id t, Id a, Id b, std::size_t most, std::vector<Id>& tetrahedra,
                             std::vector<Id>& around) const {
  tetrahedra.clear();
  around.clear();
  // The two other corners in the order that makes {a, b, c, d} positive: the face opposite a holds b, c, d.
  const Face opposite_a = face(t, corner_of(t, a));
  std::size_t k = 0;
  while (opposite_a[k] != b) ++k;
  Id c = opposite_a[(k + 2) % 3], d = opposite_a[(k + 1) % 3];
  Id now = t;
  do {
    if (tetrahedra.size() == most) return false;
    tetrahedra.push_back(now);
    around.push_back(c);
    const Id next = neighbours_[at(now)][corner_of(now, c)];
    if (next == none) return false;
    c = d;
    for (const Id v : corners_[at(next)])
      if (v != a && v != b && v != c) d = v;
    now = next;
  } while (now != t);
  return true;
}

TetrahedraComplex::OpenFace TetrahedraComplex::open_face(Id t, std::size_t f) const {
  return {sorted(face(t, f)), t, f};
}

void TetrahedraComplex::join(const OpenFace& a, const OpenFace& b) {
  if (a.tetrahedron != none) neighbours_[at(a.tetrahedron)][a.face] = b.tetrahedron;
  if (b.tetrahedron != none) neighbours_[at(b.tetrahedron)][b.face] = a.tetrahedron;
}

TetrahedraComplex::Id TetrahedraComplex::free_slot() {
  if (!free_.empty()) {
    const Id t = free_.back();
    free_.pop_back();
    return t;
  }
  corners_.push_back({none, none, none, none});
  neighbours_.push_back({none, none, none, none});
  quality_.push_back(0.0);
  mark_.push_back(0);
  return static_cast<Id>(corners_.size()) - 1;
}

/// Finds the counterparts of a new tetrahedron's faces among the open ones.
void TetrahedraComplex::close(Id t) {
  for (std::size_t f = 0; f < 4; ++f) {
    const OpenFace mine = open_face(t, f);
    const auto other =
        std::find_if(open_.begin(), open_.end(), [&](const OpenFace& o) { return o.key == mine.key; });
    if (other == open_.end()) {
      open_.push_back(mine);
    } else {
      join(mine, *other);
      *other = open_.back();
      open_.pop_back();
    }
  }
}

void TetrahedraComplex::replace(const std::vector<Id>& old, const std::vector<Corners>& fresh) {
  ++stamp_;
  for (const Id t : old) mark_[at(t)] = stamp_;
  open_.clear();
  for (const Id t : old)
    for (std::size_t f = 0; f < 4; ++f) {
      const Id n = neighbours_[at(t)][f];
      if (n != none && mark_[at(n)] == stamp_) continue;
      const Corners* around = n == none ? nullptr : &neighbours_[at(n)];
      const auto back =
          around == nullptr
              ? std::size_t{0}
              : static_cast<std::size_t>(std::find(around->begin(), around->end(), t) - around->begin());
      open_.push_back({sorted(face(t, f)), n, back});
    }
  for (const Id t : old) {
    for (const Id v : corners_[at(t)]) some_tetrahedron_[at(v)] = none;
    corners_[at(t)] = {none, none, none, none};
  }
  alive_ += fresh.size();
  alive_ -= old.size();
  for (std::size_t i = old.size(); i > 0; --i) free_.push_back(old[i - 1]);  // the first is taken first
  for (const Corners& corners : fresh) {
    const Id t = free_slot();
    corners_[at(t)] = corners;
    neighbours_[at(t)] = {none, none, none, none};
    quality_[at(t)] = quality_of(corners);
    for (const Id v : corners) some_tetrahedron_[at(v)] = t;
    close(t);
    touched_.push_back(t);
  }
  if (!open_.empty()) throw GeometryError("the tetrahedra of a cavity do not fill it");
}

void TetrahedraComplex::move(Id v, const Vec3& p, const std::vector<Id>& star) {
  points_[at(v)] = p;
  for (const Id t : star) {
    quality_[at(t)] = quality_of(corners_[at(t)]);
    touched_.push_back(t);
  }
}

void TetrahedraComplex::write_to(geometry::VolumeMesh& mesh) const {
  std::vector<Id> number(points_.size(), none);
  mesh.points.clear();
  for (std::size_t v = 0; v < points_.size(); ++v) {
    if (used_[v] != 0 && fixed_[v] == 0 && some_tetrahedron_[v] == none) continue;  // vanished
    number[v] = static_cast<Id>(mesh.points.size());
    mesh.points.push_back(points_[v]);
  }
  mesh.tetrahedra.clear();
  for (Corners t : corners_) {
    if (t[0] == none) continue;
    for (Id& v : t) v = number[at(v)];
    mesh.tetrahedra.push_back(t);
  }
  for (geometry::Triangle& t : mesh.boundary)
    for (Id& v : t) v = number[at(v)];
}

}  // namespace ostia::meshing
