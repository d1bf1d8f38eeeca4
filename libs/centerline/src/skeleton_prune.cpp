#include "graph_editor.h"

#include "ostia/centerline/skeleton_edit.h"
#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace ostia::centerline {
namespace {

using detail::GraphEditor;

class Pruning {
 public:
  Pruning(const SkeletonGraph& graph, const PruneOptions& options) : editor_(graph), options_(options) {}

  SkeletonGraph run() {
    std::vector<std::int32_t> ids;
    for (const auto& [id, e] : editor_.edges()) ids.push_back(id);
    for (const std::int32_t id : ids) offer(id);
    while (!leaves_.empty()) {
      const std::int32_t id = leaves_.begin()->second;
      leaves_.erase(leaves_.begin());
      remove(id);
    }
    if (options_.isolated) {
      std::vector<std::int32_t> alone;
      for (const auto& [id, n] : editor_.nodes())
        if (editor_.degree(id) == 0) alone.push_back(id);
      for (const std::int32_t id : alone) editor_.remove_node(id);
    }
    return editor_.graph();
  }

 private:
  bool goes(const SkeletonEdge& e, double length) const {
    const std::size_t a = editor_.degree(e.from), b = editor_.degree(e.to);
    if (e.from == e.to || std::min(a, b) > 1) return false;
    if (a == 1 && b == 1) return options_.isolated && length < options_.length_mm;
    if (a == 2 || b == 2) return false;
    const double radius = editor_.nodes().at(a == 1 ? e.to : e.from).radius_mm;
    return length < options_.length_mm || length <= options_.junction_radii * radius;
  }

  void offer(std::int32_t id) {
    const SkeletonEdge& e = editor_.edges().at(id);
    const double length = length_mm(e);
    if (goes(e, length)) leaves_.insert({length, id});
  }

  void remove(std::int32_t id) {
    const SkeletonEdge leaf = editor_.edges().at(id);
    editor_.remove_edge(id);
    for (const std::int32_t n : {leaf.from, leaf.to}) {
      if (editor_.degree(n) == 0) {
        editor_.remove_node(n);
      } else if (editor_.degree(n) == 1) {
        renew(*editor_.edges_at(n).begin());
      } else if (editor_.degree(n) == 2) {
        join(n);
      }
    }
  }

  void renew(std::int32_t id) {
    forget(id);
    offer(id);
  }
  void forget(std::int32_t id) { leaves_.erase({length_mm(editor_.edges().at(id)), id}); }

  void join(std::int32_t n) {
    for (const std::int32_t id : editor_.edges_at(n)) forget(id);
    const std::int32_t joined = editor_.join_at(n);
    if (joined >= 0) offer(joined);
  }

  GraphEditor editor_;
  PruneOptions options_;
  std::set<std::pair<double, std::int32_t>> leaves_;
};

struct Ray {
  const imaging::MaskVolume& mask;
  Vec3 from, direction;

  // The mask between voxels, 0 beyond the image.
  double value(double t) const {
    const Vec3 at = mask.geometry.index(from + t * direction);
    const std::array<std::int64_t, 3> low{static_cast<std::int64_t>(std::floor(at.x())),
                                          static_cast<std::int64_t>(std::floor(at.y())),
                                          static_cast<std::int64_t>(std::floor(at.z()))};
    double sum = 0.0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      std::array<std::int64_t, 3> c{};
      bool inside = true;
      for (std::size_t d = 0; d < 3; ++d) {
        const auto step = static_cast<std::int64_t>(corner >> d & 1U);
        const double part = at[static_cast<Eigen::Index>(d)] - static_cast<double>(low[d]);
        weight *= step != 0 ? part : 1.0 - part;
        c[d] = low[d] + step;
        inside = inside && c[d] >= 0 && c[d] < mask.geometry.size[d];
      }
      if (inside && mask(c[0], c[1], c[2]) != 0) sum += weight;
    }
    return sum;
  }

  // Where the mask falls to one half; below 0 where the ray begins outside or does not leave within `most`.
  double way_out(double most) const {
    const double step = 0.1 * mask.geometry.spacing.minCoeff();
    double before = value(0.0);
    if (before < 0.5) return -1.0;
    for (double t = step; t <= most; t += step) {
      const double now = value(t);
      if (now < 0.5) return t - step * (0.5 - now) / (before - now);
      before = now;
    }
    return -1.0;
  }
};

// A stub, too, keeps a part that tells where it leads.
constexpr double most_of_branch = 0.5;

