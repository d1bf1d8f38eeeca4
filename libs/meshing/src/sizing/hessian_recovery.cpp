#include "sizing/hessian_recovery.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/element_centres.h"
#include "ostia/geometry/mixed_mesh_sides.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

/// Sorts pairs and turns them into rows.
void into_rows(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs, std::size_t rows,
               std::vector<std::size_t>& first, std::vector<std::int32_t>& values) {
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first.assign(rows + 1, 0);
  values.clear();
  for (const auto& [row, value] : pairs) {
    ++first[static_cast<std::size_t>(row) + 1];
    values.push_back(value);
  }
  for (std::size_t i = 0; i < rows; ++i) first[i + 1] += first[i];
}

template <class Element, class Edges>
void add_edges(const std::vector<Element>& elements, const Edges& edges,
               std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  for (const Element& element : elements)
    for (const auto& [a, b] : edges) {
      pairs.emplace_back(element[a], element[b]);
      pairs.emplace_back(element[b], element[a]);
    }
}

template <class Element>
void add_corners(const std::vector<Element>& elements, std::int32_t& number,
                 std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  for (const Element& element : elements) {
    for (const std::int32_t v : element) pairs.emplace_back(v, number);
    ++number;
  }
}

/// Where the field's values are.
std::vector<Vec3> places_of(const geometry::MixedMesh& mesh, const MeshField& field) {
  return field.at_elements ? geometry::element_centres(mesh) : mesh.points;
}

constexpr int unknowns = 10;
using Row = Eigen::Matrix<double, unknowns, 1>;
using Normal = Eigen::Matrix<double, unknowns, unknowns>;

Row monomials(const Vec3& x) {
  Row row;
  row << 1.0, x.x(), x.y(), x.z(), 0.5 * x.x() * x.x(), 0.5 * x.y() * x.y(), 0.5 * x.z() * x.z(),
      x.y() * x.z(), x.z() * x.x(), x.x() * x.y();
  return row;
}

/// Fits the polynomial about one node after another.
class Fitter {
 public:
  Fitter(const geometry::MixedMesh& mesh, const MeshRing& ring, const MeshField& field,
         const std::vector<Vec3>& places)
      : mesh_(mesh), ring_(ring), field_(field), places_(places) {}

  void fit(std::size_t node, Symmetric3* out) {
    gather(node);
    const Vec3& middle = mesh_.points[node];
    double reach = 0.0;
    for (const std::int32_t s : samples_) reach = std::max(reach, (place(s) - middle).squaredNorm());
    reach = std::sqrt(reach);
    const auto components = static_cast<Eigen::Index>(field_.components);
    Normal normal = Normal::Zero();
    right_.setZero(unknowns, components);
    for (const std::int32_t s : samples_) {
      const Vec3 x = (place(s) - middle) / reach;
      const double weight = 1.0 / (0.1 + x.squaredNorm());
      const Row row = monomials(x);
      normal.noalias() += weight * row * row.transpose();
      for (Eigen::Index c = 0; c < components; ++c)
        right_.col(c) += weight * value(s, static_cast<std::size_t>(c)) * row;
    }
    solve(normal);
    for (Eigen::Index c = 0; c < components; ++c)
      for (Eigen::Index k = 0; k < 6; ++k)
        out[c][static_cast<std::size_t>(k)] = right_(4 + k, c) / (reach * reach);
  }

 private:
  const Vec3& place(std::int32_t sample) const { return places_[static_cast<std::size_t>(sample)]; }
  /// Less the first sample's, so that large means cost no digits.
  double value(std::int32_t sample, std::size_t c) const {
    const auto n = static_cast<std::size_t>(field_.components);
    return field_.values[static_cast<std::size_t>(sample) * n + c] -
           field_.values[static_cast<std::size_t>(samples_.front()) * n + c];
  }

  /// Rings are added until there is enough to fit.
  void gather(std::size_t node) {
    constexpr std::size_t enough = 24;
    constexpr int most_rings = 4;
    nodes_.assign(1, static_cast<std::int32_t>(node));
    for (int rings = 0; rings < most_rings; ++rings) {
      if (field_.at_elements) {  // a ring of elements
        take(ring_.first_element, ring_.elements, samples_);
        if (samples_.size() >= enough) return;
        take(ring_.first_node, ring_.nodes, more_);
      } else {
        take(ring_.first_node, ring_.nodes, more_);
      }
      nodes_.insert(nodes_.end(), more_.begin(), more_.end());
      unique(nodes_);
      if (field_.at_elements) continue;
      samples_ = nodes_;
      if (samples_.size() >= enough) return;
    }
  }
  static void unique(std::vector<std::int32_t>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  void take(const std::vector<std::size_t>& first, const std::vector<std::int32_t>& values,
            std::vector<std::int32_t>& out) const {
    out.clear();
    for (const std::int32_t v : nodes_)
      for (std::size_t i = first[static_cast<std::size_t>(v)]; i < first[static_cast<std::size_t>(v) + 1];
           ++i)
        out.push_back(values[i]);
    unique(out);
  }

  /// Columns scaled to one length: those across thin prisms are small. Where the samples do not say all ten
  /// numbers, the smallest solution.
  void solve(const Normal& normal) {
    const Row scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Normal scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    const Eigen::LDLT<Normal> factors(scaled);
    constexpr double least_pivot = 1e-11;
    right_ = scale.asDiagonal() * right_;
    if (factors.info() == Eigen::Success && factors.vectorD().minCoeff() > least_pivot)
      right_ = factors.solve(right_).eval();
    else
      right_ = scaled.completeOrthogonalDecomposition().solve(right_).eval();
    right_ = scale.asDiagonal() * right_;
  }

  const geometry::MixedMesh& mesh_;
  const MeshRing& ring_;
  const MeshField& field_;
  const std::vector<Vec3>& places_;
  std::vector<std::int32_t> nodes_, more_, samples_;
  Eigen::Matrix<double, unknowns, Eigen::Dynamic> right_;
};

}  // namespace

MeshRing ring_of(const geometry::MixedMesh& mesh) {
  MeshRing ring;
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(12 * mesh.tetrahedra.size() + 18 * mesh.prisms.size());
  add_edges(mesh.tetrahedra, geometry::tetrahedron_edges, pairs);
  add_edges(mesh.prisms, geometry::prism_edges, pairs);
  into_rows(pairs, mesh.points.size(), ring.first_node, ring.nodes);
  pairs.clear();
  std::int32_t number = 0;
  add_corners(mesh.tetrahedra, number, pairs);
  add_corners(mesh.prisms, number, pairs);
  into_rows(pairs, mesh.points.size(), ring.first_element, ring.elements);
  return ring;
}

std::vector<Symmetric3> recovered_hessians(const geometry::MixedMesh& mesh, const MeshRing& ring,
                                           const MeshField& field, const core::TaskContext& task) {
  const std::vector<Vec3> places = places_of(mesh, field);
  const auto components = static_cast<std::size_t>(field.components);
  std::vector<Symmetric3> hessians(mesh.points.size() * components, Symmetric3{});
  core::parallel_chunks(mesh.points.size(), 512, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    Fitter fitter(mesh, ring, field, places);
    for (std::size_t i = first; i < last; ++i)
      if (ring.first_node[i] != ring.first_node[i + 1]) fitter.fit(i, &hessians[i * components]);
  });
  return hessians;
}

double largest_curvature(const Symmetric3& h) {
  Eigen::Matrix3d matrix;
  matrix << h[0], h[5], h[4], h[5], h[1], h[3], h[4], h[3], h[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace ostia::meshing
