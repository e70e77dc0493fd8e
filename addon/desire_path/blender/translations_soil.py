"""translations_soil.py - how soils and spray are described in other languages; see translations_described.py."""

GERMAN = {
    "How thick the soft soil lies over rigid ground, in metres": (
        "Wie dick die weiche Schicht über festem Grund liegt, in Metern"
    ),
    "How hard it resists, in pascal: half of it, prints twice as deep": (
        "Wie stark er widersteht, in Pascal: die Hälfte davon, und Abdrücke werden doppelt so tief"
    ),
    "How much of what is pressed is pushed aside: 0 nothing, 0.5 all of it": (
        "Wie viel vom Gepressten beiseitegeschoben wird: 0 nichts, 0.5 alles"
    ),
    "How long it takes to give way, in seconds": "Wie lange er braucht, um nachzugeben, in Sekunden",
    "Loose soil that is steeper slides": "Loser Boden, der steiler ist, rutscht",
    "A sideways push this strong leaves the rim on one side alone, in newtons; 0 = half the walker's weight": (
        "Ein so starker seitlicher Schub lässt den Rand nur auf einer Seite, in Newton; 0 = das halbe Gewicht des "
        "Läufers"
    ),
    "How far it shears before it carries sideways, in metres; 0 = no slip": (
        "Wie weit er geschert wird, bevor er seitlich trägt, in Metern; 0 = kein Rutschen"
    ),
    "Firm walls of prints that are steeper come loose and slide; 90 degrees = all stand": (
        "Feste Wände von Abdrücken, die steiler sind, lösen sich und rutschen; 90 Grad = alle stehen"
    ),
    "By how much walls, slopes and rims differ from place to place; 0 = as from a mould": (
        "Wie sehr sich Wände, Böschungen und Ränder von Ort zu Ort unterscheiden; 0 = wie aus einer Form"
    ),
    "How far apart places are that differ, in metres": (
        "Wie weit Orte auseinanderliegen, die sich unterscheiden, in Metern"
    ),
    "Share of a print's depth that comes back when the foot lifts": (
        "Anteil der Tiefe eines Abdrucks, der zurückkommt, wenn der Fuß abhebt"
    ),
    "How wide it bulges around a print, in metres; 0 = loose soil in a heap": (
        "Wie breit er sich um einen Abdruck aufwölbt, in Metern; 0 = loser Boden als Haufen"
    ),
    "How long what slides takes for 10 cm, in seconds; 0 = it comes to rest at once": (
        "Wie lange Rutschendes für 10 cm braucht, in Sekunden; 0 = es kommt sofort zur Ruhe"
    ),
    "0 like a trodden path, 1 like powder: each tenth more, prints three quarters deeper": (
        "0 wie ein Trampelpfad, 1 wie Pulver: mit jedem Zehntel mehr werden Abdrücke um drei Viertel tiefer"
    ),
    "How thick the soft soil lies over rigid ground": "Wie dick die weiche Schicht über festem Grund liegt",
    "How much of what is pressed is pushed aside: 0 nothing, 1 all of it": (
        "Wie viel vom Gepressten beiseitegeschoben wird: 0 nichts, 1 alles"
    ),
    "How soon walls of prints come loose and slide: 0 = all stand": (
        "Wie bald sich Wände von Abdrücken lösen und rutschen: 0 = alle stehen"
    ),
    "How wide it bulges around a print; 0 = loose soil in a heap": (
        "Wie breit er sich um einen Abdruck aufwölbt; 0 = loser Boden als Haufen"
    ),
    "How far apart places are that differ": "Wie weit Orte auseinanderliegen, die sich unterscheiden",
    "How far soles shear it before it carries sideways; 0 = they do not slip": (
        "Wie weit Sohlen ihn scheren, bevor er seitlich trägt; 0 = sie rutschen nicht"
    ),
    "0 = it breaks under anything, 0.4 = under a person where it is 2 cm thick, 1 = like ice": (
        "0 = sie bricht unter allem, 0.4 = unter einem Menschen, wo sie 2 cm dick ist, 1 = wie Eis"
    ),
    "How heavy a cubic metre of this snow is, which packs under feet: 100 powder, 350 by wind; 0 = no snow": (
        "Wie schwer ein Kubikmeter dieses Schnees ist, der sich unter Füßen verdichtet: 100 Pulver, 350 vom Wind; "
        "0 = kein Schnee"
    ),
    "Bekker's k_phi of ground that was measured, in N/m^(n+2), in place of its stiffness; 0 = none": (
        "Bekkers k_phi von gemessenem Boden, in N/m^(n+2), statt seiner Steifigkeit; 0 = keines"
    ),
    "Bekker's k_c of ground that was measured, in N/m^(n+1); 0 = none": (
        "Bekkers k_c von gemessenem Boden, in N/m^(n+1); 0 = keines"
    ),
    "How large the crumbs of its rims are at most, in metres; 0 = as usual for its kind": (
        "Wie groß die Krümel seiner Ränder höchstens sind, in Metern; 0 = wie für seine Art üblich"
    ),
    "How large the crumbs of its rims are at most, where details are shown; 0 = as usual for its kind": (
        "Wie groß die Krümel seiner Ränder höchstens sind, wo Einzelheiten gezeigt werden; 0 = wie für seine Art üblich"
    ),
    "How thick it sticks to a sole or wheel that lifts, in metres; 0 = not at all": (
        "Wie dick er an einer Sohle oder einem Rad haftet, die sich heben, in Metern; 0 = gar nicht"
    ),
    "How thick it sticks to a sole or wheel that lifts, to be left along the way; 0 = not at all": (
        "Wie dick er an einer Sohle oder einem Rad haftet, die sich heben, und unterwegs zurückbleibt; 0 = gar nicht"
    ),
    "Pressure under which most of what sticks comes off on other ground, in pascal: more carries it farther": (
        "Druck, unter dem das meiste, was haftet, auf anderem Boden abgeht, in Pascal: mehr trägt es weiter"
    ),
    "How deep below the ground water stands, which shows in deeper prints, in metres; 0 = none": (
        "Wie tief unter dem Boden Wasser steht, das sich in tieferen Abdrücken zeigt, in Metern; 0 = keines"
    ),
    "How far a sole may slide before soil flows off ahead of it, in metres: before, it shears along; 0 = at once": (
        "Wie weit eine Sohle rutschen darf, bis Erde vor ihr ausweicht, in Metern: bis dahin schert sie mit; 0 = sofort"
    ),
    "How deep below the ground water stands: it fills deeper prints up to there; 0 = none": (
        "Wie tief unter dem Boden Wasser steht: es füllt tiefere Abdrücke bis dorthin; 0 = keines"
    ),
    "Bekker's n: how sinkage grows with pressure": "Bekkers n: wie das Einsinken mit dem Druck wächst",
    "How full of water it is: damp walls stand, soaked ones slide; 0 = dry, 1 = it flows": (
        "Wie voll Wasser er ist: feuchte Wände stehen, durchnässte rutschen; 0 = trocken, 1 = er fließt"
    ),
    "How thick a crust lies on top, in metres; 0 = none": "Wie dick eine Kruste obenauf liegt, in Metern; 0 = keine",
    "How thick a crust lies on top, which carries until it breaks into pieces; 0 = none": (
        "Wie dick eine Kruste obenauf liegt, die trägt, bis sie in Stücke bricht; 0 = keine"
    ),
    "What bending the crust bears before it breaks into pieces, in pascal; 0 = none": (
        "Welche Biegung die Kruste aushält, bevor sie in Stücke bricht, in Pascal; 0 = keine"
    ),
    "Where this soil lies: weights above one half": "Wo diese Bodenart liegt: Gewichte über ein halb",
    "The soil that lies where the group is painted": "Die Bodenart, die liegt, wo die Gruppe gemalt ist",
    "{} MPa, stays at slopes up to {} degrees, yields in {} s": (
        "{} MPa, hält an Böschungen bis {} Grad, gibt in {} s nach"
    ),
    "The numbers of this soil, by the names of Soil": "Die Werte dieser Bodenart, nach den Namen von Soil",
    "A .json file in which a soil was saved, in place of the preset and the numbers; empty = none": (
        "Eine .json-Datei, in der eine Bodenart gespeichert wurde, anstelle von Vorlage und Werten; leer = keine"
    ),
    "A vertex group that scales the thickness: 1 = all of it, 0 = it does not lie there. Empty = it lies everywhere": (
        "Eine Vertex-Gruppe, die die Dicke skaliert: 1 = die ganze, 0 = dort liegt sie nicht. Leer = sie liegt überall"
    ),
    "Above the one that lies on it": "Über die, die auf ihr liegt",
    "Below the one it lies on": "Unter die, auf der sie liegt",
    "How thick it lies": "Wie dick sie liegt",
    "How thick it lies, in metres": "Wie dick sie liegt, in Metern",
    "Lay another soil on the ground, on top of all that lie there": (
        "Eine weitere Bodenart auf den Boden legen, über alle, die dort liegen"
    ),
    "Move the layer above or below another one": "Die Schicht über oder unter eine andere schieben",
    "Soils that lie on the ground's own, from the top down: snow on earth, mud on a road": (
        "Bodenarten, die auf der eigenen des Bodens liegen, von oben nach unten: Schnee auf Erde, Schlamm auf einer "
        "Straße"
    ),
    "Take the layer off the ground; its vertex group stays": (
        "Die Schicht vom Boden nehmen; ihre Vertex-Gruppe bleibt"
    ),
    "What this layer is made of": "Woraus diese Schicht besteht",
    "Where the layer goes": "Wohin die Schicht kommt",
    # ---- spray
    "A volume for each frame of what flies over the ground": "Ein Volumen je Bild von dem, was über dem Boden fliegt",
    "What sticks to soles and wheels, and flies off them where they are moved fast": (
        "Was an Sohlen und Rädern haftet und fortfliegt, wo sie schnell bewegt werden"
    ),
    "Nothing sticks": "Nichts haftet",
    "Dry grains, which come off at once": "Trockene Körner, die sich sofort lösen",
    "Lumps that hold on, and fly off what turns or swings fast": (
        "Klumpen, die haften und von dem fortfliegen, was sich schnell dreht oder schwingt"
    ),
    "Light flakes, which the air slows down": "Leichte Flocken, die die Luft bremst",
    "How much of it sticks, against what is usual": "Wie viel davon haftet, gegen das Übliche",
}
