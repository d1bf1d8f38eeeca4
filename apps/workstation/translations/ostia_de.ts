<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>ConnectMenu</name>
    <message>
        <source>Which vessel shall begin here?</source>
        <translation>Welches Gefäß soll hier beginnen?</translation>
    </message>
</context>
<context>
    <name>LesionTexts</name>
    <message>
        <source>not graded: not evaluable</source>
        <translation>nicht bewertet: nicht beurteilbar</translation>
    </message>
    <message>
        <source>not graded: limited</source>
        <translation>nicht bewertet: eingeschränkt</translation>
    </message>
    <message>
        <source>not graded: hardly an artery</source>
        <translation>nicht bewertet: wohl keine Arterie</translation>
    </message>
    <message>
        <source>not graded: not checked</source>
        <translation>nicht bewertet: nicht geprüft</translation>
    </message>
    <message>
        <source>A lesion has a grade where its stretch is evaluable, its vessel is Done, or you have accepted it.</source>
        <translation>Eine Läsion hat einen Grad, wo ihre Strecke beurteilbar ist, ihr Gefäß „Fertig“ ist oder Sie sie angenommen haben.</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>non-calcified</source>
        <translation>nicht verkalkt</translation>
    </message>
    <message>
        <source>mixed</source>
        <translation>gemischt</translation>
    </message>
    <message>
        <source>calcified</source>
        <translation>verkalkt</translation>
    </message>
    <message>
        <source>No.</source>
        <translation>Nr.</translation>
    </message>
    <message>
        <source>Segment</source>
        <translation>Segment</translation>
    </message>
    <message>
        <source>Grade</source>
        <translation>Grad</translation>
    </message>
    <message>
        <source>%</source>
        <translation>%</translation>
    </message>
    <message>
        <source>MLD</source>
        <translation>MLD</translation>
    </message>
    <message>
        <source>MLA</source>
        <translation>MLA</translation>
    </message>
    <message>
        <source>Length</source>
        <translation>Länge</translation>
    </message>
    <message>
        <source>Plaque</source>
        <translation>Plaque</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Klasse</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Comment</source>
        <translation>Kommentar</translation>
    </message>
    <message>
        <source>Lesion</source>
        <translation>Läsion</translation>
    </message>
    <message>
        <source>CAD-RADS of the lesion</source>
        <translation>CAD-RADS der Läsion</translation>
    </message>
    <message>
        <source>Diameter stenosis (%)</source>
        <translation>Einengung des Durchmessers (%)</translation>
    </message>
    <message>
        <source>Minimal lumen diameter (mm)</source>
        <translation>Kleinster Durchmesser des Lumens (mm)</translation>
    </message>
    <message>
        <source>Minimal lumen area (mm²)</source>
        <translation>Kleinste Fläche des Lumens (mm²)</translation>
    </message>
    <message>
        <source>Length (mm)</source>
        <translation>Länge (mm)</translation>
    </message>
    <message>
        <source>Plaque (mm³)</source>
        <translation>Plaque (mm³)</translation>
    </message>
    <message>
        <source>Class of the plaque</source>
        <translation>Art der Plaque</translation>
    </message>
    <message>
        <source>Evaluable</source>
        <translation>Beurteilbar</translation>
    </message>
    <message>
        <source>%1, narrowest at %2 mm</source>
        <translation>%1, am engsten bei %2 mm</translation>
    </message>
    <message>
        <source>%1, plaque about %2 mm</source>
        <translation>%1, Plaque um %2 mm</translation>
    </message>
    <message>
        <source>open</source>
        <translation>offen</translation>
    </message>
    <message>
        <source>accepted</source>
        <translation>angenommen</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>verworfen</translation>
    </message>
    <message>
        <source>FFR (research)</source>
        <translation>FFR (Forschung)</translation>
    </message>
    <message>
        <source>FFR behind it (computed, for research)</source>
        <translation>FFR dahinter (berechnet, für die Forschung)</translation>
    </message>
    <message>
        <source>Nothing flows there, or it has no sections.</source>
        <translation>Dort fließt nichts, oder es gibt keine Schnitte.</translation>
    </message>
    <message>
        <source>Computed, for research; read %1 mm behind it. The lesion takes %2 of it.</source>
        <translation>Berechnet, für die Forschung; %1 mm dahinter gelesen. Die Läsion nimmt davon %2.</translation>
    </message>
</context>
<context>
    <name>MeshPreview</name>
    <message>
        <source>least dihedral angle, °</source>
        <translation>kleinster Flächenwinkel, °</translation>
    </message>
    <message>
        <source>scaled Jacobian</source>
        <translation>skalierte Jacobi-Determinante</translation>
    </message>
    <message>
        <source>non-orthogonality, °</source>
        <translation>Nicht-Orthogonalität, °</translation>
    </message>
    <message>
        <source>skewness</source>
        <translation>Schiefe</translation>
    </message>
    <message>
        <source>edge length, mm</source>
        <translation>Kantenlänge, mm</translation>
    </message>
</context>
<context>
    <name>QApplication</name>
    <message>
        <source>The coronary modelling workstation.</source>
        <translation>Der Arbeitsplatz für Modelle der Herzkranzgefäße.</translation>
    </message>
    <message>
        <source>A case, an image, a DICOM folder, or a zip of one.</source>
        <translation>Ein Fall, ein Bild, ein DICOM-Ordner oder ein ZIP davon.</translation>
    </message>
    <message>
        <source>Where recent cases and window settings are kept.</source>
        <translation>Wo letzte Fälle und Einstellungen des Fensters aufbewahrt werden.</translation>
    </message>
    <message>
        <source>Writes the times of all frames, a JSON line each.</source>
        <translation>Schreibt die Zeiten aller Bilder auf, je eine JSON-Zeile.</translation>
    </message>
    <message>
        <source>Writes down each step of hand and keys, for --walk.</source>
        <translation>Schreibt jeden Schritt von Hand und Tasten auf, für --walk.</translation>
    </message>
    <message>
        <source>Walks through the window as the file says, and ends.</source>
        <translation>Geht durch das Fenster, wie die Datei es sagt, und endet.</translation>
    </message>
    <message>
        <source>Where the pictures and times of --walk go.</source>
        <translation>Wohin Bilder und Zeiten von --walk kommen.</translation>
    </message>
    <message>
        <source>Opens the sample case.</source>
        <translation>Öffnet den Beispielfall.</translation>
    </message>
    <message>
        <source>Starts without the tour, as OSTIA_NO_TOUR does.</source>
        <translation>Startet ohne Rundgang, ebenso wie OSTIA_NO_TOUR.</translation>
    </message>
</context>
<context>
    <name>QKeySequenceEdit</name>
    <message>
        <source>Press shortcut</source>
        <translation>Tasten drücken</translation>
    </message>
</context>
<context>
    <name>QPlatformTheme</name>
    <message>
        <source>OK</source>
        <translation>OK</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>&amp;Yes</source>
        <translation>&amp;Ja</translation>
    </message>
    <message>
        <source>&amp;No</source>
        <translation>&amp;Nein</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Anwenden</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>Zurücksetzen</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
</context>
<context>
    <name>QShortcut</name>
    <message>
        <source>Ctrl</source>
        <translation>Strg</translation>
    </message>
    <message>
        <source>Shift</source>
        <translation>Umschalt</translation>
    </message>
    <message>
        <source>Alt</source>
        <translation>Alt</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Space</source>
        <translation>Leertaste</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Auf</translation>
    </message>
    <message>
        <source>Down</source>
        <translation>Ab</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Links</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Home</source>
        <translation>Pos1</translation>
    </message>
    <message>
        <source>End</source>
        <translation>Ende</translation>
    </message>
    <message>
        <source>Ins</source>
        <translation>Einfg</translation>
    </message>
    <message>
        <source>Del</source>
        <translation>Entf</translation>
    </message>
    <message>
        <source>Tab</source>
        <translation>Tab</translation>
    </message>
</context>
<context>
    <name>fields</name>
    <message>
        <source>wall shear stress</source>
        <translation>Wandschubspannung</translation>
    </message>
    <message>
        <source>wall shear stress vector</source>
        <translation>Vektor der Wandschubspannung</translation>
    </message>
    <message>
        <source>pressure</source>
        <translation>Druck</translation>
    </message>
    <message>
        <source>velocity</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>time averaged wall shear stress</source>
        <translation>zeitlich gemittelte Wandschubspannung</translation>
    </message>
    <message>
        <source>oscillatory shear index</source>
        <translation>oszillatorischer Scherindex</translation>
    </message>
    <message>
        <source>relative residence time</source>
        <translation>relative Verweilzeit</translation>
    </message>
    <message>
        <source>%1 (magnitude)</source>
        <translation>%1 (Betrag)</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>nicht bekannt</translation>
    </message>
</context>
<context>
    <name>gestures</name>
    <message>
        <source>Plug-ins</source>
        <translation>Plug-ins</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>Edit</source>
        <translation>Bearbeiten</translation>
    </message>
    <message>
        <source>Lesions</source>
        <translation>Läsionen</translation>
    </message>
    <message>
        <source>Tools</source>
        <translation>Werkzeuge</translation>
    </message>
    <message>
        <source>Views</source>
        <translation>Ansichten</translation>
    </message>
    <message>
        <source>Grey levels</source>
        <translation>Graustufen</translation>
    </message>
    <message>
        <source>Panels</source>
        <translation>Felder</translation>
    </message>
    <message>
        <source>Mouse by keys</source>
        <translation>Maus mit Tasten</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Befund</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualität</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>2D views</source>
        <translation>2D-Ansichten</translation>
    </message>
    <message>
        <source>left button</source>
        <translation>linke Taste</translation>
    </message>
    <message>
        <source>what the tool says; browsing: the cursor goes there</source>
        <translation>wie das Werkzeug es will; beim Betrachten geht der Cursor dorthin</translation>
    </message>
    <message>
        <source>CPR, section, oblique slice</source>
        <translation>CPR, Querschnitt, schräge Schicht</translation>
    </message>
    <message>
        <source>Shift and left button, drag</source>
        <translation>Umschalt und linke Taste, ziehen</translation>
    </message>
    <message>
        <source>turn about the vessel&apos;s axis, or the slice</source>
        <translation>um die Gefäßachse drehen, oder die Schicht</translation>
    </message>
    <message>
        <source>right button, drag</source>
        <translation>rechte Taste, ziehen</translation>
    </message>
    <message>
        <source>window and level</source>
        <translation>Fensterung</translation>
    </message>
    <message>
        <source>middle button, drag; or Ctrl and Shift and left button</source>
        <translation>mittlere Taste, ziehen; oder Strg, Umschalt und linke Taste</translation>
    </message>
    <message>
        <source>move the picture</source>
        <translation>Bild verschieben</translation>
    </message>
    <message>
        <source>CPR, section</source>
        <translation>CPR, Querschnitt</translation>
    </message>
    <message>
        <source>wheel</source>
        <translation>Rad</translation>
    </message>
    <message>
        <source>the cursor goes along the vessel</source>
        <translation>der Cursor geht am Gefäß entlang</translation>
    </message>
    <message>
        <source>slice</source>
        <translation>Schichtbild</translation>
    </message>
    <message>
        <source>the next slices</source>
        <translation>die nächsten Schichten</translation>
    </message>
    <message>
        <source>Ctrl and wheel</source>
        <translation>Strg und Rad</translation>
    </message>
    <message>
        <source>zoom</source>
        <translation>vergrößern, verkleinern</translation>
    </message>
    <message>
        <source>2D views, editing</source>
        <translation>2D-Ansichten, Bearbeiten</translation>
    </message>
    <message>
        <source>Shift and wheel</source>
        <translation>Umschalt und Rad</translation>
    </message>
    <message>
        <source>the reach of a pull, the size of the ball</source>
        <translation>Reichweite des Zugs, Größe der Kugel</translation>
    </message>
    <message>
        <source>a handle, drag</source>
        <translation>Griff ziehen</translation>
    </message>
    <message>
        <source>move a measurement&apos;s point</source>
        <translation>Punkt einer Messung verschieben</translation>
    </message>
    <message>
        <source>2D views, centerline</source>
        <translation>2D-Ansichten, Mittellinie</translation>
    </message>
    <message>
        <source>double click</source>
        <translation>Doppelklick</translation>
    </message>
    <message>
        <source>another control point</source>
        <translation>weiterer Stützpunkt</translation>
    </message>
    <message>
        <source>key Delete</source>
        <translation>Taste Entf</translation>
    </message>
    <message>
        <source>the measurement or control point under the mouse goes</source>
        <translation>die Messung oder der Stützpunkt unter der Maus wird gelöscht</translation>
    </message>
    <message>
        <source>key Esc</source>
        <translation>Taste Esc</translation>
    </message>
    <message>
        <source>what is begun is dropped; then: browsing</source>
        <translation>Begonnenes wird verworfen; dann: Betrachten</translation>
    </message>
    <message>
        <source>keys Up, Down, Page</source>
        <translation>Tasten Auf, Ab, Bild</translation>
    </message>
    <message>
        <source>as the wheel, by one or ten steps</source>
        <translation>wie das Rad, um einen oder zehn Schritte</translation>
    </message>
    <message>
        <source>keys +, - and 0</source>
        <translation>Tasten +, - und 0</translation>
    </message>
    <message>
        <source>zoom, and all of it</source>
        <translation>vergrößern, verkleinern, alles zeigen</translation>
    </message>
    <message>
        <source>tree</source>
        <translation>Baum</translation>
    </message>
    <message>
        <source>left button, drag</source>
        <translation>linke Taste, ziehen</translation>
    </message>
    <message>
        <source>turn</source>
        <translation>drehen</translation>
    </message>
    <message>
        <source>middle button, or Shift, drag</source>
        <translation>mittlere Taste oder Umschalt, ziehen</translation>
    </message>
    <message>
        <source>move</source>
        <translation>verschieben</translation>
    </message>
    <message>
        <source>wheel, or right button, drag</source>
        <translation>Rad, oder rechte Taste, ziehen</translation>
    </message>
    <message>
        <source>click on a vessel</source>
        <translation>Klick auf ein Gefäß</translation>
    </message>
    <message>
        <source>this vessel, and the cursor goes there</source>
        <translation>dieses Gefäß; der Cursor geht dorthin</translation>
    </message>
    <message>
        <source>all of the tree</source>
        <translation>der ganze Baum</translation>
    </message>
    <message>
        <source>arrow keys, +, - and 0</source>
        <translation>Pfeiltasten, +, - und 0</translation>
    </message>
    <message>
        <source>turn, zoom, and all of it</source>
        <translation>drehen, vergrößern, verkleinern, alles zeigen</translation>
    </message>
    <message>
        <source>lumen profile</source>
        <translation>Lumenprofil</translation>
    </message>
    <message>
        <source>click, or drag</source>
        <translation>klicken oder ziehen</translation>
    </message>
    <message>
        <source>the cursor goes there</source>
        <translation>der Cursor geht dorthin</translation>
    </message>
    <message>
        <source>wheel, or keys Left and Right</source>
        <translation>Rad, oder Tasten Links und Rechts</translation>
    </message>
    <message>
        <source>panel&apos;s title</source>
        <translation>Titel eines Feldes</translation>
    </message>
    <message>
        <source>this panel alone, and back</source>
        <translation>dieses Feld allein, und zurück</translation>
    </message>
    <message>
        <source>vessel list</source>
        <translation>Gefäßliste</translation>
    </message>
    <message>
        <source>right click, or menu key</source>
        <translation>Rechtsklick oder Menütaste</translation>
    </message>
    <message>
        <source>keys F2, Space, Delete</source>
        <translation>Tasten F2, Leertaste, Entf</translation>
    </message>
    <message>
        <source>another name, tick, delete</source>
        <translation>anderer Name, Haken, löschen</translation>
    </message>
    <message>
        <source>Vessel</source>
        <translation>Gefäß</translation>
    </message>
    <message>
        <source>tree, measuring</source>
        <translation>Baum, Messen</translation>
    </message>
    <message>
        <source>place a measurement, or its next point, on the wall</source>
        <translation>eine Messung oder ihren nächsten Punkt auf die Wand setzen</translation>
    </message>
    <message>
        <source>a handle of the selected measurement, drag</source>
        <translation>Griff der gewählten Messung, ziehen</translation>
    </message>
    <message>
        <source>move it over the wall</source>
        <translation>ihn über die Wand bewegen</translation>
    </message>
    <message>
        <source>the measurement under the mouse goes, or the selected one</source>
        <translation>die Messung unter der Maus verschwindet, sonst die gewählte</translation>
    </message>
    <message>
        <source>rename, colour, cut off, split, cut, delete, join, connect</source>
        <translation>umbenennen, färben, abschneiden, teilen, durchtrennen, löschen, anschließen, verbinden</translation>
    </message>
    <message>
        <source>Vessel tree</source>
        <translation>Gefäßbaum</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Heart in 3D</source>
        <translation>Herz in 3D</translation>
    </message>
    <message>
        <source>three planes</source>
        <translation>drei Ebenen</translation>
    </message>
    <message>
        <source>a ring on a line, drag</source>
        <translation>ein Ring auf einer Linie, ziehen</translation>
    </message>
    <message>
        <source>turn the other two planes</source>
        <translation>die beiden anderen Ebenen drehen</translation>
    </message>
    <message>
        <source>a dot on a slab&apos;s border, drag; Shift and wheel</source>
        <translation>ein Punkt am Rand einer Schicht, ziehen; Umschalt und Mausrad</translation>
    </message>
    <message>
        <source>the thickness of the slab</source>
        <translation>die Dicke der Schicht</translation>
    </message>
    <message>
        <source>Pressure</source>
        <translation>Druck</translation>
    </message>
    <message>
        <source>Calcium score</source>
        <translation>Kalkscore</translation>
    </message>
    <message>
        <source>Compared with the last scan</source>
        <translation>Verglichen mit der letzten Aufnahme</translation>
    </message>
</context>
<context>
    <name>jobs</name>
    <message>
        <source>%1 is a surface without values. Open the wall.vtp of a result, which &quot;ostia result&quot; writes and which a run from the window leaves</source>
        <translation>%1 ist eine Oberfläche ohne Werte. Öffnen Sie die wall.vtp eines Ergebnisses, die &quot;ostia result&quot; schreibt und die ein Lauf aus dem Fenster hinterlässt</translation>
    </message>
    <message>
        <source>There is not enough memory for this case: use a coarser mesh.</source>
        <translation>Für diesen Fall reicht der Speicher nicht: ein gröberes Netz verwenden.</translation>
    </message>
    <message>
        <source>%1 holds no mesh.vtu</source>
        <translation>%1 enthält keine mesh.vtu</translation>
    </message>
    <message>
        <source>There is not enough memory for this: choose longer edges, or fewer vessels.</source>
        <translation>Dafür reicht der Speicher nicht: längere Kanten oder weniger Gefäße wählen.</translation>
    </message>
    <message>
        <source>%1 is no volume mesh. These are read: %2</source>
        <translation>%1 ist kein Volumennetz. Gelesen werden: %2</translation>
    </message>
