#include "quadratic/jacobian.h"

#include "quadratic/bernstein.h"
#include "quality/mixed_elements.h"

#include "ostia/meshing/boundary_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// A prism's nodes at its three levels: corners, then edges 01 12 20 of each.
constexpr std::array<std::array<std::size_t, 6>, 3> prism_levels{
    {{0, 1, 2, 6, 7, 8}, {12, 13, 14, 15, 16, 17}, {3, 4, 5, 9, 10, 11}}};

/// Which control point belongs to two corners of a tetrahedron; of a triangle with the first three of each.
constexpr std::array<std::array<std::size_t, 4>, 4> tetrahedron_pair{
    {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3}}};
constexpr std::array<std::array<std::size_t, 3>, 3> triangle_pair{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

/// The control point of a parabola through three points.
Vec3 control(const Vec3& a, const Vec3& middle, const Vec3& b) {
  return 2.0 * middle - 0.5 * (a + b);
}

TetrahedronNodes controls(const TetrahedronNodes& nodes) {
  TetrahedronNodes points = nodes;
  for (std::size_t e = 0; e < 6; ++e)
    points[4 + e] = control(nodes[tetrahedron_edges[e][0]], nodes[4 + e], nodes[tetrahedron_edges[e][1]]);
  return points;
}

using PrismControls = std::array<std::array<Vec3, 6>, 3>;
PrismControls controls(const PrismNodes& nodes) {
  PrismControls points;
  for (std::size_t level = 0; level < 3; ++level) {
    for (std::size_t i = 0; i < 6; ++i) points[level][i] = nodes[prism_levels[level][i]];
    for (std::size_t e = 0; e < 3; ++e)
      points[level][3 + e] = control(points[level][e], points[level][3 + e], points[level][(e + 1) % 3]);
  }
  for (std::size_t i = 0; i < 6; ++i) points[1][i] = control(points[0][i], points[1][i], points[2][i]);
  return points;
}

/// Coefficients of (a x b) . c.
template <std::size_t Inner, std::size_t Out, std::size_t A, std::size_t C>
std::array<double, Out> triple_product(const std::array<Vec3, A>& a, const std::array<Vec3, A>& b,
                                       const std::array<Vec3, C>& c, const std::vector<ProductTerm>& cross,
                                       const std::vector<ProductTerm>& dot) {
  std::array<Vec3, Inner> normal;
  normal.fill(Vec3::Zero());
  for (const ProductTerm& term : cross) normal[term.out] += term.weight * a[term.a].cross(b[term.b]);
  std::array<double, Out> out{};
  for (const ProductTerm& term : dot) out[term.out] += term.weight * normal[term.a].dot(c[term.b]);
  return out;
}

struct TetrahedronTables {
  std::vector<Powers> one = simplex_powers(4, 1), two = simplex_powers(4, 2), three = simplex_powers(4, 3);
  std::vector<ProductTerm> cross = product_terms(one, one, two), dot = product_terms(two, one, three);
  BernsteinDomain domain = bernstein_domain(three, {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
};
const TetrahedronTables& tetrahedron_tables() {
  static const TetrahedronTables tables;
  return tables;
}

struct PrismTables {
  std::vector<Powers> across = prism_powers(1, 2), along = prism_powers(2, 1), normal = prism_powers(2, 4),
                      all = prism_powers(4, 5);
  std::vector<ProductTerm> cross = product_terms(across, across, normal),
                           dot = product_terms(normal, along, all);
  BernsteinDomain domain = bernstein_domain(all, {{0, 1}, {0, 2}, {1, 2}, {3, 4}});
};
const PrismTables& prism_tables() {
  static const PrismTables tables;
  return tables;
}

template <std::size_t N>
double mean_magnitude(const std::array<double, N>& c) {
  double sum = 0.0;
  for (const double value : c) sum += std::abs(value);
  return sum / static_cast<double>(N);
}

template <std::size_t N>
JacobianBounds bounds(const BernsteinDomain& domain, std::array<double, N> c, double tolerance) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double absolute = tolerance * mean_magnitude(c);
  const LowerBound low = lower_bound(domain, c.data(), absolute, never);
  for (double& value : c) value = -value;
  const LowerBound high = lower_bound(domain, c.data(), absolute, never);
  return {low.lower, low.least, -high.least, -high.lower};
}

template <std::size_t N>
double lower(const BernsteinDomain& domain, const std::array<double, N>& c, double tolerance) {
  constexpr double never = std::numeric_limits<double>::infinity();
  return lower_bound(domain, c.data(), tolerance * mean_magnitude(c), never).lower;
}

template <std::size_t N>
double mean(const std::array<double, N>& c) {
  return std::accumulate(c.begin(), c.end(), 0.0) / static_cast<double>(N);
}

struct Derivatives {
  Vec3 u = Vec3::Zero(), v = Vec3::Zero(), w = Vec3::Zero(), position = Vec3::Zero();
};

Derivatives evaluate(const TetrahedronNodes& nodes, const Vec3& uvw) {
  const TetrahedronNodes b = controls(nodes);
  const std::array<double, 4> weights{1.0 - uvw.sum(), uvw.x(), uvw.y(), uvw.z()};
  Derivatives d;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& pair = tetrahedron_pair[i];
    d.u += 2.0 * weights[i] * (b[pair[1]] - b[pair[0]]);
    d.v += 2.0 * weights[i] * (b[pair[2]] - b[pair[0]]);
    d.w += 2.0 * weights[i] * (b[pair[3]] - b[pair[0]]);
    for (std::size_t j = 0; j < 4; ++j) d.position += weights[i] * weights[j] * b[pair[j]];
  }
  return d;
}

Derivatives evaluate(const PrismNodes& nodes, const Vec3& uvw) {
  const PrismControls b = controls(nodes);
  const std::array<double, 3> weights{1.0 - uvw.x() - uvw.y(), uvw.x(), uvw.y()};
  const double t = uvw.z(), s = 1.0 - t;
  const std::array<double, 3> along{s * s, 2.0 * s * t, t * t}, slope{-2.0 * s, 2.0 * (s - t), 2.0 * t};
  Derivatives d;
  for (std::size_t level = 0; level < 3; ++level)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& pair = triangle_pair[i];
      const auto& at = b[level];
      d.u += 2.0 * along[level] * weights[i] * (at[pair[1]] - at[pair[0]]);
      d.v += 2.0 * along[level] * weights[i] * (at[pair[2]] - at[pair[0]]);
      for (std::size_t j = 0; j < 3; ++j) {
        d.w += slope[level] * weights[i] * weights[j] * at[pair[j]];
        d.position += along[level] * weights[i] * weights[j] * at[pair[j]];
      }
    }
  return d;
}

