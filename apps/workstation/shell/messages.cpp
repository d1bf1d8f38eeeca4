#include "shell/messages.h"

#include "shell/library_texts.h"

#include "ostia/core/error.h"
#include "ostia/session/case_file.h"

#include <QMessageBox>
#include <QWidget>
#include <new>
#include <utility>

namespace ostia::workstation {

Messages::Messages(QWidget& over, Line status, Line shown_name)
    : over_(over), status_(std::move(status)), shown_name_(std::move(shown_name)) {}

void Messages::keep(const QString& text) const {
  if (text.isEmpty()) return;
  log_.push_back({QTime::currentTime(), text});
  if (log_.size() > most_kept) log_.pop_front();
  logged.tell();
}

void Messages::say(const QString& text) const {
  keep(text);
  if (status_) status_(text);
}

void Messages::complain(const QString& text, const QString& title) const {
  // While the mouse goes on with what is refused, one message says so, not one for every move.
  for (const auto* open : over_.findChildren<QMessageBox*>())
    if (open->isVisible() && open->text() == text) return;
  keep(title.isEmpty() ? text : title + ": " + text);
  auto* box = new QMessageBox(QMessageBox::Warning, title.isEmpty() ? QStringLiteral("Ostia") : title, text,
                              QMessageBox::Ok, &over_);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  box->open();
}

bool Messages::guarded(const std::function<void()>& act, bool loud) const {
  try {
    act();
    return true;
  } catch (const Cancelled&) {
  } catch (const std::bad_alloc&) {
    complain(tr("There is not enough memory for this. The case is unchanged."));
  } catch (const ResourceError& error) {
    complain(library_text(error.what()));
  } catch (const session::CaseIsReadOnly&) {
    complain(tr("This case can be looked at and not changed: its file or folder may not be written. Choose "
                "File > Save the case as, and go on in the copy."),
             tr("A read-only case"));
  } catch (const IoError& error) {
    complain(library_text(error.what()));
  } catch (const Error& error) {
    if (loud)
      complain(library_text(error.what()));
    else
      say(library_text(error.what()));
  }
  return false;
}

void Messages::set_shown_name(const QString& text) const {
  if (shown_name_) shown_name_(text);
}

}  // namespace ostia::workstation
