#include "ostia/session/annotation_json.h"

#include "case_file/json_fields.h"

#include "ostia/core/error.h"

#include <type_traits>

namespace ostia::session {
namespace {

using json_fields::Json;
using json_fields::Need;
using json_fields::Reader;
using json_fields::Writer;

// One list of fields for a command, for writing and for reading.
template <class M, class V>
void measurement_fields(M& m, V& v, Need id) {
  v("id", m.id, id);
  v("kind", m.kind);
  v("name", m.name, Need::optional);
  v("points", m.points, Need::optional);
  v("vessel", m.vessel, Need::optional);
  v("from_mm", m.from_mm, Need::optional);
  v("to_mm", m.to_mm, Need::optional);
  v("inner_mm", m.inner_mm, Need::optional);
  v("outer_mm", m.outer_mm, Need::optional);
}

template <class C, class V>
void fields(C& command, V& v) {
  using Kind = std::remove_const_t<C>;
  if constexpr (std::is_same_v<Kind, MeasureAdd>) {
    measurement_fields(command.measurement, v, Need::optional);
  } else if constexpr (std::is_same_v<Kind, MeasureChange>) {
    measurement_fields(command.measurement, v, Need::required);
  } else if constexpr (std::is_same_v<Kind, MeasureDelete>) {
    v("id", command.id);
  } else if constexpr (std::is_same_v<Kind, SetPressureInputs>) {
    v("inputs", command.inputs);
  } else if constexpr (std::is_same_v<Kind, SetWhatIfs>) {
    v("stretches", command.what_ifs);
  } else if constexpr (std::is_same_v<Kind, SetReportImpression>) {
    v("text", command.text);
  } else if constexpr (std::is_same_v<Kind, SetReportModifiers>) {
    v("ischaemia", command.modifiers.ischaemia, Need::optional);
    v("stent", command.modifiers.stent, Need::optional);
    v("graft", command.modifiers.graft, Need::optional);
    v("exception", command.modifiers.exception, Need::optional);
    v("seen", command.modifiers.seen);
    v("agatston", command.modifiers.agatston);
    v("burden", command.modifiers.burden);
    v("dominance", command.modifiers.dominance, Need::optional);
  } else if constexpr (std::is_same_v<Kind, SetPlaqueFeatures>) {
    v("features", command.features);
  } else if constexpr (std::is_same_v<Kind, SetCalciumPlaces>) {
    v("words", command.words);
  } else if constexpr (std::is_same_v<Kind, SignReport>) {
    v("date", command.version.date);
    v("signer", command.version.signer);
    v("changes", command.version.changes, Need::optional);
    v("digest", command.version.digest);
  } else {
    v("vessel", command.mark.vessel);
    v("visible", command.mark.visible);
    v("checked", command.mark.checked);
    v("color", command.mark.color);
    v("note", command.mark.note, Need::optional);
    if constexpr (std::is_same_v<V, Reader>)
      v("evaluable", command.mark.evaluable, Need::optional);
    else if (!command.mark.evaluable.empty())
      v("evaluable", command.mark.evaluable);
    if constexpr (std::is_same_v<V, Reader>)
      v("lesions", command.mark.lesions, Need::optional);
    else if (!command.mark.lesions.empty())
      v("lesions", command.mark.lesions);
  }
}

AnnotationCommand command_named(const std::string& op) {
  std::string choices;
  for (const AnnotationCommand& candidate :
       {AnnotationCommand(MeasureAdd{}), AnnotationCommand(MeasureChange{}),
        AnnotationCommand(MeasureDelete{}), AnnotationCommand(MarkVessel{}),
        AnnotationCommand(SetPressureInputs{}), AnnotationCommand(SetWhatIfs{}),
        AnnotationCommand(SetReportImpression{}), AnnotationCommand(SetReportModifiers{}),
        AnnotationCommand(SetPlaqueFeatures{}), AnnotationCommand(SignReport{}),
        AnnotationCommand(SetCalciumPlaces{})}) {
    if (op_name(candidate) == op) return candidate;
    choices += (choices.empty() ? "" : ", ") + op_name(candidate);
  }
  throw InvalidInput("an annotation has the unknown \"op\" \"" + op + "\"; known are " + choices);
}

}  // namespace

std::string to_json(const AnnotationCommand& command) {
  return json_fields::line_of("annotation", op_name(command), [&](Writer& writer) {
    std::visit([&](const auto& kind) { fields(kind, writer); }, command);
  });
}

AnnotationCommand annotation_of_json(std::string_view line) {
  const Json in = json_fields::object_of("annotation", line);
  AnnotationCommand command = command_named(in["op"].get<std::string>());
  Reader reader(in, "annotation " + in["op"].get<std::string>());
  std::visit([&](auto& kind) { fields(kind, reader); }, command);
  reader.require_no_others();
  return command;
}

}  // namespace ostia::session
