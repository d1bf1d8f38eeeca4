#pragma once
/// \file A keyring that tests look into.

#include "archive/keyring.h"

#include <map>

namespace ostia::workstation::testing {

struct FakeKeyring : Keyring {
  std::map<QString, QString> kept;
  void read(const QString& server, QObject*, std::function<void(const QString&)> then) override {
    const auto found = kept.find(server);
    then(found == kept.end() ? QString() : found->second);
  }
  void keep(const QString& server, const QString& password) override { kept[server] = password; }
  void forget(const QString& server) override { kept.erase(server); }
};

}  // namespace ostia::workstation::testing
