#include "case_file/annotation_rows.h"

#include "case_file/case_damage.h"
#include "case_file/model_blob.h"

#include "ostia/core/error.h"

#include <algorithm>

namespace ostia::session {
namespace {

using analysis::Measurement;

std::int32_t id_of(std::int64_t value) {
  if (value < 0 || value != static_cast<std::int32_t>(value))
    damaged("an annotation has the id " + std::to_string(value));
  return static_cast<std::int32_t>(value);
}

bool flag_of(std::int64_t value) {
  if (value != 0 && value != 1) damaged("a vessel's mark is neither set nor not");
  return value == 1;
}

analysis::MeasureKind measure_kind_of(const std::string& name) {
  try {
    return analysis::measure_kind(name);
  } catch (const InvalidInput&) {
    damaged("a measurement of an unknown kind");
  }
}

LesionState lesion_state_of(const std::string& text) {
  try {
    return lesion_state(text);
  } catch (const InvalidInput&) {
    damaged("a lesion is neither open nor accepted nor rejected");
  }
}

/// Empty for none.
std::string color_bytes(const VesselMark& mark) {
  return mark.color ? bytes_of(std::vector<double>(mark.color->begin(), mark.color->end())) : std::string();
}

std::optional<std::array<double, 3>> color_of(std::string_view bytes) {
  if (bytes.empty()) return std::nullopt;
  const geometry::Vec3 v = vec_of(bytes);
  return std::array<double, 3>{v.x(), v.y(), v.z()};
}

std::string stretch_bytes(const VesselMark& mark) {
  std::vector<double> numbers;
  for (const analysis::EvaluableStretch& one : mark.evaluable)
    numbers.insert(numbers.end(), {one.from_mm, one.to_mm, static_cast<double>(one.grade)});
  return bytes_of(numbers);
}

std::vector<analysis::EvaluableStretch> stretches_of(std::string_view bytes) {
  const std::vector<double> numbers = doubles_of(bytes);
  if (numbers.size() % 3 != 0) damaged("a mark's stretches are not whole");
  std::vector<analysis::EvaluableStretch> stretches;
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const double grade = numbers[i + 2];
    if (grade != 0.0 && grade != 1.0 && grade != 2.0) damaged("a mark has a grade that is none");
    stretches.push_back(
        {numbers[i], numbers[i + 1], static_cast<analysis::Evaluability>(static_cast<int>(grade)), {}, true});
  }
  return stretches;
}

std::uint64_t sum_of(std::int32_t vessel, const LesionWord& word) {
  Checksum sum;
  sum.add("lesion").add(std::int64_t{vessel}).add(word.from_mm).add(word.to_mm);
  return sum.add(to_string(word.state)).add(word.comment).value();
}

std::uint64_t sum_of(const Measurement& m) {
  Checksum sum;
  sum.add("measurement").add(std::int64_t{m.id}).add(analysis::to_string(m.kind)).add(m.name);
  sum.add(bytes_of(m.points)).add(std::int64_t{m.vessel});
  return sum.add(m.from_mm).add(m.to_mm).add(m.inner_mm).add(m.outer_mm).value();
}

std::uint64_t sum_of(const VesselMark& mark) {
  Checksum sum;
  sum.add("mark").add(std::int64_t{mark.vessel}).add(std::int64_t{mark.visible});
  sum.add(std::int64_t{mark.checked}).add(color_bytes(mark)).add(mark.note);
  if (!mark.evaluable.empty()) sum.add(stretch_bytes(mark));  // older versions know of none
  return sum.value();
}

}  // namespace

std::uint64_t sum_of(const Annotations& annotations) {
  std::uint64_t sum = Checksum().add("annotation").add(std::int64_t{annotations.next_measurement_id}).value();
  for (const Measurement& measurement : annotations.measurements) sum += sum_of(measurement);
  for (const VesselMark& mark : annotations.marks) {
    sum += sum_of(mark);
    for (const LesionWord& word : mark.lesions) sum += sum_of(mark.vessel, word);
  }
  return sum + sum_of(annotations.pressure) + sum_of(annotations.report);
}

AnnotationRows::AnnotationRows(const Database& db)
    : update_(db, "UPDATE annotation SET next_measurement_id = ?1, checksum = ?2 WHERE id = 1"),
      put_measurement_(
          db,
          "INSERT INTO measurement VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9) ON CONFLICT(id) DO "
          "UPDATE SET kind = excluded.kind, name = excluded.name, points = excluded.points, "
          "vessel = excluded.vessel, from_mm = excluded.from_mm, to_mm = excluded.to_mm, "
          "inner_mm = excluded.inner_mm, outer_mm = excluded.outer_mm"),
      erase_measurement_(db, "DELETE FROM measurement WHERE id = ?1"),
      put_mark_(db,
                "INSERT INTO mark VALUES(?1, ?2, ?3, ?4, ?5) ON CONFLICT(vessel) DO UPDATE SET "
                "visible = excluded.visible, checked = excluded.checked, color = excluded.color, "
                "note = excluded.note"),
      erase_mark_(db, "DELETE FROM mark WHERE vessel = ?1"),
      read_(db, "SELECT next_measurement_id, checksum FROM annotation"),
      read_measurements_(db,
                         "SELECT id, kind, name, points, vessel, from_mm, to_mm, inner_mm, outer_mm FROM "
                         "measurement ORDER BY id"),
      read_marks_(db, "SELECT vessel, visible, checked, color, note FROM mark ORDER BY vessel"),
      put_evaluability_(db,
                        "INSERT INTO evaluability VALUES(?1, ?2) ON CONFLICT(vessel) DO UPDATE SET "
                        "stretches = excluded.stretches"),
      erase_evaluability_(db, "DELETE FROM evaluability WHERE vessel = ?1"),
      read_evaluability_(db, "SELECT vessel, stretches FROM evaluability ORDER BY vessel"),
      put_lesion_(db, "INSERT INTO lesion VALUES(?1, ?2, ?3, ?4, ?5)"),
      erase_lesions_(db, "DELETE FROM lesion WHERE vessel = ?1"),
      read_lesions_(
          db, "SELECT vessel, from_mm, to_mm, state, comment FROM lesion ORDER BY vessel, from_mm, to_mm"),
      pressure_(db),
      report_(db) {}