</context>
<context>
    <name>library</name>
    <message>
        <source>no coronary artery was found where one should leave the aorta: the root may lie outside of the image, or the arteries hold too little contrast; draw a first vessel by its two ends</source>
        <translation>Wo eine Koronararterie aus der Aorta abgehen sollte, wurde keine gefunden: Die Wurzel liegt vielleicht außerhalb des Bildes, oder die Arterien enthalten zu wenig Kontrastmittel. Zeichnen Sie ein erstes Gefäß durch seine zwei Enden.</translation>
    </message>
    <message>
        <source>nothing that looks like an artery goes on from where one leaves the aorta; draw a first vessel by its two ends</source>
        <translation>Vom Abgang aus der Aorta führt nichts weiter, was wie eine Arterie aussieht. Zeichnen Sie ein erstes Gefäß durch seine zwei Enden.</translation>
    </message>
    <message>
        <source>what was found has %1 branches, more than coronary arteries show: the image is too noisy (a deviation of %2 HU in the aorta, in cubes of 1.5 mm) or veins and muscle are as bright as arteries; take a smoother reconstruction, or draw a first vessel by its two ends</source>
        <translation>Das Gefundene hat %1 Äste, mehr als Koronararterien zeigen: Das Bild rauscht zu sehr (Abweichung %2 HU in der Aorta, in Würfeln von 1.5 mm), oder Venen und Muskel sind so hell wie Arterien. Nehmen Sie eine glattere Rekonstruktion, oder zeichnen Sie ein erstes Gefäß durch seine zwei Enden.</translation>
    </message>
    <message>
        <source>no ascending aorta was found (an upright, evenly enhanced tube of %1 to %2 mm radius above %3 HU, at least %4 mm long): %t5; draw a first vessel by its two ends instead</source>
        <translation>Es wurde keine aufsteigende Aorta gefunden (ein aufrechtes, gleichmäßig kontrastiertes Rohr von %1 bis %2 mm Radius über %3 HU, mindestens %4 mm lang): %t5. Zeichnen Sie stattdessen ein erstes Gefäß durch seine zwei Enden.</translation>
    </message>
    <message>
        <source>%1 is %2; it is a number above 0</source>
        <translation>%1 ist %2; verlangt ist eine Zahl über 0</translation>
    </message>
    <message>
        <source>the diastolic pressure, %1 mmHg, is not below the systolic one, %2 mmHg</source>
        <translation>der diastolische Druck, %1 mmHg, ist nicht kleiner als der systolische, %2 mmHg</translation>
    </message>
    <message>
        <source>the venous pressure, %1 mmHg, is not below the mean aortic one, %2 mmHg</source>
        <translation>der venöse Druck, %1 mmHg, ist nicht kleiner als der mittlere Aortendruck, %2 mmHg</translation>
    </message>
    <message>
        <source>no outlet of the tree has a diameter; its share of the flow is not known</source>
        <translation>kein Ende des Baums hat einen Durchmesser; sein Anteil am Fluss ist nicht bekannt</translation>
    </message>
    <message>
        <source>no root of the tree has a diameter; its flow is not known</source>
        <translation>kein Anfang des Baums hat einen Durchmesser; sein Fluss ist nicht bekannt</translation>
    </message>
    <message>
        <source>no upright tube of contrast is there</source>
        <translation>es gibt kein aufrechtes Rohr mit Kontrastmittel</translation>
    </message>
    <message>
        <source>the longest upright tube has a radius of %1 mm and %2 HU and is not even enough</source>
        <translation>das längste aufrechte Rohr hat einen Radius von %1 mm und %2 HU und ist nicht gleichmäßig genug</translation>
    </message>
    <message>
        <source>the longest upright tube has a radius of %1 mm and %2 HU, and lung behind it as the descending aorta has</source>
        <translation>das längste aufrechte Rohr hat einen Radius von %1 mm und %2 HU und Lunge hinter sich wie die absteigende Aorta</translation>
    </message>
    <message>
        <source>no branch of the coronary tree could be followed: %l1</source>
        <translation>Kein Ast des Koronarbaums ließ sich verfolgen: %l1</translation>
    </message>
    <message>
        <source>the image is too small to hold the root of the aorta: %1 voxels, %2 mm along one of its axes; %3 mm and %4 voxels are needed</source>
        <translation>Das Bild ist zu klein für die Wurzel der Aorta: %1 Voxel, %2 mm entlang einer seiner Achsen; nötig sind %3 mm und %4 Voxel.</translation>
    </message>
    <message>
        <source>voxels of %1 mm are wider than coronary arteries, which are 2 to 4 mm wide (at most %2 mm can be used); take a series with thinner slices, or draw a first vessel by its two ends where you see one</source>
        <translation>Voxel von %1 mm sind breiter als Koronararterien mit ihren 2 bis 4 mm (höchstens %2 mm sind brauchbar). Nehmen Sie eine Serie mit dünneren Schichten, oder zeichnen Sie ein erstes Gefäß durch seine zwei Enden, wo Sie eines sehen.</translation>
    </message>
    <message>
        <source>voxels of %1 mm are wider than coronary arteries, which are 2 to 4 mm wide (at most %2 mm can be used); take a series with thinner slices, or draw a first vessel by its two ends where you see one; %l3</source>
        <translation>Voxel von %1 mm sind breiter als Koronararterien mit ihren 2 bis 4 mm (höchstens %2 mm sind brauchbar). Nehmen Sie eine Serie mit dünneren Schichten, oder zeichnen Sie ein erstes Gefäß durch seine zwei Enden, wo Sie eines sehen. %l3</translation>
    </message>
    <message>
        <source>the image is empty: every voxel is %1; take another image</source>
        <translation>Das Bild ist leer: Jedes Voxel ist %1. Nehmen Sie ein anderes Bild.</translation>
    </message>
    <message>
        <source>the image is noise: places %1 mm apart have nothing in common (correlation %2); take another reconstruction</source>
        <translation>Das Bild ist Rauschen: Stellen im Abstand von %1 mm haben nichts gemein (Korrelation %2). Nehmen Sie eine andere Rekonstruktion.</translation>
    </message>
    <message>
        <source>the intensities lie from %1 to %2 only, these are no CT numbers (in HU fat is about -100, blood with contrast agent 250 to 600): the image may have been scaled; convert it back to HU</source>
        <translation>Die Werte liegen nur von %1 bis %2, das sind keine CT-Werte (in HU liegt Fett bei etwa -100, Blut mit Kontrastmittel bei 250 bis 600): Das Bild wurde vielleicht umskaliert. Rechnen Sie es in HU zurück.</translation>
    </message>
    <message>
        <source>the intensities lie from %1 to %2, far beyond CT numbers (in HU fat is about -100, blood with contrast agent 250 to 600): the image may have been scaled; convert it back to HU</source>
        <translation>Die Werte liegen von %1 bis %2, weit außerhalb von CT-Werten (in HU liegt Fett bei etwa -100, Blut mit Kontrastmittel bei 250 bis 600): Das Bild wurde vielleicht umskaliert. Rechnen Sie es in HU zurück.</translation>
    </message>
    <message>
        <source>nothing in the image is darker than %1, so these are no CT numbers (in HU fat is about -100, blood with contrast agent 250 to 600): it may be a picture of 256 grey levels; convert it to HU</source>
        <translation>Nichts im Bild ist dunkler als %1, es sind also keine CT-Werte (in HU liegt Fett bei etwa -100, Blut mit Kontrastmittel bei 250 bis 600): Vielleicht ist es ein Bild mit 256 Graustufen. Rechnen Sie es in HU um.</translation>
    </message>
    <message>
        <source>nothing in the image is darker than %1, so these are no CT numbers (in HU fat is about -100, blood with contrast agent 250 to 600): 1024 may not have been subtracted (the rescale intercept); convert it to HU</source>
        <translation>Nichts im Bild ist dunkler als %1, es sind also keine CT-Werte (in HU liegt Fett bei etwa -100, Blut mit Kontrastmittel bei 250 bis 600): Vielleicht wurden 1024 nicht abgezogen (Rescale Intercept). Rechnen Sie es in HU um.</translation>
    </message>
    <message>
        <source>the image is darker than a CT in HU can be (nothing in it is brighter than %1): 1024 may have been subtracted twice, or the image scaled; convert it to HU</source>
        <translation>Das Bild ist dunkler, als ein CT in HU sein kann (nichts darin ist heller als %1): Vielleicht wurden 1024 zweimal abgezogen oder das Bild umskaliert. Rechnen Sie es in HU um.</translation>
    </message>
    <message>
        <source>the image is darker than a CT in HU can be (%1 % lie below air, -1000): 1024 may have been subtracted twice, or the image scaled; convert it to HU</source>
        <translation>Das Bild ist dunkler, als ein CT in HU sein kann (%1 % liegen unter Luft, -1000): Vielleicht wurden 1024 zweimal abgezogen oder das Bild umskaliert. Rechnen Sie es in HU um.</translation>
    </message>
    <message>
        <source>nothing in the image is darker than %1, though %2 % of it is as dark as lung may be: lungs have -700 to -900 HU and air -1000, so the image may have been scaled; convert it back to HU</source>
        <translation>Nichts im Bild ist dunkler als %1, obwohl %2 % davon so dunkel wie Lunge sind: Lungen haben -700 bis -900 HU und Luft -1000, das Bild wurde also vielleicht umskaliert. Rechnen Sie es in HU zurück.</translation>
    </message>
    <message>
        <source>the image shows no chest: it holds hardly any lung (%1 % of %2 mm), as abdomen, head or legs do; take an image of the heart, or draw a first vessel by its two ends where you see one</source>
        <translation>Das Bild zeigt keinen Thorax: Es enthält kaum Lunge (%1 % von %2 mm), wie Bauch, Kopf oder Beine. Nehmen Sie ein Bild des Herzens, oder zeichnen Sie ein erstes Gefäß durch seine zwei Enden, wo Sie eines sehen.</translation>
    </message>
    <message>
        <source>there is no contrast along the way between the two places (%1 HU); click into the vessel&apos;s lumen at both ends</source>
        <translation>Auf dem Weg zwischen den beiden Stellen ist kein Kontrastmittel (%1 HU). Klicken Sie an beiden Enden in das Lumen des Gefäßes.</translation>
    </message>
    <message>
        <source>the two places are too near to each other for a vessel; choose them farther apart</source>
        <translation>Die beiden Stellen liegen für ein Gefäß zu nahe beieinander. Wählen Sie sie weiter auseinander.</translation>
    </message>
    <message>
        <source>the way runs for %1 mm through something wider than a coronary artery, an aorta or a chamber</source>
        <translation>Der Weg führt über %1 mm durch etwas, das weiter als eine Koronararterie ist, eine Aorta oder Kammer.</translation>
    </message>
    <message>
        <source>the way runs for %1 mm through something wider than a coronary artery, an aorta or a chamber; click a place in the vessel itself that is nearer, or the ostium first</source>
        <translation>Der Weg führt über %1 mm durch etwas, das weiter als eine Koronararterie ist, eine Aorta oder Kammer. Klicken Sie eine nähere Stelle im Gefäß selbst an, oder zuerst das Ostium.</translation>
    </message>
    <message>
        <source>both ends of the way, %1 and %2 mm, lie in air: click in the contrast-filled lumen</source>
        <translation>Beide Enden des Weges, %1 und %2 mm, liegen in Luft: Klicken Sie in das kontrastgefüllte Lumen.</translation>
    </message>
    <message>
        <source>the two ends of the way, %1 and %2 mm, are one place: click them further apart</source>
        <translation>Die beiden Enden des Weges, %1 und %2 mm, sind eine Stelle: Klicken Sie weiter auseinander.</translation>
    </message>
    <message>
        <source>the click %1 mm lies inside vessel &apos;%2&apos;, which is in the tree already: click the distal end of one that is not</source>
        <translation>Der Klick bei %1 mm liegt im Gefäß „%2“, das schon im Baum ist: Klicken Sie das distale Ende eines Gefäßes an, das noch fehlt.</translation>
    </message>
    <message>
        <source>the click was moved by %1 mm onto the lumen</source>
        <translation>Der Klick wurde um %1 mm auf das Lumen gerückt</translation>
    </message>
    <message>
        <source>%1: its branches go, too: %2</source>
        <translation>%1: Die Äste gehen mit: %2</translation>
    </message>
    <message>
        <source>%1: what leaves it beyond the cut goes, too: %2</source>
        <translation>%1: Was jenseits des Schnitts abgeht, geht mit: %2</translation>
    </message>
    <message>
        <source>%1: no vessel would be left; the last one stays</source>
        <translation>%1: Kein Gefäß bliebe übrig; das letzte bleibt</translation>
    </message>
    <message>
        <source>the ball did not touch the wall; nothing changed</source>
        <translation>die Kugel berührte die Wand nicht; nichts wurde geändert</translation>
    </message>
    <message>
        <source>the wall was dragged nowhere; nothing changed</source>
        <translation>die Wand wurde nirgendwohin gezogen; nichts wurde geändert</translation>
    </message>
    <message>
        <source>the wall was stopped %1 before the axis at %2 places; a wall never passes its axis</source>
        <translation>die Wand wurde an %2 Stellen %1 vor der Achse angehalten; eine Wand überschreitet nie ihre Achse</translation>
    </message>
    <message>
        <source>the reach of %1 is shorter than one and a half times the wall&apos;s %2 between samples: the wall follows as smoothly as they allow</source>
        <translation>die Reichweite von %1 ist kürzer als das Anderthalbfache des Abstands der Proben der Wand, %2: die Wand folgt so glatt, wie es diese erlauben</translation>
    </message>
    <message>
        <source>the pull on %1 starts %2 from the vessel&apos;s wall; take hold of the wall itself</source>
        <translation>%1: Der Zug beginnt %2 neben der Gefäßwand; fassen Sie die Wand selbst</translation>
    </message>
    <message>
        <source>the pull on %1 moves the wall by more than %2; drag it in steps</source>
        <translation>%1: Der Zug versetzt die Wand um mehr als %2; ziehen Sie sie in Schritten</translation>
    </message>
    <message>
        <source>the pull on %1 ends %2 from the axis; keep the wall at least %3 away, or move the axis first</source>
        <translation>%1: Der Zug endet %2 neben der Achse; lassen Sie der Wand mindestens %3 Abstand, oder versetzen Sie erst die Achse</translation>
    </message>
    <message>
        <source>the line on %1 comes within %2 of the axis at %3 along the vessel; draw each side of the wall by itself</source>
        <translation>%1: Die Linie kommt der Achse bei %3 längs des Gefäßes näher als %2; zeichnen Sie jede Seite der Wand für sich</translation>
    </message>
    <message>
        <source>the line on %1 crosses the axis near %2 along the vessel; draw each side of the wall by itself</source>
        <translation>%1: Die Linie kreuzt die Achse bei %2 längs des Gefäßes; zeichnen Sie jede Seite der Wand für sich</translation>
    </message>
    <message>
        <source>the line on %1 crosses itself near %2 along the vessel; draw it without a loop</source>
        <translation>%1: Die Linie kreuzt sich selbst bei %2 längs des Gefäßes; zeichnen Sie sie ohne Schleife</translation>
    </message>
    <message>
        <source>the line on %1 runs back along the vessel at %2; draw it in one direction</source>
        <translation>%1: Die Linie läuft bei %2 längs des Gefäßes zurück; zeichnen Sie sie in einer Richtung</translation>
    </message>
    <message>
        <source>its branches are shorter on average than the least radius: are radii and places in different units? `ostia convert --units m --radius-units mm` settles it</source>
        <translation>Seine Äste sind im Mittel kürzer als der kleinste Radius: Haben Radien und Orte verschiedene Einheiten? `ostia convert --units m --radius-units mm` bringt es in Ordnung.</translation>
    </message>
    <message>
        <source>no way from %1 mm to %t2: %l3</source>
        <translation>Kein Weg von %1 mm zu %t2: %l3</translation>
    </message>
    <message>
        <source>the front has covered the image</source>
        <translation>die Front hat das ganze Bild bedeckt</translation>
    </message>
    <message>
        <source>cannot open the case %1: %l2</source>
        <translation>Der Fall %1 lässt sich nicht öffnen: %l2</translation>
    </message>
    <message>
        <source>its format %1 is newer than this program&apos;s (%2, Ostia %3); open it with Ostia %4 or newer</source>
        <translation>Sein Format %1 ist neuer als das dieses Programms (%2, Ostia %3). Öffnen Sie ihn mit Ostia %4 oder einer neueren Version.</translation>
    </message>
    <message>
        <source>its format %1 is newer than this program&apos;s (%2, Ostia %3); open it with Ostia of a newer version</source>
        <translation>Sein Format %1 ist neuer als das dieses Programms (%2, Ostia %3). Öffnen Sie ihn mit einer neueren Version von Ostia.</translation>
    </message>
    <message>
        <source>the file is empty; take a copy of it from a backup</source>
        <translation>Die Datei ist leer. Nehmen Sie eine Kopie aus einer Sicherung.</translation>
    </message>
    <message>
        <source>it is not a case of Ostia; cases are made by `ostia lumen --case`</source>
        <translation>Es ist kein Fall von Ostia; Fälle macht `ostia lumen --case`.</translation>
    </message>
    <message>
        <source>it is a database of another program, not a case of Ostia</source>
        <translation>Es ist die Datenbank eines anderen Programms, kein Fall von Ostia.</translation>
    </message>
    <message>
        <source>the file is truncated to %1 bytes</source>
        <translation>Die Datei ist auf %1 Bytes gekürzt.</translation>
    </message>
    <message>
        <source>the file is truncated: it has %1 of %2 bytes; take a copy of it from a backup</source>
        <translation>Die Datei ist gekürzt: Sie hat %1 von %2 Bytes. Nehmen Sie eine Kopie aus einer Sicherung.</translation>
    </message>
    <message>
        <source>the file is damaged (%1); take a copy of it from a backup</source>
        <translation>Die Datei ist beschädigt (%1). Nehmen Sie eine Kopie aus einer Sicherung.</translation>
    </message>
    <message>
        <source>its tables are not those of a case; the file is damaged or was made by another program</source>
        <translation>Seine Tabellen sind nicht die eines Falls; die Datei ist beschädigt oder von einem anderen Programm.</translation>
    </message>
    <message>
        <source>it is open in another window or program; close it there, or wait until it is done</source>
        <translation>Er ist in einem anderen Fenster oder Programm offen. Schließen Sie ihn dort, oder warten Sie, bis es fertig ist.</translation>
    </message>
    <message>
        <source>it is open in another window of this program; close it there</source>
        <translation>Er ist in einem anderen Fenster dieses Programms offen. Schließen Sie ihn dort.</translation>
    </message>
    <message>
        <source>cannot write the case %1: the disk is full; the case is what it was before. Make room and try again</source>
        <translation>Der Fall %1 lässt sich nicht schreiben: Der Datenträger ist voll; der Fall ist, wie er vorher war. Schaffen Sie Platz und versuchen Sie es wieder.</translation>
    </message>
    <message>
        <source>%1 is no CT image: open an angiogram</source>
        <translation>%1 ist kein CT-Bild: Öffnen Sie ein Angiogramm.</translation>
    </message>
    <message>
        <source>cannot read %1: %l2</source>
        <translation>%1 lässt sich nicht lesen: %l2</translation>
    </message>
    <message>
        <source>there is no such file or folder</source>
        <translation>Es gibt keine solche Datei und keinen solchen Ordner.</translation>
    </message>
    <message>
        <source>it is neither a file nor a folder</source>
        <translation>Es ist weder Datei noch Ordner.</translation>
    </message>
    <message>
        <source>it is no DICOM folder, file or zip, no image (.nrrd .nhdr .mhd .mha .nii .nii.gz) and no surface (.stl .ply .obj .vtp .vtk)</source>
        <translation>Es ist kein DICOM-Ordner, keine DICOM-Datei und kein Zip davon, kein Bild (.nrrd .nhdr .mhd .mha .nii .nii.gz) und keine Oberfläche (.stl .ply .obj .vtp .vtk).</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is not a DICOM file</source>
        <translation>„%1“ ist keine DICOM-Datei.</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is DICOM, but holds no image</source>
        <translation>„%1“ ist DICOM, enthält aber kein Bild.</translation>
    </message>
    <message>
        <source>&apos;%1&apos; is damaged: %l2</source>
        <translation>„%1“ ist beschädigt: %l2</translation>
    </message>
    <message>
        <source>&apos;%1&apos; does not exist</source>
        <translation>„%1“ gibt es nicht.</translation>
    </message>
    <message>
        <source>&apos;%1&apos; of the series is gone; open its folder again</source>
        <translation>„%1“ aus der Serie ist nicht mehr da. Öffnen Sie den Ordner noch einmal.</translation>
    </message>
    <message>
        <source>the files of DICOM series %1 have changed; open their folder again</source>
        <translation>Die Dateien der DICOM-Serie %1 haben sich geändert. Öffnen Sie den Ordner noch einmal.</translation>
    </message>
    <message>
        <source>no ascending aorta was found (an upright, evenly enhanced tube of %1 to %2 mm radius above %3 HU, at least %4 mm long): %t5; draw a first vessel by its two ends instead; %l6</source>
        <translation>Es wurde keine aufsteigende Aorta gefunden (ein aufrechtes, gleichmäßig kontrastiertes Rohr von %1 bis %2 mm Radius über %3 HU, mindestens %4 mm lang): %t5. Zeichnen Sie stattdessen ein erstes Gefäß durch seine zwei Enden. %l6</translation>
    </message>
    <message>
        <source>the brightest even region of %1 ml has %2, as blood without contrast agent: take the angiogram of this patient</source>
        <translation>Der hellste gleichmäßige Bereich von %1 ml hat %2, wie Blut ohne Kontrastmittel: Nehmen Sie das Angiogramm.</translation>
    </message>
    <message>
        <source>contrast is there (%1): the top of the heart may be cut off, or the image may be turned; look at its orientation</source>
        <translation>Kontrastmittel ist da (%1): Vielleicht fehlt der obere Teil des Herzens, oder das Bild ist gedreht. Prüfen Sie seine Orientierung.</translation>
    </message>
    <message>
        <source>the heart&apos;s chambers lie %1 mm above the middle of the aorta that was found, not below it: the image ends above the aortic root, stands on its head, or has its slices in the wrong order; take an image of the whole heart, set its orientation right, or draw a first vessel by its two ends</source>
        <translation>Die Herzkammern liegen %1 mm über der Mitte der gefundenen Aorta, nicht darunter: Das Bild endet über der Aortenwurzel, steht auf dem Kopf oder hat seine Schichten in falscher Reihenfolge. Nehmen Sie ein Bild des ganzen Herzens, berichtigen Sie seine Orientierung, oder zeichnen Sie ein erstes Gefäß durch seine zwei Enden.</translation>
    </message>
    <message>
        <source>%l1; besides, %l2</source>
        <translation>%l1 Außerdem: %l2</translation>
    </message>
    <message>
        <source>the lungs lie in front and behind, not at the sides: x and y may be exchanged, or the image be turned by 90 degrees; no vessel was given a name; look at the image&apos;s orientation first</source>
        <translation>Die Lungen liegen vorn und hinten statt an den Seiten: Vielleicht sind x und y vertauscht, oder das Bild ist um 90 Grad gedreht. Kein Gefäß hat einen Namen bekommen. Prüfen Sie zuerst die Orientierung des Bildes.</translation>
    </message>
    <message>
        <source>voxels of %1 mm are wide for coronary arteries: those below 2 mm are missed, and names and radii are less sure</source>
        <translation>Voxel von %1 mm sind breit für Koronararterien: Solche unter 2 mm fehlen, und Namen und Radien sind weniger sicher.</translation>
    </message>
    <message>
        <source>%1 ml of metal (above %2 HU): look at each vessel that passes near it, its shadows may cut or fake vessels</source>
        <translation>%1 ml Metall (über %2 HU): Prüfen Sie jedes Gefäß, das nahe daran verläuft; seine Schatten können Gefäße abschneiden oder vortäuschen.</translation>
    </message>
    <message>
        <source>some contrast agent may be in the blood: a fifth of the heart is brighter than %1 HU, and blood without contrast agent has 30 to 60; look at each lesion</source>
        <translation>im Blut kann Kontrastmittel sein: Ein Fünftel des Herzens ist heller als %1 HU, und Blut ohne Kontrastmittel hat 30 bis 60; jede Läsion ansehen</translation>
    </message>
    <message>
        <source>calcium score: the blood has contrast agent (a fifth of the heart is brighter than %1 HU, and blood without contrast agent has 30 to 60), which counts as calcium from 130 HU on; take the scan without contrast agent</source>
        <translation>Kalkscore: Im Blut ist Kontrastmittel (ein Fünftel des Herzens ist heller als %1 HU, und Blut ohne Kontrastmittel hat 30 bis 60), das von 130 HU an als Kalk zählt; die Aufnahme ohne Kontrastmittel nehmen</translation>
    </message>
    <message>
        <source>a part of %1 ml on the heart, about %2 mm, is taken for no coronary calcium and not scored; look whether some of it is</source>
        <translation>ein Teil von %1 ml am Herzen, um %2 mm, gilt nicht als Koronarkalk und zählt nicht; nachsehen, ob etwas davon es ist</translation>
    </message>
    <message>
        <source>no heart was found, so no place could be proposed: no lesion counts until a person has said where it lies</source>
        <translation>es wurde kein Herz gefunden und darum kein Ort vorgeschlagen: Keine Läsion zählt, bis ein Mensch gesagt hat, wo sie liegt</translation>
    </message>
    <message>
        <source>the slices lie %1 mm apart, and the Agatston score is defined for %2 mm: %3 of them were averaged to one of %4 mm</source>
        <translation>die Schichten liegen %1 mm auseinander, und der Agatston-Score ist für %2 mm definiert: Je %3 wurden zu einer von %4 mm gemittelt</translation>
    </message>
    <message>
        <source>the slices lie %1 mm apart, and the Agatston score is defined for %2 mm: %3 of them were averaged to one of %4 mm, and a slice&apos;s score is multiplied by %5</source>
        <translation>die Schichten liegen %1 mm auseinander, und der Agatston-Score ist für %2 mm definiert: Je %3 wurden zu einer von %4 mm gemittelt, und der Score einer Schicht wird mit %5 multipliziert</translation>
    </message>
    <message>
        <source>the slices lie %1 mm apart, and the Agatston score is defined for %2 mm: a slice&apos;s score is multiplied by %3</source>
        <translation>die Schichten liegen %1 mm auseinander, und der Agatston-Score ist für %2 mm definiert: Der Score einer Schicht wird mit %3 multipliziert</translation>
    </message>
    <message>
        <source>no vessel is named %1</source>
        <translation>kein Gefäß heißt %1</translation>
    </message>
    <message>
        <source>%1: less than 5 mm of its range were measured</source>
        <translation>%1: Weniger als 5 mm des Bereichs wurden gemessen</translation>
    </message>
    <message>
        <source>%1: %2 of %3 mm were measured</source>
        <translation>%1: %2 von %3 mm wurden gemessen</translation>
    </message>
    <message>
        <source>%1: no fat was found that is clear of edges</source>
        <translation>%1: Es wurde kein Fett gefunden, das frei von Rändern ist</translation>
    </message>
    <message>
        <source>the tube voltage is not known: fat is darker at less than 120 kV (by about a quarter at 80), and bounds of studies hold for theirs</source>
        <translation>die Röhrenspannung ist nicht bekannt: Unter 120 kV ist Fett dunkler (bei 80 um etwa ein Viertel), und Grenzen aus Studien gelten für deren Spannung</translation>
    </message>
    <message>
        <source>the scan was taken at %1 kV: compare its values with those of other voltages only as estimated at 120 kV</source>
        <translation>aufgenommen mit %1 kV: Werte mit denen anderer Spannungen nur so vergleichen, wie sie für 120 kV geschätzt sind</translation>
    </message>
    <message>
        <source>hardly one patient: %l1</source>
        <translation>kaum ein Patient: %l1</translation>
    </message>
    <message>
        <source>one of the trees is mirrored: as they are their axes are %1 mm apart, mirrored %2 mm</source>
        <translation>einer der Bäume ist gespiegelt: so, wie sie sind, liegen ihre Achsen %1 mm auseinander, gespiegelt %2 mm</translation>
    </message>
    <message>
        <source>the axes of the vessels with the same names are %1 mm apart when the trees lie on each other as well as they can (one patient&apos;s: up to %2 mm)</source>
        <translation>die Achsen der Gefäße gleichen Namens liegen %1 mm auseinander, wenn die Bäume so gut wie möglich aufeinander liegen (bei einem Patienten: bis %2 mm)</translation>
    </message>
    <message>
        <source>half of the ostia and forks with the same names are %1 mm or more apart when the trees lie on each other as well as they can (one patient&apos;s: up to %2 mm)</source>
        <translation>die Hälfte der Ostien und Gabelungen gleichen Namens liegt %1 mm oder mehr auseinander, wenn die Bäume so gut wie möglich aufeinander liegen (bei einem Patienten: bis %2 mm)</translation>
    </message>
    <message>
        <source>only %1 % of the shorter tree runs beside the other (one patient&apos;s: %2 % or more)</source>
        <translation>nur %1 % des kürzeren Baums laufen neben dem anderen (bei einem Patienten: %2 % oder mehr)</translation>
    </message>
    <message>
        <source>no vessel has the same name in both trees, so that nothing says how they lie to each other; name the vessels (RCA, LAD, LCX, ...) in both</source>
        <translation>kein Gefäß heißt in beiden Bäumen gleich, so dass nichts sagt, wie sie zueinander liegen; benennen Sie die Gefäße (RCA, LAD, LCX, ...) in beiden</translation>
    </message>
    <message>
        <source>%1 is not compared: less than half of it is in both trees</source>
        <translation>%1 wird nicht verglichen: weniger als die Hälfte davon ist in beiden Bäumen</translation>
    </message>
    <message>
        <source>%1 is in the former tree alone</source>
        <translation>%1 ist nur im früheren Baum</translation>
    </message>
    <message>
        <source>%1 is in the later tree alone</source>
        <translation>%1 ist nur im späteren Baum</translation>
    </message>
    <message>
        <source>the former scan: %l1</source>
        <translation>die frühere Aufnahme: %l1</translation>
    </message>
    <message>
        <source>the later scan: %l1</source>
        <translation>die spätere Aufnahme: %l1</translation>
    </message>
    <message>
        <source>%1: %2 mm could not be measured, the wall does not close there</source>
        <translation>%1: %2 mm konnten nicht vermessen werden, dort schließt sich die Wand nicht</translation>
    </message>
    <message>
        <source>plaque is not compared: the image of the former case was not at hand</source>
        <translation>Plaque wird nicht verglichen: das Bild des früheren Falls war nicht zur Hand</translation>
    </message>
    <message>
        <source>plaque is not compared: the image of the later case was not at hand</source>
        <translation>Plaque wird nicht verglichen: das Bild des späteren Falls war nicht zur Hand</translation>
    </message>
    <message>
        <source>the scans were taken at %1 and %2 kV: classes of plaque and the fat&apos;s CT number change with that alone</source>
        <translation>die Aufnahmen wurden mit %1 und %2 kV gemacht: schon damit ändern sich die Klassen der Plaque und die CT-Zahl des Fetts</translation>
    </message>
    <message>
        <source>no repeatability was given: differences are told, and none of them is called a change</source>
        <translation>keine Wiederholbarkeit ist bekannt: Unterschiede werden genannt, und keiner davon heißt eine Veränderung</translation>
    </message>
    <message>
        <source>the former case has no vessels; choose one with a coronary tree</source>
        <translation>der frühere Fall hat keine Gefäße; wählen Sie einen mit einem Koronarbaum</translation>
    </message>
    <message>
        <source>the series of the former image is not in its folder any more</source>
        <translation>die Serie des früheren Bildes ist nicht mehr in ihrem Ordner</translation>
    </message>
    <message>
        <source>what was chosen is another image than that of the former case</source>
        <translation>gewählt wurde ein anderes Bild als das des früheren Falls</translation>
    </message>
</context>
<context>
    <name>manual</name>
    <message>
        <source>Beginning</source>
        <translation>Anfang</translation>
    </message>
    <message>
        <source>From DICOM to a report</source>
        <translation>Von DICOM zum Befund</translation>
    </message>
    <message>
        <source>The window</source>
        <translation>Das Fenster</translation>
    </message>
    <message>
        <source>Editing the lumen</source>
        <translation>Das Lumen bearbeiten</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Report and export</source>
        <translation>Befund und Export</translation>
    </message>
    <message>
        <source>For researchers</source>
        <translation>Für die Forschung</translation>
    </message>
    <message>
        <source>Quality mode</source>
        <translation>Qualitätsmodus</translation>
    </message>
    <message>
        <source>Keys and mouse</source>
        <translation>Tasten und Maus</translation>
    </message>
    <message>
        <source>When something is wrong</source>
        <translation>Wenn etwas nicht stimmt</translation>
    </message>
    <message>
        <source>PACS</source>
        <translation>PACS</translation>
    </message>
    <message>
        <source>Calcium score</source>
        <translation>Kalkscore</translation>
    </message>
    <message>
        <source>Fat around the arteries</source>
        <translation>Fett um die Arterien</translation>
    </message>
    <message>
        <source>Compared with the last scan</source>
        <translation>Verglichen mit der letzten Aufnahme</translation>
    </message>
</context>
<context>
    <name>measures</name>
    <message>
        <source>arrow</source>
        <translation>Pfeil</translation>
    </message>
    <message>
        <source>note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>diameter</source>
        <translation>Durchmesser</translation>
    </message>
    <message>
        <source>stenosis</source>
        <translation>Stenose</translation>
    </message>
    <message>
        <source>volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>ring_hu</source>
        <translation>HU-Ring</translation>
    </message>
    <message>
        <source>length</source>
        <translation>Länge</translation>
    </message>
    <message>
        <source>perimeter</source>
        <translation>Umfang</translation>
    </message>
    <message>
        <source>percent diameter</source>
        <translation>Durchmesserstenose</translation>
    </message>
    <message>
        <source>percent area</source>
        <translation>Flächenstenose</translation>
    </message>
    <message>
        <source>MLD</source>
        <translation>MLD</translation>
    </message>
    <message>
        <source>MLA</source>
        <translation>MLA</translation>
    </message>
    <message>
        <source>reference diameter</source>
        <translation>Referenzdurchmesser</translation>
    </message>
    <message>
        <source>reference area</source>
        <translation>Referenzfläche</translation>
    </message>
    <message>
        <source>mean area</source>
        <translation>mittlere Fläche</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>Mittelwert</translation>
    </message>
    <message>
        <source>SD</source>
        <translation>SD</translation>
    </message>
    <message>
        <source>least</source>
        <translation>kleinster Wert</translation>
    </message>
    <message>
        <source>largest</source>
        <translation>größter Wert</translation>
    </message>
    <message>
        <source>samples</source>
        <translation>Messwerte</translation>
    </message>
</context>
<context>
    <name>open_file</name>
    <message>
        <source>This computer has no program that opens it. It is at %1.</source>
        <translation>Dieser Rechner hat kein Programm, das das öffnet. Es liegt hier: %1</translation>
    </message>
    <message>
        <source>%1 cannot be opened</source>
        <translation>%1 lässt sich nicht öffnen</translation>
    </message>
