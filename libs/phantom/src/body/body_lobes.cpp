#include "body/body_organs.h"

#include "ostia/geometry/polyline.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace ostia::phantom {
namespace {

constexpr std::uint64_t lobe_stream = 0x4c4f42455300ULL;
constexpr double lobe_reach_mm = 12.0;

enum class Cavity { left_auricle, left_atrium, right_auricle, right_atrium, pulmonary_trunk };

/// Where a cavity lies beside an artery: a lobe begins between these abscissas.
struct LobePlace {
  std::string_view artery;
  double from_mm, to_mm;
  Cavity cavity;
};
constexpr std::array<LobePlace, 9> lobe_places{{{"LCX", 4.0, 14.0, Cavity::left_auricle},
                                                {"LCX", 24.0, 40.0, Cavity::left_atrium},
                                                {"LAD", 6.0, 14.0, Cavity::pulmonary_trunk},
                                                {"LAD", 14.0, 30.0, Cavity::left_auricle},
                                                {"D1", 8.0, 16.0, Cavity::left_auricle},
                                                {"OM1", 8.0, 14.0, Cavity::left_auricle},
                                                {"RCA", 10.0, 22.0, Cavity::right_auricle},
                                                {"RCA", 32.0, 50.0, Cavity::right_atrium},
                                                {"RCA", 62.0, 90.0, Cavity::right_atrium}}};

Vec3 middle_of(Cavity cavity, const HeartFrame& f) {
  switch (cavity) {
    case Cavity::left_auricle:
      return {34, 16, 46};
    case Cavity::left_atrium:
      return f.world(-17.0 * f.wide, -9.0, -21.5);
    case Cavity::right_auricle:
      return f.world(36.0 * f.wide, 12.0, -17.0);
    case Cavity::right_atrium:
      return f.world(34.0 * f.wide, -7.0, -22.5);
    case Cavity::pulmonary_trunk:
      break;
  }
  return {16, -26, 44};
}

Material blood_in(Cavity cavity, const TissueHu& hu) {
  switch (cavity) {
    case Cavity::left_auricle:
      return {Label::left_atrium, hu.arterial - 14.0f};
    case Cavity::left_atrium:
      return {Label::left_atrium, hu.arterial - 4.0f};
    case Cavity::right_auricle:
    case Cavity::right_atrium:
      return {Label::right_atrium, hu.right_heart};
    case Cavity::pulmonary_trunk:
      break;
  }
  return {Label::pulmonary_artery, hu.pulmonary};
}

/// As much of each piece as keeps the gap; what is left too thin goes.
Capsules kept_clear(Capsules pieces, const VesselField& field, double gap_mm, double least_mm) {
  Capsules out;
  for (Capsule piece : pieces) {
    double most = 1e9;
    for (const double t : {0.0, 0.5, 1.0})
      most = std::min(
          most,
          field.value(Boundary::wall, piece.from + t * (piece.to - piece.from), lobe_reach_mm) - gap_mm);
    if (most < least_mm) continue;
    piece.from_radius = std::min(piece.from_radius, most);
    piece.to_radius = std::min(piece.to_radius, most);
    out.push_back(piece);
  }
  return out;
}

/// Along the artery, on the side where the cavity lies.
Capsules lobe_along(const CoronaryVessel& artery, double s_from, double length, double radius, double gap,
                    const Vec3& cavity, const VesselField& field) {
  constexpr double step_mm = 2.5;
  std::vector<Vec3> way;
  std::vector<double> radii;
  for (double s = 0.0; s <= length; s += step_mm) {
    const geometry::PolylineLocation at = geometry::at_abscissa(artery.axis.points, s_from + s);
    const Vec3& tangent = artery.axis.frames[at.segment].tangent;
    Vec3 aside = cavity - at.point;
    aside -= tangent * tangent.dot(aside);
    if (aside.norm() < 1.0) continue;
    const double own = radius * (0.45 + 0.55 * std::sin(std::numbers::pi * s / length));
    way.push_back(at.point + (artery.wall.max_at(s_from + s) + gap + own) * aside.normalized());
    radii.push_back(own);
  }
  if (way.size() < 4) return {};
  return kept_clear(tube(way, radii, 1.5), field, gap, 0.6);
}

}  // namespace

void add_lobes(Organs& organs, const HeartShape& heart, const CoronaryTree& tree, const VesselField& field,
               const HeartWarp* warp, const BodyOptions& options) {
  if (options.lobes <= 0.0) return;
  const HeartFrame frame(heart);
  Capsules walls;
  for (std::size_t n = 0; n < lobe_places.size(); ++n) {
    const LobePlace& place = lobe_places[n];
    const auto draw = [&](std::uint64_t k) { return uniform(options.seed, lobe_stream + 16 * n + k); };
    if (draw(0) >= options.lobes) continue;
    const auto artery = std::ranges::find(tree.vessels, place.artery, &CoronaryVessel::name);
    if (artery == tree.vessels.end()) continue;
    const double s_from = place.from_mm + draw(1) * (place.to_mm - place.from_mm),
                 length = 10.0 + 18.0 * draw(2);
    if (s_from + length > artery->axis.abscissa.back() - 3.0) continue;
    const Vec3 own = middle_of(place.cavity, frame);
    const Capsules lobe = lobe_along(*artery, s_from, length, 1.6 + 3.0 * draw(3), 0.05 + 0.6 * draw(4),
                                     warp == nullptr ? own : warp->to_world(own), field);
    if (lobe.empty()) continue;
    organs.push_back({blood_in(place.cavity, options.hu), {14.0f, 4.0f, 0.0f}, {}, lobe, true});
    append(walls, grown(lobe, 0.8));
  }
  if (!walls.empty())
    organs.push_back(
        {{Label::myocardium, options.hu.myocardium - 15.0f}, {9.0f, 7.0f, 0.0f}, {}, walls, true});
}

}  // namespace ostia::phantom
