#pragma once
/// \file Coded concepts (PS3.3 8.8), and those that our objects use. docs/reference/dicom-objects.md says
/// from which context group of PS3.16 each is.

#include "ostia/imaging/dicom_dataset.h"

#include <optional>
#include <string>

namespace ostia::dicom {

struct Code {
  std::string value, scheme, meaning;  ///< "41801008", "SCT", "Coronary artery"
  bool operator==(const Code& other) const { return value == other.value && scheme == other.scheme; }
};

/// Makes the sequence `tag` of this one code.
void set_code(imaging::DicomDataset& data, imaging::DicomTag tag, const Code& code);
/// The first code of a sequence.
std::optional<Code> code_of(const imaging::DicomDataset& data, imaging::DicomTag tag);

namespace codes {
inline const Code coronary_artery{"41801008", "SCT", "Coronary artery"};
inline const Code artery{"51114001", "SCT", "Artery"};
inline const Code vessel_lumen{"91747007", "SCT", "Lumen of blood vessel"};
inline const Code body_structure{"123037004", "SCT", "Anatomical Structure"};
inline const Code abnormal_structure{"49755003", "SCT", "Morphologically Abnormal Structure"};
inline const Code plaque{"1522000", "SCT", "Plaque"};
inline const Code soft_plaque{"122356", "DCM", "Soft plaque"};
inline const Code fibrolipidic_plaque{"122394", "DCM", "Fibro-Lipidic Plaque"};
inline const Code fibrous_plaque{"40772000", "SCT", "Fibrous Plaque"};
inline const Code calcified_plaque{"29483008", "SCT", "Calcified atheromatous plaque"};
inline const Code stenosis{"415582006", "SCT", "Stenosis"};

inline const Code millimetre{"mm", "UCUM", "mm"};
inline const Code square_millimetre{"mm2", "UCUM", "mm2"};
inline const Code cubic_millimetre{"mm3", "UCUM", "mm3"};
inline const Code percent{"%", "UCUM", "%"};
inline const Code ratio{"{ratio}", "UCUM", "ratio"};

inline const Code length{"410668003", "SCT", "Length"};
inline const Code lesion_length{"408716009", "SCT", "Stenotic Lesion Length"};
inline const Code volume{"118565006", "SCT", "Volume"};
inline const Code lumen_volume{"122372", "DCM", "Lumen Volume"};
inline const Code plaque_volume{"122376", "DCM", "Total Plaque Volume"};
inline const Code plaque_burden{"122354", "DCM", "Plaque Burden"};
inline const Code remodelling_index{"122345", "DCM", "Remodeling Index"};
inline const Code lumen_diameter{"397413000", "SCT", "Vessel lumen diameter"};
inline const Code lumen_area{"397415007", "SCT", "Vessel lumen cross-sectional area"};
inline const Code diameter_stenosis{"408715008", "SCT", "Lumen Diameter Stenosis"};
inline const Code area_stenosis{"408714007", "SCT", "Lumen Area Stenosis"};
inline const Code fractional_flow_reserve{"371842003", "SCT", "Fractional flow reserve"};
inline const Code minimum{"255605001", "SCT", "Minimum"};
inline const Code mean{"373098007", "SCT", "Mean"};
}  // namespace codes

/// The site of one of the 18 standard segments (analysis::AhaSegment::number): its code of CID 3015 "Coronary
/// Arteries", the coronary artery as a whole for other numbers.
Code segment_site(int number);

/// CAD-RADS (CID 3020 to 3022): the assessment, and what modifies it. `category` is "0" to "5", "4A", "4B" or
/// "N"; nothing for anything else.
struct CadRadsCodes {
  Code assessment;
  std::optional<Code> stenosis_modifier;  ///< of 4A and 4B
};
std::optional<CadRadsCodes> cad_rads_codes(const std::string& category);
inline const Code cad_assessment{"130720", "DCM", "Coronary Artery Disease Assessment"};
inline const Code cad_modifier{"130721", "DCM", "Coronary Artery Disease Assessment Modifier"};
inline const Code cad_stenosis_modifier{"130722", "DCM",
                                        "Coronary Artery Disease Stenosis Assessment Modifier"};
inline const Code stent_modifier{"130733", "DCM", "S - Stent"};
inline const Code graft_modifier{"130734", "DCM", "G - Graft"};
inline const Code not_diagnostic_segments{"130732", "DCM", "N - Non-diagnostic segments"};

}  // namespace ostia::dicom
