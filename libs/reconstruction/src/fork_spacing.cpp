#include "fork_spacing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <set>
#include <utility>

namespace ostia::reconstruction {
namespace {

constexpr double degree = 0.017453292519943295;
constexpr double splayed = 50.0 * degree;
constexpr double decay = 8.0;      // of a movement: the way along the vessels, in its own lengths
constexpr double clear = 1.25;     // of two radii: the distance at which walls of polygons are clear
constexpr double own_piece = 0.5;  // of a radius: what a branch keeps between its joints

Vec3 end_of(const geometry::VesselGraph& graph, const Tube& tube) {
  return graph.points[static_cast<std::size_t>(tube.end)];
}

/// How far along `of` the walls of another branch at the same fork reach.
double need(const Slot& of, const Slot& other) {
  const double angle = std::clamp(std::acos(std::clamp(of.direction.dot(other.direction), -1.0, 1.0)),
                                  splayed, 150.0 * degree);
  const double met = (other.radius + of.radius * std::cos(angle)) / std::sin(angle);
  return std::max(0.3 * of.radius, met);
}

double need_at(const std::vector<Slot>& slots, std::int32_t tube, bool distal) {
  double most = 0.0;
  for (const Slot& of : slots) {
    if (of.tube != tube || of.distal != distal) continue;
    for (const Slot& other : slots)
      if (&other != &of) most = std::max(most, need(of, other));
  }
  return most;
}

class Mover {
 public:
  explicit Mover(Network& network) : network_(network) {}

  /// The branch's end by `by`, its inner points in proportion, and what lies distal ever less.
  void move_end(std::size_t branch, std::int32_t start, std::int32_t end, const Vec3& by) {
    const double length = network_.length(branch);
    double s = 0.0;
    std::set<std::int32_t> own{start};
    for (const std::int32_t e : network_.branches[branch].edges) {
      const geometry::GraphEdge& edge = network_.graph.edges[static_cast<std::size_t>(e)];
      s += (point(edge.to) - point(edge.from)).norm();
      if (edge.to == end) break;
      own.insert(edge.to);
      shifts_[edge.to] = s / length * by;
    }
    spread(end, own, by);
    for (const auto& [index, shift] : shifts_) {
      point(index) += shift;
      for (const std::int32_t e : network_.incidence.leaving(index)) edges_.insert(e);
      for (const std::int32_t e : network_.incidence.arriving(index)) edges_.insert(e);
    }
    shifts_.clear();
  }

  const std::set<std::int32_t>& edges() const { return edges_; }

 private:
  Vec3& point(std::int32_t index) { return network_.graph.points[static_cast<std::size_t>(index)]; }

  void spread(std::int32_t from, const std::set<std::int32_t>& barred, const Vec3& by) {
    const double reach = decay * by.norm();
    using Way = std::pair<double, std::int32_t>;
    std::priority_queue<Way, std::vector<Way>, std::greater<>> open;
    open.emplace(0.0, from);
    std::set<std::int32_t> done;
    while (!open.empty()) {
      const auto [way, index] = open.top();
      open.pop();
      if (!done.insert(index).second) continue;
      shifts_[index] = (1.0 - way / reach) * by;
      const auto visit = [&](std::int32_t next) {
        const double further = way + (point(next) - point(index)).norm();
        if (further < reach && barred.count(next) == 0) open.emplace(further, next);
      };
      for (const std::int32_t e : network_.incidence.leaving(index))
        visit(network_.graph.edges[static_cast<std::size_t>(e)].to);
      for (const std::int32_t e : network_.incidence.arriving(index))
        visit(network_.graph.edges[static_cast<std::size_t>(e)].from);
    }
  }

