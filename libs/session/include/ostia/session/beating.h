#pragma once
/// \file A case's wall and axes at any phase of the heart, carried by a cage. See
/// docs/reference/workstation.md, "The beating case".

#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/cage_motion.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/motion/moving_cage.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace ostia::session {

using geometry::Vec3;

/// The image of one phase; null: the case's own, at the template's.
struct PhaseImage {
  std::shared_ptr<const imaging::ImageVolume> volume;
  double phase = 0.0;  ///< share of the cycle
};

/// A vessel's axis where the cage has carried it. Abscissas of both phases belong to the same places of the
/// vessel, straight between marks 0.5 mm apart.
class CarriedAxis {
 public:
  CarriedAxis(std::shared_ptr<const geometry::AxisCurve> curve, std::vector<double> template_mm,
              std::vector<double> here_mm);
  const std::shared_ptr<const geometry::AxisCurve>& curve() const { return curve_; }
  double here(double template_mm) const;  ///< clamped to the ends, as is the other
  double at_template(double here_mm) const;

 private:
  std::shared_ptr<const geometry::AxisCurve> curve_;
  std::vector<double> template_mm_, here_mm_;
};

class Beating;

/// The tree at one phase. Immutable to those who ask; axes are made when they are asked for. Any thread.
class ShownPhase {
 public:
  ShownPhase(std::shared_ptr<const Beating> beating, double phase);
  double phase() const { return phase_; }  ///< share of the cycle, [0, 1)
  double template_phase() const;
  const Beating& beating() const { return *beating_; }
  /// The triangles of the wall that Beating was given, their points carried.
  const std::shared_ptr<const geometry::TriMesh>& wall() const { return wall_; }
  const CarriedAxis& axis(std::int32_t vessel) const;  ///< throws InvalidInput

 private:
  std::shared_ptr<const Beating> beating_;
  double phase_;
  std::vector<Vec3> control_points_;
  std::shared_ptr<const geometry::TriMesh> wall_;
  mutable std::mutex making_;
  mutable std::map<std::int32_t, std::unique_ptr<const CarriedAxis>> axes_;
};

/// A motion and a model that goes with it. Immutable.
class Beating : public std::enable_shared_from_this<Beating> {
 public:
  /// The wall (LiveModel::wall) and the axes of the model are at the template's phase. Throws InvalidInput
  /// for a motion that is none (motion::MovingCage), and where a tenth of the wall or more lies outside of
  /// the cage: the motion is another tree's.
  static std::shared_ptr<const Beating> made(const geometry::CageMotion& motion,
                                             std::shared_ptr<const lumen::LumenModel> model,
                                             geometry::TriMesh wall);
  const geometry::CageMotion& motion() const { return motion_; }
  const lumen::LumenModel& model() const { return *model_; }
  const geometry::TriMesh& wall() const { return wall_; }
  const motion::MovingCage& cage() const { return cage_; }
  std::shared_ptr<const ShownPhase> at(double phase) const;  ///< 1.25 is 0.25
  /// Of each point of the wall the abscissa, at the template's phase, of the nearest foot on a vessel's axis;
  /// NaN where that is farther than 15 mm. Made once a vessel, which takes its time. Throws InvalidInput.
  const std::vector<double>& wall_feet(std::int32_t vessel) const;

 private:
  friend class ShownPhase;
  struct AxisPoints {
    std::vector<double> s_mm;      // at equal steps
    motion::CarriedPoints points;  // of the axis, and last one beside its first, towards the first normal
    std::vector<double> radius;
  };
  Beating(const geometry::CageMotion& motion, std::shared_ptr<const lumen::LumenModel> model,
          geometry::TriMesh wall);
  const AxisPoints& axis_points(std::int32_t vessel) const;
  std::unique_ptr<const CarriedAxis> carried_axis(std::int32_t vessel,
                                                  const std::vector<Vec3>& control_points) const;
  geometry::CageMotion motion_;
  std::shared_ptr<const lumen::LumenModel> model_;
  geometry::TriMesh wall_;
  motion::MovingCage cage_;
  motion::CarriedPoints wall_points_;
  mutable std::mutex making_;
  mutable std::map<std::int32_t, std::unique_ptr<const AxisPoints>> axis_points_;
  mutable std::map<std::int32_t, std::unique_ptr<const std::vector<double>>> wall_feet_;
};

/// The distance of two phases around the cycle, [0, 0.5].
double phase_distance(double a, double b);
std::string percent_of_cycle(double phase);  ///< "35 %", "37.5 %"

}  // namespace ostia::session
