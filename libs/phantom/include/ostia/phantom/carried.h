#pragma once
/// \file What patients carry: wires, clips, electrodes and leads, and a scene with them.

#include "ostia/core/task_context.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/heart.h"
#include "ostia/phantom/heart_warp.h"
#include "ostia/phantom/scan_realism.h"
#include "ostia/phantom/scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::phantom {

/// A piece of metal: what is nearer to a line than its radius, which runs linearly between both ends.
struct MetalPiece {
  Vec3 from, to;
  double from_mm = 0.0, to_mm = 0.0;  ///< radii
};

enum class ThingKind { sternal_wire, clip, ecg_lead, pacemaker_lead };
const char* word(ThingKind kind);  ///< "sternal wire", "clip", "ECG lead", "pacemaker lead"

struct CarriedThing {
  ThingKind kind = ThingKind::sternal_wire;
  float hu = 8000.0f;
  std::vector<MetalPiece> pieces;
};

/// Where a patient is and what lies about there.
struct CarryingPatient {
  const HeartShape& heart;
  const CoronaryTree& tree;
  const HeartWarp* warp = nullptr;  ///< what heart and chest are bent by; null: not
  const Scene& body;                ///< electrodes are put on its skin
};
/// As many as are asked for, where they belong. Deterministic by the seed. Clips lie along a graft ("SVG")
/// where there is one, else behind the left edge of the sternum; electrodes where the skin is met from the
/// front.
std::vector<CarriedThing> carried_things(const CarryingPatient& patient, const ScanRealism& realism,
                                         std::uint64_t seed);

/// A scene with things in it, labelled metal. Coronary arteries stay as they are. The scene within must
/// outlive it.
class CarriedScene : public Scene {
 public:
  CarriedScene(const Scene& within, const std::vector<CarriedThing>& things);
  std::unique_ptr<const ScenePart> part(const geometry::Box3& box) const override;

 private:
  struct Piece {
    MetalPiece shape;
    float hu;
    geometry::Box3 box;
  };
  class Part;
  const Scene& within_;
  std::vector<Piece> pieces_;
};

}  // namespace ostia::phantom
