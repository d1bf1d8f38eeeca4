// C-STORE (PS3.4 B).

#include "dimse_archive.h"
#include "text.h"
#include "uid.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcfilefo.h>
#include <dcmtk/dcmdata/dcmetinf.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmdata/dcxfer.h>
#include <dcmtk/dcmnet/dimse.h>

#include <algorithm>
#include <set>
#include <utility>

namespace ostia::pacs {
namespace {

constexpr std::size_t most_kinds = 60;  // of objects over one association, with two contexts each

/// What an association must know of a file.
struct Outgoing {
  std::string sop_class, sop_uid, syntax, fault;
};

Outgoing outgoing(const std::filesystem::path& file) {
  Outgoing object;
  DcmFileFormat format;
  if (format.loadFile(file.c_str(), EXS_Unknown, EGL_noChange, DCM_MaxReadLength, ERM_metaOnly).bad()) {
    object.fault = "the file cannot be read as a DICOM object";
    return object;
  }
  const auto text = [&](const DcmTagKey& tag) {
    OFString value;
    format.getMetaInfo()->findAndGetOFString(tag, value);
    return clean_text({value.c_str(), value.size()});
  };
  object.sop_class = text(DCM_MediaStorageSOPClassUID);
  object.sop_uid = text(DCM_MediaStorageSOPInstanceUID);
  object.syntax = text(DCM_TransferSyntaxUID);
  if (!is_uid(object.sop_class) || !is_uid(object.sop_uid) || !is_uid(object.syntax))
    object.fault = "the file's header does not say what object it is (0002,0002), (0002,0003), (0002,0010)";
  return object;
}

/// What DCMTK writes in any of the uncompressed syntaxes without loss.
bool is_uncompressed(const std::string& syntax) {
  const DcmXfer known(syntax.c_str());
  return known.getXfer() != EXS_Unknown && !known.isEncapsulated();
}

std::vector<ProposedContext> contexts_of(const std::vector<Outgoing>& objects) {
  std::set<std::pair<std::string, std::string>> pairs;
  std::set<std::string> plain_classes;
  for (const Outgoing& object : objects) {
    if (!object.fault.empty()) continue;
    pairs.emplace(object.sop_class, object.syntax);
    if (is_uncompressed(object.syntax)) plain_classes.insert(object.sop_class);
  }
  std::vector<ProposedContext> contexts;
  for (const auto& [sop_class, syntax] : pairs) contexts.push_back({sop_class, {syntax}});
  for (const std::string& sop_class : plain_classes) contexts.push_back({sop_class, plain_syntaxes()});
  return contexts;
}

/// How many of the objects fit into one association.
std::size_t fitting(const std::vector<Outgoing>& objects, std::size_t first) {
  std::set<std::pair<std::string, std::string>> kinds;
  std::size_t end = first;
  while (end < objects.size()) {
    kinds.emplace(objects[end].sop_class, objects[end].syntax);
    if (kinds.size() > most_kinds) break;
    ++end;
  }
  return end;
}

SendResult judged(unsigned short status) {
  constexpr unsigned short duplicate_instance = 0x0111;
  if (status == STATUS_STORE_Success || status == duplicate_instance) return {};
  if ((status & 0xF000) == 0xB000)
    return {SendState::sent, "stored with a remark of the server (status " + hexadecimal(status) + ")"};
  if ((status & 0xFF00) == STATUS_STORE_Refused_OutOfResources)
    return {SendState::unreachable, "the server has no room for it now (status " + hexadecimal(status) + ")"};
  if (status == STATUS_STORE_Refused_SOPClassNotSupported)
    return {SendState::refused, "the server does not take objects of this kind"};
  if (status == STATUS_STORE_Refused_NotAuthorized)
    return {SendState::refused, "the server does not let us store"};
  return {SendState::refused, "the server refuses it (status " + hexadecimal(status) + ")"};
}

/// DCMTK reads a file before it sends anything, and says of one that it cannot read that it was not sent.
bool is_damaged(const std::filesystem::path& file) {
  DcmFileFormat format;
  return format.loadFile(file.c_str()).bad() || format.getDataset()->isEmpty();
}

SendResult sent(DimseConnection& connection, const std::filesystem::path& file, const Outgoing& object) {
  if (!object.fault.empty()) return {SendState::refused, object.fault};
  unsigned char context = connection.context_for(object.sop_class, object.syntax);
  if (context == 0 && is_uncompressed(object.syntax))
    for (const std::string& syntax : plain_syntaxes())
      if (context == 0) context = connection.context_for(object.sop_class, syntax);
  if (context == 0)
    return {SendState::refused, "the server does not take objects of this kind (SOP class " +
                                    object.sop_class + ") in this transfer syntax"};
  T_DIMSE_C_StoreRQ request{};
  request.MessageID = connection.association()->nextMsgID++;
  OFStandard::strlcpy(request.AffectedSOPClassUID, object.sop_class.c_str(),
                      sizeof request.AffectedSOPClassUID);
  OFStandard::strlcpy(request.AffectedSOPInstanceUID, object.sop_uid.c_str(),
                      sizeof request.AffectedSOPInstanceUID);
  request.DataSetType = DIMSE_DATASET_PRESENT;
  request.Priority = DIMSE_PRIORITY_MEDIUM;
  T_DIMSE_C_StoreRSP response{};
  DcmDataset* detail = nullptr;
  const OFCondition condition =
      DIMSE_storeUser(connection.association(), context, &request, file.c_str(), nullptr, nullptr, nullptr,
                      DIMSE_NONBLOCKING, connection.timeout(), &response, &detail);
  delete detail;
  if (condition == DIMSE_BADDATA || condition == DIMSE_BADMESSAGE || condition.module() == OFM_dcmdata ||
      (condition == DIMSE_SENDFAILED && is_damaged(file)))
    return {SendState::refused, "the file is damaged"};
  connection.require(condition);
  return judged(response.DimseStatus);
}

}  // namespace

void DimseArchive::store(const std::vector<std::filesystem::path>& files, std::vector<SendResult>& results,
                         const core::TaskContext& task) {
  prepare_dcmtk();
  std::vector<Outgoing> objects;
  for (const std::filesystem::path& file : files) objects.push_back(outgoing(file));
  for (std::size_t first = 0; first < files.size();) {
    const std::size_t end = fitting(objects, first);
    const std::vector<Outgoing> these(objects.begin() + static_cast<std::ptrdiff_t>(first),
                                      objects.begin() + static_cast<std::ptrdiff_t>(end));
    const std::vector<ProposedContext> contexts = contexts_of(these);
    if (contexts.empty()) {
      for (const Outgoing& object : these) results.push_back({SendState::refused, object.fault});
      first = end;
      continue;
    }
    DimseConnection connection(server(), secrets_, contexts, task);
    for (; first < end; ++first) {
      task.throw_if_cancelled();
      results.push_back(sent(connection, files[first], objects[first]));
      task.set_stage("sending " + std::to_string(first + 1) + " of " + std::to_string(files.size()));
      task.set_progress(static_cast<double>(first + 1) / static_cast<double>(files.size()));
    }
    connection.release();
  }
}

}  // namespace ostia::pacs
