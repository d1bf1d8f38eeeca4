#include "opening/orientation.h"

#include "opening/opening.h"
#include "opening/orientation_dialog.h"
#include "shell/desk.h"

#include <utility>

namespace ostia::workstation {

Orientation::Orientation(Desk& desk, Opening& opening, std::function<void()> search)
    : QObject(&desk.window), desk_(desk), opening_(opening), search_(std::move(search)) {
  connect(&opening, &Opening::axes_unknown, this, &Orientation::ask);
}

bool Orientation::can_be_set() const {
  const session::OpenImage& image = desk_.bench.image();
  return image.volume && !image.reference.sha256.empty();
}

void Orientation::ask() {
  if (!can_be_set()) return;
  const session::OpenImage& image = desk_.bench.image();
  auto* dialog = new OrientationDialog(image.volume, opening_.as_read(), image.reference.axes,
                                       desk_.bench.grey.get(), desk_.bench.has_case(), &desk_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, [this, dialog, of = image.reference.sha256] {
    if (desk_.bench.image().reference.sha256 == of) give(dialog->axes());
  });
  dialog->open();
}

void Orientation::give(const std::string& axes) {
  const session::OpenImage& image = desk_.bench.image();
  const std::string own = imaging::axes_of(opening_.as_read());
  const std::string given = axes == own ? std::string() : axes;
  const std::string& now = image.reference.axes;
  if ((now.empty() ? own : now) == axes) {
    if (!desk_.bench.has_case()) search_();
    return;
  }
  const Step step{image.reference.sha256, now, given,
                  desk_.bench.has_case() ? desk_.case_path : std::filesystem::path()};
  if (!opening_.give_axes(given)) return;
  undone_.clear();
  done_.push_back(step);
}

bool Orientation::stands_at(const Step& step, const std::string& axes) const {
  const session::OpenImage& image = desk_.bench.image();
  return image.volume && image.reference.sha256 == step.image_sha256 && image.reference.axes == axes;
}

bool Orientation::can_take_back() const {
  if (done_.empty() || !stands_at(done_.back(), done_.back().to)) return false;
  return !desk_.bench.has_case() || !desk_.bench.session().file().next_undo();
}

bool Orientation::can_do_again() const {
  if (undone_.empty() || !stands_at(undone_.back(), undone_.back().from)) return false;
  return !desk_.bench.has_case() || !desk_.bench.session().file().next_redo();
}

void Orientation::take_back() {
  if (!can_take_back()) return;
  const Step step = done_.back();
  done_.pop_back();
  undone_.push_back(step);
  std::error_code ignored;
  if (std::filesystem::exists(step.former_case, ignored))
    opening_.open_with_axes(step.former_case, step.from);
  else
    opening_.give_axes(step.from);
}

void Orientation::do_again() {
  if (!can_do_again()) return;
  const Step step = undone_.back();
  undone_.pop_back();
  done_.push_back(step);
  opening_.give_axes(step.to);
}

}  // namespace ostia::workstation
