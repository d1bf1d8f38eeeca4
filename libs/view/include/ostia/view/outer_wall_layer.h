#pragma once
/// \file The outer wall's lines over a picture.

#include "ostia/session/outer_wall_board.h"
#include "ostia/view/picture_view.h"

#include <cstdint>
#include <vector>

namespace ostia::view {

/// Where the known outer walls meet one view, as dashed lines; on a curved reformation the selected vessel's.
/// Made anew when view or walls are others. As long as the layer lives the view shows it; the layer goes
/// first.
class OuterWallLayer {
 public:
  OuterWallLayer(PictureView& view, session::OuterWallBoard& board);
  ~OuterWallLayer();
  OuterWallLayer(const OuterWallLayer&) = delete;
  OuterWallLayer& operator=(const OuterWallLayer&) = delete;
  const std::vector<std::vector<Vec2>>& lines();  ///< in the view's pixels, whether shown or not

 private:
  PictureView& view_;
  session::OuterWallBoard& board_;
  std::vector<std::vector<Vec2>> lines_;
  std::uint64_t placed_ = 0, known_ = 0;
  bool made_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
