#include "ostia/meshing/quadratic.h"

#include "boundary_layer/wall.h"
#include "quadratic/jacobian.h"
#include "quadratic/nodes.h"
#include "quadratic/projection.h"
#include "quality/mixed_elements.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/meshing/boundary_layer.h"
#include "ostia/meshing/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ostia::meshing {

using geometry::MixedMesh;
using geometry::Vec3;

void validate(const QuadraticOptions& o) {
  auto in = [](double value, double low, double high, const std::string& name) {
    if (!(value >= low && value <= high))
      throw InvalidInput("quadratic elements: " + name + " " + std::to_string(value) + " must lie in [" +
                         std::to_string(low) + ", " + std::to_string(high) + "]");
  };
  in(o.min_jacobian_ratio, 0.01, 0.9, "min_jacobian_ratio");
  if (!(o.max_displacement > 0.0 && o.max_displacement <= 1.0))
    throw InvalidInput("quadratic elements: max_displacement " + std::to_string(o.max_displacement) +
                       " must lie in (0, 1] edges");
  in(o.decay_length, 1.5, 20.0, "decay_length");
  in(o.max_rounds, 1, 100, "max_rounds");
}

namespace {

constexpr std::size_t element_grain = 2048;

/// The wall's nodes on their way to the reference, with all that follows them.
class Bending {
 public:
  Bending(SecondOrder& second, std::vector<WallNode> wall, std::vector<LayerNode> followers,
          std::vector<Projection> ways, const QuadraticOptions& options)
      : wall_(std::move(wall)),
        ways_(std::move(ways)),
        share_(wall_.size(), 1.0),
        second_(second),
        options_(options) {
    const MixedMesh& mesh = second.mesh;
    wall_of_.assign(mesh.points.size(), -1);
    factor_.assign(mesh.points.size(), 0.0);
    straight_ = mesh.points;
    for (std::size_t i = 0; i < wall_.size(); ++i) follow(wall_[i].node, i, 1.0);
    for (const LayerNode& node : followers) {
      const auto i = static_cast<std::size_t>(node.wall_node);
      const double reach = std::max(node.whole, options.decay_length * ways_[i].displacement.norm());
      const double factor = reach > 0.0 ? 1.0 - node.depth / reach : 0.0;
      if (factor > 1e-12) follow(node.node, i, factor);
    }
    bend();
    find_bent();
  }

  /// Moves back until all elements are good enough. Returns the rounds.
  int untangle(const core::TaskContext& task);
  const std::vector<WallNode>& wall() const { return wall_; }
  const std::vector<double>& shares() const { return share_; }
  const std::vector<Projection>& ways() const { return ways_; }

 private:
  struct Element {
    std::size_t index;
    bool prism;
  };

  void follow(std::int32_t node, std::size_t wall_node, double factor) {
    wall_of_[static_cast<std::size_t>(node)] = static_cast<std::int32_t>(wall_node);
    factor_[static_cast<std::size_t>(node)] = factor;
  }
  void bend();
  void find_bent();
  bool good(const Element& element) const;
  template <class Visit>
  void for_each_wall_node(const Element& element, const Visit& visit) const {
    const MixedMesh& mesh = second_.mesh;
    auto all = [&](const auto& nodes) {
      for (const std::int32_t node : nodes)
        if (const std::int32_t w = wall_of_[static_cast<std::size_t>(node)]; w >= 0)
          visit(static_cast<std::size_t>(w));
    };
    if (element.prism)
      all(mesh.prism_nodes[element.index]);
    else
      all(mesh.tetrahedron_nodes[element.index]);
  }

