// Points between the zeros where a line is bent, and the lines from cell to cell.

#include "contours/contour_tracer.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <tuple>

namespace ostia::lumen {
namespace {

constexpr int most_halvings = 4;
constexpr int most_steps = 12;
constexpr double farthest = 0.25;  // from its chord, in chord lengths, that a point may lie
constexpr double same_px = 1e-9;

}  // namespace

struct ContourTracer::Chord {
  int cell = 0, line = 0;
  double order0 = 0.0, order1 = 1.0;  // where its ends stand in the line
  Vec2 p, q;
  // The point in the middle is moved by t along the normal that leaves the lumen.
  double t = 0.0, f = 0.0, former_t = 0.0, former_f = 0.0;
  enum class State { first, moving, straight, found, given_up } state = State::first;
  Vec3 place = Vec3::Zero();

  double limit() const { return farthest * (q - p).norm(); }
  Vec2 px() const {
    const Vec2 way = (q - p).normalized();
    return 0.5 * (p + q) + t * Vec2(-way.y(), way.x());
  }
  bool open() const { return state == State::first || state == State::moving; }

  void take(double value, double slope_px, double bend_px) {
    f = value;
    double next = t - f / slope_px;
    if (state == State::first && std::abs(f) <= bend_px * slope_px) {
      state = State::straight;
      return;
    }
    if (std::abs(f) <= RootFinder::enough) {
      state = State::found;
      return;
    }
    if (state == State::moving && former_f != f) next = t - f * (t - former_t) / (f - former_f);
    former_t = t;
    former_f = f;
    state = State::moving;
    t = std::clamp(next, -limit(), limit());
    if (t == former_t) state = State::given_up;
  }
};

void ContourTracer::pull_onto_wall(std::vector<Chord>& chords) {
  const double slope_px = slope_ * grid_.pixel_mm();
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < chords.size(); ++i) open.push_back(i);
  std::vector<Vec3> places;
  std::vector<double> values;
  for (int step = 0; step < most_steps && !open.empty(); ++step) {
    places.resize(open.size());
    core::parallel_for(open.size(), 64, [&](std::size_t i) {
      Chord& chord = chords[open[i]];
      places[i] = chord.place = grid_.place(chord.px());
    });
    evaluate(places, values);
    for (std::size_t i = 0; i < open.size(); ++i) chords[open[i]].take(values[i], slope_px, options_.bend_px);
    std::erase_if(open, [&](std::size_t i) { return !chords[i].open(); });
  }
}

void ContourTracer::straighten_bends(const std::vector<int>& fresh) {
  struct Extra {
    int cell, line;
    double order;
    ContourPoint point;
  };
  std::vector<Extra> extras;
  std::vector<Chord> chords, halves;
  const auto add = [](std::vector<Chord>& to, Chord chord) {
    if ((chord.q - chord.p).norm() > same_px) to.push_back(chord);
  };
  for (const int index : fresh) {
    const Cell& cell = cells_[static_cast<std::size_t>(index)];
    for (std::size_t l = 0; l < cell.lines.size(); ++l) {
      const auto& points = cell.lines[l].points;
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        if (!points[i].exact || !points[i + 1].exact) continue;
        Chord chord;
        chord.cell = index, chord.line = static_cast<int>(l);
        chord.order0 = static_cast<double>(i), chord.order1 = static_cast<double>(i + 1);
        chord.p = points[i].px, chord.q = points[i + 1].px;
        add(chords, chord);
      }
    }
  }
  for (int round = 0; round < most_halvings && !chords.empty(); ++round) {
    pull_onto_wall(chords);
    halves.clear();
    for (const Chord& chord : chords) {
      if (chord.state != Chord::State::found) continue;
      const double order = 0.5 * (chord.order0 + chord.order1);
      extras.push_back({chord.cell, chord.line, order, {chord.px(), chord.place, true}});
      // Halving a chord makes its bow four times flatter.
      if (std::abs(chord.t) <= 4.0 * options_.bend_px) continue;
      Chord first, second;
      first.cell = second.cell = chord.cell;
      first.line = second.line = chord.line;
      first.order0 = chord.order0, first.order1 = second.order0 = order, second.order1 = chord.order1;
      first.p = chord.p, first.q = second.p = chord.px(), second.q = chord.q;
      add(halves, first);
      add(halves, second);
    }
    chords.swap(halves);
  }
  std::sort(extras.begin(), extras.end(), [](const Extra& a, const Extra& b) {
    return std::tie(a.cell, a.line, a.order) < std::tie(b.cell, b.line, b.order);
  });
  std::vector<ContourPoint> merged;
  for (std::size_t i = 0; i < extras.size();) {
    Line& line =
        cells_[static_cast<std::size_t>(extras[i].cell)].lines[static_cast<std::size_t>(extras[i].line)];
    const int cell = extras[i].cell, number = extras[i].line;
    merged.clear();
    for (std::size_t k = 0; k < line.points.size(); ++k) {
      merged.push_back(line.points[k]);
      for (; i < extras.size() && extras[i].cell == cell && extras[i].line == number &&
             extras[i].order < static_cast<double>(k + 1);
           ++i)
        merged.push_back(extras[i].point);
    }
    line.points = merged;
  }
}

