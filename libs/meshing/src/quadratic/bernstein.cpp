#include "quadratic/bernstein.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::meshing {
namespace {

constexpr std::size_t most_parts = 2000;

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value *= static_cast<double>(n - k + i) / i;
  return value;
}

std::size_t place_of(const std::vector<Powers>& powers, const Powers& wanted) {
  return static_cast<std::size_t>(std::find(powers.begin(), powers.end(), wanted) - powers.begin());
}

/// Product over the coordinates of (a + b over a): what B_a B_b is of B_(a+b), but for the degrees' part.
double choices(const Powers& a, const Powers& b) {
  double value = 1.0;
  for (std::size_t i = 0; i < a.size(); ++i) value *= binomial(a[i] + b[i], a[i]);
  return value;
}

/// The midpoint of corners i and j takes the place of j (de Casteljau).
std::vector<BernsteinDomain::Term> half(const std::vector<Powers>& powers, std::size_t i, std::size_t j) {
  std::vector<BernsteinDomain::Term> terms;
  for (std::size_t out = 0; out < powers.size(); ++out) {
    const int n = powers[out][j];
    for (int k = 0; k <= n; ++k) {
      Powers from = powers[out];
      from[i] += n - k;
      from[j] -= n - k;
      terms.push_back({out, place_of(powers, from), binomial(n, k) * std::ldexp(1.0, -n)});
    }
  }
  return terms;
}

using Coefficients = std::vector<double>;

Coefficients applied(const std::vector<BernsteinDomain::Term>& terms, const Coefficients& c) {
  Coefficients out(c.size(), 0.0);
  for (const BernsteinDomain::Term& term : terms) out[term.out] += term.weight * c[term.from];
  return out;
}

const BernsteinDomain::Direction& most_bent(const BernsteinDomain& domain, const Coefficients& c) {
  const BernsteinDomain::Direction* most = &domain.directions.front();
  double largest = -1.0;
  for (const BernsteinDomain::Direction& direction : domain.directions) {
    double bend = 0.0;
    for (const auto& [a, b, d] : direction.second_differences)
      bend = std::max(bend, std::abs(c[a] - 2.0 * c[b] + c[d]));
    if (bend > largest) {
      largest = bend;
      most = &direction;
    }
  }
  return *most;
}

}  // namespace

std::vector<Powers> simplex_powers(std::size_t slots, int degree) {
  std::vector<Powers> powers;
  Powers p{};
  const auto fill = [&](const auto& self, std::size_t slot, int left) -> void {
    if (slot + 1 == slots) {
      p[slot] = left;
      powers.push_back(p);
      return;
    }
    for (int n = left; n >= 0; --n) {
      p[slot] = n;
      self(self, slot + 1, left - n);
    }
  };
  fill(fill, 0, degree);
  return powers;
}

std::vector<Powers> prism_powers(int triangle_degree, int segment_degree) {
  std::vector<Powers> powers;
  for (int level = 0; level <= segment_degree; ++level)
    for (Powers p : simplex_powers(3, triangle_degree)) {
      p[3] = segment_degree - level;
      p[4] = level;
      powers.push_back(p);
    }
  return powers;
}

std::vector<ProductTerm> product_terms(const std::vector<Powers>& a, const std::vector<Powers>& b,
                                       const std::vector<Powers>& out) {
  std::vector<ProductTerm> terms;
  const auto part = [](const Powers& p, std::size_t first, std::size_t last) {
    int sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += p[i];
    return sum;
  };
  // A tetrahedron's fourth coordinate and a segment's first share a slot: only the latter has a fifth, and
  // its degree is counted by itself.
  const bool prism = std::any_of(out.begin(), out.end(), [](const Powers& p) { return p[4] > 0; });
  const std::size_t split = prism ? 3 : 5;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      Powers sum = a[i];
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += b[j][k];
      double all = 1.0;
      for (const auto& [first, last] : {std::pair<std::size_t, std::size_t>{0, split}, {split, 5}})
        all *= binomial(part(sum, first, last), part(a[i], first, last));
      terms.push_back({i, j, place_of(out, sum), choices(a[i], b[j]) / all});
    }
  return terms;
}

BernsteinDomain bernstein_domain(const std::vector<Powers>& powers,
                                 const std::vector<std::array<std::size_t, 2>>& edges) {
  BernsteinDomain domain;
  domain.size = powers.size();
  for (std::size_t i = 0; i < powers.size(); ++i) {
    // A corner holds all of the degree in one coordinate of each factor.
    const auto& p = powers[i];
    const bool corner = std::all_of(edges.begin(), edges.end(), [&](const std::array<std::size_t, 2>& e) {
      return p[e[0]] == 0 || p[e[1]] == 0;
    });
    if (corner) domain.corners.push_back(i);
  }
  for (const auto& [i, j] : edges) {
    BernsteinDomain::Direction direction{half(powers, i, j), half(powers, j, i), {}};
    for (std::size_t k = 0; k < powers.size(); ++k) {
      if (powers[k][i] == 0 || powers[k][j] == 0) continue;
      Powers before = powers[k], after = powers[k];
      ++before[i], --before[j], --after[i], ++after[j];
      direction.second_differences.push_back({place_of(powers, before), k, place_of(powers, after)});
    }
    domain.directions.push_back(std::move(direction));
  }
  return domain;
}

LowerBound lower_bound(const BernsteinDomain& domain, const double* coefficients, double tolerance,
                       double enough) {
  LowerBound bound{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  // Most elements are hardly bent: these need no memory.
  const double all = *std::min_element(coefficients, coefficients + domain.size);
  for (const std::size_t corner : domain.corners) bound.least = std::min(bound.least, coefficients[corner]);
  if (all >= bound.least - tolerance || all >= enough) {
    bound.lower = all;
    return bound;
  }
  std::vector<Coefficients> parts{Coefficients(coefficients, coefficients + domain.size)};
  for (std::size_t made = 1; !parts.empty();) {
    const Coefficients c = std::move(parts.back());
    parts.pop_back();
    for (const std::size_t corner : domain.corners) bound.least = std::min(bound.least, c[corner]);
    const double lower = *std::min_element(c.begin(), c.end());
    if (lower >= bound.least - tolerance || lower >= enough || made >= most_parts) {
      bound.lower = std::min(bound.lower, lower);
      continue;
    }
    const BernsteinDomain::Direction& direction = most_bent(domain, c);
    parts.push_back(applied(direction.first_half, c));
    parts.push_back(applied(direction.second_half, c));
    made += 2;
  }
  return bound;
}

}  // namespace ostia::meshing
