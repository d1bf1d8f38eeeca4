#include "ostia/phantom/heart_warp.h"

#include "body/smooth_step.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/thin_plate_spline.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::phantom {
namespace {

constexpr double spacing_mm = 6.0;
constexpr double least_allowed = 0.25;  // Jacobian
constexpr int most_smoothings = 60;
// The lattice: the phantom's chest about its heart, with a rim over which displacements fade to nothing.
const Vec3 lowest(-190.0, -150.0, -200.0), highest(180.0, 170.0, 200.0);
constexpr double fade_mm = 42.0;

/// Cubic B-spline's four weights at t in [0, 1), and their derivatives.
struct Weights {
  std::array<double, 4> value, slope;
};
Weights weights(double t) {
  const double u = 1.0 - t;
  return {{u * u * u / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
           (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0, t * t * t / 6.0},
          {-0.5 * u * u, 1.5 * t * t - 2.0 * t, -1.5 * u * u + 2.0 * u, 0.5 * t * t}};
}

/// 0 at the lattice's border, 1 from `fade_mm` within it on.
double fade(const Vec3& p) {
  double inside = fade_mm;
  for (int a = 0; a < 3; ++a) inside = std::min({inside, p[a] - lowest[a], highest[a] - p[a]});
  return phantom::smooth_step(inside, 2.0 * spacing_mm, fade_mm).value;
}

}  // namespace

void WarpLandmarks::add(const Vec3& in_world, const Vec3& in_own) {
  world.push_back(in_world);
  own.push_back(in_own);
}

std::size_t HeartWarp::at(int i, int j, int k) const {
  return static_cast<std::size_t>(i) +
         static_cast<std::size_t>(count_[0]) *
             (static_cast<std::size_t>(j) +
              static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(k));
}

HeartWarp::HeartWarp(const WarpLandmarks& landmarks) : origin_(lowest) {
  const geometry::ThinPlateSpline spline(landmarks.world, landmarks.own);
  for (int a = 0; a < 3; ++a)
    count_[static_cast<std::size_t>(a)] = static_cast<int>((highest[a] - lowest[a]) / spacing_mm) + 1;
  displacement_.assign(at(0, 0, count_[2]), Vec3::Zero());
  core::parallel_for(static_cast<std::size_t>(count_[2]), 1, [&](std::size_t slab) {
    const int k = static_cast<int>(slab);
    for (int j = 0; j < count_[1]; ++j) {
      for (int i = 0; i < count_[0]; ++i) {
        const Vec3 p = origin_ + spacing_mm * Vec3(i, j, k);
        const double share = fade(p);
        if (share > 0.0) displacement_[at(i, j, k)] = share * (spline(p) - p);
      }
    }
  });
  measure();
  while (least_ < least_allowed) {
    if (++smoothings_ > most_smoothings)
      throw InvalidInput(
          "no smooth heart fits under these arteries: the map onto it folds (its Jacobian is " +
          std::to_string(least_) + " at least)");
    smooth();
    measure();
  }
}

Vec3 HeartWarp::to_own(const Vec3& world) const {
  std::array<int, 3> cell{};
  std::array<Weights, 3> w{};
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const double x = (world[a] - origin_[a]) / spacing_mm;
    if (!(x >= 1.0 && x < static_cast<double>(count_[n] - 2))) return world;
    cell[n] = static_cast<int>(x);
    w[n] = weights(x - cell[n]);
  }
  Vec3 sum = Vec3::Zero();
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4; ++j) {
      const double share = w[2].value[static_cast<std::size_t>(k)] * w[1].value[static_cast<std::size_t>(j)];
      const Vec3* row = displacement_.data() + at(cell[0] - 1, cell[1] - 1 + j, cell[2] - 1 + k);
      sum += share * (w[0].value[0] * row[0] + w[0].value[1] * row[1] + w[0].value[2] * row[2] +
                      w[0].value[3] * row[3]);
    }
  }
  return world + sum;
}

