#include "mask_ostia.h"

#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::coronary {
namespace {

// From the right ostium to the left one in LPS, measured on ten patients' masks (docs/methods/mask-tree.md).
const Vec3 usual_way_mm(14.0, 28.0, 15.0);
const Vec3 way_sigma_mm(10.0, 10.0, 10.0);
constexpr double most_way_sigma = 3.5;       // of ostia in two parts
constexpr double most_way_sigma_one = 2.6;   // of ostia in one part, which may as well be one tree
constexpr double least_way_between_mm = 90;  // along the lines: from one tree into the other at their ends
constexpr double least_part_mm = 15.0;       // of lines that an ostium belongs to
constexpr double contact_mm = 5.0;
constexpr double look_mm = 5.0;
constexpr double contact_worth = 4.0, flow_worth = 2.0, width_worth = 3.0, cover_worth = 2.0;
constexpr double bend_arm_mm = 6.0, least_arm_mm = 3.0;  // on either side of a bend
constexpr double bend_cosine = -0.1;                     // between the arms: they turn by 85 degrees or more
constexpr double longest_stub_mm = 6.0;

struct EndOfLine {
  std::int32_t node = 0, part = 0;
  Vec3 at = Vec3::Zero(), out = Vec3::Zero();
  double width_mm = 0.0, part_mm = 0.0;
  double worth = 0.0;  // by itself
};

/// Blood that comes from an ostium goes on forwards at a fork; from any other end it would have to turn back.
double forwards(const LineGraph& graph, std::int32_t from) {
  double sum = 0.0, weights = 0.0;
  const auto reach = graph.reach(from);
  for (const auto& [node, here] : reach) {
    if (here.line < 0 || graph.degree(node) < 3) continue;
    const LineGraph::Line& in = graph.lines().at(here.line);
    const Vec3 way = outward(in, in.from == node, look_mm);
    for (const std::int32_t id : graph.lines_at(node)) {
      const LineGraph::Line& next = graph.lines().at(id);
      if (id == here.line || next.from == next.to) continue;
      const double weight = std::min(20.0, length_mm(next));
      sum += weight * std::min(0.5, -way.dot(outward(next, next.from == node, look_mm)));
      weights += weight;
    }
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

std::vector<EndOfLine> ends_of_lines(const LineGraph& graph, const std::vector<Vec3>& contacts,
                                     double& whole_mm) {
  const auto part = graph.parts();
  std::map<std::int32_t, double> part_mm;
  whole_mm = 0.0;
  for (const auto& [id, line] : graph.lines()) {
    part_mm[part.at(line.from)] += length_mm(line);
    whole_mm += length_mm(line);
  }
  double longest = 0.0;
  for (const auto& [id, mm] : part_mm) longest = std::max(longest, mm);
  std::vector<EndOfLine> ends;
  double widest = 0.0;
  for (const auto& [id, node] : graph.nodes()) {
    if (graph.degree(id) != 1 || part_mm[part.at(id)] < std::min(longest, least_part_mm)) continue;
    const LineGraph::Line& line = graph.lines().at(*graph.lines_at(id).begin());
    const bool first = line.from == id;
    EndOfLine end{id, part.at(id), node.at, outward(line, first, look_mm), 0.0, part_mm[part.at(id)], 0.0};
    end.width_mm = mean_radius(line, first, 1.0, 9.0);
    widest = std::max(widest, end.width_mm);
    ends.push_back(end);
  }
  for (EndOfLine& end : ends) {
    end.worth = flow_worth * forwards(graph, end.node) + width_worth * end.width_mm / widest;
    for (const Vec3& contact : contacts)
      if ((contact - end.at).norm() < contact_mm + end.width_mm) {
        end.worth += contact_worth;
        break;
      }
  }
  return ends;
}

double way_sigma(const EndOfLine& left, const EndOfLine& right) {
  return (left.at - right.at - usual_way_mm).cwiseQuotient(way_sigma_mm).norm();
}

double along_lines_mm(const LineGraph& graph, std::int32_t from, std::int32_t to) {
  const auto reach = graph.reach(from);
  const auto found = reach.find(to);
  return found == reach.end() ? 0.0 : found->second.mm;
}

}  // namespace

namespace {

/// How far the mask goes on from a place.
double way_within(const imaging::MaskVolume& lumen, const Vec3& from, const Vec3& direction) {
  constexpr double step_mm = 0.2;
  double way = 0.0;
  for (; way < longest_stub_mm; way += step_mm) {
    const Vec3 at = lumen.geometry.index(from + (way + step_mm) * direction);
    std::array<std::int64_t, 3> v{};
    for (int d = 0; d < 3; ++d) {
      const auto k = static_cast<std::size_t>(d);
      v[k] = std::lround(at[d]);
      if (v[k] < 0 || v[k] >= lumen.geometry.size[k]) return way;
    }
    if (lumen(v[0], v[1], v[2]) == 0) return way;
  }
  return way;
}

struct Bend {
  std::size_t point = 0;
  double cosine = -1.0;
  Vec3 out = Vec3::Zero();
};

/// The sharpest bend of a line, if any.
std::optional<Bend> bend_of(const LineGraph::Line& line) {
  const std::vector<double> s = geometry::abscissas(line.points);
  std::optional<Bend> best;
  for (std::size_t i = 1; i + 1 < s.size(); ++i) {
    if (std::min(s[i], s.back() - s[i]) < least_arm_mm) continue;
    const double before = std::max(0.0, s[i] - bend_arm_mm), after = std::min(s.back(), s[i] + bend_arm_mm);
    const Vec3 a = (geometry::at_abscissa(line.points, before).point - line.points[i]).normalized();
    const Vec3 b = (geometry::at_abscissa(line.points, after).point - line.points[i]).normalized();
    const double cosine = a.dot(b);
    if (cosine < bend_cosine || (best && cosine <= best->cosine)) continue;
    best = Bend{i, cosine, -(a + b).normalized()};
  }
  return best;
}

}  // namespace

std::vector<std::int32_t> add_ends_at_bends(LineGraph& graph, const imaging::MaskVolume& lumen) {
  std::vector<std::int32_t> ids;
  for (const auto& [id, line] : graph.lines()) ids.push_back(id);
  std::vector<std::int32_t> stubs;
  for (const std::int32_t id : ids) {
    const LineGraph::Line line = graph.lines().at(id);
    const auto bend = bend_of(line);
    if (!bend) continue;
    const Vec3 at = line.points[bend->point];
    const double way = way_within(lumen, at, bend->out), radius = line.radius_mm[bend->point];
    if (way < 0.2) continue;
    const std::int32_t middle = graph.split(id, bend->point);
    const std::int32_t end = graph.add_node({at + way * bend->out, radius});
    const std::vector<Vec3> points = straight_points(at, at + way * bend->out);
    stubs.push_back(graph.add_line(middle, end, points, std::vector<double>(points.size(), radius)));
  }
  return stubs;
}

MaskOstia ostia_of_lines(const LineGraph& graph, const std::vector<Vec3>& contacts) {
  double whole_mm = 0.0;
  const std::vector<EndOfLine> ends = ends_of_lines(graph, contacts, whole_mm);
  MaskOstia best;
  double best_worth = -1e9, widest = 0.0;
  for (const EndOfLine& end : ends) widest = std::max(widest, end.width_mm);
  for (const EndOfLine& left : ends)
    for (const EndOfLine& right : ends) {
      if (left.node == right.node) continue;
      const bool one = left.part == right.part;
      const double sigma = way_sigma(left, right);
      if (sigma > (one ? most_way_sigma_one : most_way_sigma)) continue;
      const Vec3 across = (left.at - right.at).normalized();
      const double pointing = right.out.dot(across) - left.out.dot(across);
      const double cover = (one ? left.part_mm : left.part_mm + right.part_mm) / whole_mm;
      const double worth = left.worth + right.worth - 0.5 * sigma * sigma + 0.5 * pointing +
                           cover_worth * cover - (one ? 1.5 : 0.0);
      if (worth <= best_worth) continue;
      if (one && (std::min(left.width_mm, right.width_mm) < 0.6 * widest ||
                  along_lines_mm(graph, left.node, right.node) < least_way_between_mm))
        continue;
      best_worth = worth;
      best = {left.node, right.node, one, sigma};
    }
  if (best.left) return best;
  // One tree alone: its ostium lies above most of it.
  for (const EndOfLine& end : ends) {
    double above = 0.0, count = 0.0;
    for (const EndOfLine& other : ends)
      if (other.part == end.part) above += end.at.z() - other.at.z(), count += 1.0;
    const double worth =
        end.worth + std::clamp(above / count / 20.0, -1.0, 1.0) + cover_worth * end.part_mm / whole_mm;
    if (worth <= best_worth) continue;
    best_worth = worth;
    best.left = end.node;
  }
  return best;
}

}  // namespace ostia::coronary
