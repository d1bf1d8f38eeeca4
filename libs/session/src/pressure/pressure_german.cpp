// The pages of pressures in German, by their English. Places: see core/phrasebook.h.

#include "ostia/session/pressure_document.h"

namespace ostia::session {
namespace {

using Phrases = std::vector<core::Phrase>;

Phrases of_pages() {
  return {
      {"Pressure and flow along the coronary arteries", "Druck und Fluss entlang der Koronararterien"},
      {"Case of %1", "Fall zu %1"},
      {"computed", "berechnet"},
      {"research software, not a medical device", "Forschungssoftware, kein Medizinprodukt"},
      {"Research software, not a medical device: these pressures and flows are computed, and no decision on "
       "a "
       "patient may rest on them.",
       "Forschungssoftware, kein Medizinprodukt: diese Drücke und Flüsse sind berechnet; keine Entscheidung "
       "über einen Patienten darf sich auf sie stützen."},
      {"Research software, not a medical device; no decision on a patient may rest on it.",
       "Forschungssoftware, kein Medizinprodukt; keine Entscheidung über einen Patienten darf darauf ruhen."},
      {"Summary", "Zusammenfassung"},
      {"Date", "Datum"},
      {"Image", "Bild"},
      {"Program", "Programm"},
      {"Mean aortic pressure", "Mittlerer Aortendruck"},
      {"%1 mmHg (%2/%3 by cuff)", "%1 mmHg (%2/%3 nach Manschette)"},
      {"Flow of the tree at rest", "Fluss des Baums in Ruhe"},
      {"%1 ml/min, told", "%1 ml/min, angegeben"},
      {"%1 ml/min, by the left ventricle's mass", "%1 ml/min, nach der Masse des linken Ventrikels"},
      {"%1 ml/min, by the vessels' calibre", "%1 ml/min, nach dem Kaliber der Gefäße"},
      {"Lowest FFR", "Niedrigste FFR"},
      {"%1 at the end of %2", "%1 am Ende von %2"},
      {"not known: all ends lie behind occlusions", "nicht bekannt: alle Enden liegen hinter Verschlüssen"},
      {"Narrowings", "Engstellen"},
      {"None was found.", "Keine wurde gefunden."},
      {"No.", "Nr."},
      {"Vessel", "Gefäß"},
      {"At (mm)", "Bei (mm)"},
      {"Before", "Davor"},
      {"FFR", "FFR"},
      {"Read behind (mm)", "Gelesen dahinter (mm)"},
      {"Takes", "Abfall"},
      {"Pd/Pa at rest", "Pd/Pa in Ruhe"},
      {"What if", "Was wäre, wenn"},
      {"FFR, what if", "FFR, was wäre, wenn"},
      {"occluded", "verschlossen"},
      {"FFR is Pd/Pa under hyperaemia, read behind each narrowing; at or below %1 it counts as significant.",
       "FFR ist Pd/Pa unter Hyperämie, hinter jeder Engstelle gelesen; bis %1 gilt sie als bedeutsam."},
      {"How sure", "Wie sicher"},
      {"Narrowing or end", "Engstelle oder Ende"},
      {"Median FFR", "FFR im Median"},
      {"95 % lie in", "95 % liegen in"},
      {"At or below %1 (%)", "Bis %1 (%)"},
      {"Varies by", "Schwankt durch"},
      {"wall %1 %", "Wand %1 %"},
      {"pressure %1 %", "Druck %1 %"},
      {"flow %1 %", "Fluss %1 %"},
      {"hyperaemia %1 %", "Hyperämie %1 %"},
      {"split %1 %", "Aufteilung %1 %"},
      {"blood %1 %", "Blut %1 %"},
      {"Of %1 trees drawn within what is not known for sure of the wall and the inputs.",
       "Aus %1 Bäumen, gezogen in dem, was von der Wand und den Eingaben nicht sicher bekannt ist."},
      {"Pullback curves", "Rückzugskurven"},
      {"%1: FFR along its way from the aorta", "%1: FFR entlang seines Wegs von der Aorta"},
      {"%1: FFR along its way from the aorta, as it is and what if",
       "%1: FFR entlang seines Wegs von der Aorta, wie es ist und was wäre, wenn"},
      {"Ends of the vessels", "Enden der Gefäße"},
      {"Flow (ml/min)", "Fluss (ml/min)"},
      {"At rest (ml/min)", "In Ruhe (ml/min)"},
      {"Flow reserve", "Flussreserve"},
      {"Pullback index", "Rückzugsindex"},
      {"Stretches that are looked at as if they had another calibre; the lumen and the beds behind it stay "
       "as "
       "they are.",
       "Strecken, die betrachtet werden, als hätten sie ein anderes Kaliber; das Lumen und die Gefäßbetten "
       "dahinter bleiben, wie sie sind."},
      {"From (mm)", "Von (mm)"},
      {"To (mm)", "Bis (mm)"},
      {"opened to the reference, %1 % left", "bis zur Referenz geöffnet, %1 % bleiben"},
      {"narrowed by %1 %", "um %1 % verengt"},
      {"Marks", "Hinweise"},
      {"Inputs", "Eingaben"},
      {"Input", "Eingabe"},
      {"Value", "Wert"},
      {"Usual", "Üblich"},
      {"Source", "Quelle"},
      {"told", "angegeben"},
      {"as it is", "wie es ist"},
      {"what if", "was wäre, wenn"},
      {"mm from the aorta", "mm von der Aorta"},
      {"How they come about: Ostia's page on pressure and flow along the coronary tree.",
       "Wie sie zustande kommen: Ostias Seite über Druck und Fluss entlang des Koronarbaums."},
  };
}

Phrases of_inputs() {
  return {
      {"systolic pressure by cuff", "systolischer Druck nach Manschette"},
      {"diastolic pressure by cuff", "diastolischer Druck nach Manschette"},
      {"share of the pulse pressure in the mean pressure", "Anteil des Pulsdrucks am Mitteldruck"},
      {"pressure behind the beds", "Druck hinter den Gefäßbetten"},
      {"heart rate, for the pulse", "Herzfrequenz, für den Puls"},
      {"density of blood", "Dichte des Bluts"},
      {"viscosity of blood at high shear", "Viskosität des Bluts bei hoher Scherung"},
      {"flow of the whole tree at rest", "Fluss des ganzen Baums in Ruhe"},
      {"mass of the left ventricle", "Masse des linken Ventrikels"},
      {"flow at rest of a gram of heart muscle", "Ruhefluss eines Gramms Herzmuskel"},
      {"share of that muscle which the tree supplies", "Anteil dieses Muskels, den der Baum versorgt"},
      {"flow of a vessel of one metre", "Fluss eines Gefäßes von einem Meter"},
      {"exponent of the diameter in a vessel's flow", "Exponent des Durchmessers im Fluss eines Gefäßes"},
      {"exponent of the diameter by which a flow is shared",
       "Exponent des Durchmessers, nach dem sich ein Fluss teilt"},
      {"resistance of the beds under adenosine over that at rest",
       "Widerstand der Gefäßbetten unter Adenosin gegen den in Ruhe"},
      {"measured; %1 where it is not told", "gemessen; %1, wo er nicht angegeben ist"},
      {"usual value", "üblicher Wert"},
      {"usual value at a haematocrit of 45 %", "üblicher Wert bei einem Hämatokrit von 45 %"},
      {"told, of the image", "angegeben, aus dem Bild"},
      {"told; 1 with both coronary arteries", "angegeben; 1 mit beiden Koronararterien"},
  };
}

Phrases of_marks() {
  return {
      {"%1 at %2: occluded; nothing flows, and collateral flow is not modelled",
       "%1 bei %2: verschlossen; nichts fließt, und Kollateralfluss ist nicht im Modell"},
      {"%1 at %2: a graft; the flow that it competes with is not modelled",
       "%1 bei %2: ein Bypass; der Fluss, mit dem er konkurriert, ist nicht im Modell"},
      {"%1 at %2: the flow is too fast for the laminar model (Reynolds' number above %3)",
       "%1 bei %2: der Fluss ist zu schnell für das laminare Modell (Reynolds-Zahl über %3)"},
      {"%1 at %2: an ectasia or aneurysm; flow that turns in it is not modelled",
       "%1 bei %2: eine Ektasie oder ein Aneurysma; Fluss, der darin kreist, ist nicht im Modell"},
      {"%1 at %2: narrower than CT can tell (%3)", "%1 bei %2: enger, als die CT unterscheiden kann (%3)"},
      {"%1 at %2: the tree ends before the jet has mixed; the pressure behind is higher than the last that "
       "is "
       "shown",
       "%1 bei %2: der Baum endet, bevor sich der Strahl gemischt hat; der Druck dahinter ist höher als der "
       "letzte, der gezeigt wird"},
      {"one coronary artery alone is there: its share of the ventricle's mass is not told, so the flow goes "
       "by "
       "its calibre",
       "nur eine Koronararterie ist da: ihr Anteil an der Masse des Ventrikels ist nicht angegeben, also "
       "geht "
       "der Fluss nach ihrem Kaliber"},
      {"%1 of %2 have no closed wall; the calibre there is taken from the sections beside them",
       "%1 von %2 haben keine geschlossene Wand; das Kaliber dort ist das der Schnitte daneben"},
      {"%1 from %2 to %3 mm: no section there is narrower than what is asked for; nothing is changed",
       "%1 von %2 bis %3 mm: kein Schnitt dort ist enger als verlangt; nichts ändert sich"},
      {"%1 from %2 to %3 mm: no section there is wider than what is asked for; nothing is changed",
       "%1 von %2 bis %3 mm: kein Schnitt dort ist weiter als verlangt; nichts ändert sich"},
  };
}

}  // namespace

const core::Phrasebook& pressure_words(ReportLanguage language) {
  static const core::Phrasebook english, german([] {
    Phrases all = of_pages();
    for (Phrases more : {of_inputs(), of_marks()})
      for (core::Phrase& one : more) all.push_back(std::move(one));
    return all;
  }());
  return language == ReportLanguage::german ? german : english;
}

}  // namespace ostia::session