template <std::size_t Corners, std::size_t Nodes>
std::array<Vec3, Nodes> straight_version(const std::array<Vec3, Nodes>& nodes) {
  std::array<Vec3, Corners> corners;
  std::copy_n(nodes.begin(), Corners, corners.begin());
  return straight(corners);
}

double determinant(const TetrahedronNodes& p) {
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
}

/// Least value of a parabola in Bernstein form on [0, 1].
double least_of(double a, double b, double c) {
  const double bend = a - 2.0 * b + c, ends = std::min(a, c);
  // Its vertex lies inside where the middle coefficient is below both ends.
  return b < ends && bend > 0.0 ? (a * c - b * b) / bend : ends;
}

/// The least Jacobian of a straight prism: it is of degree 1 across, so it is taken at one of the uprights.
ElementJacobian straight_jacobian(const PrismNodes& p) {
  const auto c = prism_jacobian_coefficients({p[0], p[1], p[2], p[3], p[4], p[5]});
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) least = std::min(least, least_of(c[i], c[3 + i], c[6 + i]));
  return {least, least, 0.5 * mean(c), 0.5 * mean(c)};
}
ElementJacobian straight_jacobian(const TetrahedronNodes& p) {
  const double value = determinant(p);
  return {value, value, value / 6.0, value / 6.0};
}

