#pragma once
/// \file What every object that is written has in common: whose it is, of which study, of which images.

#include "ostia/core/task_context.h"
#include "ostia/imaging/dicom.h"
#include "ostia/imaging/dicom_dataset.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::dicom {

using imaging::DicomDataset;
using imaging::Vec3;

/// One slice of the source series.
struct SourceFrame {
  std::string sop_class, sop_instance;
  int frame = 0;                 ///< of a multi-frame instance, from 1; 0: a single-frame one
  Vec3 position = Vec3::Zero();  ///< ImagePositionPatient
};

/// The series that objects are derived from.
struct SourceSeries {
  DicomDataset identity;  ///< patient and study, byte for byte as in the source, with its character set
  std::string study_uid, series_uid, frame_of_reference;
  std::vector<SourceFrame> frames;  ///< none where the source is not at hand
  bool pseudonym = false;           ///< identity is made up
};

/// From the headers of a series' files, by our own parser. Throws InvalidInput where a file lacks what is
/// needed (study, series, SOP instance, frame of reference), or files are of two patients, studies or frames
/// of reference; IoError.
SourceSeries source_of(const imaging::DicomSeries& series, const core::TaskContext& task = core::no_task());

/// Nobody's, of a study of its own: for objects that go nowhere near a patient's record. `seed`: what the
/// image is known by; the same seed, the same study.
SourceSeries pseudonymous_source(const std::string& pseudonym, const std::string& seed);

/// What an object says of itself.
struct ObjectOptions {
  std::string content_date = "19700101", content_time = "000000";  ///< DA, TM
  std::int64_t instance_number = 1;                                ///< rises with each amendment
  std::int64_t series_number = 1;
  std::string series_description;
  std::string software_version;  ///< of Ostia
  std::string creator;           ///< ContentCreatorName; may be empty
};

/// Patient, study, series (whose UID follows from the source series and `kind`), equipment and SOP class.
DicomDataset object_head(const SourceSeries& source, const std::string& sop_class,
                         const std::string& modality, const std::string& kind, const ObjectOptions& options);
/// Gives the finished object its SOP instance UID, which follows from all that it holds: the same content is
/// the same instance, other content another one of the same series.
void seal(DicomDataset& object);

/// Text of our own for a data set: of what its character set cannot hold '?' is made; no control characters,
/// no backslash, at most `most` characters.
std::string own_text(const DicomDataset& object, const std::string& utf8, std::size_t most);
/// A value of VR LO (64 characters) or UT; as above.
void set_own_text(DicomDataset& object, const DicomDataset& root, imaging::DicomTag tag, const char* vr,
                  const std::string& utf8);

/// Adds references to instances of the source series as sequence `tag` of items (0008,1150), (0008,1155):
/// each instance once; nothing without the source.
void add_source_instances(const SourceSeries& source, DicomDataset& to, imaging::DicomTag tag);
/// The same as the Common Instance Reference module (PS3.3 C.12.2) has it; nothing without the source.
void add_referenced_series(const SourceSeries& source, DicomDataset& to);

}  // namespace ostia::dicom
