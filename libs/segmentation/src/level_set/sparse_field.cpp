#include "level_set/sparse_field.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::segmentation::detail {
namespace {

constexpr double kFarVoxels = 3.0;
constexpr double kHeldVoxels = 0.3;  // the least depth of a held voxel, of the least spacing

/// The distance solved from up to three axes with the nearest known distance on each.
double solve_eikonal(std::array<double, 3> a, std::array<double, 3> inverse_h, int used) {
  for (int i = 1; i < used; ++i) {
    for (int j = i; j > 0 && a[j] < a[j - 1]; --j) {
      std::swap(a[j], a[j - 1]);
      std::swap(inverse_h[j], inverse_h[j - 1]);
    }
  }
  double p = 0.0;
  double q = 0.0;
  double r = -1.0;
  double solution = 1e30;
  for (int n = 0; n < used && a[n] < solution; ++n) {
    const double w = inverse_h[n] * inverse_h[n];
    p += w;
    q += w * a[n];
    r += w * a[n] * a[n];
    const double discriminant = q * q - p * r;
    if (discriminant < 0.0) break;
    solution = (q + std::sqrt(discriminant)) / p;
  }
  return solution;
}

}  // namespace

SparseField::SparseField(const imaging::FloatVolume& initial) : geometry_(initial.geometry) {
  strides_ = {1, geometry_.size[0], geometry_.size[0] * geometry_.size[1]};
  for (int d = 0; d < 3; ++d) inverse_spacing_[d] = 1.0 / geometry_.spacing[d];
  far_ = kFarVoxels * geometry_.spacing.maxCoeff();
  start(initial);
}

bool SparseField::is_active(std::int64_t n) const {
  const bool negative = values_[n] < 0.0F;
  for (int d = 0; d < 3; ++d) {
    if ((values_[n - strides_[d]] < 0.0F) != negative || (values_[n + strides_[d]] < 0.0F) != negative)
      return true;
  }
  return false;
}

void SparseField::start(const imaging::FloatVolume& initial) {
  const auto& size = geometry_.size;
  const std::size_t count = initial.voxels.size();
  values_.resize(count);
  marks_.assign(count, kBorder);
  core::parallel_for(static_cast<std::size_t>(size[2]), 4, [&](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < size[1]; ++j) {
      for (std::int64_t i = 0; i < size[0]; ++i) {
        const std::int64_t n = geometry_.offset(i, j, k);
        const bool border =
            i == 0 || j == 0 || k == 0 || i + 1 == size[0] || j + 1 == size[1] || k + 1 == size[2];
        if (!border) marks_[n] = kFar;
        // The outermost voxels are outside: a surface that reaches them is closed there.
        values_[n] = static_cast<float>(initial.voxels[n] < 0.0F && !border ? -far_ : far_);
      }
    }
  });
  std::vector<float> distances;
  for (std::int64_t n = 0; n < static_cast<std::int64_t>(count); ++n) {
    if (marks_[n] == kBorder || !is_active(n)) continue;
    layers_[0].push_back(n);
    // The distance by the differences across the surface where there are such (Russo and Smereka 2000).
    double squared = 0.0;
    const double here = initial.voxels[n];
    for (int d = 0; d < 3; ++d) {
      double steepest = 0.0;
      for (const std::int64_t m : {n - strides_[d], n + strides_[d]}) {
        const double there = marks_[m] == kBorder ? std::abs(here) : initial.voxels[m];
        steepest = std::max(steepest, std::abs(there - here));
      }
      squared += steepest * steepest * inverse_spacing_[d] * inverse_spacing_[d];
    }
    const double h = geometry_.spacing.minCoeff();
    const double distance = squared > 0.0 ? here / std::sqrt(squared) : 0.0;
    distances.push_back(static_cast<float>(std::clamp(distance, -h, h)));
  }
  for (std::size_t a = 0; a < layers_[0].size(); ++a) {
    const std::int64_t n = layers_[0][a];
    const float least = 1e-4F * static_cast<float>(geometry_.spacing.minCoeff());
    values_[n] = initial.voxels[n] < 0.0F ? std::min(distances[a], -least) : std::max(distances[a], least);
    marks_[n] = 1;
  }
  grow_layers();
}