template <std::size_t Corners, std::size_t Nodes>
ElementJacobian element(const std::array<Vec3, Nodes>& nodes, const BernsteinDomain& domain) {
  constexpr double tolerance = 1e-2, reference_volumes = Corners == 4 ? 6.0 : 2.0;
  ElementJacobian result = straight_jacobian(nodes);
  if (straight_version<Corners>(nodes) == nodes) return result;
  const auto c = jacobian_coefficients(nodes);
  result.lower = lower(domain, c, tolerance);
  result.volume_mm3 = mean(c) / reference_volumes;
  return result;
}

template <std::size_t Corners, std::size_t Nodes>
bool keeps(const std::array<Vec3, Nodes>& nodes, const BernsteinDomain& domain, double share) {
  constexpr double tolerance = 1e-2;
  if (straight_version<Corners>(nodes) == nodes) return true;
  const double plain = straight_jacobian(nodes).lower;
  const double enough = plain > 0.0 ? share * plain : plain;
  const auto c = jacobian_coefficients(nodes);
  return lower_bound(domain, c.data(), tolerance * mean_magnitude(c), enough).lower >= enough;
}

}  // namespace

TetrahedronNodes tetrahedron_nodes(const geometry::MixedMesh& mesh, std::size_t tetrahedron) {
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i)
    corners[i] = mesh.points[static_cast<std::size_t>(mesh.tetrahedra[tetrahedron][i])];
  if (mesh.tetrahedron_nodes.empty()) return straight(corners);
  TetrahedronNodes nodes;
  std::copy(corners.begin(), corners.end(), nodes.begin());
  for (std::size_t i = 0; i < 6; ++i)
    nodes[4 + i] = mesh.points[static_cast<std::size_t>(mesh.tetrahedron_nodes[tetrahedron][i])];
  return nodes;
}

PrismNodes prism_nodes(const geometry::MixedMesh& mesh, std::size_t prism) {
  std::array<Vec3, 6> corners;
  for (std::size_t i = 0; i < 6; ++i)
    corners[i] = mesh.points[static_cast<std::size_t>(mesh.prisms[prism][i])];
  if (mesh.prism_nodes.empty()) return straight(corners);
  PrismNodes nodes;
  std::copy(corners.begin(), corners.end(), nodes.begin());
  for (std::size_t i = 0; i < 12; ++i)
    nodes[6 + i] = mesh.points[static_cast<std::size_t>(mesh.prism_nodes[prism][i])];
  return nodes;
}

TetrahedronNodes straight(const std::array<Vec3, 4>& corners) {
  TetrahedronNodes nodes;
  std::copy(corners.begin(), corners.end(), nodes.begin());
  for (std::size_t e = 0; e < 6; ++e)
    nodes[4 + e] = 0.5 * (corners[tetrahedron_edges[e][0]] + corners[tetrahedron_edges[e][1]]);
  return nodes;
}

PrismNodes straight(const std::array<Vec3, 6>& corners) {
  PrismNodes nodes;
  std::copy(corners.begin(), corners.end(), nodes.begin());
  for (std::size_t e = 0; e < 9; ++e)
    nodes[6 + e] = 0.5 * (corners[prism_edges[e][0]] + corners[prism_edges[e][1]]);
  for (std::size_t q = 0; q < 3; ++q) {
    const auto& [a, b, c, d] = prism_quads[q];
    // In this order neighbours that see the side from elsewhere get the same bits.
    nodes[15 + q] = 0.25 * ((corners[a] + corners[c]) + (corners[b] + corners[d]));
  }
  return nodes;
}

Vec3 position(const TetrahedronNodes& nodes, const Vec3& uvw) {
  return evaluate(nodes, uvw).position;
}

