#include "scene/wall_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace ostia::view {
namespace {

using geometry::Vec3;
using lumen::ContourLine;

/// Where an edge of the surface goes through the view, and the crossings beside it on the line.
struct Crossing {
  Vec2 px;
  Vec3 world;
  std::array<std::int32_t, 2> next{-1, -1};
  bool taken = false;

  int neighbours() const { return (next[0] >= 0 ? 1 : 0) + (next[1] >= 0 ? 1 : 0); }
  bool join(std::int32_t other) {
    for (std::int32_t& place : next)
      if (place < 0) {
        place = other;
        return true;
      }
    return false;
  }
};

class Cutter {
 public:
  Cutter(const geometry::TriMesh& wall, const std::function<std::optional<SeenCorner>(std::size_t)>& seen)
      : wall_(wall), seen_(seen) {}

  void add(const geometry::Triangle& triangle, double widest_px) {
    std::array<const SeenCorner*, 3> corner{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::optional<SeenCorner>& known = corner_of(static_cast<std::size_t>(triangle[c]));
      if (!known) return;
      corner[c] = &*known;
    }
    std::array<std::int32_t, 2> ends{};
    std::size_t count = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3;
      if ((corner[c]->px - corner[d]->px).norm() > widest_px) return;
    }
    for (std::size_t c = 0; c < 3 && count < 2; ++c) {
      const std::size_t d = (c + 1) % 3;
      if ((corner[c]->out_mm < 0.0) == (corner[d]->out_mm < 0.0)) continue;
      ends[count++] = crossing(triangle[c], triangle[d], *corner[c], *corner[d]);
    }
    if (count < 2) return;
    // More than two triangles at an edge: what is more begins a line of its own.
    if (crossings_[index(ends[0])].neighbours() > 1 || crossings_[index(ends[1])].neighbours() > 1) return;
    crossings_[index(ends[0])].join(ends[1]);
    crossings_[index(ends[1])].join(ends[0]);
  }

  std::vector<ContourLine> lines() {
    std::vector<ContourLine> all;
    for (const bool open : {true, false})
      for (std::size_t i = 0; i < crossings_.size(); ++i)
        if (!crossings_[i].taken && (!open || crossings_[i].neighbours() == 1)) all.push_back(line_from(i));
    std::erase_if(all, [](const ContourLine& line) { return line.picture_px.size() < 2; });
    return all;
  }

 private:
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  const std::optional<SeenCorner>& corner_of(std::size_t point) {
    const auto [place, is_new] = corners_.try_emplace(point);
    if (is_new) place->second = seen_(point);
    return place->second;
  }

  std::int32_t crossing(std::int32_t a, std::int32_t b, const SeenCorner& at_a, const SeenCorner& at_b) {
    const auto low = static_cast<std::uint64_t>(std::min(a, b)),
               high = static_cast<std::uint64_t>(std::max(a, b));
    const auto [place, is_new] =
        by_edge_.try_emplace((high << 32U) | low, static_cast<std::int32_t>(crossings_.size()));
    if (is_new) {
      const double t = at_a.out_mm / (at_a.out_mm - at_b.out_mm);
      crossings_.push_back({(1.0 - t) * at_a.px + t * at_b.px,
                            (1.0 - t) * wall_.points[index(a)] + t * wall_.points[index(b)]});
    }
    return place->second;
  }

  ContourLine line_from(std::size_t first) {
    ContourLine line;
    std::int32_t at = static_cast<std::int32_t>(first);
    while (at >= 0) {
      Crossing& here = crossings_[index(at)];
      here.taken = true;
      line.picture_px.push_back(here.px);
      line.world.push_back(here.world);
      std::int32_t on = -1;
      for (const std::int32_t next : here.next) {
        if (next >= 0 && !crossings_[index(next)].taken) on = next;
      }
      const bool round =
          on < 0 && line.picture_px.size() > 2 &&
          std::find(here.next.begin(), here.next.end(), static_cast<std::int32_t>(first)) != here.next.end();
      if (round) {
        line.picture_px.push_back(line.picture_px.front());
        line.world.push_back(line.world.front());
      }
      at = on;
    }
    return line;
  }

  const geometry::TriMesh& wall_;
  const std::function<std::optional<SeenCorner>(std::size_t)>& seen_;
  std::unordered_map<std::size_t, std::optional<SeenCorner>> corners_;
  std::unordered_map<std::uint64_t, std::int32_t> by_edge_;
  std::vector<Crossing> crossings_;
};

}  // namespace

std::vector<ContourLine> wall_cut(const geometry::TriMesh& wall, const std::vector<double>& out_mm,
                                  double slack_mm, double widest_px,
                                  const std::function<std::optional<SeenCorner>(std::size_t)>& seen) {
  Cutter cutter(wall, seen);
  for (const geometry::Triangle& t : wall.triangles) {
    const double a = out_mm[static_cast<std::size_t>(t[0])], b = out_mm[static_cast<std::size_t>(t[1])],
                 c = out_mm[static_cast<std::size_t>(t[2])];
    // Written so that NaN is left out.
    if (!(std::min({a, b, c}) <= slack_mm && std::max({a, b, c}) >= -slack_mm)) continue;
    if (std::isnan(a) || std::isnan(b) || std::isnan(c)) continue;
    cutter.add(t, widest_px);
  }
  return cutter.lines();
}

}  // namespace ostia::view
