#include "ostia/analysis/calcium_score.h"

#include "calcium/calcium_heart.h"
#include "calcium/calcium_surroundings.h"

#include "ostia/analysis/plaque_burden.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/imaging/morphology.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace ostia::analysis {
namespace {

constexpr double largest_lesion_mm3 = 3000.0;  // a bone, or what holds together with one, is larger
constexpr double about_heart_mm = 25.0;        // arteries on the heart, the root above it
constexpr double at_heart_mm = 3.0;            // nearer than breastbone and ribs
constexpr double contrast_hu = 130.0, some_contrast_hu = 90.0;
constexpr double slice_tolerance_mm = 0.05;
constexpr std::array<const char*, calcium_places> place_words{"LM",    "LAD",   "LCX",  "RCA",
                                                              "aorta", "valve", "bone", "other"};

void require_in(double value, double low, double high, const char* name, const char* range) {
  if (!(value >= low && value <= high))
    throw InvalidInput(std::string("calcium score: ") + name + " is " + core::rounded_text(value, 3) +
                       "; it has to be in " + range);
}

void add_to(CalciumAmount& sum, const CalciumAmount& one) {
  sum.agatston += one.agatston;
  sum.volume_mm3 += one.volume_mm3;
  sum.interpolated_mm3 += one.interpolated_mm3;
  sum.mass_mg += one.mass_mg;
}

void count(CalciumScore& score) {
  score.total = {};
  score.by_place = {};
  for (const CalciumLesion& lesion : score.lesions) {
    add_to(score.by_place[static_cast<std::size_t>(lesion.place)], lesion.amount);
    if (is_coronary(lesion.place)) add_to(score.total, lesion.amount);
  }
}

/// Within so far of the heart's bulk.
class NearHeart {
 public:
  NearHeart(const HeartBulk& heart, double within_mm) : mask_(imaging::dilated(heart.mask, within_mm)) {}
  bool holds(const Vec3& place) const {
    const Vec3 at = mask_.geometry.index(place);
    std::array<std::int64_t, 3> n{};
    for (std::size_t d = 0; d < 3; ++d) {
      n[d] = std::llround(at[static_cast<Eigen::Index>(d)]);
      if (n[d] < 0 || n[d] >= mask_.geometry.size[d]) return false;
    }
    return mask_(n[0], n[1], n[2]) != 0;
  }

