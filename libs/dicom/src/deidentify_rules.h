#pragma once
/// \file What becomes of each attribute of an image that is de-identified.

#include "ostia/imaging/dicom_dataset.h"

namespace ostia::dicom {

enum class TagFate {
  remove,  ///< all that is in no list
  keep,
  empty,
  new_uid,
  dummy_date,  ///< of enhanced images, which must have one
  dummy_time,
};
TagFate fate_of(imaging::DicomTag tag);

}  // namespace ostia::dicom
