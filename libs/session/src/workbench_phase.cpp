// Another phase of the heart on the table.
#include "ostia/core/error.h"
#include "ostia/session/beating.h"
#include "ostia/session/workbench.h"

#include <exception>

namespace ostia::session {
namespace {

constexpr double on_axis_mm = 1e-6;

geometry::Box3 box_of(const imaging::Geometry& grid) {
  geometry::Box3 box;
  for (int n = 0; n < 8; ++n)
    box.extend(grid.world({n & 1 ? static_cast<double>(grid.size[0] - 1) : 0.0,
                           n & 2 ? static_cast<double>(grid.size[1] - 1) : 0.0,
                           n & 4 ? static_cast<double>(grid.size[2] - 1) : 0.0}));
  return box;
}

bool images_overlap(const imaging::Geometry& a, const imaging::Geometry& b) {
  return box_of(a).intersects(box_of(b));
}

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

void Workbench::show_other_image(std::shared_ptr<const OtherImage> image) {
  if (image && !image->volume) throw InvalidInput("there is no image to show");
  if (image && !image_.volume) throw InvalidInput("there is no image that another could be shown beside");
  if (image && !images_overlap(image->volume->geometry, image_.volume->geometry))
    throw InvalidInput("the images do not overlap: they are not of the same part of the body");
  if (image == other_image_) return;
  other_image_ = std::move(image);
  other_image_changed.tell();
}

void Workbench::leave_other_image() {
  if (!other_image_) return;
  other_image_.reset();
  other_image_changed.tell();
}

std::shared_ptr<const imaging::ImageVolume> Workbench::shown_image() const {
  if (phase_image_ && phase_image_->volume) return phase_image_->volume;
  return other_image_ ? other_image_->volume : image_.volume;
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
  if (!phase_ && !(other_image_ && session_)) return;
  phase_refused.tell();
  if (!phase_)
    throw InvalidInput("another image of the study is shown (" + other_image_->name +
                       "); the tree can be edited and measured on the case's own image only");
  throw InvalidInput("the tree is shown at " + percent_of_cycle(phase_->phase()) +
                     " of the cycle; it can be edited and measured at " +
                     percent_of_cycle(phase_->template_phase()) + " only, the phase that the case is of");
}

}  // namespace ostia::session
