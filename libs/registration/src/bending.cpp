#include "bending.h"

#include <array>
#include <cmath>

namespace ostia::registration {
namespace {

constexpr double bending_length_mm = 20.0;

/// Sums scale (sum of coefficients times shifts)^2 over all nodes where the stencil fits, for one component.
struct BendingStencil {
  std::vector<std::pair<std::int64_t, double>> parts;  // offset from the node, coefficient
  std::array<std::int64_t, 3> first{}, last{};         // nodes [first, last)
  double scale = 0.0;
};

BendingStencil along(const imaging::Geometry& nodes, int axis, double weight) {
  const std::array<std::int64_t, 3> stride{1, nodes.size[0], nodes.size[0] * nodes.size[1]};
  BendingStencil stencil;
  stencil.last = nodes.size;
  stencil.first[axis] = 1;
  stencil.last[axis] -= 1;
  stencil.parts = {{-stride[axis], 1.0}, {0, -2.0}, {stride[axis], 1.0}};
  stencil.scale = weight * std::pow(bending_length_mm / (nodes.spacing[axis] * nodes.spacing[axis]), 2);
  return stencil;
}

BendingStencil across(const imaging::Geometry& nodes, int a, int b, double weight) {
  const std::array<std::int64_t, 3> stride{1, nodes.size[0], nodes.size[0] * nodes.size[1]};
  BendingStencil stencil;
  stencil.last = nodes.size;
  stencil.last[a] -= 1;
  stencil.last[b] -= 1;
  stencil.parts = {{0, 1.0}, {stride[a], -1.0}, {stride[b], -1.0}, {stride[a] + stride[b], 1.0}};
  stencil.scale = 2.0 * weight * std::pow(bending_length_mm / (nodes.spacing[a] * nodes.spacing[b]), 2);
  return stencil;
}

double add_bending(const imaging::Geometry& nodes, const BendingStencil& stencil, const double* shifts,
                   double* gradient) {
  double sum = 0.0;
  for (std::int64_t k = stencil.first[2]; k < stencil.last[2]; ++k)
    for (std::int64_t j = stencil.first[1]; j < stencil.last[1]; ++j)
      for (std::int64_t i = stencil.first[0]; i < stencil.last[0]; ++i) {
        const std::int64_t node = nodes.offset(i, j, k);
        double difference = 0.0;
        for (const auto& [offset, coefficient] : stencil.parts)
          difference += coefficient * shifts[node + offset];
        sum += difference * difference;
        for (const auto& [offset, coefficient] : stencil.parts)
          gradient[node + offset] += 2.0 * stencil.scale * difference * coefficient;
      }
  return stencil.scale * sum;
}

}  // namespace

double bending_cost(const imaging::Geometry& nodes, double weight, const double* shifts, double* gradient) {
  const std::int64_t count = nodes.voxels();
  const double each = weight / static_cast<double>(count);
  double cost = 0.0;
  for (int a = 0; a < 3; ++a) {
    const std::array<BendingStencil, 2> stencils{along(nodes, a, each), across(nodes, a, (a + 1) % 3, each)};
    for (const BendingStencil& stencil : stencils)
      for (int component = 0; component < 3; ++component)
        cost += add_bending(nodes, stencil, shifts + component * count, gradient + component * count);
  }
  return cost;
}

}  // namespace ostia::registration
