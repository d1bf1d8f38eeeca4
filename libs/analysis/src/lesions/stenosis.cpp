#include "ostia/analysis/stenosis.h"

#include "lesions/mouth.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace ostia::analysis {
namespace {

using core::mm_text;

// A lesion reaches as far as the lumen is narrower than the reference by this share, or by half of the least
// narrowing that counts.
constexpr double shoulder_share = 0.10;
// Narrowings are two where the lumen between them recovers to this share of the lesser one.
constexpr double apart_share = 0.5;
// A place of reference is the first that is narrowed by no more than this, within so far of the lesion.
constexpr double healthy_share = 0.05, healthy_within_mm = 10.0;

double circle_area(double diameter) {
  return 0.25 * std::numbers::pi * diameter * diameter;
}

void set_percents(Stenosis& stenosis) {
  const auto percent = [](double least, double reference) {
    return reference > 0.0 ? 100.0 * (1.0 - least / reference) : 100.0;
  };
  stenosis.diameter_percent = percent(stenosis.least_diameter_mm, stenosis.reference_diameter_mm);
  stenosis.area_percent = percent(stenosis.least_area_mm2, stenosis.reference_area_mm2);
}

/// Where `narrowing` passes a level between two sections.
double crossing(double s_a, double a, double s_b, double b, double level) {
  return a == b ? s_a : s_a + std::clamp((level - a) / (b - a), 0.0, 1.0) * (s_b - s_a);
}

/// Sections [first, last] of a profile.
struct Stretch {
  std::size_t first = 0, last = 0;
};

class Search {
 public:
  Search(const LumenProfile& profile, const ReferenceLine& reference, const StenosisOptions& options)
      : sections_(profile.sections), profile_(profile), reference_(reference.diameter_mm), options_(options) {
    const double least = options.least_percent / 100.0;
    shoulder_ = std::min(shoulder_share, 0.5 * least);
    mouths_ = mouths_of(profile, reference.joints);
    for (std::size_t i = 0; i < sections_.size(); ++i) narrowing_.push_back(narrowing(i));
  }

  std::vector<Stenosis> found() const {
    std::vector<Stenosis> result;
    for (const Stretch& run : runs()) {
      for (const Stretch& part : parts(run)) {
        const Stenosis stenosis = described(part, run);
        if (stenosis.diameter_percent >= options_.least_percent &&
            stenosis.length_mm() >= options_.least_length_mm)
          result.push_back(stenosis);
      }
    }
    return result;
  }

 private:
  bool shut(std::size_t i) const { return !sections_[i].found && !sections_[i].open; }
  double narrowing(std::size_t i) const {
    if (shut(i)) return 1.0;
    if (!sections_[i].found || !(reference_[i] > 0.0)) return 0.0;  // where nothing is known, nothing is said
    return 1.0 - sections_[i].diameter_mm / reference_[i];
  }

  std::vector<Stretch> runs() const {
    std::vector<Stretch> runs;
    for (std::size_t i = 0; i < narrowing_.size(); ++i) {
      if (!(narrowing_[i] > shoulder_) || in_mouth(i)) continue;
      if (runs.empty() || runs.back().last + 1 < i || begins_vessel(i)) runs.push_back({i, i});
      runs.back().last = i;
    }
    return runs;
  }

  /// Cut at the widest place between narrowings that are apart.
  std::vector<Stretch> parts(const Stretch& run) const {
    const double least = options_.least_percent / 100.0;
    std::vector<Stretch> parts{{run.first, run.last}};
    double peak = narrowing_[run.first];
    std::size_t valley = run.first;
    for (std::size_t i = run.first + 1; i <= run.last; ++i) {
      const double here = narrowing_[i];
      if (here < narrowing_[valley]) valley = i;
      const bool apart =
          std::min(peak, here) >= least && narrowing_[valley] < apart_share * std::min(peak, here);
      if (apart) {
        parts.back().last = valley;
        parts.push_back({valley, run.last});
      }
      if (apart || here > peak) {
        peak = here;
        valley = i;
      }
    }
    return parts;
  }