</context>
<context>
    <name>opengl</name>
    <message>
        <source>The library libX11.so.6 is not installed.</source>
        <translation>Die Bibliothek libX11.so.6 ist nicht installiert.</translation>
    </message>
    <message>
        <source>The library libGL.so.1 is not installed.</source>
        <translation>Die Bibliothek libGL.so.1 ist nicht installiert.</translation>
    </message>
    <message>
        <source>The installed OpenGL library has no GLX.</source>
        <translation>Der installierten OpenGL-Bibliothek fehlt GLX.</translation>
    </message>
    <message>
        <source>The display offers no OpenGL.</source>
        <translation>Der Bildschirm bietet kein OpenGL.</translation>
    </message>
    <message>
        <source>The display&apos;s OpenGL is older than 3.0.</source>
        <translation>Das OpenGL des Bildschirms ist älter als 3.0.</translation>
    </message>
    <message>
        <source>The display&apos;s OpenGL is older than 3.2.</source>
        <translation>Das OpenGL des Bildschirms ist älter als 3.2.</translation>
    </message>
    <message>
        <source>The graphics driver does not answer.</source>
        <translation>Der Grafiktreiber antwortet nicht.</translation>
    </message>
    <message>
        <source>The graphics driver failed when it was asked for a window.</source>
        <translation>Der Grafiktreiber versagte, als er um ein Fenster gebeten wurde.</translation>
    </message>
    <message>
        <source>Ostia&apos;s window needs OpenGL 3.2: update the graphics driver, or draw without the graphics card (install Mesa&apos;s software renderer, package libgl1-mesa-dri, and start with LIBGL_ALWAYS_SOFTWARE=1). The command line program ostia needs no display.</source>
        <translation>Das Fenster von Ostia braucht OpenGL 3.2: Erneuern Sie den Grafiktreiber, oder lassen Sie ohne die Grafikkarte zeichnen (Mesas Software-Renderer installieren, Paket libgl1-mesa-dri, und mit LIBGL_ALWAYS_SOFTWARE=1 starten). Das Befehlszeilenprogramm ostia braucht keinen Bildschirm.</translation>
    </message>
    <message>
        <source>The workstation cannot start</source>
        <translation>Der Arbeitsplatz kann nicht starten</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::AboutDialog</name>
    <message>
        <source>&lt;p&gt;It is built with Qt %1 (LGPL-3), VTK %2 (BSD-3), CGAL (GPL-3 and LGPL-3), TetGen (AGPL-3, in the worker), CHOLMOD (GPL-2 or later), GDCM (BSD-3, in the worker), SQLite (public domain), Eigen (MPL-2), TBB, Embree and OpenSSL (Apache-2.0), Cairo and Pango (LGPL-2.1), libzip and ISA-L (BSD-3), zlib, spdlog, fmt, nlohmann-json and nanoflann.&lt;/p&gt;</source>
        <translation>&lt;p&gt;Gebaut mit Qt %1 (LGPL-3), VTK %2 (BSD-3), CGAL (GPL-3 und LGPL-3), TetGen (AGPL-3, im Hilfsprogramm), CHOLMOD (GPL-2 oder später), GDCM (BSD-3, im Hilfsprogramm), SQLite (gemeinfrei), Eigen (MPL-2), TBB, Embree und OpenSSL (Apache-2.0), Cairo und Pango (LGPL-2.1), libzip und ISA-L (BSD-3), zlib, spdlog, fmt, nlohmann-json und nanoflann.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>About Ostia</source>
        <translation>Über Ostia</translation>
    </message>
    <message>
        <source>&lt;h2&gt;Ostia %1&lt;/h2&gt;&lt;p&gt;The coronary modelling workstation.&lt;/p&gt;</source>
        <translation>&lt;h2&gt;Ostia %1&lt;/h2&gt;&lt;p&gt;Der Arbeitsplatz für Modelle der Herzkranzgefäße.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>&lt;p&gt;&lt;b&gt;Research software, not a medical device.&lt;/b&gt; It has no approval of any authority. Nothing that it shows or measures may be the ground of a diagnosis or a treatment.&lt;/p&gt;</source>
        <translation>&lt;p&gt;&lt;b&gt;Forschungssoftware, kein Medizinprodukt.&lt;/b&gt; Sie ist von keiner Behörde zugelassen. Nichts, was sie zeigt oder misst, darf Grundlage einer Diagnose oder Behandlung sein.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>&lt;p&gt;Ostia&apos;s own sources are under the Apache License 2.0. The program as it is built and handed on contains libraries under stricter licences and is as a whole under the GNU Affero General Public License 3 (AGPL-3): whoever gets it has a right to all of its sources.&lt;/p&gt;</source>
        <translation>&lt;p&gt;Ostias eigene Quellen stehen unter der Apache-Lizenz 2.0. Das Programm, wie es gebaut und weitergegeben wird, enthält Bibliotheken unter strengeren Lizenzen und steht als Ganzes unter der GNU Affero General Public License 3 (AGPL-3): wer es bekommt, hat ein Recht auf alle seine Quellen.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>&lt;p&gt;The editing of the lumen follows Wels et al., which is the subject of the patent application EP 16170187.5; look into its state before commercial use. Details: docs/licences.md.&lt;/p&gt;</source>
        <translation>&lt;p&gt;Das Bearbeiten des Lumens folgt Wels et al.; das Verfahren ist Gegenstand der Patentanmeldung EP 16170187.5. Prüfen Sie deren Stand vor gewerblicher Nutzung. Näheres: docs/licences.md.&lt;/p&gt;</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::AlongWidget</name>
    <message>
        <source>Diameter along the vessel, before and now</source>
        <translation>Durchmesser entlang des Gefäßes, früher und jetzt</translation>
    </message>
    <message>
        <source>This vessel is in one of the scans alone.</source>
        <translation>Dieses Gefäß ist nur in einer der Aufnahmen.</translation>
    </message>
    <message>
        <source>One of the scans shows no lumen here.</source>
        <translation>Eine der Aufnahmen zeigt hier kein Lumen.</translation>
    </message>
    <message>
        <source>%1 mm: diameter %2 mm before, %3 mm now, difference %4 mm</source>
        <translation>%1 mm: Durchmesser früher %2 mm, jetzt %3 mm, Unterschied %4 mm</translation>
    </message>
    <message>
        <source> (smallest real difference %1 mm)</source>
        <translation> (kleinster echter Unterschied %1 mm)</translation>
    </message>
    <message>
        <source>now</source>
        <translation>jetzt</translation>
    </message>
    <message>
        <source>before</source>
        <translation>früher</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ArchiveDialog</name>
    <message>
        <source>From the PACS</source>
        <translation>Aus dem PACS</translation>
    </message>
    <message>
        <source>&amp;Search</source>
        <translation>&amp;Suchen</translation>
    </message>
    <message>
        <source>Studies and series</source>
        <translation>Studien und Serien</translation>
    </message>
    <message>
        <source>Patient, series</source>
        <translation>Patient, Serie</translation>
    </message>
    <message>
        <source>Date</source>
        <translation>Datum</translation>
    </message>
    <message>
        <source>Description</source>
        <translation>Beschreibung</translation>
    </message>
    <message>
        <source>Modality</source>
        <translation>Modalität</translation>
    </message>
    <message>
        <source>Images</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>Server</source>
        <translation>Server</translation>
    </message>
    <message>
        <source>Password or token</source>
        <translation>Passwort oder Token</translation>
    </message>
    <message>
        <source>&amp;Keep it in the desktop&apos;s keyring</source>
        <translation>Im Schlüsselbund des Desktops &amp;behalten</translation>
    </message>
    <message>
        <source>Patient&apos;s name</source>
        <translation>Name des Patienten</translation>
    </message>
    <message>
        <source>DOE^J*</source>
        <translation>MUSTER^M*</translation>
    </message>
    <message>
        <source>Patient&apos;s ID</source>
        <translation>Kennung des Patienten</translation>
    </message>
    <message>
        <source>From day</source>
        <translation>Ab Tag</translation>
    </message>
    <message>
        <source>To day</source>
        <translation>Bis Tag</translation>
    </message>
    <message>
        <source>Days, from and to</source>
        <translation>Tage, von und bis</translation>
    </message>
    <message>
        <source>Searching…</source>
        <translation>Suche…</translation>
    </message>
    <message>
        <source>Searching in the PACS</source>
        <translation>Suche im PACS</translation>
    </message>
    <message>
        <source>There are more: ask for less.</source>
        <translation>Es gibt mehr: Grenzen Sie die Suche ein.</translation>
    </message>
    <message>
        <source>Looking for series</source>
        <translation>Suche nach Serien</translation>
    </message>
    <message>
        <source>Series %1</source>
        <translation>Serie %1</translation>
    </message>
    <message>
        <source>Fetching the series</source>
        <translation>Serie wird geholt</translation>
    </message>
    <message>
        <source>The series did not come</source>
        <translation>Die Serie kam nicht an</translation>
    </message>
    <message numerus="yes">
        <source>%n study(ies)</source>
        <translation>
            <numerusform>%n Studie</numerusform>
            <numerusform>%n Studien</numerusform>
        </translation>
    </message>
    <message>
        <source>Pictures of the series</source>
        <translation>Bilder der Serien</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::BeatingCase</name>
    <message>
        <source>Phase of the heart</source>
        <translation>Herzphase</translation>
    </message>
    <message>
        <source>Open a motion</source>
        <translation>Bewegung öffnen</translation>
    </message>
    <message>
        <source>Motions (*.json);;All files (*)</source>
        <translation>Bewegungen (*.json);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Reading the motion</source>
        <translation>Bewegung wird gelesen</translation>
    </message>
    <message>
        <source>The motion cannot be opened</source>
        <translation>Die Bewegung kann nicht geöffnet werden</translation>
    </message>
    <message>
        <source>Folder with the images of the phases</source>
        <translation>Ordner mit den Bildern der Phasen</translation>
    </message>
    <message>
        <source>Looking for the phases</source>
        <translation>Phasen werden gesucht</translation>
    </message>
    <message>
        <source>The images of the phases cannot be opened</source>
        <translation>Die Bilder der Phasen können nicht geöffnet werden</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Calcium</name>
    <message>
        <source>The image is still being read.</source>
        <translation>Das Bild wird noch gelesen.</translation>
    </message>
    <message>
        <source>Open this image by itself: it is not known which file it is of.</source>
        <translation>Dieses Bild für sich öffnen: Es ist nicht bekannt, aus welcher Datei es ist.</translation>
    </message>
    <message>
        <source>Calcium score</source>
        <translation>Kalkscore</translation>
    </message>
    <message>
        <source>There is no calcium score</source>
        <translation>Es gibt keinen Kalkscore</translation>
    </message>
    <message>
        <source>No scan has been scored.</source>
        <translation>Noch keine Aufnahme ist ausgewertet.</translation>
    </message>
    <message>
        <source>No case is open whose report could take it.</source>
        <translation>Es ist kein Fall offen, dessen Bericht ihn nehmen könnte.</translation>
    </message>
    <message>
        <source>The case that is open is of another patient than the scan.</source>
        <translation>Der offene Fall ist von einem anderen Patienten als die Aufnahme.</translation>
    </message>
    <message>
        <source>The report says an Agatston score of %1.</source>
        <translation>Der Bericht nennt einen Agatston-Score von %1.</translation>
    </message>
    <message>
        <source>Where the calcium score&apos;s folder is made</source>
        <translation>Wo der Ordner des Kalkscores entsteht</translation>
    </message>
    <message>
        <source>The calcium score is in %1.</source>
        <translation>Der Kalkscore ist in %1.</translation>
    </message>
    <message>
        <source>The calcium score was not written</source>
        <translation>Der Kalkscore wurde nicht geschrieben</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::CalciumPage</name>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>minimal (1 to 10)</source>
        <translation>minimal (1 bis 10)</translation>
    </message>
    <message>
        <source>mild (11 to 100)</source>
        <translation>gering (11 bis 100)</translation>
    </message>
    <message>
        <source>moderate (101 to 400)</source>
        <translation>mäßig (101 bis 400)</translation>
    </message>
    <message>
        <source>severe (above 400)</source>
        <translation>schwer (über 400)</translation>
    </message>
    <message>
        <source>aorta</source>
        <translation>Aorta</translation>
    </message>
    <message>
        <source>valve</source>
        <translation>Klappe</translation>
    </message>
    <message>
        <source>bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>other</source>
        <translation>anderes</translation>
    </message>
    <message>
        <source>Calcium score</source>
        <translation>Kalkscore</translation>
    </message>
    <message>
        <source>Calcium by artery</source>
        <translation>Kalk nach Arterie</translation>
    </message>
    <message>
        <source>Artery</source>
        <translation>Arterie</translation>
    </message>
    <message>
        <source>Agatston</source>
        <translation>Agatston</translation>
    </message>
    <message>
        <source>mm³</source>
        <translation>mm³</translation>
    </message>
    <message>
        <source>mg</source>
        <translation>mg</translation>
    </message>
    <message>
        <source>Lesions of calcium</source>
        <translation>Kalkläsionen</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>Ort</translation>
    </message>
    <message>
        <source>Peak HU</source>
        <translation>Höchste HU</translation>
    </message>
    <message>
        <source>Sure</source>
        <translation>Sicher</translation>
    </message>
    <message>
        <source>Click: slices go to the lesion. A click on it in a slice chooses it here. Sure: how much the place that the program proposes can be trusted.</source>
        <translation>Klick: Die Schichten gehen zur Läsion. Ein Klick auf sie in einer Schicht wählt sie hier. Sicher: wie weit dem Ort zu trauen ist, den das Programm vorschlägt.</translation>
    </message>
    <message>
        <source>&amp;Bones and what else is bright, too</source>
        <translation>Auch &amp;Knochen und was sonst hell ist</translation>
    </message>
    <message>
        <source>Calibration for the mass</source>
        <translation>Kalibrierung für die Masse</translation>
    </message>
    <message>
        <source>mg of hydroxyapatite in 1 cm³ for each HU, of this scanner and protocol, from a phantom.</source>
        <translation>mg Hydroxylapatit in 1 cm³ je HU, für dieses Gerät und Protokoll, aus einem Phantom.</translation>
    </message>
    <message>
        <source>The scan is being scored…</source>
        <translation>Die Aufnahme wird ausgewertet…</translation>
    </message>
    <message>
        <source>No score yet</source>
        <translation>Noch kein Score</translation>
    </message>
    <message>
        <source>Open a CT without contrast agent, and choose Vessel &gt; Calcium score.</source>
        <translation>Ein CT ohne Kontrastmittel öffnen und Gefäß &gt; Kalkscore wählen.</translation>
    </message>
    <message>
        <source>Agatston %1: %2. CAC-DRS %3</source>
        <translation>Agatston %1: %2. CAC-DRS %3</translation>
    </message>
    <message>
        <source>Tube voltage %1 kV; the threshold of %2 HU is for 120 kV.</source>
        <translation>Röhrenspannung %1 kV; die Schwelle von %2 HU gilt für 120 kV.</translation>
    </message>
    <message>
        <source>Places are proposals until you have looked at the lesions.</source>
        <translation>Orte sind Vorschläge, bis ein Mensch die Läsionen angesehen hat.</translation>
    </message>
    <message>
        <source>The image that is shown is another one.</source>
        <translation>Das Bild, das gezeigt wird, ist ein anderes.</translation>
    </message>
    <message>
        <source>Total</source>
        <translation>Summe</translation>
    </message>
    <message>
        <source>reader</source>
        <translation>Befunder</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Command</name>
    <message>
        <source>&amp;Look for plug-ins again</source>
        <translation>Plug-ins neu &amp;suchen</translation>
    </message>
    <message>
        <source>Reads the scripts in the folders of plug-ins, and says which are none.</source>
        <translation>Liest die Skripte in den Ordnern der Plug-ins und sagt, welche keine sind.</translation>
    </message>
    <message>
        <source>&amp;Open the folder of plug-ins</source>
        <translation>&amp;Ordner der Plug-ins öffnen</translation>
    </message>
    <message>
        <source>Python scripts in it become commands of this menu.</source>
        <translation>Python-Skripte darin werden Befehle dieses Menüs.</translation>
    </message>
    <message>
        <source>None yet</source>
        <translation>Noch keine</translation>
    </message>
    <message>
        <source>%1 in a window of its own</source>
        <translation>%1 in eigenem Fenster</translation>
    </message>
    <message>
        <source>On another monitor, say; again, or closing it, puts it back.</source>
        <translation>Etwa auf einem anderen Monitor; noch einmal, oder Schließen, holt es zurück.</translation>
    </message>
    <message>
        <source>Arrow</source>
        <translation>Pfeil</translation>
    </message>
    <message>
        <source>Drag from what it points at to where its text is to stand.</source>
        <translation>Von dem, worauf er zeigt, dorthin ziehen, wo sein Text stehen soll.</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Click a place, and type what is to stand beside it.</source>
        <translation>Auf eine Stelle klicken und tippen, was daneben stehen soll.</translation>
    </message>
    <message>
        <source>The cursor is in no lesion of the table.</source>
        <translation>Der Cursor ist in keiner Läsion der Tabelle.</translation>
    </message>
    <message>
        <source>No other lesion in this direction.</source>
        <translation>Keine weitere Läsion in dieser Richtung.</translation>
    </message>
    <message>
        <source>Next lesion</source>
        <translation>Nächste Läsion</translation>
    </message>
    <message>
        <source>All views go to the narrowest place of the next lesion of the table, as it is sorted and filtered.</source>
        <translation>Alle Ansichten gehen zur engsten Stelle der nächsten Läsion der Tabelle, wie sie sortiert und gefiltert ist.</translation>
    </message>
    <message>
        <source>Previous lesion</source>
        <translation>Vorige Läsion</translation>
    </message>
    <message>
        <source>All views go to the narrowest place of the lesion before it in the table.</source>
        <translation>Alle Ansichten gehen zur engsten Stelle der Läsion davor in der Tabelle.</translation>
    </message>
    <message>
        <source>This case has no probabilities: its vessels were not found by the program.</source>
        <translation>Dieser Fall hat keine Wahrscheinlichkeiten: Das Programm hat seine Gefäße nicht gefunden.</translation>
    </message>
    <message>
        <source>No place of this case is doubtful.</source>
        <translation>Keine Stelle dieses Falls ist zweifelhaft.</translation>
    </message>
    <message>
        <source>No other doubtful place in this direction.</source>
        <translation>Keine weitere zweifelhafte Stelle in dieser Richtung.</translation>
    </message>
    <message>
        <source>Doubtful place %1 of %2: %3, %4, probability %5</source>
        <translation>Zweifelhafte Stelle %1 von %2: %3, %4, Wahrscheinlichkeit %5</translation>
    </message>
    <message>
        <source>Next doubtful place</source>
        <translation>Nächste zweifelhafte Stelle</translation>
    </message>
    <message>
        <source>All views go to the place that the program is least sure of, then to the next in the order of doubt.</source>
        <translation>Alle Ansichten gehen zur Stelle, deren das Programm am wenigsten sicher ist, dann zur nächsten in der Reihenfolge des Zweifels.</translation>
    </message>
    <message>
        <source>Previous doubtful place</source>
        <translation>Vorige zweifelhafte Stelle</translation>
    </message>
    <message>
        <source>All views go back to the doubtful place before it.</source>
        <translation>Alle Ansichten gehen zur zweifelhaften Stelle davor zurück.</translation>
    </message>
    <message>
        <source>&amp;Accept the lesion</source>
        <translation>Läsion &amp;annehmen</translation>
    </message>
    <message>
        <source>The lesion at the cursor is one: it is graded, as if its vessel were checked.</source>
        <translation>Die Läsion am Cursor ist eine: Sie wird gewertet, als wäre ihr Gefäß geprüft.</translation>
    </message>
    <message>
        <source>&amp;Reject the lesion</source>
        <translation>Läsion ver&amp;werfen</translation>
    </message>
    <message>
        <source>The lesion at the cursor is none: the report lists it as rejected and does not grade it.</source>
        <translation>Die Läsion am Cursor ist keine: Der Bericht führt sie als verworfen und wertet sie nicht.</translation>
    </message>
    <message>
        <source>Leave the lesion &amp;open</source>
        <translation>Läsion &amp;offen lassen</translation>
    </message>
    <message>
        <source>Takes back what was said of the lesion at the cursor.</source>
        <translation>Nimmt zurück, was von der Läsion am Cursor gesagt wurde.</translation>
    </message>
    <message>
        <source>&amp;Comment the lesion</source>
        <translation>Läsion &amp;kommentieren</translation>
    </message>
    <message>
        <source>Types a comment on the lesion at the cursor; it is in the report.</source>
        <translation>Ein Kommentar zur Läsion am Cursor wird getippt; er steht im Bericht.</translation>
    </message>
    <message>
        <source>Copy the &amp;table of lesions</source>
        <translation>&amp;Tabelle der Läsionen kopieren</translation>
    </message>
    <message>
        <source>The rows that are shown, as text with tabs between the cells.</source>
        <translation>Die Zeilen, die gezeigt werden, als Text mit Tabulatoren zwischen den Zellen.</translation>
    </message>
    <message>
        <source>The table of lesions was copied as text.</source>
        <translation>Die Tabelle der Läsionen ist als Text kopiert.</translation>
    </message>
    <message>
        <source>Lesions</source>
        <translation>Läsionen</translation>
    </message>
    <message>
        <source>Add artery</source>
        <translation>Arterie hinzufügen</translation>
    </message>
    <message>
        <source>Click an artery&apos;s ostium, then its distal end: it begins a tree of its own.</source>
        <translation>Auf das Ostium einer Arterie klicken, dann auf ihr distales Ende: sie beginnt einen eigenen Baum.</translation>
    </message>
    <message>
        <source>Judge: &amp;evaluable</source>
        <translation>Urteil: &amp;beurteilbar</translation>
    </message>
    <message>
        <source>Judge: &amp;limited</source>
        <translation>Urteil: &amp;eingeschränkt</translation>
    </message>
    <message>
        <source>Judge: &amp;not evaluable</source>
        <translation>Urteil: &amp;nicht beurteilbar</translation>
    </message>
    <message>
        <source>Judge: as the &amp;program finds it</source>
        <translation>Urteil: wie das &amp;Programm es findet</translation>
    </message>
    <message>
        <source>The stretch of the chosen measurement along the vessel or, without one, the stretch at the cursor.</source>
        <translation>Die Strecke der gewählten Messung längs des Gefäßes oder, ohne eine solche, die Strecke am Cursor.</translation>
    </message>
    <message>
        <source>Evaluability</source>
        <translation>Beurteilbarkeit</translation>
    </message>
    <message>
        <source>Marks beside CPRs and in the profile where the image shows a vessel in part, or not at all.</source>
        <translation>Zeigt neben den CPRs und im Profil, wo das Bild ein Gefäß nur zum Teil oder gar nicht zeigt.</translation>
    </message>
    <message>
        <source>Next panel</source>
        <translation>Nächstes Feld</translation>
    </message>
    <message>
        <source>The keyboard goes to the next panel.</source>
        <translation>Die Tastatur geht zum nächsten Feld.</translation>
    </message>
    <message>
        <source>Previous panel</source>
        <translation>Voriges Feld</translation>
    </message>
    <message>
        <source>The keyboard goes to the previous panel.</source>
        <translation>Die Tastatur geht zum vorigen Feld.</translation>
    </message>
    <message>
        <source>This panel alone</source>
        <translation>Dieses Feld allein</translation>
    </message>
    <message>
        <source>The panel with the keyboard fills the window; again: all panels.</source>
        <translation>Das Feld mit der Tastatur füllt das Fenster; nochmals: alle Felder.</translation>
    </message>
    <message>
        <source>Vessels</source>
        <translation>Gefäße</translation>
    </message>
    <message>
        <source>CPR</source>
        <translation>CPR</translation>
    </message>
    <message>
        <source>CPR + 90°</source>
        <translation>CPR + 90°</translation>
    </message>
    <message>
        <source>Cross-section</source>
        <translation>Querschnitt</translation>
    </message>
    <message>
        <source>Slice</source>
        <translation>Schichtbild</translation>
    </message>
    <message>
        <source>Coronary tree</source>
        <translation>Koronarbaum</translation>
    </message>
    <message>
        <source>Lumen profile</source>
        <translation>Lumenprofil</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>Pointer to the left</source>
        <translation>Zeiger nach links</translation>
    </message>
    <message>
        <source>Moves the mouse pointer by one pixel; held down, faster.</source>
        <translation>Bewegt den Mauszeiger um einen Bildpunkt; gehalten schneller.</translation>
    </message>
    <message>
        <source>Pointer to the right</source>
        <translation>Zeiger nach rechts</translation>
    </message>
    <message>
        <source>Pointer up</source>
        <translation>Zeiger nach oben</translation>
    </message>
    <message>
        <source>Pointer down</source>
        <translation>Zeiger nach unten</translation>
    </message>
    <message>
        <source>Press or let go</source>
        <translation>Drücken oder loslassen</translation>
    </message>
    <message>
        <source>Presses the main mouse button and holds it; again: lets it go.</source>
        <translation>Drückt die Maustaste und hält sie; nochmals: lässt sie los.</translation>
    </message>
    <message>
        <source>No case is open.</source>
        <translation>Es ist kein Fall geöffnet.</translation>
    </message>
    <message>
        <source>A &amp;flow case…</source>
        <translation>Ein &amp;Strömungsfall…</translation>
    </message>
    <message>
        <source>Writes a case of blood flow in a mesh for a solver, and runs it.</source>
        <translation>Schreibt einen Fall der Blutströmung in einem Netz für einen Löser und rechnet ihn.</translation>
    </message>
    <message>
        <source>Open flow res&amp;ults…</source>
        <translation>Ström&amp;ungsergebnisse öffnen…</translation>
    </message>
    <message>
        <source>Colours the wall in 3D by a solver&apos;s result, such as its shear stress.</source>
        <translation>Färbt die Wand in 3D nach dem Ergebnis eines Lösers, etwa der Schubspannung.</translation>
    </message>
    <message>
        <source>&amp;Find a command…</source>
        <translation>Be&amp;fehl suchen…</translation>
    </message>
    <message>
        <source>Type what you want to do; shows the command, its key and its menu, and runs it.</source>
        <translation>Tippen, was man tun will: zeigt den Befehl, seine Taste und sein Menü und führt ihn aus.</translation>
    </message>
    <message>
        <source>&amp;Manual</source>
        <translation>&amp;Handbuch</translation>
    </message>
    <message>
        <source>The user&apos;s manual; needs no network.</source>
        <translation>Das Handbuch; braucht kein Netz.</translation>
    </message>
    <message>
        <source>&amp;Keys and mouse</source>
        <translation>&amp;Tasten und Maus</translation>
    </message>
    <message>
        <source>All keys and mouse gestures, to be searched.</source>
        <translation>Alle Tasten und Mausgesten, mit Suche.</translation>
    </message>
    <message>
        <source>&amp;Tour</source>
        <translation>&amp;Rundgang</translation>
    </message>
    <message>
        <source>Goes through the parts of the window.</source>
        <translation>Geht durch die Teile des Fensters.</translation>
    </message>
    <message>
        <source>&amp;About Ostia</source>
        <translation>Ü&amp;ber Ostia</translation>
    </message>
    <message>
        <source>Version, licences, and what the program is not.</source>
        <translation>Version, Lizenzen, und was das Programm nicht ist.</translation>
    </message>
    <message>
        <source>&amp;Report (PDF, HTML, tables)</source>
        <translation>&amp;Befund (PDF, HTML, Tabellen)</translation>
    </message>
    <message>
        <source>Makes the report of the case as it is now, in a folder beside it.</source>
        <translation>Erstellt den Befund des Falls, wie er jetzt ist, in einem Ordner daneben.</translation>
    </message>
    <message>
        <source>&amp;Pin this view to the report</source>
        <translation>Diese Ansicht an den Befund an&amp;heften</translation>
    </message>
    <message>
        <source>The view that was clicked last becomes a key image of the next report.</source>
        <translation>Die zuletzt angeklickte Ansicht wird ein Schlüsselbild des nächsten Befunds.</translation>
    </message>
    <message>
        <source>The &amp;centerlines…</source>
        <translation>Die &amp;Mittellinien…</translation>
    </message>
    <message>
        <source>Writes the centerlines with their radii (VTP).</source>
        <translation>Schreibt die Mittellinien mit ihren Radien (VTP).</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Drag from one place to the other.</source>
        <translation>Von einer Stelle zur anderen ziehen.</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Click three places, the vertex second.</source>
        <translation>Drei Stellen anklicken, den Scheitel als zweite.</translation>
    </message>
    <message>
        <source>Area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Draw around it.</source>
        <translation>Umfahren.</translation>
    </message>
    <message>
        <source>Diameter</source>
        <translation>Durchmesser</translation>
    </message>
    <message>
        <source>Drag across the lumen.</source>
        <translation>Quer über das Lumen ziehen.</translation>
    </message>
    <message>
        <source>Stenosis</source>
        <translation>Stenose</translation>
    </message>
    <message>
        <source>On a CPR, drag from the proximal to the distal place of reference.</source>
        <translation>Auf einer CPR von der proximalen zur distalen Referenzstelle ziehen.</translation>
    </message>
    <message>
        <source>Volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>On a CPR, drag along the stretch of the vessel.</source>
        <translation>Auf einer CPR am Abschnitt des Gefäßes entlang ziehen.</translation>
    </message>
    <message>
        <source>HU ring</source>
        <translation>HU-Ring</translation>
    </message>
    <message>
        <source>Click where CT numbers about the lumen are wanted.</source>
        <translation>Klicken, wo CT-Werte um das Lumen gewünscht sind.</translation>
    </message>
    <message>
        <source>The &amp;wall…</source>
        <translation>Die &amp;Wand…</translation>
    </message>
    <message>
        <source>Makes a surface of the wall (VTP, STL, PLY) in the background.</source>
        <translation>Macht im Hintergrund eine Oberfläche der Wand (VTP, STL, PLY).</translation>
    </message>
    <message>
        <source>A &amp;mesh…</source>
        <translation>Ein &amp;Netz…</translation>
    </message>
    <message>
        <source>Fills the lumen with tetrahedra for a solver, in the background.</source>
        <translation>Füllt das Lumen im Hintergrund mit Tetraedern für einen Löser.</translation>
    </message>
    <message>
        <source>Open a &amp;mesh…</source>
        <translation>&amp;Netz öffnen…</translation>
    </message>
    <message>
        <source>Shows a mesh made earlier, here or elsewhere, and how good it is.</source>
        <translation>Zeigt ein früher erzeugtes Netz, von hier oder anderswo, und wie gut es ist.</translation>
    </message>
    <message>
        <source>The &amp;mesh</source>
        <translation>Das &amp;Netz</translation>
    </message>
    <message>
        <source>Shows and hides the mesh that was made or opened last.</source>
        <translation>Zeigt und verbirgt das Netz, das zuletzt erzeugt oder geöffnet wurde.</translation>
    </message>
    <message>
        <source>&amp;Open a case or image…</source>
        <translation>Fall oder Bild ö&amp;ffnen…</translation>
    </message>
    <message>
        <source>Opens a case, an image file, or a zip of DICOM files; dropping it on the window does the same.</source>
        <translation>Öffnet einen Fall, eine Bilddatei oder ein ZIP mit DICOM-Dateien; auf das Fenster ziehen geht auch.</translation>
    </message>
    <message>
        <source>From the PACS</source>
        <translation>Aus dem PACS</translation>
    </message>
    <message>
        <source>From the &amp;PACS…</source>
        <translation>Aus dem &amp;PACS…</translation>
    </message>
    <message>
        <source>Searches in an image archive and opens a series from it.</source>
        <translation>Sucht in einem Bildarchiv und öffnet eine Serie daraus.</translation>
    </message>
    <message>
        <source>Open a DICOM &amp;folder…</source>
        <translation>DICOM-&amp;Ordner öffnen…</translation>
    </message>
    <message>
        <source>Looks for CT series in a folder of DICOM files.</source>
        <translation>Sucht CT-Serien in einem Ordner mit DICOM-Dateien.</translation>
    </message>
    <message>
        <source>The &amp;sample case</source>
        <translation>&amp;Beispielfall</translation>
    </message>
    <message>
        <source>Opens a computed patient with disease, made on the first use.</source>
        <translation>Öffnet einen berechneten kranken Patienten; beim ersten Mal wird er erzeugt.</translation>
    </message>
    <message>
        <source>Save the case &amp;as…</source>
        <translation>Fall &amp;speichern als…</translation>
    </message>
    <message>
        <source>Makes a copy of the case and goes on in it. A case is always saved.</source>
        <translation>Legt eine Kopie des Falls an und arbeitet in ihr weiter. Ein Fall ist immer gespeichert.</translation>
    </message>
    <message>
        <source>&amp;Close the case</source>
        <translation>Fall s&amp;chließen</translation>
    </message>
    <message>
        <source>Closes the case; nothing is lost.</source>
        <translation>Schließt den Fall; nichts geht verloren.</translation>
    </message>
    <message>
        <source>No motion is open.</source>
        <translation>Es ist keine Bewegung geöffnet.</translation>
    </message>
    <message>
        <source>Open a mo&amp;tion…</source>
        <translation>Be&amp;wegung öffnen…</translation>
    </message>
    <message>
        <source>Shows the case beating: a motion that was fitted to its phases.</source>
        <translation>Zeigt den Fall schlagend: eine Bewegung, die an seine Phasen angepasst wurde.</translation>
    </message>
    <message>
        <source>&amp;Play the heartbeat</source>
        <translation>&amp;Herzschlag abspielen</translation>
    </message>
    <message>
        <source>Plays the phases of the heart in all views, or pauses; needs a motion.</source>
        <translation>Spielt die Herzphasen in allen Ansichten ab oder hält an; braucht eine Bewegung.</translation>
    </message>
    <message>
        <source>Back to the case&apos;s phase</source>
        <translation>Zurück zur Phase des Falls</translation>
    </message>
    <message>
        <source>Shows the phase that the case is of again, at which it can be edited.</source>
        <translation>Zeigt wieder die Phase des Falls, in der er bearbeitet werden kann.</translation>
    </message>
    <message>
        <source>&amp;QA mode</source>
        <translation>&amp;Qualitätsmodus</translation>
    </message>
    <message>
        <source>Holds the case against contours that somebody else knows to be right.</source>
        <translation>Hält den Fall gegen Konturen, von denen jemand weiß, dass sie richtig sind.</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>Ends the program; nothing is lost.</source>
        <translation>Beendet das Programm; nichts geht verloren.</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>Takes the last step back.</source>
        <translation>Nimmt den letzten Schritt zurück.</translation>
    </message>
    <message>
        <source>There is no step to take back.</source>
        <translation>Es gibt keinen Schritt, der zurückgenommen werden kann.</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>Does again what was taken back.</source>
        <translation>Wiederholt, was zurückgenommen wurde.</translation>
    </message>
    <message>
        <source>No step was taken back.</source>
        <translation>Es wurde kein Schritt zurückgenommen.</translation>
    </message>
    <message>
        <source>&amp;Preferences…</source>
        <translation>&amp;Einstellungen…</translation>
    </message>
    <message>
        <source>Keys, theme and language.</source>
        <translation>Tasten, Farben und Sprache.</translation>
    </message>
    <message>
        <source>Light or dark</source>
        <translation>Hell oder dunkel</translation>
    </message>
    <message>
        <source>Changes between the dark and the light theme.</source>
        <translation>Wechselt zwischen dunklen und hellen Farben.</translation>
    </message>
    <message>
        <source>Choose a segment</source>
        <translation>Segment auswählen</translation>
    </message>
    <message>
        <source>A click on a segment shows its facts.</source>
        <translation>Ein Klick auf ein Segment zeigt seine Daten.</translation>
    </message>
    <message>
        <source>Straight distance</source>
        <translation>Gerader Abstand</translation>
    </message>
    <message>
        <source>Click two places on the vessels&apos; walls.</source>
        <translation>Klicken Sie auf zwei Stellen der Gefäßwände.</translation>
    </message>
    <message>
        <source>Distance along the tree</source>
        <translation>Abstand entlang des Baums</translation>
    </message>
    <message>
        <source>Click two places; the way is along the vessels&apos; axes.</source>
        <translation>Klicken Sie auf zwei Stellen; der Weg geht entlang der Gefäßachsen.</translation>
    </message>
    <message>
        <source>Angle of two segments</source>
        <translation>Winkel zweier Segmente</translation>
    </message>
    <message>
        <source>Click two segments; between their distal directions.</source>
        <translation>Klicken Sie auf zwei Segmente; zwischen ihren distalen Richtungen.</translation>
    </message>
    <message>
        <source>Region</source>
        <translation>Region</translation>
    </message>
    <message>
        <source>Click the centre of a ball; what lies in it is added up.</source>
        <translation>Klicken Sie auf die Mitte einer Kugel; was darin liegt, wird zusammengezählt.</translation>
    </message>
    <message>
        <source>Coordinate grid</source>
        <translation>Koordinatengitter</translation>
    </message>
    <message>
        <source>Lines at round coordinates.</source>
        <translation>Linien an runden Koordinaten.</translation>
    </message>
    <message>
        <source>Subtree only</source>
        <translation>Nur der Teilbaum</translation>
    </message>
    <message>
        <source>Shows the chosen segment and all behind it alone.</source>
        <translation>Zeigt nur das gewählte Segment und alles dahinter.</translation>
    </message>
    <message>
        <source>All of the tree</source>
        <translation>Ganzer Baum</translation>
    </message>
    <message>
        <source>Shows all of the vessel tree.</source>
        <translation>Zeigt den ganzen Gefäßbaum.</translation>
    </message>
    <message>
        <source>Copy the values</source>
        <translation>Werte kopieren</translation>
    </message>
    <message>
        <source>Puts what was measured on the clipboard, as a table.</source>
        <translation>Legt das Gemessene als Tabelle in die Zwischenablage.</translation>
    </message>
    <message>
        <source>Save the values…</source>
        <translation>Werte speichern…</translation>
    </message>
    <message>
        <source>Writes what was measured as a table (CSV).</source>
        <translation>Schreibt das Gemessene als Tabelle (CSV).</translation>
    </message>
    <message>
        <source>Forget the values</source>
        <translation>Werte verwerfen</translation>
    </message>
    <message>
        <source>Takes all that was measured in the tree away.</source>
        <translation>Entfernt alles, was im Baum gemessen wurde.</translation>
    </message>
    <message>
        <source>Close the tree</source>
        <translation>Baum schließen</translation>
    </message>
    <message>
        <source>Closes the vessel tree; the case&apos;s views come back.</source>
        <translation>Schließt den Gefäßbaum; die Ansichten des Falls kommen zurück.</translation>
    </message>
    <message>
        <source>No vessel is selected.</source>
        <translation>Es ist kein Gefäß ausgewählt.</translation>
    </message>
    <message>
        <source>The case has one vessel alone.</source>
        <translation>Der Fall hat nur ein einziges Gefäß.</translation>
    </message>
    <message>
        <source>This vessel does not go on from the end of another.</source>
        <translation>Dieses Gefäß setzt kein anderes an dessen Ende fort.</translation>
    </message>
    <message>
        <source>A case is open already: close it first.</source>
        <translation>Es ist schon ein Fall geöffnet: Schließen Sie ihn zuerst.</translation>
    </message>
    <message>
        <source>No image is open.</source>
        <translation>Es ist kein Bild geöffnet.</translation>
    </message>
    <message>
        <source>Pull</source>
        <translation>Ziehen</translation>
    </message>
    <message>
        <source>Take the contour and pull it. Shift and wheel: how far the pull reaches.</source>
        <translation>Die Kontur greifen und ziehen. Umschalt und Rad: wie weit der Zug reicht.</translation>
    </message>
    <message>
        <source>Draw</source>
        <translation>Zeichnen</translation>
    </message>
    <message>
        <source>Draw the wall anew, on a CPR or around the lumen on the cross-section.</source>
        <translation>Die Wand neu zeichnen, auf einer CPR oder um das Lumen im Querschnitt.</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinsel</translation>
    </message>
    <message>
        <source>A ball that pushes the wall: outwards from within, inwards from without.</source>
        <translation>Eine Kugel, die die Wand schiebt: von innen nach außen, von außen nach innen.</translation>
    </message>
    <message>
        <source>Centerline</source>
        <translation>Mittellinie</translation>
    </message>
    <message>
        <source>Pull the centerline. Double click adds a control point, Delete takes one away.</source>
        <translation>Die Mittellinie ziehen. Doppelklick setzt einen Stützpunkt, Entf löscht einen.</translation>
    </message>
    <message>
        <source>Add vessel</source>
        <translation>Neues Gefäß</translation>
    </message>
    <message>
        <source>Click the distal end of a vessel; the way back to the tree is found.</source>
        <translation>Auf das distale Ende eines Gefäßes klicken; der Weg zurück zum Baum wird gesucht.</translation>
    </message>
    <message>
        <source>Smaller ball, shorter reach</source>
        <translation>Kleinere Kugel, kürzere Reichweite</translation>
    </message>
    <message>
        <source>Makes the brush&apos;s ball smaller, or the reach of a pull shorter.</source>
        <translation>Macht die Kugel des Pinsels kleiner oder die Reichweite des Zugs kürzer.</translation>
    </message>
    <message>
        <source>Larger ball, longer reach</source>
        <translation>Größere Kugel, längere Reichweite</translation>
    </message>
    <message>
        <source>Makes the brush&apos;s ball larger, or the reach of a pull longer.</source>
        <translation>Macht die Kugel des Pinsels größer oder die Reichweite des Zugs länger.</translation>
    </message>
    <message>
        <source>Outer wall</source>
        <translation>Außenwand</translation>
    </message>
    <message>
        <source>Looks for the outer wall of the selected vessel, draws it on the 2D views and tells what plaque there is.</source>
        <translation>Sucht die Außenwand des gewählten Gefäßes, zeichnet sie in die 2D-Ansichten und nennt die Plaque.</translation>
    </message>
    <message>
        <source>Plaque</source>
        <translation>Plaque</translation>
    </message>
    <message>
        <source>Colours what lies between lumen and outer wall on sections and CPRs by its class.</source>
        <translation>Färbt auf Querschnitten und CPRs nach Klassen, was zwischen Lumen und Außenwand liegt.</translation>
    </message>
    <message>
        <source>&amp;Find the coronary arteries</source>
        <translation>Koronararterien &amp;finden</translation>
    </message>
    <message>
        <source>Finds aorta, ostia and arteries in the image, and names them.</source>
        <translation>Findet Aorta, Ostien und Arterien im Bild und benennt sie.</translation>
    </message>
    <message>
        <source>&amp;Split at the cursor</source>
        <translation>Am Cursor &amp;teilen</translation>
    </message>
    <message>
        <source>Makes two vessels of this one; the second begins at the cursor and takes the side branches from there on.</source>
        <translation>Macht aus diesem Gefäß zwei; das zweite beginnt am Cursor und übernimmt die Seitenäste ab dort.</translation>
    </message>
    <message>
        <source>&amp;Join with parent vessel</source>
        <translation>Mit dem &amp;Muttergefäß verbinden</translation>
    </message>
    <message>
        <source>Makes this vessel part of the one from whose end it goes on; takes a split back.</source>
        <translation>Macht dieses Gefäß zu einem Teil dessen, an dessen Ende es anschließt; nimmt eine Teilung zurück.</translation>
    </message>
    <message>
        <source>Cut in &amp;two at the cursor</source>
        <translation>Am Cursor &amp;durchtrennen</translation>
    </message>
    <message>
        <source>Cuts the vessel in two; what lies distal of the cursor, with its branches, is a tree of its own.</source>
        <translation>Durchtrennt das Gefäß; was distal des Cursors liegt, mit seinen Ästen, ist ein eigener Baum.</translation>
    </message>
    <message>
        <source>&amp;Connect to the cursor…</source>
        <translation>Mit dem Cursor &amp;verbinden…</translation>
    </message>
    <message>
        <source>A new piece of vessel leads from the cursor to where the vessel that you choose begins.</source>
        <translation>Ein neues Gefäßstück führt vom Cursor dorthin, wo das gewählte Gefäß beginnt.</translation>
    </message>
    <message>
        <source>caudal</source>
        <translation>kaudal</translation>
    </message>
    <message>
        <source>cranial</source>
        <translation>kranial</translation>
    </message>
    <message>
        <source>Turns the tree in 3D so that it is seen from there.</source>
        <translation>Dreht den Baum in 3D so, dass er von dort gesehen wird.</translation>
    </message>
    <message>
        <source>the front</source>
        <translation>vorn</translation>
    </message>
    <message>
        <source>the left</source>
        <translation>links</translation>
    </message>
    <message>
        <source>the right</source>
        <translation>rechts</translation>
    </message>
    <message>
        <source>above</source>
        <translation>oben</translation>
    </message>
    <message>
        <source>broadside of the vessel</source>
        <translation>der Breitseite des Gefäßes</translation>
    </message>
    <message>
        <source>Turn the CPRs left</source>
        <translation>CPRs nach links drehen</translation>
    </message>
    <message>
        <source>Turns both CPRs by five degrees about the vessel&apos;s axis.</source>
        <translation>Dreht beide CPRs um fünf Grad um die Gefäßachse.</translation>
    </message>
    <message>
        <source>Turn the CPRs right</source>
        <translation>CPRs nach rechts drehen</translation>
    </message>
    <message>
        <source>To proximal</source>
        <translation>Nach proximal</translation>
    </message>
    <message>
        <source>The cursor goes half a millimetre towards the ostium.</source>
        <translation>Der Cursor geht einen halben Millimeter zum Ostium hin.</translation>
    </message>
    <message>
        <source>To distal</source>
        <translation>Nach distal</translation>
    </message>
    <message>
        <source>The cursor goes half a millimetre towards the vessel&apos;s end.</source>
        <translation>Der Cursor geht einen halben Millimeter zum Ende des Gefäßes hin.</translation>
    </message>
    <message>
        <source>Next vessel</source>
        <translation>Nächstes Gefäß</translation>
    </message>
    <message>
        <source>Shows the next vessel of the list.</source>
        <translation>Zeigt das nächste Gefäß der Liste.</translation>
    </message>
    <message>
        <source>Previous vessel</source>
        <translation>Voriges Gefäß</translation>
    </message>
    <message>
        <source>Shows the previous vessel of the list.</source>
        <translation>Zeigt das vorige Gefäß der Liste.</translation>
    </message>
    <message>
        <source>Beginning of the vessel</source>
        <translation>Anfang des Gefäßes</translation>
    </message>
    <message>
        <source>The cursor goes to where the vessel begins.</source>
        <translation>Der Cursor geht zum Anfang des Gefäßes.</translation>
    </message>
    <message>
        <source>End of the vessel</source>
        <translation>Ende des Gefäßes</translation>
    </message>
    <message>
        <source>The cursor goes to where the vessel ends.</source>
        <translation>Der Cursor geht zum Ende des Gefäßes.</translation>
    </message>
    <message>
        <source>Stretched CPR</source>
        <translation>Gestreckte CPR</translation>
    </message>
    <message>
        <source>The CPRs keep the vessel&apos;s bends in one direction instead of none.</source>
        <translation>Die CPRs behalten die Biegungen des Gefäßes in einer Richtung statt in keiner.</translation>
    </message>
    <message>
        <source>Slab: maximum</source>
        <translation>Schicht: Maximum</translation>
    </message>
    <message>
        <source>2D views show the largest CT number within the slab&apos;s thickness.</source>
        <translation>2D-Ansichten zeigen den größten CT-Wert innerhalb der Schichtdicke.</translation>
    </message>
    <message>
        <source>Slab: mean</source>
        <translation>Schicht: Mittelwert</translation>
    </message>
    <message>
        <source>2D views show the mean CT number within the slab&apos;s thickness.</source>
        <translation>2D-Ansichten zeigen den mittleren CT-Wert innerhalb der Schichtdicke.</translation>
    </message>
    <message>
        <source>Thinner slab</source>
        <translation>Dünnere Schicht</translation>
    </message>
    <message>
        <source>Makes the slab of the 2D views thinner.</source>
        <translation>Macht die Schicht der 2D-Ansichten dünner.</translation>
    </message>
    <message>
        <source>Thicker slab</source>
        <translation>Dickere Schicht</translation>
    </message>
    <message>
        <source>Makes the slab of the 2D views thicker.</source>
        <translation>Macht die Schicht der 2D-Ansichten dicker.</translation>
    </message>
    <message>
        <source>Contours</source>
        <translation>Konturen</translation>
    </message>
    <message>
        <source>Shows or hides the lumen&apos;s contour on all views.</source>
        <translation>Zeigt oder verbirgt die Kontur des Lumens in allen Ansichten.</translation>
    </message>
    <message>
        <source>Grey levels for contrast-filled vessels.</source>
        <translation>Graustufen für kontrastgefüllte Gefäße.</translation>
    </message>
    <message>
        <source>Grey levels for muscle, fat and thrombus.</source>
        <translation>Graustufen für Muskel, Fett und Thrombus.</translation>
    </message>
    <message>
        <source>Grey levels for the lungs.</source>
        <translation>Graustufen für die Lunge.</translation>
    </message>
    <message>
        <source>Grey levels for bone and calcium.</source>
        <translation>Graustufen für Knochen und Kalk.</translation>
    </message>
    <message>
        <source>Window: %1</source>
        <translation>Fensterung: %1</translation>
    </message>
    <message>
        <source>Browse</source>
        <translation>Betrachten</translation>
    </message>
    <message>
        <source>The cursor goes where you click. Shift and drag: turn the CPR.</source>
        <translation>Der Cursor geht, wohin Sie klicken. Umschalt und Ziehen: CPR drehen.</translation>
    </message>
    <message>
        <source>Fit all views</source>
        <translation>Alle Ansichten einpassen</translation>
    </message>
    <message>
        <source>All views show all there is.</source>
        <translation>Alle Ansichten zeigen alles, was da ist.</translation>
    </message>
    <message>
        <source>All views</source>
        <translation>Alle Ansichten</translation>
    </message>
    <message>
        <source>The reading layout: lists, CPRs, sections, tree and profile.</source>
        <translation>Die Anordnung zum Befunden: Listen, CPRs, Schnitte, Baum und Profil.</translation>
    </message>
    <message>
        <source>Three planes alone</source>
        <translation>Drei Ebenen allein</translation>
    </message>
    <message>
        <source>Axial, coronal and sagittal, or oblique, with one crosshair and a slab.</source>
        <translation>Axial, koronar und sagittal, oder schräg, mit einem Fadenkreuz und einer Schicht.</translation>
    </message>
    <message>
        <source>2D views alone</source>
        <translation>2D-Ansichten allein</translation>
    </message>
    <message>
        <source>The tree gives its room to the other views.</source>
        <translation>Der Baum gibt seinen Platz den anderen Ansichten.</translation>
    </message>
    <message>
        <source>Save this layout…</source>
        <translation>Diese Anordnung speichern…</translation>
    </message>
    <message>
        <source>Keeps the window as it is under a name, with what floats on another monitor.</source>
        <translation>Behält das Fenster, wie es ist, unter einem Namen, mit allem, was auf einem anderen Bildschirm liegt.</translation>
    </message>
    <message>
        <source>Forget a layout…</source>
        <translation>Eine Anordnung vergessen…</translation>
    </message>
    <message>
        <source>Takes one of your own layouts away.</source>
        <translation>Nimmt eine eigene Anordnung weg.</translation>
    </message>
    <message>
        <source>Begin with the layout shown last</source>
        <translation>Mit der zuletzt gezeigten Anordnung beginnen</translation>
    </message>
    <message>
        <source>The window begins with it; again: as it was left.</source>
        <translation>Das Fenster beginnt mit ihr; noch einmal: wie es verlassen wurde.</translation>
    </message>
    <message>
        <source>Three &amp;planes</source>
        <translation>Drei &amp;Ebenen</translation>
    </message>
    <message>
        <source>Three linked planes beside the other views, or on another monitor.</source>
        <translation>Drei verbundene Ebenen neben den anderen Ansichten oder auf einem anderen Bildschirm.</translation>
    </message>
    <message>
        <source>Slab: minimum</source>
        <translation>Schicht: Minimum</translation>
    </message>
    <message>
        <source>2D views show the smallest CT number within the slab&apos;s thickness.</source>
        <translation>2D-Ansichten zeigen den kleinsten CT-Wert innerhalb der Schichtdicke.</translation>
    </message>
    <message>
        <source>Patient on the views</source>
        <translation>Patient auf den Ansichten</translation>
    </message>
    <message>
        <source>Writes in a corner of each image whose it is. Pictures of a report never have it.</source>
        <translation>Schreibt in eine Ecke jedes Bildes, von wem es ist. Bilder eines Befunds haben es nie.</translation>
    </message>
    <message>
        <source>Save these grey levels…</source>
        <translation>Diese Graustufen speichern…</translation>
    </message>
    <message>
        <source>Keeps window and level under a name, on this computer.</source>
        <translation>Behält Fensterbreite und -lage unter einem Namen, auf diesem Computer.</translation>
    </message>
    <message>
        <source>Forget grey levels…</source>
        <translation>Graustufen vergessen…</translation>
    </message>
    <message>
        <source>Takes grey levels of your own away.</source>
        <translation>Nimmt eigene Graustufen weg.</translation>
    </message>
    <message>
        <source>C-arm angles…</source>
        <translation>Winkel des C-Bogens …</translation>
    </message>
    <message>
        <source>Turns the tree in 3D to angles that you type.</source>
        <translation>Dreht den Baum in 3D auf die Winkel, die Sie eingeben.</translation>
    </message>
    <message>
        <source>The C-arm&apos;s angles</source>
        <translation>Winkel des C-Bogens</translation>
    </message>
    <message>
        <source>AP, LAT, or angles as &quot;LAO 30 CRA 20&quot;, &quot;RAO 30 CAU 25&quot;:</source>
        <translation>AP, LAT oder Winkel wie „LAO 30 CRA 20“, „RAO 30 CAU 25“:</translation>
    </message>
    <message>
        <source>Look: coronary arteries</source>
        <translation>Darstellung: Koronararterien</translation>
    </message>
    <message>
        <source>The heart closed and lit, contrast light on dark muscle.</source>
        <translation>Das Herz geschlossen und beleuchtet, Kontrast hell auf dunklem Muskel.</translation>
    </message>
    <message>
        <source>Look: contrast alone</source>
        <translation>Darstellung: nur Kontrast</translation>
    </message>
    <message>
        <source>Muscle is hardly there: vessels and chambers are seen through it.</source>
        <translation>Muskel ist kaum da: Gefäße und Höhlen sind durch ihn zu sehen.</translation>
    </message>
    <message>
        <source>Look: soft tissue</source>
        <translation>Darstellung: Weichteile</translation>
    </message>
    <message>
        <source>All that is denser than fat.</source>
        <translation>Alles, was dichter als Fett ist.</translation>
    </message>
    <message>
        <source>Look: bone</source>
        <translation>Darstellung: Knochen</translation>
    </message>
    <message>
        <source>Bone, calcium and dense contrast alone.</source>
        <translation>Nur Knochen, Kalk und dichter Kontrast.</translation>
    </message>
    <message>
        <source>Draw a line in 3D about what is to stay; Escape: no cut.</source>
        <translation>Ziehen Sie in 3D eine Linie um das, was bleiben soll; Escape: kein Schnitt.</translation>
    </message>
    <message>
        <source>Draw a line in 3D about what is to go; Escape: no cut.</source>
        <translation>Ziehen Sie in 3D eine Linie um das, was weg soll; Escape: kein Schnitt.</translation>
    </message>
    <message>
        <source>Cut away what I draw around</source>
        <translation>Wegschneiden, was ich umfahre</translation>
    </message>
    <message>
        <source>Scissors: what lies behind the line&apos;s inside goes.</source>
        <translation>Schere: Was hinter dem Innern der Linie liegt, verschwindet.</translation>
    </message>
    <message>
        <source>Keep only what I draw around</source>
        <translation>Nur behalten, was ich umfahre</translation>
    </message>
    <message>
        <source>Scissors: what lies outside of the line goes.</source>
        <translation>Schere: Was außerhalb der Linie liegt, verschwindet.</translation>
    </message>
    <message>
        <source>Take the last cut back</source>
        <translation>Letzten Schnitt zurücknehmen</translation>
    </message>
    <message>
        <source>Nothing has been cut.</source>
        <translation>Es ist nichts weggeschnitten.</translation>
    </message>
    <message>
        <source>All cuts and the box back</source>
        <translation>Alle Schnitte und die Box aufheben</translation>
    </message>
    <message>
        <source>&amp;Heart in 3D</source>
        <translation>&amp;Herz in 3D</translation>
    </message>
    <message>
        <source>Look, box and scissors of the CT behind the tree.</source>
        <translation>Darstellung, Box und Schere des CT hinter dem Baum.</translation>
    </message>
    <message>
        <source>Heart without bones</source>
        <translation>Herz ohne Knochen</translation>
    </message>
    <message>
        <source>Ribs, breastbone, spine and what lies far from the arteries are left out.</source>
        <translation>Rippen, Brustbein, Wirbelsäule und alles fern der Arterien bleiben weg.</translation>
    </message>
    <message>
        <source>Phases from a folder…</source>
        <translation>Phasen aus einem Ordner …</translation>
    </message>
    <message>
        <source>More images of this heart: files of phases, or series of the same study.</source>
        <translation>Weitere Bilder dieses Herzens: Dateien von Phasen oder Serien derselben Untersuchung.</translation>
    </message>
    <message>
        <source>There is no other series of the study.</source>
        <translation>Es gibt keine andere Serie der Untersuchung.</translation>
    </message>
    <message>
        <source>There are no phases of one grid.</source>
        <translation>Es gibt keine Phasen auf demselben Gitter.</translation>
    </message>
    <message>
        <source>Series of the study</source>
        <translation>Serien der Untersuchung</translation>
    </message>
    <message>
        <source>Shows or hides the strip with a picture of each series and phase.</source>
        <translation>Zeigt oder verbirgt den Streifen mit einem Bild jeder Serie und Phase.</translation>
    </message>
    <message>
        <source>Back to the image on the table</source>
        <translation>Zurück zum geöffneten Bild</translation>
    </message>
    <message>
        <source>Shows the image that the case is of again, on which it is edited.</source>
        <translation>Zeigt wieder das Bild, zu dem der Fall gehört und auf dem er bearbeitet wird.</translation>
    </message>
    <message>
        <source>Play the phases</source>
        <translation>Phasen abspielen</translation>
    </message>
    <message>
        <source>Shows the phases of the study one after the other, or pauses.</source>
        <translation>Zeigt die Phasen der Untersuchung nacheinander oder hält an.</translation>
    </message>
    <message>
        <source>Find the sharpest phase</source>
        <translation>Schärfste Phase suchen</translation>
    </message>
    <message>
        <source>Measures at which phase the arteries, or the heart, have the sharpest edges.</source>
        <translation>Misst, in welcher Phase die Arterien oder das Herz die schärfsten Kanten haben.</translation>
    </message>
    <message>
        <source>&amp;Messages…</source>
        <translation>&amp;Meldungen…</translation>
    </message>
    <message>
        <source>All that the window has said since it was opened, to be read again.</source>
        <translation>Alles, was das Fenster gesagt hat, seit es offen ist, zum Nachlesen.</translation>
    </message>
    <message>
        <source>Ano&amp;ther series…</source>
        <translation>&amp;Andere Serie…</translation>
    </message>
    <message>
        <source>The series of the folder that was opened last, to choose another one.</source>
        <translation>Die Serien des zuletzt geöffneten Ordners, um eine andere zu wählen.</translation>
    </message>
    <message>
        <source>What was opened last is no folder of DICOM files.</source>
        <translation>Was zuletzt geöffnet wurde, ist kein Ordner mit DICOM-Dateien.</translation>
    </message>
    <message>
        <source>&amp;Reports of crashes…</source>
        <translation>&amp;Absturzberichte…</translation>
    </message>
    <message>
        <source>What the program wrote down when it ended by itself; on this computer alone.</source>
        <translation>Was das Programm notiert hat, als es von selbst endete; nur auf diesem Rechner.</translation>
    </message>
    <message>
        <source>There is none.</source>
        <translation>Es gibt keinen.</translation>
    </message>
    <message>
        <source>Tree over the heart</source>
        <translation>Baum über dem Herzen</translation>
    </message>
    <message>
        <source>Without it the arteries are those of the CT, as the look shows them.</source>
        <translation>Ohne ihn sind die Arterien die des CT, wie die Darstellung sie zeigt.</translation>
    </message>
    <message>
        <source>Set o&amp;rientation…</source>
        <translation>O&amp;rientierung angeben…</translation>
    </message>
    <message>
        <source>How the image lies in the patient, where its file says it wrongly or not at all.</source>
        <translation>Wie das Bild in der Person liegt, wo seine Datei es falsch oder gar nicht sagt.</translation>
    </message>
    <message>
        <source>Box with handles</source>
        <translation>Box mit Griffen</translation>
    </message>
    <message>
        <source>A frame about the heart; a side that is pulled cuts away what lies beyond.</source>
        <translation>Ein Rahmen um das Herz; eine gezogene Seite nimmt weg, was jenseits liegt.</translation>
    </message>
    <message>
        <source>The page Pressure is not open.</source>
        <translation>Die Seite „Druck“ ist nicht offen.</translation>
    </message>
    <message>
        <source>&amp;Pressure (research)</source>
        <translation>&amp;Druck (Forschung)</translation>
    </message>
    <message>
        <source>Computes pressure and flow along the tree, and shows FFR in all views.</source>
        <translation>Berechnet Druck und Fluss entlang des Gefäßbaums und zeigt die FFR in allen Ansichten.</translation>
    </message>
    <message>
        <source>&amp;Colour the tree by FFR</source>
        <translation>Gefäßbaum nach FFR &amp;färben</translation>
    </message>
    <message>
        <source>While the page Pressure is open.</source>
        <translation>Solange die Seite „Druck“ offen ist.</translation>
    </message>
    <message>
        <source>What if it were &amp;opened</source>
        <translation>Was wäre, wenn sie &amp;offen wäre</translation>
    </message>
    <message>
        <source>FFR as if the narrowing at the cursor had its reference calibre, less what stays; the lumen is as it was.</source>
        <translation>FFR, als hätte die Engstelle am Cursor ihr Referenzkaliber, abzüglich dessen, was bleibt; das Lumen bleibt, wie es war.</translation>
    </message>
    <message>
        <source>What if it were &amp;narrower</source>
        <translation>Was wäre, wenn es &amp;enger wäre</translation>
    </message>
    <message>
        <source>FFR as if the stretch at the cursor were narrowed by a stenosis of this percent; the lumen is as it was.</source>
        <translation>FFR, als wäre die Strecke am Cursor durch eine Stenose dieses Prozentsatzes verengt; das Lumen bleibt, wie es war.</translation>
    </message>
    <message>
        <source>&amp;Take all of them back</source>
        <translation>Alle &amp;zurücknehmen</translation>
    </message>
    <message>
        <source>FFR of the lumen as it is alone.</source>
        <translation>Nur die FFR des Lumens, wie es ist.</translation>
    </message>
    <message>
        <source>Nothing is looked at as if it were otherwise.</source>
        <translation>Nichts wird betrachtet, als wäre es anders.</translation>
    </message>
    <message>
        <source>Report of the p&amp;ressures</source>
        <translation>&amp;Befund der Drücke</translation>
    </message>
    <message>
        <source>PDF, HTML and tables of inputs, curves and readings, in a folder beside the case.</source>
        <translation>PDF, HTML und Tabellen der Eingaben, Kurven und Ablesungen, in einem Ordner neben dem Fall.</translation>
    </message>
    <message>
        <source>The page Pressure is not open, or knows no pressures yet.</source>
        <translation>Die Seite „Druck“ ist nicht offen oder kennt noch keine Drücke.</translation>
    </message>
    <message>
        <source>&amp;What the report says…</source>
        <translation>Was der &amp;Befund sagt…</translation>
    </message>
    <message>
        <source>Impression, modifiers of CAD-RADS, features of high-risk plaque, signature.</source>
        <translation>Beurteilung, Zusätze zu CAD-RADS, Merkmale von Hochrisikoplaque, Unterschrift.</translation>
    </message>
    <message>
        <source>Says where the chosen lesion of calcium lies; Undo takes it back.</source>
        <translation>Sagt, wo die gewählte Kalkläsion liegt; Rückgängig nimmt es zurück.</translation>
    </message>
    <message>
        <source>No lesion of calcium is chosen.</source>
        <translation>Keine Kalkläsion ist gewählt.</translation>
    </message>
    <message>
        <source>Calcium &amp;score</source>
        <translation>Kalk&amp;score</translation>
    </message>
    <message>
        <source>Finds the calcium of a CT without contrast agent and counts it by artery.</source>
        <translation>Findet den Kalk eines CT ohne Kontrastmittel und zählt ihn nach Arterie.</translation>
    </message>
    <message>
        <source>L&amp;M</source>
        <translation>L&amp;M</translation>
    </message>
    <message>
        <source>&amp;LAD</source>
        <translation>&amp;LAD</translation>
    </message>
    <message>
        <source>LC&amp;X</source>
        <translation>LC&amp;X</translation>
    </message>
    <message>
        <source>&amp;RCA</source>
        <translation>&amp;RCA</translation>
    </message>
    <message>
        <source>&amp;Not coronary</source>
        <translation>&amp;Nicht koronar</translation>
    </message>
    <message>
        <source>&amp;Take it into the report</source>
        <translation>In den &amp;Bericht nehmen</translation>
    </message>
    <message>
        <source>The report of the case that is open says this score.</source>
        <translation>Der Bericht des offenen Falls nennt diesen Score.</translation>
    </message>
    <message>
        <source>&amp;Write tables and pictures…</source>
        <translation>&amp;Tabellen und Bilder schreiben…</translation>
    </message>
    <message>
        <source>A folder with the score as JSON, the lesions as a table and a mask, and slices.</source>
        <translation>Ein Ordner mit dem Score als JSON, den Läsionen als Tabelle und Maske und mit Schichten.</translation>
    </message>
    <message>
        <source>No scan has been scored.</source>
        <translation>Noch keine Aufnahme ist ausgewertet.</translation>
    </message>
    <message>
        <source>&amp;Send to the PACS…</source>
        <translation>An das PACS &amp;senden…</translation>
    </message>
    <message>
        <source>Sends the case&apos;s segmentation, report, measurements, surface and key images.</source>
        <translation>Sendet Segmentierung, Bericht, Messungen, Oberfläche und Schlüsselbilder des Falls.</translation>
    </message>
    <message>
        <source>Send to the PACS</source>
        <translation>An das PACS senden</translation>
    </message>
    <message>
        <source>&amp;Outbox…</source>
        <translation>&amp;Postausgang…</translation>
    </message>
    <message>
        <source>What waits to be sent to the PACS, and why it was not.</source>
        <translation>Was darauf wartet, an das PACS gesendet zu werden, und warum es das noch nicht ist.</translation>
    </message>
    <message>
        <source>S&amp;ervers…</source>
        <translation>S&amp;erver…</translation>
    </message>
    <message>
        <source>Which image archives there are, and how each is reached.</source>
        <translation>Welche Bildarchive es gibt und wie jedes erreicht wird.</translation>
    </message>
    <message>
        <source>&amp;Fat about the arteries</source>
        <translation>&amp;Fett um die Arterien</translation>
    </message>
    <message>
        <source>Measures the fat about RCA, LAD and LCX and colours it on the CPRs.</source>
        <translation>Misst das Fett um RCA, LAD und LCX und färbt es auf den CPRs.</translation>
    </message>
    <message>
        <source>The page of the comparison is not open.</source>
        <translation>Die Seite des Vergleichs ist nicht offen.</translation>
    </message>
    <message>
        <source>Compare with the last s&amp;can…</source>
        <translation>Mit der letzten Auf&amp;nahme vergleichen…</translation>
    </message>
    <message>
        <source>What has changed since the same patient&apos;s former case: lesions, lumen, plaque. The former case is only read.</source>
        <translation>Was sich seit dem früheren Fall desselben Patienten verändert hat: Läsionen, Lumen, Plaque. Der frühere Fall wird nur gelesen.</translation>
    </message>
    <message>
        <source>&amp;Page of the comparison</source>
        <translation>Seite des &amp;Vergleichs</translation>
    </message>
    <message>
        <source>Both scans side by side in the place of the views, and back.</source>
        <translation>Beide Aufnahmen nebeneinander an der Stelle der Ansichten, und zurück.</translation>
    </message>
    <message>
        <source>&amp;Former tree in the 3D view</source>
        <translation>&amp;Früherer Baum in der 3D-Ansicht</translation>
    </message>
    <message>
        <source>The former wall, blue and half transparent, over the present one: where it stands out the vessel was wider.</source>
        <translation>Die frühere Wand, blau und halb durchsichtig, über der jetzigen: wo sie hervorsteht, war das Gefäß weiter.</translation>
    </message>
    <message>
        <source>&amp;Blink</source>
        <translation>&amp;Blinken</translation>
    </message>
    <message>
        <source>The other scan in the same place; again, and the first is back.</source>
        <translation>Die andere Aufnahme an derselben Stelle; noch einmal, und die erste ist wieder da.</translation>
    </message>
    <message>
        <source>&amp;Side by side</source>
        <translation>&amp;Nebeneinander</translation>
    </message>
    <message>
        <source>Ne&amp;xt lesion of either scan</source>
        <translation>Nä&amp;chste Läsion beider Aufnahmen</translation>
    </message>
    <message>
        <source>Both scans go to the next lesion of the list.</source>
        <translation>Beide Aufnahmen gehen zur nächsten Läsion der Liste.</translation>
    </message>
    <message>
        <source>Pre&amp;vious lesion of either scan</source>
        <translation>Vo&amp;rige Läsion beider Aufnahmen</translation>
    </message>
    <message>
        <source>&amp;Compare again</source>
        <translation>Noch &amp;einmal vergleichen</translation>
    </message>
    <message>
        <source>With the case as it is now.</source>
        <translation>Mit dem Fall, wie er jetzt ist.</translation>
    </message>
    <message>
        <source>&amp;Take it into the next report</source>
        <translation>In den nächsten Befund übe&amp;rnehmen</translation>
    </message>
    <message>
        <source>The lesions before and now, and what runs along the vessels, become pages of the next report.</source>
        <translation>Die Läsionen früher und jetzt und die Verläufe entlang der Gefäße werden Seiten des nächsten Befunds.</translation>
    </message>
    <message>
        <source>&amp;Write pages and tables…</source>
        <translation>Seiten und Tabellen &amp;schreiben…</translation>
    </message>
    <message>
        <source>A folder with the comparison as PDF, HTML, JSON and table.</source>
        <translation>Ein Ordner mit dem Vergleich als PDF, HTML, JSON und Tabelle.</translation>
    </message>
    <message>
        <source>Put the &amp;former scan away</source>
        <translation>Die &amp;frühere Aufnahme weglegen</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Comparing</name>
    <message>
        <source>No case is open.</source>
        <translation>Kein Fall ist offen.</translation>
    </message>
    <message>
        <source>The case has not been compared with a former one.</source>
        <translation>Der Fall wurde mit keinem früheren verglichen.</translation>
    </message>
    <message>
        <source>the former scan</source>
        <translation>die frühere Aufnahme</translation>
    </message>
    <message>
        <source>The same patient&apos;s former case</source>
        <translation>Der frühere Fall desselben Patienten</translation>
    </message>
    <message>
        <source>Cases (*.ostia);;All files (*)</source>
        <translation>Fälle (*.ostia);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>%1 is the case that is open. Choose the case of the patient&apos;s former scan.</source>
        <translation>%1 ist der Fall, der offen ist. Wählen Sie den Fall der früheren Aufnahme des Patienten.</translation>
    </message>
    <message>
        <source>Nothing was compared</source>
        <translation>Nichts wurde verglichen</translation>
    </message>
    <message>
        <source>Reading the former case</source>
        <translation>Der frühere Fall wird gelesen</translation>
    </message>
    <message>
        <source>The image of the former case</source>
        <translation>Das Bild des früheren Falls</translation>
    </message>
    <message>
        <source>The image that the former case was made on (%1) is not where it was, or has never been opened on this computer. Without it lumens are compared, and neither plaque nor pictures.</source>
        <translation>Das Bild, auf dem der frühere Fall beruht (%1), ist nicht, wo es war, oder wurde auf diesem Rechner nie geöffnet. Ohne es werden Lumen verglichen, weder Plaque noch Bilder.</translation>
    </message>
    <message>
        <source>Find the file…</source>
        <translation>Die Datei suchen…</translation>
    </message>
    <message>
        <source>Find the DICOM folder…</source>
        <translation>Den DICOM-Ordner suchen…</translation>
    </message>
    <message>
        <source>Go on without</source>
        <translation>Ohne weiter</translation>
    </message>
    <message>
        <source>Comparing the two scans</source>
        <translation>Die Aufnahmen werden verglichen</translation>
    </message>
    <message>
        <source>The images are known as those of two patients.</source>
        <translation>Die Bilder sind als die zweier Patienten bekannt.</translation>
    </message>
    <message>
        <source>Hardly one patient</source>
        <translation>Kaum ein Patient</translation>
    </message>
    <message>
        <source>The two cases are hardly of one patient, and nothing was compared.

