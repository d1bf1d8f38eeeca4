#include "simple_point.h"

#include <array>
#include <bit>
#include <cstdlib>

namespace ostia::centerline::detail {
namespace {

using Masks = std::array<std::uint32_t, neighbour_count>;

constexpr int magnitude(int v) {
  return v < 0 ? -v : v;
}

constexpr int order(int n) {
  const Step s = neighbour_step(n);
  return magnitude(s.x) + magnitude(s.y) + magnitude(s.z);
}

constexpr std::uint32_t up_to_order(int most) {
  std::uint32_t mask = 0;
  for (int n = 0; n < neighbour_count; ++n)
    if (order(n) <= most) mask |= 1U << n;
  return mask;
}

// Neighbours of each neighbour, by faces alone or by all contacts.
constexpr Masks adjacency(bool faces_only) {
  Masks masks{};
  for (int a = 0; a < neighbour_count; ++a)
    for (int b = 0; b < neighbour_count; ++b) {
      const Step s = neighbour_step(a), t = neighbour_step(b);
      const int dx = magnitude(s.x - t.x), dy = magnitude(s.y - t.y), dz = magnitude(s.z - t.z);
      const bool near = faces_only ? dx + dy + dz == 1 : dx <= 1 && dy <= 1 && dz <= 1;
      if (a != b && near) masks[static_cast<std::size_t>(a)] |= 1U << b;
    }
  return masks;
}

constexpr std::uint32_t faces = up_to_order(1);
constexpr std::uint32_t faces_and_edges = up_to_order(2);
constexpr Masks by_faces = adjacency(true);
constexpr Masks by_contact = adjacency(false);

// What is reached from the lowest bit of `from` within `within`.
std::uint32_t reached(std::uint32_t from, std::uint32_t within, const Masks& adjacent) {
  std::uint32_t seen = from & (~from + 1U);
  std::uint32_t open = seen;
  while (open != 0) {
    const auto n = static_cast<std::size_t>(std::countr_zero(open));
    open &= open - 1U;
    const std::uint32_t next = adjacent[n] & within & ~seen;
    seen |= next;
    open |= next;
  }
  return seen;
}

}  // namespace

bool is_simple(std::uint32_t neighbours) {
  if (neighbours == 0) return false;
  const std::uint32_t background = ~neighbours & faces_and_edges;
  const std::uint32_t open_faces = background & faces;
  if (open_faces == 0) return false;
  if ((open_faces & ~reached(open_faces, background, by_faces)) != 0) return false;
  return reached(neighbours, neighbours, by_contact) == neighbours;
}

}  // namespace ostia::centerline::detail
