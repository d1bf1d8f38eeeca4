#include "store_receiver.h"

#include "dimse_connection.h"
#include "intake.h"
#include "object_reception.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmnet/dimse.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

namespace ostia::pacs {
namespace {

constexpr long most_received_pdu = 131072;

void reject(T_ASC_Association* association, bool for_now) {
  T_ASC_RejectParameters why{};
  why.result = for_now ? ASC_RESULT_REJECTEDTRANSIENT : ASC_RESULT_REJECTEDPERMANENT;
  why.source = for_now ? ASC_SOURCE_SERVICEPROVIDER_PRESENTATION_RELATED : ASC_SOURCE_SERVICEUSER;
  why.reason = for_now ? ASC_REASON_SP_PRES_LOCALLIMITEXCEEDED : ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED;
  ASC_rejectAssociation(association, &why);
}

void drop(T_ASC_Association* association) {
  ASC_dropSCPAssociation(association, 1);
  ASC_destroyAssociation(&association);
}

bool is_called(T_ASC_Association* association, const std::string& title) {
  return association->params->DULparams.calledAPTitle == title;
}

void accept_contexts(T_ASC_Association* association) {
  std::vector<const char*> syntaxes;
  for (const std::string& syntax : received_syntaxes()) syntaxes.push_back(syntax.c_str());
  const char* echo[] = {UID_VerificationSOPClass};
  ASC_acceptContextsWithPreferredTransferSyntaxes(association->params, echo, 1, syntaxes.data(),
                                                  static_cast<int>(syntaxes.size()));
  ASC_acceptContextsWithPreferredTransferSyntaxes(association->params, dcmAllStorageSOPClassUIDs,
                                                  numberOfDcmAllStorageSOPClassUIDs, syntaxes.data(),
                                                  static_cast<int>(syntaxes.size()));
}

}  // namespace

StoreReceiver::StoreReceiver(const ServerDescription& server, const Secrets& secrets, Intake& intake,
                             const core::TaskContext& task)
    : server_(server), intake_(intake), watch_(task) {
  prepare_dcmtk();
  if (ASC_initializeNetwork(NET_ACCEPTOR, server.receive_port, timeout(), &network_).bad())
    throw IoError("cannot listen at port " + std::to_string(server.receive_port) +
                  ", which receive_port names: another program has it, or it is below 1024");
  try {
    set_transport(network_, NET_ACCEPTOR, server, secrets, watch_);
    listener_ = std::thread([this] { run(); });
  } catch (...) {
    ASC_dropNetwork(&network_);
    throw;
  }
}

StoreReceiver::~StoreReceiver() {
  stop_ = true;
  listener_.join();
  watch_.shut_down();
  join_done(true);
  ASC_dropNetwork(&network_);
}

int StoreReceiver::timeout() const {
  return std::max(1, static_cast<int>(std::ceil(server_.idle_timeout_s)));
}

void StoreReceiver::run() {
  while (!stop_) {
    join_done(false);
    if (!ASC_associationWaiting(network_, 0)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      continue;
    }
    T_ASC_Association* association = nullptr;
    const int before = watch_.last();
    // A peer that connects and says nothing keeps others waiting for a few seconds.
    const OFCondition condition =
        ASC_receiveAssociation(network_, &association, most_received_pdu, nullptr, nullptr, server_.tls,
                               DUL_NOBLOCK, std::min(timeout(), 5));
    ++signs_;
    // No other thread adds one; a connection that did not come about has none.
    const int last = watch_.last(), socket = last == before ? -1 : last;
    if (condition.good()) {
      welcome(association, socket);
    } else {
      if (association != nullptr) drop(association);
      watch_.release(socket);
    }
  }
}

void StoreReceiver::welcome(T_ASC_Association* association, int socket) {
  const bool busy = static_cast<int>(peers_.size()) >= server_.receive_associations;
  if (busy || !is_called(association, server_.own_title)) {
    reject(association, busy);
    drop(association);
    return watch_.release(socket);
  }
  Peer& peer = peers_.emplace_back();
  peer.thread = std::thread([this, association, socket, &peer] {
    serve(association);
    watch_.release(socket);
    peer.done = true;
  });
}

void StoreReceiver::serve(T_ASC_Association* association) {
  accept_contexts(association);
  if (ASC_acknowledgeAssociation(association).good() && !answer_commands(association))
    ASC_abortAssociation(association);
  drop(association);
}

bool StoreReceiver::answer_commands(T_ASC_Association* association) {
  for (;;) {
    unsigned char context = 0;
    T_DIMSE_Message message{};
    DcmDataset* detail = nullptr;
    OFCondition condition =
        DIMSE_receiveCommand(association, DIMSE_NONBLOCKING, timeout(), &context, &message, &detail);
    delete detail;
    if (condition == DUL_PEERREQUESTEDRELEASE) return ASC_acknowledgeRelease(association).good();
    if (condition.bad()) return false;
    ++signs_;
    if (message.CommandField == DIMSE_C_ECHO_RQ)
      condition =
          DIMSE_sendEchoResponse(association, context, &message.msg.CEchoRQ, STATUS_ECHO_Success, nullptr);
    else if (message.CommandField == DIMSE_C_STORE_RQ)
      condition = receive_object(association, context, message.msg.CStoreRQ, intake_, timeout());
    else
      return false;
    ++signs_;
    if (condition.bad() || !intake_.fault().empty() || !intake_.disk_fault().empty()) return false;
  }
}

void StoreReceiver::join_done(bool all) {
  for (auto peer = peers_.begin(); peer != peers_.end();) {
    if (!all && !peer->done) {
      ++peer;
      continue;
    }
    peer->thread.join();
    peer = peers_.erase(peer);
  }
}

}  // namespace ostia::pacs