Vec3 position(const PrismNodes& nodes, const Vec3& uvw) {
  return evaluate(nodes, uvw).position;
}

double jacobian(const TetrahedronNodes& nodes, const Vec3& uvw) {
  const Derivatives d = evaluate(nodes, uvw);
  return d.u.cross(d.v).dot(d.w);
}

double jacobian(const PrismNodes& nodes, const Vec3& uvw) {
  const Derivatives d = evaluate(nodes, uvw);
  return d.u.cross(d.v).dot(d.w);
}

std::array<double, 20> jacobian_coefficients(const TetrahedronNodes& nodes) {
  const TetrahedronNodes b = controls(nodes);
  std::array<Vec3, 4> u, v, w;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& pair = tetrahedron_pair[i];
    u[i] = 2.0 * (b[pair[1]] - b[pair[0]]);
    v[i] = 2.0 * (b[pair[2]] - b[pair[0]]);
    w[i] = 2.0 * (b[pair[3]] - b[pair[0]]);
  }
  const TetrahedronTables& tables = tetrahedron_tables();
  return triple_product<10, 20>(u, v, w, tables.cross, tables.dot);
}

std::array<double, 90> jacobian_coefficients(const PrismNodes& nodes) {
  const PrismControls b = controls(nodes);
  std::array<Vec3, 9> u, v;
  std::array<Vec3, 12> w;
  for (std::size_t level = 0; level < 3; ++level)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& pair = triangle_pair[i];
      u[3 * level + i] = 2.0 * (b[level][pair[1]] - b[level][pair[0]]);
      v[3 * level + i] = 2.0 * (b[level][pair[2]] - b[level][pair[0]]);
    }
  // In the order of simplex_powers(3, 2): 00 01 02 11 12 22.
  constexpr std::array<std::size_t, 6> order{0, 3, 5, 1, 4, 2};
  for (std::size_t level = 0; level < 2; ++level)
    for (std::size_t i = 0; i < 6; ++i)
      w[6 * level + i] = 2.0 * (b[level + 1][order[i]] - b[level][order[i]]);
  const PrismTables& tables = prism_tables();
  return triple_product<30, 90>(u, v, w, tables.cross, tables.dot);
}

double volume(const TetrahedronNodes& nodes) {
  return mean(jacobian_coefficients(nodes)) / 6.0;
}

double volume(const PrismNodes& nodes) {
  return mean(jacobian_coefficients(nodes)) / 2.0;
}

JacobianBounds jacobian_bounds(const TetrahedronNodes& nodes, double tolerance) {
  return bounds(tetrahedron_tables().domain, jacobian_coefficients(nodes), tolerance);
}

JacobianBounds jacobian_bounds(const PrismNodes& nodes, double tolerance) {
  return bounds(prism_tables().domain, jacobian_coefficients(nodes), tolerance);
}

double jacobian_lower_bound(const TetrahedronNodes& nodes, double tolerance) {
  return lower(tetrahedron_tables().domain, jacobian_coefficients(nodes), tolerance);
}

double jacobian_lower_bound(const PrismNodes& nodes, double tolerance) {
  return lower(prism_tables().domain, jacobian_coefficients(nodes), tolerance);
}

double ElementJacobian::ratio() const {
  if (straight_lower > 0.0) return lower / straight_lower;
  return lower >= straight_lower ? 1.0 : 0.0;
}

ElementJacobian element_jacobian(const TetrahedronNodes& nodes) {
  return element<4>(nodes, tetrahedron_tables().domain);
}

ElementJacobian element_jacobian(const PrismNodes& nodes) {
  return element<6>(nodes, prism_tables().domain);
}

bool keeps_jacobian(const TetrahedronNodes& nodes, double share) {
  return keeps<4>(nodes, tetrahedron_tables().domain, share);
}

bool keeps_jacobian(const PrismNodes& nodes, double share) {
  return keeps<6>(nodes, prism_tables().domain, share);
}

}  // namespace ostia::meshing
