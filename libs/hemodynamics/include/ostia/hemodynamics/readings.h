#pragma once
/// \file What is read off a tree's pressures: Pd/Pa everywhere, behind lesions, and along a pullback.

#include "ostia/hemodynamics/flow_state.h"
#include "ostia/hemodynamics/pulse.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::hemodynamics {

/// The sentence that stands in all that is shown and written.
constexpr std::string_view research_use =
    "Research software, not a medical device: these pressures and flows are computed, and no decision on a "
    "patient may "
    "rest on them.";

/// A narrowing, from its proximal to its distal end.
struct LesionPlace {
  std::string name;  ///< "S1"
  TreePlace from, throat, to;
};

struct ReadingOptions {
  double behind_mm = 25.0;     ///< of a lesion's end, where its FFR is read: usually 20 to 30, [0, 60]
  double least_seen_mm = 0.6;  ///< a narrower throat is narrower than CT can tell, [0, 2]
  double ectasia = 1.5;        ///< of the branch's median diameter: wider is marked, [1.1, 5]
  double threshold = 0.80;     ///< at or below: counts as significant
};
void validate(const ReadingOptions& options);  ///< throws InvalidInput

struct LesionReading {
  LesionPlace lesion;
  TreePlace read_at;       ///< behind its end, along the way of the largest flow
  double distance_mm = 0;  ///< from its end; less than asked for where the tree ends before
  bool ostial = false;     ///< it begins at the aorta
  double before = 1.0;     ///< Pd/Pa at its proximal end; 1 of an ostial one
  double behind = 1.0;     ///< Pd/Pa where it is read: the lesion's FFR
  double delta() const { return before - behind; }
  bool occluded =
      false;  ///< nothing flows through it: `behind` is not known (collateral flow is not modelled)
};

/// A way from the aorta to an outlet, as a wire is pulled back along it.
struct PullbackPoint {
  TreePlace place;
  double from_aorta_mm = 0.0;
  double ratio = 1.0;
};
struct Pullback {
  std::size_t outlet = 0;  ///< branch
  std::vector<PullbackPoint> points;
  /// Pullback pressure gradient index (Collet et al. 2019): near 1 focal, near 0 diffuse. 0 where less than
  /// 0.05 is lost on the whole way.
  double ppg_index = 0.0;
  double greatest_fall_20mm = 0.0;  ///< of Pd/Pa over 20 mm
};

/// Where the model does not hold, or is told to be looked at.
struct FlowMark {
  enum class Kind { reynolds, ectasia, occlusion, narrow, jet_at_end, graft } kind;
  TreePlace place;
  std::string text;  ///< one sentence
};
std::string_view name_of(FlowMark::Kind kind);

struct TreeReadings {
  double aortic_pa = 0.0;
  std::vector<std::vector<StationFlow>> stations;  ///< of each branch
  std::vector<LesionReading> lesions;
  std::vector<Pullback> pullbacks;  ///< one an outlet
  std::vector<FlowMark> marks;
  double ratio(std::size_t branch, std::size_t station) const {
    return stations[branch][station].pressure_pa / aortic_pa;
  }
};

/// Throws InvalidInput for options and for lesions whose branches are not there.
TreeReadings read_tree(const PreparedNetwork& network, const FlowState& state,
                       const std::vector<LesionPlace>& lesions, const ReadingOptions& options = {});

/// Pd/Pa where an outlet of the network ends; nothing behind an occlusion.
std::optional<double> outlet_ratio(const PreparedNetwork& network, const TreeReadings& readings,
                                   std::size_t outlet);
/// Pressure at a place of a tree, linear between stations.
double pressure_at(const PreparedNetwork& network, const TreeReadings& readings, const TreePlace& place);
/// So far downstream of a place, along the way of the largest flow; `gone_mm` is less where the tree ends.
TreePlace downstream(const PreparedNetwork& network, const Solution& solution, TreePlace from,
                     double distance_mm, double& gone_mm);

}  // namespace ostia::hemodynamics
