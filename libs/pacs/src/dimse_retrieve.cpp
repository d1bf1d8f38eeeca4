// C-GET and C-MOVE, study root (PS3.4 C.4.2, C.4.3).

#include "dimse_archive.h"
#include "intake.h"
#include "object_reception.h"
#include "store_receiver.h"
#include "text.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdatset.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/dimse.h>

#include <algorithm>
#include <chrono>

namespace ostia::pacs {
namespace {

using RetrievalClock = std::chrono::steady_clock;
constexpr std::size_t most_classes = 10;  // with 12 syntaxes each, of 128 contexts
constexpr std::size_t images_a_request = 500;

/// One context for each pair, so that whatever syntax the server has an object in can come as it is.
std::vector<ProposedContext> contexts_for(std::set<std::string> classes) {
  if (classes.empty())  // not known: what fits into none of these is missing, and then listed and asked for
    classes = {UID_CTImageStorage,         UID_EnhancedCTImageStorage,
               UID_MRImageStorage,         UID_SecondaryCaptureImageStorage,
               UID_SegmentationStorage,    UID_EncapsulatedPDFStorage,
               UID_EncapsulatedSTLStorage, UID_Comprehensive3DSRStorage,
               UID_ComprehensiveSRStorage, UID_RTStructureSetStorage};
  std::vector<ProposedContext> contexts{{UID_GETStudyRootQueryRetrieveInformationModel, plain_syntaxes()}};
  std::size_t count = 0;
  for (const std::string& one : classes) {
    if (++count > most_classes) break;
    for (const std::string& syntax : received_syntaxes()) contexts.push_back({one, {syntax}, true});
  }
  return contexts;
}

DcmDataset identifiers_of(const SeriesWanted& wanted, const std::vector<std::string>& images) {
  DcmDataset keys;
  keys.putAndInsertString(DCM_QueryRetrieveLevel, images.empty() ? "SERIES" : "IMAGE");
  keys.putAndInsertString(DCM_StudyInstanceUID, wanted.study_uid.c_str());
  keys.putAndInsertString(DCM_SeriesInstanceUID, wanted.series_uid.c_str());
  std::string list;
  for (const std::string& image : images) list += (list.empty() ? "" : "\\") + image;
  if (!images.empty()) keys.putAndInsertString(DCM_SOPInstanceUID, list.c_str());
  return keys;
}

bool goes_on(unsigned short status) {
  return status == STATUS_MOVE_Pending_SubOperationsAreContinuing;
}

/// Of the last answer of C-GET and C-MOVE, whose statuses are the same. What failed in part is seen by what
/// is missing.
void require_retrieved(const ServerDescription& server, unsigned short status, const char* what) {
  if (status == STATUS_MOVE_Success_SubOperationsCompleteNoFailures ||
      status == STATUS_MOVE_Warning_SubOperationsCompleteOneOrMoreFailures)
    return;
  const std::string name = "the server '" + server.name + "' ";
  if (status == STATUS_MOVE_Refused_MoveDestinationUnknown)
    throw InvalidInput(name + "does not know where '" + server.own_title +
                       "' is; have it registered there with this machine's address and port " +
                       std::to_string(server.receive_port) + ", or use retrieval get");
  if ((status & 0xFF00) == 0xA700)
    throw NetworkError(name + "has no means left for " + what + "; try again later");
  throw InvalidInput(name + "refuses " + what + " (status " + hexadecimal(status) + ")");
}

void send_request(DimseConnection& connection, unsigned char context, T_DIMSE_Message& message,
                  DcmDataset& keys) {
  connection.require(DIMSE_sendMessageUsingMemoryData(connection.association(), context, &message, nullptr,
                                                      &keys, nullptr, nullptr));
}

OFCondition receive_command(DimseConnection& connection, unsigned char& context, T_DIMSE_Message& message) {
  DcmDataset* detail = nullptr;
  const OFCondition condition = DIMSE_receiveCommand(connection.association(), DIMSE_NONBLOCKING,
                                                     connection.timeout(), &context, &message, &detail);
  delete detail;
  return condition;
}

/// Some servers append a data set (the list of failed images) to the last answer.
void drop_data_set(DimseConnection& connection, unsigned short type) {
  if (type == DIMSE_DATASET_NULL) return;
  unsigned char context = 0;
  DcmDataset* dropped = nullptr;
  DIMSE_receiveDataSetInMemory(connection.association(), DIMSE_NONBLOCKING, connection.timeout(), &context,
                               &dropped, nullptr, nullptr);
  delete dropped;
}

[[noreturn]] void refuse_command(const ServerDescription& server) {
  throw InvalidInput("the server '" + server.name + "' answers with a command that was not asked for");
}

}  // namespace

void DimseArchive::retrieve(const SeriesWanted& wanted, const std::vector<std::string>& missing,
                            Intake& intake, const core::TaskContext& task) {
  const auto one_request = [&](const std::vector<std::string>& images) {
    server().retrieval == Retrieval::get ? get(wanted, images, intake, task)
                                         : move(wanted, images, intake, task);
  };
  if (missing.empty()) return one_request({});
  for (std::size_t first = 0; first < missing.size(); first += images_a_request) {
    const std::size_t last = std::min(first + images_a_request, missing.size());
    one_request({missing.begin() + static_cast<std::ptrdiff_t>(first),
                 missing.begin() + static_cast<std::ptrdiff_t>(last)});
  }
}

void DimseArchive::get(const SeriesWanted& wanted, const std::vector<std::string>& images, Intake& intake,
                       const core::TaskContext& task) {
  const char* model = UID_GETStudyRootQueryRetrieveInformationModel;
  DimseConnection connection(server(), secrets_, contexts_for(intake.classes()), task);
  const unsigned char context = connection.context(model, "C-GET; use retrieval move");
  DcmDataset keys = identifiers_of(wanted, images);
  T_DIMSE_Message request{};
  request.CommandField = DIMSE_C_GET_RQ;
  request.msg.CGetRQ.MessageID = 1;
  OFStandard::strlcpy(request.msg.CGetRQ.AffectedSOPClassUID, model,
                      sizeof request.msg.CGetRQ.AffectedSOPClassUID);
  request.msg.CGetRQ.Priority = DIMSE_PRIORITY_MEDIUM;
  request.msg.CGetRQ.DataSetType = DIMSE_DATASET_PRESENT;
  send_request(connection, context, request, keys);
  for (;;) {
    unsigned char of = 0;
    T_DIMSE_Message message{};
    connection.require(receive_command(connection, of, message));
    if (message.CommandField == DIMSE_C_STORE_RQ) {
      const OFCondition condition =
          receive_object(connection.association(), of, message.msg.CStoreRQ, intake, connection.timeout());
      intake.throw_if_faulty();
      connection.require(condition);
    } else if (message.CommandField == DIMSE_C_GET_RSP) {
      const T_DIMSE_C_GetRSP& answer = message.msg.CGetRSP;
      drop_data_set(connection, static_cast<unsigned short>(answer.DataSetType));
      if (goes_on(answer.DimseStatus)) continue;
      require_retrieved(server(), answer.DimseStatus, "C-GET");
      break;
    } else {
      refuse_command(server());
    }
  }
  connection.release();
}

void DimseArchive::move(const SeriesWanted& wanted, const std::vector<std::string>& images, Intake& intake,
                        const core::TaskContext& task) {
  const char* model = UID_MOVEStudyRootQueryRetrieveInformationModel;
  StoreReceiver receiver(server(), secrets_, intake, task);
  DimseConnection connection(server(), secrets_, {{model, plain_syntaxes()}}, task);
  const unsigned char context = connection.context(model, "C-MOVE; use retrieval get");
  DcmDataset keys = identifiers_of(wanted, images);
  T_DIMSE_Message request{};
  request.CommandField = DIMSE_C_MOVE_RQ;
  request.msg.CMoveRQ.MessageID = 1;
  OFStandard::strlcpy(request.msg.CMoveRQ.AffectedSOPClassUID, model,
                      sizeof request.msg.CMoveRQ.AffectedSOPClassUID);
  request.msg.CMoveRQ.Priority = DIMSE_PRIORITY_MEDIUM;
  request.msg.CMoveRQ.DataSetType = DIMSE_DATASET_PRESENT;
  OFStandard::strlcpy(request.msg.CMoveRQ.MoveDestination, server().own_title.c_str(),
                      sizeof request.msg.CMoveRQ.MoveDestination);
  send_request(connection, context, request, keys);
  const auto silence = std::chrono::duration<double>(server().idle_timeout_s);
  auto last_sign = RetrievalClock::now();
  std::size_t seen = receiver.signs();
  for (;;) {
    intake.throw_if_faulty();
    task.throw_if_cancelled();
    // The server may say nothing here as long as objects come on connections of their own.
    if (const std::size_t now = receiver.signs(); now != seen) {
      seen = now;
      last_sign = RetrievalClock::now();
    }
    if (!ASC_dataWaiting(connection.association(), 1)) {
      if (RetrievalClock::now() - last_sign > silence) connection.require(DIMSE_NODATAAVAILABLE);
      continue;
    }
    last_sign = RetrievalClock::now();
    unsigned char of = 0;
    T_DIMSE_Message message{};
    connection.require(receive_command(connection, of, message));
    if (message.CommandField != DIMSE_C_MOVE_RSP) refuse_command(server());
    const T_DIMSE_C_MoveRSP& answer = message.msg.CMoveRSP;
    drop_data_set(connection, static_cast<unsigned short>(answer.DataSetType));
    if (goes_on(answer.DimseStatus)) continue;
    require_retrieved(server(), answer.DimseStatus, "C-MOVE");
    break;
  }
  connection.release();
}

}  // namespace ostia::pacs
