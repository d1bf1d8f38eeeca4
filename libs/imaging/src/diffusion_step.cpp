#include "diffusion_step.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ostia::imaging::detail {
namespace {

using Vec3f = Eigen::Vector3f;

constexpr std::int64_t kSlab = 4;       // slices a chunk
constexpr float kLeastSquare = 1e-10F;  // of a gradient that is divided by
constexpr float kFlat = 1e-6F;          // gradients below it have no direction

/// What the faces of a voxel ask of it.
struct Cell {
  Vec3f central = Vec3f::Zero();  ///< grad u by central differences
  Vec3f along = Vec3f::Zero();    ///< flux: sqrt(1 - g) e
  float g = 1.0F;                 ///< flux: what flows everywhere
};

/// A voxel and the steps to its neighbours, none across the border.
struct Place {
  std::int64_t at = 0;
  std::array<std::int64_t, 3> before{}, after{};
};

class Stepper {
 public:
  Stepper(const Geometry& grid, const float* u, const float* smooth, const StepOptions& options)
      : size_(grid.size), u_(u), smooth_(smooth), options_(options) {
    stride_ = {1, size_[0], size_[0] * size_[1]};
    for (int d = 0; d < 3; ++d) inverse_[d] = static_cast<float>(1.0 / grid.spacing[d]);
    inverse_k2_ = static_cast<float>(1.0 / (options.contrast * options.contrast));
  }

  /// Slices [first, last) of u after the step.
  void slab(std::int64_t first, std::int64_t last, const float* start, float* next) const;

 private:
  Place place(std::int64_t i, std::int64_t j, std::int64_t k) const;
  Cell cell(const Place& p) const;
  void flow(const Place& p, const Vec3f& gradient, Cell& cell) const;
  float face(const Cell& low, const Cell& high, float difference, int d) const;
  float change(const Place& p, const Cell* here) const;

  std::array<std::int64_t, 3> size_, stride_{};
  Vec3f inverse_;
  float inverse_k2_ = 0.0F;
  const float* u_;
  const float* smooth_;
  StepOptions options_;
};

Place Stepper::place(std::int64_t i, std::int64_t j, std::int64_t k) const {
  Place p;
  const std::array<std::int64_t, 3> index{i, j, k};
  for (std::size_t d = 0; d < 3; ++d) {
    p.at += index[d] * stride_[d];
    p.before[d] = index[d] > 0 ? -stride_[d] : 0;
    p.after[d] = index[d] + 1 < size_[d] ? stride_[d] : 0;
  }
  return p;
}

Vec3f central(const float* image, const Place& p, const Vec3f& inverse) {
  Vec3f out;
  for (std::size_t d = 0; d < 3; ++d)
    out[static_cast<int>(d)] =
        0.5F * inverse[static_cast<int>(d)] * (image[p.at + p.after[d]] - image[p.at + p.before[d]]);
  return out;
}

/// Where flux goes on an edge: along the surface of equal intensity, where it is curved least.
void Stepper::flow(const Place& p, const Vec3f& gradient, Cell& cell) const {
  cell.g = std::exp(-gradient.squaredNorm() * inverse_k2_);
  const float norm = gradient.norm();
  if (norm < kFlat) return;
  Vec3f pure, mixed;  // second derivatives; yz, xz, xy
  const float* s = smooth_ + p.at;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::size_t a = (d + 1) % 3, b = (d + 2) % 3;
    const int x = static_cast<int>(d), y = static_cast<int>(a), z = static_cast<int>(b);
    pure[x] = (s[p.after[d]] - 2.0F * s[0] + s[p.before[d]]) * inverse_[x] * inverse_[x];
    mixed[x] = 0.25F * inverse_[y] * inverse_[z] *
               (s[p.after[a] + p.after[b]] - s[p.after[a] + p.before[b]] - s[p.before[a] + p.after[b]] +
                s[p.before[a] + p.before[b]]);
  }
  Eigen::Matrix3f second;
  second << pure[0], mixed[2], mixed[1], mixed[2], pure[1], mixed[0], mixed[1], mixed[0], pure[2];
  const Vec3f normal = gradient / norm;
  const Vec3f v = normal.unitOrthogonal(), w = normal.cross(v);
  const Vec3f turned = second * v;
  const float vv = v.dot(turned), vw = w.dot(turned), ww = w.dot(second * w);
  // Of the form on the tangent plane the eigenvector of the eigenvalue that is nearer to 0.
  const float middle = 0.5F * (vv + ww), half = 0.5F * (vv - ww);
  const float angle = 0.5F * std::atan2(vw, half);  // of the larger eigenvalue
  const bool larger_is_flatter = middle < 0.0F;
  const float c = std::cos(angle), t = std::sin(angle);
  const Vec3f e = larger_is_flatter ? Vec3f(c * v + t * w) : Vec3f(-t * v + c * w);
  cell.along = std::sqrt(1.0F - cell.g) * e;
}

