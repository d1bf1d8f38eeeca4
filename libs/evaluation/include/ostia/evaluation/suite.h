#pragma once
/// \file Two runs of any set of cases held against each other: is the new one as good as the golden one?
///
/// A run is a folder tree; files that bear the same relative path belong together. What a file holds is
/// compared in its own terms: figures by rules of their own, surfaces, lines and contours in millimetres,
/// masks by Dice, images in HU. Bytes are never compared. See docs/methods/evaluate-suite.md.

#include "ostia/core/task_context.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::evaluation {

enum class Direction { higher_is_better, lower_is_better, two_sided };

/// How far a figure may be from the golden one: by `absolute` (in the figure's own unit) or by `relative`
/// times the golden value's size, whichever allows more.
struct FigureRule {
  std::string file = "*";  ///< pattern of the relative path; * stands for any text, ? for one character
  std::string key = "*";   ///< pattern of the figure's key, "sections[s03].msd_mm"
  Direction direction = Direction::two_sided;
  double absolute = 0.0;
  double relative = 0.0;
};

/// How far apart two surfaces, lines or contours may be, mm.
struct ShapeRule {
  std::string file = "*";
  double mean_mm = 0.02;   ///< mean distance, both ways
  double max_mm = 0.2;     ///< largest distance, either way
  double radius_mm = 0.1;  ///< lines: largest difference of the radius
};

struct ImageRule {
  std::string file = "*";
  double dice = 0.995;   ///< masks: each label's least Dice, in [0, 1]
  double mean_hu = 1.0;  ///< images: mean of |difference|, in the image's unit (HU)
  double max_hu = 50.0;  ///< images: largest |difference|
};

/// Rules by kind; of those whose patterns fit the first holds.
struct Tolerances {
  std::vector<FigureRule> figures;
  std::vector<ShapeRule> surfaces, lines, contours;
  std::vector<ImageRule> images;  ///< masks, too
  std::vector<std::string> ignored_files, ignored_keys;
};
/// What holds unless a file says otherwise: scores of overlap may fall by 0.005, distances grow by 0.01 mm or
/// 5 %, least angles fall by 1 degree, other figures differ by 1 %; times, memory, versions and digests are
/// left out.
Tolerances default_tolerances();
/// docs/schemas/tolerance.schema.json. The file's rules go before the default ones. Throws InvalidInput
/// naming the file and the member: unknown members, numbers that are negative or not finite, `"v"` other
/// than 1.
Tolerances read_tolerances(const std::filesystem::path& path);
void validate(const Tolerances& tolerances);

/// Whether `text` fits a pattern of `*` (any text, `/` too) and `?`.
bool fits(std::string_view pattern, std::string_view text);

enum class FindingKind {
  regression,   ///< worse than the tolerance allows, or cannot be read
  missing,      ///< the golden run has it, the result has not
  improvement,  ///< better by more than the tolerance
  change,       ///< differs in what has no better or worse (a text)
  extra         ///< the result has it, the golden run has not
};
std::string name_of(FindingKind kind);

struct Finding {
  FindingKind kind = FindingKind::change;
  std::string file;                      ///< relative path
  std::string key;                       ///< the figure's; empty for a whole file
  std::optional<double> golden, result;  ///< values, or 0 and the distance for shapes
  double allowed = 0.0;                  ///< difference that was allowed
  std::string text;                      ///< one sentence
};

enum class FileKind { figures, surface, lines, contours, mask, image, points, other };
std::string name_of(FileKind kind);

/// A figure that both runs have.
struct FigurePair {
  std::string key;
  double golden = 0.0, result = 0.0;
  double allowed = 0.0;
  Direction direction = Direction::two_sided;
};

/// What was compared of one file that both runs have.
struct ComparedFile {
  std::string file;
  FileKind kind = FileKind::other;  ///< other: nothing but its being there
  std::vector<FigurePair> figures;  ///< a JSON file's; for shapes "mean_mm", "max_mm", ... with golden = 0
  bool differs = false;             ///< beyond its tolerance
};

struct SuiteResult {
  std::vector<ComparedFile> files;  ///< by path
  std::vector<Finding> findings;    ///< by kind, then by path and key
  std::size_t figures = 0;          ///< how many were compared
  std::size_t count(FindingKind kind) const;
  bool passed() const { return count(FindingKind::regression) + count(FindingKind::missing) == 0; }
};

/// Throws InvalidInput for what is no folder, an empty one, or two trees that share no file. A file that
/// cannot be read is a regression of its own, and the rest is compared.
SuiteResult compare_suites(const std::filesystem::path& golden, const std::filesystem::path& result,
                           const Tolerances& tolerances = default_tolerances(),
                           const core::TaskContext& task = core::no_task());

/// docs/schemas/suite.schema.json; holds relative paths alone.
std::string suite_json(const SuiteResult& result);
/// The same for the terminal: counts, then a line a finding.
std::string suite_text(const SuiteResult& result);

}  // namespace ostia::evaluation
