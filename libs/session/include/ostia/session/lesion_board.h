#pragma once
/// \file The lesions of the workbench's vessels as a list: what is known, the work that finds the plaque, and
/// the reader's word.

#include "ostia/analysis/lesions.h"
#include "ostia/coronary/certainty.h"
#include "ostia/session/evaluability_board.h"
#include "ostia/session/found_walls.h"
#include "ostia/session/lesion_grading.h"
#include "ostia/session/workbench.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// Which of the lesions that are found are told, in lists and in reports: those on the vessel's own part,
/// which begins at `own_from_mm` (before it lies its parent's); plaque by itself only where the image can be
/// judged: elsewhere an outer wall is a guess. `stretches`: of its vessel; empty: not known, all is told.
inline bool is_told(const analysis::Lesion& lesion, double own_from_mm,
                    const std::vector<analysis::EvaluableStretch>& stretches) {
  if (lesion.stenosis.throat_mm < own_from_mm) return false;
  if (lesion.narrows) return true;
  const auto here = analysis::worst_within(stretches, lesion.stenosis.throat_mm, lesion.stenosis.throat_mm);
  return !here || here->grade != analysis::Evaluability::not_evaluable;
}

/// A lesion as a list shows it.
struct LesionRow {
  int number = 0;  ///< as a report of the case numbers it once all plaque is known
  std::int32_t vessel = 0;
  std::string vessel_name, segment;  ///< the standard segment's label; empty where none has a name
  analysis::Lesion lesion;
  std::optional<analysis::EvaluableStretch> evaluable;  ///< the worst of it; nothing: not known
  LesionState state = LesionState::open;
  bool checked = false;    ///< a person is done with its vessel
  bool has_image = false;  ///< an image is open, so that what is not known of it yet will be
  std::string comment;
  bool unlikely = false;  ///< its vessel is hardly an artery (unlikely_vessels)

  GradeBar bar() const { return grade_bar(state, checked, evaluable, unlikely); }  ///< why it has no grade
};

/// A vessel whose plaque is to be measured.
struct PlaqueWork : WallsWanted {
  std::shared_ptr<FoundWalls> known;  ///< where its walls are looked for, or were

  using Found = analysis::PlaqueProfile;
  /// Any thread; nothing where no outer wall can be looked for. Throws as vessel_walls does.
  std::optional<Found> found(const core::TaskContext& task = core::no_task()) const;
};

/// Watches the workbench. After an edit what was known of a vessel's plaque is kept until it is found anew,
/// also where other vessels come or go; another image or case begins afresh. What the reader said is in the
/// case (Annotations), by the vessel's id, and found again with the vessel. One thread.
class LesionBoard {
 public:
  /// `walls`: what others who look for walls find, too.
  LesionBoard(Workbench& bench, EvaluabilityBoard& evaluability,
              std::shared_ptr<FoundWalls> walls = std::make_shared<FoundWalls>());
  LesionBoard(const LesionBoard&) = delete;
  LesionBoard& operator=(const LesionBoard&) = delete;

  Signal<> changed;  ///< rows may be others

  /// Of all vessels whose profile is measured (Workbench::profile_work has nothing), each lesion at the
  /// vessel that owns its throat; numbered through. What an edit moved is measured again first.
  const std::vector<LesionRow>& rows();
  /// How many vessels' plaque is not known yet, or not any more; 0 without an image.
  int missing() const;
  /// The selected vessel first; nothing where all is known or cannot be.
  std::optional<PlaqueWork> work() const;
  /// Takes what the work found; nothing: it cannot be found, and is not tried again until an edit. False, and
  /// nothing taken, where model or image are others by now.
  bool take(const PlaqueWork& work, std::optional<analysis::PlaqueProfile> found);

  /// The reader's word on a lesion, as a step that can be undone. Throws InvalidInput.
  void say(const LesionRow& lesion, LesionState state, const std::string& comment);

 private:
  struct Known {
    std::optional<analysis::PlaqueProfile> plaque;
    bool stale = true;
    double length_mm = 0.0;  ///< of its vessel
  };
  void drop();
  void read_certainty();
  void touch();
  void add_rows(const geometry::Vessel& vessel, bool unlikely);
  bool unknown(std::int32_t vessel) const;
  Workbench& bench_;
  EvaluabilityBoard& evaluability_;
  std::shared_ptr<FoundWalls> found_;
  std::map<std::int32_t, Known> known_;
  std::vector<coronary::VesselCertainty> certainty_;  ///< as the case keeps it
  std::vector<LesionRow> rows_;
  bool fresh_ = false, finding_ = false;
  std::vector<Subscription> own_;
};

}  // namespace ostia::session
