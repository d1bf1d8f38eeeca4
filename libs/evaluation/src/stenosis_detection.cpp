#include "ostia/evaluation/stenosis_detection.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::evaluation {
namespace {

constexpr double no_share = std::numeric_limits<double>::quiet_NaN();

void require_sound(const std::vector<Lesion>& lesions, const std::string& whose) {
  for (std::size_t i = 0; i < lesions.size(); ++i) {
    const Lesion& l = lesions[i];
    const std::string which = whose + " lesion " + std::to_string(i);
    if (l.vessel.empty()) throw InvalidInput(which + " names no vessel");
    const std::string where = which + " in " + l.vessel;
    if (!std::isfinite(l.s_from_mm) || !std::isfinite(l.s_to_mm) || !(l.s_from_mm < l.s_to_mm))
      throw InvalidInput(where + " goes from " + std::to_string(l.s_from_mm) + " to " +
                         std::to_string(l.s_to_mm) + " mm; its end must lie behind its start");
    if (!(l.s_throat_mm >= l.s_from_mm && l.s_throat_mm <= l.s_to_mm))
      throw InvalidInput(where + " has its narrowest place, " + std::to_string(l.s_throat_mm) +
                         " mm, outside its stretch");
    if (!(l.grade >= 0.0 && l.grade <= 1.0))
      throw InvalidInput(where + " has the grade " + std::to_string(l.grade) +
                         "; give the diameter stenosis as a share in [0, 1]");
  }
}

struct Rivalry {
  LesionPair pair;
  double share = 0.0;  ///< shared over joint length
};

std::vector<LesionPair> paired(const std::vector<Lesion>& reference, const std::vector<Lesion>& found) {
  std::vector<Rivalry> rivals;
  for (std::size_t i = 0; i < reference.size(); ++i)
    for (std::size_t j = 0; j < found.size(); ++j) {
      const Lesion &a = reference[i], &b = found[j];
      const double shared = std::min(a.s_to_mm, b.s_to_mm) - std::max(a.s_from_mm, b.s_from_mm);
      const double joint = std::max(a.s_to_mm, b.s_to_mm) - std::min(a.s_from_mm, b.s_from_mm);
      if (a.vessel == b.vessel && shared > 0.0) rivals.push_back({{i, j, shared}, shared / joint});
    }
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const Rivalry& a, const Rivalry& b) { return a.share > b.share; });
  std::vector<bool> reference_taken(reference.size(), false), found_taken(found.size(), false);
  std::vector<LesionPair> pairs;
  for (const Rivalry& r : rivals) {
    if (reference_taken[r.pair.reference] || found_taken[r.pair.found]) continue;
    reference_taken[r.pair.reference] = found_taken[r.pair.found] = true;
    pairs.push_back(r.pair);
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const LesionPair& a, const LesionPair& b) { return a.reference < b.reference; });
  return pairs;
}

void add_differences(const std::vector<Lesion>& reference, const std::vector<Lesion>& found,
                     LesionDetection& out) {
  double sum = 0.0, squares = 0.0, throats = 0.0;
  for (const LesionPair& p : out.pairs) {
    const double d = found[p.found].grade - reference[p.reference].grade;
    sum += std::abs(d);
    squares += d * d;
    throats += std::abs(found[p.found].s_throat_mm - reference[p.reference].s_throat_mm);
  }
  const auto n = static_cast<double>(out.pairs.size());
  out.mean_grade_difference = n > 0.0 ? sum / n : no_share;
  out.rms_grade_difference = n > 0.0 ? std::sqrt(squares / n) : no_share;
  out.mean_throat_distance_mm = n > 0.0 ? throats / n : no_share;
}

}  // namespace

double LesionCounts::sensitivity() const {
  const auto there = static_cast<double>(true_positive + false_negative);
  return there > 0.0 ? static_cast<double>(true_positive) / there : no_share;
}

double LesionCounts::ppv() const {
  const auto found = static_cast<double>(true_positive + false_positive);
  return found > 0.0 ? static_cast<double>(true_positive) / found : no_share;
}

LesionDetection detect_lesions(const std::vector<Lesion>& reference, const std::vector<Lesion>& found,
                               double threshold) {
  if (!(threshold > 0.0 && threshold <= 1.0))
    throw InvalidInput("the threshold of a stenosis must lie in (0, 1], is " + std::to_string(threshold));
  require_sound(reference, "reference");
  require_sound(found, "found");
  LesionDetection out;
  out.pairs = paired(reference, found);
  std::vector<std::array<int, 2>> categories;
  const auto count = [&](const std::string& vessel, std::size_t LesionCounts::*which) {
    ++(out.all.*which);
    ++(out.by_vessel[vessel].*which);
  };
  const auto meet = [&](const std::string& vessel, double there, double seen) {
    categories.push_back({grade_category(there), grade_category(seen)});
    out.by_vessel[vessel];
    if (there >= threshold && seen >= threshold) {
      count(vessel, &LesionCounts::true_positive);
    } else if (there >= threshold) {
      count(vessel, &LesionCounts::false_negative);
    } else if (seen >= threshold) {
      count(vessel, &LesionCounts::false_positive);
    }
  };
  std::vector<bool> reference_paired(reference.size(), false), found_paired(found.size(), false);
  for (const LesionPair& p : out.pairs) {
    reference_paired[p.reference] = found_paired[p.found] = true;
    meet(reference[p.reference].vessel, reference[p.reference].grade, found[p.found].grade);
  }
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (reference_paired[i]) continue;
    out.missed.push_back(i);
    meet(reference[i].vessel, reference[i].grade, 0.0);
  }
  for (std::size_t j = 0; j < found.size(); ++j) {
    if (found_paired[j]) continue;
    out.unexplained.push_back(j);
    meet(found[j].vessel, 0.0, found[j].grade);
  }
  add_differences(reference, found, out);
  out.weighted_kappa = categories.empty() ? no_share : weighted_kappa(categories, grade_categories);
  return out;
}

}  // namespace ostia::evaluation
