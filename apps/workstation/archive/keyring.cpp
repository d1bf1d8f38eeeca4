#include "archive/keyring.h"

#include <qt5keychain/keychain.h>

#include <QPointer>

namespace ostia::workstation {
namespace {

const QString keyring_service = QStringLiteral("ostia-pacs");

class DesktopKeyring final : public Keyring {
 public:
  void read(const QString& server, QObject* context, std::function<void(const QString&)> then) override {
    auto* job = new QKeychain::ReadPasswordJob(keyring_service);  // deletes itself
    job->setKey(server);
    QObject::connect(job, &QKeychain::Job::finished, context, [job, then = std::move(then)] {
      then(job->error() == QKeychain::NoError ? job->textData() : QString());
    });
    job->start();
  }
  void keep(const QString& server, const QString& password) override {
    auto* job = new QKeychain::WritePasswordJob(keyring_service);
    job->setKey(server);
    job->setTextData(password);
    job->start();
  }
  void forget(const QString& server) override {
    auto* job = new QKeychain::DeletePasswordJob(keyring_service);
    job->setKey(server);
    job->start();
  }
};

}  // namespace

Keyring& desktop_keyring() {
  static DesktopKeyring keyring;
  return keyring;
}

}  // namespace ostia::workstation
