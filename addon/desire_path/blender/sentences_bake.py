"""sentences_bake.py - what a bake, its limits and its files tell, in other languages.

Keys are the English sentences as templates; {} is what comes in, in the same order unless numbered.
"""

GERMAN = {
    # ---- bake/bake.py
    "{}. What was baked before is still there; make room or choose another folder, then bake again.": (
        "{} Was zuvor gebacken wurde, ist noch da; Platz schaffen oder einen anderen Ordner wählen, dann noch "
        "einmal backen."
    ),
    "There is not enough memory: choose a larger cell size or fewer frames.": (
        "Der Speicher reicht nicht: größere Zellen oder weniger Bilder wählen."
    ),
    "The walk cannot be simulated ({}): check the walker's place and scale and the frame rate.": (
        "Der Gang lässt sich nicht simulieren ({}): Ort und Größe des Läufers und die Bildrate prüfen."
    ),
    # ---- bake/checks.py
    "The sole of bone {} is {} m long, too large for cells of {} m: check the walker's scale or choose a larger "
    "cell size.": (
        "Die Sohle des Knochens {} ist {} m lang, zu groß für Zellen von {} m: die Größe des Läufers prüfen oder "
        "größere Zellen wählen."
    ),
    "The feet of {} are lost between cells of {} m: choose a cell size of {} m or so, or check the walker's scale.": (
        "Die Füße von {} gehen zwischen Zellen von {} m verloren: eine Zellgröße von etwa {} m wählen, oder die "
        "Größe des Läufers prüfen."
    ),
    "The sole of bone {} is lost between cells of {} m and leaves no print: choose smaller cells.": (
        "Die Sohle des Knochens {} geht zwischen Zellen von {} m verloren und hinterlässt keinen Abdruck: "
        "kleinere Zellen wählen."
    ),
    # ---- bake/exchange.py
    "{} is damaged: delete it, and bake again.": "{} ist beschädigt: löschen und noch einmal backen.",
    # ---- bake/folder.py
    "{} is damaged: bake again.": "{} ist beschädigt: noch einmal backen.",
    "The bake in {} was written by version {} in another form: bake again.": (
        "Das Gebackene in {} wurde von Version {} in anderer Form geschrieben: noch einmal backen."
    ),
    "There is no bake in {}: bake the ground first.": "In {} liegt nichts Gebackenes: erst den Boden backen.",
    # ---- bake/grounds.py
    "The walk passes beside the ground: move the walker or the ground so that one lies over the other.": (
        "Der Gang führt am Boden vorbei: den Läufer oder den Boden verschieben, so dass einer über dem anderen liegt."
    ),
    "A bake needs a Ground, or a list of Parcels.": "Zum Backen braucht es einen Ground oder eine Liste von Parcels.",
    "'{}' and '{}' bake into the same folder: choose another one for either.": (
        "'{}' und '{}' werden in denselben Ordner gebacken: für einen davon einen anderen wählen."
    ),
    "No foot touches the ground in these frames: check that the walker stands on it and the scale is right.": (
        "Kein Fuß berührt in diesen Bildern den Boden: prüfen, ob der Läufer darauf steht und die Größe stimmt."
    ),
    # ---- bake/options.py
    "There is no load model '{}': choose {}.": "Es gibt kein Lastmodell '{}': {} wählen.",
    "There is no film '{}': choose {}.": "Es gibt keinen Film '{}': {} wählen.",
    "Frames {} to {} cannot be baked: give whole numbers.": (
        "Die Bilder {} bis {} lassen sich nicht backen: ganze Zahlen angeben."
    ),
    # ---- bake/output.py
    "{} is a {}, in which no bake can lie: choose a folder.": (
        "{} ist ein {}, worin nichts Gebackenes liegen kann: einen Ordner wählen."
    ),
    "The folder {} cannot be made ({}): choose another one.": (
        "Der Ordner {} lässt sich nicht anlegen ({}): einen anderen wählen."
    ),
    "The folder {} cannot be written ({}): choose another one.": (
        "Im Ordner {} lässt sich nicht schreiben ({}): einen anderen wählen."
    ),
    "{} stands where the bake keeps a file: move it or choose another folder.": (
        "{} steht, wo das Backen eine Datei hält: verschieben oder einen anderen Ordner wählen."
    ),
    "Another bake into {} is running (process {} on {}, since {}): wait for it, stop it, or choose another folder.": (
        "In {} wird schon gebacken (Prozess {} auf {}, seit {}): darauf warten, ihn anhalten, oder einen anderen "
        "Ordner wählen."
    ),
    "{} stands where the bake keeps a {}: move it or choose another folder.": (
        "{0} steht, wo das Backen etwas anderes hält ({1}): verschieben oder einen anderen Ordner wählen."
    ),
    "{} stands where the bake keeps a link: move it or choose another folder.": (
        "{} steht, wo das Backen eine Verknüpfung hält: verschieben oder einen anderen Ordner wählen."
    ),
    "{} is named as a file of a bake, of which there is nothing else: move it, or choose another folder.": (
        "{} heißt wie eine Datei eines Backens, von dem sonst nichts da ist: verschieben oder einen anderen "
        "Ordner wählen."
    ),
    "The folder {} holds the bake of another ground ({}): choose another folder.": (
        "Im Ordner {} liegt das Gebackene eines anderen Bodens ({}): einen anderen Ordner wählen."
    ),
    "{} cannot be deleted ({}): delete the folder {} by hand.": (
        "{} lässt sich nicht löschen ({}): den Ordner {} von Hand löschen."
    ),
    "The bake in {} cannot be moved ({}): move it to {} by hand.": (
        "Das Gebackene in {} lässt sich nicht verschieben ({}): von Hand nach {} verschieben."
    ),
    # ---- bake/plan.py
    "The model impulse takes settle_time as it is at first, and its keys count for the depth of prints alone: "
    "choose the model inertia.": (
        "Das Modell impulse nimmt settle_time, wie es zu Anfang ist, und Keyframes darauf zählen nur für die "
        "Tiefe: das Modell inertia wählen."
    ),
    "The frame range {} to {} holds no motion: let it end after it starts.": (
        "Die Bilder {} bis {} enthalten keine Bewegung: das Ende nach den Anfang legen."
    ),
    "The recording holds frames {} to {} and none of {} to {}: choose frames among them.": (
        "Die Aufnahme hat die Bilder {} bis {} und keines von {} bis {}: Bilder daraus wählen."
    ),
    # ---- bake/press.py
    "Nothing was pressed, and nothing can be kept: move a body into the ground first.": (
        "Es wurde nichts gedrückt, und so ist nichts zu behalten: erst einen Körper in den Boden bewegen."
    ),
    # ---- bake/report.py
    "A print reaches the rigid ground under the soil: check the walker's mass, or choose a firmer soil.": (
        "Ein Abdruck reicht bis auf den festen Grund: die Masse des Läufers prüfen, oder eine festere Bodenart wählen."
    ),
    "Feet on the ground {}: make the ground larger, or move it under the walk.": (
        "Füße auf dem Boden {}: den Boden größer machen oder unter den Gang schieben."
    ),
    # ---- bake/state.py
    "The state after frame {} in {} is damaged, or of another bake, and was not used: what came since the one "
    "before was simulated again.": (
        "Der Stand nach Bild {} in {} ist beschädigt oder gehört zu anderem Gebackenen und wurde nicht genommen: "
        "was seit dem davor kam, wurde noch einmal simuliert."
    ),
    "No state could be kept after frame {}, to go on from ({}).": (
        "Nach Bild {} ließ sich kein Stand aufheben, von dem es weitergeht ({})."
    ),
    # ---- bounds.py
    "A limit of {} {} cannot be kept: give a number above 0.": (
        "Eine Grenze von {} {} lässt sich nicht halten: eine Zahl über 0 angeben."
    ),
    "There is no limit '{}': write one of {} and a number, as in frames=1000000; memory and disk in GB.": (
        "Es gibt keine Grenze '{}': eine von {} und eine Zahl schreiben, wie frames=1000000; Speicher und Platte in GB."
    ),
    "This would take {}{} {}, and {} {}: {}, or raise the limit of {}.": (
        "Das bräuchte {}{} {}, und {} {}: {}, oder die Grenze von {} erhöhen."
    ),
    "The walk spans {} x {} m, and a map of it would have {} cells, where {} are the most: choose cells of {} m or "
    "more, or bake it in parts.": (
        "Der Gang erstreckt sich über {} x {} m, und eine Karte davon hätte {} Zellen, wo {} die meisten sind: Zellen "
        "von {} m oder mehr wählen, oder ihn in Teilen backen."
    ),
    # ---- files/atomic_file.py
    "{} cannot be written to {}, whose folder is not there: choose another folder or make this one.": (
        "{} lässt sich nicht nach {} schreiben, dessen Ordner nicht da ist: einen anderen Ordner wählen oder "
        "diesen anlegen."
    ),
    "{} cannot be written to {}, which is a {}: choose the name of a file.": (
        "{} lässt sich nicht nach {} schreiben, das ein {} ist: den Namen einer Datei wählen."
    ),
    "There is not enough memory to write {}: close other programs or make less of it.": (
        "Der Speicher reicht nicht, um {} zu schreiben: andere Programme schließen oder weniger davon machen."
    ),
    "{} cannot be written to {} ({}): choose another folder or make room.": (
        "{} lässt sich nicht nach {} schreiben ({}): einen anderen Ordner wählen oder Platz schaffen."
    ),
    # ---- files/record.py
    "There is no {} at {}: check the path.": "In {1} ist nichts dergleichen ({0}): den Pfad prüfen.",
    "The {} {} cannot be read ({}): check its name and whose file it is.": (
        "{1} lässt sich nicht lesen ({0}, {2}): den Namen prüfen, und wem die Datei gehört."
    ),
    "{} is not a {}: save one with {}.save().": "{} ist etwas anderes ({}): eines mit {}.save() speichern.",
    "{} is not a {} of this version: save one with {}.save().": (
        "{} ist von einer anderen Version ({}): eines mit {}.save() speichern."
    ),
    "{} says {}, which no {} has: remove it.": "{} nennt {}, was es nicht gibt ({}): es entfernen.",
    # ---- memory.py
    "A memory limit of {} cannot be kept: write one as 4G or 800M.": (
        "Eine Speichergrenze von {} lässt sich nicht einhalten: eine wie 4G oder 800M angeben."
    ),
    "This cannot be done in {} of memory: give at least {}, or no limit.": (
        "Das geht nicht mit {} Speicher: mindestens {} geben, oder keine Grenze setzen."
    ),
    "This system does not say how much memory a program takes: leave out the memory limit.": (
        "Dieses System sagt nicht, wie viel Speicher ein Programm belegt: die Speichergrenze weglassen."
    ),
    # ---- files/table.py
    "{} is larger than {} MB: give a shorter table with the columns {}.": (
        "{} ist größer als {} MB: eine kürzere Tabelle mit den Spalten {} geben."
    ),
    "There is not enough memory for {}: give a shorter table.": (
        "Der Speicher reicht nicht für {}: eine kürzere Tabelle geben."
    ),
    "{} cannot be read ({}): give a table with the columns {}.": (
        "{} lässt sich nicht lesen ({}): eine Tabelle mit den Spalten {} geben."
    ),
    "{} is no table of text: give one with the columns {}.": (
        "{} ist keine Tabelle aus Text: eine mit den Spalten {} geben."
    ),
    "{} has no columns {}: let its first line say {}.": "{} hat keine Spalten {}: die erste Zeile {} sagen lassen.",
    # ---- tables.py
    "{} {} of {} is no number: give one.": "{} {} von {} ist keine Zahl: eine angeben.",
    "{} {} of {} cannot be used: choose one from {} to {}.": "{} {} von {} geht nicht: etwas von {} bis {} wählen.",
}
