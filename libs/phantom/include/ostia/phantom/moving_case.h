#pragma once
/// \file A case at the phases of its heart's beat: image and truth, every point followed.

#include "ostia/core/task_context.h"
#include "ostia/geometry/contour_set.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/phantom/body.h"
#include "ostia/phantom/heartbeat.h"
#include "ostia/phantom/phantom_case.h"
#include "ostia/phantom/scene.h"
#include "ostia/phantom/truth.h"

#include <memory>
#include <string>
#include <vector>

namespace ostia::phantom {

/// Phases at equal distances from the R peak on, percent of RR. Throws InvalidInput unless 1 to 100 are asked
/// for.
std::vector<double> phase_percents(int phases);
/// "phase-05": the whole percents.
std::string phase_name(double percent);

/// The beat of a case.
Heartbeat heartbeat_of(const CasePlan& plan);

/// A still scene as it is at a phase. The map back to the template is interpolated linearly between exact
/// places 1 mm apart (to 0.03 mm); the scene must outlive it.
class MovedScene : public Scene {
 public:
  MovedScene(const Scene& still, const BeatPhase& phase) : still_(still), phase_(phase) {}
  std::unique_ptr<const ScenePart> part(const geometry::Box3& box) const override;

 private:
  const Scene& still_;
  BeatPhase phase_;
};

/// The case as the scanner sees it at a phase: its grid, and noise of its own. `body` is the case's.
Scan scan_phase(const CasePlan& plan, const Body& body, const BeatPhase& phase,
                const core::TaskContext& task = core::no_task());

/// Axes where they are at a phase, point by point. Radii grow as the cross-section's area does.
geometry::VesselTree moved(const geometry::VesselTree& tree, const BeatPhase& phase);
/// Contours point by point; abscissas stay those of the template's axis.
geometry::ContourSet moved(const geometry::ContourSet& contours, const BeatPhase& phase);
ChallengeVessel moved(const ChallengeVessel& vessel, const BeatPhase& phase);

}  // namespace ostia::phantom
