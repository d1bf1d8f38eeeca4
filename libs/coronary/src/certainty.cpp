#include "ostia/coronary/certainty.h"

#include "certainty_weights.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/sampling.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace ostia::coronary {
namespace {

static_assert(std::size(piece_weights) == piece_looks.size());
static_assert(std::size(vessel_weights) == vessel_looks.size());

constexpr double piece_mm = 10.0;
constexpr double tissue_hu = 60.0;        // of walls and muscle
constexpr double sure_logit = 6.0;        // more is no more
constexpr double behind_ostium_mm = 2.0;  // of an axis behind its ostium that may lie in the aorta
constexpr double chord_mm = 2.0;          // over which a bend is measured
constexpr double darkness_mm = 1.5;       // a dark place is as long at least
constexpr std::size_t darkest_look = 1, upstream_look = 10;
static_assert(piece_looks[darkest_look] == "darkest" && piece_looks[upstream_look] == "upstream");

/// What is seen across the axis at one of its points.
struct SeenAcross {
  double brightness = 0.0, edges = 0.0, fat = 0.0;
};

/// Of one image.
class ArterySight {
 public:
  ArterySight(const imaging::ImageVolume& image, const Aorta& aorta)
      : image_(image), contrast_hu_(std::max(aorta.lumen_hu - tissue_hu, 50.0)), noise_hu_(aorta.noise_hu) {}

  SeenAcross across(const Vec3& point, const geometry::Frame& frame, double radius_mm) const {
    constexpr int directions = 12;
    constexpr double step_mm = 0.5, beyond_mm = 1.5, dark = 0.5;
    constexpr double faintest = 0.1;  // what is darker has no edge
    const auto way = [&](int d) {
      return geometry::radial_direction(frame, 2.0 * std::numbers::pi * d / directions);
    };
    double sum = imaging::sample(image_, point);
    for (int d = 0; d < directions; d += 2) sum += imaging::sample(image_, point + 0.5 * radius_mm * way(d));
    const double hu = sum / (1.0 + directions / 2);
    SeenAcross seen;
    seen.brightness = std::clamp((hu - tissue_hu) / contrast_hu_, -0.5, 1.5);
    for (int d = 0; d < directions; ++d) {
      double least = hu;
      for (double r = radius_mm; r <= 2.0 * radius_mm + beyond_mm; r += step_mm)
        least = std::min(least, imaging::sample(image_, point + r * way(d)));
      const bool falls = least < tissue_hu + dark * (hu - tissue_hu);
      seen.edges += falls && seen.brightness >= faintest ? 1.0 / directions : 0.0;
      seen.fat += least < 0.0 ? 1.0 / directions : 0.0;
    }
    return seen;
  }
  /// Over the contrast of something that is so bright.
  double noise(double brightness) const {
    return std::clamp(noise_hu_ / (contrast_hu_ * std::max(brightness, 0.05)), 0.0, 1.0);
  }
  double voxel_mm() const { return image_.geometry.spacing.maxCoeff(); }

 private:
  const imaging::ImageVolume& image_;
  double contrast_hu_, noise_hu_;
};

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// The vessel that owns a place, the first one through its segment; and where its own part begins.
struct Owner {
  std::int32_t vessel = 0;
  double from_mm = 0.0;
};

std::int32_t first_through(const geometry::VesselTree& tree, std::int32_t segment) {
  for (const geometry::Vessel& one : tree.vessels)
    if (std::find(one.segments.begin(), one.segments.end(), segment) != one.segments.end()) return one.id;
  return 0;
}

std::vector<Owner> owners_along(const geometry::VesselTree& tree, const geometry::Vessel& vessel) {
  std::vector<Owner> owners;
  double s_mm = 0.0;
  for (const std::int32_t id : vessel.segments) {
    const std::int32_t owner = first_through(tree, id);
    if (owners.empty() || owners.back().vessel != owner) owners.push_back({owner, s_mm});
    s_mm += geometry::segment(tree, id).axis.abscissa.back();
  }
  return owners;
}

const VesselCertainty* certainty_of_vessel(const std::vector<VesselCertainty>& all, std::int32_t vessel) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const VesselCertainty& one) { return one.vessel == vessel; });
  return found != all.end() ? &*found : nullptr;
}

const VesselPiece* piece_at(const VesselCertainty& of, double s_mm) {
  for (const VesselPiece& piece : of.pieces)
    if (s_mm <= piece.to_mm) return &piece;
  return of.pieces.empty() ? nullptr : &of.pieces.back();
}

