#include "shell/language.h"

#include "report/case_report_words.h"
#include "shell/library_texts.h"

#include "ostia/core/phrasebook.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QFile>
#include <QRegularExpression>
#include <QXmlStreamReader>
#include <map>
#include <set>

namespace ostia::workstation {
namespace {

TEST(Language, TheSettingGoesBeforeTheSystem) {
  EXPECT_EQ(chosen_language("en", {"de-DE"}), "en");
  EXPECT_EQ(chosen_language("de", {"en-GB"}), "de");
}

TEST(Language, WithoutASettingTheSystemsFirstKnownLanguageIsTaken) {
  EXPECT_EQ(chosen_language(std::nullopt, {"fr-FR", "de-AT", "en"}), "de");
  EXPECT_EQ(chosen_language("", {"de_CH"}), "de");
  EXPECT_EQ(chosen_language(std::nullopt, {"fr"}), "en");
  EXPECT_EQ(chosen_language(std::nullopt, {}), "en");
  EXPECT_EQ(chosen_language("xx", {"den"}), "en") << "what merely begins like one";
}

struct Text {
  QString context, source;
  QStringList translations;
  bool finished = true;
};

std::vector<Text> texts_of(const QString& code) {
  QFile file(QStringLiteral(OSTIA_SOURCES "/apps/workstation/translations/ostia_%1.ts").arg(code));
  EXPECT_TRUE(file.open(QIODevice::ReadOnly));
  std::vector<Text> found;
  QXmlStreamReader xml(&file);
  QString context;
  while (!xml.atEnd()) {
    if (xml.readNext() != QXmlStreamReader::StartElement) continue;
    if (xml.name() == QLatin1String("name")) {
      context = xml.readElementText();
    } else if (xml.name() == QLatin1String("message")) {
      found.push_back({context, {}, {}, true});
    } else if (xml.name() == QLatin1String("source")) {
      found.back().source = xml.readElementText();
    } else if (xml.name() == QLatin1String("translation")) {
      found.back().finished = !xml.attributes().hasAttribute("type");
      const QString text = xml.readElementText(QXmlStreamReader::IncludeChildElements).trimmed();
      found.back().translations << text;
    }
  }
  EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString();
  return found;
}

TEST(Language, GermanIsComplete) {
  const std::vector<Text> texts = texts_of("de");
  ASSERT_GT(texts.size(), 400u);
  for (const Text& one : texts) {
    EXPECT_TRUE(one.finished) << one.context.toStdString() << ": " << one.source.toStdString();
    for (const QString& translation : one.translations)
      EXPECT_EQ(one.source.trimmed().isEmpty(), translation.isEmpty()) << one.source.toStdString();
  }
}

/// Without what a menu or a sentence adds; "NO" is another word than "No".
QString term_of(QString text) {
  text = text.remove('&').remove(QRegularExpression("[\\x{2026}:.]+$")).trimmed();
  if (text.size() > 1 && text[1].isLower()) text[0] = text[0].toLower();
  return text;
}

TEST(Language, WindowAndReportSayTheSameForTheSame) {
  std::map<QString, std::set<QString>> of_report;
  for (const core::Phrase& one : session::report_words::german())
    of_report[term_of(QString::fromStdString(one.from))].insert(term_of(QString::fromStdString(one.to)));
  int same = 0;
  for (const Text& one : texts_of("de")) {
    const auto found = of_report.find(term_of(one.source));
    if (found == of_report.end() || one.context == "QPlatformTheme")
      continue;  // buttons are not of the report
    ++same;
    for (const QString& translation : one.translations)
      EXPECT_TRUE(found->second.count(term_of(translation)))
          << one.context.toStdString() << ": \"" << one.source.toStdString() << "\" is \""
          << translation.toStdString() << "\" in the window and \"" << found->second.begin()->toStdString()
          << "\" in the report";
  }
  EXPECT_GT(same, 60) << "window and report have hardly a word in common";
}

TEST(Language, SentencesOfLibrariesKeepTheirPlaces) {
  std::vector<core::Phrase> phrases;
  for (const Text& one : texts_of("de"))
    if (one.context == "library")
      phrases.push_back({one.source.toStdString(), one.translations.front().toStdString()});
  ASSERT_EQ(phrases.size(), library_sentences().size());
  const core::Phrasebook german(phrases);  // throws for a place that is lost
  EXPECT_NE(
      german
          .say("cannot open the case a.ostia: its format 9 is newer than this program's (5, Ostia 0.2); open "
               "it with Ostia 0.3 or newer")
          .find("Ostia 0.3"),
      std::string::npos);
}

TEST(Language, EditsAreSaidWithTheNamesOfVesselsAlone) {
  EXPECT_EQ(library_text("branch.delete on vessel 7 (RCA): its branches go, too: CB, vessel 12"),
            QStringLiteral("RCA: its branches go, too: CB, vessel 12"));
  EXPECT_EQ(
      library_text("wall.drag on LAD starts 3.00 mm from the vessel's wall; take hold of the wall itself"),
      QStringLiteral("the pull on LAD starts 3.00 mm from the vessel's wall; take hold of the wall itself"));
  EXPECT_EQ(
      library_text("cpr.stroke on vessel 4 runs back along the vessel at 2.0 mm; draw it in one direction, "
                   "or use section.contour"),
      QStringLiteral("the line on vessel 4 runs back along the vessel at 2.0 mm; draw it in one direction"));
}

TEST(Language, EnglishHasThePluralsThatGermanHas) {
  QStringList english, german;
  for (const Text& one : texts_of("en")) {
    EXPECT_TRUE(one.finished) << one.source.toStdString();
    EXPECT_FALSE(one.translations.join(' ').contains("(s)")) << one.source.toStdString();
    english << one.source;
  }
  for (const Text& one : texts_of("de"))
    if (one.source.contains("%n")) german << one.source;
  EXPECT_EQ(english, german);
}

TEST(Language, TranslationsKeepThePlacesOfNumbersAndNames) {
  const QRegularExpression place("%[1-9n]");
  for (const Text& one : texts_of("de")) {
    QStringList wanted;
    auto at = place.globalMatch(one.source);
    while (at.hasNext()) wanted << at.next().captured();
    for (const QString& mark : wanted)
      EXPECT_TRUE(one.translations.join(' ').contains(mark))
          << one.source.toStdString() << " has lost " << mark.toStdString();
  }
}

}  // namespace
}  // namespace ostia::workstation
