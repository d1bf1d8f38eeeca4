#pragma once
/// \file The plug-ins of this machine: which there are, and one at work.

#include "ostia/session/plugin_job.h"
#include "ostia/session/signal.h"
#include "ostia/session/workbench.h"

#include <QObject>
#include <QString>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace ostia::workstation {

struct Desk;
class FlowResults;
class Opening;

/// Reads the folders in the background and runs plug-ins as jobs, on copies. Edits are one step of the case,
/// surfaces stand in the wall's place, of a mask a new case is made. Who edits meanwhile, or opens another
/// case, does not get the result.
class Plugins final : public QObject {
  Q_OBJECT
 public:
  Plugins(Desk& desk, Opening& opening, FlowResults& results);
  const session::PluginList& list() const { return list_; }
  /// Where something in the folders is new. `told`: what is no plug-in is said in a dialog.
  void look(bool told = false);
  void open_folder();
  /// Asks for its parameters, and whether a script that is new may run.
  void start(const std::string& name);
  /// Why it cannot be used now; empty where it can.
  QString why_not(const session::Plugin& plugin) const;

 signals:
  void changed();

 private:
  struct Made;
  void take(const session::PluginList& list, bool told);
  void run(const session::Plugin& plugin, session::PluginValues values);
  void show(const session::Plugin& plugin, const Made& made);
  void apply(const session::PluginEdits& edits);
  bool trusts(const std::string& digest) const;
  void trust(const std::string& digest);
  void cancel_all();
  Desk& desk_;
  Opening& opening_;
  FlowResults& results_;
  session::PluginList list_;
  std::string seen_;  ///< of the folders, to know when to look again
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
