#include "ostia/lumen/tree_surface.h"

#include "wall/change.h"
#include "wall/following.h"
#include "wall/mesh.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::lumen {
namespace {

constexpr double bytes_per_cell = 256.0;  // values, pieces and the joined mesh
// A throat of 0.1 mm would ask for cells of 0.025 mm of the whole tree, twenty million triangles; these still
// put four across it.
constexpr double finest_default_mm = 0.05;
// Cells from the origin, so that places in the grid are whole numbers of 32 bits with room to spare.
constexpr double farthest_cell = 1e9;

/// What a block has to look at in one wave.
struct Visit {
  std::vector<CellCode> seeds;  // ascending
  std::vector<GridIndex> entries;
};
using Wave = std::map<GridIndex, Visit>;

GridIndex cell_of(const Vec3& seed, double cell_mm) {
  const Vec3 cell = (seed / cell_mm).array().floor();
  if (!(cell.lpNorm<Eigen::Infinity>() < farthest_cell))
    throw InvalidInput("a seed of the wall lies at " + std::to_string(seed.x()) + ", " +
                       std::to_string(seed.y()) + ", " + std::to_string(seed.z()) +
                       " mm; it must be finite and less than 1e9 cells from the origin");
  return {static_cast<std::int32_t>(cell.x()), static_cast<std::int32_t>(cell.y()),
          static_cast<std::int32_t>(cell.z())};
}

Wave wave_of_seeds(const std::vector<Vec3>& seeds, double cell_mm) {
  if (seeds.empty()) throw InvalidInput("the wall has no seeds to start from; give places on it");
  Wave wave;
  auto last = wave.end();  // most seeds lie in the same block as the one before
  for (const Vec3& seed : seeds) {
    const GridIndex cell = cell_of(seed, cell_mm), block = block_of(cell);
    if (last == wave.end() || last->first != block) last = wave.try_emplace(block).first;
    last->second.seeds.push_back(code_in_block(cell, block));
  }
  for (auto& [block, visit] : wave) {
    std::sort(visit.seeds.begin(), visit.seeds.end());
    visit.seeds.erase(std::unique(visit.seeds.begin(), visit.seeds.end()), visit.seeds.end());
  }
  return wave;
}

}  // namespace

void validate(const TreeSurfaceOptions& options) {
  if (!(options.cell_mm >= 0.02 && options.cell_mm <= 2.0))
    throw InvalidInput("the cells of the wall's grid are " + std::to_string(options.cell_mm) +
                       " mm wide; give 0.02 to 2 mm");
  if (!(options.memory_limit_mib >= 1.0 && options.memory_limit_mib <= 1e6))
    throw InvalidInput("the memory limit of the wall is " + std::to_string(options.memory_limit_mib) +
                       " MiB; give 1 to 1e6");
  if (!(options.keep_within_mm >= 0.0 && options.keep_within_mm <= 0.01))
    throw InvalidInput("the wall is kept within " + std::to_string(options.keep_within_mm) +
                       " mm of what it is; give 0 to 0.01 mm");
}

struct TreeSurface::Impl {
  TreeSurfaceOptions options;
  WallBlocks blocks;

  // Follows the wall wave by wave: the blocks of a wave look at their own cells side by side, and hand each
  // other the cells by which the wall goes on.
  TreeSurfaceReport follow(WallJob& job, const std::vector<Vec3>& seeds, const core::TaskContext& task) {
    Wave wave = wave_of_seeds(seeds, options.cell_mm);
    job.count_cells(begin());
    std::size_t visited = 0;
    while (!wave.empty()) {
      std::vector<std::pair<WallBlock*, const Visit*>> work;
      for (const auto& [index, visit] : wave) {
        WallBlock& block = blocks[index];
        block.index = index;
        work.emplace_back(&block, &visit);
      }
      std::vector<std::vector<GridIndex>> out(work.size());
      core::parallel_for(work.size(), 1, [&](std::size_t i) {
        task.throw_if_cancelled();
        const auto& [block, visit] = work[i];
        out[i] = follow_wall(job, *block, blocks, visit->seeds, visit->entries);
      });
      visited += work.size();
      wave = next_wave(out);
      task.set_progress(static_cast<double>(visited) / static_cast<double>(visited + wave.size()));
    }
    return end(job);
  }

  std::size_t largest_cells() const {
    return static_cast<std::size_t>(options.memory_limit_mib * 1048576.0 / bytes_per_cell);
  }

  // Returns the cells that are there already.
  std::size_t begin() {
    std::size_t cells = 0;
    for (auto& [index, block] : blocks) {
      block.made = false;
      for (WallPiece& piece : block.pieces) {
        piece.reached = false;
        cells += piece.cells.size();
      }
    }
    return cells;
  }