// The line whose last point is the node: what is kept, at least two points, with the end moved to the wall.
void lead_out(GraphEditor& editor, std::int32_t id, std::int32_t node, const imaging::MaskVolume& mask,
              const EndOptions& options) {
  const SkeletonEdge line = editor.edges().at(id);
  const double whole = length_mm(line);
  // The radius where the end's own course begins: the widest within a radius of it.
  const std::vector<double> s = geometry::abscissas(line.points);
  double radius = line.radius_mm.back();
  for (std::size_t i = line.points.size(); i-- > 0 && whole - s[i] <= 2.0 * radius;)
    radius = std::max(radius, line.radius_mm[i]);
  const double trimmed = std::min(options.trimmed_radii * radius, most_of_branch * whole);
  const geometry::PolylineLocation last = geometry::at_abscissa(line.points, whole - trimmed);
  SkeletonEdge kept = line;
  kept.points.resize(last.segment + 1);
  kept.radius_mm.resize(last.segment + 1);
  if ((last.point - kept.points.back()).norm() > 1e-9) {
    kept.points.push_back(last.point);
    kept.radius_mm.push_back((1.0 - last.t) * line.radius_mm[last.segment] +
                             last.t * line.radius_mm[last.segment + 1]);
  }
  if (kept.points.size() < 2) return;
  const auto [start, direction] = detail::line_end(kept, false, options.direction_mm);
  if (direction.isZero()) return;
  const double most =
      trimmed + options.most_radii * radius + options.most_voxels * mask.geometry.spacing.maxCoeff();
  const double way = Ray{mask, start, direction}.way_out(most);
  if (way <= 1e-9) return;
  const double radius_there = kept.radius_mm.back();
  kept.points.back() = start;
  const double step = mask.geometry.spacing.minCoeff();
  const auto pieces = static_cast<int>(std::max(1.0, std::ceil(way / step)));
  for (int i = 1; i <= pieces; ++i) {
    kept.points.push_back(start + direction * (way * i / pieces));
    kept.radius_mm.push_back(radius_there);
  }
  editor.node(node).position = kept.points.back();
  editor.node(node).radius_mm = radius_there;
  editor.replace_line(id, std::move(kept.points), std::move(kept.radius_mm));
}

void extend_end(GraphEditor& editor, std::int32_t node, const imaging::MaskVolume& mask,
                const EndOptions& options) {
  const std::int32_t id = *editor.edges_at(node).begin();
  const bool leads_away = editor.edges().at(id).from == node;
  if (leads_away) editor.reverse(id);  // the end comes last
  lead_out(editor, id, node, mask, options);
  if (leads_away) editor.reverse(id);
}

}  // namespace

void validate(const PruneOptions& o) {
  detail::require(o.length_mm >= 0.0 && o.length_mm <= 1000.0, "pruning", "length_mm", o.length_mm,
                  "[0, 1000] mm");
  detail::require(o.junction_radii >= 0.0 && o.junction_radii <= 5.0, "pruning", "junction_radii",
                  o.junction_radii, "[0, 5]");
}

SkeletonGraph pruned(const SkeletonGraph& graph, const PruneOptions& options) {
  validate(options);
  detail::require_sound(graph, "pruning");
  return Pruning(graph, options).run();
}

void validate(const EndOptions& o) {
  detail::require(o.trimmed_radii >= 0.0 && o.trimmed_radii <= 3.0, "skeleton ends", "trimmed_radii",
                  o.trimmed_radii, "[0, 3]");
  detail::require(o.direction_mm > 0.0 && o.direction_mm <= 50.0, "skeleton ends", "direction_mm",
                  o.direction_mm, "(0, 50] mm");
  detail::require(o.most_radii >= 0.0 && o.most_radii <= 20.0, "skeleton ends", "most_radii", o.most_radii,
                  "[0, 20]");
  detail::require(o.most_voxels >= 0.0 && o.most_voxels <= 20.0, "skeleton ends", "most_voxels",
                  o.most_voxels, "[0, 20]");
}

SkeletonGraph ends_extended(const SkeletonGraph& graph, const imaging::MaskVolume& mask,
                            const EndOptions& options) {
  validate(options);
  detail::require_sound(graph, "skeleton ends");
  if (mask.voxels.empty() || static_cast<std::int64_t>(mask.voxels.size()) != mask.geometry.voxels())
    throw InvalidInput("skeleton ends: the mask's geometry does not fit its " +
                       std::to_string(mask.voxels.size()) + " voxels");
  GraphEditor editor(graph);
  for (const SkeletonNode& n : graph.nodes)
    if (editor.degree(n.id) == 1) extend_end(editor, n.id, mask, options);
  SkeletonGraph result = editor.graph();
  result.oriented = graph.oriented;
  return result;
}

}  // namespace ostia::centerline
