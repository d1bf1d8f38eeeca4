#include "comparison/one_cursor.h"

#include <cmath>

namespace ostia::workstation {
namespace {

using analysis::MatchedPlace;
using analysis::VesselMatch;
using geometry::Vec3;

constexpr double half_circle_deg = 180.0;

class Following {
 public:
  explicit Following(bool& flag) : flag_(flag) { flag_ = true; }
  ~Following() { flag_ = false; }
  Following(const Following&) = delete;
  Following& operator=(const Following&) = delete;

 private:
  bool& flag_;
};

}  // namespace

OneCursor::OneCursor(session::Workbench& now, session::Workbench& before) : now_(now), before_(before) {
  const auto from_now = [this](const auto&...) { follow_now(); };
  const auto from_before = [this](const auto&...) { follow_before(); };
  own_.push_back(now.vessel.observe(from_now));
  own_.push_back(now.cursor_mm.observe(from_now));
  own_.push_back(now.place.observe(from_now));
  own_.push_back(now.theta_deg.observe(from_now));
  own_.push_back(before.vessel.observe(from_before));
  own_.push_back(before.cursor_mm.observe(from_before));
  own_.push_back(before.place.observe(from_before));
  own_.push_back(before.theta_deg.observe(from_before));
  share(now.grey, before.grey);
  share(now.curved_mode, before.curved_mode);
  share(now.slab, before.slab);
  share(now.slab_mm, before.slab_mm);
  share(now.contours_shown, before.contours_shown);
  share(now.turning, before.turning);
}

template <class T>
void OneCursor::share(session::Property<T>& now, session::Property<T>& before) {
  before.set(now.get());
  own_.push_back(now.observe([&before](const T& value) { before.set(value); }));
  own_.push_back(before.observe([&now](const T& value) { now.set(value); }));
}

void OneCursor::set(std::shared_ptr<const session::Comparison> made) {
  made_ = std::move(made);
  mean_turns_.clear();
  follow_now();
}

double OneCursor::turn_of(const VesselMatch& match, const MatchedPlace& place) const {
  const auto is = now_.axis(match.after), was = before_.axis(match.before);
  if (!is || !was) return 0.0;
  const Vec3 carried = made_->fit.motion.rotation.transpose() *
                       geometry::radial_direction(is->frame(now_.here_mm(place.after_mm)), 0.0);
  return geometry::angle_of(was->frame(place.before_mm), carried) * half_circle_deg / M_PI;
}

double OneCursor::mean_turn(const VesselMatch& match) {
  const auto known = mean_turns_.find(match.after);
  if (known != mean_turns_.end()) return known->second;
  double x = 0.0, y = 0.0;
  for (const MatchedPlace& place : match.places) {
    const double turn = turn_of(match, place) * M_PI / half_circle_deg;
    x += std::cos(turn);
    y += std::sin(turn);
  }
  return mean_turns_[match.after] = std::atan2(y, x) * half_circle_deg / M_PI;
}

void OneCursor::follow_now() {
  if (!made_ || following_ || !now_.has_case() || !before_.has_case()) return;
  const Following following(following_);
  const auto& motion = made_->fit.motion;
  const geometry::Mat3 back = motion.rotation.transpose();
  const VesselMatch* match = made_->change.match.of_after(now_.vessel.get());
  const double s_mm = now_.own_mm(now_.cursor_mm.get());
  std::optional<double> there;
  if (match) there = match->to_before(s_mm);
  const auto is = now_.axis();
  const double there_mm = there.value_or(0.0);
  if (!there || !is) {
    before_.vessel.set(session::Workbench::no_vessel);
    before_.place.set(back * (now_.place.get() - motion.shift));
    reached.set(Reached::now_alone);
    return;
  }
  before_.vessel.set(match->before);
  before_.cursor_mm.set(there_mm);
  // Beside the axis, too: a click in a slice.
  const Vec3 beside = now_.place.get() - is->point(now_.cursor_mm.get());
  before_.place.set(before_.axis()->point(before_.cursor_mm.get()) + back * beside);
  before_.theta_deg.set(now_.theta_deg.get() + mean_turn(*match));
  turn_deg.set(turn_of(*match, {there_mm, s_mm}));
  reached.set(Reached::both);
}

void OneCursor::follow_before() {
  if (!made_ || following_ || !now_.has_case() || !before_.has_case()) return;
  const Following following(following_);
  const auto& motion = made_->fit.motion;
  const VesselMatch* match = made_->change.match.of_before(before_.vessel.get());
  const double s_mm = before_.cursor_mm.get();
  std::optional<double> there;
  if (match) there = match->to_after(s_mm);
  const auto was = before_.axis();
  const double there_mm = there.value_or(0.0);
  if (!there || !was) {
    now_.place.set(motion(before_.place.get()));
    reached.set(was ? Reached::before_alone : Reached::now_alone);
    return;
  }
  const Vec3 beside = before_.place.get() - was->point(s_mm);
  now_.vessel.set(match->after);
  now_.cursor_mm.set(now_.here_mm(there_mm));
  now_.place.set(now_.axis()->point(now_.cursor_mm.get()) + motion.rotation * beside);
  now_.theta_deg.set(before_.theta_deg.get() - mean_turn(*match));
  turn_deg.set(turn_of(*match, {s_mm, there_mm}));
  reached.set(Reached::both);
}

}  // namespace ostia::workstation
