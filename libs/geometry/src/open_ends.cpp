#include "open_ends.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace ostia::geometry {
namespace {

// Vertices nearer to the plane than this (in grid steps) move onto it, so that the cut leaves no needles
// beside them.
constexpr double snap_distance = 0.3;
// Border edges shorter than this (in grid steps), left where the plane meets needles, shrink to a point.
constexpr double shortest_border_edge = 0.15;
constexpr double smallest_angle = 0.05;

enum class Side : std::uint8_t { kept, on, beyond };

/// Cuts one end of a mesh.
class Cut {
 public:
  Cut(TriMesh& mesh, const FreeEnd& end, const TubeDistance& f, double spacing_mm, bool exact)
      : mesh_(mesh),
        end_(end),
        f_(f),
        spacing_mm_(spacing_mm),
        snap_mm_(snap_distance * spacing_mm),
        exact_(exact) {
    // Beyond the plane the shape is the half ball of the end's radius; nothing farther away is concerned.
    const double reach = 1.3 * end.radius + 2.0 * spacing_mm;
    height_.assign(mesh.points.size(), -reach);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const Vec3 offset = mesh.points[v] - end.centre;
      if (offset.squaredNorm() <= reach * reach) height_[v] = offset.dot(end.normal);
    }
    side_.resize(height_.size());
    for (std::size_t v = 0; v < height_.size(); ++v) side_[v] = height_[v] > 0.0 ? Side::beyond : Side::kept;
  }

  void run() {
    find_triangles_near();
    snap();
    split();
    merge_short_border_edges();
    compact();
  }

 private:
  Side side(std::int32_t v) const { return side_[static_cast<std::size_t>(v)]; }
  const Vec3& point(std::int32_t v) const { return mesh_.points[static_cast<std::size_t>(v)]; }

