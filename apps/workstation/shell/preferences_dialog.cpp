#include "shell/preferences_dialog.h"

#include "commands/table.h"
#include "commands/texts.h"
#include "shell/bind.h"
#include "shell/desk.h"
#include "shell/hanging.h"
#include "shell/language.h"
#include "shell/theme.h"
#include "views/overlay_colors.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace ostia::workstation {
namespace {

constexpr int command_id_role = Qt::UserRole;

QString shown(const QList<QKeySequence>& keys) {
  QStringList texts;
  for (const QKeySequence& one : keys) texts << one.toString(QKeySequence::NativeText);
  return texts.join(", ");
}

}  // namespace

PreferencesDialog::PreferencesDialog(Desk& desk, CommandTable& commands)
    : QDialog(&desk.window), desk_(desk), commands_(commands), keys_(commands.keys()) {
  setObjectName("preferences");
  setWindowTitle(tr("Preferences"));
  resize_within(*this, QSize(620, 600));
  auto* tabs = new QTabWidget(this);
  tabs->addTab(general_page(), tr("General"));
  tabs->addTab(keys_page(), tr("Keys"));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(tabs, 1);
  layout->addWidget(buttons);
}

QWidget* PreferencesDialog::general_page() {
  auto* page = new QWidget;
  auto* form = new QFormLayout(page);
  auto* theme = new QComboBox;
  theme->setObjectName("theme");
  theme->addItems({tr("Dark"), tr("Light")});
  theme->setCurrentIndex(current_theme() == Theme::dark ? 0 : 1);
  theme->setToolTip(tr("Images are dark in both"));
  connect(theme, QOverload<int>::of(&QComboBox::activated), this, [this](int index) {
    if ((index == 0) != (current_theme() == Theme::dark)) commands_.action("view.theme").trigger();
  });
  form->addRow(tr("Theme"), theme);
  auto* language = new QComboBox;
  language->setObjectName("language");
  language->addItem(tr("As the system has it"), QString());
  for (const Language& one : languages()) language->addItem(one.name, one.code);
  const auto chosen = desk_.machine.setting(language_setting);
  language->setCurrentIndex(chosen ? std::max(0, language->findData(QString::fromStdString(*chosen))) : 0);
  auto* note =
      new QLabel(tr("Another language is used from the next start on. Numbers keep the decimal "
                    "point in every language, as in reports and files."));
  note->setWordWrap(true);
  connect(language, QOverload<int>::of(&QComboBox::activated), this, [this, language](int index) {
    desk_.messages.guarded([&] {
      desk_.machine.set_setting(language_setting, language->itemData(index).toString().toStdString());
    });
  });
  form->addRow(tr("Language"), language);
  form->addRow(QString(), note);
  add_patients(*form);
  add_author(*form);
  return page;
}

void PreferencesDialog::add_author(QFormLayout& form) {
  auto* name = new QLineEdit(QString::fromStdString(desk_.machine.setting(author_setting).value_or("")));
  name->setObjectName("author");
  name->setMaxLength(60);
  name->setPlaceholderText(tr("Nobody"));
  name->setToolTip(
      tr("Stands at each step that you do from now on, in the case alone: in no report and no "
         "export. Left empty, steps have no name."));
  connect(name, &QLineEdit::editingFinished, this, [this, name] {
    const std::string text = name->text().simplified().toStdString();
    desk_.messages.guarded([&] {
      desk_.machine.set_setting(author_setting, text);
      if (desk_.bench.has_case()) desk_.bench.session().file().set_author(text);
    });
  });
  form.addRow(tr("Your name at steps"), name);
}

void PreferencesDialog::add_patients(QFormLayout& form) {
  auto* on_views = new QCheckBox(tr("In a corner of each image"));
  on_views->setObjectName("identity_on_views");
  bind_checked(on_views, desk_.identity.on_views);
  form.addRow(tr("Patient's name"), on_views);
  auto* kept = new QCheckBox(tr("In the list of recent cases"));
  kept->setObjectName("identity_kept");
  kept->setToolTip(
      tr("Names are kept on this computer, in a file that you alone can read. No case has them."));
  bind_checked(kept, desk_.identity.kept);
  auto* forget = new QPushButton(tr("Forget all names"));
  forget->setObjectName("identity_forget");
  forget->setAutoDefault(false);
  connect(forget, &QPushButton::clicked, this,
          [this] { desk_.messages.guarded([this] { desk_.identity.forget_all(); }); });
  auto* row = new QHBoxLayout;
  row->addWidget(kept);
  row->addStretch(1);
  row->addWidget(forget);
  form.addRow(QString(), row);
}