/// Sum of the angles between chords, per mm.
double bend_per_mm(const geometry::Centerline& axis, std::size_t first, std::size_t last) {
  double angle = 0.0;
  Vec3 before = Vec3::Zero();
  std::size_t from = first;
  for (std::size_t i = first + 1; i <= last; ++i) {
    if (axis.abscissa[i] - axis.abscissa[from] < chord_mm) continue;
    const Vec3 way = (axis.points[i] - axis.points[from]).normalized();
    if (before.norm() > 0.5) angle += std::acos(std::clamp(before.dot(way), -1.0, 1.0));
    before = way;
    from = i;
  }
  return angle / std::max(axis.abscissa[last] - axis.abscissa[first], chord_mm);
}

/// The least mean over a stretch as long as a gap would be.
double darkest_of(const std::vector<double>& brightness, double step_mm) {
  const auto over = std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(darkness_mm / step_mm)), 1,
                                            brightness.size());
  double least = std::numeric_limits<double>::infinity(), sum = 0.0;
  for (std::size_t i = 0; i < brightness.size(); ++i) {
    sum += brightness[i];
    if (i >= over) sum -= brightness[i - over];
    if (i + 1 >= over) least = std::min(least, sum / static_cast<double>(over));
  }
  return least;
}

/// Looks along one vessel's own part, piece by piece.
class OwnPart {
 public:
  OwnPart(const ArterySight& sight, const geometry::Centerline& axis, double from_mm, double upstream)
      : sight_(sight), axis_(axis), from_mm_(from_mm), upstream_(upstream) {}

  std::vector<VesselPiece> pieces() {
    const double end_mm = axis_.abscissa.back(), length_mm = end_mm - from_mm_;
    const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(length_mm / piece_mm)));
    double before_mm = axis_.radius[nearest(from_mm_)];  // radius of what comes before
    std::vector<VesselPiece> made;
    for (std::size_t k = 0; k < count; ++k) {
      VesselPiece piece;
      piece.from_mm = from_mm_ + length_mm * static_cast<double>(k) / static_cast<double>(count);
      piece.to_mm = from_mm_ + length_mm * static_cast<double>(k + 1) / static_cast<double>(count);
      piece.place = geometry::at_abscissa(axis_.points, 0.5 * (piece.from_mm + piece.to_mm)).point;
      look(piece, before_mm);
      upstream_ = std::min(upstream_, piece.looks[darkest_look]);
      made.push_back(piece);
    }
    return made;
  }

 private:
  std::size_t nearest(double s_mm) const {
    const auto after = std::lower_bound(axis_.abscissa.begin(), axis_.abscissa.end(), s_mm);
    return std::min(static_cast<std::size_t>(after - axis_.abscissa.begin()), axis_.size() - 1);
  }

  void look(VesselPiece& piece, double& before_mm) const {
    const double end_mm = axis_.abscissa.back();
    // Where it leaves the aorta or its parent, their lumen is all about it.
    const double inside_mm = from_mm_ + (from_mm_ > 0.0 ? axis_.radius[nearest(from_mm_)] : behind_ostium_mm);
    std::size_t first = nearest(std::max(piece.from_mm, inside_mm)), last = nearest(piece.to_mm);
    if (last < first + 2) first = std::min(nearest(piece.from_mm), last);
    std::vector<double> brightness, edges, fat, radius;
    for (std::size_t i = first; i <= last; ++i) {
      const SeenAcross seen = sight_.across(axis_.points[i], axis_.frames[i], axis_.radius[i]);
      brightness.push_back(seen.brightness);
      edges.push_back(seen.edges);
      fat.push_back(seen.fat);
      radius.push_back(axis_.radius[i]);
    }
    const double bright = mean_of(brightness), radius_mm = std::max(mean_of(radius), 0.1);
    double square = 0.0;
    for (const double one : brightness) square += (one - bright) * (one - bright);
    const double step_mm = (axis_.abscissa[last] - axis_.abscissa[first]) /
                           std::max<double>(1.0, static_cast<double>(last - first));
    piece.looks = {bright,
                   darkest_of(brightness, std::max(step_mm, 0.1)),
                   mean_of(edges),
                   mean_of(fat),
                   std::sqrt(square / static_cast<double>(brightness.size())),
                   sight_.noise(bright),
                   std::min(std::log2(radius_mm / sight_.voxel_mm()), 1.0),
                   bend_per_mm(axis_, first, last),
                   std::sqrt(piece.from_mm / piece_mm),
                   std::min((end_mm - piece.to_mm) / piece_mm, 3.0),
                   upstream_,
                   std::clamp(std::log2(radius_mm / std::max(before_mm, 0.1)), -2.0, 2.0),
                   std::log2((end_mm - from_mm_) / piece_mm)};
    before_mm = radius_mm;
  }

  const ArterySight& sight_;
  const geometry::Centerline& axis_;
  double from_mm_, upstream_;
};

