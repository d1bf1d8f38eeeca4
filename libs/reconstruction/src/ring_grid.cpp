#include "ring_grid.h"

#include "ostia/core/error.h"

#include <array>
#include <string>

namespace ostia::reconstruction {
namespace {

[[noreturn]] void out_of_order(std::size_t branch) {
  throw GeometryError("the quadrilaterals of branch " + std::to_string(branch) +
                      " do not follow each other ring by ring: was the surface changed?");
}

/// The points of one quadrilateral of level 0 after all subdivisions: `at(x, y)`, x from its corner 0 to 1.
class Patch {
 public:
  Patch(const std::vector<geometry::Quad>& quads, int level)
      : quads_(quads), side_(std::size_t{1} << level), points_((side_ + 1) * (side_ + 1)) {}

  void fill(std::size_t quad, int level) { fill(quad, level, 0, 0, 0); }
  std::int32_t at(std::size_t x, std::size_t y) const { return points_[y * (side_ + 1) + x]; }

 private:
  /// Its first corner lies at the place `turn` (0 to 3, counter-clockwise from the least x and y) of a square
  /// from x, y on; so does that of its child there: subdivision puts a quadrilateral's k-th child at its k-th
  /// corner, with that corner first.
  void fill(std::size_t quad, int level, std::size_t turn, std::size_t x, std::size_t y) {
    constexpr std::array<std::array<std::size_t, 2>, 4> places = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const std::size_t half = level > 0 ? std::size_t{1} << (level - 1) : 1;
    for (std::size_t place = 0; place < 4; ++place) {
      const std::size_t k = (place + 4 - turn) % 4;
      const std::size_t to_x = x + half * places[place][0], to_y = y + half * places[place][1];
      if (level > 0)
        fill(4 * quad + k, level - 1, place, to_x, to_y);
      else
        points_[to_y * (side_ + 1) + to_x] = quads_[quad][k];
    }
  }

  const std::vector<geometry::Quad>& quads_;
  std::size_t side_;
  std::vector<std::int32_t> points_;
};

/// Adds one ring of level 0's quadrilaterals, from `first` on.
void add_band(const ReconstructedSurface& surface, std::size_t first, std::size_t branch, RingGrid& grid) {
  const auto sides = static_cast<std::size_t>(surface.sides);
  const std::size_t parts = std::size_t{1} << surface.level;
  RingGrid band(parts + 1, std::vector<std::int32_t>(sides * parts));
  Patch patch(surface.quads, surface.level);
  std::vector<std::int32_t> end(parts + 1);  // beyond the last side
  for (std::size_t k = 0; k < sides; ++k) {
    patch.fill(first + k, surface.level);
    for (std::size_t y = 0; y <= parts; ++y) {
      if (k > 0 && patch.at(0, y) != end[y]) out_of_order(branch);
      for (std::size_t x = 0; x < parts; ++x) band[y][k * parts + x] = patch.at(x, y);
      end[y] = patch.at(parts, y);
    }
  }
  for (std::size_t y = 0; y <= parts; ++y)
    if (end[y] != band[y].front()) out_of_order(branch);
  if (!grid.empty() && grid.back() != band.front()) out_of_order(branch);
  grid.insert(grid.end(), band.begin() + (grid.empty() ? 0 : 1), band.end());
}

}  // namespace

std::vector<RingGrid> ring_grids(const ReconstructedSurface& surface) {
  const std::size_t each = std::size_t{1} << (2 * surface.level), coarse = surface.quads.size() / each;
  std::vector<RingGrid> grids(surface.axis_ends.size());
  for (std::size_t i = 0; i < coarse;) {
    const auto branch = static_cast<std::size_t>(surface.branch_of_quad[i * each]);
    if (surface.surface.face_ids[2 * i * each] != surface.surface.faces.front().id) {  // a cap
      ++i;
      continue;
    }
    if (i + static_cast<std::size_t>(surface.sides) > coarse) out_of_order(branch);
    add_band(surface, i, branch, grids[branch]);
    i += static_cast<std::size_t>(surface.sides);
  }
  return grids;
}

}  // namespace ostia::reconstruction
