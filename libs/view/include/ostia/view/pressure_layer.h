#pragma once
/// \file FFR at the cursor and where it falls to the threshold, over a curved reformation.

#include "ostia/session/pressure_board.h"
#include "ostia/view/curved_view.h"

#include <string>
#include <vector>

namespace ostia::view {

/// "FFR (research) 0.78", with the 95 % where they are known "FFR (research) 0.78 (0.71\u20130.84)": beside
/// it stands what it is for.
std::string ffr_text(const std::optional<double>& ffr,
                     const std::optional<session::FfrInterval>& interval = {});
/// "what if 0.91".
std::string what_if_text(const std::optional<double>& ffr);

/// While the board is shown: FFR beside the cursor's line, below it what it would be with the stretches of
/// the case, and a short line where it falls to the threshold. As long as the layer lives the view shows it;
/// the layer goes first.
class PressureLayer {
 public:
  PressureLayer(CurvedView& view, session::PressureBoard& board);
  ~PressureLayer();
  PressureLayer(const PressureLayer&) = delete;
  PressureLayer& operator=(const PressureLayer&) = delete;

 private:
  void add(Overlay& overlay) const;
  CurvedView& view_;
  session::PressureBoard& board_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
