#pragma once
/// \file Where the places of one scan's tree lie in another scan, by the images (docs/methods/compare.md).

#include "ostia/analysis/tree_match.h"
#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/registration/register.h"
#include "ostia/session/comparison.h"

#include <optional>
#include <string>

namespace ostia::session {

/// What is known before the images are asked: places every 2 mm on the axes that the scan shows, and the
/// ostia and forks of `fit` that are within 5 mm of each other when the trees are laid on each other, three
/// of them or none. Throws InvalidInput where the scan shows no place of the tree.
registration::Guidance guidance_of(const geometry::VesselTree& before, const imaging::ImageVolume& image,
                                   const analysis::TreeFit* fit = nullptr);

/// A map as compare_cases takes it; its words tell what it is.
ScanMap scan_map(const registration::Registration& found);

/// By what two cases are laid onto each other.
enum class MapBy {
  any,     ///< the images where both are there and their verdict is good, else the trees
  trees,   ///< the rigid motion between the trees
  images,  ///< the images, unless their verdict is that it failed
};
std::string to_string(MapBy by);        ///< "any", "trees", "images"
MapBy map_by(const std::string& text);  ///< of to_string; throws InvalidInput

/// Either the images' map, or why there is none.
struct MapOfImages {
  std::optional<ScanMap> map;
  std::string why_not;  ///< one sentence; empty where there is a map, or none was wanted
};
/// The map for a comparison of two cases and their images (null: not at hand). Throws InvalidInput where
/// `images` are asked for and one is not at hand, or they cannot be laid onto each other, with the reason;
/// Cancelled.
MapOfImages map_of_images(const geometry::VesselTree& before, const geometry::VesselTree& after,
                          const imaging::ImageVolume* before_image, const imaging::ImageVolume* after_image,
                          MapBy by, const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
