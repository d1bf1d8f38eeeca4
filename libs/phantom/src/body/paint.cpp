#include "body/paint.h"

#include "scan/artefacts.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

using geometry::Vec3;

constexpr std::int64_t block_side = 16;
/// Neighbours of one material that differ by more, in HU, are not one piece of it.
constexpr float strong_difference_hu = 40.0f;

Vec3 vector_of(std::int64_t i, std::int64_t j, std::int64_t k) {
  return {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
}

/// The centres of three consecutive slices; a slice beyond the grid repeats its neighbour.
struct ThreeSlices {
  std::array<const std::uint8_t*, 3> labels;
  std::array<const float*, 3> hu;
};

/// Whether one of the neighbours across a face or an edge is of another material. A surface that is flat at
/// the voxel's scale cannot pass through the voxel otherwise, but for a corner of 10^-4 of it.
bool at_boundary(const ThreeSlices& slices, std::int64_t width, std::int64_t height, std::int64_t i,
                 std::int64_t j) {
  const auto at = static_cast<std::ptrdiff_t>(j * width + i);
  const std::uint8_t label = slices.labels[1][at];
  const float hu = slices.hu[1][at];
  for (int dk = -1; dk <= 1; ++dk) {
    for (int dj = -1; dj <= 1; ++dj) {
      if (j + dj < 0 || j + dj >= height) continue;
      for (int di = -1; di <= 1; ++di) {
        if (di * dj * dk != 0 || i + di < 0 || i + di >= width) continue;
        const auto other = at + dj * static_cast<std::ptrdiff_t>(width) + di;
        const auto slice = static_cast<std::size_t>(dk + 1);
        if (slices.labels[slice][other] != label) return true;
        if (std::abs(slices.hu[slice][other] - hu) > strong_difference_hu) return true;
      }
    }
  }
  return false;
}

}  // namespace

Painter::Painter(const Scene& scene, const ScanOptions& options, const imaging::Geometry& grid,
                 std::array<std::int64_t, 3> margin)
    : scene_(scene), options_(options), grid_(grid), margin_(margin) {
  blocks_i_ = (grid.size[0] + block_side - 1) / block_side;
  blocks_j_ = (grid.size[1] + block_side - 1) / block_side;
  step_ = grid.direction * grid.spacing.asDiagonal();
}

Painter::Block Painter::block(std::size_t index) const {
  const std::int64_t i = static_cast<std::int64_t>(index) % blocks_i_,
                     j = static_cast<std::int64_t>(index) / blocks_i_;
  return {i * block_side, std::min((i + 1) * block_side, grid_.size[0]), j * block_side,
          std::min((j + 1) * block_side, grid_.size[1])};
}

/// Where what the scanner shows at an index lies in the scene.
geometry::Vec3 Painter::place(const Vec3& index) const {
  const Vec3 point = grid_.world(index);
  if (options_.stair_step_mm <= 0.0) return point;
  const auto slice = static_cast<std::int64_t>(std::floor(index.z() + 0.5)) - margin_[2];
  return point - motion_share(options_, point) * stair_shift(options_, slice);
}

geometry::Box3 Painter::box(const Block& b, std::int64_t first, std::int64_t count) const {
  geometry::Box3 box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 index(static_cast<double>((corner & 1) != 0 ? b.i1 : b.i0) - 0.5,
                     static_cast<double>((corner & 2) != 0 ? b.j1 : b.j0) - 0.5,
                     static_cast<double>((corner & 4) != 0 ? first + count : first) - 0.5);
    box.extend(grid_.world(index));
  }
  const Vec3 shift = Vec3::Constant(1e-6 + 0.5 * options_.stair_step_mm);
  return {box.min() - shift, box.max() + shift};
}

