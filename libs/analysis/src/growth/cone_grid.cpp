#include "growth/cone_grid.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

using geometry::Vec3;

std::uint64_t key_of(int level, std::int64_t i, std::int64_t j, std::int64_t k) {
  constexpr std::uint64_t mask = 0xfffff;  // cells a million apart share a key: asked about in vain, no more
  return (static_cast<std::uint64_t>(level) << 60U) | ((static_cast<std::uint64_t>(i) & mask) << 40U) |
         ((static_cast<std::uint64_t>(j) & mask) << 20U) | (static_cast<std::uint64_t>(k) & mask);
}

double squared_distance_to_axis(const RoundCone& cone, const Vec3& point) {
  const Vec3 along = cone.to - cone.from;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - cone.from).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (cone.from + t * along - point).squaredNorm();
}

}  // namespace

ConeGrid::ConeGrid(double cell_mm) : slots_(1U << 16U, Slot{0, -1}) {
  for (double& size : cells_) {
    size = cell_mm;
    cell_mm *= 8.0;
  }
}

template <class Visit>
bool ConeGrid::visit_cells(int level, const RoundCone& cone, const Visit& visit) const {
  const double size = cell(level), widest = std::max(cone.radius_from, cone.radius_to);
  const double near = widest + 0.8661 * size;
  std::array<std::int64_t, 3> low{}, high{};
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    low[at] = static_cast<std::int64_t>(std::floor((std::min(cone.from[a], cone.to[a]) - widest) / size));
    high[at] = static_cast<std::int64_t>(std::floor((std::max(cone.from[a], cone.to[a]) + widest) / size));
  }
  const bool few = (high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1) <= 2;
  for (std::int64_t i = low[0]; i <= high[0]; ++i)
    for (std::int64_t j = low[1]; j <= high[1]; ++j)
      for (std::int64_t k = low[2]; k <= high[2]; ++k) {
        const Vec3 centre = size * Vec3(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5,
                                        static_cast<double>(k) + 0.5);
        if (!few && squared_distance_to_axis(cone, centre) > near * near) continue;
        if (visit(key_of(level, i, j, k))) return true;
      }
  return false;
}

std::size_t ConeGrid::slot_of(std::uint64_t key) const {
  std::size_t at =
      static_cast<std::size_t>((key ^ (key >> 29U)) * 0x9e3779b97f4a7c15ULL >> 20U) & (slots_.size() - 1);
  while (slots_[at].head >= 0 && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
  return at;
}

void ConeGrid::grow() {
  std::vector<Slot> old(slots_.size() * 2, Slot{0, -1});
  old.swap(slots_);
  for (const Slot& slot : old)
    if (slot.head >= 0) slots_[slot_of(slot.key)] = slot;
}

void ConeGrid::add(std::int32_t edge, const RoundCone& cone) {
  const double widest = std::max(cone.radius_from, cone.radius_to);
  const double extent = (cone.to - cone.from).cwiseAbs().maxCoeff() + 2.0 * widest;
  int level = 0;
  while (level + 1 < levels && extent > 4.0 * cell(level)) ++level;
  ++used_[static_cast<std::size_t>(level)];
  visit_cells(level, cone, [&](std::uint64_t key) {
    if (2 * taken_ > slots_.size()) grow();
    Slot& slot = slots_[slot_of(key)];
    if (slot.head < 0) ++taken_;
    slot.key = key;
    entries_.push_back({edge, slot.head});
    slot.head = static_cast<std::int32_t>(entries_.size()) - 1;
    return false;
  });
}

bool ConeGrid::any_near(const RoundCone& cone, const std::function<bool(std::int32_t)>& hits) const {
  for (int level = levels - 1; level >= 0; --level) {
    if (used_[static_cast<std::size_t>(level)] == 0) continue;
    const bool found = visit_cells(level, cone, [&](std::uint64_t key) {
      for (std::int32_t e = slots_[slot_of(key)].head; e >= 0; e = entries_[static_cast<std::size_t>(e)].next)
        if (hits(entries_[static_cast<std::size_t>(e)].edge)) return true;
      return false;
    });
    if (found) return true;
  }
  return false;
}

}  // namespace ostia::analysis