QWidget* PreferencesDialog::keys_page() {
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  auto* form = new QFormLayout;
  scheme_ = new QComboBox;
  scheme_->setObjectName("scheme");
  scheme_->addItem(tr("As on a PACS station"), static_cast<int>(ShortcutScheme::pacs));
  scheme_->addItem(tr("As in research software"), static_cast<int>(ShortcutScheme::research));
  scheme_->setToolTip(tr("Choosing one gives all commands its keys"));
  connect(scheme_, QOverload<int>::of(&QComboBox::activated), this, &PreferencesDialog::choose_scheme);
  form->addRow(tr("Scheme"), scheme_);
  layout->addLayout(form);
  list_ = new QTreeWidget;
  list_->setObjectName("commands");
  list_->setAccessibleName(tr("Commands and their keys"));
  list_->setColumnCount(2);
  list_->setHeaderLabels({tr("Command"), tr("Keys")});
  list_->setRootIsDecorated(false);
  list_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  list_->header()->setStretchLastSection(false);
  layout->addWidget(list_, 1);
  editor_ = new QKeySequenceEdit;
  editor_->setObjectName("keys");
  editor_->setAccessibleName(tr("New keys"));
  editor_->setToolTip(tr("Click here and press the keys for the selected command"));
  auto* none = new QPushButton(tr("No key"));
  none->setToolTip(tr("The command is then in menus alone"));
  auto* reset_one = new QPushButton(tr("As in the scheme"));
  auto* all = new QPushButton(tr("All as in the scheme"));
  for (QPushButton* button : {none, reset_one, all}) button->setAutoDefault(false);
  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel(tr("New keys:")));
  row->addWidget(editor_, 1);
  row->addWidget(none);
  row->addWidget(reset_one);
  row->addWidget(all);
  layout->addLayout(row);
  trouble_ = new QLabel;
  trouble_->setObjectName("trouble");
  trouble_->setWordWrap(true);
  trouble_->setMinimumHeight(2 * trouble_->fontMetrics().height());
  layout->addWidget(trouble_);
  connect(editor_, &QKeySequenceEdit::editingFinished, this, [this] {
    if (!editor_->keySequence().isEmpty()) take(QKeySequence(editor_->keySequence()[0]));
  });
  connect(none, &QPushButton::clicked, this, [this] { take({}); });
  connect(reset_one, &QPushButton::clicked, this, &PreferencesDialog::reset);
  connect(all, &QPushButton::clicked, this, &PreferencesDialog::reset_all);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this] {
    editor_->clear();
    trouble_->clear();
  });
  fill_keys();
  return page;
}

void PreferencesDialog::fill_keys() {
  QMap<QString, QTreeWidgetItem*> groups;
  for (const Command& command : commands_.all()) {
    const QString title = command_group(command.id);
    if (!groups.contains(title)) {
      auto* group = new QTreeWidgetItem(list_, {title});
      QFont bold = font();
      bold.setBold(true);
      group->setFont(0, bold);
      group->setFlags(Qt::ItemIsEnabled);
      group->setExpanded(true);
      groups[title] = group;
    }
    auto* line = new QTreeWidgetItem(groups[title], {plain_text(command.text)});
    line->setData(0, command_id_role, command.id);
    line->setToolTip(0, command.tip);
  }
  show_keys();
}

void PreferencesDialog::show_keys() {
  scheme_->setCurrentIndex(scheme_->findData(static_cast<int>(keys_.scheme())));
  for (int i = 0; i < list_->topLevelItemCount(); ++i)
    for (int j = 0; j < list_->topLevelItem(i)->childCount(); ++j) {
      QTreeWidgetItem* line = list_->topLevelItem(i)->child(j);
      const QString id = line->data(0, command_id_role).toString();
      line->setText(1, shown(keys_.keys(id)));
      QFont font = line->font(1);
      font.setBold(keys_.is_changed(id));
      line->setFont(1, font);
    }
}

QString PreferencesDialog::current() const {
  const QTreeWidgetItem* line = list_->currentItem();
  return line ? line->data(0, command_id_role).toString() : QString();
}

QString PreferencesDialog::name_of(const QString& id) const {
  const Command* command = commands_.find(id);
  return command ? plain_text(command->text) : id;
}

void PreferencesDialog::complain(const QString& text) {
  QPalette palette = trouble_->palette();
  palette.setColor(QPalette::WindowText, role_color(view::Role::stenosis, Ground::paper));
  trouble_->setPalette(palette);
  trouble_->setText(text);
}

void PreferencesDialog::take(const QKeySequence& keys) {
  const QString id = current();
  trouble_->clear();
  editor_->clear();
  if (id.isEmpty()) {
    complain(tr("Choose a command in the list first."));
    return;
  }
  if (!keys_.change(id, keys)) {
    const QString key = keys.toString(QKeySequence::NativeText);
    if (const auto other = keys_.taken_by(keys, id))
      complain(tr("%1 belongs to \"%2\". Choose another key, or take it from that command first.")
                   .arg(key, name_of(*other)));
    else
      complain(tr("%1 moves through views and lists and can run no command. Choose another key.").arg(key));
    return;
  }
  commands_.set_keys(keys_);
  show_keys();
  if (is_kept_by_window_managers(keys))
    complain(tr("%1 is this command's key now, but many desktops take it for themselves: where nothing "
                "happens, choose another.")
                 .arg(keys.toString(QKeySequence::NativeText)));
}

void PreferencesDialog::reset() {
  const QString id = current();
  trouble_->clear();
  if (id.isEmpty()) return complain(tr("Choose a command in the list first."));
  if (!keys_.reset(id)) return complain(tr("Another command has been given this command's key."));
  commands_.set_keys(keys_);
  show_keys();
}

void PreferencesDialog::reset_all() {
  trouble_->clear();
  keys_.reset_all();
  commands_.set_keys(keys_);
  show_keys();
}

void PreferencesDialog::choose_scheme(int index) {
  trouble_->clear();
  keys_ = keys_.in_scheme(static_cast<ShortcutScheme>(scheme_->itemData(index).toInt()));
  commands_.set_keys(keys_);
  show_keys();
}

}  // namespace ostia::workstation