ContourLine ContourTracer::line_from(Onward at) {
  ContourLine made;
  const auto add = [&](const ContourPoint& point) {
    if (!point.exact) return;
    if (!made.picture_px.empty() && (made.picture_px.back() - point.px).norm() <= same_px) return;
    made.picture_px.push_back(point.px);
    made.world.push_back(point.place);
  };
  const int first = cells_[static_cast<std::size_t>(at.cell)].lines[static_cast<std::size_t>(at.line)].from;
  int last = first;
  while (at.cell >= 0) {
    const Line& line = cells_[static_cast<std::size_t>(at.cell)].lines[static_cast<std::size_t>(at.line)];
    for (const ContourPoint& point : line.points) add(point);
    last = line.to;
    if (last < 0) break;
    Onward& next = edges_[static_cast<std::size_t>(last / 2)].onward[static_cast<std::size_t>(last % 2)];
    at = next;
    next.cell = -1;
  }
  if (last == first && made.picture_px.size() > 1) {
    if ((made.picture_px.front() - made.picture_px.back()).norm() <= same_px) {
      made.picture_px.pop_back();
      made.world.pop_back();
    }
    made.picture_px.push_back(made.picture_px.front());
    made.world.push_back(made.world.front());
  }
  return made;
}

std::vector<ContourLine> ContourTracer::chained() {
  for (const int index : active_)
    for (const int edge : cells_[static_cast<std::size_t>(index)].edge)
      edges_[static_cast<std::size_t>(edge)].onward = {};
  const auto onward = [&](int zero) -> Onward& {
    return edges_[static_cast<std::size_t>(zero / 2)].onward[static_cast<std::size_t>(zero % 2)];
  };
  for (const int index : active_) {
    const std::vector<Line>& lines = cells_[static_cast<std::size_t>(index)].lines;
    for (std::size_t l = 0; l < lines.size(); ++l) {
      if (lines[l].from < 0) continue;
      onward(lines[l].from).cell = index;
      onward(lines[l].from).line = static_cast<int>(l);
      onward(lines[l].to).entered = true;
    }
  }
  std::vector<ContourLine> made;
  const auto pass = [&](bool open) {
    for (const int index : active_) {
      const std::vector<Line>& lines = cells_[static_cast<std::size_t>(index)].lines;
      for (std::size_t l = 0; l < lines.size(); ++l) {
        const Onward here{index, static_cast<int>(l), false};
        if (lines[l].from >= 0) {
          Onward& start = onward(lines[l].from);
          if (start.cell < 0 || (open && start.entered)) continue;
          start.cell = -1;
        } else if (open) {
          continue;
        }
        made.push_back(line_from(here));
        if (made.back().picture_px.size() < 2) made.pop_back();
      }
    }
  };
  pass(true);
  pass(false);
  return made;
}

}  // namespace ostia::lumen
