#include "contours/contour_tracer.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <algorithm>
#include <string>

namespace ostia::lumen {
namespace {

constexpr std::size_t cells_per_task = 64;
// Between two places f is taken to change by no more than this times its slope on the wall.
constexpr double safe_rise = 1.5;
constexpr double longest_stride = 16.0;  // cells
// Right, left, down, up.
constexpr std::array<std::array<int, 2>, 4> ways{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

}  // namespace

ContourTracer::ContourTracer(ViewSurface view, const std::vector<Vec2>& seeds,
                             const ContourLineOptions& options)
    : grid_(std::move(view), options),
      options_(options),
      corner_index_(grid_.columns(), grid_.rows()),
      edge_index_{{grid_.columns(), grid_.rows()}, {grid_.columns(), grid_.rows()}},
      cell_index_(grid_.columns(), grid_.rows()) {
  for (const Vec2& px : seeds)
    if (px.allFinite() && grid_.holds(px)) seeds_.push_back({px, grid_.place(px), 0.0, false});
  if (seeds_.empty())
    throw InvalidInput("contour lines need at least one seed within the picture, of " +
                       std::to_string(seeds.size()) + " none is; give the axis where the view shows it");
}

// ---- evaluation

void ContourTracer::evaluate(const std::vector<Vec3>& places, std::vector<double>& values) {
  values.resize(places.size());
  field_->values(places, values);
  evaluations_ += places.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    const Vec3& p = places[i];
    throw InvalidInput("the field of a contour is not finite at (" + std::to_string(p.x()) + ", " +
                       std::to_string(p.y()) + ", " + std::to_string(p.z()) + ") mm");
  }
}

double ContourTracer::evaluate(const Vec2& px, Vec3& place) {
  place = grid_.place(px);
  std::vector<double> value;
  evaluate(std::vector<Vec3>{place}, value);
  return value[0];
}

// ---- corners, edges and cells, made when first asked for

int ContourTracer::corner_at(int column, int row) {
  std::int32_t& index = corner_index_.at(column, row);
  if (index < 0) {
    index = static_cast<std::int32_t>(corners_.size());
    Corner corner;
    corner.column = column;
    corner.row = row;
    corner.px = grid_.corner(column, row);
    corner.place = grid_.place_on_row(corner.px.x(), row);
    corners_.push_back(corner);
  }
  return index;
}

int ContourTracer::edge_at(int column, int row, bool upright) {
  std::int32_t& index = edge_index_[upright ? 1 : 0].at(column, row);
  if (index < 0) {
    index = static_cast<std::int32_t>(edges_.size());
    Edge edge;
    edge.column = column;
    edge.row = row;
    edge.upright = upright;
    edge.corner = {corner_at(column, row), upright ? corner_at(column, row + 1) : corner_at(column + 1, row)};
    edges_.push_back(edge);
  }
  return index;
}

int ContourTracer::cell_at(int column, int row) {
  std::int32_t& index = cell_index_.at(column, row);
  if (index < 0) {
    index = static_cast<std::int32_t>(cells_.size());
    Cell cell;
    cell.column = column;
    cell.row = row;
    cell.edge = {edge_at(column, row, false), edge_at(column + 1, row, true), edge_at(column, row + 1, false),
                 edge_at(column, row, true)};
    cells_.push_back(std::move(cell));
  }
  return index;
}

std::array<int, 4> ContourTracer::corners_of(const Cell& cell) const {
  const Edge &top = edges_[static_cast<std::size_t>(cell.edge[0])],
             &bottom = edges_[static_cast<std::size_t>(cell.edge[2])];
  return {top.corner[0], top.corner[1], bottom.corner[1], bottom.corner[0]};
}

double ContourTracer::edge_length(const Edge& edge) const {
  return (corners_[static_cast<std::size_t>(edge.corner[1])].place -
          corners_[static_cast<std::size_t>(edge.corner[0])].place)
      .norm();
}

Vec2 ContourTracer::on_edge(const Edge& edge, double t) const {
  const Vec2 &p = corners_[static_cast<std::size_t>(edge.corner[0])].px,
             &q = corners_[static_cast<std::size_t>(edge.corner[1])].px;
  return p + t * (q - p);
}

Vec3 ContourTracer::place_on_edge(const Edge& edge, double t) {
  const Vec2 px = on_edge(edge, t);
  return edge.upright ? grid_.place(px) : grid_.place_on_row(px.x(), edge.row);
}

// ---- looking for lines

void ContourTracer::want(int corner) {
  if (!corners_[static_cast<std::size_t>(corner)].known) wanted_.push_back(corner);
}

void ContourTracer::evaluate_wanted() {
  std::sort(wanted_.begin(), wanted_.end(), [&](int a, int b) {
    const Corner &p = corners_[static_cast<std::size_t>(a)], &q = corners_[static_cast<std::size_t>(b)];
    return std::pair(p.row, p.column) < std::pair(q.row, q.column);
  });
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
  std::vector<Vec3> places;
  std::vector<double> values;
  for (const int corner : wanted_) places.push_back(corners_[static_cast<std::size_t>(corner)].place);
  for (const int edge : probing_) {
    Edge& probed = edges_[static_cast<std::size_t>(edge)];
    places.push_back(place_on_edge(probed, probed.probe.next()));
  }
  evaluate(places, values);
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    Corner& corner = corners_[static_cast<std::size_t>(wanted_[i])];
    corner.value = values[i];
    corner.known = true;
  }
  for (std::size_t i = 0; i < probing_.size(); ++i)
    edges_[static_cast<std::size_t>(probing_[i])].probe.take(values[wanted_.size() + i]);
  wanted_.clear();
}

