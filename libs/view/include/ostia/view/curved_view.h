#pragma once
/// \file A curved planar reformation of the selected vessel.

#include "ostia/reformat/curved_reformation.h"
#include "ostia/view/picture_view.h"

#include <utility>

namespace ostia::view {

/// Zoom and place along the vessel: the two CPRs share them.
struct CurvedFrame {
  std::optional<double> pixel_mm;  ///< nothing: as each view's size asks
  double top_mm = 0.0;             ///< abscissa at the first row, with `pixel_mm`
  bool whole = false;              ///< without `pixel_mm`: all of the vessel, or large enough to see its wall
  session::Signal<> changed;
};

/// One of the two CPRs; the second is turned by 90 degrees. Proximal is at the top.
class CurvedView final : public PictureView {
 public:
  enum class Which { first, second };
  CurvedView(session::Workbench& bench, Which which, std::shared_ptr<CurvedFrame> frame);

  bool ready() const override;
  std::optional<Vec3> world(const Vec2& px) override;
  std::optional<ViewPlace> project(const Vec3& place) override;
  double pixel_mm() override;
  void zoom(double factor, const Vec2& about_px) override;
  void pan(const Vec2& delta_px) override;
  void fit() override;
  void scroll(double steps) override;  ///< the cursor goes along the vessel

  double theta_deg() const;  ///< of this view
  double abscissa_at(double y_px);
  double row_of(double s_mm);
  /// Where the axis runs in the view: a row's pixel.
  Vec2 axis_at(double s_mm);
  /// Its points, and the ends of those along the vessel: the short lines at the right border.
  std::optional<HandleHit> handle_near(const Vec2& px, double reach_px) override;
  /// `project` for a place whose abscissa is about known: in bends a place has several feet.
  std::optional<ViewPlace> project_near(const Vec3& place, double s_mm);
  std::vector<double> framing() const override;
  void set_framing(const std::vector<double>& framing) override;

 protected:
  void size_changed() override { reformation_.reset(); }
  GreyImage make_image() override;
  Vec2 contour_offset() const override { return Vec2(offset_px_, 0.0); }
  bool is_torn(const Vec2& picture_px) override;
  std::optional<lumen::ViewSurface> contour_surface() override;
  std::vector<Vec2> contour_seeds() override;
  std::vector<lumen::ContourLine> cut(const session::ShownPhase& phase) override;
  lumen::ContourLineOptions line_options() const override;
  void add_to_overlay(Overlay& overlay) override;

 private:
  const reformat::CurvedReformation* reformation();
  std::pair<Vec2, Vec2> end_line(double s_mm);
  /// Of each point of the wall, about how far out of the view it lies; NaN above, below and far beside it.
  std::vector<double> about_out_mm(const session::ShownPhase& phase);
  void add_parents(Overlay& overlay);
  void add_stretches(Overlay& overlay);
  void moved();
  void read();    ///< large enough to see the wall, about the cursor
  void follow();  ///< scrolls so that the cursor stays in the view
  double fitted_pixel_mm() const;
  Which which_;
  std::shared_ptr<CurvedFrame> frame_;
  void set_frame(double pixel_mm, double top_mm);
  int shift_px_ = 0;  ///< of the axis to the right of the middle
  int offset_px_ = 0;
  std::unique_ptr<reformat::CurvedReformation> reformation_;
  std::vector<reformat::CurvedReformation::Row> rows_;  // at the rows' edges; empty: not asked for yet
};

}  // namespace ostia::view
