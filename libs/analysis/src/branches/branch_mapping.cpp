#include "ostia/analysis/branch_mapping.h"

#include "branches/branch_metrics.h"
#include "branches/harmonic_map.h"
#include "branches/wall_parts.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

namespace ostia::analysis {
namespace {

MappedBranch mapped(WallPart part, const BranchMetrics& metrics) {
  constexpr std::size_t grain = 256;
  MappedBranch out;
  out.group = part.group;
  out.mesh = std::move(part.mesh);
  out.sources = std::move(part.sources);
  const std::size_t n = out.mesh.points.size();
  for (std::vector<double>* values : {&out.abscissa_mm, &out.angle_rad, &out.distance_mm}) values->resize(n);
  core::parallel_for(n, grain, [&](std::size_t i) {
    const BranchPlace place = metrics.at(out.mesh.points[i]);
    out.abscissa_mm[i] = place.abscissa_mm;
    out.angle_rad[i] = place.angle_rad;
    out.distance_mm[i] = place.distance_mm;
  });
  HarmonicMap map = harmonic_map(out.mesh, out.abscissa_mm);
  out.harmonic = std::move(map.harmonic);
  out.stretched_mm = out.harmonic.empty() ? out.abscissa_mm : std::move(map.stretched_mm);
  return out;
}

}  // namespace

MappedWall map_branches(const geometry::TriMesh& wall, const geometry::BranchedLines& lines,
                        const core::TaskContext& task) {
  if (lines.lines.empty()) throw InvalidInput("there are no lines by which a wall could be mapped");
  if (wall.triangles.empty()) throw InvalidInput("the wall has no triangles that could be mapped");
  const BranchTracts tracts(lines);
  std::vector<WallPart> parts = wall_parts(wall, BranchTubes(tracts));
  MappedWall out;
  std::string no_tubes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(i) / static_cast<double>(parts.size()));
    const BranchMetrics metrics(lines, tracts, parts[i].group);
    out.branches.push_back(mapped(std::move(parts[i]), metrics));
    if (out.branches.back().harmonic.empty())
      no_tubes += (no_tubes.empty() ? "" : ", ") + std::to_string(out.branches.back().group);
  }
  if (!no_tubes.empty())
    out.warnings.push_back(
        "the walls of these branches are no tubes with two open ends, and are mapped by "
        "abscissa instead: " +
        no_tubes);
  return out;
}

std::vector<double> mapped_values(const MappedBranch& branch, const std::vector<double>& values,
                                  std::size_t components) {
  std::vector<double> out;
  out.reserve(branch.sources.size() * components);
  for (const WallPoint& source : branch.sources) {
    for (std::size_t c = 0; c < components; ++c) {
      double value = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        if (source.weights[k] == 0.0) continue;
        value += source.weights[k] * values.at(static_cast<std::size_t>(source.points[k]) * components + c);
      }
      out.push_back(value);
    }
  }
  return out;
}

}  // namespace ostia::analysis
