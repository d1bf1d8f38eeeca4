#include "ostia/lumen/tree_surface.h"

#include "wall_block.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace ostia::lumen {
namespace {

constexpr double bytes_per_cell = 256.0;  // values, pieces and the joined mesh
// Cells from the origin, so that places in the grid are whole numbers of 32 bits with room to spare.
constexpr double farthest_cell = 1e9;

/// What a block has to look at in one wave.
struct Visit {
  std::vector<GridIndex> seeds, entries;
};
using Wave = std::map<GridIndex, Visit>;

Wave wave_of_seeds(const std::vector<Vec3>& seeds, double cell_mm) {
  if (seeds.empty()) throw InvalidInput("the wall has no seeds to start from; give places on it");
  std::vector<GridIndex> cells;
  cells.reserve(seeds.size());
  for (const Vec3& seed : seeds) {
    const Vec3 cell = (seed / cell_mm).array().floor();
    if (!(cell.lpNorm<Eigen::Infinity>() < farthest_cell))
      throw InvalidInput("a seed of the wall lies at " + std::to_string(seed.x()) + ", " +
                         std::to_string(seed.y()) + ", " + std::to_string(seed.z()) +
                         " mm; it must be finite and less than 1e9 cells from the origin");
    cells.push_back({static_cast<std::int32_t>(cell.x()), static_cast<std::int32_t>(cell.y()),
                     static_cast<std::int32_t>(cell.z())});
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  Wave wave;
  for (const GridIndex& cell : cells) wave[block_of(cell)].seeds.push_back(cell);
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
}

struct TreeSurface::Impl {
  TreeSurfaceOptions options;
  WallBlocks blocks;

  // Follows the wall wave by wave: the blocks of a wave look at their own cells side by side, and hand each
  // other the cells by which the wall goes on.
  TreeSurfaceReport follow(const ScalarField& field, const std::vector<Vec3>& seeds,
                           const core::TaskContext& task) {
    Wave wave = wave_of_seeds(seeds, options.cell_mm);
    WallJob job(field, options.cell_mm, largest_cells(), begin());
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
    for (auto& [index, block] : blocks) {
      settle(block);
      report.blocks += block.pieces.empty() ? 0 : 1;
      report.blocks_made += block.made && !block.pieces.empty() ? 1 : 0;
      for (const WallPiece& piece : block.pieces) report.triangles += piece.mesh->triangles.size();
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
    if (!changed.isEmpty())
      for (auto& [index, block] : impl_->blocks)
        if (depends_on(block, changed, impl_->options.cell_mm))
          forget(block, changed, impl_->options.cell_mm);
    return impl_->follow(*field, seeds, task);
  } catch (...) {
    impl_->blocks.clear();
    throw;
  }
}

geometry::TriMesh TreeSurface::mesh() const {
  std::size_t points = 0, triangles = 0;
  std::map<const WallPiece*, std::size_t> first_point;
  for (const auto& [index, block] : impl_->blocks) {
    for (const WallPiece& piece : block.pieces) {
      first_point[&piece] = points;
      points += piece.own;
      triangles += piece.mesh->triangles.size();
    }
  }
  if (points > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw ResourceError("the lumen's wall has more than 2^31 points; take larger cells");

  // The number of the point on an edge that begins in a cell of another block.
  const auto number_in = [&](const WallBlock& owner, EdgeCode edge) -> std::int32_t {
    for (const WallPiece& piece : owner.pieces) {
      const auto last = piece.edges.begin() + static_cast<std::ptrdiff_t>(piece.own);
      const auto found = std::lower_bound(piece.edges.begin(), last, edge);
      if (found != last && *found == edge)
        return static_cast<std::int32_t>(first_point.at(&piece) +
                                         static_cast<std::size_t>(found - piece.edges.begin()));
    }
    throw Error("the wall's blocks do not fit one another");
  };

  geometry::TriMesh mesh;
  mesh.points.reserve(points);
  mesh.triangles.reserve(triangles);
  std::vector<std::int32_t> number;
  for (const auto& [index, block] : impl_->blocks) {
    std::array<const WallBlock*, 8> owners{};  // of the edges on the block's upper faces, by the faces
    for (const WallPiece& piece : block.pieces) {
      number.clear();
      const auto first = static_cast<std::int32_t>(mesh.points.size());
      for (std::size_t i = 0; i < piece.own; ++i) number.push_back(first + static_cast<std::int32_t>(i));
      for (std::size_t i = piece.own; i < piece.edges.size(); ++i) {
        std::array<int, 3> node = place_of_node(static_cast<NodeCode>(piece.edges[i] / 3));
        GridIndex beyond = index;
        std::size_t side = 0;
        for (std::size_t a = 0; a < 3; ++a) {
          if (node[a] < block_cells) continue;
          node[a] -= block_cells;
          ++beyond[a];
          side |= std::size_t{1} << a;
        }
        if (owners[side] == nullptr) owners[side] = &impl_->blocks.at(beyond);
        number.push_back(
            number_in(*owners[side], static_cast<EdgeCode>(3 * node_code(node) + piece.edges[i] % 3)));
      }
      mesh.points.insert(mesh.points.end(), piece.mesh->points.begin(),
                         piece.mesh->points.begin() + static_cast<std::ptrdiff_t>(piece.own));
      for (const geometry::Triangle& t : piece.mesh->triangles)
        mesh.triangles.push_back({number[static_cast<std::size_t>(t[0])],
                                  number[static_cast<std::size_t>(t[1])],
                                  number[static_cast<std::size_t>(t[2])]});
    }
  }
  return mesh;
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
  return std::clamp(0.25 * smallest, 0.02, 0.25);
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