  /// The section with the least area; where the lumen is shut, the middle of that.
  std::size_t throat(const Stretch& part) const {
    std::size_t best = part.first, last_shut = part.first;
    const auto area = [&](std::size_t i) {
      return shut(i) ? -1.0 : sections_[i].found ? sections_[i].area_mm2 : INFINITY;
    };
    for (std::size_t i = part.first; i <= part.last; ++i) {
      if (area(i) < area(best)) best = i;
    }
    if (!shut(best)) return best;
    for (last_shut = best; last_shut < part.last && shut(last_shut + 1);) ++last_shut;
    return (best + last_shut) / 2;
  }

  double healthy_place(std::size_t from, int way) const {
    const double start = sections_[from].s_mm;
    for (auto i = static_cast<std::ptrdiff_t>(from); i >= 0 && i < std::ssize(sections_); i += way) {
      const auto k = static_cast<std::size_t>(i);
      if (std::abs(sections_[k].s_mm - start) > healthy_within_mm || other_vessel(from, k)) break;
      if (sections_[k].found && narrowing_[k] <= healthy_share) return sections_[k].s_mm;
    }
    return start;
  }

  Stenosis described(const Stretch& part, const Stretch& run) const {
    const std::size_t at = throat(part);
    Stenosis stenosis;
    stenosis.vessel = profile_.vessel;
    stenosis.throat_mm = sections_[at].s_mm;
    stenosis.from_mm = sections_[part.first].s_mm;
    stenosis.to_mm = sections_[part.last].s_mm;
    if (part.first == run.first && part.first > 0 && !begins_vessel(part.first))
      stenosis.from_mm = edge(part.first - 1, part.first);
    if (part.last == run.last && part.last + 1 < sections_.size() && !in_mouth(part.last + 1))
      stenosis.to_mm = edge(part.last + 1, part.last);
    stenosis.proximal_mm = healthy_place(part.first, -1);
    stenosis.distal_mm = healthy_place(part.last, 1);
    stenosis.least_diameter_mm = sections_[at].diameter_mm;
    stenosis.least_area_mm2 = sections_[at].area_mm2;
    stenosis.reference_diameter_mm = reference_[at];
    stenosis.reference_area_mm2 = circle_area(reference_[at]);
    set_percents(stenosis);
    return stenosis;
  }
  bool in_mouth(std::size_t i) const {
    return std::any_of(mouths_.begin(), mouths_.end(), [i](const Mouth& one) { return one.holds(i); });
  }
  /// Whether two sections are not on the same side of an ostium.
  bool other_vessel(std::size_t i, std::size_t k) const {
    return in_mouth(k) || std::any_of(mouths_.begin(), mouths_.end(), [i, k](const Mouth& one) {
             return (i >= one.behind) != (k >= one.behind);
           });
  }
  /// The first section behind an ostium: what lies before is the parent's.
  bool begins_vessel(std::size_t i) const {
    return std::any_of(mouths_.begin(), mouths_.end(), [i](const Mouth& one) { return i == one.behind; });
  }
  double edge(std::size_t outside, std::size_t inside) const {
    if (shut(inside)) return sections_[inside].s_mm;
    return crossing(sections_[outside].s_mm, narrowing_[outside], sections_[inside].s_mm, narrowing_[inside],
                    shoulder_);
  }

  const std::vector<SectionMeasures>& sections_;
  const LumenProfile& profile_;
  const std::vector<double>& reference_;
  StenosisOptions options_;
  double shoulder_ = 0.0;
  std::vector<Mouth> mouths_;
  std::vector<double> narrowing_;
};

void validate(const StenosisOptions& options) {
  if (!(options.least_percent >= 5.0 && options.least_percent <= 95.0))
    throw InvalidInput("a stenosis counts from " + std::to_string(options.least_percent) +
                       " % of the diameter on; choose 5 to 95 %");
  if (!(options.least_length_mm >= 0.0 && options.least_length_mm <= 100.0))
    throw InvalidInput("a stenosis counts from " + mm_text(options.least_length_mm, 6) +
                       " of length on; choose 0 to 100 mm");
}

/// The measured sections of a stretch, its ends included.
std::vector<SectionMeasures> sections_between(const LumenProfile& profile, double from, double to) {
  std::vector<SectionMeasures> sections{at(profile, from)};
  for (const SectionMeasures& section : profile.sections) {
    if (section.s_mm > from && section.s_mm < to) sections.push_back(section);
  }
  sections.push_back(at(profile, to));
  for (const SectionMeasures& section : sections) {
    if (!section.found)
      throw InvalidInput("the lumen is not measured at " + mm_text(section.s_mm, 6) +
                         ", between the two places of reference; choose a stretch without gaps");
  }
  return sections;
}

}  // namespace

