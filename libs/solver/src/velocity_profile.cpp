#include "ostia/solver/velocity_profile.h"

#include "ostia/core/error.h"
#include "ostia/solver/womersley.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace ostia::solver {
namespace {

using geometry::Vec3;
using Edge = std::pair<std::int32_t, std::int32_t>;
/// Three corners, then the nodes in the middle of 01, 12, 20.
using Element = std::array<std::int32_t, 6>;
using Stiffness = Eigen::Matrix<double, 6, 6>;

/// The section's triangles with nodes in the middle of their edges.
struct Elements {
  std::vector<Element> elements;
  std::vector<std::size_t> facet;  ///< of each element
  std::vector<char> on_rim;        ///< of each node
};

Edge edge_of(std::int32_t a, std::int32_t b) {
  return std::minmax(a, b);
}

Elements quadratic_elements(const Section& section) {
  Elements out;
  std::map<Edge, std::pair<std::int32_t, int>> edges;  // node in its middle, triangles beside it
  auto nodes = static_cast<std::int32_t>(section.points.size());
  const auto add = [&](std::size_t facet, std::int32_t a, std::int32_t b, std::int32_t c) {
    Element element = {a, b, c, -1, -1, -1};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [place, fresh] =
          edges.try_emplace(edge_of(element[i], element[(i + 1) % 3]), std::pair(nodes, 0));
      nodes += fresh ? 1 : 0;
      element[3 + i] = place->second.first;
      ++place->second.second;
    }
    out.elements.push_back(element);
    out.facet.push_back(facet);
  };
  for (std::size_t f = 0; f < section.facets.size(); ++f) {
    const auto& corners = section.facets[f];
    add(f, corners[0], corners[1], corners[2]);
    if (corners[3] >= 0) add(f, corners[0], corners[2], corners[3]);
  }
  out.on_rim.assign(static_cast<std::size_t>(nodes), 0);
  for (const auto& [edge, use] : edges) {
    if (use.second > 1) continue;
    for (const std::int32_t node : {edge.first, edge.second, use.first})
      out.on_rim[static_cast<std::size_t>(node)] = 1;
  }
  return out;
}

double area_of(const Section& section, const Element& e) {
  const auto p = [&](std::size_t i) { return section.points[static_cast<std::size_t>(e[i])]; };
  return (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2.0;
}

/// Exact: gradients are linear, and the mean over the edges' middles integrates their products exactly.
Stiffness stiffness(const Section& section, const Element& e) {
  const auto p = [&](std::size_t i) { return section.points[static_cast<std::size_t>(e[i % 3])]; };
  const double area = area_of(section, e);
  const Vec3 normal = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
  std::array<Vec3, 3> slope;  // of the barycentric coordinates
  for (std::size_t i = 0; i < 3; ++i) slope[i] = normal.cross(p(i + 2) - p(i + 1)) / (2.0 * area);
  Stiffness matrix = Stiffness::Zero();
  for (std::size_t middle = 0; middle < 3; ++middle) {
    std::array<double, 3> b = {0.0, 0.0, 0.0};
    b[middle] = b[(middle + 1) % 3] = 0.5;
    Eigen::Matrix<double, 3, 6> gradient;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      gradient.col(static_cast<Eigen::Index>(i)) = (4.0 * b[i] - 1.0) * slope[i];
      gradient.col(static_cast<Eigen::Index>(3 + i)) = 4.0 * (b[i] * slope[j] + b[j] * slope[i]);
    }
    matrix += area / 3.0 * gradient.transpose() * gradient;
  }
  return matrix;
}

/// The solution at all nodes, mm2.
Eigen::VectorXd solve(const Section& section, const Elements& mesh) {
  std::vector<Eigen::Index> unknown(mesh.on_rim.size(), -1);
  Eigen::Index unknowns = 0;
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (mesh.on_rim[i] == 0) unknown[i] = unknowns++;
  if (unknowns == 0 || unknowns == static_cast<Eigen::Index>(unknown.size()))
    throw GeometryError("an inlet's section has no rim, or no edge inside it; mesh it finer");
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns);
  for (const Element& e : mesh.elements) {
    const Stiffness local = stiffness(section, e);
    for (std::size_t i = 0; i < 6; ++i) {
      const Eigen::Index row = unknown[static_cast<std::size_t>(e[i])];
      if (row < 0) continue;
      if (i >= 3) load[row] += area_of(section, e) / 3.0;  // the corners' shapes integrate to 0
      for (std::size_t j = 0; j < 6; ++j) {
        const Eigen::Index column = unknown[static_cast<std::size_t>(e[j])];
        if (column >= 0)
          entries.emplace_back(row, column,
                               local(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success)
    throw GeometryError("an inlet's section has triangles without area; mesh it again");
  const Eigen::VectorXd solved = factor.solve(load);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknown.size()));
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (unknown[i] >= 0) all[static_cast<Eigen::Index>(i)] = solved[unknown[i]];
  return all;
}

double along(const Section& section, std::size_t facet) {
  return section.area_vectors_mm2[facet].dot(section.normal);
}

}  // namespace

DevelopedProfile developed_profile(const Section& section) {
  const Elements mesh = quadratic_elements(section);
  const Eigen::VectorXd nodes = solve(section, mesh);
  std::vector<double> integral(section.facets.size(), 0.0), area(section.facets.size(), 0.0);
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    const Element& e = mesh.elements[i];
    const double third = area_of(section, e) / 3.0;
    area[mesh.facet[i]] += 3.0 * third;
    integral[mesh.facet[i]] += third * (nodes[e[3]] + nodes[e[4]] + nodes[e[5]]);
  }
  DevelopedProfile out;
  double flow = 0.0;
  for (std::size_t f = 0; f < integral.size(); ++f) {
    out.relative.push_back(std::max(0.0, integral[f] / area[f]));
    flow += out.relative[f] * along(section, f);
  }
  const double mean = flow / section.area_mm2, largest = nodes.maxCoeff();
  if (!(mean > 0.0)) throw GeometryError("an inlet's section lets nothing through; mesh it finer");
  out.largest = largest / mean;
  out.conductance_mm2 = mean;
  for (double& w : out.relative) {
    out.radius.push_back(std::sqrt(std::max(0.0, 1.0 - w / largest)));
    w /= mean;
  }
  return out;
}

std::vector<std::complex<double>> oscillating_profile(const Section& section,
                                                      const DevelopedProfile& developed,
                                                      double angular_frequency, double viscosity_mm2_s) {
  const double alpha = womersley_number(section.diameter_mm() / 2.0, angular_frequency, viscosity_mm2_s);
  std::vector<std::complex<double>> out;
  std::complex<double> mean = 0.0;
  for (std::size_t f = 0; f < section.facets.size(); ++f) {
    out.push_back(womersley_profile(alpha, developed.radius[f]));
    mean += out.back() * (along(section, f) / section.area_mm2);
  }
  for (std::complex<double>& value : out) value /= mean;
  return out;
}

std::vector<Vec3> inward_velocities(const Section& section, const std::vector<double>& values,
                                    double flow_mm3_s) {
  if (values.size() != section.facets.size())
    throw InvalidInput("a profile of " + std::to_string(values.size()) + " values for " +
                       std::to_string(section.facets.size()) + " facets");
  std::vector<Vec3> out;
  for (const double value : values)
    out.emplace_back(-section.normal * (value * flow_mm3_s / section.area_mm2));
  return out;
}

}  // namespace ostia::solver
