#include "ostia/session/outer_wall_board.h"

#include <utility>

namespace ostia::session {
namespace {

constexpr int ring_points = 64;

RuledSurface ruled(const VesselWalls& walls) {
  RuledSurface out;
  out.vessel = walls.vessel;
  out.ring = ring_points;
  const segmentation::LumenBoundary& rows = walls.outer.surface;
  for (int r = 0; r < rows.rows(); ++r) {
    out.s_mm.push_back(rows.from_mm + r * rows.step_mm);
    for (const Vec3& p : outer_wall_ring(walls, out.s_mm.back(), ring_points)) {
      out.surface.points.push_back(p);
      out.box.extend(p);
    }
    if (r == 0) continue;
    for (int i = 0; i < ring_points; ++i) {
      const std::int32_t a = (r - 1) * ring_points + i, b = (r - 1) * ring_points + (i + 1) % ring_points;
      out.surface.triangles.push_back({a, b, a + ring_points});
      out.surface.triangles.push_back({b, b + ring_points, a + ring_points});
    }
  }
  return out;
}

}  // namespace

std::optional<VesselWalls> OuterWallWork::found(const core::TaskContext& task) const {
  const std::shared_ptr<const VesselWalls> shared = known->of(*this, task.sub(0.0, 0.9));
  if (!shared) return std::nullopt;
  VesselWalls out = *shared;
  add_plaque_maps(out, *model, *image, {}, task.sub(0.9, 1.0));
  return out;
}

OuterWallBoard::OuterWallBoard(Workbench& bench, std::shared_ptr<FoundWalls> walls)
    : bench_(bench), found_(std::move(walls)) {
  own_.push_back(bench.model_changed.observe([this](const ModelEvent&) { drop(); }));
  own_.push_back(bench.case_changed.observe([this] { drop(); }));
  own_.push_back(bench.image_changed.observe([this] { drop(); }));
}

void OuterWallBoard::drop() {
  if (known_.empty()) return;
  known_.clear();
  ++revision_;
  changed.tell();
}

const VesselWalls* OuterWallBoard::of_selected() const {
  const auto found = known_.find(bench_.vessel.get());
  return found != known_.end() && found->second.walls ? &*found->second.walls : nullptr;
}

std::optional<OuterWallWork> OuterWallBoard::work() const {
  const lumen::LumenModel* model = bench_.model();
  const std::int32_t vessel = bench_.vessel.get();
  if (!model || !bench_.image().volume || vessel == Workbench::no_vessel || known_.contains(vessel))
    return std::nullopt;
  return OuterWallWork{
      {bench_.session().file().model(), bench_.session().solved_walls(), bench_.image().volume, vessel},
      found_};
}

bool OuterWallBoard::take(const OuterWallWork& work, std::optional<VesselWalls> found) {
  if (!bench_.has_case() || bench_.session().file().model() != work.model ||
      bench_.image().volume != work.image)
    return false;
  Known& known = known_[work.vessel];
  known.surface = found ? ruled(*found) : RuledSurface{};
  known.walls = std::move(found);
  ++revision_;
  changed.tell();
  return true;
}

}  // namespace ostia::session