%1</source>
        <translation>Die beiden Fälle sind kaum von einem Patienten, und nichts wurde verglichen.

%1</translation>
    </message>
    <message>
        <source>Compare all the same</source>
        <translation>Trotzdem vergleichen</translation>
    </message>
    <message>
        <source>Compared with the scan %1</source>
        <translation>Verglichen mit der Aufnahme %1</translation>
    </message>
    <message>
        <source>%1: lesions, before → now</source>
        <translation>%1: Läsionen, früher → jetzt</translation>
    </message>
    <message>
        <source>Where the comparison&apos;s folder is made</source>
        <translation>Wo der Ordner des Vergleichs angelegt wird</translation>
    </message>
    <message>
        <source>Comparison</source>
        <translation>Vergleich</translation>
    </message>
    <message>
        <source>The comparison is in %1.</source>
        <translation>Der Vergleich ist in %1.</translation>
    </message>
    <message>
        <source>The comparison was not written</source>
        <translation>Der Vergleich wurde nicht geschrieben</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ComparisonPage</name>
    <message>
        <source>What is to be known of this comparison</source>
        <translation>Was von diesem Vergleich zu wissen ist</translation>
    </message>
    <message>
        <source>CPR</source>
        <translation>CPR</translation>
    </message>
    <message>
        <source>Vessel</source>
        <translation>Gefäß</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>Querschnitt</translation>
    </message>
    <message>
        <source>Orientation of the slice</source>
        <translation>Lage der Schicht</translation>
    </message>
    <message>
        <source>Axial</source>
        <translation>Axial</translation>
    </message>
    <message>
        <source>Coronal</source>
        <translation>Koronar</translation>
    </message>
    <message>
        <source>Sagittal</source>
        <translation>Sagittal</translation>
    </message>
    <message>
        <source>Slice</source>
        <translation>Schicht</translation>
    </message>
    <message>
        <source>Out of date: the case has changed since. Compare again.</source>
        <translation>Veraltet: Der Fall wurde seither geändert. Noch einmal vergleichen.</translation>
    </message>
    <message>
        <source>Compared with the scan %1.</source>
        <translation>Verglichen mit der Aufnahme %1.</translation>
    </message>
    <message>
        <source>Lesions: %1 in both, %2 new, %3 gone, %4 not reached by one scan.</source>
        <translation>Läsionen: %1 in beiden, %2 neu, %3 verschwunden, %4 von einer Aufnahme nicht erreicht.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::CrashReportDialog</name>
    <message>
        <source>Reports of crashes</source>
        <translation>Absturzberichte</translation>
    </message>
    <message>
        <source>Whoever looks for the fault needs this text. Copy it into your message, or delete it.</source>
        <translation>Wer den Fehler sucht, braucht diesen Text. Kopieren Sie ihn in Ihre Nachricht, oder löschen Sie ihn.</translation>
    </message>
    <message>
        <source>Copy all</source>
        <translation>Alles kopieren</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::CrashReports</name>
    <message>
        <source>The last session</source>
        <translation>Die letzte Sitzung</translation>
    </message>
    <message>
        <source>The program ended by itself the last time; the case is as it was. It has left a report on this computer, with its version, the last commands and where in the program it was, and with no name and no path. It is sent to nobody.</source>
        <translation>Das Programm endete beim letzten Mal von selbst; der Fall ist, wie er war. Es hat auf diesem Rechner einen Bericht hinterlassen, mit seiner Version, den letzten Befehlen und der Stelle im Programm, ohne Namen und ohne Pfade. Er wird niemandem geschickt.</translation>
    </message>
    <message>
        <source>Look at it</source>
        <translation>Ansehen</translation>
    </message>
    <message>
        <source>Delete it</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Later</source>
        <translation>Später</translation>
    </message>
    <message>
        <source>A report could not be deleted.</source>
        <translation>Ein Bericht ließ sich nicht löschen.</translation>
    </message>
    <message>
        <source>There is no report of a crash any more.</source>
        <translation>Es gibt keinen Absturzbericht mehr.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::CutFields</name>
    <message>
        <source>The plane can be dragged in 3D by its frame and its arrow.</source>
        <translation>Die Ebene lässt sich in 3D an ihrem Rahmen und ihrem Pfeil ziehen.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::DoubtList</name>
    <message>
        <source>%1 to %2 mm</source>
        <translation>%1 bis %2 mm</translation>
    </message>
    <message>
        <source>Doubts</source>
        <translation>Zweifel</translation>
    </message>
    <message>
        <source>Vessel</source>
        <translation>Gefäß</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>Stelle</translation>
    </message>
    <message>
        <source>Probability</source>
        <translation>Wahrscheinlichkeit</translation>
    </message>
    <message>
        <source>That a coronary artery is there and its axis lies in it, by the program</source>
        <translation>Dass dort eine Koronararterie ist und ihre Mittellinie darin liegt, nach dem Programm</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Evaluability</name>
    <message>
        <source>No case is open.</source>
        <translation>Es ist kein Fall offen.</translation>
    </message>
    <message>
        <source>No vessel is selected.</source>
        <translation>Es ist kein Gefäß gewählt.</translation>
    </message>
    <message>
        <source>as the program finds it</source>
        <translation>wie das Programm es findet</translation>
    </message>
    <message>
        <source>%1 from %2 to %3 mm: %4</source>
        <translation>%1 von %2 bis %3 mm: %4</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::FailurePanel</name>
    <message>
        <source>Now click the distal end of this vessel in the slice.</source>
        <translation>Klicken Sie jetzt in der Schicht das distale Ende dieses Gefäßes an.</translation>
    </message>
    <message>
        <source>Click the ostium of the artery in the slice, then its distal end.</source>
        <translation>Klicken Sie in der Schicht das Ostium der Arterie an, dann ihr distales Ende.</translation>
    </message>
    <message>
        <source>No vessel yet</source>
        <translation>Noch kein Gefäß</translation>
    </message>
    <message>
        <source>There is an image, and no vessel in it yet. Have the arteries found, or begin one by two clicks.</source>
        <translation>Es gibt ein Bild und noch kein Gefäß darin. Lassen Sie die Arterien suchen, oder beginnen Sie eine mit zwei Klicks.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Fat</name>
    <message>
        <source>Fat about the arteries</source>
        <translation>Fett um die Arterien</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::FatPage</name>
    <message>
        <source>Fat about the arteries</source>
        <translation>Fett um die Arterien</translation>
    </message>
    <message>
        <source>Artery</source>
        <translation>Arterie</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>Index HU</source>
        <translation>Index HU</translation>
    </message>
    <message>
        <source>At 120 kV</source>
        <translation>Bei 120 kV</translation>
    </message>
    <message>
        <source>Clear HU</source>
        <translation>Frei HU</translation>
    </message>
    <message>
        <source>mm³</source>
        <translation>mm³</translation>
    </message>
    <message>
        <source>Index: the mean of all that is -190 to -30 HU within one diameter of the outer wall. Clear: without what lies beside an edge and is partly something else. Return: the CPRs show this artery.</source>
        <translation>Index: das Mittel von allem, was -190 bis -30 HU hat und nicht weiter als einen Durchmesser von der Außenwand liegt. Frei: ohne das, was an einem Rand liegt und zum Teil etwas anderes ist. Eingabe: Die CPRs zeigen diese Arterie.</translation>
    </message>
    <message>
        <source>%1 to %2 HU</source>
        <translation>%1 bis %2 HU</translation>
    </message>
    <message>
        <source>below %1 HU</source>
        <translation>unter %1 HU</translation>
    </message>
    <message>
        <source>above %1 HU</source>
        <translation>über %1 HU</translation>
    </message>
    <message>
        <source>No case is open.</source>
        <translation>Es ist kein Fall offen.</translation>
    </message>
    <message>
        <source>The image of the case is not open.</source>
        <translation>Das Bild des Falls ist nicht offen.</translation>
    </message>
    <message>
        <source>The fat is being measured…</source>
        <translation>Das Fett wird gemessen…</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 bis %2</translation>
    </message>
    <message>
        <source>Tube voltage %1 kV.</source>
        <translation>Röhrenspannung %1 kV.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::FloatingViews</name>
    <message>
        <source>%1 – Ostia</source>
        <translation>%1 – Ostia</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::FlowBar</name>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Result that is shown</source>
        <translation>Gezeigtes Ergebnis</translation>
    </message>
    <message>
        <source>Colours from the 2nd to the 98th percentile of all values</source>
        <translation>Farben vom 2. bis zum 98. Perzentil aller Werte</translation>
    </message>
    <message>
        <source>Value of the first colour</source>
        <translation>Wert der ersten Farbe</translation>
    </message>
    <message>
        <source>Value of the last colour</source>
        <translation>Wert der letzten Farbe</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>Das Bild speichern</translation>
    </message>
    <message>
        <source>Hide the result</source>
        <translation>Das Ergebnis ausblenden</translation>
    </message>
    <message>
        <source>Type two numbers, the smaller one first.</source>
        <translation>Zwei Zahlen eingeben, die kleinere zuerst.</translation>
    </message>
    <message>
        <source>Shear stress and pressure along the vessel, in the profile</source>
        <translation>Schubspannung und Druck entlang des Gefäßes, im Profil</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::FlowCases</name>
    <message>
        <source>Mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>Flow case</source>
        <translation>Strömungsfall</translation>
    </message>
    <message>
        <source>The flow case could not be written</source>
        <translation>Der Strömungsfall konnte nicht geschrieben werden</translation>
    </message>
    <message>
        <source>%1: flow case written</source>
        <translation>%1: Strömungsfall geschrieben</translation>
    </message>
    <message>
        <source>Open folder</source>
        <translation>Ordner öffnen</translation>
    </message>
    <message>
        <source>Run the solver</source>
        <translation>Löser starten</translation>
    </message>
    <message>
        <source>The solver is running already: cancel it first.</source>
        <translation>Der Löser läuft schon: zuerst abbrechen.</translation>
    </message>
    <message>
        <source>Solver</source>
        <translation>Löser</translation>
    </message>
    <message>
        <source>%1 iterations</source>
        <translation>%1 Iterationen</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1: converged, %2</source>
        <translation>%1: konvergiert, %2</translation>
    </message>
    <message>
        <source>%1: not converged, %2</source>
        <translation>%1: nicht konvergiert, %2</translation>
    </message>
    <message>
        <source>The solver&apos;s run failed</source>
        <translation>Der Lauf des Lösers ist gescheitert</translation>
    </message>
    <message>
        <source>Show the result</source>
        <translation>Ergebnis zeigen</translation>
    </message>
    <message>
        <source>The result is shown, but look at it before you use it: %1</source>
        <translation>Das Ergebnis wird gezeigt, aber sehen Sie es an, bevor Sie es verwenden: %1</translation>
    </message>
    <message>
        <source>A result to look at</source>
        <translation>Ein Ergebnis zum Ansehen</translation>
    </message>
    <message>
        <source>The result of %1 was computed while no case was open. Close the case that is open to see it.</source>
        <translation>Das Ergebnis von %1 wurde berechnet, als kein Fall offen war. Schließen Sie den offenen Fall, um es zu sehen.</translation>
    </message>
    <message>
        <source>The result of %1 belongs to the case %2, which is not open. Open that case, then show the result.</source>
        <translation>Das Ergebnis von %1 gehört zum Fall %2, der nicht offen ist. Öffnen Sie diesen Fall, dann zeigen Sie das Ergebnis an.</translation>
    </message>
    <message>
        <source>A result of another case</source>
        <translation>Ein Ergebnis eines anderen Falls</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::FlowDialog</name>
    <message>
        <source>Mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>Volume meshes (*.vtu);;All files (*)</source>
        <translation>Volumennetze (*.vtu);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Choose a mesh: the mesh.vtu of an exported mesh.</source>
        <translation>Ein Netz wählen: die mesh.vtu eines exportierten Netzes.</translation>
    </message>
    <message>
        <source>There is no file of this name.</source>
        <translation>Es gibt keine Datei dieses Namens.</translation>
    </message>
    <message>
        <source>Its elements are quadratic, the solvers take linear ones. Export the mesh with linear elements.</source>
        <translation>Seine Elemente sind quadratisch, die Löser nehmen lineare. Das Netz mit linearen Elementen exportieren.</translation>
    </message>
    <message>
        <source>It has prisms, %1 takes tetrahedra alone. Export it with layers as tetrahedra, or choose OpenFOAM.</source>
        <translation>Es hat Prismen, %1 nimmt nur Tetraeder. Mit Schichten als Tetraeder exportieren oder OpenFOAM wählen.</translation>
    </message>
    <message>
        <source>A flow of %1 ml/s is not that of a vessel. Choose %2 to %3 ml/s.</source>
        <translation>Ein Fluss von %1 ml/s ist nicht der eines Gefäßes. %2 bis %3 ml/s wählen.</translation>
    </message>
    <message>
        <source>%1 has no outlets with a given share. Choose pressure 0 or resistances, or OpenFOAM.</source>
        <translation>%1 kennt keine Auslässe mit festem Anteil. Druck 0 oder Widerstände wählen, oder OpenFOAM.</translation>
    </message>
    <message>
        <source>Choose a viscosity of %1 to %2 mPa s.</source>
        <translation>Eine Viskosität von %1 bis %2 mPa s wählen.</translation>
    </message>
    <message>
        <source>Choose a density of %1 to %2 kg/m³.</source>
        <translation>Eine Dichte von %1 bis %2 kg/m³ wählen.</translation>
    </message>
    <message>
        <source>The folder holds files. Name another one.</source>
        <translation>Der Ordner enthält Dateien. Einen anderen nennen.</translation>
    </message>
    <message>
        <source>reading…</source>
        <translation>wird gelesen…</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>%1 ml/s</source>
        <translation>%1 ml/s</translation>
    </message>
    <message>
        <source>computed</source>
        <translation>berechnet</translation>
    </message>
    <message>
        <source>Run it where %1 is installed: %2 in the folder.</source>
        <translation>Dort starten, wo %1 installiert ist: %2 im Ordner.</translation>
    </message>
    <message>
        <source>%1 is not on the PATH. Install OpenFOAM (Debian: apt install openfoam), or run Allrun in the folder where it is installed.</source>
        <translation>%1 ist nicht im PATH. OpenFOAM installieren (Debian: apt install openfoam), oder Allrun im Ordner dort starten, wo es installiert ist.</translation>
    </message>
    <message>
        <source>Flow case</source>
        <translation>Strömungsfall</translation>
    </message>
    <message>
        <source>Write the case</source>
        <translation>Fall schreiben</translation>
    </message>
    <message>
        <source>C&amp;hoose…</source>
        <translation>Wa&amp;hl…</translation>
    </message>
    <message>
        <source>&amp;Mesh</source>
        <translation>&amp;Netz</translation>
    </message>
    <message>
        <source>Inlets and outlets</source>
        <translation>Ein- und Auslässe</translation>
    </message>
    <message>
        <source>Open end</source>
        <translation>Offenes Ende</translation>
    </message>
    <message>
        <source>Diameter</source>
        <translation>Durchmesser</translation>
    </message>
    <message>
        <source>Mean flow</source>
        <translation>Mittlerer Fluss</translation>
    </message>
    <message>
        <source>&amp;Ends</source>
        <translation>&amp;Enden</translation>
    </message>
    <message>
        <source>Solver</source>
        <translation>Löser</translation>
    </message>
    <message>
        <source>&amp;Solver</source>
        <translation>&amp;Löser</translation>
    </message>
    <message>
        <source>Flow through each inlet</source>
        <translation>Fluss durch jeden Einlass</translation>
    </message>
    <message>
        <source>by its diameter</source>
        <translation>nach seinem Durchmesser</translation>
    </message>
    <message>
        <source>the same through each inlet</source>
        <translation>gleich viel durch jeden Einlass</translation>
    </message>
    <message>
        <source>By its diameter: 1.43 d^2.55 (SI), measured in human coronary arteries (van der Giessen 2011)</source>
        <translation>Nach seinem Durchmesser: 1.43 d^2.55 (SI), gemessen in menschlichen Herzkranzgefäßen (van der Giessen 2011)</translation>
    </message>
    <message>
        <source> ml/s</source>
        <translation> ml/s</translation>
    </message>
    <message>
        <source>&amp;Flow in</source>
        <translation>&amp;Zufluss</translation>
    </message>
    <message>
        <source>Course over time</source>
        <translation>Verlauf über die Zeit</translation>
    </message>
    <message>
        <source>steady</source>
        <translation>stationär</translation>
    </message>
    <message>
        <source>pulse of a left coronary artery (model)</source>
        <translation>Puls einer linken Koronararterie (Modell)</translation>
    </message>
    <message>
        <source>pulse of a right coronary artery (model)</source>
        <translation>Puls einer rechten Koronararterie (Modell)</translation>
    </message>
    <message>
        <source>&amp;Time</source>
        <translation>&amp;Verlauf</translation>
    </message>
    <message>
        <source>Outlets</source>
        <translation>Auslässe</translation>
    </message>
    <message>
        <source>a share of the flow each, by diameter</source>
        <translation>je ein Anteil am Fluss, nach Durchmesser</translation>
    </message>
    <message>
        <source>pressure 0 at each</source>
        <translation>Druck 0 an jedem</translation>
    </message>
    <message>
        <source>resistances, by diameter</source>
        <translation>Widerstände, nach Durchmesser</translation>
    </message>
    <message>
        <source>Shares and resistances go as the diameter to 2.27 (van der Giessen 2011); together the resistances take 90 mmHg.</source>
        <translation>Anteile und Widerstände gehen mit dem Durchmesser hoch 2.27 (van der Giessen 2011); zusammen nehmen die Widerstände 90 mmHg auf.</translation>
    </message>
    <message>
        <source>&amp;Outlets</source>
        <translation>&amp;Auslässe</translation>
    </message>
    <message>
        <source>Viscosity of blood</source>
        <translation>Viskosität des Bluts</translation>
    </message>
    <message>
        <source>Newtonian</source>
        <translation>newtonsch</translation>
    </message>
    <message>
        <source>shear-thinning</source>
        <translation>scherverdünnend</translation>
    </message>
    <message>
        <source>Shear-thinning: the law of Carreau (Cho and Kensey 1991)</source>
        <translation>Scherverdünnend: das Gesetz von Carreau (Cho und Kensey 1991)</translation>
    </message>
    <message>
        <source>Viscosity</source>
        <translation>Viskosität</translation>
    </message>
    <message>
        <source> mPa s</source>
        <translation> mPa s</translation>
    </message>
    <message>
        <source>Density</source>
        <translation>Dichte</translation>
    </message>
    <message>
        <source> kg/m³</source>
        <translation> kg/m³</translation>
    </message>
    <message>
        <source>&amp;Blood</source>
        <translation>&amp;Blut</translation>
    </message>
    <message>
        <source>&amp;Run the solver when the case is written</source>
        <translation>Löser &amp;starten, wenn der Fall geschrieben ist</translation>
    </message>
    <message>
        <source>There is no mesh.vtu in this folder. Export a mesh from the case.</source>
        <translation>In diesem Ordner ist keine mesh.vtu. Exportieren Sie ein Netz aus dem Fall.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::FlowResults</name>
    <message>
        <source>Open flow results</source>
        <translation>Strömungsergebnisse öffnen</translation>
    </message>
    <message>
        <source>Surfaces with values (*.vtp *.vtk);;All files (*)</source>
        <translation>Oberflächen mit Werten (*.vtp *.vtk);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Flow results</source>
        <translation>Strömungsergebnisse</translation>
    </message>
    <message>
        <source>The results could not be opened</source>
        <translation>Die Ergebnisse konnten nicht geöffnet werden</translation>
    </message>
    <message>
        <source>Save the picture</source>
        <translation>Das Bild speichern</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Bilder (*.png)</translation>
    </message>
    <message>
        <source>The picture is in %1.</source>
        <translation>Das Bild liegt in %1.</translation>
    </message>
    <message>
        <source>%1: mean (least to greatest)</source>
        <translation>%1: Mittel (kleinste bis größte)</translation>
    </message>
    <message>
        <source>Flow along the vessels</source>
        <translation>Strömung entlang der Gefäße</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::GreyPresets</name>
    <message>
        <source>Save these grey levels</source>
        <translation>Diese Graustufen speichern</translation>
    </message>
    <message>
        <source>Name of window %1, level %2:</source>
        <translation>Name für Breite %1, Lage %2:</translation>
    </message>
    <message>
        <source>There are no grey levels of your own yet.</source>
        <translation>Es gibt noch keine eigenen Graustufen.</translation>
    </message>
    <message>
        <source>Forget grey levels</source>
        <translation>Graustufen vergessen</translation>
    </message>
    <message>
        <source>Which:</source>
        <translation>Welche:</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Hanging</name>
    <message>
        <source>Tree</source>
        <translation>Baum</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::HeartDock</name>
    <message>
        <source>Heart in 3D</source>
        <translation>Herz in 3D</translation>
    </message>
    <message>
        <source>Look</source>
        <translation>Darstellung</translation>
    </message>
    <message>
        <source>Coronary arteries</source>
        <translation>Koronararterien</translation>
    </message>
    <message>
        <source>Contrast alone</source>
        <translation>Nur Kontrast</translation>
    </message>
    <message>
        <source>Soft tissue</source>
        <translation>Weichteile</translation>
    </message>
    <message>
        <source>Bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>Shift</source>
        <translation>Verschieben</translation>
    </message>
    <message>
        <source>To the right: only what is denser is seen</source>
        <translation>Nach rechts: nur Dichteres ist zu sehen</translation>
    </message>
    <message>
        <source>Softness</source>
        <translation>Weichheit</translation>
    </message>
    <message>
        <source>To the left: hard edges. To the right: soft ones</source>
        <translation>Nach links: harte Kanten. Nach rechts: weiche</translation>
    </message>
    <message>
        <source>Box</source>
        <translation>Box</translation>
    </message>
    <message>
        <source>Right to left</source>
        <translation>Rechts nach links</translation>
    </message>
    <message>
        <source>Front to back</source>
        <translation>Vorn nach hinten</translation>
    </message>
    <message>
        <source>Feet to head</source>
        <translation>Füße nach Kopf</translation>
    </message>
    <message>
        <source>%1: from</source>
        <translation>%1: von</translation>
    </message>
    <message>
        <source>%1: to</source>
        <translation>%1: bis</translation>
    </message>
    <message>
        <source>No box</source>
        <translation>Keine Box</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::HistogramWidget</name>
    <message>
        <source>%1 to %2: %3 elements</source>
        <translation>%1 bis %2: %3 Elemente</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Jobs</name>
    <message>
        <source>%1 s left</source>
        <translation>noch %1 s</translation>
    </message>
    <message>
        <source>%1 min left</source>
        <translation>noch %1 min</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Cancel %1</source>
        <translation>%1 abbrechen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Close %1</source>
        <translation>%1 schließen</translation>
    </message>
    <message>
        <source>the report</source>
        <translation>der Bericht</translation>
    </message>
    <message>
        <source>the surface</source>
        <translation>die Oberfläche</translation>
    </message>
    <message>
        <source>the mesh</source>
        <translation>das Netz</translation>
    </message>
    <message>
        <source>the flow case</source>
        <translation>der Strömungsfall</translation>
    </message>
    <message>
        <source>the solver&apos;s run</source>
        <translation>der Lauf des Lösers</translation>
    </message>
    <message>
        <source>Not finished yet: %1. It is lost if the window closes now; the case is safe.</source>
        <translation>Noch nicht fertig: %1. Es geht verloren, wenn das Fenster jetzt geschlossen wird; der Fall ist sicher.</translation>
    </message>
    <message>
        <source>Close all the same</source>
        <translation>Trotzdem schließen</translation>
    </message>
    <message>
        <source>Go on working</source>
        <translation>Weiterarbeiten</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Layouts</name>
    <message>
        <source>Save this layout</source>
        <translation>Diese Anordnung speichern</translation>
    </message>
    <message>
        <source>Its name:</source>
        <translation>Ihr Name:</translation>
    </message>
    <message>
        <source>There is no layout of your own yet.</source>
        <translation>Es gibt noch keine eigene Anordnung.</translation>
    </message>
    <message>
        <source>Forget a layout</source>
        <translation>Eine Anordnung vergessen</translation>
    </message>
    <message>
        <source>Which:</source>
        <translation>Welche:</translation>
    </message>
    <message>
        <source>The window begins as it was left.</source>
        <translation>Das Fenster beginnt, wie es verlassen wurde.</translation>
    </message>
    <message>
        <source>The window begins with this layout.</source>
        <translation>Das Fenster beginnt mit dieser Anordnung.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::LesionChanges</name>
    <message>
        <source>in both</source>
        <translation>in beiden</translation>
    </message>
    <message>
        <source>new</source>
        <translation>neu</translation>
    </message>
    <message>
        <source>gone</source>
        <translation>verschwunden</translation>
    </message>
    <message>
        <source>not reached before</source>
        <translation>früher nicht erreicht</translation>
    </message>
    <message>
        <source>not reached now</source>
        <translation>jetzt nicht erreicht</translation>
    </message>
    <message>
        <source>Lesion</source>
        <translation>Läsion</translation>
    </message>
    <message>
        <source>Vessel</source>
        <translation>Gefäß</translation>
    </message>
    <message>
        <source>Before → now</source>
        <translation>Früher → jetzt</translation>
    </message>
    <message>
        <source>MLD, mm</source>
        <translation>MLD, mm</translation>
    </message>
    <message>
        <source>MLA, mm²</source>
        <translation>MLA, mm²</translation>
    </message>
    <message>
        <source>Stenosis, %</source>
        <translation>Stenose, %</translation>
    </message>
    <message>
        <source>Plaque, mm³</source>
        <translation>Plaque, mm³</translation>
    </message>
    <message>
        <source>Lesions before and now</source>
        <translation>Läsionen früher und jetzt</translation>
    </message>
    <message>
        <source>Both scans go to the lesion. * differs by more than two scans of an unchanged patient do (smallest real difference, 95 %).</source>
        <translation>Beide Aufnahmen gehen zur Läsion. * unterscheidet sich um mehr, als zwei Aufnahmen eines unveränderten Patienten es tun (kleinster echter Unterschied, 95 %).</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::LesionList</name>
    <message>
        <source>Lesions</source>
        <translation>Läsionen</translation>
    </message>
    <message>
        <source>Filter the lesions</source>
        <translation>Läsionen filtern</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filter</translation>
    </message>
    <message>
        <source>Shows the rows alone that have this text in one of their cells.</source>
        <translation>Zeigt nur die Zeilen, in denen dieser Text steht.</translation>
    </message>
    <message>
        <source>State of the lesions that are shown</source>
        <translation>Urteil der Läsionen, die gezeigt werden</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>plaque: %1 to go</source>
        <translation>Plaque: noch %1</translation>
    </message>
    <message>
        <source>Vessels whose plaque is not known yet; their lesions may become more.</source>
        <translation>Gefäße, deren Plaque noch nicht bekannt ist; ihre Läsionen können mehr werden.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::MainWindow</name>
    <message>
        <source>The truth cannot be opened</source>
        <translation>Die Wahrheit lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>Drop one case, image or folder at a time; of a DICOM series drop its folder.</source>
        <translation>Bitte nur einen Fall, ein Bild oder einen Ordner auf einmal ablegen, von einer DICOM-Serie ihren Ordner.</translation>
    </message>
    <message>
        <source>Read-only</source>
        <translation>Schreibgeschützt</translation>
    </message>
    <message>
        <source>The case&apos;s file or its folder may not be written. File &gt; Save the case as makes a copy that can be edited.</source>
        <translation>Die Datei des Falls oder ihr Ordner darf nicht beschrieben werden. Datei &gt; Fall speichern als legt eine Kopie an, die sich bearbeiten lässt.</translation>
    </message>
    <message>
        <source>Ostia – read-only</source>
        <translation>Ostia – schreibgeschützt</translation>
    </message>
    <message>
        <source>%1 – read-only</source>
        <translation>%1 – nur lesbar</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ManualDialog</name>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>Contents</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>The manual&apos;s pages</source>
        <translation>Die Seiten des Handbuchs</translation>
    </message>
    <message>
        <source>Page of the manual</source>
        <translation>Seite des Handbuchs</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>The page before</source>
        <translation>Die Seite davor</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::MeasurementList</name>
    <message>
        <source>Filter the measurements</source>
        <translation>Messungen filtern</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filter</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Measurement</source>
        <translation>Messung</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Menus</name>
    <message>
        <source>Plug-&amp;ins</source>
        <translation>&amp;Plug-ins</translation>
    </message>
    <message>
        <source>Windows of their own</source>
        <translation>Eigene Fenster</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>&amp;Recent cases</source>
        <translation>&amp;Letzte Fälle</translation>
    </message>
    <message>
        <source>&amp;Export</source>
        <translation>&amp;Exportieren</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>Ve&amp;ssel</source>
        <translation>&amp;Gefäß</translation>
    </message>
    <message>
        <source>&amp;Tools</source>
        <translation>&amp;Werkzeuge</translation>
    </message>
    <message>
        <source>Vessel t&amp;ree</source>
        <translation>Gefäß&amp;baum</translation>
    </message>
    <message>
        <source>Mouse by keys</source>
        <translation>Maus mit Tasten</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>S&amp;lab</source>
        <translation>&amp;Schicht</translation>
    </message>
    <message>
        <source>Look at the tree from</source>
        <translation>Den Baum ansehen von</translation>
    </message>
    <message>
        <source>Go to</source>
        <translation>Gehe zu</translation>
    </message>
    <message>
        <source>Panels</source>
        <translation>Felder</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>&amp;Grey levels</source>
        <translation>&amp;Graustufen</translation>
    </message>
    <message>
        <source>La&amp;youts</source>
        <translation>An&amp;ordnungen</translation>
    </message>
    <message>
        <source>Heart in &amp;3D</source>
        <translation>Herz in &amp;3D</translation>
    </message>
    <message>
        <source>Series and phases</source>
        <translation>Serien und Phasen</translation>
    </message>
    <message>
        <source>&amp;Pressure</source>
        <translation>&amp;Druck</translation>
    </message>
    <message>
        <source>PACS</source>
        <translation>PACS</translation>
    </message>
    <message>
        <source>Calci&amp;um score</source>
        <translation>Kal&amp;kscore</translation>
    </message>
    <message>
        <source>Compared with the &amp;last scan</source>
        <translation>Verglichen mit der &amp;letzten Aufnahme</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::MeshDock</name>
    <message>
        <source>Mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>No mesh has been made yet.</source>
        <translation>Es wurde noch kein Netz erzeugt.</translation>
    </message>
    <message>
        <source>How many elements have which value</source>
        <translation>Wie viele Elemente welchen Wert haben</translation>
    </message>
    <message>
        <source>&amp;Worst elements</source>
        <translation>&amp;Schlechteste Elemente</translation>
    </message>
    <message>
        <source>Worst elements</source>
        <translation>Schlechteste Elemente</translation>
    </message>
    <message>
        <source>A click shows the element in 3D.</source>
        <translation>Ein Klick zeigt das Element in 3D.</translation>
    </message>
    <message>
        <source>What the colours show</source>
        <translation>Was die Farben zeigen</translation>
    </message>
    <message>
        <source>E&amp;dges</source>
        <translation>&amp;Kanten</translation>
    </message>
    <message>
        <source>&amp;Colours</source>
        <translation>Fa&amp;rben</translation>
    </message>
    <message>
        <source>How the mesh is cut open</source>
        <translation>Wie das Netz aufgeschnitten ist</translation>
    </message>
    <message>
        <source>not at all</source>
        <translation>gar nicht</translation>
    </message>
    <message>
        <source>across the selected vessel</source>
        <translation>quer zum gewählten Gefäß</translation>
    </message>
    <message>
        <source>left and right</source>
        <translation>links und rechts</translation>
    </message>
    <message>
        <source>front and back</source>
        <translation>vorn und hinten</translation>
    </message>
    <message>
        <source>head and feet</source>
        <translation>Kopf und Füße</translation>
    </message>
    <message>
        <source>towards the viewer</source>
        <translation>zum Betrachter hin</translation>
    </message>
    <message>
        <source>Place of the cut</source>
        <translation>Ort des Schnitts</translation>
    </message>
    <message>
        <source>The &amp;other side</source>
        <translation>Die a&amp;ndere Seite</translation>
    </message>
    <message>
        <source>C&amp;ut</source>
        <translation>Schn&amp;itt</translation>
    </message>
    <message>
        <source>%1: %2 tetrahedra, %3 prisms</source>
        <translation>%1: %2 Tetraeder, %3 Prismen</translation>
    </message>
    <message>
        <source>Worst %1, mean %2</source>
        <translation>Schlechtester %1, Mittel %2</translation>
    </message>
    <message>
        <source>%1 at (%2, %3, %4) mm</source>
        <translation>%1 bei (%2, %3, %4) mm</translation>
    </message>
    <message>
        <source>Passes the quality control.</source>
        <translation>Besteht die Qualitätskontrolle.</translation>
    </message>
    <message>
        <source>Does not pass the quality control: %1</source>
        <translation>Besteht die Qualitätskontrolle nicht: %1</translation>
    </message>
    <message>
        <source>Edges of the elements</source>
        <translation>Kanten der Elemente</translation>
    </message>
    <message>
        <source>Of a whole tree there are more edges than pixels: they are drawn where they are near.</source>
        <translation>Ein ganzer Baum hat mehr Kanten als Bildpunkte: sie werden gezeichnet, wo sie nah sind.</translation>
    </message>
    <message>
        <source>where they are near</source>
        <translation>wo sie nah sind</translation>
    </message>
    <message>
        <source>always</source>
        <translation>immer</translation>
    </message>
    <message>
        <source>never</source>
        <translation>nie</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::MeshingCheck</name>
    <message>
        <source>Edges %1 times as long</source>
        <translation>Kanten %1-mal so lang</translation>
    </message>
    <message>
        <source>Layers %1 times as thick</source>
        <translation>Schichten %1-mal so dick</translation>
    </message>
    <message>
        <source>No layers</source>
        <translation>Keine Schichten</translation>
    </message>
    <message>
        <source>Change the settings</source>
        <translation>Einstellungen ändern</translation>
    </message>
    <message>
        <source>The unit looks wrong</source>
        <translation>Die Einheit scheint falsch</translation>
    </message>
    <message>
        <source>Points without a place</source>
        <translation>Punkte ohne Ort</translation>
    </message>
    <message>
        <source>A hole in the wall</source>
        <translation>Ein Loch in der Wand</translation>
    </message>
    <message>
        <source>Edges of more than two triangles</source>
        <translation>Kanten von mehr als zwei Dreiecken</translation>
    </message>
    <message>
        <source>Triangles that look the wrong way</source>
        <translation>Dreiecke, die zur falschen Seite zeigen</translation>
    </message>
    <message>
        <source>The wall is inside out</source>
        <translation>Die Wand ist nach innen gekehrt</translation>
    </message>
    <message>
        <source>The wall crosses itself</source>
        <translation>Die Wand durchdringt sich</translation>
    </message>
    <message>
        <source>Two walls nearly touch</source>
        <translation>Zwei Wände berühren sich fast</translation>
    </message>
    <message>
        <source>Few edges across the lumen</source>
        <translation>Wenige Kanten quer durchs Lumen</translation>
    </message>
    <message>
        <source>An edge length that cannot be</source>
        <translation>Eine unmögliche Kantenlänge</translation>
    </message>
    <message>
        <source>An end smaller than its elements</source>
        <translation>Ein Ende, kleiner als seine Elemente</translation>
    </message>
    <message>
        <source>A fold in which layers cannot grow</source>
        <translation>Eine Falte, in der keine Schichten wachsen</translation>
    </message>
    <message>
        <source>Little room for layers</source>
        <translation>Wenig Platz für Schichten</translation>
    </message>
    <message>
        <source>Looks for what would fail or come out poor, without meshing; the places are shown in 3D.</source>
        <translation>Sucht, was scheitern oder schlecht würde, ohne zu vernetzen; die Stellen werden in 3D gezeigt.</translation>
    </message>
    <message>
        <source>Places that would fail or come out poor</source>
        <translation>Stellen, die scheitern oder schlecht würden</translation>
    </message>
    <message>
        <source>Changes the fields of this dialog; check again afterwards.</source>
        <translation>Ändert die Felder dieses Dialogs; danach erneut prüfen.</translation>
    </message>
    <message>
        <source>Looking…</source>
        <translation>Es wird gesucht …</translation>
    </message>
    <message>
        <source>Nothing was found that would fail.</source>
        <translation>Nichts gefunden, was scheitern würde.</translation>
    </message>
    <message>
        <source>Would fail: %1. Would come out poor: %2.</source>
        <translation>Würde scheitern: %1. Würde schlecht: %2.</translation>
    </message>
    <message>
        <source>fails: %1</source>
        <translation>scheitert: %1</translation>
    </message>
    <message>
        <source>poor: %1</source>
        <translation>schlecht: %1</translation>
    </message>
    <message>
        <source>Shows what would fail before anything is meshed.</source>
        <translation>Zeigt, was scheitern würde, bevor vernetzt wird.</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>An&amp;halten</translation>
    </message>
    <message>
        <source>Chec&amp;k</source>
        <translation>&amp;Prüfen</translation>
    </message>
    <message>
        <source>The settings have changed: check again.</source>
        <translation>Die Einstellungen sind geändert: erneut prüfen.</translation>
    </message>
    <message>
        <source>%1. Way out: %2.</source>
        <translation>%1. Ausweg: %2.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::MeshingDialog</name>
    <message>
        <source>%1 million</source>
        <translation>%1 Millionen</translation>
    </message>
    <message>
        <source>Mesh and export</source>
        <translation>Vernetzen und exportieren</translation>
    </message>
    <message>
        <source>Export the surface</source>
        <translation>Oberfläche exportieren</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>Vessels</source>
        <translation>Gefäße</translation>
    </message>
    <message>
        <source>all, %1</source>
        <translation>alle, %1</translation>
    </message>
    <message>
        <source>those shown in 3D: %1</source>
        <translation>die in 3D gezeigten: %1</translation>
    </message>
    <message>
        <source>the selected one: %1</source>
        <translation>das ausgewählte: %1</translation>
    </message>
    <message>
        <source>&amp;Vessels</source>
        <translation>&amp;Gefäße</translation>
    </message>
    <message>
        <source>Ends</source>
        <translation>Enden</translation>
    </message>
    <message>
        <source>cut flat, closed, faces named</source>
        <translation>eben, geschlossen, Flächen benannt</translation>
    </message>
    <message>
        <source>cut flat, open</source>
        <translation>eben, offen</translation>
    </message>
    <message>
        <source>rounded, as in the model</source>
        <translation>gerundet, wie im Modell</translation>
    </message>
    <message>
        <source>&amp;Ends</source>
        <translation>&amp;Enden</translation>
    </message>
    <message>
        <source>ParaView, VTK; keeps the names of the faces</source>
        <translation>ParaView, VTK; behält die Namen der Flächen</translation>
    </message>
    <message>
        <source>Any program, 3D printers; without names of faces</source>
        <translation>Jedes Programm, 3D-Drucker; ohne Namen der Flächen</translation>
    </message>
    <message>
        <source>MeshLab, Blender; without names of faces</source>
        <translation>MeshLab, Blender; ohne Namen der Flächen</translation>
    </message>
    <message>
        <source>Surface as</source>
        <translation>Oberfläche als</translation>
    </message>
    <message>
        <source>Folder that is made</source>
        <translation>Ordner, der gemacht wird</translation>
    </message>
    <message>
        <source>&amp;Choose…</source>
        <translation>&amp;Wählen…</translation>
    </message>
    <message>
        <source>&amp;New folder</source>
        <translation>&amp;Neuer Ordner</translation>
    </message>
    <message>
        <source>Where the folder is to be</source>
        <translation>Wo der Ordner liegen soll</translation>
    </message>
    <message>
        <source>together with the vessels that they come from: %1</source>
        <translation>zusammen mit den Gefäßen, von denen sie kommen: %1</translation>
    </message>
    <message>
        <source>About %1 cells; more than %2 do not fit. Choose longer edges, or fewer vessels.</source>
        <translation>Etwa %1 Zellen; mehr als %2 gehen nicht. Wählen Sie längere Kanten oder weniger Gefäße.</translation>
    </message>
    <message>
        <source>Choose at least one format.</source>
        <translation>Wählen Sie mindestens ein Format.</translation>
    </message>
    <message>
        <source>Name a new folder.</source>
        <translation>Nennen Sie einen neuen Ordner.</translation>
    </message>
    <message>
        <source>There is a file of this name. Name another folder.</source>
        <translation>Es gibt eine Datei dieses Namens. Nennen Sie einen anderen Ordner.</translation>
    </message>
    <message>
        <source>There is no folder %1.</source>
        <translation>Es gibt keinen Ordner %1.</translation>
    </message>
    <message>
        <source>Nothing can be written in %1. Choose another place.</source>
        <translation>In %1 kann nichts geschrieben werden. Wählen Sie einen anderen Ort.</translation>
    </message>
    <message>
        <source>About %1 cells, %2 triangles on their surface.</source>
        <translation>Etwa %1 Zellen, %2 Dreiecke auf ihrer Oberfläche.</translation>
    </message>
    <message>
        <source>About %1 triangles.</source>
        <translation>Etwa %1 Dreiecke.</translation>
    </message>
    <message>
        <source>The export that is under way will be given up for this one.</source>
        <translation>Der laufende Export wird für diesen aufgegeben.</translation>
    </message>
    <message>
        <source>The folder holds files that are not from an earlier export. Name another one.</source>
        <translation>Im Ordner liegen Dateien, die nicht von einem früheren Export sind. Nennen Sie einen anderen.</translation>
    </message>
    <message>
        <source>Si&amp;zes</source>
        <translation>&amp;Größen</translation>
    </message>
    <message>
        <source>La&amp;yers and elements</source>
        <translation>Schich&amp;ten und Elemente</translation>
    </message>
    <message>
        <source>&amp;Formats</source>
        <translation>&amp;Formate</translation>
    </message>
    <message>
        <source>&amp;Will it mesh?</source>
        <translation>&amp;Wird es ein Netz?</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::MeshingExport</name>
    <message>
        <source>Mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>Oberfläche</translation>
    </message>
    <message>
        <source>The mesh could not be made</source>
        <translation>Das Netz konnte nicht gemacht werden</translation>
    </message>
    <message>
        <source>The surface could not be exported</source>
        <translation>Die Oberfläche konnte nicht exportiert werden</translation>
    </message>
    <message>
        <source>%1: %2 cells, least dihedral angle %3°</source>
        <translation>%1: %2 Zellen, kleinster Diederwinkel %3°</translation>
    </message>
    <message>
        <source>%1: %2 triangles</source>
        <translation>%1: %2 Dreiecke</translation>
    </message>
    <message>
        <source>Open folder</source>
        <translation>Ordner öffnen</translation>
    </message>
    <message>
        <source>The mesh is in %1, but it does not pass the quality control: %2. Look at it before you compute with it, or mesh again with shorter edges.</source>
        <translation>Das Netz ist in %1, besteht aber die Qualitätsprüfung nicht: %2. Sehen Sie es an, bevor Sie damit rechnen, oder vernetzen Sie neu mit kürzeren Kanten.</translation>
    </message>
    <message>
        <source>A mesh to look at</source>
        <translation>Ein Netz zum Ansehen</translation>
    </message>
    <message>
        <source>layers of full thickness on %1 % of the wall</source>
        <translation>Schichten in voller Dicke auf %1 % der Wand</translation>
    </message>
    <message>
        <source>quality passed</source>
        <translation>Qualität bestanden</translation>
    </message>
    <message>
        <source>quality not passed</source>
        <translation>Qualität nicht bestanden</translation>
    </message>
    <message>
        <source>Preparing the mesh&apos;s picture</source>
        <translation>Das Bild des Netzes wird vorbereitet</translation>
    </message>
    <message>
        <source>Open a mesh</source>
        <translation>Netz öffnen</translation>
    </message>
    <message>
        <source>Volume meshes (*.vtu *.msh *.exo *.e *.ex2 *.inp *.cgns *.xdmf points);;All files (*)</source>
        <translation>Volumennetze (*.vtu *.msh *.exo *.e *.ex2 *.inp *.cgns *.xdmf points);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Opening the mesh</source>
        <translation>Das Netz wird geöffnet</translation>
    </message>
    <message>
        <source>The mesh could not be opened</source>
        <translation>Das Netz konnte nicht geöffnet werden</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::MeshingForecast</name>
    <message>
        <source>Will it mesh?</source>
        <translation>Wird es ein Netz?</translation>
    </message>
    <message>
        <source>It would fail: %1</source>
        <translation>Es würde scheitern: %1</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Messages</name>
    <message>
        <source>There is not enough memory for this. The case is unchanged.</source>
        <translation>Dafür reicht der Arbeitsspeicher nicht. Der Fall ist unverändert.</translation>
    </message>
    <message>
        <source>This case can be looked at and not changed: its file or folder may not be written. Choose File &gt; Save the case as, and go on in the copy.</source>
        <translation>Dieser Fall kann angesehen, aber nicht geändert werden: Seine Datei oder sein Ordner darf nicht beschrieben werden. Wählen Sie Datei &gt; Fall speichern als und arbeiten Sie in der Kopie weiter.</translation>
    </message>
    <message>
        <source>A read-only case</source>
        <translation>Ein schreibgeschützter Fall</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::MessagesDialog</name>
    <message>
        <source>Messages</source>
        <translation>Meldungen</translation>
    </message>
    <message>
        <source>Nothing was said yet.</source>
        <translation>Es wurde noch nichts gesagt.</translation>
    </message>
    <message>
        <source>Copy all</source>
        <translation>Alles kopieren</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Opening</name>
    <message numerus="yes">
        <source>%n vessel(s) of the mask; a question mark says where to look first.</source>
        <translation>
            <numerusform>%n Gefäß der Maske; ein Fragezeichen sagt, wo zuerst hinzusehen ist.</numerusform>
            <numerusform>%n Gefäße der Maske; ein Fragezeichen sagt, wo zuerst hinzusehen ist.</numerusform>
        </translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Cases and images (*.ostia *.nrrd *.mhd *.mha *.nii *.nii.gz *.dcm *.zip);;All files (*)</source>
        <translation>Fälle und Bilder (*.ostia *.nrrd *.mhd *.mha *.nii *.nii.gz *.dcm *.zip);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>Open a folder of DICOM files</source>
        <translation>Ordner mit DICOM-Dateien öffnen</translation>
    </message>
    <message>
        <source>There is no file or folder %1.</source>
        <translation>Es gibt keine Datei und keinen Ordner %1.</translation>
    </message>
    <message>
        <source>Sample case</source>
        <translation>Beispielfall</translation>
    </message>
    <message>
        <source>Opening the case</source>
        <translation>Fall wird geöffnet</translation>
    </message>
    <message>
        <source>The case cannot be opened</source>
        <translation>Der Fall lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>The image of this case</source>
        <translation>Das Bild dieses Falls</translation>
    </message>
    <message>
        <source>The image that this case was made on (%1) is not where it was, or has never been opened on this computer. The case can be looked at without it.</source>
        <translation>Das Bild, an dem dieser Fall entstand (%1), liegt nicht mehr dort, wo es war, oder wurde auf diesem Rechner noch nie geöffnet. Der Fall kann ohne Bild betrachtet werden.</translation>
    </message>
    <message>
        <source>Find the file…</source>
        <translation>Datei suchen…</translation>
    </message>
    <message>
        <source>Find the DICOM folder…</source>
        <translation>DICOM-Ordner suchen…</translation>
    </message>
    <message>
        <source>Go on without</source>
        <translation>Ohne Bild weiter</translation>
    </message>
    <message>
        <source>Looking for series</source>
        <translation>Serien werden gesucht</translation>
    </message>
    <message>
        <source>This cannot be opened</source>
        <translation>Das lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>Reading the image</source>
        <translation>Bild wird gelesen</translation>
    </message>
    <message>
        <source>The image cannot be opened</source>
        <translation>Das Bild lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>Save the case as</source>
        <translation>Fall speichern als</translation>
    </message>
    <message>
        <source>Cases (*.ostia)</source>
        <translation>Fälle (*.ostia)</translation>
    </message>
    <message>
        <source>The program ended without closing this case; it is opened where it was.</source>
        <translation>Das Programm endete, ohne diesen Fall zu schließen; er wird geöffnet, wo er war.</translation>
    </message>
    <message>
        <source>First slice</source>
        <translation>Erste Schicht</translation>
    </message>
    <message>
        <source>What was chosen is another image.</source>
        <translation>Was gewählt wurde, ist ein anderes Bild.</translation>
    </message>
    <message>
        <source>This case can be looked at and not changed: its file or folder is read-only. Save it as another to edit it.</source>
        <translation>Dieser Fall kann angesehen und nicht geändert werden: Seine Datei oder sein Ordner ist schreibgeschützt. Speichern Sie ihn unter einem anderen Namen, um ihn zu bearbeiten.</translation>
    </message>
    <message numerus="yes">
        <source>The program ended without closing this case and %n more, which are among the recent ones.</source>
        <translation>
            <numerusform>Das Programm endete, ohne diesen Fall und %n weiteren zu schließen, der unter den letzten Fällen steht.</numerusform>
            <numerusform>Das Programm endete, ohne diesen Fall und %n weitere zu schließen, die unter den letzten Fällen stehen.</numerusform>
        </translation>
    </message>
    <message>
        <source>Vessel trees (*.vtp *.vtk *.swc *.csv *.gxl *.xml *.dat)</source>
        <translation>Gefäßbäume (*.vtp *.vtk *.swc *.csv *.gxl *.xml *.dat)</translation>
    </message>
    <message>
        <source>none yet</source>
        <translation>noch keine</translation>
    </message>
    <message>
        <source>Turning the image</source>
        <translation>Das Bild wird gedreht</translation>
    </message>
    <message>
        <source>The image cannot be turned</source>
        <translation>Das Bild kann nicht gedreht werden</translation>
    </message>
    <message>
        <source>The image is turned as a person said: File &gt; Set orientation.</source>
        <translation>Das Bild liegt, wie es von Hand angegeben wurde: Datei &gt; Orientierung angeben.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::OrientationDialog</name>
    <message>
        <source>Set orientation</source>
        <translation>Orientierung angeben</translation>
    </message>
    <message>
        <source>Turn and flip until the letters are right: the breastbone at A, the spine at P, the heart&apos;s tip towards L, the liver at R and I.</source>
        <translation>Drehen und spiegeln Sie, bis die Buchstaben stimmen: das Brustbein bei A, die Wirbelsäule bei P, die Herzspitze gegen L, die Leber bei R und I.</translation>
    </message>
    <message>
        <source>The case that is open was made of the image as it was. It is kept and closed; the arteries are looked for anew.</source>
        <translation>Der offene Fall wurde am Bild gemacht, wie es war. Er bleibt erhalten und wird geschlossen; die Arterien werden neu gesucht.</translation>
    </message>
    <message>
        <source>As in the file</source>
        <translation>Wie in der Datei</translation>
    </message>
    <message>
        <source>Axial, seen from the feet</source>
        <translation>Axial, von den Füßen gesehen</translation>
    </message>
    <message>
        <source>Coronal, seen from the front</source>
        <translation>Koronal, von vorn gesehen</translation>
    </message>
    <message>
        <source>Sagittal, seen from the left</source>
        <translation>Sagittal, von links gesehen</translation>
    </message>
    <message>
        <source>Turn by 90°</source>
        <translation>Um 90° drehen</translation>
    </message>
    <message>
        <source>Turn by 90°: %1</source>
        <translation>Um 90° drehen: %1</translation>
    </message>
    <message>
        <source>Columns run towards</source>
        <translation>Spalten laufen nach</translation>
    </message>
    <message>
        <source>Rows run towards</source>
        <translation>Zeilen laufen nach</translation>
    </message>
    <message>
        <source>Slices run towards</source>
        <translation>Schichten laufen nach</translation>
    </message>
    <message>
        <source>Left (L)</source>
        <translation>links (L)</translation>
    </message>
    <message>
        <source>Right (R)</source>
        <translation>rechts (R)</translation>
    </message>
    <message>
        <source>Back (P)</source>
        <translation>hinten (P)</translation>
    </message>
    <message>
        <source>Front (A)</source>
        <translation>vorn (A)</translation>
    </message>
    <message>
        <source>Head (S)</source>
        <translation>oben, Kopf (S)</translation>
    </message>
    <message>
        <source>Feet (I)</source>
        <translation>unten, Füße (I)</translation>
    </message>
    <message>
        <source>Flip left and right</source>
        <translation>Links und rechts tauschen</translation>
    </message>
    <message>
        <source>Flip front and back</source>
        <translation>Vorn und hinten tauschen</translation>
    </message>
    <message>
        <source>Flip head and feet</source>
        <translation>Kopf und Füße tauschen</translation>
    </message>
    <message>
        <source>Axes %1, as the file says.</source>
        <translation>Achsen %1, wie die Datei sagt.</translation>
    </message>
    <message>
        <source>Axes %1; the file says %2.</source>
        <translation>Achsen %1; die Datei sagt %2.</translation>
    </message>
    <message>
        <source>This mirrors the patient: left and right of the heart are exchanged against the file. Be sure of it.</source>
        <translation>Das spiegelt die Person: links und rechts des Herzens sind gegen die Datei vertauscht. Seien Sie sich sicher.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Outbox</name>
    <message>
        <source>Sending to the PACS</source>
        <translation>Senden an das PACS</translation>
    </message>
    <message>
        <source>All is sent to the PACS.</source>
        <translation>Alles ist an das PACS gesendet.</translation>
    </message>
    <message>
        <source>Not sent: %1 wait, %2 were refused; File &gt; PACS &gt; Outbox says why.</source>
        <translation>Nicht gesendet: %1 warten, %2 wurden abgelehnt; Datei &gt; PACS &gt; Postausgang sagt, warum.</translation>
    </message>
    <message>
        <source>The outbox was not sent</source>
        <translation>Der Postausgang wurde nicht gesendet</translation>
    </message>
    <message>
        <source>No case is open.</source>
        <translation>Es ist kein Fall offen.</translation>
    </message>
    <message>
        <source>The image of the case is not open.</source>
        <translation>Das Bild des Falls ist nicht offen.</translation>
    </message>
    <message>
        <source>The image of the case is no DICOM series: its objects would be nobody&apos;s.</source>
        <translation>Das Bild des Falls ist keine DICOM-Serie: Seine Objekte wären von niemandem.</translation>
    </message>
    <message>
        <source>The image is turned against its files: objects would lie elsewhere than in them.</source>
        <translation>Das Bild ist gegen seine Dateien gedreht: Objekte lägen anderswo als in ihnen.</translation>
    </message>
    <message>
        <source>Making DICOM objects</source>
        <translation>DICOM-Objekte entstehen</translation>
    </message>
    <message>
        <source>Nothing was sent</source>
        <translation>Nichts wurde gesendet</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::OutboxDialog</name>
    <message>
        <source>waiting</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>sent</source>
        <translation>gesendet</translation>
    </message>
    <message>
        <source>refused</source>
        <translation>abgelehnt</translation>
    </message>
    <message>
        <source>Outbox</source>
        <translation>Postausgang</translation>
    </message>
    <message>
        <source>What is sent to the PACS</source>
        <translation>Was an das PACS gesendet wird</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>To</source>
        <translation>An</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Stand</translation>
    </message>
    <message>
        <source>Tries</source>
        <translation>Versuche</translation>
    </message>
    <message>
        <source>Why</source>
        <translation>Warum</translation>
    </message>
    <message>
        <source>&amp;Send what waits</source>
        <translation>&amp;Senden, was wartet</translation>
    </message>
    <message>
        <source>&amp;Try again</source>
        <translation>&amp;Noch einmal</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>Takes what is chosen out of the outbox; what was not sent is not sent any more.</source>
        <translation>Nimmt das Gewählte aus dem Postausgang; was nicht gesendet war, wird nicht mehr gesendet.</translation>
    </message>
    <message>
        <source>Sending…</source>
        <translation>Wird gesendet…</translation>
    </message>
    <message>
        <source>Nothing waits to be sent.</source>
        <translation>Nichts wartet.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::OuterWalls</name>
    <message>
        <source>Plaque %1 mm³ (low attenuation %2, fibrofatty %3, fibrous %4, calcified %5), burden %6 %; the outer wall is seen on %7 % of it</source>
        <translation>Plaque %1 mm³ (niedrige Dichte %2, fibrofettig %3, fibrös %4, verkalkt %5), Plaquelast %6 %; die Außenwand ist auf %7 % davon zu sehen</translation>
    </message>
    <message>
        <source>Outer wall</source>
        <translation>Außenwand</translation>
    </message>
    <message>
        <source>Stenosis %1 %</source>
        <translation>Stenose %1 %</translation>
    </message>
    <message>
        <source>its plaque is known with the outer wall (View &gt; Outer wall)</source>
        <translation>ihre Plaque ist mit der Außenwand bekannt (Ansicht &gt; Außenwand)</translation>
    </message>
    <message>
        <source>plaque %1 mm³</source>
        <translation>Plaque %1 mm³</translation>
    </message>
    <message>
        <source>low attenuation %1, fibrofatty %2, fibrous %3, calcified %4</source>
        <translation>niedrige Dichte %1, fibrofettig %2, fibrös %3, verkalkt %4</translation>
    </message>
    <message>
        <source>burden %1 %</source>
        <translation>Plaquelast %1 %</translation>
    </message>
    <message>
        <source>remodelling index %1</source>
        <translation>Remodelling-Index %1</translation>
    </message>
    <message>
        <source>There is no case with its image.</source>
        <translation>Es ist kein Fall mit seinem Bild geöffnet.</translation>
    </message>
    <message>
        <source>No outer wall was found along this vessel.</source>
        <translation>An diesem Gefäß wurde keine Außenwand gefunden.</translation>
    </message>
    <message>
        <source>No outer wall is known along this vessel: switch on Outer wall, and it is looked for.</source>
        <translation>An diesem Gefäß ist keine Außenwand bekannt: Außenwand einschalten, dann wird sie gesucht.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Palette</name>
    <message>
        <source>Find a command</source>
        <translation>Befehl suchen</translation>
    </message>
    <message>
        <source>Type what you want to do</source>
        <translation>Tippen Sie, was Sie tun wollen</translation>
    </message>
    <message>
        <source>What you want to do</source>
        <translation>Was Sie tun wollen</translation>
    </message>
    <message>
        <source>Commands that fit</source>
        <translation>Passende Befehle</translation>
    </message>
    <message>
        <source>No command fits.</source>
        <translation>Kein Befehl passt.</translation>
    </message>
    <message numerus="yes">
        <source>%n command(s)   ·   ↑ ↓ choose   ·   Enter runs it   ·   Esc closes</source>
        <translation>
            <numerusform>%n Befehl   ·   ↑ ↓ wählen   ·   Eingabe führt aus   ·   Esc schließt</numerusform>
            <numerusform>%n Befehle   ·   ↑ ↓ wählen   ·   Eingabe führt aus   ·   Esc schließt</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Panel</name>
    <message>
        <source>Back into the window</source>
        <translation>Zurück ins Fenster</translation>
    </message>
    <message>
        <source>A window of its own</source>
        <translation>Ein eigenes Fenster</translation>
    </message>
    <message>
        <source>Double click: this view alone, and back
