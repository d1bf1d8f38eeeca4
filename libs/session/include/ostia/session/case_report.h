#pragma once
/// \file The report of a case: what the model says of the patient's coronaries, for a person and for scripts
/// (docs/reference/report.md).

#include "ostia/analysis/aha_segments.h"
#include "ostia/analysis/cad_rads.h"
#include "ostia/analysis/high_risk_plaque.h"
#include "ostia/analysis/lesions.h"
#include "ostia/analysis/measurement.h"
#include "ostia/analysis/medina.h"
#include "ostia/analysis/scct_segments.h"
#include "ostia/analysis/stenosis.h"
#include "ostia/core/task_context.h"
#include "ostia/coronary/certainty.h"
#include "ostia/figure/picture.h"
#include "ostia/imaging/scan_technique.h"
#include "ostia/imaging/series_preview.h"
#include "ostia/pipeline/manifest.h"
#include "ostia/session/case_file.h"
#include "ostia/session/evaluability.h"
#include "ostia/session/outer_walls.h"
#include "ostia/session/report_digest.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// Of what a person reads: report.html, report.pdf and the key images. Files for scripts, and the report's
/// own texts, are English.
enum class ReportLanguage { english, german };
ReportLanguage report_language(const std::string& code);  ///< "en", "de"; throws InvalidInput
std::string to_string(ReportLanguage language);           ///< its code

/// How much of it a person reads; report.json and the tables hold everything.
enum class ReportTemplate {
  full,
  brief,  ///< "short": first page, impression, stenoses, segments, versions, the tree
};
ReportTemplate report_template(const std::string& word);  ///< "full", "short"; throws InvalidInput
std::string to_string(ReportTemplate form);               ///< its word

struct ReportOptions {
  std::optional<ImageReference> image;  ///< how the case knows its image; none: the report says so
  std::string date;                     ///< of the report, as it is to stand there; empty: none
  analysis::ProfileOptions profile;
  analysis::ReferenceOptions reference;
  analysis::StenosisOptions stenosis;
  analysis::MedinaOptions medina;
  analysis::PlaqueStretchOptions plaque_stretches;  ///< of plaque that is a lesion by itself
  OuterWallsOptions walls;
  VesselEvaluabilityOptions evaluability;
  /// Stenoses of vessels with a thinner reference are listed, but have no say in the patient's category:
  /// CAD-RADS grades coronary vessels from this diameter on (Cury et al. 2022). [0, 5] mm
  double least_graded_mm = 1.5;
  double picture_percent = 25.0;  ///< a vessel with a stenosis from here on has a key image, [0, 100]
  double theta_deg = 0.0;         ///< of the first reformation; the second is at + 90
  double level_hu = 250.0, window_hu = 900.0;
  ReportLanguage language = ReportLanguage::english;
  ReportTemplate form = ReportTemplate::full;
  /// Agatston score of another scan, in place of the one that the case's modifiers have; [0, 20000]
  std::optional<double> agatston = {};
  std::string impression = {};  ///< in place of the case's own; empty: that one, else a draft
  analysis::HighRiskOptions high_risk = {};
  std::optional<imaging::ScanTechnique> technique = {};  ///< as the image's headers say
  /// How likely each vessel is an artery, as the case keeps it (kept_certainty); empty: nothing is known.
  std::vector<coronary::VesselCertainty> certainty = {};
};
void validate(const ReportOptions& options);  ///< throws InvalidInput

/// What lies between lumen and outer wall over a stretch, as the image shows it.
struct ReportPlaque {
  double from_mm = 0.0, to_mm = 0.0;  ///< the part of the stretch where the outer wall was looked for
  analysis::PlaqueVolumes volumes;
  double seen_share = 0.0;  ///< of the vessel's outer wall that borders on fat; the rest is a bridge
};

