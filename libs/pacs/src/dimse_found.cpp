#include "dimse_found.h"

#include "text.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>

#include <charconv>

namespace ostia::pacs {
namespace {

/// A value as it is, or all of those that are separated by backslashes.
std::string value_of(DcmDataset& answer, const DcmTagKey& tag) {
  OFString text;
  answer.findAndGetOFStringArray(tag, text);
  return std::string(text.c_str(), text.size());
}

}  // namespace

Found found_in(DcmDataset& answer, bool& readable) {
  // An unknown character set leaves the bytes as they are; clean_text then shows '?'.
  readable = answer.convertToUTF8().good();
  const auto text = [&](const DcmTagKey& tag) { return clean_text(value_of(answer, tag)); };
  Found one;
  one.study_uid = text(DCM_StudyInstanceUID);
  one.series_uid = text(DCM_SeriesInstanceUID);
  one.sop_uid = text(DCM_SOPInstanceUID);
  one.sop_class = text(DCM_SOPClassUID);
  one.patient_name = clean_name(value_of(answer, DCM_PatientName));
  one.patient_id = text(DCM_PatientID);
  one.birth_date = text(DCM_PatientBirthDate);
  one.study_date = text(DCM_StudyDate);
  one.study_time = text(DCM_StudyTime);
  one.accession = text(DCM_AccessionNumber);
  one.study_description = text(DCM_StudyDescription);
  one.modality = text(DCM_Modality);
  if (one.modality.empty()) one.modality = text(DCM_ModalitiesInStudy);
  one.series_description = text(DCM_SeriesDescription);
  one.series_number = text(DCM_SeriesNumber);
  std::string images = text(DCM_NumberOfSeriesRelatedInstances);
  if (images.empty()) images = text(DCM_NumberOfStudyRelatedInstances);
  long count = -1;
  if (std::from_chars(images.data(), images.data() + images.size(), count).ec == std::errc() && count >= 0)
    one.images = count;
  return one;
}

}  // namespace ostia::pacs