  std::vector<WallNode> wall_;
  std::vector<Projection> ways_;
  std::vector<double> share_;  // of the way that each wall node goes
  SecondOrder& second_;
  const QuadraticOptions& options_;
  std::vector<std::int32_t> wall_of_;  // of each node
  std::vector<double> factor_;
  std::vector<Vec3> straight_;
  std::vector<Element> bent_;
};

void Bending::bend() {
  MixedMesh& mesh = second_.mesh;
  const auto first = static_cast<std::size_t>(second_.first_edge_node),
             quads = static_cast<std::size_t>(second_.first_quad_node);
  const auto displaced = [&](std::size_t node) -> Vec3 {
    const std::int32_t w = wall_of_[node];
    if (w < 0) return Vec3::Zero();
    const auto i = static_cast<std::size_t>(w);
    return (share_[i] * factor_[node]) * ways_[i].displacement;
  };
  core::parallel_for(quads - first, element_grain, [&](std::size_t e) {
    const std::size_t node = first + e;
    if (wall_of_[node] >= 0) mesh.points[node] = straight_[node] + displaced(node);
  });
  core::parallel_for(second_.quad_edges.size(), element_grain, [&](std::size_t q) {
    const std::size_t node = quads + q;
    Vec3 way = displaced(node);
    // The middle of the surface blended between its four edges (Coons).
    if (wall_of_[node] < 0)
      for (const std::int32_t edge : second_.quad_edges[q])
        way += 0.5 * displaced(static_cast<std::size_t>(edge));
    mesh.points[node] = way.isZero(0.0) ? straight_[node] : Vec3(straight_[node] + way);
  });
}

void Bending::find_bent() {
  const MixedMesh& mesh = second_.mesh;
  const auto add = [&](const Element& element) {
    bool moves = false;
    for_each_wall_node(element, [&](std::size_t w) { moves = moves || ways_[w].found; });
    if (moves) bent_.push_back(element);
  };
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) add({i, false});
  for (std::size_t i = 0; i < mesh.prisms.size(); ++i) add({i, true});
}

/// The share of the straight element's Jacobian that a bent one must keep: more where that is flat already.
double share_to_keep(double straight_scaled_jacobian, double least_ratio) {
  constexpr double least_scaled_jacobian = 0.05;
  if (!(straight_scaled_jacobian > 0.0)) return least_ratio;
  return std::clamp(least_scaled_jacobian / straight_scaled_jacobian, least_ratio, 1.0);
}

bool Bending::good(const Element& element) const {
  const double least = options_.min_jacobian_ratio;
  if (element.prism) {
    const PrismNodes p = prism_nodes(second_.mesh, element.index);
    const double scaled = prism_scaled_jacobian({p[0], p[1], p[2], p[3], p[4], p[5]});
    return keeps_jacobian(p, share_to_keep(scaled, least));
  }
  const TetrahedronNodes p = tetrahedron_nodes(second_.mesh, element.index);
  return keeps_jacobian(p, share_to_keep(scaled_jacobian(p[0], p[1], p[2], p[3]), least));
}

int Bending::untangle(const core::TaskContext& task) {
  constexpr double step_back = 0.6;
  std::vector<char> changed(wall_.size(), 1), touched(bent_.size()), fine(bent_.size(), 1);
  int rounds = 0;
  while (true) {
    task.throw_if_cancelled();
    core::parallel_for(bent_.size(), 256, [&](std::size_t i) {
      touched[i] = 0;
      for_each_wall_node(bent_[i], [&](std::size_t w) { touched[i] = touched[i] | changed[w]; });
      if (touched[i] != 0) fine[i] = good(bent_[i]) ? 1 : 0;
    });
    std::fill(changed.begin(), changed.end(), 0);
    bool any = false;
    for (std::size_t i = 0; i < bent_.size(); ++i) {
      if (fine[i] != 0) continue;
      for_each_wall_node(bent_[i], [&](std::size_t w) {
        if (changed[w] != 0 || share_[w] == 0.0 || !ways_[w].found) return;
        changed[w] = 1;
        share_[w] = rounds < options_.max_rounds ? step_back * share_[w] : 0.0;
        if (share_[w] < 0.05) share_[w] = 0.0;
        any = true;
      });
    }
    if (!any) return rounds;
    ++rounds;
    bend();
  }
}

std::string formatted(const char* format, double a, double b) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

void report_wall(const Bending& bending, const MixedMesh& mesh, const geometry::AabbTree& tree,
                 QuadraticReport& report) {
  constexpr double rounding = 1e-7;  // of the edge
  const std::vector<WallNode>& wall = bending.wall();
  std::vector<double> distances(wall.size());
  core::parallel_for(wall.size(), 512, [&](std::size_t i) {
    distances[i] = tree.closest(mesh.points[static_cast<std::size_t>(wall[i].node)]).distance;
  });
  report.wall_nodes = wall.size();
  for (std::size_t i = 0; i < wall.size(); ++i) {
    const Vec3& p = mesh.points[static_cast<std::size_t>(wall[i].node)];
    const bool found = bending.ways()[i].found;
    if (!found) ++report.not_projected;
    if (found && bending.shares()[i] < 1.0) ++report.moved_back;
    const bool on = distances[i] <= rounding * wall[i].length;
    if (on)
      ++report.on_reference;
    else
      report.places.push_back({p, found ? bending.shares()[i] : 0.0, distances[i]});
    report.max_distance_mm = std::max(report.max_distance_mm, distances[i]);
    report.mean_distance_mm += distances[i] / static_cast<double>(wall.size());
    report.max_displacement_mm = std::max(report.max_displacement_mm, (p - wall[i].straight).norm());
  }
  std::stable_sort(report.places.begin(), report.places.end(),
                   [](const auto& a, const auto& b) { return a.distance_mm > b.distance_mm; });
  constexpr std::size_t most = 20;
  if (report.places.size() > most) report.places.resize(most);
}

