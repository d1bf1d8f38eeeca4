#pragma once
/// \file The few words that views write over pictures, so that an app can give them in its language.

#include "ostia/analysis/evaluability.h"
#include "ostia/analysis/measurement_kinds.h"

#include <array>
#include <string>

namespace ostia::view {

/// UTF-8; English until an app sets others.
struct Words {
  std::string straightened = "straightened", stretched = "stretched";
  std::string axial = "axial", coronal = "coronal", sagittal = "sagittal", oblique = "oblique";
  std::string slab_mean = "mean", slab_maximum = "MIP", slab_minimum = "MinIP";  ///< before a thickness
  std::string diameter = "diameter, mm", area = "area, mm\u00b2";
  std::string from_root = "mm from its root";  ///< after a vessel's name
  std::string outer_wall = "outer wall";
  std::string low_attenuation = "low attenuation", fibrofatty = "fibrofatty", fibrous = "fibrous",
              calcified = "calcified";  ///< plaque, by class
  std::string evaluable = "evaluable", limited = "limited", not_evaluable = "not evaluable",
              by_reader = "reader";
  /// By analysis::EvaluabilityReason.
  std::array<std::string, 6> reasons{
      "the image ends", "voxels too coarse for its calibre", "hardly brighter than the noise",
      "no clear edge",  "calcium hides the lumen",           "the edge is blurred"};
  const std::string& reason(analysis::EvaluabilityReason one) const {
    return reasons[static_cast<std::size_t>(one)];
  }
  /// By analysis::MeasureKind: what a measurement without a name is called, before its number.
  std::array<std::string, analysis::measure_kinds.size()> kinds{
      "Distance", "Angle", "Area", "Diameter", "Stenosis", "Volume", "HU ring", "Arrow", "Note"};
  const std::string& kind(analysis::MeasureKind one) const { return kinds[static_cast<std::size_t>(one)]; }
  std::string ffr = "FFR (research)";  ///< before a number; says what it is for
  std::string what_if = "what if";     ///< before the number that it would be
  std::string not_measurable = "not measurable";
  std::string image = "image", tree = "tree";  ///< each before the phase of the heart that it is of
  // What the 3D view answers to clicks that place nothing.
  std::string off_wall = "There is no vessel: click on the wall of one.";
  std::string other_vessel = "This is another vessel: both places have to lie along one.";
  std::string no_lumen = "The lumen is shut or open here: there is nothing to measure across it.";
};
const Words& words();
/// Before views are made; one thread.
void set_words(Words words);

}  // namespace ostia::view
