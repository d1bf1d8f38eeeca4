#pragma once
/// \file What all 2D views have in common: a piece of the patient on a rectangle of pixels.

#include "ostia/lumen/contour_lines.h"
#include "ostia/lumen/view_contours.h"
#include "ostia/session/workbench.h"
#include "ostia/view/handle_hit.h"
#include "ostia/view/overlay.h"

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace ostia::session {
class ShownPhase;
}

namespace ostia::view {

/// Where a place of the patient appears, and how far in front of or behind the view it lies.
struct ViewPlace {
  Vec2 px = Vec2::Zero();
  double out_mm = 0.0;
};

/// A view of the workbench. Image and overlay are made when they are asked for and something has changed;
/// only what has changed is made. Pixels are those of the device; (0, 0) is the first one's outer corner, y
/// runs down. One thread.
class PictureView {
 public:
  explicit PictureView(session::Workbench& bench);
  virtual ~PictureView();
  PictureView(const PictureView&) = delete;
  PictureView& operator=(const PictureView&) = delete;

  /// `density`: device pixels to a unit of the interface (2 on a screen scaled to 200 %).
  void set_size(int width, int height, double density);
  int width() const { return width_; }
  int height() const { return height_; }
  double density() const { return density_; }

  /// Empty where there is nothing to show.
  const GreyImage& image();
  /// Grows with each image made: a painter keeps what it made of the last one.
  std::uint64_t image_revision() const { return image_revision_; }
  const Overlay& overlay();
  /// What image() and overlay() would have to make first, and takes the time: image and contour lines.
  void prepare();
  /// Whoever shows pictures that move may have coarse ones of a thick slab at first, and asks for the real
  /// one when they rest.
  void allow_drafts() { drafts_allowed_ = true; }
  bool is_draft() const { return draft_; }  ///< image() is a coarse one
  void refine();                            ///< the next image() is not
  /// Something fades away: ask for the overlay again soon.
  bool animating() const { return !fading_.empty(); }

  /// Somebody should ask for image and overlay again.
  session::Signal<> stale;

  virtual bool ready() const = 0;  ///< there is something to show, and world and project mean something
  virtual std::optional<Vec3> world(const Vec2& px) = 0;
  virtual std::optional<ViewPlace> project(const Vec3& place) = 0;
  virtual double pixel_mm() = 0;                   ///< size of a device pixel in the patient
  std::optional<double> value_at(const Vec2& px);  ///< CT number of the image there; nothing outside

  virtual void zoom(double factor, const Vec2& about_px) = 0;  ///< above 1: larger; `about_px` stays
  virtual void pan(const Vec2& delta_px) = 0;                  ///< what is shown moves so far
  virtual void fit() = 0;                                      ///< all in the view
  virtual void scroll(double steps) = 0;  ///< a wheel's steps, positive away from the user

  /// The wall's lines as they are now, in pixels and in the patient.
  const std::vector<lumen::ContourLine>& contour_lines();
  /// Of them the point nearest to a place of the picture, if within `reach_px`.
  struct WallHit {
    Vec3 place = Vec3::Zero();
    Vec2 px = Vec2::Zero();
    double distance_px = 0.0;
  };
  std::optional<WallHit> wall_near(const Vec2& px, double reach_px);

  /// What a tool shows while it works (a stroke, a ball); replaced as a whole.
  void set_tool_overlay(Overlay overlay);

  /// Of the handles of measurements the nearest within `reach_px` of a place, as the view shows them.
  virtual std::optional<HandleHit> handle_near(const Vec2& px, double reach_px);

  /// Something of others over the picture, under what the tool shows; asked whenever the overlay is made.
  using Layer = std::function<void(Overlay& overlay)>;
  enum class LayerPlace { plaque, truth, outer_wall, evaluability, pressure, fat, calcium };
  void set_layer(Layer layer, LayerPlace place = LayerPlace::truth);
  void touch_layer() { overlay_stale(); }  ///< the layer shows something else
  /// Another number whenever world and project may mean something else.
  std::uint64_t placement_revision() const { return placement_revision_; }
  /// How the person has set the view (zoom, pan, ...), so that a view of the same size on the same workbench
  /// shows the same, to the last bit. Throws InvalidInput for numbers that are no framing of such a view.
  virtual std::vector<double> framing() const = 0;
  virtual void set_framing(const std::vector<double>& framing) = 0;

  session::Workbench& bench() const { return bench_; }

 protected:
  virtual void size_changed() {}  ///< before everything is stale
  void image_stale();             ///< what is shown moved: image, lines and overlay
  void contours_stale();          ///< the wall is another
  void overlay_stale();
  virtual GreyImage make_image() = 0;
  bool wants_draft() const { return drafts_allowed_ && !refining_; }
  void mark_draft() { draft_ = true; }  ///< what make_image makes is one
  /// The picture's coordinates for contour lines differ from the view's by this (a picture wider than the
  /// view).
  virtual Vec2 contour_offset() const { return Vec2::Zero(); }
  virtual std::optional<lumen::ViewSurface> contour_surface() = 0;
  virtual std::vector<Vec2> contour_seeds() = 0;
  /// The lines of the wall at another phase of the heart.
  virtual std::vector<lumen::ContourLine> cut(const session::ShownPhase& phase) = 0;
  virtual lumen::ContourLineOptions line_options() const;
  /// At a place of the contour lines' picture: one row shows there what lies far apart, so that a line would
  /// be drawn across the picture where there is no wall.
  virtual bool is_torn(const Vec2&) { return false; }
  virtual void add_to_overlay(Overlay& overlay) = 0;
  /// Measurements' marks whose points lie within `reach_mm` of the view.
  void add_measurements(Overlay& overlay, double reach_mm);
  void add_fading(Overlay& overlay, double reach_mm);
  void add_scale_bar(Overlay& overlay);
  /// Which slab is shown, and how thick it is; nothing without one.
  void add_slab(Overlay& overlay);
  /// At another phase of the heart: which, and of which phase the image is.
  void add_phase(Overlay& overlay);
  void add_letters(Overlay& overlay, const Vec3& right, const Vec3& down);
  double units(double length) const { return length * density_; }
  /// Keeps observing the workbench as long as the view lives.
  void keep(session::Subscription subscription) { own_.push_back(std::move(subscription)); }
  void on_model_changed(const session::ModelEvent& event);

 private:
  struct Fading {
    Vec3 place;
    std::chrono::steady_clock::time_point since;
  };
  void bring_contours();
  void add_contours(Overlay& overlay);
  session::Workbench& bench_;
  int width_ = 0, height_ = 0;
  double density_ = 1.0;
  GreyImage image_;
  Overlay overlay_, tool_overlay_;
  std::uint64_t image_revision_ = 0, placement_revision_ = 0;
  std::array<Layer, 7> layers_;  // by LayerPlace
  bool image_fresh_ = false, overlay_fresh_ = false;
  bool drafts_allowed_ = false, draft_ = false, refining_ = false;
  enum class Lines { fresh, moved, anew } lines_state_ = Lines::anew;
  geometry::Box3 lines_changed_;
  std::unique_ptr<lumen::ViewContours> contours_;
  std::vector<lumen::ContourLine> cut_;  // in their place at another phase
  std::vector<Fading> fading_;
  std::vector<session::Subscription> own_;
};

/// Prepares several views of one workbench side by side on all cores.
void prepare(const std::vector<PictureView*>& views);

}  // namespace ostia::view
