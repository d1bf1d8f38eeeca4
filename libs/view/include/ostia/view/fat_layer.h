#pragma once
/// \file The fat about a main artery over its reformations, coloured by its CT number.

#include "ostia/session/fat_board.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/kept_tint.h"

#include <array>
#include <memory>
#include <vector>

namespace ostia::view {

/// A colour of the map. The first bound is FatOptions::from_hu, the last to_hu.
struct FatColor {
  Role role;
  double to_hu;  ///< brighter fat is of the next
};
/// -70 HU is about where the index of inflamed fat begins (Oikonomou et al. 2018), at 120 kV.
inline constexpr std::array<FatColor, 3> fat_colors{
    {{Role::fat_dark, -110.0}, {Role::fat_middle, -70.0}, {Role::fat_bright, -30.0}}};

/// What of the selected vessel's surroundings is fat, within the stretch and the reach of its index, pixel by
/// pixel; at edges, too. While a hand turns a stretched reformation it is left out. As long as the layer
/// lives the view shows it; the layer goes first.
class FatLayer {
 public:
  FatLayer(CurvedView& view, session::FatBoard& board);
  ~FatLayer();
  FatLayer(const FatLayer&) = delete;
  FatLayer& operator=(const FatLayer&) = delete;
  /// Whether shown or not; null where there is nothing to show. Its roles are those of fat_colors, in order.
  const std::shared_ptr<const OverlayTint>& tint();

 private:
  void draw(Overlay& overlay);
  std::shared_ptr<const OverlayTint> made() const;
  CurvedView& view_;
  session::FatBoard& board_;
  KeptTint tint_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