float SparseField::distance_from(std::int64_t n, const std::vector<std::uint8_t>& marks,
                                 std::uint8_t known) const {
  const float sign = values_[n] < 0.0F ? -1.0F : 1.0F;
  std::array<double, 3> a{};
  std::array<double, 3> w{};
  int used = 0;
  for (int d = 0; d < 3; ++d) {
    double nearest = 1e30;
    for (const std::int64_t m : {n - strides_[d], n + strides_[d]}) {
      if (marks[m] == known) nearest = std::min(nearest, static_cast<double>(sign * values_[m]));
    }
    if (nearest >= 1e30) continue;
    a[used] = nearest;
    w[used++] = inverse_spacing_[d];
  }
  return sign * static_cast<float>(std::min(solve_eikonal(a, w, used), far_));
}

void SparseField::grow_layers() {
  for (std::uint8_t layer = 1; layer < 3; ++layer) {
    std::vector<std::int64_t>& next = layers_[layer];
    next.clear();
    for (const std::int64_t n : layers_[layer - 1]) {
      for (int d = 0; d < 3; ++d) {
        for (const std::int64_t m : {n - strides_[d], n + strides_[d]}) {
          if (marks_[m] != kFar) continue;
          marks_[m] = static_cast<std::uint8_t>(layer + 1);
          next.push_back(m);
        }
      }
    }
    core::parallel_for(next.size(), 4096,
                       [&](std::size_t a) { values_[next[a]] = distance_from(next[a], marks_, layer); });
  }
}

void SparseField::hold_inside(std::vector<std::int64_t> voxels) {
  held_ = std::move(voxels);
  restrain();
}

void SparseField::restrain() {
  const float deepest = static_cast<float>(-kHeldVoxels * geometry_.spacing.minCoeff());
  for (const std::int64_t n : held_) {
    if (marks_[n] == 1) values_[n] = std::min(values_[n], deepest);
  }
}

void SparseField::advance(const std::vector<float>& changes) {
  std::vector<std::int64_t> old = std::move(layers_[0]);
  core::parallel_for(old.size(), 8192, [&](std::size_t a) { values_[old[a]] += changes[a]; });
  restrain();
  // First-layer voxels get the distance of the moved surface before some of them join the active layer.
  std::vector<float> first(layers_[1].size());
  core::parallel_for(layers_[1].size(), 4096,
                     [&](std::size_t a) { first[a] = distance_from(layers_[1][a], marks_, 1); });
  for (std::size_t a = 0; a < first.size(); ++a) {
    const std::int64_t n = layers_[1][a];
    const bool negative = values_[n] < 0.0F;
    if ((first[a] < 0.0F) == negative) values_[n] = first[a];
  }
  // Everything forgets its layer; who leaves the band keeps its sign alone.
  layers_[0].clear();
  std::vector<std::int64_t> candidates = std::move(old);
  candidates.insert(candidates.end(), layers_[1].begin(), layers_[1].end());
  for (const std::int64_t n : candidates) marks_[n] = kFar;
  for (const std::int64_t n : layers_[2]) {
    marks_[n] = kFar;
    values_[n] = static_cast<float>(values_[n] < 0.0F ? -far_ : far_);
  }
  for (const std::int64_t n : candidates) {
    if (!is_active(n)) continue;
    marks_[n] = 1;
    layers_[0].push_back(n);
  }
  const float limit = static_cast<float>(1.5 * geometry_.spacing.maxCoeff());
  for (const std::int64_t n : candidates) {
    if (marks_[n] == 1) {
      values_[n] = std::clamp(values_[n], -limit, limit);
    } else {
      values_[n] = static_cast<float>(values_[n] < 0.0F ? -far_ : far_);
    }
  }
  grow_layers();
}

imaging::FloatVolume SparseField::take() && {
  return {geometry_, std::move(values_)};
}

}  // namespace ostia::segmentation::detail
