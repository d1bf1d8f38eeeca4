#pragma once
/// \file How far a vessel can be judged, beside its curved reformations and in its profile.

#include "ostia/session/evaluability_board.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/profile_view.h"

#include <string>
#include <vector>

namespace ostia::view {

Role role_of(analysis::Evaluability grade);
/// "limited: no clear edge, the edge is blurred", "not evaluable (reader)", in the words of the app.
std::string text_of(const analysis::EvaluableStretch& stretch);

/// A narrow band along the left border where the selected vessel is less than evaluable, with words beside it
/// where there is room; the parent's part of the way has the parent's. As long as the layer lives the view
/// shows it; the layer goes first.
class EvaluabilityLayer {
 public:
  EvaluabilityLayer(CurvedView& view, session::EvaluabilityBoard& board);
  ~EvaluabilityLayer();
  EvaluabilityLayer(const EvaluabilityLayer&) = delete;
  EvaluabilityLayer& operator=(const EvaluabilityLayer&) = delete;

 private:
  CurvedView& view_;
  std::vector<session::Subscription> own_;
};

/// Of the way from a vessel's root to its end: each vessel's stretches where it owns the way.
std::vector<analysis::EvaluableStretch> stretches_of_way(const session::EvaluabilityBoard& board,
                                                         const session::Workbench& bench,
                                                         std::int32_t vessel);

}  // namespace ostia::view
