#pragma once
/// \file The contour lines of a view, kept up to date while the wall is edited.

#include "ostia/lumen/contour_lines.h"

#include <memory>
#include <span>
#include <vector>

namespace ostia::lumen {

/// Remembers what it has asked of the field, so that after an edit only what the edit could have changed is
/// evaluated again. The lines are those of `contour_lines`, to the last bit where the field outside `changed`
/// is what it was to the last bit. Not safe from several threads at once; different views may be updated at
/// the same time.
class ViewContours {
 public:
  /// Throws InvalidInput as `contour_lines` does; no lines before the first update.
  ViewContours(ViewSurface view, std::vector<Vec2> seeds_px, const ContourLineOptions& options = {});
  ~ViewContours();
  ViewContours(ViewContours&&) noexcept;
  ViewContours& operator=(ViewContours&&) noexcept;

  const std::vector<ContourLine>& lines() const;
  /// The lines of another field altogether.
  void update(const ScalarField& field);
  /// The lines of a field that is the one of the last update outside a box (IncrementalReport::changed,
  /// LiveChange::box; where it is empty nothing has changed). Where it throws, the lines are as before and
  /// the next update evaluates everything.
  void update(const ScalarField& field, const Box3& changed);
  /// Places that the last update asked the field for.
  std::size_t evaluations() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Several views at once, side by side on all cores.
void update_views(std::span<ViewContours* const> views, const ScalarField& field, const Box3& changed);

}  // namespace ostia::lumen
