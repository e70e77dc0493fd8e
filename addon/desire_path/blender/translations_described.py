"""translations_described.py - the descriptions of the add-on in other languages, shown beside the pointer.

Keys are the English descriptions, as Blender has them: line ends and all.
"""

GERMAN = {
    # ---- buttons
    "Make the active mesh a ground in which walkers leave prints": (
        "Das aktive Netz zu einem Boden machen, in dem Läufer Abdrücke hinterlassen"
    ),
    "Add a soil that lies where a vertex group is painted": (
        "Eine Bodenart hinzufügen, die dort liegt, wo eine Vertex-Gruppe gemalt ist"
    ),
    "Remove the painted soil from the list; the vertex group stays": (
        "Die gemalte Bodenart aus der Liste nehmen; die Vertex-Gruppe bleibt"
    ),
    "Let the active armature leave prints, by the feet found in it, or the active mesh, as a rigid body; joins "
    "it to the ground": (
        "Das aktive Skelett mit den Füßen, die darin gefunden werden, oder das aktive Netz als starren Körper "
        "Abdrücke hinterlassen lassen; verbindet es mit dem Boden"
    ),
    "Show the documentation of Desire Path, which is installed with it, in a text editor": (
        "Die Dokumentation von Desire Path, die mit installiert ist, in einem Texteditor zeigen"
    ),
    "Which page is shown": "Welche Seite gezeigt wird",
    "How everything is used, in Blender and without": "Wie alles benutzt wird, in Blender und ohne",
    "What has changed from version to version": "Was sich von Version zu Version geändert hat",
    "The kind of plant, by its picture": "Die Pflanzenart nach ihrem Bild",
    "Find the feet, toes, heels and hips of the active armature; each can be changed by hand then": (
        "Füße, Zehen, Fersen und Hüfte des aktiven Skeletts finden; jedes kann danach von Hand geändert werden"
    ),
    "Add a foot that was not found; the active bone is taken for it, another can be chosen": (
        "Einen Fuß hinzufügen, der nicht gefunden wurde; der aktive Knochen wird dafür genommen, ein anderer kann "
        "gewählt werden"
    ),
    "Let this foot leave no prints; Find Feet brings it back": (
        "Diesen Fuß keine Abdrücke hinterlassen lassen; Füße finden holt ihn zurück"
    ),
    "Which of the feet, counted from 0": "Welcher der Füße, von 0 an gezählt",
    "Let the active object be a ground or walker no more; frees its bake": (
        "Das aktive Objekt ist kein Boden oder Läufer mehr; löscht, was dafür gebacken wurde"
    ),
    "Write what the active walker does to a file that bakes without Blender": (
        "Was der aktive Läufer tut, in eine Datei schreiben, die sich ohne Blender backen lässt"
    ),
    "Where the recording is written": "Wohin die Aufnahme geschrieben wird",
    "Write what was baked on the active ground for game engines, makers of terrain and other programs of pictures": (
        "Was auf dem aktiven Boden gebacken ist, für Spiele-Engines, Gelände- und andere Bildprogramme schreiben"
    ),
    "What is written": "Was geschrieben wird",
    "Where it is written: .png, .raw or .r16; .usdc, .usda or .usd; .vdb; .abc": (
        "Wohin es geschrieben wird: .png, .raw oder .r16; .usdc, .usda oder .usd; .vdb; .abc"
    ),
    "A mesh at the end of the walk with all maps, and the plants that were baked as a mesh": (
        "Ein Netz am Ende des Gangs mit allen Karten, und die Pflanzen, die als Netz gebacken sind"
    ),
    "The ground and its plants as they move, in the frames of the scene": (
        "Der Boden und seine Pflanzen, wie sie sich bewegen, in den Bildern der Szene"
    ),
    "A grey picture or bare numbers; a .json beside it tells what a value is": (
        "Ein graues Bild oder bloße Zahlen; eine .json daneben sagt, was ein Wert ist"
    ),
    "Press the walkers' prints into the active ground, in files that play without this add-on": (
        "Die Abdrücke der Läufer in den aktiven Boden drücken, als Dateien, die ohne diese Erweiterung abgespielt "
        "werden"
    ),
    "Bake all grounds of the scene, one after the other; those that a walk crosses are baked together": (
        "Alle Böden der Szene nacheinander backen; die ein Gang überquert, werden zusammen gebacken"
    ),
    "Stop the bake that is running; what was baked stays": "Das laufende Backen anhalten; was gebacken ist, bleibt",
    "Give the ground back as it was before the bake, and delete the baked files once the file is saved or closed": (
        "Den Boden wiedergeben, wie er vor dem Backen war, und die gebackenen Dateien löschen, sobald die Datei "
        "gespeichert oder geschlossen wird"
    ),
    "Show the files of the active ground's bake in the system's file browser": (
        "Die gebackenen Dateien des aktiven Bodens im Dateibrowser des Systems zeigen"
    ),
    "Show or hide how hard the ground carries each foot, as arrows at the current frame, and the mass centre": (
        "Als Pfeile im aktuellen Bild zeigen oder verbergen, wie stark der Boden jeden Fuß trägt, und den Schwerpunkt"
    ),
    "Show or hide a graph of each foot's vertical force over time, in the corner of the 3D viewport": (
        "Eine Kurve der senkrechten Kraft jedes Fußes über die Zeit in der Ecke der 3D-Ansicht zeigen oder verbergen"
    ),
    "Tell contacts, cadence, mean force and what is odd about the walk": (
        "Kontakte, Schrittfrequenz, mittlere Kraft und Auffälliges am Gang nennen"
    ),
    "Where loads.csv and contacts.csv are written; empty = nowhere": "Ort der beiden Dateien; leer = keiner",
    "Write every force and every contact of the walk as tables, loads.csv and contacts.csv": (
        "Jede Kraft und jeden Kontakt des Gangs als Tabellen schreiben, loads.csv und contacts.csv"
    ),
    "Put the feet of the active armature on its ground: up, down and across slopes, carried there from a level "
    "floor. Makes a new action; the one it had stays": (
        "Die Füße des aktiven Skeletts auf seinen Boden setzen: Hänge hinauf, hinunter und quer, vom ebenen Boden "
        "dorthin getragen. Macht eine neue Action; die vorige bleibt"
    ),
    "Let the body of the active armature lean into slopes and swing on ground that gives way, its feet staying where "
    "they are. Makes a new action; the one it had stays": (
        "Den Körper des aktiven Skeletts sich in Hänge neigen und auf nachgebendem Boden schwingen lassen, während die "
        "Füße bleiben, wo sie sind. Legt eine neue Action an; die alte bleibt"
    ),
    "Let the active armature walk as slowly as its prints are deep, at the effort of firm ground. Its keys stay: a "
    "strip of the NLA editor plays them, by a curve of time to work on": (
        "Das aktive Skelett so langsam gehen lassen, wie seine Abdrücke tief sind, mit der Mühe festen Bodens. Seine "
        "Keyframes bleiben: ein Strip des NLA-Editors spielt sie, nach einer Kurve der Zeit, die sich bearbeiten lässt"
    ),
    "Loose sand, which costs 2.1 times the effort however shallow prints are": (
        "Loser Sand, der 2,1-mal so viel Mühe kostet, wie flach die Abdrücke auch sind"
    ),
    "Only the depth of prints costs effort": "Nur die Tiefe der Abdrücke kostet Mühe",
    "Play the action again at its own time": "Die Action wieder in ihrer eigenen Zeit spielen",
    "What walking costs where prints are shallow": "Was Gehen kostet, wo Abdrücke flach sind",
    "By which share of the slope under its feet the body leans": (
        "Um welchen Anteil der Neigung unter seinen Füßen sich der Körper neigt"
    ),
    "How soon the body follows the ground, in newtons for a mass centre 1 m high": (
        "Wie bald der Körper dem Boden folgt, in Newton für einen Schwerpunkt in 1 m Höhe"
    ),
    "How little it swings, in newton metre seconds for a mass centre 1 m high": (
        "Wie wenig er schwingt, in Newtonmetersekunden für einen Schwerpunkt in 1 m Höhe"
    ),
    "Play the action again that the balanced one was made from": (
        "Wieder die Action abspielen, aus der die ausbalancierte entstand"
    ),
    "Let the feet down into the prints that are baked, and the body with them": (
        "Die Füße in die gebackenen Abdrücke hinablassen, und den Körper mit ihnen"
    ),
    "Let plants grow on the active ground: they bend under the walkers, wear, and hold the soil": (
        "Pflanzen auf dem aktiven Boden wachsen lassen: sie biegen sich unter den Läufern, nutzen sich ab und halten "
        "die Erde"
    ),
    "A kind of plant, or a .json file in which a kind was saved": (
        "Eine Pflanzenart, oder eine .json-Datei, in der eine gespeichert wurde"
    ),
    "Plants on a square metre where the group is 1; 0 = as dense as the kind usually stands": (
        "Pflanzen auf einem Quadratmeter, wo die Gruppe 1 ist; 0 = so dicht, wie die Art gewöhnlich steht"
    ),
    "A vertex group or float attribute that thins the plants out; empty = they grow everywhere": (
        "Eine Vertex-Gruppe oder ein Float-Attribut, das die Pflanzen ausdünnt; leer = sie wachsen überall"
    ),
    "Name of an image that thins the plants out, white = all of them; by the active UV map, else stretched over "
    "the ground seen from above; empty = none": (
        "Name eines Bildes, das die Pflanzen ausdünnt, weiß = alle; nach der aktiven UV-Map, sonst über den von oben "
        "gesehenen Boden gespannt; leer = keines"
    ),
    "Make an object that shows the plants": "Ein Objekt erzeugen, das die Pflanzen zeigt",
    "Make an object that shows the chosen plants as grass": (
        "Ein Objekt erzeugen, das die gewählten Pflanzen als Gras zeigt"
    ),
    "Put the plants of the active ground anew, after its mesh, a density group or a density image was changed": (
        "Die Pflanzen des aktiven Bodens neu setzen, nachdem sein Netz, eine Dichtegruppe oder ein Dichtebild "
        "geändert wurde"
    ),
    "Take the chosen plants off the ground, with the grass that shows them; the vertex group stays": (
        "Die gewählten Pflanzen vom Boden nehmen, mit dem Gras, das sie zeigt; die Vertex-Gruppe bleibt"
    ),
    "Let the selected characters walk over the selected ground, or over one made for them, and show their prints": (
        "Die gewählten Figuren über den gewählten Boden gehen lassen, oder über einen, der für sie erzeugt wird, und "
        "ihre Abdrücke zeigen"
    ),
    "Give the selected grounds a material of what they are made of. Your own materials stay, and get a node group": (
        "Den gewählten Böden ein Material dessen geben, woraus sie sind. Eigene Materialien bleiben und bekommen eine "
        "Node-Gruppe"
    ),
    "What the ground looks like": "Wie der Boden aussieht",
    "What the ground's soils look like, the painted ones where they lie": (
        "Wie die Bodenarten des Bodens aussehen, die gemalten dort, wo sie liegen"
    ),
    "Grains, a little damp below the surface": "Körner, unter der Oberfläche etwas feucht",
    "White and a little translucent, bluer where it was pressed": (
        "Weiß und etwas durchscheinend, bläulicher, wo er gepresst wurde"
    ),
    "Damp lumps, smooth and wet where feet went": "Feuchte Klumpen, glatt und nass, wo Füße gingen",
    "Snow under a plate of ice, which cracks around prints": "Schnee unter einer Eisplatte, die um Abdrücke reißt",
    "Dusty and hard, with small stones, flaked and cracked around prints": (
        "Staubig und hart, mit Steinchen, um Abdrücke blättrig und rissig"
    ),
    "Dark crumbs, darker and flat where feet went": "Dunkle Krumen, dunkler und flach, wo Füße gingen",
    "Moss and dead leaves between plants, bare earth where the cover is gone": (
        "Moos und welke Blätter zwischen Pflanzen, nackte Erde, wo der Bewuchs fehlt"
    ),
    "Use it in place of materials of your own, too": "Es auch anstelle eigener Materialien verwenden",
    "Write the looks of grounds to a file of assets, and list it as a library of the Asset Browser": (
        "Das Aussehen von Böden in eine Datei von Assets schreiben und sie als Bibliothek im Asset-Browser aufführen"
    ),
    "Save the soil of the active ground as a file, for other grounds, scripts and people": (
        "Die Bodenart des aktiven Bodens als Datei speichern, für andere Böden, Skripte und Leute"
    ),
    "Copy all messages of this session, and the state of the active ground's bake, to the clipboard and into a text": (
        "Alle Meldungen dieser Sitzung und den Stand des aktiven Bodens in die Zwischenablage und in einen Text "
        "kopieren"
    ),
    "Take the numbers of this soil": "Die Werte dieser Bodenart übernehmen",
    "The .json file of the soil": "Die .json-Datei der Bodenart",
    "Keep these numbers as a soil of your own, for all files": (
        "Diese Werte als eigene Bodenart behalten, für alle Dateien"
    ),
    "What the soil is called": "Wie die Bodenart heißt",
    "Remove this soil of your own; grounds that have its numbers keep them": (
        "Diese eigene Bodenart entfernen; Böden, die ihre Werte haben, behalten sie"
    ),
    "Keep or drop what is pressed by hand, or take its last stroke back": (
        "Von Hand Gepresstes behalten oder verwerfen, oder den letzten Strich zurücknehmen"
    ),
    "It stays, as a bake of its own": "Es bleibt, als eigenes Gebackenes",
    "The ground is as it was before": "Der Boden ist, wie er zuvor war",
    "Take the last stroke back": "Den letzten Strich zurücknehmen",
    "Take the selected objects in hand and press them into the selected ground, or into the widest selected mesh": (
        "Die gewählten Objekte in die Hand nehmen und in den gewählten Boden drücken, oder ins breiteste gewählte Netz"
    ),
    "How deep they are pressed; 0 = a fifth of their height": "Wie tief sie gedrückt werden; 0 = ein Fünftel der Höhe",
    "What each weighs, in kilograms: it sinks until the ground carries it. 0 = the ground gives way to its shape; "
    "-1 = what a rigid body or walker weighs, else 0": (
        "Was jedes wiegt, in Kilogramm: es sinkt, bis der Boden es trägt. 0 = der Boden weicht seiner Form; -1 = was "
        "ein starrer Körper oder Läufer wiegt, sonst 0"
    ),
    # ---- plants
    "How many plants grow on a square metre where the group is 1": (
        "Wie viele Pflanzen auf einem Quadratmeter wachsen, wo die Gruppe 1 ist"
    ),
    "A vertex group or float attribute that thins the plants out: 1 = all of them, 0 = none. Empty = they grow "
    "everywhere": (
        "Eine Vertex-Gruppe oder ein Float-Attribut, das die Pflanzen ausdünnt: 1 = alle, 0 = keine. Leer = sie "
        "wachsen überall"
    ),
    "An image that thins the plants out, times the group if both are set: white = all of them, black = none, by "
    "the brightness of its pixels as they are stored. It lies on the ground by the active UV map; where there is "
    "none, it is stretched over the ground's bounding rectangle seen from above. Update Plants takes over what "
    "was painted since": (
        "Ein Bild, das die Pflanzen ausdünnt, mal der Gruppe, wenn beide gesetzt sind: weiß = alle, schwarz = keine, "
        "nach der Helligkeit seiner gespeicherten Pixel. Es liegt nach der aktiven UV-Map auf dem Boden; wo keine "
        "ist, wird es über das von oben gesehene Rechteck um den Boden gespannt. Pflanzen erneuern übernimmt, was "
        "seither gemalt wurde"
    ),
    "Another number puts every plant somewhere else": "Eine andere Zahl setzt jede Pflanze anderswohin",
    "The object that shows these plants; empty = they are not shown": (
        "Das Objekt, das diese Pflanzen zeigt; leer = sie werden nicht gezeigt"
    ),
    # ---- feet
    "Which foot this is": "Welcher Fuß das ist",
    "The bone that begins at the ankle": "Der Knochen, der am Knöchel beginnt",
    "The bone that begins at the ball of the foot; empty where the rig has none": (
        "Der Knochen, der am Fußballen beginnt; leer, wo das Rig keinen hat"
    ),
    "A bone that lies at the heel, if there is one": "Ein Knochen, der an der Ferse liegt, wenn es einen gibt",
    "The bone that begins at the hip of this leg; with neither thigh nor shank both are found above the foot": (
        "Der Knochen, der an der Hüfte dieses Beins beginnt; ohne Ober- und Unterschenkel werden beide über dem Fuß "
        "gefunden"
    ),
    "The bone that begins at the knee of this leg": "Der Knochen, der am Knie dieses Beins beginnt",
    # ---- a ground
    "Walkers leave prints in this mesh": "Läufer hinterlassen Abdrücke in diesem Netz",
    "What the ground is made of where nothing else is painted": "Woraus der Boden ist, wo nichts anderes gemalt ist",
    "Side of a cell of the pressed ground, in metres: smaller shows finer prints": (
        "Seite einer Zelle des gepressten Bodens, in Metern: kleiner zeigt feinere Abdrücke"
    ),
    "Side of a cell of the pressed ground: smaller shows finer prints": (
        "Seite einer Zelle des gepressten Bodens: kleiner zeigt feinere Abdrücke"
    ),
    "First frame that is baked": "Erstes Bild, das gebacken wird",
    "Last frame that is baked": "Letztes Bild, das gebacken wird",
    "Where the baked frames, maps and the report are written": (
        "Wohin gebackene Bilder, Karten und Bericht geschrieben werden"
    ),
    "Soils that lie where a vertex group is painted": "Bodenarten, die dort liegen, wo eine Vertex-Gruppe gemalt ist",
    "What grows on this ground, bends under feet and wears": (
        "Was auf diesem Boden wächst, sich unter Füßen biegt und abnutzt"
    ),
    "Also bake the simulated plants as a mesh of stems, for close-ups: where feet come near, in place of the "
    "grass, and down as long as that where trodden; large files": (
        "Auch die simulierten Pflanzen als Netz von Halmen backen, für Nahaufnahmen: wo Füße nahe kommen, anstelle "
        "des Grases, und so lange liegend wie dieses, wo es zertreten ist; große Dateien"
    ),
    "Show the prints on a copy of the mesh that is fine along the trail, so that they are seen on any mesh; the "
    "mesh itself stays as it is. Off: prints move the mesh's own points alone": (
        "Die Abdrücke auf einer Kopie des Netzes zeigen, die entlang der Spur fein ist, so dass man sie auf jedem "
        "Netz sieht; das Netz selbst bleibt, wie es ist. Aus: Abdrücke bewegen nur die Punkte des Netzes"
    ),
    "Shortest edge of the refined copy, in metres; 0 = the cell size": (
        "Kürzeste Kante der verfeinerten Kopie, in Metern; 0 = die Zellgröße"
    ),
    "Shortest edge of the refined copy; 0 = the cell size": "Kürzeste Kante der verfeinerten Kopie; 0 = die Zellgröße",
    "Edges of the refined copy are no shorter than so many pixels of the scene's camera, as near as it comes "
    "over the baked frames; 0 = the same everywhere": (
        "Kanten der verfeinerten Kopie sind nicht kürzer als so viele Pixel der Kamera der Szene, so nah sie in den "
        "gebackenen Bildern kommt; 0 = überall gleich"
    ),
    "Show crumbs, grit and frayed edges, finer than a cell, on edges so long where feet went, in metres: 0.002 "
    "for close-ups, slower to play. Nothing of them is baked; 0 = none": (
        "Krumen, Splitt und ausgefranste Ränder zeigen, feiner als eine Zelle, mit so langen Kanten, wo Füße gingen, "
        "in Metern: 0.002 für Nahaufnahmen, langsamer abzuspielen. Nichts davon wird gebacken; 0 = keine"
    ),
    "Also fill vertex groups with plant strength and compression (1 = the loose layer pressed flat), for hair "
    "and modifiers; slower to play": (
        "Auch Vertex-Gruppen mit Pflanzenstärke und Verdichtung füllen (1 = die lockere Schicht ganz gepresst), für "
        "Haare und Modifikatoren; langsamer abzuspielen"
    ),
    "Bake again by itself, while you go on working, once the walk, the soil, the mesh or a setting was changed; "
    "what was baked before plays until then": (
        "Von selbst neu backen, während man weiterarbeitet, sobald der Gang, die Bodenart, das Netz oder eine "
        "Einstellung geändert wurde; bis dahin wird das zuvor Gebackene abgespielt"
    ),
    "Also write the final compression, heap, pressure and plant strength as attributes of the mesh, for "
    "materials and nodes": (
        "Auch die endgültige Verdichtung, Aufhäufung, den Druck und die Pflanzenstärke als Attribute des Netzes "
        "schreiben, für Materialien und Nodes"
    ),
    "How a sole presses the ground": "Wie eine Sohle den Boden presst",
    "A tread prints its tread, a tilted sole digs in its edge": (
        "Ein Profil drückt sich ab, eine gekippte Sohle gräbt ihre Kante ein"
    ),
    "The same pressure under the whole sole": "Derselbe Druck unter der ganzen Sohle",
    "How displaced soil is laid around a print": "Wie verdrängter Boden um einen Abdruck gelegt wird",
    "At once in the shape it comes to rest in": "Sofort in der Form, in der er zur Ruhe kommt",
    "On the rim, falling off over its width, then sliding": "Auf dem Rand, über seine Breite abfallend, dann rutschend",
    "Processors to bake with, 0 = all; the result is the same": "Prozessoren, 0 = alle; das Ergebnis ist dasselbe",
    "Memory that Blender may take while it bakes, 0 = all there is: what does not fit waits in the bake's folder, and "
    "the result is the same": (
        "Speicher, den Blender beim Backen belegen darf, 0 = allen: was nicht hineinpasst, wartet im Ordner des "
        "Gebackenen; das Ergebnis ist dasselbe"
    ),
    # ---- a walker
    "This armature, or rigid body, leaves prints": "Dieses Skelett, oder dieser starre Körper, hinterlässt Abdrücke",
    "The mesh this walker leaves prints in": "Das Netz, in dem dieser Läufer Abdrücke hinterlässt",
    "How the walker presses the ground": "Wie der Läufer den Boden presst",
    "As the ground says; a mesh that is moved into the ground goes where it is moved to": (
        "Wie es der Boden sagt; ein Netz, das in den Boden bewegt wird, geht, wohin es bewegt wird"
    ),
    "As a rigid sole that its weight presses": "Als starre Sohle, die sein Gewicht presst",
    "The same pressure everywhere under it": "Überall darunter derselbe Druck",
    "Down to where it is, whatever it weighs, and what is in its way is pushed ahead": (
        "Bis dorthin, wo er ist, was er auch wiegt; was im Weg ist, wird vorangeschoben"
    ),
    "Which limbs of an armature press the ground": "Welche Glieder eines Skeletts den Boden pressen",
    "The feet that were found": "Die Füße, die gefunden wurden",
    "Feet go through what they sink into, as through deep snow, and push ahead what they do not clear": (
        "Füße gehen durch das, worin sie einsinken, wie durch tiefen Schnee, und schieben vor sich her, was im Weg ist"
    ),
    "Every bone that a mesh hangs on, as of who falls; it carves, unless told otherwise": (
        "Jeder Knochen, an dem ein Netz hängt, wie bei Stürzenden; er schneidet ein, wenn nichts anderes gesagt ist"
    ),
    "What built-in soles have below: those of a walker without feet or shoes of its own, or a sole": (
        "Was eingebaute Sohlen unten haben: die eines Läufers ohne eigene Füße, Schuhe oder Sohle"
    ),
    "A smooth sole": "Eine glatte Sohle",
    "Bars and blocks, as under a boot": "Stege und Blöcke, wie unter einem Stiefel",
    "Low ridges, as under a running shoe": "Niedrige Rippen, wie unter einem Laufschuh",
    "How heavy the walker is, in kilograms; 0 = estimated from its height": (
        "Wie schwer der Läufer ist, in Kilogramm; 0 = aus seiner Größe geschätzt"
    ),
    "How heavy the walker is; 0 = estimated from its height": (
        "Wie schwer der Läufer ist; 0 = aus seiner Größe geschätzt"
    ),
    "A bone that begins at the body's mass centre; empty = found from the segments of the body": (
        "Ein Knochen, der am Schwerpunkt des Körpers beginnt; leer = aus den Gliedern des Körpers gefunden"
    ),
    "A mesh whose underside is the sole of every foot, mirrored for the other side; place it at a foot of the "
    "rest pose. Empty = the walker's own feet or shoes": (
        "Ein Netz, dessen Unterseite die Sohle jedes Fußes ist, für die andere Seite gespiegelt; an einen Fuß der "
        "Ruhepose setzen. Leer = die eigenen Füße oder Schuhe des Läufers"
    ),
    "A clip that walks in place goes ahead with the character, at the speed of its feet, by an action of its "
    "own. Off: the clip as it was": (
        "Ein Clip, der auf der Stelle geht, trägt die Figur vorwärts, so schnell wie ihre Füße, durch eine eigene "
        "Action. Aus: der Clip, wie er war"
    ),
    "Prints are pressed as if the feet were placed on the ground's slopes; the character stays as it is. Place "
    "Feet changes the character too": (
        "Abdrücke werden gedrückt, als wären die Füße auf die Hänge des Bodens gesetzt; die Figur bleibt, wie sie "
        "ist. Füße aufsetzen ändert auch die Figur"
    ),
    "A curve, a mesh of edges or an empty with empties: the walk's cycle is carried along it. Empty = the walker "
    "goes where its keys lead it": (
        "Eine Kurve, ein Netz aus Kanten oder ein Empty mit Empties: der Gangzyklus wird daran entlanggetragen. Leer "
        "= der Läufer geht, wohin seine Keyframes ihn führen"
    ),
    "How often the path is walked": "Wie oft der Weg gegangen wird",
    "Every other pass goes back; else all go one way": (
        "Jeder zweite Durchgang führt zurück; sonst gehen alle in eine Richtung"
    ),
    "How far passes lie beside the path, as a standard deviation in metres": (
        "Wie weit Durchgänge neben dem Weg liegen, als Standardabweichung in Metern"
    ),
    "How far passes lie beside the path, as a standard deviation": (
        "Wie weit Durchgänge neben dem Weg liegen, als Standardabweichung"
    ),
    "Another number scatters the passes otherwise": "Eine andere Zahl streut die Durchgänge anders",
    "How the weight on each foot is found": "Wie das Gewicht auf jedem Fuß gefunden wird",
    "From how the body's mass centre moves: walks, runs, jumps, landings": (
        "Daraus, wie sich der Schwerpunkt des Körpers bewegt: Gehen, Laufen, Springen, Landen"
    ),
    "Weight, and an impulse at every touch-down": "Gewicht, und ein Stoß bei jedem Aufsetzen",
    "How often the armature is looked at in a frame; between, it is interpolated": (
        "Wie oft das Skelett in einem Bild angesehen wird; dazwischen wird interpoliert"
    ),
    "The bones of the walker's feet, found by Add Walker or Find Feet": (
        "Die Knochen der Füße des Läufers, gefunden durch Läufer hinzufügen oder Füße finden"
    ),
    "The bone the body hangs on": "Der Knochen, an dem der Körper hängt",
}
