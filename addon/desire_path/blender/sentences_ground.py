"""sentences_ground.py - what grounds, soils and plants tell, in other languages.

Keys are the English sentences as templates; {} is what comes in, in the same order unless numbered.
"""

GERMAN = {
    # ---- ground/detail.py
    "A detail's min_crumb is above its max_crumb: exchange them.": (
        "min_crumb einer Feinheit liegt über max_crumb: beide vertauschen."
    ),
    "A point is NaN, infinite or farther out than {} m: move or remove it.": (
        "Ein Punkt ist NaN, unendlich oder weiter fort als {} m: ihn verschieben oder entfernen."
    ),
    # ---- ground/film.py
    "This simulation was closed: make a new one.": "Diese Simulation wurde geschlossen: eine neue machen.",
    # ---- ground/ground.py
    "The height of the flat ground is not a number: give it in metres.": (
        "Die Höhe des ebenen Bodens ist keine Zahl: sie in Metern angeben."
    ),
    "A ground of heights needs at least 2 x 2 samples.": "Ein Boden aus Höhen braucht mindestens 2 x 2 Werte.",
    "The ground has infinite heights: mark holes with NaN instead.": (
        "Der Boden hat unendliche Höhen: Löcher stattdessen mit NaN bezeichnen."
    ),
    "The ground has no height anywhere: every sample is NaN.": "Der Boden hat nirgends eine Höhe: jeder Wert ist NaN.",
    "The ground's sample spacing must be a positive number of metres.": (
        "Der Abstand der Werte des Bodens muss eine positive Zahl von Metern sein."
    ),
    "The soils' weights have shape {}: give one for each soil and height.": (
        "Die Gewichte der Bodenarten haben die Form {}: eines für jede Bodenart und Höhe geben."
    ),
    "The ground has no faces: give it at least one.": "Der Boden hat keine Flächen: ihm mindestens eine geben.",
    "The ground has vertices of shape {} and triangles of shape {}: give (n, 3) positions and (m, 3) indices.": (
        "Der Boden hat Punkte der Form {} und Dreiecke der Form {}: Orte (n, 3) und Nummern (m, 3) geben."
    ),
    "A triangle of the ground names a vertex that is not there: mend its indices.": (
        "Ein Dreieck des Bodens nennt einen Punkt, den es nicht gibt: die Nummern richten."
    ),
    "Vertex {} of the ground is not a finite position: repair the mesh and bake again.": (
        "Der Punkt {} des Bodens liegt nicht im Endlichen: das Netz richten und noch einmal backen."
    ),
    "The soils' weights have shape {}: give one for each soil and vertex.": (
        "Die Gewichte der Bodenarten haben die Form {}: eines für jede Bodenart und jeden Punkt geben."
    ),
    "Give the ground between 1 and 255 soils.": "Dem Boden 1 bis 255 Bodenarten geben.",
    "Ground that is pressed by hand takes no SoilKeys: give it the Soil of one moment, keys.at(2.0).": (
        "Boden, der von Hand gedrückt wird, nimmt keine SoilKeys: ihm die Bodenart eines Augenblicks geben, "
        "keys.at(2.0)."
    ),
    "A cell size of {} m cannot be worked with: choose 0.0005 to 1 m (0.01 is usual).": (
        "Mit einer Zellgröße von {} m lässt sich nicht arbeiten: 0.0005 bis 1 m wählen (0.01 ist üblich)."
    ),
    # ---- ground/kinds.py
    'There is no plant form "{}": choose surface or tuft.': (
        'Es gibt keine Pflanzenform "{}": surface oder tuft wählen.'
    ),
    "A tuft of {} sheets cannot be built: choose 2 or 3.": (
        "Ein Büschel aus {} Blättern lässt sich nicht bauen: 2 oder 3 wählen."
    ),
    "A plant's break_angle lies below its degrade_angle: raise it.": (
        "break_angle einer Pflanze liegt unter degrade_angle: ihn erhöhen."
    ),
    "A plant {} m high and {} m wide has too many particles {} m apart: raise its spacing.": (
        "Eine Pflanze, {} m hoch und {} m breit, hat zu viele Teilchen im Abstand von {} m: den Abstand erhöhen."
    ),
    "There is no plant '{}': choose one of {}.": "Es gibt keine Pflanze '{}': eine von {} wählen.",
    "{} is no kind of plant: give a Kind or one of {}.": "{} ist keine Pflanzenart: eine Kind oder eine von {} geben.",
    # ---- ground/maps.py
    "There is nothing to write to {}: give at least one map.": (
        "Es gibt nichts nach {} zu schreiben: mindestens eine Karte geben."
    ),
    "The map '{}' for {} has the shape {}: give it rows and columns.": (
        "Die Karte '{}' für {} hat die Form {}: ihr Zeilen und Spalten geben."
    ),
    "The maps for {} differ in shape ({}): give all the same.": (
        "Die Karten für {} haben verschiedene Formen ({}): allen dieselbe geben."
    ),
    "{} cannot be written ({}): make room or choose another folder.": (
        "{} lässt sich nicht schreiben ({}): Platz schaffen oder einen anderen Ordner wählen."
    ),
    "{} cannot be written ({}): give up to 64 maps of at most 2^32 cells, and maps and notes with different names "
    "of 1 to 29 characters that OpenEXR does not use itself.": (
        "{} lässt sich nicht schreiben ({}): bis zu 64 Karten von höchstens 2^32 Zellen geben, und Karten und "
        "Notizen mit verschiedenen Namen von 1 bis 29 Zeichen, die OpenEXR nicht selbst verwendet."
    ),
    "{} cannot be opened: check that the file is there and may be read.": (
        "{} lässt sich nicht öffnen: prüfen, ob die Datei da ist und gelesen werden darf."
    ),
    "{} has a packing unknown here, of a newer OpenEXR: write it again with ZIP, PIZ or none.": (
        "{} ist auf eine Art gepackt, die hier unbekannt ist, von einem neueren OpenEXR: mit ZIP, PIZ oder "
        "ungepackt neu schreiben."
    ),
    "{} is damaged or no flat OpenEXR image: write it again, or choose another file.": (
        "{} ist beschädigt oder kein flaches OpenEXR-Bild: es neu schreiben, oder eine andere Datei wählen."
    ),
    # ---- ground/options.py
    "There is no contact law '{}': choose {}.": "Es gibt kein Kontaktgesetz '{}': {} wählen.",
    "There is no heap law '{}': choose {}.": "Es gibt kein Gesetz für Haufen '{}': {} wählen.",
    "The number of threads must be 0 (all) to 64.": "Die Zahl der Prozessoren muss 0 (alle) bis 64 sein.",
    "A rim width of {} is no number: give more than 0 m (0.04 is usual).": (
        "Eine Randbreite von {} ist keine Zahl: mehr als 0 m angeben (0.04 ist üblich)."
    ),
    "A rim width of {} m cannot be used: choose more than 0 (0.04 is usual).": (
        "Eine Randbreite von {} m geht nicht: mehr als 0 wählen (0.04 ist üblich)."
    ),
    "The origin of the cells is not a finite point: give two numbers in metres.": (
        "Der Ursprung der Zellen ist kein endlicher Punkt: zwei Zahlen in Metern angeben."
    ),
    "The origin of the cells, {} {}, lies too far away: give one within {} m.": (
        "Der Ursprung der Zellen, {} {}, liegt zu weit fort: einen innerhalb von {} m angeben."
    ),
    "Limits of {} are none: give Limits(), or leave them out for the usual ones.": (
        "Grenzen wie {} gibt es nicht: Limits() geben, oder sie für die üblichen weglassen."
    ),
    # ---- ground/parcels.py
    "There are no plants to write as a mesh: give the bake plants, or no plant_mesh.": (
        "Es gibt keine Pflanzen, die als Netz zu schreiben wären: dem Backen Pflanzen geben, oder kein plant_mesh."
    ),
    "'{}' and '{}' both have a trail already, and a walk over several grounds goes on from one: free what was "
    "pressed into the others, or bake each ground by itself.": (
        "'{}' und '{}' haben beide schon eine Spur, und ein Gang über mehrere Böden geht von einer aus weiter: "
        "löschen, was in die anderen gedrückt wurde, oder jeden Boden für sich backen."
    ),
    "'{}' is no mesh: only meshes can be baked together.": "'{}' ist kein Netz: nur Netze lassen sich zusammen backen.",
    # ---- bake/volume.py
    "VDB is written by the module openvdb, which is not there: export from Blender 4.4 or later.": (
        "VDB schreibt das Modul openvdb, das es hier nicht gibt: aus Blender 4.4 oder später exportieren."
    ),
    "Nothing flies in the bake in {}: choose a spray and bake again.": (
        "Im Gebackenen in {} fliegt nichts: Spritzer wählen und noch einmal backen."
    ),
    # ---- ground/spray.py
    "A spray's slow_speed of {} m/s is not below its fast_speed, {} m/s: lower it.": (
        "slow_speed der Spritzer von {} m/s liegt nicht unter fast_speed, {} m/s: sie senken."
    ),
    "There is no spray '{}': choose one of {}, or a .json file of one.": (
        "Es gibt keine Spritzer '{}': eine von {} wählen, oder eine .json-Datei davon."
    ),
    "Grains of {} m are too many on {}: choose a particle_size of {} m or more, or less adhesion.": (
        "Körner von {} m sind zu viele auf {}: particle_size von {} m oder mehr wählen, oder weniger adhesion."
    ),
    "{} is no frame of a spray: choose spray_0001.exr of a bake.": (
        "{} ist kein Bild von Spritzern: spray_0001.exr von etwas Gebackenem wählen."
    ),
    # ---- ground/plant_mesh.py
    "No plants stand where the walk goes: raise their density or widen their rectangle.": (
        "Wo der Gang verläuft, stehen keine Pflanzen: ihre Dichte erhöhen oder ihr Rechteck verbreitern."
    ),
    # ---- ground/planting.py
    "A density of {} plants a m^2 cannot be planted: choose one from 1e-6 to 100000, or None for the kind's own.": (
        "Eine Dichte von {} Pflanzen je m^2 lässt sich nicht pflanzen: eine von 1e-6 bis 100000 wählen, oder None "
        "für die der Art."
    ),
    "A seed of {} cannot be used: choose a whole number from 0 to 2^64 - 1.": (
        "Ein Startwert von {} geht nicht: eine ganze Zahl von 0 bis 2^64 - 1 wählen."
    ),
    "The rectangle {} holds no ground: give x0, y0, x1, y1 in metres.": (
        "Im Rechteck {} liegt kein Boden: x0, y0, x1, y1 in Metern angeben."
    ),
    "The weight of a planting needs rows and columns, and a rectangle to lie over.": (
        "Das Gewicht einer Pflanzung braucht Zeilen und Spalten, und ein Rechteck, über dem es liegt."
    ),
    "The weight of a planting must be 0 to 1 everywhere: mend what is not.": (
        "Das Gewicht einer Pflanzung muss überall 0 bis 1 sein: richten, was es nicht ist."
    ),
    "Roots of shape {} cannot be planted: give finite x, y [m], (n, 2).": (
        "Wurzeln der Form {} lassen sich nicht pflanzen: endliche x, y [m], (n, 2) geben."
    ),
    "The vigour of a planting needs roots, and one number from -8 to 8 for each.": (
        "Die Wuchskraft einer Pflanzung braucht Wurzeln, und für jede eine Zahl von -8 bis 8."
    ),
    # ---- ground/pressing.py
    "'{}' has a face without its vertices: repair the mesh.": (
        "'{}' hat eine Fläche ohne ihre Punkte: das Netz richten."
    ),
    "'{}' has NaN or infinite vertices: repair the mesh.": (
        "'{}' hat Punkte, die NaN oder unendlich sind: das Netz richten."
    ),
    "A mass of {} kg for '{}' is none: give more than 0, or none.": (
        "Eine Masse von {} kg für '{}' ist keine: mehr als 0 angeben, oder keine."
    ),
    "There is no body to press the ground with: give one at least.": (
        "Es gibt keinen Körper, der in den Boden drückt: mindestens einen geben."
    ),
    "A move of {} seconds cannot be made: give more than 0.": (
        "Eine Bewegung von {} Sekunden geht nicht: mehr als 0 angeben."
    ),
    "'{}' presses by its shape: give it a mass when it is made.": (
        "'{}' drückt durch seine Form: ihm eine Masse geben, wenn es gemacht wird."
    ),
    "A pose is a place and a unit quaternion: give 7 finite numbers.": (
        "Eine Lage ist ein Ort und ein Einheitsquaternion: 7 endliche Zahlen geben."
    ),
    "Nothing was pressed yet: move a body first.": "Es wurde noch nichts gedrückt: erst einen Körper bewegen.",
    "{} bodies need as many poses of 7 finite numbers: a place and a unit quaternion.": (
        "{} Körper brauchen ebenso viele Lagen aus 7 endlichen Zahlen: einen Ort und ein Einheitsquaternion."
    ),
    "A pose has a rotation that is no unit quaternion: give (w, x, y, z) of length 1.": (
        "Eine Lage hat eine Drehung, die kein Einheitsquaternion ist: (w, x, y, z) der Länge 1 geben."
    ),
    "'{}' is {} m wide, too large for cells of {} m: choose larger ones.": (
        "'{}' ist {} m breit, zu groß für Zellen von {} m: größere wählen."
    ),
    # ---- ground/rectangle_cells.py
    "The rectangle {}, {} to {}, {} holds no cells, or has no end: give finite x0 < x1 and y0 < y1 in metres, as "
    "box(reach()) does.": (
        "Im Rechteck {}, {} bis {}, {} liegen keine Zellen, oder es hat kein Ende: endliche x0 < x1 und y0 < y1 "
        "in Metern angeben, wie box(reach())."
    ),
    # ---- ground/refine.py
    "Vertex {} is NaN or infinite: move or remove it in Edit Mode.": (
        "Der Punkt {} ist NaN oder unendlich: ihn im Bearbeitungsmodus verschieben oder entfernen."
    ),
    # ---- ground/sim.py
    "The ground has no area seen from above: it stands upright. Lay it down and bake again.": (
        "Der Boden hat von oben gesehen keine Fläche: er steht aufrecht. Ihn hinlegen und noch einmal backen."
    ),
    "The ground cannot be used: {}.": "Der Boden ist nicht zu gebrauchen: {}.",
    "Plants cannot rest for {} seconds: give 0 or more.": (
        "Pflanzen können nicht {} Sekunden ruhen: 0 oder mehr angeben."
    ),
    "There is no stand {}: choose one of those in `stands`.": (
        "Es gibt keinen Bestand {}: einen von denen in `stands` wählen."
    ),
    "There is no field '{}': choose one of {}.": "Es gibt kein Feld '{}': eines von {} wählen.",
    "A window of {} x {} cells holds nothing: read at least one.": (
        "Ein Fenster von {} x {} Zellen enthält nichts: mindestens eine lesen."
    ),
    # ---- ground/soil.py
    "No {} has '{}': choose one of {}, as in {}.": "{0} kennt kein '{1}': eines von {2} wählen, wie {3}.",
    "'{}' is no number for a {}'s {}: give one.": "'{0}' ist keine Zahl für {2} ({1}): eine angeben.",
    "A soil gives way as snow or as ground that was measured, not as both: set its snow_density to 0, or its "
    "bekker_friction and bekker_cohesion.": (
        "Ein Boden gibt nach wie Schnee oder wie vermessener Boden, nicht wie beides: snow_density auf 0 setzen, oder "
        "bekker_friction und bekker_cohesion."
    ),
    "There is no soil '{}': choose one of {}, or a .json file of one.": (
        "Es gibt keine Bodenart '{}': eine von {} wählen, oder eine .json-Datei von einer."
    ),
    # ---- ground/soil_keys.py
    "Keys of a soil go by name: give {}.": "Keyframes einer Bodenart gehen nach Namen: {} geben.",
    "No soil has '{}': choose keys of {}.": "Keine Bodenart hat '{}': Keyframes von {} wählen.",
    '{} holds no keys of a soil: write {"young_modulus": [[0, 2e6], [5, 4e5]]}, each key a time [s] and a value.': (
        '{0} enthält keine Keyframes einer Bodenart: {{"young_modulus": [[0, 2e6], [5, 4e5]]}} schreiben, jeder '
        "eine Zeit [s] und ein Wert."
    ),
    "The keys of {} are no pairs of a time and a value: give [[0, 2e6], [5, 4e5]].": (
        "Die Keyframes von {} sind keine Paare aus Zeit und Wert: [[0, 2e6], [5, 4e5]] geben."
    ),
    "The keys of {} need times in seconds that rise: give each one once, or twice where it switches.": (
        "Die Keyframes von {} brauchen steigende Zeiten in Sekunden: jede einmal geben, oder zweimal, wo sie "
        "umschaltet."
    ),
    "A soil's {} cannot change over time, since {}: give it no keys.": (
        "{} einer Bodenart kann sich nicht mit der Zeit ändern, da {}: keine Keyframes darauf geben."
    ),
    # ---- ground/state_file.py
    "The state {} cannot be read ({}): check its name and whose file it is.": (
        "Der Stand {} lässt sich nicht lesen ({}): den Namen prüfen, und wem die Datei gehört."
    ),
    "{} is damaged, or the state of another ground, walk or plants: run this one from its start.": (
        "{} ist beschädigt, oder der Stand eines anderen Bodens, Gangs oder anderer Pflanzen: diesen von Anfang "
        "an laufen lassen."
    ),
    "A state can only be loaded before the first step: make the simulation anew and load the walk first.": (
        "Ein Stand lässt sich nur vor dem ersten Schritt laden: die Simulation neu machen und erst den Gang laden."
    ),
    # ---- ground/trail.py
    "The plants of {} are not in the map: what grows here now was not trodden before.": (
        "Die Pflanzen von {} sind nicht in der Karte: was jetzt hier wächst, wurde zuvor nicht betreten."
    ),
    "The cells of {} ({} m from {}, {}) are not those of this bake: the trail was averaged over cells of {} m.": (
        "Die Zellen von {} ({} m ab {}, {}) sind nicht die dieses Backens: die Spur wurde über Zellen von {} m "
        "gemittelt."
    ),
    "{} covers too many cells of {} m: choose a larger cell size.": (
        "{} bedeckt zu viele Zellen von {} m: größere Zellen wählen."
    ),
    "{} does not say how far its samples are apart: add --spacing METRES.": (
        "{} sagt nicht, wie weit die Werte auseinander liegen: --spacing METER angeben."
    ),
    "{} does not say where it lies: give originX and originY as numbers [m].": (
        "{} sagt nicht, wo es liegt: originX und originY als Zahlen [m] angeben."
    ),
    "{} is a map without the height before the walk (no rest.V): bake it again, and go on from that.": (
        "{} ist eine Karte ohne die Höhe vor dem Gang (kein rest.V): noch einmal backen und davon ausgehen."
    ),
    "{} does not say how large its cells are: give the map as the bake wrote it.": (
        "{} sagt nicht, wie groß die Zellen sind: die Karte geben, wie das Backen sie schrieb."
    ),
    "{} is damaged: its {} holds values that no bake writes.": (
        "{} ist beschädigt: {} enthält Werte, die kein Backen schreibt."
    ),
    "{} is damaged: its rest heights are no ground.": "{} ist beschädigt: die Höhen vor dem Gang sind kein Boden.",
    "{} is a frame for playback, not a height map: give the bake's maps_final.exr.": (
        "{} ist ein Bild zum Abspielen, keine Karte von Höhen: maps_final.exr des Backens geben."
    ),
    "{} has no channel of heights among {}: call it height, Z, V or Y [m].": (
        "{} hat keinen Kanal für Höhen unter {}: ihn height, Z, V oder Y [m] nennen."
    ),
    # ---- ground/height16.py
    "{} is not there: bake with maps, or give the file of maps itself.": (
        "{} ist nicht da: mit Karten backen, oder die Datei der Karten selbst angeben."
    ),
    "There is no ground in these heights: give a map of some.": (
        "In diesen Höhen ist kein Boden: eine Karte von Boden geben."
    ),
    "These heights are too far apart to be told: give a map of ground.": (
        "Diese Höhen liegen zu weit auseinander, um unterschieden zu werden: eine Karte von Boden geben."
    ),
    "{} is of no kind that is written: give it a name that ends with {}.": (
        "{} ist von keiner Art, die geschrieben wird: ihm einen Namen geben, der auf {} endet."
    ),
    # ---- ground/geotiff.py
    "GeoTIFF is read by the package rasterio, which is not there: pip install desire-path[geotiff], or pip install "
    "rasterio.": (
        "GeoTIFF wird mit dem Paket rasterio gelesen, das nicht da ist: pip install desire-path[geotiff], oder pip "
        "install rasterio."
    ),
    "{} has more than 2^28 samples: cut out what is walked on.": (
        "{} hat mehr als 2^28 Werte: ausschneiden, worauf gegangen wird."
    ),
    "{} is damaged or no GeoTIFF ({}): write it again, or choose another file.": (
        "{} ist beschädigt oder kein GeoTIFF ({}): noch einmal schreiben, oder eine andere Datei wählen."
    ),
    "The heights of {} are in {}: write them in metres.": "Die Höhen von {} sind in {}: sie in Metern schreiben.",
    "The samples of {} are not square or not along x and y: warp it, north up.": (
        "Die Werte von {} liegen nicht in Quadraten oder nicht entlang x und y: umrechnen, Norden oben."
    ),
    "The samples of {} are {} m apart: give a map whose unit is a length.": (
        "Die Werte von {} liegen {} m auseinander: eine Karte geben, deren Einheit eine Länge ist."
    ),
    "{} lies on a map in degrees: warp it to one in metres, as UTM (gdalwarp -t_srs).": (
        "{} liegt auf einer Karte in Grad: auf eine in Metern umrechnen, etwa UTM (gdalwarp -t_srs)."
    ),
    # ---- ground/stage.py
    "USD is written by the module pxr, which is not there: pip install desire-path[usd], or pip install usd-core, "
    "or export from Blender 4.5 or later.": (
        "USD wird mit dem Modul pxr geschrieben, das nicht da ist: pip install desire-path[usd], oder pip install "
        "usd-core, oder aus Blender 4.5 oder neuer exportieren."
    ),
    "The plants in {} are damaged ({}): bake again.": "Die Pflanzen in {} sind beschädigt ({}): noch einmal backen.",
    "The stage cannot be written to {} ({}): choose another folder or make room.": (
        "Die Bühne lässt sich nicht nach {} schreiben ({}): einen anderen Ordner wählen oder Platz schaffen."
    ),
    "{} cannot be so large: write .raw, or bake with a larger cell size.": (
        "{} kann nicht so groß sein: .raw schreiben, oder mit größeren Zellen backen."
    ),
    # ---- ground/materials.py
    "More than {} soils here stick to soles: set the adhesion of some to 0.": (
        "Mehr als {} Bodenarten kleben hier an Sohlen: adhesion von einigen auf 0 setzen."
    ),
    # ---- ground/layers.py
    "A layer {} m thick cannot lie on the ground: give more than 0 and up to {} m.": (
        "Eine Schicht von {} m Dicke kann nicht auf dem Boden liegen: mehr als 0 und bis zu {} m angeben."
    ),
    "{} layers lie on the ground: give at most {}.": "{} Schichten liegen auf dem Boden: höchstens {} angeben.",
    "{} soils and {} painted layers make too many kinds of ground: paint fewer of them.": (
        "{} Bodenarten und {} gemalte Schichten ergeben zu viele Arten von Boden: weniger davon malen."
    ),
    "Ground in layers takes no soil that changes over time: give it that of one moment.": (
        "Boden in Schichten nimmt keine Bodenart, die sich mit der Zeit ändert: die eines Augenblicks angeben."
    ),
    "'{}' and '{}' have different layers: give both the same, painted where they lie, or bake each ground by itself.": (
        "'{}' und '{}' haben verschiedene Schichten: beiden dieselben geben, gemalt, wo sie liegen, oder jeden Boden "
        "für sich backen."
    ),
    # ---- blender/layered.py, op_layers.py
    "'{}' has no vertex group '{}' by which a layer lies: choose another group, or none.": (
        "'{}' hat keine Vertex-Gruppe '{}', nach der eine Schicht liegt: eine andere Gruppe wählen, oder keine."
    ),
    "Two layers of one soil lie on each other on '{}': remove one, and make the other thicker.": (
        "Auf '{}' liegen zwei Schichten derselben Bodenart aufeinander: eine entfernen und die andere dicker machen."
    ),
    "The soil of '{}' has keys, which ground in layers does not take: remove the keys, or the layers.": (
        "Die Bodenart von '{}' hat Keys, die Boden in Schichten nicht nimmt: die Keys entfernen, oder die Schichten."
    ),
    "The layers of '{}' change between frames {} and {}, by keys or drivers, which layers do not take: remove or mute "
    "these.": (
        "Die Schichten von '{}' ändern sich zwischen den Bildern {} und {}, durch Keys oder Treiber, die Schichten "
        "nicht nehmen: diese entfernen oder stumm schalten."
    ),
    "'{}' has {} layers, which is the most: remove one first.": (
        "'{}' hat {} Schichten, mehr gehen nicht: zuerst eine entfernen."
    ),
    "Nothing lies on '{}' yet: add a layer first.": "Auf '{}' liegt noch nichts: zuerst eine Schicht hinzufügen.",
}
