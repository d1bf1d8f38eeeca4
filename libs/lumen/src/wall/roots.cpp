#include "wall/roots.h"

#include "ostia/geometry/cube_patterns.h"

#include <algorithm>
#include <cmath>

namespace ostia::lumen {
namespace {

// A root that inverse interpolation through three values puts within this of the last place asked, in cells,
// is taken without asking again: what it is off is of the third order in this.
constexpr double near_enough = 0.02;
constexpr int most_rounds = 10;

struct Sample {
  double t, f;
};

// t at f = 0 on the parabola t(f) through three samples; not finite where two values are equal.
double inverse_parabola(const Sample& a, const Sample& b, const Sample& c) {
  return a.t * b.f * c.f / ((a.f - b.f) * (a.f - c.f)) + b.t * a.f * c.f / ((b.f - a.f) * (b.f - c.f)) +
         c.t * a.f * b.f / ((c.f - a.f) * (c.f - b.f));
}

/// The root of one edge, between two samples on different sides.
class Bracket {
 public:
  explicit Bracket(const WallEdge& edge) : low_{0.0, edge.from}, high_{1.0, edge.to} {
    next_ = std::clamp(secant(), geometry::node_clearance, 1.0 - geometry::node_clearance);
  }
  double next() const { return next_; }
  bool done() const { return done_; }

  // Takes the value at next().
  void take(double f) {
    if (f == 0.0) {
      done_ = true;
      return;
    }
    const double last = next_;
    Sample& end = (f < 0.0) == (low_.f < 0.0) ? low_ : high_;
    const Sample left = end;
    end = {last, f};
    double t = inverse_parabola(low_, high_, left);
    if (!(t > low_.t && t < high_.t)) t = stuck_ ? 0.5 * (low_.t + high_.t) : secant();
    stuck_ = std::abs(t - last) > 0.5 * std::abs(left.t - last);
    next_ = std::clamp(t, geometry::node_clearance, 1.0 - geometry::node_clearance);
    done_ = std::abs(next_ - last) <= near_enough;
  }

 private:
  double secant() const { return low_.t + (high_.t - low_.t) * low_.f / (low_.f - high_.f); }
  Sample low_, high_;
  double next_ = 0.5;
  bool done_ = false, stuck_ = false;
};

}  // namespace

std::vector<double> roots(WallJob& job, const std::vector<WallEdge>& edges) {
  std::vector<Bracket> brackets(edges.begin(), edges.end());
  std::vector<std::size_t> open(edges.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = i;
  std::vector<Vec3> places;
  for (int round = 0; round < most_rounds && !open.empty(); ++round) {
    places.clear();
    for (const std::size_t i : open)
      places.push_back(job.place(edges[i].node, edges[i].axis, brackets[i].next()));
    const std::vector<double> f = job.ask(places);
    for (std::size_t k = 0; k < open.size(); ++k) brackets[open[k]].take(f[k]);
    std::erase_if(open, [&](std::size_t i) { return brackets[i].done(); });
  }
  std::vector<double> found;
  found.reserve(edges.size());
  for (const Bracket& bracket : brackets) found.push_back(bracket.next());
  return found;
}

}  // namespace ostia::lumen