Cell Stepper::cell(const Place& p) const {
  Cell out;
  out.central = central(u_, p, inverse_);
  if (options_.method == Diffusion::flux) flow(p, central(smooth_, p, inverse_), out);
  return out;
}

/// What flows through the face between two voxels along axis d; `difference` is the derivative across it.
float Stepper::face(const Cell& low, const Cell& high, float difference, int d) const {
  if (options_.method == Diffusion::flux) {
    const auto side = [&](const Cell& c) {
      return c.g * difference +
             c.along[d] * (c.along.dot(c.central) + c.along[d] * (difference - c.central[d]));
    };
    return 0.5F * (side(low) + side(high));
  }
  Vec3f gradient = 0.5F * (low.central + high.central);
  gradient[d] = difference;
  const float squared = gradient.squaredNorm();
  const float conductance = std::exp(-0.5F * squared * inverse_k2_);
  if (options_.method == Diffusion::gradient) return conductance * difference;
  return conductance * difference / std::sqrt(squared + kLeastSquare);
}

/// du/dt, without the attachment; `here` is the voxel's cell among those of a slab.
float Stepper::change(const Place& p, const Cell* here) const {
  float sum = 0.0F;
  Vec3f behind = Vec3f::Zero(), ahead = Vec3f::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int d = static_cast<int>(axis);
    if (p.before[axis] != 0) {
      behind[d] = (u_[p.at] - u_[p.at + p.before[axis]]) * inverse_[d];
      sum -= face(here[p.before[axis]], *here, behind[d], d) * inverse_[d];
    }
    if (p.after[axis] != 0) {
      ahead[d] = (u_[p.at + p.after[axis]] - u_[p.at]) * inverse_[d];
      sum += face(*here, here[p.after[axis]], ahead[d], d) * inverse_[d];
    }
  }
  if (options_.method != Diffusion::curvature) return sum;
  // |grad u| from where the level sets come (Osher and Sethian 1988).
  const Vec3f zero = Vec3f::Zero();
  const float squared = sum > 0.0F ? behind.cwiseMin(zero).squaredNorm() + ahead.cwiseMax(zero).squaredNorm()
                                   : behind.cwiseMax(zero).squaredNorm() + ahead.cwiseMin(zero).squaredNorm();
  return std::sqrt(squared) * sum;
}

void Stepper::slab(std::int64_t first, std::int64_t last, const float* start, float* next) const {
  const std::int64_t from = std::max<std::int64_t>(first - 1, 0), to = std::min(last + 1, size_[2]);
  std::vector<Cell> cells(static_cast<std::size_t>((to - from) * stride_[2]));
  const auto each = [&](std::int64_t k0, std::int64_t k1, const auto& visit) {
    for (std::int64_t k = k0; k < k1; ++k)
      for (std::int64_t j = 0; j < size_[1]; ++j)
        for (std::int64_t i = 0; i < size_[0]; ++i) visit(place(i, j, k));
  };
  const std::int64_t shift = from * stride_[2];
  each(from, to, [&](const Place& p) { cells[static_cast<std::size_t>(p.at - shift)] = cell(p); });
  const auto dt = static_cast<float>(options_.dt);
  const auto pull = static_cast<float>(options_.attachment);
  each(first, last, [&](const Place& p) {
    const float flown = change(p, cells.data() + (p.at - shift));
    next[p.at] = u_[p.at] + dt * (flown + pull * (start[p.at] - u_[p.at]));
  });
}

}  // namespace

void diffusion_step(const Geometry& grid, const std::vector<float>& u, const std::vector<float>& smooth,
                    const std::vector<float>& start, const StepOptions& options, std::vector<float>& next,
                    const core::TaskContext& task) {
  const Stepper stepper(grid, u.data(), smooth.data(), options);
  core::parallel_chunks(static_cast<std::size_t>(grid.size[2]), kSlab,
                        [&](std::size_t first, std::size_t last) {
                          task.throw_if_cancelled();
                          stepper.slab(static_cast<std::int64_t>(first), static_cast<std::int64_t>(last),
                                       start.data(), next.data());
                        });
}

}  // namespace ostia::imaging::detail
