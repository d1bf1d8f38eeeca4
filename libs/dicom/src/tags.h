#pragma once
/// \file Names of the tags that several sources of the room use (PS3.6).

#include "ostia/imaging/dicom_dataset.h"

namespace ostia::dicom::tag {

using imaging::DicomTag;
inline constexpr DicomTag sop_class = 0x00080016, sop_instance = 0x00080018, modality = 0x00080060;
inline constexpr DicomTag referenced_series = 0x00081115, referenced_class = 0x00081150,
                          referenced_instance = 0x00081155, referenced_frame = 0x00081160;
inline constexpr DicomTag patient_name = 0x00100010, patient_id = 0x00100020;
inline constexpr DicomTag deidentification_codes = 0x00120064;
inline constexpr DicomTag study_uid = 0x0020000D, series_uid = 0x0020000E, frame_of_reference = 0x00200052;
inline constexpr DicomTag image_position = 0x00200032, image_orientation = 0x00200037;
inline constexpr DicomTag number_of_frames = 0x00280008, rows = 0x00280010, columns = 0x00280011,
                          pixel_spacing = 0x00280030, bits_allocated = 0x00280100;
inline constexpr DicomTag plane_position = 0x00209113, plane_orientation = 0x00209116,
                          pixel_measures = 0x00289110, shared_groups = 0x52009229,
                          per_frame_groups = 0x52009230, segment_identification = 0x0062000A,
                          segment_number_reference = 0x0062000B;
inline constexpr DicomTag pixel_data = 0x7FE00010;

}  // namespace ostia::dicom::tag
