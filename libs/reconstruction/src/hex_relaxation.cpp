#include "hex_relaxation.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace ostia::reconstruction {
namespace {

using geometry::Hexahedron;
using geometry::HexMesh;
using geometry::Vec3;

constexpr std::array<std::array<int, 2>, 12> edges = {
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

class Relaxation {
 public:
  Relaxation(HexMesh& mesh, const LayerLines& layers, double wanted)
      : mesh_(mesh),
        depths_(layers.depths),
        wanted_(wanted),
        line_(mesh.points.size()),
        around_(mesh.points.size()) {
    // Whose hexahedra change with which node: those about a node of a line with the line's end.
    std::vector<std::int32_t> mover(mesh.points.size());
    std::iota(mover.begin(), mover.end(), 0);
    for (const auto& line : layers.lines) {
      for (std::size_t i = 1; i < line.size(); ++i) mover[static_cast<std::size_t>(line[i])] = line.back();
      if (!line.empty()) line_[static_cast<std::size_t>(line.back())] = &line;
    }
    for (const geometry::Quad& q : mesh.quads)
      for (const std::int32_t p : q) mover[static_cast<std::size_t>(p)] = -1;
    for (std::size_t h = 0; h < mesh.hexahedra.size(); ++h)
      for (const std::int32_t p : mesh.hexahedra[h]) {
        const std::int32_t by = mover[static_cast<std::size_t>(p)];
        if (by < 0) continue;
        std::vector<std::int32_t>& about = around_[static_cast<std::size_t>(by)];
        if (about.empty() || about.back() != static_cast<std::int32_t>(h))
          about.push_back(static_cast<std::int32_t>(h));
      }
  }

  /// Whether anything was moved.
  bool round(const core::TaskContext& task) {
    bool moved = false;
    for (std::size_t node = 0; node < around_.size(); ++node) {
      if (node % 1024 == 0) task.throw_if_cancelled();
      if (!around_[node].empty()) moved = improve(node) || moved;
    }
    return moved;
  }

 private:
  double least_about(std::size_t node) const {
    double least = 1.0;
    for (const std::int32_t h : around_[node])
      least = std::min(least, geometry::scaled_jacobian(mesh_, mesh_.hexahedra[static_cast<std::size_t>(h)]));
    return least;
  }

  struct Neighbours {
    Vec3 middle = Vec3::Zero();
    double distance = 0.0;  ///< mean
  };
  Neighbours neighbours(std::size_t node) const {
    Neighbours out;
    double count = 0.0;
    for (const std::int32_t h : around_[node]) {
      const Hexahedron& hexahedron = mesh_.hexahedra[static_cast<std::size_t>(h)];
      for (const auto& edge : edges)
        for (const int end : {0, 1}) {
          const auto at = [&](int k) {
            return static_cast<std::size_t>(
                hexahedron[static_cast<std::size_t>(edge[static_cast<std::size_t>(k)])]);
          };
          if (at(end) != node) continue;
          const Vec3& other = mesh_.points[at(1 - end)];
          out.middle += other;
          out.distance += (other - mesh_.points[node]).norm();
          count += 1.0;
        }
    }
    out.middle /= count;
    out.distance /= count;
    return out;
  }

  void move(std::size_t node, const Vec3& place) {
    mesh_.points[node] = place;
    if (line_[node] == nullptr) return;
    const std::vector<std::int32_t>& line = *line_[node];
    const Vec3& wall = mesh_.points[static_cast<std::size_t>(line.front())];
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      mesh_.points[static_cast<std::size_t>(line[i])] = wall + depths_[i] * (place - wall);
  }

  bool improve(std::size_t node) {
    const double before = least_about(node);
    if (before >= wanted_) return false;
    const Vec3 old = mesh_.points[node];
    const Neighbours near = neighbours(node);
    Vec3 best = old;
    double most = before;
    const auto attempt = [&](const Vec3& place) {
      move(node, place);
      const double least = least_about(node);
      if (least > most + 1e-6) {
        most = least;
        best = place;
      }
    };
    for (const double part : {1.0, 0.5, 0.2}) attempt(old + part * (near.middle - old));
    for (double step = 0.5 * near.distance; step > 0.01 * near.distance; step *= 0.5) {
      const Vec3 from = best;
      for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) attempt(from + sign * step * Vec3::Unit(axis));
    }
    move(node, best);
    return most > before;
  }

  HexMesh& mesh_;
  const std::vector<double>& depths_;
  double wanted_;
  std::vector<const std::vector<std::int32_t>*> line_;  ///< of each node the line it ends, if it does
  std::vector<std::vector<std::int32_t>> around_;       ///< hexahedra that change when the node is moved
};

}  // namespace

void relax(HexMesh& mesh, const LayerLines& layers, double wanted, int rounds,
           const core::TaskContext& task) {
  Relaxation relaxation(mesh, layers, wanted);
  for (int i = 0; i < rounds && relaxation.round(task); ++i)
    task.set_progress(static_cast<double>(i + 1) / static_cast<double>(rounds));
}

}  // namespace ostia::reconstruction
