#include "remeshing/edit_mesh.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <string>
#include <tuple>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

struct DirectedEdge {
  std::int32_t low, high, half_edge;
};

}  // namespace

EditMesh::EditMesh(const geometry::TriMesh& mesh) : points(mesh.points) {
  const auto faces = static_cast<std::int32_t>(mesh.triangles.size());
  origin_.resize(3 * mesh.triangles.size());
  twin_.assign(origin_.size(), none);
  out_.assign(points.size(), none);
  live_faces_ = mesh.triangles.size();
  std::vector<DirectedEdge> edges;
  edges.reserve(origin_.size());
  for (std::int32_t f = 0; f < faces; ++f) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(f)];
    for (std::int32_t i = 0; i < 3; ++i) {
      const std::int32_t a = t[static_cast<std::size_t>(i)], b = t[static_cast<std::size_t>((i + 1) % 3)];
      if (a < 0 || a >= vertex_count() || a == b)
        throw GeometryError(
            "triangle " + std::to_string(f) +
            " of the surface has a corner that repeats or does not exist; repair the surface first");
      origin_of(3 * f + i) = a;
      edges.push_back({std::min(a, b), std::max(a, b), 3 * f + i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& x, const DirectedEdge& y) {
    return std::tie(x.low, x.high, x.half_edge) < std::tie(y.low, y.high, y.half_edge);
  });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    const std::string name =
        "the edge between points " + std::to_string(edges[i].low) + " and " + std::to_string(edges[i].high);
    if (j - i > 2)
      throw GeometryError(name + " has " + std::to_string(j - i) + " triangles; repair the surface first");
    if (j - i == 2) {
      if (origin(edges[i].half_edge) == origin(edges[i + 1].half_edge))
        throw GeometryError("the triangles at " + name +
                            " are turned against each other; orient the surface first");
      pair(edges[i].half_edge, edges[i + 1].half_edge);
    }
    i = j;
  }
  std::vector<std::int32_t> corners(points.size(), 0);
  for (std::int32_t h = 0; h < half_edge_count(); ++h) {
    ++corners[static_cast<std::size_t>(origin(h))];
    if (out(origin(h)) == none || twin(h) == none) out_[static_cast<std::size_t>(origin(h))] = h;
  }
  for (std::int32_t v = 0; v < vertex_count(); ++v) {
    if (!alive_vertex(v)) continue;
    std::int32_t fan = 0;
    around(v, [&](std::int32_t) { ++fan; });
    if (fan != corners[static_cast<std::size_t>(v)])
      throw GeometryError("the triangles at point " + std::to_string(v) +
                          " form more than one fan; repair the surface first");
  }
}

void EditMesh::pair(std::int32_t a, std::int32_t b) {
  if (a != none) twin_[static_cast<std::size_t>(a)] = b;
  if (b != none) twin_[static_cast<std::size_t>(b)] = a;
}

// Turns clockwise from h, which starts at v, to the border if there is one.
void EditMesh::settle_out(std::int32_t v, std::int32_t h) {
  const std::int32_t start = h;
  while (twin(h) != none) {
    h = next(twin(h));
    if (h == start) break;
  }
  out_[static_cast<std::size_t>(v)] = h;
}

std::int32_t EditMesh::add_face(std::int32_t a, std::int32_t b, std::int32_t c) {
  std::int32_t f = face_count();
  if (free_faces_.empty()) {
    origin_.insert(origin_.end(), 3, none);
    twin_.insert(twin_.end(), 3, none);
  } else {
    f = free_faces_.back();
    free_faces_.pop_back();
  }
  origin_of(3 * f) = a;
  origin_of(3 * f + 1) = b;
  origin_of(3 * f + 2) = c;
  for (std::int32_t i = 0; i < 3; ++i) twin_[static_cast<std::size_t>(3 * f + i)] = none;
  ++live_faces_;
  return f;
}

std::int32_t EditMesh::valence(std::int32_t v) const {
  std::int32_t count = border(v) ? 1 : 0;
  around(v, [&](std::int32_t) { ++count; });
  return count;
}

bool EditMesh::connected(std::int32_t a, std::int32_t b) const {
  const std::int32_t start = out(a);
  std::int32_t h = start;
  do {
    if (target(h) == b || origin(prev(h)) == b) return true;
    h = twin(prev(h));
  } while (h != none && h != start);
  return false;
}

Vec3 EditMesh::area_normal(std::int32_t f) const {
  const Vec3& a = at(origin(3 * f));
  return (at(origin(3 * f + 1)) - a).cross(at(origin(3 * f + 2)) - a);
}

bool EditMesh::can_flip(std::int32_t h) const {
  const std::int32_t t = twin(h);
  if (t == none) return false;
  const std::int32_t c = origin(prev(h)), d = origin(prev(t));
  return c != d && !connected(c, d);
}

void EditMesh::flip(std::int32_t h) {
  const std::int32_t t = twin(h), hn = next(h), hp = prev(h), tn = next(t), tp = prev(t);
  const std::int32_t a = origin(h), b = origin(t), c = origin(hp), d = origin(tp);
  const std::int32_t bc = twin(hn), ca = twin(hp), ad = twin(tn), db = twin(tp);
  origin_of(h) = c, origin_of(hn) = d, origin_of(hp) = b;
  origin_of(t) = d, origin_of(tn) = c, origin_of(tp) = a;
  for (const auto& [slot, other] : {std::pair{hn, db}, {hp, bc}, {tn, ca}, {tp, ad}}) {
    twin_[static_cast<std::size_t>(slot)] = none;
    pair(slot, other);
  }
  auto rename = [&](std::int32_t v, std::int32_t to, std::initializer_list<std::int32_t> from) {
    if (std::find(from.begin(), from.end(), out(v)) != from.end()) out_[static_cast<std::size_t>(v)] = to;
  };
  rename(a, tp, {h, tn});
  rename(b, hp, {t, hn});
  rename(c, tn, {hp});
  rename(d, hn, {tp});
}

