"""sentences_rig.py - what is told of skeletons, feet and soles, in other languages.

Keys are the English sentences as templates; {} is what comes in, in the same order unless numbered.
"""

GERMAN = {
    # ---- rig/body.py
    "The skeleton's rest matrices do not fit its bones: record again.": (
        "Die Ruhematrizen des Skeletts passen nicht zu seinen Knochen: noch einmal aufnehmen."
    ),
    "The bones span {} m, too little for feet: check the walker's scale and the scene's unit scale.": (
        "Die Knochen messen {} m, zu wenig für Füße: die Größe des Läufers und die Einheiten der Szene prüfen."
    ),
    "The recorded matrices do not fit their times and bones: record again.": (
        "Die aufgenommenen Matrizen passen nicht zu ihren Zeiten und Knochen: noch einmal aufnehmen."
    ),
    "A mass of {} kg cannot press the ground: give the walker a mass above 0.": (
        "Eine Masse von {} kg kann nicht in den Boden drücken: dem Läufer eine über 0 geben."
    ),
    "The recorded times do not increase: record again.": (
        "Die aufgenommenen Zeiten steigen nicht: noch einmal aufnehmen."
    ),
    "Bone {} was not recorded: it was renamed or removed; detect the rig again or choose the bone by hand.": (
        "Der Knochen {} wurde nicht aufgenommen: er wurde umbenannt oder entfernt; die Füße neu finden oder den "
        "Knochen von Hand wählen."
    ),
    "Bone {} has a broken rest pose: mend the bone in edit mode.": (
        "Der Knochen {} hat eine kaputte Ruhelage: ihn im Bearbeitungsmodus richten."
    ),
    "Bone {} is scaled to nothing at frame {}: give it a scale above 0 there.": (
        "Der Knochen {} ist in Bild {} auf nichts skaliert: ihm dort eine Größe über 0 geben."
    ),
    # ---- rig/foot.py
    "Bone {} has no length: give it one in edit mode.": (
        "Der Knochen {} hat keine Länge: ihm im Bearbeitungsmodus eine geben."
    ),
    "Bone {} has no length up to {}: choose another toe bone or none.": (
        "Der Knochen {} hat bis {} keine Länge: einen anderen Zehenknochen wählen oder keinen."
    ),
    # ---- rig/foot_parts.py
    "{} never stands flat: its sole was laid by the rest pose.": (
        "{} steht nie flach: die Sohle wurde nach der Ruhelage gelegt."
    ),
    "No faces of the mesh move with {}: it got the built-in sole.": (
        "Mit {} bewegen sich keine Flächen des Netzes: er bekam die eingebaute Sohle."
    ),
    # ---- rig/limbs.py
    "No mesh hangs on the bones of '{}': bind one to it, or let its feet press.": (
        "An den Knochen von '{}' hängt kein Netz: eines daran binden, oder die Füße drücken lassen."
    ),
    # ---- rig/mass.py
    "{} weighs {} kg by an estimate from the {} litres of its mesh: set a mass to use another.": (
        "{} wiegt {} kg, geschätzt aus den {} Litern des Netzes: eine Masse setzen, um eine andere zu nehmen."
    ),
    "The mass of {} cannot be estimated, since only people with two legs below their hips tell their height, and "
    "no mesh is bound to it: give it a mass in kilograms.": (
        "Die Masse von {} lässt sich nicht schätzen, da nur Menschen mit zwei Beinen unter der Hüfte ihre Größe "
        "verraten, und kein Netz daran hängt: eine Masse in Kilogramm angeben."
    ),
    "{} weighs {} kg by an estimate from its height of {} m: set a mass to use another.": (
        "{} wiegt {} kg, geschätzt aus der Größe von {} m: eine Masse setzen, um eine andere zu nehmen."
    ),
    "{}: if that is not meant, {}.": "{}: wenn das nicht gemeint ist, {}.",
    "{} and weighs {} kg, since nobody gave it another mass: give it the mass of its size, or, if that size is "
    "not meant, {}.": (
        "{} und wiegt {} kg, da ihm niemand eine andere Masse gab: ihm die Masse seiner Größe geben, oder, wenn "
        "diese Größe nicht gemeint ist, {}."
    ),
    "{} and weighs {} kg, which cannot be: {}, or give it the mass of its size.": (
        "{} und wiegt {} kg, was nicht sein kann: {}, oder ihm die Masse seiner Größe geben."
    ),
    # ---- rig/rigs.py
    "The armature has no bone {}: it was renamed or removed; choose the foot bone again.": (
        "Das Skelett hat keinen Knochen {}: er wurde umbenannt oder entfernt; den Fußknochen neu wählen."
    ),
    "The armature has no bones: choose the one that walks.": "Das Skelett hat keine Knochen: das wählen, das geht.",
    "No foot bones were found: the armature has no bone named like a foot or an ankle and no pair of legs; choose "
    "the foot bones by hand.": (
        "Es fanden sich keine Fußknochen: das Skelett hat keinen Knochen, der wie ein Fuß oder Knöchel heißt, und "
        "kein Paar von Beinen; die Fußknochen von Hand wählen."
    ),
    "The feet were found by the shape of the rig, not by name: check that {} are the feet.": (
        "Die Füße wurden nach der Form des Skeletts gefunden, nicht nach Namen: prüfen, ob {} die Füße sind."
    ),
    "The armature has no bone {}: it was renamed or removed; detect the rig again or choose the bone by hand.": (
        "Das Skelett hat keinen Knochen {}: er wurde umbenannt oder entfernt; die Füße neu finden oder den "
        "Knochen von Hand wählen."
    ),
    "No foot bones were chosen: choose at least one foot bone.": (
        "Es wurden keine Fußknochen gewählt: mindestens einen wählen."
    ),
    "The armature has no bone {}: it was renamed or removed; detect the rig again or choose the hips by hand.": (
        "Das Skelett hat keinen Knochen {}: er wurde umbenannt oder entfernt; die Füße neu finden oder die Hüfte "
        "von Hand wählen."
    ),
    "No hips bone was found: the mass centre is taken above the feet; choose the hips bone by hand.": (
        "Es fand sich kein Hüftknochen: der Schwerpunkt wird über den Füßen genommen; den Hüftknochen von Hand wählen."
    ),
    # ---- rig/sole.py
    "The soles of {} are {} cells of {} m wide, too few for a print to have their shape: choose a cell size of {} "
    "m or so.": (
        "Die Sohlen von {} sind {} Zellen von {} m breit, zu wenige für einen Abdruck ihrer Form: eine Zellgröße "
        "von etwa {} m wählen."
    ),
    "{} press with {} triangles on {} cells, too few for the shape of a foot: give the shoes or skin a finer mesh "
    "there, or choose a mesh as the sole.": (
        "{} drücken mit {} Dreiecken auf {} Zellen, zu wenige für die Form eines Fußes: den Schuhen oder der Haut "
        "dort ein feineres Netz geben, oder ein Netz als Sohle wählen."
    ),
    # ---- blender/bones.py
    "'{}' changes its size, and is {} times as large at frame {} as at frame {}: its feet press as large as they are "
    "there. Keep its scale, or bake frames apart.": (
        "'{0}' ändert seine Größe und ist in Bild {2} {1}-mal so groß wie in Bild {3}: die Füße drücken so groß, wie "
        "sie dort sind. Die Größe lassen, oder die Bilder einzeln backen."
    ),
    # ---- rig/sole_mesh.py
    "{} has no faces to be a sole: choose a mesh with faces.": (
        "{} hat keine Flächen, um eine Sohle zu sein: ein Netz mit Flächen wählen."
    ),
    "{} has a face without its vertices: repair the mesh.": "{} hat eine Fläche ohne ihre Punkte: das Netz richten.",
    "{} has NaN or infinite vertices: repair the mesh.": (
        "{} hat Punkte, die NaN oder unendlich sind: das Netz richten."
    ),
    "{} lies at no foot of the rest pose: it was laid centred under each, its front the way the walker faces.": (
        "{} liegt an keinem Fuß der Ruhelage: es wurde mittig unter jeden gelegt, vorn, wohin der Läufer sieht."
    ),
    "{} is {} m long under a foot of {} m: check its scale.": (
        "{} ist {} m lang unter einem Fuß von {} m: die Größe prüfen."
    ),
    # ---- rig/solid.py
    "The matrices of '{}' have shape {} where {} is needed: give one a time.": (
        "Die Matrizen von '{}' haben die Form {}, wo {} nötig ist: für jede Zeit eine geben."
    ),
    # ---- rig/tread.py
    "There is no tread '{}': choose one of {}.": "Es gibt kein Profil '{}': eines von {} wählen.",
}