void ContourTracer::start_from_seeds() {
  std::vector<int> next_to;
  for (const Seed& seed : seeds_) {
    const auto [column, row] = grid_.corner_near(seed.px);
    next_to.push_back(corner_at(column, row));
    want(next_to.back());
  }
  evaluate_wanted();
  // Where the corner is far from the wall its seed lies on the same side.
  std::vector<Vec3> places;
  std::vector<double> values;
  std::vector<std::size_t> asked;
  std::vector<bool> beside(seeds_.size(), false);
  for (std::size_t i = 0; i < seeds_.size(); ++i) {
    const Corner& corner = corners_[static_cast<std::size_t>(next_to[i])];
    beside[i] = std::abs(corner.value) > safe_rise * slope_ * (seeds_[i].place - corner.place).norm();
    if (beside[i] || seeds_[i].known) continue;
    asked.push_back(i);
    places.push_back(seeds_[i].place);
  }
  evaluate(places, values);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    seeds_[asked[i]].value = values[i];
    seeds_[asked[i]].known = true;
  }
  std::vector<std::array<int, 2>> walkers;  // a corner and a direction
  for (std::size_t i = 0; i < seeds_.size(); ++i) {
    if (beside[i] ||
        inside(seeds_[i].value) == inside(corners_[static_cast<std::size_t>(next_to[i])].value)) {
      for (int way = 0; way < 4; ++way) walkers.push_back({next_to[i], way});
      continue;
    }
    const auto [column, row] = grid_.cell_at(seeds_[i].px);
    enter(column, row);
    Cell& cell = cells_[static_cast<std::size_t>(cell_at(column, row))];
    if (cell.seed < 0) cell.seed = static_cast<int>(i);
  }
  walk(std::move(walkers));
}

