#include "ostia/analysis/high_risk_plaque.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

namespace ostia::analysis {
namespace {

using std::numbers::pi;

constexpr double calcium_reach_mm = 4.0;  // pieces of calcium are followed so far beyond the lesion
// A ray of a napkin ring: so much of the half at the lumen is of low attenuation, so much of the outer
// quarter is not.
constexpr double core_share = 2.0 / 3.0, rim_share = 2.0 / 3.0;

void require_high_risk(bool fine, const char* name, double value, const char* range) {
  if (fine && std::isfinite(value)) return;
  char text[200];
  std::snprintf(text, sizeof text, "high-risk plaque: %s is %g; it has to be in %s", name, value, range);
  throw InvalidInput(text);
}

/// Pieces of one class that touch each other.
struct PlaquePiece {
  double volume_mm3 = 0.0, size_mm = 0.0;
  double s_mm = 0.0, theta = 0.0;  // of its middle
};

/// The maps of a stretch as cells: slab, ray, piece of the wall.
class PlaqueCells {
 public:
  PlaqueCells(const PlaqueProfile& plaque, const std::vector<PlaqueMap>& maps, double from_mm, double to_mm)
      : plaque_(plaque), maps_(maps) {
    while (first_ < maps.size() && plaque.slabs[first_].s_mm < from_mm) ++first_;
    last_ = first_;
    while (last_ < maps.size() && plaque.slabs[last_].s_mm <= to_mm) ++last_;
    if (first_ < last_) around_ = maps[first_].around, deep_ = maps[first_].deep;
  }

  std::vector<PlaquePiece> pieces(PlaqueClass wanted) const {
    std::vector<char> open((last_ - first_) * cells_of_slab(), 0);
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = class_at(i) == wanted ? 1 : 0;
    std::vector<PlaquePiece> found;
    for (std::size_t i = 0; i < open.size(); ++i)
      if (open[i] != 0) found.push_back(taken(open, i));
    return found;
  }

 private:
  std::size_t cells_of_slab() const {
    return static_cast<std::size_t>(around_) * static_cast<std::size_t>(deep_);
  }
  std::size_t slab_of(std::size_t cell) const { return first_ + cell / cells_of_slab(); }
  int ray_of(std::size_t cell) const {
    return static_cast<int>(cell % cells_of_slab() / static_cast<std::size_t>(deep_));
  }
  int depth_of(std::size_t cell) const { return static_cast<int>(cell % static_cast<std::size_t>(deep_)); }
  std::optional<PlaqueClass> class_at(std::size_t cell) const {
    return maps_[slab_of(cell)].pieces[cell % cells_of_slab()];
  }
  /// Thickness of a piece, and the distance of its middle from the axis.
  std::pair<double, double> radial(std::size_t cell) const {
    const PlaqueMap& map = maps_[slab_of(cell)];
    const auto ray = static_cast<std::size_t>(ray_of(cell));
    const double thick = (map.outer_mm[ray] - map.lumen_mm[ray]) / deep_;
    return {thick, map.lumen_mm[ray] + (depth_of(cell) + 0.5) * thick};
  }

  std::vector<std::size_t> beside(std::size_t cell) const {
    std::vector<std::size_t> out;
    const auto deep = static_cast<std::size_t>(deep_);
    const std::size_t ray_begin = cell - static_cast<std::size_t>(depth_of(cell));
    const std::size_t slab_begin = cell - cell % cells_of_slab();
    const std::size_t in_ray = cell - ray_begin;
    if (in_ray > 0) out.push_back(cell - 1);
    if (in_ray + 1 < deep) out.push_back(cell + 1);
    const int ray = ray_of(cell);
    for (const int next : {(ray + 1) % around_, (ray + around_ - 1) % around_})
      out.push_back(slab_begin + static_cast<std::size_t>(next) * deep + in_ray);
    if (cell >= cells_of_slab()) out.push_back(cell - cells_of_slab());
    if (cell + cells_of_slab() < (last_ - first_) * cells_of_slab()) out.push_back(cell + cells_of_slab());
    return out;
  }

  PlaquePiece taken(std::vector<char>& open, std::size_t start) const {
    std::vector<std::size_t> members{start};
    open[start] = 0;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (const std::size_t next : beside(members[i]))
        if (open[next] != 0) open[next] = 0, members.push_back(next);
    return measured(members);
  }

  PlaquePiece measured(const std::vector<std::size_t>& members) const {
    PlaquePiece out;
    const double turn = 2.0 * pi / around_, length = plaque_.slabs[first_].volumes.length_mm;
    std::set<std::size_t> slabs;
    std::set<int> rays;
    double nearest = 1e9, farthest = 0.0, sum_rho = 0.0, x = 0.0, y = 0.0, along = 0.0;
    for (const std::size_t cell : members) {
      const auto [thick, rho] = radial(cell);
      const double volume = length * turn * rho * thick, theta = (ray_of(cell) + 0.5) * turn;
      out.volume_mm3 += volume;
      along += volume * plaque_.slabs[slab_of(cell)].s_mm;
      x += volume * std::cos(theta), y += volume * std::sin(theta);
      sum_rho += volume * rho;
      nearest = std::min(nearest, rho - 0.5 * thick), farthest = std::max(farthest, rho + 0.5 * thick);
      slabs.insert(slab_of(cell)), rays.insert(ray_of(cell));
    }
    if (!(out.volume_mm3 > 0.0)) return out;
    out.s_mm = along / out.volume_mm3;
    out.theta = std::atan2(y, x);
    const double arc = static_cast<double>(rays.size()) * turn * sum_rho / out.volume_mm3;
    out.size_mm = std::max({static_cast<double>(slabs.size()) * length, arc, farthest - nearest});
    return out;
  }