  // Cells that are known to be reached are left out.
  Wave next_wave(const std::vector<std::vector<GridIndex>>& out) const {
    Wave wave;
    const WallBlock* last = nullptr;  // most cells lie in the same block as the one before
    for (const auto& cells : out) {
      for (const GridIndex& cell : cells) {
        const GridIndex index = block_of(cell);
        if (last == nullptr || last->index != index) {
          const auto found = blocks.find(index);
          last = found == blocks.end() ? nullptr : &found->second;
        }
        if (last == nullptr || !reached(*last, cell)) wave[index].entries.push_back(cell);
      }
    }
    return wave;
  }
  static bool reached(const WallBlock& block, const GridIndex& cell) {
    const WallPiece* piece = block.piece_at(code_in_block(cell, block.index));
    return piece != nullptr && piece->reached;
  }

  TreeSurfaceReport end(const WallJob& job) {
    TreeSurfaceReport report;
    report.evaluations = job.evaluations();
    std::size_t points = 0;
    for (auto& [index, block] : blocks) {
      settle(block);
      report.blocks += block.pieces.empty() ? 0 : 1;
      report.blocks_made += block.made && !block.pieces.empty() ? 1 : 0;
      for (WallPiece& piece : block.pieces) {
        piece.first_point = points;
        piece.first_triangle = report.triangles;
        points += piece.own;
        report.triangles += piece.mesh->triangles.size();
      }
    }
    if (report.triangles == 0)
      throw InvalidInput("no seed lies within a cell (" + std::to_string(options.cell_mm) +
                         " mm) of the wall; give places on it");
    std::erase_if(blocks, [](const auto& item) { return item.second.kept.nodes.empty(); });
    return report;
  }
};

TreeSurface::TreeSurface(const TreeSurfaceOptions& options) : impl_(std::make_unique<Impl>()) {
  validate(options);
  impl_->options = options;
}
TreeSurface::~TreeSurface() = default;
TreeSurface::TreeSurface(TreeSurface&&) noexcept = default;
TreeSurface& TreeSurface::operator=(TreeSurface&&) noexcept = default;

TreeSurfaceReport TreeSurface::build(std::shared_ptr<const ScalarField> field, const std::vector<Vec3>& seeds,
                                     const core::TaskContext& task) {
  impl_->blocks.clear();
  return update(std::move(field), Box3(), seeds, task);
}

TreeSurfaceReport TreeSurface::update(std::shared_ptr<const ScalarField> field, const Box3& changed,
                                      const std::vector<Vec3>& seeds, const core::TaskContext& task) {
  if (!field) throw InvalidInput("the wall has no field to follow");
  try {
    task.throw_if_cancelled();
    WallJob job(*field, impl_->options.cell_mm, impl_->largest_cells());
    if (!changed.isEmpty())
      forget_changed(job, impl_->blocks, changed, impl_->options.keep_within_mm * field->wall_slope());
    return impl_->follow(job, seeds, task);
  } catch (...) {
    impl_->blocks.clear();
    throw;
  }
}

geometry::TriMesh TreeSurface::mesh() const {
  return joined(impl_->blocks);
}

std::vector<TreeSurfacePart> TreeSurface::parts() const {
  std::vector<TreeSurfacePart> all;
  for (const auto& [index, block] : impl_->blocks)
    for (const WallPiece& piece : block.pieces) all.push_back({index, piece.mesh});
  return all;
}

double default_cell_mm(const LumenModel& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& vessel : model.vessels)
    for (const SurfaceSample& sample : vessel->samples)
      if (sample.origin != SampleOrigin::cap)
        smallest = std::min(smallest, (sample.position - vessel->axis->point(sample.s_mm)).norm());
  return std::clamp(0.25 * smallest, finest_default_mm, 0.25);
}

geometry::TriMesh surface_of(const LumenModel& model, double cell_mm, const core::TaskContext& task) {
  if (model.vessels.empty()) throw InvalidInput("the model has no vessels whose wall could be made");
  TreeSurface surface({.cell_mm = cell_mm == 0.0 ? default_cell_mm(model) : cell_mm});
  std::vector<std::shared_ptr<const ImplicitSurface>> branches;
  std::vector<Vec3> seeds;
  for (const auto& vessel : model.vessels) {
    task.throw_if_cancelled();
    branches.push_back(std::make_shared<const ImplicitSurface>(solve(*vessel)));
    for (const SurfaceSample& sample : vessel->samples) seeds.push_back(sample.position);
    task.set_progress(0.5 * static_cast<double>(branches.size()) / static_cast<double>(model.vessels.size()));
  }
  surface.build(std::make_shared<const TreeField>(branches, model.blend), seeds, task.sub(0.5, 1.0));
  return surface.mesh();
}

}  // namespace ostia::lumen