Right click: a window of its own, and back</source>
        <translation>Doppelklick: diese Ansicht allein, und zurück
Rechtsklick: ein eigenes Fenster, und zurück</translation>
    </message>
    <message>
        <source>This view alone, and back</source>
        <translation>Diese Ansicht allein, und zurück</translation>
    </message>
    <message>
        <source>Maximise %1</source>
        <translation>%1 maximieren</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PanelLayout</name>
    <message>
        <source>Doubts</source>
        <translation>Zweifel</translation>
    </message>
    <message>
        <source>Measurements and steps</source>
        <translation>Messungen und Schritte</translation>
    </message>
    <message>
        <source>Lesions</source>
        <translation>Läsionen</translation>
    </message>
    <message>
        <source>Lumen profile</source>
        <translation>Lumenprofil</translation>
    </message>
    <message>
        <source>CPR</source>
        <translation>CPR</translation>
    </message>
    <message>
        <source>CPR + 90°</source>
        <translation>CPR + 90°</translation>
    </message>
    <message>
        <source>Cross-section, %1 mm on</source>
        <translation>Querschnitt, %1 mm weiter</translation>
    </message>
    <message>
        <source>Slice</source>
        <translation>Schichtbild</translation>
    </message>
    <message>
        <source>Axial</source>
        <translation>Axial</translation>
    </message>
    <message>
        <source>Coronal</source>
        <translation>Koronar</translation>
    </message>
    <message>
        <source>Sagittal</source>
        <translation>Sagittal</translation>
    </message>
    <message>
        <source>Oblique</source>
        <translation>Schräg</translation>
    </message>
    <message>
        <source>Oblique: Shift and drag turns it</source>
        <translation>Schräg: Umschalt und Ziehen dreht</translation>
    </message>
    <message>
        <source>Orientation of the slice</source>
        <translation>Ausrichtung der Schicht</translation>
    </message>
    <message>
        <source>Cross-section</source>
        <translation>Querschnitt</translation>
    </message>
    <message>
        <source>Neighbours, every %1 mm</source>
        <translation>Nachbarn, alle %1 mm</translation>
    </message>
    <message>
        <source>Coronary tree</source>
        <translation>Koronarbaum</translation>
    </message>
    <message>
        <source>Vessels</source>
        <translation>Gefäße</translation>
    </message>
    <message>
        <source>Measurements</source>
        <translation>Messungen</translation>
    </message>
    <message>
        <source>Steps</source>
        <translation>Schritte</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PhaseBar</name>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Back to the phase that the case is of</source>
        <translation>Zurück zur Phase des Falls</translation>
    </message>
    <message>
        <source>Chooses the folder with the images of the phases</source>
        <translation>Wählt den Ordner mit den Bildern der Phasen</translation>
    </message>
    <message>
        <source>Shows the selected vessel&apos;s lumen over the cycle</source>
        <translation>Zeigt das Lumen des gewählten Gefäßes über den Herzzyklus</translation>
    </message>
    <message>
        <source>Loop</source>
        <translation>Schleife</translation>
    </message>
    <message>
        <source>Close the motion</source>
        <translation>Bewegung schließen</translation>
    </message>
    <message>
        <source>Phase, % of RR</source>
        <translation>Phase, % von RR</translation>
    </message>
    <message>
        <source> %</source>
        <translation> %</translation>
    </message>
    <message>
        <source>Beats a minute</source>
        <translation>Schläge pro Minute</translation>
    </message>
    <message>
        <source> /min</source>
        <translation> /min</translation>
    </message>
    <message>
        <source>4D profile</source>
        <translation>4D-Profil</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Back to %1</source>
        <translation>Zurück zu %1</translation>
    </message>
    <message>
        <source>Edited at %1 only:</source>
        <translation>Bearbeitet wird nur bei %1:</translation>
    </message>
    <message>
        <source>Images…</source>
        <translation>Bilder…</translation>
    </message>
    <message>
        <source>Images: %1</source>
        <translation>Bilder: %1</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PhaseLoader</name>
    <message>
        <source>The image of %1 cannot be read: %2</source>
        <translation>Das Bild bei %1 kann nicht gelesen werden: %2</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PhaseMap</name>
    <message>
        <source>Lumen profile over the cycle</source>
        <translation>Lumenprofil über den Herzzyklus</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source> mm²</source>
        <translation> mm²</translation>
    </message>
    <message>
        <source> %</source>
        <translation> %</translation>
    </message>
    <message>
        <source>Being measured…</source>
        <translation>Wird vermessen…</translation>
    </message>
    <message>
        <source>%1 mm, %2 %: %3</source>
        <translation>%1 mm, %2 %: %3</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PhaseProfile</name>
    <message>
        <source>Lumen over the cycle</source>
        <translation>Lumen über den Herzzyklus</translation>
    </message>
    <message>
        <source>What the colours are</source>
        <translation>Was die Farben zeigen</translation>
    </message>
    <message>
        <source>Diameter</source>
        <translation>Durchmesser</translation>
    </message>
    <message>
        <source>Area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Change of the diameter</source>
        <translation>Änderung des Durchmessers</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PhaseSlider</name>
    <message>
        <source>Phase of the heart</source>
        <translation>Herzphase</translation>
    </message>
    <message>
        <source>Phase of the heart, % of the time between two R peaks</source>
        <translation>Herzphase, % der Zeit zwischen zwei R-Zacken</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PictureWidget</name>
    <message>
        <source>outside the image</source>
        <translation>außerhalb des Bildes</translation>
    </message>
    <message>
        <source>W %1  L %2</source>
        <translation>W %1  L %2</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PlanesDock</name>
    <message>
        <source>Three planes</source>
        <translation>Drei Ebenen</translation>
    </message>
    <message>
        <source>Axial plane</source>
        <translation>Axiale Ebene</translation>
    </message>
    <message>
        <source>Coronal plane</source>
        <translation>Koronare Ebene</translation>
    </message>
    <message>
        <source>Sagittal plane</source>
        <translation>Sagittale Ebene</translation>
    </message>
    <message>
        <source>Slab</source>
        <translation>Schicht</translation>
    </message>
    <message>
        <source>Thin</source>
        <translation>Dünn</translation>
    </message>
    <message>
        <source>Mean</source>
        <translation>Mittelwert</translation>
    </message>
    <message>
        <source>MIP</source>
        <translation>MIP</translation>
    </message>
    <message>
        <source>MinIP</source>
        <translation>MinIP</translation>
    </message>
    <message>
        <source>Thickness of the slab</source>
        <translation>Dicke der Schicht</translation>
    </message>
    <message>
        <source>Shift and wheel over a plane, or the dots on its border, change it, too</source>
        <translation>Auch Umschalt und Mausrad über einer Ebene oder die Punkte an ihrem Rand ändern sie</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>Straight</source>
        <translation>Gerade</translation>
    </message>
    <message>
        <source>Axial, coronal and sagittal again; the rings on the lines turn them</source>
        <translation>Wieder axial, koronar und sagittal; die Ringe auf den Linien drehen sie</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PluginDialog</name>
    <message>
        <source>Trust it and run</source>
        <translation>Vertrauen und ausführen</translation>
    </message>
    <message>
        <source>Run</source>
        <translation>Ausführen</translation>
    </message>
    <message>
        <source>The script %1 is new here, or has changed. It is a program that may do what you may do on this computer. Run it if you know where it is from.</source>
        <translation>Das Skript %1 ist hier neu oder hat sich geändert. Es ist ein Programm, das auf diesem Computer darf, was Sie dürfen. Führen Sie es aus, wenn Sie wissen, woher es ist.</translation>
    </message>
    <message>
        <source>A whole number.</source>
        <translation>Eine ganze Zahl.</translation>
    </message>
    <message>
        <source>A number.</source>
        <translation>Eine Zahl.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Plugins</name>
    <message>
        <source>Looking for plug-ins</source>
        <translation>Plug-ins suchen</translation>
    </message>
    <message>
        <source>The plug-ins cannot be listed</source>
        <translation>Die Plug-ins können nicht aufgelistet werden</translation>
    </message>
    <message>
        <source>Some scripts are no plug-ins</source>
        <translation>Einige Skripte sind keine Plug-ins</translation>
    </message>
    <message>
        <source>Some scripts are no plug-ins: %1</source>
        <translation>Einige Skripte sind keine Plug-ins: %1</translation>
    </message>
    <message numerus="yes">
        <source>%n plug-in(s).</source>
        <translation>
            <numerusform>%n Plug-in.</numerusform>
            <numerusform>%n Plug-ins.</numerusform>
        </translation>
    </message>
    <message>
        <source>The folder of plug-ins is %1</source>
        <translation>Der Ordner der Plug-ins ist %1</translation>
    </message>
    <message>
        <source>No case is open.</source>
        <translation>Es ist kein Fall geöffnet.</translation>
    </message>
    <message>
        <source>No image is open.</source>
        <translation>Es ist kein Bild geöffnet.</translation>
    </message>
    <message>
        <source>The image is still being read.</source>
        <translation>Das Bild wird noch gelesen.</translation>
    </message>
    <message>
        <source>The case is open for reading only; save it as another one, which can be edited.</source>
        <translation>Der Fall ist nur zum Lesen geöffnet; speichern Sie ihn als einen anderen, der bearbeitet werden kann.</translation>
    </message>
    <message>
        <source>%1 has failed</source>
        <translation>%1 ist gescheitert</translation>
    </message>
    <message>
        <source>The case was edited while %1 was at work, and its edits are of the case before. Run it again.</source>
        <translation>Der Fall wurde bearbeitet, während %1 am Werk war, und dessen Änderungen gelten dem Fall davor. Führen Sie es noch einmal aus.</translation>
    </message>
    <message>
        <source>%1: shown in the wall&apos;s place.</source>
        <translation>%1: anstelle der Wand gezeigt.</translation>
    </message>
    <message>
        <source>%1: shown in the wall&apos;s place, of the case before the last edit.</source>
        <translation>%1: anstelle der Wand gezeigt, vom Fall vor der letzten Änderung.</translation>
    </message>
    <message numerus="yes">
        <source>%n vessel(s) of the mask; a question mark says where to look first.</source>
        <translation>
            <numerusform>%n Gefäß der Maske; ein Fragezeichen sagt, wo zuerst hinzusehen ist.</numerusform>
            <numerusform>%n Gefäße der Maske; ein Fragezeichen sagt, wo zuerst hinzusehen ist.</numerusform>
        </translation>
    </message>
    <message>
        <source>The plug-in has changed nothing.</source>
        <translation>Das Plug-in hat nichts geändert.</translation>
    </message>
    <message numerus="yes">
        <source>%n edit(s) as one step; Undo takes it back.</source>
        <translation>
            <numerusform>%n Änderung als ein Schritt; Rückgängig nimmt ihn zurück.</numerusform>
            <numerusform>%n Änderungen als ein Schritt; Rückgängig nimmt ihn zurück.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PreferencesDialog</name>
    <message>
        <source>Preferences</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>General</source>
        <translation>Allgemein</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Images are dark in both</source>
        <translation>Bilder sind in beiden dunkel</translation>
    </message>
    <message>
        <source>Theme</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>As the system has it</source>
        <translation>Wie im System</translation>
    </message>
    <message>
        <source>Another language is used from the next start on. Numbers keep the decimal point in every language, as in reports and files.</source>
        <translation>Eine andere Sprache gilt ab dem nächsten Start. Zahlen behalten in jeder Sprache den Dezimalpunkt, wie in Befunden und Dateien.</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>As on a PACS station</source>
        <translation>Wie am PACS-Arbeitsplatz</translation>
    </message>
    <message>
        <source>As in research software</source>
        <translation>Wie in Forschungsprogrammen</translation>
    </message>
    <message>
        <source>Choosing one gives all commands its keys</source>
        <translation>Die Wahl gibt allen Befehlen die Tasten des Schemas</translation>
    </message>
    <message>
        <source>Scheme</source>
        <translation>Schema</translation>
    </message>
    <message>
        <source>Commands and their keys</source>
        <translation>Befehle und ihre Tasten</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>New keys</source>
        <translation>Neue Tasten</translation>
    </message>
    <message>
        <source>Click here and press the keys for the selected command</source>
        <translation>Hier klicken und die Tasten für den gewählten Befehl drücken</translation>
    </message>
    <message>
        <source>No key</source>
        <translation>Keine Taste</translation>
    </message>
    <message>
        <source>The command is then in menus alone</source>
        <translation>Der Befehl steht dann nur in Menüs</translation>
    </message>
    <message>
        <source>As in the scheme</source>
        <translation>Wie im Schema</translation>
    </message>
    <message>
        <source>All as in the scheme</source>
        <translation>Alle wie im Schema</translation>
    </message>
    <message>
        <source>New keys:</source>
        <translation>Neue Tasten:</translation>
    </message>
    <message>
        <source>Choose a command in the list first.</source>
        <translation>Wählen Sie zuerst einen Befehl in der Liste.</translation>
    </message>
    <message>
        <source>%1 belongs to &quot;%2&quot;. Choose another key, or take it from that command first.</source>
        <translation>%1 gehört zu „%2“. Wählen Sie eine andere Taste oder nehmen Sie sie zuerst jenem Befehl weg.</translation>
    </message>
    <message>
        <source>%1 moves through views and lists and can run no command. Choose another key.</source>
        <translation>%1 bewegt durch Ansichten und Listen und kann keinen Befehl auslösen. Wählen Sie eine andere Taste.</translation>
    </message>
    <message>
        <source>Another command has been given this command&apos;s key.</source>
        <translation>Ein anderer Befehl hat die Taste dieses Befehls bekommen.</translation>
    </message>
    <message>
        <source>In a corner of each image</source>
        <translation>In einer Ecke jedes Bildes</translation>
    </message>
    <message>
        <source>Patient&apos;s name</source>
        <translation>Name des Patienten</translation>
    </message>
    <message>
        <source>In the list of recent cases</source>
        <translation>In der Liste der letzten Fälle</translation>
    </message>
    <message>
        <source>Names are kept on this computer, in a file that you alone can read. No case has them.</source>
        <translation>Namen bleiben auf diesem Computer, in einer Datei, die nur Sie lesen können. Kein Fall hat sie.</translation>
    </message>
    <message>
        <source>Forget all names</source>
        <translation>Alle Namen vergessen</translation>
    </message>
    <message>
        <source>Nobody</source>
        <translation>Niemand</translation>
    </message>
    <message>
        <source>Stands at each step that you do from now on, in the case alone: in no report and no export. Left empty, steps have no name.</source>
        <translation>Steht ab jetzt bei jedem Ihrer Schritte, nur im Fall: in keinem Bericht und keinem Export. Bleibt es leer, haben Schritte keinen Namen.</translation>
    </message>
    <message>
        <source>Your name at steps</source>
        <translation>Ihr Name bei Schritten</translation>
    </message>
    <message>
        <source>%1 is this command&apos;s key now, but many desktops take it for themselves: where nothing happens, choose another.</source>
        <translation>%1 ist jetzt die Taste dieses Befehls, aber viele Arbeitsumgebungen behalten sie für sich: Wo nichts geschieht, wählen Sie eine andere.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PressureInputs</name>
    <message>
        <source>Inputs of the pressures</source>
        <translation>Eingaben der Drücke</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>Eingabe</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Usual</source>
        <translation>Üblich</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>Double click on a value to type another; nothing typed: the usual one.</source>
        <translation>Doppelklick auf einen Wert, um einen anderen zu tippen; nichts getippt: der übliche.</translation>
    </message>
    <message>
        <source>given here</source>
        <translation>hier angegeben</translation>
    </message>
    <message>
        <source>%1: %2 to %3 are taken; source of the usual value: %4</source>
        <translation>%1: %2 bis %3 werden genommen; Quelle des üblichen Werts: %4</translation>
    </message>
    <message>
        <source>“%1” is no number</source>
        <translation>„%1“ ist keine Zahl</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PressurePage</name>
    <message>
        <source>occluded</source>
        <translation>verschlossen</translation>
    </message>
    <message>
        <source>Pressure</source>
        <translation>Druck</translation>
    </message>
    <message>
        <source>Readings</source>
        <translation>Ablesungen</translation>
    </message>
    <message>
        <source>Inputs</source>
        <translation>Eingaben</translation>
    </message>
    <message>
        <source>FFR behind narrowings</source>
        <translation>FFR hinter Engstellen</translation>
    </message>
    <message>
        <source>Vessel</source>
        <translation>Gefäß</translation>
    </message>
    <message>
        <source>FFR</source>
        <translation>FFR</translation>
    </message>
    <message>
        <source>Takes</source>
        <translation>Abfall</translation>
    </message>
    <message>
        <source>What if</source>
        <translation>Was wäre, wenn</translation>
    </message>
    <message>
        <source>Read about 25 mm behind each narrowing, under hyperaemia.</source>
        <translation>Etwa 25 mm hinter jeder Engstelle gelesen, unter Hyperämie.</translation>
    </message>
    <message>
        <source>Ends of the vessels</source>
        <translation>Enden der Gefäße</translation>
    </message>
    <message>
        <source>End of</source>
        <translation>Ende von</translation>
    </message>
    <message>
        <source>ml/min</source>
        <translation>ml/min</translation>
    </message>
    <message>
        <source>Reserve</source>
        <translation>Reserve</translation>
    </message>
    <message>
        <source>PPG</source>
        <translation>PPG</translation>
    </message>
    <message>
        <source>Flow under hyperaemia, flow reserve, pullback pressure gradient index (1: focal).</source>
        <translation>Fluss unter Hyperämie, Flussreserve, Index des Druckgradienten beim Rückzug (1: fokal).</translation>
    </message>
    <message>
        <source>What is to be looked at</source>
        <translation>Was anzusehen ist</translation>
    </message>
    <message>
        <source>Diameter stenosis that stays</source>
        <translation>Durchmesserstenose, die bleibt</translation>
    </message>
    <message>
        <source>Diameter stenosis at the throat</source>
        <translation>Durchmesserstenose an der engsten Stelle</translation>
    </message>
    <message>
        <source>What if: stretches</source>
        <translation>Was wäre, wenn: Strecken</translation>
    </message>
    <message>
        <source>mm from its root</source>
        <translation>mm ab Ursprung</translation>
    </message>
    <message>
        <source>Delete takes the chosen stretch away; Undo brings it back.</source>
        <translation>Entf nimmt die gewählte Strecke weg; Rückgängig bringt sie wieder.</translation>
    </message>
    <message>
        <source>Take this stretch back</source>
        <translation>Diese Strecke zurücknehmen</translation>
    </message>
    <message>
        <source>%1 at %2 mm: FFR %3</source>
        <translation>%1 bei %2 mm: FFR %3</translation>
    </message>
    <message>
        <source>, what if %1</source>
        <translation>, was wäre, wenn: %1</translation>
    </message>
    <message>
        <source>No case is open.</source>
        <translation>Es ist kein Fall geöffnet.</translation>
    </message>
    <message>
        <source>Sections are being measured…</source>
        <translation>Schnitte werden gemessen…</translation>
    </message>
    <message>
        <source>open, %1 % left</source>
        <translation>offen, %1 % bleiben</translation>
    </message>
    <message>
        <source>narrowed by %1 %</source>
        <translation>um %1 % verengt</translation>
    </message>
    <message>
        <source>95 %: %1 to %2; at or below %3 with %4 %</source>
        <translation>95 %: %1 bis %2; bei oder unter %3 mit %4 %</translation>
    </message>
    <message>
        <source>At (mm)</source>
        <translation>Bei (mm)</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::PressureSaving</name>
    <message>
        <source>Report of the pressures</source>
        <translation>Befund der Drücke</translation>
    </message>
    <message>
        <source>The pressures are in %1</source>
        <translation>Die Drücke sind in %1</translation>
    </message>
    <message>
        <source>Open the PDF</source>
        <translation>PDF öffnen</translation>
    </message>
    <message>
        <source>The report could not be made</source>
        <translation>Der Befund konnte nicht erstellt werden</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ProfileWidget</name>
    <message>
        <source>Lumen profile</source>
        <translation>Lumenprofil</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::QaDock</name>
    <message>
        <source>no annotated section</source>
        <translation>kein annotierter Abschnitt</translation>
    </message>
    <message>
        <source>MSD %1 mm, maximum %2 mm, Dice %3, %4 mm annotated</source>
        <translation>MSD %1 mm, Maximum %2 mm, Dice %3, %4 mm annotiert</translation>
    </message>
    <message>
        <source>, %1 mm of it without a wall</source>
        <translation>, davon %1 mm ohne Wand</translation>
    </message>
    <message>
        <source>QA</source>
        <translation>QA</translation>
    </message>
    <message>
        <source>Open truth…</source>
        <translation>Wahrheit öffnen…</translation>
    </message>
    <message>
        <source>Contours that the case is held against</source>
        <translation>Konturen, gegen die der Fall gehalten wird</translation>
    </message>
    <message>
        <source>Observer</source>
        <translation>Beobachter</translation>
    </message>
    <message>
        <source>Whose contours are the truth</source>
        <translation>Wessen Konturen die Wahrheit sind</translation>
    </message>
    <message>
        <source>Truth over the pictures</source>
        <translation>Wahrheit über den Bildern</translation>
    </message>
    <message>
        <source>Tree coloured by its error</source>
        <translation>Baum nach Fehler gefärbt</translation>
    </message>
    <message>
        <source>Annotated sections</source>
        <translation>Annotierte Abschnitte</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>Abschnitt</translation>
    </message>
    <message>
        <source>Vessel</source>
        <translation>Gefäß</translation>
    </message>
    <message>
        <source>MSD</source>
        <translation>MSD</translation>
    </message>
    <message>
        <source>Max.</source>
        <translation>Max.</translation>
    </message>
    <message>
        <source>Δ area</source>
        <translation>Δ Fläche</translation>
    </message>
    <message>
        <source>Dice</source>
        <translation>Dice</translation>
    </message>
    <message>
        <source>Mean distance of the surfaces, mm</source>
        <translation>Mittlerer Abstand der Oberflächen, mm</translation>
    </message>
    <message>
        <source>Largest distance of the surfaces, mm</source>
        <translation>Größter Abstand der Oberflächen, mm</translation>
    </message>
    <message>
        <source>Mean difference of the areas, case - truth, mm²</source>
        <translation>Mittlere Differenz der Flächen, Fall - Wahrheit, mm²</translation>
    </message>
    <message>
        <source>Next worst section</source>
        <translation>Nächstschlechter Abschnitt</translation>
    </message>
    <message>
        <source>To the worst place of the section that is farthest off</source>
        <translation>Zur schlechtesten Stelle des Abschnitts, der am weitesten abweicht</translation>
    </message>
    <message>
        <source>Time at work: it stops when nothing was done for a minute</source>
        <translation>Arbeitszeit: sie steht still, wenn eine Minute lang nichts getan wurde</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Stop or go on counting</source>
        <translation>Anhalten oder weiterzählen</translation>
    </message>
    <message>
        <source>Zero</source>
        <translation>Null</translation>
    </message>
    <message>
        <source>Count from zero</source>
        <translation>Von null an zählen</translation>
    </message>
    <message>
        <source>Record…</source>
        <translation>Aufzeichnen…</translation>
    </message>
    <message>
        <source>Write down what the hand does in the views</source>
        <translation>Aufschreiben, was die Hand in den Ansichten tut</translation>
    </message>
    <message>
        <source>Replay…</source>
        <translation>Abspielen…</translation>
    </message>
    <message>
        <source>Do again what was recorded, on the same case</source>
        <translation>Das Aufgezeichnete am selben Fall wiederholen</translation>
    </message>
    <message>
        <source>Speed of a replay</source>
        <translation>Geschwindigkeit des Abspielens</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>End the replay here</source>
        <translation>Das Abspielen hier beenden</translation>
    </message>
    <message>
        <source>Contours</source>
        <translation>Konturen</translation>
    </message>
    <message>
        <source>Contours (*.json)</source>
        <translation>Konturen (*.json)</translation>
    </message>
    <message>
        <source>%1: not in this case</source>
        <translation>%1: nicht in diesem Fall</translation>
    </message>
    <message>
        <source>No truth is open.</source>
        <translation>Es ist keine Wahrheit geöffnet.</translation>
    </message>
    <message>
        <source>&lt;b&gt;%1&lt;/b&gt;: %2</source>
        <translation>&lt;b&gt;%1&lt;/b&gt;: %2</translation>
    </message>
    <message>
        <source>&lt;b&gt;Case&lt;/b&gt;: %1</source>
        <translation>&lt;b&gt;Fall&lt;/b&gt;: %1</translation>
    </message>
    <message>
        <source>  (idle)</source>
        <translation>  (ruht)</translation>
    </message>
    <message>
        <source>At work %1</source>
        <translation>Arbeitszeit %1</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Stop recording</source>
        <translation>Aufzeichnen beenden</translation>
    </message>
    <message>
        <source>from the truth, mm</source>
        <translation>von der Wahrheit, mm</translation>
    </message>
    <message>
        <source>Recording: what the hand does in the views is written down.</source>
        <translation>Aufzeichnung läuft: was die Hand in den Ansichten tut, wird aufgeschrieben.</translation>
    </message>
    <message numerus="yes">
        <source>%n movement(s) were recorded.</source>
        <translation>
            <numerusform>%n Bewegung wurde aufgezeichnet.</numerusform>
            <numerusform>%n Bewegungen wurden aufgezeichnet.</numerusform>
        </translation>
    </message>
    <message>
        <source>Record to</source>
        <translation>Aufzeichnen nach</translation>
    </message>
    <message>
        <source>Recordings (*.jsonl)</source>
        <translation>Aufzeichnungen (*.jsonl)</translation>
    </message>
    <message>
        <source>Replay</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>The replay has ended. The recording does not say what the model was at its end.</source>
        <translation>Das Abspielen ist beendet. Die Aufzeichnung sagt nicht, wie das Modell am Ende war.</translation>
    </message>
    <message>
        <source>The replay has ended: the model is what it was when it was recorded.</source>
        <translation>Das Abspielen ist beendet: das Modell ist so, wie es bei der Aufzeichnung war.</translation>
    </message>
    <message>
        <source>The replay has ended, but the model is not what it was when it was recorded.</source>
        <translation>Das Abspielen ist beendet, aber das Modell ist nicht so, wie es bei der Aufzeichnung war.</translation>
    </message>
    <message>
        <source>The replay was ended after %1 of %2 movements.</source>
        <translation>Das Abspielen wurde nach %1 von %2 Bewegungen beendet.</translation>
    </message>
    <message>
        <source>Reading the truth</source>
        <translation>Wahrheit wird gelesen</translation>
    </message>
    <message>
        <source>Replay as fast as recorded</source>
        <translation>So schnell abspielen wie aufgezeichnet</translation>
    </message>
    <message>
        <source>Replay at full speed</source>
        <translation>So schnell wie möglich abspielen</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ReportDialog</name>
    <message>
        <source>&amp;Name the patient in this report</source>
        <translation>&amp;Patient in diesem Befund nennen</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Befund</translation>
    </message>
    <message>
        <source>The report of the case as it is now, in a folder beside it.</source>
        <translation>Der Befund des Falls, wie er jetzt ist, in einem Ordner daneben.</translation>
    </message>
    <message>
        <source>The name is then in report.pdf and report.html. The tables, the pictures and the case stay without it.</source>
        <translation>Der Name steht dann in report.pdf und report.html. Tabellen, Bilder und Fall bleiben ohne ihn.</translation>
    </message>
    <message>
        <source>&amp;Make the report</source>
        <translation>Befund &amp;erstellen</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ReportNotesDialog</name>
    <message>
        <source>What the report says</source>
        <translation>Was der Befund sagt</translation>
    </message>
    <message>
        <source>The findings are being measured…</source>
        <translation>Die Messwerte werden erhoben…</translation>
    </message>
    <message>
        <source>Impression</source>
        <translation>Beurteilung</translation>
    </message>
    <message>
        <source>Impression; left empty, the report has a draft of the findings</source>
        <translation>Beurteilung; bleibt sie leer, steht im Befund ein Entwurf aus den Messwerten</translation>
    </message>
    <message>
        <source>Add the &amp;draft</source>
        <translation>&amp;Entwurf anfügen</translation>
    </message>
    <message>
        <source>Puts the draft of the findings, as they are now, behind what is written.</source>
        <translation>Setzt den Entwurf aus den Messwerten, wie sie jetzt sind, hinter das, was geschrieben ist.</translation>
    </message>
    <message>
        <source>Features of high-risk plaque</source>
        <translation>Merkmale von Hochrisikoplaque</translation>
    </message>
    <message>
        <source>Lesion</source>
        <translation>Läsion</translation>
    </message>
    <message>
        <source>Feature</source>
        <translation>Merkmal</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation>Sicherheit</translation>
    </message>
    <message>
        <source>Is there</source>
        <translation>Ist da</translation>
    </message>
    <message>
        <source>Ischaemia (I)</source>
        <translation>Ischämie (I)</translation>
    </message>
    <message>
        <source>not tested</source>
        <translation>nicht geprüft</translation>
    </message>
    <message>
        <source>negative</source>
        <translation>negativ</translation>
    </message>
    <message>
        <source>borderline</source>
        <translation>grenzwertig</translation>
    </message>
    <message>
        <source>positive</source>
        <translation>positiv</translation>
    </message>
    <message>
        <source>Stent (S)</source>
        <translation>Stent (S)</translation>
    </message>
    <message>
        <source>Graft (G)</source>
        <translation>Bypass (G)</translation>
    </message>
    <message>
        <source>Exceptions (E)</source>
        <translation>Ausnahmen (E)</translation>
    </message>
    <message>
        <source>What is no atherosclerosis: dissection, anomalous origin, aneurysm</source>
        <translation>Was keine Atherosklerose ist: Dissektion, anomaler Abgang, Aneurysma</translation>
    </message>
    <message>
        <source>Dominance</source>
        <translation>Versorgungstyp</translation>
    </message>
    <message>
        <source>as the tree has it</source>
        <translation>wie im Gefäßbaum</translation>
    </message>
    <message>
        <source>right</source>
        <translation>rechts</translation>
    </message>
    <message>
        <source>left</source>
        <translation>links</translation>
    </message>
    <message>
        <source>co-dominant</source>
        <translation>ausgeglichen</translation>
    </message>
    <message>
        <source>Calcium score (Agatston)</source>
        <translation>Kalkscore (Agatston)</translation>
    </message>
    <message>
        <source>Plaque by sight</source>
        <translation>Plaque nach Augenmaß</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>mild</source>
        <translation>leicht</translation>
    </message>
    <message>
        <source>moderate</source>
        <translation>mäßig</translation>
    </message>
    <message>
        <source>severe</source>
        <translation>schwer</translation>
    </message>
    <message>
        <source>Plaque burden stated</source>
        <translation>Angegebene Plaquelast</translation>
    </message>
    <message>
        <source>as the report chooses</source>
        <translation>wie der Befund wählt</translation>
    </message>
    <message>
        <source>no plaque</source>
        <translation>keine Plaque</translation>
    </message>
    <message>
        <source>Signed by</source>
        <translation>Unterschrieben von</translation>
    </message>
    <message>
        <source>What changed</source>
        <translation>Was sich geändert hat</translation>
    </message>
    <message>
        <source>&amp;Sign this version</source>
        <translation>Diese Fassung &amp;unterschreiben</translation>
    </message>
    <message>
        <source>As the case is now: CAD-RADS %1</source>
        <translation>Wie der Fall jetzt ist: CAD-RADS %1</translation>
    </message>
    <message>
        <source>The findings could not be measured: %1</source>
        <translation>Die Messwerte waren nicht zu erheben: %1</translation>
    </message>
    <message>
        <source>low attenuation</source>
        <translation>niedrige Dichte</translation>
    </message>
    <message>
        <source>positive remodelling</source>
        <translation>positives Remodeling</translation>
    </message>
    <message>
        <source>spotty calcium</source>
        <translation>punktförmiger Kalk</translation>
    </message>
    <message>
        <source>napkin ring</source>
        <translation>Serviettenring</translation>
    </message>
    <message>
        <source>high</source>
        <translation>hoch</translation>
    </message>
    <message>
        <source>low</source>
        <translation>gering</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>nicht bekannt</translation>
    </message>
    <message>
        <source>found</source>
        <translation>gefunden</translation>
    </message>
    <message>
        <source>not found</source>
        <translation>nicht gefunden</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>Version %1 of the report is signed.</source>
        <translation>Fassung %1 des Befunds ist unterschrieben.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Reporting</name>
    <message>
        <source>Report</source>
        <translation>Befund</translation>
    </message>
    <message>
        <source>The report could not be made</source>
        <translation>Der Befund konnte nicht erstellt werden</translation>
    </message>
    <message>
        <source>The report is in %1.</source>
        <translation>Der Befund liegt in %1.</translation>
    </message>
    <message>
        <source>Open the PDF</source>
        <translation>PDF öffnen</translation>
    </message>
    <message>
        <source>Open the HTML</source>
        <translation>HTML öffnen</translation>
    </message>
    <message>
        <source>Pinned by the reader: %1</source>
        <translation>Vom Befunder angeheftet: %1</translation>
    </message>
    <message>
        <source>This view will be key image %1 of the next report.</source>
        <translation>Diese Ansicht wird Schlüsselbild %1 des nächsten Befunds.</translation>
    </message>
    <message>
        <source>Export the centerlines</source>
        <translation>Mittellinien exportieren</translation>
    </message>
    <message>
        <source>Centerlines (*.vtp)</source>
        <translation>Mittellinien (*.vtp)</translation>
    </message>
    <message>
        <source>The centerlines are in %1.</source>
        <translation>Die Mittellinien liegen in %1.</translation>
    </message>
    <message>
        <source>Click into the CPR, section or slice to be pinned first.</source>
        <translation>Klicken Sie zuerst in die CPR, den Querschnitt oder die Schicht, die angeheftet werden soll.</translation>
    </message>
    <message>
        <source>Findings of the report</source>
        <translation>Erhebung für den Befund</translation>
    </message>
    <message numerus="yes">
        <source>%n page(s) more in the next report.</source>
        <translation>
            <numerusform>%n Seite mehr im nächsten Befund.</numerusform>
            <numerusform>%n Seiten mehr im nächsten Befund.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::SceneWidget</name>
    <message>
        <source>Coronary tree</source>
        <translation>Koronarbaum</translation>
    </message>
    <message>
        <source>Preparing the heart</source>
        <translation>Herz wird vorbereitet</translation>
    </message>
    <message>
        <source>Tree alone</source>
        <translation>Nur der Baum</translation>
    </message>
    <message>
        <source>With the heart</source>
        <translation>Mit dem Herzen</translation>
    </message>
    <message>
        <source>With a MIP</source>
        <translation>Mit einer MIP</translation>
    </message>
    <message>
        <source>What is behind the tree</source>
        <translation>Was hinter dem Baum zu sehen ist</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::SendDialog</name>
    <message>
        <source>Segmentation</source>
        <translation>Segmentierung</translation>
    </message>
    <message>
        <source>Report (PDF)</source>
        <translation>Bericht (PDF)</translation>
    </message>
    <message>
        <source>Lumen&apos;s surface (STL)</source>
        <translation>Oberfläche des Lumens (STL)</translation>
    </message>
    <message>
        <source>Measurements (structured report)</source>
        <translation>Messungen (Structured Report)</translation>
    </message>
    <message>
        <source>Key images</source>
        <translation>Schlüsselbilder</translation>
    </message>
    <message>
        <source>DICOM object</source>
        <translation>DICOM-Objekt</translation>
    </message>
    <message>
        <source>Send to the PACS</source>
        <translation>An das PACS senden</translation>
    </message>
    <message>
        <source>Server</source>
        <translation>Server</translation>
    </message>
    <message>
        <source>They are of the patient of the image and name them, as its files do. What cannot be sent now waits in the outbox.</source>
        <translation>Sie sind vom Patienten des Bildes und nennen ihn, wie dessen Dateien. Was jetzt nicht gesendet werden kann, wartet im Postausgang.</translation>
    </message>
    <message>
        <source>&amp;Send</source>
        <translation>&amp;Senden</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::SeriesBrowser</name>
    <message>
        <source>Series in this folder</source>
        <translation>Serien in diesem Ordner</translation>
    </message>
    <message>
        <source>Series</source>
        <translation>Serie</translation>
    </message>
    <message>
        <source>Slices</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>Voxel, mm</source>
        <translation>Voxel, mm</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>Hinweise</translation>
    </message>
    <message>
        <source>Uneven slices</source>
        <translation>Ungleichmäßige Schichten</translation>
    </message>
    <message>
        <source>Slices are missing or unevenly spaced in this series. What lies between them can be interpolated; lumina there are not measured but guessed. Go on?</source>
        <translation>In dieser Serie fehlen Schichten, oder ihre Abstände sind ungleich. Was dazwischen liegt, kann interpoliert werden; Lumina sind dort nicht gemessen, sondern geraten. Fortfahren?</translation>
    </message>
    <message numerus="yes">
        <source>%n damaged file(s)</source>
        <translation>
            <numerusform>%n beschädigte Datei</numerusform>
            <numerusform>%n beschädigte Dateien</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n file(s) that are no images</source>
        <translation>
            <numerusform>%n Datei, die kein Bild ist</numerusform>
            <numerusform>%n Dateien, die keine Bilder sind</numerusform>
        </translation>
    </message>
    <message>
        <source>Left out: %1</source>
        <translation>Ausgelassen: %1</translation>
    </message>
    <message>
        <source>Pictures of the series</source>
        <translation>Bilder der Serien</translation>
    </message>
    <message>
        <source>Images of several patients lie in this folder. Each series is of one of them: look at its name.</source>
        <translation>In diesem Ordner liegen Bilder mehrerer Patienten. Jede Serie ist von einem von ihnen: Achten Sie auf ihren Namen.</translation>
    </message>
    <message>
        <source>Orientation unknown</source>
        <translation>Orientierung unbekannt</translation>
    </message>
    <message>
        <source>The files of this series do not say how the patient lies. It can be read as axial slices, and you set its orientation by the pictures then. Go on?</source>
        <translation>Die Dateien dieser Serie sagen nicht, wie die Person liegt. Sie kann als axiale Schichten gelesen werden, und Sie geben die Orientierung dann anhand der Bilder an. Weiter?</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::SeriesStrip</name>
    <message>
        <source>Find the sharpest</source>
        <translation>Schärfste suchen</translation>
    </message>
    <message>
        <source>Work on this one</source>
        <translation>Mit diesem arbeiten</translation>
    </message>
    <message>
        <source>Opens it in the place of the image on the table: vessels are then found in it, and the case that is open, which is of the other image, is closed</source>
        <translation>Öffnet es anstelle des geöffneten Bildes: Gefäße werden dann darin gesucht, und der offene Fall, der zum anderen Bild gehört, wird geschlossen</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Shows the image on the table again</source>
        <translation>Zeigt wieder das geöffnete Bild</translation>
    </message>
    <message>
        <source>Series of the study</source>
        <translation>Serien der Untersuchung</translation>
    </message>
    <message>
        <source>Series and phases</source>
        <translation>Serien und Phasen</translation>
    </message>
    <message>
        <source>Phase that is shown</source>
        <translation>Gezeigte Phase</translation>
    </message>
    <message>
        <source>Phases of the study, one after the other</source>
        <translation>Phasen der Untersuchung, eine nach der anderen</translation>
    </message>
    <message>
        <source>Pictures a second</source>
        <translation>Bilder je Sekunde</translation>
    </message>
    <message>
        <source> /s</source>
        <translation> /s</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Play the phases</source>
        <translation>Phasen abspielen</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ServersDialog</name>
    <message>
        <source>PACS servers</source>
        <translation>PACS-Server</translation>
    </message>
    <message>
        <source>&amp;New</source>
        <translation>&amp;Neu</translation>
    </message>
    <message>
        <source>&amp;Remove</source>
        <translation>&amp;Entfernen</translation>
    </message>
    <message>
        <source>&amp;Test the connection</source>
        <translation>Verbindung &amp;prüfen</translation>
    </message>
    <message>
        <source>Name here</source>
        <translation>Name hier</translation>
    </message>
    <message>
        <source>As lists of this program call it.</source>
        <translation>So nennen ihn die Listen dieses Programms.</translation>
    </message>
    <message>
        <source>Protocol</source>
        <translation>Protokoll</translation>
    </message>
    <message>
        <source>DICOM (C-FIND, C-GET, C-STORE)</source>
        <translation>DICOM (C-FIND, C-GET, C-STORE)</translation>
    </message>
    <message>
        <source>DICOMweb</source>
        <translation>DICOMweb</translation>
    </message>
    <message>
        <source>Host</source>
        <translation>Rechner</translation>
    </message>
    <message>
        <source>Port</source>
        <translation>Port</translation>
    </message>
    <message>
        <source>Its title</source>
        <translation>Sein Titel</translation>
    </message>
    <message>
        <source>Application entity title of the server.</source>
        <translation>Application Entity Title des Servers.</translation>
    </message>
    <message>
        <source>Our title</source>
        <translation>Unser Titel</translation>
    </message>
    <message>
        <source>As the server knows this machine.</source>
        <translation>So kennt der Server diesen Rechner.</translation>
    </message>
    <message>
        <source>Images come by</source>
        <translation>Bilder kommen mit</translation>
    </message>
    <message>
        <source>C-GET: on our connection</source>
        <translation>C-GET: auf unserer Verbindung</translation>
    </message>
    <message>
        <source>C-MOVE: the server connects to us</source>
        <translation>C-MOVE: der Server verbindet sich mit uns</translation>
    </message>
    <message>
        <source>Our port for C-MOVE</source>
        <translation>Unser Port für C-MOVE</translation>
    </message>
    <message>
        <source>&amp;Encrypted (TLS)</source>
        <translation>&amp;Verschlüsselt (TLS)</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>Login</source>
        <translation>Anmeldung</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>name and password</source>
        <translation>Name und Passwort</translation>
    </message>
    <message>
        <source>token</source>
        <translation>Token</translation>
    </message>
    <message>
        <source>User</source>
        <translation>Benutzer</translation>
    </message>
    <message>
        <source>Password or token</source>
        <translation>Passwort oder Token</translation>
    </message>
    <message>
        <source>Kept in the desktop&apos;s keyring alone. Empty: the one that is there stays.</source>
        <translation>Nur im Schlüsselbund des Desktops. Leer: Das vorhandene bleibt.</translation>
    </message>
    <message>
        <source>Proxy</source>
        <translation>Proxy</translation>
    </message>
    <message>
        <source>Trusted certificates</source>
        <translation>Vertraute Zertifikate</translation>
    </message>
    <message>
        <source>A file in PEM; empty: those of the system.</source>
        <translation>Eine PEM-Datei; leer: die des Systems.</translation>
    </message>
    <message>
        <source>Our certificate</source>
        <translation>Unser Zertifikat</translation>
    </message>
    <message>
        <source>A file in PEM; empty: none.</source>
        <translation>Eine PEM-Datei; leer: keines.</translation>
    </message>
    <message>
        <source>Its key</source>
        <translation>Sein Schlüssel</translation>
    </message>
    <message>
        <source>A file in PEM.</source>
        <translation>Eine PEM-Datei.</translation>
    </message>
    <message>
        <source>No server is described yet: New begins one.</source>
        <translation>Noch ist kein Server beschrieben: Neu beginnt einen.</translation>
    </message>
    <message>
        <source>new</source>
        <translation>neu</translation>
    </message>
    <message>
        <source>Asking the server…</source>
        <translation>Der Server wird gefragt…</translation>
    </message>
    <message>
        <source>Asking the server</source>
        <translation>Der Server wird gefragt</translation>
    </message>
    <message>
        <source>It answers, and lets us in.</source>
        <translation>Er antwortet und lässt uns ein.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ShortcutsPage</name>
    <message>
        <source>Keys and mouse</source>
        <translation>Tasten und Maus</translation>
    </message>
    <message>
        <source>Search: a word, or a key</source>
        <translation>Suchen: ein Wort oder eine Taste</translation>
    </message>
    <message>
        <source>Search</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>Only lines with all of these words stay</source>
        <translation>Nur Zeilen mit allen diesen Wörtern bleiben</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>What it does</source>
        <translation>Was er tut</translation>
    </message>
    <message>
        <source>Keys and mouse gestures</source>
        <translation>Tasten und Mausgesten</translation>
    </message>
    <message>
        <source>Mouse and keys in the views</source>
        <translation>Maus und Tasten in den Ansichten</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::SizeFields</name>
    <message>
        <source>Size of the triangles</source>
        <translation>Größe der Dreiecke</translation>
    </message>
    <message>
        <source>as fine as the model</source>
        <translation>so fein wie das Modell</translation>
    </message>
    <message>
        <source>by the calibre</source>
        <translation>nach dem Kaliber</translation>
    </message>
    <message>
        <source>the same everywhere</source>
        <translation>überall gleich</translation>
    </message>
    <message>
        <source>By the calibre: as many edges around a thin vessel as around a thick one. The same everywhere: shorter only where fewer than eight edges would be around the lumen.</source>
        <translation>Nach dem Kaliber: um ein dünnes Gefäß so viele Kanten wie um ein dickes. Überall gleich: kürzer nur, wo weniger als acht Kanten um das Lumen lägen.</translation>
    </message>
    <message>
        <source>Edges around a vessel</source>
        <translation>Kanten um ein Gefäß</translation>
    </message>
    <message>
        <source> edges around</source>
        <translation> Kanten ringsum</translation>
    </message>
    <message>
        <source>Edge length</source>
        <translation>Kantenlänge</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>&amp;Triangles</source>
        <translation>&amp;Dreiecke</translation>
    </message>
    <message>
        <source>Edges at stenoses over those of the vessel</source>
        <translation>Kanten an Stenosen gegenüber denen des Gefäßes</translation>
    </message>
    <message>
        <source>edges times </source>
        <translation>Kanten mal </translation>
    </message>
    <message>
        <source>Shorter edges where the vessel is narrowed by 30 % or more; 0.5 halves them, 1 leaves them.</source>
        <translation>Kürzere Kanten, wo das Gefäß um 30 % oder mehr verengt ist; 0,5 halbiert sie, 1 lässt sie.</translation>
    </message>
    <message>
        <source>At &amp;stenoses</source>
        <translation>An &amp;Stenosen</translation>
    </message>
    <message>
        <source>Choose %1 to %2 of the edges’ length.</source>
        <translation>Wählen Sie %1 bis %2 der Kantenlänge.</translation>
    </message>
    <message>
        <source>Edge over the wall&apos;s radius of curvature</source>
        <translation>Kante gegenüber dem Krümmungsradius der Wand</translation>
    </message>
    <message>
        <source>not looked at</source>
        <translation>nicht beachtet</translation>
    </message>
    <message>
        <source> of the bend&apos;s radius</source>
        <translation> des Krümmungsradius</translation>
    </message>
    <message>
        <source>Shorter edges where the wall bends more than around itself, as in the crotch of a fork; 0.4 is a good start.</source>
        <translation>Kürzere Kanten, wo sich die Wand stärker krümmt als rings um das Gefäß, etwa im Schritt einer Gabel; 0,4 ist ein guter Anfang.</translation>
    </message>
    <message>
        <source>At &amp;bends</source>
        <translation>An &amp;Biegungen</translation>
    </message>
    <message>
        <source>Choose %1 to %2, or 0.</source>
        <translation>Wählen Sie %1 bis %2, oder 0.</translation>
    </message>
    <message>
        <source>Bound on the size of wide places, in radii</source>
        <translation>Grenze für weite Stellen, in Radien</translation>
    </message>
    <message>
        <source>as wide as they are</source>
        <translation>so weit, wie sie sind</translation>
    </message>
    <message>
        <source>as if </source>
        <translation>wie </translation>
    </message>
    <message>
        <source> radii wide</source>
        <translation> Radien weit</translation>
    </message>
    <message>
        <source>An aneurysm gets the edges of its vessel: the wall counts as at most so many radii away from the axis. 1 or more; 0: no bound.</source>
        <translation>Ein Aneurysma bekommt die Kanten seines Gefäßes: die Wand gilt als höchstens so viele Radien von der Achse entfernt. 1 oder mehr; 0: keine Grenze.</translation>
    </message>
    <message>
        <source>&amp;Aneurysms</source>
        <translation>&amp;Aneurysmen</translation>
    </message>
    <message>
        <source>Length of the flow extensions</source>
        <translation>Länge der Strömungsverlängerungen</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source> diameters long</source>
        <translation> Durchmesser lang</translation>
    </message>
    <message>
        <source>Tubes beyond the cut ends that lead the flow in and out, from each real section to a circle.</source>
        <translation>Rohre jenseits der Schnittenden, die die Strömung hinein- und hinausführen, von jedem wirklichen Querschnitt zu einem Kreis.</translation>
    </message>
    <message>
        <source>Flow e&amp;xtensions</source>
        <translation>Ver&amp;längerungen</translation>
    </message>
    <message>
        <source>Choose %1 to %2 diameters, or 0 for none.</source>
        <translation>Wählen Sie %1 bis %2 Durchmesser, oder 0 für keine.</translation>
    </message>
    <message>
        <source>%1 edges around a vessel are too few. Choose %2 to %3.</source>
        <translation>%1 Kanten um ein Gefäß sind zu wenige. Wählen Sie %2 bis %3.</translation>
    </message>
    <message>
        <source>%1 edges around a vessel are too many. Choose %2 to %3.</source>
        <translation>%1 Kanten um ein Gefäß sind zu viele. Wählen Sie %2 bis %3.</translation>
    </message>
    <message>
        <source>Edges of %1 mm are too short. Choose %2 to %3 mm.</source>
        <translation>Kanten von %1 mm sind zu kurz. Wählen Sie %2 bis %3 mm.</translation>
    </message>
    <message>
        <source>Edges of %1 mm are too long. Choose %2 to %3 mm.</source>
        <translation>Kanten von %1 mm sind zu lang. Wählen Sie %2 bis %3 mm.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::StartPage</name>
    <message>
        <source>No case is open</source>
        <translation>Kein Fall ist geöffnet</translation>
    </message>
    <message>
        <source>Drop a DICOM folder, an image or a case on this window, or:</source>
        <translation>Legen Sie einen DICOM-Ordner, ein Bild oder einen Fall auf dieses Fenster, oder:</translation>
    </message>
    <message>
        <source>Recent cases:</source>
        <translation>Letzte Fälle:</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::StepList</name>
    <message>
        <source>Steps</source>
        <translation>Schritte</translation>
    </message>
    <message>
        <source>Click: go back or forth to this step</source>
        <translation>Klick: zu diesem Schritt zurück oder vor</translation>
    </message>
    <message>
        <source>Filter the steps</source>
        <translation>Schritte filtern</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filter</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::StudySeries</name>
    <message>
        <source>Series of the study</source>
        <translation>Serien der Untersuchung</translation>
    </message>
    <message>
        <source>Folder with phases or series of this study</source>
        <translation>Ordner mit Phasen oder Serien dieser Untersuchung</translation>
    </message>
    <message>
        <source>Looking for the phases</source>
        <translation>Phasen werden gesucht</translation>
    </message>
    <message>
        <source>No series there is known to be of the patient and the study that the image on the table is of. Two patients are never shown together: open the series by itself.</source>
        <translation>Von keiner Serie dort ist bekannt, dass sie vom Patienten und aus der Untersuchung des geöffneten Bildes stammt. Zwei Patienten werden nie zusammen gezeigt: Öffnen Sie die Serie für sich.</translation>
    </message>
    <message>
        <source>The images of the phases cannot be opened</source>
        <translation>Die Bilder der Phasen können nicht geöffnet werden</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <translation>%1 wird gelesen</translation>
    </message>
    <message>
        <source>%1 cannot be read and is left out: %2</source>
        <translation>%1 kann nicht gelesen werden und fällt weg: %2</translation>
    </message>
    <message>
        <source>image %1</source>
        <translation>Bild %1</translation>
    </message>
    <message>
        <source>the case&apos;s image</source>
        <translation>Bild des Falls</translation>
    </message>
    <message>
        <source>image %1, axes of %2</source>
        <translation>Bild %1, Achsen von %2</translation>
    </message>
    <message>
        <source>All phases together need %1 GB, more than the %2 GB that they may take: while they play they are shown more coarsely.</source>
        <translation>Alle Phasen zusammen brauchen %1 GB, mehr als die %2 GB, die sie belegen dürfen: Beim Abspielen werden sie gröber gezeigt.</translation>
    </message>
    <message>
        <source>Reading the phases, %1 of %2</source>
        <translation>Phasen werden gelesen, %1 von %2</translation>
    </message>
    <message>
        <source>no edges between fat and blood</source>
        <translation>keine Kanten zwischen Fett und Blut</translation>
    </message>
    <message>
        <source>half of the edges are missing</source>
        <translation>die Hälfte der Kanten fehlt</translation>
    </message>
    <message>
        <source>much noisier than the others</source>
        <translation>viel verrauschter als die anderen</translation>
    </message>
    <message>
        <source>other voxels than the others</source>
        <translation>andere Voxel als die anderen</translation>
    </message>
    <message>
        <source>does not cover the arteries</source>
        <translation>enthält die Arterien nicht ganz</translation>
    </message>
    <message>
        <source>the image on the table</source>
        <translation>das geöffnete Bild</translation>
    </message>
    <message>
        <source>series %1</source>
        <translation>Serie %1</translation>
    </message>
    <message>
        <source>%1 slices, voxels of %2 x %3 x %4 mm</source>
        <translation>%1 Schichten, Voxel von %2 x %3 x %4 mm</translation>
    </message>
    <message>
        <source>Slices are missing or uneven: open it by File &gt; Open.</source>
        <translation>Schichten fehlen oder liegen ungleich: mit Datei &gt; Öffnen öffnen.</translation>
    </message>
    <message>
        <source>cannot be read</source>
        <translation>nicht lesbar</translation>
    </message>
    <message>
        <source>on the table</source>
        <translation>geöffnet</translation>
    </message>
    <message>
        <source>sharpest</source>
        <translation>am schärfsten</translation>
    </message>
    <message>
        <source>%1 % sharp</source>
        <translation>Schärfe %1 %</translation>
    </message>
    <message>
        <source>not compared</source>
        <translation>nicht verglichen</translation>
    </message>
    <message>
        <source>Not compared: %1</source>
        <translation>Nicht verglichen: %1</translation>
    </message>
    <message>
        <source>Pictures of the series</source>
        <translation>Bilder der Serien</translation>
    </message>
    <message>
        <source>Looking for the sharpest phase</source>
        <translation>Schärfste Phase wird gesucht</translation>
    </message>
    <message>
        <source>By the edges about the arteries, whose axes the motion carries to each phase.</source>
        <translation>Nach den Kanten um die Arterien, deren Achsen die Bewegung in jede Phase trägt.</translation>
    </message>
    <message>
        <source>By the edges within 10 mm of the axes of the case&apos;s own phase: without a motion nobody knows where the arteries are at the others.</source>
        <translation>Nach den Kanten bis 10 mm um die Achsen der Phase des Falls: Ohne Bewegung weiß niemand, wo die Arterien in den anderen liegen.</translation>
    </message>
    <message>
        <source>By the edges of the heart: there are no axes of arteries yet.</source>
        <translation>Nach den Kanten des Herzens: Es gibt noch keine Achsen von Arterien.</translation>
    </message>
    <message>
        <source>Being measured…</source>
        <translation>Wird gemessen …</translation>
    </message>
    <message>
        <source>Find the sharpest</source>
        <translation>Schärfste suchen</translation>
    </message>
    <message>
        <source>Measures at which phase the arteries, or the heart, have the sharpest edges</source>
        <translation>Misst, in welcher Phase die Arterien oder das Herz die schärfsten Kanten haben</translation>
    </message>
    <message>
        <source>No sharpest phase</source>
        <translation>Keine schärfste Phase</translation>
    </message>
    <message>
        <source>Fewer than two phases can be compared.</source>
        <translation>Weniger als zwei Phasen lassen sich vergleichen.</translation>
    </message>
    <message>
        <source>As sharp: %1</source>
        <translation>Ebenso scharf: %1</translation>
    </message>
    <message>
        <source>Sharpest: %1</source>
        <translation>Am schärfsten: %1</translation>
    </message>
    <message>
        <source>Shows it.</source>
        <translation>Zeigt sie.</translation>
    </message>
    <message numerus="yes">
        <source>Series of the study – %n series of other patients or studies left out</source>
        <translation>
            <numerusform>Serien der Untersuchung – eine Serie anderer Patienten oder Untersuchungen weggelassen</numerusform>
            <numerusform>Serien der Untersuchung – %n Serien anderer Patienten oder Untersuchungen weggelassen</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::ToolBars</name>
    <message>
        <source>Reach</source>
        <translation>Reichweite</translation>
    </message>
    <message>
        <source>How far along the vessel a pull reaches</source>
        <translation>Wie weit ein Zug entlang des Gefäßes reicht</translation>
    </message>
    <message>
        <source>Ball</source>
        <translation>Kugel</translation>
    </message>
    <message>
        <source>Radius of the brush</source>
        <translation>Radius des Pinsels</translation>
    </message>
    <message>
        <source>Slab</source>
        <translation>Schicht</translation>
    </message>
    <message>
        <source>Thickness of the slab in 2D views, where one is shown</source>
        <translation>Dicke der Schicht in den 2D-Ansichten, wo eine gezeigt wird</translation>
    </message>
    <message>
        <source>Options</source>
        <translation>Optionen</translation>
    </message>
    <message>
        <source>Tools</source>
        <translation>Werkzeuge</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Tour</name>
    <message>
        <source>no key</source>
        <translation>keine Taste</translation>
    </message>
    <message>
        <source>Welcome</source>
        <translation>Willkommen</translation>
    </message>
    <message>
        <source>Ostia turns a CT angiogram into a corrected model of the coronary arteries. Drop a DICOM folder, an image or a case on the window, or use File. File &gt; The sample case opens a computed patient to try everything on.</source>
        <translation>Ostia macht aus einer CT-Angiographie ein korrigiertes Modell der Koronararterien. Ziehen Sie einen DICOM-Ordner, ein Bild oder einen Fall auf das Fenster, oder nehmen Sie das Menü Datei. Datei &gt; Beispielfall öffnet einen berechneten Patienten, an dem man alles ausprobieren kann.</translation>
    </message>
    <message>
        <source>The vessels</source>
        <translation>Die Gefäße</translation>
    </message>
    <message>
        <source>Every artery with its segments, its length, and its largest narrowing. Click one, and all views show it; %1 goes to the next. Tick Done when you have gone through it. A right click renames, cuts, joins or deletes.</source>
        <translation>Jede Arterie mit ihren Segmenten, ihrer Länge und ihrer stärksten Einengung. Ein Klick zeigt sie in allen Ansichten; %1 geht zur nächsten. Haken Sie sie ab, wenn Sie sie durchgesehen haben. Ein Rechtsklick benennt um, schneidet, verbindet oder löscht.</translation>
    </message>
    <message>
        <source>Two CPRs</source>
        <translation>Zwei CPRs</translation>
    </message>
    <message>
        <source>The selected artery laid straight, seen from two sides 90 degrees apart; its ostium is at the top. Shift and drag turns both, and so do %1 and %2. The wheel goes along the vessel, Ctrl and wheel zooms, the right button sets the grey levels.</source>
        <translation>Die gewählte Arterie, gerade gelegt, von zwei Seiten im Abstand von 90 Grad; das Ostium ist oben. Umschalt und Ziehen dreht beide, ebenso %1 und %2. Das Rad geht am Gefäß entlang, Strg und Rad vergrößert, die rechte Taste stellt die Graustufen ein.</translation>
    </message>
    <message>
        <source>The section</source>
        <translation>Der Querschnitt</translation>
    </message>
    <message>
        <source>The cut across the artery at the cursor, with its area and diameters. Below are its neighbours, and a slice of the patient.</source>
        <translation>Der Schnitt quer zur Arterie am Cursor, mit Fläche und Durchmessern. Darunter liegen seine Nachbarn und ein Schichtbild des Patienten.</translation>
    </message>
    <message>
        <source>The tree</source>
        <translation>Der Gefäßbaum</translation>
    </message>
    <message>
        <source>The lumen in three dimensions. Drag turns it, a click on a vessel goes there. The list in its title shows the heart behind it.</source>
        <translation>Das Lumen in drei Dimensionen. Ziehen dreht es, ein Klick auf ein Gefäß geht dorthin. Die Liste im Titel zeigt das Herz dahinter.</translation>
    </message>
    <message>
        <source>The profile</source>
        <translation>Das Profil</translation>
    </message>
    <message>
        <source>Diameter and area along the artery; the dashed line is the calibre without disease, red bands are stenoses. Click to go there; %1 goes from stenosis to stenosis.</source>
        <translation>Durchmesser und Fläche entlang der Arterie; die gestrichelte Linie ist das Kaliber ohne Krankheit, rote Bänder sind Stenosen. Ein Klick geht dorthin; %1 geht von Stenose zu Stenose.</translation>
    </message>
    <message>
        <source>Editing</source>
        <translation>Bearbeiten</translation>
    </message>
    <message>
        <source>Pull (%1) takes the contour where you grip it. Draw (%2) replaces the wall by your line, on a CPR or around the section. The brush (%3) pushes. All views follow while the mouse moves, and every step is saved at once.</source>
        <translation>Ziehen (%1) nimmt die Kontur dort, wo Sie sie greifen. Zeichnen (%2) ersetzt die Wand durch Ihre Linie, auf einer CPR oder um den Querschnitt. Der Pinsel (%3) schiebt. Alle Ansichten folgen der Maus, und jeder Schritt ist sofort gespeichert.</translation>
    </message>
    <message>
        <source>Undo and steps</source>
        <translation>Rückgängig und Schritte</translation>
    </message>
    <message>
        <source>%1 takes back, %2 does again. The tab Steps lists everything since the case began: click a line to go back to it.</source>
        <translation>%1 nimmt zurück, %2 wiederholt. Die Karte Schritte listet alles seit Beginn des Falls: ein Klick auf eine Zeile geht dorthin zurück.</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Distance, angle, area, diameter, stenosis, volume, and CT numbers around the lumen. What you place can be moved by its points, is listed under Measurements, and follows the wall.</source>
        <translation>Abstand, Winkel, Fläche, Durchmesser, Stenose, Volumen und CT-Werte um das Lumen. Messungen lassen sich an ihren Punkten verschieben, stehen in der Liste Messungen und folgen der Wand.</translation>
    </message>
    <message>
        <source>Report and help</source>
        <translation>Befund und Hilfe</translation>
    </message>
    <message>
        <source>Tour</source>
        <translation>Rundgang</translation>
    </message>
    <message>
        <source>Do not show again</source>
        <translation>Nicht mehr zeigen</translation>
    </message>
    <message>
        <source>Without the tick the next start begins with this tour; Help &gt; Tour repeats it</source>
        <translation>Ohne Haken beginnt der nächste Start mit diesem Rundgang; Hilfe &gt; Rundgang wiederholt ihn</translation>
    </message>
    <message>
        <source>Ends the tour (Esc)</source>
        <translation>Beendet den Rundgang (Esc)</translation>
    </message>
    <message>
        <source>End the tour</source>
        <translation>Rundgang beenden</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>The part before (Left)</source>
        <translation>Der vorige Teil (Links)</translation>
    </message>
    <message>
        <source>The next part (Right, Enter)</source>
        <translation>Der nächste Teil (Rechts, Eingabe)</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Finish</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>%1 makes the report with key images, segments, stenoses and measurements. %2 shows all keys and mouse gestures, Help &gt; Manual leads from DICOM to the report, Help &gt; Tour repeats this tour. Ostia is research software, not a medical device.</source>
        <translation>%1 erstellt den Befund mit Schlüsselbildern, Segmenten, Stenosen und Messungen. %2 zeigt alle Tasten und Mausgesten, Hilfe &gt; Handbuch führt von DICOM zum Befund, Hilfe &gt; Rundgang wiederholt diesen Rundgang. Ostia ist Forschungssoftware, kein Medizinprodukt.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::TransferPlot</name>
    <message>
        <source>Opacity of each CT number</source>
        <translation>Deckkraft je CT-Zahl</translation>
    </message>
    <message>
        <source>Drag to the side: other CT numbers are seen. Up or down: softer or harder. Double click: the preset as it is.</source>
        <translation>Zur Seite ziehen: andere CT-Zahlen sind zu sehen. Nach oben oder unten: weicher oder härter. Doppelklick: die Vorgabe, wie sie ist.</translation>
    </message>
    <message>
        <source>900 HU</source>
        <translation>900 HU</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::TreeOpening</name>
    <message>
        <source>Reading the vessel tree</source>
        <translation>Gefäßbaum wird gelesen</translation>
    </message>
    <message>
        <source>The tree cannot be opened</source>
        <translation>Der Baum kann nicht geöffnet werden</translation>
    </message>
    <message>
        <source>Faults in the tree</source>
        <translation>Fehler im Baum</translation>
    </message>
    <message>
        <source>%1 has faults: %2.

