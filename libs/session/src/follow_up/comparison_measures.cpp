#include "ostia/session/comparison_measures.h"

namespace ostia::session {

CaseMoment moment_of(const CaseFile& file) {
  return {file.model(), file.annotations(), file.journal(), file.image(), {}, {}};
}

ComparedCase measured_case(const CaseMoment& of, const analysis::SurfaceOfVessel& surfaces,
                           const core::TaskContext& task) {
  ReportOptions options;
  options.image = of.reference;
  const CaseReport report = make_case_report(*of.model, surfaces, *of.annotations, of.journal, of.image.get(),
                                             options, task.sub(0.0, 0.8));
  std::optional<CaseFat> fat;
  if (of.image) {
    CaseFatOptions how;
    how.tube_kv = of.tube_kv;
    fat = case_fat(*of.model, surfaces, *of.image, how, task.sub(0.8, 1.0));
  }
  return compared_case(*of.model, report, fat ? &*fat : nullptr);
}

}  // namespace ostia::session
