#pragma once
/// \file Whether a lesion may have a grade, for the report and for the table in the window alike
/// (docs/methods/evaluability.md).

#include "ostia/analysis/evaluability.h"
#include "ostia/session/annotation.h"

#include <optional>

namespace ostia::session {

/// Why a lesion has no grade.
enum class GradeBar {
  none,      ///< it has one
  rejected,  ///< by the reader
  not_evaluable_by_reader,
  image_unknown,  ///< nobody has checked its vessel, and nothing is known of the image there
  limited,        ///< and so with these two, of its stretch
  not_evaluable,
  unlikely,  ///< its vessel is hardly an artery (unlikely_vessels)
};

/// A grade stands where the reader has accepted the lesion; else, unless the reader calls its stretch not
/// evaluable, where a person has checked its vessel or the stretch is evaluable, by the program or the
/// reader. `image`: the worst stretch that the lesion lies in; nothing: not known. `unlikely`: its vessel is
/// hardly an artery; a person's word on the vessel or the stretch says that it is one.
GradeBar grade_bar(LesionState state, bool checked, const std::optional<analysis::EvaluableStretch>& image,
                   bool unlikely = false);

}  // namespace ostia::session
