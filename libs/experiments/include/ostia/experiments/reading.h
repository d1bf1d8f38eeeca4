#pragma once
/// \file The reading experiment: how many actions a simulated reader takes from an image to a coronary tree
/// that is right, with the tree that the search finds and without it (docs/experiments/reading.md).

#include "ostia/core/task_context.h"
#include "ostia/experiments/simulated_reader.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/phantom/coronary_tree.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ostia::experiments {

/// Modelled times of the hand beside those of strokes (ReaderOptions): the keystroke-level model's (Card,
/// Moran and Newell, Commun. ACM 23, 1980), s, each >= 0.
struct HandTimes {
  double think_s = 1.35;  ///< before each action
  double home_s = 0.4;    ///< the hand from mouse to keyboard
  double key_s = 0.28, point_s = 1.1, press_s = 0.1;
};

/// How the whole tree is read.
struct ReadingOptions {
  double tolerance_mm = 0.3;       ///< of wall and axis; less is not seen, [0.1, 2]
  double least_diameter_mm = 1.5;  ///< vessels and stretches that are thinner do not count, [0.5, 4]
  double astray_mm = 1.0;          ///< an axis so far outside of every true lumen follows no artery, (0, 20]
  double click_sigma_mm = 0.3;     ///< of a click on a slice, in each direction, [0, 2]
  double view_mm = 40.0;           ///< length of a vessel that a reformation shows, [10, 200]
  int most_actions = 200;          ///< then the reader gives up, [1, 10000]
  HandTimes times;
  /// Of strokes. `visible_px` and `seed` are set from the members here; every stroke may be on a
  /// cross-section, at most 20 mend one view.
  ReaderOptions strokes = [] {
    ReaderOptions usual;
    usual.section_share = 1.0;
    usual.most_strokes = 20;
    return usual;
  }();
  std::uint64_t seed = 1;
};
void validate(const ReadingOptions& options);  ///< throws InvalidInput

enum class ReadingAct {
  search,    ///< "find the coronary arteries"
  removal,   ///< a vessel that follows no artery
  addition,  ///< a missing vessel by its ends
  naming,
  ending,  ///< an end that goes on, or is cut off
  axis,    ///< a pull at the centerline, or a control point put on it
  stroke,  ///< on a reformation or a cross-section
  undo
};
inline constexpr ReadingAct reading_acts[] = {ReadingAct::search, ReadingAct::removal, ReadingAct::addition,
                                              ReadingAct::naming, ReadingAct::ending,  ReadingAct::axis,
                                              ReadingAct::stroke, ReadingAct::undo};
const char* word(ReadingAct act);  ///< "search", "removal", ...

/// One thing that the hand did. What the program refused counts as what it was to be.
struct ReadingAction {
  ReadingAct act = ReadingAct::stroke;
  std::string vessel;  ///< true name, or that of the vessel that was wrong
  int clicks = 0;      ///< places in the image that were clicked; a stroke has none
  double seconds = 0.0;
  std::string refusal;  ///< why the program did not do it; empty: it did
  // Of strokes.
  bool on_section = false;
  double s_mm = 0.0;      ///< on the true vessel, of the stroke's middle
  double worst_mm = 0.0;  ///< largest disagreement that it was to mend
};

/// How a model differs from the truth on the stretches that count.
struct ReadingState {
  double length_mm = 0.0;                           ///< of these stretches
  double missing_mm = 0.0;                          ///< of them without an axis in the lumen
  double wall_off_mm = 0.0;                         ///< of them with a wall beyond the tolerance
  double axis_off_mm = 0.0;                         ///< of them with an axis beyond it
  double beyond_mm = 0.0;                           ///< of them with any of these
  double worst_wall_mm = 0.0, worst_axis_mm = 0.0;  ///< where there is an axis in the lumen
  double astray_mm = 0.0;                           ///< of the model's vessels, what follows no artery
  int wrong_names = 0;                              ///< of vessels that are there
  double share_beyond() const { return length_mm > 0.0 ? beyond_mm / length_mm : 0.0; }
};

/// A tree's reading from one start.
struct ReadingRun {
  std::string patient;  ///< "seed 3"
  bool automatic = false;
  std::string search_refusal;  ///< why the search found nothing; the reader then began without it
  std::vector<ReadingAction> actions;
  double looking_s = 0.0;  ///< modelled, for the views that were looked at
  ReadingState before, after;
  bool gave_up = false;           ///< at the most actions
  std::vector<std::string> left;  ///< what the reader saw and could not mend
  std::string digest;             ///< of the final model; empty without one
  std::size_t vessels = 0;        ///< true ones that count
  std::size_t count(ReadingAct act) const;
  std::size_t refused() const;
  int clicks() const;
  double seconds() const;  ///< modelled, of actions and looking
};

/// Reads one tree: vessels that follow no artery go, missing ones come, ends and names are put right, then
/// vessel by vessel axis and wall. `start` null: there is nothing but the image. Seen is the truth as an
/// overlay, never a score. Deterministic, the same for any number of threads. Throws InvalidInput for options
/// out of range, a truth without a vessel that counts, or a start that cannot be solved; Cancelled.
ReadingRun read_tree(const phantom::CoronaryTree& truth, const imaging::ImageVolume& image,
                     const std::shared_ptr<const lumen::LumenModel>& start,
                     const ReadingOptions& options = {}, const core::TaskContext& task = core::no_task());

/// Which patients are read, each scanned on the heart's own field.
struct ReadingPatients {
  std::uint64_t first_seed = 1;
  int patients = 5;        ///< [1, 200]
  double voxel_mm = 0.5;   ///< in the plane, [0.35, 2]
  bool hard = false;       ///< patients and scans as phantom::hard_case draws them
  double noise_hu = 25.0;  ///< where they are not, [0, 500]
  double motion_mm = 0.0;  ///< during the exposure, where they are not, [0, 10]
  ReadingOptions reader;   ///< `seed` is set from the patient's
};
void validate(const ReadingPatients& options);  ///< throws InvalidInput

/// Each patient read twice: from the tree that the search finds, then from nothing. Where the search refuses,
/// both begin with nothing. Deterministic. Throws InvalidInput, Cancelled.
std::vector<ReadingRun> read_patients(const ReadingPatients& options = {},
                                      const core::TaskContext& task = core::no_task());

/// The three quartiles of something over patients.
struct ReadingQuartiles {
  double low = 0.0, median = 0.0, high = 0.0;
};
/// By linear interpolation; NaN without values.
ReadingQuartiles quartiles_of(std::vector<double> values);

/// Patients of one start together.
struct ReadingSummary {
  std::size_t patients = 0, gave_up = 0, refused_searches = 0;
  ReadingQuartiles actions, tree_actions;  ///< all, and all but strokes
  std::vector<ReadingQuartiles> by_act;    ///< as reading_acts has them
  ReadingQuartiles clicks, minutes, share_before, share_beyond, worst_wall_mm, worst_axis_mm, missing_mm;
};
ReadingSummary summarize(const std::vector<ReadingRun>& runs, bool automatic);

/// What decides whether the experiment was done already.
std::string parameters_json(const ReadingPatients& options);
/// docs/schemas/experiment-reading.schema.json.
std::string reading_json(const std::vector<ReadingRun>& runs, const ReadingPatients& options);
/// The table in plain text.
std::string reading_text(const std::vector<ReadingRun>& runs);
/// Into an existing folder: patients.csv, actions.csv, report.html.
void write_reading_report(const std::filesystem::path& folder, const std::vector<ReadingRun>& runs,
                          const ReadingPatients& options);

}  // namespace ostia::experiments
