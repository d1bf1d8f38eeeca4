// The report in German, by its English: tables, steps and pictures. Places: see core/phrasebook.h.

#include "report/case_report_words.h"

namespace ostia::session::report_words {
namespace {

using Phrases = std::vector<core::Phrase>;

Phrases plaque() {
  return {
      {"Plaque", "Plaque"},
      {"No outer wall was found.", "Es wurde keine Außenwand gefunden."},
      {"Not measured: the image was not at hand.", "Nicht gemessen: das Bild lag nicht vor."},
      {"Class", "Klasse"},
      {"Low attenuation", "Niedrige Dichte"},
      {"Fibrofatty", "Fibrofettig"},
      {"Fibrous", "Fibrös"},
      {"Calcified", "Verkalkt"},
      {"Thin wall (mm\u00b3)", "Dünne Wand (mm\u00b3)"},
      {"Burden", "Last"},
      {"Remodelling index", "Remodeling-index"},
      {"Outer wall seen", "Außenwand sichtbar"},
      {"Between lumen and outer wall, by vessel and by stenosis",
       "Zwischen Lumen und Außenwand, je Gefäß und je Stenose"},
      {"non-calcified", "nicht verkalkt"},
      {"mixed", "gemischt"},
      {"calcified", "verkalkt"},
      {"Low attenuation: below %1 HU; fibrofatty: to %2 HU; fibrous: to %3 HU; calcified: above, after the "
       "blur of lumen and fat was taken away. A wall thinner than %4 mm, or thicker by less than %5 mm than "
       "a "
       "healthy one of that calibre, is wall and no plaque. Class: calcified from half of the plaque on, "
       "non-calcified below 5 %. Burden: plaque, of all within the outer wall. Remodelling index: vessel "
       "area "
       "at the throat over that at the places of reference. Where no fat borders on the wall it is not seen, "
       "and the outer wall is a bridge. All of this was found by the program.",
       "Niedrige Dichte: unter %1 HU; fibrofettig: bis %2 HU; fibrös: bis %3 HU; verkalkt: darüber, nachdem "
       "die "
       "Unschärfe von Lumen und Fett abgezogen wurde. Eine Wand dünner als %4 mm, oder um weniger als %5 mm "
       "dicker als eine gesunde dieses Kalibers, ist Wand und keine Plaque. Klasse: verkalkt ab der Hälfte "
       "der "
       "Plaque, nicht verkalkt unter 5 %. Last: Plaque, von allem innerhalb der Außenwand. Remodelingindex: "
       "Gefäßfläche an der Engstelle durch die an den Referenzstellen. Wo kein Fett an die Wand grenzt, ist "
       "sie nicht zu sehen, und die Außenwand ist eine Brücke. All das hat das Programm gefunden."},
      {"fat is seen beyond the wall on %1 % of the rays: elsewhere the outer wall is a bridge",
       "Fett ist jenseits der Wand auf %1 % der Strahlen zu sehen: anderswo ist die Außenwand eine Brücke"},
      {"%1: its outer wall was not looked for: %l2", "%1: die Außenwand wurde nicht gesucht: %l2"},
  };
}

Phrases tables() {
  return {
      {"Key images", "Schlüsselbilder"},
      {"Segments", "Segmente"},
      {"Mean diameter (mm)", "Mittlerer Durchmesser (mm)"},
      {"Least diameter (mm)", "Kleinster Durchmesser (mm)"},
      {"Least area (mm\u00b2)", "Kleinste Fläche (mm\u00b2)"},
      {"Volume (mm\u00b3)", "Volumen (mm\u00b3)"},
      {"Worst stenosis", "Schwerste Stenose"},
      {"Standard segments, AHA and SCCT numbers in brackets",
       "Standardsegmente, Nummern nach AHA und SCCT in Klammern"},
      {"Own length (mm)", "Eigene Länge (mm)"},
      {"Note", "Notiz"},
      {"What was checked, and what was noted", "Was geprüft und was notiert wurde"},
      {"Measurements", "Messungen"},
      {"None were placed.", "Es wurden keine gesetzt."},
      {"Kind", "Art"},
      {"Name", "Name"},
      {"Values", "Werte"},
      {"Measurements placed by a person", "Von Hand gesetzte Messungen"},
      {"distance", "Abstand"},
      {"angle", "Winkel"},
      {"area", "Fläche"},
      {"diameter", "Durchmesser"},
      {"stenosis", "Stenose"},
      {"volume", "Volumen"},
      {"HU in a ring", "HU im Ring"},
      {"arrow", "Pfeil"},
      {"note", "Notiz"},
      {"length: %1", "Länge: %1"},
      {"angle: %1", "Winkel: %1"},
      {"area: %1", "Fläche: %1"},
      {"diameter: %1", "Durchmesser: %1"},
      {"volume: %1", "Volumen: %1"},
      {"perimeter: %1", "Umfang: %1"},
      {"mean: %1", "Mittel: %1"},
      {"least: %1", "Minimum: %1"},
      {"largest: %1", "Maximum: %1"},
      {"samples: %1", "Proben: %1"},
      {"percent diameter: %1", "Prozent des Durchmessers: %1"},
      {"percent area: %1", "Prozent der Fläche: %1"},
      {"reference diameter: %1", "Referenzdurchmesser: %1"},
      {"reference area: %1", "Referenzfläche: %1"},
      {"mean area: %1", "mittlere Fläche: %1"},
      {"not measurable: its vessel was deleted", "nicht messbar: das Gefäß wurde gelöscht"},
      {"not measured: the image was not at hand", "nicht gemessen: das Bild lag nicht vor"},
      {"not measurable: %l1", "nicht messbar: %l1"},
      {"CT numbers about a lumen need the image", "CT-Werte um ein Lumen brauchen das Bild"},
      {"there is no lumen at %1 mm of vessel %2 to measure CT numbers about",
       "bei %1 mm von Gefäß %2 ist kein Lumen, um das sich CT-Werte messen ließen"},
      {"the ring at %1 mm of vessel %2 lies outside the image; choose a place that the image shows",
       "der Ring bei %1 mm von Gefäß %2 liegt außerhalb des Bildes; wählen Sie eine Stelle, die das Bild "
       "zeigt"},
      {"vessel %1 (deleted)", "Gefäß %1 (gelöscht)"},
  };
}

Phrases warnings() {
  return {
      {"%1 mm could not be measured, the wall does not close there",
       "%1 mm waren nicht messbar, dort ist die Wand nicht geschlossen"},
      {"%1: no name of a coronary artery; it counts for none of LM, LAD, LCX and RCA in the patient's "
       "category",
       "%1: nicht der Name einer Koronararterie; zählt in der Kategorie der Person für keines von LM, LAD, "
       "LCX "
       "und RCA"},
      {"the image was not at hand: key images show the model alone, CT numbers are not measured",
       "das Bild lag nicht vor: die Schlüsselbilder zeigen das Modell allein, CT-Werte sind nicht gemessen"},
  };
}

Phrases steps() {
  return {
      {"Edit log", "Protokoll der Bearbeitung"},
      {"Step", "Schritt"},
      {"What was done", "Was getan wurde"},
      {"Steps of the journal; what was undone is left out",
       "Schritte des Protokolls ohne das, was zurückgenommen wurde"},
      {"%t1 at %2 mm", "%t1 bei %2 mm"},
      {"case begun", "Fall begonnen"},
      {"wall drawn on a curved reformation", "Wand in einer CPR gezeichnet"},
      {"contour drawn on a cross-section", "Kontur in einem Querschnitt gezeichnet"},
      {"wall dragged", "Wand gezogen"},
      {"wall pushed with the brush", "Wand mit dem Pinsel verschoben"},
      {"centerline moved", "Mittellinie verschoben"},
      {"centerline point added", "Punkt der Mittellinie eingefügt"},
      {"centerline point deleted", "Punkt der Mittellinie gelöscht"},
      {"vessel extended", "Gefäß verlängert"},
      {"vessel trimmed", "Gefäß gekürzt"},
      {"vessel added", "Gefäß hinzugefügt"},
      {"vessel added: %1", "Gefäß hinzugefügt: %1"},
      {"vessel deleted", "Gefäß gelöscht"},
      {"vessel attached elsewhere", "Gefäß anderswo angesetzt"},
      {"vessel split", "Gefäß geteilt"},
      {"vessel joined with its parent", "Gefäß mit seinem Stammgefäß vereinigt"},
      {"vessel cut in two trees", "Gefäß in zwei Bäume getrennt"},
      {"vessel connected by a new piece", "Gefäß durch ein neues Stück verbunden"},
      {"vessel renamed: %1", "Gefäß umbenannt: %1"},
      {"edited by a plug-in: %1", "von einem Plug-in bearbeitet: %1"},
      {"vessel with an ostium of its own added: %1", "Gefäß mit eigenem Ostium hinzugefügt: %1"},
      {"measurement added: %t1", "Messung hinzugefügt: %t1"},
      {"measurement changed: %t1", "Messung geändert: %t1"},
      {"measurement deleted", "Messung gelöscht"},
      {"%t1 \"%2\"", "%t1 „%2“"},
      {"vessel's mark set: checked", "Gefäß markiert: geprüft"},
      {"vessel's mark set: not checked", "Gefäß markiert: nicht geprüft"},
      {"inputs of the computed pressures set", "Eingaben der berechneten Drücke gesetzt"},
      {"stretches with another calibre, for the computed pressures, set",
       "Strecken mit anderem Kaliber, für die berechneten Drücke, gesetzt"},
      {"the wall was stopped %1 before the axis at %2 places; a wall never passes its axis",
       "die Wand wurde an %2 Stellen %1 vor der Achse angehalten; eine Wand überschreitet nie ihre Achse"},
      {"the ball did not touch the wall; nothing changed",
       "die Kugel berührte die Wand nicht; nichts wurde geändert"},
      {"the wall was dragged nowhere; nothing changed",
       "die Wand wurde nirgendwohin gezogen; nichts wurde geändert"},
      {"the reach of %1 is shorter than one and a half times the wall's %2 between samples: the wall follows "
       "as smoothly as they allow",
       "die Reichweite von %1 ist kürzer als das Anderthalbfache des Abstands der Proben der Wand, %2: die "
       "Wand folgt so glatt, wie es diese erlauben"},
      {"%1 points of the stroke were nearer than %2 to their neighbours and were merged",
       "%1 Punkte des Strichs lagen näher als %2 an ihren Nachbarn und wurden vereinigt"},
      {"%1 points of the contour were nearer than %2 to their neighbours and were merged",
       "%1 Punkte der Kontur lagen näher als %2 an ihren Nachbarn und wurden vereinigt"},
  };
}

Phrases pictures() {
  return {
      {"The tree", "Der Gefäßbaum"},
      {"The tree, with stenoses ringed", "Der Gefäßbaum, Stenosen umringt"},
      {"from the front", "von vorn"},
      {"LAO 50, cranial 20", "LAO 50, kranial 20"},
      {"RAO 30, caudal 20", "RAO 30, kaudal 20"},
      {"from above", "von oben"},
      {"mm along the vessel", "mm entlang des Gefäßes"},
      {"lumen", "Lumen"},
      {"reference", "Referenz"},
      {"Diameter along the vessel", "Durchmesser entlang des Gefäßes"},
      {"leaves %1", "Abgang aus %1"},
      {"%1: straightened at %2\u00b0 and %3\u00b0 with the lumen's contour, diameter along the vessel",
       "%1: gestreckt bei %2° und %3° mit der Kontur des Lumens, Durchmesser entlang des Gefäßes"},
      {"%1: straightened at %2\u00b0 and %3\u00b0 with the lumen's contour, diameter along the vessel, and "
       "the "
       "cross-section at each throat",
       "%1: gestreckt bei %2° und %3° mit der Kontur des Lumens, Durchmesser entlang des Gefäßes und der "
       "Querschnitt an jeder Engstelle"},
      {"%1: straightened at %2\u00b0 and %3\u00b0 with the lumen's contour, diameter along the vessel, and "
       "the "
       "cross-sections at the %4 narrowest throats of %5",
       "%1: gestreckt bei %2° und %3° mit der Kontur des Lumens, Durchmesser entlang des Gefäßes und die "
       "Querschnitte an den %4 engsten von %5 Engstellen"},
  };
}

}  // namespace

std::vector<core::Phrase> german_of_tables() {
  std::vector<core::Phrase> all;
  for (const Phrases& some : {plaque(), tables(), warnings(), steps(), pictures()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace ostia::session::report_words
