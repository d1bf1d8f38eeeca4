#pragma once
/// \file Passwords in the desktop's keyring.

#include <QObject>
#include <QString>
#include <functional>

namespace ostia::workstation {

/// Where passwords are kept between two starts: nowhere else.
class Keyring {
 public:
  virtual ~Keyring() = default;
  /// `then` is told in the interface's thread: empty where there is none, or no keyring.
  virtual void read(const QString& server, QObject* context, std::function<void(const QString&)> then) = 0;
  virtual void keep(const QString& server, const QString& password) = 0;
  virtual void forget(const QString& server) = 0;
};
/// The desktop's own (Secret Service, KWallet).
Keyring& desktop_keyring();

}  // namespace ostia::workstation