void ContourTracer::walk(std::vector<std::array<int, 2>> walkers) {
  struct Step {
    int from, way, next, length;
  };
  std::vector<Step> steps;
  std::vector<std::array<int, 2>> careful;  // one cell at a time
  const auto step = [&](int from, int way, int length) {
    const auto [across, down] = ways[static_cast<std::size_t>(way)];
    const Corner& corner = corners_[static_cast<std::size_t>(from)];
    const int column = std::clamp(corner.column + length * across, 0, grid_.columns());
    const int row = std::clamp(corner.row + length * down, 0, grid_.rows());
    if (column == corner.column && row == corner.row) return;
    const int moved = std::abs(column - corner.column) + std::abs(row - corner.row);
    const int next = corner_at(column, row);
    want(next);
    steps.push_back({from, way, next, moved});
  };
  while (!walkers.empty() || !careful.empty()) {
    steps.clear();
    for (const auto& [from, way] : careful) step(from, way, 1);
    careful.clear();
    for (const auto& [from, way] : walkers) {
      Corner& corner = corners_[static_cast<std::size_t>(from)];
      if (corner.run != run_) corner.run = run_, corner.walked = 0;
      const auto bit = static_cast<std::uint8_t>(1 << way);
      if ((corner.walked & bit) != 0) continue;
      corner.walked = static_cast<std::uint8_t>(corner.walked | bit);
      const double cells = std::abs(corner.value) / (safe_rise * slope_ * grid_.cell_mm());
      step(from, way, static_cast<int>(std::clamp(cells, 1.0, longest_stride)));
    }
    evaluate_wanted();
    walkers.clear();
    for (const auto& [from, way, next, length] : steps) {
      const Corner &p = corners_[static_cast<std::size_t>(from)],
                   &q = corners_[static_cast<std::size_t>(next)];
      if (inside(p.value) == inside(q.value)) {
        walkers.push_back({next, way});
      } else if (length > 1) {
        careful.push_back({from, way});
      } else {
        const int edge = edge_at(std::min(p.column, q.column), std::min(p.row, q.row), p.column == q.column);
        enter_beside(edges_[static_cast<std::size_t>(edge)]);
      }
    }
  }
}

void ContourTracer::enter(int column, int row) {
  if (column < 0 || row < 0 || column >= grid_.columns() || row >= grid_.rows()) return;
  const int index = cell_at(column, row);
  Cell& cell = cells_[static_cast<std::size_t>(index)];
  if (cell.run == run_) return;
  cell.run = run_;
  cell.seed = -1;
  frontier_.push_back(index);
  active_.push_back(index);
}

void ContourTracer::enter_beside(const Edge& edge) {
  const int column = edge.column, row = edge.row;
  const bool upright = edge.upright;  // the edge may move when cells are made
  enter(column, row);
  if (upright)
    enter(column - 1, row);
  else
    enter(column, row - 1);
}

void ContourTracer::classify(int index) {
  Edge& edge = edges_[static_cast<std::size_t>(index)];
  if (edge.run == run_) return;
  edge.run = run_;
  if (edge.state == Edge::State::unknown) {
    const double f0 = corners_[static_cast<std::size_t>(edge.corner[0])].value,
                 f1 = corners_[static_cast<std::size_t>(edge.corner[1])].value;
    edge.zeros = 0;
    if (inside(f0) != inside(f1)) {
      edge.state = Edge::State::bracketed;
      edge.zeros = 1;
      edge.bracket[0] = {0.0, f0, 1.0, f1};
    } else {
      edge.probe = DipProbe(f0, f1, slope_ * edge_length(edge));
      edge.state = edge.probe.done() ? Edge::State::clear : Edge::State::probing;
    }
  }
  if (edge.state == Edge::State::probing) probing_.push_back(index);
  if (edge.zeros > 0) enter_beside(edge);
}

void ContourTracer::follow() {
  std::vector<int> cells, probed;
  while (!frontier_.empty() || !probing_.empty()) {
    cells.swap(frontier_);
    frontier_.clear();
    for (const int cell : cells)
      for (const int corner : corners_of(cells_[static_cast<std::size_t>(cell)])) want(corner);
    evaluate_wanted();
    probed.swap(probing_);
    probing_.clear();
    for (const int index : probed) take_probe(index);
    for (const int cell : cells) {
      const std::array<int, 4> around = cells_[static_cast<std::size_t>(cell)].edge;
      for (const int edge : around) classify(edge);
    }
    cells.clear();
  }
}

