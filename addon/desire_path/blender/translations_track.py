"""translations_track.py - labels and descriptions of tracks in other languages, as translations.py takes them."""

LABELS = {
    "Operator": {"Add Track": "Spur hinzufügen", "Press Tracks": "Spuren drücken", "Remove Track": "Spur entfernen"},
    "*": {
        "Apart [m]": "Abstand [m]",
        "Bare Foot": "Bloßer Fuß",
        "Bars": "Balken",
        "Bicycle": "Fahrrad",
        "Blocks": "Blöcke",
        "Boot": "Stiefel",
        "Car": "Auto",
        "Deer": "Hirsch",
        "End [m/s]": "Ende [m/s]",
        "First": "Zuerst",
        "Gauge [m]": "Spur [m]",
        "Gull": "Möwe",
        "Horseshoe": "Hufeisen",
        "Image": "Bild",
        "Height [m]": "Höhe [m]",
        "Length [m]": "Länge [m]",
        "Leaves": "Hinterlässt",
        "Left": "Links",
        "Lorry": "Lastzug",
        "Motorcycle": "Motorrad",
        "Radius [m]": "Radius [m]",
        "Right": "Rechts",
        "Shoe": "Schuh",
        "Size": "Größe",
        "Size Scatter": "Größenstreuung",
        "Speed [m/s]": "Fahrt [m/s]",
        "Stamp": "Stempel",
        "Stamps": "Stempel",
        "Track": "Spur",
        "Tractor": "Traktor",
        "Truck": "Lastwagen",
        "Tyre [m]": "Reifen [m]",
        "Vehicle": "Fahrzeug",
        "Wheel": "Rad",
        "Wheels": "Räder",
        "Width [m]": "Breite [m]",
        "Wolf": "Wolf",
    },
}
GERMAN = {
    "Let marks lie along the active curve, on its ground or the only one there is, and show where": (
        "Entlang der aktiven Kurve Abdrücke liegen lassen, auf ihrem Boden oder dem einzigen, und zeigen wo"
    ),
    "Let no marks lie along the active curve; what was pressed stays until tracks are pressed again": (
        "Entlang der aktiven Kurve keine Abdrücke mehr; was gedrückt ist, bleibt, bis wieder Spuren gedrückt werden"
    ),
    "Press all tracks of this ground into it, in the order of their names, in place of those pressed before": (
        "Alle Spuren dieses Bodens in ihn drücken, in der Folge ihrer Namen, anstelle derer davor"
    ),
    "Whose wheels roll along": ("Wessen Räder rollen"),
    "One wheel, or two, as set below": ("Ein Rad, oder zwei, wie unten gesetzt"),
    "Two narrow tyres, one behind the other": ("Zwei schmale Reifen, einer hinter dem anderen"),
    "Two tyres, one behind the other": ("Zwei Reifen, einer hinter dem anderen"),
    "Four wheels": ("Vier Räder"),
    "Bars on its tyres, the larger behind": ("Balken auf den Reifen, die größeren hinten"),
    "Two axles, with dual tyres behind": ("Zwei Achsen, mit Zwillingsreifen hinten"),
    "Three axles, with dual tyres on the two behind": ("Drei Achsen, mit Zwillingsreifen auf den beiden hinteren"),
    "Marks lie along this curve": ("Entlang dieser Kurve liegen Abdrücke"),
    "What leaves a track along a curve": ("Was entlang einer Kurve eine Spur hinterlässt"),
    "What leaves the track": ("Was die Spur hinterlässt"),
    "The shape of the marks": ("Die Form der Abdrücke"),
    "The shape of the marks, seen from above, forward is up: white is lowest, black does not touch": (
        "Die Form der Abdrücke, von oben gesehen, vorn ist oben: Weiß ist am tiefsten, Schwarz berührt nicht"
    ),
    "How long the image is, in metres": ("Wie lang das Bild ist, in Metern"),
    "From what is nearly black to what is white, in metres": ("Von fast Schwarz bis Weiß, in Metern"),
    "A mesh whose underside leaves the marks: its own X is forward, Z is up, of a left foot": (
        "Ein Netz, dessen Unterseite die Abdrücke hinterlässt: sein X ist vorn, Z ist oben, für einen linken Fuß"
    ),
    "From mark to mark, in metres; 0 = as is usual": ("Von Abdruck zu Abdruck, in Metern; 0 = wie üblich"),
    "Between the lines of left and right marks, in metres; 0 = as is usual": (
        "Zwischen den Linien der linken und rechten Abdrücke, in Metern; 0 = wie üblich"
    ),
    "Times as large as usual": ("Wievielmal so groß wie üblich"),
    "By how much sizes differ, a share": ("Um wie viel sich Größen unterscheiden, ein Anteil"),
    "Another number scatters the sizes otherwise": ("Eine andere Zahl streut die Größen anders"),
    "The foot that begins": ("Der Fuß, der beginnt"),
    "How deep marks are, whatever presses weighs, in metres; 0 = as the weight makes them": (
        "Wie tief Abdrücke sind, was immer drückt, in Metern; 0 = wie das Gewicht sie macht"
    ),
    "What rests on a mark, or on all wheels, in kilograms, where no depth is set; 0 = as is usual": (
        "Was auf einem Abdruck ruht, oder auf allen Rädern, in Kilogramm, wo keine Tiefe gesetzt ist; 0 = wie üblich"
    ),
    "What rests on a mark, or on all wheels; 0 = as is usual": (
        "Was auf einem Abdruck ruht, oder auf allen Rädern; 0 = wie üblich"
    ),
    "At the start of the curve, in metres a second; 0 = as is usual": (
        "Am Anfang der Kurve, in Metern pro Sekunde; 0 = wie üblich"
    ),
    "At the end of the curve, in metres a second: steps grow with it; 0 = as at the start": (
        "Am Ende der Kurve, in Metern pro Sekunde: Schritte wachsen mit ihm; 0 = wie am Anfang"
    ),
    "Of the wheel, in metres": ("Des Rades, in Metern"),
    "How wide the tyre is, in metres": ("Wie breit der Reifen ist, in Metern"),
    "Two wheels, so far from middle to middle, in metres; 0 = one wheel": (
        "Zwei Räder, so weit von Mitte zu Mitte, in Metern; 0 = ein Rad"
    ),
    "What the tyre carries": ("Was der Reifen trägt"),
    "Marks of one shape after the other": ("Ein Abdruck derselben Form nach dem anderen"),
    "A wheel that rolls along, two, or those of a vehicle": ("Ein Rad, das entlangrollt, oder zwei"),
    "Marks of a mesh, one after the other": ("Abdrücke eines Netzes, einer nach dem anderen"),
    "A boot with lugs": ("Ein Stiefel mit Stollen"),
    "A running shoe": ("Ein Laufschuh"),
    "A bare foot": ("Ein bloßer Fuß"),
    "A horse that is shod": ("Ein beschlagenes Pferd"),
    "The paw of a wolf, or of a large dog": ("Die Pfote eines Wolfs oder großen Hundes"),
    "The cloven hoof of a deer": ("Der gespaltene Huf eines Hirsches"),
    "The webbed foot of a gull": ("Der Fuß einer Möwe mit Schwimmhäuten"),
    "A picture of your own": ("Ein eigenes Bild"),
    "The left foot begins": ("Der linke Fuß beginnt"),
    "The right foot begins": ("Der rechte Fuß beginnt"),
    "A smooth tyre": ("Ein glatter Reifen"),
    "Rows of blocks, as on roads": ("Reihen von Blöcken, wie auf Straßen"),
    "Bars that meet in the middle, as of a tractor": ("Balken, die sich in der Mitte treffen, wie bei einem Schlepper"),
    "Select the curve that a track lies along first": ("Erst die Kurve wählen, an der eine Spur liegt"),
}
