"""Who touches the ground and how hard: contacts and forces of a recording, its report and picture."""
