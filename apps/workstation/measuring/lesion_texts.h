#pragma once
/// \file The words of the table of lesions.

#include "ostia/session/lesion_board.h"
#include "ostia/session/pressure_readout.h"

#include <QStringList>
#include <optional>
#include <vector>

namespace ostia::workstation {

enum LesionColumn {
  number_column,
  segment_column,
  grade_column,
  percent_column,
  ffr_column,  ///< while pressures are shown
  mld_column,
  mla_column,
  lesion_length_column,
  plaque_column,
  class_column,
  evaluable_column,
  state_column,
  comment_column,
  lesion_columns
};
QStringList lesion_titles();          ///< short, as the header has them
QStringList lesion_titles_in_full();  ///< with units: "Minimal lumen diameter (mm)"
/// One text a column. The grade is the lesion's own; where it has none (LesionRow::bar) it says why.
QStringList lesion_cells(const session::LesionRow& row);
/// What a column sorts by, where that is a number.
std::vector<std::optional<double>> lesion_numbers(const session::LesionRow& row);
QString lesion_tip(const session::LesionRow& row);  ///< where it lies
/// "0.78", or "0.78, 0.91 if" with the stretches that are looked at as if they were otherwise.
QString ffr_cell(const std::optional<session::LesionFfr>& ffr);
QString ffr_tip(const std::optional<session::LesionFfr>& ffr);
QString state_word(session::LesionState state);

}  // namespace ostia::workstation