void ContourTracer::take_probe(int index) {
  Edge& edge = edges_[static_cast<std::size_t>(index)];
  if (!edge.probe.done()) {
    probing_.push_back(index);
    return;
  }
  edge.state = edge.probe.found() ? Edge::State::bracketed : Edge::State::clear;
  if (!edge.probe.found()) return;
  edge.zeros = 2;
  edge.bracket = {edge.probe.first(), edge.probe.second()};
  enter_beside(edge);
}

// ---- lines in cells

void ContourTracer::solve_edges() {
  struct Open {
    int edge, zero;
    RootFinder finder;
    Vec3 place = Vec3::Zero();
  };
  std::vector<Open> open;
  std::vector<int> fresh;
  for (const int cell : active_)
    for (const int index : cells_[static_cast<std::size_t>(cell)].edge)
      if (edges_[static_cast<std::size_t>(index)].state == Edge::State::bracketed) {
        edges_[static_cast<std::size_t>(index)].state = Edge::State::solved;
        fresh.push_back(index);
      }
  for (const int index : fresh) {
    const Edge& edge = edges_[static_cast<std::size_t>(index)];
    for (int k = 0; k < edge.zeros; ++k)
      open.push_back({index, k, RootFinder(edge.bracket[static_cast<std::size_t>(k)])});
  }
  std::vector<Vec3> places;
  std::vector<double> values;
  std::vector<double> asked;
  while (!open.empty()) {
    for (Open& one : open) {
      if (!one.finder.done()) continue;
      Edge& edge = edges_[static_cast<std::size_t>(one.edge)];
      ContourPoint& zero = edge.zero[static_cast<std::size_t>(one.zero)];
      zero.px = on_edge(edge, one.finder.root());
      zero.place = place_on_edge(edge, one.finder.root());
      zero.exact = std::abs(one.finder.residual()) <= 1e-6;
    }
    std::erase_if(open, [](const Open& one) { return one.finder.done(); });
    asked.resize(open.size());
    places.resize(open.size());
    for (std::size_t i = 0; i < open.size(); ++i) asked[i] = open[i].finder.next();
    for (std::size_t i = 0; i < open.size(); ++i)
      if (const Edge& edge = edges_[static_cast<std::size_t>(open[i].edge)]; !edge.upright)
        places[i] = place_on_edge(edge, asked[i]);
    core::parallel_for(open.size(), cells_per_task, [&](std::size_t i) {
      const Edge& edge = edges_[static_cast<std::size_t>(open[i].edge)];
      if (edge.upright) places[i] = grid_.place(on_edge(edge, asked[i]));
    });
    evaluate(places, values);
    for (std::size_t i = 0; i < open.size(); ++i) open[i].finder.take(values[i]);
  }
}

void ContourTracer::build_cells() {
  std::vector<int> fresh;
  for (const int index : active_) {
    Cell& cell = cells_[static_cast<std::size_t>(index)];
    if (cell.built && cell.built_with_seed == cell.seed) continue;
    build(cell);
    fresh.push_back(index);
  }
  straighten_bends(fresh);
}

