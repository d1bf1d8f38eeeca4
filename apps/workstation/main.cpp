#include "description_files.h"
#include "help/help.h"
#include "shell/crash_watch.h"
#include "shell/ending_signals.h"
#include "shell/language.h"
#include "shell/main_window.h"
#include "shell/main_window_walks.h"
#include "views/frame_log.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/core/version.h"
#include "ostia/view/opengl_check.h"

#include <QVTKOpenGLNativeWidget.h>

#include <QApplication>
#include <QCommandLineParser>
#include <QInputEvent>
#include <QMessageBox>
#include <QStandardPaths>
#include <QSurfaceFormat>
#include <QTimer>
#include <algorithm>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <initializer_list>
#include <string_view>

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

struct CommandLine {
  QCommandLineParser parser;
  const QCommandLineOption state{
      "state-folder", QApplication::tr("Where recent cases and window settings are kept."), "folder",
      QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) + "/ostia"};
  const QCommandLineOption frames{
      "frame-log", QApplication::tr("Writes the times of all frames, a JSON line each."), "file"};
  const QCommandLineOption sample{"sample", QApplication::tr("Opens the sample case.")};
  const QCommandLineOption no_tour{"no-tour",
                                   QApplication::tr("Starts without the tour, as OSTIA_NO_TOUR does.")};
  const QCommandLineOption record{
      "record-walk", QApplication::tr("Writes down each step of hand and keys, for --walk."), "file"};
  const QCommandLineOption walk{
      "walk", QApplication::tr("Walks through the window as the file says, and ends."), "file"};
  const QCommandLineOption walk_folder{
      "walk-folder", QApplication::tr("Where the pictures and times of --walk go."), "folder", "walk"};
  CommandLine() {
    parser.setApplicationDescription(QApplication::tr("The coronary modelling workstation."));
    parser.addHelpOption();
    parser.addVersionOption();
    parser.addPositionalArgument(
        "what", QApplication::tr("A case, an image, a DICOM folder, or a zip of one."), "[what]");
    for (const QCommandLineOption& option : options()) parser.addOption(option);
  }
  /// As QCommandLineParser has no list of them.
  std::vector<QCommandLineOption> options() const {
    return {state, frames, sample, no_tour, record, walk, walk_folder};
  }
  std::string state_folder() const { return parser.value(state).toStdString(); }
  /// Before any window is made.
  void use_language() const {
    ostia::workstation::use_language(
        ostia::session::MachineState(state_folder()).setting(ostia::workstation::language_setting));
  }
};

/// For the manual page and the completions.
ostia::command_line::CommandDescription description_of(const CommandLine& said) {
  ostia::command_line::CommandDescription program;
  program.words = {"ostia-workstation"};
  program.text = "The window in which coronary trees are looked at, corrected and measured";
  program.options.push_back(
      {{"WHAT"}, "FILE", {}, {}, "A case, an image, a DICOM folder, or a zip of one", false, false});
  program.options.push_back({{"-h", "--help"}, {}, {}, {}, "Prints the options and ends", false, false});
  program.options.push_back({{"-v", "--version"}, {}, {}, {}, "Prints the version and ends", false, false});
  for (const QCommandLineOption& option : said.options()) {
    ostia::command_line::OptionDescription described;
    for (const QString& name : option.names()) described.names.push_back("--" + name.toStdString());
    described.value = option.valueName().toUpper().toStdString();
    described.text = option.description().toStdString();
    if (!described.text.empty() && described.text.back() == '.') described.text.pop_back();
    program.options.push_back(described);
  }
  return program;
}

/// What needs no display, so that a script can ask for it anywhere; true where it was all that was wanted.
bool answered(int argc, char** argv) {
  const auto asked = [&](std::initializer_list<std::string_view> words) {
    for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i)
      if (std::find(words.begin(), words.end(), argv[i]) != words.end()) return true;
    return false;
  };
  if (asked({"--version", "-v"})) {
    std::printf("ostia-workstation %s\n", ostia::core::version().c_str());
    return true;
  }
  if (const auto folder =
          ostia::command_line::described_into(std::vector<std::string>(argv + 1, argv + argc))) {
    ostia::command_line::write_description_files(description_of(CommandLine()), *folder);
    return true;
  }
  if (!asked({"--help", "-h", "--help-all"})) return false;
  const QCoreApplication application(argc, argv);  // the help names the program
  std::fputs(qPrintable(CommandLine().parser.helpText()), stdout);
  return true;
}

