#pragma once
/// \file The bound on circumradii that a mesher asks for at a place inside.

#include "mesher/mesher_job.h"

#include "ostia/geometry/kd_tree.h"
#include "ostia/meshing/size_field.h"

namespace ostia::meshing {

/// The job's field, where it has one, between what the surface's own triangles allow: near the surface they
/// cannot be refined, and a mesher that is asked for less than their circumradii adds points for ever. A
/// field's bound is led to the surface's with the field's gradation.
class InteriorSizes {
 public:
  explicit InteriorSizes(const MesherJob& job);
  double operator()(const geometry::Vec3& place) const;

 private:
  const MesherJob& job_;
  geometry::KdTree surface_;
  SizeLookup field_;
};

}  // namespace ostia::meshing
