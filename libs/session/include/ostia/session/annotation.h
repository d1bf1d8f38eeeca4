#pragma once
/// \file What a person notes in a case beside the model: measurements, marks at vessels, what the computed
/// pressures are told, and what the report says by a person.

#include "ostia/analysis/evaluability.h"
#include "ostia/analysis/measurement.h"
#include "ostia/lumen/edit.h"
#include "ostia/session/lesion_state.h"
#include "ostia/session/pressure_notes.h"
#include "ostia/session/report_notes.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ostia::session {

/// What a reader says of a lesion, which is known by its stretch: lesions are found anew after every edit.
struct LesionWord {
  double from_mm = 0.0, to_mm = 0.0;
  LesionState state = LesionState::open;
  std::string comment;  ///< free text
};

/// How a vessel is shown, and what a reader says of it.
struct VesselMark {
  std::int32_t vessel = 0;
  bool visible = true;
  bool checked = false;                        ///< the reader is done with it
  std::optional<std::array<double, 3>> color;  ///< red, green, blue, [0, 1]; nothing: the interface chooses
  std::string note;                            ///< free text
  /// The reader's word on how far stretches can be judged, instead of the program's: ascending, without
  /// overlap, all `by_person`, without reasons.
  std::vector<analysis::EvaluableStretch> evaluable = {};
  std::vector<LesionWord> lesions = {};  ///< by `from_mm`, then `to_mm`
};

struct Annotations {
  std::vector<analysis::Measurement> measurements;  ///< by id
  std::vector<VesselMark> marks;                    ///< by vessel, at most one each
  std::int32_t next_measurement_id = 1;
  PressureNotes pressure = {};
  ReportNotes report = {};
};
/// The mark after the reader's word on a stretch; nothing as grade takes the word back, whatever it was.
VesselMark with_evaluability(VesselMark mark, double from_mm, double to_mm,
                             std::optional<analysis::Evaluability> grade);
/// The reader's word on the lesion of a stretch: the one that shares most with it, and no less than half of
/// the shorter of the two; null where there is none.
const LesionWord* word_on(const VesselMark* mark, double from_mm, double to_mm);
/// The mark after a word on a lesion, instead of the one that was there; open without a comment is none.
VesselMark with_lesion(VesselMark mark, LesionWord word);
/// Nothing where the vessel has no mark (it is then shown, and not checked).
const VesselMark* find_mark(const Annotations& annotations, std::int32_t vessel);
/// Its mark, or one that says nothing yet.
VesselMark mark_or_new(const Annotations& annotations, std::int32_t vessel);
const analysis::Measurement* find_measurement(const Annotations& annotations, std::int32_t id);

/// "measure.add": a new measurement. Its id is given by the case, whatever it is here.
struct MeasureAdd {
  analysis::Measurement measurement;
};
/// "measure.change": another value for the measurement of this id, whole.
struct MeasureChange {
  analysis::Measurement measurement;
};
/// "measure.delete"
struct MeasureDelete {
  std::int32_t id = 0;
};
/// "vessel.mark": the vessel's mark, whole.
struct MarkVessel {
  VesselMark mark;
};
/// "pressure.inputs": those that a person gives, whole.
struct SetPressureInputs {
  std::map<std::string, double> inputs;
};
/// "pressure.what_if": the stretches that are looked at as if they were otherwise, whole.
struct SetWhatIfs {
  std::vector<WhatIf> what_ifs;
};
/// "report.impression": the reader's text, whole; empty: the report drafts one.
struct SetReportImpression {
  std::string text;
};
/// "report.modifiers": whole.
struct SetReportModifiers {
  ReportModifiers modifiers;
};
/// "report.features": the words on features of plaque, whole.
struct SetPlaqueFeatures {
  std::vector<FeatureWord> features;
};
/// "calcium.places": the words on lesions of a calcium score, whole.
struct SetCalciumPlaces {
  std::vector<CalciumWord> words;
};
/// "report.sign": a further version.
struct SignReport {
  ReportVersion version;
};
using AnnotationCommand =
    std::variant<MeasureAdd, MeasureChange, MeasureDelete, MarkVessel, SetPressureInputs, SetWhatIfs,
                 SetReportImpression, SetReportModifiers, SetPlaqueFeatures, SignReport, SetCalciumPlaces>;

std::string op_name(const AnnotationCommand& command);  ///< "measure.add", ...
bool is_annotation_op(const std::string& op);           ///< one of these names

/// The annotations after a command. Pure. Throws InvalidInput (and nothing is changed): a measurement with a
/// fault, an id that is not there, a vessel that the model does not have (a measurement that lost its vessel
/// may keep it), a color outside [0, 1], inputs beyond physiology, stretches that are none, values that are
/// not finite, text that is not UTF-8, a further version of the report that does not say what changed.
Annotations annotated(const Annotations& before, const AnnotationCommand& command,
                      const lumen::LumenModel& model);

/// The annotations after an edit of the model. What stands on a vessel that is split goes with the part that
/// it lies on (what lies across the seam with the new vessel, whose axis has both, at the same abscissas);
/// what stands on a vessel that is joined with its parent stands on the parent. Marks stay with the vessel
/// that keeps its id; the reader's word on stretches goes where its stretch goes. All other edits leave
/// annotations as they are.
Annotations following(const Annotations& before, const lumen::Edit& edit,
                      const lumen::LumenModel& model_before, const lumen::LumenModel& model_after);

/// What differs: measurements by id, marks by vessel, came, went or changed; what pressures are told; what
/// the report says by a person.
struct AnnotationChange {
  std::vector<std::int32_t> measurements, marks;
  bool pressure = false, report = false;
  bool empty() const { return measurements.empty() && marks.empty() && !pressure && !report; }
};
AnnotationChange changes_between(const Annotations& before, const Annotations& after);

/// The same to the last bit.
bool same(const analysis::Measurement& a, const analysis::Measurement& b);
bool same(const VesselMark& a, const VesselMark& b);

/// Does the measurement stand on a vessel (rather than on its points alone)?
bool needs_vessel(const analysis::Measurement& measurement);
/// Annotations whose vessel is not in the model: it was deleted. They are kept, since an undo may bring it
/// back; analysis::measured refuses them.
struct Orphans {
  std::vector<std::int32_t> measurements;  ///< ids
  std::vector<std::int32_t> marks;         ///< vessels
};
Orphans find_orphans(const Annotations& annotations, const lumen::LumenModel& model);

}  // namespace ostia::session
