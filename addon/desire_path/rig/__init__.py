"""From an armature to a recording: names, legs, feet, soles, masses."""
