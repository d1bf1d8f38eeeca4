#include "reading/reading_sight.h"

#include "lumen/wall_on_ray.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/polyline.h"
#include "ostia/session/new_vessel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace ostia::experiments {
namespace {

constexpr double astray_step_mm = 0.5;
constexpr double least_tail_mm = 2.0;      // that is worth cutting off
constexpr double broken_start_mm = 5.0;    // a vessel whose beginning is missing by so much is made anew
constexpr double least_there_share = 0.2;  // of a vessel that is there at all
constexpr double in_lumen_mm = 0.75;       // an axis so near to the middle is in the vessel, however narrow

SeenVessel seen_vessel(const OwnAxis& own, const std::vector<OwnAxis>& truth, double astray_mm) {
  SeenVessel seen;
  const std::vector<Vec3> points = geometry::resample(own.points, astray_step_mm);
  seen.length_mm = geometry::length(own.points);
  const double step = seen.length_mm / static_cast<double>(points.size() - 1);
  std::map<std::size_t, std::vector<double>> along;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const NearestAxis near = nearest_axis(truth, points[i]);
    if (near.away_mm > near.radius_mm + astray_mm) {
      seen.astray_mm += i == 0 ? 0.0 : step;
      continue;
    }
    seen.right_to_mm = step * static_cast<double>(i);
    along[near.axis].push_back(near.s_mm);
  }
  const auto most = std::max_element(along.begin(), along.end(), [](const auto& a, const auto& b) {
    return a.second.size() < b.second.size();
  });
  if (most == along.end()) return seen;
  seen.follows = most->first;
  const auto [low, high] = std::minmax_element(most->second.begin(), most->second.end());
  seen.low_mm = *low;
  seen.high_mm = *high;
  return seen;
}

/// Whether an axis that is nearest to a place has ended before it, or begins behind it.
bool past_end(const OwnAxis& own, const Vec3& place, double by_mm) {
  const std::vector<Vec3>& points = own.points;
  const auto past = [&](const Vec3& end, const Vec3& next) {
    return (place - end).dot((end - next).normalized()) > by_mm;
  };
  const geometry::PolylineLocation at = geometry::closest(points, place);
  const bool first = at.segment == 0 && at.t <= 0.0;
  const bool last = at.segment + 2 == points.size() && at.t >= 1.0;
  return (last && past(points.back(), points[points.size() - 2])) ||
         (first && own.from_mm <= 0.0 && past(points[0], points[1]));
}

std::vector<SeenRow> seen_rows(const CountedVessel& vessel, const std::vector<OwnAxis>& own,
                               double tolerance_mm) {
  std::vector<SeenRow> rows(vessel.rows.size());
  if (own.empty()) return rows;
  core::parallel_for(rows.size(), 16, [&](std::size_t i) {
    const CountedRow& row = vessel.rows[i];
    const NearestAxis near = nearest_axis(own, row.middle);
    rows[i].off_mm = near.away_mm;
    if (near.away_mm <= std::max(row.mean_mm, in_lumen_mm) &&
        !past_end(own[near.axis], row.middle, tolerance_mm))
      rows[i].axis = near.axis;
  });
  return rows;
}

/// Which own axis is which counted vessel: those with most rows first, each once.
std::vector<std::optional<std::size_t>> matched(const ReadingSight& sight) {
  struct Claim {
    std::size_t rows, vessel, axis;
  };
  std::vector<Claim> claims;
  for (std::size_t v = 0; v < sight.rows.size(); ++v) {
    std::map<std::size_t, std::size_t> covers;
    for (const SeenRow& row : sight.rows[v])
      if (row.axis) ++covers[*row.axis];
    for (const auto& [axis, rows] : covers)
      if (2 * rows >= sight.rows[v].size()) claims.push_back({rows, v, axis});
  }
  std::stable_sort(claims.begin(), claims.end(),
                   [](const Claim& a, const Claim& b) { return a.rows > b.rows; });
  std::vector<std::optional<std::size_t>> as(sight.rows.size());
  for (const Claim& claim : claims)
    if (!as[claim.vessel] && std::find(as.begin(), as.end(), claim.axis) == as.end())
      as[claim.vessel] = claim.axis;
  return as;
}

/// Whether anything that leaves a vessel is worth keeping.
bool bears_right_ones(const ReadingSight& sight, const lumen::LumenModel& model, std::size_t vessel) {
  for (std::size_t i = 0; i < sight.own.size(); ++i)
    if (i != vessel && !sight.vessels[i].wrong() &&
        lumen::leads_through(model.tree, sight.own[i].vessel, sight.own[vessel].vessel))
      return true;
  return false;
}