Slab Painter::centres(std::int64_t first, std::int64_t count, const core::TaskContext& task) const {
  Slab slab;
  slab.first = first;
  slab.count = count;
  const std::int64_t width = grid_.size[0], height = grid_.size[1];
  const auto voxels = static_cast<std::size_t>(width * height * count);
  slab.centre_hu.resize(voxels);
  slab.labels.resize(voxels);
  slab.parts.resize(blocks());
  slab.fine.resize(blocks());
  slab.differences.resize(blocks());
  core::parallel_for(blocks(), 1, [&](std::size_t index) {
    task.throw_if_cancelled();
    const Block b = block(index);
    slab.parts[index] = scene_.part(box(b, first, count));
    const ScenePart& part = *slab.parts[index];
    const std::optional<Material> all = part.uniform();
    for (std::int64_t k = 0; k < count; ++k) {
      for (std::int64_t j = b.j0; j < b.j1; ++j) {
        const auto row = static_cast<std::size_t>(width * (j + height * k));
        for (std::int64_t i = b.i0; i < b.i1; ++i) {
          const Material m = all ? *all : part.at(place(vector_of(i, j, first + k)));
          slab.labels[row + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(m.label);
          slab.centre_hu[row + static_cast<std::size_t>(i)] = m.hu;
        }
      }
    }
    if (all) slab.parts[index].reset();
  });
  slab.mean_hu = slab.centre_hu;
  return slab;
}

/// The pieces of a voxel; false when its corners show that it is all of one material after all.
bool Painter::sample_pieces(const ScenePart& part, const Vec3& index, const Material& centre, bool fine,
                            std::vector<float>& values) const {
  const int n = options_.supersampling;
  const auto piece_at = [&](int px, int py, int pz) {
    const Vec3 offset(px, py, pz);
    return part.at(place(index + ((offset.array() + 0.5) / n - 0.5).matrix()));
  };
  if (!fine && n > 2) {
    bool same = true;
    for (int corner = 0; corner < 8 && same; ++corner) {
      const Material m =
          piece_at((corner & 1) * (n - 1), (corner >> 1 & 1) * (n - 1), (corner >> 2) * (n - 1));
      same = m.label == centre.label && std::abs(m.hu - centre.hu) <= strong_difference_hu;
    }
    if (same) return false;
  }
  std::size_t at = 0;
  for (int pz = 0; pz < n; ++pz) {
    for (int py = 0; py < n; ++py) {
      for (int px = 0; px < n; ++px) values[at++] = piece_at(px, py, pz).hu;
    }
  }
  return true;
}

void Painter::refine_block(Slab& slab, std::size_t index, const Slab* before, const Slab* after) const {
  const ScenePart& part = *slab.parts[index];
  const Block b = block(index);
  const std::int64_t width = grid_.size[0], height = grid_.size[1], plane = width * height;
  const auto slice_of = [&](std::int64_t k) -> std::pair<const Slab*, std::int64_t> {
    if (k < 0)
      return before != nullptr ? std::pair{before, before->count - 1} : std::pair{&slab, std::int64_t{0}};
    if (k >= slab.count)
      return after != nullptr ? std::pair{after, std::int64_t{0}} : std::pair{&slab, k - 1};
    return {&slab, k};
  };
  // Is there anything thin in the whole block?
  const geometry::Box3 whole = box(b, slab.first, slab.count);
  const bool thin = part.fine_near(whole.center(), 0.5 * whole.diagonal().norm());
  const double reach_mm = 0.5 * grid_.spacing.norm();
  const auto pieces = static_cast<std::size_t>(std::pow(options_.supersampling, 3) + 0.5);
  std::vector<float> values(pieces);
  for (std::int64_t k = 0; k < slab.count; ++k) {
    ThreeSlices slices{};
    for (int dk = -1; dk <= 1; ++dk) {
      const auto [from, at] = slice_of(k + dk);
      slices.labels[static_cast<std::size_t>(dk + 1)] = from->labels.data() + at * plane;
      slices.hu[static_cast<std::size_t>(dk + 1)] = from->centre_hu.data() + at * plane;
    }
    for (std::int64_t j = b.j0; j < b.j1; ++j) {
      for (std::int64_t i = b.i0; i < b.i1; ++i) {
        const Vec3 at = vector_of(i, j, slab.first + k);
        const bool fine = thin && part.fine_near(place(at), reach_mm);
        if (!fine && !at_boundary(slices, width, height, i, j)) continue;
        const auto voxel = static_cast<std::size_t>(i + width * (j + height * k));
        const Material centre{static_cast<Label>(slab.labels[voxel]), slab.centre_hu[voxel]};
        if (!sample_pieces(part, at, centre, fine, values)) continue;
        double sum = 0.0;
        for (const float v : values) sum += v;
        const auto mean = static_cast<float>(sum / static_cast<double>(pieces));
        slab.mean_hu[voxel] = mean;
        float largest = 0.0f;
        for (float& v : values) largest = std::max(largest, std::abs(v -= mean));
        if (largest < 0.5f) continue;
        slab.fine[index].push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j),
                                    static_cast<std::int32_t>(slab.first + k)});
        slab.differences[index].insert(slab.differences[index].end(), values.begin(), values.end());
      }
    }
  }
}

void Painter::refine(Slab& slab, const Slab* before, const Slab* after, const core::TaskContext& task) const {
  core::parallel_for(blocks(), 1, [&](std::size_t index) {
    task.throw_if_cancelled();
    if (slab.parts[index] == nullptr) return;
    if (options_.supersampling > 1) refine_block(slab, index, before, after);
    slab.parts[index].reset();
  });
}

}  // namespace ostia::phantom
