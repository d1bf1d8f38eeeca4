#include "marching_cubes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/cube_patterns.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

// Cubes a chunk is high. Chunks are worked on side by side and share the vertices of the slice between them.
constexpr std::int64_t chunk_height = 8;

/// Vertices and triangles of one chunk. Vertices in the first slice come first, those in the last slice last,
/// both in the order of the scan: so the last of one chunk are the first of the next.
struct SlabPart {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::int32_t before_last_slice = 0;
};

class Chunk {
 public:
  Chunk(const MarchingCubes& job, std::int64_t first, std::int64_t last)
      : job_(job),
        nx_(job.size[0]),
        ny_(job.size[1]),
        first_(first),
        slices_(last - first + 1),
        values_(static_cast<std::size_t>(nx_ * ny_ * slices_)) {
    job.fill(first, slices_, values_.data());
    check();
    for (auto& below : across_x_) below.resize(static_cast<std::size_t>(nx_ * ny_));
    for (auto& below : across_y_) below.resize(static_cast<std::size_t>(nx_ * ny_));
    along_z_.resize(static_cast<std::size_t>(nx_ * ny_));
  }

  SlabPart run() {
    slice_vertices(0, 0);
    for (std::int64_t k = 0; k + 1 < slices_; ++k) {
      upright_vertices(k);
      part_.before_last_slice = count();
      slice_vertices(k + 1, static_cast<int>((k + 1) % 2));
      cubes(k);
    }
    return std::move(part_);
  }

 private:
  void check() const {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!std::isnan(values_[i])) continue;
      const auto at = static_cast<std::int64_t>(i), from = job_.numbered_from;
      throw InvalidInput("the grid's value at voxel " + std::to_string(from + at % nx_) + "," +
                         std::to_string(from + at / nx_ % ny_) + "," +
                         std::to_string(from + first_ + at / (nx_ * ny_)) +
                         " is not a number; replace it before an isosurface is taken");
    }
  }

  std::int32_t count() const { return static_cast<std::int32_t>(part_.points.size()); }
  std::size_t at(std::int64_t i, std::int64_t j) const { return static_cast<std::size_t>(i + nx_ * j); }
  const float* slice(std::int64_t k) const {
    return values_.data() + static_cast<std::size_t>(nx_ * ny_ * k);
  }
  bool in(float value) const { return value < job_.level; }

  std::int32_t vertex(std::int64_t i, std::int64_t j, std::int64_t k, int axis, float from, float to) {
    if (part_.points.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max() - 1)) {
      throw ResourceError("the isosurface has more than 2^31 points; use a coarser grid");
    }
    part_.points.push_back(job_.place({{i, j, first_ + k}, axis, from, to}));
    return count() - 1;
  }

  void slice_vertices(std::int64_t k, int which) {
    const float* v = slice(k);
    auto& ex = across_x_[static_cast<std::size_t>(which)];
    auto& ey = across_y_[static_cast<std::size_t>(which)];
    for (std::int64_t j = 0; j < ny_; ++j) {
      for (std::int64_t i = 0; i < nx_; ++i) {
        const std::size_t n = at(i, j);
        const bool here = in(v[n]);
        if (i + 1 < nx_ && here != in(v[n + 1])) ex[n] = vertex(i, j, k, 0, v[n], v[n + 1]);
        const std::size_t up = n + static_cast<std::size_t>(nx_);
        if (j + 1 < ny_ && here != in(v[up])) ey[n] = vertex(i, j, k, 1, v[n], v[up]);
      }
    }
  }

  void upright_vertices(std::int64_t k) {
    const float *low = slice(k), *high = slice(k + 1);
    for (std::int64_t j = 0; j < ny_; ++j) {
      for (std::int64_t i = 0; i < nx_; ++i) {
        const std::size_t n = at(i, j);
        if (in(low[n]) != in(high[n])) along_z_[n] = vertex(i, j, k, 2, low[n], high[n]);
      }
    }
  }

  template <class Visit>
  void each_crossed_cube(std::int64_t k, const Visit& visit) const {
    const float *low = slice(k), *high = slice(k + 1);
    const auto row = static_cast<std::size_t>(nx_);
    for (std::int64_t j = 0; j + 1 < ny_; ++j) {
      // Bits 0, 2, 4, 6 hold the cube's left corners, 1, 3, 5, 7 its right ones.
      unsigned bits = 0;
      for (std::int64_t i = 0; i < nx_; ++i) {
        const std::size_t n = at(i, j);
        bits = ((bits >> 1) & 0x55u) | (in(low[n]) ? 0x02u : 0u) | (in(low[n + row]) ? 0x08u : 0u) |
               (in(high[n]) ? 0x20u : 0u) | (in(high[n + row]) ? 0x80u : 0u);
        if (i > 0 && bits != 0 && bits != 0xFFu) visit(i - 1, j, bits);
      }
    }
  }

  void cubes(std::int64_t k) {
    const auto below = static_cast<std::size_t>(k % 2), above = 1 - below;
    const auto& patterns = cube_patterns();
    each_crossed_cube(k, [&](std::int64_t i, std::int64_t j, unsigned bits) {
      const std::size_t n = at(i, j), right = n + 1, back = n + static_cast<std::size_t>(nx_);
      const std::array<const std::int32_t*, 12> place{
          &across_x_[below][n], &across_x_[below][back],  &across_x_[above][n], &across_x_[above][back],
          &across_y_[below][n], &across_y_[below][right], &across_y_[above][n], &across_y_[above][right],
          &along_z_[n],         &along_z_[right],         &along_z_[back],      &along_z_[back + 1]};
      for (const auto& t : patterns[bits]) {
        Triangle triangle{*place[t[0]], *place[t[1]], *place[t[2]]};
        if (job_.left_handed) std::swap(triangle[1], triangle[2]);
        part_.triangles.push_back(triangle);
      }
    });
  }

  const MarchingCubes& job_;
  std::int64_t nx_, ny_, first_, slices_;
  std::vector<float> values_;
  // Vertex on the edge that begins at a node; only read where the edge is crossed, so never cleared.
  std::array<std::vector<std::int32_t>, 2> across_x_, across_y_;
  std::vector<std::int32_t> along_z_;
  SlabPart part_;
};