Mat3 HeartWarp::gradient(const Vec3& world) const {
  std::array<int, 3> cell{};
  std::array<Weights, 3> w{};
  for (int a = 0; a < 3; ++a) {
    const auto n = static_cast<std::size_t>(a);
    const double x = (world[a] - origin_[a]) / spacing_mm;
    if (!(x >= 1.0 && x < static_cast<double>(count_[n] - 2))) return Mat3::Identity();
    cell[n] = static_cast<int>(x);
    w[n] = weights(x - cell[n]);
  }
  Mat3 sum = Mat3::Zero();
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3& d = displacement_[at(cell[0] - 1 + static_cast<int>(i), cell[1] - 1 + static_cast<int>(j),
                                         cell[2] - 1 + static_cast<int>(k))];
        sum.col(0) += w[0].slope[i] * w[1].value[j] * w[2].value[k] * d;
        sum.col(1) += w[0].value[i] * w[1].slope[j] * w[2].value[k] * d;
        sum.col(2) += w[0].value[i] * w[1].value[j] * w[2].slope[k] * d;
      }
    }
  }
  return Mat3::Identity() + sum / spacing_mm;
}

Vec3 HeartWarp::to_world(const Vec3& own) const {
  constexpr double tolerance_mm = 1e-7;
  Vec3 p = own - (to_own(own) - own);
  for (int i = 0; i < 60; ++i) {
    const Vec3 off = to_own(p) - own;
    if (off.norm() < tolerance_mm) break;
    Vec3 step = gradient(p).inverse() * off;
    if (step.norm() > spacing_mm)
      step *= spacing_mm / step.norm();  // Newton's steps may leap out of a valley
    p -= step;
  }
  return p;
}

/// One round of the binomial filter along each axis.
void HeartWarp::smooth() {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vec3> out = displacement_;
    core::parallel_for(static_cast<std::size_t>(count_[2]), 4, [&](std::size_t slab) {
      const int k = static_cast<int>(slab);
      for (int j = 0; j < count_[1]; ++j) {
        for (int i = 0; i < count_[0]; ++i) {
          const std::array<int, 3> here{i, j, k};
          const auto n = static_cast<std::size_t>(axis);
          if (here[n] == 0 || here[n] + 1 == count_[n]) continue;
          const std::size_t step = at(axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
          const std::size_t m = at(i, j, k);
          out[m] = 0.25 * displacement_[m - step] + 0.5 * displacement_[m] + 0.25 * displacement_[m + step];
        }
      }
    });
    displacement_ = std::move(out);
  }
}

void HeartWarp::measure() {
  struct Found {
    double least = 1.0, largest = 1.0, longest = 0.0;
  };
  const Found found = core::parallel_reduce<Found>(
      static_cast<std::size_t>(2 * count_[2]), 2, Found{},
      [&](std::size_t first, std::size_t last) {
        Found own;
        for (std::size_t k = first; k < last; ++k) {
          for (int j = 2; j < 2 * count_[1] - 4; ++j) {
            for (int i = 2; i < 2 * count_[0] - 4; ++i) {
              const Vec3 p = origin_ + 0.5 * spacing_mm * Vec3(i, j, static_cast<double>(k));
              const double jacobian = gradient(p).determinant();
              own.least = std::min(own.least, jacobian);
              own.largest = std::max(own.largest, jacobian);
              if (i % 2 == 0 && j % 2 == 0 && k % 2 == 0)
                own.longest = std::max(own.longest, (to_own(p) - p).norm());
            }
          }
        }
        return own;
      },
      [](const Found& a, const Found& b) {
        return Found{std::min(a.least, b.least), std::max(a.largest, b.largest),
                     std::max(a.longest, b.longest)};
      });
  least_ = found.least;
  largest_ = found.largest;
  longest_ = found.longest;
}

}  // namespace ostia::phantom
