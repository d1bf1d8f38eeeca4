#include "plugins/plugins.h"

#include "flow/arrays.h"
#include "flow/results.h"
#include "opening/opening.h"
#include "plugins/dialog.h"
#include "shell/desk.h"
#include "shell/library_texts.h"

#include "ostia/core/log.h"
#include "ostia/session/found_model.h"

#include <QDateTime>
#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QUrl>

namespace ostia::workstation {
namespace fs = std::filesystem;
namespace {

constexpr const char* listing_job = "plugins";
constexpr const char* trusted_setting = "plugins.trusted";
constexpr int most_trusted = 200;

QString job_kind(const session::Plugin& plugin) {
  return QStringLiteral("plugin.") + QString::fromStdString(plugin.name);
}

/// The scripts with size and time: another text where one came, went or was written.
std::string sight_of(const std::vector<fs::path>& folders) {
  QStringList seen;
  for (const fs::path& folder : folders)
    for (const QFileInfo& file :
         QDir(QString::fromStdString(folder.string())).entryInfoList({"*.py"}, QDir::Files, QDir::Name))
      seen << QStringLiteral("%1 %2 %3")
                  .arg(file.absoluteFilePath())
                  .arg(file.size())
                  .arg(file.lastModified().toMSecsSinceEpoch());
  return seen.join('\n').toStdString();
}

}  // namespace

/// What a run has made, and what it was made of.
struct Plugins::Made {
  session::PluginAnswer answer;
  std::optional<FlowSurface> surface;
  std::optional<session::FoundModel> found;
  std::shared_ptr<const lumen::LumenModel> of;
  session::ImageReference image;
};

Plugins::Plugins(Desk& desk, Opening& opening, FlowResults& results)
    : QObject(&desk.window), desk_(desk), opening_(opening), results_(results) {
  own_.push_back(desk.bench.case_changed.observe([this] { cancel_all(); }));
  own_.push_back(desk.bench.image_changed.observe([this] { cancel_all(); }));
}

void Plugins::cancel_all() {
  for (const session::Plugin& one : list_.plugins) desk_.jobs.cancel(job_kind(one));
}

void Plugins::look(bool told) {
  const std::vector<fs::path> folders = session::plugin_folders();
  std::string seen = sight_of(folders);
  if (seen == seen_ && !told) return;
  seen_ = std::move(seen);
  if (seen_.empty()) {
    take({}, told);
    return;
  }
  desk_.jobs.run(
      listing_job, tr("Looking for plug-ins"),
      [folders](const core::TaskContext& task) {
        return std::any(std::make_shared<const session::PluginList>(session::list_plugins(folders, task)));
      },
      [this, told](const std::any& list) {
        take(*std::any_cast<const std::shared_ptr<const session::PluginList>&>(list), told);
      },
      [this, told](const QString& message) {
        if (told)
          desk_.messages.complain(message, tr("The plug-ins cannot be listed"));
        else
          desk_.messages.say(message);
      });
}

void Plugins::take(const session::PluginList& list, bool told) {
  list_ = list;
  emit changed();
  QStringList refused;
  for (const std::string& one : list_.refused) refused << QString::fromStdString(one);
  if (!refused.isEmpty() && told)
    desk_.messages.complain(refused.join('\n'), tr("Some scripts are no plug-ins"));
  else if (!refused.isEmpty())
    desk_.messages.say(tr("Some scripts are no plug-ins: %1").arg(refused.join("; ")));
  else if (told)
    desk_.messages.say(tr("%n plug-in(s).", nullptr, static_cast<int>(list_.plugins.size())));
}

void Plugins::open_folder() {
  const auto folders = session::plugin_folders();
  const QString folder = QString::fromStdString(folders.size() > 1 ? folders[folders.size() - 2].string()
                                                                   : folders.front().string());
  if (!QDir().mkpath(folder) || !QDesktopServices::openUrl(QUrl::fromLocalFile(folder)))
    desk_.messages.complain(tr("The folder of plug-ins is %1").arg(folder));
}

QString Plugins::why_not(const session::Plugin& plugin) const {
  if (plugin.needs_case && !desk_.bench.has_case()) return tr("No case is open.");
  if (plugin.needs_image && !desk_.bench.image().volume) return tr("No image is open.");
  if (plugin.needs_image && opening_.reading()) return tr("The image is still being read.");
  return {};
}

bool Plugins::trusts(const std::string& digest) const {
  const auto known = desk_.machine.setting(trusted_setting);
  return known && QString::fromStdString(*known).split(' ').contains(QString::fromStdString(digest));
}

/// The newest first.
void Plugins::trust(const std::string& digest) {
  QStringList known = QString::fromStdString(desk_.machine.setting(trusted_setting).value_or(""))
                          .split(' ', Qt::SkipEmptyParts);
  known.prepend(QString::fromStdString(digest));
  known.removeDuplicates();
  desk_.machine.set_setting(trusted_setting, known.mid(0, most_trusted).join(' ').toStdString());
}

void Plugins::start(const std::string& name) {
  const session::Plugin plugin = session::plugin_named(list_, name);
  if (const QString why = why_not(plugin); !why.isEmpty()) return desk_.messages.say(why);
  if (plugin.gives == session::PluginGives::edits) {
    desk_.bench.require_own_phase();
    if (!desk_.bench.session().file().editable())
      return desk_.messages.complain(
          tr("The case is open for reading only; save it as another one, which can be edited."));
  }
  const bool is_new = !trusts(plugin.digest);
  if (!is_new && plugin.parameters.empty()) return run(plugin, {});
  std::vector<NamedVessel> vessels;
  if (desk_.bench.has_case())
    for (const geometry::Vessel& one : desk_.bench.model()->tree.vessels)
      vessels.push_back({QString::fromStdString(one.name), one.id, one.id == desk_.bench.vessel.get()});
  auto* dialog = new PluginDialog(plugin, is_new, vessels, &desk_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, [this, dialog, plugin, is_new] {
    desk_.messages.guarded(
        [&] {
          if (is_new) trust(plugin.digest);
          run(plugin, dialog->values());
        },
        true);
  });
  dialog->open();
}

void Plugins::run(const session::Plugin& plugin, session::PluginValues values) {
  auto job = std::make_shared<session::PluginJob>(plugin, std::move(values));
  Made begun;
  if (desk_.bench.has_case()) {
    job->take_case(desk_.bench.session().file());
    begun.of = desk_.bench.session().file().model();
  }
  const session::OpenImage image = desk_.bench.image();
  begun.image = image.reference;
  if (plugin.needs_image) job->take_image(image.volume);
  const QString title = QString::fromStdString(plugin.title);
  desk_.jobs.run(
      job_kind(plugin), title,
      [job, begun, volume = image.volume](const core::TaskContext& task) {
        auto made = std::make_shared<Made>(begun);
        made->answer = job->run(std::chrono::hours(1), task.sub(0.0, 0.7));
        task.set_stage({});
        if (!made->answer.surface.mesh.triangles.empty())
          made->surface = flow_surface_of(std::move(made->answer.surface));
        if (made->answer.mask)
          made->found =
              session::model_of_mask(*made->answer.mask, volume.get(), {}, task.sub(0.7, 1.0)).found;
        return std::any(std::shared_ptr<const Made>(made));
      },
      [this, plugin](const std::any& made) {
        show(plugin, *std::any_cast<const std::shared_ptr<const Made>&>(made));
      },
      [this, title](const QString& message) {
        desk_.messages.complain(message, tr("%1 has failed").arg(title));
      });
}

void Plugins::show(const session::Plugin& plugin, const Made& made) {
  const QString title = QString::fromStdString(plugin.title);
  const bool same = !made.of || (desk_.bench.has_case() && desk_.bench.session().file().model() == made.of);
  if (plugin.gives == session::PluginGives::edits) {
    if (!same)
      return desk_.messages.complain(
          tr("The case was edited while %1 was at work, and its edits are of the case before. Run it again.")
              .arg(title));
    desk_.messages.guarded([&] { apply(made.answer.edits); }, true);
    return;
  }
  if (made.surface) {
    results_.show(*made.surface);
    desk_.messages.say(
        same ? tr("%1: shown in the wall's place.").arg(title)
             : tr("%1: shown in the wall's place, of the case before the last edit.").arg(title));
    return;
  }
  if (!made.found) return;
  for (const std::string& warning : made.found->found.warnings) core::log_warning(warning);
  const session::ImageReference reference = made.image;
  opening_.start_case(
      reference, [&](const fs::path& path) { return session::create_case(path, *made.found, reference); });
  desk_.messages.say(tr("%n vessel(s) of the mask; a question mark says where to look first.", nullptr,
                        static_cast<int>(made.found->model.tree.vessels.size())));
}

void Plugins::apply(const session::PluginEdits& edits) {
  if (edits.edits.empty()) return desk_.messages.say(tr("The plug-in has changed nothing."));
  desk_.bench.edit_by_plugin(edits);
  desk_.messages.say(
      tr("%n edit(s) as one step; Undo takes it back.", nullptr, static_cast<int>(edits.edits.size())));
}

}  // namespace ostia::workstation
