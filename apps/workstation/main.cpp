#include "frame_log.h"
#include "help.h"
#include "language.h"
#include "main_window.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/view/opengl_check.h"

#include <QVTKOpenGLNativeWidget.h>

#include <QApplication>
#include <QCommandLineParser>
#include <QInputEvent>
#include <QStandardPaths>
#include <QSurfaceFormat>
#include <clocale>
#include <csignal>
#include <cstdio>

namespace {

/// What gets past every guard ends as a message, never as a crash.
class Application final : public QApplication {
 public:
  using QApplication::QApplication;
  bool notify(QObject* receiver, QEvent* event) override {
    if (const QInputEvent* input = dynamic_cast<QInputEvent*>(event))
      ostia::workstation::FrameLog::instance().input(static_cast<std::uint32_t>(input->timestamp()));
    try {
      return QApplication::notify(receiver, event);
    } catch (const std::exception& error) {
      for (QWidget* widget : topLevelWidgets())
        if (auto* window = qobject_cast<ostia::workstation::MainWindow*>(widget)) {
          window->complain(QString::fromStdString(error.what()));
          return false;
        }
      std::fprintf(stderr, "%s\n", error.what());
      return false;
    }
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == "--version") {
    std::printf("ostia-workstation %s\n", OSTIA_VERSION);
    return 0;
  }
  if (const std::optional<std::string> trouble = ostia::view::check_opengl()) {
    std::fprintf(stderr, "ostia-workstation: %s\n", trouble->c_str());
    return 5;
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of a file's size is an error that is said, not the program's end
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  QApplication::setAttribute(Qt::AA_DontCreateNativeWidgetSiblings);
  Application application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setApplicationName("ostia");
  QApplication::setApplicationDisplayName("Ostia");
  QApplication::setApplicationVersion(OSTIA_VERSION);

  QCommandLineParser parser;
  parser.setApplicationDescription(QApplication::tr("The coronary modelling workstation."));
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument("what", QApplication::tr("A case, an image, a DICOM folder, or a zip of one."),
                               "[what]");
  const QCommandLineOption state(
      "state-folder", QApplication::tr("Where recent cases and window settings are kept."), "folder",
      QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) + "/ostia");
  const QCommandLineOption frames(
      "frame-log", QApplication::tr("Writes the times of all frames, a JSON line each."), "file");
  const QCommandLineOption sample("sample", QApplication::tr("Opens the sample case."));
  const QCommandLineOption no_tour("no-tour",
                                   QApplication::tr("Starts without the tour, as OSTIA_NO_TOUR does."));
  parser.addOptions({state, frames, sample, no_tour});
  parser.process(application);
  if (parser.positionalArguments().size() > 1) {
    std::fprintf(stderr, "ostia-workstation: one case, image or folder at a time\n");
    return 2;
  }
  if (parser.isSet(frames) && !ostia::workstation::FrameLog::instance().open(parser.value(frames))) {
    std::fprintf(stderr, "ostia-workstation: --frame-log: the file cannot be written\n");
    return 3;
  }
  const std::string state_folder = parser.value(state).toStdString();
  ostia::workstation::use_language(
      ostia::session::MachineState(state_folder).setting(ostia::workstation::language_setting));
  ostia::workstation::MainWindow window(state_folder);
  window.show();
  if (!parser.isSet(no_tour)) window.findChild<ostia::workstation::Help*>()->greet();
  if (!parser.positionalArguments().isEmpty())
    window.open(parser.positionalArguments().front().toStdString());
  else if (parser.isSet(sample))
    window.open_sample();
  return QApplication::exec();
}