/// What check_opengl can say.
[[maybe_unused]] const char* const texts_of_opengl[] = {
    QT_TRANSLATE_NOOP("opengl", "The library libX11.so.6 is not installed."),
    QT_TRANSLATE_NOOP("opengl", "The library libGL.so.1 is not installed."),
    QT_TRANSLATE_NOOP("opengl", "The installed OpenGL library has no GLX."),
    QT_TRANSLATE_NOOP("opengl", "The display offers no OpenGL."),
    QT_TRANSLATE_NOOP("opengl", "The display's OpenGL is older than 3.0."),
    QT_TRANSLATE_NOOP("opengl", "The display's OpenGL is older than 3.2."),
    QT_TRANSLATE_NOOP("opengl", "The graphics driver does not answer."),
    QT_TRANSLATE_NOOP("opengl", "The graphics driver failed when it was asked for a window."),
    QT_TRANSLATE_NOOP("opengl",
                      "Ostia's window needs OpenGL 3.2: update the graphics driver, or draw without the "
                      "graphics card (install "
                      "Mesa's software renderer, package libgl1-mesa-dri, and start with "
                      "LIBGL_ALWAYS_SOFTWARE=1). The command "
                      "line program ostia needs no display."),
};

/// Says it on stderr and, for who has started the program by a click, in a box where a display shows one.
/// Returns the exit code.
int refuse(const ostia::view::OpenGlTrouble& trouble, int argc, char** argv) {
  std::fprintf(stderr, "ostia-workstation: %s\n", trouble.text().c_str());
  constexpr int exit_code = 5;
  if (!trouble.has_display) return exit_code;
  QApplication application(argc, argv);
  // On a platform without a screen (offscreen, minimal, vnc) nobody could close the box.
  const QString platform = QGuiApplication::platformName();
  if (platform != "xcb" && !platform.startsWith("wayland")) return exit_code;
  CommandLine said;
  if (said.parser.parse(QApplication::arguments())) said.use_language();
  const auto translated = [](const std::string& text) {
    return QCoreApplication::translate("opengl", text.c_str());
  };
  QMessageBox box(QMessageBox::Critical,
                  QCoreApplication::translate("opengl", "The workstation cannot start"),
                  translated(trouble.reason), QMessageBox::Close);
  box.setInformativeText(translated(trouble.way_out));
  box.setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  box.exec();
  return exit_code;
}

/// Throws Error where a file cannot be read or written. At the walk's end the program ends: 4 where it did
/// not get through.
void take_walks(const CommandLine& said, ostia::workstation::MainWindow& window) {
  if (said.parser.isSet(said.record))
    ostia::workstation::record_walk(window, said.parser.value(said.record).toStdString());
  if (!said.parser.isSet(said.walk)) return;
  const auto ended = [&window](const QString& failure) {
    if (!failure.isEmpty())
      std::fprintf(stderr, "ostia-workstation: the walk ended at %s\n", qPrintable(failure));
    window.end();
    QCoreApplication::exit(
        static_cast<int>(failure.isEmpty() ? ostia::ExitCode::ok : ostia::ExitCode::quality_failed));
  };
  ostia::workstation::begin_walk(window, said.parser.value(said.walk).toStdString(),
                                 said.parser.value(said.walk_folder).toStdString(), ended);
}

constexpr int drivers_are_there_ms = 3000;  // those of the first pictures

int run(const CommandLine& said) {
  using ostia::workstation::FrameLog;
  if (said.parser.positionalArguments().size() > 1) {
    std::fprintf(stderr, "ostia-workstation: one case, image or folder at a time\n");
    return 2;
  }
  if (said.parser.isSet(said.frames) && !FrameLog::instance().open(said.parser.value(said.frames))) {
    std::fprintf(stderr, "ostia-workstation: --frame-log: the file cannot be written\n");
    return 3;
  }
  said.use_language();
  const ostia::workstation::CrashWatch watch(ostia::workstation::crash_folder(said.state_folder()));
  ostia::workstation::MainWindow window(said.state_folder());
  const ostia::workstation::EndingSignals ending;
  QObject::connect(&ending, &ostia::workstation::EndingSignals::asked, &window,
                   &ostia::workstation::MainWindow::end);
  window.show();
  QTimer::singleShot(drivers_are_there_ms, [] { ostia::workstation::know_modules(); });
  if (!said.parser.isSet(said.no_tour)) window.findChild<ostia::workstation::Help*>()->greet();
  if (!said.parser.positionalArguments().isEmpty())
    window.open(said.parser.positionalArguments().front().toStdString());
  else if (said.parser.isSet(said.sample))
    window.open_sample();
  try {
    take_walks(said, window);
  } catch (const ostia::Error& error) {
    std::fprintf(stderr, "ostia-workstation: %s\n", error.what());
    return static_cast<int>(error.exit_code());
  }
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  QCoreApplication::setApplicationName("ostia");
  QCoreApplication::setApplicationVersion(QString::fromStdString(ostia::core::version()));
  if (answered(argc, argv)) return 0;
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  QApplication::setAttribute(Qt::AA_DontCreateNativeWidgetSiblings);
  QGuiApplication::setApplicationDisplayName("Ostia");
  QGuiApplication::setDesktopFileName("io.github.ostia.Workstation");
  if (const auto trouble = ostia::view::check_opengl()) return refuse(*trouble, argc, argv);
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of a file's size is an error that is said, not the program's end
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  Application application(argc, argv);
  QApplication::setWindowIcon(QIcon::fromTheme("io.github.ostia.Workstation"));
  std::setlocale(LC_NUMERIC, "C");
  CommandLine said;
  said.parser.process(application);
  return run(said);
}
