#include "ostia/session/lesion_grading.h"

namespace ostia::session {

GradeBar grade_bar(LesionState state, bool checked, const std::optional<analysis::EvaluableStretch>& image,
                   bool unlikely) {
  using analysis::Evaluability;
  if (state == LesionState::rejected) return GradeBar::rejected;
  if (state == LesionState::accepted) return GradeBar::none;
  if (image && image->by_person && image->grade == Evaluability::not_evaluable)
    return GradeBar::not_evaluable_by_reader;
  if (checked || (image && image->by_person)) return GradeBar::none;
  if (unlikely) return GradeBar::unlikely;
  if (image && image->grade == Evaluability::evaluable) return GradeBar::none;
  if (!image) return GradeBar::image_unknown;
  return image->grade == Evaluability::limited ? GradeBar::limited : GradeBar::not_evaluable;
}

}  // namespace ostia::session