/// Whether another vessel runs in the same artery along most of this one, and is the longer one.
bool is_double(const ReadingSight& sight, std::size_t vessel) {
  const SeenVessel& one = sight.vessels[vessel];
  for (std::size_t i = 0; i < sight.vessels.size(); ++i) {
    const SeenVessel& other = sight.vessels[i];
    if (i == vessel || !one.follows || other.follows != one.follows) continue;
    if (one.length_mm > other.length_mm || (one.length_mm == other.length_mm && vessel < i)) continue;
    const double both = std::min(one.high_mm, other.high_mm) - std::max(one.low_mm, other.low_mm);
    if (both > 0.5 * (one.high_mm - one.low_mm)) return true;
  }
  return false;
}

void add_wrong_vessels(const ReadingSight& sight, const lumen::LumenModel& model,
                       std::vector<ReadingIssue>& issues) {
  for (std::size_t i = 0; i < sight.own.size(); ++i) {
    const SeenVessel& seen = sight.vessels[i];
    const OwnAxis& own = sight.own[i];
    if ((seen.wrong() || is_double(sight, i)) && !bears_right_ones(sight, model, i)) {
      issues.push_back({ReadingIssueKind::removal, own.vessel, {}, 0.0, own.name});
    } else if (seen.length_mm - seen.right_to_mm > least_tail_mm && seen.right_to_mm > 0.0) {
      issues.push_back({ReadingIssueKind::trim, own.vessel, {}, own.from_mm + seen.right_to_mm, own.name});
    }
  }
}

void add_missing(const ReadingOverlay& overlay, const ReadingSight& sight,
                 std::vector<ReadingIssue>& issues) {
  for (std::size_t v = 0; v < sight.rows.size(); ++v) {
    const std::vector<SeenRow>& rows = sight.rows[v];
    const std::string& name = overlay.vessels()[v].vessel->name;
    std::size_t there = 0, first = rows.size(), last = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!rows[i].axis) continue;
      ++there;
      first = std::min(first, i);
      last = i;
    }
    const auto of_all = static_cast<double>(rows.size());
    if (static_cast<double>(there) < least_there_share * of_all) {
      issues.push_back({ReadingIssueKind::missing, 0, v, 0.0, name});
    } else if (static_cast<double>(first) * reading_row_mm > broken_start_mm && sight.as[v]) {
      issues.push_back({ReadingIssueKind::removal, sight.own[*sight.as[v]].vessel, {}, 0.0, name});
    } else if (last + 2 < rows.size()) {
      issues.push_back({ReadingIssueKind::short_end, sight.own[*rows[last].axis].vessel, v,
                        overlay.vessels()[v].rows[last].s_mm, name});
    }
  }
}

/// Who has another's name makes room first.
void add_wrong_names(const ReadingOverlay& overlay, const ReadingSight& sight, const lumen::LumenModel& model,
                     std::vector<ReadingIssue>& issues) {
  const auto holder = [&](const std::string& name) {
    return std::find_if(sight.own.begin(), sight.own.end(),
                        [&](const OwnAxis& own) { return own.name == name; });
  };
  const auto wanted = [&](std::size_t axis) -> std::string {
    for (std::size_t v = 0; v < sight.as.size(); ++v)
      if (sight.as[v] == axis) return overlay.vessels()[v].vessel->name;
    return {};
  };
  for (std::size_t v = 0; v < sight.as.size(); ++v) {
    const std::string& name = overlay.vessels()[v].vessel->name;
    if (!sight.as[v] || sight.own[*sight.as[v]].name == name) continue;
    const auto other = holder(name);
    if (other == sight.own.end()) {
      issues.push_back({ReadingIssueKind::name, sight.own[*sight.as[v]].vessel, v, 0.0, name});
      continue;
    }
    std::string elsewhere = wanted(static_cast<std::size_t>(other - sight.own.begin()));
    if (elsewhere.empty() || holder(elsewhere) != sight.own.end()) elsewhere = session::unused_name(&model);
    issues.push_back({ReadingIssueKind::name, other->vessel, v, 0.0, elsewhere});
  }
}