struct ReportVessel {
  std::int32_t id = 0;
  std::string name;
  double length_mm = 0.0;              ///< from the root
  double own_from_mm = 0.0;            ///< where its own part begins
  bool checked = false;                ///< a person is done with it
  std::string note;                    ///< the person's own text
  double unmeasured_mm = 0.0;          ///< of its own part, where the wall does not close
  std::optional<ReportPlaque> plaque;  ///< of its own part; nothing without an image
  /// How far its own part can be judged, the reader's word over the program's; empty without an image and a
  /// word.
  std::vector<analysis::EvaluableStretch> evaluable = {};
  /// That it is an artery, where it hardly is one (unlikely_vessels): nothing of it is graded.
  std::optional<double> unlikely = {};
};

/// A standard segment. What could not be measured is nothing.
struct ReportSegment {
  std::int32_t vessel = 0;
  std::string vessel_name, label;
  double from_mm = 0.0, to_mm = 0.0;
  std::optional<double> mean_diameter_mm, least_diameter_mm, least_area_mm2, volume_mm3;
  int worst_stenosis = 0;  ///< ReportStenosis::number; 0: none
  double worst_percent = 0.0;
  bool checked = false;
  std::optional<analysis::EvaluableStretch> evaluable;  ///< the worst of it; nothing where nothing is known
  int number = 0;                                       ///< of the standard (AhaSegment); 0: none of it
};

/// A feature of high-risk plaque of a lesion.
struct ReportFeature {
  analysis::PlaqueFeatureFinding finding;  ///< with less confidence where the image shows the place less
  LesionState state = LesionState::open;   ///< the reader's word on it
  /// It is there by the reader's word, or found with more than low confidence and not rejected.
  bool counts = false;
};

/// A lesion: a narrowing, or plaque that narrows little or nothing.
struct ReportStenosis {
  int number = 0;  ///< "S1", "S2": in the order of the tree's vessels, from proximal to distal
  analysis::Stenosis stenosis;
  bool narrows = true;               ///< found by its narrowing; false: by its plaque alone
  std::string vessel_name, segment;  ///< the segment's label
  std::string main_vessel;           ///< LM, LAD, LCX, RCA; empty where the name is not known
  /// By its percent, plaque no less than 1; nothing where it lies in what cannot be judged, or was rejected.
  std::optional<analysis::CadRads> category;
  double graded_percent = 0.0;  ///< what counts towards the patient's category (Lesion::graded_percent)
  /// Has a say in the patient's category: the vessel is wide enough, the lesion was not rejected, and it lies
  /// where the image can be judged, or a person has accepted it or checked the vessel.
  bool graded = true;
  LesionState state = LesionState::open;  ///< the reader's word on it
  std::string comment;                    ///< the reader's own text
  std::string not_graded;                 ///< why not; empty where it is
  bool checked = false;
  std::optional<analysis::EvaluableStretch> evaluable;  ///< the worst of the lesion; nothing: not known
  std::optional<ReportPlaque> plaque;                   ///< of the lesion; nothing without an image
  std::optional<double> remodelling_index;
  /// Of the first bifurcation that it belongs to with a 1 in Medina's class: "1,0,1", "LAD/LCX"; else empty.
  std::string medina = {}, bifurcation = {};
  std::vector<ReportFeature> features = {};  ///< all four; empty where no outer wall was looked for
  bool high_risk = false;                    ///< two features or more count, in a vessel that is graded
};

/// One of the 18 standard segments (SCCT, Leipsic et al. 2014), whether the tree has it or not.
struct ReportStandardSegment {
  int number = 0;
  std::string code, name;            ///< "pLAD", "proximal LAD"
  std::vector<std::string> vessels;  ///< names of those that it is a part of; empty: the tree lacks it
  /// By the worst lesion in it that is graded; 0 where none is and all of it can be judged; else nothing.
  std::optional<analysis::CadRads> category;
  double worst_percent = 0.0;
  int worst_stenosis = 0;   ///< ReportStenosis::number; 0: none
  bool has_plaque = false;  ///< counts in the segment involvement score: a lesion that is graded lies in it
  std::optional<analysis::PlaqueVolumes> plaque;  ///< where an outer wall was looked for
  std::optional<double> least_diameter_mm, least_area_mm2;
  std::vector<analysis::PlaqueFeature> features;        ///< that count, of lesions in it
  std::optional<analysis::EvaluableStretch> evaluable;  ///< the worst of it
  bool checked = false;
};

