#include "coronaries/coronary_disease.h"

#include "coronaries/coronary_calibre.h"

#include "ostia/core/error.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::phantom {
namespace {

using std::numbers::pi;
constexpr std::uint64_t disease_stream = 0x4449534500000000;

/// 1 at the throat, 0 from the shoulders on; smooth, with a plateau.
double narrowing_at(double s_mm, const LesionOptions& lesion) {
  const double x = 2.0 * std::abs(s_mm - lesion.s_throat_mm) / lesion.length_mm;
  if (x >= 1.0) return 0.0;
  const double y = std::max(0.0, (x - lesion.plateau) / (1.0 - lesion.plateau));
  return 0.5 * (1.0 + std::cos(pi * y));
}

void require(bool good, const std::string& what) {
  if (!good) throw InvalidInput("lesion: " + what);
}

double healthy_radius(const CoronaryVessel& vessel, double s_mm) {
  const auto& s = vessel.axis.abscissa;
  const auto at = std::lower_bound(s.begin(), s.end(), s_mm) - s.begin();
  const std::size_t j = std::clamp<std::size_t>(static_cast<std::size_t>(at), 1, s.size() - 1);
  const double t = std::clamp((s_mm - s[j - 1]) / (s[j] - s[j - 1]), 0.0, 1.0);
  return (1.0 - t) * vessel.healthy_radius_mm[j - 1] + t * vessel.healthy_radius_mm[j];
}

/// What is left of the radius at each angle where the narrowing has reached the share `w` of its throat's: a
/// circle pushed away from the plaque. On the far side the narrowing is (1 - eccentricity) of the mean one.
std::vector<double> shares_left(const CoronaryVessel& vessel, const LesionOptions& lesion, double s_mm,
                                double w) {
  const int around = vessel.lumen.around();
  std::vector<double> shares(static_cast<std::size_t>(around), 1.0);
  if (w <= 0.0) return shares;
  const double mean = 1.0 - w * lesion.diameter_stenosis;
  const double most = 1.0 - w * lesion.diameter_stenosis * (1.0 - lesion.eccentricity);
  double radius = mean, shift = 0.0;
  for (int i = 0; i < 40; ++i) {  // mean of an off-centre circle: radius - shift^2 / (4 radius), about
    shift = std::min(most - radius, 0.8 * radius);
    radius = 0.5 * (radius + mean + shift * shift / (4.0 * radius));
  }
  double was_sum = 0.0, sum = 0.0;
  for (int c = 0; c < around; ++c) {
    const double theta = 2.0 * pi * c / around, angle = theta - lesion.theta;
    const double across = shift * std::sin(angle), was = vessel.lumen.at(s_mm, theta);
    const double left = std::sqrt(radius * radius - across * across) - shift * std::cos(angle);
    shares[static_cast<std::size_t>(c)] = left;
    was_sum += was;
    sum += was * left;
  }
  for (double& share : shares) share *= mean * was_sum / sum;
  return shares;
}

/// The profiles, sample by sample, with the lesion in them.
void reshape(CoronaryVessel& vessel, const LesionOptions& lesion) {
  const int around = vessel.lumen.around();
  const double step = vessel.lumen.step_mm();
  const auto rows = static_cast<int>(std::lround(vessel.lumen.length_mm() / step)) + 1;
  std::vector<double> lumen, wall;
  for (int row = 0; row < rows; ++row) {
    const double s = row * step, w = narrowing_at(s, lesion);
    const std::vector<double> shares = shares_left(vessel, lesion, s, w);
    for (int c = 0; c < around; ++c) {
      const double theta = 2.0 * pi * c / around, side = std::cos(theta - lesion.theta);
      const double was = vessel.lumen.at(s, theta), outer = vessel.wall.at(s, theta);
      const double narrowed = was * shares[static_cast<std::size_t>(c)];
      const double swollen =
          outer * (1.0 + w * (lesion.remodelling - 1.0) * (1.0 + 0.5 * lesion.eccentricity * side));
      lumen.push_back(narrowed);
      wall.push_back(std::max(swollen, narrowed + 0.2));
    }
  }
  vessel.lumen = RadialProfile(step, around, std::move(lumen));
  vessel.wall = RadialProfile(step, around, std::move(wall));
  for (std::size_t i = 0; i < vessel.axis.size(); ++i) {
    const double s = vessel.axis.abscissa[i];
    if (std::abs(s - lesion.s_throat_mm) < 0.5 * lesion.length_mm + 2.0)
      vessel.axis.radius[i] = vessel.lumen.mean_at(s);
  }
}

/// CT numbers of plaque: soft 10-60, fibrous 60-130, calcified 300-1,300 (usual values).
float plaque_hu(PlaqueKind kind, double draw) {
  switch (kind) {
    case PlaqueKind::soft:
      return static_cast<float>(15.0 + 40.0 * draw);
    case PlaqueKind::fibrous:
    case PlaqueKind::mixed:
      return static_cast<float>(70.0 + 50.0 * draw);
    case PlaqueKind::calcified:
      break;
  }
  return static_cast<float>(550.0 + 700.0 * draw);
}

void add_nodules(CoronaryVessel& vessel, double s_mm, double length_mm, double theta, int count,
                 std::uint64_t seed, std::uint64_t stream) {
  for (int i = 0; i < count; ++i) {
    const auto draw = [&](std::uint64_t k) {
      return uniform(seed, stream + 16 * static_cast<std::uint64_t>(i) + k);
    };
    Plaque nodule;
    nodule.kind = PlaqueKind::calcified;
    nodule.length_mm = 1.5 + 3.5 * draw(0);
    nodule.s_centre_mm = s_mm + 0.7 * length_mm * (draw(1) - 0.5);
    nodule.theta_centre = theta + 1.4 * (draw(2) - 0.5);
    nodule.theta_extent = (50.0 + 80.0 * draw(3)) * pi / 180.0;
    nodule.depth_from = 0.2 + 0.25 * draw(4);
    nodule.depth_to = 0.95;
    nodule.hu = plaque_hu(PlaqueKind::calcified, draw(5));
    vessel.plaques.push_back(nodule);
  }
}

}  // namespace

