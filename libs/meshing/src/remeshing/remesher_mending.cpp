// The worst triangles of a remeshed surface: flips, collapses, and points moved to open the smallest angle
// around them.
#include "remeshing/remesher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::meshing {

using geometry::Vec3;

double Remesher::worst_angle_cosine(std::int32_t v, const Vec3& p) const {
  double worst = 0.0;
  mesh_.around(v, [&](std::int32_t e) {
    worst = std::max(
        worst, min_angle_cosine(p, mesh_.at(mesh_.target(e)), mesh_.at(mesh_.origin(EditMesh::prev(e)))));
  });
  return worst;
}

// A pattern search in the tangent plane (or along the border curve): steps that open the smallest angle
// around v.
bool Remesher::optimise_vertex(std::int32_t v) {
  bool moved = false;
  double best = worst_angle_cosine(v, mesh_.at(v));
  auto attempt = [&](const Place& place) {
    const double now = worst_angle_cosine(v, place.point);
    if (now >= best - 1e-6 || !move_is_safe(v, place)) return false;
    move(v, place);
    best = now;
    return moved = true;
  };
  attempt(relaxed_place(v));
  for (double step = 0.2 * size(v); step > 0.02 * size(v); step *= 0.5) {
    if (mesh_.border(v)) {
      const BorderCurve& border = curves_[static_cast<std::size_t>(curve(v))];
      for (const double sign : {1.0, -1.0}) {
        const double arc = arc_[static_cast<std::size_t>(v)] + sign * step;
        attempt({border.at(arc), normal(v), size(v), arc});
      }
      continue;
    }
    const Vec3 u = normal(v).unitOrthogonal(), w = normal(v).cross(u);
    for (int k = 0; k < 8; ++k) {
      const double angle = k * std::numbers::pi / 4.0;
      const Vec3 p = mesh_.at(v) + step * (std::cos(angle) * u + std::sin(angle) * w);
      if (worst_angle_cosine(v, p) >= best) continue;  // spares the projection
      const auto sample = reference_.project(p);
      attempt({sample.point, sample.normal, sample.size, 0.0});
    }
  }
  return moved;
}

bool Remesher::mend_face(std::int32_t f) {
  bool changed = false;
  std::array<std::int32_t, 3> h{3 * f, 3 * f + 1, 3 * f + 2};
  for (const std::int32_t e : h)
    if (flip_raises_angle(e)) {
      mesh_.flip(e);
      ++flips;
      return true;
    }
  std::sort(h.begin(), h.end(), [&](std::int32_t x, std::int32_t y) {
    return std::pair(mesh_.length(x), x) < std::pair(mesh_.length(y), y);
  });
  const std::int32_t t = mesh_.twin(h[0]);
  if (try_collapse(h[0], true) || (t != EditMesh::none && try_collapse(t, true))) return true;
  // A point with too few neighbours goes; its star closes over it.
  for (const std::int32_t e : h) {
    const std::int32_t v = mesh_.origin(e);
    if (mesh_.border(v) || mesh_.valence(v) > 4) continue;
    bool gone = false;
    std::vector<std::int32_t> spokes;
    mesh_.around(v, [&](std::int32_t s) { spokes.push_back(s); });
    for (const std::int32_t s : spokes)
      if (!gone) gone = try_collapse(s, true);
    if (gone) return true;
  }
  for (const std::int32_t e : h) changed = optimise_vertex(mesh_.origin(e)) || changed;
  return changed;
}

std::size_t Remesher::mend(double below_angle_deg) {
  const double bound = std::cos(below_angle_deg * std::numbers::pi / 180.0);
  std::size_t bad = 0;
  auto cosine = [&](std::int32_t f) {
    return min_angle_cosine(mesh_.at(mesh_.origin(3 * f)), mesh_.at(mesh_.origin(3 * f + 1)),
                            mesh_.at(mesh_.origin(3 * f + 2)));
  };
  for (std::int32_t f = 0; f < mesh_.face_count(); ++f) {
    if (!mesh_.alive_face(f) || cosine(f) <= bound) continue;
    if (bad++ % 256 == 0) task_->throw_if_cancelled();
    mend_face(f);
  }
  return bad;
}

}  // namespace ostia::meshing