A repair changes what is shown, never the file.</source>
        <translation>%1 hat Fehler: %2.

Eine Reparatur ändert, was gezeigt wird, nie die Datei.</translation>
    </message>
    <message>
        <source>Repair and open</source>
        <translation>Reparieren und öffnen</translation>
    </message>
    <message>
        <source>Open as it is</source>
        <translation>Unverändert öffnen</translation>
    </message>
    <message>
        <source>Measuring the vessel tree</source>
        <translation>Gefäßbaum wird vermessen</translation>
    </message>
    <message>
        <source>No vessel tree is open: open a file of one first.</source>
        <translation>Kein Gefäßbaum ist geöffnet: Öffnen Sie zuerst eine Datei mit einem.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::TreePage</name>
    <message>
        <source>Radius of a region</source>
        <translation>Radius einer Region</translation>
    </message>
    <message>
        <source> mm</source>
        <translation> mm</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Measured values</source>
        <translation>Messwerte</translation>
    </message>
    <message>
        <source>Click a segment first: what lies behind it is then shown alone.</source>
        <translation>Klicken Sie zuerst auf ein Segment: Nur was dahinter liegt, wird dann gezeigt.</translation>
    </message>
    <message>
        <source>Save the measured values as</source>
        <translation>Messwerte speichern unter</translation>
    </message>
    <message>
        <source>Tables (*.csv)</source>
        <translation>Tabellen (*.csv)</translation>
    </message>
    <message>
        <source>%1 degrees</source>
        <translation>%1 Grad</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message numerus="yes">
        <source>%n segment(s), %1 mm, %2 mm², %3 mm³</source>
        <translation>
            <numerusform>%n Segment, %1 mm, %2 mm², %3 mm³</numerusform>
            <numerusform>%n Segmente, %1 mm, %2 mm², %3 mm³</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n segment(s)</source>
        <translation>
            <numerusform>%n Segment</numerusform>
            <numerusform>%n Segmente</numerusform>
        </translation>
    </message>
    <message>
        <source>Click a segment to see its facts.</source>
        <translation>Klicken Sie auf ein Segment, um seine Daten zu sehen.</translation>
    </message>
    <message>
        <source>Length %1 mm</source>
        <translation>Länge %1 mm</translation>
    </message>
    <message>
        <source>Radius %1 to %2 mm</source>
        <translation>Radius %1 bis %2 mm</translation>
    </message>
    <message>
        <source>Lateral area %1 mm²</source>
        <translation>Mantelfläche %1 mm²</translation>
    </message>
    <message>
        <source>Volume %1 mm³</source>
        <translation>Volumen %1 mm³</translation>
    </message>
    <message>
        <source>Strahler order %1, by diameter %2</source>
        <translation>Ordnung nach Strahler %1, nach Durchmesser %2</translation>
    </message>
    <message>
        <source>From the root %1 mm</source>
        <translation>Von der Wurzel %1 mm</translation>
    </message>
    <message numerus="yes">
        <source>With all behind it: %n segment(s),</source>
        <translation>
            <numerusform>Mit allem dahinter: %n Segment,</numerusform>
            <numerusform>Mit allem dahinter: %n Segmente,</numerusform>
        </translation>
    </message>
    <message>
        <source>%1 mm, %2 mm², %3 mm³</source>
        <translation>%1 mm, %2 mm², %3 mm³</translation>
    </message>
    <message>
        <source>At its fork %1° between the two, %2° and %3° from the parent</source>
        <translation>An seiner Gabel %1° zwischen beiden, %2° und %3° vom Stamm</translation>
    </message>
    <message>
        <source>Orders and what lies behind it are known of trees alone.</source>
        <translation>Ordnungen und was dahinter liegt sind nur bei Bäumen bekannt.</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::TreeView</name>
    <message>
        <source>Vessel tree</source>
        <translation>Gefäßbaum</translation>
    </message>
    <message>
        <source>The display&apos;s OpenGL is older than 3.3: the tree cannot be drawn.</source>
        <translation>Das OpenGL der Anzeige ist älter als 3.3: Der Baum kann nicht gezeichnet werden.</translation>
    </message>
    <message>
        <source>The graphics driver refuses the tree&apos;s drawing: %1</source>
        <translation>Der Grafiktreiber lehnt das Zeichnen des Baums ab: %1</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::TwinViews</name>
    <message>
        <source>%1, now</source>
        <translation>%1, jetzt</translation>
    </message>
    <message>
        <source>%1, before</source>
        <translation>%1, früher</translation>
    </message>
    <message>
        <source>%1, now: not reached</source>
        <translation>%1, jetzt: nicht erreicht</translation>
    </message>
    <message>
        <source>%1, before: not reached</source>
        <translation>%1, früher: nicht erreicht</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::VesselFinder</name>
    <message>
        <source>The case has no vessel any more and was closed; Undo brings it back.</source>
        <translation>Der Fall hat kein Gefäß mehr und wurde geschlossen; Rückgängig bringt ihn zurück.</translation>
    </message>
    <message>
        <source>The first vessel was taken back, and with it its case; Redo brings it back.</source>
        <translation>Das erste Gefäß wurde zurückgenommen und mit ihm sein Fall; Wiederholen bringt ihn zurück.</translation>
    </message>
    <message>
        <source>Another artery</source>
        <translation>Weitere Arterie</translation>
    </message>
    <message>
        <source>A vessel is found in the image: open the image of this case first.</source>
        <translation>Ein Gefäß wird im Bild gesucht: öffnen Sie zuerst das Bild dieses Falls.</translation>
    </message>
    <message>
        <source>The image is still being read.</source>
        <translation>Das Bild wird noch gelesen.</translation>
    </message>
    <message>
        <source>Finding the coronary arteries</source>
        <translation>Koronararterien werden gesucht</translation>
    </message>
    <message numerus="yes">
        <source>%n vessel(s) were found. Look at each before you trust it; a question mark in the list says where the program is not sure.</source>
        <translation>
            <numerusform>%n Gefäß wurde gefunden. Sehen Sie es an, bevor Sie ihm trauen; ein Fragezeichen in der Liste sagt, wo das Programm nicht sicher ist.</numerusform>
            <numerusform>%n Gefäße wurden gefunden. Sehen Sie jedes an, bevor Sie ihm trauen; ein Fragezeichen in der Liste sagt, wo das Programm nicht sicher ist.</numerusform>
        </translation>
    </message>
    <message>
        <source>The arteries were not found by themselves: %1</source>
        <translation>Die Arterien wurden nicht von selbst gefunden: %1</translation>
    </message>
    <message>
        <source>Way back to the tree</source>
        <translation>Weg zurück zum Baum</translation>
    </message>
    <message>
        <source>No vessel found</source>
        <translation>Kein Gefäß gefunden</translation>
    </message>
    <message>
        <source>Now click the distal end of this vessel.</source>
        <translation>Klicken Sie nun auf das distale Ende dieses Gefäßes.</translation>
    </message>
    <message>
        <source>First vessel</source>
        <translation>Erstes Gefäß</translation>
    </message>
    <message>
        <source>%1 was lengthened: the way came to its end.</source>
        <translation>%1 wurde verlängert: Der Weg kam am Ende des Gefäßes an.</translation>
    </message>
    <message>
        <source>Click the ostium of the artery, then its distal end.</source>
        <translation>Klicken Sie auf das Ostium der Arterie, dann auf ihr distales Ende.</translation>
    </message>
    <message>
        <source>The arteries were not found by themselves</source>
        <translation>Die Arterien wurden nicht von selbst gefunden</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::VesselList</name>
    <message>
        <source>Image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>How far the image shows the vessel: a dot where nothing keeps it from being judged, else where it can be judged in part, or not at all</source>
        <translation>Wie weit das Bild das Gefäß zeigt: ein Punkt, wo der Beurteilung nichts entgegensteht, sonst wo es eingeschränkt oder gar nicht beurteilbar ist</translation>
    </message>
    <message>
        <source>in part</source>
        <translation>zum Teil</translation>
    </message>
    <message>
        <source>%1 % not</source>
        <translation>%1 % nicht</translation>
    </message>
    <message>
        <source>%1 to %2 mm: %3</source>
        <translation>%1 bis %2 mm: %3</translation>
    </message>
    <message>
        <source>All of it can be judged</source>
        <translation>Alles ist beurteilbar</translation>
    </message>
    <message>
        <source>Vessels</source>
        <translation>Gefäße</translation>
    </message>
    <message>
        <source>Vessel</source>
        <translation>Gefäß</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>Edits</source>
        <translation>Bearb.</translation>
    </message>
    <message>
        <source>Worst</source>
        <translation>Engste</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Samples of the wall that a person placed</source>
        <translation>Punkte der Wand, die ein Mensch gesetzt hat</translation>
    </message>
    <message>
        <source>Largest narrowing, percent of diameter</source>
        <translation>Stärkste Einengung, Prozent des Durchmessers</translation>
    </message>
    <message>
        <source>A person has gone through this vessel</source>
        <translation>Ein Mensch hat dieses Gefäß durchgesehen</translation>
    </message>
    <message>
        <source>Tick: shown in 3D. F2: another name.</source>
        <translation>Haken: in 3D gezeigt. F2: anderer Name.</translation>
    </message>
    <message>
        <source>Colour of %1</source>
        <translation>Farbe von %1</translation>
    </message>
    <message>
        <source>Rename…</source>
        <translation>Umbenennen…</translation>
    </message>
    <message>
        <source>Colour…</source>
        <translation>Farbe…</translation>
    </message>
    <message>
        <source>Cut off distal of the cursor</source>
        <translation>Distal des Cursors abschneiden</translation>
    </message>
    <message>
        <source>Delete with its branches</source>
        <translation>Mit seinen Ästen löschen</translation>
    </message>
    <message>
        <source>Join to</source>
        <translation>Verbinden mit</translation>
    </message>
    <message>
        <source>Where its own part begins goes to the nearest place of that vessel</source>
        <translation>Der Anfang seines eigenen Teils kommt an die nächste Stelle jenes Gefäßes</translation>
    </message>
    <message>
        <source>Split at the cursor</source>
        <translation>Am Cursor teilen</translation>
    </message>
    <message>
        <source>Join with parent vessel</source>
        <translation>Mit dem Muttergefäß verbinden</translation>
    </message>
    <message>
        <source>Cut in two at the cursor</source>
        <translation>Am Cursor durchtrennen</translation>
    </message>
    <message>
        <source>Connect to the cursor</source>
        <translation>Mit dem Cursor verbinden</translation>
    </message>
