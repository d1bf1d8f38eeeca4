#pragma once
/// \file What may stand between us and a server: an end of TLS, a proxy. Both are written in Python.

#include "started_program.h"

#include <filesystem>
#include <string>

namespace ostia::testing {

/// Takes TLS off at a port of its own and passes the rest to another port of this machine.
class TlsFront {
 public:
  /// `folder`: of `key.pem` and `certificate.pem`. `authorities`: who must have signed the peer's
  /// certificate; empty: it is not asked for one.
  TlsFront(int behind, const std::filesystem::path& folder, const std::filesystem::path& authorities = {});
  int port() const { return port_; }

 private:
  int port_;
  StartedProgram program_;
};

/// Answers each begin of TLS with an alert (a fatal one, RFC 8446, 6.2) and hangs up.
class TlsAlarm {
 public:
  explicit TlsAlarm(int alert);
  int port() const { return port_; }

 private:
  int port_;
  StartedProgram program_;
};

/// For programs that know no TLS: puts it on towards a port of this machine.
class TlsBack {
 public:
  /// `authorities`: who must have signed the certificate for "localhost".
  TlsBack(int behind, const std::filesystem::path& authorities);
  int port() const { return port_; }

 private:
  int port_;
  StartedProgram program_;
};

/// A proxy that leads through to wherever it is asked (CONNECT) and writes down where.
class Tunnel {
 public:
  /// `status`: 200, or what it says instead of leading there.
  explicit Tunnel(int status = 200);
  int port() const { return port_; }
  std::string asked_for() const;  ///< the requests' first lines

 private:
  std::filesystem::path log_;
  int port_;
  StartedProgram program_;
};

}  // namespace ostia::testing