TriMesh join(std::vector<SlabPart>& parts) {
  std::size_t points = 0, triangles = 0;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const SlabPart& part = parts[c];
    points += c + 1 < parts.size() ? static_cast<std::size_t>(part.before_last_slice) : part.points.size();
    triangles += part.triangles.size();
  }
  if (points > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw ResourceError("the isosurface has more than 2^31 points; use a coarser grid");
  }
  TriMesh mesh;
  mesh.points.reserve(points);
  mesh.triangles.reserve(triangles);
  for (std::size_t c = 0; c < parts.size(); ++c) {
    SlabPart& part = parts[c];
    // A vertex in the last slice is the next chunk's at the same place in the scan.
    const auto offset = static_cast<std::int32_t>(mesh.points.size());
    const bool shares = c + 1 < parts.size();
    const auto own = shares ? part.points.begin() + part.before_last_slice : part.points.end();
    mesh.points.insert(mesh.points.end(), part.points.begin(), own);
    for (const Triangle& t : part.triangles) {
      mesh.triangles.push_back({offset + t[0], offset + t[1], offset + t[2]});
    }
    part = SlabPart{};
  }
  return mesh;
}

}  // namespace

double crossing_fraction(float from, float to, float level) {
  constexpr float largest = std::numeric_limits<float>::max();
  const double a = std::clamp(from, -largest, largest), b = std::clamp(to, -largest, largest);
  return std::clamp((static_cast<double>(level) - a) / (b - a), node_clearance, 1.0 - node_clearance);
}

TriMesh march(const MarchingCubes& job, const core::TaskContext& task) {
  if (std::isnan(job.level)) throw InvalidInput("the level of the isosurface is not a number");
  const auto [nx, ny, nz] = job.size;
  if (nx < 2 || ny < 2 || nz < 2) return {};
  const auto chunks = static_cast<std::size_t>((nz - 1 + chunk_height - 1) / chunk_height);
  std::vector<SlabPart> parts(chunks);
  std::atomic<std::size_t> done{0};
  core::parallel_for(chunks, 1, [&](std::size_t c) {
    task.throw_if_cancelled();
    const std::int64_t first = static_cast<std::int64_t>(c) * chunk_height;
    parts[c] = Chunk(job, first, std::min(first + chunk_height, nz - 1)).run();
    task.set_progress(static_cast<double>(++done) / static_cast<double>(chunks));
  });
  return join(parts);
}

}  // namespace ostia::geometry
