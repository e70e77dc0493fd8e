"""translations_said.py - what the add-on says in other languages: questions, and why a button cannot be pressed.

Keys are the English sentences; {} is what comes in, in the same order.
"""

GERMAN = {
    "Free the bake of '{}'?": "Gebackenes von '{}' löschen?",
    "Free": "Löschen",
    "Undo brings it back until the file is saved or closed.": (
        "Rückgängig bringt es wieder, bis die Datei gespeichert oder geschlossen wird."
    ),
    "Frame {}, {} left, {:.1f} MB": "Bild {}, noch {}, {:.1f} MB",
    "ESC: stop": "ESC: anhalten",
    "A bake is running": "Es wird gerade gebacken",
    "Leave Edit Mode first": "Erst den Bearbeitungsmodus verlassen",
    "Press Add Ground first": "Erst Boden hinzufügen",
    "Select a ground first": "Erst einen Boden wählen",
    "Select the ground first": "Erst den Boden wählen",
    "Select the mesh that is walked on first": "Erst das Netz wählen, auf dem gegangen wird",
    "Select the armature that walks first": "Erst das Skelett wählen, das geht",
    "Select the armature that walks, or a mesh that moves first": (
        "Erst das Skelett wählen, das geht, oder ein Netz, das sich bewegt"
    ),
    "Select a character, its armature or a mesh it wears, and a ground if there is one": (
        "Eine Figur wählen, ihr Skelett oder ein Netz, das sie trägt, und einen Boden, wenn es einen gibt"
    ),
    "Select a character. To import {} here, call as root: {}": (
        "Eine Figur wählen. Um hier {} zu importieren, als root aufrufen: {}"
    ),
    "There is no ground in this scene": "In dieser Szene gibt es keinen Boden",
    "This is a ground: select the armature that walks on it, or a mesh that moves": (
        "Das ist ein Boden: das Skelett wählen, das darauf geht, oder ein Netz, das sich bewegt"
    ),
    "'{}' is linked from another file: make a library override of it (Object > Library Override > Make), or open "
    "that file": (
        "'{}' ist aus einer anderen Datei verknüpft: ein Library Override davon machen (Objekt > Library Override > "
        "Make), oder jene Datei öffnen"
    ),
    "'{}' shows instances of a collection: make them real (Object > Apply > Make Instances Real) and select the "
    "mesh that is walked on": (
        "'{}' zeigt Instanzen einer Sammlung: sie eigenständig machen (Objekt > Anwenden > Make Instances Real) und "
        "das Netz wählen, auf dem gegangen wird"
    ),
    "A bake is running, or something is pressed already": "Es wird gerade gebacken oder schon etwas gepresst",
    "Select a ground, and beside it the objects to press into it": (
        "Einen Boden wählen, und dazu die Objekte, die hineingedrückt werden"
    ),
}
