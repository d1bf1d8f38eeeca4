#pragma once
/// \file A case held against the contours of somebody who knows, while it is edited
/// (docs/reference/qa-mode.md).

#include "ostia/evaluation/contour_pairs.h"
#include "ostia/geometry/contour_set.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/session/active_time.h"
#include "ostia/session/ruled_surface.h"
#include "ostia/session/workbench.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// One contour of the truth and the wall in its plane.
struct ContourError {
  double s_mm = 0.0;   ///< on the case's axis
  bool found = false;  ///< false: no wall there, and the figures mean nothing
  evaluation::OutlineDifference difference;
};

/// One annotated section. Means are over its contours that were found.
struct SectionError {
  std::string section, vessel_name;  ///< as the truth names them
  std::int32_t vessel = Workbench::no_vessel;
  geometry::Health health = geometry::Health::healthy;
  double from_mm = 0.0, to_mm = 0.0;  ///< on the case's axis
  std::vector<ContourError> contours;
  std::size_t missing = 0;               ///< contours without a wall
  double mean_mm = 0.0, max_mm = 0.0;    ///< of the contour pairs; NaN where none was found
  double area_difference_mm2 = 0.0;      ///< case - truth
  double dice = 0.0;                     ///< of the areas, summed over the contours
  evaluation::AreaDistances surfaces{};  ///< of the ruled surfaces: its mean is the MSD
  bool matched() const { return vessel != Workbench::no_vessel; }
};

/// All sections of a vessel, or of the case.
struct WholeError {
  std::size_t sections = 0, unmatched = 0;  ///< unmatched ones are in no figure
  double length_mm = 0.0, missing_mm = 0.0;
  evaluation::AreaDistances surfaces{};
  double dice = 0.0;
};

/// A section of the truth where the case has it.
struct TruthSection : RuledSurface {
  geometry::ContourSection contours;
};

/// Watches the workbench. A section belongs to the vessel of its name where that runs through its contours
/// (their centroids no farther from the axis than the contour's mean radius and 1 mm, in the mean), else to
/// the vessel that runs nearest through them. The wall is the vessel's own (without side branches), as it is
/// solved for the screen. Figures are brought up to date when they are asked for, and only what an edit moved
/// is measured again (outlines that stay within 1e-4 mm are kept). One thread.
class QualityCheck {
 public:
  explicit QualityCheck(Workbench& bench);
  ~QualityCheck();

  /// Lumen contours; the observer "truth" is chosen where there is one. Throws InvalidInput (no contours of
  /// a lumen in it; read_contours), IoError; then all is as before.
  void open(const std::filesystem::path& path);
  void set_truth(geometry::ContourSet contours);
  void close();
  bool has_truth() const { return !truth_.sections.empty(); }
  const std::vector<std::string>& observers() const { return observers_; }

  Property<std::string> observer;  ///< whose contours are the truth
  Property<bool> shown{true};      ///< over the pictures

  /// Goes on measuring for about so long; true when all figures are up to date. The others below take as long
  /// as they need: ask this one first where somebody waits.
  bool advance(double budget_ms);
  /// Of the observer, in the file's order; empty without truth or case.
  const std::vector<TruthSection>& truth();
  std::uint64_t truth_revision();  ///< another number when `truth` is another
  const std::vector<SectionError>& sections();
  WholeError of_vessel(std::int32_t vessel);
  WholeError of_case();

  /// The worst section by MSD that was not gone to since all were; takes the workbench to its worst contour.
  /// Nothing where no section has figures.
  std::optional<std::size_t> next_worst();
  void go_to(std::size_t section);

  /// Signed distances of points from the truth's surface, positive outside, NaN where no section has the
  /// point between its ends within `reach_mm`. `places[i]` is the vessel and abscissa of point i.
  struct WallPlace {
    std::int32_t vessel = Workbench::no_vessel;
    double s_mm = 0.0;
  };
  std::vector<double> wall_errors(const std::vector<Vec3>& points, const std::vector<WallPlace>& places,
                                  double reach_mm = 3.0);

  ActiveTime& timer() { return timer_; }
  /// What bringing the figures up to date took the last time, and how many contours were measured for it.
  double last_update_ms() const { return last_update_ms_; }
  std::size_t last_update_contours() const { return last_update_contours_; }

  Signal<> stale;          ///< figures or truth are others: ask again, soon
  Signal<> truth_changed;  ///< `truth` is another

 private:
  struct Section;
  void match();
  void refresh();
  bool measure_some(std::size_t section, std::size_t most);
  void measure(std::size_t section, const std::vector<std::size_t>& changed);
  bool is_unmoved(std::size_t section, std::size_t contour) const;
  void chosen();
  void touched(const ModelEvent& event);
  Workbench& bench_;
  geometry::ContourSet truth_;
  std::vector<std::string> observers_;
  bool match_stale_ = true;
  std::uint64_t revision_ = 0;
  std::vector<TruthSection> matched_;
  std::vector<std::unique_ptr<Section>> states_;
  std::vector<SectionError> errors_;
  std::vector<std::size_t> visited_;
  ActiveTime timer_;
  double last_update_ms_ = 0.0;
  std::size_t last_update_contours_ = 0, measured_now_ = 0;
  double spent_now_ms_ = 0.0;
  std::vector<Subscription> own_;
};

}  // namespace ostia::session
