"""sentences_walker.py - what is told of recordings, loads and placed feet, in other languages.

Keys are the English sentences as templates; {} is what comes in, in the same order unless numbered.
"""

GERMAN = {
    # ---- loads/below.py
    "The ground gave heights of shape {} for {} places: let it give one for each.": (
        "Der Boden gab Höhen der Form {} für {} Orte: ihn für jeden eine geben lassen."
    ),
    "The ground's heights have shape {} where {} is needed: give one height for each contact point and sample.": (
        "Die Höhen des Bodens haben die Form {}, wo {} nötig ist: für jeden Berührpunkt und Zeitpunkt eine Höhe geben."
    ),
    "A {} is no ground to stand on: give a height, heights (K, T), a function of points (n, 2), or a Simulation, "
    "as Simulation(Ground.flat()).": (
        "Auf einem {} kann man nicht stehen: eine Höhe geben, Höhen (K, T), eine Funktion von Punkten (n, 2), "
        "oder eine Simulation, wie Simulation(Ground.flat())."
    ),
    # ---- loads/carving.py
    "{} stays over the ground, so that it leaves no print by the contact law Carve: lower it, or let it press by "
    "its mass.": (
        "{} bleibt über dem Boden, so dass es nach dem Kontaktgesetz Verdrängt keinen Abdruck hinterlässt: es "
        "tiefer setzen, oder durch seine Masse drücken lassen."
    ),
    # ---- loads/checks.py
    "{} is below the ground all the time, whose highest faces count: move the ground down or the walker up, or "
    "take roofs out of the ground.": (
        "{} ist die ganze Zeit unter dem Boden, dessen höchste Flächen zählen: den Boden tiefer oder den Läufer "
        "höher setzen, oder Dächer aus dem Boden nehmen."
    ),
    "{} walks {} m above the ground: lower it or raise the ground.": (
        "{} geht {} m über dem Boden: tiefer setzen, oder den Boden höher."
    ),
    "{} walks {} m deep in the ground: raise it or lower the ground.": (
        "{} geht {} m tief im Boden: höher setzen, oder den Boden tiefer."
    ),
    "The feet of {} slide at {} m/s while they stand, though it goes at {} m/s: make it faster or slower, until "
    "they stand still.": (
        "Die Füße von {} rutschen mit {} m/s, während sie stehen, obwohl es mit {} m/s vorwärts geht: schneller "
        "oder langsamer machen, bis sie still stehen."
    ),
    "The feet of {} slide at {} m/s while they stand: if its clip walks in place, move the character forward at "
    "that speed.": (
        "Die Füße von {} rutschen mit {} m/s, während sie stehen: geht der Clip auf der Stelle, die Figur mit "
        "dieser Geschwindigkeit vorwärts bewegen."
    ),
    "The feet of {} would have to push along the ground with {} times its weight near frame {}, more than soles "
    "hold: a pose that is blended in, or something else that moves it; make that slower, or leave those frames out.": (
        "Die Füße von {} müssten mit dem {}-fachen Gewicht längs des Bodens drücken, um Bild {}, mehr als Sohlen "
        "halten: eine überblendete Pose, oder etwas anderes bewegt die Figur; langsamer machen, oder diese Bilder "
        "weglassen."
    ),
    "{} falls {} times as hard as gravity draws it near frame {}, and presses the deeper: a pose that is blended in, "
    "or a fall that is too short; make that slower, or leave those frames out.": (
        "{} fällt {}-mal so stark, wie die Schwerkraft zieht, um Bild {}, und drückt umso tiefer: eine überblendete "
        "Pose, oder ein zu kurzer Fall; langsamer machen, oder diese Bilder weglassen."
    ),
    "{} of {} steps of {} land beside the ground or reach over its edge, and leave no print there: make the "
    "ground larger, or move it under the walk, which takes up {} x {} m.": (
        "{} von {} Schritten von {} landen neben dem Boden oder ragen über seinen Rand, und hinterlassen dort "
        "keinen Abdruck: den Boden größer machen, oder unter den Gang schieben, der {} x {} m einnimmt."
    ),
    "{} never touches the ground: check its feet, its scale and the frame range.": (
        "{} berührt den Boden nie: Füße, Größe und Bilder prüfen."
    ),
    "The feet of {} carry {} of its weight on average: check the mass centre, the scale and whether feet float.": (
        "Die Füße von {} tragen im Mittel {} des Gewichts: Schwerpunkt und Größe prüfen, und ob die Füße schweben."
    ),
    "{} stands on something else than the ground, of which there is no print: about {} m over it, first at frame "
    "{}; make that a ground if it is to take prints.": (
        "{} steht auf etwas anderem als dem Boden, wovon es keinen Abdruck gibt: etwa {} m darüber, zuerst in "
        "Bild {}; jenes zum Boden machen, wenn es Abdrücke bekommen soll."
    ),
    # ---- loads/plot.py
    "Drawing needs Matplotlib, which is not here: install it with pip install desire-path[plot], or pip "
    "install matplotlib.": (
        "Kräfte zu zeichnen braucht Matplotlib, das nicht da ist: es mit pip install desire-path[plot] oder pip "
        "install matplotlib einrichten."
    ),
    "{} is no picture this can draw: let its name end in {} or {}.": (
        "{} ist kein Bild, das sich hiermit zeichnen lässt: den Namen auf {} oder {} enden lassen."
    ),
    # ---- loads/walker.py
    "{} is an old name: call it {}.": "{} ist ein alter Name: {} sagen.",
    "There is no setting {}: use one of {}.": "Es gibt keine Einstellung {}: eine von {} nehmen.",
    "There is no load model {}: use {}.": "Es gibt kein Lastmodell {}: {} nehmen.",
    "A settle time of {} s cannot be used: give one above 0.": (
        "Eine Zeit des Setzens von {} s geht nicht: eine über 0 angeben."
    ),
    "The settle time of the soil is not above 0 everywhere: let it be, under every foot.": (
        "Die Zeit des Setzens der Bodenart ist nicht überall über 0: sie es unter jedem Fuß sein lassen."
    ),
    # ---- motion/gait.py
    "There is no recording at {}: record the walk first or check the name.": (
        "In {} ist keine Aufnahme: erst den Gang aufnehmen, oder den Namen prüfen."
    ),
    "The recording {} cannot be read ({}): check whose file it is.": (
        "Die Aufnahme {} lässt sich nicht lesen ({}): prüfen, wem die Datei gehört."
    ),
    "{} is damaged or no recording ({}): record the walk again.": (
        "{} ist beschädigt oder keine Aufnahme ({}): den Gang noch einmal aufnehmen."
    ),
    "{} was recorded by another version ({}): record the walk again.": (
        "{} wurde von einer anderen Version aufgenommen ({}): den Gang noch einmal aufnehmen."
    ),
    "There is not enough memory for the recording {}: record fewer frames.": (
        "Der Speicher reicht nicht für die Aufnahme {}: weniger Bilder aufnehmen."
    ),
    "There is no walker to record: choose an armature first.": (
        "Es gibt keinen Läufer aufzunehmen: erst ein Skelett wählen."
    ),
    "The walkers were recorded at different times: record them over one frame range.": (
        "Die Läufer wurden zu verschiedenen Zeiten aufgenommen: sie über dieselben Bilder aufnehmen."
    ),
    "A rate of {} samples a second cannot be used: give one above 0.": (
        "Eine Rate von {} Werten in der Sekunde geht nicht: eine über 0 angeben."
    ),
    # ---- motion/drawn.py
    "Poses of {} are held for {} frames each: prints are those of the motion between them.": (
        "Posen von {} werden je {} Bilder lang gehalten: Abdrücke sind die der Bewegung dazwischen."
    ),
    # ---- motion/jumps.py
    "{}: taken as a cut, over which nothing moves.": "{}: als Schnitt genommen, über den sich nichts bewegt.",
    "{}, and {} more times elsewhere: taken as cuts, over which nothing moves.": (
        "{}, und {} mal mehr anderswo: als Schnitte genommen, über die sich nichts bewegt."
    ),
    # ---- motion/mass_keys.py
    "The recording's mass keys are not those of its walkers: give some for each, or ().": (
        "Die Keyframes der Massen in der Aufnahme sind nicht die ihrer Läufer: für jeden welche geben, oder ()."
    ),
    "Only walkers who are there all the time can have keys on their mass: remove them.": (
        "Nur Läufer, die immer da sind, können Keyframes auf ihrer Masse haben: sie entfernen."
    ),
    "The keys on the mass of {} need times that rise.": "Die Keyframes auf der Masse von {} brauchen steigende Zeiten.",
    "{} has a mass of {} kg at {} s: give it one above 0 and up to {}.": (
        "{} hat eine Masse von {} kg bei {} s: eine über 0 und bis {} geben."
    ),
    # ---- motion/recording.py
    "The recording's {} has shape {} where {} is needed: record the walk again.": (
        "{} der Aufnahme hat die Form {}, wo {} nötig ist: den Gang noch einmal aufnehmen."
    ),
    "The recording's {} has {} entries where {} are needed: record the walk again.": (
        "{} der Aufnahme hat {} Einträge, wo {} nötig sind: den Gang noch einmal aufnehmen."
    ),
    "The recording has {} soles for {} parts: give one for each.": (
        "Die Aufnahme hat {} Sohlen für {} Teile: für jedes eine geben."
    ),
    "The recording has no frames: choose a frame range in which the character walks.": (
        "Die Aufnahme hat keine Bilder: Bilder wählen, in denen die Figur geht."
    ),
    "The recording has no feet: choose the foot bones and record again.": (
        "Die Aufnahme hat keine Füße: die Fußknochen wählen und noch einmal aufnehmen."
    ),
    "The recording's cuts do not rise from its second sample to its last: record the walk again.": (
        "Die Schnitte der Aufnahme steigen nicht von ihrem zweiten Wert bis zum letzten: den Gang noch einmal "
        "aufnehmen."
    ),
    "The recording's jumps are not among its cuts and walkers: record the walk again.": (
        "Die Sprünge der Aufnahme gehören nicht zu ihren Schnitten und Läufern: den Gang noch einmal aufnehmen."
    ),
    "The recording's times do not increase: record the walk again.": (
        "Die Zeiten der Aufnahme steigen nicht: den Gang noch einmal aufnehmen."
    ),
    "The recording reaches {} s at {} frames a second, which no scene does: record the walk again.": (
        "Die Aufnahme reicht bis {} s mit {} Bildern in der Sekunde, was keine Szene tut: den Gang noch einmal "
        "aufnehmen."
    ),
    "The recording begins at frame {}, where no scene is: record the walk again.": (
        "Die Aufnahme beginnt bei Bild {}, wo keine Szene ist: den Gang noch einmal aufnehmen."
    ),
    "A frame rate of {} cannot be used: set the scene's frames a second to more than 0.": (
        "Eine Bildrate von {} geht nicht: die Bilder in der Sekunde der Szene auf mehr als 0 setzen."
    ),
    "{} has a mass of {} kg: give it one above 0 and up to {}.": (
        "{} hat eine Masse von {} kg: eine über 0 und bis {} geben."
    ),
    "The mass centre of {} has no finite position at frame {}: mend the animation there or leave the frame out.": (
        "Der Schwerpunkt von {} liegt in Bild {} nicht im Endlichen: die Animation dort richten, oder das Bild "
        "weglassen."
    ),
    "The recording's legs have no length above 0 for each walker: record the walk again.": (
        "Die Beine der Aufnahme haben nicht für jeden Läufer eine Länge über 0: den Gang noch einmal aufnehmen."
    ),
    "There is no contact law '{}': choose auto or {}.": "Es gibt kein Kontaktgesetz '{}': auto oder {} wählen.",
    "The recording has {} contact laws for {} walkers: give each one.": (
        "Die Aufnahme hat {} Kontaktgesetze für {} Läufer: jedem eines geben."
    ),
    "Bone {} has no finite position at frame {}: mend the animation there or leave the frame out.": (
        "Der Knochen {} liegt in Bild {} nicht im Endlichen: die Animation dort richten, oder das Bild weglassen."
    ),
    "Bone {} has a broken rotation at frame {}: record the walk again.": (
        "Der Knochen {} hat in Bild {} eine kaputte Drehung: den Gang noch einmal aufnehmen."
    ),
    "The sole of bone {} has no faces or a broken vertex: choose another sole.": (
        "Die Sohle des Knochens {} hat keine Flächen oder einen kaputten Punkt: eine andere Sohle wählen."
    ),
    "The sole of bone {} has a face without its vertices: choose another sole.": (
        "Die Sohle des Knochens {} hat eine Fläche ohne ihre Punkte: eine andere Sohle wählen."
    ),
    "The recording's contact point {} has no finite position: record the walk again.": (
        "Der Berührpunkt {} der Aufnahme liegt nicht im Endlichen: den Gang noch einmal aufnehmen."
    ),
    "The recording's {} says {} at {}, where 0 to {} are there: record the walk again.": (
        "{} der Aufnahme nennt {} bei {}, wo es 0 bis {} gibt: den Gang noch einmal aufnehmen."
    ),
    "Part {} of the recording, of bone {}, has no contact point: give it one.": (
        "Der Teil {} der Aufnahme, vom Knochen {}, hat keinen Berührpunkt: ihm einen geben."
    ),
    "Walkers {} cannot be taken of {}: give their numbers from 0 on, rising.": (
        "Die Läufer {} lassen sich nicht aus {} nehmen: ihre Nummern von 0 an geben, steigend."
    ),
    # ---- motion/scatter.py
    "A {} of {} cannot be used: choose one from 0 to {}.": "{} von {} geht nicht: etwas von 0 bis {} wählen.",
    # ---- placement/cycle.py
    "{} walks in place and is carried ahead at {} m/s.": (
        "{} geht auf der Stelle und wird mit {} m/s vorwärts getragen."
    ),
    "The recording of {} is too short to be carried along a path: record at least one whole stride.": (
        "Die Aufnahme von {} ist zu kurz, um an einem Weg entlang getragen zu werden: mindestens einen ganzen "
        "Doppelschritt aufnehmen."
    ),
    "{} does not walk ahead in its recording and cannot be carried along a path: record a walk, in place or over "
    "the ground.": (
        "{} geht in der Aufnahme nicht vorwärts und lässt sich nicht an einem Weg entlang tragen: einen Gang "
        "aufnehmen, auf der Stelle oder über den Boden."
    ),
    # ---- placement/passes.py
    "A {} is no ground to walk on: give a Ground, a Simulation or a function of points (n, 2).": (
        "Auf einem {} kann man nicht gehen: einen Ground, eine Simulation oder eine Funktion von Punkten (n, 2) geben."
    ),
    "A walk of {} passes cannot be walked: give a whole number from 1 on.": (
        "Ein Gang aus {} Durchgängen geht nicht: eine ganze Zahl von 1 an geben."
    ),
    "A pause of {} s cannot be used: choose one from 0 to {}.": (
        "Eine Pause von {} s geht nicht: eine von 0 bis {} wählen."
    ),
    "The keys on the mass of walkers do not count along a path: they weigh what they do at first.": (
        "Keyframes auf der Masse von Läufern zählen an einem Weg nicht: sie wiegen, was sie zu Anfang wiegen."
    ),
    "{} passes over {} m are too long for one recording: walk them in several bakes, or choose fewer passes or a "
    "lower frame rate.": (
        "{} Durchgänge über {} m sind zu lang für eine Aufnahme: sie mit mehrmaligem Backen gehen, oder weniger "
        "Durchgänge oder eine kleinere Bildrate wählen."
    ),
    "The walkers were recorded at different rates: resample them to one.": (
        "Die Läufer wurden mit verschiedenen Raten aufgenommen: sie auf eine bringen."
    ),
    # ---- placement/place.py
    "A {} of {} m cannot be used: give one above 0.": "{} von {} m geht nicht: mehr als 0 angeben.",
    "A toe slope of {} rad cannot be used: give 0 to {}.": (
        "Eine Neigung der Zehen von {} rad geht nicht: 0 bis {} angeben."
    ),
    "Feet are placed on a Ground or a Simulation: make one of the ground first.": (
        "Füße werden auf einen Ground oder eine Simulation aufgesetzt: erst eines aus dem Boden machen."
    ),
    "The floor's height is not a number: give it in metres, or none.": (
        "Die Höhe des Fußbodens ist keine Zahl: sie in Metern angeben, oder keine."
    ),
    "There is no walker {}: the recording has {}.": "Es gibt keinen Läufer {}: die Aufnahme hat {}.",
    "{} walks beside the ground: move the walker or the ground so that one lies over the other.": (
        "{} geht am Boden vorbei: den Läufer oder den Boden verschieben, so dass einer über dem anderen liegt."
    ),
    # ---- placement/wade.py
    "Feet cannot be lifted by {} m: give 0 or more.": "Füße lassen sich nicht um {} m heben: 0 oder mehr angeben.",
    # ---- blender/bodies.py
    "'{}' walks over grounds of which one lies over the other, and wades through one alone: untick Wade, or bake each "
    "ground by itself.": (
        "'{}' geht über Böden, von denen einer über dem anderen liegt, und watet nur durch einen: Waten ausschalten, "
        "oder jeden Boden für sich backen."
    ),
    # ---- placement/settle_feet.py
    "No foot stands on ground that is pressed: bake the trail of this walk first.": (
        "Kein Fuß steht auf Boden, der eingedrückt ist: erst die Spur dieses Gangs backen."
    ),
    # ---- placement/balance.py
    "A body cannot lean with a {} of {}: give {} to {}.": (
        "Ein Körper kann sich mit {} von {} nicht neigen: {} bis {} angeben."
    ),
    "{} does not go on two feet: only such a body leans, one on more feet lies along the ground.": (
        "{} geht nicht auf zwei Füßen: nur ein solcher Körper neigt sich, einer auf mehr Füßen folgt dem Boden."
    ),
}
