// Another phase of the heart on the table.
#include "ostia/core/error.h"
#include "ostia/session/beating.h"
#include "ostia/session/workbench.h"

#include <exception>

namespace ostia::session {
namespace {

constexpr double on_axis_mm = 1e-6;

}  // namespace

void Workbench::show_phase(std::shared_ptr<const ShownPhase> phase, std::shared_ptr<const PhaseImage> image) {
  if (phase && !session_) throw InvalidInput("no case is open");
  if (phase && &phase->beating().model() != session_->file().model().get())
    throw InvalidInput("the tree has been edited since its motion was prepared: prepare it anew");
  if (!phase && !phase_) return;
  // Axes are made when they are first asked for, which may fail: then what was shown stays.
  if (phase && vessel.get() != no_vessel) phase->axis(vessel.get());
  double own = cursor_mm.get();
  bool follows = true;
  try {
    const std::shared_ptr<const geometry::AxisCurve> before = axis();
    own = own_mm(cursor_mm.get());
    // A slice that was scrolled away from the vessel stays where it is.
    follows = before && (before->point(cursor_mm.get()) - place.get()).norm() < on_axis_mm;
  } catch (const std::exception&) {  // another vessel was chosen, which has no axis at the phase that is left
  }
  phase_ = std::move(phase);
  phase_image_ = phase_ ? std::move(image) : nullptr;
  phase_changed.tell();
  const std::shared_ptr<const geometry::AxisCurve> after = axis();
  if (!after) return;
  place_stays_ = true;
  const double here = here_mm(own);
  cursor_mm.set_domain(Range<double>{0.0, after->length(), 0.0});
  cursor_mm.set(here);
  place_stays_ = false;
  if (follows) cursor_to_place();
}

void Workbench::leave_phase() {
  if (!phase_) return;
  phase_.reset();
  phase_image_.reset();
  phase_changed.tell();
}

const imaging::ImageVolume* Workbench::shown_volume() const {
  return phase_image_ && phase_image_->volume ? phase_image_->volume.get() : image_.volume.get();
}

double Workbench::image_phase() const {
  if (!phase_) throw InvalidInput("the case's own phase is shown");
  return phase_image_ && phase_image_->volume ? phase_image_->phase : phase_->template_phase();
}

double Workbench::here_mm(double own_mm) const {
  return phase_ && axis() ? phase_->axis(vessel.get()).here(own_mm) : own_mm;
}
double Workbench::own_mm(double here_mm) const {
  return phase_ && axis() ? phase_->axis(vessel.get()).at_template(here_mm) : here_mm;
}

void Workbench::require_own_phase() const {
  if (!phase_) return;
  phase_refused.tell();
  throw InvalidInput("the tree is shown at " + percent_of_cycle(phase_->phase()) +
                     " of the cycle; it can be edited and measured at " +
                     percent_of_cycle(phase_->template_phase()) + " only, the phase that the case is of");
}

}  // namespace ostia::session
