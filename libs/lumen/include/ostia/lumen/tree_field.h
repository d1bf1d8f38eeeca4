#pragma once
/// \file The whole tree as one field ([Wels] 2.4).

#include "ostia/lumen/lumen_model.h"
#include "ostia/lumen/scalar_field.h"

#include <memory>
#include <vector>

namespace ostia::lumen {

/// [Wels] eq. 4: -1 where f < -w, 0 where f > w, linear between.
double field_function(double f, double width_mm);

/// g + 0.5, so that it is negative inside and zero on the wall like its branches, in units of 2w per mm.
///
/// sharp: g = min_i f_i^w ([Wels] eq. 5), the exact union.
///
/// smooth: where two branches are both below rho, the pair's union is
///   m - S(c) (m - r),  m = min(f_i, f_j),  r = rho - sqrt((rho - f_i)^2 + (rho - f_j)^2),
/// and the least over all pairs is taken. rho is w, but no more than 0.8 of the constant that a vessel's f
/// goes to far from its samples (FarField::constant: its offset), since f tells no distance beyond that. r is
/// the arc of radius rho that touches both walls where they are perpendicular. c is the cosine between the
/// two gradients and S rises from 0 (the walls run the same way) to 1 (90 degrees and more) as the smoothstep
/// of 1 - c. What this promises:
///  - nothing is removed: smooth <= sharp everywhere;
///  - exactly sharp where one wall alone is near (any other f_j >= rho), so everywhere but at joints;
///  - on the wall, m <= (1 - 1/sqrt 2) rho = 0.293 rho: no fillet is deeper than that under both walls
///  together,
///    and two walls that face each other are bridged where the gap is below 0.59 rho;
///  - along a stretch where one branch runs inside the other or along its wall, tangentially to within 20
///    degrees, S <= 0.011: the parent's wall is lifted by less than 0.005 rho (1 um for rho = 0.2 mm);
///  - once differentiable where at most two walls are that near (kernels with continuous gradients).
class TreeField final : public ScalarField {
 public:
  /// Throws InvalidInput for no branches, a null one, or a width outside (0, 2] mm.
  TreeField(std::vector<std::shared_ptr<const ScalarField>> branches, const BlendOptions& blend);
  TreeField(const std::vector<std::shared_ptr<const ImplicitSurface>>& branches, const BlendOptions& blend);

  double value(const Vec3& place) const override;
  /// Exact; in fillets the share of S's slope is by central differences (1e-6 of the whole).
  Vec3 gradient(const Vec3& place) const override;
  /// A branch is asked for the places in its box alone.
  void values(std::span<const Vec3> places, std::span<double> out) const override;
  Box3 box() const override;
  double wall_slope() const override { return 0.5 / blend_.width_mm; }
  const std::vector<std::shared_ptr<const ScalarField>>& branches() const { return branches_; }
  const BlendOptions& blend() const { return blend_; }

 private:
  class Near;
  void batch_values(std::span<const Vec3> places, std::span<double> out) const;
  std::vector<std::shared_ptr<const ScalarField>> branches_;
  std::vector<Box3> boxes_;
  std::vector<double> radii_;  // of the arcs with each branch, at most
  BlendOptions blend_;
};

}  // namespace ostia::lumen
