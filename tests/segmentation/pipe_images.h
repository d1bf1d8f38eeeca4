#pragma once
/// \file Images of tubes about curved lines, blurred and noisy, and a parent with a branch.

#include "ostia/geometry/polyline.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace ostia::segmentation::testing {

using geometry::Vec3;

/// A tube about a line: its contrast is added to the background where the lumen is.
struct Pipe {
  std::vector<Vec3> axis;
  double radius = 1.0;
  double hu = 350.0;
};

/// Tubes with walls blurred by a Gaussian (sigma 0.35 mm), with noise.
inline imaging::ImageVolume pipe_image(const std::vector<Pipe>& pipes,
                                       const std::array<std::int64_t, 3>& size, const Vec3& spacing,
                                       double noise = 15.0) {
  imaging::ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.geometry.origin = Vec3(-10.0, 5.0, 20.0);
  std::vector<float> values(static_cast<std::size_t>(image.geometry.voxels()), 60.0F);
  for (const Pipe& pipe : pipes) {
    const std::vector<Vec3> dense = geometry::resample(pipe.axis, 0.3);
    std::vector<float> nearest(values.size(), 1e9F);
    const double reach = pipe.radius + 1.6;
    for (const Vec3& p : dense) {
      const Vec3 at = image.geometry.index(p);
      const Vec3 half = Vec3::Constant(reach).cwiseQuotient(spacing);
      std::array<std::int64_t, 3> low{}, high{};
      for (int d = 0; d < 3; ++d) {
        low[static_cast<std::size_t>(d)] = std::max<std::int64_t>(0, std::llround(at[d] - half[d]));
        high[static_cast<std::size_t>(d)] =
            std::min<std::int64_t>(size[static_cast<std::size_t>(d)] - 1, std::llround(at[d] + half[d]));
      }
      for (std::int64_t k = low[2]; k <= high[2]; ++k)
        for (std::int64_t j = low[1]; j <= high[1]; ++j)
          for (std::int64_t i = low[0]; i <= high[0]; ++i) {
            const Vec3 w = image.geometry.world(
                Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
            float& n = nearest[static_cast<std::size_t>(image.geometry.offset(i, j, k))];
            n = std::min(n, static_cast<float>((w - p).norm()));
          }
    }
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (nearest[v] > reach) continue;
      const double part = 0.5 * std::erfc((nearest[v] - pipe.radius) / (std::sqrt(2.0) * 0.35));
      values[v] = std::max(values[v], static_cast<float>(60.0 + (pipe.hu - 60.0) * part));
    }
  }
  std::mt19937 generator(11);
  std::normal_distribution<float> random(0.0F, static_cast<float>(noise));
  image.voxels.resize(values.size());
  for (std::size_t v = 0; v < values.size(); ++v)
    image.voxels[v] = static_cast<std::int16_t>(std::lround(values[v] + random(generator)));
  return image;
}

inline std::vector<Vec3> line(const Vec3& from, const Vec3& to) {
  return geometry::resample({from, to}, 0.5);
}

inline geometry::VesselTree tree_of(const std::vector<Vec3>& axis, double radius, std::int32_t id = 3) {
  geometry::VesselTree tree;
  tree.nodes = {{1, axis.front()}, {2, axis.back()}};
  geometry::TreeSegment segment;
  segment.id = 5;
  segment.from = 1;
  segment.to = 2;
  segment.axis.points = axis;
  segment.axis.radius.assign(axis.size(), radius);
  geometry::complete(segment.axis);
  tree.segments = {segment};
  tree.vessels = {{id, "LAD", {5}}};
  return tree;
}

inline double mean_distance(const std::vector<Vec3>& points, const std::vector<Vec3>& truth,
                            double skip_mm = 0.0) {
  const std::vector<double> s = geometry::abscissas(points);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (s[i] < skip_mm) continue;
    sum += (geometry::closest(truth, points[i]).point - points[i]).norm();
    ++count;
  }
  return sum / static_cast<double>(count);
}

/// A straight parent along x and a curved branch that leaves it at 60 degrees.
struct Fork {
  std::vector<Vec3> parent, branch;
  Vec3 junction;
  geometry::VesselTree tree;
  imaging::ImageVolume image;
};

inline Fork fork(const std::vector<Pipe>& others = {}, double gap_from = 0.0, double gap_to = 0.0) {
  Fork f;
  f.parent = line(Vec3(-12.0, 15.0, 30.0), Vec3(32.0, 15.0, 30.0));
  f.junction = Vec3(0.0, 15.0, 30.0);
  for (double t = 0.0; t <= 1.0001; t += 0.01) {
    const double angle = (60.0 - 80.0 * t) * M_PI / 180.0;  // bends forward
    const Vec3 step(std::cos(angle), std::sin(angle), 0.35 * std::sin(5.0 * t));
    f.branch.push_back(f.branch.empty() ? f.junction : Vec3(f.branch.back() + 0.3 * step));
  }
  std::vector<Pipe> pipes{{f.parent, 1.8, 380.0}};
  if (gap_to > gap_from) {
    const std::vector<double> s = geometry::abscissas(f.branch);
    Pipe proximal{{}, 1.1, 360.0}, distal{{}, 1.1, 360.0};
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (s[i] <= gap_from) proximal.axis.push_back(f.branch[i]);
      if (s[i] >= gap_to) distal.axis.push_back(f.branch[i]);
    }
    pipes.push_back(proximal);
    pipes.push_back(distal);
  } else {
    pipes.push_back({f.branch, 1.1, 360.0});
  }
  pipes.insert(pipes.end(), others.begin(), others.end());
  f.tree = tree_of(f.parent, 1.8);
  f.image = pipe_image(pipes, {120, 100, 50}, Vec3(0.4, 0.4, 0.5));
  return f;
}

}  // namespace ostia::segmentation::testing