struct ElementSums {
  double volume = 0.0, straight_volume = 0.0, least_ratio = 1.0;
  std::size_t inverted = 0;
};

template <class Nodes>
ElementSums sums_of(std::size_t count, const Nodes& nodes_of, const core::TaskContext& task) {
  return core::parallel_reduce(
      count, element_grain, ElementSums{},
      [&](std::size_t first, std::size_t last) {
        task.throw_if_cancelled();
        ElementSums sums;
        for (std::size_t i = first; i < last; ++i) {
          const auto nodes = nodes_of(i);
          const ElementJacobian j = element_jacobian(nodes);
          sums.volume += j.volume_mm3;
          sums.straight_volume += j.straight_volume_mm3;
          sums.least_ratio = std::min(sums.least_ratio, j.ratio());
          sums.inverted += j.lower > 0.0 ? 0 : 1;
        }
        return sums;
      },
      [](const ElementSums& a, const ElementSums& b) {
        return ElementSums{a.volume + b.volume, a.straight_volume + b.straight_volume,
                           std::min(a.least_ratio, b.least_ratio), a.inverted + b.inverted};
      });
}

void report_elements(const MixedMesh& mesh, QuadraticReport& report, const core::TaskContext& task) {
  for (const ElementSums& sums :
       {sums_of(
            mesh.tetrahedra.size(), [&](std::size_t i) { return tetrahedron_nodes(mesh, i); }, task),
        sums_of(
            mesh.prisms.size(), [&](std::size_t i) { return prism_nodes(mesh, i); }, task)}) {
    report.volume_mm3 += sums.volume;
    report.straight_volume_mm3 += sums.straight_volume;
    report.min_jacobian_ratio = std::min(report.min_jacobian_ratio, sums.least_ratio);
    report.inverted += sums.inverted;
  }
}

void add_warnings(QuadraticReport& report) {
  const std::string where = report.places.empty() ? "" : " near " + place_text(report.places[0].point);
  const std::string farthest =
      formatted("; the farthest is %.3g mm from the reference", report.max_distance_mm, 0.0) + where;
  const std::string of_nodes = " of " + std::to_string(report.wall_nodes) + " nodes of the wall ";
  if (report.moved_back > 0)
    report.warnings.push_back(std::to_string(report.moved_back) + of_nodes +
                              "were moved back towards the straight edge to keep elements valid" + farthest);
  if (report.not_projected > 0)
    report.warnings.push_back(std::to_string(report.not_projected) + of_nodes +
                              "have no reference surface near them and stay straight" + farthest);
  if (report.inverted > 0)
    report.warnings.push_back(std::to_string(report.inverted) +
                              " elements are inverted, as they are in the linear mesh; mend that first");
}

}  // namespace

QuadraticMesh make_quadratic(const MixedMesh& linear, const geometry::TriMesh& reference_wall,
                             const QuadraticOptions& options, const core::TaskContext& task) {
  validate(options);
  if (linear.quadratic()) throw InvalidInput("quadratic elements: the mesh is quadratic already");
  check_lists(linear, "quadratic elements");
  if (reference_wall.triangles.empty())
    throw InvalidInput("quadratic elements: the reference surface has no triangles");
  task.set_stage("quadratic elements");
  const geometry::AabbTree tree(reference_wall);
  task.set_progress(0.1);
  QuadraticMesh result;
  {
    const EdgeNumbers edges(linear);
    SecondOrder second = with_straight_nodes(linear, edges, task);
    task.set_progress(0.3);
    std::vector<WallNode> wall = wall_nodes(second);
    std::vector<Projection> ways =
        projections(wall, reference_wall, tree, options.max_displacement, task.sub(0.3, 0.5));
    std::vector<LayerNode> followers = layer_nodes(second, edges, wall);
    Bending bending(second, std::move(wall), std::move(followers), std::move(ways), options);
    task.set_progress(0.5);
    result.report.rounds = bending.untangle(task);
    task.set_progress(0.8);
    report_wall(bending, second.mesh, tree, result.report);
    result.mesh = std::move(second.mesh);
  }
  report_elements(result.mesh, result.report, task);
  add_warnings(result.report);
  task.set_progress(1.0);
  return result;
}

}  // namespace ostia::meshing
