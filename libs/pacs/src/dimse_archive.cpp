#include "dimse_archive.h"

#include "transports.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/dimse.h>

namespace ostia::pacs {

void DimseArchive::echo(const core::TaskContext& task) {
  task.set_stage("asking");
  DimseConnection connection(server(), secrets_, {{UID_VerificationSOPClass, plain_syntaxes()}}, task);
  connection.context(UID_VerificationSOPClass, "C-ECHO");
  DIC_US status = 0;
  DcmDataset* detail = nullptr;
  const OFCondition condition =
      DIMSE_echoUser(connection.association(), 1, DIMSE_NONBLOCKING, connection.timeout(), &status, &detail);
  delete detail;
  connection.require(condition);
  if (status != STATUS_ECHO_Success)
    throw InvalidInput("the server '" + server().name + "' refuses to answer an echo");
  connection.release();
}

std::unique_ptr<Archive> dimse_archive(const ServerDescription& server, const Secrets& secrets) {
  return std::make_unique<DimseArchive>(server, secrets);
}

}  // namespace ostia::pacs
