#pragma once
/// \file Flat views: slices of the patient and sections across the selected vessel.

#include "ostia/reformat/plane.h"
#include "ostia/view/picture_view.h"

#include <string>

namespace ostia::view {

/// A view on a plane.
class PlaneView : public PictureView {
 public:
  explicit PlaneView(session::Workbench& bench) : PictureView(bench) {}
  bool ready() const override;
  std::optional<Vec3> world(const Vec2& px) override;
  std::optional<ViewPlace> project(const Vec3& place) override;
  double pixel_mm() override;
  void zoom(double factor, const Vec2& about_px) override;
  void pan(const Vec2& delta_px) override;
  void fit() override;
  /// The plane that is shown; nothing where there is nothing to show.
  const std::optional<reformat::Plane>& plane();
  std::vector<double> framing() const override;
  void set_framing(const std::vector<double>& framing) override;

 protected:
  /// Centre and axes; width, height and pixel follow from size and zoom.
  struct Placement {
    Vec3 centre = Vec3::Zero(), u = Vec3::UnitX(), v = Vec3::UnitY();
    double side_mm = 20.0;  ///< shown in the smaller direction when fitted
  };
  virtual std::optional<Placement> placement() const = 0;
  void size_changed() override { plane_fresh_ = false; }
  void moved();  ///< the placement is another
  GreyImage make_image() override;
  std::optional<lumen::ViewSurface> contour_surface() override;
  std::vector<Vec2> contour_seeds() override;
  std::vector<lumen::ContourLine> cut(const session::ShownPhase& phase) override;
  Vec2 pan_px_ = Vec2::Zero();
  double zoom_ = 1.0;

 private:
  std::optional<reformat::Plane> plane_;
  bool plane_fresh_ = false;
};

/// The section across the selected vessel at the cursor, or at some millimetres from it (a strip of
/// neighbours).
class SectionView final : public PlaneView {
 public:
  SectionView(session::Workbench& bench, double offset_mm, double side_mm = 16.0);
  void scroll(double steps) override;  ///< the cursor goes along the vessel
  double s_mm() const;
  double offset_mm() const { return offset_mm_; }
  /// What stands at this angle about the axis lies to the right; 0 at first.
  void set_turn_deg(double turn_deg);
  bool ready() const override;

 protected:
  std::optional<Placement> placement() const override;
  std::vector<Vec2> contour_seeds() override;
  void add_to_overlay(Overlay& overlay) override;

 private:
  double offset_mm_, side_mm_;
  double turn_deg_ = 0.0;
};

enum class SliceKind { axial, coronal, sagittal, oblique };
std::string to_string(SliceKind kind);

/// A slice of the patient through the cursor's place.
class SliceView final : public PlaneView {
 public:
  SliceView(session::Workbench& bench, SliceKind kind);
  void scroll(double steps) override;  ///< to the next slices
  bool ready() const override;
  SliceKind kind() const { return kind_; }
  void set_kind(SliceKind kind);
  /// Turns the oblique slice about its horizontal and vertical middle lines.
  void tilt(double about_horizontal_deg, double about_vertical_deg);
  std::vector<double> framing() const override;
  void set_framing(const std::vector<double>& framing) override;

 protected:
  std::optional<Placement> placement() const override;
  void add_to_overlay(Overlay& overlay) override;

 private:
  SliceKind kind_;
  Vec3 u_ = Vec3::UnitX(), v_ = Vec3::UnitY();  ///< of the oblique slice
};

}  // namespace ostia::view