/// On rays from the model's axis to the true wall.
double wall_off(const CountedRow& row, const Vec3& axis, const lumen::ScalarField& own,
                const lumen::ScalarField& tree) {
  double worst = 0.0;
  for (const CountedRow::Ray& ray : row.rays) {
    if (!ray.seen) continue;
    const Vec3 way = row.foot + ray.radius_mm * ray.direction - axis;
    const double true_mm = way.norm();
    const auto off = [&](const lumen::ScalarField& wall) {
      const double rho = wall_on_ray(wall, axis, way / true_mm);
      if (!std::isnan(rho)) return std::abs(rho - true_mm);
      return wall.value(axis) >= 0.0 ? true_mm : farthest_wall_mm;  // closed, or without an end
    };
    const double by_itself = off(own);
    // Where its beginning lies in another's lumen, both walls together are the tree's.
    worst = std::max(worst, by_itself <= worst ? by_itself : std::min(by_itself, off(tree)));
  }
  return worst;
}

}  // namespace

ReadingSight look_at(const ReadingOverlay& overlay, const lumen::LumenModel* model,
                     const ReadingOptions& options) {
  ReadingSight sight;
  if (model) sight.own = own_axes(model->tree);
  for (const OwnAxis& own : sight.own)
    sight.vessels.push_back(seen_vessel(own, overlay.axes(), options.astray_mm));
  for (const CountedVessel& vessel : overlay.vessels())
    sight.rows.push_back(seen_rows(vessel, sight.own, options.tolerance_mm));
  sight.as = matched(sight);
  return sight;
}

ReadingState state_of(const ReadingOverlay& overlay, const lumen::LiveModel* live,
                      const ReadingOptions& options) {
  ReadingState state;
  const ReadingSight sight = look_at(overlay, live ? &live->model() : nullptr, options);
  for (const SeenVessel& seen : sight.vessels) state.astray_mm += seen.astray_mm;
  const auto tree = live ? live->field() : nullptr;
  std::vector<std::shared_ptr<const lumen::ScalarField>> walls;
  for (const OwnAxis& own : sight.own) walls.push_back(live->surface(own.vessel));
  for (std::size_t v = 0; v < sight.rows.size(); ++v) {
    const std::vector<SeenRow>& rows = sight.rows[v];
    std::vector<double> off(rows.size(), 0.0);
    core::parallel_for(rows.size(), 4, [&](std::size_t i) {
      if (!rows[i].axis) return;
      const CountedRow& row = overlay.vessels()[v].rows[i];
      const Vec3 axis = geometry::closest(sight.own[*rows[i].axis].points, row.middle).point;
      off[i] = wall_off(row, axis, *walls[*rows[i].axis], *tree);
    });
    for (std::size_t i = 0; i < rows.size(); ++i) {
      state.length_mm += reading_row_mm;
      const bool missing = !rows[i].axis;
      const bool wall = !missing && off[i] > options.tolerance_mm;
      const bool axis = !missing && rows[i].off_mm > options.tolerance_mm;
      state.missing_mm += missing ? reading_row_mm : 0.0;
      state.wall_off_mm += wall ? reading_row_mm : 0.0;
      state.axis_off_mm += axis ? reading_row_mm : 0.0;
      state.beyond_mm += missing || wall || axis ? reading_row_mm : 0.0;
      if (missing) continue;
      state.worst_wall_mm = std::max(state.worst_wall_mm, off[i]);
      state.worst_axis_mm = std::max(state.worst_axis_mm, rows[i].off_mm);
    }
    if (sight.as[v] && sight.own[*sight.as[v]].name != overlay.vessels()[v].vessel->name) ++state.wrong_names;
  }
  return state;
}

Vec3 wall_shift(const CountedRow& row, const lumen::ScalarField& wall) {
  Vec3 sum = Vec3::Zero();
  int rays = 0;
  for (const CountedRow::Ray& ray : row.rays) {
    const double rho = wall_on_ray(wall, row.foot, ray.direction);
    if (!ray.seen || std::isnan(rho)) continue;
    sum += (rho - ray.radius_mm) * ray.direction;
    ++rays;
  }
  // A shift by d moves the wall by d . n on each ray: the mean of (d . n) n is d / 2.
  return rays > 0 ? Vec3(2.0 / rays * sum) : sum;
}

std::string ReadingIssue::key() const {
  return std::to_string(static_cast<int>(kind)) + ":" + name + ":" +
         (kind == ReadingIssueKind::missing || kind == ReadingIssueKind::short_end
              ? std::string()
              : std::to_string(model_vessel));
}

std::vector<ReadingIssue> issues_of(const ReadingOverlay& overlay, const ReadingSight& sight,
                                    const lumen::LumenModel* model) {
  std::vector<ReadingIssue> issues;
  if (model) add_wrong_vessels(sight, *model, issues);
  add_missing(overlay, sight, issues);
  if (model) add_wrong_names(overlay, sight, *model, issues);
  return issues;
}

}  // namespace ostia::experiments