  const PlaqueProfile& plaque_;
  const std::vector<PlaqueMap>& maps_;
  std::size_t first_ = 0, last_ = 0;
  int around_ = 1, deep_ = 1;
};

FeatureConfidence by_margin(double value, double bound, double wide) {
  return std::abs(value - bound) >= wide * bound ? FeatureConfidence::high : FeatureConfidence::moderate;
}

double degrees_of(double theta) {
  const double turns = theta / (2.0 * pi);
  return 360.0 * (turns - std::floor(turns));
}

PlaqueFeatureFinding low_attenuation(const std::vector<PlaquePiece>& pieces, const HighRiskOptions& o) {
  PlaqueFeatureFinding out{PlaqueFeature::low_attenuation, true};
  out.bound = o.least_low_mm3;
  for (const PlaquePiece& one : pieces) {
    if (!(one.volume_mm3 > out.value)) continue;
    out.value = one.volume_mm3;
    out.s_mm = one.s_mm, out.theta_deg = degrees_of(one.theta);
  }
  out.present = out.value >= out.bound;
  out.confidence = by_margin(out.value, out.bound, 0.5);
  return out;
}

PlaqueFeatureFinding positive_remodelling(const PlaqueProfile& plaque, const Stenosis& lesion,
                                          const HighRiskOptions& o) {
  PlaqueFeatureFinding out{PlaqueFeature::positive_remodelling};
  out.bound = o.least_remodelling;
  const auto areas = remodelling_index(plaque, lesion);
  if (!areas) return out;
  out.known = true;
  out.value = std::sqrt(*areas);  // of diameters, as reports of CT have it
  out.present = out.value > out.bound;
  out.s_mm = lesion.throat_mm;
  out.confidence = by_margin(out.value, out.bound, 0.1);
  return out;
}

PlaqueFeatureFinding spotty_calcium(const std::vector<PlaquePiece>& pieces, const PlaqueVolumes& volumes,
                                    const Stenosis& lesion, const HighRiskOptions& o) {
  PlaqueFeatureFinding out{PlaqueFeature::spotty_calcium, true};
  out.bound = o.spot_mm;
  const PlaquePiece *spot = nullptr, *smallest = nullptr;
  for (const PlaquePiece& one : pieces) {
    if (one.volume_mm3 < o.least_spot_mm3 || one.s_mm < lesion.from_mm || one.s_mm > lesion.to_mm) continue;
    if (!smallest || one.size_mm < smallest->size_mm) smallest = &one;
    if (one.size_mm < o.spot_mm && (!spot || one.size_mm > spot->size_mm)) spot = &one;
  }
  out.confidence = FeatureConfidence::high;  // no calcium
  const PlaquePiece* told = spot ? spot : smallest;
  if (!told) return out;
  out.value = told->size_mm;
  out.s_mm = told->s_mm, out.theta_deg = degrees_of(told->theta);
  out.present = spot != nullptr && plaque_type(volumes) != PlaqueType::calcified;
  out.confidence = by_margin(out.value, out.bound, 0.2);
  return out;
}

/// Whether a ray of a map goes through low attenuation at the lumen and a brighter rim without calcium.
bool is_ringed(const PlaqueMap& map, int ray) {
  const int half = map.deep / 2, quarter = std::max(1, map.deep / 4);
  int core = 0, rim = 0;
  for (int i = 0; i < map.deep; ++i) {
    const auto piece = map.pieces[static_cast<std::size_t>(ray) * static_cast<std::size_t>(map.deep) +
                                  static_cast<std::size_t>(i)];
    if (!piece || *piece == PlaqueClass::calcified) return false;
    if (i < half && *piece == PlaqueClass::low_attenuation) ++core;
    if (i >= map.deep - quarter && *piece == PlaqueClass::fibrofatty) ++rim;
  }
  return half > 0 && core >= core_share * half && rim >= rim_share * quarter;
}

/// The longest run of such rays, radians, and its middle.
std::pair<double, double> ring_of(const PlaqueMap& map) {
  const double turn = 2.0 * pi / map.around;
  int best = 0, best_end = 0, run = 0;
  for (int i = 0; i < 2 * map.around && run < map.around; ++i) {  // twice around: a run may pass 0
    run = is_ringed(map, i % map.around) ? run + 1 : 0;
    if (run > best) best = run, best_end = i;
  }
  return {best * turn, (best_end - 0.5 * best + 1.0) * turn};
}

PlaqueFeatureFinding napkin_ring(const PlaqueProfile& plaque, const std::vector<PlaqueMap>& maps,
                                 const Stenosis& lesion, const HighRiskOptions& o) {
  PlaqueFeatureFinding out{PlaqueFeature::napkin_ring, true};
  out.bound = o.ring_deg;
  double length = 0.0, longest = 0.0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const PlaqueSlab& slab = plaque.slabs[i];
    if (slab.s_mm < lesion.from_mm || slab.s_mm > lesion.to_mm) continue;
    const auto [arc, middle] = ring_of(maps[i]);
    const double deg = arc * 180.0 / pi;
    length = deg >= o.ring_deg ? length + slab.volumes.length_mm : 0.0;
    longest = std::max(longest, length);
    if (deg > out.value) out.value = deg, out.s_mm = slab.s_mm, out.theta_deg = degrees_of(middle);
  }
  out.present = longest >= o.ring_mm - 1e-9;
  out.confidence = FeatureConfidence::moderate;
  return out;
}

}  // namespace