bool free_for_lesion(const CoronaryTree& tree, const CoronaryVessel& vessel, double from, double to) {
  if (from < vessel.s_free_mm + 2.0 || to > vessel.axis.abscissa.back() - 8.0) return false;
  for (const CoronaryVessel& child : tree.vessels) {
    if (child.parent == vessel.id && child.parent_s_mm > from - 3.0 && child.parent_s_mm < to + 3.0)
      return false;
  }
  return std::none_of(vessel.stenoses.begin(), vessel.stenoses.end(),
                      [&](const Stenosis& s) { return s.s_from_mm < to + 3.0 && s.s_to_mm > from - 3.0; });
}

void add_lesion(CoronaryVessel& vessel, const LesionOptions& lesion) {
  require(lesion.length_mm >= 2.0 && lesion.length_mm <= 40.0, "length_mm must lie in [2, 40]");
  require(lesion.diameter_stenosis >= 0.0 && lesion.diameter_stenosis <= 0.95,
          "diameter_stenosis must lie in [0, 0.95]");
  require(lesion.eccentricity >= 0.0 && lesion.eccentricity < 1.0, "eccentricity must lie in [0, 1)");
  require(lesion.diameter_stenosis * (1.0 + lesion.eccentricity) <= 0.97,
          "diameter_stenosis (1 + eccentricity) must not exceed 0.97: the lumen would close on one side");
  require(lesion.remodelling >= 1.0 && lesion.remodelling <= 1.5, "remodelling must lie in [1, 1.5]");
  require(lesion.plateau >= 0.0 && lesion.plateau <= 0.9, "plateau must lie in [0, 0.9]");
  const double from = lesion.s_throat_mm - 0.5 * lesion.length_mm, to = from + lesion.length_mm;
  require(from >= 0.0 && to <= vessel.axis.abscissa.back(),
          "it reaches from " + std::to_string(from) + " to " + std::to_string(to) + " mm, beyond " +
              vessel.name + " of " + std::to_string(vessel.axis.abscissa.back()) + " mm");
  reshape(vessel, lesion);
  Stenosis stenosis;
  stenosis.s_from_mm = from;
  stenosis.s_to_mm = to;
  stenosis.s_throat_mm = lesion.s_throat_mm;
  stenosis.eccentricity = lesion.eccentricity;
  stenosis.kind = lesion.kind;
  const double healthy = healthy_radius(vessel, lesion.s_throat_mm);
  stenosis.diameter_stenosis = 1.0 - vessel.lumen.mean_at(lesion.s_throat_mm) / healthy;
  stenosis.area_stenosis = 1.0 - vessel.lumen.area_at(lesion.s_throat_mm) / (pi * healthy * healthy);
  vessel.stenoses.push_back(stenosis);
  std::sort(vessel.stenoses.begin(), vessel.stenoses.end(),
            [](const Stenosis& a, const Stenosis& b) { return a.s_throat_mm < b.s_throat_mm; });

  const std::uint64_t stream = disease_stream + 4096;
  Plaque body;
  body.kind = lesion.kind == PlaqueKind::calcified ? PlaqueKind::fibrous : lesion.kind;
  body.s_centre_mm = lesion.s_throat_mm;
  body.length_mm = lesion.length_mm;
  body.theta_centre = lesion.theta;
  // A body that goes all the way round has no side; twice the turn keeps its taper from opening it in the
  // middle.
  body.theta_extent = lesion.eccentricity > 0.5 ? 1.5 * pi : 4.0 * pi;
  body.depth_to = 0.9;
  body.hu = plaque_hu(body.kind, uniform(lesion.seed, stream));
  vessel.plaques.push_back(body);
  if (lesion.kind == PlaqueKind::calcified || lesion.kind == PlaqueKind::mixed) {
    const int count = lesion.kind == PlaqueKind::calcified ? 4 : 2;
    add_nodules(vessel, lesion.s_throat_mm, lesion.length_mm, lesion.theta, count, lesion.seed, stream + 64);
  }
}

