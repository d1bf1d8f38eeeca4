#pragma once
/// \file A patient's tree made ready: which vessels count, where they say that the heart is.

#include "heart/heart_fit.h"

#include "ostia/phantom/patient_heart.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::phantom {

/// The vessels of both trees, parents first, with names; what hangs on no ostium is left out and told.
struct KeptTree {
  std::vector<PatientVessel> vessels;
  std::optional<std::size_t> lad, rca;  ///< roots
  std::vector<std::string> remarks;
};
KeptTree kept_tree(const PatientTree& patient);

/// Marks every 3 mm, from 15 mm behind an ostium and 6 mm behind a fork on.
std::vector<CourseMark> course_marks(const KeptTree& tree);
/// Which groove a mark follows, now that it is known where the heart is: an LAD before it comes down to its
/// groove, an RCA behind the crux follow none; what lies 6 mm and more within the muscle is no mark.
std::vector<CourseMark> sorted_marks(const HeartShape& heart, const HeartFit& fit,
                                     std::vector<CourseMark> marks);

struct LaidOut {
  HeartFit fit;
  std::vector<CourseMark> marks;  ///< in the patient
  std::optional<Ostia> ostia;     ///< in the patient, where both are known
};
LaidOut lay_out(const PatientTree& patient, const KeptTree& tree, const HeartShape& heart);

/// Pairs of places for the map: along the arteries, at the root, on the heart between them, and in the chest.
WarpLandmarks landmarks(const HeartShape& heart, const LaidOut& laid);

}  // namespace ostia::phantom