std::string to_string(PlaqueFeature feature) {
  switch (feature) {
    case PlaqueFeature::low_attenuation:
      return "low attenuation";
    case PlaqueFeature::positive_remodelling:
      return "positive remodelling";
    case PlaqueFeature::spotty_calcium:
      return "spotty calcium";
    case PlaqueFeature::napkin_ring:
      break;
  }
  return "napkin ring";
}

PlaqueFeature plaque_feature(const std::string& text) {
  for (const PlaqueFeature one : plaque_features)
    if (to_string(one) == text) return one;
  throw InvalidInput("a feature of plaque is \"" + text +
                     "\"; there are low attenuation, positive remodelling, spotty calcium, napkin ring");
}

std::string unit_of(PlaqueFeature feature) {
  switch (feature) {
    case PlaqueFeature::low_attenuation:
      return "mm3";
    case PlaqueFeature::positive_remodelling:
      return "";
    case PlaqueFeature::spotty_calcium:
      return "mm";
    case PlaqueFeature::napkin_ring:
      break;
  }
  return "deg";
}

std::string to_string(FeatureConfidence confidence) {
  return confidence == FeatureConfidence::low        ? "low"
         : confidence == FeatureConfidence::moderate ? "moderate"
                                                     : "high";
}

void validate(const HighRiskOptions& o) {
  const auto within = [](double x, double low, double high) { return x >= low && x <= high; };
  require_high_risk(within(o.least_low_mm3, 0.05, 50.0), "least_low_mm3", o.least_low_mm3, "[0.05, 50] mm3");
  require_high_risk(within(o.least_remodelling, 1.0, 2.0), "least_remodelling", o.least_remodelling,
                    "[1, 2]");
  require_high_risk(within(o.spot_mm, 0.5, 10.0), "spot_mm", o.spot_mm, "[0.5, 10] mm");
  require_high_risk(within(o.least_spot_mm3, 0.01, 10.0), "least_spot_mm3", o.least_spot_mm3,
                    "[0.01, 10] mm3");
  require_high_risk(within(o.ring_deg, 10.0, 360.0), "ring_deg", o.ring_deg, "[10, 360] degrees");
  require_high_risk(within(o.ring_mm, 0.25, 10.0), "ring_mm", o.ring_mm, "[0.25, 10] mm");
}

std::vector<PlaqueFeatureFinding> plaque_features_of(const PlaqueProfile& plaque,
                                                     const std::vector<PlaqueMap>& maps,
                                                     const Stenosis& lesion, const HighRiskOptions& options) {
  validate(options);
  if (!maps.empty() && maps.size() != plaque.slabs.size())
    throw InvalidInput("high-risk plaque: there are " + std::to_string(maps.size()) + " maps of " +
                       std::to_string(plaque.slabs.size()) + " slabs");
  const bool mapped =
      !maps.empty() && std::max(lesion.from_mm, plaque.from_mm) < std::min(lesion.to_mm, plaque.to_mm);
  std::vector<PlaqueFeatureFinding> out{{PlaqueFeature::low_attenuation},
                                        positive_remodelling(plaque, lesion, options),
                                        {PlaqueFeature::spotty_calcium},
                                        {PlaqueFeature::napkin_ring}};
  out[0].bound = options.least_low_mm3, out[2].bound = options.spot_mm, out[3].bound = options.ring_deg;
  if (!mapped) return out;
  out[0] = low_attenuation(
      PlaqueCells(plaque, maps, lesion.from_mm, lesion.to_mm).pieces(PlaqueClass::low_attenuation), options);
  out[2] = spotty_calcium(
      PlaqueCells(plaque, maps, lesion.from_mm - calcium_reach_mm, lesion.to_mm + calcium_reach_mm)
          .pieces(PlaqueClass::calcified),
      plaque_between(plaque, lesion.from_mm, lesion.to_mm), lesion, options);
  out[3] = napkin_ring(plaque, maps, lesion, options);
  return out;
}

}  // namespace ostia::analysis
