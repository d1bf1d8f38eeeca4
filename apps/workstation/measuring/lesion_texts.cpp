#include "measuring/lesion_texts.h"

#include "shell/quantities.h"

#include "ostia/view/words.h"

#include <QCoreApplication>

namespace ostia::workstation {
namespace {

struct LesionTexts {
  Q_DECLARE_TR_FUNCTIONS(LesionTexts)
};

/// Its grade, or why it has none.
QString grade_text(const session::LesionRow& row) {
  using session::GradeBar;
  switch (row.bar()) {
    case GradeBar::none:
      break;
    case GradeBar::rejected:
      return QStringLiteral("\u2013");
    case GradeBar::not_evaluable_by_reader:
    case GradeBar::not_evaluable:
      return LesionTexts::tr("not graded: not evaluable");
    case GradeBar::limited:
      return LesionTexts::tr("not graded: limited");
    case GradeBar::unlikely:
      return LesionTexts::tr("not graded: hardly an artery");
    case GradeBar::image_unknown:
      return row.has_image ? QStringLiteral("?") : LesionTexts::tr("not graded: not checked");
  }
  return QString::fromStdString(analysis::to_string(row.lesion.category()));
}

QString class_text(const session::LesionRow& row) {
  if (!row.lesion.plaque) return QStringLiteral("?");
  switch (analysis::plaque_type(*row.lesion.plaque)) {
    case analysis::PlaqueType::none:
      return LesionTexts::tr("none");
    case analysis::PlaqueType::non_calcified:
      return LesionTexts::tr("non-calcified");
    case analysis::PlaqueType::mixed:
      return LesionTexts::tr("mixed");
    case analysis::PlaqueType::calcified:
      break;
  }
  return LesionTexts::tr("calcified");
}

QString evaluable_text(const session::LesionRow& row) {
  if (!row.evaluable) return QStringLiteral("?");
  const view::Words& words = view::words();
  const std::string& grade = row.evaluable->grade == analysis::Evaluability::evaluable ? words.evaluable
                             : row.evaluable->grade == analysis::Evaluability::limited ? words.limited
                                                                                       : words.not_evaluable;
  return QString::fromStdString(row.evaluable->by_person ? grade + " (" + words.by_reader + ")" : grade);
}

}  // namespace

QStringList lesion_titles() {
  return {LesionTexts::tr("No."),    LesionTexts::tr("Segment"),        LesionTexts::tr("Grade"),
          LesionTexts::tr("%"),      LesionTexts::tr("FFR (research)"), LesionTexts::tr("MLD"),
          LesionTexts::tr("MLA"),    LesionTexts::tr("Length"),         LesionTexts::tr("Plaque"),
          LesionTexts::tr("Class"),  LesionTexts::tr("Image"),          LesionTexts::tr("State"),
          LesionTexts::tr("Comment")};
}

QStringList lesion_titles_in_full() {
  return {LesionTexts::tr("Lesion"),
          LesionTexts::tr("Segment"),
          LesionTexts::tr("CAD-RADS of the lesion"),
          LesionTexts::tr("Diameter stenosis (%)"),
          LesionTexts::tr("FFR behind it (computed, for research)"),
          LesionTexts::tr("Minimal lumen diameter (mm)"),
          LesionTexts::tr("Minimal lumen area (mm\u00b2)"),
          LesionTexts::tr("Length (mm)"),
          LesionTexts::tr("Plaque (mm\u00b3)"),
          LesionTexts::tr("Class of the plaque"),
          LesionTexts::tr("Evaluable"),
          LesionTexts::tr("State"),
          LesionTexts::tr("Comment")};
}

QStringList lesion_cells(const session::LesionRow& row) {
  const analysis::Stenosis& s = row.lesion.stenosis;
  return {QStringLiteral("S%1").arg(row.number),
          QString::fromStdString(row.segment.empty() ? row.vessel_name : row.segment),
          grade_text(row),
          quantity::stenosis(s.diameter_percent),
          QString(),
          quantity::calibre(s.least_diameter_mm),
          quantity::area(s.least_area_mm2),
          quantity::length(s.length_mm()),
          row.lesion.plaque ? quantity::volume(row.lesion.plaque->plaque_mm3()) : QStringLiteral("?"),
          class_text(row),
          evaluable_text(row),
          state_word(row.state),
          QString::fromStdString(row.comment)};
}

std::vector<std::optional<double>> lesion_numbers(const session::LesionRow& row) {
  const analysis::Stenosis& s = row.lesion.stenosis;
  std::vector<std::optional<double>> out(lesion_columns);
  out[number_column] = row.number;
  // Those without a grade stand before all that have one.
  out[grade_column] =
      row.bar() == session::GradeBar::none ? static_cast<double>(row.lesion.category()) : -1.0;
  out[percent_column] = s.diameter_percent;
  out[mld_column] = s.least_diameter_mm;
  out[mla_column] = s.least_area_mm2;
  out[lesion_length_column] = s.length_mm();
  if (row.lesion.plaque) out[plaque_column] = row.lesion.plaque->plaque_mm3();
  return out;
}

QString lesion_tip(const session::LesionRow& row) {
  const analysis::Stenosis& s = row.lesion.stenosis;
  const QString where = row.lesion.narrows ? LesionTexts::tr("%1, narrowest at %2 mm")
                                           : LesionTexts::tr("%1, plaque about %2 mm");
  QString tip = where.arg(QString::fromStdString(row.vessel_name), quantity::length(s.throat_mm));
  if (row.bar() != session::GradeBar::none && row.state != session::LesionState::rejected)
    tip += '\n' + LesionTexts::tr(
                      "A lesion has a grade where its stretch is evaluable, its vessel is Done, or "
                      "you have accepted it.");
  return tip;
}

QString ffr_cell(const std::optional<session::LesionFfr>& ffr) {
  if (!ffr) return QStringLiteral("?");
  const auto text = [](const hemodynamics::LesionReading& one) {
    return one.occluded ? QStringLiteral("\u2013") : quantity::ratio(one.behind);
  };
  return ffr->after ? text(ffr->now) + QStringLiteral(" \u2192 ") + text(*ffr->after) : text(ffr->now);
}

QString ffr_tip(const std::optional<session::LesionFfr>& ffr) {
  if (!ffr || ffr->now.occluded) return LesionTexts::tr("Nothing flows there, or it has no sections.");
  return LesionTexts::tr("Computed, for research; read %1 mm behind it. The lesion takes %2 of it.")
      .arg(quantity::length(ffr->now.distance_mm), quantity::ratio(ffr->now.delta()));
}

QString state_word(session::LesionState state) {
  switch (state) {
    case session::LesionState::open:
      return LesionTexts::tr("open");
    case session::LesionState::accepted:
      return LesionTexts::tr("accepted");
    case session::LesionState::rejected:
      break;
  }
  return LesionTexts::tr("rejected");
}

}  // namespace ostia::workstation
