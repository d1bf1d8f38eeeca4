#include "ostia/analysis/evaluability.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ostia::analysis {
namespace {

constexpr double calibre_reach_mm = 10.0;  // within which the vessel's own calibre is looked for
constexpr double narrow_share = 0.75;      // of that calibre: below, a section says little of the image
constexpr std::size_t reasons_known = 6;

/// Of one section: the grade for each reason.
using Grades = std::array<Evaluability, reasons_known>;

Evaluability graded(bool worst, bool limited) {
  return worst ? Evaluability::not_evaluable : limited ? Evaluability::limited : Evaluability::evaluable;
}

/// The evidence along a vessel, and what is the usual about a place.
class Course {
 public:
  Course(const std::vector<WallEvidence>& evidence, double voxel_mm, double noise_hu,
         const EvaluabilityOptions& options)
      : evidence_(evidence), voxel_mm_(voxel_mm), noise_hu_(std::max(noise_hu, 1.0)), options_(options) {
    for (std::size_t i = 0; i < evidence.size(); ++i) calibre_mm_.push_back(usual_calibre(i));
  }

  Grades grades(std::size_t i) const {
    Grades out{};
    const auto set = [&](EvaluabilityReason reason, Evaluability grade) {
      out[static_cast<std::size_t>(reason)] = grade;
    };
    if (!evidence_[i].in_image) {
      set(EvaluabilityReason::outside_image, Evaluability::not_evaluable);
      return out;
    }
    const EvaluabilityOptions& o = options_;
    const double calibre = calibre_mm_[i], voxels = calibre / voxel_mm_;
    set(EvaluabilityReason::coarse_voxels, graded(voxels < o.least_voxels, voxels < o.limited_voxels));
    const double calcium = about(i, &WallEvidence::calcium_share, false);
    set(EvaluabilityReason::calcium, graded(calcium > o.most_calcium, calcium > o.limited_calcium));
    if (!any_open(i)) return out;  // an occlusion: what is seen of it is calcium, or its neighbours tell
    const double cnr = about(i, &WallEvidence::contrast_hu, true) / noise_hu_;
    set(EvaluabilityReason::faint, graded(cnr < o.least_cnr, cnr < o.limited_cnr));
    if (calcium < o.most_calcium) {
      const double clear = about(i, &WallEvidence::clear_share, true);
      set(EvaluabilityReason::no_clear_edge, graded(clear < o.least_clear, clear < o.limited_clear));
    }
    // Plaque has edges of its own; what moved, or the scanner, blurs longer stretches than a lesion.
    const double blur = about(i, &WallEvidence::blur_mm, true, calibre_reach_mm);
    set(EvaluabilityReason::blurred,
        graded(blur > o.most_blur_share * calibre,
               blur > o.limited_blur_mm || blur > o.limited_blur_share * calibre));
    return out;
  }

 private:
  bool open(std::size_t i) const { return evidence_[i].in_image && evidence_[i].calibre_mm > 0.2; }
  bool any_open(std::size_t i) const {
    for (std::size_t j = 0; j < evidence_.size(); ++j)
      if (open(j) && near(i, j, calibre_reach_mm)) return true;
    return false;
  }
  bool near(std::size_t i, std::size_t j, double reach_mm) const {
    return std::abs(evidence_[i].s_mm - evidence_[j].s_mm) <= reach_mm + 1e-9;
  }

