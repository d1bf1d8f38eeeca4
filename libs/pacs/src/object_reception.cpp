#include "object_reception.h"

#include "intake.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/dimse.h>

#include <filesystem>

namespace ostia::pacs {
namespace {

struct Reception {
  Intake* intake;
  std::filesystem::path part;
};

/// Called from DCMTK: throws nothing.
void taken(void* data, T_DIMSE_StoreProgress* progress, T_DIMSE_C_StoreRQ*, char*, DcmDataset**,
           T_DIMSE_C_StoreRSP* response, DcmDataset**) {
  if (progress->state != DIMSE_StoreEnd) return;
  auto& reception = *static_cast<Reception*>(data);
  try {
    response->DimseStatus = reception.intake->take(reception.part) == Intake::Taken::refused
                                ? STATUS_STORE_Error_CannotUnderstand
                                : STATUS_STORE_Success;
  } catch (const std::exception&) {
    reception.intake->note_disk_fault("a received object cannot be kept on the disk");
    response->DimseStatus = STATUS_STORE_Refused_OutOfResources;
  }
}

}  // namespace

OFCondition receive_object(T_ASC_Association* association, unsigned char context, T_DIMSE_C_StoreRQ& request,
                           Intake& intake, int timeout_s) {
  Reception reception{&intake, intake.next_part()};
  const OFCondition condition = DIMSE_storeProvider(association, context, &request, reception.part.c_str(), 1,
                                                    nullptr, taken, &reception, DIMSE_NONBLOCKING, timeout_s);
  if (condition == DIMSE_OUTOFRESOURCES)
    intake.note_disk_fault("a received object cannot be written; is the disk full?");
  if (condition.bad()) {
    std::error_code ignored;
    std::filesystem::remove(reception.part, ignored);
  }
  return condition;
}

}  // namespace ostia::pacs
