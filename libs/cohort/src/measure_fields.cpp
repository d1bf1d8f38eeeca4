#include "measure_fields.h"

#include <array>

namespace ostia::cohort {
namespace {

constexpr std::array levels_of_measures{MeasureLevel{"measures", "patient", "", "", ""},
                                        MeasureLevel{"measures", "vessel", "vessels", "/name", ""},
                                        MeasureLevel{"measures", "segment", "segments", "/label", ""},
                                        MeasureLevel{"measures", "stenosis", "stenoses", "/number", "S"},
                                        MeasureLevel{"pressure", "outlet", "outlets", "/name", ""}};

constexpr std::array fields_of_measures{
    MeasureField{"patient", "/cad_rads/category", "cad_rads", "",
                 "CAD-RADS 2.0 category of the patient; N: not diagnostic"},
    MeasureField{"patient", "/cad_rads/burden/segments", "plaque_segments", "1", "segments with plaque"},
    MeasureField{"patient", "/dominance/value", "dominance", "", "which artery supplies the posterior wall"},
    MeasureField{"patient", "/all_checked", "all_checked", "", "true: a person has checked every vessel"},
    MeasureField{"vessel", "/length_mm", "length_mm", "mm", "length along the axis, from the ostium"},
    MeasureField{"vessel", "/checked", "checked", "", "true: a person has checked the vessel"},
    MeasureField{"vessel", "/plaque/plaque_mm3", "plaque_mm3", "mm3",
                 "plaque of all classes between lumen and outer wall"},
    MeasureField{"vessel", "/plaque/low_attenuation_mm3", "low_attenuation_mm3", "mm3",
                 "of it, low attenuation"},
    MeasureField{"vessel", "/plaque/fibrofatty_mm3", "fibrofatty_mm3", "mm3", "of it, fibro-fatty"},
    MeasureField{"vessel", "/plaque/fibrous_mm3", "fibrous_mm3", "mm3", "of it, fibrous"},
    MeasureField{"vessel", "/plaque/calcified_mm3", "calcified_mm3", "mm3", "of it, calcified"},
    MeasureField{"vessel", "/plaque/burden_percent", "burden_percent", "%",
                 "plaque as a share of all within the outer wall"},
    MeasureField{"segment", "/length_mm", "length_mm", "mm", "length along the axis"},
    MeasureField{"segment", "/mean_diameter_mm", "mean_diameter_mm", "mm", "mean of the lumen's diameters"},
    MeasureField{"segment", "/least_diameter_mm", "least_diameter_mm", "mm", "minimal lumen diameter (MLD)"},
    MeasureField{"segment", "/least_area_mm2", "least_area_mm2", "mm2", "minimal lumen area (MLA)"},
    MeasureField{"segment", "/volume_mm3", "volume_mm3", "mm3", "volume of the lumen"},
    MeasureField{"segment", "/worst_percent", "worst_percent", "%",
                 "diameter stenosis of its worst narrowing"},
    MeasureField{"stenosis", "/main_vessel", "main_vessel", "", "the artery that it counts for"},
    MeasureField{"stenosis", "/segment", "segment", "", "the segment that it lies in"},
    MeasureField{"stenosis", "/length_mm", "length_mm", "mm", "length along the axis"},
    MeasureField{"stenosis", "/diameter_percent", "diameter_percent", "%", "diameter stenosis"},
    MeasureField{"stenosis", "/area_percent", "area_percent", "%", "area stenosis"},
    MeasureField{"stenosis", "/least_diameter_mm", "least_diameter_mm", "mm", "minimal lumen diameter (MLD)"},
    MeasureField{"stenosis", "/least_area_mm2", "least_area_mm2", "mm2", "minimal lumen area (MLA)"},
    MeasureField{"stenosis", "/reference_diameter_mm", "reference_diameter_mm", "mm",
                 "of the healthy lumen there"},
    MeasureField{"stenosis", "/plaque/plaque_mm3", "plaque_mm3", "mm3", "plaque of all classes"},
    MeasureField{"stenosis", "/remodelling_index", "remodelling_index", "1",
                 "outer wall at the lesion against beside it"},
    MeasureField{"stenosis", "/cad_rads", "cad_rads", "", "its grade, where it is graded"},
    MeasureField{"stenosis", "/checked", "checked", "", "true: a person has checked it"},
    MeasureField{"outlet", "/ffr", "ffr", "1", "FFR at the vessel's end, computed from its form"},
    MeasureField{"outlet", "/rest_ml_min", "rest_ml_min", "ml/min", "flow at rest"},
    MeasureField{"outlet", "/hyperaemic_ml_min", "hyperaemic_ml_min", "ml/min", "flow under adenosine"}};

constexpr std::array words_of_columns{
    ColumnWords{"scans", "scan", "pseudonym of the scan: a keyed hash of its id"},
    ColumnWords{"scans", "patient", "pseudonym of the patient, the same for all scans of one"},
    ColumnWords{"scans", "kind", "image or mask"},
    ColumnWords{
        "scans", "import",
        "state of this stage: waiting, ok, quality (done, a person must look), failed, stale, damaged"},
    ColumnWords{"scans", "extract", "likewise"},
    ColumnWords{"scans", "lumen", "likewise"},
    ColumnWords{"scans", "mesh", "likewise"},
    ColumnWords{"scans", "measures", "likewise"},
    ColumnWords{"scans", "pressure", "likewise"},
    ColumnWords{"measures", "scan", "as in scans"},
    ColumnWords{"measures", "patient", "as in scans"},
    ColumnWords{"measures", "level",
                "what is measured: patient, vessel, segment, stenosis, outlet (a vessel's end)"},
    ColumnWords{"measures", "entry", "which of them in the result, from 1"},
    ColumnWords{"measures", "item", "its name: RCA, pRCA (1), S1; empty for the patient"},
    ColumnWords{"measures", "measure", "name of the measure, below"},
    ColumnWords{"measures", "value", "the value, in the unit; what is not known has no row"},
    ColumnWords{"measures", "unit", "mm, mm2, mm3, %, ml/min, 1 (a number), empty (a text)"}};

}  // namespace

std::span<const MeasureField> measure_fields() {
  return fields_of_measures;
}
std::span<const MeasureLevel> measure_levels() {
  return levels_of_measures;
}
std::span<const ColumnWords> column_words() {
  return words_of_columns;
}

}  // namespace ostia::cohort