  /// The upper quartile nearby: of a vessel with a narrowing the vessel's.
  double usual_calibre(std::size_t i) const {
    std::vector<double> values;
    for (std::size_t j = 0; j < evidence_.size(); ++j)
      if (open(j) && near(i, j, calibre_reach_mm)) values.push_back(evidence_[j].calibre_mm);
    if (values.empty()) return evidence_[i].calibre_mm;
    const std::size_t place = values.size() - 1 - values.size() / 4;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place), values.end());
    return values[place];
  }

  /// Median over the window; with `wide` of its sections that are not narrowed or, where all are, of the
  /// nearest that is not.
  double about(std::size_t i, double WallEvidence::*figure, bool wide, double reach_mm = 0.0) const {
    const double reach = reach_mm > 0.0 ? reach_mm : 0.5 * options_.window_mm;
    std::vector<double> values;
    std::size_t nearest = evidence_.size();
    for (std::size_t j = 0; j < evidence_.size(); ++j) {
      if (!evidence_[j].in_image) continue;
      if (wide && !(open(j) && evidence_[j].calibre_mm >= narrow_share * calibre_mm_[j])) continue;
      if (near(i, j, reach)) values.push_back(evidence_[j].*figure);
      if (nearest == evidence_.size() || std::abs(evidence_[j].s_mm - evidence_[i].s_mm) <
                                             std::abs(evidence_[nearest].s_mm - evidence_[i].s_mm))
        nearest = j;
    }
    if (values.empty()) return nearest < evidence_.size() ? evidence_[nearest].*figure : 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  const std::vector<WallEvidence>& evidence_;
  double voxel_mm_, noise_hu_;
  EvaluabilityOptions options_;
  std::vector<double> calibre_mm_;
};

EvaluableStretch stretch_of(const Grades& grades, double from_mm, double to_mm) {
  EvaluableStretch out{from_mm, to_mm, *std::max_element(grades.begin(), grades.end()), {}, false};
  for (std::size_t r = 0; r < grades.size(); ++r)
    if (grades[r] != Evaluability::evaluable && grades[r] == out.grade)
      out.reasons.push_back(static_cast<EvaluabilityReason>(r));
  return out;
}

bool alike(const EvaluableStretch& a, const EvaluableStretch& b) {
  return a.grade == b.grade && a.by_person == b.by_person;
}

/// Neighbours of one grade are one, with the reasons of both.
void append(std::vector<EvaluableStretch>& stretches, EvaluableStretch next) {
  if (!(next.from_mm < next.to_mm)) return;
  if (stretches.empty() || !alike(stretches.back(), next)) {
    stretches.push_back(std::move(next));
    return;
  }
  EvaluableStretch& last = stretches.back();
  last.to_mm = next.to_mm;
  for (const EvaluabilityReason reason : next.reasons)
    if (std::find(last.reasons.begin(), last.reasons.end(), reason) == last.reasons.end())
      last.reasons.push_back(reason);
  std::sort(last.reasons.begin(), last.reasons.end());
}

}  // namespace

std::string to_string(Evaluability grade) {
  switch (grade) {
    case Evaluability::evaluable:
      return "evaluable";
    case Evaluability::limited:
      return "limited";
    case Evaluability::not_evaluable:
      return "not evaluable";
  }
  throw InvalidInput("a grade of evaluability that is none of the three");
}

Evaluability evaluability(const std::string& text) {
  for (const Evaluability grade :
       {Evaluability::evaluable, Evaluability::limited, Evaluability::not_evaluable})
    if (text == to_string(grade)) return grade;
  throw InvalidInput("\"" + text +
                     "\" says not how far a stretch can be judged; known are evaluable, limited, "
                     "not evaluable");
}

std::string to_string(EvaluabilityReason reason) {
  switch (reason) {
    case EvaluabilityReason::outside_image:
      return "the image ends";
    case EvaluabilityReason::coarse_voxels:
      return "voxels too coarse for its calibre";
    case EvaluabilityReason::faint:
      return "hardly brighter than the noise";
    case EvaluabilityReason::no_clear_edge:
      return "no clear edge";
    case EvaluabilityReason::calcium:
      return "calcium hides the lumen";
    case EvaluabilityReason::blurred:
      return "the edge is blurred";
  }
  throw InvalidInput("a reason of evaluability that is none of the six");
}