 private:
  imaging::MaskVolume mask_;
};

void require_no_contrast(const HeartBulk& heart, std::vector<std::string>& warnings) {
  const std::string found = "a fifth of the heart is brighter than " +
                            core::rounded_text(heart.bright_hu, 0) +
                            " HU, and blood without contrast agent has 30 to 60";
  if (heart.bright_hu > contrast_hu)
    throw InvalidInput("calcium score: the blood has contrast agent (" + found +
                       "), which counts as calcium from 130 HU on; take the scan without contrast agent");
  if (heart.bright_hu > some_contrast_hu)
    warnings.push_back("some contrast agent may be in the blood: " + found + "; look at each lesion");
}

/// By what lies about it, then by where it lies.
PlaceGuess proposal(const HeartBulk& heart, const Vec3& centre, double bright_about) {
  constexpr double most_bright = 0.1;
  if (bright_about > most_bright) return {CalciumPlace::bone, std::min(1.0, 0.5 + bright_about)};
  return guess_place(heart.place(centre));
}

/// What is too large for a lesion and lies on the heart may be coronary calcium joined to a ring or a wall.
void warn_of_large(const CalciumLesion& part, std::vector<std::string>& warnings) {
  const auto mm = [&](int axis) { return core::rounded_text(part.centre[axis], 0); };
  warnings.push_back("a part of " + core::rounded_text(part.amount.volume_mm3 / 1000.0, 1) +
                     " ml on the heart, about (" + mm(0) + ", " + mm(1) + ", " + mm(2) +
                     ") mm, is taken for no coronary calcium and not scored; look whether some of it is");
}

/// Parts that are lesions, with their proposals; `number` is still the part's.
std::vector<CalciumLesion> lesions_of(const CalciumSlices& slices, const CalciumSpots& found,
                                      const std::vector<CalciumLesion>& parts,
                                      const std::optional<HeartBulk>& heart, CalciumScore& score) {
  std::vector<CalciumLesion> lesions;
  std::optional<NearHeart> near, at;
  if (heart) near.emplace(*heart, about_heart_mm);
  if (heart) at.emplace(*heart, at_heart_mm);
  const std::vector<imaging::Region> boxes = part_boxes(found, slices.image.geometry);
  for (std::size_t part = 1; part < parts.size(); ++part) {
    CalciumLesion lesion = parts[part];
    if (lesion.amount.volume_mm3 > largest_lesion_mm3 || (near && !near->holds(lesion.centre))) {
      ++score.chest_parts;
      if (at && at->holds(lesion.centre)) warn_of_large(lesion, score.warnings);
      continue;
    }
    lesion.number = static_cast<int>(part);
    if (heart) {
      const double bright = bright_surroundings(slices, found, static_cast<std::uint32_t>(part), boxes[part]);
      const PlaceGuess guess = proposal(*heart, lesion.centre, bright);
      lesion.place = lesion.proposed = guess.place;
      lesion.confidence = guess.confidence;
    }
    lesions.push_back(lesion);
  }
  return lesions;
}

/// In the order that a reader goes through them. Returns the new number of each part.
std::vector<std::int32_t> number_them(std::vector<CalciumLesion>& lesions, std::size_t parts) {
  std::stable_sort(lesions.begin(), lesions.end(), [](const CalciumLesion& a, const CalciumLesion& b) {
    if (a.place != b.place) return a.place < b.place;
    return a.amount.agatston > b.amount.agatston;
  });
  std::vector<std::int32_t> numbers(parts, 0);
  for (std::size_t i = 0; i < lesions.size(); ++i) {
    numbers[static_cast<std::size_t>(lesions[i].number)] = static_cast<std::int32_t>(i + 1);
    lesions[i].number = static_cast<int>(i + 1);
  }
  return numbers;
}

void tell_slices(const CalciumSlices& slices, CalciumScore& score) {
  score.slice_mm = slices.slice_mm;
  score.averaged = slices.averaged;
  score.scored_slice_mm = slices.image.geometry.spacing.z();
  const CalciumOptions& o = score.options;
  if (std::abs(score.slice_mm - o.definition_mm) <= slice_tolerance_mm && score.averaged == 1) return;
  std::string text = "the slices lie " + core::rounded_text(score.slice_mm, 2) +
                     " mm apart, and the Agatston score is defined for " +
                     core::rounded_text(o.definition_mm, 1) + " mm: ";
  const double factor = score.scored_slice_mm / o.definition_mm;
  if (score.averaged > 1)
    text += std::to_string(score.averaged) + " of them were averaged to one of " +
            core::rounded_text(score.scored_slice_mm, 2) + " mm";
  if (std::abs(factor - 1.0) > 1e-3)
    text += std::string(score.averaged > 1 ? ", and " : "") + "a slice's score is multiplied by " +
            core::rounded_text(factor, 3);
  score.warnings.push_back(text);
}

}  // namespace

std::string to_string(CalciumPlace place) {
  return place_words[static_cast<std::size_t>(place)];
}

CalciumPlace calcium_place(std::string_view word) {
  const auto alike = [](std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
      return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
    });
  };
  for (std::size_t n = 0; n < calcium_places; ++n)
    if (alike(word, place_words[n])) return static_cast<CalciumPlace>(n);
  if (alike(word, "none")) return CalciumPlace::other;
  throw InvalidInput("\"" + std::string(word) +
                     "\" is no place of calcium; say LM, LAD, LCX, RCA, aorta, valve, bone or none");
}

