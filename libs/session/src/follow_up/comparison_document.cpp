// A comparison as a person reads it: the same parts as HTML and as PDF.

#include "follow_up/comparison_parts.h"

#include "ostia/core/quantity_text.h"
#include "ostia/core/text.h"
#include "ostia/core/version.h"
#include "ostia/figure/html_report.h"
#include "ostia/figure/pdf_document.h"
#include "ostia/figure/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::session {
namespace {

using analysis::ChangeMeasure;
using analysis::ChangeVerdict;
using analysis::Difference;
using CompareRows = std::vector<std::vector<std::string>>;

constexpr double least_drawn_mm = 10.0;
constexpr const char* compare_disclaimer =
    "Made with research software that is not a medical device. Nothing on this page may be used for "
    "diagnosis or treatment unless a physician has verified it on the images.";
constexpr const char* mark_words =
    "* differs by more than two scans of an unchanged patient do (smallest real difference, 95 %). Of "
    "twenty measures that have not changed one may be marked by chance.";

int decimals_of(ChangeMeasure measure) {
  switch (measure) {
    case ChangeMeasure::least_diameter:
    case ChangeMeasure::least_area:
    case ChangeMeasure::remodelling:
      return 2;
    default:
      return 1;
  }
}

/// "3.10 -> 2.40 *"; "-" where neither is known.
std::string both_text(const Difference& one, ChangeMeasure measure) {
  if (!one.before && !one.after) return "-";
  const int decimals = decimals_of(measure);
  const bool real = one.verdict() == ChangeVerdict::less || one.verdict() == ChangeVerdict::more;
  return core::shown_text(one.before, decimals) + " \u2192 " + core::shown_text(one.after, decimals) +
         (real ? " *" : "");
}

std::vector<std::string> measures_header(std::vector<std::string> first,
                                         const std::vector<ChangeMeasure>& measures) {
  for (const ChangeMeasure measure : measures) first.push_back(analysis::title_of(measure));
  return first;
}

void add_measures(std::vector<std::string>& row, const analysis::StretchChange& change,
                  const std::vector<ChangeMeasure>& measures) {
  for (const ChangeMeasure measure : measures)
    row.push_back(both_text(analysis::of(change, measure), measure));
}

const std::vector<ChangeMeasure> lesion_columns{ChangeMeasure::least_diameter, ChangeMeasure::least_area,
                                                ChangeMeasure::stenosis,       ChangeMeasure::length,
                                                ChangeMeasure::plaque,         ChangeMeasure::low_attenuation,
                                                ChangeMeasure::calcified,      ChangeMeasure::remodelling};
const std::vector<ChangeMeasure> placed_columns{ChangeMeasure::least_diameter, ChangeMeasure::least_area,
                                                ChangeMeasure::plaque,         ChangeMeasure::low_attenuation,
                                                ChangeMeasure::fibrofatty,     ChangeMeasure::fibrous,
                                                ChangeMeasure::calcified,      ChangeMeasure::burden};

CompareRows lesion_rows_of(const Comparison& made) {
  CompareRows rows;
  for (const analysis::LesionChange& one : made.change.lesions) {
    std::vector<std::string> row{compared_label(made, one), one.vessel_name, one.segment};
    add_measures(row, one.change, lesion_columns);
    rows.push_back(std::move(row));
  }
  return rows;
}

CompareRows placed_rows(const std::vector<analysis::PlacedChange>& all) {
  CompareRows rows;
  for (const analysis::PlacedChange& one : all) {
    std::vector<std::string> row{one.label, core::percent_text(100.0 * one.covered_share)};
    add_measures(row, one.change, placed_columns);
    rows.push_back(std::move(row));
  }
  return rows;
}

CompareRows patient_rows(const Comparison& made) {
  CompareRows rows;
  for (const ChangeMeasure measure : analysis::change_measures) {
    const Difference& one = analysis::of(made.change.patient, measure);
    if (!one.change()) continue;
    const int decimals = decimals_of(measure);
    rows.push_back({analysis::title_of(measure), core::shown_text(one.before, decimals),
                    core::shown_text(one.after, decimals), core::signed_text(*one.change(), decimals),
                    core::shown_text(one.smallest_real, decimals), analysis::to_string(one.verdict())});
  }
  return rows;
}

std::vector<std::pair<std::string, std::string>> comparison_facts(const Comparison& made) {
  using analysis::LesionFate;
  const auto count = [&](LesionFate fate) {
    return std::ranges::count(made.change.lesions, fate, &analysis::LesionChange::fate);
  };
  const auto image = [](const ComparedCase& one) {
    return (one.image ? one.image->pseudonym : std::string("the case names none")) +
           (one.has_image ? "" : " (not at hand)");
  };
  std::vector<std::pair<std::string, std::string>> rows{
      {"Former scan", image(made.before)},
      {"Later scan", image(made.after)},
      {"Lesions", std::to_string(count(LesionFate::both)) + " in both scans, " +
                      std::to_string(count(LesionFate::appeared)) + " new, " +
                      std::to_string(count(LesionFate::gone)) + " gone, " +
                      std::to_string(count(LesionFate::before_unseen) + count(LesionFate::after_unseen)) +
                      " in what one tree alone reaches"},
      {"Map between the scans", made.map_words},
      {"Axes on each other", core::fixed_text(made.fit.axes_mm, 2) + " mm apart in the mean when rigid; " +
                                 core::percent_text(100.0 * made.change.match.shared_share) +
                                 " % of the shorter tree is in both"}};
  double worst = 0.0;
  for (const double one : made.fit.landmark_residuals_mm) worst = std::max(worst, one);
  if (!made.fit.landmarks.empty())
    rows.emplace_back("Ostia and forks", std::to_string(made.fit.landmarks.size()) +
                                             " named in both, up to " + core::fixed_text(worst, 1) +
                                             " mm apart when rigid");
  rows.emplace_back("Repeatability", made.repeatability.from.empty() ? "not known" : made.repeatability.from);
  rows.emplace_back("Program", "Ostia " + core::version());
  return rows;
}

template <class Document>
void write_compared(Document& page, const Comparison& made, const std::vector<KeyImage>& images) {
  using figure::Notice;
  page.notice(Notice::note, compare_disclaimer);
  if (!made.another_patient.empty()) page.notice(Notice::bad, "Hardly one patient: " + made.another_patient);
  for (const std::string& warning : made.warnings) page.notice(Notice::warning, warning);
  page.section("Summary");
  page.key_values(comparison_facts(made));
  page.section("Lesions");
  if (made.change.lesions.empty())
    page.paragraph("No lesion in either scan.");
  else
    page.table(measures_header({"lesion", "vessel", "segment"}, lesion_columns), lesion_rows_of(made),
               "Each over the same stretch of both scans, before \u2192 now. " + std::string(mark_words));
  if (const CompareRows rows = patient_rows(made); !rows.empty()) {
    page.section("All vessels together");
    page.table({"", "before", "now", "difference", "smallest real difference", "verdict"}, rows,
               "Of what both trees reach");
  }
  page.section("Vessels and segments");
  page.table(measures_header({"vessel", "of it, %"}, placed_columns), placed_rows(made.change.vessels),
             "The part that is in both scans, before \u2192 now. " + std::string(mark_words));
  page.table(measures_header({"segment", "of it, %"}, placed_columns), placed_rows(made.change.segments),
             "The former scan's segments, carried to the later one");
  if (!made.change.unmatched.empty()) {
    page.section("Not compared");
    for (const std::string& one : made.change.unmatched) page.paragraph(one + ".");
  }
  if (!images.empty()) page.section("Along the vessels");
  for (const KeyImage& image : images) page.picture(image.picture, image.caption);
}

/// By the later scan's abscissas.
struct AlongVessel {
  std::vector<double> s_mm, value;
  void add(const std::optional<double>& s, double y) {
    if (!s) return;
    s_mm.push_back(*s);
    value.push_back(y);
  }
};

figure::Series series_of(const AlongVessel& along, const std::string& name, const figure::Color& color,
                         figure::LineStyle style = figure::LineStyle::solid) {
  return {name, along.s_mm, along.value, color, style, 2.0};
}

const analysis::ScannedVessel& scanned_vessel(const ComparedCase& of, std::int32_t id) {
  return *std::ranges::find(of.tree.vessels, id, &analysis::ScannedVessel::vessel);
}

figure::Picture along_picture(const Comparison& made, const analysis::VesselMatch& match) {
  const auto& was = scanned_vessel(made.before, match.before);
  const auto& is = scanned_vessel(made.after, match.after);
  const auto carried = [&](double s) { return match.to_after(s); };
  const auto same = [](double s) { return std::optional(s); };
  const auto diameters = [](const analysis::ScannedVessel& of, const auto& place) {
    AlongVessel along;
    for (const auto& section : of.profile.sections)
      along.add(place(section.s_mm), section.found || !section.open
                                         ? section.diameter_mm
                                         : std::numeric_limits<double>::quiet_NaN());
    return along;
  };
  const figure::Color before = figure::palette(1), now = figure::palette(3);
  figure::PlotOptions how;
  how.title = is.name + ": lumen";
  how.x_label = "mm along the vessel, later scan";
  how.y_label = "diameter, mm";
  how.y_from_zero = true;
  for (const analysis::LesionChange& one : made.change.lesions)
    if (one.after_stretch && one.after_stretch->vessel == match.after)
      how.references.push_back({figure::ReferenceLine::Along::x,
                                0.5 * (one.after_stretch->from_mm + one.after_stretch->to_mm),
                                compared_label(made, one)});
  const figure::Picture lumen = figure::line_plot(
      {series_of(diameters(was, carried), "before", before), series_of(diameters(is, same), "now", now)},
      how);
  if (!was.plaque || !is.plaque) return lumen;
  const auto plaques = [](const analysis::ScannedVessel& of, const auto& place) {
    AlongVessel along;
    for (const analysis::PlaqueSlab& slab : of.plaque->slabs) along.add(place(slab.s_mm), slab.plaque_mm2);
    return along;
  };
  const AlongVessel plaque_before = plaques(was, carried), plaque_now = plaques(is, same);
  if (plaque_before.s_mm.empty() || plaque_now.s_mm.empty()) return lumen;
  how.title = is.name + ": plaque";
  how.y_label = "plaque, mm2";
  return figure::grid(
      {lumen, figure::line_plot(
                  {series_of(plaque_before, "before", before), series_of(plaque_now, "now", now)}, how)},
      {.columns = 1, .look = figure::Look::light, .gap_px = 6});
}

std::string listed_labels(const std::vector<std::size_t>& which, const ComparedCase& of) {
  std::string text;
  for (const std::size_t i : which) text += (text.empty() ? "" : ", ") + of.tree.lesions[i].label;
  return text;
}

}  // namespace

