<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en" sourcelanguage="en">
<context>
    <name>ostia::workstation::ArchiveDialog</name>
    <message numerus="yes">
        <source>%n study(ies)</source>
        <translation>
            <numerusform>%n study</numerusform>
            <numerusform>%n studies</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Opening</name>
    <message numerus="yes">
        <source>%n vessel(s) of the mask; a question mark says where to look first.</source>
        <translation>
            <numerusform>One vessel of the mask; a question mark says where to look first.</numerusform>
            <numerusform>%n vessels of the mask; a question mark says where to look first.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>The program ended without closing this case and %n more, which are among the recent ones.</source>
        <translation>
            <numerusform>The program ended without closing this case and one more, which is among the recent ones.</numerusform>
            <numerusform>The program ended without closing this case and %n more, which are among the recent ones.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Palette</name>
    <message numerus="yes">
        <source>%n command(s)   ·   ↑ ↓ choose   ·   Enter runs it   ·   Esc closes</source>
        <translation>
            <numerusform>%n command   ·   ↑ ↓ choose   ·   Enter runs it   ·   Esc closes</numerusform>
            <numerusform>%n commands   ·   ↑ ↓ choose   ·   Enter runs it   ·   Esc closes</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Plugins</name>
    <message numerus="yes">
        <source>%n plug-in(s).</source>
        <translation>
            <numerusform>One plug-in.</numerusform>
            <numerusform>%n plug-ins.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n vessel(s) of the mask; a question mark says where to look first.</source>
        <translation>
            <numerusform>One vessel of the mask; a question mark says where to look first.</numerusform>
            <numerusform>%n vessels of the mask; a question mark says where to look first.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n edit(s) as one step; Undo takes it back.</source>
        <translation>
            <numerusform>One edit; Undo takes it back.</numerusform>
            <numerusform>%n edits as one step; Undo takes it back.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::QaDock</name>
    <message numerus="yes">
        <source>%n movement(s) were recorded.</source>
        <translation>
            <numerusform>One movement was recorded.</numerusform>
            <numerusform>%n movements were recorded.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::Reporting</name>
    <message numerus="yes">
        <source>%n page(s) more in the next report.</source>
        <translation>
            <numerusform>%n page more in the next report.</numerusform>
            <numerusform>%n pages more in the next report.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::SeriesBrowser</name>
    <message numerus="yes">
        <source>%n damaged file(s)</source>
        <translation>
            <numerusform>%n damaged file</numerusform>
            <numerusform>%n damaged files</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n file(s) that are no images</source>
        <translation>
            <numerusform>%n file that is no image</numerusform>
            <numerusform>%n files that are no images</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::StudySeries</name>
    <message numerus="yes">
        <source>Series of the study – %n series of other patients or studies left out</source>
        <translation>
            <numerusform>Series of the study – one series of other patients or studies left out</numerusform>
            <numerusform>Series of the study – %n series of other patients or studies left out</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::TreePage</name>
    <message numerus="yes">
        <source>%n segment(s), %1 mm, %2 mm², %3 mm³</source>
        <translation>
            <numerusform>%n segment, %1 mm, %2 mm², %3 mm³</numerusform>
            <numerusform>%n segments, %1 mm, %2 mm², %3 mm³</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n segment(s)</source>
        <translation>
            <numerusform>%n segment</numerusform>
            <numerusform>%n segments</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>With all behind it: %n segment(s),</source>
        <translation>
            <numerusform>With all behind it: %n segment,</numerusform>
            <numerusform>With all behind it: %n segments,</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>ostia::workstation::VesselFinder</name>
    <message numerus="yes">
        <source>%n vessel(s) were found. Look at each before you trust it; a question mark in the list says where the program is not sure.</source>
        <translation>
            <numerusform>One vessel was found. Look at it before you trust it; a question mark in the list says where the program is not sure.</numerusform>
            <numerusform>%n vessels were found. Look at each before you trust it; a question mark in the list says where the program is not sure.</numerusform>
        </translation>
    </message>
</context>
</TS>
