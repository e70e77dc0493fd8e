"""sentences_tracks.py - what is told of paths and tracks of stamps and wheels, in other languages.

Keys are the English sentences as templates; {} is what comes in, in the same order unless numbered.
"""

GERMAN = {
    # ---- bake/stamping.py
    "There is no mark to press: lay a track first.": "Es gibt keinen Abdruck zu drücken: erst eine Fährte legen.",
    "The tracks lie in {} cells of {} m: choose larger cells.": (
        "Die Fährten liegen in {} Zellen von {} m: größere Zellen wählen."
    ),
    # ---- blender/track.py
    "The tracks of '{}' are pressed already, together with what a hand has pressed, and would be pressed twice: "
    "undo that, or free the ground, first.": (
        "Die Fährten von '{}' sind schon eingedrückt, zusammen mit dem, was eine Hand eingedrückt hat, und würden es "
        "zweimal: das erst rückgängig machen, oder den Boden freigeben."
    ),
    "The tracks that were pressed are gone: free the ground, or add others and press them.": (
        "Die Fährten, die eingedrückt wurden, sind fort: den Boden freigeben, oder andere hinzufügen und eindrücken."
    ),
    "The tracks have changed since they were pressed: press them again.": (
        "Die Fährten haben sich geändert, seit sie eingedrückt wurden: sie wieder eindrücken."
    ),
    # ---- placement/marks.py
    "There is no foot '{}' to begin with: choose left or right.": (
        "Es gibt keinen Fuß '{}', um zu beginnen: left oder right wählen."
    ),
    "{} marks cannot be made: give a number from 1 to {}.": "{} Abdrücke gehen nicht: eine Zahl von 1 bis {} angeben.",
    "A track has either a spacing or a number of marks: leave one of them out.": (
        "Eine Fährte hat entweder einen Abstand oder eine Zahl von Abdrücken: eines davon weglassen."
    ),
    "This would be {} marks, and {} are the most: give a larger spacing.": (
        "Das wären {} Abdrücke, und {} sind die meisten: einen größeren Abstand angeben."
    ),
    "The curve stands upright, and no track goes along it: lay it over the ground.": (
        "Die Kurve steht aufrecht, und keine Fährte führt an ihr entlang: sie über den Boden legen."
    ),
    "A track has either a mass or a depth: leave one of them out.": (
        "Eine Fährte hat entweder eine Masse oder eine Tiefe: eines davon weglassen."
    ),
    "A track with a {} of {} {} is none: give one above 0 and up to {}.": (
        "Eine Fährte mit {} von {} {} ist keine: mehr als 0 und bis {} angeben."
    ),
    "A track with a {} of {} is none: give one from {} to {}.": (
        "Eine Fährte mit {} von {} ist keine: etwas von {} bis {} angeben."
    ),
    # ---- placement/pace.py
    "A track's ground is a height, a function of places (n, 2), or a Simulation.": (
        "Der Boden einer Fährte ist eine Höhe, eine Funktion von Orten (n, 2) oder eine Simulation."
    ),
    "The track leaves the ground at x {} m, y {} m: keep the curve on it, or make it larger.": (
        "Die Fährte verlässt den Boden bei x {} m, y {} m: die Kurve darauf halten, oder ihn größer machen."
    ),
    # ---- placement/vehicle.py
    "A vehicle has {} axles: give it from 1 to {}.": "Ein Fahrzeug hat {} Achsen: 1 bis {} angeben.",
    "A vehicle's first axle is its foremost, 0 m behind itself, and the others lie behind it: mend `behind`.": (
        "Die erste Achse eines Fahrzeugs ist seine vorderste, 0 m hinter sich, und die anderen liegen hinter ihr: "
        "`behind` richten."
    ),
    "The curve bends too tightly for this vehicle at x {} m, y {} m, where its front wheels would stand at {} degrees: "
    "draw it wider, or choose a shorter vehicle.": (
        "Die Kurve biegt bei x {} m, y {} m zu eng für dieses Fahrzeug, dessen Vorderräder dort {} Grad einschlagen "
        "müssten: sie weiter ziehen, oder ein kürzeres Fahrzeug wählen."
    ),
    "An axle has no {}: remove it.": "Eine Achse hat kein {}: es entfernen.",
    "A vehicle's axles are a list of Axle: give it so.": (
        "Die Achsen eines Fahrzeugs sind eine Liste von Axle: so angeben."
    ),
    "The {} is {}: give a number from {} to {}.": "{} ist {}: eine Zahl von {} bis {} angeben.",
    "An axle has {} tyres side by side: give 1 or {}.": "Eine Achse hat {} Reifen nebeneinander: 1 oder {} angeben.",
    "Dual tyres {} m wide do not fit in a gauge of {} m: widen it.": (
        "Zwillingsreifen von {} m Breite passen nicht in eine Spurweite von {} m: sie weiten."
    ),
    "There is no vehicle '{}': choose one of {}, or a .json file of one.": (
        "Es gibt kein Fahrzeug '{}': eines von {} wählen, oder eine .json-Datei von einem."
    ),
    # ---- placement/path.py
    "The path has no length: give it at least two places that lie apart.": (
        "Der Weg hat keine Länge: ihm mindestens zwei Orte geben, die auseinander liegen."
    ),
    "The path is no list of places: give rows of x, y or x, y, z in metres.": (
        "Der Weg ist keine Liste von Orten: Zeilen aus x, y oder x, y, z in Metern geben."
    ),
    "The path has the shape {}: give at least two rows of x, y or x, y, z in metres.": (
        "Der Weg hat die Form {}: mindestens zwei Zeilen aus x, y oder x, y, z in Metern geben."
    ),
    "Row {} of the path is not a finite place: mend it.": "Die Zeile {} des Wegs ist kein endlicher Ort: sie richten.",
    "Row {} of the path lies {} m away: give places within {} m.": (
        "Die Zeile {} des Wegs liegt {} m fort: Orte innerhalb von {} m geben."
    ),
    "Line {} of {} is not a place in numbers: mend it.": "Die Zeile {} von {} ist kein Ort in Zahlen: sie richten.",
    # ---- placement/stamps.py
    "The stamp's mesh has no faces, or one without its vertices: repair the mesh.": (
        "Das Netz des Stempels hat keine Flächen, oder eine ohne ihre Punkte: das Netz richten."
    ),
    "The stamp's mesh has NaN or infinite vertices: repair the mesh.": (
        "Das Netz des Stempels hat Punkte, die NaN oder unendlich sind: das Netz richten."
    ),
    "The stamp's mesh has no length along x: turn it, so that x is forward and z up.": (
        "Das Netz des Stempels hat keine Länge entlang x: es so drehen, dass x nach vorn und z nach oben zeigt."
    ),
    "The stamp's picture has the shape {}: give it rows and columns.": (
        "Das Bild des Stempels hat die Form {}: ihm Zeilen und Spalten geben."
    ),
    "The stamp's picture has NaN or infinite pixels: mend the picture.": (
        "Das Bild des Stempels hat Pixel, die NaN oder unendlich sind: das Bild richten."
    ),
    "A stamp with a {} of {} m is none: give one from {} to {} m.": (
        "Ein Stempel mit {} von {} m ist keiner: etwas von {} bis {} m angeben."
    ),
    "The stamp's picture is black all over, and touches nothing: paint its shape white.": (
        "Das Bild des Stempels ist ganz schwarz und berührt nichts: seine Form weiß malen."
    ),
    "There is no stamp '{}': choose one of {}.": "Es gibt keinen Stempel '{}': einen von {} wählen.",
    # ---- placement/track.py
    "A wheel of radius {} m cannot roll {} m deep: give it less depth, or more radius.": (
        "Ein Rad mit dem Radius {} m kann nicht {} m tief rollen: ihm weniger Tiefe oder mehr Radius geben."
    ),
    "{} frames a second cannot be made: give a number above 0.": (
        "{} Bilder in der Sekunde gehen nicht: eine Zahl über 0 angeben."
    ),
    "This track would take {} samples, and {} are the most: shorten the curve, go faster, or on larger wheels.": (
        "Diese Fährte bräuchte {} Werte, und {} sind die meisten: die Kurve kürzen, schneller gehen, oder auf "
        "größeren Rädern."
    ),
    # ---- placement/tyre.py
    "There is no tread '{}' for wheels: choose one of {}.": "Es gibt kein Profil '{}' für Räder: eines von {} wählen.",
    "A wheel with a {} of {} m cannot roll: give one above 0 and up to {} m.": (
        "Ein Rad mit {} von {} m kann nicht rollen: mehr als 0 und bis {} m angeben."
    ),
    # ---- blender/track.py
    "The track '{}' has no ground: press Add Ground on a mesh first.": (
        "Die Spur '{}' hat keinen Boden: erst Boden hinzufügen auf einem Netz drücken."
    ),
    "The track '{}' has no image: choose the picture of its stamp.": (
        "Die Spur '{}' hat kein Bild: das Bild ihres Stempels wählen."
    ),
    "The track '{}' has no sole: choose a mesh whose underside leaves the marks.": (
        "Die Spur '{}' hat keine Sohle: ein Netz wählen, dessen Unterseite die Abdrücke hinterlässt."
    ),
    "There are several grounds: choose the one of the track '{}'.": (
        "Es gibt mehrere Böden: den der Spur '{}' wählen."
    ),
    "Choose what leaves the marks of '{}' in its panel.": (
        "Im Bedienfeld von '{}' wählen, was die Abdrücke hinterlässt."
    ),
    "No track lies on '{}': press Add Track on a curve first.": (
        "Auf '{}' liegt keine Spur: erst Spur hinzufügen auf einer Kurve drücken."
    ),
    "Plants grow on '{}', which tracks do not bend: press them before it is sown.": (
        "Auf '{}' wachsen Pflanzen, die von Spuren nicht gebogen werden: sie drücken, bevor gesät wird."
    ),
    "{} along '{}' on '{}': Press Tracks presses them.": "{} entlang '{}' auf '{}': Spuren drücken drückt sie.",
}
