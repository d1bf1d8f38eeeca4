#pragma once
/// \file What the reader of a tree sees of a model beside the overlay.

#include "reading/reading_overlay.h"

#include "ostia/lumen/live_model.h"

#include <cstddef>
#include <optional>

namespace ostia::experiments {

/// A counted row beside the model's axes.
struct SeenRow {
  std::optional<std::size_t> axis;  ///< of ReadingSight::own; none: no axis runs in the lumen there
  double off_mm = 0.0;              ///< of that axis from the lumen's middle
};

/// A vessel of the model beside the true ones.
struct SeenVessel {
  double length_mm = 0.0, astray_mm = 0.0;  ///< of its own stretch
  double right_to_mm = 0.0;                 ///< on its own stretch: from there to its end it is astray
  std::optional<std::size_t> follows;       ///< of ReadingOverlay::axes: the one that it is in most
  double low_mm = 0.0, high_mm = 0.0;       ///< on that one's own stretch
  bool wrong() const { return astray_mm > 0.5 * length_mm; }
};

struct ReadingSight {
  std::vector<OwnAxis> own;
  std::vector<SeenVessel> vessels;         ///< one an own axis
  std::vector<std::vector<SeenRow>> rows;  ///< of each counted vessel
  /// For each counted vessel the own axis that is it: in most of its rows, half of them at least.
  std::vector<std::optional<std::size_t>> as;
};
/// `model` null: nothing is there.
ReadingSight look_at(const ReadingOverlay& overlay, const lumen::LumenModel* model,
                     const ReadingOptions& options);

/// The same as figures, with the wall. `live` null: nothing is there.
ReadingState state_of(const ReadingOverlay& overlay, const lumen::LiveModel* live,
                      const ReadingOptions& options);

/// How far, and whither, the middle of the model's wall lies from the true one's.
Vec3 wall_shift(const CountedRow& row, const lumen::ScalarField& wall);

enum class ReadingIssueKind { removal, trim, missing, short_end, name };
/// What is wrong with the tree itself, walls and middles of axes aside.
struct ReadingIssue {
  ReadingIssueKind kind = ReadingIssueKind::removal;
  std::int32_t model_vessel = 0;       ///< all but `missing`
  std::optional<std::size_t> counted;  ///< of ReadingOverlay::vessels: `missing`, `short_end`
  double s_mm = 0.0;        ///< `trim`: on the vessel's whole axis; `short_end`: the last row that is there
  std::string name;         ///< the vessel's; `name`: that it is to have
  std::string key() const;  ///< the same for the same fault
};
/// In the order in which a person mends them; `model` as in look_at.
std::vector<ReadingIssue> issues_of(const ReadingOverlay& overlay, const ReadingSight& sight,
                                    const lumen::LumenModel* model);

}  // namespace ostia::experiments
