#pragma once
/// \file Plaque over a picture, coloured by its class.

#include "ostia/session/outer_wall_board.h"
#include "ostia/view/kept_tint.h"
#include "ostia/view/picture_view.h"

#include <memory>
#include <vector>

namespace ostia::view {

/// What the selected vessel's plaque is made of, between lumen and outer wall, pixel by pixel on its sections
/// and curved reformations, with a legend where the view has room for one. Other views show none of it. Made
/// for the picture that is shown, anew when that or the walls are others; while a hand turns a stretched
/// reformation it is left out. As long as the layer lives the view shows it; the layer goes first.
class PlaqueLayer {
 public:
  PlaqueLayer(PictureView& view, session::OuterWallBoard& board);
  ~PlaqueLayer();
  PlaqueLayer(const PlaqueLayer&) = delete;
  PlaqueLayer& operator=(const PlaqueLayer&) = delete;
  /// Whether shown or not; null where there is nothing to show. Its roles are those of the classes, in order.
  const std::shared_ptr<const OverlayTint>& tint();

 private:
  void draw(Overlay& overlay);
  void add_legend(Overlay& overlay) const;
  std::shared_ptr<const OverlayTint> made() const;
  PictureView& view_;
  session::OuterWallBoard& board_;
  KeptTint tint_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
