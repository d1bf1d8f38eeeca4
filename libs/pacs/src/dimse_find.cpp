// C-FIND, study root (PS3.4 C.4.1).

#include "dimse_archive.h"
#include "dimse_found.h"
#include "text.h"
#include "uid.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/dimse.h>

namespace ostia::pacs {
namespace {

void ask(DcmDataset& keys, const DcmTagKey& tag, const std::string& value = {}) {
  keys.putAndInsertString(tag, value.c_str());
}

void ask_study(DcmDataset& keys, const Query& query) {
  const bool dated = !query.from_date.empty() || !query.to_date.empty();
  ask(keys, DCM_QueryRetrieveLevel, "STUDY");
  ask(keys, DCM_PatientName, query.patient_name);
  ask(keys, DCM_PatientID, query.patient_id);
  ask(keys, DCM_PatientBirthDate);
  ask(keys, DCM_StudyInstanceUID, query.study_uid);
  ask(keys, DCM_StudyDate, dated ? query.from_date + "-" + query.to_date : std::string());
  ask(keys, DCM_StudyTime);
  ask(keys, DCM_AccessionNumber);
  ask(keys, DCM_StudyDescription, query.description);
  ask(keys, DCM_ModalitiesInStudy, query.modality);
  ask(keys, DCM_NumberOfStudyRelatedInstances);
}

void ask_series(DcmDataset& keys, const Query& query) {
  ask(keys, DCM_QueryRetrieveLevel, "SERIES");
  ask(keys, DCM_StudyInstanceUID, query.study_uid);
  ask(keys, DCM_SeriesInstanceUID, query.series_uid);
  ask(keys, DCM_Modality, query.modality);
  ask(keys, DCM_SeriesDescription, query.description);
  ask(keys, DCM_SeriesNumber);
  ask(keys, DCM_NumberOfSeriesRelatedInstances);
}

void ask_image(DcmDataset& keys, const Query& query) {
  ask(keys, DCM_QueryRetrieveLevel, "IMAGE");
  ask(keys, DCM_StudyInstanceUID, query.study_uid);
  ask(keys, DCM_SeriesInstanceUID, query.series_uid);
  ask(keys, DCM_SOPInstanceUID);
  ask(keys, DCM_SOPClassUID);
}

struct Gathering {
  DimseConnection* connection;
  unsigned char context;
  const Query* query;
  FindResult result;
  std::size_t unreadable = 0, without_uid = 0;
  bool cancel_sent = false;
};

bool has_uid(const Found& one, Level level) {
  return is_uid(level == Level::study    ? one.study_uid
                : level == Level::series ? one.series_uid
                                         : one.sop_uid);
}

void gather(void* data, T_DIMSE_C_FindRQ* request, int, T_DIMSE_C_FindRSP*, DcmDataset* answer) {
  auto& g = *static_cast<Gathering*>(data);
  if (answer == nullptr || g.result.cut_off) return;
  if (g.result.found.size() >= g.query->most) {
    g.result.cut_off = true;
    DIMSE_sendCancelRequest(g.connection->association(), g.context, request->MessageID);
    return;
  }
  bool readable = true;
  const Found one = found_in(*answer, readable);
  if (!readable) ++g.unreadable;
  if (has_uid(one, g.query->level))
    g.result.found.push_back(one);
  else
    ++g.without_uid;
}

}  // namespace

FindResult DimseArchive::find(const Query& query, const core::TaskContext& task) {
  validate(query);
  const char* model = UID_FINDStudyRootQueryRetrieveInformationModel;
  DimseConnection connection(server(), secrets_, {{model, plain_syntaxes()}}, task);
  DcmDataset keys;
  ask(keys, DCM_SpecificCharacterSet, "ISO_IR 192");  // many servers answer in the set that they are asked in
  query.level == Level::study    ? ask_study(keys, query)
  : query.level == Level::series ? ask_series(keys, query)
                                 : ask_image(keys, query);

  Gathering gathering{&connection, connection.context(model, "C-FIND"), &query, {}};
  T_DIMSE_C_FindRQ request{};
  request.MessageID = 1;
  OFStandard::strlcpy(request.AffectedSOPClassUID, model, sizeof request.AffectedSOPClassUID);
  request.Priority = DIMSE_PRIORITY_MEDIUM;
  request.DataSetType = DIMSE_DATASET_PRESENT;
  T_DIMSE_C_FindRSP response{};
  DcmDataset* detail = nullptr;
  int count = 0;
  const OFCondition condition =
      DIMSE_findUser(connection.association(), gathering.context, &request, &keys, count, gather, &gathering,
                     DIMSE_NONBLOCKING, connection.timeout(), &response, &detail);
  delete detail;
  connection.require(condition);
  FindResult result = std::move(gathering.result);
  const bool well =
      response.DimseStatus == STATUS_FIND_Success_MatchingIsComplete ||
      (result.cut_off && response.DimseStatus == STATUS_FIND_Cancel_MatchingTerminatedDueToCancelRequest);
  if ((response.DimseStatus & 0xFF00) == STATUS_FIND_Refused_OutOfResources)
    throw NetworkError("the server '" + server().name + "' has no means left for a search; try again later");
  if (!well)
    throw InvalidInput("the server '" + server().name + "' refuses the search (status " +
                       hexadecimal(response.DimseStatus) + ")");
  connection.release();
  if (gathering.unreadable > 0)
    result.warnings.push_back(
        std::to_string(gathering.unreadable) +
        " entries are in a character set that is not known; what cannot be read is shown as ?");
  if (gathering.without_uid > 0)
    result.warnings.push_back(std::to_string(gathering.without_uid) + " entries without a UID are left out");
  return result;
}

}  // namespace ostia::pacs
