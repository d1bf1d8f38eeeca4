#include "untangle.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ostia::reconstruction {
namespace {

constexpr double narrowing = 0.9;  // of the radius, each round
constexpr double least_factor = 0.05;
constexpr double parting = 0.15;  // of the radius, each round

/// The part of a branch in which it meets others, and whence they press.
struct Meeting {
  double first = 1e300, last = -1e300;  // abscissas, mm
  Vec3 push = Vec3::Zero();
};

Vec3 centroid(const QuadMesh& mesh, std::int32_t triangle) {
  const geometry::Quad& q = mesh.quads[static_cast<std::size_t>(triangle / 2)];
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : q) sum += mesh.points[static_cast<std::size_t>(v)];
  return 0.25 * sum;
}

void narrow(Tube& tube, const Meeting& meeting) {
  const auto place = [&](double s) { return at(tube, s).radius; };
  const double before = meeting.first - 2.0 * place(meeting.first),
               after = meeting.last + 2.0 * place(meeting.last);
  const double push = meeting.push.norm();
  bool moved = false;
  std::vector<double> window(tube.points.size());
  for (std::size_t i = 0; i < tube.points.size(); ++i) {
    const double x = tube.abscissa[i];
    const double fade = std::max(0.25 * (after - before), tube.radius[i]);
    window[i] = std::clamp(1.0 - std::max(before - x, x - after) / fade, 0.0, 1.0);
  }
  for (std::size_t i = 0; i < tube.points.size(); ++i) {
    const double step = parting * tube.radius[i] * tube.factor[i];
    tube.factor[i] = std::max(least_factor, tube.factor[i] * (1.0 - (1.0 - narrowing) * window[i]));
    if (push <= 0.0 || i == 0 || i + 1 == tube.points.size()) continue;
    // Ends stay where they are, and so does the axis near them.
    const double x = tube.abscissa[i];
    const double room = std::min(1.0, std::min(x, tube.length() - x) / (2.0 * tube.radius[i]));
    const Vec3 t = tube.frames[i].tangent;
    const Vec3 side = meeting.push / push - t.dot(meeting.push / push) * t;
    tube.points[i] += step * window[i] * room * side;
    moved = true;
  }
  if (moved) measure(tube);
}

}  // namespace

void give_way(std::vector<Tube>& tubes, const QuadMesh& mesh,
              const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  std::map<std::int32_t, Meeting> meetings;
  const auto meet = [&](std::int32_t one, std::int32_t other) {
    const std::int32_t branch = mesh.branch_of_quad[static_cast<std::size_t>(one / 2)];
    const std::int32_t against = mesh.branch_of_quad[static_cast<std::size_t>(other / 2)];
    const Vec3 here = centroid(mesh, one);
    const auto& mine = tubes[static_cast<std::size_t>(branch)];
    const auto on = geometry::closest(mine.points, here);
    Meeting& meeting = meetings[branch];
    meeting.first = std::min(meeting.first, on.abscissa);
    meeting.last = std::max(meeting.last, on.abscissa);
    if (branch == against) return;
    const auto theirs = geometry::closest(tubes[static_cast<std::size_t>(against)].points, on.point);
    Vec3 away = on.point - theirs.point;
    if (away.norm() < 1e-9) away = (branch < against ? 1.0 : -1.0) * mine.frames[on.segment].normal;
    meeting.push += away.normalized();
  };
  for (const auto& [a, b] : pairs) {
    meet(a, b);
    meet(b, a);
  }
  for (const auto& [branch, meeting] : meetings) narrow(tubes[static_cast<std::size_t>(branch)], meeting);
}

}  // namespace ostia::reconstruction