void set_calcium(CoronaryTree& tree, double amount, std::uint64_t seed) {
  if (!(amount >= 0.0 && amount <= 20.0))
    throw InvalidInput("calcium must lie in [0, 20], not " + std::to_string(amount));
  if (amount < 1.0) {
    if (amount > 0.0) return;
    for (CoronaryVessel& vessel : tree.vessels)
      for (Plaque& plaque : vessel.plaques)
        if (plaque.kind == PlaqueKind::calcified) {
          plaque.kind = PlaqueKind::fibrous;
          plaque.hu = plaque_hu(PlaqueKind::fibrous, 0.5);
        }
    return;
  }
  constexpr double spacing_mm = 12.0;
  const std::uint64_t stream = disease_stream + (std::uint64_t{1} << 24);
  for (CoronaryVessel& vessel : tree.vessels) {
    if (vessel.name != "LAD" && vessel.name != "LCX" && vessel.name != "RCA") continue;
    const double step = spacing_mm / std::max(1e-6, amount - 1.0);
    const double from = vessel.s_free_mm + 3.0, to = 0.67 * vessel.axis.abscissa.back();
    std::uint64_t index = static_cast<std::uint64_t>(vessel.id) << 16;
    for (double s = from; s < to; s += step, index += 64)
      add_nodules(vessel, s, std::min(step, 4.0), 2.0 * pi * uniform(seed, stream + index), 1, seed,
                  stream + index + 8);
  }
}

void add_stent(CoronaryVessel& vessel, double s_from_mm, double length_mm, bool struts) {
  const double length = vessel.axis.abscissa.back();
  if (!(s_from_mm >= 0.0 && length_mm > 0.0 && s_from_mm + length_mm <= length))
    throw InvalidInput("stent: it reaches from " + std::to_string(s_from_mm) + " to " +
                       std::to_string(s_from_mm + length_mm) + " mm, beyond " + vessel.name + " of " +
                       std::to_string(length) + " mm");
  constexpr float even_hu = 3000.0f, solid_hu = 14000.0f;  // of cobalt chromium, about
  vessel.stents.push_back({s_from_mm, s_from_mm + length_mm, 0.1, struts ? solid_hu : even_hu, struts});
}

void draw_disease(CoronaryTree& tree, double amount, std::uint64_t seed) {
  std::uint64_t index = disease_stream;
  const auto draw = [&] { return uniform(seed, index++); };
  const int lesions = static_cast<int>(std::floor(amount * (2.0 + 5.0 * draw())));
  for (int made = 0, tries = 0; made < lesions && tries < 200; ++tries) {
    const double which = draw();
    const std::string name = which < 0.38   ? "LAD"
                             : which < 0.66 ? "RCA"
                             : which < 0.84 ? "LCX"
                             : which < 0.92 ? "D1"
                                            : "OM1";
    LesionOptions lesion;
    lesion.length_mm = 6.0 + 12.0 * draw();
    const double place = std::pow(draw(), 1.4), severity = draw();
    lesion.diameter_stenosis = 0.2 + 0.62 * severity * severity;
    lesion.eccentricity = std::min(0.85 * draw(), 0.97 / lesion.diameter_stenosis - 1.01);
    lesion.theta = 2.0 * pi * draw();
    lesion.remodelling = 1.02 + 0.2 * draw();
    const double kind = draw();
    lesion.kind = kind < 0.3    ? PlaqueKind::soft
                  : kind < 0.45 ? PlaqueKind::fibrous
                  : kind < 0.75 ? PlaqueKind::mixed
                                : PlaqueKind::calcified;
    lesion.seed = seed + index;
    for (CoronaryVessel& vessel : tree.vessels) {
      if (vessel.name != name) continue;
      const double low = vessel.s_free_mm + 3.0, high = 0.75 * vessel.axis.abscissa.back();
      lesion.s_throat_mm = low + place * (high - low);
      lesion.eccentricity = std::max(0.0, lesion.eccentricity);
      if (!free_for_lesion(tree, vessel, lesion.s_throat_mm - 0.5 * lesion.length_mm,
                           lesion.s_throat_mm + 0.5 * lesion.length_mm))
        break;
      add_lesion(vessel, lesion);
      ++made;
    }
  }
}

}  // namespace ostia::phantom
