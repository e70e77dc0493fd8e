"""sentences_tools.py - what the buttons of the add-on tell, and who walks, in other languages.

Keys are the English sentences as templates; {} is what comes in, in the same order unless numbered.
"""

GERMAN = {
    # ---- blender/moves.py
    "Nothing moves '{}': {}. It is baked as it stands.": "Nichts bewegt '{}': {}. Es wird gebacken, wie es steht.",
    # ---- blender/op_bake.py
    "The bake was stopped; the one from before plays on.": (
        "Das Backen wurde angehalten; was davor gebacken war, spielt weiter."
    ),
    "There are no files of '{}' yet: bake it first.": "Von '{}' gibt es noch keine Dateien: erst backen.",
    "'{}' is no ground, so there is nothing to free.": "'{}' ist kein Boden, so dass es nichts zu löschen gibt.",
    # ---- blender/op_export.py
    "There is no name to write to: give a filepath that ends with {}.": (
        "Es fehlt ein Name für die Datei: einen filepath angeben, der auf {} endet."
    ),
    "{} x {} heights are written to {}.": "{} x {} Höhen sind nach {} geschrieben.",
    "{} points and {} stems are written to {}.": "{} Punkte und {} Halme sind nach {} geschrieben.",
    "{} frames are written to {}.": "{} Bilder sind nach {} geschrieben.",
    "This Blender was built without Alembic: take one of blender.org, or export USD.": (
        "Dieses Blender wurde ohne Alembic gebaut: eines von blender.org nehmen, oder USD exportieren."
    ),
    "'{}' is hidden, and so is not written: show it first.": (
        "'{}' ist ausgeblendet und wird so nicht geschrieben: erst einblenden."
    ),
    "Alembic cannot be written to {} ({}).": "Alembic lässt sich nicht nach {} schreiben ({}).",
    "Alembic cannot be written to {}: choose another folder or make room.": (
        "Alembic lässt sich nicht nach {} schreiben: einen anderen Ordner wählen oder Platz schaffen."
    ),
    # ---- blender/op_forces.py
    "Forces are shown in a viewport, and Blender runs without a window: draw them to a picture with python -m "
    "desire_path plot.": (
        "Kräfte werden in einer 3D-Ansicht gezeigt, und Blender läuft ohne Fenster: sie mit python -m desire_path "
        "plot in ein Bild zeichnen."
    ),
    "The forces of '{}' are shown from frame {} to {}; after a change of the walk show them anew.": (
        "Die Kräfte von '{}' werden von Bild {} bis {} gezeigt; nach einer Änderung des Gangs neu zeigen."
    ),
    # ---- blender/op_material.py
    "The Asset Browser has the library '{}', {}.": "Der Asset-Browser hat die Bibliothek '{}', {}.",
    # ---- blender/op_place.py
    "The feet of '{}' lie on '{}' already: there is nothing to place.": (
        "Die Füße von '{}' liegen schon auf '{}': es gibt nichts aufzusetzen."
    ),
    "Bone '{}' of '{}' stays {} at frame {}, since constraints or limits hold it: bake the animation to keys "
    "first (Pose > Animation > Bake Action, with Visual Keying and Clear Constraints).": (
        "Der Knochen '{}' von '{}' bleibt {} in Bild {}, da Constraints oder Grenzen ihn halten: erst die "
        "Animation zu Keyframes backen (Pose > Animation > Bake Action, mit Visual Keying und Clear Constraints)."
    ),
    "'{}' walks on no ground yet: press Add Walker, or choose its ground.": (
        "'{}' geht noch auf keinem Boden: Läufer hinzufügen, oder seinen Boden wählen."
    ),
    "'{}' plays '{}', its feet {} '{}'; '{}' is as it was.": (
        "'{}' spielt '{}', die Füße {} '{}'; '{}' ist, wie es war."
    ),
    "'{}' plays '{}', its feet {} '{}'.": "'{}' spielt '{}', die Füße {} '{}'.",
    # ---- blender/op_balance.py
    "'{}' would hardly lean, for its feet stand level: press Place Feet on a slope or Sink into Prints first, or let "
    "it lean more.": (
        "'{}' würde sich kaum neigen, denn die Füße stehen eben: erst Füße aufsetzen an einem Hang oder In Abdrücke "
        "sinken drücken, oder mehr neigen lassen."
    ),
    "'{}' plays no action that Balance made: there is nothing to take off.": (
        "'{}' spielt keine Action, die Ausbalancieren gemacht hat: es gibt nichts abzunehmen."
    ),
    "The action '{}' that '{}' was made from is gone: undo, or choose another action.": (
        "Die Action '{}', aus der '{}' entstand, ist nicht mehr da: rückgängig machen oder eine andere wählen."
    ),
    "'{}' plays '{}' again.": "'{}' spielt wieder '{}'.",
    "'{}' plays '{}', leaning by {} to {} degrees; '{}' is as it was.": (
        "'{}' spielt '{}' und neigt sich um {} bis {} Grad; '{}' ist, wie es war."
    ),
    "'{}' plays '{}', leaning by {} to {} degrees.": "'{}' spielt '{}' und neigt sich um {} bis {} Grad.",
    # ---- placement/balance.py
    # ---- blender/op_slow.py
    "How deep '{}' sinks is not known. {}": "Wie tief '{}' einsinkt, ist nicht bekannt. {}",
    "'{}' is slowed down already: take that off, bake, and press Slow Down again.": (
        "'{}' ist schon verlangsamt: das abnehmen, backen und noch einmal Verlangsamen drücken."
    ),
    "'{}' plays no action: Slow Down sets the time of one action. Give it that, by Object > Animation > Bake Action "
    "with Visual Keying.": (
        "'{}' spielt keine Action: Verlangsamen stellt die Zeit einer einzigen Action. Sie entsteht durch Object > "
        "Animation > Bake Action mit Visual Keying."
    ),
    "'{}' plays strips of the NLA editor: Slow Down sets the time of one action. Give it that, by Object > Animation "
    "> Bake Action with Visual Keying.": (
        "'{}' spielt Strips des NLA-Editors: Verlangsamen stellt die Zeit einer einzigen Action. Sie entsteht durch "
        "Object > Animation > Bake Action mit Visual Keying."
    ),
    "There is no bake yet: press Bake Trail.": "Noch ist nichts gebacken: Spur backen drücken.",
    "'{}' hardly sinks: at equal effort it walks as fast as on firm ground. Nothing was changed.": (
        "'{}' sinkt kaum ein: mit gleicher Mühe geht es so schnell wie auf festem Boden. Nichts wurde geändert."
    ),
    "'{}' is not slowed down: there is nothing to take off.": (
        "'{}' ist nicht verlangsamt: es gibt nichts abzunehmen."
    ),
    "Walking costs '{}' {} times as much as on firm ground: at equal effort it takes {} times as long, up to frame "
    "{}.": (
        "Gehen kostet '{}' {}-mal so viel wie auf festem Boden: mit gleicher Mühe dauert es {}-mal so lang, bis Bild "
        "{}."
    ),
    # ---- blender/op_plants.py
    "{} plants of {} grow on '{}'.": "{0} Pflanzen der Art {1} wachsen auf '{2}'.",
    "The {} on '{}' is shown already, by '{}'.": "{} auf '{}' wird schon gezeigt, von '{}'.",
    # ---- blender/op_press.py
    "What is selected touches no ground: move it down into the ground first.": (
        "Was gewählt ist, berührt keinen Boden: es erst nach unten in den Boden bewegen."
    ),
    "Nothing is left to undo: ESC drops the tool.": "Es ist nichts mehr zurückzunehmen: ESC verwirft.",
    # ---- blender/op_walk_it.py
    "The curves {} are selected: select the one to go along.": (
        "Die Kurven {} sind gewählt: die eine wählen, an der entlang es geht."
    ),
    "'{}' is linked from another file: make a library override of it (Object > Library Override > Make) first.": (
        "'{}' ist aus einer anderen Datei verknüpft: erst ein Library Override davon machen (Objekt > Library "
        "Override > Make)."
    ),
    "Nothing moves '{}': {}.": "Nichts bewegt '{}': {}.",
    "'{}' is made to be walked on.": "'{}' wurde gemacht, um darauf zu gehen.",
    "{} Its prints are pressed as if its feet were placed.": (
        "{} Die Abdrücke werden gedrückt, als wären die Füße aufgesetzt."
    ),
    "The feet of '{}' are placed on '{}': action '{}'.": "Die Füße von '{}' sind auf '{}' aufgesetzt: Aktion '{}'.",
    # ---- blender/op_walkers.py
    "'{}' has {} feet ({}) and hangs on {}.": "'{}' hat {} Füße ({}) und hängt an {}.",
    "'{}' has {} feet ({}) and no hips bone.": "'{}' hat {} Füße ({}) und keinen Hüftknochen.",
    "There is no foot {}: '{}' has {}.": "Es gibt keinen Fuß {}: '{}' hat {}.",
    "'{}' is moved by the armature '{}': select that, and press Add Walker.": (
        "'{}' wird vom Skelett '{}' bewegt: dieses wählen und Läufer hinzufügen."
    ),
    "'{}' has no faces to press the ground with: give it some.": (
        "'{}' hat keine Flächen, mit denen es in den Boden drückt: ihm welche geben."
    ),
    "There is no ground yet: select the mesh that is walked on and press Add Ground.": (
        "Es gibt noch keinen Boden: das Netz wählen, auf dem gegangen wird, und Boden hinzufügen."
    ),
    "There are several grounds: select the one to walk on together with the armature, the armature last.": (
        "Es gibt mehrere Böden: den, auf dem gegangen wird, zusammen mit dem Skelett wählen, das Skelett zuletzt."
    ),
    "Recorded frames {} to {} of '{}' to {}.": "Bilder {} bis {} von '{}' nach {} aufgenommen.",
    # ---- blender/paths.py
    "The path '{}' is an empty without empties: parent two or more to it, named in the order they are walked to.": (
        "Der Weg '{}' ist ein Empty ohne Empties: ihm zwei oder mehr unterordnen, benannt in der Reihenfolge, in "
        "der es zu ihnen geht."
    ),
    "'{}' is no path: choose a curve, a mesh of edges, or an empty with empties.": (
        "'{}' ist kein Weg: eine Kurve, ein Netz aus Kanten oder ein Empty mit Empties wählen."
    ),
    "The path '{}' has no length: give it two or more points.": (
        "Der Weg '{}' hat keine Länge: ihm zwei oder mehr Punkte geben."
    ),
    "The path '{}' is not one line: join its pieces, or take off branches.": (
        "Der Weg '{}' ist keine einzelne Linie: die Stücke verbinden, oder Zweige entfernen."
    ),
    "'{}' has {} passes and no path to go along: it walks once as keyed; set its Path.": (
        "'{}' hat {} Durchgänge und keinen Weg, an dem es entlang geht: es geht einmal, wie die Keyframes sagen; "
        "ihm einen Weg geben."
    ),
    # ---- blender/picture.py
    "There is no image '{}' in this file: open it in the Image Editor, or leave the density image empty.": (
        "In dieser Datei gibt es kein Bild '{}': es im Image Editor öffnen, oder das Dichtebild leer lassen."
    ),
    "The density image '{}' is no single picture but a {}: save the picture that is meant as a file of its own "
    "and choose that.": (
        "Das Dichtebild '{}' ist kein einzelnes Bild, sondern {}: das gemeinte Bild als eigene Datei speichern "
        "und diese wählen."
    ),
    "The density image '{}' cannot be loaded from {}: mend its path in the Image Editor, or choose another image.": (
        "Das Dichtebild '{}' lässt sich nicht von {} laden: den Pfad im Image Editor richten, oder ein anderes "
        "Bild wählen."
    ),
    "The density image '{}' cannot be loaded: mend its path in the Image Editor, or choose another image.": (
        "Das Dichtebild '{}' lässt sich nicht laden: den Pfad im Image Editor richten, oder ein anderes Bild wählen."
    ),
    # ---- blender/plants.py
    "A kind of plant is missing: choose one of {}, or a file.": (
        "Die Pflanzenart fehlt: eine von {} oder eine Datei wählen."
    ),
    "There is no plant kind '{}': choose one of {}, or a file that Kind.save() wrote.": (
        "Es gibt keine Pflanzenart '{}': eine von {} wählen, oder eine Datei, die Kind.save() schrieb."
    ),
    "'{}' has no vertex group or attribute '{}' for the density of its plants: choose another one.": (
        "'{}' hat keine Vertex-Gruppe und kein Attribut '{}' für die Dichte der Pflanzen: etwas anderes wählen."
    ),
    "'{}' of '{}' is no number at point {}: give it one from 0 to 1.": (
        "'{}' von '{}' ist am Punkt {} keine Zahl: ihm eine von 0 bis 1 geben."
    ),
    "'{}' has no faces: give it some for plants to grow on.": (
        "'{}' hat keine Flächen: ihm welche geben, auf denen Pflanzen wachsen."
    ),
    "'{}' would carry {} million plants of {} and shows {} million: paint a density group or image where they are "
    "seen.": (
        "'{}' trüge {} Millionen Pflanzen der Art {} und zeigt {} Millionen: eine Dichtegruppe oder ein "
        "Dichtebild malen, wo sie zu sehen sind."
    ),
    "No {} grows on '{}': check its density, and the group and the image that thin it out.": (
        "Auf '{1}' wächst nichts von der Art {0}: die Dichte prüfen, und die Gruppe und das Bild, die sie ausdünnen."
    ),
    # ---- blender/posing.py
    "The {} of bone '{}' is locked and would have to change: unlock it (Item in the sidebar of the 3D view), or "
    "place the feet of another rig.": (
        "Am Knochen '{1}' ist gesperrt, was sich ändern müsste ({0}): es entsperren (Item in der Seitenleiste der "
        "3D-Ansicht), oder die Füße eines anderen Skeletts aufsetzen."
    ),
    # ---- blender/press.py
    "Select a ground, and beside it the objects to press into it.": (
        "Einen Boden wählen, und dazu die Objekte, die hineingedrückt werden."
    ),
    "Select something to press into '{}', too: any object with faces.": (
        "Dazu wählen, was in '{}' gedrückt wird: irgendein Objekt mit Flächen."
    ),
    "Plants grow on '{}', which a hand does not bend: press before they are sown.": (
        "Auf '{}' wachsen Pflanzen, die eine Hand nicht biegt: drücken, bevor sie gesät sind."
    ),
    "'{}' is pressed as it is before its walk: bake again to see both.": (
        "'{}' wird gedrückt, wie es vor dem Gang ist: noch einmal backen, um beides zu sehen."
    ),
    "The ground or what presses it is gone: nothing more can be pressed.": (
        "Der Boden oder was hineindrückt ist fort: es kann nichts mehr gedrückt werden."
    ),
    "'{}' stays as it was pressed, {} mm deep at most; files in {}.": (
        "'{}' bleibt, wie es gedrückt wurde, höchstens {} mm tief; Dateien in {}."
    ),
    "'{}' has no faces to press the ground with: give it some, or select another.": (
        "'{}' hat keine Flächen, mit denen es in den Boden drückt: ihm welche geben, oder ein anderes wählen."
    ),
    # ---- blender/press_view.py
    "'{}' shows prints on its own points alone, since {}.": "'{}' zeigt Abdrücke nur auf den eigenen Punkten, da {}.",
    # ---- blender/pressed.py
    "What was pressed into '{}' by hand cannot be read ({}) Press it again, or free the ground.": (
        "Was von Hand in '{}' gedrückt wurde, lässt sich nicht lesen ({}) Es noch einmal drücken, oder das "
        "Gebackene löschen."
    ),
    "{} changed since it was pressed by hand: press it again.": (
        "{} geändert, seit von Hand gedrückt wurde: noch einmal drücken."
    ),
    # ---- blender/private.py
    "'{}' is disabled in viewports: enable it (the screen icon in the Outliner) and try again.": (
        "'{}' ist in 3D-Ansichten abgeschaltet: es einschalten (das Bildschirmzeichen im Outliner) und es noch "
        "einmal versuchen."
    ),
    # ---- blender/trodden.py
    "'{}' is linked from another file, and what is trodden of it stays as it is: make a library override of it.": (
        "'{}' ist aus einer anderen Datei verknüpft, und was davon betreten wird, bleibt, wie es ist: ein Library "
        "Override davon machen."
    ),
    "'{}' is in Edit Mode, and what is trodden of it stays as it is: leave Edit Mode.": (
        "'{}' ist im Bearbeitungsmodus, und was davon betreten wird, bleibt, wie es ist: den Bearbeitungsmodus "
        "verlassen."
    ),
    "{} It is left as it is.": "{} Es bleibt, wie es ist.",
    # ---- blender/refined.py
    "The mesh of '{}' is not refined where the prints are, since {}.": (
        "Das Netz von '{}' wird an den Abdrücken nicht verfeinert, da {}."
    ),
    "The refined copy of '{}' lacks its attribute '{}', which is of a kind that is not known here.": (
        "Der verfeinerten Kopie von '{}' fehlt das Attribut '{}', dessen Art hier unbekannt ist."
    ),
    "Prints on '{}' are shown coarser than asked for: finer, they would take more than {} million faces. Set "
    "Refined Size higher.": (
        "Abdrücke auf '{}' werden gröber gezeigt als verlangt: feiner brauchten sie mehr als {} Millionen "
        "Flächen. Verfeinerte Kanten höher setzen."
    ),
    # ---- blender/ride.py
    "'{}' moves: its prints stay on it, and the walk is taken as it is seen from it.": (
        "'{}' bewegt sich: die Abdrücke bleiben darauf, und der Gang wird genommen, wie er von dort aus gesehen ist."
    ),
    "'{}' tilts by up to {} degrees under the walk: the walker's weight is taken as if it did not; tilt it less "
    "where forces matter.": (
        "'{}' neigt sich unter dem Gang um bis zu {} Grad: das Gewicht des Läufers wird genommen, als täte es das "
        "nicht; weniger neigen, wo es auf Kräfte ankommt."
    ),
    "'{}' changes its size under the walk: key its location and rotation only.": (
        "'{}' ändert unter dem Gang seine Größe: nur Ort und Drehung mit Keyframes versehen."
    ),
    "'{}' speeds up, slows down or turns with {} times gravity near frame {}: forces are found as if it moved "
    "evenly.": (
        "'{}' wird mit {} mal der Schwerkraft schneller, langsamer oder gedreht, bei Bild {}: Kräfte werden "
        "gefunden, als bewegte es sich gleichmäßig."
    ),
    # ---- blender/sample.py
    "The library of '{}', {}, is not there: relocate it in the Outliner, where its Display Mode is Blender File.": (
        "Die Bibliothek von '{}', {}, ist nicht da: sie im Outliner umleiten, dessen Anzeigemodus Blender-Datei ist."
    ),
    "'{}' has no bones: choose the armature that walks.": "'{}' hat keine Knochen: das Skelett wählen, das geht.",
    "Bone '{}' of '{}' has no usable transform at frame {} (NaN, infinite, or scaled to nothing): look at its "
    "keys and drivers there.": (
        "Der Knochen '{}' von '{}' hat in Bild {} keine brauchbare Transformation (NaN, unendlich oder auf nichts "
        "skaliert): dort nach Keyframes und Treibern sehen."
    ),
    "'{}' has no bone '{}', it may have been renamed or removed: press Find Feet to find the feet anew, or choose "
    "the bone by hand.": (
        "'{}' hat keinen Knochen '{}', er wurde vielleicht umbenannt oder entfernt: Füße finden drücken, um sie "
        "neu zu suchen, oder den Knochen von Hand wählen."
    ),
    "The {} foot of '{}' has no foot bone: choose one, or press Find Feet.": (
        "Der Fuß {} von '{}' hat keinen Fußknochen: einen wählen, oder Füße finden drücken."
    ),
    "Bone '{}' of '{}' is both the {} foot and the {} foot: choose another for one of them.": (
        "Der Knochen '{}' von '{}' ist sowohl der Fuß {} als auch der Fuß {}: für einen davon einen anderen wählen."
    ),
    "'{}' is in Edit Mode, in which it stands still: leave Edit Mode first.": (
        "'{}' ist im Edit Mode, in dem es still steht: zuerst den Edit Mode verlassen."
    ),
    "'{}' is set to Rest Position, in which it stands still: choose Pose Position in its Object Data properties.": (
        "'{}' ist auf Rest Position gestellt, in der es still steht: Pose Position in den Objektdaten wählen."
    ),
    "'{}' weighs {} kg: give it a mass above 0, or 0 to have it estimated.": (
        "'{}' wiegt {} kg: ihm eine Masse über 0 geben, oder 0, um sie schätzen zu lassen."
    ),
    "What '{}' wears at its feet changes its shape between the frames, by keys, drivers or a modifier: its soles are "
    "as at frame {}.": (
        "Was '{}' an den Füßen trägt, ändert seine Form zwischen den Bildern, durch Keys, Treiber oder einen Modifier: "
        "die Sohlen sind wie in Bild {}."
    ),
    "'{}' is off in renders at some of the frames: '{}' wears it at all of them where it walks.": (
        "'{}' ist in manchen der Bilder beim Rendern aus: '{}' trägt es in allen, in denen es geht."
    ),
    "'{}' is off in renders at some of the frames: it presses the ground at all of them.": (
        "'{}' ist in manchen der Bilder beim Rendern aus: es drückt den Boden in allen."
    ),
    "There is nobody to record: select the armature that walks, or a mesh that moves.": (
        "Es gibt niemanden aufzunehmen: das Skelett wählen, das geht, oder ein Netz, das sich bewegt."
    ),
    "The frames {} to {} hold no motion: set an end after the start.": (
        "Die Bilder {} bis {} enthalten keine Bewegung: das Ende nach den Anfang legen."
    ),
    "No mesh hangs on the bones of '{}', so that its limbs have nothing to press with: bind one to it, or let its "
    "feet press.": (
        "An den Knochen von '{}' hängt kein Netz, so dass die Glieder nichts haben, womit sie drücken: eines "
        "daran binden, oder die Füße drücken lassen."
    ),
    "'{}' is {} m away at frame {}, as when a simulation comes apart or a key is wrong: mend it, or let the "
    "frames end before.": (
        "'{}' ist {} m fort in Bild {}, wie wenn eine Simulation auseinanderfällt oder ein Keyframe falsch ist: "
        "das richten, oder die Bilder davor enden lassen."
    ),
    "'{}' has no usable transform at frame {} (NaN, infinite, or scaled to nothing): look at its keys and drivers "
    "there.": (
        "'{}' hat in Bild {} keine brauchbare Transformation (NaN, unendlich oder auf nichts skaliert): dort nach "
        "Keyframes und Treibern sehen."
    ),
    "'{}' changes its shape or size between the frames: it presses as it is at frame {}.": (
        "'{}' ändert zwischen den Bildern Form oder Größe: es drückt, wie es in Bild {} ist."
    ),
    "The mass of '{}' cannot be estimated, since its mesh is not closed: give it a mass in kilograms.": (
        "Die Masse von '{}' lässt sich nicht schätzen, da das Netz nicht geschlossen ist: ihm eine Masse in "
        "Kilogramm geben."
    ),
    # ---- blender/show.py
    "The last bake was stopped when its frames {} to {} were there, before its maps were: bake again to go on.": (
        "Das letzte Backen wurde angehalten, als seine Bilder {} bis {} da waren, aber noch keine Karten: noch einmal "
        "backen, damit es weitergeht."
    ),
    "The last bake was stopped before its first frame, or has lost it since: bake again.": (
        "Das letzte Backen wurde vor dem ersten Bild angehalten oder hat es seither verloren: noch einmal backen."
    ),
    "The last bake was stopped, or lost files since: frames {} to {} play, {} to {} are missing or damaged; bake "
    "again to go on.": (
        "Das letzte Backen wurde angehalten oder hat seither Dateien verloren: die Bilder {} bis {} spielen, {} "
        "bis {} fehlen oder sind beschädigt; noch einmal backen, damit es weitergeht."
    ),
    "{} of the last bake is gone: bake again.": "{} des letzten Backens fehlt: noch einmal backen.",
    "{} of the last bake are gone: bake again.": "{} des letzten Backens fehlen: noch einmal backen.",
    # ---- blender/state.py
    "This bake does not say what it was made from, as earlier versions did not: bake again.": (
        "Es ist nicht vermerkt, woraus dies gebacken wurde, wie bei früheren Versionen: noch einmal backen."
    ),
    "'{}' is shown as it was pressed by hand, before anybody walks on it: bake it.": (
        "'{}' wird gezeigt, wie es von Hand gedrückt wurde, bevor jemand darauf geht: backen."
    ),
    "This ground was moved since the bake: bake again.": (
        "Dieser Boden wurde seit dem Backen verschoben: noch einmal backen."
    ),
    "{} has changed since the bake: bake again.": "Seit dem Backen geändert: {}. Noch einmal backen.",
    "{} have changed since the bake: bake again.": "Seit dem Backen geändert: {}. Noch einmal backen.",
    # ---- blender/underfoot.py
    "'{}' is not walked on: {}.": "Auf '{}' wird nicht gegangen: {}.",
    "'{}' is turned over, its feet are above its body: turn it so that it stands upright.": (
        "'{}' steht auf dem Kopf, die Füße sind über dem Körper: es so drehen, dass es aufrecht steht."
    ),
    "'{}' walks {} m higher than '{}', and no ground can be made for both: bring them to one height, or select "
    "the ground they walk on, too.": (
        "'{}' geht {} m höher als '{}', und für beide lässt sich kein Boden machen: sie auf eine Höhe bringen, "
        "oder den Boden mitwählen, auf dem sie gehen."
    ),
    # ---- blender/worn.py
    "A mesh on '{}' has NaN or infinite vertices at its feet: repair the mesh.": (
        "Ein Netz an '{}' hat an den Füßen Punkte, die NaN oder unendlich sind: das Netz richten."
    ),
    "'{}' is no mesh: choose a mesh as the sole of '{}'.": "'{}' ist kein Netz: ein Netz als Sohle von '{}' wählen.",
}