void validate(const EvaluabilityOptions& o) {
  const auto require = [](bool fine, const char* what) {
    if (!fine) throw InvalidInput(std::string("evaluability: ") + what);
  };
  require(o.window_mm >= 1.0 && o.window_mm <= 20.0, "window_mm has to be in [1, 20] mm");
  require(o.least_voxels >= 0.0 && o.least_voxels <= o.limited_voxels,
          "least_voxels is above limited_voxels");
  require(o.least_cnr >= 0.0 && o.least_cnr <= o.limited_cnr, "least_cnr is above limited_cnr");
  require(o.least_clear >= 0.0 && o.least_clear <= o.limited_clear && o.limited_clear <= 1.0,
          "shares of clear edges have to be in [0, 1], least_clear below limited_clear");
  require(o.limited_calcium >= 0.0 && o.limited_calcium <= o.most_calcium && o.most_calcium <= 1.0,
          "shares of calcium have to be in [0, 1], limited_calcium below most_calcium");
  require(o.limited_blur_mm > 0.0 && o.limited_blur_share > 0.0 && o.limited_blur_share <= o.most_blur_share,
          "bounds of the blur have to be above 0, limited_blur_share below most_blur_share");
}

std::vector<EvaluableStretch> evaluable_stretches(const std::vector<WallEvidence>& evidence, double from_mm,
                                                  double to_mm, double voxel_mm, double noise_hu,
                                                  const EvaluabilityOptions& options) {
  validate(options);
  if (!(voxel_mm > 0.0)) throw InvalidInput("evaluability: the voxels' spacing has to be above 0");
  std::vector<EvaluableStretch> out;
  const Course course(evidence, voxel_mm, noise_hu, options);
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const double begin = i == 0 ? from_mm : 0.5 * (evidence[i - 1].s_mm + evidence[i].s_mm);
    const double end = i + 1 == evidence.size() ? to_mm : 0.5 * (evidence[i].s_mm + evidence[i + 1].s_mm);
    append(out, stretch_of(course.grades(i), std::max(begin, from_mm), std::min(end, to_mm)));
  }
  return out;
}

std::vector<EvaluableStretch> overruled(const std::vector<EvaluableStretch>& stretches,
                                        const std::vector<EvaluableStretch>& by_person) {
  std::vector<EvaluableStretch> now = stretches;
  for (EvaluableStretch word : by_person) {
    if (now.empty()) break;
    word.by_person = true;
    word.from_mm = std::max(word.from_mm, now.front().from_mm);
    word.to_mm = std::min(word.to_mm, now.back().to_mm);
    if (!(word.from_mm < word.to_mm)) continue;
    std::vector<EvaluableStretch> next;
    const auto part = [&](const EvaluableStretch& of, double from_mm, double to_mm) {
      EvaluableStretch cut = of;
      cut.from_mm = std::max(of.from_mm, from_mm), cut.to_mm = std::min(of.to_mm, to_mm);
      append(next, std::move(cut));
    };
    for (const EvaluableStretch& one : now) part(one, one.from_mm, word.from_mm);
    append(next, word);
    for (const EvaluableStretch& one : now) part(one, word.to_mm, one.to_mm);
    now = std::move(next);
  }
  return now;
}

std::optional<EvaluableStretch> worst_within(const std::vector<EvaluableStretch>& stretches, double from_mm,
                                             double to_mm) {
  std::optional<EvaluableStretch> worst;
  for (const EvaluableStretch& one : stretches) {
    if (one.to_mm < from_mm || one.from_mm > to_mm) continue;
    if (!worst || one.grade > worst->grade) worst = one;
  }
  return worst;
}

double share_of(const std::vector<EvaluableStretch>& stretches, Evaluability grade) {
  double sum = 0.0, all = 0.0;
  for (const EvaluableStretch& one : stretches) {
    all += one.to_mm - one.from_mm;
    if (one.grade == grade) sum += one.to_mm - one.from_mm;
  }
  return all > 0.0 ? sum / all : 0.0;
}

}  // namespace ostia::analysis
