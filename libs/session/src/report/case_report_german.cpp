// The report in German, by its English. Places: see core/phrasebook.h.

#include "report/case_report_words.h"

namespace ostia::session::report_words {
namespace {

using Phrases = std::vector<core::Phrase>;

Phrases about_document() {
  return {
      {"Coronary arteries on CT angiography", "Koronararterien in der CT-Angiographie"},
      {"Case of %1", "Fall zu %1"},
      {"Case %1", "Fall %1"},
      {"research software, not a medical device", "Forschungssoftware, kein Medizinprodukt"},
      {"Made with research software that is not a medical device. Nothing in this report may be used for "
       "diagnosis or treatment unless a physician has verified it on the images.",
       "Mit Forschungssoftware erstellt, die kein Medizinprodukt ist. Nichts in diesem Bericht darf für "
       "Diagnose oder Behandlung verwendet werden, bevor es ärztlich an den Bildern geprüft wurde."},
      {"Patient", "Name"},
      {"Patient ID", "Patienten-ID"},
      {"Study date", "Untersuchungsdatum"},
      {"Series", "Serie"},
      {"This document names a patient, as its reader asked. The tables and pictures beside it do not.",
       "Dieses Dokument nennt einen Namen, wie beim Erstellen verlangt. Die Tabellen und Bilder daneben tun "
       "es "
       "nicht."},
  };
}

Phrases summary() {
  return {
      {"Summary", "Zusammenfassung"},
      {"Date", "Datum"},
      {"Image", "Bild"},
      {"%1 (not at hand)", "%1 (lag nicht vor)"},
      {"the case names none", "der Fall nennt keines"},
      {"Orientation", "Orientierung"},
      {"%1, given by a person", "%1, von Hand angegeben"},
      {"Worst graded stenosis", "Schwerste bewertete Stenose"},
      {"none from %1 % of the diameter on", "keine ab %1 % des Durchmessers"},
      {"%1: %2 % of the diameter", "%1: %2 % des Durchmessers"},
      {"Image quality", "Bildqualität"},
      {"Not found", "Nicht gefunden"},
      {"Lesions", "Läsionen"},
      {"Vessels", "Gefäße"},
      {"Steps taken", "Arbeitsschritte"},
      {"Program", "Programm"},
      {"Model", "Modell"},
      {"%1, of which %2 were accepted and %3 rejected by a person",
       "%1, davon %2 von Hand angenommen und %3 verworfen"},
      {"%1, of which %2 were checked by a person", "%1, davon %2 von Hand geprüft"},
      {"Every vessel was checked by a person.", "Alle Gefäße wurden von Hand geprüft."},
      {"Not checked by a person: %1. What stands here of these vessels is the program's own finding.",
       "Nicht von Hand geprüft: %1. Was hier über diese Gefäße steht, hat allein das Programm gefunden."},
      {"Not judged: %l1.", "Nicht beurteilt: %l1."},
      {"%1: %t2", "%1: %t2"},
      {"No stenosis (0 %)", "keine Stenose (0 %)"},
      {"Minimal stenosis (1-24 %)", "minimale Stenose (1-24 %)"},
      {"Mild stenosis (25-49 %)", "leichte Stenose (25-49 %)"},
      {"Moderate stenosis (50-69 %)", "mäßige Stenose (50-69 %)"},
      {"Severe stenosis (70-99 %)", "schwere Stenose (70-99 %)"},
      {"Left main stenosis from 50 % or severe stenoses of three vessels (70-99 %)",
       "Hauptstammstenose ab 50 % oder schwere Stenosen dreier Gefäße (70-99 %)"},
      {"Total occlusion (100 %)", "Verschluss (100 %)"},
      {"Not diagnostic: obstructive disease is not excluded",
       "nicht diagnostisch: eine obstruktive Erkrankung ist nicht ausgeschlossen"},
      {"%1: %t2; not diagnostic elsewhere, where there may be more",
       "%1: %t2; anderswo nicht diagnostisch, dort kann mehr sein"},
  };
}

Phrases quality() {
  return {
      {"good", "gut"},
      {"fair", "mäßig"},
      {"poor", "schlecht"},
      {"not known: the image was not at hand", "nicht bekannt: das Bild lag nicht vor"},
      {"voxels of %1 mm in the plane", "Voxel von %1 mm in der Ebene"},
      {"slices %1 mm apart", "Schichten im Abstand von %1 mm"},
      {"noise of %1 HU", "Rauschen von %1 HU"},
      {"arteries of %1 HU", "Arterien mit %1 HU"},
      {"contrast is %1 times the noise", "der Kontrast ist das %1-Fache des Rauschens"},
      {"edges blurred by %1 mm (motion, or the scanner)",
       "Kanten um %1 mm verwischt (Bewegung oder der Scanner)"},
      {"%1 of the arteries' length cannot be evaluated",
       "%1 der Länge der Arterien lassen sich nicht beurteilen"},
      {"%t1; up to %2 is usual", "%t1; üblich sind höchstens %2"},
      {"%t1; at least %2 is usual", "%t1; üblich sind mindestens %2"},
      {"Of the arteries' length %1 % evaluable, %2 % limited, %3 % not evaluable",
       "Von der Länge der Arterien sind %1 % beurteilbar, %2 % eingeschränkt, %3 % nicht beurteilbar"},
      {"evaluable", "beurteilbar"},
      {"limited", "eingeschränkt"},
      {"not evaluable", "nicht beurteilbar"},
      {"%t1 (reader)", "%t1 (Befunder)"},
      {"not known", "nicht bekannt"},
      {"all of it", "ganz"},
      {"%1 mm: %t2", "%1 mm: %t2"},
      {"the image ends", "das Bild endet"},
      {"voxels too coarse for its calibre", "Voxel zu grob für das Kaliber"},
      {"hardly brighter than the noise", "kaum heller als das Rauschen"},
      {"no clear edge", "keine klare Kante"},
      {"calcium hides the lumen", "Kalk verdeckt das Lumen"},
      {"the edge is blurred", "die Kante ist unscharf"},
      {"says the reader", "sagt der Befunder"},
      {"not found", "nicht gefunden"},
      {"%t1: not found", "%t1: nicht gefunden"},
      {"%t1: not found, or among the vessels without a coronary artery's name (%2)",
       "%t1: nicht gefunden, oder unter den Gefäßen ohne den Namen einer Koronararterie (%2)"},
      {"left coronary artery (LM, LAD, LCX)", "linke Koronararterie (LM, LAD, LCX)"},
      {"%t1: not found, what was found is hardly an artery (probability of %2)",
       "%t1: nicht gefunden, was gefunden wurde, ist wohl keine Arterie (Wahrscheinlichkeit: %2)"},
      {"%t1: not found, or among the vessels without a coronary artery's name (%2), what was found is hardly "
       "an "
       "artery (probability of %3)",
       "%t1: nicht gefunden, oder unter den Gefäßen ohne den Namen einer Koronararterie (%2), was gefunden "
       "wurde, ist wohl keine Arterie (Wahrscheinlichkeit: %3)"},
      {"its vessel is hardly an artery", "sein Gefäß ist wohl keine Arterie"},
      {"probability %1", "Wahrscheinlichkeit %1"},
      {"nobody has checked it, and no image was at hand", "niemand hat es geprüft, und es lag kein Bild vor"},
      {"%1 from %2 to %3 mm: not evaluable (%t4)", "%1 von %2 bis %3 mm: nicht beurteilbar (%t4)"},
      {"%1 in %2, %3 % by the model: %t4", "%1 in %2, %3 % nach dem Modell: %t4"},
      {"%1 in %2, %3 % by the model: %t4 (%t5), and nobody has checked it",
       "%1 in %2, %3 % nach dem Modell: %t4 (%t5), und niemand hat es geprüft"},
      {"%t1 (%t2), and nobody has checked it", "%t1 (%t2), und niemand hat es geprüft"},
  };
}

Phrases lesions() {
  return {
      {"Stenoses", "Stenosen"},
      {"No narrowing of %1 % of the diameter or more was found.",
       "Es wurde keine Verengung um %1 % des Durchmessers oder mehr gefunden."},
      {"No.", "Nr."},
      {"Vessel", "Gefäß"},
      {"Segment", "Segment"},
      {"At (mm)", "Bei (mm)"},
      {"Length (mm)", "Länge (mm)"},
      {"Reference (mm)", "Referenz (mm)"},
      {"Diameter stenosis", "Durchmesser-stenose"},
      {"MLA (mm\u00b2)", "MLA (mm\u00b2)"},
      {"Area stenosis", "Flächen-stenose"},
      {"Evaluable", "Beurteilbar"},
      {"Checked", "Geprüft"},
      {"Narrowings and plaques, each at its own vessel", "Verengungen und Plaques, jede bei ihrem Gefäß"},
      {"yes", "ja"},
      {"NO", "NEIN"},
      {"accepted", "angenommen"},
      {"rejected", "verworfen"},
      {"not graded", "nicht bewertet"},
      {"none", "keine"},
      {"%1 is not graded: %t2.", "%1 ist nicht bewertet: %t2."},
      {"rejected by the reader", "vom Befunder verworfen"},
      {"not evaluable, says the reader", "nicht beurteilbar, sagt der Befunder"},
      {"its vessel is thinner than %1 mm", "das Gefäß ist dünner als %1 mm"},
      {"* The reference is thinner than %1 mm: without a say in the patient's category.",
       "* Die Referenz ist dünner als %1 mm: zählt nicht für die Kategorie der Person."},
      {"Bifurcation lesions", "Bifurkationsläsionen"},
      {"Bifurcation", "Bifurkation"},
      {"Main, proximal", "Hauptgefäß, proximal"},
      {"Main, distal", "Hauptgefäß, distal"},
      {"Side branch", "Seitenast"},
      {"Main vessel / side branch; worst narrowing of the diameter in each",
       "Hauptgefäß / Seitenast; jeweils die schwerste Verengung des Durchmessers"},
      {"Medina's class: main vessel before the bifurcation, main vessel behind it, side branch; 1 where the "
       "diameter is narrowed by %1 % or more within %2 mm. Side branches from %3 mm on.",
       "Medina-Klasse: Hauptgefäß vor der Bifurkation, Hauptgefäß dahinter, Seitenast; 1, wo der Durchmesser "
       "innerhalb von %2 mm um %1 % oder mehr verengt ist. Seitenäste ab %3 mm."},
  };
}

}  // namespace

std::vector<core::Phrase> german() {
  std::vector<core::Phrase> all = german_of_tables(), parts = german_of_parts();
  all.insert(all.end(), parts.begin(), parts.end());
  for (const Phrases& some : {about_document(), summary(), quality(), lesions()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace ostia::session::report_words
