#pragma once
/// \file Where ends cannot be cut, a picture of them is among the results that are kept.

#include "output/kept_results.h"

#include "ostia/geometry/tri_mesh.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/meshing/clip.h"
#include "ostia/pipeline/ends_picture.h"

#include <optional>

namespace ostia::app {

class EndsNotCutPicture {
 public:
  /// `kept` gets the picture `ends.png`.
  explicit EndsNotCutPicture(KeptResults& kept) {
    kept.add("ends.png", [this](const std::filesystem::path& file) {
      if (picture_) picture_->write_png(file);
    });
  }
  /// Does `work`, which cuts the ends of `lumen`. Used within KeptResults::guard.
  template <class Work>
  auto guard(const geometry::TriMesh& lumen, const geometry::VesselTree& axes, const Work& work) {
    try {
      return work();
    } catch (const meshing::EndsNotCut& error) {
      picture_ = pipeline::picture_of_ends(lumen, axes, error.ends());
      throw;
    }
  }

 private:
  std::optional<figure::Picture> picture_;
};

}  // namespace ostia::app
