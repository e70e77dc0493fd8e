"""sentences_crowd.py - what is told of crowds, in other languages.

Keys are the English sentences as templates; {} is what comes in, in the same order unless numbered.
"""

GERMAN = {
    # ---- blender/crowd.py
    "A crowd goes between places: select two empties or more.": (
        "Eine Menge geht zwischen Orten: zwei oder mehr Leerobjekte wählen."
    ),
    "The crowd has no ground: press Add Ground on a mesh first.": (
        "Die Menge hat keinen Boden: erst bei einem Netz Boden hinzufügen drücken."
    ),
    "There are several grounds: select the one of the crowd, too.": (
        "Es gibt mehrere Böden: auch den der Menge wählen."
    ),
    "{} passages on '{}', detour {}: the last ways are in '{}', all of them and the cover in {}.": (
        "{} Gänge auf '{}', Umweg {}: die letzten Wege sind in '{}', alle, und die Decke, in {}."
    ),
    # ---- crowd/choice.py
    "Nobody can go anywhere: give at least two places a rate above 0.": (
        "Niemand kann irgendwohin: mindestens zwei Orten eine Häufigkeit über 0 geben."
    ),
    "No way leads from '{}' to '{}', for obstacles lie all around one of them: leave a gap.": (
        "Kein Weg führt von '{}' nach '{}', denn um einen davon liegen ringsum Hindernisse: eine Lücke lassen."
    ),
    "The place '{}' lies in an obstacle: move it.": "Der Ort '{}' liegt in einem Hindernis: ihn verschieben.",
    "The place '{}' lies outside the ground: move it, or make that larger.": (
        "Der Ort '{}' liegt außerhalb des Bodens: ihn verschieben, oder den Boden größer machen."
    ),
    "The places '{}' and '{}' have no ground between them: move one of them, or make its radius smaller.": (
        "Zwischen den Orten '{}' und '{}' liegt kein Boden: einen davon verschieben, oder seinen Radius verkleinern."
    ),
    # ---- crowd/covers.py
    "A crowd cannot walk on {}: name one of {}.": "Eine Menge kann nicht auf {} gehen: eines nennen von {}.",
    "A crowd knows no ground called {}: name one of {}.": (
        "Eine Menge kennt keinen Boden namens {}: einen nennen von {}."
    ),
    "A crowd's ground cannot have a {} of {}: give a number from {} to {}.": (
        "Der Boden einer Menge kann {} {} nicht haben: eine Zahl von {} bis {} angeben."
    ),
    "A crowd's ground has no number called '{}': remove it.": (
        "Der Boden einer Menge hat keine Zahl namens '{}': sie entfernen."
    ),
    "Snow of {} m cannot be waded: give a depth from 0.03 to 0.5.": (
        "Durch Schnee von {} m kann niemand waten: eine Tiefe von 0.03 bis 0.5 angeben."
    ),
    # ---- crowd/crowd.py
    "Another crowd is walking into {}: wait for it, stop it, or choose another folder.": (
        "Eine andere Menge geht schon nach {}: auf sie warten, sie anhalten, oder einen anderen Ordner wählen."
    ),
    "The crowd cannot be written to {} ({}): make room and start it again, and it goes on.": (
        "Die Menge kann nicht nach {} geschrieben werden ({}): Platz schaffen und neu starten, dann geht sie weiter."
    ),
    # ---- crowd/feet.py
    "{} holds no paths of a crowd: let one walk first.": ("{} enthält keine Wege einer Menge: erst eine gehen lassen."),
    "{} is no folder of a crowd: let one walk into it first.": (
        "{} ist kein Ordner einer Menge: erst eine dorthin gehen lassen."
    ),
    "{} is damaged: let the crowd walk again.": "{} ist beschädigt: die Menge noch einmal gehen lassen.",
    "The crowd in {} has not walked to its end: let it go on first.": (
        "Die Menge in {} ist nicht zu Ende gegangen: sie erst weitergehen lassen."
    ),
    "The feet in {} are pressed already: wait, or choose another folder.": (
        "Die Füße in {} werden schon gedrückt: warten, oder einen anderen Ordner wählen."
    ),
    'The scene does not say where feet press: add {"press": {"box": [x0, y0, x1, y1]}}.': (
        'Die Szene sagt nicht, wo Füße drücken: {{"press": {{"box": [x0, y0, x1, y1]}}}} hinzufügen.'
    ),
    # ---- crowd/prints.py
    "Feet sink {} cm into '{}', and 3 to 50 cm are waded: choose another ground.": (
        "Füße sinken {} cm tief in '{}', gewatet wird durch 3 bis 50 cm: einen anderen Boden wählen."
    ),
    # ---- crowd/scene.py
    'Ground that prints tell of has a soil: write {"kind": "prints", "soil": "deep-snow"}.': (
        'Boden, von dem Abdrücke erzählen, hat ein Erdreich: {{"kind": "prints", "soil": "deep-snow"}} schreiben.'
    ),
    "Shares of walkers that visit places add up to {}: give at most 1 in all.": (
        "Die Anteile derer, die Orte besuchen, ergeben zusammen {}: höchstens 1 im Ganzen angeben."
    ),
    "A place cannot be called {}: give it a name without commas.": (
        "Ein Ort kann nicht {} heißen: ihm einen Namen ohne Kommas geben."
    ),
    "Feet cannot press {} x {} m in cells of {} m: give x0, y0 below x1, y1, and up to {} cells.": (
        "Füße können nicht {} x {} m in Zellen von {} m drücken: x0, y0 kleiner als x1, y1 angeben, und bis {} Zellen."
    ),
    "Feet press in a rectangle: write its box as [x0, y0, x1, y1] in metres.": (
        "Füße drücken in einem Rechteck: seine box als [x0, y0, x1, y1] in Metern schreiben."
    ),
    "Ground of {} x {} m cannot be walked in cells of {} m: let each side have 1 to {} cells.": (
        "Ein Boden von {} x {} m kann nicht in Zellen von {} m begangen werden: jeder Seite 1 bis {} Zellen geben."
    ),
    "Nobody walks here: give at least one kind of walkers a share above 0.": (
        "Hier geht niemand: mindestens einer Art von Gehenden einen Anteil über 0 geben."
    ),
    "The heights of a scene are no name of a file: give that of an EXR.": (
        "Die Höhen einer Szene sind kein Dateiname: den einer EXR angeben."
    ),
    "The soil that feet press is no name: give that of a soil, or of its file.": (
        "Das Erdreich, das Füße drücken, ist kein Name: den eines Erdreichs angeben, oder seiner Datei."
    ),
    "The walk of walkers is no name of a file: give that of a recording (.npz).": (
        "Der Gang von Gehenden ist kein Dateiname: den einer Aufnahme (.npz) angeben."
    ),
    "There are {} places: give up to {}.": "Es gibt {} Orte: bis zu {} angeben.",
    "Two places are called '{}': give each a name of its own.": (
        "Zwei Orte heißen '{}': jedem einen eigenen Namen geben."
    ),
    "{} is no scene in JSON{}: mend it.": "{} ist keine Szene in JSON{}: sie richten.",
    # ---- crowd/spans.py
    "Nobody comes in any span: give one of them passages a day.": (
        "In keinem Zeitabschnitt kommt jemand: einem davon Gänge am Tag geben."
    ),
    "There are {} spans: give up to {}.": "Es gibt {} Zeitabschnitte: bis zu {} angeben.",
    # ---- crowd/trajectories.py
    "A trajectory leaves the ground at ({}, {}): make that larger, by size and origin.": (
        "Eine Bahn verlässt den Boden bei ({}, {}): ihn größer machen, durch size und origin."
    ),
    "The database {} is damaged ({}): write it again.": (
        "Die Datenbank {} ist beschädigt ({}): sie noch einmal schreiben."
    ),
    "The table {} of {} has no column {}: give one that JuPedSim wrote.": (
        "Die Tabelle {} von {} hat keine Spalte {}: eine angeben, die JuPedSim schrieb."
    ),
    "There are no trajectories at {}: check the path.": "Es gibt keine Bahnen unter {}: den Pfad prüfen.",
    "This Python cannot read {}, for it has no SQLite: give a table frame,id,x,y.": (
        "Dieses Python kann {} nicht lesen, denn es hat kein SQLite: eine Tabelle frame,id,x,y angeben."
    ),
    "Walker {} of {} is in two places in frame {}: remove one.": (
        "Läufer {} von {} ist in Bild {} an zwei Orten: einen entfernen."
    ),
    "{} cannot be read ({}): give a table frame,id,x,y or a SQLite file of JuPedSim.": (
        "{} kann nicht gelesen werden ({}): eine Tabelle frame,id,x,y angeben, oder eine SQLite-Datei von JuPedSim."
    ),
    "{} has a column '{}', of which nothing is known: keep frame,id,x,y.": (
        "{} hat eine Spalte '{}', von der nichts bekannt ist: frame,id,x,y behalten."
    ),
    "{} holds no trajectory: nobody walked.": "{} enthält keine Bahn: niemand ging.",
    "{} is no trajectory, {} is not a frame, an id and a place: mend it.": (
        "{} ist keine Bahn, {} ist nicht ein Bild, eine Nummer und ein Ort: sie richten."
    ),
    "{} is the database of another program, without a table {}: give one that JuPedSim wrote.": (
        "{} ist die Datenbank eines anderen Programms, ohne eine Tabelle {}: eine angeben, die JuPedSim schrieb."
    ),
}
