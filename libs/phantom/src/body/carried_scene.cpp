#include "ostia/phantom/carried.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::phantom {
namespace {

bool is_coronary(Label label) {
  return label == Label::coronary_lumen || label == Label::vessel_wall || label == Label::soft_plaque ||
         label == Label::fibrous_plaque || label == Label::calcified_plaque || label == Label::metal;
}

/// Negative in the metal; where it is thin, about the distance.
double metal_distance(const MetalPiece& piece, const Vec3& p) {
  const Vec3 along = piece.to - piece.from, d = p - piece.from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp(d.dot(along) / length2, 0.0, 1.0) : 0.0;
  return (d - t * along).norm() - (piece.from_mm + t * (piece.to_mm - piece.from_mm));
}

}  // namespace

/// The pieces of metal that a block may hold, and what else is there.
class CarriedScene::Part : public ScenePart {
 public:
  Part(std::unique_ptr<const ScenePart> within, std::vector<const Piece*> pieces)
      : within_(std::move(within)), pieces_(std::move(pieces)) {}

  Material at(const Vec3& p) const override {
    const Material other = within_->at(p);
    for (const Piece* piece : pieces_)
      if (metal_distance(piece->shape, p) < 0.0 && !is_coronary(other.label))
        return {Label::metal, piece->hu};
    return other;
  }
  std::optional<Material> uniform() const override {
    return pieces_.empty() ? within_->uniform() : std::nullopt;
  }
  bool fine_near(const Vec3& p, double reach_mm) const override {
    for (const Piece* piece : pieces_)
      if (metal_distance(piece->shape, p) < reach_mm) return true;
    return within_->fine_near(p, reach_mm);
  }

 private:
  std::unique_ptr<const ScenePart> within_;
  std::vector<const Piece*> pieces_;
};

CarriedScene::CarriedScene(const Scene& within, const std::vector<CarriedThing>& things) : within_(within) {
  for (const CarriedThing& thing : things) {
    for (const MetalPiece& shape : thing.pieces) {
      const Vec3 reach = Vec3::Constant(std::max(shape.from_mm, shape.to_mm));
      pieces_.push_back(
          {shape, thing.hu, {shape.from.cwiseMin(shape.to) - reach, shape.from.cwiseMax(shape.to) + reach}});
    }
  }
}

std::unique_ptr<const ScenePart> CarriedScene::part(const geometry::Box3& box) const {
  // A voxel's pieces may lie a little beyond the block that its centre is in.
  const Vec3 beyond = Vec3::Constant(1.0);
  const geometry::Box3 wide(box.min() - beyond, box.max() + beyond);
  std::vector<const Piece*> near;
  for (const Piece& piece : pieces_)
    if (piece.box.intersects(wide)) near.push_back(&piece);
  std::unique_ptr<const ScenePart> within = within_.part(box);
  if (near.empty()) return within;
  return std::make_unique<Part>(std::move(within), std::move(near));
}

}  // namespace ostia::phantom