/// The overall plaque burden by each way that is known, and the one that is stated.
struct ReportBurden {
  int segments = 0;       ///< segment involvement score
  bool at_least = false;  ///< something could not be judged: there may be more
  analysis::PlaqueBurden by_segments = analysis::PlaqueBurden::none;
  std::optional<double> agatston = {};
  std::optional<analysis::PlaqueBurden> by_calcium = {}, by_sight = {};
  /// The reader's, else the highest of the known ones; with a stent, whose metal is no calcium, without
  /// that by the calcium score.
  analysis::PlaqueBurden stated = analysis::PlaqueBurden::none;
  bool by_reader = false;
};

/// Where a side branch leaves, wide enough to count (MedinaOptions::least_side_mm).
struct ReportBifurcation {
  analysis::MedinaClass medina;
  std::string main_name, side_name;
};

struct ReportMeasurement {
  analysis::Measurement measurement;
  std::string vessel_name;  ///< empty for none
  std::vector<analysis::MeasuredValue> values;
  std::string problem;  ///< why there are no values; empty otherwise
};

/// A step of the journal that was not taken back.
struct ReportStep {
  std::int64_t number = 0;
  std::string op, words;  ///< "section.contour", "contour drawn on a cross-section at 24.0 mm"
  std::string vessel;     ///< its name now
  std::vector<std::string> notes;
};

/// The vessel that a step was about; nothing where it was about none, such as a measurement of points.
std::optional<std::int32_t> vessel_of_step(const JournalEntry& step);

/// Plain data. No path, and nothing of the patient's identity but what a person wrote into names and notes.
struct CaseReport {
  ReportOptions options;
  std::string program_version, model_digest;
  bool has_image = false;  ///< the image was at hand when the report was made
  std::vector<ReportVessel> vessels;
  std::vector<ReportSegment> segments;
  std::vector<ReportStenosis> stenoses;  ///< each once: at its own vessel, not at those that share the way
  std::vector<ReportBifurcation> bifurcations;  ///< by main vessel, from proximal to distal
  analysis::PatientCategory category;           ///< of the patient
  std::optional<ScanQuality> quality;           ///< nothing without an image
  std::vector<std::string> not_found;           ///< arteries (arteries_not_found)
  std::vector<std::string> not_judged;          ///< why the category has an N: stretches, lesions, arteries
  std::vector<ReportMeasurement> measurements;
  std::vector<ReportStep> steps;
  std::vector<std::string> warnings;  ///< what keeps the report from being complete
  /// By vessel: what the tables were made of, and the pictures are.
  std::map<std::int32_t, analysis::LumenProfile> profiles;
  std::map<std::int32_t, analysis::ReferenceLine> references;
  std::map<std::int32_t, analysis::Ostium> ostia;
  std::map<std::int32_t, VesselWalls> walls;                  ///< of vessels whose outer wall was looked for
  ReportNotes notes = {};                                     ///< what the case keeps of its report
  std::vector<ReportStandardSegment> standard_segments = {};  ///< all 18, by number
  analysis::Dominance dominance = analysis::Dominance::unknown;
  bool dominance_by_reader = false;
  ReportBurden burden = {};
  analysis::CadRadsStatement statement = {};  ///< `category` with burden and modifiers
  std::string impression_draft = {};          ///< of the findings, English
  std::string impression = {};                ///< the reader's text, else the draft
  bool impression_by_person = false;
  std::string content_digest = {};  ///< report_content_digest
  /// The case and the text are those of the last version that was signed.
  bool is_signed = false;

  std::vector<std::string> unchecked() const;  ///< names of vessels that no person has checked
};

