#pragma once
/// \file What must lie about an aorta before it is believed to be one of a heart
/// (docs/methods/coronary-input.md).

#include "ostia/coronary/aorta.h"

#include <string>

namespace ostia::coronary {

/// The left heart's chambers beside an aorta: as bright as it and wider than 14 mm everywhere.
struct HeartChambers {
  double core_ml = 0.0;                                  ///< what is left of them 7 mm inside their walls
  Vec3 core = Vec3::Zero();                              ///< its centre, LPS, mm
  Vec3 lower_end = Vec3::Zero(), middle = Vec3::Zero();  ///< of the aorta that was given
};
HeartChambers chambers_beside(const imaging::ImageVolume& image, const Aorta& aorta,
                              const core::TaskContext& task = core::no_task());

/// What that says. Without chambers (abdomen, neck, an image cut above the root), or with chambers above the
/// aorta (an image that stands on its head), this is no aorta to begin from.
struct HeartVerdict {
  std::string refusal;  ///< why, and what to do; empty: there is a heart below it
  std::string warning;  ///< chambers on its wrong side: mirrored or turned; names are not to be trusted
};
HeartVerdict judge(const HeartChambers& heart);

/// In plain words, after a search for the aorta that failed: no contrast agent, or contrast that lies
/// otherwise (turned image, cut heart); with what to do. "; ..." or nothing.
std::string why_no_aorta(const imaging::ImageVolume& image, const core::TaskContext& task = core::no_task());
/// The first of these alone: that there is no contrast agent, as in a scan for the calcium score; else empty.
std::string why_no_contrast(const imaging::ImageVolume& image,
                            const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