template <std::size_t n>
double bounded_logit(double constant, const double (&weights)[n], const std::array<double, n>& looks) {
  double logit = constant;
  for (std::size_t i = 0; i < n; ++i) logit += weights[i] * looks[i];
  return std::clamp(logit, -sure_logit, sure_logit);
}

double probability_of(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

/// The least brightness on the way to a place of a vessel that was looked at before.
double upstream_of(const std::vector<VesselCertainty>& known, const Owner& owner, double s_mm) {
  constexpr double open = 1.0;
  const VesselCertainty* const parent = certainty_of_vessel(known, owner.vessel);
  const VesselPiece* const piece = parent ? piece_at(*parent, s_mm) : nullptr;
  return piece ? std::min(piece->looks[upstream_look], piece->looks[darkest_look]) : open;
}

}  // namespace

std::array<double, vessel_looks.size()> looks_of_vessel(const std::vector<VesselPiece>& pieces,
                                                        const std::vector<double>& logits) {
  if (pieces.empty()) return {};
  double sum = 0.0, length_mm = 0.0, lowest = sure_logit;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double own_mm = pieces[i].to_mm - pieces[i].from_mm;
    const double logit = std::clamp(logits[i], -sure_logit, sure_logit);
    sum += own_mm * logit;
    length_mm += own_mm;
    lowest = std::min(lowest, logit);
  }
  return {sum / length_mm, lowest, std::log2(length_mm / piece_mm)};
}

std::vector<VesselCertainty> certainty_of(const imaging::ImageVolume& image, const geometry::VesselTree& tree,
                                          const Aorta& aorta) {
  if (image.voxels.empty()) throw InvalidInput("certainty of coronary arteries: the image is empty");
  constexpr double least_mm = 0.5;
  const ArterySight sight(image, aorta);
  std::vector<VesselCertainty> all;
  for (const geometry::Vessel& vessel : tree.vessels) {
    VesselCertainty one;
    one.vessel = vessel.id;
    one.probability = 1.0;
    const geometry::Centerline axis = geometry::vessel_axis(tree, vessel);
    const std::vector<Owner> owners = owners_along(tree, vessel);
    if (!owners.empty() && owners.back().vessel == vessel.id &&
        axis.abscissa.back() - owners.back().from_mm >= least_mm) {
      const double from_mm = owners.back().from_mm;
      const double upstream = owners.size() > 1 ? upstream_of(all, owners[owners.size() - 2], from_mm) : 1.0;
      one.pieces = OwnPart(sight, axis, from_mm, upstream).pieces();
      std::vector<double> logits;
      for (VesselPiece& piece : one.pieces) {
        logits.push_back(bounded_logit(piece_constant, piece_weights, piece.looks));
        piece.probability = probability_of(logits.back());
      }
      one.looks = looks_of_vessel(one.pieces, logits);
      one.probability = probability_of(bounded_logit(vessel_constant, vessel_weights, one.looks));
    }
    all.push_back(std::move(one));
  }
  return all;
}

double probability_at(const std::vector<VesselCertainty>& certainty, const geometry::VesselTree& tree,
                      std::int32_t vessel, double s_mm) {
  const auto found = std::find_if(tree.vessels.begin(), tree.vessels.end(),
                                  [&](const geometry::Vessel& one) { return one.id == vessel; });
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (found == tree.vessels.end()) return unknown;
  std::int32_t owner = vessel;
  for (const Owner& one : owners_along(tree, *found))
    if (one.from_mm <= s_mm || one.from_mm == 0.0) owner = one.vessel;
  const VesselCertainty* const known = certainty_of_vessel(certainty, owner);
  const VesselPiece* const piece = known ? piece_at(*known, s_mm) : nullptr;
  return piece ? piece->probability : unknown;
}

}  // namespace ostia::coronary
