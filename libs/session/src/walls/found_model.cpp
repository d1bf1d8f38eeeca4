#include "ostia/session/found_model.h"

#include "findings/vessel_doubt.h"

#include "ostia/core/text.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/pipeline/image_walls.h"
#include "ostia/session/doubts.h"

#include <system_error>

namespace ostia::session {
namespace {

constexpr double least_evidence = 0.5;  // of an axis that needs no second look
constexpr double least_choice = 0.1;    // of a second name that is worth telling

/// "D1 (62 %) or RI (30 %)".
std::string names_of(const coronary::VesselLabel& label) {
  const auto named = [](const std::string& name, double probability) {
    return name + " (" + core::rounded_text(100.0 * probability, 0) + " %)";
  };
  const std::string first = named(label.likeliest, label.confidence);
  return label.second_confidence > least_choice
             ? first + " or " + named(label.second, label.second_confidence)
             : first;
}

}  // namespace

std::string doubt_about(const coronary::VesselLabel& label, const coronary::AxisNotes& axis) {
  std::string doubt;
  const auto add = [&](const std::string& text) { doubt += (doubt.empty() ? "" : "; ") + text; };
  if (label.likeliest.empty())
    add("which artery it is was not found");
  else if (!label.given || label.second_confidence > least_choice)
    add((label.given ? "" : "perhaps ") + names_of(label));
  if (axis.evidence < least_evidence)
    add("faint: evidence " + core::rounded_text(100.0 * axis.evidence, 0) + " %");
  for (const std::string& warning : axis.warnings) add(warning);
  return doubt;
}

FoundModel found_model(const imaging::ImageVolume& image, const coronary::ExtractOptions& options,
                       const core::TaskContext& task) {
  FoundModel result;
  result.found = coronary::extract(image, options, task.sub(0.0, 0.7));
  task.set_stage("walls of the vessels");
  const geometry::VesselTree& tree = result.found.vessels.tree;
  std::vector<std::vector<std::string>> said;
  result.model =
      lumen::model_of_walls(tree, pipeline::walls_from_image(tree, image, task.sub(0.7, 1.0), &said));
  for (std::size_t i = 0; i < tree.vessels.size(); ++i) {
    std::vector<std::string>& warnings = result.found.notes[i].warnings;
    warnings.insert(warnings.end(), said[i].begin(), said[i].end());
    std::string doubt = doubt_text(result.found.certainty[i]);
    const std::string other = doubt_about(result.found.vessels.labels[i], result.found.notes[i]);
    if (!doubt.empty() && !other.empty()) doubt += "; ";
    result.doubts.push_back(doubt + other);
  }
  task.set_progress(1.0);
  return result;
}

CaseFile create_case(const std::filesystem::path& path, const FoundModel& found,
                     const std::optional<ImageReference>& image) {
  CaseFile made = CaseFile::create(path, found.model, image);
  try {
    if (!found.found.certainty.empty()) keep_certainty(made, found.found.certainty);
    for (std::size_t i = 0; i < found.doubts.size(); ++i) {
      if (found.doubts[i].empty()) continue;
      VesselMark mark;
      mark.vessel = found.model.tree.vessels[i].id;
      mark.note = found.doubts[i];
      made.annotate(MarkVessel{mark});
    }
  } catch (...) {
    { const CaseFile closed = std::move(made); }
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    throw;
  }
  return made;
}

}  // namespace ostia::session