</context>
<context>
    <name>ostia::workstation::VolumeFields</name>
    <message>
        <source>STL, a file for each face</source>
        <translation>STL, eine Datei je Fläche</translation>
    </message>
    <message>
        <source>Layers of prisms on the wall</source>
        <translation>Prismenschichten auf der Wand</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>Flat prisms on the wall, where the shear stress is. Where there is no room they get thinner, never fewer.</source>
        <translation>Flache Prismen auf der Wand, wo die Schubspannung ist. Wo kein Platz ist, werden sie dünner, nie weniger.</translation>
    </message>
    <message>
        <source>Thickness of all layers</source>
        <translation>Dicke aller Schichten</translation>
    </message>
    <message>
        <source>thickness </source>
        <translation>Dicke </translation>
    </message>
    <message>
        <source> of an edge</source>
        <translation> einer Kante</translation>
    </message>
    <message>
        <source>as tetrahedra</source>
        <translation>als Tetraeder</translation>
    </message>
    <message>
        <source>Each prism becomes three tetrahedra, for programs that know nothing else</source>
        <translation>Jedes Prisma wird zu drei Tetraedern, für Programme, die nichts anderes kennen</translation>
    </message>
    <message>
        <source>&amp;Layers</source>
        <translation>&amp;Schichten</translation>
    </message>
    <message>
        <source>Order of the elements</source>
        <translation>Ordnung der Elemente</translation>
    </message>
    <message>
        <source>linear</source>
        <translation>linear</translation>
    </message>
    <message>
        <source>quadratic, curved along the wall</source>
        <translation>quadratisch, der Wand entlang gekrümmt</translation>
    </message>
    <message>
        <source>Ele&amp;ments</source>
        <translation>Ele&amp;mente</translation>
    </message>
    <message>
        <source>Formats of the mesh</source>
        <translation>Formate des Netzes</translation>
    </message>
    <message>
        <source>VTU, which ParaView reads, is always written; it keeps the names of the faces</source>
        <translation>VTU, das ParaView liest, wird immer geschrieben; es behält die Namen der Flächen</translation>
    </message>
    <message>
        <source>Mesh as VTU, and</source>
        <translation>Netz als VTU und</translation>
    </message>
    <message>
        <source>%1 layers are too many. Choose up to %2.</source>
        <translation>%1 Schichten sind zu viele. Wählen Sie höchstens %2.</translation>
    </message>
    <message>
        <source>Layers of %1 edges together cannot be made. Choose a thickness above 0 and up to %2.</source>
        <translation>Schichten von zusammen %1 Kanten sind nicht möglich. Wählen Sie eine Dicke über 0 bis %2.</translation>
    </message>
    <message>
        <source>%1 cannot hold quadratic elements. Choose linear ones, or take the mark away.</source>
        <translation>%1 kann keine quadratischen Elemente aufnehmen. Wählen Sie lineare, oder entfernen Sie das Häkchen.</translation>
    </message>
    <message>
        <source>%1 cannot hold these prisms. Choose layers as tetrahedra, or take the mark away.</source>
        <translation>%1 kann diese Prismen nicht aufnehmen. Wählen Sie Schichten als Tetraeder, oder entfernen Sie das Häkchen.</translation>
    </message>
