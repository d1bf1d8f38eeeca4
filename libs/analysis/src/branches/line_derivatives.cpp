#include "branches/line_derivatives.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

constexpr Eigen::Index coefficients = 6;
constexpr std::size_t enough_points = 9;  // in a fit, where the line has as many
constexpr double rim = 1.02;              // of the reach: where weights end, so that its last point counts

struct Window {
  std::size_t first, last;  // one behind
  double half_mm;           // to the farthest point
};

/// The points within `reach` of point i, or as much farther on one side as the line ends on the other.
Window window(const std::vector<double>& s, std::size_t i, double reach) {
  const double missing = std::max(0.0, reach - (s[i] - s.front())) + std::max(0.0, reach - (s.back() - s[i]));
  const double half = reach + missing;
  const double slack = 1e-9 * reach;
  auto first =
      static_cast<std::size_t>(std::lower_bound(s.begin(), s.end(), s[i] - half - slack) - s.begin());
  auto last = static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), s[i] + half + slack) - s.begin());
  while (last - first < std::min(enough_points, s.size())) {
    const bool left = first > 0 && (last == s.size() || s[i] - s[first - 1] < s[last] - s[i]);
    if (left)
      --first;
    else
      ++last;
  }
  return {first, last, std::max(s[i] - s[first], s[last - 1] - s[i])};
}

}  // namespace

LineDerivatives::LineDerivatives(const std::vector<double>& s_mm, double reach_mm) : rows_(s_mm.size()) {
  for (std::size_t i = 0; i < s_mm.size(); ++i) {
    const Window w = window(s_mm, i, reach_mm);
    const auto count = static_cast<Eigen::Index>(w.last - w.first);
    // Columns are powers of the offset over the half; rows are scaled by the root of the weight.
    Eigen::MatrixXd powers(count, coefficients);
    Eigen::VectorXd root(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const double x = (s_mm[w.first + static_cast<std::size_t>(k)] - s_mm[i]) / w.half_mm;
      root[k] = std::sqrt(1.0 - (x / rim) * (x / rim));
      double power = root[k];
      for (Eigen::Index p = 0; p < coefficients; ++p, power *= x) powers(k, p) = power;
    }
    const Eigen::MatrixXd inverse = powers.colPivHouseholderQr().solve(Eigen::MatrixXd(root.asDiagonal()));
    rows_[i].first = w.first;
    double scale = 1.0;
    for (std::size_t order = 0; order < 3; ++order) {
      scale *= static_cast<double>(order + 1) / w.half_mm;
      const Eigen::RowVectorXd row = scale * inverse.row(static_cast<Eigen::Index>(order) + 1);
      rows_[i].weights[order].assign(row.data(), row.data() + row.size());
    }
  }
}

std::array<std::vector<geometry::Vec3>, 3> LineDerivatives::operator()(
    const std::vector<geometry::Vec3>& values) const {
  std::array<std::vector<geometry::Vec3>, 3> result;
  for (std::size_t order = 0; order < 3; ++order) {
    result[order].assign(rows_.size(), geometry::Vec3::Zero());
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t k = 0; k < rows_[i].weights[order].size(); ++k)
        result[order][i] += rows_[i].weights[order][k] * values[rows_[i].first + k];
  }
  return result;
}

}  // namespace ostia::analysis
