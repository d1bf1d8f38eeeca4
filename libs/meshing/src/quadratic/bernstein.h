#pragma once
/// \file Polynomials in Bernstein form on a simplex, or on a triangle times a segment, and their bounds.

#include <array>
#include <cstddef>
#include <vector>

namespace ostia::meshing {

/// Powers of up to five barycentric coordinates: four of a tetrahedron; or three of a triangle and two of a
/// segment.
using Powers = std::array<int, 5>;

/// All powers of a degree over `slots` coordinates, the first coordinate's falling.
std::vector<Powers> simplex_powers(std::size_t slots, int degree);
/// Those of a triangle times a segment, the triangle's together for each of the segment's.
std::vector<Powers> prism_powers(int triangle_degree, int segment_degree);

/// Terms of the product of two Bernstein polynomials: out += weight a b.
struct ProductTerm {
  std::size_t a, b, out;
  double weight;
};
std::vector<ProductTerm> product_terms(const std::vector<Powers>& a, const std::vector<Powers>& b,
                                       const std::vector<Powers>& out);

/// How coefficients change when the domain is halved.
struct BernsteinDomain {
  struct Term {
    std::size_t out, from;
    double weight;
  };
  /// The midpoint of two corners takes the place of the second one, or of the first.
  struct Direction {
    std::vector<Term> first_half, second_half;
    std::vector<std::array<std::size_t, 3>> second_differences;
  };
  std::size_t size = 0;
  std::vector<std::size_t> corners;  ///< coefficients that are values of the polynomial
  std::vector<Direction> directions;
};
BernsteinDomain bernstein_domain(const std::vector<Powers>& powers,
                                 const std::vector<std::array<std::size_t, 2>>& edges);

struct LowerBound {
  double lower = 0.0;  ///< nowhere less
  double least = 0.0;  ///< a value that is taken
};
/// By halving parts in the direction in which they bend most until least - lower <= tolerance, or lower >=
/// enough.
LowerBound lower_bound(const BernsteinDomain& domain, const double* coefficients, double tolerance,
                       double enough);

}  // namespace ostia::meshing