Stenosis stenosis_between(const LumenProfile& profile, double proximal_mm, double distal_mm) {
  if (!(proximal_mm >= 0.0 && distal_mm <= profile.length_mm + 1e-6 && proximal_mm < distal_mm))
    throw InvalidInput("the places of reference, " + mm_text(proximal_mm, 6) + " and " +
                       mm_text(distal_mm, 6) + ", must lie on the vessel, " + mm_text(profile.length_mm, 6) +
                       " long, the proximal one first");
  const auto sections = sections_between(profile, proximal_mm, distal_mm);
  const auto enclosed =
      std::count_if(profile.sections.begin(), profile.sections.end(),
                    [&](const SectionMeasures& a) { return a.s_mm >= proximal_mm && a.s_mm <= distal_mm; });
  if (enclosed < 2)
    throw InvalidInput("the places of reference, " + mm_text(proximal_mm, 6) + " and " +
                       mm_text(distal_mm, 6) +
                       ", do not enclose two sections of the profile; choose them farther apart");
  const SectionMeasures &a = sections.front(), &b = sections.back();
  const auto share = [&](double s) { return (s - proximal_mm) / (distal_mm - proximal_mm); };
  const auto reference = [&](double s) { return a.diameter_mm + share(s) * (b.diameter_mm - a.diameter_mm); };
  const auto narrowing = [&](std::size_t i) {
    return 1.0 - sections[i].diameter_mm / reference(sections[i].s_mm);
  };
  std::size_t throat = 0;
  for (std::size_t i = 1; i < sections.size(); ++i) {
    if (sections[i].area_mm2 < sections[throat].area_mm2) throat = i;
  }
  Stenosis stenosis;
  stenosis.vessel = profile.vessel;
  stenosis.proximal_mm = proximal_mm;
  stenosis.distal_mm = distal_mm;
  stenosis.throat_mm = sections[throat].s_mm;
  stenosis.least_diameter_mm = sections[throat].diameter_mm;
  stenosis.least_area_mm2 = sections[throat].area_mm2;
  stenosis.reference_diameter_mm = reference(stenosis.throat_mm);
  stenosis.reference_area_mm2 = a.area_mm2 + share(stenosis.throat_mm) * (b.area_mm2 - a.area_mm2);
  set_percents(stenosis);
  const double shoulder = std::min(shoulder_share, 0.5 * narrowing(throat));
  std::size_t from = throat, to = throat;
  while (from > 0 && narrowing(from) > shoulder) --from;
  while (to + 1 < sections.size() && narrowing(to) > shoulder) ++to;
  const auto edge = [&](std::size_t outside, std::size_t inside) {
    return crossing(sections[outside].s_mm, narrowing(outside), sections[inside].s_mm, narrowing(inside),
                    shoulder);
  };
  stenosis.from_mm = from < throat ? edge(from, from + 1) : stenosis.throat_mm;
  stenosis.to_mm = to > throat ? edge(to, to - 1) : stenosis.throat_mm;
  return stenosis;
}

std::vector<Stenosis> find_stenoses(const LumenProfile& profile, const ReferenceLine& reference,
                                    const StenosisOptions& options) {
  validate(options);
  if (reference.diameter_mm.size() != profile.sections.size())
    throw InvalidInput("the reference line has " + std::to_string(reference.diameter_mm.size()) +
                       " values for " + std::to_string(profile.sections.size()) + " sections");
  return Search(profile, reference, options).found();
}

}  // namespace ostia::analysis
