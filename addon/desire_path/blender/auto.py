"""auto.py - settings that follow by themselves until they are set by hand."""


def set_auto(settings, **values):
    """Set what follows by itself, without taking it for a choice made by hand."""
    for name, value in values.items():
        setattr(settings, name, value)
        flag = "folder_auto" if name == "folder" else "frames_auto"
        setattr(settings, flag, True)
