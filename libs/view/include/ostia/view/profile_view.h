#pragma once
/// \file The lumen's size along the selected vessel as a plot.

#include "ostia/analysis/wall_flow.h"
#include "ostia/session/workbench.h"
#include "ostia/view/handle_hit.h"
#include "ostia/view/overlay.h"

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ostia::session {
class EvaluabilityBoard;
class OuterWallBoard;
class PressureBoard;
}  // namespace ostia::session

namespace ostia::view {

struct ProfileFlow;

/// Diameter and area along the vessel, the reference line, lesions and the cursor; the outer wall's diameter
/// while it or the plaque is shown. Beside them a solver's result, whose axes then take that of the area.
/// Abscissa runs to the right.
class ProfileView {
 public:
  explicit ProfileView(session::Workbench& bench);
  /// Where outer walls come from; it has to outlive the view, or null is set before it goes.
  void set_walls(session::OuterWallBoard* board);
  /// Where stretches come from that are less than evaluable; the same holds.
  void set_evaluability(session::EvaluabilityBoard* board);
  /// Where FFR along the vessel comes from, with an axis of its own in the place of the area's; the same
  /// holds.
  void set_pressure(session::PressureBoard* board);
  void set_flow(std::shared_ptr<const ProfileFlow> flow);  ///< null: none
  void set_size(int width, int height, double density);
  const Overlay& overlay();
  session::Signal<> stale;
  bool ready() const;
  std::optional<double> abscissa_at(double x_px) const;
  double x_of(double s_mm) const;
  double density() const { return density_; }
  /// Of the ends of measurements along the vessel, as short lines above the axis, the nearest within
  /// `reach_px`.
  std::optional<HandleHit> handle_near(const Vec2& px, double reach_px) const;
  /// The lesion whose band is there; nothing beside the plot.
  std::optional<analysis::Stenosis> lesion_at(const Vec2& px) const;
  session::Property<bool> area_shown{true};
  session::Workbench& bench() const { return bench_; }

 private:
  /// Where the plot lies, px, and what its axes reach to.
  struct Frame {
    double left = 0, right = 1, top = 0, bottom = 1;
    double length_mm = 1, most_mm = 1, most_mm2 = 1;
    double x(double s_mm) const;
    double y(double share) const;  ///< of an axis' reach; what lies beyond is drawn at its end
  };
  Frame frame() const;
  std::pair<Vec2, Vec2> end_line(double s_mm) const;
  std::vector<std::pair<double, double>> outer_wall() const;  ///< (s, diameter), where it is shown
  void add_text(const Vec2& px, const std::string& what, Role role, Anchor anchor);
  void add_tick(const Vec2& px, const std::string& what, Role role, Anchor anchor);  ///< beside its line
  void add_rows(const Frame& frame, double most, bool left, Role role);
  void add_axes(const Frame& frame);
  void add_stenoses(const Frame& frame);
  void add_stretches();
  void add_way(const Frame& frame);
  void add_evaluability(const Frame& frame);
  /// A line through the sections' shares of an axis; it breaks where one is not finite.
  void add_curve(const Frame& frame, const analysis::LumenProfile& profile, const OverlayLine& style,
                 const std::vector<double>& shares);
  void add_curves(const Frame& frame, const analysis::LumenProfile& profile);
  void add_outer_wall(const Frame& frame);
  void add_titles(const Frame& frame);
  // Of what flows (profile_flow.cpp).
  /// Of the selected vessel's way; none: not shown. Gathered once, until vessel, model or flow are others.
  const std::vector<analysis::FlowStation>& flow_along() const;
  void forget_flow_along() { flow_along_.reset(); }
  bool area_drawn() const { return area_shown.get() && !(flow_room_px() + ffr_room() > 0.0); }
  double flow_room_px() const;  ///< of its axes, in units of the interface
  void add_flow_line(const Frame& frame, const std::vector<analysis::FlowStation>& along, Role role,
                     const std::function<double(const analysis::FlowStation&)>& share);
  void add_shear(const Frame& frame, const std::vector<analysis::FlowStation>& along, double cursor_mm);
  void add_pressure(const Frame& frame, const std::vector<analysis::FlowStation>& along, double cursor_mm);
  void add_flow(const Frame& frame);
  // Of computed pressures (profile_pressure.cpp).
  bool ffr_drawn() const;
  double ffr_room() const;  ///< of its axis, in units of the interface
  void add_ffr(const Frame& frame);
  void add_ffr_axis(const Frame& frame, double low, double threshold);
  void touch();
  session::Workbench& bench_;
  int width_ = 0, height_ = 0;
  double density_ = 1.0;
  bool fresh_ = false;
  Overlay overlay_;
  session::OuterWallBoard* walls_ = nullptr;
  session::EvaluabilityBoard* evaluability_ = nullptr;
  session::PressureBoard* pressure_ = nullptr;
  std::shared_ptr<const ProfileFlow> flow_;
  struct FlowAlong {
    std::int32_t vessel = 0;
    std::vector<analysis::FlowStation> stations;
  };
  mutable std::optional<FlowAlong> flow_along_;
  std::vector<session::Subscription> own_, walls_changes_, evaluability_changes_, pressure_changes_;
};

}  // namespace ostia::view
