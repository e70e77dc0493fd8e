"""sentences_phrases.py - what comes into sentences, or stands for itself, in other languages.

Keys are the English phrases; {} is what comes in, in the same order.
"""

GERMAN = {
    # ---- lists
    " and ": " und ",
    "the walk": "der Gang",
    "the ground": "der Boden",
    "the plants": "die Pflanzen",
    "the settings": "die Einstellungen",
    "The ground has": "Der Boden wurde",
    "The settings have": "Die Einstellungen wurden",
    "left": "links",
    "right": "rechts",
    "about": "etwa",
    # ---- sentences that end in another one
    "{} bake.": "{} Mal gebacken.",
    "{} bakes.": "{} Mal gebacken.",
    "'{}' was not baked: {}": "'{}' wurde nicht gebacken: {}",
    "'{}' is not walked on: {}": "Auf '{}' wird nicht gegangen: {}",
    "The scene has changed since the bake: {}": "Die Szene hat sich seit dem Backen geändert: {}",
    "The scene has changed since the ground was pressed: {}": (
        "Die Szene hat sich geändert, seit der Boden gedrückt wurde: {}"
    ),
    "'{}': {}": "'{}': {}",
    # ---- short ones
    "'{}' is made of '{}'.": "'{}' ist aus '{}'.",
    "'{}' is a ground.": "'{}' ist ein Boden.",
    "'{}' is a ground; until the file is saved its bake goes to the temporary folder {}.": (
        "'{}' ist ein Boden; bis die Datei gespeichert ist, wird in den vorläufigen Ordner {} gebacken."
    ),
    "'{}' walks on '{}' {}.": "'{}' geht auf '{}' {}.",
    "with {}": "mit {}",
    "with all that hangs on its bones": "mit allem, was an seinen Knochen hängt",
    "as a rigid body": "als starrer Körper",
    "The name of its soil file, '{}', says no look: it is taken for earth; Kind chooses another.": (
        "Der Name der Bodendatei, '{}', sagt kein Aussehen: sie wird für Erde genommen; Art wählt ein anderes."
    ),
    "Tables in {}.": "Tabellen in {}.",
    # ---- how a character goes
    "does not walk": "geht nicht",
    "moves by itself": "bewegt sich selbst",
    ", its clip repeated": ", der Clip wiederholt",
    ", as far as its clip goes, which does not loop": ", so weit der Clip reicht, der sich nicht wiederholen lässt",
    ", past the end of which its clip goes": ", über deren Ende der Clip hinausreicht",
    " to its end, its clip repeated up to frame {}": " bis an ihr Ende, der Clip wiederholt bis Bild {}",
    # ---- why nothing moves
    "it is keyed at one frame; give it an action": "es hat Keyframes in nur einem Bild; ihm eine Aktion geben",
    "it has no keys; give it an action": "es hat keine Keyframes; ihm eine Aktion geben",
    "the curves of its action '{}' are muted; unmute them in the Graph Editor": (
        "die Kurven seiner Aktion '{}' sind stumm; sie im Graph Editor einschalten"
    ),
    "its action '{}' has no keys for it; choose another action or slot": (
        "seine Aktion '{}' hat keine Keyframes dafür; eine andere Aktion oder einen anderen Slot wählen"
    ),
    "its tracks or strips are muted; unmute them in the NLA Editor": (
        "seine Spuren oder Streifen sind stumm; sie im NLA Editor einschalten"
    ),
    "its NLA tracks are off or hold no strip; switch them on in the NLA Editor or give it an action": (
        "seine NLA-Spuren sind aus oder leer; sie im NLA Editor einschalten, oder ihm eine Aktion geben"
    ),
    "follows its constraint '{}'": "folgt seinem Constraint '{}'",
    "is moved by a driver": "wird von einem Treiber bewegt",
    "location": "Ort",
    "rotation": "Drehung",
    "{} m from its place": "{} m von seinem Ort",
    "turned by {} degrees from its place": "um {} Grad verdreht",
    "in the prints of": "in den Abdrücken von",
    "on": "auf",
    " on {} and {}": " auf {} und {}",
    # ---- why a ground is shown or walked on otherwise
    "its particles stand on its own points": "seine Partikel auf den eigenen Punkten stehen",
    "it shows instances on its own points or faces": "es Instanzen auf den eigenen Punkten oder Flächen zeigt",
    "objects hang on its own points": "Objekte an den eigenen Punkten hängen",
    "geometry nodes after the prints would be given other points": (
        "Geometry Nodes nach den Abdrücken andere Punkte bekämen"
    ),
    "it has shape keys, which the copy would not follow": "es Shape Keys hat, denen die Kopie nicht folgte",
    "modifiers change its shape in time, which the copy would not follow": (
        "Modifikatoren seine Form in der Zeit ändern, der die Kopie nicht folgte"
    ),
    "its modifiers make it otherwise in renders than in the viewport": (
        "seine Modifikatoren es beim Rendern anders machen als in der 3D-Ansicht"
    ),
    "the walk passes beside it": "der Gang führt daran vorbei",
    "it is {} m wide, which is less than a step": "es ist {} m breit, weniger als ein Schritt",
    "it lies {} m above the feet": "es liegt {} m über den Füßen",
    "the prints in": "die Abdrücke in",
    "where the prints are": "wo die Abdrücke sind",
    "too far apart": "zu weit auseinander",
    "{} m apart": "{} m auseinander",
    "reach over its edge, and leave no print there": "ragen über seinen Rand und hinterlassen dort keinen Abdruck",
    "contact law": "Kontaktgesetz",
    "way to heap soil": "Art, wie Boden gehäuft wird",
    "amount of spray": "Menge der Spritzer",
    # ---- sizes
    "'{}' is {} m tall": "'{}' ist {} m groß",
    "apply a scale of {} to it": "es um {} skalieren",
    "apply a scale of {} to it, as it seems to be in {}": "es um {} skalieren, da es wohl in {} ist",
    "check its scale and the scene's unit scale": "seine Größe und die Einheiten der Szene prüfen",
    "{} jumps {} m between frames {} and {}": "{} springt {} m zwischen den Bildern {} und {}",
    # ---- limits
    "{} frames": "{} Bilder",
    "{} seconds of walking": "{} Sekunden des Gangs",
    "{} cells in a picture": "{} Zellen in einem Bild",
    "{} plants": "{} Pflanzen",
    "{} GB of memory": "{} GB Speicher",
    "{} GB on the disk": "{} GB auf der Platte",
    "{} MB of memory": "{} MB Speicher",
    "{} MB on the disk": "{} MB auf der Platte",
    "{} kB of memory": "{} kB Speicher",
    "{} kB on the disk": "{} kB auf der Platte",
    "frames": "Bilder",
    "seconds of walking": "Sekunden des Gangs",
    "cells in a picture": "Zellen in einem Bild",
    "plants": "Pflanzen",
    "GB of memory": "GB Speicher",
    "GB on the disk": "GB auf der Platte",
    "MB of memory": "MB Speicher",
    "MB on the disk": "MB auf der Platte",
    "kB of memory": "kB Speicher",
    "kB on the disk": "kB auf der Platte",
    "are free": "sind frei",
    "are the limit": "sind die Grenze",
    "let it end earlier": "früher enden lassen",
    "choose a larger cell size or a shorter walk": "größere Zellen oder einen kürzeren Gang wählen",
    "choose a lower density, or plant a rectangle": "eine geringere Dichte wählen, oder ein Rechteck bepflanzen",
    "choose a larger cell size, fewer frames or fewer plants": (
        "größere Zellen, weniger Bilder oder weniger Pflanzen wählen"
    ),
    "choose a larger cell size or fewer frames, or make room": (
        "größere Zellen oder weniger Bilder wählen, oder Platz schaffen"
    ),
    # ---- files
    "The recording": "Die Aufnahme",
    "The report": "Der Bericht",
    "The index of the frames": "Das Verzeichnis der Bilder",
    "The list of checksums": "Die Liste der Prüfsummen",
    "The state of the bake": "Der Stand des Backens",
    "The table of contacts": "Die Tabelle der Kontakte",
    "soil": "Bodenart",
    "spray": "Spritzer",
    "folder": "Ordner",
    "link": "Verknüpfung",
    "device": "Gerät",
    "it is no plain file": "es ist keine einfache Datei",
    "it is larger than {} GB": "es ist größer als {} GB",
    "it is no .npz": "es ist kein .npz",
    "there is not enough memory for it": "der Speicher reicht dafür nicht",
    "it is encrypted": "es ist verschlüsselt",
    "movie": "ein Film",
    "sequence": "eine Folge",
    # ---- what walkers do
    "{} contacts, {} a minute, {} m/s": "{} Kontakte, {} in der Minute, {} m/s",
    "{} contacts, {} m/s": "{} Kontakte, {} m/s",
    "Mean force {} body weights, largest of a foot {}": "Mittlere Kraft {} Körpergewichte, größte eines Fußes {}",
    "In the air for {} % of the time": "In der Luft {} % der Zeit",
    # ---- panels
    "Frames {} to {}: {} contacts, deepest print {} mm, {} l pressed, {} l in rims, baked in {} s": (
        "Bilder {} bis {}: {} Kontakte, tiefster Abdruck {} mm, {} l gedrückt, {} l in Rändern, in {} s gebacken"
    ),
    "{} contacts, deepest print {} mm, {} l pressed, {} l in rims, baked in {} s": (
        "{} Kontakte, tiefster Abdruck {} mm, {} l gedrückt, {} l in Rändern, in {} s gebacken"
    ),
    "Baked together with {}": "Zusammen gebacken mit {}",
    "Temporary: save the file to keep it": "Vorläufig: die Datei speichern, um es zu behalten",
    "{} plants, {} cm high, full cover from {} /m2 on": "{} Pflanzen, {} cm hoch, volle Decke ab {} /m2",
    "about {} kg": "etwa {} kg",
    "mass estimated when recorded": "Masse wird beim Aufnehmen geschätzt",
    ", {} passes": ", {} Durchgänge",
    # ---- the hand
    "LMB: press    Wheel, PageUp/Down: {}    Shift Wheel: turn    F: follow the animation    Ctrl Z: undo "
    "stroke    Enter: keep    ESC: drop": (
        "LMT: drücken    Rad, Bild auf/ab: {}    Umschalt Rad: drehen    F: der Animation folgen    Strg Z: "
        "Strich zurück    Eingabe: behalten    ESC: verwerfen"
    ),
    "Follows the animation.    {}": "Folgt der Animation.    {}",
    "weight {}": "Gewicht {}",
    "depth {} mm": "Tiefe {} mm",
}
