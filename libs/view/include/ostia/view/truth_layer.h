#pragma once
/// \file The truth's lines over a picture.

#include "ostia/session/quality_check.h"
#include "ostia/view/picture_view.h"

#include <cstdint>
#include <vector>

namespace ostia::view {

/// Where a triangle surface meets a view: `px` and `out_mm` of each of its points (ViewPlace), triangles with
/// points on both sides of the view are cut, linearly between their points, and the cuts are joined to lines.
/// A cut longer than `most_px` is left out: the view jumps there. Closed lines end with their first point.
std::vector<std::vector<Vec2>> lines_of_cut(const geometry::TriMesh& surface,
                                            const std::vector<std::optional<ViewPlace>>& places,
                                            double most_px);

/// Where a wall of rings meets a view, as lines_of_cut has them: on a curved reformation that of the selected
/// vessel, on flat views any.
std::vector<std::vector<Vec2>> lines_on(PictureView& view, const session::RuledSurface& wall);

/// The observer's contours on one view: lines where their ruled surface meets it, so that between two
/// contours it is what is between them. On a curved reformation those of the selected vessel, at the view's
/// angle. Made anew when view or truth are others, not when the wall is. As long as the layer lives the view
/// shows it; the layer goes first.
class TruthLayer {
 public:
  TruthLayer(PictureView& view, session::QualityCheck& check);
  ~TruthLayer();
  TruthLayer(const TruthLayer&) = delete;
  TruthLayer& operator=(const TruthLayer&) = delete;
  const std::vector<std::vector<Vec2>>& lines();  ///< in the view's pixels, whether shown or not

 private:
  void draw(Overlay& overlay);
  void make();
  PictureView& view_;
  session::QualityCheck& check_;
  std::vector<std::vector<Vec2>> lines_;
  std::uint64_t placed_ = 0, truth_ = 0;
  bool made_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::view
