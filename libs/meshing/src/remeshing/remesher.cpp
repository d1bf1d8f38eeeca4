#include "remeshing/remesher.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

constexpr double longest = 4.0 / 3.0, shortest = 4.0 / 5.0;  // Botsch and Kobbelt's thresholds
constexpr double min_facing = 0.3;    // a triangle within 72 degrees of the surface is not folded
constexpr double microscopic = 0.02;  // edges below this part of the target have no direction worth keeping
constexpr std::size_t fewest_on_curve = 6;  // points that a border loop keeps

}  // namespace

double min_angle_cosine(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - b, w = a - c;
  const double x = u.squaredNorm(), y = v.squaredNorm(), z = w.squaredNorm();
  // The smallest angle is opposite the shortest edge, between the two others.
  double product = z * x, dot = -w.dot(u);
  if (x <= y && x <= z) {
    product = y * z, dot = -v.dot(w);
  } else if (z <= y) {
    product = x * y, dot = -u.dot(v);
  }
  return product > 0.0 ? dot / std::sqrt(product) : 1.0;
}

Vec3 BorderCurve::at(double s) const {
  s = std::fmod(s, length);
  if (s < 0.0) s += length;
  const auto after = std::upper_bound(arc.begin(), arc.end(), s);
  const auto i = static_cast<std::size_t>(after - arc.begin()) - 1;
  const double end = i + 1 < arc.size() ? arc[i + 1] : length;
  const Vec3& b = points[(i + 1) % points.size()];
  return end > arc[i] ? Vec3(points[i] + (s - arc[i]) / (end - arc[i]) * (b - points[i])) : points[i];
}

