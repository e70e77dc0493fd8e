"""translations_crowd.py - labels and descriptions of crowds in other languages, as translations.py takes them."""

LABELS = {
    "Operator": {"Add Crowd": "Menge hinzufügen"},
    "*": {
        "A Day": "Am Tag",
        "Brush": "Gestrüpp",
        "Lawn": "Rasen",
        "Meadow": "Wiese",
        "Passages": "Gänge",
        "Sand": "Sand",
        "Snow 15 cm": "Schnee 15 cm",
        "Snow 25 cm": "Schnee 25 cm",
        "Snow 35 cm": "Schnee 35 cm",
    },
}
GERMAN = {
    "Let a crowd go between the selected empties, round the selected meshes, and show its last ways": (
        "Eine Menge zwischen den gewählten Leerobjekten gehen lassen, um die gewählten Netze herum, und ihre letzten "
        "Wege zeigen"
    ),
    "Grass that wears, and draws walkers where it is worn": "Gras, das sich abnutzt und anzieht, wo es abgenutzt ist",
    "Grass that hardly costs more than a firm way": "Gras, das kaum mehr Mühe macht als ein fester Weg",
    "High plants, which walkers go round": "Hohe Pflanzen, um die herumgegangen wird",
    "Loose ground that does not wear": "Lockerer Boden, der sich nicht abnutzt",
    "Snow in which feet sink by 15 cm, until it is trodden": "Schnee, in den Füße 15 cm einsinken, bis er getreten ist",
    "Snow in which feet sink by 25 cm, until it is trodden": "Schnee, in den Füße 25 cm einsinken, bis er getreten ist",
    "Snow in which feet sink by 35 cm, until it is trodden": "Schnee, in den Füße 35 cm einsinken, bis er getreten ist",
    "What the crowd walks on": "Worauf die Menge geht",
    "How often somebody goes from place to place": "Wie oft jemand von Ort zu Ort geht",
    "So many of the passages are those of one day": "So viele der Gänge sind die eines Tages",
    "Of who goes where, and how": "Dafür, wer wohin geht, und wie",
    "Select an empty that the crowd goes to first": "Erst ein Leerobjekt wählen, zu dem die Menge geht",
}
