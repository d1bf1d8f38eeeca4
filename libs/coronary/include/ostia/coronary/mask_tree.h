#pragma once
/// \file A labelled coronary tree from a mask that a network or a hand has drawn.

#include "ostia/coronary/axes.h"
#include "ostia/coronary/labels.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::coronary {

/// docs/methods/mask-tree.md gives the method and where the defaults come from.
struct MaskTreeOptions {
  double thick_mm = 5.5;           ///< what holds a ball of this radius is aorta or chamber, [3, 15]
  double speck_mm = 5.0;           ///< parts whose lines are no longer than that are left out, [0, 50]
  double least_branch_mm = 3.0;    ///< branches that stand out less from their parent are left out, [0.5, 50]
  double longest_gap_mm = 15.0;    ///< over which a part is joined to a tree, [0, 50]
  double least_probability = 0.2;  ///< of a bridge that is built, [0, 1]
  double smooth_radii = 5.0;       ///< waves of the axes shorter than that go, in radii, [0, 50]
  double step_mm = 0.5;            ///< between points of the axes, [0.1, 2]
  LabelOptions labels;
};
void validate(const MaskTreeOptions& options);  ///< throws InvalidInput

/// A gap that was bridged.
struct MaskBridge {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< mm; `from` is the part's that was joined
  double probability = 0.0;                     ///< that both are one vessel, [0, 1]
  bool to_side = false;                         ///< `to` lies beside a vessel instead of at its end
  double length_mm() const { return (to - from).norm(); }
};

/// A place where the mask was one and vessels are two.
struct MaskCut {
  Vec3 place = Vec3::Zero();  ///< mm
  double radius_mm = 0.0;     ///< of the mask there
};

/// What became of an end so that a mesh can be cut there.
struct MaskEndChange {
  enum class Kind {
    shortened,  ///< it touched another vessel
    left_out,   ///< a stub that ends within reach of the vessel that it comes from
    led_on,     ///< an ostium right at its first fork begins earlier
  };
  Kind kind = Kind::shortened;
  Vec3 place = Vec3::Zero();  ///< where the line ended before, mm
  double length_mm = 0.0;     ///< that was taken away, or added before an ostium
  std::int32_t vessel = 0;    ///< of the tree; 0: left out
};

struct MaskTree {
  LabelledTree vessels;  ///< axes with radii; roots: the ostia, then those of parts that joined no tree
  std::vector<AxisNotes> notes;  ///< one a vessel, in the tree's order; evidence: of the bridges on its way
  std::vector<Vec3> ostia;       ///< the left one first, where both are there
  imaging::MaskVolume lumen;     ///< what the vessels were made of: the mask without aorta and specks
  std::vector<MaskBridge> bridges;
  std::vector<MaskCut> cuts;
  std::vector<MaskEndChange> ends;
  std::vector<std::string> warnings;  ///< what was left out, joined and parted, in plain words
};

/// What is thicker than an artery goes (aorta, chambers), and so do specks. The skeleton's lines are joined
/// over gaps where they point at each other, the two ostia are chosen by calibre, branching and the usual
/// way from one to the other in a patient in LPS, and what makes a circle between them is parted: vessels
/// that cross each by themselves, others at their thinnest place. Axes are smooth and in the middle, and end
/// where a plane across them meets one vessel alone.
///
/// `labels`: 0 outside; one value, or one a vessel, whose borders are where vessels are parted first. Throws
/// InvalidInput for options out of range and an empty mask, GeometryError for a mask without a vessel (an
/// organ, specks alone), naming what was found and what to do, Cancelled. Deterministic.
MaskTree mask_tree(const imaging::MaskVolume& labels, const MaskTreeOptions& options = {},
                   const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
