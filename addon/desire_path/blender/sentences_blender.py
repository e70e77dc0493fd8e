"""sentences_blender.py - what the add-on tells of bakes, grounds and their looks, in other languages.

Keys are the English sentences as templates; {} is what comes in, in the same order unless numbered.
"""

GERMAN = {
    # ---- blender/axes.py
    "The transform of '{}' has NaN or infinite numbers: set its location, rotation and scale anew.": (
        "Die Transformation von '{}' hat Zahlen, die NaN oder unendlich sind: Ort, Drehung und Größe neu setzen."
    ),
    "'{}' is scaled to nothing along an axis: give it a scale other than 0.": (
        "'{}' ist entlang einer Achse auf nichts skaliert: eine Größe außer 0 geben."
    ),
    # ---- blender/bake_all.py
    "There is no ground in this scene: select a mesh and press Add Ground first.": (
        "In dieser Szene gibt es keinen Boden: ein Netz wählen und erst Boden hinzufügen."
    ),
    "Nobody walks on the grounds of this scene: select an armature and press Add Walker.": (
        "Auf den Böden dieser Szene geht niemand: ein Skelett wählen und Läufer hinzufügen."
    ),
    "'{}' is gone: bake again when it is back.": "'{}' ist fort: noch einmal backen, wenn es wieder da ist.",
    "'{}' is in Edit Mode: leave it and bake again.": (
        "'{}' ist im Bearbeitungsmodus: ihn verlassen und noch einmal backen."
    ),
    # ---- blender/bake_job.py
    "Nobody walks on '{}': select the armature and press Add Walker.": (
        "Auf '{}' geht niemand: das Skelett wählen und Läufer hinzufügen."
    ),
    "'{}' is no ground yet: press Add Ground first.": "'{}' ist noch kein Boden: erst Boden hinzufügen.",
    "The frames {} to {} of '{}' hold no motion: set an end after the start.": (
        "Die Bilder {} bis {} von '{}' enthalten keine Bewegung: das Ende nach den Anfang legen."
    ),
    "A walker was removed or renamed while it was to be recorded: bake again.": (
        "Ein Läufer wurde entfernt oder umbenannt, während er aufgenommen werden sollte: noch einmal backen."
    ),
    "Nothing was baked.": "Es wurde nichts gebacken.",
    "No foot has trodden '{}': it is as it was.": "Kein Fuß hat '{}' betreten: es ist, wie es war.",
    "Baked frames {} to {}{} in {} s: {} contacts, deepest print {} mm; files in {}.": (
        "Bilder {} bis {} gebacken{} in {} s: {} Kontakte, tiefster Abdruck {} mm; Dateien in {}."
    ),
    # ---- blender/bodies.py
    "'{}' is moved {} m deep into the ground: it carves, whatever it weighs. Choose what it presses by in its "
    "panel to have it otherwise.": (
        "'{}' wird {} m tief in den Boden bewegt: es verdrängt ihn, was immer es wiegt. Im Panel wählen, womit es "
        "drückt, wenn es anders sein soll."
    ),
    # ---- blender/chosen.py
    "'{}' walks on '{}' in the scene '{}' only: link it to '{}', or bake there.": (
        "'{}' geht auf '{}' nur in der Szene '{}': mit '{}' verknüpfen, oder dort backen."
    ),
    "'{}' is off in renders or in the view layer, by itself or by its collection, and leaves no prints.": (
        "'{}' ist beim Rendern oder in der Ansichtsebene aus, selbst oder durch seine Sammlung, und hinterlässt keine "
        "Abdrücke."
    ),
    # ---- blender/cover.py
    "The mesh of '{}' is linked from another file: no attributes were written.": (
        "Das Netz von '{}' ist aus einer anderen Datei verknüpft: es wurden keine Attribute geschrieben."
    ),
    "'{}' has a vertex group '{}' of its own: it was left alone.": (
        "'{}' hat eine eigene Vertex-Gruppe '{}': sie wurde in Ruhe gelassen."
    ),
    "'{}' has an attribute '{}' of its own: it was left alone.": (
        "'{}' hat ein eigenes Attribut '{}': es wurde in Ruhe gelassen."
    ),
    "'{}' has hardly a point {}, so that they cannot be seen: subdivide it there, to about {} m.": (
        "'{}' hat kaum einen Punkt {}, so dass sie nicht zu sehen sind: dort unterteilen, bis etwa {} m."
    ),
    "The viewport shows {} '{}', renders do not, where its points lie {}: let its modifiers make it as fine in "
    "renders.": (
        "In der 3D-Ansicht sind {} '{}' zu sehen, beim Rendern nicht, wo die Punkte {} liegen: die Modifikatoren "
        "es beim Rendern ebenso fein machen lassen."
    ),
    "Renders show {} '{}', the viewport does not, where its points lie {}: let its modifiers make it as fine in "
    "the viewport if you want to see them there.": (
        "Beim Rendern sind {} '{}' zu sehen, in der 3D-Ansicht nicht, wo die Punkte {} liegen: die Modifikatoren "
        "es dort ebenso fein machen lassen, wenn sie zu sehen sein sollen."
    ),
    "The points of '{}' lie {} {}, which are baked in cells of {} m: make it as fine as those there to see prints "
    "as they are.": (
        "Die Punkte von '{}' liegen {} {}, die in Zellen von {} m gebacken sind: es ebenso fein machen, um die "
        "Abdrücke zu sehen, wie sie sind."
    ),
    # ---- blender/footing.py
    "Bone '{}' of '{}' {}, so that keys would not move it: bake the animation to keys first (Pose > Animation > "
    "Bake Action, with Visual Keying and Clear Constraints), or choose the bone that leads it as the foot.": (
        "Der Knochen '{}' von '{}' {}, so dass Keyframes ihn nicht bewegen: erst die Animation zu Keyframes "
        "backen (Pose > Animation > Bake Action, mit Visual Keying und Clear Constraints), oder als Fuß den "
        "Knochen wählen, der ihn führt."
    ),
    "The leg of '{}' reaches for the object '{}': move that object, or let the constraint reach for a bone of the "
    "armature.": (
        "Das Bein von '{}' greift nach dem Objekt '{}': jenes bewegen, oder den Constraint nach einem Knochen des "
        "Skeletts greifen lassen."
    ),
    "Bone '{}' of '{}' is fixed to its parent and no leg of two bones was found above it: choose the foot bone of "
    "a leg, or disconnect it in Edit Mode.": (
        "Der Knochen '{}' von '{}' ist fest mit dem darüber verbunden, und über ihm fand sich kein Bein aus zwei "
        "Knochen: den Fußknochen eines Beins wählen, oder ihn im Bearbeitungsmodus lösen."
    ),
    # ---- blender/forward.py
    "'{}' {}: it is not carried ahead.": "'{}' {}: es wird nicht vorwärts getragen.",
    "'{}' cannot be given keys: make its library override editable first.": (
        "'{}' kann keine Keyframes bekommen: erst das Library Override bearbeitbar machen."
    ),
    "'{}' walks in place and cannot be carried ahead, since something else holds it there: move what its object "
    "or its bones follow, by keys or along a curve.": (
        "'{}' geht auf der Stelle und lässt sich nicht vorwärts tragen, da etwas anderes es dort hält: bewegen, "
        "wem das Objekt oder seine Knochen folgen, durch Keyframes oder entlang einer Kurve."
    ),
    "'{}' walks in place and is carried ahead at {} m/s{}: action '{}'; Carried switches it off.": (
        "'{}' geht auf der Stelle und wird mit {} m/s vorwärts getragen{}: Aktion '{}'; Getragen schaltet es aus."
    ),
    "'{}' walks in place and is carried along the curve at {} m/s{}: action '{}'; Carried switches it off.": (
        "'{}' geht auf der Stelle und wird mit {} m/s entlang der Kurve getragen{}: Aktion '{}'; "
        "Getragen schaltet es aus."
    ),
    # ---- blender/forward_curve.py
    "The curve has no length seen from above: give it two or more points apart.": (
        "Die Kurve hat von oben gesehen keine Länge: ihr zwei oder mehr Punkte geben, die auseinander liegen."
    ),
    "'{}' turns by axis and angle, which cannot go along a curve: choose another rotation mode.": (
        "'{}' wird durch Achse und Winkel gedreht und kann so keiner Kurve folgen: eine andere Art der Drehung wählen."
    ),
    # ---- blender/ground.py
    "There is no ground: select the mesh that is walked on.": (
        "Es gibt keinen Boden: das Netz wählen, auf dem gegangen wird."
    ),
    "'{}' has both an attribute and a vertex group '{}', by which prints are played: rename or remove one of them.": (
        "'{}' hat ein Attribut und eine Vertex-Gruppe '{}', womit Abdrücke gezeigt werden: eines umbenennen oder "
        "entfernen."
    ),
    "'{}' has no vertex group '{}' to paint a soil with: choose another group or remove the soil from the list.": (
        "'{}' hat keine Vertex-Gruppe '{}', um eine Bodenart damit zu malen: eine andere Gruppe wählen oder die "
        "Bodenart aus der Liste nehmen."
    ),
    "'{}' shows instances of its children, in which there are no prints: make them real (Object > Apply > Make "
    "Instances Real) if they are walked on.": (
        "'{}' zeigt Instanzen seiner Kinder, in denen es keine Abdrücke gibt: sie eigenständig machen (Objekt > "
        "Anwenden > Make Instances Real), wenn auf ihnen gegangen wird."
    ),
    "'{}' has no faces: give it some to walk on.": (
        "'{}' hat keine Flächen: ihm welche geben, auf denen man gehen kann."
    ),
    "The shape of '{}' changes between the frames, by keys, drivers or a modifier: it is walked on as it is at "
    "frame {}.": (
        "Die Form von '{}' ändert sich zwischen den Bildern, durch Keyframes, Treiber oder einen Modifikator: es "
        "wird darauf gegangen, wie es in Bild {} ist."
    ),
    "Vertex {} of '{}' is NaN or infinite: move or remove it in Edit Mode.": (
        "Der Punkt {} von '{}' ist NaN oder unendlich: ihn im Bearbeitungsmodus verschieben oder entfernen."
    ),
    "The walk passes beside the ground '{}': move the walker or the ground so that one lies over the other.": (
        "Der Gang führt am Boden '{}' vorbei: den Läufer oder den Boden verschieben, so dass einer über dem "
        "anderen liegt."
    ),
    "The faces of '{}' have no area: give it faces to walk on.": (
        "Die Flächen von '{}' haben keinen Inhalt: ihm welche geben, auf denen man gehen kann."
    ),
    "All faces of '{}' look down or sideways: flip its normals (Mesh > Normals > Flip) or turn it over.": (
        "Alle Flächen von '{}' sehen nach unten oder zur Seite: die Normalen umkehren (Netz > Normalen > "
        "Umkehren) oder es umdrehen."
    ),
    "'{}' stands upright like a wall: turn it so that it can be walked on.": (
        "'{}' steht aufrecht wie eine Wand: es so drehen, dass man darauf gehen kann."
    ),
    # ---- blender/home.py
    "The folder lies beside a file that was never saved: save the file or choose another folder.": (
        "Der Ordner liegt neben einer Datei, die nie gespeichert wurde: die Datei speichern oder einen anderen "
        "Ordner wählen."
    ),
    "'{}' bakes into the same folder: choose another one for either.": (
        "'{}' wird in denselben Ordner gebacken: für einen davon einen anderen wählen."
    ),
    "The folder {} holds the bake of another ground or of another file: choose another folder for '{}'.": (
        "Im Ordner {} liegt das Gebackene eines anderen Bodens oder einer anderen Datei: für '{}' einen anderen "
        "Ordner wählen."
    ),
    # ---- blender/inputs.py
    "Nobody walks on '{}' any more.": "Auf '{}' geht niemand mehr.",
    "The walkers of one ground need the same load model: choose one for all of them.": (
        "Die Läufer eines Bodens brauchen dasselbe Lastmodell: für alle eines wählen."
    ),
    "The walk crosses '{}' and '{}', which need the same {}: choose one for both.": (
        "Der Gang überquert '{}' und '{}', die dasselbe brauchen ({}): für beide eines wählen."
    ),
    "The gravity of the scene is {} m/s2, but prints are pressed by the Earth's, {} m/s2: for the prints of that "
    "weight give walkers {} times their mass.": (
        "Die Schwerkraft der Szene ist {} m/s2, Abdrücke aber drückt die der Erde, {} m/s2: für Abdrücke jenes "
        "Gewichts den Läufern das {}-fache ihrer Masse geben."
    ),
    "The walk crosses '{}' with cells of {} m and {} with larger ones: all are pressed in cells of {} m.": (
        "Der Gang überquert '{}' mit Zellen von {} m und {} mit größeren: alle werden in Zellen von {} m gedrückt."
    ),
    # ---- blender/materials.py
    "'{}' is shown by nothing now.": "'{}' wird nun von nichts gezeigt.",
    "'{}' is yours and stays in the file, by a fake user.": (
        "'{}' gehört dem Nutzer und bleibt durch einen Fake User in der Datei."
    ),
    "The mesh '{}' of '{}' is linked from another file and has no material slot: make the mesh local, or give it "
    "a material in that file.": (
        "Das Netz '{}' von '{}' ist aus einer anderen Datei verknüpft und hat keinen Materialplatz: das Netz "
        "lokal machen, oder ihm in jener Datei ein Material geben."
    ),
    "The mesh '{}' of '{}' is linked from another file, so where its soils are painted cannot be written into it: "
    "make the mesh local, or choose one look for all of it as Kind.": (
        "Das Netz '{}' von '{}' ist aus einer anderen Datei verknüpft, so dass nicht hineingeschrieben werden "
        "kann, wo seine Bodenarten gemalt sind: das Netz lokal machen, oder als Art ein Aussehen für alles wählen."
    ),
    "The material '{}' of '{}' is linked from another file: make it local, or tick Replace to use another one in "
    "its place.": (
        "Das Material '{}' von '{}' ist aus einer anderen Datei verknüpft: es lokal machen, oder Ersetzen "
        "ankreuzen, um stattdessen ein anderes zu nehmen."
    ),
    "The material '{}' of '{}' uses no nodes: turn on Use Nodes in its tab, or tick Replace to use another one in "
    "its place.": (
        "Das Material '{}' von '{}' hat keine Nodes: Use Nodes in seinem Reiter einschalten, oder Ersetzen "
        "ankreuzen, um stattdessen ein anderes zu nehmen."
    ),
    "'{}' is yours: its node group shows the soils as they are now.": (
        "'{}' gehört dem Nutzer: die Node-Gruppe darin zeigt die Bodenarten, wie sie nun sind."
    ),
    "'{}' is yours and stays as it is: the node group '{}' in it can be plugged in.": (
        "'{}' gehört dem Nutzer und bleibt, wie es ist: die Node-Gruppe '{}' darin kann angeschlossen werden."
    ),
    "{} cannot be written, choose another folder: {}.": (
        "{} lässt sich nicht schreiben, einen anderen Ordner wählen: {}."
    ),
    # ---- blender/messages.py
    "The messages are in the clipboard and in the text '{}'.": (
        "Die Meldungen sind in der Zwischenablage und im Text '{}'."
    ),
    # ---- blender/command_line.py
    "{} is not there: give the path of a .blend file.": "{} ist nicht da: den Pfad einer .blend-Datei angeben.",
    "There is no scene '{}' in {}: give the name of one.": (
        "Es gibt keine Szene '{}' in {}: den Namen von einer angeben."
    ),
    "There is no ground '{}' in '{}', whose grounds are: {}.": (
        "Es gibt keinen Boden '{}' in '{}', deren Böden sind: {}."
    ),
    "Nobody walks on a ground of '{}': add a ground and a walker, and save the file.": (
        "Auf keinem Boden von '{}' geht jemand: Boden und Läufer hinzufügen und die Datei speichern."
    ),
    # ---- blender/soil_keys.py
    "The keys on the soils of '{}' do not count where a frame is a pass: they are as at frame {}.": (
        "Die Keyframes auf den Bodenarten von '{}' zählen nicht, wo ein Bild ein Durchgang ist: sie sind wie in Bild "
        "{}."
    ),
    "The keys on the soil of '{}' do not count while a soil file is set: clear it.": (
        "Die Keyframes auf der Bodenart von '{}' zählen nicht, solange eine Bodendatei gesetzt ist: sie leeren."
    ),
    # ---- blender/soil_presets.py
    "'{}' cannot name a soil: use letters, digits, spaces, - and _.": (
        "'{}' kann keine Bodenart benennen: Buchstaben, Ziffern, Leerzeichen, - und _ nehmen."
    ),
    "No soil is painted on '{}' yet: add one first.": "Auf '{}' ist noch keine Bodenart gemalt: erst eine hinzufügen.",
    "No soil of your own is chosen: choose the one to remove in the menu.": (
        "Es ist keine eigene Bodenart gewählt: im Menü die wählen, die entfernt werden soll."
    ),
    "There is no soil at {}: it was removed already.": "In {} ist keine Bodenart: sie wurde schon entfernt.",
    # ---- blender/soils.py
    "The soil is saved as {}.": "Die Bodenart ist gespeichert als {}.",
    # ---- blender/stack.py
    "The particles '{}' of '{}' come before '{}' among its modifiers and do not follow the prints: move them "
    "below it.": (
        "Die Partikel '{}' von '{}' stehen vor '{}' unter den Modifikatoren und folgen den Abdrücken nicht: sie "
        "darunter schieben."
    ),
}
