#include "ostia/session/beating_profile.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::session {
namespace {

constexpr double step_mm = 1.0;
constexpr double half_chord_mm = 0.25;  // of the axis, for its direction
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Of the surface within an outline, its length being the area.
Vec3 vector_area(const std::vector<Vec3>& outline, std::size_t first, std::size_t count) {
  Vec3 sum = Vec3::Zero();
  const Vec3& centre = outline[first];
  for (std::size_t i = 1; i + 1 < count; ++i)
    sum += 0.5 * (outline[first + i] - centre).cross(outline[first + i + 1] - centre);
  return sum;
}

}  // namespace

ProfileWork ring_work(const Session& session, std::int32_t vessel) {
  ProfileWork work;
  work.model = session.file().model();
  work.vessel = lumen::vessel(*work.model, vessel).vessel;
  work.walls = session.solved_walls();
  return work;
}

LumenRings lumen_rings(const ProfileWork& work, const core::TaskContext& task) {
  LumenRings made;
  made.vessel = work.vessel;
  const geometry::AxisCurve& axis = *lumen::vessel(*work.model, work.vessel).axis;
  const auto wall_of = [&](std::int32_t one) { return work.walls.at(one); };
  const auto steps = static_cast<std::size_t>(std::max(2.0, std::ceil(axis.length() / step_mm)));
  for (std::size_t i = 0; i <= steps; ++i) {
    task.throw_if_cancelled();
    task.set_progress(static_cast<double>(i) / static_cast<double>(steps));
    const double s = axis.length() * static_cast<double>(i) / static_cast<double>(steps);
    const analysis::MeasuredSection section =
        analysis::measured_section(*work.model, wall_of, work.vessel, s);
    made.s_mm.push_back(s);
    made.rings.push_back(section.measures.found ? section.contour : std::vector<Vec3>{});
    made.before.push_back(axis.point(std::max(0.0, s - half_chord_mm)));
    made.after.push_back(axis.point(std::min(axis.length(), s + half_chord_mm)));
  }
  return made;
}

double BeatingProfile::diameter_mm(std::size_t phase, std::size_t section) const {
  return std::sqrt(4.0 * area_mm2[phase][section] / std::numbers::pi);
}

BeatingProfile beating_profile(const LumenRings& rings, const Beating& beating, std::size_t phases) {
  if (phases < 3) throw InvalidInput("a profile over the cycle needs at least three phases");
  std::vector<Vec3> all;
  for (const std::vector<Vec3>& ring : rings.rings) all.insert(all.end(), ring.begin(), ring.end());
  const std::size_t outlines = all.size(), sections = rings.s_mm.size();
  all.insert(all.end(), rings.before.begin(), rings.before.end());
  all.insert(all.end(), rings.after.begin(), rings.after.end());
  const motion::CarriedPoints carried(beating.motion().grid, all);
  BeatingProfile made;
  made.vessel = rings.vessel;
  made.s_mm = rings.s_mm;
  for (std::size_t k = 0; k < phases; ++k) {
    made.phases.push_back(static_cast<double>(k) / static_cast<double>(phases));
    const std::vector<Vec3> places = carried.places(beating.cage().at(made.phases.back()));
    std::vector<double> area(sections, no_value);
    std::size_t first = 0;
    for (std::size_t i = 0; i < sections; ++i) {
      const std::size_t count = rings.rings[i].size();
      const Vec3 along = places[outlines + sections + i] - places[outlines + i];
      if (count > 2) area[i] = std::abs(vector_area(places, first, count).dot(along.normalized()));
      first += count;
    }
    made.area_mm2.push_back(std::move(area));
  }
  return made;
}

}  // namespace ostia::session
