#include "contours/cell_split.h"

#include "contours/edge_roots.h"

#include <algorithm>
#include <map>

namespace ostia::lumen {
namespace {

constexpr int deepest = 6;

using Seed = std::optional<std::pair<Vec2, double>>;

// A zero on the way around, and whether the lumen ends there.
struct CornerTurn {
  int zero = 0;
  bool lumen_ends = false;
};

std::vector<CornerTurn> turns_around(const CellOutline& cell) {
  std::vector<CornerTurn> turns;
  bool in = inside(cell.value[0]);
  for (const std::vector<int>& edge : cell.zeros) {
    for (const int zero : edge) {
      turns.push_back({zero, in});
      in = !in;
    }
  }
  return turns;
}

std::vector<int> backwards(std::vector<int> zeros) {
  std::reverse(zeros.begin(), zeros.end());
  return zeros;
}

class Splitter {
 public:
  explicit Splitter(const CellField& field) : field_(field) {}

  void join(const CellOutline& cell, const Seed& seed, int depth) {
    const std::vector<CornerTurn> turns = turns_around(cell);
    const bool hidden = turns.empty() && seed && inside(seed->second) != inside(cell.value[0]);
    if (turns.empty() && !hidden) return;
    if (turns.size() == 2) return add(turns[0], turns[1]);
    if (depth < deepest) return split(cell, seed, depth);
    if (!turns.empty()) join_many(cell, turns);
  }

  /// Stretches joined to lines: those that begin and end on the outline, then closed ones.
  std::vector<CellLine> lines(const CellOutline& outline) {
    std::vector<CellLine> found;
    for (const CornerTurn& turn : turns_around(outline))
      if (!turn.lumen_ends) found.push_back(line_from(turn.zero));
    while (!next_.empty()) found.push_back(line_from(next_.begin()->first));
    std::erase_if(found, [](const CellLine& line) { return line.zeros.size() < 2; });
    return found;
  }

 private:
  // Lines begin where, going around clockwise, the lumen begins, and end where it ends.
  void add(const CornerTurn& p, const CornerTurn& q) {
    if (p.lumen_ends)
      next_[q.zero] = p.zero;
    else
      next_[p.zero] = q.zero;
  }

  // Saddles below the smallest cell: the value in the middle tells whether the lumen or what is outside it
  // runs through.
  void join_many(const CellOutline& cell, const std::vector<CornerTurn>& turns) {
    const bool through =
        inside(field_.value(0.25 * (cell.corner[0] + cell.corner[1] + cell.corner[2] + cell.corner[3])));
    for (std::size_t i = 0; i < turns.size(); ++i) {
      const CornerTurn& after = turns[(i + 1) % turns.size()];
      if (turns[i].lumen_ends == through) add(turns[i], after);
    }
  }

  struct Half {
    std::vector<int> first, second;
    Vec2 px;
    double value = 0.0;
  };
  Half halved(const CellOutline& cell, std::size_t edge) const {
    const Vec2 &p = cell.corner[edge], &q = cell.corner[(edge + 1) % 4];
    Half half;
    half.px = 0.5 * (p + q);
    const Vec2 way = q - p;
    for (const int zero : cell.zeros[edge]) {
      const bool before = (field_.zero_px(zero) - half.px).dot(way) < 0.0;
      (before ? half.first : half.second).push_back(zero);
    }
    half.value = with_sign(field_.value(half.px), inside(cell.value[edge]) != (half.first.size() % 2 == 1));
    return half;
  }
  /// What the zeros say wins over a value that is zero to round-off.
  static double with_sign(double value, bool in) {
    if (inside(value) == in) return value;
    return in ? -1e-12 : 1e-12;
  }

  void split(const CellOutline& cell, const Seed& seed, int depth) {
    std::array<Half, 4> half;
    for (std::size_t k = 0; k < 4; ++k) half[k] = halved(cell, k);
    const Vec2 middle = 0.5 * (half[0].px + half[2].px);
    const double value = field_.value(middle);
    std::array<std::vector<int>, 4> spoke;  // from the middle of each edge to the middle of the cell
    for (std::size_t k = 0; k < 4; ++k)
      spoke[k] = field_.zeros_between(half[k].px, half[k].value, middle, value);
    for (std::size_t k = 0; k < 4; ++k) {
      // Corner k with the half edges at it; kept in the order of the outline from its own corner.
      const std::size_t before = (k + 3) % 4;
      CellOutline part;
      part.corner = {cell.corner[k], half[k].px, middle, half[before].px};
      part.value = {cell.value[k], half[k].value, value, half[before].value};
      part.zeros = {half[k].first, spoke[k], backwards(spoke[before]), half[before].second};
      join(part, within(part, seed) ? seed : std::nullopt, depth + 1);
    }
  }
  static bool within(const CellOutline& part, const Seed& seed) {
    if (!seed) return false;
    const Vec2 low = part.corner[0].cwiseMin(part.corner[2]), high = part.corner[0].cwiseMax(part.corner[2]);
    return (seed->first.array() >= low.array()).all() && (seed->first.array() <= high.array()).all();
  }

  CellLine line_from(int zero) {
    CellLine line;
    line.zeros.push_back(zero);
    for (auto found = next_.find(zero); found != next_.end(); found = next_.find(line.zeros.back())) {
      line.zeros.push_back(found->second);
      next_.erase(found);
    }
    return line;
  }

  const CellField& field_;
  std::map<int, int> next_;
};

}  // namespace

std::vector<CellLine> lines_in_cell(const CellOutline& cell, const CellField& field, const Seed& seed) {
  Splitter splitter(field);
  splitter.join(cell, seed, 0);
  return splitter.lines(cell);
}

}  // namespace ostia::lumen
