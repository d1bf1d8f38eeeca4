#pragma once
// One association with a server, by DCMTK.

#include "socket_watch.h"

#include "ostia/pacs/server.h"

#include <string>
#include <vector>

struct T_ASC_Association;
struct T_ASC_Network;
class OFCondition;

namespace ostia::pacs {

/// What is asked for in an association: an abstract syntax with transfer syntaxes.
struct ProposedContext {
  std::string abstract_syntax;
  std::vector<std::string> transfer_syntaxes;
  bool receives = false;  ///< we are the ones that store (C-GET)
};

/// Uncompressed transfer syntaxes, for commands with small data sets.
const std::vector<std::string>& plain_syntaxes();
/// Those in which objects may come: uncompressed ones and each compression that the readers know.
const std::vector<std::string>& received_syntaxes();

/// DCMTK keeps silent: what it logs may name a patient.
void prepare_dcmtk();

/// Gives a network's sockets to the watch, with TLS where the server has it. `role`: as DCMTK's
/// T_ASC_NetworkRole. Throws InvalidInput for files of certificates that cannot be used.
void set_transport(T_ASC_Network* network, int role, const ServerDescription& server, const Secrets& secrets,
                   SocketWatch& watch);

class DimseConnection {
 public:
  /// Throws NetworkError, InvalidInput (rejected, certificates, no DICOM), Cancelled.
  DimseConnection(const ServerDescription& server, const Secrets& secrets,
                  const std::vector<ProposedContext>& contexts, const core::TaskContext& task);
  /// Aborts what was not released.
  ~DimseConnection();
  DimseConnection(const DimseConnection&) = delete;
  DimseConnection& operator=(const DimseConnection&) = delete;

  T_ASC_Association* association() { return association_; }
  /// Of the accepted context. Throws InvalidInput "does not offer `what`".
  unsigned char context(const char* abstract_syntax, const char* what) const;
  /// The accepted one for objects of this kind; 0: none.
  unsigned char context_for(const std::string& sop_class, const std::string& transfer_syntax) const;
  /// Seconds for DCMTK's calls.
  int timeout() const;
  void release();
  /// Nothing where it is good; else Cancelled, NetworkError or InvalidInput.
  void require(const OFCondition& condition);

 private:
  void request(const std::vector<ProposedContext>& contexts, const std::string& address);
  [[noreturn]] void refuse_rejected() const;
  void require_right_host() const;

  const ServerDescription& server_;
  const core::TaskContext task_;
  SocketWatch watch_;
  T_ASC_Network* network_ = nullptr;
  T_ASC_Association* association_ = nullptr;
};

}  // namespace ostia::pacs
