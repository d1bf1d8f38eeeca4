#pragma once
/// \file Follows contour lines through the cells of a view, remembering what was evaluated.

#include "contours/cell_split.h"
#include "contours/edge_roots.h"
#include "contours/view_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::lumen {

/// Everything that is kept depends on the field where it lies alone, never on the way lines were followed;
/// which cells are passed is found anew in each trace. So a trace after `forget` equals a fresh one.
class ContourTracer {
 public:
  ContourTracer(ViewSurface view, const std::vector<Vec2>& seeds, const ContourLineOptions& options);

  std::vector<ContourLine> trace(const ScalarField& field);
  /// What lies in the box is evaluated again.
  void forget(const Box3& changed);
  std::size_t evaluations() const { return evaluations_; }  ///< of the last trace

 private:
  struct Corner {
    int column = 0, row = 0;
    Vec2 px;
    Vec3 place;
    double value = 0.0;
    bool known = false;
    int run = 0;              // in which `walked` was set
    std::uint8_t walked = 0;  // a bit for each direction
  };
  struct Seed {
    Vec2 px;
    Vec3 place;
    double value = 0.0;
    bool known = false;
  };
  // Where the line that comes out of a zero goes on.
  struct Onward {
    int cell = -1, line = -1;
    bool entered = false;
  };
  struct Edge {
    int column = 0, row = 0;
    bool upright = false;
    std::array<int, 2> corner{};
    enum class State { unknown, probing, clear, bracketed, solved } state = State::unknown;
    DipProbe probe;
    int zeros = 0;
    std::array<Bracket, 2> bracket{};
    std::array<ContourPoint, 2> zero{};
    int run = 0;
    std::array<Onward, 2> onward{};
  };
  // A stretch of a line within a cell. `from` and `to` are 2 * edge + number of the zero, -1 in closed ones.
  struct Line {
    int from = -1, to = -1;
    std::vector<ContourPoint> points;
  };
  struct Cell {
    int column = 0, row = 0;
    std::array<int, 4> edge{};  // top, right, bottom, left
    int run = 0;
    int seed = -1;  // whose sign differs from the corner next to it
    int built_with_seed = -1;
    bool built = false;
    std::vector<Line> lines;
  };
  struct Chord;  // between two neighbouring points of a line

  void evaluate(const std::vector<Vec3>& places, std::vector<double>& values);
  double evaluate(const Vec2& px, Vec3& place);
  int corner_at(int column, int row);
  int edge_at(int column, int row, bool upright);
  int cell_at(int column, int row);
  std::array<int, 4> corners_of(const Cell& cell) const;
  double edge_length(const Edge& edge) const;
  Vec2 on_edge(const Edge& edge, double t) const;
  Vec3 place_on_edge(const Edge& edge, double t);

  void want(int corner);
  void evaluate_wanted();
  void start_from_seeds();
  void walk(std::vector<std::array<int, 2>> walkers);
  void enter(int column, int row);
  void enter_beside(const Edge& edge);
  void follow();
  void classify(int edge);
  void take_probe(int edge);
  void solve_edges();
  void build_cells();
  void build(Cell& cell);
  void straighten_bends(const std::vector<int>& fresh);
  void pull_onto_wall(std::vector<Chord>& chords);
  ContourLine line_from(Onward at);
  std::vector<ContourLine> chained();

  ViewGrid grid_;
  ContourLineOptions options_;
  std::vector<Seed> seeds_;
  TiledIndex corner_index_, edge_index_[2], cell_index_;
  std::vector<Corner> corners_;
  std::vector<Edge> edges_;
  std::vector<Cell> cells_;

  const ScalarField* field_ = nullptr;  // during a trace
  double slope_ = 1.0;
  int run_ = 0;
  std::size_t evaluations_ = 0;
  std::vector<int> wanted_, frontier_, probing_, active_;  // of corners, cells, edges, cells
};

}  // namespace ostia::lumen
