#include "mesh/refinement.h"

#include "ostia/core/log.h"

#include <cstdio>

namespace ostia::app {

void check_refinement(const MeshCommand& o) {
  const bool refines = !o.refine_from.empty();
  if (!refines && (!o.refine_by.empty() || o.refine_error || o.refine_elements || o.refine_coarsening))
    throw UsageError(
        "--by, --refine-error, --refine-elements and --refine-coarsening need --refine-from RESULT");
  if (refines && o.refine_by.empty())
    throw UsageError("--refine-from needs --by FIELD, such as --by velocity_m_s");
  if (o.refine_error && o.refine_elements)
    throw UsageError("--refine-error and --refine-elements: the one follows from the other; give one");
}

void apply_refinement(const MeshCommand& o, const geometry::Box3& box, pipeline::ModelOptions& how,
                      const core::TaskContext& task) {
  if (o.refine_from.empty()) return;
  pipeline::RefinementOptions asked;
  asked.result = o.refine_from;
  asked.field = o.refine_by;
  if (o.refine_error) asked.sizing.error_share = *o.refine_error;
  asked.sizing.elements = o.refine_elements;
  if (o.refine_coarsening) asked.sizing.most_coarsening = *o.refine_coarsening;
  asked.sizing.gradation = how.sizing.gradation;
  asked.sizing.min_edge_mm = how.sizing.min_edge_mm;
  asked.sizing.max_edge_mm = how.sizing.max_edge_mm;
  const pipeline::Refinement made = pipeline::refinement_by(asked, box, task);
  for (const std::string& warning : made.warnings) core::log_warning(warning);
  const pipeline::RefinementReport& report = made.report;
  char text[200];
  std::snprintf(
      text, sizeof text, "edges of %.3g to %.3g mm; shorter in %.0f %% of the volume, about %.0f elements",
      report.least_edge_mm, report.largest_edge_mm, 100.0 * report.refined_share, report.elements_foretold);
  core::log_info(text);
  how.sizing.field = made.sizes;
  how.volume.tetrahedralize.field = made.sizes;
  how.volume.refinement = report;
}

}  // namespace ostia::app
