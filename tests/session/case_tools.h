#pragma once
/// \file Small models, edits and folders for tests of the case file.

#include "vessel_trees.h"

#include "ostia/lumen/start_surface.h"
#include "ostia/session/annotation_json.h"
#include "ostia/session/case_file.h"

#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace ostia::session::testing {

namespace fs = std::filesystem;

class TempFolder {
 public:
  TempFolder() {
    std::string name = (fs::temp_directory_path() / "ostia-case-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TempFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline constexpr std::int32_t tube_vessel = 4;  // of straight_vessel

/// A tube along z, 30 mm long.
inline lumen::LumenModel tube_model() {
  return lumen::model_of_tubes(lumen::testing::straight_vessel(30.0, 1.5));
}

/// A trunk with two branches.
inline lumen::LumenModel y_model() {
  return lumen::model_of_tubes(lumen::testing::tree_of(geometry::y_junction(15.0, 15.0, 2.0, 1.4, 70.0)));
}

/// A round contour across the tube.
inline lumen::SectionContour ring(double s_mm, double radius_mm, std::int32_t vessel = tube_vessel) {
  lumen::SectionContour contour;
  contour.vessel = vessel;
  contour.s_mm = s_mm;
  for (int i = 0; i < 12; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 12.0;
    contour.points.emplace_back(radius_mm * std::cos(a), radius_mm * std::sin(a), s_mm);
  }
  return contour;
}

inline lumen::WallDrag drag(double s_mm, double by_mm) {
  lumen::WallDrag edit;
  edit.vessel = tube_vessel;
  edit.from = {1.5, 0.0, s_mm};
  edit.to = {1.5 + by_mm, 0.0, s_mm};
  return edit;
}

inline lumen::VesselRename renamed(const std::string& name) {
  return {tube_vessel, name};
}

/// An edit of each kind, with numbers that are hard to write.
inline std::vector<lumen::Edit> one_of_each() {
  const geometry::Vec3 a(0.1, -1.0 / 3.0, 1e-17), b(-0.0, 123456.789012345678, 5e-324), c(1e300, -2.5, 0.3);
  const lumen::NewWall wall{8, {1.0 / 3.0, 1, 1, 1, 1, 1, 1, 1, 0.7, 1, 1, 1, 1, 1, 1, 1.1}};
  return {lumen::CprStroke{7, {a, b, c}, lumen::ReformationMode::stretched, 1.0 / 7.0, 61.3},
          lumen::SectionContour{1, 12.1, 1.7, false, {a, b, c}},
          lumen::WallDrag{2, a, b, 2.9},
          lumen::WallPush{3, {a}, 0.7},
          lumen::AxisMove{4, a, b, 4.9},
          lumen::AxisInsert{5, a},
          lumen::AxisDelete{6, b},
          lumen::AxisExtend{7, {a, b}},
          lumen::AxisTrim{8, 0.1 + 0.2},
          lumen::BranchAdd{9, "Ramus \"\xC3\xA9\"\n", {a, b}, {1.1, 0.9}, wall},
          lumen::BranchDelete{2147483647},
          lumen::BranchAttach{11, 12, c},
          lumen::BranchSplit{14, 0.7 / 3.0, "distal \xC3\xA9"},
          lumen::BranchMerge{15},
          lumen::BranchCut{16, 0.2 / 7.0, ""},
          lumen::BranchConnect{17, 18, a},
          lumen::VesselRename{13, "D1"},
          lumen::VesselAdd{"Graft", {a, b}, {1.1, 0.9}, wall}};
}

/// A measurement of a kind, with numbers that are hard to write. Its id is the case's to give.
inline analysis::Measurement measurement(analysis::MeasureKind kind, std::int32_t vessel = tube_vessel) {
  using analysis::MeasureKind;
  analysis::Measurement made;
  made.kind = kind;
  made.name = "Proximal \"\xC3\xA9\"";
  const geometry::Vec3 a(0.1, -1.0 / 3.0, 10.0), b(-0.0, 1.5, 10.0), c(1.0, 0.3, 11.0);
  if (kind == MeasureKind::distance || kind == MeasureKind::diameter || kind == MeasureKind::arrow)
    made.points = {a, b};
  if (kind == MeasureKind::note) made.points = {a};
  if (kind == MeasureKind::angle || kind == MeasureKind::area) made.points = {a, b, c};
  if (made.points.empty() || kind == MeasureKind::diameter) made.vessel = vessel;
  made.from_mm = 5.0 + 1.0 / 7.0;
  made.to_mm = kind == MeasureKind::ring_hu ? made.from_mm : 20.1;
  made.inner_mm = 0.3;
  made.outer_mm = 2.7;
  return made;
}
inline constexpr auto all_kinds = analysis::measure_kinds;

inline MeasureAdd added(analysis::MeasureKind kind, std::int32_t vessel = tube_vessel) {
  return {measurement(kind, vessel)};
}

/// The measurement `id` of a case, its second point moved to x.
inline MeasureChange moved(const CaseFile& file, std::int32_t id, double x) {
  MeasureChange change{*find_measurement(*file.annotations(), id)};
  change.measurement.points.at(1).x() = x;
  return change;
}

inline MarkVessel marked(const std::string& note, bool checked = true, std::int32_t vessel = tube_vessel) {
  return {{vessel,
           false,
           checked,
           std::array{0.1, 1.0 / 3.0, 1.0},
           note,
           {{1.0 / 3.0, 5.0, analysis::Evaluability::limited, {}, true},
            {5.0, 7.5, analysis::Evaluability::not_evaluable, {}, true}},
           {{0.1, 1.0 / 3.0, LesionState::accepted, ""},
            {2.0, 7.5, LesionState::rejected, "a step of the scanner's \xC3\xA4rger \"quoted\""}}}};
}

/// What pressures can be told, with numbers that are hard to write.
inline SetPressureInputs told_inputs() {
  return {{{"systolic_mmhg", 130.0 + 1.0 / 3.0}, {"lv_mass_g", 141.7}, {"split_exponent", 2.3}}};
}
inline SetWhatIfs opened(std::int32_t vessel = tube_vessel) {
  return {{{vessel, 5.0 + 1.0 / 7.0, 12.5, WhatIfKind::open, 10.1},
           {vessel, 0.1, 20.0 / 3.0, WhatIfKind::narrow, 60.0}}};
}

/// What a report can be told, with what is hard to write.
inline SetReportImpression written(const std::string& text = "Line \"one\"\nl\xC3\xADne two") {
  return {text};
}
inline SetReportModifiers told_modifiers() {
  ReportModifiers all;
  all.ischaemia = analysis::Ischaemia::borderline;
  all.stent = true;
  all.exception = "anomalous origin of the LCX";
  all.seen =
      SeenPlaque{analysis::PlaqueAmount::mild, analysis::PlaqueAmount::none, analysis::PlaqueAmount::severe};
  all.agatston = 101.0 + 1.0 / 3.0;
  all.burden = analysis::PlaqueBurden::p4;
  all.dominance = analysis::Dominance::left;
  return {all};
}
inline SetPlaqueFeatures told_features(std::int32_t vessel = tube_vessel) {
  return {{{vessel, 5.0 + 1.0 / 7.0, 12.5, analysis::PlaqueFeature::napkin_ring, LesionState::accepted},
           {vessel, 5.0, 12.5, analysis::PlaqueFeature::low_attenuation, LesionState::rejected}}};
}
inline SetCalciumPlaces told_calcium() {
  return {{{{1.0 / 3.0, -20.25, 1e-3}, analysis::CalciumPlace::rca},
           {{7.0, 8.5, -100.1}, analysis::CalciumPlace::other}}};
}
inline SignReport signing(const std::string& changes = "") {
  return {{"2026-03-01", "Dr. \xC3\x84", changes, std::string(64, 'a')}};
}

/// All of the annotations as text, to the last bit.
inline std::string text_of(const Annotations& annotations) {
  std::string text = std::to_string(annotations.next_measurement_id) + "\n";
  for (const analysis::Measurement& one : annotations.measurements)
    text += to_json(AnnotationCommand(MeasureChange{one})) + "\n";
  for (const VesselMark& mark : annotations.marks)
    text += to_json(AnnotationCommand(MarkVessel{mark})) + "\n";
  text += to_json(AnnotationCommand(SetPressureInputs{annotations.pressure.inputs})) + "\n";
  text += to_json(AnnotationCommand(SetWhatIfs{annotations.pressure.what_ifs})) + "\n";
  text += to_json(AnnotationCommand(SetReportImpression{annotations.report.impression})) + "\n";
  text += to_json(AnnotationCommand(SetReportModifiers{annotations.report.modifiers})) + "\n";
  text += to_json(AnnotationCommand(SetPlaqueFeatures{annotations.report.features})) + "\n";
  text += to_json(AnnotationCommand(SetCalciumPlaces{annotations.report.calcium})) + "\n";
  for (const ReportVersion& one : annotations.report.versions)
    text += to_json(AnnotationCommand(SignReport{one})) + "\n";
  return text;
}

inline std::string bytes_of_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace ostia::session::testing