  void find_triangles_near() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::int32_t v : mesh_.triangles[t]) {
        if (std::abs(height_[static_cast<std::size_t>(v)]) < snap_mm_) around_[v].push_back(t);
      }
    }
  }

  // The nearest point of the plane; within it, to the surface along the surface's gradient in the plane.
  Vec3 on_plane(Vec3 p) const {
    p -= (p - end_.centre).dot(end_.normal) * end_.normal;
    for (int iteration = 0; exact_ && iteration < 40; ++iteration) {
      const TubeDistance::Nearest nearest = f_.nearest(p);
      if (std::abs(nearest.distance) < 1e-12) break;
      Vec3 gradient = (p - nearest.axis_point).normalized();
      gradient -= gradient.dot(end_.normal) * end_.normal;
      const double squared = gradient.squaredNorm();
      if (squared < 0.01) break;
      p -= (nearest.distance / squared) * gradient;
      p -= (p - end_.centre).dot(end_.normal) * end_.normal;
    }
    return p;
  }

  Vec3 area_vector(const Triangle& t, std::int32_t moved, const Vec3& to) const {
    const auto at = [&](std::size_t c) { return t[c] == moved ? to : point(t[c]); };
    return (at(1) - at(0)).cross(at(2) - at(0));
  }

  double longest_squared(const Triangle& t, std::int32_t moved, const Vec3& to) const {
    const auto at = [&](std::size_t c) { return t[c] == moved ? to : point(t[c]); };
    return std::max(
        {(at(1) - at(0)).squaredNorm(), (at(2) - at(1)).squaredNorm(), (at(0) - at(2)).squaredNorm()});
  }

  bool may_snap(std::int32_t v, const Vec3& to) const {
    for (const std::size_t index : around_.at(v)) {
      const Triangle& t = mesh_.triangles[index];
      const auto on = std::count_if(t.begin(), t.end(), [&](std::int32_t c) { return side(c) == Side::on; });
      if (on == 2) return false;  // a triangle wholly in the plane would be neither kept nor cut
      const Vec3 before = area_vector(t, v, point(v)), after = area_vector(t, v, to);
      if (after.dot(before) < 0.3 * before.squaredNorm()) return false;
    }
    return true;
  }

  void snap() {
    std::vector<std::int32_t> candidates;
    for (const auto& entry : around_) candidates.push_back(entry.first);
    const auto off = [&](std::int32_t v) { return std::abs(height_[static_cast<std::size_t>(v)]); };
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](std::int32_t a, std::int32_t b) { return off(a) < off(b); });
    for (const std::int32_t v : candidates) {
      const Vec3 to = on_plane(point(v));
      if (!may_snap(v, to)) continue;
      mesh_.points[static_cast<std::size_t>(v)] = to;
      side_[static_cast<std::size_t>(v)] = Side::on;
    }
  }

  std::int32_t crossing(std::int32_t a, std::int32_t b) {
    const auto [found, fresh] =
        crossings_.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(mesh_.points.size()));
    if (fresh) {
      const Vec3 p = point(a), q = point(b);
      const double ha = (p - end_.centre).dot(end_.normal), hb = (q - end_.centre).dot(end_.normal);
      mesh_.points.push_back(on_plane(p + ha / (ha - hb) * (q - p)));
      side_.push_back(Side::on);
    }
    return found->second;
  }

  // Keeps the part of a triangle below the plane.
  void keep_part(Triangle t, std::vector<Triangle>& kept) {
    const auto beyond =
        std::count_if(t.begin(), t.end(), [&](std::int32_t v) { return side(v) == Side::beyond; });
    const auto below =
        std::count_if(t.begin(), t.end(), [&](std::int32_t v) { return side(v) == Side::kept; });
    if (below == 0) return;
    if (beyond == 0) {
      kept.push_back(t);
      return;
    }
    // Turn the triangle until its only vertex of a side is the first.
    const Side lone = below == 1 ? Side::kept : Side::beyond;
    while (side(t[0]) != lone) std::rotate(t.begin(), t.begin() + 1, t.end());
    if (below == 2) {
      const std::int32_t ab = crossing(t[0], t[1]), ca = crossing(t[2], t[0]);
      const bool first_shorter =
          (point(ab) - point(t[2])).squaredNorm() < (point(t[1]) - point(ca)).squaredNorm();
      if (first_shorter) {
        kept.insert(kept.end(), {{ab, t[1], t[2]}, {ab, t[2], ca}});
      } else {
        kept.insert(kept.end(), {{ab, t[1], ca}, {t[1], t[2], ca}});
      }
      return;
    }
    const std::int32_t second = side(t[1]) == Side::on ? t[1] : crossing(t[0], t[1]);
    const std::int32_t third = side(t[2]) == Side::on ? t[2] : crossing(t[2], t[0]);
    kept.push_back({t[0], second, third});
  }

  void split() {
    std::vector<Triangle> kept;
    kept.reserve(mesh_.triangles.size());
    for (const Triangle& t : mesh_.triangles) keep_part(t, kept);
    mesh_.triangles = std::move(kept);
  }

  void merge_short_border_edges() {
    around_.clear();
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::int32_t v : mesh_.triangles[t]) {
        if (side(v) == Side::on) around_[v].push_back(t);
      }
    }
    for (auto& entry : around_) {
      while (merge_into(entry.first)) {
      }
    }
    std::erase_if(mesh_.triangles, [](const Triangle& t) { return t[0] < 0; });
  }

  // Merges one border neighbour that is too near into `a`; whether there was one.
  bool merge_into(std::int32_t a) {
    for (const std::size_t index : around_.at(a)) {
      for (const std::int32_t b : mesh_.triangles[index]) {
        if (b == a || side(b) != Side::on || !may_merge(a, b)) continue;
        merge(a, b);
        return true;
      }
    }
    return false;
  }

  std::set<std::int32_t> neighbours(std::int32_t v) const {
    std::set<std::int32_t> result;
    for (const std::size_t t : around_.at(v))
      result.insert(mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    result.erase(v);
    return result;
  }

  static bool has(const Triangle& t, std::int32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); }

  bool may_merge(std::int32_t a, std::int32_t b) const {
    if ((point(a) - point(b)).norm() > shortest_border_edge * spacing_mm_) return false;
    const auto& of_b = around_.at(b);
    if (std::count_if(of_b.begin(), of_b.end(), [&](std::size_t t) { return has(mesh_.triangles[t], a); }) !=
        1) {
      return false;  // not on the border
    }
    const std::set<std::int32_t> near_a = neighbours(a), near_b = neighbours(b);
    const auto common =
        std::count_if(near_a.begin(), near_a.end(), [&](std::int32_t v) { return near_b.count(v) > 0; });
    if (common != 1) return false;
    return std::all_of(of_b.begin(), of_b.end(), [&](std::size_t index) {
      const Triangle& t = mesh_.triangles[index];
      if (has(t, a)) return true;
      const Vec3 before = area_vector(t, b, point(b)), after = area_vector(t, b, point(a));
      if (after.dot(before) <= 0.5 * after.norm() * before.norm()) return false;
      // Nor does a needle come of it: height over length of the triangle, about its smallest angle.
      return after.norm() > smallest_angle * longest_squared(t, b, point(a));
    });
  }

  void merge(std::int32_t a, std::int32_t b) {
    std::vector<std::size_t> joined;
    for (const std::size_t index : around_.at(b)) {
      Triangle& t = mesh_.triangles[index];
      if (!has(t, a)) {
        std::replace(t.begin(), t.end(), b, a);
        joined.push_back(index);
        continue;
      }
      for (const std::int32_t v : t) {
        if (v != b && side(v) == Side::on) std::erase(around_.at(v), index);
      }
      t = {-1, -1, -1};
    }
    auto& of_a = around_.at(a);
    of_a.insert(of_a.end(), joined.begin(), joined.end());
    around_.at(b).clear();
  }

  void compact() {
    std::vector<std::int32_t> place(mesh_.points.size(), -1);
    for (const Triangle& t : mesh_.triangles) {
      for (const std::int32_t v : t) place[static_cast<std::size_t>(v)] = 0;
    }
    std::int32_t next = 0;
    for (std::size_t v = 0; v < place.size(); ++v) {
      if (place[v] < 0) continue;
      mesh_.points[static_cast<std::size_t>(next)] = mesh_.points[v];
      place[v] = next++;
    }
    mesh_.points.resize(static_cast<std::size_t>(next));
    for (Triangle& t : mesh_.triangles) {
      for (std::int32_t& v : t) v = place[static_cast<std::size_t>(v)];
    }
  }

  TriMesh& mesh_;
  const FreeEnd& end_;
  const TubeDistance& f_;
  double spacing_mm_, snap_mm_;
  bool exact_;
  std::vector<double> height_;  // above the plane; far away well below
  std::vector<Side> side_;
  std::map<std::int32_t, std::vector<std::size_t>> around_;  // triangles at the vertices that may snap
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> crossings_;
};

}  // namespace

std::vector<FreeEnd> free_ends(const AnalyticShape& shape) {
  std::vector<FreeEnd> ends;
  for (std::size_t i = 0; i < shape.tubes.size(); ++i) {
    const Centerline& axis = shape.tubes[i].axis;
    if ((axis.points.front() - axis.points.back()).norm() < 1e-9) continue;
    AnalyticShape others;
    for (std::size_t j = 0; j < shape.tubes.size(); ++j) {
      if (j != i) others.tubes.push_back(shape.tubes[j]);
    }
    const auto covered = [&](const Vec3& p) {
      return !others.tubes.empty() && TubeDistance(others)(p) < 0.0;
    };
    if (!covered(axis.points.front())) {
      ends.push_back({axis.points.front(), -axis.frames.front().tangent, axis.radius.front()});
    }
    if (!covered(axis.points.back())) {
      ends.push_back({axis.points.back(), axis.frames.back().tangent, axis.radius.back()});
    }
  }
  return ends;
}

void cut_flat(TriMesh& mesh, const FreeEnd& end, const TubeDistance& f, double spacing_mm, bool exact) {
  Cut(mesh, end, f, spacing_mm, exact).run();
}

}  // namespace ostia::geometry
