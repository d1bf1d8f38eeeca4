#include "ostia/dicom/code.h"

#include <array>

namespace ostia::dicom {

void set_code(imaging::DicomDataset& data, imaging::DicomTag tag, const Code& code) {
  data.erase(tag);
  imaging::DicomDataset& item = data.add_item(tag);
  item.set_text(0x00080100, "SH", code.value);
  item.set_text(0x00080102, "SH", code.scheme);
  item.set_text(0x00080104, "LO", code.meaning);
}

std::optional<Code> code_of(const imaging::DicomDataset& data, imaging::DicomTag tag) {
  const imaging::DicomDataset* item = data.item(tag);
  if (!item) return std::nullopt;
  return Code{item->text(0x00080100), item->text(0x00080102), item->text(0x00080104)};
}

Code segment_site(int number) {
  static const std::array<Code, 19> sites{{
      codes::coronary_artery,
      {"91083009", "SCT", "Proximal Right Coronary Artery"},
      {"450960006", "SCT", "Mid Right Coronary Artery"},
      {"41879009", "SCT", "Distal Right Coronary Artery"},
      {"53655008", "SCT", "Posterior Descending Right Coronary Artery"},
      {"3227004", "SCT", "Left Main Coronary Artery"},
      {"68787002", "SCT", "Proximal Left Anterior Descending Coronary Artery"},
      {"91748002", "SCT", "Mid Left Anterior Descending Coronary Artery"},
      {"36672000", "SCT", "Distal Left Anterior Descending Coronary Artery"},
      {"91750005", "SCT", "1st Diagonal Coronary Artery"},
      {"91751009", "SCT", "2nd Diagonal Coronary Artery"},
      {"52433000", "SCT", "Proximal Circumflex Coronary Artery"},
      {"91754001", "SCT", "1st Marginal Coronary Artery"},
      // The 13th segment is the groove's part of the circumflex behind the first marginal.
      {"6511003", "SCT", "Distal Circumflex Coronary Artery"},
      {"91755000", "SCT", "2nd Marginal Coronary Artery"},
      {"91760001", "SCT", "Left Posterior Descending Circumflex Coronary Artery"},
      {"91761002", "SCT", "1st Right posterolateral Coronary Artery"},
      {"244252004", "SCT", "Intermediate Artery (Ramus)"},
      {"57823005", "SCT", "Left Posterolateral Circumflex Coronary Artery"},
  }};
  return sites[number >= 1 && number <= 18 ? static_cast<std::size_t>(number) : 0];
}

std::optional<CadRadsCodes> cad_rads_codes(const std::string& category) {
  const auto code = [](const char* value, const char* meaning) { return Code{value, "DCM", meaning}; };
  const Code severe = code("130727", "4 - Severe stenosis");
  if (category == "0") return CadRadsCodes{code("130723", "0 - Documented absence of CAD"), {}};
  if (category == "1") return CadRadsCodes{code("130724", "1 - Minimal non-obstructive CAD"), {}};
  if (category == "2") return CadRadsCodes{code("130725", "2 - Mild non-obstructive CAD"), {}};
  if (category == "3") return CadRadsCodes{code("130726", "3 - Moderate stenosis"), {}};
  if (category == "4A") return CadRadsCodes{severe, code("130728", "4A - Severe stenosis")};
  if (category == "4B") return CadRadsCodes{severe, code("130729", "4B - Severe stenosis")};
  if (category == "5") return CadRadsCodes{code("130730", "5 - Total coronary occlusion"), {}};
  if (category == "N") return CadRadsCodes{code("130731", "N - Non-diagnostic study"), {}};
  return std::nullopt;
}

}  // namespace ostia::dicom
