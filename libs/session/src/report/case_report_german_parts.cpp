// The report in German, by its English: impression, CAD-RADS as it is written, high-risk plaque, standard
// segments, versions. Places: see core/phrasebook.h.

#include "report/case_report_words.h"

namespace ostia::session::report_words {
namespace {

using Phrases = std::vector<core::Phrase>;

Phrases impression() {
  return {
      {"Impression", "Beurteilung"},
      {"Drafted by the program from the findings; nobody has written it.",
       "Vom Programm aus den Befunden entworfen; niemand hat es geschrieben."},
      {"CAD-RADS %1: %t2", "CAD-RADS %1: %t2"},
      {"%1: %2 % of the diameter, %t3; MLD %4 mm", "%1: %2 % des Durchmessers, %t3; MLD %4 mm"},
      {"%1: %2 % of the diameter, %t3; MLD %4 mm; plaque: %t5",
       "%1: %2 % des Durchmessers, %t3; MLD %4 mm; Plaque: %t5"},
      {"minimal", "minimal"},
      {"mild", "leicht"},
      {"moderate", "mäßig"},
      {"severe", "schwer"},
      {"extensive", "ausgedehnt"},
      {"occlusion", "Verschluss"},
      {"no plaque", "keine Plaque"},
      {"No graded narrowing of %1 % of the diameter or more",
       "Keine bewertete Verengung um %1 % des Durchmessers oder mehr"},
      {"Plaque in %1 of 18 segments: %t2", "Plaque in %1 von 18 Segmenten: %t2"},
      {"Plaque in at least %1 of 18 segments: %t2", "Plaque in mindestens %1 von 18 Segmenten: %t2"},
      {"Calcium score %1: %t2", "Kalkscore %1: %t2"},
      {"High-risk plaque, %1 in %2: %l3", "Hochrisikoplaque, %1 in %2: %l3"},
      {"Test for ischaemia: %t1", "Ischämietest: %t1"},
      {"Dominance: %t1", "Versorgungstyp: %t1"},
      {"Image quality: %t1", "Bildqualität: %t1"},
  };
}

Phrases cad_rads() {
  return {
      {"Technique", "Technik"},
      {"slices of %1 mm", "Schichten von %1 mm"},
      {"kernel %1", "Faltungskern %1"},
      {"at %1 % of the cardiac cycle", "bei %1 % des Herzzyklus"},
      {"voxels of %1 mm", "Voxel von %1 mm"},
      {"Dominance", "Versorgungstyp"},
      {"unknown", "nicht bekannt"},
      {"right", "rechts"},
      {"left", "links"},
      {"co-dominant", "ausgeglichen"},
      {"As it is written", "Schreibweise"},
      {"Plaque burden by segments (SIS)", "Plaquelast nach Segmenten (SIS)"},
      {"Plaque burden by calcium score", "Plaquelast nach Kalkscore"},
      {"Plaque burden by sight", "Plaquelast nach Augenmaß"},
      {"Plaque burden stated", "Angegebene Plaquelast"},
      {"%1 of 18 segments: %t2", "%1 von 18 Segmenten: %t2"},
      {"at least %1 of 18 segments: %t2", "mindestens %1 von 18 Segmenten: %t2"},
      {"Agatston %1: %t2", "Agatston %1: %t2"},
      {"P%1, %t2", "P%1, %t2"},
      {"not judged by the reader", "vom Befunder nicht beurteilt"},
      {"High-risk plaque (HRP)", "Hochrisikoplaque (HRP)"},
      {"none found", "keine gefunden"},
      {"Ischaemia (I)", "Ischämie (I)"},
      {"not tested", "nicht geprüft"},
      {"negative", "negativ"},
      {"borderline", "grenzwertig"},
      {"positive", "positiv"},
      {"Stent (S)", "Stent (S)"},
      {"Graft (G)", "Bypass (G)"},
      {"Exceptions (E)", "Ausnahmen (E)"},
      {"none known", "keine bekannt"},
      {"Next investigation", "Nächste Untersuchung"},
      {"functional assessment can be considered", "funktionelle Untersuchung kann erwogen werden"},
      {"invasive angiography or functional assessment can be considered",
       "invasive Angiographie oder funktionelle Untersuchung kann erwogen werden"},
      {"invasive angiography is recommended", "invasive Angiographie wird empfohlen"},
      {"invasive angiography, functional assessment or assessment of viability can be considered",
       "invasive Angiographie, funktionelle Untersuchung oder Vitalitätsdiagnostik kann erwogen werden"},
      {"additional or other evaluation may be needed", "zusätzliche oder andere Diagnostik kann nötig sein"},
      {"Category, plaque burden and modifiers after Cury et al. 2022; the ways to the plaque burden often "
       "differ: the highest is stated, that by calcium not beside a stent, and the reader's word before all. "
       "Next investigation: what their table names for stable "
       "chest pain; it is no advice for this patient.",
       "Kategorie, Plaquelast und Zusätze nach Cury et al. 2022; die Wege zur Plaquelast führen oft zu "
       "verschiedenen Ergebnissen: das höchste wird angegeben, das des Kalks nicht neben einem Stent, und "
       "das Wort des Befunders vor allen. Nächste Untersuchung: was deren Tabelle bei "
       "stabilem Brustschmerz nennt; es ist kein Rat für diese Person."},
      {"CAD-RADS of a lesion is by its diameter alone, of what can be judged. Narrowings below %1 % are "
       "listed where plaque is seen; plaque without narrowing is category 1. MLD and MLA: least lumen "
       "diameter and area. Percentages are against the calibre that the vessel would have without disease.",
       "CAD-RADS einer Läsion nach dem Durchmesser allein, von dem, was sich beurteilen lässt. Verengungen "
       "unter %1 % sind aufgeführt, wo Plaque zu sehen ist; Plaque ohne Verengung ist Kategorie 1. MLD und "
       "MLA: kleinster Durchmesser und kleinste Fläche des Lumens. Prozente gelten gegen das Kaliber, das "
       "das "
       "Gefäß ohne Erkrankung hätte."},
      {"the category is 1 and not 0: a plaque burden of %1 was given, so there is plaque that the tables do "
       "not have",
       "die Kategorie ist 1 und nicht 0: es wurde eine Plaquelast von %1 angegeben, also gibt es Plaque, die "
       "in den Tabellen fehlt"},
  };
}

Phrases high_risk() {
  return {
      {"High-risk plaque", "Hochrisikoplaque"},
      {"Features of high-risk plaque, by lesion", "Merkmale von Hochrisikoplaque, je Läsion"},
      {"Lesion", "Läsion"},
      {"Feature", "Merkmal"},
      {"Measured", "Gemessen"},
      {"Bound", "Grenze"},
      {"By image", "Nach dem Bild"},
      {"Confidence", "Sicherheit"},
      {"Reader", "Befunder"},
      {"Counts", "Zählt"},
      {"low attenuation", "niedrige Dichte"},
      {"positive remodelling", "positives Remodeling"},
      {"spotty calcium", "punktförmiger Kalk"},
      {"napkin ring", "Serviettenring"},
      {"at least %1", "mindestens %1"},
      {"above %1", "über %1"},
      {"below %1", "unter %1"},
      {"found", "gefunden"},
      {"low", "gering"},
      {"high", "hoch"},
      {"no", "nein"},
      {"Low attenuation: the largest piece of plaque below %1 HU. Positive remodelling: outer diameter at "
       "the "
       "throat over that at the places of reference. Spotty calcium: a piece of calcium that is smaller than "
       "%2 mm in every direction, in plaque that is not calcified as a whole. Napkin ring: low attenuation "
       "at "
       "the lumen within a brighter rim without calcium, around %3\u00b0 or more over %4 mm. What is of low "
       "confidence counts where a person has accepted it. Two features or more are high-risk plaque.",
       "Niedrige Dichte: das größte Stück Plaque unter %1 HU. Positives Remodeling: Außendurchmesser an der "
       "Engstelle durch den an den Referenzstellen. Punktförmiger Kalk: ein Stück Kalk, das in jeder "
       "Richtung "
       "kleiner als %2 mm ist, in Plaque, die nicht als Ganzes verkalkt ist. Serviettenring: niedrige Dichte "
       "am Lumen in einem helleren Rand ohne Kalk, um %3° oder mehr auf %4 mm. Was von geringer Sicherheit "
       "ist, zählt, wo es von Hand angenommen wurde. Zwei Merkmale oder mehr sind Hochrisikoplaque."},
  };
}

Phrases standard_segments() {
  return {
      {"Standard segments", "Standardsegmente"},
      {"The 18 segments of the SCCT", "Die 18 Segmente der SCCT"},
      {"Stenosis", "Stenose"},
      {"High-risk features", "Hochrisiko-merkmale"},
      {"not in the tree", "nicht im Baum"},
      {"not judged", "nicht beurteilt"},
      {"%1 %, %t2", "%1 %, %t2"},
  };
}

Phrases versions() {
  return {
      {"Versions", "Fassungen"},
      {"Version", "Fassung"},
      {"Signed by", "Unterschrieben von"},
      {"What changed", "Was sich geändert hat"},
      {"Versions that were signed", "Fassungen, die unterschrieben wurden"},
      {"first version", "erste Fassung"},
      {"Nobody has signed this report.", "Niemand hat diesen Bericht unterschrieben."},
      {"This is version %1, as it was signed.", "Dies ist Fassung %1, wie sie unterschrieben wurde."},
      {"Something has changed since version %1 was signed.",
       "Seit Fassung %1 unterschrieben wurde, hat sich etwas geändert."},
      {"impression of the report written", "Beurteilung des Berichts geschrieben"},
      {"modifiers of CAD-RADS set", "Zusätze zu CAD-RADS gesetzt"},
      {"word on features of plaque given", "Urteil über Merkmale von Plaque abgegeben"},
      {"report signed", "Bericht unterschrieben"},
  };
}

}  // namespace

std::vector<core::Phrase> german_of_parts() {
  std::vector<core::Phrase> all;
  for (const Phrases& some : {impression(), cad_rads(), high_risk(), standard_segments(), versions()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace ostia::session::report_words
