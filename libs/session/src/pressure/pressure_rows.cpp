#include "pressure/pressure_rows.h"

#include "case_file/case_damage.h"
#include "case_file/model_blob.h"

#include "ostia/core/error.h"

namespace ostia::session {
namespace {

std::uint64_t sum_of_input(const std::string& key, double value) {
  return Checksum().add("pressure_input").add(key).add(value).value();
}

std::uint64_t sum_of_stretch(std::size_t place, const WhatIf& one) {
  Checksum sum;
  sum.add("what_if").add(static_cast<std::int64_t>(place)).add(std::int64_t{one.vessel});
  return sum.add(one.from_mm).add(one.to_mm).add(to_string(one.kind)).add(one.percent).value();
}

WhatIf what_if_of(const Statement& row) {
  WhatIf one;
  one.vessel = static_cast<std::int32_t>(row.integer(1));
  one.from_mm = row.real(2);
  one.to_mm = row.real(3);
  one.percent = row.real(5);
  try {
    one.kind = what_if_kind(row.text(4));
    validate(one);
  } catch (const InvalidInput&) {
    damaged("a stretch of its pressures is none");
  }
  if (row.integer(1) < 0 || row.integer(1) != one.vessel) damaged("a stretch of its pressures has no vessel");
  return one;
}

}  // namespace

std::uint64_t sum_of(const PressureNotes& notes) {
  std::uint64_t sum = 0;
  for (const auto& [key, value] : notes.inputs) sum += sum_of_input(key, value);
  for (std::size_t i = 0; i < notes.what_ifs.size(); ++i) sum += sum_of_stretch(i, notes.what_ifs[i]);
  return sum;
}

PressureRows::PressureRows(const Database& db)
    : put_input_(db,
                 "INSERT INTO pressure_input VALUES(?1, ?2) ON CONFLICT(key) DO UPDATE SET value = "
                 "excluded.value"),
      erase_input_(db, "DELETE FROM pressure_input WHERE key = ?1"),
      read_inputs_(db, "SELECT key, value FROM pressure_input ORDER BY key"),
      put_what_if_(db,
                   "INSERT INTO what_if VALUES(?1, ?2, ?3, ?4, ?5, ?6) ON CONFLICT(place) DO UPDATE SET "
                   "vessel = excluded.vessel, from_mm = excluded.from_mm, to_mm = excluded.to_mm, "
                   "kind = excluded.kind, percent = excluded.percent"),
      erase_what_if_(db, "DELETE FROM what_if WHERE place >= ?1"),
      read_what_ifs_(db, "SELECT place, vessel, from_mm, to_mm, kind, percent FROM what_if ORDER BY place") {}

void PressureRows::write(const PressureNotes& before, const PressureNotes& after) {
  for (const auto& [key, value] : before.inputs)
    if (!after.inputs.contains(key)) erase_input_.with(key).run();
  for (const auto& [key, value] : after.inputs) put_input_.with(key, value).run();
  erase_what_if_.with(static_cast<std::int64_t>(after.what_ifs.size())).run();
  for (std::size_t i = 0; i < after.what_ifs.size(); ++i) {
    const WhatIf& one = after.what_ifs[i];
    put_what_if_
        .with(static_cast<std::int64_t>(i), one.vessel, one.from_mm, one.to_mm, to_string(one.kind),
              one.percent)
        .run();
  }
}

PressureNotes PressureRows::read() {
  PressureNotes notes;
  for (Statement& row = read_inputs_.with(); row.step();) notes.inputs[row.text(0)] = row.real(1);
  try {
    validate(notes.inputs);
  } catch (const InvalidInput&) {
    damaged("an input of its pressures is none");
  }
  for (Statement& row = read_what_ifs_.with(); row.step();) {
    if (row.integer(0) != static_cast<std::int64_t>(notes.what_ifs.size()))
      damaged("a stretch of its pressures is missing");
    notes.what_ifs.push_back(what_if_of(row));
  }
  return notes;
}

}  // namespace ostia::session
