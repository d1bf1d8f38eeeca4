#pragma once
/// \file What a 2D view shows, as plain values: an image, and lines, marks and texts over it. An app paints
/// it.

#include "ostia/figure/color.h"
#include "ostia/geometry/vec.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::view {

using geometry::Vec2;
using geometry::Vec3;

/// CT numbers, rows from the top; NaN outside the image.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// What something over the image means; the app's theme knows its colour and width.
enum class Role {
  lumen,        ///< the wall
  outer_wall,   ///< where the vessel's wall ends
  truth,        ///< the wall as somebody else knows it
  axis,         ///< of the selected vessel
  other_axis,   ///< of the others
  cursor,       ///< the one place that runs through all views
  reference,    ///< calibre without disease, places of reference
  stenosis,     ///< a lesion
  measurement,  ///< that a person placed
  selected,     ///< the measurement or handle that is chosen
  stroke,       ///< being drawn
  dismissed,    ///< samples that an edit took away
  handle,       ///< can be taken hold of
  information,  ///< texts in corners, scales, ticks
  warning,
  diameter,  ///< curves of the profile
  area,
  grid,
  low_attenuation,  ///< plaque, by class
  fibrofatty,
  fibrous,
  calcified,
  axial_plane,  ///< one of three linked planes, where another view shows it
  coronal_plane,
  sagittal_plane,
  shear,  ///< of a solver's result along the vessel
  pressure,
  what_if,  ///< pressures as if the vessel were another
  limited,  ///< stretches that can be judged in part, and not at all
  not_evaluable,
  calcium_lm,  ///< lesions of a calcium score, by artery
  calcium_lad,
  calcium_lcx,
  calcium_rca,
  calcium_elsewhere,
  fat_dark,  ///< about an artery, by its CT number
  fat_middle,
  fat_bright,
};

struct OverlayLine {
  std::vector<Vec2> px;
  Role role = Role::lumen;
  double opacity = 1.0;
  bool dashed = false;
  std::optional<figure::Color> color = {};  ///< a vessel's, instead of the role's; the same below
  std::optional<std::int32_t> of = {};      ///< of a measurement (its id): its label keeps off the line
};
struct OverlayMark {
  Vec2 px = Vec2::Zero();
  Role role = Role::handle;
  double radius = 3.0;  ///< in units of the interface, not of pixels
  double opacity = 1.0;
  bool filled = true;
  std::optional<figure::Color> color = {};
};
/// Which point of the text stands at its place.
enum class Anchor { top_left, top, top_right, left, middle, right, bottom_left, bottom, bottom_right };
struct OverlayText {
  Vec2 px = Vec2::Zero();
  std::string text;
  Role role = Role::information;
  Anchor anchor = Anchor::top_left;
  /// Of a measurement (its id): stands beside `px` where place_labels puts it, whatever `anchor` is.
  std::optional<std::int32_t> label_of = {};
  bool stays =
      false;  ///< beside something drawn (a tick, a legend's square): it makes room for no other text
};
/// A filled band (a lesion along the profile).
struct OverlayBand {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< opposite corners
  Role role = Role::stenosis;
  double opacity = 0.25;
  std::optional<figure::Color> color = {};
};

/// Pixels of the view that are coloured as what they show; the image stays visible below.
struct OverlayTint {
  int left = 0, top = 0, width = 0, height = 0;  ///< a rectangle of the view's pixels
  std::vector<std::uint8_t> what;                ///< rows from the top; 0: nothing, i: roles[i - 1]
  std::vector<Role> roles;
  double opacity = 0.38;
};

/// Painted in this order: tints, bands, lines, marks, texts.
struct Overlay {
  std::vector<std::shared_ptr<const OverlayTint>> tints;
  std::vector<OverlayBand> bands;
  std::vector<OverlayLine> lines;
  std::vector<OverlayMark> marks;
  std::vector<OverlayText> texts;
};

/// A bar of a round length (1, 2 or 5 times a power of ten mm) no longer than a quarter of `width_px`.
struct ScaleBar {
  double length_px = 0.0;
  std::string text;  ///< "10 mm"
};
ScaleBar scale_bar(double pixel_mm, int width_px);

}  // namespace ostia::view