std::string compared_vessel_name(const ComparedCase& of, std::int32_t vessel) {
  const auto found = std::ranges::find(of.tree.vessels, vessel, &analysis::ScannedVessel::vessel);
  return found != of.tree.vessels.end() ? found->name : std::to_string(vessel);
}

std::string compared_label(const Comparison& made, const analysis::LesionChange& lesion) {
  const std::string before = listed_labels(lesion.before, made.before);
  const std::string after = listed_labels(lesion.after, made.after);
  if (lesion.fate == analysis::LesionFate::both) return before + " \u2192 " + after;
  return (before.empty() ? after : before) + " (" + analysis::to_string(lesion.fate) + ")";
}

std::vector<KeyImage> comparison_images(const Comparison& made) {
  std::vector<KeyImage> images;
  for (const analysis::VesselMatch& match : made.change.match.vessels) {
    const auto& is = scanned_vessel(made.after, match.after);
    if (match.shared_mm < least_drawn_mm || is.profile.sections.size() < 2) continue;
    images.push_back({"vessel-" + std::to_string(match.after),
                      is.name + " before (blue) and now (orange-red), lesions in the middle of their stretch",
                      along_picture(made, match)});
  }
  return images;
}

std::string comparison_html(const Comparison& made, const std::vector<KeyImage>& images) {
  figure::HtmlReport page("Compared with the former scan", "Two cases of one patient");
  write_compared(page, made, images);
  return page.html();
}

std::string comparison_pdf(const Comparison& made, const std::vector<KeyImage>& images) {
  figure::PdfDocument page("Compared with the former scan", "Two cases of one patient");
  write_compared(page, made, images);
  return page.pdf();
}

}  // namespace ostia::session
