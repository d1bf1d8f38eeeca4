#include "images/cage_springs.h"

namespace ostia::pipeline {

using geometry::Vec3;
using Points = std::vector<Vec3>;

namespace {

// Of the cage, against the mean of the images' terms. A smooth tube does not tell how far it goes along
// itself: bending of the whole motion is what decides there, and linear motion costs nothing.
constexpr double bending = 1.0, stretching = 0.01;
constexpr double ridge = 1e-4;

Vec3 sum_of(const std::array<std::int32_t, 3>& points, const std::array<double, 3>& factors,
            const Points& displaced) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t p = 0; p < 3; ++p) sum += factors[p] * displaced[static_cast<std::size_t>(points[p])];
  return sum;
}

}  // namespace

CageSprings::CageSprings(const geometry::CageGrid& level, const geometry::CageGrid& whole)
    : level_(level), whole_(whole) {
  const int n = level.points_a_side();
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const std::array<int, 3> at{i, j, k};
        const std::int32_t p = level.point(i, j, k);
        springs_.push_back({{p, p, p}, {1.0, 0.0, 0.0}, ridge, false});
        for (std::size_t a = 0; a < 3; ++a) {
          const std::int32_t step = a == 0 ? 1 : a == 1 ? n : n * n;
          if (at[a] + 1 < n) springs_.push_back({{p, p + step, p}, {-1.0, 1.0, 0.0}, stretching, false});
          if (at[a] > 0 && at[a] + 1 < n)
            springs_.push_back({{p - step, p, p + step}, {1.0, -2.0, 1.0}, bending, true});
        }
      }
}

Points CageSprings::whole_displacement(const Points& begin, const Points& moved) const {
  Points out = moved;
  const int n = level_.points_a_side(), every = whole_.cells / level_.cells;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const std::int32_t p = whole_.point(every * i, every * j, every * k);
        out[static_cast<std::size_t>(level_.point(i, j, k))] +=
            begin[static_cast<std::size_t>(p)] - whole_.place(p);
      }
  return out;
}

void CageSprings::add(double stiffness, const Points& begin, const Points& moved,
                      std::vector<Eigen::Triplet<double>>& entries, Eigen::VectorXd& right) const {
  const Points whole = whole_displacement(begin, moved);
  for (const Spring& one : springs_) {
    const Vec3 sum = sum_of(one.points, one.factors, one.of_whole ? whole : moved);
    const double own = one.stiffness * stiffness;
    for (std::size_t p = 0; p < 3; ++p)
      for (int a = 0; a < 3; ++a) {
        right[3 * one.points[p] + a] -= own * one.factors[p] * sum[a];
        for (std::size_t q = 0; q < 3; ++q)
          entries.emplace_back(3 * one.points[p] + a, 3 * one.points[q] + a,
                               own * one.factors[p] * one.factors[q]);
      }
  }
}

double CageSprings::energy(double stiffness, const Points& begin, const Points& moved) const {
  const Points whole = whole_displacement(begin, moved);
  double sum = 0.0;
  for (const Spring& one : springs_)
    sum += one.stiffness * stiffness *
           sum_of(one.points, one.factors, one.of_whole ? whole : moved).squaredNorm();
  return sum;
}

}  // namespace ostia::pipeline
