#include "ostia/meshing/field_sizing.h"

#include "sizing/gradation.h"
#include "sizing/hessian_recovery.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/mixed_mesh_sides.h"
#include "ostia/meshing/boundary_layer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

namespace ostia::meshing {

using geometry::Vec3;

void validate(const FieldSizingOptions& o) {
  const auto in = [](double value, double low, double high, const std::string& name) {
    if (!(value >= low && value <= high))
      throw InvalidInput("refinement: " + name + " " + std::to_string(value) + " must lie in [" +
                         std::to_string(low) + ", " + std::to_string(high) + "]");
  };
  if (!(o.error_share > 0.0 && o.error_share <= 1.0))
    throw InvalidInput("refinement: the error " + std::to_string(o.error_share) +
                       " must be a share of the field's range: above 0, at most 1");
  if (o.elements && !(*o.elements >= 100.0 && *o.elements <= 1e9))
    throw InvalidInput("refinement: " + std::to_string(*o.elements) +
                       " elements; ask for 100 or more, at most 1e9");
  in(o.most_refinement, 0.05, 1.0, "most_refinement");
  in(o.most_coarsening, 1.0, 20.0, "most_coarsening");
  in(o.gradation, 0.01, 2.0, "gradation");
  if (!(o.min_edge_mm >= 0.0) || !(o.max_edge_mm > o.min_edge_mm))
    throw InvalidInput(
        "refinement: the shortest edge (min_edge_mm) must be at least 0 and the longest (max_edge_mm) larger "
        "than it");
}

namespace {

/// A linear interpolation's error on a regular tetrahedron, over the squared edge times the curvature.
constexpr double error_constant = 3.0 / 16.0;

std::string text(const char* format, double a, double b, double c = 0.0) {
  char buffer[240];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

void check(const geometry::MixedMesh& mesh, const MeshField& field) {
  if (mesh.quadratic())
    throw InvalidInput("refinement: the result is on quadratic elements; fields are taken on linear ones");
  const std::size_t elements = mesh.tetrahedra.size() + mesh.prisms.size();
  if (elements == 0) throw InvalidInput("refinement: the result has no tetrahedra or prisms");
  if (field.components < 1 || field.components > 9)
    throw InvalidInput("refinement: the field has " + std::to_string(field.components) +
                       " components; 1 to 9 are taken");
  const std::size_t places = field.at_elements ? elements : mesh.points.size();
  const auto components = static_cast<std::size_t>(field.components);
  if (field.values.size() != places * components)
    throw InvalidInput("refinement: the field has " + std::to_string(field.values.size()) + " numbers for " +
                       std::to_string(places) + (field.at_elements ? " elements" : " nodes") + " of " +
                       std::to_string(components) + " components");
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (!std::isfinite(field.values[i]))
      throw InvalidInput("refinement: the field is not finite at " +
                         std::string(field.at_elements ? "element " : "node ") +
                         std::to_string(i / components) + "; has the solver diverged?");
}

/// The norm of the components' ranges.
double range_of(const MeshField& field) {
  const auto components = static_cast<std::size_t>(field.components);
  double squares = 0.0;
  for (std::size_t c = 0; c < components; ++c) {
    double low = field.values[c], high = low;
    for (std::size_t i = c; i < field.values.size(); i += components) {
      low = std::min(low, field.values[i]);
      high = std::max(high, field.values[i]);
    }
    squares += (high - low) * (high - low);
  }
  return std::sqrt(squares);
}

/// Everything that the lengths depend on, at the nodes.
struct Nodes {
  const geometry::MixedMesh& mesh;
  MeshRing ring;
  std::vector<double> old_edge, curvature, volume;
  std::vector<double> prism_volume;  // of each prism
  double tetrahedron_share = 0.0;    // volume of a tetrahedron over its cubed edge, in the mean

  std::span<const std::int32_t> around(std::size_t i) const {
    return std::span(ring.nodes).subspan(ring.first_node[i], ring.first_node[i + 1] - ring.first_node[i]);
  }
  bool used(std::size_t i) const { return ring.first_node[i] != ring.first_node[i + 1]; }
};

template <class Element, class Edges>
void add_lengths(const std::vector<Vec3>& points, const std::vector<Element>& elements, const Edges& edges,
                 std::vector<double>& sum, std::vector<double>& count) {
  for (const Element& element : elements)
    for (const auto& [a, b] : edges) {
      const auto i = static_cast<std::size_t>(element[a]), j = static_cast<std::size_t>(element[b]);
      const double length = (points[i] - points[j]).norm();
      for (const std::size_t v : {i, j}) sum[v] += length, count[v] += 1.0;
    }
}

/// Mean edge at each node. What a layer's thickness is says nothing of its elements' edges along the wall:
/// the prisms' sides are left out. Averaged over neighbours, since a single node's mean is left to chance,
/// and bounded growth would take the least of them everywhere.
std::vector<double> local_edges(const geometry::MixedMesh& mesh, const Nodes& nodes) {
  constexpr int rounds = 3;
  std::vector<double> edge(mesh.points.size(), 0.0), count(mesh.points.size(), 0.0);
  add_lengths(mesh.points, mesh.tetrahedra, geometry::tetrahedron_edges, edge, count);
  const auto triangle_edges = std::span(geometry::prism_edges).first<6>();
  add_lengths(mesh.points, mesh.prisms, triangle_edges, edge, count);
  for (std::size_t i = 0; i < edge.size(); ++i) edge[i] = count[i] > 0.0 ? edge[i] / count[i] : 1.0;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<double> before = edge;
    core::parallel_for(edge.size(), 4096, [&](std::size_t i) {
      const auto around = nodes.around(i);
      double sum = before[i];
      for (const std::int32_t v : around) sum += before[static_cast<std::size_t>(v)];
      edge[i] = sum / static_cast<double>(around.size() + 1);
    });
  }
  return edge;
}

/// Volumes of the elements, and each node's share of them.
void add_volumes(Nodes& nodes) {
  const geometry::MixedMesh& mesh = nodes.mesh;
  nodes.volume.assign(mesh.points.size(), 0.0);
  const auto at = [&](std::int32_t v) -> const Vec3& { return mesh.points[static_cast<std::size_t>(v)]; };
  double volumes = 0.0, cubes = 0.0;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    const Vec3& a = at(t[0]);
    const double volume = std::abs((at(t[1]) - a).cross(at(t[2]) - a).dot(at(t[3]) - a)) / 6.0;
    volumes += volume;
    for (const std::int32_t v : t) {
      nodes.volume[static_cast<std::size_t>(v)] += volume / 4.0;
      cubes += std::pow(nodes.old_edge[static_cast<std::size_t>(v)], 3) / 4.0;
    }
  }
  if (cubes > 0.0) nodes.tetrahedron_share = volumes / cubes;
  for (const geometry::Prism& p : mesh.prisms) {
    const double volume =
        std::abs(prism_volume({at(p[0]), at(p[1]), at(p[2]), at(p[3]), at(p[4]), at(p[5])}));
    nodes.prism_volume.push_back(volume);
    for (const std::int32_t v : p) nodes.volume[static_cast<std::size_t>(v)] += volume / 6.0;
  }
}

std::vector<double> curvatures(const geometry::MixedMesh& mesh, const Nodes& nodes, const MeshField& field,
                               const core::TaskContext& task) {
  const auto components = static_cast<std::size_t>(field.components);
  const std::vector<Symmetric3> hessians = recovered_hessians(mesh, nodes.ring, field, task);
  std::vector<double> out(mesh.points.size());
  core::parallel_for(out.size(), 2048, [&](std::size_t i) {
    double squares = 0.0;
    for (std::size_t c = 0; c < components; ++c) {
      const double one = largest_curvature(hessians[i * components + c]);
      squares += one * one;
    }
    out[i] = std::sqrt(squares);
  });
  return out;
}

double shortest_allowed(const FieldSizingOptions& o, double old_edge) {
  return std::min(std::max(o.most_refinement * old_edge, o.min_edge_mm), o.most_coarsening * old_edge);
}

std::vector<double> edges_for(const Nodes& nodes, const FieldSizingOptions& o, double error) {
  std::vector<double> edges(nodes.old_edge.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double curvature = nodes.curvature[i], old = nodes.old_edge[i];
    const double longest = o.most_coarsening * old;
    const double wanted = curvature > 0.0 ? std::sqrt(error / (error_constant * curvature)) : longest;
    edges[i] = std::min(std::clamp(wanted, shortest_allowed(o, old), longest), o.max_edge_mm);
  }
  limit_growth(
      nodes.mesh.points, [&](std::size_t i) { return nodes.around(i); }, o.gradation, edges);
  return edges;
}

/// A tetrahedron becomes (old / new)^3, a prism, whose layers stay as many, the square of it. Layers get
/// thinner with the wall's edges, and what they leave is filled with tetrahedra.
double elements_with(const Nodes& nodes, const std::vector<double>& edges) {
  std::vector<double> finer(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) finer[i] = nodes.old_edge[i] / edges[i];
  constexpr double thickest = 1.5;  // of their old thickness: there is no room for more
  double tetrahedra = 0.0, prisms = 0.0;
  for (const geometry::Tetrahedron& t : nodes.mesh.tetrahedra)
    for (const std::int32_t v : t) tetrahedra += std::pow(finer[static_cast<std::size_t>(v)], 3) / 4.0;
  for (std::size_t k = 0; k < nodes.mesh.prisms.size(); ++k)
    for (const std::int32_t v : nodes.mesh.prisms[k]) {
      const auto i = static_cast<std::size_t>(v);
      prisms += finer[i] * finer[i] / 6.0;
      if (nodes.tetrahedron_share > 0.0)
        tetrahedra += nodes.prism_volume[k] / 6.0 * (1.0 - std::min(1.0 / finer[i], thickest)) /
                      (nodes.tetrahedron_share * std::pow(edges[i], 3));
    }
  return std::max(tetrahedra, 0.0) + prisms;
}

double largest_error(const Nodes& nodes, const std::vector<double>& edges) {
  double largest = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    largest = std::max(largest, error_constant * edges[i] * edges[i] * nodes.curvature[i]);
  return largest;
}

/// The error with which as many elements are foretold as are wanted, by halving the interval of its
/// logarithm.
double error_for(double wanted, const Nodes& nodes, const FieldSizingOptions& o, FieldSizing& out,
                 const core::TaskContext& task) {
  constexpr double decades = 8.0, near_enough = 0.005;
  constexpr int most_steps = 24;
  const double most = std::max(out.largest_error, 1e-300) * 4.0 * o.most_coarsening * o.most_coarsening;
  double low = most * std::pow(10.0, -decades), high = most;
  const double fewest = elements_with(nodes, edges_for(nodes, o, high)),
               finest = elements_with(nodes, edges_for(nodes, o, low));
  const bool few = wanted<fewest, many = wanted> finest;
  if (few || many)
    out.warnings.push_back(
        text("%.0f elements are out of reach in one round: it makes %.0f to %.0f", wanted, fewest, finest) +
        (few ? "; allow longer edges than the mesh given has" : "; refine again with the next result"));
  if (few) return high;
  if (many) return low;
  for (int step = 0; step < most_steps; ++step) {
    task.throw_if_cancelled();
    const double middle = std::sqrt(low * high);
    const double elements = elements_with(nodes, edges_for(nodes, o, middle));
    if (std::abs(elements - wanted) <= near_enough * wanted) return middle;
    (elements > wanted ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

void judge(const Nodes& nodes, const FieldSizingOptions& o, FieldSizing& out) {
  double all = 0.0, refined = 0.0, held = 0.0;
  for (std::size_t i = 0; i < nodes.volume.size(); ++i) {
    const double edge = out.sizes.edge_mm[i], old = nodes.old_edge[i];
    all += nodes.volume[i];
    if (edge < 0.95 * old) refined += nodes.volume[i];
    const double wanted = std::sqrt(out.target_error / (error_constant * nodes.curvature[i]));
    if (nodes.curvature[i] > 0.0 && wanted < 0.999 * shortest_allowed(o, old)) held += nodes.volume[i];
  }
  if (all > 0.0) out.refined_share = refined / all, out.held_share = held / all;
}

}  // namespace

FieldSizing sizes_from_field(const geometry::MixedMesh& mesh, const MeshField& field,
                             const FieldSizingOptions& options, const core::TaskContext& task) {
  validate(options);
  check(mesh, field);
  task.set_stage("sizes from the field");
  Nodes nodes{mesh, ring_of(mesh), {}, {}, {}, {}};
  task.set_progress(0.2);
  nodes.old_edge = local_edges(mesh, nodes);
  add_volumes(nodes);
  nodes.curvature = curvatures(mesh, nodes, field, task);
  task.set_progress(0.7);
  FieldSizing out;
  out.old_edge_mm = nodes.old_edge;
  out.range = range_of(field);
  out.largest_error = largest_error(nodes, nodes.old_edge);
  out.elements_before = static_cast<double>(mesh.tetrahedra.size() + mesh.prisms.size());
  if (!(out.range > 0.0)) out.warnings.emplace_back("the field is the same everywhere: it refines nothing");
  out.target_error = options.elements ? error_for(*options.elements, nodes, options, out, task)
                                      : options.error_share * out.range;
  out.sizes.gradation = options.gradation;
  out.sizes.edge_mm = edges_for(nodes, options, std::max(out.target_error, 1e-300));
  out.elements = elements_with(nodes, out.sizes.edge_mm);
  out.reached_error = largest_error(nodes, out.sizes.edge_mm);
  judge(nodes, options, out);
  // Points of no element, such as a file may hold, say nothing.
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (!nodes.used(i)) continue;
    const std::size_t kept = out.sizes.points.size();
    out.sizes.points.push_back(mesh.points[i]);
    out.sizes.edge_mm[kept] = out.sizes.edge_mm[i];
    out.old_edge_mm[kept] = out.old_edge_mm[i];
  }
  out.sizes.edge_mm.resize(out.sizes.points.size());
  out.old_edge_mm.resize(out.sizes.points.size());
  task.set_progress(1.0);
  return out;
}

}  // namespace ostia::meshing