</context>
<context>
    <name>presets</name>
    <message>
        <source>CTA</source>
        <translation>CTA</translation>
    </message>
    <message>
        <source>Soft tissue</source>
        <translation>Weichteil</translation>
    </message>
    <message>
        <source>Lung</source>
        <translation>Lunge</translation>
    </message>
    <message>
        <source>Bone</source>
        <translation>Knochen</translation>
    </message>
</context>
<context>
    <name>stages</name>
    <message>
        <source>reading DICOM headers</source>
        <translation>DICOM-Köpfe lesen</translation>
    </message>
    <message>
        <source>decoding DICOM</source>
        <translation>DICOM entschlüsseln</translation>
    </message>
    <message>
        <source>resampling DICOM</source>
        <translation>DICOM umrechnen</translation>
    </message>
    <message>
        <source>unpacking</source>
        <translation>auspacken</translation>
    </message>
    <message>
        <source>synthetic patient</source>
        <translation>berechneter Patient</translation>
    </message>
    <message>
        <source>scan</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>writing</source>
        <translation>schreiben</translation>
    </message>
    <message>
        <source>writing the image</source>
        <translation>Bild schreiben</translation>
    </message>
    <message>
        <source>walls of the vessels</source>
        <translation>Gefäßwände</translation>
    </message>
    <message>
        <source>lumen boundary</source>
        <translation>Rand des Lumens</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>Oberfläche</translation>
    </message>
    <message>
        <source>measuring</source>
        <translation>messen</translation>
    </message>
    <message>
        <source>key images</source>
        <translation>Schlüsselbilder</translation>
    </message>
    <message>
        <source>report</source>
        <translation>Befund</translation>
    </message>
    <message>
        <source>finding the way to the tree</source>
        <translation>Weg zum Baum suchen</translation>
    </message>
    <message>
        <source>finding the way between two points</source>
        <translation>Weg zwischen zwei Punkten suchen</translation>
    </message>
    <message>
        <source>walls</source>
        <translation>Wände</translation>
    </message>
    <message>
        <source>ends cut</source>
        <translation>Enden schneiden</translation>
    </message>
    <message>
        <source>clipping</source>
        <translation>Enden schneiden</translation>
    </message>
    <message>
        <source>caps</source>
        <translation>Deckel</translation>
    </message>
    <message>
        <source>centerlines of the cut lumen</source>
        <translation>Mittellinien des geschnittenen Lumens</translation>
    </message>
    <message>
        <source>remeshing</source>
        <translation>Neu vernetzen</translation>
    </message>
    <message>
        <source>tetrahedra</source>
        <translation>Tetraeder</translation>
    </message>
    <message>
        <source>quality</source>
        <translation>Güte</translation>
    </message>
    <message>
        <source>flow extensions</source>
        <translation>Strömungsverlängerungen</translation>
    </message>
    <message>
        <source>boundary layers</source>
        <translation>Grenzschichten</translation>
    </message>
    <message>
        <source>quadratic elements</source>
        <translation>quadratische Elemente</translation>
    </message>
    <message>
        <source>mesh quality</source>
        <translation>Netzqualität</translation>
    </message>
    <message>
        <source>checking the mesh</source>
        <translation>Netz wird geprüft</translation>
    </message>
    <message>
        <source>iteration, residual</source>
        <translation>Iteration, Residuum</translation>
    </message>
    <message>
        <source>time, s</source>
        <translation>Zeit, s</translation>
    </message>
    <message>
        <source>reading the result</source>
        <translation>Ergebnis wird gelesen</translation>
    </message>
    <message>
        <source>preview</source>
        <translation>Vorschau</translation>
    </message>
    <message>
        <source>mesh forecast</source>
        <translation>Vorhersage</translation>
    </message>
    <message>
        <source>reading</source>
        <translation>Lesen</translation>
    </message>
</context>
<context>
    <name>steps</name>
    <message>
        <source>Plug-in</source>
        <translation>Plug-in</translation>
    </message>
    <message>
        <source>Add an artery</source>
        <translation>Arterie hinzufügen</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>Draw on CPR</source>
        <translation>Zeichnen auf CPR</translation>
    </message>
    <message>
        <source>Draw on section</source>
        <translation>Zeichnen auf Querschnitt</translation>
    </message>
    <message>
        <source>Pull the wall</source>
        <translation>Wand ziehen</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinsel</translation>
    </message>
    <message>
        <source>Move the centerline</source>
        <translation>Mittellinie verschieben</translation>
    </message>
    <message>
        <source>Add a control point</source>
        <translation>Stützpunkt hinzufügen</translation>
    </message>
    <message>
        <source>Delete a control point</source>
        <translation>Stützpunkt löschen</translation>
    </message>
    <message>
        <source>Extend the vessel</source>
        <translation>Gefäß verlängern</translation>
    </message>
    <message>
        <source>Cut the vessel off</source>
        <translation>Gefäß abschneiden</translation>
    </message>
    <message>
        <source>Add a vessel</source>
        <translation>Gefäß hinzufügen</translation>
    </message>
    <message>
        <source>Delete a vessel</source>
        <translation>Gefäß löschen</translation>
    </message>
    <message>
        <source>Join a vessel elsewhere</source>
        <translation>Gefäß anderswo verbinden</translation>
    </message>
    <message>
        <source>Rename a vessel</source>
        <translation>Gefäß umbenennen</translation>
    </message>
    <message>
        <source>Mark a vessel</source>
        <translation>Gefäß kennzeichnen</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Messen</translation>
    </message>
    <message>
        <source>Change a measurement</source>
        <translation>Messung ändern</translation>
    </message>
    <message>
        <source>Delete a measurement</source>
        <translation>Messung löschen</translation>
    </message>
    <message>
        <source>Split a vessel</source>
        <translation>Gefäß teilen</translation>
    </message>
    <message>
        <source>Join a vessel with its parent</source>
        <translation>Gefäß mit dem Muttergefäß verbinden</translation>
    </message>
    <message>
        <source>Cut a vessel in two</source>
        <translation>Gefäß durchtrennen</translation>
    </message>
    <message>
        <source>Connect a vessel</source>
        <translation>Gefäß verbinden</translation>
    </message>
    <message>
        <source>Inputs of the pressures</source>
        <translation>Eingaben der Drücke</translation>
    </message>
    <message>
        <source>What if, of the pressures</source>
        <translation>Was wäre, wenn, bei den Drücken</translation>
    </message>
    <message>
        <source>Impression of the report</source>
        <translation>Beurteilung des Befunds</translation>
    </message>
    <message>
        <source>Modifiers of CAD-RADS</source>
        <translation>Zusätze zu CAD-RADS</translation>
    </message>
    <message>
        <source>Features of plaque</source>
        <translation>Merkmale von Plaque</translation>
    </message>
    <message>
        <source>Sign the report</source>
        <translation>Befund unterschreiben</translation>
    </message>
    <message>
        <source>Place of a lesion of calcium</source>
        <translation>Ort einer Kalkläsion</translation>
    </message>
</context>
<context>
    <name>views</name>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Diameter</source>
        <translation>Durchmesser</translation>
    </message>
    <message>
        <source>Stenosis</source>
        <translation>Stenose</translation>
    </message>
    <message>
        <source>Volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>HU ring</source>
        <translation>HU-Ring</translation>
    </message>
    <message>
        <source>Arrow</source>
        <translation>Pfeil</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>evaluable</source>
        <translation>beurteilbar</translation>
    </message>
    <message>
        <source>limited</source>
        <translation>eingeschränkt</translation>
    </message>
    <message>
        <source>not evaluable</source>
        <translation>nicht beurteilbar</translation>
    </message>
    <message>
        <source>reader</source>
        <translation>Befunder</translation>
    </message>
    <message>
        <source>the image ends</source>
        <translation>das Bild endet</translation>
    </message>
    <message>
        <source>voxels too coarse for its calibre</source>
        <translation>Voxel zu grob für das Kaliber</translation>
    </message>
    <message>
        <source>hardly brighter than the noise</source>
        <translation>kaum heller als das Rauschen</translation>
    </message>
    <message>
        <source>no clear edge</source>
        <translation>keine klare Kante</translation>
    </message>
    <message>
        <source>calcium hides the lumen</source>
        <translation>Kalk verdeckt das Lumen</translation>
    </message>
    <message>
        <source>the edge is blurred</source>
        <translation>die Kante ist unscharf</translation>
    </message>
    <message>
        <source>straightened</source>
        <translation>begradigt</translation>
    </message>
    <message>
        <source>stretched</source>
        <translation>gestreckt</translation>
    </message>
    <message>
        <source>axial</source>
        <translation>axial</translation>
    </message>
    <message>
        <source>coronal</source>
        <translation>koronar</translation>
    </message>
    <message>
        <source>sagittal</source>
        <translation>sagittal</translation>
    </message>
    <message>
        <source>oblique</source>
        <translation>schräg</translation>
    </message>
    <message>
        <source>diameter, mm</source>
        <translation>Durchmesser, mm</translation>
    </message>
    <message>
        <source>area, mm²</source>
        <translation>Fläche, mm²</translation>
    </message>
    <message>
        <source>mm from its root</source>
        <translation>mm ab Ursprung</translation>
    </message>
    <message>
        <source>not measurable</source>
        <translation>nicht messbar</translation>
    </message>
    <message>
        <source>There is no vessel: click on the wall of one.</source>
        <translation>Hier ist kein Gefäß: auf die Wand eines Gefäßes klicken.</translation>
    </message>
    <message>
        <source>This is another vessel: both places have to lie along one.</source>
        <translation>Das ist ein anderes Gefäß: Beide Stellen müssen an demselben liegen.</translation>
    </message>
    <message>
        <source>The lumen is shut or open here: there is nothing to measure across it.</source>
        <translation>Das Lumen ist hier verschlossen oder offen: Quer dazu ist nichts zu messen.</translation>
    </message>
    <message>
        <source>outer wall</source>
        <translation>Außenwand</translation>
    </message>
    <message>
        <source>low attenuation</source>
        <translation>niedrige Dichte</translation>
    </message>
    <message>
        <source>fibrofatty</source>
        <translation>fibrofettig</translation>
    </message>
    <message>
        <source>fibrous</source>
        <translation>fibrös</translation>
    </message>
    <message>
        <source>calcified</source>
        <translation>verkalkt</translation>
    </message>
    <message>
        <source>image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>tree</source>
        <translation>Baum</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>Mittelwert</translation>
    </message>
    <message>
        <source>MIP</source>
        <translation>MIP</translation>
    </message>
    <message>
        <source>MinIP</source>
        <translation>MinIP</translation>
    </message>
    <message>
        <source>FFR (research)</source>
        <translation>FFR (Forschung)</translation>
    </message>
    <message>
        <source>what if</source>
        <translation>was wäre, wenn</translation>
    </message>
</context>
</TS>