void AnnotationRows::put(const Measurement& m) {
  const std::string points = bytes_of(m.points);
  put_measurement_
      .with(m.id, analysis::to_string(m.kind), m.name, Blob{points}, m.vessel, m.from_mm, m.to_mm, m.inner_mm,
            m.outer_mm)
      .run();
}

void AnnotationRows::put_lesions(const VesselMark& mark) {
  erase_lesions_.with(mark.vessel).run();
  for (const LesionWord& word : mark.lesions)
    put_lesion_.with(mark.vessel, word.from_mm, word.to_mm, to_string(word.state), word.comment).run();
}

void AnnotationRows::read_lesions(Annotations& annotations) {
  Statement& row = read_lesions_.with();
  while (row.step()) {
    const std::int32_t vessel = id_of(row.integer(0));
    const auto mark = std::find_if(annotations.marks.begin(), annotations.marks.end(),
                                   [&](const VesselMark& one) { return one.vessel == vessel; });
    if (mark == annotations.marks.end()) damaged("a word on a lesion of a vessel that has no mark");
    mark->lesions.push_back({row.real(1), row.real(2), lesion_state_of(row.text(3)), row.text(4)});
  }
}

void AnnotationRows::put(const VesselMark& mark) {
  const std::string color = color_bytes(mark);
  put_mark_.with(mark.vessel, std::int32_t{mark.visible}, std::int32_t{mark.checked}, Blob{color}, mark.note)
      .run();
  put_lesions(mark);
  if (mark.evaluable.empty()) {
    erase_evaluability_.with(mark.vessel).run();
    return;
  }
  const std::string stretches = stretch_bytes(mark);
  put_evaluability_.with(mark.vessel, Blob{stretches}).run();
}

void AnnotationRows::write_new(const Database& database) {
  const Annotations none;
  Statement insert(database, "INSERT INTO annotation VALUES(1, ?1, ?2)");
  insert.with(none.next_measurement_id, static_cast<std::int64_t>(sum_of(none))).run();
}

void AnnotationRows::write_change(const Annotations& before, const Annotations& after) {
  const AnnotationChange change = changes_between(before, after);
  for (const std::int32_t id : change.measurements) {
    if (const Measurement* measurement = find_measurement(after, id))
      put(*measurement);
    else
      erase_measurement_.with(id).run();
  }
  for (const std::int32_t vessel : change.marks) {
    if (const VesselMark* mark = find_mark(after, vessel))
      put(*mark);
    else
      erase_mark_.with(vessel).run(), erase_evaluability_.with(vessel).run(),
          erase_lesions_.with(vessel).run();
  }
  if (change.pressure) pressure_.write(before.pressure, after.pressure);
  if (change.report) report_.write(before.report, after.report);
  update_.with(after.next_measurement_id, static_cast<std::int64_t>(sum_of(after))).run();
}

Annotations AnnotationRows::read() {
  Annotations annotations;
  if (!read_.with().step()) damaged("it holds no place for annotations");
  annotations.next_measurement_id = id_of(read_.integer(0));
  const auto checksum = static_cast<std::uint64_t>(read_.integer(1));
  read_.reset();
  Statement& m = read_measurements_.with();
  while (m.step()) {
    Measurement one;
    one.id = id_of(m.integer(0));
    one.kind = measure_kind_of(m.text(1));
    one.name = m.text(2);
    one.points = points_of(m.bytes(3));
    one.vessel = id_of(m.integer(4));
    one.from_mm = m.real(5), one.to_mm = m.real(6), one.inner_mm = m.real(7), one.outer_mm = m.real(8);
    annotations.measurements.push_back(std::move(one));
  }
  Statement& v = read_marks_.with();
  while (v.step())
    annotations.marks.push_back(
        {id_of(v.integer(0)), flag_of(v.integer(1)), flag_of(v.integer(2)), color_of(v.bytes(3)), v.text(4)});
  Statement& e = read_evaluability_.with();
  while (e.step()) {
    const std::int32_t vessel = id_of(e.integer(0));
    const auto mark = std::find_if(annotations.marks.begin(), annotations.marks.end(),
                                   [&](const VesselMark& one) { return one.vessel == vessel; });
    if (mark == annotations.marks.end()) damaged("a reader's word on a vessel that has no mark");
    mark->evaluable = stretches_of(e.bytes(1));
  }
  read_lesions(annotations);
  annotations.pressure = pressure_.read();
  annotations.report = report_.read();
  if (sum_of(annotations) != checksum) damaged("its annotations are not what was written");
  if (!annotations.measurements.empty() &&
      annotations.measurements.back().id >= annotations.next_measurement_id)
    damaged("a measurement has an id that was not given yet");
  return annotations;
}

}  // namespace ostia::session
