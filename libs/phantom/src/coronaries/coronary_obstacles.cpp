#include "coronaries/coronary_obstacles.h"

#include "coronaries/coronary_disease.h"

#include "ostia/core/error.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

namespace ostia::phantom {
namespace {

using std::numbers::pi;
constexpr std::uint64_t obstacle_stream = 0x4f42535441434c45ULL;
constexpr int most_tries = 300;

class ObstacleDraw {
 public:
  explicit ObstacleDraw(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high) { return low + (high - low) * uniform(seed_, index_++); }

 private:
  std::uint64_t seed_, index_ = obstacle_stream;
};

/// A vessel of its name's share: the proximal and middle parts of the three main ones bear most disease.
CoronaryVessel* drawn_vessel(CoronaryTree& tree, ObstacleDraw& draw) {
  constexpr std::array<std::pair<std::string_view, double>, 4> shares{
      {{"LAD", 0.4}, {"RCA", 0.35}, {"LCX", 0.18}, {"D1", 0.07}}};
  double p = draw.between(0.0, 1.0);
  std::string_view name = shares.back().first;
  for (const auto& [one, share] : shares) {
    if (p < share) {
      name = one;
      break;
    }
    p -= share;
  }
  const auto found = std::ranges::find(tree.vessels, name, &CoronaryVessel::name);
  return found == tree.vessels.end() ? nullptr : &*found;
}

bool clear_of_sections(const std::vector<AnnotatedSection>& sections, const CoronaryVessel& vessel,
                       double from_mm, double to_mm) {
  return std::ranges::none_of(sections, [&](const AnnotatedSection& one) {
    return one.vessel == vessel.id && one.s_from_mm < to_mm + 2.0 && one.s_to_mm > from_mm - 2.0;
  });
}

/// Where a stretch of this length may lie in the vessel's first share; none where the draw met no room.
std::optional<double> drawn_place(const CoronaryTree& tree, const std::vector<AnnotatedSection>& sections,
                                  const CoronaryVessel& vessel, double length_mm, double first_share,
                                  ObstacleDraw& draw) {
  const double lowest = vessel.s_free_mm + 2.5,
               highest = first_share * vessel.axis.abscissa.back() - length_mm;
  const double from = draw.between(lowest, std::max(lowest, highest)), to = from + length_mm;
  if (!free_for_lesion(tree, vessel, from, to) || !clear_of_sections(sections, vessel, from, to)) return {};
  return from;
}

/// A chain of lumps that overlap and wander about the lumen's side.
void add_lumps(CoronaryVessel& vessel, double from_mm, double to_mm, double theta, ObstacleDraw& draw) {
  for (double s = from_mm + 1.5; s < to_mm - 1.0; s += draw.between(2.5, 5.0)) {
    Plaque lump;
    lump.kind = PlaqueKind::calcified;
    lump.s_centre_mm = s;
    lump.length_mm = draw.between(5.0, 9.0);
    lump.theta_centre = theta + draw.between(-0.5, 0.5);
    lump.theta_extent = draw.between(100.0, 240.0) * pi / 180.0;
    lump.depth_from = draw.between(0.02, 0.15);
    lump.depth_to = 0.97;
    lump.hu = static_cast<float>(draw.between(700.0, 1500.0));
    vessel.plaques.push_back(lump);
  }
}

LesionOptions stretch_lesion(double from_mm, double length_mm, ObstacleDraw& draw) {
  LesionOptions lesion;
  lesion.s_throat_mm = from_mm + 0.5 * length_mm;
  lesion.length_mm = length_mm;
  lesion.theta = draw.between(0.0, 2.0 * pi);
  lesion.plateau = 0.6;
  lesion.kind = PlaqueKind::fibrous;
  lesion.seed = static_cast<std::uint64_t>(draw.between(1.0, 1e9));
  return lesion;
}

void add_long_calcium(CoronaryTree& tree, double total_mm, const std::vector<AnnotatedSection>& sections,
                      ObstacleDraw& draw) {
  constexpr double shortest_mm = 8.0, longest_mm = 38.0, first_share = 0.75;
  for (int tries = 0; tries < most_tries && total_mm > 0.5 * shortest_mm; ++tries) {
    CoronaryVessel* const vessel = drawn_vessel(tree, draw);
    const double length = std::min(draw.between(shortest_mm, longest_mm), std::max(shortest_mm, total_mm));
    if (vessel == nullptr) continue;
    const auto from = drawn_place(tree, sections, *vessel, length, first_share, draw);
    if (!from) continue;
    LesionOptions lesion = stretch_lesion(*from, length, draw);
    lesion.diameter_stenosis = draw.between(0.05, 0.45);
    lesion.eccentricity = draw.between(0.2, 0.9);
    lesion.remodelling = draw.between(1.05, 1.35);
    add_lesion(*vessel, lesion);
    add_lumps(*vessel, *from, *from + length, lesion.theta, draw);
    total_mm -= length;
  }
}

void add_closed_stretches(CoronaryTree& tree, const Obstacles& obstacles,
                          const std::vector<AnnotatedSection>& sections, ObstacleDraw& draw) {
  constexpr double first_share = 0.65;
  auto left = std::lround(obstacles.closed);
  for (int tries = 0; tries < most_tries && left > 0; ++tries) {
    CoronaryVessel* const vessel = drawn_vessel(tree, draw);
    const double length = draw.between(6.0, 25.0);
    if (vessel == nullptr || !vessel->occlusions.empty()) continue;
    const auto from = drawn_place(tree, sections, *vessel, length, first_share, draw);
    if (!from) continue;
    LesionOptions lesion = stretch_lesion(*from, length, draw);
    lesion.diameter_stenosis = draw.between(0.9, 0.95);
    lesion.eccentricity = 0.0;
    lesion.remodelling = 1.0;
    lesion.kind = draw.between(0.0, 1.0) < 0.5 ? PlaqueKind::mixed : PlaqueKind::soft;
    add_lesion(*vessel, lesion);
    vessel->occlusions.push_back({*from, *from + length, obstacles.filling});
    --left;
  }
}

void require_obstacle(const char* name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw InvalidInput(std::string("obstacles: ") + name + " is " + std::to_string(value) +
                       "; it must lie in [" + std::to_string(least) + ", " + std::to_string(most) + "]");
}

}  // namespace

void validate(const Obstacles& o) {
  require_obstacle("calibre", o.calibre, 0.5, 1.3);
  if (!(o.contrast_fall < 0.0)) require_obstacle("contrast_fall", o.contrast_fall, 0.0, 0.6);
  require_obstacle("vein_closeness", o.vein_closeness, 0.0, 1.0);
  require_obstacle("lobes", o.lobes, 0.0, 1.0);
  require_obstacle("groove_fat", o.groove_fat, 0.1, 1.0);
  require_obstacle("calcified_mm", o.calcified_mm, 0.0, 300.0);
  require_obstacle("closed", o.closed, 0.0, 3.0);
  require_obstacle("filling", o.filling, 0.1, 1.0);
}

void add_obstacles(CoronaryTree& tree, const Obstacles& obstacles,
                   const std::vector<AnnotatedSection>& sections, std::uint64_t seed) {
  ObstacleDraw draw(seed);
  add_closed_stretches(tree, obstacles, sections, draw);
  add_long_calcium(tree, obstacles.calcified_mm, sections, draw);
}

}  // namespace ostia::phantom