void validate(const CalciumOptions& o) {
  require_in(o.threshold_hu, 50.0, 1000.0, "threshold_hu", "[50, 1000] HU");
  require_in(o.least_area_mm2, 0.0, 100.0, "least_area_mm2", "[0, 100] mm2");
  require_in(o.definition_mm, 0.5, 10.0, "definition_mm", "[0.5, 10] mm");
  require_in(o.largest_slice_mm, 1.0, 10.0, "largest_slice_mm", "[1, 10] mm");
  if (o.slice_thickness_mm) require_in(*o.slice_thickness_mm, 1e-3, 20.0, "slice_thickness_mm", "(0, 20] mm");
  if (o.calibration) require_in(*o.calibration, 1e-6, 5.0, "calibration", "(0, 5] mg/cm3 for each HU");
}

CalciumCategory calcium_category(double agatston) {
  const double whole = whole_agatston(agatston);
  return whole <= 0.0     ? CalciumCategory::none
         : whole <= 10.0  ? CalciumCategory::minimal
         : whole <= 100.0 ? CalciumCategory::mild
         : whole <= 400.0 ? CalciumCategory::moderate
                          : CalciumCategory::severe;
}

std::string to_string(CalciumCategory category) {
  switch (category) {
    case CalciumCategory::none:
      return "0";
    case CalciumCategory::minimal:
      return "1-10";
    case CalciumCategory::mild:
      return "11-100";
    case CalciumCategory::moderate:
      return "101-400";
    case CalciumCategory::severe:
      break;
  }
  return ">400";
}

std::string cac_drs(double agatston, int vessels) {
  const double whole = whole_agatston(agatston);
  if (whole <= 0.0) return "A0";
  const int grade = whole < 100.0 ? 1 : whole < 300.0 ? 2 : 3;
  return "A" + std::to_string(grade) + "/N" + std::to_string(vessels);
}

int CalciumScore::vessels() const {
  int count = 0;
  for (std::size_t n = 0; n < coronary_places; ++n) count += by_place[n].agatston > 0.0 ? 1 : 0;
  return count;
}

ScoredCalcium score_calcium(const imaging::ImageVolume& image, const CalciumOptions& options,
                            const core::TaskContext& task) {
  validate(options);
  task.set_stage("calcium");
  CalciumSlices slices = calcium_slices(image, options, task.sub(0.0, 0.2));
  ScoredCalcium out;
  CalciumScore& score = out.score;
  score.options = options;
  tell_slices(slices, score);
  const std::optional<HeartBulk> heart = heart_bulk(slices.image, task.sub(0.2, 0.6));
  if (heart)
    require_no_contrast(*heart, score.warnings);
  else
    score.warnings.push_back(
        "no heart was found, so no place could be proposed: no lesion counts until a person has said where "
        "it lies");
  const CalciumSpots found = calcium_spots(slices, options, task.sub(0.6, 0.85));
  const std::vector<CalciumLesion> parts = measured_parts(slices, found, options, task.sub(0.85, 0.95));
  score.lesions = lesions_of(slices, found, parts, heart, score);
  const std::vector<std::int32_t> numbers = number_them(score.lesions, parts.size());
  count(score);
  out.lesion_numbers.geometry = slices.image.geometry;
  for (const std::uint32_t part : found.parts.label) out.lesion_numbers.voxels.push_back(numbers[part]);
  out.image = std::move(slices.image);
  task.set_progress(1.0);
  return out;
}

CalciumScore with_places(CalciumScore score, const std::map<int, CalciumPlace>& places) {
  for (const auto& [number, place] : places) {
    if (number < 1 || number > static_cast<int>(score.lesions.size()))
      throw InvalidInput("calcium score: there is no lesion " + std::to_string(number) + "; there are " +
                         std::to_string(score.lesions.size()));
    CalciumLesion& lesion = score.lesions[static_cast<std::size_t>(number - 1)];
    lesion.place = place;
    lesion.assigned = true;
  }
  count(score);
  return score;
}

}  // namespace ostia::analysis