void ContourTracer::build(Cell& cell) {
  cell.lines.clear();
  cell.built = true;
  cell.built_with_seed = cell.seed;
  CellOutline outline;
  const std::array<int, 4> corners = corners_of(cell);
  std::vector<ContourPoint> points;
  std::vector<int> names;  // of the points on the outline: 2 * edge + number
  for (std::size_t k = 0; k < 4; ++k) {
    const Corner& corner = corners_[static_cast<std::size_t>(corners[k])];
    outline.corner[k] = corner.px;
    outline.value[k] = corner.value;
    const Edge& edge = edges_[static_cast<std::size_t>(cell.edge[k])];
    const bool backwards = k >= 2;  // edges run to the right and down
    for (int i = 0; i < edge.zeros; ++i) {
      const int zero = backwards ? edge.zeros - 1 - i : i;
      outline.zeros[k].push_back(static_cast<int>(points.size()));
      points.push_back(edge.zero[static_cast<std::size_t>(zero)]);
      names.push_back(2 * cell.edge[k] + zero);
    }
  }
  if (points.empty() && cell.seed < 0) return;
  const int on_outline = static_cast<int>(points.size());
  CellField asked;
  asked.value = [&](const Vec2& px) {
    Vec3 place;
    return evaluate(px, place);
  };
  asked.zero_px = [&](int zero) { return points[static_cast<std::size_t>(zero)].px; };
  asked.zeros_between = [&](const Vec2& p, double fp, const Vec2& q, double fq) {
    std::vector<Bracket> brackets;
    const auto at = [&](double t) -> Vec2 { return p + t * (q - p); };
    Vec3 place;
    if (inside(fp) != inside(fq)) {
      brackets.push_back({0.0, fp, 1.0, fq});
    } else {
      DipProbe probe(fp, fq, slope_ * (grid_.place(q) - grid_.place(p)).norm());
      while (!probe.done()) probe.take(evaluate(at(probe.next()), place));
      if (probe.found()) brackets = {probe.first(), probe.second()};
    }
    std::vector<int> zeros;
    for (const Bracket& bracket : brackets) {
      RootFinder finder(bracket);
      while (!finder.done()) finder.take(evaluate(at(finder.next()), place));
      zeros.push_back(static_cast<int>(points.size()));
      const Vec2 px = at(finder.root());
      points.push_back({px, grid_.place(px), std::abs(finder.residual()) <= 1e-6});
    }
    return zeros;
  };
  std::optional<std::pair<Vec2, double>> seed;
  if (cell.seed >= 0) {
    const Seed& given = seeds_[static_cast<std::size_t>(cell.seed)];
    seed = {given.px, given.value};
  }
  for (const CellLine& found : lines_in_cell(outline, asked, seed)) {
    Line line;
    if (found.zeros.front() < on_outline) {
      line.from = names[static_cast<std::size_t>(found.zeros.front())];
      line.to = names[static_cast<std::size_t>(found.zeros.back())];
    }
    for (const int zero : found.zeros) line.points.push_back(points[static_cast<std::size_t>(zero)]);
    cell.lines.push_back(std::move(line));
  }
}

// ---- all of it

std::vector<ContourLine> ContourTracer::trace(const ScalarField& field) {
  field_ = &field;
  slope_ = field.wall_slope();
  ++run_;
  evaluations_ = 0;
  wanted_.clear();
  frontier_.clear();
  probing_.clear();
  active_.clear();
  start_from_seeds();
  follow();
  std::sort(active_.begin(), active_.end(), [&](int a, int b) {
    const Cell &p = cells_[static_cast<std::size_t>(a)], &q = cells_[static_cast<std::size_t>(b)];
    return std::pair(p.row, p.column) < std::pair(q.row, q.column);
  });
  solve_edges();
  build_cells();
  return chained();
}

void ContourTracer::forget(const Box3& changed) {
  if (changed.isEmpty()) return;
  // Between its corners a view bends by less than this share of their distance.
  constexpr double margin = 0.25;
  const auto touched = [&](const Box3& box) {
    const Vec3 by = Vec3::Constant(margin * box.diagonal().norm());
    return Box3(box.min() - by, box.max() + by).intersects(changed);
  };
  for (Seed& seed : seeds_)
    if (changed.contains(seed.place)) seed.known = false;
  for (Corner& corner : corners_)
    if (changed.contains(corner.place)) corner.known = false;
  for (Edge& edge : edges_) {
    Box3 box;
    for (const int corner : edge.corner) box.extend(corners_[static_cast<std::size_t>(corner)].place);
    if (touched(box)) edge.state = Edge::State::unknown, edge.zeros = 0;
  }
  for (Cell& cell : cells_) {
    Box3 box;
    for (const int corner : corners_of(cell)) box.extend(corners_[static_cast<std::size_t>(corner)].place);
    if (touched(box)) cell.built = false;
  }
}

}  // namespace ostia::lumen
