#pragma once
/// \file Files of vessel trees: read in the background, their faults said, repaired where that is wanted.

#include "trees/page.h"

#include "ostia/io/graph_file.h"

#include <QObject>
#include <QPointer>
#include <filesystem>

namespace ostia::workstation {

class TreeOpening final : public QObject {
  Q_OBJECT
 public:
  /// Trees are shown over the views of `window`, with the commands of `commands` beside them.
  TreeOpening(Desk& desk, QMainWindow& window, const CommandTable& commands)
      : desk_(desk), window_(window), commands_(commands) {}
  /// True for a file that io::is_graph_file takes; what cannot be looked into is none.
  static bool takes(const std::filesystem::path& path);
  void open(const std::filesystem::path& path);
  void close();
  TreePage* page() { return page_; }  ///< null: no tree is open
  /// Does it with the page, or says that no tree is open.
  void with_page(const std::function<void(TreePage&)>& act);

 private:
  void ask(const std::shared_ptr<const io::LoadedGraph>& loaded, const std::filesystem::path& path,
           const QString& faults, bool usable);
  void prepare(const std::shared_ptr<const io::LoadedGraph>& loaded, const std::filesystem::path& path,
               const std::string& faults, bool repair);
  Desk& desk_;
  QMainWindow& window_;
  const CommandTable& commands_;
  QPointer<TreePage> page_;
};

}  // namespace ostia::workstation