std::vector<BorderCurve> border_curves(const EditMesh& mesh) {
  std::vector<BorderCurve> curves;
  std::vector<bool> seen(static_cast<std::size_t>(mesh.half_edge_count()), false);
  for (std::int32_t first = 0; first < mesh.half_edge_count(); ++first) {
    if (!mesh.alive(first) || mesh.twin(first) != EditMesh::none || seen[static_cast<std::size_t>(first)])
      continue;
    BorderCurve curve;
    for (std::int32_t h = first; !seen[static_cast<std::size_t>(h)]; h = mesh.out(mesh.target(h))) {
      seen[static_cast<std::size_t>(h)] = true;
      curve.vertices.push_back(mesh.origin(h));
      curve.points.push_back(mesh.at(mesh.origin(h)));
      curve.arc.push_back(curve.length);
      curve.length += mesh.length(h);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

ReferenceSurface::ReferenceSurface(const geometry::TriMesh& mesh, const std::vector<double>& sizes)
    : tree_(mesh), triangles_(mesh.triangles), normals_(geometry::vertex_normals(mesh)), sizes_(sizes) {}

ReferenceSurface::Sample ReferenceSurface::project(const Vec3& p) const {
  const geometry::SurfacePoint hit = tree_.closest(p);
  const geometry::Triangle& t = triangles_[static_cast<std::size_t>(hit.triangle)];
  Sample sample{hit.point, Vec3::Zero(), 0.0};
  for (int i = 0; i < 3; ++i) {
    const auto v = static_cast<std::size_t>(t[static_cast<std::size_t>(i)]);
    sample.normal += hit.barycentric[i] * normals_[v];
    sample.size += hit.barycentric[i] * sizes_[v];
  }
  sample.normal.normalize();
  return sample;
}

Remesher::Remesher(const geometry::TriMesh& surface, const std::vector<double>& sizes)
    : mesh_(surface),
      reference_(surface, sizes),
      curves_(border_curves(mesh_)),
      size_(sizes),
      arc_(sizes.size(), 0.0),
      normal_(reference_.normals()),
      curve_(sizes.size(), EditMesh::none),
      frozen_(curves_.size(), false) {
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    curve_points_.push_back(curves_[c].vertices.size());
    for (std::size_t i = 0; i < curves_[c].vertices.size(); ++i) {
      const auto v = static_cast<std::size_t>(curves_[c].vertices[i]);
      curve_[v] = static_cast<std::int32_t>(c);
      arc_[v] = curves_[c].arc[i];
    }
  }
}

double Remesher::facing(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& reference) const {
  const Vec3 n = (b - a).cross(c - a);
  const double scale = n.norm() * reference.norm();
  return scale > 0.0 ? n.dot(reference) / scale : -1.0;
}

Vec3 Remesher::reference_normal(std::int32_t a, std::int32_t b, std::int32_t c) const {
  return normal(a) + normal(b) + normal(c);
}

std::vector<std::pair<double, std::int32_t>> Remesher::edges_beyond(double threshold, bool longer) const {
  std::vector<std::pair<double, std::int32_t>> edges;
  for (std::int32_t h = 0; h < mesh_.half_edge_count(); ++h) {
    if (!mesh_.canonical(h)) continue;
    const double r = ratio(h);
    if (longer ? r > threshold : r < threshold) edges.emplace_back(longer ? -r : r, h);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void Remesher::split_edge(std::int32_t h) {
  const std::int32_t a = mesh_.origin(h), b = mesh_.target(h);
  const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
  Vec3 middle = 0.5 * (mesh_.at(a) + mesh_.at(b));
  double arc = 0.0;
  std::int32_t on = EditMesh::none;
  if (mesh_.twin(h) == EditMesh::none) {
    on = curve(a);
    const BorderCurve& border = curves_[static_cast<std::size_t>(on)];
    double step = std::fmod(arc_[ib] - arc_[ia], border.length);
    if (step <= 0.0) step += border.length;
    arc = std::fmod(arc_[ia] + 0.5 * step, border.length);
    middle = border.at(arc);
    ++curve_points_[static_cast<std::size_t>(on)];
  }
  const double s = 0.5 * (size_[ia] + size_[ib]);
  const Vec3 n = (normal_[ia] + normal_[ib]).normalized();
  mesh_.split(h, middle);
  size_.push_back(s);
  normal_.push_back(n);
  arc_.push_back(arc);
  curve_.push_back(on);
}

std::size_t Remesher::split_long() {
  std::size_t done = 0;
  for (int pass = 0; pass < 12; ++pass) {
    const auto edges = edges_beyond(longest, true);
    if (edges.empty()) break;
    task_->throw_if_cancelled();
    for (const auto& [key, h] : edges) {
      if (ratio(h) <= longest || (mesh_.twin(h) == EditMesh::none && frozen(mesh_.origin(h)))) continue;
      split_edge(h);
      ++done;
    }
  }
  splits += done;
  return done;
}

bool Remesher::collapse_is_good(std::int32_t h, bool mending) const {
  const std::int32_t a = mesh_.origin(h), b = mesh_.target(h);
  const Vec3& p = mesh_.at(b);
  const bool along_border = mesh_.twin(h) == EditMesh::none;
  if (along_border && curve_points_[static_cast<std::size_t>(curve(a))] <= fewest_on_curve) return false;
  double before = 0.0, after = 0.0;  // cosines of the smallest angles
  bool good = true;
  // Marching cubes leave such edges next to a grid point; the triangles on them face anywhere.
  const bool tiny = !along_border && ratio(h) < microscopic;
  const double limit = mending ? 1.6 : longest;
  mesh_.around(a, [&](std::int32_t e) {
    if (!good) return;
    const std::int32_t x = mesh_.target(e), y = mesh_.origin(EditMesh::prev(e));
    before = std::max(before, min_angle_cosine(mesh_.at(a), mesh_.at(x), mesh_.at(y)));
    if (x == b || y == b) return;
    const Vec3& px = mesh_.at(x);
    const Vec3& py = mesh_.at(y);
    const Vec3 reference = reference_normal(b, x, y);
    const double now = facing(p, px, py, reference);
    if (!tiny && now < min_facing && now <= facing(mesh_.at(a), px, py, reference)) good = false;
    after = std::max(after, min_angle_cosine(p, px, py));
    if ((p - px).norm() > limit * scale_ * 0.5 * (size(b) + size(x))) good = false;
    if ((p - py).norm() > limit * scale_ * 0.5 * (size(b) + size(y))) good = false;
  });
  if (!good || tiny) return good;
  // Outside of mending a collapse may cost some quality, but never make a needle.
  constexpr double needle = 0.9659;  // 15 degrees
  return mending ? after < before : after < std::max(before, needle);
}

bool Remesher::try_collapse(std::int32_t h, bool mending) {
  if (frozen(mesh_.origin(h)) || !collapse_is_good(h, mending) || !mesh_.can_collapse(h)) return false;
  const std::int32_t a = mesh_.origin(h);
  if (curve(a) != EditMesh::none) --curve_points_[static_cast<std::size_t>(curve(a))];
  mesh_.collapse(h);
  ++collapses;
  return true;
}

std::size_t Remesher::collapse_short() {
  std::size_t done = 0;
  for (int pass = 0; pass < 6; ++pass) {
    task_->throw_if_cancelled();
    std::size_t in_pass = 0;
    for (const auto& [key, h] : edges_beyond(shortest, false)) {
      if (!mesh_.alive(h) || ratio(h) >= shortest) continue;
      const std::int32_t t = mesh_.twin(h);
      if (try_collapse(h, false) || (t != EditMesh::none && try_collapse(t, false))) {
        ++in_pass;
        continue;
      }
      if (t != EditMesh::none || frozen(mesh_.origin(h))) continue;
      // A border edge also collapses the other way: into its origin, by sliding the origin to the target's
      // place.
      const std::int32_t a = mesh_.origin(h), b = mesh_.target(h);
      const Place there{mesh_.at(b), normal(b), size(b), arc_[static_cast<std::size_t>(b)]};
      const Place here{mesh_.at(a), normal(a), size(a), arc_[static_cast<std::size_t>(a)]};
      move(b, here);
      if (try_collapse(h, false))
        ++in_pass;
      else
        move(b, there);
    }
    done += in_pass;
    if (in_pass == 0) break;
  }
  return done;
}

bool Remesher::flip_keeps_shape(std::int32_t h) const {
  if (!mesh_.can_flip(h)) return false;
  const std::int32_t t = mesh_.twin(h);
  const std::int32_t a = mesh_.origin(h), b = mesh_.origin(t), c = mesh_.origin(EditMesh::prev(h)),
                     d = mesh_.origin(EditMesh::prev(t));
  const Vec3 &pa = mesh_.at(a), &pb = mesh_.at(b), &pc = mesh_.at(c), &pd = mesh_.at(d);
  if (facing(pc, pd, pb, reference_normal(c, d, b)) < min_facing) return false;
  if (facing(pd, pc, pa, reference_normal(d, c, a)) < min_facing) return false;
  auto cosine = [](const Vec3& m, const Vec3& n) { return m.dot(n) / std::max(m.norm() * n.norm(), 1e-300); };
  const double now = cosine((pd - pc).cross(pb - pc), (pc - pd).cross(pa - pd));
  return now > 0.8 || now >= cosine((pb - pa).cross(pc - pa), (pa - pb).cross(pd - pb));
}

bool Remesher::flip_raises_angle(std::int32_t h) const {
  const std::int32_t t = mesh_.twin(h);
  if (t == EditMesh::none) return false;
  const Vec3 &a = mesh_.at(mesh_.origin(h)), &b = mesh_.at(mesh_.origin(t)),
             &c = mesh_.at(mesh_.origin(EditMesh::prev(h))), &d = mesh_.at(mesh_.origin(EditMesh::prev(t)));
  const double before = std::max(min_angle_cosine(a, b, c), min_angle_cosine(b, a, d));
  const double after = std::max(min_angle_cosine(c, d, b), min_angle_cosine(d, c, a));
  return after < before - 1e-9 && flip_keeps_shape(h);
}

bool Remesher::flip_lowers_valence_deviation(std::int32_t h) const {
  const std::int32_t t = mesh_.twin(h);
  if (t == EditMesh::none) return false;
  const std::int32_t a = mesh_.origin(h), b = mesh_.origin(t), c = mesh_.origin(EditMesh::prev(h)),
                     d = mesh_.origin(EditMesh::prev(t));
  auto cost = [&](std::int32_t v, int change) {
    const int off = mesh_.valence(v) - (mesh_.border(v) ? 4 : 6) + change;
    return off * off;
  };
  const int before = cost(a, 0) + cost(b, 0) + cost(c, 0) + cost(d, 0);
  if (cost(a, -1) + cost(b, -1) + cost(c, 1) + cost(d, 1) >= before) return false;
  // Better valence pays only while no needle comes of it: relaxation opens the rest.
  const Vec3 &pa = mesh_.at(a), &pb = mesh_.at(b), &pc = mesh_.at(c), &pd = mesh_.at(d);
  const double old_worst = std::max(min_angle_cosine(pa, pb, pc), min_angle_cosine(pb, pa, pd));
  const double worst = std::max(min_angle_cosine(pc, pd, pb), min_angle_cosine(pd, pc, pa));
  constexpr double sharp = 0.94;  // 20 degrees
  return (worst < sharp || worst < old_worst) && flip_keeps_shape(h);
}

std::size_t Remesher::flip_sweep(bool for_valence) {
  std::size_t done = 0;
  for (int pass = 0; pass < 6; ++pass) {
    task_->throw_if_cancelled();
    std::size_t in_pass = 0;
    for (std::int32_t h = 0; h < mesh_.half_edge_count(); ++h) {
      if (!mesh_.canonical(h)) continue;
      if (for_valence ? !flip_lowers_valence_deviation(h) : !flip_raises_angle(h)) continue;
      mesh_.flip(h);
      ++in_pass;
    }
    done += in_pass;
    if (in_pass == 0) break;
  }
  flips += done;
  return done;
}

std::size_t Remesher::flip_for_valence() {
  return flip_sweep(true);
}
std::size_t Remesher::flip_for_angle() {
  return flip_sweep(false);
}

Remesher::Place Remesher::border_place(std::int32_t v) const {
  const std::int32_t h = mesh_.out(v);
  std::int32_t before = EditMesh::none;  // the border neighbour on the other side
  mesh_.around(v, [&](std::int32_t e) { before = mesh_.origin(EditMesh::prev(e)); });
  const BorderCurve& border = curves_[static_cast<std::size_t>(curve(v))];
  auto step = [&](std::int32_t from, std::int32_t to) {
    const double s =
        std::fmod(arc_[static_cast<std::size_t>(to)] - arc_[static_cast<std::size_t>(from)], border.length);
    return s < 0.0 ? s + border.length : s;
  };
  const std::int32_t after = mesh_.target(h);
  const double forward = step(v, after), back = step(before, v);
  // Edges in proportion to their targets.
  const double wf = size(v) + size(after), wb = size(v) + size(before);
  const double arc = arc_[static_cast<std::size_t>(v)] + (forward * wb - back * wf) / (wb + wf);
  const Vec3 p = border.at(arc);
  const auto sample = reference_.project(p);
  return {p, sample.normal, sample.size, arc};
}

Remesher::Place Remesher::relaxed_place(std::int32_t v) const {
  if (mesh_.border(v)) return border_place(v);
  Vec3 sum = Vec3::Zero();
  double weights = 0.0;
  mesh_.around(v, [&](std::int32_t e) {
    const std::int32_t x = mesh_.target(e), y = mesh_.origin(EditMesh::prev(e));
    const Vec3 centroid = (mesh_.at(v) + mesh_.at(x) + mesh_.at(y)) / 3.0;
    const double s = (size(v) + size(x) + size(y)) / 3.0;
    const double w = mesh_.area_normal(EditMesh::face(e)).norm() /
                     (s * s * s * s);  // density of a graded centroidal tessellation
    sum += w * centroid;
    weights += w;
  });
  const Vec3& p = mesh_.at(v);
  Vec3 shift = weights > 0.0 ? Vec3(sum / weights - p) : Vec3::Zero();
  shift -= shift.dot(normal(v)) * normal(v);
  const auto sample = reference_.project(p + shift);
  return {sample.point, sample.normal, sample.size, 0.0};
}

bool Remesher::move_is_safe(std::int32_t v, const Place& place) const {
  if (frozen(v)) return false;
  if (place.normal.dot(normal(v)) < 0.0) return false;  // the other side of a thin wall, or another vessel
  bool safe = true;
  mesh_.around(v, [&](std::int32_t e) {
    if (!safe) return;
    const std::int32_t x = mesh_.target(e), y = mesh_.origin(EditMesh::prev(e));
    const Vec3& px = mesh_.at(x);
    const Vec3& py = mesh_.at(y);
    const double now = facing(place.point, px, py, place.normal + normal(x) + normal(y));
    if (now < min_facing && now <= facing(mesh_.at(v), px, py, reference_normal(v, x, y))) safe = false;
    // A triangle may shrink, not collapse.
    constexpr double needle = 0.9962;  // 5 degrees
    if (min_angle_cosine(place.point, px, py) > std::max(needle, min_angle_cosine(mesh_.at(v), px, py)))
      safe = false;
  });
  return safe;
}

void Remesher::move(std::int32_t v, const Place& place) {
  const auto i = static_cast<std::size_t>(v);
  mesh_.points[i] = place.point;
  normal_[i] = place.normal;
  size_[i] = place.size;
  arc_[i] = place.arc;
}

void Remesher::relax() {
  std::vector<Place> places(static_cast<std::size_t>(mesh_.vertex_count()));
  core::parallel_chunks(places.size(), 512, [&](std::size_t first, std::size_t last) {
    task_->throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i)
      if (mesh_.alive_vertex(static_cast<std::int32_t>(i)))
        places[i] = relaxed_place(static_cast<std::int32_t>(i));
  });
  for (std::int32_t v = 0; v < mesh_.vertex_count(); ++v) {
    if (!mesh_.alive_vertex(v)) continue;
    const Place& place = places[static_cast<std::size_t>(v)];
    if (move_is_safe(v, place)) {
      move(v, place);
    } else if (!mesh_.border(v)) {  // at least back onto the surface
      const auto sample = reference_.project(mesh_.at(v));
      const Place back{sample.point, sample.normal, sample.size, 0.0};
      if (move_is_safe(v, back)) move(v, back);
    }
  }
}

void Remesher::calibrate() {
  double wanted = 0.0;
  for (std::int32_t f = 0; f < mesh_.face_count(); ++f) {
    if (!mesh_.alive_face(f)) continue;
    const double s =
        (size(mesh_.origin(3 * f)) + size(mesh_.origin(3 * f + 1)) + size(mesh_.origin(3 * f + 2))) / 3.0;
    wanted += 0.5 * mesh_.area_normal(f).norm() / (std::sqrt(3.0) / 4.0 * s * s);
  }
  if (wanted <= 0.0) return;
  scale_ = std::clamp(scale_ * std::pow(static_cast<double>(mesh_.live_faces()) / wanted, 0.4), 0.7, 1.4);
}

}  // namespace ostia::meshing
