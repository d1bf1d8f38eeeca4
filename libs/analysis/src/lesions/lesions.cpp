#include "ostia/analysis/lesions.h"

#include "ostia/analysis/ostial_way.h"
#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::analysis {
namespace {

constexpr double least_plaque_percent = 1.0;  // CAD-RADS 1 begins there

void require_range(bool fine, const char* name, double value, const char* range) {
  if (!fine)
    throw InvalidInput("plaque's stretches: " + std::string(name) + " is " + std::to_string(value) +
                       "; it has to be in " + range);
}

/// What the narrowings leave of the stretches: those apart from all, and of the others the long parts.
std::vector<PlaqueStretch> beside(const std::vector<PlaqueStretch>& stretches,
                                  const std::vector<Stenosis>& narrowings, double least_mm) {
  std::vector<PlaqueStretch> out;
  for (const PlaqueStretch& one : stretches) {
    double from = one.from_mm;
    bool apart = true;
    const auto add = [&](double to_mm) {
      if (apart ? from < to_mm : to_mm - from >= least_mm) out.push_back({from, to_mm});
    };
    for (const Stenosis& narrow : narrowings) {
      if (narrow.to_mm <= from || narrow.from_mm >= one.to_mm) continue;
      apart = false;
      add(narrow.from_mm);
      from = narrow.to_mm;
    }
    add(one.to_mm);
  }
  return out;
}

/// The section of the stretch that is narrowest against the reference; nothing where none is found.
std::optional<std::size_t> narrowest(const LumenProfile& profile, const ReferenceLine& reference,
                                     const PlaqueStretch& stretch) {
  std::optional<std::size_t> best;
  double least = 0.0;
  for (std::size_t i = 0; i < profile.sections.size(); ++i) {
    const SectionMeasures& section = profile.sections[i];
    const double calibre = reference.diameter_mm[i];
    if (!section.found || !(calibre > 0.0) || section.s_mm < stretch.from_mm || section.s_mm > stretch.to_mm)
      continue;
    const double share = section.diameter_mm / calibre;
    if (!best || share < least) best = i, least = share;
  }
  return best;
}

std::optional<Lesion> plaque_lesion(const LumenProfile& profile, const ReferenceLine& reference,
                                    const PlaqueStretch& stretch) {
  const auto at = narrowest(profile, reference, stretch);
  if (!at) return std::nullopt;
  const SectionMeasures& section = profile.sections[*at];
  Lesion lesion;
  lesion.narrows = false;
  Stenosis& s = lesion.stenosis;
  s.vessel = profile.vessel;
  s.from_mm = s.proximal_mm = stretch.from_mm;
  s.to_mm = s.distal_mm = stretch.to_mm;
  s.throat_mm = section.s_mm;
  s.least_diameter_mm = section.diameter_mm;
  s.least_area_mm2 = section.area_mm2;
  s.reference_diameter_mm = reference.diameter_mm[*at];
  s.reference_area_mm2 = 0.25 * std::numbers::pi * s.reference_diameter_mm * s.reference_diameter_mm;
  const auto percent = [](double least, double whole) {
    return std::max(0.0, 100.0 * (1.0 - least / whole));
  };
  s.diameter_percent = percent(s.least_diameter_mm, s.reference_diameter_mm);
  s.area_percent = percent(s.least_area_mm2, s.reference_area_mm2);
  return lesion;
}

}  // namespace

void validate(const PlaqueStretchOptions& o) {
  require_range(o.least_area_mm2 >= 0.05 && o.least_area_mm2 <= 20.0, "least_area_mm2", o.least_area_mm2,
                "[0.05, 20] mm2");
  require_range(o.least_length_mm >= 0.25 && o.least_length_mm <= 50.0, "least_length_mm", o.least_length_mm,
                "[0.25, 50] mm");
  require_range(o.least_beside_mm >= 0.25 && o.least_beside_mm <= 50.0, "least_beside_mm", o.least_beside_mm,
                "[0.25, 50] mm");
  require_range(o.gap_mm >= 0.0 && o.gap_mm <= 10.0, "gap_mm", o.gap_mm, "[0, 10] mm");
}

std::vector<PlaqueStretch> plaque_stretches(const PlaqueProfile& plaque,
                                            const PlaqueStretchOptions& options) {
  validate(options);
  std::vector<PlaqueStretch> out;
  for (const PlaqueSlab& slab : plaque.slabs) {
    if (slab.plaque_mm2 < options.least_area_mm2) continue;
    const double half = 0.5 * slab.volumes.length_mm;
    if (out.empty() || slab.s_mm - half - out.back().to_mm > options.gap_mm + 1e-9)
      out.push_back({slab.s_mm - half, slab.s_mm + half});
    out.back().to_mm = slab.s_mm + half;
  }
  std::erase_if(out, [&](const PlaqueStretch& one) {
    return one.to_mm - one.from_mm < options.least_length_mm - 1e-9;
  });
  return out;
}

CadRads Lesion::category() const {
  return cad_rads(graded_percent());
}

double Lesion::graded_percent() const {
  return has_plaque() ? std::max(least_plaque_percent, stenosis.diameter_percent) : stenosis.diameter_percent;
}

std::vector<Lesion> find_lesions(const LumenProfile& profile, const ReferenceLine& reference,
                                 const PlaqueProfile* plaque, const StenosisOptions& narrowings,
                                 const PlaqueStretchOptions& plaques) {
  const std::vector<Stenosis> narrow = find_stenoses(profile, reference, narrowings);
  const LumenProfile read = read_through(profile, reference);  // in the mouth there is no calibre of its own
  std::vector<Lesion> lesions;
  for (const Stenosis& one : narrow) lesions.push_back({one, true, {}});
  if (!plaque) return lesions;
  for (const PlaqueStretch& stretch :
       beside(plaque_stretches(*plaque, plaques), narrow, plaques.least_beside_mm))
    if (auto lesion = plaque_lesion(read, reference, stretch)) lesions.push_back(std::move(*lesion));
  for (Lesion& one : lesions) {
    const double from = std::max(one.stenosis.from_mm, plaque->from_mm);
    const double to = std::min(one.stenosis.to_mm, plaque->to_mm);
    if (from < to) one.plaque = plaque_between(*plaque, from, to);
  }
  std::stable_sort(lesions.begin(), lesions.end(), [](const Lesion& a, const Lesion& b) {
    return a.stenosis.throat_mm < b.stenosis.throat_mm;
  });
  return lesions;
}

}  // namespace ostia::analysis