/// Every vessel's wall solved afresh in canonical order, as all that is exported is: a report of these does
/// not depend on the way that led to the model, one of a LiveModel's walls may differ by rounding. Throws as
/// lumen::solve does, and Cancelled.
analysis::SurfaceOfVessel solved_surfaces(const lumen::LumenModel& model,
                                          const core::TaskContext& task = core::no_task());

/// Measures every vessel. `surface_of` is asked from the calling thread. The same for any number of threads.
/// Throws InvalidInput for bad options and Cancelled; a measurement that cannot be made is named, not thrown.
CaseReport make_case_report(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                            const Annotations& annotations, const std::vector<JournalEntry>& journal,
                            const imaging::ImageVolume* image, const ReportOptions& options = {},
                            const core::TaskContext& task = core::no_task());

/// A picture of the report.
struct KeyImage {
  std::string name;  ///< of its file, without ending: letters, digits and dashes
  std::string caption;
  figure::Picture picture;
};
/// The tree with its stenoses marked; then for RCA, LAD, LCX (the three longest vessels where no name is
/// known) and each vessel with a stenosis from `picture_percent` on: both straightened reformations with the
/// lumen's contour, the diameter along the vessel, the cross-sections at the throats (the six worst). Without
/// an image the contours alone. Throws Cancelled.
std::vector<KeyImage> key_images(const CaseReport& report, const lumen::LumenModel& model,
                                 const analysis::SurfaceOfVessel& surface_of,
                                 const imaging::ImageVolume* image,
                                 const core::TaskContext& task = core::no_task());

std::string report_json(const CaseReport& report,
                        const std::vector<KeyImage>& images);  ///< docs/schemas/case-report.schema.json
/// `named`: whom both name, since a person has asked for it; by default nobody, as all else that is written.
std::string report_html(const CaseReport& report, const std::vector<KeyImage>& images,
                        const imaging::ShownIdentity& named = {});
std::string report_pdf(const CaseReport& report, const std::vector<KeyImage>& images,
                       const imaging::ShownIdentity& named = {});
/// One line a segment, stenosis, value of a measurement; RFC 4180. Text that a spreadsheet would take for a
/// formula has an apostrophe before it.
std::string segments_csv(const CaseReport& report);
std::string stenoses_csv(const CaseReport& report);
std::string plaque_csv(const CaseReport& report);  ///< one line a vessel and, below it, a stenosis of it
std::string measurements_csv(const CaseReport& report);

/// What was measured of a feature that is known, with its unit: "2.10 mm3" with a raised 3.
std::string feature_text(const analysis::PlaqueFeatureFinding& finding);
/// The draft of the impression in the report's language, a line a statement.
std::string drafted_impression(const CaseReport& report);

/// SHA-256 over what a report is made of: model, annotations, journal, image reference.
std::string report_digest(const CaseFile& file);
/// The job as a manifest knows it. `further` are the names and captions of pictures that were handed in.
/// `named`: the documents say whose image it is; the manifest says that they do, and not who.
pipeline::JobKey report_job(const CaseFile& file, bool with_image, const ReportOptions& options,
                            const std::vector<KeyImage>& further = {}, bool named = false);
/// Further pictures of a report's job, which takes as long as packing them does; any thread.
void add_further(pipeline::JobKey& job, const std::vector<KeyImage>& further);

/// report.html, report.pdf, report.json, segments.csv, stenoses.csv, plaque.csv, measurements.csv,
/// images/*.png and, last, manifest.json. The folder appears whole or not at all; the same report gives the
/// same bytes, the manifest's times aside. `named` stands in report.html and report.pdf alone. Throws
/// InvalidInput for images of the same or an unfit name or a folder that holds other files, IoError,
/// ResourceError, Cancelled.
void write_case_report(const std::filesystem::path& folder, const CaseReport& report,
                       const std::vector<KeyImage>& images, const pipeline::JobKey& job,
                       double seconds_before = 0.0, const core::TaskContext& task = core::no_task(),
                       const imaging::ShownIdentity& named = {});

}  // namespace ostia::session
