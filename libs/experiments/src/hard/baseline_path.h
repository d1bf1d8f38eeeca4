#pragma once
/// \file A vessel between two given points as the cheapest way through vesselness and brightness: a method to
/// compare with (C. Metz et al., Two point minimum cost path approach for CTA coronary centerline extraction,
/// 2008; Med. Phys. 36:5568-5579, 2009).

#include "hard/baseline_frangi.h"

#include "ostia/geometry/vec.h"

namespace ostia::experiments {

struct CheapestWayOptions {
  FrangiOptions vesselness;
  double bright_hu = 100.0, bright_width_hu = 25.0;  ///< brightness: 1 / (1 + exp(-(HU - bright) / width))
  double least = 1e-3;  ///< what is added to vesselness x brightness: no place costs more than 1 / least
};

/// What a millimetre costs at each voxel: 1 / (vesselness x brightness + least).
imaging::FloatVolume cost_per_mm(const imaging::ImageVolume& image, const CheapestWayOptions& options = {},
                                 const core::TaskContext& task = core::no_task());

/// The cheapest chains of voxels (26 neighbours; Dijkstra 1959) from the voxel at one place to those at the
/// others, as their centres, mm, one chain a place; neither smoothed nor centred. Places outside go to the
/// nearest voxel. Of ways that cost the same the one of lower voxels. Throws Cancelled.
std::vector<std::vector<geometry::Vec3>> cheapest_ways(const imaging::FloatVolume& cost_per_mm,
                                                       const geometry::Vec3& from,
                                                       const std::vector<geometry::Vec3>& to,
                                                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
