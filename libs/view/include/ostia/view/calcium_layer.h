#pragma once
/// \file The lesions of a calcium score over a slice, coloured by the artery that they lie in.

#include "ostia/session/calcium_board.h"
#include "ostia/view/kept_tint.h"
#include "ostia/view/plane_view.h"

#include <memory>
#include <vector>

namespace ostia::view {

/// The role of a place: one for each of LM, LAD, LCX, RCA, and one for all that is not coronary.
Role calcium_role(analysis::CalciumPlace place);

/// Pixel by pixel where the plane meets lesions, on the image that was scored alone; the chosen one is ringed
/// on the slices that it is seen in. As long as the layer lives the view shows it; the layer goes first.
class CalciumLayer {
 public:
  CalciumLayer(PlaneView& view, session::CalciumBoard& board);
  ~CalciumLayer();
  CalciumLayer(const CalciumLayer&) = delete;
  CalciumLayer& operator=(const CalciumLayer&) = delete;
  /// Whether shown or not; null where there is nothing to show.
  const std::shared_ptr<const OverlayTint>& tint();

 private:
  void draw(Overlay& overlay);
  std::shared_ptr<const OverlayTint> made() const;
  PlaneView& view_;
  session::CalciumBoard& board_;
  KeptTint tint_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
