#pragma once
/// \file A reader who edits a lumen until it agrees with an overlay ([Wels] 3, without a hand).

#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/contour_set.h"
#include "ostia/lumen/edit.h"
#include "ostia/lumen/scalar_field.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::experiments {

using geometry::Vec3;

/// How the reader works. Sizes of errors and shares are the experiment's conditions; the times are usual
/// values, not measured of persons.
struct ReaderOptions {
  int picture_px = 512;  ///< rows of a reformation; the section fills it
  double pointing_sigma_mm =
      0.05;         ///< of a click, in each direction; on a reformation no less than one pixel
  int points = 12;  ///< of a stroke, at most
  std::vector<double> lines_deg{
      0.0, 60.0,
      120.0};  ///< the reformations looked at; the twin is turned so that one of its views lies there
  double row_mm = 0.25;          ///< distance of the rows that are compared
  double section_step_mm = 2.0;  ///< distance of the cross-sections looked at
  double visible_px = 3.5;       ///< a disagreement of more pixels is seen
  double section_share = 0.3;    ///< of all strokes, at most, on cross-sections
  double beta_deg = 45.0;        ///< of lumen::CprStroke
  double eps_mm = 2.0;           ///< of lumen::SectionContour
  int most_strokes = 30;         ///< then the reader gives up
  double seconds_a_stroke = 2.0, seconds_a_point = 0.6, seconds_a_view = 2.0;  ///< modelled time
  std::uint64_t seed = 1;
};
void validate(const ReaderOptions& options);  ///< throws InvalidInput

/// One stroke with what made the reader draw it.
struct ReaderStroke {
  lumen::Edit edit;
  bool on_section = false;
  double worst_mm = 0.0;  ///< largest disagreement that the stroke is to mend
  double seconds = 0.0;   ///< modelled, the change of view included
};

/// Sees the contours of one section as an overlay and the wall as it is, on reformations and cross-sections
/// along the axis; never a score, never the truth.
class SimulatedReader {
 public:
  /// Whether a place of the overlay is none of the wall's: a branch leaves there.
  using Hidden = std::function<bool(const Vec3& place)>;
  /// Throws InvalidInput for a section with a fault or one that the axis does not run through.
  SimulatedReader(const geometry::ContourSection& overlay, std::shared_ptr<const geometry::AxisCurve> axis,
                  std::int32_t vessel, const ReaderOptions& options = {}, const Hidden& hidden = {});
  ~SimulatedReader();
  /// The next stroke, where they disagree most; nothing when no disagreement is visible.
  std::optional<ReaderStroke> next(const lumen::ScalarField& wall);
  /// The program refused the last stroke: it is not drawn again, another one is tried.
  void refused();
  /// Why `next` returned nothing.
  std::string why_stopped() const;
  double pixel_mm() const;
  double from_mm() const;  ///< abscissas between which the overlay lies
  double to_mm() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::experiments