std::int32_t EditMesh::split(std::int32_t h, const Vec3& p) {
  const std::int32_t m = vertex_count();
  points.push_back(p);
  out_.push_back(none);
  const std::int32_t t = twin(h), hn = next(h), hp = prev(h);
  const std::int32_t a = origin(h), b = origin(hn), c = origin(hp);
  const std::int32_t bc = twin(hn);
  const std::int32_t e0 = 3 * add_face(m, b, c), e1 = e0 + 1, e2 = e0 + 2;
  origin_of(hn) = m;
  pair(hn, e2);
  pair(e1, bc);
  if (out(b) == hn) out_[static_cast<std::size_t>(b)] = e1;
  out_[static_cast<std::size_t>(m)] = e0;
  if (t == none) return m;
  const std::int32_t tn = next(t), tp = prev(t), d = origin(tp), ad = twin(tn);
  const std::int32_t g0 = 3 * add_face(m, a, d), g1 = g0 + 1, g2 = g0 + 2;
  origin_of(tn) = m;
  pair(tn, g2);
  pair(g1, ad);
  pair(h, g0);
  pair(t, e0);
  if (out(a) == tn) out_[static_cast<std::size_t>(a)] = g1;
  return m;
}

bool EditMesh::can_collapse(std::int32_t h) const {
  const std::int32_t t = twin(h), a = origin(h), b = target(h);
  const bool edge_on_border = t == none;
  if (border(a) && !(edge_on_border && border(b))) return false;
  // The two edges beside the collapsed one must not both be borders: an ear would vanish.
  if (twin(next(h)) == none && twin(prev(h)) == none) return false;
  if (t != none && twin(next(t)) == none && twin(prev(t)) == none) return false;
  const std::int32_t c = origin(prev(h)), d = edge_on_border ? none : origin(prev(t));
  // Link condition: no common neighbours but the corners opposite the edge.
  std::int32_t shared = 0;
  auto visit_neighbours = [&](std::int32_t v, const auto& visit) {
    around(v, [&](std::int32_t e) {
      visit(target(e));
      if (twin(prev(e)) == none) visit(origin(prev(e)));
    });
  };
  std::array<std::int32_t, 32> near{};
  std::size_t count = 0;
  visit_neighbours(b, [&](std::int32_t v) {
    if (count < near.size()) near[count++] = v;
  });
  if (count == near.size()) return false;
  visit_neighbours(a, [&](std::int32_t v) {
    if (v != b && std::find(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), v) !=
                      near.begin() + static_cast<std::ptrdiff_t>(count))
      ++shared;
  });
  if (shared != (edge_on_border ? 1 : 2)) return false;
  for (const std::int32_t v : {c, d})
    if (v != none && valence(v) <= (border(v) ? 2 : 3)) return false;
  // A border triangle of three vertices must not shrink to two.
  if (edge_on_border) {
    const std::int32_t after = target(out(b));
    if (after == a || target(out(after)) == a) return false;
  }
  return true;
}

void EditMesh::collapse(std::int32_t h) {
  const std::int32_t t = twin(h), a = origin(h), b = target(h);
  const std::int32_t c = origin(prev(h)), d = t == none ? none : origin(prev(t));
  const std::int32_t bc = twin(next(h)), ca = twin(prev(h));
  const std::int32_t ad = t == none ? none : twin(next(t)), db = t == none ? none : twin(prev(t));
  std::vector<std::int32_t> star;
  around(a, [&](std::int32_t e) { star.push_back(e); });
  for (const std::int32_t e : star) origin_of(e) = b;
  auto remove = [&](std::int32_t f) {
    for (std::int32_t i = 0; i < 3; ++i) {
      origin_of(3 * f + i) = none;
      twin_[static_cast<std::size_t>(3 * f + i)] = none;
    }
    free_faces_.push_back(f);
    --live_faces_;
  };
  remove(face(h));
  if (t != none) remove(face(t));
  auto glue = [&](std::int32_t x, std::int32_t y) {  // x and y had the removed face between them
    if (x != none) twin_[static_cast<std::size_t>(x)] = y;
    if (y != none) twin_[static_cast<std::size_t>(y)] = x;
  };
  glue(bc, ca);
  if (t != none) glue(ad, db);
  out_[static_cast<std::size_t>(a)] = none;
  settle_out(c, bc != none ? bc : next(ca));
  if (t != none) settle_out(d, ad != none ? ad : next(db));
  settle_out(b, ca != none ? ca : next(bc));
}

geometry::TriMesh EditMesh::compact(std::vector<std::int32_t>* old_vertices,
                                    std::vector<std::int32_t>* old_faces) const {
  geometry::TriMesh mesh;
  std::vector<std::int32_t> number(points.size(), none);
  if (old_vertices) old_vertices->clear();
  if (old_faces) old_faces->clear();
  for (std::int32_t v = 0; v < vertex_count(); ++v) {
    if (!alive_vertex(v)) continue;
    number[static_cast<std::size_t>(v)] = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.push_back(at(v));
    if (old_vertices) old_vertices->push_back(v);
  }
  mesh.triangles.reserve(live_faces_);
  for (std::int32_t f = 0; f < face_count(); ++f) {
    if (!alive_face(f)) continue;
    auto corner = [&](std::int32_t i) { return number[static_cast<std::size_t>(origin(3 * f + i))]; };
    mesh.triangles.push_back({corner(0), corner(1), corner(2)});
    if (old_faces) old_faces->push_back(f);
  }
  return mesh;
}

}  // namespace ostia::meshing
