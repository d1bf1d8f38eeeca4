#pragma once
/// \file The same function kept up to date while a person edits.

#include "ostia/lumen/vessel_lumen.h"

#include <memory>
#include <optional>

namespace ostia::lumen {

/// What one change took, and what it could have altered.
struct IncrementalReport {
  int rows_removed = 0, rows_added = 0;
  bool refactored = false;  ///< decided by a count of changed rows, never by a clock
  double residual = 0.0;    ///< largest |f(p_i) - h_i|, mm
  geometry::Box3 changed;   ///< outside it f is what it was, to 1e-6 mm
  double changed_from_mm = 0.0,
         changed_to_mm = 0.0;  ///< abscissas whose wall may have moved by more than 1e-6 mm
};

/// A vessel with the sparse Cholesky factor of its system. Changes of samples change the factor, and what is
/// shown equals the fresh solution (`solve`) to 1e-6 mm. For the screen only: what is stored is solved
/// afresh.
class IncrementalSurface {
 public:
  explicit IncrementalSurface(const VesselLumen& vessel);  ///< throws as `solve` does
  ~IncrementalSurface();
  IncrementalSurface(IncrementalSurface&&) noexcept;
  IncrementalSurface& operator=(IncrementalSurface&&) noexcept;

  /// Removes samples by id, then adds. The axis and options stay; for others make a new one. Throws
  /// InvalidInput for unknown ids and NumericalError where the residual stays above tolerance after
  /// refactoring; then all is as before.
  IncrementalReport change(const std::vector<std::int64_t>& removed, const std::vector<SurfaceSample>& added);
  std::shared_ptr<const ImplicitSurface> surface() const;
  const std::vector<SurfaceSample>& samples() const;  ///< in canonical order

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::lumen