  Network& network_;
  std::map<std::int32_t, Vec3> shifts_;
  std::set<std::int32_t> edges_;
};

std::vector<Slot> slots_at(const std::vector<Tube>& tubes, const TubeEnds& ends, std::int32_t joint) {
  std::vector<Slot> slots;
  for (const TubeEnd& end : ends[static_cast<std::size_t>(joint)])
    slots.push_back(slot_of(tubes, end.tube, end.distal));
  return slots;
}

/// The branch seen from one of its ends.
struct From {
  const Tube& tube;
  bool distal;
  TubePlace at(double away) const { return reconstruction::at(tube, distal ? tube.length() - away : away); }
};

/// How far apart two branches should be at a distance from their fork; none where they are.
double lack(const TubePlace& a, const TubePlace& b, double away) {
  const double want = std::min(2.0 * away * std::sin(0.5 * splayed), clear * (a.radius + b.radius));
  return std::max(0.0, want - (a.point - b.point).norm());
}

Vec3 apart(const TubePlace& a, const TubePlace& b, const Vec3& otherwise) {
  const Vec3 between = a.point - b.point;
  if (between.norm() > 1e-6 * a.radius) return between.normalized();
  return otherwise.norm() > 1e-6 ? otherwise.normalized() : a.frame.normal;
}

void bend(Tube& tube, const std::vector<Vec3>& shifts) {
  for (std::size_t i = 1; i + 1 < tube.points.size(); ++i) tube.points[i] += shifts[i];
  measure(tube);
}

/// Where each of the tube's points should go to be clear of the other branch, its share of the way.
std::vector<Vec3> shifts_from(const From& own, const From& other, double share, const Vec3& side) {
  std::vector<Vec3> shifts(own.tube.points.size(), Vec3::Zero());
  const double most = std::min(own.tube.length(), other.tube.length());
  for (std::size_t i = 1; i + 1 < shifts.size(); ++i) {
    const double away = own.distal ? own.tube.length() - own.tube.abscissa[i] : own.tube.abscissa[i];
    if (away >= most) continue;
    const TubePlace a = own.at(away), b = other.at(away);
    const double fade = std::min(1.0, (own.tube.length() - away) / (0.25 * own.tube.length()));
    shifts[i] = share * fade * lack(a, b, away) * apart(a, b, side);
  }
  return shifts;
}

}  // namespace

Network::Network(const geometry::VesselGraph& given)
    : graph(given), incidence(graph), branches(geometry::branches(graph, incidence)) {}

double Network::length(std::size_t branch) const {
  double sum = 0.0;
  for (const std::int32_t e : branches[branch].edges) {
    const geometry::GraphEdge& edge = graph.edges[static_cast<std::size_t>(e)];
    sum +=
        (graph.points[static_cast<std::size_t>(edge.to)] - graph.points[static_cast<std::size_t>(edge.from)])
            .norm();
  }
  return sum;
}

std::vector<std::int32_t> make_room(Network& network, const std::vector<Tube>& tubes, const TubeEnds& ends,
                                    const std::vector<std::int32_t>& joints) {
  Mover mover(network);
  std::set<std::int32_t> touched;
  for (const std::int32_t joint : joints)
    for (const TubeEnd& end : ends[static_cast<std::size_t>(joint)]) touched.insert(end.tube);
  for (const std::int32_t index : touched) {
    const auto b = static_cast<std::size_t>(index);
    const Tube& tube = tubes[b];
    if (tube.start == tube.end) continue;
    const double radius = std::min(tube.radius.front(), tube.radius.back());
    const double needed = need_at(slots_at(tubes, ends, tube.start), index, false) +
                          need_at(slots_at(tubes, ends, tube.end), index, true) + own_piece * radius;
    const double length = network.length(b);
    if (length >= needed) continue;
    const Vec3 way = end_of(network.graph, tube) - network.graph.points[static_cast<std::size_t>(tube.start)];
    const Vec3 direction = way.norm() > 0.1 * length ? way.normalized() : tube.frames.back().tangent;
    mover.move_end(b, tube.start, tube.end, (needed - length) * direction);
  }
  for (const std::int32_t joint : joints) {
    const std::vector<Slot> slots = slots_at(tubes, ends, joint);
    for (const Slot& own : slots)
      for (const Slot& other : slots) {
        const Tube &tube = tubes[static_cast<std::size_t>(own.tube)],
                   &beside = tubes[static_cast<std::size_t>(other.tube)];
        const bool ends_first = !own.distal && own.tube != other.tube && tube.length() < beside.length();
        if (!ends_first || tube.start == tube.end || own.direction.dot(other.direction) < std::cos(splayed))
          continue;
        const TubePlace a = at(tube, tube.length()), b = From{beside, other.distal}.at(tube.length());
        const double by = lack(a, b, tube.length());
        if (by > 0.0)
          mover.move_end(static_cast<std::size_t>(own.tube), tube.start, tube.end,
                         by * apart(a, b, own.direction - other.direction));
      }
  }
  std::vector<std::int32_t> changed;
  for (std::size_t b = 0; b < network.branches.size(); ++b) {
    const auto& edges = network.branches[b].edges;
    if (std::any_of(edges.begin(), edges.end(), [&](std::int32_t e) { return mover.edges().count(e) > 0; }))
      changed.push_back(static_cast<std::int32_t>(b));
  }
  return changed;
}

void splay(std::vector<Tube>& tubes, const TubeEnds& ends, const std::vector<std::int32_t>& joints) {
  for (const std::int32_t joint : joints) {
    const std::vector<Slot> slots = slots_at(tubes, ends, joint);
    for (std::size_t i = 0; i < slots.size(); ++i)
      for (std::size_t k = i + 1; k < slots.size(); ++k) {
        const Slot &a = slots[i], &b = slots[k];
        if (a.tube == b.tube || a.direction.dot(b.direction) < std::cos(splayed)) continue;
        Tube &one = tubes[static_cast<std::size_t>(a.tube)], &other = tubes[static_cast<std::size_t>(b.tube)];
        // The thinner one gives way more.
        const double share = b.radius * b.radius / (a.radius * a.radius + b.radius * b.radius);
        const Vec3 side = a.direction - b.direction;
        const auto first = shifts_from({one, a.distal}, {other, b.distal}, share, side);
        const auto second = shifts_from({other, b.distal}, {one, a.distal}, 1.0 - share, Vec3(-side));
        bend(one, first);
        bend(other, second);
      }
  }
}

}  // namespace ostia::reconstruction
