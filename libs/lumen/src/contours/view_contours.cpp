#include "ostia/lumen/view_contours.h"

#include "contours/contour_tracer.h"

#include "ostia/core/parallel.h"

#include <optional>

namespace ostia::lumen {

struct ViewContours::Impl {
  ViewSurface view;
  std::vector<Vec2> seeds;
  ContourLineOptions options;
  std::optional<ContourTracer> tracer;
  bool traced = false;  // what the tracer remembers is of the last field
  std::vector<ContourLine> lines;
  std::size_t evaluations = 0;

  void trace(const ScalarField& field) {
    try {
      lines = tracer->trace(field);
      evaluations = tracer->evaluations();
      traced = true;
    } catch (...) {
      traced = false;
      throw;
    }
  }
  void start() {
    tracer.emplace(view, seeds, options);
    traced = false;
  }
};

ViewContours::ViewContours(ViewSurface view, std::vector<Vec2> seeds_px, const ContourLineOptions& options)
    : impl_(std::make_unique<Impl>()) {
  validate(view);
  validate(options);
  impl_->view = std::move(view);
  impl_->seeds = std::move(seeds_px);
  impl_->options = options;
  impl_->start();
}
ViewContours::~ViewContours() = default;
ViewContours::ViewContours(ViewContours&&) noexcept = default;
ViewContours& ViewContours::operator=(ViewContours&&) noexcept = default;

const std::vector<ContourLine>& ViewContours::lines() const {
  return impl_->lines;
}
std::size_t ViewContours::evaluations() const {
  return impl_->evaluations;
}

void ViewContours::update(const ScalarField& field) {
  impl_->start();
  impl_->trace(field);
}

void ViewContours::update(const ScalarField& field, const Box3& changed) {
  if (!impl_->traced) return update(field);
  if (changed.isEmpty()) {
    impl_->evaluations = 0;
    return;
  }
  impl_->tracer->forget(changed);
  impl_->trace(field);
}

void update_views(std::span<ViewContours* const> views, const ScalarField& field, const Box3& changed) {
  core::parallel_for(views.size(), 1, [&](std::size_t i) { views[i]->update(field, changed); });
}

}  // namespace ostia::lumen
